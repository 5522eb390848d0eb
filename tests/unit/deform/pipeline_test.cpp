// The values of a deformation: what was asked is put back by assigning it, and frames are values.
#include "kernel/deform/pipeline.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/stats.h"

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

struct Seen {
    std::vector<Vec3> solved, previewed;
    std::vector<Vec3> turns;
    std::vector<HandleId> handles;

    explicit Seen(Deformer& d) : previewed(d.solve(FrameQuality::preview)), handles(d.handles()) {
        solved = d.solve();
        for (const HandleId h : handles) turns.push_back(d.pose(h).turn);
    }
    bool operator==(const Seen&) const = default;
};

}  // namespace

TEST_CASE("a frame is written and taken as rest shape as a Deformer does it") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit edit = make_edit(scene);
    const Affine move = bend(scene, edit.deformer.handle(edit.high).center);
    const auto prepared = edit.deformer.prepare();
    Poses poses = edit.deformer.snapshot().poses;
    pose_handle(*prepared, poses, edit.high, move);
    FrameScratch scratch;
    const DeformFrame frame = solve_frame(prepared, poses, scratch);
    CHECK(edit.deformer.positions() == rest_positions_of(edit.deformer));
    edit.deformer.set_transform(edit.high, move);
    CHECK(edit.deformer.solve() == frame.positions);
    Mesh a = scene.mesh, b = scene.mesh;
    write_frame(*rest_of(*prepared), frame, a);
    edit.deformer.apply_to(b);
    CHECK(hash(a) == hash(b));
    CHECK(rest_frame(*rebased(*rest_of(*prepared), frame)).positions == frame.positions);
    CHECK(error_of([&] { pose_handle(*prepared, poses, {7}, move); }).code() ==
          ErrorCode::handle_removed);
}

TEST_CASE("poses and frames of other holds or another region are refused") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    const Affine move = translation({0.5, 0, 0});
    d.set_transform(edit.low, move);
    const Poses before = d.snapshot().poses;
    const HandleId third = d.add_handle(scene.region({scene.between(0)}));
    const auto of_third = d.prepare();
    const Poses three = d.snapshot().poses;
    d.constrain(VertexConstraint{scene.between(9), Vec3(1, 0, 0), {}, {}});
    const auto prepared = d.prepare();
    FrameScratch scratch;
    const auto refused = [&](const std::shared_ptr<const Preparation>& by, const Poses& poses) {
        CHECK(error_of([&] { (void)solve_frame(by, poses, scratch); }).code() ==
              ErrorCode::invalid_argument);
        const Error error = error_of([&] { (void)preview_frame(by, poses, scratch); });
        CHECK(error.code() == ErrorCode::invalid_argument);
        return error.message();
    };
    CHECK(refused(of_third, before).find("2 handles, but the preparation has 3") !=
          std::string::npos);
    CHECK(refused(prepared, three).find("0 targets, but the preparation has 1") !=
          std::string::npos);
    (void)refused(prepared, {});
    (void)refused(of_third, d.snapshot().poses);
    (void)refused(nullptr, before);
    Poses changed = before;
    CHECK(error_of([&] { pose_handle(*of_third, changed, third, move); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(changed == before);
    CHECK(solve_frame(of_third, three, scratch).positions.size() == d.positions().size());

    Mesh mesh = scene.mesh;
    const std::uint64_t untouched = hash(mesh);
    const RestShape& rest = *rest_of(*prepared);
    const Scene other = make_scene(make_bar({1.0, 5.0, 4, 10}));
    Edit of_other = make_edit(other);
    for (const DeformFrame& frame :
         {DeformFrame(), rest_frame(*rest_of(*of_other.deformer.prepare()))}) {
        CHECK(error_of([&] { write_frame(rest, frame, mesh); }).code() ==
              ErrorCode::invalid_argument);
        CHECK(error_of([&] { (void)rebased(rest, frame); }).code() == ErrorCode::invalid_argument);
    }
    CHECK(hash(mesh) == untouched);
    CHECK(error_of([&] { (void)frame_gradients({}, scratch); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(error_of([&] { (void)prepare_deformation(rest_of(*prepared), nullptr); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("undo: what was asked is put back to the bit, whatever was asked in between") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    const Index middle = scene.between(0);
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    const auto full_turn = [&](double angle) {
        d.set_transform(edit.high, rotation(Vec3(0.1, 1, 0).normalized(), angle, Vec3(0, 2, 0)));
    };
    std::vector<std::pair<DeformSnapshot, Seen>> history;
    const auto step = [&](const auto& change) {
        history.emplace_back(d.snapshot(), Seen(d));
        change();
    };
    step([&] {
        for (double t = 0.5; t < 7.0; t += 0.5) full_turn(t);
    });
    step([&] { full_turn(0.0); });
    step([&] { d.add_handle(scene.region({middle, scene.between(1)})); });
    step([&] { d.set_transform(d.handles().back(), translation({0.3, 0, 0.1})); });
    step([&] { d.constrain(VertexConstraint{scene.between(9), Vec3(1, 0, 0), {}, {}}); });
    step([&] { d.constrain(VertexConstraint{scene.between(9), Vec3(1, 0.5, 0), {}, {}}); });
    step([&] { set_stiffness(d, scene.region({scene.between(5), scene.between(6)}), 20.0); });
    step([&] { set_handle_region(d, edit.low, scene.region({scene.low.front(), scene.low[1]})); });
    step([&] { d.rebase(); });
    step([&] { full_turn(3.0); });
    step([&] { d.remove_handle(edit.low); });
    step([&] { d.reset(); });
    for (; !history.empty(); history.pop_back()) {
        CAPTURE(history.size());
        d.restore(history.back().first);
        CHECK(d.positions() == history.back().first.shown->positions);
        CHECK(Seen(d) == history.back().second);
    }
    Edit other = make_edit(scene);
    CHECK(error_of([&] { d.restore(other.deformer.snapshot()); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(error_of([&] { d.restore(DeformSnapshot()); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("undo: a handle that is added and taken back costs no factorisation") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, bend(scene, d.handle(edit.high).center));
    const std::vector<Vec3> before = d.solve();
    const DeformSnapshot snapshot = d.snapshot();
    d.add_handle(scene.region({scene.between(0)}));
    d.restore(snapshot);
    CHECK(d.solve() == before);
    CHECK(stats_of(d).factorizations == 1);
}

TEST_CASE(
    "a full frame after a draft is that without, to the bit, whatever else was asked between") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    for (const int refine : {0, 1}) {
        for (const double angle : {0.8, 2.5, 3.6, 5.0}) {
            CAPTURE(refine);
            CAPTURE(angle);
            DeformOptions options;
            options.refine = refine;
            Edit edit = make_edit(scene, options);
            const Vec3 turn = angle * scene.across;
            const Affine move = rotation(scene.across, angle, Vec3::Zero());
            const auto prepared = edit.deformer.prepare();
            Poses poses = edit.deformer.snapshot().poses, other = poses;
            const Vec3 center = edit.deformer.handle(edit.high).center;
            pose_handle(*prepared, poses, edit.high, move, center, turn);
            pose_handle(*prepared, other, edit.high, translation(scene.across));
            FrameScratch fresh, scratch;
            const auto full = [&](FrameScratch& with) {
                return solve_frame(prepared, poses, with).positions;
            };
            const std::vector<Vec3> expected = full(fresh);
            const auto draft = [&](const Poses& at) {
                return solve_frame(prepared, at, scratch, FrameQuality::draft);
            };
            const DeformFrame drafted = draft(poses);
            CHECK(drafted.positions != expected);
            CHECK(full(scratch) == expected);
            CHECK(full(scratch) == expected);
            (void)draft(poses);
            (void)frame_gradients(drafted, scratch);
            CHECK(full(scratch) == expected);
            (void)draft(poses);
            (void)preview_frame(prepared, other, scratch);
            CHECK(full(scratch) == expected);
            (void)draft(poses);
            (void)draft(other);
            CHECK(full(scratch) == expected);
            const auto again = prepare_deformation(rest_of(*prepared), constraints_of(*prepared));
            (void)draft(poses);
            CHECK(solve_frame(again, poses, scratch).positions == expected);
        }
    }
}
