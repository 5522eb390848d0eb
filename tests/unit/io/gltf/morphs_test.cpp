// Morph targets of meshes that become one: paired by name, with weights and animations.
#include <algorithm>
#include <cmath>

#include "kernel/merge/merge.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/scatter.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

struct Target {
    const char* name = nullptr;
    Vec3 adds = Vec3::Zero();
    double weight = 0.0;
};

// An open tube of eight sides along y, with targets that move all of it. Names without any are left
// out, weights too where `has_weights` is not set.
GltfFile tube(double bottom, const std::vector<Target>& targets, bool has_weights = true) {
    constexpr int kSides = 8, kRings = 4;
    GltfFile file;
    std::vector<float> positions;
    std::vector<std::uint16_t> corners;
    for (int ring = 0; ring < kRings; ++ring) {
        for (int i = 0; i < kSides; ++i) {
            const double angle = 2.0 * kPi * i / kSides;
            for (const double x : {std::cos(angle), bottom + 0.7 * ring, -std::sin(angle)}) {
                positions.push_back(static_cast<float>(x));
            }
        }
    }
    for (int ring = 0; ring + 1 < kRings; ++ring) {
        for (int i = 0; i < kSides; ++i) {
            const int a = ring * kSides + i, b = ring * kSides + (i + 1) % kSides;
            for (const int v : {a, b, b + kSides, a, b + kSides, a + kSides}) {
                corners.push_back(static_cast<std::uint16_t>(v));
            }
        }
    }
    Json primitive{{"attributes", {{"POSITION", file.floats(positions, "VEC3")}}},
                   {"indices", file.indices(corners)}};
    Json names = Json::array(), weights = Json::array();
    for (const Target& target : targets) {
        std::vector<float> adds;
        for (int v = 0; v < kSides * kRings; ++v) {
            for (int k = 0; k < 3; ++k) adds.push_back(static_cast<float>(target.adds[k]));
        }
        primitive["targets"].push_back({{"POSITION", file.floats(adds, "VEC3")}});
        if (target.name) names.push_back(target.name);
        weights.push_back(target.weight);
    }
    const int node = file.add_mesh(primitive);
    file.json["nodes"][node]["name"] = "part";
    if (!names.empty()) file.json["meshes"][0]["extras"]["targetNames"] = names;
    if (has_weights && !targets.empty()) file.json["meshes"][0]["weights"] = weights;
    return file;
}

// A ball of a radius, with a bump at the top if asked for, and targets that move all of it.
Mesh ball(double radius, bool bump, const std::vector<Target>& targets) {
    Mesh mesh = make_sphere({.segments = 24, .kind = SphereKind::triangles});
    for (Vec3& p : mesh.edit_positions()) {
        const double beside = p.x() * p.x() + p.z() * p.z();
        if (bump && p.y() > 0.0) p.y() += 0.5 * std::exp(-12.0 * beside);
        p *= radius;
    }
    GltfFile file;
    std::vector<float> positions;
    std::vector<std::uint16_t> corners;
    for (const Vec3& p : mesh.positions()) {
        for (const double x : {p.x(), p.y(), p.z()}) positions.push_back(static_cast<float>(x));
    }
    for (const Index v : mesh.topology().faces().vertices) {
        corners.push_back(static_cast<std::uint16_t>(v));
    }
    Json primitive{{"attributes", {{"POSITION", file.floats(positions, "VEC3")}}},
                   {"indices", file.indices(corners)}};
    Json names = Json::array(), weights = Json::array();
    for (const Target& target : targets) {
        std::vector<float> adds;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            for (int k = 0; k < 3; ++k) adds.push_back(static_cast<float>(target.adds[k]));
        }
        primitive["targets"].push_back({{"POSITION", file.floats(adds, "VEC3")}});
        names.push_back(target.name);
        weights.push_back(target.weight);
    }
    file.json["nodes"][file.add_mesh(primitive)]["name"] = "part";
    file.json["meshes"][0]["extras"]["targetNames"] = names;
    file.json["meshes"][0]["weights"] = weights;
    return file.load();
}

// The weights of all targets at two times, 1, 2, 3, ...
void animate(GltfFile& file, std::size_t targets) {
    std::vector<float> weights;
    for (std::size_t k = 0; k < 2 * targets; ++k) weights.push_back(static_cast<float>(k + 1));
    const int input = file.accessor<float>({0, 1}, kFloat, "SCALAR", {{"min", {0}}, {"max", {1}}});
    file.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", input}, {"output", file.floats(weights, "SCALAR")}}}}}};
}

MergeResult merged(const Mesh& source, const Mesh& target) {
    const auto loop = [](const Mesh& mesh, double sign) {
        std::vector<Path> all = boundaries(mesh);
        return *std::max_element(all.begin(), all.end(), [&](const Path& a, const Path& b) {
            return sign * mesh.position(a.vertices()[0]).y() <
                   sign * mesh.position(b.vertices()[0]).y();
        });
    };
    const Mesh* targets[] = {&target};
    MergeOptions options;
    options.configuration = Configuration::fixed;
    return Merger(source, targets, {{loop(source, -1.0), loop(target, 1.0)}}, options).solve();
}

const Vec3 kUp = Vec3::UnitY(), kOut = Vec3::UnitX(), kBack = Vec3::UnitZ();

// What a target adds to a vertex, zero where it is not known there.
Vec3 added(const Mesh& mesh, int number, Index v) {
    const Attribute* morph =
        mesh.attributes().find("morph." + std::to_string(number) + ".position");
    return morph ? morph_displacements(mesh, *morph)[at(v)] : Vec3(Vec3::Zero());
}

Index highest(const Mesh& mesh, double sign) {
    Index best = 0;
    for (Index v = 1; v < mesh.vertex_count(); ++v) {
        if (sign * mesh.position(v).y() > sign * mesh.position(best).y()) best = v;
    }
    return best;
}

Json written(const Mesh& mesh) {
    return json_of_glb(encode_mesh(mesh, "glb"));
}

Json names_of(const Json& json, std::size_t mesh = 0) {
    return json["meshes"][mesh]["extras"]["targetNames"];
}

std::vector<float> track(const Json& json, const Mesh& mesh) {
    const Json& animation = json["animations"][0];
    const int sampler = animation["channels"][0]["sampler"];
    const Json& accessor = json["accessors"][animation["samplers"][sampler]["output"].get<int>()];
    const Json& view = json["bufferViews"][accessor["bufferView"].get<int>()];
    const std::string glb = encode_mesh(mesh, "glb");
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof(length));
    std::vector<float> values(accessor["count"].get<std::size_t>());
    std::memcpy(values.data(), glb.data() + 28 + length + view.value("byteOffset", 0),
                values.size() * sizeof(float));
    return values;
}

}  // namespace

TEST_CASE("merged, shape keys are those of both by name, with weights") {
    const Mesh head = tube(2.1, {{"smile", kUp, 0.25}, {"blink", kOut, 0.5}}).load();
    const Mesh body = tube(0.0, {{"fat", kBack, 0.75}, {"blink", kUp, 0.5}}).load();
    const MergeResult result = merged(head, body);
    CHECK(result.report.warnings.empty());
    const Json json = written(result.mesh);
    REQUIRE(json["meshes"].size() == 1);
    CHECK(names_of(json) == Json::array({"fat", "blink", "smile"}));
    CHECK(json["meshes"][0]["weights"] == Json::array({0.75, 0.5, 0.25}));
    CHECK(json["meshes"][0]["primitives"][0]["targets"].size() == 3);
    const Index top = highest(result.mesh, 1.0), bottom = highest(result.mesh, -1.0);
    CHECK(added(result.mesh, 1, top).norm() < 1e-6);
    CHECK((added(result.mesh, 2, top) - kOut).norm() < 1e-6);
    CHECK((added(result.mesh, 3, top) - kUp).norm() < 1e-6);
    CHECK((added(result.mesh, 1, bottom) - kBack).norm() < 1e-6);
    CHECK((added(result.mesh, 2, bottom) - kUp).norm() < 1e-6);
    CHECK(added(result.mesh, 3, bottom).norm() < 1e-6);
    const Mesh again = decode_mesh(encode_mesh(result.mesh, "glb"), "glb");
    CHECK((added(again, 3, highest(again, 1.0)) - kUp).norm() < 1e-6);
}

namespace {

Index farthest(const Mesh& mesh, const Vec3& direction) {
    Index best = 0;
    for (Index v = 1; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).dot(direction) > mesh.position(best).dot(direction)) best = v;
    }
    return best;
}

PastePlacement at_side() {
    PastePlacement placement;
    placement.at = Vec3(2.0, 0.0, 0.0);
    return placement;
}

// The bump of a ball with [smile, blink] on the side of one with [fat, blink]: it was turned by a
// quarter, and `smile`, which moved it up, moves it out.
void check_bump(const Mesh& mesh, double scale) {
    const Json json = written(mesh);
    REQUIRE(json["meshes"].size() == 1);
    CHECK(names_of(json) == Json::array({"fat", "blink", "smile"}));
    CHECK(json["meshes"][0]["weights"] == Json::array({0.75, 0.5, 0.25}));
    CHECK(json["meshes"][0]["primitives"][0]["targets"].size() == 3);
    const Index tip = farthest(mesh, Vec3::UnitX()), away = farthest(mesh, -Vec3::UnitX());
    CHECK(added(mesh, 1, tip).norm() < 1e-6);
    CHECK((added(mesh, 3, tip) - scale * Vec3::UnitX()).norm() < 0.1 * scale);
    CHECK((added(mesh, 1, away) - kBack).norm() < 1e-6);
    CHECK((added(mesh, 2, away) - kUp).norm() < 1e-6);
    CHECK(added(mesh, 3, away).norm() < 1e-6);
}

}  // namespace

TEST_CASE("pasted and scattered, shape keys are those of both by name, turned with the part") {
    const Mesh part = ball(1.0, true, {{"smile", kUp, 0.25}, {"blink", kOut, 0.5}});
    const Mesh body = ball(2.0, false, {{"fat", kBack, 0.75}, {"blink", kUp, 0.5}});
    const Region region = select_sphere(part, Vec3(0.0, 1.3, 0.0), 0.95);
    Paste paste(part, body, region, std::nullopt, std::nullopt, at_side());
    paste.optimize(4);
    const PasteResult pasted = paste.merge();
    check_bump(pasted.merged.mesh, pasted.merged.report.joins.at(0).scale);

    const PastePlacement places[] = {at_side()};
    const ScatterResult scattered = scatter(part, body, region, std::nullopt, places);
    REQUIRE(scattered.placed == 1);
    check_bump(scattered.mesh, 1.0);
}

TEST_CASE("cloned, a feature takes its shape keys along, turned with it") {
    const Mesh mesh = ball(1.0, true, {{"smile", kUp, 0.25}, {"blink", kOut, 0.5}});
    PastePlacement placement = at_side();
    placement.at = Vec3(1.0, 0.0, 0.0);
    Paste paste(mesh, mesh, select_sphere(mesh, Vec3(0.0, 1.3, 0.0), 0.7), std::nullopt,
                std::nullopt, placement);
    const PasteResult cloned = paste.merge();
    const Mesh& made = cloned.merged.mesh;
    const Json json = written(made);
    CHECK(names_of(json) == Json::array({"smile", "blink"}));
    CHECK(json["meshes"][0]["weights"] == Json::array({0.25, 0.5}));
    const double scale = cloned.merged.report.joins.at(0).scale;
    const Vec3 tip = added(made, 1, farthest(made, Vec3::UnitX()));
    CHECK((tip - scale * Vec3::UnitX()).norm() < 0.1 * scale);
    CHECK((added(made, 1, farthest(made, -Vec3::UnitX())) - kUp).norm() < 1e-6);
}

TEST_CASE("pasted, a weight that differs on both sides is named, and the target's counts") {
    const Mesh part = ball(1.0, true, {{"blink", kOut, 0.5}});
    const Mesh body = ball(2.0, false, {{"blink", kUp, 0.1}});
    Paste paste(part, body, select_sphere(part, Vec3(0.0, 1.3, 0.0), 0.95), std::nullopt,
                std::nullopt, at_side());
    const PasteResult pasted = paste.merge();
    CHECK(written(pasted.merged.mesh)["meshes"][0]["weights"] == Json::array({0.1}));
    const std::vector<std::string>& told = pasted.merged.report.warnings;
    CHECK(std::any_of(told.begin(), told.end(), [](const std::string& text) {
        return text.find("blink") != std::string::npos;
    }));
}

TEST_CASE("shape keys of one side alone keep names and weights, whichever side it is") {
    const Mesh plain_head = tube(2.1, {}).load(), plain_body = tube(0.0, {}).load();
    const Mesh head = tube(2.1, {{"smile", kUp, 0.25}}).load();
    const Mesh body = tube(0.0, {{"fat", kBack, 0.75}}).load();
    Mesh bare = plain_body;
    bare.set_asset(nullptr);
    bare.attributes().labels().clear();
    for (const Mesh* target : {&plain_body, static_cast<const Mesh*>(&bare)}) {
        const Json json = written(merged(head, *target).mesh);
        CHECK(names_of(json) == Json::array({"smile"}));
        CHECK(json["meshes"][0]["weights"] == Json::array({0.25}));
    }
    const Json json = written(merged(plain_head, body).mesh);
    CHECK(names_of(json) == Json::array({"fat"}));
    CHECK(json["meshes"][0]["weights"] == Json::array({0.75}));
}

TEST_CASE("appended, each object has the keys of all by name, and its own weights") {
    Mesh mesh = tube(0.0, {{"fat", kBack, 0.75}, {"blink", kUp, 0.1}}).load();
    append(mesh, tube(9.0, {{"blink", kOut, 0.5}, {"smile", kUp, 0.25}}).load());
    const Json json = written(mesh);
    REQUIRE(json["meshes"].size() == 2);
    const Json all = Json::array({"fat", "blink", "smile"});
    for (const std::size_t m : {0, 1}) {
        CHECK(names_of(json, m) == all);
        CHECK(json["meshes"][m]["primitives"][0]["targets"].size() == 3);
    }
    CHECK(json["meshes"][0]["weights"] == Json::array({0.75, 0.1, 0.25}));
    CHECK(json["meshes"][1]["weights"] == Json::array({0.75, 0.5, 0.25}));
    CHECK((added(mesh, 2, highest(mesh, 1.0)) - kOut).norm() < 1e-6);
    CHECK((added(mesh, 3, highest(mesh, 1.0)) - kUp).norm() < 1e-6);
    // What has no keys gets none, and once all have these keys nothing is renumbered.
    append(mesh, tube(20.0, {}).load());
    append(mesh, tube(30.0, {{"smile", kBack}}).load());
    CHECK((added(mesh, 3, highest(mesh, 1.0)) - kBack).norm() < 1e-6);
    const Json more = written(mesh);
    CHECK(!more["meshes"][2]["primitives"][0].contains("targets"));
    CHECK(!more["meshes"][2].contains("extras"));
    CHECK(names_of(more, 3) == all);
}

TEST_CASE("objects of one file whose keys differ are paired by name as well") {
    Mesh mesh = tube(0.0, {{"fat", kBack}}).load();
    append(mesh, tube(9.0, {{"smile", kUp}}).load());
    const Mesh saved = decode_mesh(encode_mesh(mesh, "glb"), "glb");
    GltfFile file = tube(0.0, {{"fat", kBack}});
    const GltfFile other = tube(9.0, {{"smile", kUp}});
    // Both in one file, as other programs write them: each with one target.
    Json& json = file.json;
    const int accessors = static_cast<int>(json["accessors"].size());
    const int views = static_cast<int>(json["bufferViews"].size());
    while (file.bytes.size() % 4 != 0) file.bytes += '\0';
    const std::size_t offset = file.bytes.size();
    file.bytes += other.bytes;
    for (Json view : other.json["bufferViews"]) {
        view["byteOffset"] = view["byteOffset"].get<std::size_t>() + offset;
        json["bufferViews"].push_back(view);
    }
    for (Json accessor : other.json["accessors"]) {
        accessor["bufferView"] = accessor["bufferView"].get<int>() + views;
        json["accessors"].push_back(accessor);
    }
    Json second = other.json["meshes"][0];
    Json& primitive = second["primitives"][0];
    primitive["attributes"]["POSITION"] =
        accessors + primitive["attributes"]["POSITION"].get<int>();
    primitive["indices"] = accessors + primitive["indices"].get<int>();
    Json& delta = primitive["targets"][0]["POSITION"];
    delta = accessors + delta.get<int>();
    json["meshes"].push_back(second);
    json["nodes"].push_back({{"name", "head"}, {"mesh", 1}});
    Mesh both = file.load();
    CHECK((added(both, 1, highest(both, 1.0)) - kUp).norm() < 1e-6);
    append(both, tube(20.0, {{"smile", kOut}}).load());
    CHECK((added(both, 1, highest(both, -1.0)) - kBack).norm() < 1e-6);
    CHECK((added(both, 2, highest(both, 1.0)) - kOut).norm() < 1e-6);
    Index head = 0;
    while (std::abs(both.position(head).y() - 9.0) > 0.1) ++head;
    CHECK(added(both, 1, head).norm() == 0.0);
    CHECK((added(both, 2, head) - kUp).norm() < 1e-6);
}

TEST_CASE("keys without names are paired by number, and apart from those with names") {
    Mesh mesh = tube(0.0, {{nullptr, kBack}, {nullptr, kUp}}).load();
    append(mesh, tube(9.0, {{nullptr, kOut}}).load());
    CHECK((added(mesh, 1, highest(mesh, 1.0)) - kOut).norm() < 1e-6);
    CHECK(!written(mesh)["meshes"][0].contains("extras"));
    append(mesh, tube(20.0, {{"smile", kUp}}).load());
    CHECK((added(mesh, 3, highest(mesh, 1.0)) - kUp).norm() < 1e-6);
    CHECK(names_of(written(mesh)) == Json::array({"target 1", "target 2", "smile"}));
}

TEST_CASE("two keys of one name are paired in their order") {
    Mesh mesh = tube(0.0, {{"a", kBack}, {"a", kUp}}).load();
    append(mesh, tube(9.0, {{"b", kUp}, {"a", kOut}, {"a", kBack}}).load());
    const Index top = highest(mesh, 1.0);
    CHECK((added(mesh, 1, top) - kOut).norm() < 1e-6);
    CHECK((added(mesh, 2, top) - kBack).norm() < 1e-6);
    CHECK((added(mesh, 3, top) - kUp).norm() < 1e-6);
}

TEST_CASE("a weight that differs on both sides of a seam is named, and the target's counts") {
    const MergeResult result =
        merged(tube(2.1, {{"blink", kOut, 0.5}}).load(), tube(0.0, {{"blink", kUp, 0.125}}).load());
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(result.report.warnings[0].find("\"blink\"") != std::string::npos);
    CHECK(written(result.mesh)["meshes"][0]["weights"] == Json::array({0.125}));
}

TEST_CASE("animations of weights follow their keys, and one that is lost is named") {
    GltfFile body = tube(0.0, {{"fat", kBack, 0.75}, {"blink", kUp}});
    animate(body, 2);
    const Mesh target = body.load();
    Mesh mesh = tube(9.0, {{"smile", kUp, 0.25}, {"fat", kOut}}).load();
    append(mesh, target);
    Json json = written(mesh);
    CHECK(names_of(json, 1) == Json::array({"smile", "fat", "blink"}));
    CHECK(track(json, mesh) == std::vector<float>{0.25f, 1, 2, 0.25f, 3, 4});
    const Mesh merged_on = merged(tube(2.1, {{"smile", kUp, 0.25}}).load(), target).mesh;
    json = written(merged_on);
    CHECK(track(json, merged_on) == std::vector<float>{1, 2, 0.25f, 3, 4, 0.25f});
    GltfFile head = tube(2.1, {{"smile", kUp}});
    animate(head, 1);
    const MergeResult lost = merged(head.load(), tube(0.0, {{"fat", kBack}}).load());
    LoggedContext logged;
    encode_mesh(lost.mesh, "glb", {}, logged.context);
    CHECK(logged.log().find("animations of morph weights") != std::string::npos);
}

TEST_CASE("a key that was added or taken away leaves as many names and weights as keys") {
    Mesh mesh = tube(0.0, {{"fat", kBack, 0.75}}).load();
    Attribute more = *mesh.attributes().find("morph.1.position");
    more.name = "morph.2.position";
    mesh.attributes().add(more);
    Json json = written(mesh);
    CHECK(names_of(json) == Json::array({"fat", "target 2"}));
    CHECK(json["meshes"][0]["weights"] == Json::array({0.75, 0.0}));
    mesh.attributes().remove("morph.1.position");
    mesh.attributes().remove("morph.2.position");
    json = written(mesh);
    CHECK(!json["meshes"][0].contains("extras"));
    CHECK(!json["meshes"][0].contains("weights"));
}
