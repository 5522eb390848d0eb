// glTF files made to do harm are refused with a code, soon and without taking much memory.
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;
namespace fs = std::filesystem;

namespace {

// A square whose buffer is in another file.
GltfFile square_at(const std::string& uri) {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    file.json["buffers"] = {{{"byteLength", file.bytes.size()}, {"uri", uri}}};
    return file;
}

ErrorCode code_of(const GltfFile& file) {
    return file.error().code();
}

// Saves a file in a folder and loads it from there.
Mesh load_in(const TemporaryFolder& folder, const GltfFile& file) {
    write_bytes(folder / "file.gltf", file.text());
    return load_mesh(folder / "file.gltf");
}

ErrorCode code_in(const TemporaryFolder& folder, const GltfFile& file) {
    return error_of([&] { load_in(folder, file); }).code();
}

std::string glb_of(const std::string& json, const std::string& binary) {
    const auto words = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
    Bytes bytes("glTF");
    bytes.add(std::uint32_t{2}, words(json) + words(binary) + 28, words(json));
    std::string text = std::string(bytes) + "JSON" + json;
    return text + std::string(Bytes().add(words(binary))) + std::string("BIN\0", 4) + binary;
}

ErrorCode glb_code(const std::string& bytes) {
    return error_of([&] { decode_mesh(bytes, "glb"); }).code();
}

}  // namespace

TEST_CASE("a buffer beside the file is read, whatever its name") {
    const TemporaryFolder folder;
    write_bytes(folder / "a b.bin", square_at("").bytes);
    CHECK(load_in(folder, square_at("a%20b.bin")).face_count() == 2);
    CHECK(load_in(folder, square_at("./a b.bin")).face_count() == 2);
}

TEST_CASE("paths that leave the folder are refused") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "inside");
    write_bytes(folder / "secret.bin", square_at("").bytes);
    const std::string absolute = (folder / "secret.bin").string();
    std::vector<std::string> uris{"../secret.bin",      "%2e%2e/secret.bin",  "..%2Fsecret.bin",
                                  "x/../../secret.bin", "..\\secret.bin",     "C:\\secret.bin",
                                  "c:secret.bin",       "file://" + absolute, absolute};
#ifndef _WIN32
    fs::create_symlink(folder / "secret.bin", folder / "inside/link.bin");
    uris.push_back("link.bin");
#endif
    for (const std::string& uri : uris) {
        CAPTURE(uri);
        write_bytes(folder / "inside/file.gltf", square_at(uri).text());
        CHECK(error_of([&] { load_mesh(folder / "inside/file.gltf"); }).code() ==
              ErrorCode::unsafe_path);
    }
}

TEST_CASE("images are held to the folder too, but may be missing") {
    const TemporaryFolder folder;
    GltfFile file;
    file.add_mesh(file.square_primitive());
    fs::create_directories(folder / "inside");
    write_bytes(folder / "picture.png", "\x89PNG\r\n\x1a\nsecret");
    for (const std::string uri :
         {"../picture.png", "..\\picture.png", "%2e%2e/picture.png", "C:\\picture.png",
          "c:/picture.png", "file:///picture.png", "/picture.png", "\\\\host\\picture.png"}) {
        CAPTURE(uri);
        file.json["images"] = {{{"uri", uri}}, {{"uri", uri}}};
        write_bytes(folder / "inside/file.gltf", file.text());
        const LoggedContext logged;
        const Mesh mesh = load_mesh(folder / "inside/file.gltf", {}, logged.context);
        CHECK(mesh.face_count() == 2);
        CHECK(mesh.report().find(FindingKind::files_missing)->count == 2);
        CHECK(std::count(logged.log().begin(), logged.log().end(), '\n') == 1);
        const std::string bytes = encode_mesh(mesh, "glb");
        CHECK(json_of_glb(bytes)["images"][0]["uri"] == uri);
        CHECK(bytes.find("secret") == std::string::npos);
    }
    fs::create_directories(folder / "maps");
    write_bytes(folder / "maps/wood.png", "\x89PNG\r\n\x1a\nwood");
    file.json["images"] = {{{"uri", "maps\\wood.png"}}};
    CHECK(encode_mesh(load_in(folder, file), "glb").find("wood") != std::string::npos);
    fs::remove(folder / "picture.png");
    file.json["images"] = {{{"uri", "picture.png"}}};
    const Mesh mesh = load_in(folder, file);
    CHECK(mesh.report().find(FindingKind::files_missing));
    CHECK(json_of_glb(encode_mesh(mesh, "glb"))["images"][0]["uri"] == "picture.png");
}

TEST_CASE("buffers that cannot be had") {
    const TemporaryFolder folder;
    CHECK(code_in(folder, square_at("https://example.org/a.bin")) == ErrorCode::unsupported);
    CHECK(code_in(folder, square_at("none.bin")) == ErrorCode::file_not_found);
    CHECK(code_in(folder, square_at(".")) == ErrorCode::file_is_directory);
    CHECK(code_of(square_at("a.bin")) == ErrorCode::file_not_found);
    write_bytes(folder / "short.bin", "abc");
    CHECK(code_in(folder, square_at("short.bin")) == ErrorCode::file_truncated);
    CHECK(code_in(folder, square_at("data:;base64,AAAA")) == ErrorCode::file_truncated);
    CHECK(code_in(folder, square_at("data:;base64,!!!!")) == ErrorCode::file_syntax);
}

TEST_CASE("of a file that is larger than its buffer only the beginning is read") {
    const TemporaryFolder folder;
    GltfFile file = square_at("large.bin");
    write_bytes(folder / "large.bin", file.bytes);
    fs::resize_file(folder / "large.bin", std::uintmax_t{1} << 36);
    CHECK(load_in(folder, file).face_count() == 2);
    file.json["buffers"][0]["byteLength"] = std::uint64_t{1} << 62;
    CHECK(code_in(folder, file) == ErrorCode::file_truncated);
}

TEST_CASE("counts beyond the data are refused before memory is taken") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{1} << 31, ~std::uint64_t{0},
                                      ~std::uint64_t{0} / 12 + 1}) {
        CAPTURE(count);
        file.json["accessors"][0]["count"] = count;
        const ErrorCode code = code_of(file);
        CHECK((code == ErrorCode::file_syntax || code == ErrorCode::file_too_large));
    }
}

TEST_CASE("accessors without a view count as well") {
    GltfFile file;
    file.json["accessors"] = {{{"componentType", kFloat}, {"count", 1000000000}, {"type", "VEC3"}}};
    file.add_mesh({{"attributes", {{"POSITION", 0}}}});
    CHECK(code_of(file) == ErrorCode::file_too_large);
}

TEST_CASE("offsets that overflow are refused") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    SUBCASE("of an accessor") {
        file.json["accessors"][0]["byteOffset"] = ~std::uint64_t{0} - 3;
    }
    SUBCASE("of a view") {
        file.json["bufferViews"][0]["byteOffset"] = ~std::uint64_t{0} - 3;
    }
    SUBCASE("length of a view") {
        file.json["bufferViews"][0]["byteLength"] = ~std::uint64_t{0};
    }
    SUBCASE("beyond the view") {
        file.json["accessors"][0]["byteOffset"] = 4;
    }
    SUBCASE("no such view") {
        file.json["accessors"][0]["bufferView"] = 77;
    }
    SUBCASE("no such buffer") {
        file.json["bufferViews"][0]["buffer"] = 77;
    }
    CHECK(code_of(file) == ErrorCode::file_syntax);
}

TEST_CASE("a small file that repeats itself is refused") {
    GltfFile file;
    SUBCASE("by nodes") {
        std::vector<float> many(30000, 0.5f);
        const int positions = file.floats(many, "VEC3");
        file.add_mesh({{"attributes", {{"POSITION", positions}}}});
        for (int i = 0; i < 3000; ++i) file.json["nodes"].push_back({{"mesh", 0}});
    }
    SUBCASE("by attributes") {
        std::vector<float> many(300000, 0.5f);
        const int positions = file.floats(many, "VEC3");
        Json wide{{"attributes", {{"POSITION", positions}}}};
        for (int i = 0; i < 2000; ++i) wide["attributes"]["_A" + std::to_string(i)] = positions;
        file.add_mesh(wide);
    }
    CHECK(code_of(file) == ErrorCode::file_too_large);
}

TEST_CASE("of copies that would be too many one is kept, and that is said") {
    GltfFile file;
    const int node = file.add_mesh(file.square_primitive());
    file.json["accessors"].push_back(
        {{"componentType", kFloat}, {"count", 900000}, {"type", "VEC3"}});
    file.json["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", file.json["accessors"].size() - 1}};
    const Mesh mesh = file.load();
    CHECK(mesh.face_count() == 2);
    CHECK(mesh.report().find(FindingKind::extensions_dropped));
}

TEST_CASE("indices beyond the vertices, and those that restart") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["indices"] = file.indices({0, 1, 4});
    file.add_mesh(primitive);
    CHECK(code_of(file) == ErrorCode::face_index);
    file.json["meshes"][0]["primitives"][0]["indices"] = file.indices({0, 1, 65535});
    CHECK(code_of(file) == ErrorCode::file_syntax);
}

TEST_CASE("sparse indices beyond the elements are refused") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    const int indices = file.view<std::uint16_t>({4});
    const int values = file.view<float>({1, 2, 3});
    file.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", values}}}};
    CHECK(code_of(file) == ErrorCode::file_syntax);
    file.json["accessors"][0]["sparse"]["count"] = -1;
    CHECK(code_of(file) == ErrorCode::file_syntax);
}

TEST_CASE("nodes that are no trees are refused") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    Json& nodes = file.json["nodes"];
    SUBCASE("a cycle") {
        nodes.push_back({{"children", {2}}});
        nodes.push_back({{"children", {1}}});
    }
    SUBCASE("its own child") {
        nodes[0]["children"] = {0};
    }
    SUBCASE("two parents") {
        nodes.push_back({{"children", {0}}});
        nodes.push_back({{"children", {0}}});
    }
    SUBCASE("no such child") {
        nodes[0]["children"] = {7};
    }
    SUBCASE("no such mesh") {
        nodes[0]["mesh"] = 7;
    }
    SUBCASE("too deep") {
        for (int i = 1; i < 1500; ++i) {
            nodes.push_back(Json::object());
            nodes[i - 1]["children"] = {i};
        }
    }
    SUBCASE("a transform that is none") {
        nodes[0]["scale"] = {1, 2};
    }
    CHECK(code_of(file) == ErrorCode::file_syntax);
}

TEST_CASE("the elements of a file count on the account before they are read") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    for (int i = 1; i < 20000; ++i) file.json["nodes"].push_back(Json::object());
    const std::string text = file.text();
    const auto loaded = [&](std::size_t megabytes) {
        ContextOptions options;
        options.memory_limit = megabytes << 20;
        const Context context(options);
        return decode_mesh(text, "gltf", {}, context);
    };
    CHECK(loaded(64).vertex_count() == 4);
    CHECK(error_of([&] { loaded(8); }).code() == ErrorCode::memory_limit);
}

TEST_CASE("more attributes than a mesh can have are refused") {
    GltfFile file;
    Json primitive = file.square_primitive();
    for (int i = 0; i < 40000; ++i) {
        primitive["attributes"]["_" + std::to_string(i)] = primitive["attributes"]["POSITION"];
    }
    file.add_mesh(primitive);
    CHECK(code_of(file) == ErrorCode::invalid_argument);
}

TEST_CASE("JSON that would exhaust the stack is refused") {
    GltfFile file;
    std::string deep(200000, '[');
    CHECK(error_of([&] { decode_mesh("{\"extras\":" + deep, "gltf"); }).code() ==
          ErrorCode::file_syntax);
    std::string closed;
    for (int i = 0; i < 70; ++i) closed = "[" + closed + "]";
    CHECK(error_of([&] {
              decode_mesh("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + closed + "}", "gltf");
          }).code() == ErrorCode::file_syntax);
}

TEST_CASE("what is no glTF file is told as that, and no error of JSON") {
    for (const char* bytes : {"\x7f\x45LF", "glT", "solid cube", " "}) {
        const Error error = error_of([&] { decode_mesh(bytes, "glb"); });
        CHECK(error.code() == ErrorCode::file_syntax);
        CHECK(std::string(error.what()).find("no glTF file") != std::string::npos);
    }
    const std::string json = R"({"asset":{"version":"2.0"}})";
    CHECK(decode_mesh("\xEF\xBB\xBF\n" + json, "gltf").vertex_count() == 0);
}

TEST_CASE("binary files that end early, or have too much") {
    const std::string json = R"({"asset":{"version":"2.0"}}  )";
    const std::string good = glb_of(json.substr(0, 28), "abcd");
    CHECK(decode_mesh(good, "glb").vertex_count() == 0);
    for (std::size_t size = 4; size < good.size(); ++size) {
        CHECK(glb_code(good.substr(0, size)) == ErrorCode::file_truncated);
    }
    std::string two = good + good.substr(good.size() - 12);
    two[8] = static_cast<char>(two.size());
    CHECK(glb_code(two) == ErrorCode::file_syntax);
    std::string first = good;
    first[4] = 1;
    CHECK(glb_code(first) == ErrorCode::unsupported);
}

TEST_CASE("versions and extensions that are not known are named") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    file.json["extensionsRequired"] = {"KHR_materials_unlit", "ACME_magic"};
    CHECK(file.error().code() == ErrorCode::unsupported);
    CHECK(file.error().message().find("ACME_magic") != std::string::npos);
    file.json["extensionsRequired"] = {"KHR_materials_unlit"};
    CHECK(file.load().face_count() == 2);
    file.json["asset"]["version"] = "1.0";
    CHECK(file.error().message().find("glTF 1.0") != std::string::npos);
}

TEST_CASE("members of the wrong type are an error, not a crash") {
    GltfFile file;
    file.add_mesh(file.square_primitive());
    file.json["materials"] = {{{"name", "m"}}};
    const Json good = file.json;
    for (const auto& [at, value] :
         std::vector<std::pair<std::string, Json>>{{"/nodes", "x"},
                                                   {"/nodes/0", 3},
                                                   {"/nodes/0/children", {{"a", 1}}},
                                                   {"/nodes/0/mesh", "x"},
                                                   {"/nodes/0/skin", -3},
                                                   {"/meshes/0/primitives", 7},
                                                   {"/meshes/0/primitives/0/attributes", 7},
                                                   {"/meshes/0/primitives/0/mode", 9},
                                                   {"/accessors/0/type", "VEC9"},
                                                   {"/accessors/0/componentType", 1},
                                                   {"/scene", 5},
                                                   {"/scene", "x"},
                                                   {"/materials/0", "x"}}) {
        const std::string& path = at;
        CAPTURE(path);
        file.json = good;
        file.json[Json::json_pointer(path)] = value;
        CHECK(code_of(file) == ErrorCode::file_syntax);
    }
}
