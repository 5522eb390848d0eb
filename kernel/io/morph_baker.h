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
};

/// Collects shapes. Shapes that are the same as 32-bit numbers share a target, and the rest shape
/// needs none.
class MorphBaker {
  public:
    /// `rest` is the shape without targets; vertices outside `moving` keep their positions. Morph
    /// targets of `rest` and their animations from its file are left out; the log says so. Errors:
    /// topology_mismatch; unsupported for a mesh without faces; memory_limit.
    MorphBaker(const Mesh& rest, const Region& moving, BakeOptions options = {},
               Context context = {});

    /// Adds a key: the mesh has the shape of `shape` at `time`, in seconds: positions, and normals
    /// and tangents if the rest shape has them. Errors: invalid_argument for times that are
    /// negative or not after the one before, as 32-bit numbers, and beyond 10000 different shapes;
    /// topology_mismatch; memory_limit; cancelled.
    void add(double time, const Mesh& shape);

    Index key_count() const { return count_of(times_); }
    Index target_count() const { return count_of(targets_); }

    /// Returns the rest shape with its targets as attributes "morph.N.position" and so on, and the
    /// animation in its asset. Errors: invalid_argument if no shape was added.
    Mesh finish() const;

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
    void write_target(Index target, Mesh& mesh) const;

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
