// Texture coordinates of roots.
#include "kernel/hair/scalp/root_uvs.h"

#include <utility>

#include "kernel/mesh/shapes/head.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;

namespace {

// A head, its scalp and roots on it.
struct RootedHead {
    Mesh mesh = make_head({.vertices = 3000});
    Scalp scalp{mesh};
    std::vector<Root> roots = make_roots(mesh, scalp, {.count = 300});

    RootedHead() { mesh.attributes() = {}; }

    std::vector<Eigen::Vector2f> uvs() const { return root_uvs(mesh, scalp, roots); }
    // A linear function of the place, with the number of the face added to its first part.
    Vec2 expected(const Vec3& place, Index face) const {
        return {2.0 * place.x() + 0.5 * place.z() + face, 3.0 * place.y() - place.z()};
    }
};

}  // namespace

TEST_CASE("root uvs: without texture coordinates the direction from the middle of the head") {
    const RootedHead head;
    const auto uvs = head.uvs();
    REQUIRE(uvs.size() == head.roots.size());
    for (std::size_t i = 0; i < uvs.size(); ++i) {
        const ScalpDirection direction{2.0 * kPi * (uvs[i].x() - 0.5), kPi * (uvs[i].y() - 0.5)};
        const Vec3 from_center = head.roots[i].position - head.scalp.frame().center;
        CHECK((head.scalp.vector_of(direction) - from_center.normalized()).norm() < 1e-5);
    }
}

TEST_CASE("root uvs: what a texture has at the place of the root, by vertices or by corners") {
    for (const bool seams : {false, true}) {
        RootedHead head;
        const Topology& topology = head.mesh.topology();
        Attribute uv{"uv", seams ? Domain::corner : Domain::vertex, 2, ScalarType::float64, {}};
        const auto add = [&](const Vec2& value) {
            uv.values.insert(uv.values.end(), {value.x(), value.y()});
        };
        if (!seams) {
            for (const Vec3& p : head.mesh.positions()) add(head.expected(p, 0));
        } else {
            for (Index f = 0; f < topology.face_count(); ++f) {
                for (const Index v : topology.face(f)) add(head.expected(head.mesh.position(v), f));
            }
        }
        head.mesh.attributes().add(uv);
        const auto uvs = head.uvs();
        for (std::size_t i = 0; i < uvs.size(); ++i) {
            const Root& root = head.roots[i];
            const Vec2 wanted = head.expected(root.position, seams ? root.face : 0);
            CHECK((uvs[i].cast<double>() - wanted).norm() < 1e-3);
        }
    }
}

TEST_CASE("root uvs: an attribute of that name that is no texture is passed over") {
    RootedHead head;
    const auto before = head.uvs();
    const auto with = [&](Domain domain, Index width, Index count) {
        Attribute other{"uv", domain, width, ScalarType::float64, {}};
        other.values.assign(static_cast<std::size_t>(width) * count, 0.25);
        head.mesh.attributes().add(std::move(other));
        return head.uvs();
    };
    CHECK(with(Domain::face, 2, head.mesh.face_count()) == before);
    CHECK(with(Domain::vertex, 3, head.mesh.vertex_count()) == before);
    CHECK(with(Domain::vertex, 2, head.mesh.vertex_count()) != before);
}
