// Baked shapes come back from glTF files at their keys.
#include "kernel/io/morph_baker.h"

#include <array>
#include <string>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// The mesh with every vertex moved by an amount that grows with its height.
Mesh swayed(const Mesh& mesh, double amount) {
    Mesh shape = mesh;
    for (Vec3& p : shape.edit_positions()) p.x() += amount * p.y() * p.y();
    return shape;
}

// A binary file: its JSON and its numbers.
struct Glb {
    explicit Glb(const Mesh& mesh) : bytes(encode_mesh(mesh, "glb")), json(json_of_glb(bytes)) {}

    std::vector<float> floats(int accessor) const {
        const Json& a = json["accessors"][static_cast<std::size_t>(accessor)];
        const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        std::uint32_t json_bytes = 0;
        std::memcpy(&json_bytes, bytes.data() + 12, 4);
        const std::size_t start = 28 + json_bytes + view.value("byteOffset", std::size_t{0});
        std::vector<float> values(view["byteLength"].get<std::size_t>() / 4);
        std::memcpy(values.data(), bytes.data() + start, 4 * values.size());
        return values;
    }
    const Json& animation() const { return json["animations"][0]; }
    std::vector<float> times() const {
        return floats(animation()["samplers"][0]["input"].get<int>());
    }
    // Weights of the targets at key `k`.
    std::vector<float> weights(std::size_t k) const {
        const std::vector<float> all = floats(animation()["samplers"][0]["output"].get<int>());
        const std::size_t width = all.size() / times().size();
        return {all.begin() + static_cast<std::ptrdiff_t>(k * width),
                all.begin() + static_cast<std::ptrdiff_t>((k + 1) * width)};
    }

    std::string bytes;
    Json json;
};

// What a viewer shows of `attribute` ("" for positions) of a mesh read from a file.
std::vector<Vec3> blended(const Mesh& mesh, const std::string& attribute, const std::string& morph,
                          const std::vector<float>& weights) {
    std::vector<Vec3> values;
    if (const Attribute* base = mesh.attributes().find(attribute)) {
        for (Index i = 0; i < base->size(); ++i) values.emplace_back(base->at(i).data());
    } else {
        values.assign(mesh.positions().begin(), mesh.positions().end());
    }
    for (std::size_t t = 0; t < weights.size(); ++t) {
        const Attribute* target =
            mesh.attributes().find("morph." + std::to_string(t + 1) + "." + morph);
        REQUIRE(target);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] +=
                static_cast<double>(weights[t]) * Vec3(target->at(static_cast<Index>(i)).data());
        }
    }
    return values;
}

double max_distance(const std::vector<Vec3>& a, std::span<const Vec3> b) {
    REQUIRE(a.size() == b.size());
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
    return greatest;
}

Region all_of(const Mesh& mesh) {
    return Region::all(mesh.shared_topology());
}

}  // namespace

TEST_CASE("the shapes of a deformation come back at their keys, with their normals") {
    const Mesh rest = make_cactus({.vertices = 2000});
    Deformer edit(rest, all_of(rest));
    edit.add_handle(*rest.find_region("base"));
    const HandleId tip = edit.add_handle(*rest.find_region("tip"));
    MorphBaker baker(rest, edit.region());
    std::vector<Mesh> shapes;
    for (int k = 0; k < 4; ++k) {
        edit.set_transform(tip, rotation(Vec3::UnitZ(), 0.4 * k, edit.handle(tip).center));
        edit.solve();
        edit.apply_to(shapes.emplace_back(rest));
        baker.add(0.25 * k, shapes.back());
    }
    CHECK(baker.target_count() == 3);
    const Glb file(baker.finish());
    const Mesh read = decode_mesh(file.bytes, "glb");
    const double size = surface_radius(rest);
    CHECK(file.times() == std::vector<float>{0.0f, 0.25f, 0.5f, 0.75f});
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const std::vector<float> weights = file.weights(k);
        CHECK(max_distance(blended(read, "", "position", weights), shapes[k].positions()) <
              2e-6 * size);
        CHECK(max_distance(blended(read, "normal", "normal", weights), vertex_normals(shapes[k])) <
              2e-6);
    }
}

TEST_CASE("with a tolerance few targets make all shapes within it, and the error is told") {
    const Mesh rest = make_cactus({.vertices = 2000});
    const double size = surface_radius(rest);
    Deformer edit(rest, all_of(rest));
    edit.add_handle(*rest.find_region("base"));
    const HandleId tip = edit.add_handle(*rest.find_region("tip"));
    std::vector<Mesh> shapes;
    for (int k = 0; k < 24; ++k) {
        edit.set_transform(tip,
                           rotation(Vec3::UnitZ(), std::sin(0.3 * k), edit.handle(tip).center));
        edit.solve();
        edit.apply_to(shapes.emplace_back(rest));
    }
    Index before = 24;
    for (const double share : {1e-5, 1e-3, 1e-2}) {
        CAPTURE(share);
        MorphBaker baker(rest, edit.region(), {.tolerance = share * size});
        for (int k = 0; k < 24; ++k) baker.add(0.1 * k, shapes[static_cast<std::size_t>(k)]);
        BakeReport report;
        const Glb file(baker.finish(&report));
        const Mesh read = decode_mesh(file.bytes, "glb");
        CHECK(report.keys == 24);
        CHECK(report.targets < before);
        CHECK(report.max_error <= share * size);
        CHECK(report.max_direction_error <= 0.02);
        double worst = 0.0, turned = 0.0;
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            const std::vector<float> weights = file.weights(k);
            worst = std::max(
                worst, max_distance(blended(read, "", "position", weights), shapes[k].positions()));
            turned = std::max(turned, max_distance(blended(read, "normal", "normal", weights),
                                                   vertex_normals(shapes[k])));
        }
        CHECK(worst == doctest::Approx(report.max_error).epsilon(0.05));
        CHECK(turned < 0.021);
        before = report.targets;
    }
    CHECK(before <= 6);
    CHECK_THROWS_AS(MorphBaker(rest, edit.region(), {.tolerance = -1.0}), Error);
}

TEST_CASE("equal shapes share a target and the rest shape needs none") {
    const Mesh rest = make_bar({.across = 2, .along = 6});
    MorphBaker baker(rest, all_of(rest), {.name = "sway", .interpolation = KeyInterpolation::step});
    const double amounts[] = {0.0, 0.1, 0.2, 0.1, 0.0, 0.1};
    for (int k = 0; k < 6; ++k) baker.add(k, swayed(rest, amounts[k]));
    CHECK(baker.key_count() == 6);
    CHECK(baker.target_count() == 2);
    const Glb file(baker.finish());
    CHECK(file.animation()["name"] == "sway");
    CHECK(file.animation()["samplers"][0]["interpolation"] == "STEP");
    CHECK(file.animation()["channels"].size() == 1);
    CHECK(file.json["meshes"][0]["primitives"][0]["targets"].size() == 2);
    CHECK(file.weights(0) == std::vector<float>{0, 0});
    CHECK(file.weights(1) == std::vector<float>{1, 0});
    CHECK(file.weights(2) == std::vector<float>{0, 1});
    CHECK(file.weights(3) == std::vector<float>{1, 0});
    CHECK(file.weights(4) == std::vector<float>{0, 0});
    const Json& times = file.json["accessors"][file.animation()["samplers"][0]["input"].get<int>()];
    CHECK(times["min"] == Json::array({0.0}));
    CHECK(times["max"] == Json::array({5.0}));
}

TEST_CASE("a mesh that never moves has no targets and no animation") {
    const Mesh rest = make_bar({.across = 2, .along = 6});
    MorphBaker baker(rest, all_of(rest));
    baker.add(0.0, rest);
    baker.add(1.0, rest);
    const Glb file(baker.finish());
    CHECK_FALSE(file.json.contains("animations"));
    CHECK_FALSE(file.json["meshes"][0]["primitives"][0].contains("targets"));
}

TEST_CASE("normals are made on request only, and those of the mesh follow") {
    const Mesh rest = make_bar({.across = 2, .along = 6});
    MorphBaker without(rest, all_of(rest), {.normals = false});
    without.add(0.0, swayed(rest, 0.1));
    const Mesh plain = without.finish();
    CHECK_FALSE(plain.attributes().find("normal"));
    CHECK_FALSE(plain.attributes().find("morph.1.normal"));

    Mesh custom = rest;
    const Index corners = rest.topology().corner_count();
    std::vector<double> up, tangents;
    for (Index c = 0; c < corners; ++c) {
        const bool is_odd = c % 2 != 0;
        for (const double x : {is_odd ? 1.0 : 0.0, is_odd ? 0.0 : 1.0, 0.0}) up.push_back(x);
        for (const double x : {0.0, 0.0, 1.0, -1.0}) tangents.push_back(x);
    }
    custom.attributes().add({"normal", Domain::corner, 3, ScalarType::float32, up});
    custom.attributes().add({"tangent", Domain::corner, 4, ScalarType::float32, tangents});
    Mesh shape = swayed(custom, 0.1);
    for (double& x : shape.attributes().find("normal")->values) x = -x;
    for (Index c = 0; c < corners; ++c) shape.attributes().find("tangent")->at(c)[2] = 0.5;
    MorphBaker baker(custom, all_of(custom));
    baker.add(0.0, shape);
    const Glb file(baker.finish());
    const Mesh read = decode_mesh(file.bytes, "glb");
    REQUIRE(read.attributes().find("normal"));
    CHECK(read.attributes().find("normal")->domain == Domain::corner);
    const std::vector<Vec3> turned = blended(read, "normal", "normal", {1.0f});
    double least = 1.0;
    for (Index c = 0; c < corners; ++c) {
        least =
            std::min(least, turned[c].dot(Vec3(shape.attributes().find("normal")->at(c).data())));
    }
    CHECK(least > 0.999);
    const Attribute* tangent = read.attributes().find("morph.1.tangent");
    REQUIRE(tangent);
    CHECK(std::abs(tangent->at(0)[2] + 0.5) < 1e-6);
}

TEST_CASE("only objects that move have targets, each at its own node") {
    Mesh rest = make_box();
    rest.attributes().labels()["object"] = {{"still"}, std::vector<Index>(6, 0)};
    Mesh other = make_box();
    for (Vec3& p : other.edit_positions()) p.x() += 3.0;
    other.attributes().labels()["object"] = {{"mover"}, std::vector<Index>(6, 0)};
    const Index split = rest.vertex_count();
    append(rest, other);
    std::vector<Index> moving;
    for (Index v = split; v < rest.vertex_count(); ++v) moving.push_back(v);
    Mesh shape = rest;
    for (const Index v : moving) shape.edit_positions()[v].z() += 1.0;
    MorphBaker baker(rest, Region(rest.shared_topology(), moving));
    baker.add(0.0, rest);
    baker.add(1.0, shape);
    const Glb file(baker.finish());
    REQUIRE(file.animation()["channels"].size() == 1);
    const Json& node =
        file.json["nodes"][file.animation()["channels"][0]["target"]["node"].get<int>()];
    CHECK(node["name"] == "mover");
    for (const Json& mesh : file.json["meshes"]) {
        CHECK(mesh["primitives"][0].contains("targets") == (mesh["name"] == "mover"));
    }
}

TEST_CASE("the nodes and materials of a file stay; its morph targets give way") {
    GltfFile source;
    Json primitive = source.square_primitive();
    primitive["targets"] = {{{"POSITION", source.floats(std::vector<float>(12, 0.5f), "VEC3")}}};
    primitive["material"] = 0;
    source.json["materials"] = {{{"name", "red"}}};
    const int node = source.add_mesh(primitive);
    source.json["meshes"][0]["weights"] = {0.5};
    source.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}, {"kept", 1}};
    source.json["nodes"][node].update(
        {{"name", "flag"}, {"scale", {2, 2, 2}}, {"rotation", {0, 0.6, 0, 0.8}}});
    const int times =
        source.accessor<float>({0, 1}, kFloat, "SCALAR", {{"min", {0}}, {"max", {1}}});
    source.json["animations"] = {
        {{"samplers",
          {{{"input", times}, {"output", source.floats({0, 1}, "SCALAR")}},
           {{"input", times}, {"output", source.floats({0, 0, 0, 1, 0, 0}, "VEC3")}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}},
           {{"sampler", 1}, {"target", {{"node", node}, {"path", "translation"}}}}}}}};
    const Mesh rest = source.load();
    const LoggedContext log;
    MorphBaker baker(rest, all_of(rest), {}, log.context);
    CHECK(log.mentions("morph targets"));
    Mesh shape = rest;
    shape.edit_positions()[2].y() += 1.0;
    baker.add(0.0, shape);
    const Glb file(baker.finish());
    REQUIRE(file.json["animations"].size() == 2);
    CHECK(file.json["animations"][0]["channels"].size() == 1);
    CHECK(file.json["animations"][0]["channels"][0]["target"]["path"] == "translation");
    CHECK(file.json["animations"][1]["channels"][0]["target"]["node"] == node);
    CHECK(file.json["nodes"][node]["name"] == "flag");
    CHECK(file.json["materials"][0]["name"] == "red");
    CHECK_FALSE(file.json["meshes"][0].contains("weights"));
    CHECK_FALSE(file.json["meshes"][0]["extras"].contains("targetNames"));
    const Mesh read = decode_mesh(file.bytes, "glb");
    CHECK(max_distance(blended(read, "", "position", {1.0f}), shape.positions()) < 1e-6);
}

TEST_CASE("a mesh with a baked animation is read and saved again as it is") {
    const Mesh rest = make_bar({.across = 2, .along = 6});
    MorphBaker baker(rest, all_of(rest));
    for (int k = 0; k < 3; ++k) baker.add(k, swayed(rest, 0.1 * k));
    const Glb first(baker.finish());
    const Glb second(decode_mesh(first.bytes, "glb"));
    CHECK(second.times() == first.times());
    CHECK(second.weights(2) == first.weights(2));
    CHECK(second.json["meshes"][0]["primitives"][0]["targets"].size() == 2);
}

TEST_CASE("bad keys and meshes are refused") {
    const Mesh rest = make_bar({.across = 2, .along = 6});
    MorphBaker baker(rest, all_of(rest));
    const auto code = [&](double time, const Mesh& shape) {
        return error_of([&] { baker.add(time, shape); }).code();
    };
    CHECK(error_of([&] { baker.finish(); }).code() == ErrorCode::invalid_argument);
    CHECK(code(-1.0, rest) == ErrorCode::invalid_argument);
    CHECK(code(kNan, rest) == ErrorCode::invalid_argument);
    CHECK(code(1e300, rest) == ErrorCode::invalid_argument);
    CHECK(code(0.0, make_box()) == ErrorCode::topology_mismatch);
    baker.add(1.0, rest);
    CHECK(code(1.0, rest) == ErrorCode::invalid_argument);
    CHECK(code(1.0 + 1e-12, rest) == ErrorCode::invalid_argument);
    CHECK(baker.key_count() == 1);
    const Mesh points({Vec3::Zero(), Vec3::UnitX()}, FaceList());
    CHECK(error_of([&] { MorphBaker(points, all_of(points)); }).code() == ErrorCode::unsupported);
    CHECK(error_of([&] { MorphBaker(rest, all_of(points)); }).code() ==
          ErrorCode::topology_mismatch);
    ContextOptions options;
    options.memory_limit = 1000;
    const Context small(options);
    MorphBaker limited(rest, all_of(rest), {}, small);
    CHECK(error_of([&] { limited.add(0.0, swayed(rest, 0.1)); }).code() == ErrorCode::memory_limit);
    small.cancel();
    CHECK(error_of([&] { limited.add(0.0, rest); }).code() == ErrorCode::cancelled);
}
