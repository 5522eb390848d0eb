#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/gltf/support.h"
#include "tests/unit/io/io_support.h"

namespace lissom::test {
namespace {

// A PNG as far as its first bytes tell.
const std::string kPicture = std::string("\x89PNG\r\n\x1a\n") + "pixels";

constexpr const char* kObj =
    "mtllib cup.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red clay\nf 1 2 3\nusemtl glass\n"
    "f 1 3 4\nusemtl unknown\nf 1 4 2\n";

struct Cup {
    TemporaryFolder folder;

    explicit Cup(const std::string& library) {
        write_bytes(folder / "cup.obj", kObj);
        write_bytes(folder / "cup.mtl", library);
    }
    Mesh load() const { return load_mesh(folder / "cup.obj"); }
    Json json() const { return json_of_glb(encode_mesh(load(), "glb")); }
};

std::size_t count(const Mesh& mesh, FindingKind kind) {
    const Finding* finding = mesh.report().find(kind);
    return finding ? finding->count : 0;
}

}  // namespace

TEST_CASE("materials of a library are saved with a glTF file") {
    const Cup cup(
        "# two\nKd 1 1 1\nnewmtl red clay\nKd 1 0.25 0\nNs 30\nnewmtl glass\nKd 0.5\nd 0.25\n"
        "Ke 0 1 0\nPr 0.125\nPm 1\nillum 2\n");
    const Json json = cup.json();
    REQUIRE(json["materials"].size() == 3);
    const Json& clay = json["materials"][0];
    CHECK(clay["name"] == "red clay");
    CHECK(clay["pbrMetallicRoughness"]["baseColorFactor"] == Json({1.0, 0.25, 0.0, 1.0}));
    CHECK(clay["pbrMetallicRoughness"]["roughnessFactor"] == 0.5);
    CHECK(!clay.contains("alphaMode"));
    const Json& glass = json["materials"][1];
    CHECK(glass["alphaMode"] == "BLEND");
    CHECK(glass["pbrMetallicRoughness"]["baseColorFactor"] == Json({0.5, 0.5, 0.5, 0.25}));
    CHECK(glass["pbrMetallicRoughness"]["roughnessFactor"] == 0.125);
    CHECK(glass["pbrMetallicRoughness"]["metallicFactor"] == 1.0);
    CHECK(glass["emissiveFactor"] == Json({0.0, 1.0, 0.0}));
    CHECK(json["materials"][2]["name"] == "unknown");
}

TEST_CASE("textures pass through untouched, each once") {
    const Cup cup(
        "newmtl red clay\nKd 0.1 0.1 0.1\nmap_Kd -s 2 2 2 -clamp on skin one.png\n"
        "newmtl glass\nmap_Kd skin one.png\nnorm other.png\nmap_Ke skin one.png\n");
    write_bytes(cup.folder / "skin one.png", kPicture);
    write_bytes(cup.folder / "other.png", kPicture + "2");
    const Mesh mesh = cup.load();
    CHECK(mesh.report().find(FindingKind::files_missing) == nullptr);
    const std::string bytes = encode_mesh(mesh, "glb");
    CHECK(bytes.find(kPicture) != std::string::npos);
    const Json json = json_of_glb(bytes);
    CHECK(json["images"].size() == 2);
    CHECK(json["images"][0]["mimeType"] == "image/png");
    CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] ==
          Json({1.0, 1.0, 1.0, 1.0}));
    CHECK(json["materials"][1]["normalTexture"]["index"] == 1);
    CHECK(json["materials"][1]["emissiveTexture"]["index"] == 0);
    CHECK(json["materials"][1]["emissiveFactor"] == Json({1.0, 1.0, 1.0}));
}

TEST_CASE(
    "what is not there, not inside the folder or no picture is reported, and the mesh loads") {
    const Cup cup(
        "newmtl red clay\nmap_Kd gone.png\nnewmtl glass\nmap_Kd ../out.png\nnorm a.tga\n");
    write_bytes(cup.folder / "a.tga", "targa");
    const Mesh mesh = cup.load();
    CHECK(mesh.face_count() == 3);
    CHECK(count(mesh, FindingKind::files_missing) == 2);
    CHECK(mesh.report().find(FindingKind::files_missing)->message.find("outside") !=
          std::string::npos);
    CHECK(count(mesh, FindingKind::content_skipped) == 1);
    CHECK(!cup.json().contains("images"));

    std::filesystem::remove(cup.folder / "cup.mtl");
    CHECK(count(cup.load(), FindingKind::files_missing) == 1);
}

TEST_CASE("garbage in a library is passed over") {
    const Cup cup(std::string(
        "Kd x\nnewmtl red clay\nKd nan 1\nd\nTr 2\nmap_Kd\nmap_Ke -o\n\x01\xff junk\n"));
    const Json json = cup.json();
    CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] ==
          Json({0.8, 0.8, 0.8, 0.0}));
}

TEST_CASE("OBJ keeps the name of the library, and says no loss; PLY the same") {
    const Cup cup("newmtl red clay\nKd 1 0 0\n");
    const Mesh mesh = cup.load();
    for (const char* extension : {"obj", "ply", "glb"}) {
        LoggedContext logged;
        const std::string bytes = encode_mesh(mesh, extension, {}, logged.context);
        CHECK(logged.log().empty());
    }
    LoggedContext logged;
    encode_mesh(mesh, "off", {}, logged.context);
    CHECK(logged.mentions("cup.mtl"));
}

TEST_CASE("materials of appended meshes come along, renamed where they differ") {
    const Cup red("newmtl glass\nKd 1 0 0\n"), green("newmtl glass\nKd 0 1 0\n");
    Mesh mesh = red.load();
    append(mesh, green.load());
    const Json json = json_of_glb(encode_mesh(mesh, "glb"));
    std::vector<Json> colors;
    for (const Json& material : json["materials"]) {
        if (material.contains("pbrMetallicRoughness"))
            colors.push_back(material["pbrMetallicRoughness"]["baseColorFactor"]);
    }
    CHECK(colors == std::vector<Json>{{1.0, 0.0, 0.0, 1.0}, {0.0, 1.0, 0.0, 1.0}});
}

namespace {

// The materials that the libraries of an OBJ file define, and those that it uses.
struct Definitions {
    std::set<std::string> defined, used;

    explicit Definitions(const std::filesystem::path& obj) {
        std::istringstream text(read_bytes(obj));
        for (std::string line; std::getline(text, line);) {
            if (line.starts_with("usemtl ")) used.insert(line.substr(7));
            if (!line.starts_with("mtllib ")) continue;
            REQUIRE(std::filesystem::exists(obj.parent_path() / line.substr(7)));
            std::istringstream library(read_bytes(obj.parent_path() / line.substr(7)));
            for (std::string entry; std::getline(library, entry);) {
                if (entry.starts_with("newmtl ")) defined.insert(entry.substr(7));
            }
        }
    }
    bool are_complete() const {
        return std::includes(defined.begin(), defined.end(), used.begin(), used.end());
    }
};

}  // namespace

TEST_CASE("every usemtl of a saved OBJ is defined beside it: two libraries with one name") {
    const Cup red(
        "newmtl red clay\nKd 1 0 0\nnewmtl glass\nKd 0 0 1\nillum 2\nKs 1 1 1\nmap_Ks gloss.png\n");
    const Cup green("newmtl red clay\nKd 0 1 0\nnewmtl glass\nKd 0 0 1\nillum 2\n");
    Mesh mesh = red.load();
    append(mesh, green.load());
    LoggedContext logged;
    save_mesh(mesh, red.folder / "both.obj", {}, logged.context);
    const Definitions both(red.folder / "both.obj");
    CHECK(both.used.contains("red clay 2"));
    CHECK(both.defined.contains("red clay 2"));
    CHECK_FALSE(both.defined.contains("unknown"));
    CHECK(logged.mentions("'unknown'"));
    CHECK(logged.mentions("gloss.png"));
    CHECK(read_bytes(red.folder / "cup.mtl").starts_with("newmtl red clay"));
    const std::string library = read_bytes(red.folder / "both.mtl");
    CHECK(library.find("illum 2") != std::string::npos);
    CHECK(library.find("Kd 0 1 0") != std::string::npos);
    const Json json = json_of_glb(encode_mesh(load_mesh(red.folder / "both.obj"), "glb"));
    Json expected = json_of_glb(encode_mesh(mesh, "glb"));
    expected["materials"][1]["extras"]["mtl"].erase(2);
    CHECK(json == expected);
}

TEST_CASE("an OBJ that is saved where its libraries are leaves them as they are") {
    const Cup cup(
        "# mine\nnewmtl red clay\nKd 1 0 0\nnewmtl glass\nmap_Kd a.png\nnewmtl unknown\n");
    write_bytes(cup.folder / "a.png", kPicture);
    LoggedContext logged;
    save_mesh(cup.load(), cup.folder / "again.obj", {}, logged.context);
    CHECK(logged.log().empty());
    CHECK(cup.folder.names() ==
          std::vector<std::string>{"a.png", "again.obj", "cup.mtl", "cup.obj"});
    CHECK(Definitions(cup.folder / "again.obj").are_complete());
}

TEST_CASE("an OBJ that is saved elsewhere takes its materials and textures along") {
    const Cup cup(
        "newmtl red clay\nKd 1 0 0\nNs 30\nnewmtl glass\nd 0.5\nmap_Kd maps/skin one.png\n"
        "norm a.png\nnewmtl unknown\nmap_Kd a.png\n");
    std::filesystem::create_directories(cup.folder / "maps");
    write_bytes(cup.folder / "maps/skin one.png", kPicture);
    write_bytes(cup.folder / "a.png", kPicture + "2");
    const TemporaryFolder other;
    // Others' files are never replaced by textures.
    write_bytes(other / "a.png", "someone's");
    LoggedContext logged;
    save_mesh(cup.load(), other / "b.obj", {}, logged.context);
    CHECK(logged.log().empty());
    CHECK(other.names() ==
          std::vector<std::string>{"a 2.png", "a.png", "b.mtl", "b.obj", "skin one.png"});
    CHECK(read_bytes(other / "a.png") == "someone's");
    CHECK(read_bytes(other / "a 2.png") == kPicture + "2");
    CHECK(Definitions(other / "b.obj").are_complete());
    const Mesh back = load_mesh(other / "b.obj");
    CHECK(back.report().find(FindingKind::files_missing) == nullptr);
    Json json = json_of_glb(encode_mesh(back, "glb")),
         old = json_of_glb(encode_mesh(cup.load(), "glb"));
    CHECK(json["materials"] == old["materials"]);
    // Once more changes nothing.
    save_mesh(back, other / "b.obj");
    CHECK(other.names().size() == 5);
    // A library of the same name with other materials is not taken for ours.
    const TemporaryFolder third;
    write_bytes(third / "cup.mtl", "newmtl red clay\nKd 0 0 0\nnewmtl glass\nnewmtl unknown\n");
    save_mesh(cup.load(), third / "b.obj");
    CHECK(read_bytes(third / "b.obj").find("mtllib b.mtl\n") != std::string::npos);
}

TEST_CASE("materials of glTF that MTL can hold are kept in OBJ, and the log names the others") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["material"] = 0;
    file.add_mesh(primitive);
    file.json["images"] = {
        {{"name", "../../odd:name"},
         {"bufferView", file.view(std::vector<char>(kPicture.begin(), kPicture.end()))},
         {"mimeType", "image/png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"name", "wood"},
                               {"alphaMode", "BLEND"},
                               {"emissiveFactor", {0, 0.5, 0}},
                               {"occlusionTexture", {{"index", 0}}},
                               {"pbrMetallicRoughness",
                                {{"baseColorFactor", {1, 0.5, 0.25, 0.5}},
                                 {"metallicFactor", 0.25},
                                 {"roughnessFactor", 0.5},
                                 {"baseColorTexture", {{"index", 0}}}}}}};
    const Mesh mesh = file.load();
    const TemporaryFolder folder;
    LoggedContext logged;
    save_mesh(mesh, folder / "a.obj", {}, logged.context);
    CHECK(logged.mentions("occlusion"));
    CHECK(folder.names() == std::vector<std::string>{"a.mtl", "a.obj", "odd_name.png"});
    CHECK(read_bytes(folder / "odd_name.png") == kPicture);
    const Json json = json_of_glb(encode_mesh(load_mesh(folder / "a.obj"), "glb"));
    const Json& wood = json["materials"][0];
    CHECK(wood["pbrMetallicRoughness"]["roughnessFactor"] == 0.5);
    CHECK(wood["pbrMetallicRoughness"]["metallicFactor"] == 0.25);
    CHECK(wood["emissiveFactor"] == Json({0.0, 0.5, 0.0}));
    CHECK(wood["alphaMode"] == "BLEND");
    CHECK(wood["pbrMetallicRoughness"].contains("baseColorTexture"));
    CHECK(read_bytes(folder / "a.mtl").find("Kd 1 0.5 0.25") != std::string::npos);
}

TEST_CASE("a picture that was not found keeps its name from glTF to OBJ") {
    GltfFile file;
    Json primitive = file.square_primitive();
    primitive["material"] = 0;
    file.add_mesh(primitive);
    file.json["images"] = {{{"uri", "maps\\gone%20one.png"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {
        {{"name", "wood"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const TemporaryFolder folder;
    LoggedContext logged;
    save_mesh(file.load(), folder / "a.obj", {}, logged.context);
    CHECK_FALSE(logged.mentions("MTL"));
    CHECK(read_bytes(folder / "a.mtl").find("map_Kd maps/gone one.png\n") != std::string::npos);
}

TEST_CASE("materials of a glTF file made to harm do none in OBJ") {
    for (const Json& material : std::vector<Json>{
             {{"pbrMetallicRoughness", 1}},
             {{"pbrMetallicRoughness", {{"baseColorFactor", "red"}, {"roughnessFactor", nullptr}}}},
             {{"pbrMetallicRoughness",
               {{"baseColorFactor", {1e308, "a", nullptr}}, {"roughnessFactor", 0}}}},
             {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 7}}}}}},
             {{"emissiveTexture", {{"index", -1}}}, {"normalTexture", 3}},
             {{"extras",
               {{"mtl",
                 {"newmtl evil", "Ka 1\nnewmtl evil", "map_Ks ../../etc/passwd", 7, "Ka\\"}}}}},
             {{"extras", {{"mtl", "Ka 1"}}}, {"name", "a\nnewmtl evil"}}}) {
        CAPTURE(material.dump());
        GltfFile file;
        Json primitive = file.square_primitive();
        primitive["material"] = 0;
        file.add_mesh(primitive);
        file.json["materials"] = {material};
        const TemporaryFolder folder;
        std::string text;
        try {
            save_mesh(file.load(), folder / "a.obj");
            CHECK(Definitions(folder / "a.obj").are_complete());
            text = read_bytes(folder / "a.mtl");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::file_syntax);
        }
        CHECK(text.find("\nnewmtl evil") == std::string::npos);
        CHECK(text.find("passwd") == std::string::npos);
    }
}

TEST_CASE("what cannot be written beside an OBJ leaves all files as they were") {
    const Cup cup("newmtl red clay\nKd 1 0 0\nnewmtl glass\nmap_Kd a.png\n");
    write_bytes(cup.folder / "a.png", kPicture);
    const TemporaryFolder other;
    std::filesystem::create_directories(other / "b.obj");
    CHECK_THROWS_AS(save_mesh(cup.load(), other / "b.obj"), Error);
    CHECK(other.names() == std::vector<std::string>{"b.obj"});
    write_bytes(other / "c.mtl", "mine");
    std::filesystem::create_directories(other / "c.obj");
    CHECK_THROWS_AS(save_mesh(cup.load(), other / "c.obj"), Error);
    CHECK(read_bytes(other / "c.mtl") == "mine");
}

}  // namespace lissom::test
