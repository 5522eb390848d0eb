/// Baking: a sequence of shapes of one mesh becomes morph targets and an animation, which a glTF
/// file holds and every viewer of such files plays.
///
///     MorphBaker baker(mesh, edit.region());
///     for (...) {
///         edit.set_transform(...);
///         edit.solve();
///         edit.apply_to(shape);
///         baker.add(time, shape);
///     }
///     save_mesh(baker.finish(), "wave.glb");
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Interpolation between two keys: the shape moves along straight lines, or it stays and then
/// jumps.
enum class KeyInterpolation { linear, step };

struct BakeOptions {
    /// Name of the animation.
    std::string name = "deformation";
    KeyInterpolation interpolation = KeyInterpolation::linear;
    /// Gives a mesh without normals those of its surface, so that light follows the motion. Normals
    /// that it has always follow.
    bool normals = true;
    /// Greatest distance of a vertex from its shape, in mesh units. Above 0 the targets are the
    /// principal components of the shapes, as few as keep it and turn normals and tangents by about
    /// 1 degree at most; at 0 each different shape is a target, to the bit.
    double tolerance = 0.0;
};

/// Targets and errors of a bake.
struct BakeReport {
    Index keys = 0, targets = 0;
    /// Greatest distance of a vertex from its shape at a key, in mesh units, and of a normal or
    /// tangent.
    double max_error = 0.0, max_direction_error = 0.0;
};

/// Collects shapes. Shapes that are the same as 32-bit numbers count as one, and the rest shape
/// needs no target.
class MorphBaker {
  public:
    /// `rest` is the shape without targets; vertices outside `moving` keep their positions. Morph
    /// targets of `rest` and their animations from its file are left out; the log says so. Errors:
    /// topology_mismatch; unsupported for a mesh without faces; memory_limit; invalid_argument for
    /// a tolerance that is no length.
    MorphBaker(const Mesh& rest, const Region& moving, BakeOptions options = {},
               Context context = {});

    /// Adds a key: the mesh has the shape of `shape` at `time`, in seconds: positions, and normals
    /// and tangents if the rest shape has them. Errors: invalid_argument for times that are
    /// negative or not after the one before, as 32-bit numbers, and beyond 10000 different shapes;
    /// topology_mismatch; memory_limit; cancelled.
    void add(double time, const Mesh& shape);

    Index key_count() const { return count_of(times_); }
    /// Different shapes so far, but for that of rest.
    Index target_count() const { return count_of(targets_); }

    /// Returns the rest shape with its targets as attributes "morph.N.position" and so on, and the
    /// animation in its asset. Errors: invalid_argument if no shape was added; memory_limit;
    /// cancelled.
    Mesh finish(BakeReport* report = nullptr) const;

  private:
    // Values of the mesh that targets add to, one entry for each element that may change.
    struct Channel {
        std::string attribute, suffix;
        Domain domain = Domain::vertex;
        std::vector<Index> elements;
        std::vector<Vec3> rest;
    };

    void add_channel(const std::string& attribute, const std::string& suffix, Domain domain,
                     const std::vector<char>& moves);
    void add_directions(const std::vector<char>& moves);
    void require_later(double time) const;
    std::vector<float> differences(const Mesh& shape) const;
    Index target_of(std::vector<float> differences);
    void write_target(Index target, const std::vector<float>& values, Mesh& mesh) const;
    std::vector<float> key_weights(const std::vector<std::vector<float>>& weights) const;

    Mesh rest_;
    BakeOptions options_;
    Context context_;
    std::vector<char> moves_;
    bool makes_normals_ = false;
    std::vector<Channel> channels_;
    std::vector<std::vector<float>> targets_;
    std::vector<MemoryCharge> charges_;
    std::unordered_multimap<std::size_t, Index> target_by_hash_;
    std::vector<float> times_;
    // The target of each key, or kNoIndex for the rest shape.
    std::vector<Index> key_target_;
};

}  // namespace lissom
