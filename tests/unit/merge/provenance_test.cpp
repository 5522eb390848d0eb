// Maps of elements: made in two steps they are the products of their matrices of weights.

#include "kernel/merge/provenance.h"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <random>

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// The weight of each old element in each new one.
Eigen::MatrixXd matrix_of(const ElementMap& map, Index old_count) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(map.size(), old_count);
    for (Index i = 0; i < map.size(); ++i) {
        for (const ElementMap::Source& s : map[i]) m(i, s.element) += s.weight;
    }
    return m;
}

ElementMap random_map(Index count, Index old_count, std::mt19937& random) {
    std::uniform_int_distribution<Index> element(0, old_count - 1), sources(1, 4);
    std::uniform_real_distribution<double> weight(0.1, 1.0);
    ElementMap map;
    for (Index i = 0; i < count; ++i) {
        std::vector<ElementMap::Source> blend;
        for (Index k = sources(random); k-- > 0;)
            blend.push_back({element(random), weight(random)});
        map.add_blend(blend);
    }
    return map;
}

MeshMap random_map(const Topology& from, const Topology& to, std::mt19937& random) {
    return {random_map(from.vertex_count(), to.vertex_count(), random),
            random_map(from.corner_count(), to.corner_count(), random),
            random_map(from.face_count(), to.face_count(), random)};
}

struct Counts {
    Index vertices, corners, faces;
};

Counts counts_of(const Topology& t) {
    return {t.vertex_count(), t.corner_count(), t.face_count()};
}

Counts operator+(const Counts& a, const Counts& b) {
    return {a.vertices + b.vertices, a.corners + b.corners, a.faces + b.faces};
}

double difference(const MeshMap& a, const MeshMap& b, const Counts& old) {
    const auto apart = [](const ElementMap& p, const ElementMap& q, Index count) {
        return (matrix_of(p, count) - matrix_of(q, count)).cwiseAbs().maxCoeff();
    };
    return std::max({apart(a.vertices, b.vertices, old.vertices),
                     apart(a.corners, b.corners, old.corners), apart(a.faces, b.faces, old.faces)});
}

}  // namespace

TEST_CASE("provenance maps: a map in two steps is the product of both") {
    std::mt19937 random(1);
    for (int round = 0; round < 50; ++round) {
        const ElementMap outer = random_map(12, 9, random), inner = random_map(9, 7, random);
        const Eigen::MatrixXd both = matrix_of(outer, 9) * matrix_of(inner, 7);
        CHECK((matrix_of(composed(outer, inner), 7) - both).cwiseAbs().maxCoeff() < 1e-14);
    }
}

TEST_CASE("provenance maps: through two meshes behind each other as through the mesh of both") {
    std::mt19937 random(2);
    const Mesh a = make_grid({.segments = {2, 3}}), b = make_sphere({.segments = 4}),
               c = make_grid({.segments = {1, 2}}), d = make_sphere({.segments = 5});
    const Topology &first_origin = a.topology(), &second_origin = b.topology(),
                   &first = c.topology(), &second = d.topology();
    const Counts old = counts_of(first_origin) + counts_of(second_origin);
    const MeshMap to_first = random_map(first, first_origin, random),
                  to_second = random_map(second, second_origin, random);
    const MeshMap behind = appended_map(to_first, to_second, first_origin);
    const Eigen::MatrixXd faces = matrix_of(behind.faces, old.faces),
                          corners = matrix_of(behind.corners, old.corners);
    CHECK((faces.topLeftCorner(first.face_count(), first_origin.face_count()) -
           matrix_of(to_first.faces, first_origin.face_count()))
              .norm() < 1e-14);
    CHECK((corners.bottomRightCorner(second.corner_count(), second_origin.corner_count()) -
           matrix_of(to_second.corners, second_origin.corner_count()))
              .norm() < 1e-13);
    CHECK(faces.sum() == doctest::Approx(faces.rows()));
    for (int round = 0; round < 10; ++round) {
        const Counts between = counts_of(first) + counts_of(second);
        const MeshMap outer{random_map(30, between.vertices, random),
                            random_map(40, between.corners, random),
                            random_map(20, between.faces, random)};
        const MeshMap at_once = composed_of_two(outer, first, &to_first, to_second, first_origin);
        CHECK(difference(at_once, composed(outer, behind), old) < 1e-14);
        // The first as it is.
        const Counts same = counts_of(first) + counts_of(second_origin);
        const MeshMap plain = composed(outer, appended_map(identity_map(first), to_second, first));
        CHECK(difference(composed_of_two(outer, first, nullptr, to_second, first), plain, same) <
              1e-14);
    }
}

TEST_CASE("provenance maps: parts and flipped meshes come from where their corners are") {
    const Mesh mesh = make_sphere({.segments = 8, .kind = SphereKind::quads});
    const std::vector<Index> faces = {3, 1, 30, 17, 4};
    const MeshPart part = extract_faces(mesh, faces, {});
    Mesh turned = mesh;
    flip(turned);
    struct Made {
        const Mesh& mesh;
        MeshMap map;
    };
    for (const Made& made : {Made{part.mesh, part_map(part, mesh.topology())},
                             Made{turned, flipped_map(mesh.topology())}}) {
        const Topology &now = made.mesh.topology(), &old = mesh.topology();
        REQUIRE(made.map.corners.size() == now.corner_count());
        for (Index f = 0; f < now.face_count(); ++f) {
            const Index from = made.map.faces.main_source(f);
            for (Index k = 0; k < count_of(now.face(f)); ++k) {
                const Index corner = made.map.corners.main_source(now.first_corner(f) + k);
                const Index place = corner - old.first_corner(from);
                REQUIRE(place >= 0);
                REQUIRE(place < count_of(old.face(from)));
                const Index v = now.face(f)[static_cast<std::size_t>(k)];
                CHECK(old.face(from)[static_cast<std::size_t>(place)] ==
                      made.map.vertices.main_source(v));
            }
        }
    }
}

TEST_CASE("provenance maps: a kept vertex is the first that is nothing but the old one") {
    ElementMap map;
    map.add_copy(2);
    map.add_mean(std::vector<Index>{0, 1});
    map.add_copy(2);
    map.add_copy(0);
    CHECK(kept_vertices(map, 4) == std::vector<Index>{3, kNoIndex, 0, kNoIndex});
}
