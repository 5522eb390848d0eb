#include <filesystem>

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

}  // namespace lissom::test
