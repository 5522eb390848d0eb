#include <cmath>

#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {

TEST_CASE("two halves are cut and merged into one closed mesh") {
    const Host host;
    const lissom_mesh ball = host.add(make_sphere({}));
    const lissom_mesh other = host.add(make_sphere({.radius = 2.0}));
    const double origin[] = {0, 0.1, 0}, up[] = {0, 1, 0}, down[] = {0, -1, 0};
    lissom_mesh head{}, rest{}, body{};
    REQUIRE(lissom_cut_by_plane(host, ball, origin, up, nullptr, &head, &rest) == LISSOM_OK);
    CHECK(lissom_mesh_boundary_count(host, head) == 1);
    CHECK(lissom_mesh_boundary_count(host, rest) == 1);
    REQUIRE(lissom_cut_by_plane(host, other, origin, down, nullptr, &body, nullptr) == LISSOM_OK);

    lissom_join join{};
    lissom_merger merger{};
    REQUIRE(lissom_merger_create(host, head, &body, 1, &join, 1, nullptr, &merger) == LISSOM_OK);
    lissom_mesh whole{};
    auto report = lissom_default_merge_report();
    REQUIRE(lissom_merger_solve(host, merger, &whole, &report) == LISSOM_OK);
    CHECK(lissom_mesh_boundary_count(host, whole) == 0);
    CHECK(report.scale == doctest::Approx(2.0).epsilon(0.2));
    CHECK(report.verdict != nullptr);

    lissom_job job{};
    REQUIRE(lissom_merger_begin_solve(host, merger, &job) == LISSOM_OK);
    lissom_mesh again{};
    REQUIRE(lissom_job_finish(host, job, &again.id) == LISSOM_OK);
    CHECK(host.hash(again) == host.hash(whole));

    // Without joins their nearest boundaries meet; lissom_merge does all in one call.
    lissom_mesh once{};
    REQUIRE(lissom_merge(host, head, body, nullptr, 0, nullptr, &once, &report) == LISSOM_OK);
    CHECK(host.hash(once) == host.hash(whole));
    REQUIRE(lissom_merge(host, head, body, &join, 1, nullptr, &once, nullptr) == LISSOM_OK);
    CHECK(host.hash(once) == host.hash(whole));
    CHECK(lissom_merge(host, head, whole, nullptr, 0, nullptr, &once, nullptr) ==
          LISSOM_NOT_A_BOUNDARY);

    const std::size_t objects = lissom_object_count(host);
    join.target_boundary = 1;
    CHECK(lissom_merger_create(host, head, &body, 1, &join, 1, nullptr, &merger) ==
          LISSOM_OUT_OF_RANGE);
    join = {};
    join.target = 3;
    CHECK(lissom_merger_create(host, head, &body, 1, &join, 1, nullptr, &merger) ==
          LISSOM_OUT_OF_RANGE);
    CHECK(lissom_merger_create(host, head, nullptr, 0, &join, 1, nullptr, &merger) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_object_count(host) == objects);
}

TEST_CASE("a bump is pasted where it is placed") {
    Mesh ball = make_sphere({.segments = 24});
    for (Index v = 0; v < ball.vertex_count(); ++v) {
        Vec3 p = ball.position(v);
        if (p.y() > 0) p.y() += 0.8 * std::exp(-12 * (p.x() * p.x() + p.z() * p.z()));
        ball.set_position(v, p);
    }
    const Host host;
    const lissom_mesh source = host.add(ball),
                      target = host.add(make_sphere({.radius = 2.0, .segments = 20}));
    const double center[] = {0, 1.3, 0};
    lissom_region region{};
    REQUIRE(lissom_region_sphere(host, source, center, 0.95, &region) == LISSOM_OK);
    auto placement = lissom_default_placement();
    placement.at[0] = 2.0;
    lissom_paste paste{};
    REQUIRE(lissom_paste_create(host, source, target, region, {0}, {0}, &placement, &paste) ==
            LISSOM_OK);
    REQUIRE(lissom_paste_optimize(host, paste, 20) == LISSOM_OK);
    auto report = lissom_default_merge_report();
    lissom_mesh result{};
    REQUIRE(lissom_paste_merge(host, paste, &result, &report) == LISSOM_OK);
    CHECK(lissom_mesh_boundary_count(host, result) == 0);
    double least[3], greatest[3];
    REQUIRE(lissom_mesh_bounds(host, result, least, greatest) == LISSOM_OK);
    CHECK(greatest[0] > 2.3);
    CHECK(report.scale > 0.5);
    placement.scale = -1.0;
    CHECK(lissom_paste_move(host, paste, &placement) == LISSOM_INVALID_ARGUMENT);
    lissom_mesh same{};
    REQUIRE(lissom_paste_merge(host, paste, &same, nullptr) == LISSOM_OK);
    CHECK(host.hash(same) == host.hash(result));
}

}  // namespace lissom::test
