// What a glTF file says is what the mesh is.
#include <cmath>
#include <ctime>
#include <functional>

#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

using Faces = std::vector<std::vector<Index>>;

Faces faces_of(const Mesh& mesh) {
    Faces faces;
    for (Index f = 0; f < mesh.face_count(); ++f) faces.push_back(face_of(mesh, f));
    return faces;
}

// Four vertices, joined in a mode.
GltfFile four_points(int mode, const std::vector<std::uint16_t>& indices) {
    GltfFile file;
    Json primitive{
        {"mode", mode},
        {"attributes", {{"POSITION", file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3")}}}};
    if (!indices.empty()) primitive["indices"] = file.indices(indices);
    file.add_mesh(primitive);
    return file;
}

const Attribute& attribute(const Mesh& mesh, const char* name) {
    const Attribute* found = mesh.attributes().find(name);
    REQUIRE_MESSAGE(found, name);
    return *found;
}

}  // namespace

TEST_CASE("every mode of triangles, with and without indices") {
    const Faces strip{{0, 1, 2}, {1, 3, 2}};
    CHECK(faces_of(four_points(5, {}).load()) == strip);
    CHECK(faces_of(four_points(5, {0, 1, 2, 3}).load()) == strip);
    CHECK(faces_of(four_points(4, {0, 1, 2, 1, 3, 2}).load()) == strip);
    CHECK(faces_of(four_points(6, {0, 1, 3, 2}).load()) == Faces{{1, 3, 0}, {3, 2, 0}});
    CHECK(four_points(4, {}).load().face_count() == 1);
    CHECK(four_points(6, {}).load().face_count() == 2);
}

TEST_CASE("triangles that join strips are no faces") {
    const Mesh mesh = four_points(5, {0, 1, 2, 2, 1, 1, 3, 2}).load();
    CHECK(mesh.face_count() == 2);
    CHECK_FALSE(mesh.report().find(FindingKind::faces_collapsed));
}

TEST_CASE("points and lines beside faces are skipped and counted") {
    GltfFile file = four_points(4, {0, 1, 2});
    for (const int mode : {0, 1, 3}) {
        file.json["meshes"][0]["primitives"].push_back(
            {{"mode", mode}, {"attributes", {{"POSITION", 0}}}});
    }
    const Mesh mesh = file.load();
    const Finding* skipped = mesh.report().find(FindingKind::content_skipped);
    REQUIRE(skipped);
    CHECK(skipped->count == 3);
    CHECK(mesh.vertex_count() == 3);
}

TEST_CASE("points alone are vertices") {
    const Mesh mesh = four_points(0, {}).load();
    CHECK(mesh.vertex_count() == 4);
    CHECK(mesh.report().find(FindingKind::points_only));
    const Mesh again = round_trip(mesh, "glb");
    CHECK(again.vertex_count() == 4);
}

TEST_CASE("sparse values replace those of a view, or zeros") {
    GltfFile file;
    const int index_view = file.view<std::uint16_t>({1, 2});
    const int value_view = file.view<float>({5, 0, 0, 0, 5, 0});
    const Json sparse{{"count", 2},
                      {"indices", {{"bufferView", index_view}, {"componentType", kUnsignedShort}}},
                      {"values", {{"bufferView", value_view}}}};
    SUBCASE("zeros") {
        file.json["accessors"].push_back(
            {{"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
        file.add_mesh({{"attributes", {{"POSITION", 0}}}});
        CHECK(file.load().position(0) == Vec3(0, 0, 0));
    }
    SUBCASE("view") {
        file.accessor<float>({1, 1, 1, 2, 2, 2, 3, 3, 3}, kFloat, "VEC3", {{"sparse", sparse}});
        file.add_mesh({{"attributes", {{"POSITION", 0}}}});
        CHECK(file.load().position(0) == Vec3(1, 1, 1));
    }
    const Mesh mesh = file.load();
    CHECK(mesh.position(1) == Vec3(5, 0, 0));
    CHECK(mesh.position(2) == Vec3(0, 5, 0));
}

TEST_CASE("normalized integers are fractions, and elements may lie apart") {
    GltfFile file;
    // Three numbers and one between the elements.
    const int positions = file.accessor<std::int16_t>({0, 0, 0, 9, 32767, 0, 0, 9, 0, -32768, 0, 9},
                                                      kShort, "VEC4", {{"normalized", true}});
    file.json["accessors"][positions]["type"] = "VEC3";
    file.json["bufferViews"][0]["byteStride"] = 8;
    const int uvs = file.accessor<std::uint8_t>({0, 0, 255, 0, 51, 255}, kUnsignedByte, "VEC2",
                                                {{"normalized", true}});
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.add_mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}});
    const Mesh mesh = file.load();
    CHECK(mesh.position(1) == Vec3(1, 0, 0));
    CHECK(mesh.position(2) == Vec3(0, -1, 0));
    CHECK(attribute(mesh, "uv").values == std::vector<double>{0, 1, 1, 1, 0.2, 0});
}

TEST_CASE("attributes have the names of a mesh") {
    GltfFile file;
    Json primitive = file.square_primitive();
    Json& attributes = primitive["attributes"];
    const std::vector<float> pairs{0, 0, 1, 0, 1, 1, 0, 1};
    attributes["TEXCOORD_0"] = file.floats(pairs, "VEC2");
    attributes["TEXCOORD_1"] = file.floats(pairs, "VEC2");
    attributes["COLOR_0"] =
        file.accessor<std::uint8_t>({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 255},
                                    kUnsignedByte, "VEC4", {{"normalized", true}});
    attributes["_AREA"] = file.floats({1, 2, 3, 4}, "SCALAR");
    attributes["_uv"] = file.floats({1, 2, 3, 4}, "SCALAR");
    file.add_mesh(primitive);
    const Mesh mesh = file.load();
    CHECK(attribute(mesh, "uv2").at(2)[1] == 0.0);
    CHECK(attribute(mesh, "color").type == ScalarType::uint8);
    CHECK(attribute(mesh, "color").at(1)[1] == 1.0);
    CHECK(attribute(mesh, "AREA").values == std::vector<double>{1, 2, 3, 4});
    CHECK(attribute(mesh, "_uv").width == 1);
}

TEST_CASE("a mesh used twice is two, where its nodes are") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    file.json["nodes"] = {
        {{"name", "a"}, {"mesh", 0}, {"translation", {5, 0, 0}}},
        {{"name", "a"}, {"mesh", 0}, {"scale", {2, 2, 2}}},
        {{"children", {0, 1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 7, 1}}}};
    const Mesh mesh = file.load();
    CHECK(mesh.vertex_count() == 8);
    CHECK(mesh.position(0) == Vec3(5, 0, 7));
    CHECK(mesh.position(6) == Vec3(2, 2, 7));
    CHECK(label_of_each_face(mesh, "object") == std::vector<std::string>{"a", "a", "a 2", "a 2"});
}

TEST_CASE("a mirrored node turns faces over and keeps normals outside") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["attributes"]["NORMAL"] = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int node = file.add_mesh(primitive);
    file.json["nodes"][node]["scale"] = {1, 1, -1};
    const Mesh mesh = file.load();
    CHECK(face_of(mesh, 0) == std::vector<Index>{0, 2, 1});
    CHECK(attribute(mesh, "normal").at(0)[2] == -1.0);
    check_same_geometry(mesh, round_trip(mesh, "glb"));
}

TEST_CASE("the transform of a skinned node is ignored") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["attributes"]["JOINTS_0"] =
        file.accessor<std::uint8_t>(std::vector<std::uint8_t>(16, 0), kUnsignedByte, "VEC4");
    std::vector<float> weights(16, 0.0f);
    for (std::size_t i = 0; i < 16; i += 4) weights[i] = 1.0f;
    primitive["attributes"]["WEIGHTS_0"] = file.floats(weights, "VEC4");
    const int node = file.add_mesh(primitive);
    file.json["nodes"][node]["translation"] = {9, 9, 9};
    file.json["nodes"][node]["skin"] = 0;
    file.json["nodes"].push_back({{"name", "joint"}});
    file.json["skins"] = {{{"joints", {1}}}};
    const Mesh mesh = file.load();
    CHECK(mesh.position(0) == Vec3(0, 0, 0));
    CHECK(attribute(mesh, "joints").width == 4);
    check_same_geometry(mesh, round_trip(mesh, "glb"));
}

TEST_CASE("only the default scene is read; the rest is reported") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    file.add_mesh(file.square_primitive());
    file.json["scenes"] = {{{"nodes", {0, 1}}}, {{"nodes", {1}}}};
    CHECK(file.load().face_count() == 4);
    file.json["scene"] = 1;
    const Mesh mesh = file.load();
    CHECK(mesh.face_count() == 2);
    CHECK(mesh.report().find(FindingKind::content_skipped));
}

TEST_CASE("meshes without any node are read as they are") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    file.json.erase("nodes");
    CHECK(file.load().face_count() == 2);
}

TEST_CASE("primitives that share vertices are one surface, and lack what they lack") {
    GltfFile file;
    const int positions = file.square();
    const int colors = file.floats(std::vector<float>(12, 0.5f), "VEC3");
    file.json["materials"] = {{{"name", "paint"}}, Json::object()};
    file.add_mesh({{"attributes", {{"POSITION", positions}}},
                   {"indices", file.indices({0, 1, 2})},
                   {"material", 0}});
    file.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}},
         {"indices", file.indices({0, 2, 3})},
         {"material", 1}});
    const Mesh mesh = file.load();
    CHECK(mesh.vertex_count() == 4);
    CHECK(std::isnan(attribute(mesh, "color").at(1)[0]));
    CHECK(attribute(mesh, "color").at(3)[0] == 0.5);
    CHECK(label_of_each_face(mesh, "material") == std::vector<std::string>{"paint", "material 1"});
}

TEST_CASE("seams of texture coordinates become corners of one surface") {
    GltfFile file;
    // Two triangles with vertices of their own along the common edge.
    const int positions =
        file.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int uvs = file.floats({0, 0, 1, 0, 1, 1, .5, .5, 0, 0, 1, 0}, "VEC2");
    file.add_mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}});
    const Mesh mesh = file.load();
    CHECK(mesh.vertex_count() == 4);
    CHECK(attribute(mesh, "uv").domain == Domain::corner);
    check_same_mesh(mesh, round_trip(mesh, "glb"));
}

TEST_CASE("morph targets turn with the node") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["targets"] = {
        {{"POSITION", file.floats({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, "VEC3")}}};
    const int node = file.add_mesh(primitive);
    file.json["nodes"][node]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
    const Mesh mesh = file.load();
    const Attribute& delta = attribute(mesh, "morph.1.position");
    CHECK(delta.at(0)[1] == doctest::Approx(1.0));
    CHECK(delta.at(3)[2] == doctest::Approx(1.0));
}

TEST_CASE("polygons are read where they are encoded") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["extensions"] = {{"FB_ngon_encoding", Json::object()}};
    file.add_mesh(primitive);
    CHECK(faces_of(file.load()) == Faces{{0, 1, 2, 3}});
}

TEST_CASE("copies by EXT_mesh_gpu_instancing are objects of their own") {
    GltfFile file;
    const int node = file.add_mesh(file.square_primitive());
    const int moves = file.floats({0, 0, 0, 0, 0, 3}, "VEC3");
    file.json["nodes"][node]["extensions"] = {
        {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}}}}}};
    const Mesh mesh = file.load();
    CHECK(mesh.face_count() == 4);
    CHECK(mesh.position(4) == Vec3(0, 0, 3));
    CHECK(round_trip(mesh, "glb").face_count() == 4);
}

TEST_CASE("values that are not finite are none, and are counted") {
    GltfFile file;
    Json primitive = file.square_primitive();
    std::vector<float> uvs{0, 0, 1, 0, 1, 1, 0, 1};
    uvs[2] = std::numeric_limits<float>::infinity();
    primitive["attributes"]["TEXCOORD_0"] = file.floats(uvs, "VEC2");
    file.add_mesh(primitive);
    const Mesh mesh = file.load();
    CHECK(std::isnan(attribute(mesh, "uv").at(1)[1]));
    REQUIRE(mesh.report().find(FindingKind::values_not_finite));
    CHECK(mesh.report().find(FindingKind::values_not_finite)->count == 1);
}

TEST_CASE("a binary file is told from a text by its content") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    const std::string glb = encode_mesh(file.load(), "glb");
    CHECK(glb.starts_with("glTF"));
    CHECK(decode_mesh(glb, "gltf").face_count() == 2);
    CHECK(decode_mesh(file.text(), "glb").face_count() == 2);
    CHECK(error_of([&] { decode_mesh(glb, "ply"); }).code() == ErrorCode::file_syntax);
}

TEST_CASE("whole numbers may be written as 4.0") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    const std::string plain = file.text();
    Json json = Json::parse(plain);
    const std::function<void(Json&)> rewrite = [&](Json& value) {
        if (value.is_structured()) {
            for (Json& item : value) rewrite(item);
        } else if (value.is_number_integer()) {
            value = value.get<double>();
        }
    };
    rewrite(json);
    const std::string written = json.dump();
    CHECK(written.find("\"byteLength\":48.0") != std::string::npos);
    check_same_mesh(decode_mesh(written, "gltf"), decode_mesh(plain, "gltf"));
    json["buffers"][0]["byteLength"] = 4.5;
    CHECK(error_of([&] { decode_mesh(json.dump(), "gltf"); }).code() == ErrorCode::file_syntax);
}

TEST_CASE("many labels are joined in a time that grows with their number") {
    constexpr Index kCount = 60000;
    std::vector<Vec3> positions{{0, 0, 0}};
    FaceList faces;
    FaceLabels labels;
    for (Index f = 0; f < kCount; ++f) {
        const double angle = 2.0 * kPi * f / kCount;
        positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        faces.add({0, f + 1, (f + 1) % kCount + 1});
        labels.names.push_back("a group of one face " + std::to_string(f));
        labels.of_face.push_back(f);
    }
    Mesh mesh(std::move(positions), std::move(faces));
    mesh.attributes().labels()["group"] = labels;
    const std::string glb = encode_mesh(mesh, "glb");
    const std::clock_t start = std::clock();
    const Mesh back = decode_mesh(glb, "glb");
    // Each name among those before took 20 times as long.
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 3.0);
    CHECK(back.attributes().labels().at("group").names == labels.names);
}
