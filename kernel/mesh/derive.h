/// The one way to make a mesh from another: an ElementMap says for every new vertex, corner and
/// face which old ones it comes from, and everything that the old mesh holds follows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// For each new element, the old elements it comes from, with weights that sum to 1. An element
/// with no sources comes from nowhere: its attributes are NaN, it has no labels and is in no
/// region.
class ElementMap {
  public:
    struct Source {
        Index element = kNoIndex;
        double weight = 1.0;
    };

    ElementMap() = default;
    /// Element i comes from old element i.
    static ElementMap identity(Index count);
    /// Element i comes from old element sources[i]; kNoIndex for nowhere.
    static ElementMap copies(std::span<const Index> sources);

    /// Makes room for elements, most of them with one source.
    void reserve(Index elements);
    void add_new();
    void add_copy(Index source);
    /// The mean of `sources`.
    void add_mean(std::span<const Index> sources);
    /// Weights are scaled to sum 1.
    void add_blend(std::span<const Source> sources);

    Index size() const { return count_of(begin_) - 1; }
    std::span<const Source> operator[](Index element) const {
        return {sources_.data() + begin_[at(element)], sources_.data() + begin_[at(element + 1)]};
    }
    /// Returns the heaviest source of `element`, the first of ties, or kNoIndex.
    Index main_source(Index element) const;

  private:
    std::vector<std::size_t> begin_{0};
    std::vector<Source> sources_;
};

/// Sources of the elements of a new mesh. Corners are numbered as in Topology::first_corner.
struct MeshMap {
    ElementMap vertices, corners, faces;
};

/// Blends positions of `source` as `vertices` says. An element from nowhere gets the origin.
std::vector<Vec3> blend_positions(const Mesh& source, const ElementMap& vertices);
/// The same of one point, or displacement, for each vertex of the source.
std::vector<Vec3> blend_points(std::span<const Vec3> points, const ElementMap& vertices);

/// Returns the mesh with the given positions and faces and these contents of `source`:
/// - attributes are blended; a source without a value (NaN) does not count, but for morph targets,
///   which add nothing there. "normal" attributes are made unit again; integer attributes other
///   than "color", "normal" and "uv" take the value of the heaviest source;
/// - a face gets the labels of its heaviest source;
/// - a vertex is in a named region when all of its sources are;
/// - material libraries are kept.
///
/// Errors: invalid_argument if a map's size differs from the new element count, or as
/// require_complete_attributes; as Mesh::Mesh.
Mesh derive(const Mesh& source, std::vector<Vec3> positions, FaceList faces, const MeshMap& map,
            const Context& context = {});

/// Carries the contents of `source` to `target`, a mesh without any, as derive does. Errors: as
/// derive.
void carry(const Mesh& source, const MeshMap& map, Mesh& target, const Context& context = {});

}  // namespace lissom
