#include "kernel/mesh/query/self_intersections.h"

#include <numeric>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Mesh triangles(std::vector<Vec3> positions) {
    FaceList faces;
    for (Index v = 0; v + 2 < static_cast<Index>(positions.size()); v += 3) {
        faces.add({v, v + 1, v + 2});
    }
    return {std::move(positions), std::move(faces)};
}

// Two spheres; the second is moved by `offset`.
Mesh two_spheres(const Vec3& offset, Index segments = 8) {
    Mesh mesh = make_sphere({.segments = segments});
    Mesh other = mesh;
    transform(other, translation(offset));
    append(mesh, other);
    return mesh;
}

std::vector<Index> range(Index begin, Index end) {
    std::vector<Index> all(static_cast<std::size_t>(end - begin));
    std::iota(all.begin(), all.end(), begin);
    return all;
}

// Every pair tested, without a hierarchy.
std::vector<FacePair> by_force(const Mesh& mesh) {
    std::vector<FacePair> pairs;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto more = self_intersections(
            mesh, {.faces = range(f, f + 1), .against = range(f + 1, mesh.face_count())});
        pairs.insert(pairs.end(), more.begin(), more.end());
    }
    return pairs;
}

}  // namespace

TEST_CASE("self-intersections: none on shapes whose faces only meet their neighbours") {
    CHECK(self_intersections(make_sphere()).empty());
    CHECK(self_intersections(make_torus()).empty());
    CHECK(self_intersections(make_cactus()).empty());
    CHECK(self_intersections(make_box({.segments = {3, 4, 5}})).empty());
    CHECK(self_intersections(make_grid()).empty());
    CHECK(self_intersections(Mesh()).empty());
}

TEST_CASE("self-intersections: a triangle through another, on it, beside it and touching it") {
    const std::vector<Vec3> base{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto with = [&](Vec3 a, Vec3 b, Vec3 c) {
        std::vector<Vec3> all = base;
        all.insert(all.end(), {a, b, c});
        return self_intersections(triangles(std::move(all))).size();
    };
    CHECK(with({.2, .2, -1}, {.3, .2, 1}, {.2, .3, 1}) == 1);
    CHECK(with({.2, .2, 0}, {.3, .2, 0}, {.2, .3, 0}) == 1);  // inside, in one plane
    CHECK(with({.2, .2, 1e-3}, {.3, .2, 1e-3}, {.2, .3, 1e-3}) == 0);
    CHECK(with({.2, .2, 0}, {.3, .2, 1}, {.2, .3, 1}) == 1);  // a corner touches
    CHECK(with({2, 2, -1}, {2.1, 2, 1}, {2, 2.1, 1}) == 0);
    CHECK(with({-1, .2, 0}, {2, .2, 0}, {-1, .3, 0}) == 1);  // crosses in the plane
    CHECK(with({1, 0, 0}, {0, 0, 0}, {0, -1, 0}) == 0);      // an open seam
    CHECK(with({1, 0, 0}, {0, 0, 0}, {.2, .5, 0}) == 1);     // folded upon it
    CHECK(with({0, 0, 0}, {.5, .5, 1}, {.5, .5, -1}) == 1);  // common corner, runs through
    CHECK(with({0, 0, 0}, {-.5, .5, 1}, {-.5, .5, -1}) == 0);
}

TEST_CASE("self-intersections: as many as by force, in any frame, at any scale and by threads") {
    const Mesh mesh = two_spheres({0.9, 0.4, 0.3});
    const std::vector<FacePair> pairs = self_intersections(mesh);
    CHECK(pairs.size() > 20);
    CHECK(pairs == by_force(mesh));
    for (const double scale : {1e-6, 1.0, 1e6}) {
        Mesh moved = mesh;
        transform(moved, rotation(Vec3(1, 2, 3), 1.0, Vec3::Zero()) *
                             scaling(Vec3::Constant(scale), Vec3::Zero()));
        CHECK(self_intersections(moved) == pairs);
    }
    ContextOptions threads;
    threads.threads = 2;
    CHECK(self_intersections(mesh, {}, Context(threads)) == pairs);
}

TEST_CASE("self-intersections: restricted to some faces against others") {
    const Mesh mesh = two_spheres({0.9, 0.4, 0.3});
    const Index half = mesh.face_count() / 2;
    const auto first = range(0, half), second = range(half, mesh.face_count());
    const std::vector<FacePair> all = self_intersections(mesh);
    CHECK(self_intersections(mesh, {.faces = first, .against = second}) == all);
    CHECK(self_intersections(mesh, {.faces = second, .against = first}) == all);
    CHECK(self_intersections(mesh, {.faces = first, .against = first}).empty());
    CHECK(self_intersections(mesh, {.faces = range(all[0].first, all[0].first + 1)}).size() > 0);
    CHECK(error_of([&] { self_intersections(mesh, {.faces = range(-1, 1)}); }).code() ==
          ErrorCode::out_of_range);
    CHECK(error_of([&] { self_intersections(mesh, {.tolerance = 2.0}); }).code() ==
          ErrorCode::invalid_argument);
}
