#include "kernel/merge/piece/face_set.h"

#include <doctest/doctest.h>

#include <array>
#include <utility>

#include "kernel/mesh/mesh.h"

using namespace lissom;

namespace {

// Four faces around each of six vertices.
Mesh octahedron() {
    FaceList faces;
    for (Index k = 0; k < 4; ++k) {
        const Index a = 1 + k, b = 1 + (k + 1) % 4;
        faces.add({0, a, b});
        faces.add({5, b, a});
    }
    return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
            std::move(faces)};
}

}  // namespace

TEST_CASE("face set: two fans become one at whichever vertex they meet") {
    const Mesh mesh = octahedron();
    const Topology& topology = mesh.topology();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CAPTURE(v);
        const auto fan = topology.faces_around(v);
        const std::array<Index, 2> opposite{fan[0], fan[2]};
        FaceSet set(topology, opposite);
        CHECK(set.parts().size() == 2);
        set.grow_at_bow_ties(nullptr);
        CHECK(set.size() == 4);
        for (const Index f : fan) CHECK(set.contains(f));
        CHECK(set.parts().size() == 1);
        CHECK(set.euler_characteristic() == 1);
        REQUIRE(set.loops().size() == 1);
        CHECK(set.loops().front().size() == 4);
    }
}

TEST_CASE("face set: bow ties do not grow beyond their bounds") {
    const Mesh mesh = octahedron();
    const auto fan = mesh.topology().faces_around(0);
    const std::array<Index, 2> opposite{fan[0], fan[2]};
    const std::array<Index, 3> allowed{fan[0], fan[1], fan[2]};
    FaceSet set(mesh.topology(), opposite);
    const FaceSet bounds(mesh.topology(), allowed);
    set.grow_at_bow_ties(&bounds);
    CHECK(set.faces() == bounds.faces());
    CHECK(set.loops().size() == 1);
}
