/// The state behind a Deformer; private to kernel/deform.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "kernel/deform/comparison/method.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/operators.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/rotation/rest_directions.h"
#include "kernel/deform/system/frame_blocks.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/deform/system/linear_solution.h"
#include "kernel/deform/system/rotation_system.h"

namespace lissom {

/// Rings around the region that the stencils of its vertices reach.
inline constexpr Index kPatchRings = 1;

/// Vertices whose gradient is prescribed together: those of a handle, one with a constraint, or all
/// that are pinned.
struct GradientSource {
    Index owner = kPinned;
    Index vertex = kNoIndex;
};

/// Everything that depends on which vertices are held, but not on where they go.
struct Prepared {
    std::shared_ptr<const WorkingPatch> work;
    std::vector<Index> owner;
    /// The local vertices of each handle, with those that a refinement inserted between them.
    std::vector<std::vector<Index>> held;
    KnownMask known;
    /// Local vertices and anchors that take what a point constraint asks, with its number.
    std::vector<std::pair<Index, Index>> asked;
    GradientStencils gradients;
    std::unique_ptr<GradientSystem> first;
    std::unique_ptr<RotationSystem> second;
    std::unique_ptr<LinearSolution> solution;
    /// In place of the three above, for a comparison method; the source of each local vertex's
    /// gradient, or kNoIndex, and the sources.
    std::unique_ptr<ComparisonMethod> comparison;
    std::vector<Index> source;
    std::vector<GradientSource> sources;
    /// Row among the positions of a frame of each row of the solution, or kNoIndex for virtual
    /// vertices.
    std::vector<Index> frame_row;
    /// Vertices of the region and of a refinement without a known gradient: those with a stencil,
    /// and those without, which take the mean of their neighbours.
    std::vector<Index> gathered, averaged;
    /// How the second system answers to translations of handles; found at the first turn beyond
    /// what the first system can follow.
    Eigen::MatrixXd handle_stiffness;
    std::vector<std::vector<double>> turn_weights;
    /// Rows of the region whose vertices have no faces and nothing that holds them.
    std::vector<Index> resting_rows;

    GradientLoop gradient_loop() const {
        return {work->rings.begin.data(), work->rings.neighbor.data(), gradients.self.data(),
                gradients.neighbor.data()};
    }
};

/// The first system at a fraction of the turns that are asked for.
struct TurnPart {
    double fraction = 1.0;
    /// Where local vertices then lie, relative to where the base takes them.
    std::vector<Vec4> deviation;
    /// What the handles' translations and the vertex constraints add that the turns do not.
    std::vector<Vec4> remainder;
};

struct ShownResult {
    std::vector<Vec3> positions, inserted;
    std::shared_ptr<const WorkingPatch> patch;
    std::vector<Affine> transforms;
    std::vector<Mat3> gradients;
};

struct HandlePoses {
    std::vector<HandleState> handles;
    /// Of the patch, which a new rest shape moves.
    Vec3 origin;
};

struct Deformer::State {
    State(const Mesh& mesh, const Region& given, const DeformOptions& chosen,
          const Context& given_context);

    HandleState& handle(HandleId id);
    Index local_vertex(Index mesh_vertex) const;
    std::vector<Mat3> turns_without_faces() const;
    void require_surroundings(const Mesh& mesh) const;
    bool at_rest() const;

    void number_rows();
    void rebase();
    /// To be called before what is held changes: the last result stays until the next solve.
    void drop_prepared();
    SparseRow local_row(const MeshPoint& point) const;
    Vec3 rest_position(const SparseRow& row) const;
    void require_inside(const MeshPoint& point) const;
    void require_unheld(const std::vector<Index>& vertices,
                        std::span<const Index> except = {}) const;
    void require_handle_region(const Region& vertices, std::span<const Index> except = {}) const;
    Vec3 center_of(const HandleState& handle) const;
    HandleId add(HandleState handle);
    std::vector<Index> counterparts_of(const std::vector<Index>& local,
                                       const MirrorPlane& plane) const;
    HandleState mirrored(Index number, const HandleState& handle, const MirrorPlane& plane) const;
    void reflect(const HandleState& handle, const MirrorPlane& plane, HandleState& image) const;
    void set_constraint(const SparseRow& row, PointConstraint asked_now);
    std::optional<PointConstraint> take_constraint(const SparseRow& row);

    // Transforms and positions below are relative to the patch's origin.
    void place(HandleState& handle, const Affine& transform, const Vec3& about) const;
    Vec3 held_position(const HandleState& handle, Index v) const;
    Mat4 base_transform() const;
    std::vector<Mat4> differences() const;
    Vec3 known_position(Index v) const;
    Vec3 known_deviation(Index v) const;
    Mat3 known_gradient(Index v) const;

    Holds holds() const {
        return {handles, constraints, points, vertex_stiffness, options.transition};
    }
    void collect_asked();
    LinearProblem problem() const;
    void prepare(const Context& context);
    std::shared_ptr<const WorkingPatch> working_patch() const;
    void collect_held(Prepared& next) const;
    Index frame_row(const Patch& patch, Index v) const;
    std::unique_ptr<Prepared> factored(const Context& context);
    template <typename System>
    void factor(System& system, const Context& context) const;
    void count_costs(const Prepared& next);
    void require_area() const;
    Vec3 start_of_sequence() const;
    [[noreturn]] void refuse_singular(const Error& error, const std::vector<Index>& free) const;

    // Of comparison methods.
    void require_plain_holds() const;
    void find_sources(Prepared& next) const;
    void prepare_comparison(Prepared& next, const Context& context);
    Affine comparison_base() const;
    std::vector<SourceMotion> source_motions() const;
    void solve_comparison(const Context& context);

    void evaluate_deviation(const Context& context);
    Mat3 gradient_of(Index v, const TurnPart* part = nullptr) const;
    void find_gradients();
    Mat3 rotation_of(const Mat3& gradient) const;
    void preview(const Context& context);
    void find_turns(const Mat3& base_rotation, double greatest, const Context& context);
    void turn_held(const Mat3& base_rotation);
    std::vector<Vec4> relative_turns() const;
    double greatest_turn() const;
    static double turn_fraction(double greatest);
    TurnPart part_of_turns(double fraction, const Context& context) const;
    std::vector<Vec4> spread_moves(std::span<const Mat4> differences, const Context& context) const;
    void turn_on(const TurnPart& part, std::span<const Index> vertices,
                 std::span<Mat3> gradient) const;
    static double winding_share(double greatest);
    static double far_share(double greatest);
    std::vector<Vec4> spread(const std::vector<Vec4>& value) const;
    std::vector<Vec4> mean_of_turns(const std::vector<Vec4>& value) const;
    std::vector<Index> movable_handles() const;
    void find_responses(const Context& context);
    std::vector<Vec4> mismatches(std::span<const Vec4> x, const Context& context);
    void add_constraint_moves(std::vector<Vec4>& field) const;
    void wind_turns(const Mat3& base_rotation, double share, bool draft, const Context& context);
    void take_mean_turns(const Mat3& base_rotation, const Context& context);
    void bend_turns(std::span<const Index> vertices, std::span<Mat3> gradient,
                    const Mat3& base_rotation);
    void blend_turns(std::span<const Index> vertices, std::span<const PaddedMat3> before,
                     double share, const Mat3& base_rotation);
    std::vector<Vec4> size_changes() const;
    void refine_turns(const Mat3& base_rotation, double further, const Context& context);
    void solve_second(bool draft, const Context& context);
    void solve(bool draft, const Context& context);
    std::vector<Vec3> pulled_back(const std::vector<Vec3>& from) const;
    void take_inserted();
    void show_next();
    void to_rest();

    Region region;
    DeformOptions options;
    /// Of operations that are given none.
    Context own_context;
    /// The region as the mesh has it.
    std::shared_ptr<const WorkingPatch> rest_patch;
    /// Row in the region of each local vertex of the rest patch, or kNoIndex.
    std::vector<Index> region_row;
    std::vector<Vec3> rest;
    /// Greatest distance of a vertex of the region from the origin of the patch.
    double size = 0.0;
    /// Whether coordinates of the mesh have fewer digits for its shape than `in_patch` of handles.
    bool far_away = false;
    RestDirections directions;
    /// Vertices around the region and where they lie.
    std::vector<std::pair<Index, Vec3>> surroundings;

    std::vector<HandleState> handles;
    /// Hard constraints of vertices.
    VertexConstraints constraints;
    /// Constraints of points and soft ones, in the order of their rows.
    std::vector<PointState> points;
    /// Of every real local vertex; empty where all are 1.
    std::vector<double> vertex_stiffness;
    /// What is asked of every local vertex and anchor that a constraint owns.
    VertexConstraints asked;

    /// Null where the set of held vertices has changed; `fixed_current` is false where the value of
    /// a vertex constraint has.
    std::unique_ptr<Prepared> prepared;
    bool fixed_current = false;

    /// Where local vertices lie in the present frame, degenerate ones displaced, relative to where
    /// the base takes their rest position: its transform in the first system, the similarity
    /// nearest to it in the second.
    std::vector<Vec4> deviation;
    Mat4 frame_base = Mat4::Zero();
    /// S_i less that of the base, for the second system. Outside the region they stay zero, as then
    /// the base is the identity.
    std::vector<PaddedMat3> turns;
    /// Scratch of the refinement: positions less the translation of the base.
    std::vector<Vec4> absolute;
    /// What is shown: the positions of the last frame, the transforms of handles in it, and its
    /// gradients where they are current. Before anything that the preparation rests on changes,
    /// they are brought up to date. `next_positions` holds the positions of a frame that is not
    /// done: those of the region, then those of vertices that a refinement inserted.
    std::vector<Vec3> positions, next_positions;
    /// Inserted vertices as they are shown and the patch they belong to; null at rest.
    std::vector<Vec3> inserted;
    std::shared_ptr<const WorkingPatch> shown_patch;
    std::vector<Affine> shown;
    std::vector<Mat3> gradients;
    bool gradients_current = true;
    DeformStats stats;
};

}  // namespace lissom
