// What 32-bit numbers take from a mesh far from its origin.
#include <cmath>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const Vec3 kFarPlace(500000, 4000000, 100);

// A square of side .01 in 18 x 18 quads, where maps have their places.
Mesh far_grid() {
    GridOptions options;
    options.size = {0.01, 0.01};
    options.segments = {18, 18};
    Mesh mesh = make_grid(options);
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Vec3& p : positions) p += kFarPlace;
    mesh.set_positions(std::move(positions));
    return mesh;
}

SaveOptions moved() {
    SaveOptions options;
    options.origin = FileOrigin::automatic;
    return options;
}

double max_offset(const Mesh& a, const Mesh& b, const Vec3& offset) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v) - offset).norm());
    }
    return greatest;
}

}  // namespace

TEST_CASE("a mesh that 32-bit numbers would collapse is refused with a way out") {
    const Mesh mesh = far_grid();
    for (const char* format : {"stl", "glb", "gltf"}) {
        CAPTURE(format);
        const Error error = error_of([&] { encode_mesh(mesh, format); });
        CHECK(error.code() == ErrorCode::unsupported);
        CHECK(error.message().find("origin = \"auto\"") != std::string::npos);
        CHECK(error.elements().count > 0);
    }
    SaveOptions text;
    text.binary = false;
    CHECK(decode_mesh(encode_mesh(mesh, "stl", text), "stl").face_count() == 2 * 18 * 18);
    for (const char* format : {"ply", "obj", "off"}) {
        CAPTURE(format);
        const Mesh back = decode_mesh(encode_mesh(mesh, format), format);
        CHECK(max_offset(mesh, back, Vec3::Zero()) == 0.0);
    }
}

TEST_CASE("a moved origin keeps the shape, and glTF keeps the place in its node") {
    const Mesh mesh = far_grid();
    LoggedContext logged;
    const std::string glb = encode_mesh(mesh, "glb", moved(), logged.context);
    CHECK(logged.log() == "");
    const Mesh back = decode_mesh(glb, "glb");
    CHECK(back.face_count() == mesh.face_count());
    CHECK(zero_area_faces(back).empty());
    CHECK(max_offset(mesh, back, Vec3::Zero()) < 1e-9);
    const Json node = json_of_glb(glb)["nodes"][0];
    CHECK(node["translation"][0].get<double>() == 500000.0);
    CHECK(node["translation"][1].get<double>() == 4000000.0);
}

TEST_CASE("formats without nodes tell the origin that was moved") {
    const TemporaryFolder folder;
    const Mesh mesh = far_grid();
    for (const char* name : {"a.stl", "a.ply", "a.obj", "a.off"}) {
        CAPTURE(name);
        LoggedContext logged;
        const SavedFile saved = save_mesh(mesh, folder / name, moved(), logged.context);
        CHECK((saved.origin - kFarPlace).norm() < 0.1);
        CHECK(logged.mentions("(500000, 4000000, 100)"));
        const Mesh back = load_mesh(folder / name);
        CHECK(back.vertex_count() == mesh.vertex_count());
        if (std::string(name) != "a.stl") {
            CHECK(max_offset(mesh, back, saved.origin) < 1e-9);
        }
        Box shifted = bounds(back);
        CHECK((shifted.center() + saved.origin - bounds(mesh).center()).norm() < 1e-8);
    }
}

TEST_CASE("the origin counts in the mesh's own axes and unit") {
    const TemporaryFolder folder;
    const Mesh mesh = far_grid();
    SaveOptions options = moved();
    options.up = UpAxis::z;
    options.unit = 0.001;
    const Vec3 origin = save_mesh(mesh, folder / "a.ply", options).origin;
    LoadOptions load;
    load.up = UpAxis::z;
    load.unit = 0.001;
    const Mesh back = load_mesh(folder / "a.ply", load);
    CHECK(max_offset(mesh, back, origin) < 1e-9);
}

TEST_CASE("a mesh at its origin is saved as it is") {
    const Mesh mesh = make_head();
    for (const char* format : {"stl", "glb", "ply", "obj", "off"}) {
        CAPTURE(format);
        CHECK(encode_mesh(mesh, format, moved()) == encode_mesh(mesh, format));
    }
}

TEST_CASE("saving with a moved origin twice moves it once") {
    const Mesh mesh = far_grid();
    const Mesh once = decode_mesh(encode_mesh(mesh, "glb", moved()), "glb");
    const std::string again = encode_mesh(once, "glb", moved());
    CHECK(json_of_glb(again)["nodes"].size() == 1);
    CHECK(max_offset(mesh, decode_mesh(again, "glb"), Vec3::Zero()) < 1e-9);
}

TEST_CASE("an object keeps its node, its children and its label when it is moved below it") {
    GltfFile file;
    const int node = file.add_mesh(file.square_primitive());
    Json& json = file.json["nodes"][static_cast<std::size_t>(node)];
    json["name"] = "plate";
    json["scale"] = {2, 2, 2};
    Mesh mesh = file.load();
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Vec3& p : positions) p = p * 0.001 + kFarPlace;
    mesh.set_positions(std::move(positions));
    CHECK(error_of([&] { encode_mesh(mesh, "glb"); }).code() == ErrorCode::unsupported);
    const std::string glb = encode_mesh(mesh, "glb", moved());
    const Json nodes = json_of_glb(glb)["nodes"];
    REQUIRE(nodes.size() == 2);
    CHECK(nodes[0]["scale"][0] == 2);
    CHECK(nodes[0]["children"] == Json::parse("[1]"));
    CHECK(!nodes[0].contains("mesh"));
    const Mesh back = decode_mesh(glb, "glb");
    CHECK(max_offset(mesh, back, Vec3::Zero()) < 1e-9);
    CHECK(back.attributes().labels().at("object").names == std::vector<std::string>{"plate"});
}

TEST_CASE("points far away are kept by a moved origin") {
    const Mesh mesh({kFarPlace, kFarPlace + Vec3(0.01, 0, 0), kFarPlace + Vec3(0, 0.01, 0)},
                    FaceList());
    const Mesh back = decode_mesh(encode_mesh(mesh, "glb", moved()), "glb");
    CHECK(max_offset(mesh, back, Vec3::Zero()) < 1e-9);
}

TEST_CASE("few faces that rounding flattens are told, and no error") {
    GridOptions options;
    options.segments = {60, 60};
    Mesh mesh = make_grid(options);
    // One quad is so small that single precision sees none of it.
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    const auto face = mesh.topology().face(1000);
    for (std::size_t k = 1; k < face.size(); ++k) {
        positions[face[k]] = positions[face[0]] + 1e-11 * (positions[face[k]] - positions[face[0]]);
    }
    mesh.set_positions(std::move(positions));
    LoggedContext logged;
    encode_mesh(mesh, "glb", {}, logged.context);
    CHECK(logged.mentions("flattened or turned over 1 of 3600 faces"));
    // STL joins the vertices, which changes the surface; moving the origin does not help.
    const Error error = error_of([&] { encode_mesh(mesh, "stl"); });
    CHECK(error.code() == ErrorCode::unsupported);
    CHECK(error.message().find(".ply") != std::string::npos);
    CHECK(error.message().find("auto") == std::string::npos);
}

TEST_CASE("STL refuses points and counts vertices without faces") {
    const Mesh points({{0, 0, 0}, {1, 0, 0}}, FaceList());
    const Error error = error_of([&] { encode_mesh(points, "stl"); });
    CHECK(error.code() == ErrorCode::unsupported);
    CHECK(error.message().find("2 points") != std::string::npos);
    FaceList faces;
    faces.add({0, 1, 2});
    const Mesh mixed({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, std::move(faces));
    LoggedContext logged;
    encode_mesh(mixed, "stl", {}, logged.context);
    CHECK(logged.mentions("1 vertices without faces"));
    CHECK(encode_mesh(Mesh(), "stl").size() == 84);
}
