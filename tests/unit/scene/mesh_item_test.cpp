#include "kernel/scene/mesh_item.h"

#include <doctest/doctest.h>

#include <limits>

#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// A mesh with something of everything.
std::shared_ptr<Mesh> rich_mesh() {
    auto mesh = std::make_shared<Mesh>(make_bar());
    Attribute heat{"heat", Domain::vertex, 1, ScalarType::float64, {}};
    heat.values.resize(at(mesh->vertex_count()), 0.25);
    heat.values[3] = std::numeric_limits<double>::quiet_NaN();
    mesh->attributes().add(heat);
    FaceLabels groups;
    groups.of_face.resize(at(mesh->face_count()), groups.add("side"));
    mesh->attributes().labels()["group"] = groups;
    mesh->set_region("corner", Region(mesh->shared_topology(), {0, 1, 2}));
    mesh->material_libraries() = {"bar.mtl"};
    Report report;
    report.add(FindingKind::vertices_welded, 3, "at the seam");
    mesh->set_report(report);
    return mesh;
}

struct Capture {
    ContentStore store;
    std::shared_ptr<const ItemContent> content;

    void take(const MeshItem& item) { content = item.capture(content, store); }
};

}  // namespace

TEST_CASE("mesh item: what did not change is the same content") {
    const auto mesh = rich_mesh();
    const MeshItem item(mesh);
    Capture capture;
    capture.take(item);
    const auto first = capture.content;
    mesh->edit_positions();
    capture.take(item);
    CHECK(capture.content == first);
    CHECK(capture.content->hash() == hash(*mesh));
}

TEST_CASE("mesh item: each part of a mesh is seen to change, and comes back") {
    const auto mesh = rich_mesh();
    MeshItem item(mesh);
    Capture capture;
    capture.take(item);
    const auto first = capture.content;
    const Mesh before = *mesh;

    SUBCASE("positions") {
        mesh->edit_positions()[5].x() += 1.0;
    }
    SUBCASE("a position that is not finite") {
        mesh->edit_positions()[5].x() = std::numeric_limits<double>::quiet_NaN();
    }
    SUBCASE("values of an attribute") {
        mesh->attributes().find("heat")->values[1] = 7.0;
    }
    SUBCASE("an attribute more") {
        mesh->attributes().add({"wind", Domain::face, 1, ScalarType::uint8,
                                std::vector<double>(at(mesh->face_count()), 1.0)});
    }
    SUBCASE("the type of an attribute") {
        mesh->attributes().find("heat")->type = ScalarType::float32;
    }
    SUBCASE("labels") {
        mesh->attributes().labels()["group"].names[0] = "top";
    }
    SUBCASE("a region") {
        mesh->remove_region("corner");
    }
    SUBCASE("material libraries") {
        mesh->material_libraries().clear();
    }
    SUBCASE("the report") {
        mesh->set_report({});
    }
    SUBCASE("faces") {
        triangulate(*mesh);
    }
    SUBCASE("vertices") {
        mesh->replace_by(subdivide(*mesh, {}));
    }
    SUBCASE("everything") {
        mesh->replace_by(Mesh());
    }
    SUBCASE("another mesh of the same topology, with as many changes") {
        Mesh other = before;
        REQUIRE(other.revision() == mesh->revision());
        other.edit_positions()[5].x() += 1.0;
        mesh->edit_positions();
        capture.take(item);
        *mesh = other;
    }

    capture.take(item);
    CHECK(capture.content != first);
    const Mesh after = *mesh;
    const std::uint64_t revision = mesh->revision();
    item.restore(*first, capture.content.get());
    CHECK(mesh->revision() > revision);
    CHECK(mesh->shared_topology() == before.shared_topology());
    CHECK(hash(*mesh) == hash(before));
    CHECK(mesh->report() == before.report());
    CHECK(mesh->regions() == before.regions());
    const auto second = capture.content;
    capture.content = first;
    capture.take(item);
    CHECK(capture.content == first);

    // Without knowing what is there now.
    item.restore(*second, nullptr);
    CHECK(hash(*mesh) == hash(after));
    CHECK(mesh->shared_topology() == after.shared_topology());
}
