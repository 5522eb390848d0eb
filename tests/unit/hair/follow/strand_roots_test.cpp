#include "kernel/hair/follow/strand_roots.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strand_edit.h"
#include "tests/unit/hair/hair_support.h"

namespace lissom::test {
namespace {

// A bent quad and a triangle beside it.
Mesh bent_quad() {
    FaceList faces;
    faces.add({0, 1, 2, 3});
    faces.add({1, 4, 2});
    return {{{0, 0, 0}, {1, 0, 0.4}, {1, 1, 0}, {0, 1, 0.4}, {2, 0.5, 0}}, std::move(faces)};
}

Root root_at(const Mesh& mesh, Index face, const Triangle& triangle, const Vec3& weights) {
    Root root;
    root.face = face;
    root.triangle = triangle;
    root.barycentric = weights;
    for (int c = 0; c < 3; ++c) root.position += weights[c] * mesh.position(triangle[at(c)]);
    return root;
}

TEST_CASE("strand roots: places on every triangle of a polygon are exact and inside it") {
    const Mesh head = bent_quad();
    const std::vector<Root> roots = {root_at(head, 0, {0, 1, 3}, {0.2, 0.3, 0.5}),
                                     root_at(head, 0, {1, 2, 3}, {0.1, 0.8, 0.1}),
                                     root_at(head, 1, {1, 4, 2}, {0.25, 0.25, 0.5})};
    const StrandRoots placed = roots_on(head, roots);
    for (Index s = 0; s < 3; ++s) {
        CHECK((*root_place(placed, s, head) - roots[at(s)].position).norm() < 1e-6);
        CHECK(placed.barycentrics[at(s)].minCoeff() >= 0.0f);
    }
}

// A prism with a top of these corners; its walls are quads.
Mesh prism(const std::vector<Vec2>& outline) {
    const Index n = count_of(outline);
    std::vector<Vec3> points;
    for (const double y : {0.0, 0.1}) {
        for (const Vec2& p : outline) points.emplace_back(p.x(), y + 0.02 * p.y(), -p.y());
    }
    FaceList faces;
    std::vector<Index> top, bottom;
    for (Index i = 0; i < n; ++i) {
        top.push_back(n + i);
        bottom.push_back(n - 1 - i);
        faces.add({i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
    faces.add(top);
    faces.add(bottom);
    return {points, std::move(faces)};
}

TEST_CASE("strand roots: those grown on quads, pentagons and concave faces lie in their triangle") {
    const std::vector<std::vector<Vec2>> outlines = {
        {{-0.08, -0.08}, {0.08, -0.06}, {0.07, 0.08}, {-0.08, 0.07}},
        {{-0.08, -0.08}, {0.08, -0.08}, {0.1, 0.02}, {0.0, 0.1}, {-0.1, 0.02}},
        {{-0.08, -0.08}, {0.0, -0.02}, {0.08, -0.08}, {0.08, 0.08}, {-0.08, 0.08}}};
    for (const std::vector<Vec2>& outline : outlines) {
        const Mesh head = prism(outline);
        ScalpOptions options;
        options.hints = {Vec3::UnitY(), Vec3::UnitZ()};
        options.region = Region::all(head.shared_topology());
        options.unit = 1.0;
        const Scalp scalp(head, options);
        const std::vector<Root> roots = make_roots(head, scalp, {.count = 400});
        const StrandRoots placed = roots_on(head, roots);
        REQUIRE(placed.triangles.size() == roots.size());
        for (Index s = 0; s < count_of(roots); ++s) {
            const auto face = head.topology().face(placed.faces[at(s)]);
            for (const Index v : placed.triangles[at(s)]) {
                CHECK(std::find(face.begin(), face.end(), v) != face.end());
            }
            CHECK(placed.barycentrics[at(s)].minCoeff() >= 0.0f);
            CHECK(std::abs(placed.barycentrics[at(s)].sum() - 1.0f) < 1e-6f);
            CHECK((*root_place(placed, s, head) - roots[at(s)].position).norm() < 1e-7);
        }
    }
}

TEST_CASE("strand roots: those on triangles need no list of triangles") {
    const Mesh head = bent_quad();
    // In another order than that of the face.
    const std::vector<Root> roots = {root_at(head, 1, {4, 2, 1}, {0.2, 0.3, 0.5})};
    const StrandRoots placed = roots_on(head, roots);
    CHECK(placed.triangles.empty());
    CHECK((*root_place(placed, 0, head) - roots[0].position).norm() < 1e-6);
}

TEST_CASE("strand roots: roots without a face, and of other meshes, have no place") {
    const Mesh head = bent_quad();
    StrandRoots placed = roots_on(head, std::vector<Root>(1));
    CHECK(!root_place(placed, 0, head));
    placed.faces[0] = 7;
    CHECK(!root_place(placed, 0, head));
    placed.faces[0] = 0;
    placed.triangles = {{0, 1, 99}};
    CHECK(!root_place(placed, 0, head));
    CHECK(!root_place({}, 0, head));
}

TEST_CASE("strand roots: triangles go with their strands") {
    const Mesh head = bent_quad();
    const std::vector<Root> roots = {root_at(head, 0, {0, 1, 3}, {0.2, 0.3, 0.5}),
                                     root_at(head, 0, {1, 2, 3}, {0.1, 0.8, 0.1})};
    Strands hair({0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1}, {0, 2, 4});
    hair.set_roots(roots_on(head, roots));
    const Strands second = select(hair, std::vector<Index>{1});
    CHECK(second.roots().triangles == std::vector<Triangle>{{1, 2, 3}});
    Strands both({0, 0, 0, 0, 0, 1}, {0, 2});
    append(both, second);
    CHECK(!root_place(both.roots(), 0, head));
    CHECK((*root_place(both.roots(), 1, head) - roots[1].position).norm() < 1e-6);
}

}  // namespace
}  // namespace lissom::test
