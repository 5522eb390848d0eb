// What travels with meshes that are sewn.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "kernel/io/mesh_file.h"
#include "kernel/merge/sew/seam_skin.h"
#include "kernel/merge/sew/sew.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A vertex attribute that is an affine function of the position.
template <typename Value>
void add_attribute(Mesh& mesh, const char* name, Index width, const Value& value) {
    Attribute attribute{name, Domain::vertex, width, ScalarType::float64, {}};
    for (const Vec3& p : mesh.positions()) {
        for (Index k = 0; k < width; ++k) attribute.values.push_back(value(p, k));
    }
    mesh.attributes().add(std::move(attribute));
}

void add_corner_uvs(Mesh& mesh, double shift) {
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float32, {}};
    for (const Index v : mesh.topology().faces().vertices) {
        uv.values.push_back(mesh.position(v).x() + shift);
        uv.values.push_back(mesh.position(v).y() + shift);
    }
    mesh.attributes().add(std::move(uv));
}

std::set<Index> on_seam(const Sewn& sewn) {
    return {sewn.seams[0].begin(), sewn.seams[0].end()};
}

void add_skin(Mesh& mesh, double low, double high) {
    Attribute joints{"joints", Domain::vertex, 4, ScalarType::uint16, {}};
    Attribute weights{"weights", Domain::vertex, 4, ScalarType::float32, {}};
    for (const Vec3& p : mesh.positions()) {
        const double w = std::clamp(0.5 + 0.4 * p.x(), 0.0, 1.0);
        for (const double joint : {low, high, 0.0, 0.0}) joints.values.push_back(joint);
        for (const double weight : {w, 1.0 - w, 0.0, 0.0}) weights.values.push_back(weight);
    }
    mesh.attributes().add(std::move(joints));
    mesh.attributes().add(std::move(weights));
}

double weight_sum(const Mesh& mesh, Index v) {
    double sum = 0.0;
    for (const double w : mesh.attributes().find("weights")->at(v)) sum += w;
    return sum;
}

}  // namespace

TEST_CASE("sew: the map leads from every element to where it was") {
    const SewScene scene = two_tubes(24, 31);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0});
    const Topology& topology = sewn.mesh.topology();
    const Index targets = scene.target.vertex_count();
    REQUIRE(sewn.map.vertices.size() == sewn.mesh.vertex_count());
    REQUIRE(sewn.map.corners.size() == topology.corner_count());
    REQUIRE(sewn.map.faces.size() == sewn.mesh.face_count());
    const auto old_position = [&](Index v) {
        return v < targets ? scene.target.position(v) : scene.source.position(v - targets);
    };
    // The corners of a face lie in the face that it comes from.
    const Index old_corners = scene.target.topology().corner_count();
    const auto old_corner = [&](Index c) {
        return c < old_corners
                   ? scene.target.topology().faces().vertices[c]
                   : targets + scene.source.topology().faces().vertices[c - old_corners];
    };
    for (Index c = 0; c < topology.corner_count(); ++c) {
        Vec3 p = Vec3::Zero();
        double sum = 0.0;
        for (const auto& [corner, weight] : sewn.map.corners[c]) {
            p += weight * old_position(old_corner(corner));
            sum += weight;
        }
        CHECK(sum == doctest::Approx(1.0));
        // Source vertices were brought to the target's polyline, which cuts off arcs.
        CHECK((p - sewn.mesh.position(topology.faces().vertices[c])).norm() < 0.2);
    }
    for (Index f = 0; f < topology.face_count(); ++f) {
        const Index origin = sewn.map.faces.main_source(f);
        CHECK((origin < scene.target.face_count()) == (sewn.side_of_face[f] == SeamSide::target));
    }
}

TEST_CASE("sew: attributes away from the seam keep their bits, on it they are halves of both") {
    SewScene scene = two_tubes(24, 31);
    add_attribute(scene.target, "color", 3,
                  [](const Vec3&, Index k) { return k == 0 ? 1.0 : 0.0; });
    add_attribute(scene.source, "color", 3,
                  [](const Vec3&, Index k) { return k == 1 ? 1.0 : 0.0; });
    add_attribute(scene.source, "heat", 1, [](const Vec3& p, Index) { return p.y(); });
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    const Attribute& color = *sewn.mesh.attributes().find("color");
    const Attribute& heat = *sewn.mesh.attributes().find("heat");
    const std::set<Index> seam = on_seam(sewn);
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        const bool of_target = v < scene.target.vertex_count();
        if (seam.contains(v)) {
            CHECK(color.at(v)[0] == doctest::Approx(0.5));
            CHECK(color.at(v)[1] == doctest::Approx(0.5));
            CHECK(std::isfinite(heat.at(v)[0]));
        } else {
            CHECK(color.at(v)[0] == (of_target ? 1.0 : 0.0));
            CHECK(std::isnan(heat.at(v)[0]) == of_target);
        }
    }
}

TEST_CASE("sew: each side keeps its own texture coordinates along the seam") {
    for (const bool on_vertices : {false, true}) {
        SewScene scene = two_tubes(24, 31);
        if (on_vertices) {
            add_attribute(scene.target, "uv", 2, [](const Vec3& p, Index k) { return p[k]; });
            add_attribute(scene.source, "uv", 2,
                          [](const Vec3& p, Index k) { return p[k] + 10.0; });
        } else {
            add_corner_uvs(scene.target, 0.0);
            add_corner_uvs(scene.source, 10.0);
        }
        const Sewn sewn = sew(scene.target, scene.source, scene.joins);
        const Attribute& uv = *sewn.mesh.attributes().find("uv");
        REQUIRE(uv.domain == Domain::corner);
        for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
            const Index first = sewn.mesh.topology().first_corner(f);
            for (Index c = first; c < sewn.mesh.topology().first_corner(f + 1); ++c) {
                CHECK((uv.at(c)[0] > 5.0) == (sewn.side_of_face[f] == SeamSide::source));
            }
        }
    }
}

TEST_CASE("sew: regions of either side reach the seam") {
    SewScene scene = two_tubes(24, 31);
    scene.target.set_region("below", Region::all(scene.target.shared_topology()));
    scene.source.set_region("above", Region::all(scene.source.shared_topology()));
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    const Region& below = *sewn.mesh.find_region("below");
    const Region& above = *sewn.mesh.find_region("above");
    CHECK(below.faces().size() + above.faces().size() ==
          static_cast<std::size_t>(sewn.mesh.face_count()));
    for (const Index v : sewn.seams[0]) {
        CHECK(below.contains(v));
        CHECK(above.contains(v));
    }
}

TEST_CASE("sew: normals on the seam are those of the new surface") {
    SewScene scene = two_tubes(48, 48);
    const auto outward = [](const Vec3& p, Index k) {
        return k == 1 ? 0.0 : p[k] / std::hypot(p.x(), p.z());
    };
    add_attribute(scene.target, "normal", 3, outward);
    add_attribute(scene.source, "normal", 3,
                  [](const Vec3&, Index k) { return k == 1 ? 1.0 : 0.0; });
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    const Attribute& normal = *sewn.mesh.attributes().find("normal");
    for (const Index v : sewn.seams[0]) {
        const Vec3 n(normal.at(v)[0], normal.at(v)[1], normal.at(v)[2]);
        CHECK(n.norm() == doctest::Approx(1.0));
        CHECK(std::abs(n.y()) < 0.01);
    }
}

TEST_CASE("sew: normals next to the seam turn with it, hard edges stay hard") {
    SewScene scene = two_tubes(24, 31);
    Attribute normals{"normal", Domain::corner, 3, ScalarType::float32, {}};
    const Topology& topology = scene.target.topology();
    const std::vector<Vec3> of_face = face_normals(scene.target);
    for (Index f = 0; f < topology.face_count(); ++f) {
        for (std::size_t k = 0; k < topology.face(f).size(); ++k) {
            normals.values.insert(normals.values.end(), of_face[f].begin(), of_face[f].end());
        }
    }
    scene.target.attributes().add(normals);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    const Attribute& normal = *sewn.mesh.attributes().find("normal");
    const std::set<Index> seam = on_seam(sewn);
    const std::vector<Vec3> new_of_face = face_normals(sewn.mesh);
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        if (sewn.side_of_face[f] != SeamSide::target) continue;
        const std::span<const Index> face = sewn.mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const auto n = normal.at(sewn.mesh.topology().first_corner(f) + static_cast<Index>(k));
            if (seam.contains(face[k])) continue;
            CHECK(std::acos(std::min(1.0, Vec3(n[0], n[1], n[2]).dot(new_of_face[f]))) < 0.12);
        }
    }
}

TEST_CASE("sew: skin weights are blended by joint and sum to 1") {
    SewScene scene = two_tubes(24, 31);
    add_skin(scene.target, 0, 1);
    add_skin(scene.source, 2, 3);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    const std::set<Index> seam = on_seam(sewn);
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        CHECK(weight_sum(sewn.mesh, v) == doctest::Approx(1.0));
        const auto joints = sewn.mesh.attributes().find("joints")->at(v);
        const bool low = std::count(joints.begin(), joints.end(), 1.0) > 0;
        const bool high = std::count(joints.begin(), joints.end(), 3.0) > 0;
        if (seam.contains(v)) CHECK((low && high));
        if (!seam.contains(v)) CHECK(low != high);
    }
}

TEST_CASE("sew: a skin has joints and weights") {
    SewScene scene = two_tubes(24, 31);
    Mesh skinned = scene.source;
    add_skin(skinned, 4, 7);
    CHECK(skinned_side(scene.target, skinned) == SeamSide::source);
    CHECK(skinned_side(skinned, scene.target) == SeamSide::target);
    CHECK(!skinned_side(scene.target, scene.source));
    CHECK(!skinned_side(skinned, skinned));
    for (const char* missing : {"joints", "weights"}) {
        Mesh half = skinned;
        half.attributes().remove(missing);
        CHECK(!skinned_side(scene.target, half));
        CHECK(skinned_side(half, skinned) == SeamSide::source);
        CHECK_NOTHROW(require_same_joints(half, skinned, scene.joins));
    }
}

TEST_CASE("sew: a side without skin follows the seam") {
    for (const bool skin_on_target : {true, false}) {
        SewScene scene = two_tubes(24, 31);
        Mesh& skinned = skin_on_target ? scene.target : scene.source;
        const Mesh before = skinned;
        add_skin(skinned, 4, 7);
        const Sewn sewn = sew(scene.target, scene.source, scene.joins);
        for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
            CHECK(weight_sum(sewn.mesh, v) == doctest::Approx(1.0));
            const auto joints = sewn.mesh.attributes().find("joints")->at(v);
            CHECK((joints[0] == 4.0 || joints[0] == 7.0));
        }
    }
}

TEST_CASE("sew: skins of files are joined where their joints have the same names") {
    const auto path = data_file("gltf/blenderio_03_skinned_cylinder/03_skinned_cylinder.gltf");
    if (!path) return;
    // Two readings of a file have different assets with equal skeletons.
    const Mesh one = load_mesh(*path), two = load_mesh(*path);
    REQUIRE(one.attributes().find("joints"));
    REQUIRE(one.asset() != two.asset());
    SewScene scene = two_tubes(24, 31);
    add_skin(scene.target, 0, 1);
    add_skin(scene.source, 1, 0);
    const auto object = one.attributes().labels().at("object").names[0];
    const auto give = [&](Mesh& mesh, const Mesh& from, const std::string& label) {
        mesh.set_asset(from.asset());
        const auto faces = static_cast<std::size_t>(mesh.face_count());
        mesh.attributes().labels()["object"] = {{label}, std::vector<Index>(faces, 0)};
    };
    give(scene.target, one, object);
    CHECK(error_of([&] { sew(scene.target, scene.source, scene.joins); }).code() ==
          ErrorCode::skin_mismatch);
    give(scene.source, two, "another");
    CHECK(error_of([&] { sew(scene.target, scene.source, scene.joins); }).code() ==
          ErrorCode::skin_mismatch);
    give(scene.source, two, object);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        CHECK(weight_sum(sewn.mesh, v) == doctest::Approx(1.0));
    }
    // A side without skin becomes part of the skinned object.
    scene.source.attributes().remove("joints");
    scene.source.attributes().remove("weights");
    give(scene.source, two, "another");
    const Sewn extended = sew(scene.target, scene.source, scene.joins);
    const FaceLabels& labels = extended.mesh.attributes().labels().at("object");
    for (const Index label : labels.of_face) CHECK(labels.names[label] == object);
}

TEST_CASE("sew: a side without colors is white, and the seam has the colors of the other") {
    for (const bool of_source : {true, false}) {
        SewScene scene = two_tubes(24, 31);
        add_attribute(of_source ? scene.source : scene.target, "color", 3,
                      [](const Vec3&, Index) { return 0.25; });
        const Sewn sewn = sew(scene.target, scene.source, scene.joins);
        const std::set<Index> seam = on_seam(sewn);
        const Attribute& color = *sewn.mesh.attributes().find("color");
        for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
            const bool has = (v >= sewn.first_source_vertex) == of_source || seam.contains(v);
            for (const double value : color.at(v)) CHECK(value == (has ? 0.25 : 1.0));
        }
    }
}

TEST_CASE("sew: a side without texture coordinates has 0, 0") {
    for (const bool on_vertices : {false, true}) {
        SewScene scene = two_tubes(24, 31);
        if (on_vertices) {
            add_attribute(scene.source, "uv", 2, [](const Vec3& p, Index k) { return p[k] + 10; });
        } else {
            add_corner_uvs(scene.source, 10.0);
        }
        const Sewn sewn = sew(scene.target, scene.source, scene.joins);
        const Attribute& uv = *sewn.mesh.attributes().find("uv");
        for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
            const bool of_target = sewn.side_of_face[f] == SeamSide::target;
            const Index first = sewn.mesh.topology().first_corner(f);
            for (Index c = first; c < first + count_of(sewn.mesh.topology().face(f)); ++c) {
                for (const double value : uv.at(c)) CHECK((value == 0.0) == of_target);
            }
        }
    }
}
