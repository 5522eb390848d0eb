/// Deformation of a region of a mesh by handles: the implicit differential method of Fu,
/// "Differential methods for intuitive 3D shape modeling" (2007), chapter 2.
///
/// Local deformation gradients M_i are linear in the unknown positions (Eq 2.3 to 2.5). A first
/// sparse system reconstructs the surface from the transformed Laplacian coordinates under
/// coherence of neighbouring gradients (Eq 2.6 to 2.8); polar decomposition takes the shear out of
/// the gradients, and a second system reconstructs the surface from their rotations (Eq 2.10), or
/// rotations and scales (2.11).
///
///     Deformer edit(mesh, region);
///     const HandleId tip = edit.add_handle(tip_region);
///     edit.set_transform(tip, rotation(axis, angle, edit.handle_center(tip)));
///     edit.solve();
///     edit.apply_to(mesh);
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/deform_report.h"
#include "kernel/deform/holds/holds.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// The first system's solution as a linear function of the handles' transforms:
/// x_v = fixed_v + sum_h [linear_h translation_h] * weight(h, v), with `weight` a 4-vector.
struct HandleBasis {
    /// Vertices of the region, ascending; one row of the basis each.
    std::vector<Index> vertices;
    std::vector<HandleId> handles;
    /// For each handle, in the order of `handles`, one 4-vector a row.
    std::vector<std::vector<Vec4>> weights;
    /// Part that no handle moves: what is pinned outside the region, and vertex constraints.
    std::vector<Vec3> fixed;
};

/// How the handles of a Deformer stand, with all that is kept of their moves; see
/// Deformer::poses.
struct HandlePoses;

/// What a Deformer shows: positions, and all that apply_to, refined_mesh, gradients and rebase take
/// from the last solve or preview; see Deformer::result.
using ShownResult = DeformFrame;

/// All that was asked of a Deformer. A copy is cheap, and putting it back is an undo.
struct DeformSetup {
    std::shared_ptr<const RestShape> rest;
    std::shared_ptr<const Holds> holds;
    Poses poses;
};

/// Deforms one region of one mesh. Vertices outside the region never move and keep the identity as
/// gradient. Factors are kept: a new transform costs no factorisation, a new handle does, at the
/// next solve. Accepts polygon meshes of any genus, with or without boundary. It keeps one of each
/// of the values of pipeline.h; after an error all of them are as they were.
class Deformer {
  public:
    /// Takes the present shape of `mesh` as rest shape; the mesh may change or die afterwards.
    /// Operations that are given no context of their own run under this one: its progress, cancel,
    /// threads and memory. Errors: region_empty; topology_mismatch; invalid_argument for options
    /// out of range.
    Deformer(const Mesh& mesh, const Region& region, const DeformOptions& options = {},
             const Context& context = {});
    ~Deformer();
    Deformer(Deformer&&) noexcept;
    Deformer& operator=(Deformer&&) noexcept;

    const Region& region() const;
    const DeformOptions& options() const;
    /// The context that the deformer was made with.
    const Context& context() const;

    /// Adds a handle of the given vertices with the identity as transform.
    /// Errors: region_empty; topology_mismatch; handle_outside_region; handle_overlap, each naming
    /// the vertices; invalid_argument where neither position nor gradient is asked for.
    HandleId add_handle(const Region& vertices, const HandleOptions& options = {});
    /// Adds a handle of points, for instance `path_points`. Those in faces and on edges go exactly
    /// where the transform takes them, unless the handle is soft: the mean of the deformed vertices
    /// does. Errors: as before, and as checked_point; handle_overlap at the next preparation where
    /// what is held already leaves a point nothing to move.
    HandleId add_handle(std::span<const MeshPoint> points, const HandleOptions& options = {});
    /// Errors: handle_removed.
    void remove_handle(HandleId handle);
    /// Adds the mirror image of a handle: a second handle with the same options, whose transform is
    /// always the mirrored one; moving either moves both. It holds the vertices nearest to the
    /// reflected ones and those whose own reflection lies on the handle, so that both sides may be
    /// tessellated differently; on a symmetric mesh the result is symmetric. Vertices on its rim
    /// that are no exact counterparts are left to other handles. Errors: invalid_argument if the
    /// region has no surface within a quarter of its radius of half of the image, naming the
    /// vertices, or if the handle has an image already; handle_overlap if the handle reaches the
    /// plane, or others hold the image; handle_removed.
    HandleId mirror_handle(HandleId handle, const MirrorPlane& plane);
    /// The mirror image of a handle, or nothing.
    std::optional<HandleId> mirrored_handle(HandleId handle) const;
    /// Measures how well both sides of the rest shape match where a handle has a mirror image.
    /// Errors: handle_removed; invalid_argument for a handle without one.
    MirrorResidual mirror_residual(HandleId handle) const;
    /// Gives a handle other vertices, and no points; its transform stays, and a mirrored handle
    /// follows. The result stays as it is until the next solve, which refactors.
    /// Errors: as add_handle and mirror_handle; handle_removed.
    void set_handle_region(HandleId handle, const Region& vertices);
    /// Handles in the order they were added.
    std::vector<HandleId> handles() const;
    /// Its vertices; those around its points among them.
    const Region& handle_region(HandleId handle) const;
    const HandleOptions& handle_options(HandleId handle) const;
    /// Mean of the rest positions of the handle's vertices and points.
    Vec3 handle_center(HandleId handle) const;

    /// Sets where a handle goes: rest position p to transform(p), to the bit, gradient
    /// transform.linear.
    /// Errors: singular_transform (determinant zero or not finite); handle_removed.
    void set_transform(HandleId handle, const Affine& transform);
    /// The same about a point: rest position p goes to about + transform(p - about). A mesh that
    /// lies far from the origin of its coordinates keeps its digits so, where `about` is near it;
    /// and then held vertices lie there up to the rounding of their coordinates, which composing a
    /// transform of the whole space cannot promise.
    void set_transform(HandleId handle, const Affine& transform, const Vec3& about);
    /// The same, saying how far the handle turns: `turn` is a rotation vector, axis times angle in
    /// radians, of any length. Of all that fit the transform, the nearest to it is taken; without
    /// it, the nearest to where the handle stood, so that a drag through half a turn goes on
    /// turning. A handle that comes back to the identity after a full turn is not at rest.
    void set_transform(HandleId handle, const Affine& transform, const Vec3& about,
                       const Vec3& turn);
    const Affine& transform(HandleId handle) const;
    /// The rotation of the handle, counting full turns: axis times angle in radians.
    Vec3 turn(HandleId handle) const;
    /// How the handles stand, to be put back by `restore`, to the bit.
    std::shared_ptr<const HandlePoses> poses() const;
    /// Handles that were removed since, or added, are left as they are.
    void restore(const HandlePoses& poses);
    /// What was asked so far: handles, their transforms, constraints, stiffness and the rest shape.
    DeformSetup setup() const;
    /// Puts a setup of this deformer back, to the bit: handles and constraints added since are
    /// gone, and those removed since are there again, under the ids that they had; an id that was
    /// used in between names what it named before. What is shown stays until the next solve.
    /// Errors: invalid_argument for a setup of another deformer.
    void restore(const DeformSetup& setup);
    /// The map f with which p goes to about + f(p - about): what to compose moves with.
    Affine transform_about(HandleId handle, const Vec3& about) const;

    /// Constrains one vertex, replacing an earlier constraint of it. A vertex with neither position
    /// nor gradient is free again. Errors: out_of_range; handle_outside_region; handle_overlap
    /// where a handle holds the vertex; not_finite; invalid_argument for a weight that is not above
    /// 0.
    void constrain(const VertexConstraint& constraint);
    /// The same for a point. Errors: as before, and as checked_point; handle_overlap at the next
    /// preparation where what is held already leaves the point nothing to move.
    void constrain(const PointConstraint& constraint);

    /// Sets how much the surface at `vertices` resists being bent and stretched, beside 1 for the
    /// rest: stiff parts move rigidly, and soft ones take the bend. Refactors.
    /// Errors: topology_mismatch; handle_outside_region; invalid_argument for a factor that is not
    /// from 1e-4 to 1e5: nothing softer or stiffer can be seen, but the systems lose digits.
    void set_stiffness(const Region& vertices, double factor);

    /// Assembles and factors what the present handles need, if that has not been done. `preview`
    /// and `solve` do it by themselves. Errors: unconstrained, naming a part of the region that
    /// nothing holds; zero_area; not_positive_definite; memory_limit; cancelled; unsupported for
    /// what a comparison method cannot hold.
    void prepare() { prepare(context()); }
    void prepare(const Context& context);

    /// What `prepare` makes, for frames of the host's own; see pipeline.h. Errors: as prepare.
    std::shared_ptr<const Preparation> preparation() { return preparation(context()); }
    std::shared_ptr<const Preparation> preparation(const Context& context);

    /// Solves the first system only (Eq 2.8), by the handle basis; as `solve` for a comparison
    /// method. Errors: as prepare.
    const std::vector<Vec3>& preview() { return preview(context()); }
    const std::vector<Vec3>& preview(const Context& context);
    /// Solves both systems. With every transform the identity the result is the rest shape to the
    /// bit. Logs a warning if handles that nearly touch tear the surface; see DeformReport::tears.
    const std::vector<Vec3>& solve() { return solve(context()); }
    const std::vector<Vec3>& solve(const Context& context);
    /// As `solve`, to about five digits of the size, for the frames of a drag: half the time. Solve
    /// once more when the drag ends.
    const std::vector<Vec3>& solve_draft() { return solve_draft(context()); }
    const std::vector<Vec3>& solve_draft(const Context& context);
    /// Solves the first system by its factor instead of the basis: the oracle of tests.
    /// Errors: as prepare; unsupported for a comparison method.
    std::vector<Vec3> solve_first_directly() { return solve_first_directly(context()); }
    std::vector<Vec3> solve_first_directly(const Context& context);

    /// Positions of the region's vertices, in the order of `region().vertices()`, from the last
    /// solve or preview; rest positions before one.
    const std::vector<Vec3>& positions() const;
    /// Rest positions of the region's vertices.
    const std::vector<Vec3>& rest_positions() const;
    /// Unit normals of the surface at the region's vertices, in the order of `positions()`: what a
    /// renderer reads beside them. Faces count by their angle, as in `vertex_normals`. Takes a
    /// small part of a frame. Errors: cancelled; memory_limit.
    const std::vector<Vec3>& normals() { return normals(context()); }
    const std::vector<Vec3>& normals(const Context& context);
    /// Writes `positions()` into the region's vertices of `mesh`. Custom normals, tangents and
    /// morph targets in the region and of the vertices next to it are carried by what the surface
    /// did: they keep their angle to its normal and turn about it as its edges do. Errors: as
    /// require_surroundings.
    void apply_to(Mesh& mesh) const;
    /// Throws topology_mismatch where `mesh` has another topology, or has changed around the region
    /// since the deformer was made: the result would tear there.
    void require_surroundings(const Mesh& mesh) const;
    /// What is shown, to be put back by `show`, to the bit, whatever was solved in between. The
    /// same object until something else is shown.
    std::shared_ptr<const ShownResult> result();
    /// Shows a result of this deformer again, or a frame of its preparation; the second form
    /// without a copy. The handles stay where they are; see `restore`. Errors: invalid_argument for
    /// one of another region.
    void show(const ShownResult& result);
    void show(std::shared_ptr<const ShownResult> result);
    /// `mesh` as apply_to leaves it, with the vertices that a refinement of coarse borders
    /// inserted: behind its own, where the last result has them. Faces that they lie on become
    /// triangles; attributes are interpolated. A mesh without such vertices is only copied. Errors:
    /// as apply_to; as prepare.
    Mesh refined_mesh(const Mesh& mesh) { return refined_mesh(mesh, context()); }
    Mesh refined_mesh(const Mesh& mesh, const Context& context);
    /// Writes the rest shape into the region's vertices of `mesh`, with the custom normals it had.
    /// Errors: as apply_to.
    void apply_rest_to(Mesh& mesh) const;

    /// All transforms to the identity and `positions()` to the rest shape, to the bit; vertex
    /// constraints go.
    void reset();

    /// Takes `positions()`, the last result, as the new rest shape. Handles keep their vertices and
    /// options, and their transforms become the identity: they hold where they are now. Constraints
    /// stay and hold where their points are now, however far from what was asked. Factors are
    /// rebuilt at the next solve, which gives the same shape to the bit as long as nothing is
    /// moved.
    void rebase();

    /// Deformation gradients M_i of the region's vertices in the last solve or preview, before
    /// shear is taken out; the identity before one. For a comparison method, the M_i by which it
    /// transforms the details (Eq 2.2).
    const std::vector<Mat3>& gradients();
    /// Computes the basis if needed. Errors: as prepare; unsupported for a comparison method.
    HandleBasis basis() { return basis(context()); }
    HandleBasis basis(const Context& context);
    DeformStats stats() const;
    /// Measures the result that is shown beside the rest shape, both as they lie in `mesh`. Errors:
    /// as apply_to; cancelled.
    DeformReport report(const Mesh& mesh, const DeformReportOptions& options = {}) const {
        return report(mesh, options, context());
    }
    DeformReport report(const Mesh& mesh, const DeformReportOptions& options,
                        const Context& context) const;

  private:
    struct State;
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
