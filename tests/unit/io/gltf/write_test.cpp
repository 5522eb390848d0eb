// What is saved as glTF is what is loaded again, with all that the file had beside its surface.
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/region.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Positions as 32-bit numbers, so that they survive.
Mesh narrow_prism(Index n) {
    Mesh mesh = prism(n);
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Vec3& p : positions) p = p.cast<float>().cast<double>();
    mesh.set_positions(std::move(positions));
    return mesh;
}

void add(Mesh& mesh, const char* name, Domain domain, Index width, std::vector<double> values,
         ScalarType type = ScalarType::float32) {
    mesh.attributes().add({name, domain, width, type, std::move(values)});
}

void add_labels(Mesh& mesh, const char* kind, std::vector<std::string> names, Index run) {
    FaceLabels& labels = mesh.attributes().labels()[kind];
    labels.names = std::move(names);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        labels.of_face.push_back(f / run % static_cast<Index>(labels.names.size()));
    }
}

std::vector<double> unit_vectors(Index count) {
    std::vector<double> values;
    for (Index i = 0; i < count; ++i) {
        const double angle = 0.3 * i;
        for (const double x : {std::cos(angle), std::sin(angle), 0.0}) values.push_back(x);
    }
    return rounded_to_floats(values);
}

// Texture coordinates that survive 1 - v.
std::vector<double> coordinates(Index count) {
    std::vector<double> values;
    for (Index i = 0; i < 2 * count; ++i) values.push_back((i * 7 % 64) / 64.0);
    return values;
}

// With a skin of two joints, a morph target, a material with a texture, a camera and an animation.
GltfFile rich_file() {
    GltfFile file;
    Json primitive = file.square_primitive();
    Json& attributes = primitive["attributes"];
    attributes["NORMAL"] = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    attributes["TEXCOORD_0"] = file.floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    attributes["JOINTS_0"] = file.accessor<std::uint8_t>(
        {0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, kUnsignedByte, "VEC4");
    attributes["WEIGHTS_0"] =
        file.floats({.25, .75, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    primitive["targets"] = {{{"POSITION", file.floats(std::vector<float>(12, 0.5f), "VEC3")}}};
    primitive["material"] = 0;
    const int node = file.add_mesh(primitive);
    file.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}};
    file.json["nodes"][node].update({{"name", "body"}, {"skin", 0}});
    file.json["nodes"].push_back({{"name", "hip"}, {"children", {2}}});
    file.json["nodes"].push_back({{"name", "knee"}, {"translation", {0, 1, 0}}});
    file.json["nodes"].push_back({{"name", "eye"}, {"camera", 0}});
    file.json["scenes"] = {{{"nodes", {0, 1, 3}}}};
    std::vector<float> matrices(32, 0.0f);
    for (std::size_t i = 0; i < 32; i += 16) {
        for (std::size_t k = 0; k < 16; k += 5) matrices[i + k] = 1.0f;
    }
    file.json["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", file.floats(matrices, "MAT4")}}};
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    file.json["images"] = {{{"uri", "data:image/png;base64,iVBORw=="}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"name", "skin"},
                               {"extras", {{"note", Json::array()}}},
                               {"extensions", {{"ACME_glow", {{"power", 4294967296}}}}},
                               {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}},
         {"samplers",
          {{{"input", file.accessor<float>({0, 1}, kFloat, "SCALAR", {{"min", {0}}, {"max", {1}}})},
            {"output", file.floats({0, 1, 0, 0, 2, 0}, "VEC3")}}}}}};
    file.json["extensionsUsed"] = {"ACME_glow"};
    return file;
}

}  // namespace

TEST_CASE("polygons, attributes of vertices and corners, labels and regions survive") {
    Mesh mesh = narrow_prism(6);
    const Index vertices = mesh.vertex_count(), corners = mesh.topology().corner_count();
    add(mesh, "uv", Domain::corner, 2, coordinates(corners));
    add(mesh, "uv2", Domain::vertex, 2, coordinates(vertices));
    add(mesh, "normal", Domain::corner, 3, unit_vectors(corners));
    add(mesh, "color", Domain::vertex, 4, rounded_to_bytes(numbers(4 * vertices, 1)),
        ScalarType::uint8);
    add(mesh, "heat", Domain::vertex, 1, rounded_to_floats(numbers(vertices, 2)));
    add(mesh, "count", Domain::vertex, 3, std::vector<double>(3 * vertices, 7.0),
        ScalarType::uint16);
    add(mesh, "morph.1.position", Domain::vertex, 3, rounded_to_floats(numbers(3 * vertices, 3)));
    add_labels(mesh, "group", {"a", "b"}, 2);
    add_labels(mesh, "smoothing", {"off"}, 1);
    add_labels(mesh, "object", {"one"}, 1);
    mesh.attributes().labels()["group"].of_face[1] = kNoIndex;
    mesh.set_region("top", Region(mesh.shared_topology(), {0, 1, 2, 5}));
    for (const char* extension : {"glb", "gltf"}) {
        LoggedContext logged;
        const std::string bytes = encode_mesh(mesh, extension, {}, logged.context);
        CHECK(logged.log().empty());
        const Mesh again = decode_mesh(bytes, extension);
        check_same_mesh(mesh, again);
        REQUIRE(again.find_region("top"));
        CHECK(again.find_region("top")->vertices() == std::vector<Index>{0, 1, 2, 5});
    }
}

TEST_CASE("objects and materials are nodes and primitives") {
    Mesh mesh = narrow_prism(6);
    const Index faces = mesh.face_count();
    append(mesh, narrow_prism(6));
    add_labels(mesh, "object", {"one", "two"}, faces);
    add_labels(mesh, "material", {"red", "blue"}, faces / 2);
    const Json json = json_of_glb(encode_mesh(mesh, "glb"));
    CHECK(json["nodes"].size() == 2);
    CHECK(json["nodes"][1]["name"] == "two");
    CHECK(json["meshes"][0]["primitives"].size() == 2);
    CHECK(json["materials"][1]["name"] == "blue");
    const Mesh again = round_trip(mesh, "glb");
    CHECK(label_of_each_face(again, "material") == label_of_each_face(mesh, "material"));
    CHECK(label_of_each_face(again, "object") == label_of_each_face(mesh, "object"));
}

TEST_CASE("objects that share vertices stay one surface") {
    Mesh mesh = narrow_prism(6);
    add_labels(mesh, "object", {"one", "two"}, 4);
    const Json json = json_of_glb(encode_mesh(mesh, "glb"));
    CHECK(json["nodes"].size() == 1);
    CHECK(json["nodes"][0]["name"] == "one");
    const Mesh again = round_trip(mesh, "glb");
    CHECK(again.vertex_count() == mesh.vertex_count());
    CHECK(label_of_each_face(again, "object") == label_of_each_face(mesh, "object"));
}

TEST_CASE("open edges that lie at one place on purpose stay apart") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({3, 4, 5});
    const Mesh lips({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                    std::move(faces));
    CHECK(round_trip(lips, "glb").vertex_count() == 6);
    CHECK(decode_mesh(encode_mesh(lips, "glb"), "glb", {.weld = Weld::seams}).vertex_count() == 4);
}

TEST_CASE("what glTF cannot hold is named") {
    Mesh mesh = narrow_prism(4);
    add(mesh, "area", Domain::face, 1, std::vector<double>(mesh.face_count(), 1.0));
    add(mesh, "wide", Domain::vertex, 5, std::vector<double>(5 * mesh.vertex_count(), 1.0));
    LoggedContext logged;
    encode_mesh(mesh, "glb", {}, logged.context);
    CHECK(logged.mentions("'area'"));
    CHECK(logged.mentions("'wide'"));
}

TEST_CASE("positions beyond 32-bit numbers are refused") {
    Mesh mesh = narrow_prism(4);
    mesh.set_position(2, Vec3(1e39, 0, 0));
    const Error error = error_of([&] { encode_mesh(mesh, "glb"); });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.elements().ids == std::vector<Index>{2});
}

TEST_CASE("everything beside the surface is saved again") {
    const Mesh mesh = rich_file().load();
    const std::string bytes = encode_mesh(mesh, "glb");
    const Json json = json_of_glb(bytes);
    CHECK(json["materials"] == rich_file().json["materials"]);
    CHECK(json["cameras"] == rich_file().json["cameras"]);
    CHECK(json["skins"][0]["joints"] == Json::array({1, 2}));
    CHECK(json["skins"][0].contains("inverseBindMatrices"));
    CHECK(json["animations"][0]["channels"] == rich_file().json["animations"][0]["channels"]);
    CHECK(json["images"][0]["mimeType"] == "image/png");
    CHECK(json["images"][0].contains("bufferView"));
    CHECK(json["meshes"][0]["extras"]["targetNames"][0] == "smile");
    CHECK(json["extensionsUsed"] == Json::array({"ACME_glow"}));
    CHECK(json["nodes"][0]["skin"] == 0);
    check_same_mesh(mesh, decode_mesh(bytes, "glb"));
    CHECK(encode_mesh(decode_mesh(bytes, "glb"), "glb") == bytes);
}

TEST_CASE("faces go back to their node, whose transform stays") {
    GltfFile file;
    const int node = file.add_mesh(file.square_primitive());
    file.json["nodes"][node].update(
        {{"name", "a"}, {"translation", {4, 0, 0}}, {"scale", {2, 2, 2}}});
    Mesh mesh = file.load();
    mesh.set_position(0, Vec3(0, 0, 8));
    const std::string bytes = encode_mesh(mesh, "glb");
    CHECK(json_of_glb(bytes)["nodes"] == file.json["nodes"]);
    check_same_geometry(mesh, decode_mesh(bytes, "glb"));
}

TEST_CASE("labels without a node get one, and nodes without faces lose their mesh") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    Mesh mesh = file.load();
    mesh.attributes().labels()["object"].names[0] = "new";
    const Json json = json_of_glb(encode_mesh(mesh, "glb"));
    REQUIRE(json["nodes"].size() == 2);
    CHECK_FALSE(json["nodes"][0].contains("mesh"));
    CHECK(json["nodes"][1]["name"] == "new");
    CHECK(json["scenes"][0]["nodes"] == Json::array({0, 1}));
}

TEST_CASE("appended files keep their nodes, skins and materials apart") {
    Mesh mesh = rich_file().load();
    GltfFile other = rich_file();
    other.json["materials"][0]["doubleSided"] = true;
    append(mesh, other.load());
    const std::string bytes = encode_mesh(mesh, "glb");
    const Json json = json_of_glb(bytes);
    CHECK(json["nodes"].size() == 8);
    CHECK(json["nodes"][4]["skin"] == 1);
    CHECK(json["nodes"][7]["camera"] == 1);
    CHECK(json["skins"][1]["joints"] == Json::array({5, 6}));
    CHECK(json["animations"][1]["channels"][0]["target"]["node"] == 6);
    CHECK(json["textures"][1]["source"] == 1);
    CHECK(json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] == 1);
    CHECK(json["scenes"][0]["nodes"] == Json::array({0, 1, 3, 4, 5, 7}));
    const Mesh again = decode_mesh(bytes, "glb");
    check_same_geometry(mesh, again);
    CHECK(label_of_each_face(again, "material") == label_of_each_face(mesh, "material"));
    CHECK(label_of_each_face(again, "object") == label_of_each_face(mesh, "object"));
}

TEST_CASE("weights sum to one and name no joint twice") {
    Mesh mesh = narrow_prism(4);
    const Index count = mesh.vertex_count();
    std::vector<double> joints, weights;
    for (Index v = 0; v < count; ++v) {
        joints.insert(joints.end(), {3.0, 3.0, 1.0, 0.0});
        weights.insert(weights.end(), {1.0, 1.0, 2.0, 0.0});
    }
    add(mesh, "joints", Domain::vertex, 4, joints, ScalarType::uint8);
    add(mesh, "weights", Domain::vertex, 4, weights);
    const Mesh again = round_trip(mesh, "glb");
    const auto w = again.attributes().find("weights")->at(0);
    CHECK(w[0] == 0.5);
    CHECK(w[1] == 0.0);
    CHECK(w[2] == 0.5);
}

TEST_CASE("a polygon that no fan covers is put together again") {
    // A comb with two notches: no corner sees all others.
    const std::vector<Vec3> positions{{0, 0, 0}, {6, 0, 0}, {6, 3, 0},   {5, 3, 0}, {4.5, 1, 0},
                                      {4, 3, 0}, {2, 3, 0}, {1.5, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    FaceList faces;
    faces.add({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    const Mesh mesh(positions, faces);
    LoggedContext logged;
    const Mesh again = decode_mesh(encode_mesh(mesh, "glb", {}, logged.context), "glb");
    CHECK(logged.log().empty());
    CHECK(json_of_glb(encode_mesh(mesh, "glb"))["accessors"].back()["count"] == 24);
    CHECK(again.topology().faces().vertices == mesh.topology().faces().vertices);
    CHECK(again.face_count() == 1);
}

TEST_CASE("extras of a surface that another program changed are left out") {
    Mesh mesh = narrow_prism(4);
    add_labels(mesh, "group", {"a", "b"}, 2);
    Json json = Json::parse(encode_mesh(mesh, "gltf"));
    json["meshes"][0]["extras"]["lissom"]["faces"] = 5;
    const Mesh again = decode_mesh(json.dump(), "gltf");
    CHECK(again.report().find(FindingKind::content_skipped));
    CHECK_FALSE(again.attributes().labels().contains("group"));
    json["meshes"][0]["extras"]["lissom"] = {{"vertices", "x"}, {"labels", 3}};
    CHECK(decode_mesh(json.dump(), "gltf").face_count() == 6);
}

TEST_CASE("every image inside a binary file has a media type") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    const std::vector<std::pair<std::string, std::string>> images{
        {"\x89PNG\r\n\x1a\n..", "image/png"},
        {"\xff\xd8\xff..", "image/jpeg"},
        {"BM......", "image/bmp"},
        {"RIFF....WEBP", "image/webp"},
        {"DDS |...", "image/vnd-ms.dds"},
        {"RIFF", "application/octet-stream"},
        {"what is it", "application/octet-stream"}};
    for (const auto& [bytes, type] : images) {
        const int view = file.view(std::vector<char>(bytes.begin(), bytes.end()));
        file.json["images"].push_back({{"bufferView", view}});
        file.json["textures"].push_back({{"source", file.json["images"].size() - 1}});
    }
    const Json json = json_of_glb(encode_mesh(file.load(), "glb"));
    REQUIRE(json["images"].size() == images.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
        CHECK(json["images"][i]["mimeType"] == images[i].second);
        CHECK(json["images"][i].contains("bufferView"));
    }
}
