// Every refusal has a code, names what it is about, and leaves the deformer as it was.

#include <cmath>
#include <limits>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_scene() {
    BarOptions options;
    options.across = 3;
    options.along = 12;
    return make_scene(make_bar(options));
}

}  // namespace

TEST_CASE("region: empty, or of another mesh") {
    const Scene scene = bar_scene(), other = bar_scene();
    CHECK(error_of([&] { Deformer(scene.mesh, scene.region({})); }).code() ==
          ErrorCode::region_empty);
    CHECK(error_of([&] { Deformer(scene.mesh, other.all()); }).code() ==
          ErrorCode::topology_mismatch);
    Edit edit = make_edit(scene);
    CHECK(error_of([&] { edit.deformer.add_handle(other.region({5})); }).code() ==
          ErrorCode::topology_mismatch);
    Mesh apart = other.mesh;
    CHECK(error_of([&] { edit.deformer.apply_to(apart); }).code() == ErrorCode::topology_mismatch);
}

TEST_CASE("handles: outside the region, overlapping, empty, without purpose, removed") {
    const Scene scene = bar_scene();
    Deformer d(scene.mesh, scene.region(scene.high));
    const Error outside = error_of([&] { d.add_handle(scene.region(scene.low)); });
    CHECK(outside.code() == ErrorCode::handle_outside_region);
    CHECK(outside.elements().ids == scene.low);

    const Index first = scene.high[0], second = scene.high[1], third = scene.high[2];
    const HandleId handle = d.add_handle(scene.region({first, second}));
    const Error overlap = error_of([&] { d.add_handle(scene.region({second, third})); });
    CHECK(overlap.code() == ErrorCode::handle_overlap);
    CHECK(overlap.elements().ids == std::vector<Index>{second});

    CHECK(error_of([&] { d.add_handle(scene.region({})); }).code() == ErrorCode::region_empty);
    CHECK(error_of([&] {
              d.add_handle(scene.region({third}), {false, false});
          }).code() == ErrorCode::invalid_argument);
    CHECK(d.handles().size() == 1);

    d.remove_handle(handle);
    CHECK(error_of([&] { d.set_transform(handle, {}); }).code() == ErrorCode::handle_removed);
    CHECK(error_of([&] { d.remove_handle(handle); }).code() == ErrorCode::handle_removed);
    CHECK(error_of([&] { d.set_transform({77}, {}); }).code() == ErrorCode::handle_removed);
    CHECK(error_of([&] { d.set_transform({-1}, {}); }).code() == ErrorCode::handle_removed);
    d.add_handle(scene.region({second, third}));
}

TEST_CASE("transforms: singular or not finite, and then the old one stays") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    const Affine good = rotation(Vec3::UnitX(), 0.4, Vec3::Zero());
    edit.deformer.set_transform(edit.high, good);
    Affine nan = good;
    nan.translation.x() = std::nan("");
    for (const Affine& bad :
         {scaling({1, 0, 1}, Vec3::Zero()), scaling({0, 0, 0}, Vec3::Zero()), nan}) {
        CHECK(error_of([&] { edit.deformer.set_transform(edit.high, bad); }).code() ==
              ErrorCode::singular_transform);
        CHECK(edit.deformer.pose(edit.high).transform == good);
    }
    edit.deformer.set_transform(edit.high, scaling({1e-9, 1e-9, 1e-9}, Vec3::Zero()));
    edit.deformer.set_transform(edit.high, scaling({-1, 1, 1}, Vec3::Zero()));
}

TEST_CASE("constraints: none, or too few, name the part that nothing holds") {
    const Scene scene = bar_scene();
    Deformer none(scene.mesh, scene.all());
    const Error free = error_of([&] { none.solve(); });
    CHECK(free.code() == ErrorCode::unconstrained);
    CHECK(free.elements().kind == ElementKind::vertex);
    CHECK(free.elements().count == static_cast<std::size_t>(scene.mesh.vertex_count()));
    CHECK(none.positions() == rest_positions_of(none));

    Deformer gradients(scene.mesh, scene.all());
    gradients.add_handle(scene.region(scene.low), {false, true});
    CHECK(error_of([&] { gradients.solve(); }).code() == ErrorCode::unconstrained);

    Deformer plane(scene.mesh, scene.all());
    std::vector<Index> end;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (scene.mesh.position(v).y() < -2.4999) end.push_back(v);
    }
    plane.add_handle(scene.region(end), {true, false});
    CHECK(error_of([&] { plane.solve(); }).code() == ErrorCode::unconstrained);
    plane.add_handle(scene.region({scene.high.back()}), {true, false});
    CHECK(plane.solve() == rest_positions_of(plane));
}

TEST_CASE("vertex constraints: outside, held by a handle, not finite, out of range") {
    const Scene scene = bar_scene();
    Deformer d(scene.mesh, scene.region(scene.high));
    d.add_handle(scene.region({scene.high[0]}));
    const Vec3 p(1, 2, 3), bad(std::numeric_limits<double>::infinity(), 0, 0);
    CHECK(error_of([&] {
              d.constrain(VertexConstraint{-4, p, {}});
          }).code() == ErrorCode::out_of_range);
    CHECK(error_of([&] {
              d.constrain(VertexConstraint{100000, p, {}});
          }).code() == ErrorCode::out_of_range);
    CHECK(error_of([&] {
              d.constrain(VertexConstraint{scene.low[0], p, {}});
          }).code() == ErrorCode::handle_outside_region);
    CHECK(error_of([&] {
              d.constrain(VertexConstraint{scene.high[0], p, {}});
          }).code() == ErrorCode::handle_overlap);
    CHECK(error_of([&] {
              d.constrain(VertexConstraint{scene.high[1], bad, {}});
          }).code() == ErrorCode::not_finite);
    d.constrain(VertexConstraint{scene.high[1], p, {}});
    CHECK(error_of([&] { d.add_handle(scene.region({scene.high[1]})); }).code() ==
          ErrorCode::handle_overlap);
}

TEST_CASE("options out of range are refused") {
    const Scene scene = bar_scene();
    const auto code = [&](auto change) {
        DeformOptions options;
        change(options);
        return error_of([&] { Deformer(scene.mesh, scene.all(), options); }).code();
    };
    CHECK(code([](DeformOptions& o) { o.coherence = 0; }) == ErrorCode::invalid_argument);
    CHECK(code([](DeformOptions& o) { o.coherence = 3; }) == ErrorCode::invalid_argument);
    CHECK(code([](DeformOptions& o) { o.displacement = 0.0; }) == ErrorCode::invalid_argument);
    CHECK(code([](DeformOptions& o) { o.degenerate_threshold = 0.5; }) ==
          ErrorCode::invalid_argument);
    CHECK(code([](DeformOptions& o) { o.coherence_weight = -1.0; }) == ErrorCode::invalid_argument);
}

TEST_CASE("zero area: a vertex without any is named, a single collapsed face is borne") {
    Mesh mesh = make_bar({1.0, 4.0, 3, 12});
    const Region all = Region::all(mesh.shared_topology());
    const auto handles = [&](Deformer& d) {
        const Scene scene = make_scene(mesh, 0.1);
        d.add_handle(scene.region(scene.low));
        return d.add_handle(scene.region(scene.high));
    };
    // One edge in the middle of the bar has no length.
    const Index v = mesh.vertex_count() / 2, n = mesh.topology().neighbors(v)[0];
    Mesh collapsed = mesh;
    collapsed.set_position(v, collapsed.position(n));
    Deformer d(collapsed, all);
    const HandleId high = handles(d);
    d.set_transform(high, translation({0.2, 0, 0}));
    d.solve();
    CHECK(stats_of(d).zero_area_faces > 0);
    for (const Vec3& p : d.positions()) CHECK(p.allFinite());
    CHECK(max_distance(d.positions(), rest_positions_of(d)) < 0.3);

    // All faces around one vertex are on a line.
    Mesh flat = mesh;
    for (const Index f : mesh.topology().faces_around(v)) {
        for (const Index u : mesh.topology().face(f)) flat.set_position(u, {0, 0, 0.1 * u});
    }
    Deformer broken(flat, all);
    handles(broken);
    const Error error = error_of([&] { broken.solve(); });
    CHECK(error.code() == ErrorCode::zero_area);
    CHECK(error.elements().ids.front() == v);
}

TEST_CASE("cancel and memory limit: the deformer goes on afterwards") {
    const Scene scene = bar_scene();
    Edit edit = make_edit(scene);
    edit.deformer.set_transform(edit.high, translation({1, 0, 0}));
    const Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { edit.deformer.solve(FrameQuality::full, cancelled); }).code() ==
          ErrorCode::cancelled);
    ContextOptions options;
    options.memory_limit = 1000;
    const Context tight(options);
    CHECK(error_of([&] { edit.deformer.solve(FrameQuality::full, tight); }).code() ==
          ErrorCode::memory_limit);
    CHECK(edit.deformer.positions() == rest_positions_of(edit.deformer));
    CHECK(edit.deformer.solve()[scene.high[0]] ==
          scene.mesh.position(scene.high[0]) + Vec3(1, 0, 0));
}

TEST_CASE("cancel at every checkpoint: an error or the full result, never half of it") {
    const Scene scene = bar_scene();
    Edit oracle = make_edit(scene);
    const Affine move = bend(scene, oracle.deformer.handle(oracle.high).center);
    oracle.deformer.set_transform(oracle.high, move);
    const std::vector<Vec3> expected = oracle.deformer.solve();
    int interrupted = 0;
    for (int stop = 0; stop < 20; ++stop) {
        int reports = 0;
        Context* running = nullptr;
        ContextOptions options;
        options.progress = [&](std::string_view, double) {
            if (reports++ == stop) running->cancel();
        };
        Context context(options);
        running = &context;
        Edit edit = make_edit(scene);
        edit.deformer.set_transform(edit.high, move);
        try {
            const std::vector<Vec3> result = edit.deformer.solve(FrameQuality::full, context);
            CHECK(result == expected);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
            CHECK(edit.deformer.positions() == rest_positions_of(edit.deformer));
            CHECK(edit.deformer.solve() == expected);
            ++interrupted;
        }
    }
    CHECK(interrupted >= 3);
}
