#include "kernel/io/mesh_file.h"

#include "kernel/mesh/measure/measures.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 2 3\nvn 0 0 1\nf 1//1 2//1 3//1\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "end_header\n";
const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kStl = "solid\nendsolid\n";

}  // namespace

TEST_CASE("the extension names the format, in any case") {
    const TemporaryFolder folder;
    const Mesh mesh = prism(5);
    for (const char* name : {"a.obj", "a.OBJ", "a.b.Ply", "a.OfF", "a.STL", "a.glTF", "a.glb"}) {
        CAPTURE(name);
        save_mesh(mesh, folder / name);
        CHECK(load_mesh(folder / name).vertex_count() == mesh.vertex_count());
    }
    CHECK(readable_extensions() ==
          std::vector<std::string>{"obj", "ply", "off", "stl", "gltf", "glb"});
    CHECK(writable_extensions() == readable_extensions());
    CHECK(decode_mesh(kOff, ".OFF").face_count() == 1);
}

TEST_CASE("an unknown extension is refused with those that are known") {
    const TemporaryFolder folder;
    write_bytes(folder / "a.xyz", "x");
    write_bytes(folder / "noextension", "x");
    for (const char* name : {"a.xyz", "noextension"}) {
        const Error error = error_of([&] { load_mesh(folder / name); });
        CHECK(error.code() == ErrorCode::unknown_format);
        CHECK(error.message().find("obj, ply, off, stl") != std::string::npos);
        CHECK(error.message().find(name) != std::string::npos);
        CHECK(error_of([&] { save_mesh(Mesh(), folder / name); }).code() ==
              ErrorCode::unknown_format);
    }
    CHECK(error_of([&] { load_mesh(folder / "none.xyz"); }).code() == ErrorCode::file_not_found);
    CHECK(error_of([&] { load_mesh(folder / ""); }).code() == ErrorCode::file_is_directory);
}

TEST_CASE("errors begin with the path, and the line where there is one") {
    const TemporaryFolder folder;
    const auto path = folder / "bad.obj";
    write_bytes(path, "v 0 0 0\nv 0 0\n");
    const Error error = error_of([&] { load_mesh(path); });
    CHECK(error.message().starts_with(path.string() + ":2: "));
    write_bytes(path, "v 0 0 0\nf 1 1 1\n");
    CHECK(error_of([&] { load_mesh(path, {.repair = false}); })
              .message()
              .starts_with(path.string() + ": "));
}

TEST_CASE("content of another format than the extension says is recognised") {
    const std::string stl = encode_mesh(prism(3), "stl");
    const std::vector<std::pair<std::string, std::string>> contents{
        {kObj, "OBJ"},      {kPly, "PLY"},
        {kOff, "OFF"},      {"COFF BINARY\n", "OFF"},
        {stl, "STL"},       {"solid a\nfacet normal", "STL"},
        {"glTF\2", "glTF"}, {"{\"asset\":{}}", "glTF"}};
    for (const auto& content : contents) {
        std::string own = content.second;
        for (char& c : own) c = static_cast<char>(std::tolower(c));
        for (const std::string& extension : readable_extensions()) {
            if (own == extension || (own == "gltf" && extension == "glb")) continue;
            CAPTURE(extension);
            CAPTURE(own);
            const Error error = error_of([&] { decode_mesh(content.first, extension); });
            CHECK(error.code() == ErrorCode::file_syntax);
            CHECK(error.message().find("looks like " + content.second) != std::string::npos);
        }
    }
}

TEST_CASE("a byte order mark before text is passed over") {
    for (const char* extension : {"obj", "off"}) {
        const std::string& text = std::string_view(extension) == "obj" ? kObj : kOff;
        check_same_mesh(decode_mesh("\xef\xbb\xbf" + text, extension),
                        decode_mesh(text, extension));
    }
}

TEST_CASE("the up axis and the unit are those of the file") {
    const Mesh mesh = decode_mesh(kObj, "obj", {.up = UpAxis::z, .unit = 10.0});
    CHECK(mesh.position(2) == Vec3(0, 30, -20));
    CHECK(mesh.position(1) == Vec3(10, 0, 0));
    CHECK(mesh.attributes().find("normal")->at(0)[1] == 1.0);
    CHECK(decode_mesh(kObj, "obj", {.up = UpAxis::y}).position(2) == Vec3(0, 2, 3));
}

TEST_CASE("saving with the same axis and unit undoes what loading did") {
    const Mesh expected = decode_mesh(kObj, "obj");
    const Mesh mesh = decode_mesh(kObj, "obj", {.up = UpAxis::z, .unit = 0.5});
    const std::string saved = encode_mesh(mesh, "obj", {.up = UpAxis::z, .unit = 0.5});
    check_same_mesh(decode_mesh(saved, "obj"), expected);
    CHECK(mesh.position(2) == Vec3(0, 1.5, -1));
}

TEST_CASE("a turned mesh keeps its orientation") {
    const Mesh mesh = decode_mesh(encode_mesh(prism(4), "obj"), "obj", {.up = UpAxis::z});
    const auto signed_volume = [](const Mesh& m) {
        double sum = 0.0;
        for (Index f = 0; f < m.face_count(); ++f) {
            const auto face = m.topology().face(f);
            for (std::size_t k = 1; k + 1 < face.size(); ++k) {
                Mat3 corners;
                corners << m.position(face[0]), m.position(face[k]), m.position(face[k + 1]);
                sum +=
                    corners(0, 0) *
                        (corners(1, 1) * corners(2, 2) - corners(1, 2) * corners(2, 1)) -
                    corners(0, 1) *
                        (corners(1, 0) * corners(2, 2) - corners(1, 2) * corners(2, 0)) +
                    corners(0, 2) * (corners(1, 0) * corners(2, 1) - corners(1, 1) * corners(2, 0));
            }
        }
        return sum;
    };
    CHECK(signed_volume(mesh) == doctest::Approx(signed_volume(prism(4))));
}

TEST_CASE("a unit must be positive and finite") {
    for (const double unit : {0.0, -1.0, kNan, HUGE_VAL}) {
        CHECK(error_of([&] {
                  decode_mesh(kObj, "obj", {.up = UpAxis::none, .unit = unit});
              }).code() == ErrorCode::invalid_argument);
        CHECK(error_of([&] {
                  encode_mesh(prism(3), "obj", {.up = UpAxis::none, .unit = unit});
              }).code() == ErrorCode::invalid_argument);
    }
}

TEST_CASE("a unit that makes positions infinite is refused by name") {
    CHECK(error_of([] {
              decode_mesh("v 1e300 0 0\n", "obj", {.up = UpAxis::none, .unit = 1e300});
          }).code() == ErrorCode::not_finite);
    const Mesh mesh({Vec3(1e300, 0, 0)}, FaceList());
    CHECK(error_of([&] {
              encode_mesh(mesh, "ply", {.up = UpAxis::none, .unit = 1e-300});
          }).code() == ErrorCode::not_finite);
}

TEST_CASE("a cancelled load throws and a cancelled save leaves the old file") {
    const TemporaryFolder folder;
    const Context context;
    context.cancel();
    for (const std::string& extension : writable_extensions()) {
        CAPTURE(extension);
        const auto path = folder / ("a." + extension);
        save_mesh(prism(3), path);
        const std::string before = read_bytes(path);
        CHECK(error_of([&] { load_mesh(path, {}, context); }).code() == ErrorCode::cancelled);
        CHECK(error_of([&] { save_mesh(prism(4), path, {}, context); }).code() ==
              ErrorCode::cancelled);
        CHECK(read_bytes(path) == before);
    }
    CHECK(folder.names().size() == writable_extensions().size());
}

TEST_CASE("progress grows from 0 to 1 while a mesh is loaded") {
    const TemporaryFolder folder;
    std::vector<Vec3> positions(100000, Vec3(1, 2, 3));
    const Mesh mesh(positions, FaceList());
    for (const std::string& extension :
         {std::string("obj"), std::string("ply"), std::string("off")}) {
        std::vector<double> fractions;
        ContextOptions options;
        options.progress = [&](std::string_view, double fraction) {
            fractions.push_back(fraction);
        };
        const Context context(options);
        decode_mesh(encode_mesh(mesh, extension), extension, {}, context);
        CHECK(fractions.size() > 5);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
        CHECK(fractions.front() == 0.0);
    }
}

TEST_CASE("progress grows from 0 to 1 while a mesh is saved") {
    const TemporaryFolder folder;
    const Mesh mesh(std::vector<Vec3>(100000, Vec3(1, 2, 3)), FaceList());
    for (const char* name : {"a.obj", "a.ply", "a.off"}) {
        std::vector<double> fractions;
        ContextOptions options;
        options.progress = [&](std::string_view, double fraction) {
            fractions.push_back(fraction);
        };
        save_mesh(mesh, folder / name, {}, Context(options));
        CAPTURE(name);
        CHECK(fractions.size() > 5);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
        CHECK(fractions.front() == 0.0);
        CHECK(fractions.back() == doctest::Approx(1.0));
    }
}

TEST_CASE("the memory of a load is charged and released") {
    const TemporaryFolder folder;
    save_mesh(prism(100), folder / "a.obj");
    const Context context;
    load_mesh(folder / "a.obj", {}, context);
    CHECK(context.memory()->peak() > std::filesystem::file_size(folder / "a.obj"));
    CHECK(context.memory()->used() == 0);
}

TEST_CASE("a failed save leaves the old file") {
    const TemporaryFolder folder;
    Mesh mesh = prism(3);
    save_mesh(mesh, folder / "a.stl");
    const std::string before = read_bytes(folder / "a.stl");
    mesh.set_position(0, Vec3(1e300, 0, 0));
    CHECK(error_of([&] { save_mesh(mesh, folder / "a.stl"); }).code() == ErrorCode::not_finite);
    CHECK(read_bytes(folder / "a.stl") == before);
    CHECK(folder.names().size() == 1);
}

TEST_CASE("vertices that no face uses stay in their order if that is asked for") {
    const std::string text =
        "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 8 8 8\nv 0 1 0\nv 7 7 7\nv 1 1 0\nf 2 3 5\nf 3 7 5\n";
    const LoadOptions keep{.unused = UnusedVertices::keep};
    const Mesh dropped = decode_mesh(text, "obj");
    CHECK(dropped.vertex_count() == 4);
    CHECK(dropped.report().find(FindingKind::vertices_unreferenced)->count == 3);
    const Mesh mesh = decode_mesh(text, "obj", keep);
    REQUIRE(mesh.vertex_count() == 7);
    CHECK(mesh.position(0) == Vec3(9, 9, 9));
    CHECK(mesh.position(5) == Vec3(7, 7, 7));
    CHECK(face_of(mesh, 1) == std::vector<Index>{2, 6, 4});
    CHECK(mesh.report().find(FindingKind::vertices_unreferenced) == nullptr);
    for (const char* extension : {"obj", "ply", "off"}) {
        CAPTURE(extension);
        check_same_geometry(decode_mesh(encode_mesh(mesh, extension), extension, keep), mesh);
    }
    CHECK(decode_mesh(text, "obj", {.repair = false, .unused = UnusedVertices::keep})
              .vertex_count() == 7);
    // Faces that are dropped leave their vertices, and what is split gets copies at the end.
    const std::string torn = text + "f 1 4 4\nv 2 2 2\nv 3 3 3\nf 2 8 9\n";
    const Mesh split = decode_mesh(torn, "obj", keep);
    REQUIRE(split.vertex_count() == 10);
    CHECK(split.position(0) == Vec3(9, 9, 9));
    CHECK(split.position(8) == Vec3(3, 3, 3));
    CHECK(split.position(9) == Vec3(0, 0, 0));
    // Regions keep them too.
    const Mesh region = decode_mesh(text + "g region:a\np 1 2 4\n", "obj", keep);
    CHECK(region.find_region("a")->vertices() == std::vector<Index>{0, 1, 3});
}

TEST_CASE("normals of the surface are written if they are asked for and there are none") {
    const Mesh mesh = prism(6);
    for (const char* extension : {"obj", "ply", "off", "glb"}) {
        CAPTURE(extension);
        CHECK_FALSE(round_trip(mesh, extension).attributes().find("normal"));
        const Mesh lit = round_trip(mesh, extension, {.normals = true});
        const Attribute* normal = lit.attributes().find("normal");
        REQUIRE(normal);
        const std::vector<Vec3> expected = vertex_normals(lit);
        for (Index c = 0; c < lit.topology().corner_count(); ++c) {
            const Index v = lit.topology().faces().vertices[c];
            const auto n = normal->at(normal->domain == Domain::corner ? c : v);
            CHECK((Vec3(n[0], n[1], n[2]) - expected[v]).norm() < 1e-6);
        }
    }
    LoggedContext logged;
    encode_mesh(mesh, "stl", {.normals = true}, logged.context);
    CHECK(logged.log().empty());
    Mesh own = mesh;
    own.attributes().add(
        {"normal", Domain::vertex, 3, ScalarType::float32, std::vector<double>(36, 0.25)});
    CHECK(round_trip(own, "ply", {.normals = true}).attributes().find("normal")->at(0)[0] == 0.25);
    // Axes of the file hold for them as well.
    const Mesh turned = round_trip(mesh, "ply", {.up = UpAxis::z, .normals = true});
    CHECK(turned.attributes().find("normal")->at(0)[2] ==
          doctest::Approx(vertex_normals(mesh)[0].y()).epsilon(1e-6));
}
