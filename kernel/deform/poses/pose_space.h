/// PoseSpace: blends of posed meshes of one topology, in which parts turn as they do in life: an
/// arm half way between straight and bent is bent by half, and not shortened as a linear blend is.
///
///     const PoseSpace space(rest, {{"smile", {smile}}, {"bent", {half_bent, bent}}});
///     const Mesh mesh = space.blend({{"smile", 0.5}, {"bent", 1.0}});
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A pose by name. Several shapes are a path from rest: of n shapes, shape k is at weight k / n.
struct NamedPose {
    std::string name;
    std::vector<Mesh> shapes;
};

/// The weight of a pose in a blend: 0 is rest, 1 the pose; others extrapolate.
struct PoseWeight {
    std::string name;
    double weight = 0.0;
};

/// Keeps, for each pose, the rotation of every triangle, continuous over the surface, and the
/// stretch of its edges before that (Sumner et al., "Mesh-based inverse kinematics", 2005). A blend
/// adds rotation vectors and stretches, and finds the surface by Poisson's equation, with one
/// factor for all blends. Vertices that no pose moves stay to the bit. A component that all poses
/// move takes the screw motion of its calmest part; a smaller one that sits on the largest, such as
/// an eye, follows the surface below it. Accepts polygon meshes of any genus and number of
/// components. A copy is cheap.
class PoseSpace {
  public:
    /// Copies the shapes. Errors: mesh_empty for a rest without vertices; invalid_argument without
    /// poses, for a pose without shapes, and for a name that is empty or there twice;
    /// topology_mismatch, naming the pose, if its faces are not those of `rest`; memory_limit;
    /// cancelled.
    PoseSpace(const Mesh& rest, const std::vector<NamedPose>& poses, const Context& context = {});

    /// Returns the rest mesh in the blended shape. No weights give its shape to the bit, and a pose
    /// alone that of the pose. Custom normals, tangents and morph targets turn along. Rigid motions
    /// blend as screws. Errors: as positions.
    Mesh blend(const std::vector<PoseWeight>& weights, const Context& context = {}) const;
    /// Returns the positions alone. Weights of one name add up. Errors: not_finite;
    /// out_of_range for a name that no pose has; cancelled.
    std::vector<Vec3> positions(const std::vector<PoseWeight>& weights,
                                const Context& context = {}) const;

    const Mesh& rest() const;
    /// Returns the names of the poses, in order.
    std::vector<std::string> names() const;
    /// Returns the number of shapes of a pose. Errors: out_of_range.
    Index shape_count(const std::string& name) const;
    std::size_t memory_bytes() const;

  private:
    friend class PoseFrames;
    struct State;
    std::shared_ptr<const State> state_;
};

/// Blends of a space one after another, as an animation needs them. From the third blend on they
/// allocate nothing, if the context has one thread. One thread at a time may use it.
class PoseFrames {
  public:
    explicit PoseFrames(PoseSpace space);
    ~PoseFrames();
    PoseFrames(PoseFrames&&) noexcept;
    PoseFrames& operator=(PoseFrames&&) noexcept;

    /// Returns the positions of a blend, which are those of PoseSpace::positions to the bit and
    /// stay until the next one. `weights` has one for each pose, in the order of PoseSpace::names.
    /// Errors: invalid_argument for another number of weights; not_finite; cancelled.
    std::span<const Vec3> positions(std::span<const double> weights, const Context& context = {});

    Index pose_count() const;

  private:
    struct Room;
    PoseSpace space_;
    std::unique_ptr<Room> room_;
};

}  // namespace lissom
