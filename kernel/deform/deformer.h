/// Deformation of a region of a mesh by handles: the implicit differential method of Fu,
/// "Differential methods for intuitive 3D shape modeling" (2007), chapter 2.
///
/// Local deformation gradients M_i are linear in the unknown positions (Eq 2.3 to 2.5). A first
/// sparse system reconstructs the surface from the transformed Laplacian coordinates under
/// coherence of neighbouring gradients (Eq 2.6 to 2.8); polar decomposition takes the shear out of
/// the gradients, and a second system reconstructs the surface from their rotations (Eq 2.10), or
/// rotations and scales (2.11).
///
///     Deformer deformer(mesh);
///     deformer.pin(base);
///     const HandleId tip = deformer.add_handle(end);
///     deformer.rotate(tip, Vec3::UnitZ(), kPi / 3);
///     mesh.set_positions(deformer.solve());
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ConstraintSet;
struct DeformFrame;
struct Preparation;
struct RestShape;

/// The state of a Deformer: rest shape, handles and constraints, their poses, and the shown result.
/// A copy is cheap, and restoring it is an undo.
struct DeformSnapshot {
    std::shared_ptr<const RestShape> rest;
    std::shared_ptr<const ConstraintSet> constraints;
    Poses poses;
    std::shared_ptr<const DeformFrame> shown;
};

/// A handle of a Deformer; valid until its handles or constraints change.
struct HandleInfo {
    /// Its vertices, including those around its points.
    const Region& region;
    const HandleOptions& options;
    /// Mean of the rest positions of its vertices and points.
    Vec3 center;
    /// Its mirror image; see mirror_handle.
    std::optional<HandleId> image;
};

/// Returns a stand-in for the context that a Deformer was made with.
const Context& own_context();

/// Deforms one region of one mesh. Vertices outside the region never move and keep the identity as
/// gradient. Factors are kept: a new transform costs no factorisation, a new handle does, at the
/// next solve. Accepts polygon meshes of any genus, with or without boundary. After an error the
/// deformer is as it was. More is beside it: deformed_surface.h, handle_changes.h, handle_basis.h,
/// deform_report.h, stats.h.
class Deformer {
  public:
    /// Deforms all of `mesh`, whose present shape is the rest shape; the mesh may change or die
    /// afterwards. Operations run under `context` unless they are given another: its progress,
    /// cancel, threads and memory. Errors: region_empty for a mesh without vertices;
    /// invalid_argument for options out of range.
    explicit Deformer(const Mesh& mesh, const DeformOptions& options = {},
                      const Context& context = {});
    /// Deforms `region` of `mesh`. Errors: also topology_mismatch.
    Deformer(const Mesh& mesh, const Region& region, const DeformOptions& options = {},
             const Context& context = {});
    ~Deformer();
    Deformer(Deformer&&) noexcept;
    Deformer& operator=(Deformer&&) noexcept;

    const Region& region() const;

    /// Adds a handle of the given vertices with the identity as transform.
    /// Errors: region_empty; topology_mismatch; handle_outside_region; handle_overlap, each naming
    /// the vertices; invalid_argument if neither position nor gradient is asked for.
    HandleId add_handle(const Region& vertices, const HandleOptions& options = {});
    /// Adds a handle of points, for instance `path_points`. Those in faces and on edges go exactly
    /// to the image of the transform, unless the handle is soft: the mean of the deformed vertices
    /// does. Errors: as before, and as checked_point; handle_overlap at the next preparation if all
    /// vertices of a point are already constrained.
    HandleId add_handle(std::span<const MeshPoint> points, const HandleOptions& options = {});
    /// Holds vertices at rest: adds a handle that stays. Errors: as add_handle.
    HandleId pin(const Region& vertices) { return add_handle(vertices); }
    /// Removes a handle. Errors: handle_removed.
    void remove_handle(HandleId handle);
    /// Returns the handles in the order they were added.
    std::vector<HandleId> handles() const;
    /// Returns the vertices, options and centre of a handle. Errors: handle_removed.
    HandleInfo handle(HandleId handle) const;

    /// Sets the whole transform of a handle about a point: rest position p goes to
    /// about + transform(p - about), to the bit if `about` is the origin, with the gradient
    /// transform.linear. A mesh far from the origin of its coordinates keeps its digits with a near
    /// `about`. `turn` is a rotation vector, axis times angle in radians, of any length: of all
    /// that fit the transform, the nearest to it is taken; without it, the nearest to the present
    /// one, so that a drag through half a turn goes on turning. A handle that comes back to the
    /// identity after a full turn is not at rest.
    /// Errors: singular_transform (determinant zero or not finite); not_finite; handle_removed.
    void set_transform(HandleId handle, const Affine& transform, const Vec3& about = Vec3::Zero(),
                       const std::optional<Vec3>& turn = std::nullopt);
    /// Turns a handle on about its present centre, by an angle in radians about a direction of any
    /// length. Errors: invalid_argument for an axis without length; handle_removed.
    void rotate(HandleId handle, const Vec3& axis, double angle);
    /// Moves a handle on. Errors: not_finite; handle_removed.
    void translate(HandleId handle, const Vec3& offset);
    /// Returns the transform of a handle, and its turn: axis times angle in radians, counting full
    /// turns. Errors: handle_removed.
    const HandlePose& pose(HandleId handle) const;

    /// Constrains a point or a vertex, and replaces an earlier constraint of it. Without position
    /// and gradient it is free again. Errors: out_of_range; as checked_point;
    /// handle_outside_region; handle_overlap if a handle holds the vertex, or at the next
    /// preparation if all vertices of the point are already constrained; not_finite;
    /// invalid_argument for a weight that is not above 0.
    void constrain(const PointConstraint& constraint);

    /// Assembles and factors the systems of the present handles, unless that is done; `solve` does
    /// it by itself. Returns them for frames of the host's own; see pipeline.h. Errors:
    /// unconstrained, naming a part of the region that nothing holds; zero_area;
    /// not_positive_definite; memory_limit; cancelled; unsupported for handles that a comparison
    /// method cannot hold.
    std::shared_ptr<const Preparation> prepare(const Context& context = own_context());
    /// Solves both systems and returns `positions()`. With every transform the identity they are
    /// the rest shape to the bit. A preview solves the first system only (Eq 2.8), by the handle
    /// basis; a draft is approximate (1e-5 of the size), about twice as fast. Logs a warning if
    /// handles that nearly touch tear the surface; see DeformReport::tears. Errors: as prepare.
    const std::vector<Vec3>& solve(FrameQuality quality = FrameQuality::full,
                                   const Context& context = own_context());
    /// Returns the positions of the region's vertices, in the order of `region().vertices()`, from
    /// the last solve; rest positions before one.
    const std::vector<Vec3>& positions() const;
    /// Writes `positions()` into the region's vertices of `mesh`. Custom normals, tangents and
    /// morph targets in the region and next to it are carried along: they keep their angle to the
    /// surface's normal and turn about it as its edges do. Errors: as require_surroundings.
    void apply_to(Mesh& mesh) const;

    /// Sets all transforms to the identity and `positions()` to the rest shape, to the bit;
    /// constraints go.
    void reset();
    /// Takes `positions()`, the last result, as the new rest shape. Handles keep their vertices and
    /// options and hold their present places, with the identity as transform; so do constraints,
    /// however far from their targets. Factors are rebuilt at the next solve, which gives the same
    /// shape to the bit until something is moved.
    void rebase();

    /// Returns the present state, for `restore`. Errors: memory_limit.
    DeformSnapshot snapshot();
    /// Restores a state of this deformer to the bit: handles and constraints added since are gone,
    /// removed ones are there again under their ids. Errors: invalid_argument for a snapshot of
    /// another deformer.
    void restore(const DeformSnapshot& snapshot);

  private:
    struct State;
    friend struct DeformerAccess;
    std::unique_ptr<State> state_;
};

/// A handle for the one-shot function.
struct HandleMove {
    Region region;
    Affine transform;
    HandleOptions options;
};

/// Deforms `region` of `mesh` once. For repeated solves with the same handles keep a Deformer.
/// Errors: as Deformer; the mesh is then unchanged.
void deform(Mesh& mesh, const Region& region, std::span<const HandleMove> handles,
            const DeformOptions& options = {}, const Context& context = {});

}  // namespace lissom
