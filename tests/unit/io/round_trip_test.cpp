// What is saved is what is loaded, for every format and everything that it can hold.
#include "kernel/mesh/region.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

void add(Mesh& mesh, const char* name, Domain domain, Index width, ScalarType type, unsigned seed) {
    const Index count = domain == Domain::vertex   ? mesh.vertex_count()
                        : domain == Domain::corner ? mesh.topology().corner_count()
                                                   : mesh.face_count();
    std::vector<double> values = numbers(count * width, seed);
    if (type == ScalarType::uint8) values = rounded_to_bytes(std::move(values));
    if (type == ScalarType::float32) values = rounded_to_floats(std::move(values));
    mesh.attributes().add({name, domain, width, type, std::move(values)});
}

void clear_element(Mesh& mesh, const char* name, Index element) {
    for (double& value : mesh.attributes().find(name)->at(element)) value = kNan;
}

void add_labels(Mesh& mesh, const char* kind, std::vector<std::string> names) {
    FaceLabels labels;
    labels.names = std::move(names);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        labels.of_face.push_back(f / 2 % static_cast<Index>(labels.names.size()));
    }
    mesh.attributes().labels()[kind] = labels;
}

Mesh obj_mesh(Index n) {
    Mesh mesh = prism(n);
    add(mesh, "color", Domain::vertex, 3, ScalarType::float32, 1);
    add(mesh, "uv", Domain::corner, 2, ScalarType::float64, 2);
    add(mesh, "normal", Domain::corner, 3, ScalarType::float64, 3);
    clear_element(mesh, "color", 1);
    clear_element(mesh, "uv", 2);
    clear_element(mesh, "normal", 3);
    add_labels(mesh, "object", {"one", "two words"});
    add_labels(mesh, "group", {"a b", "c", "d"});
    add_labels(mesh, "material", {"red", "#00ff00"});
    add_labels(mesh, "smoothing", {"1", "off"});
    mesh.attributes().labels()["group"].of_face[1] = kNoIndex;
    mesh.material_libraries() = {"a.mtl", "b c.mtl"};
    return mesh;
}

Mesh ply_mesh(Index n) {
    Mesh mesh = prism(n);
    add(mesh, "normal", Domain::vertex, 3, ScalarType::float32, 1);
    add(mesh, "color", Domain::vertex, 4, ScalarType::uint8, 2);
    add(mesh, "quality", Domain::vertex, 1, ScalarType::float64, 3);
    add(mesh, "weights", Domain::vertex, 3, ScalarType::float32, 4);
    add(mesh, "uv", Domain::corner, 2, ScalarType::float32, 5);
    add(mesh, "face_color", Domain::face, 3, ScalarType::uint8, 6);
    add(mesh, "part", Domain::face, 1, ScalarType::float32, 7);
    clear_element(mesh, "quality", 2);
    for (Index c = mesh.topology().first_corner(1); c < mesh.topology().first_corner(2); ++c) {
        clear_element(mesh, "uv", c);
    }
    return mesh;
}

Mesh off_mesh(Index n) {
    Mesh mesh = prism(n);
    add(mesh, "normal", Domain::vertex, 3, ScalarType::float64, 1);
    add(mesh, "color", Domain::vertex, 3, ScalarType::uint8, 2);
    add(mesh, "uv", Domain::vertex, 2, ScalarType::float64, 3);
    add(mesh, "face_color", Domain::face, 4, ScalarType::float32, 4);
    clear_element(mesh, "face_color", 0);
    return mesh;
}

}  // namespace

TEST_CASE("OBJ keeps vertices, polygons, corner values, labels and material files") {
    for (Index n = 3; n < 9; ++n) check_same_mesh(round_trip(obj_mesh(n), "obj"), obj_mesh(n));
}

TEST_CASE("PLY keeps vertices, polygons and attributes with their types, in text and binary") {
    for (Index n = 3; n < 9; ++n) {
        const Mesh mesh = ply_mesh(n);
        check_same_mesh(round_trip(mesh, "ply"), mesh);
        check_same_mesh(round_trip(mesh, "ply", {.endianness = Endianness::big}), mesh);
        check_same_mesh(round_trip(mesh, "ply", {.binary = false}), mesh);
    }
}

TEST_CASE("OFF keeps vertices, polygons, normals, colours and texture coordinates") {
    for (Index n = 3; n < 9; ++n) check_same_mesh(round_trip(off_mesh(n), "off"), off_mesh(n));
}

TEST_CASE("STL keeps the triangles and their order") {
    std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.25, 0.5, 2}};
    FaceList faces;
    faces.add({0, 2, 1});
    faces.add({0, 1, 3});
    faces.add({1, 2, 3});
    faces.add({2, 0, 3});
    const Mesh mesh(positions, faces);
    for (const bool binary : {true, false}) {
        const Mesh back = round_trip(mesh, "stl", {.binary = binary});
        REQUIRE(back.face_count() == 4);
        CHECK(back.vertex_count() == 4);
        for (Index f = 0; f < 4; ++f) {
            for (int k = 0; k < 3; ++k) {
                CHECK(back.position(back.topology().face(f)[k]) ==
                      mesh.position(mesh.topology().face(f)[k]));
            }
        }
    }
}

TEST_CASE("every format keeps a mesh without faces or without vertices") {
    const Mesh points({Vec3(1, 2, 3), Vec3(4, 5, 6)}, FaceList());
    for (const std::string& extension : writable_extensions()) {
        CAPTURE(extension);
        check_same_geometry(round_trip(Mesh(), extension), Mesh());
        if (extension != "stl") check_same_geometry(round_trip(points, extension), points);
    }
    CHECK(round_trip(Mesh(), "stl", {.binary = false}).vertex_count() == 0);
}

TEST_CASE("positions of any size survive in every format with enough digits") {
    std::mt19937_64 generator(1);
    std::vector<Vec3> positions;
    for (int i = 0; i < 300; ++i) {
        Vec3 p;
        for (double& x : p)
            x = std::ldexp(double(generator()) - 9e18, int(generator() % 400) - 200);
        positions.push_back(p);
    }
    positions.emplace_back(5e-324, -1.7976931348623157e308, -0.0);
    const Mesh mesh(positions, FaceList());
    for (const char* extension : {"obj", "ply", "off"}) {
        check_same_geometry(round_trip(mesh, extension), mesh);
        check_same_geometry(round_trip(mesh, extension, {.binary = false}), mesh);
    }
}

TEST_CASE("saving a second time gives the same bytes") {
    for (const std::string& extension : writable_extensions()) {
        const std::string first = encode_mesh(obj_mesh(6), extension);
        const std::string second = encode_mesh(decode_mesh(first, extension), extension);
        CHECK(encode_mesh(decode_mesh(second, extension), extension) == second);
    }
}

TEST_CASE("what a format cannot hold is named when it is saved") {
    Mesh mesh = obj_mesh(4);
    add(mesh, "skin", Domain::corner, 4, ScalarType::float32, 1);
    mesh.set_region("head", Region(mesh.shared_topology(), {0, 1, 2}));
    const auto log_of = [&](const char* extension) {
        LoggedContext logged;
        encode_mesh(mesh, extension, {}, logged.context);
        return logged.log();
    };
    const auto has = [](const std::string& log, const char* text) {
        return log.find(text) != std::string::npos;
    };
    const std::string obj = log_of("obj"), ply = log_of("ply"), off = log_of("off"),
                      stl = log_of("stl");
    CHECK(ply.empty());
    for (const std::string& log : {obj, off, stl}) {
        CHECK(has(log, "attribute 'skin' (corner, width 4)"));
    }
    for (const std::string& log : {off, stl}) CHECK(has(log, "region 'head'"));
    CHECK_FALSE(has(obj, "'uv'"));
    CHECK_FALSE(has(obj, "labels"));
    CHECK_FALSE(has(obj, "region"));
    CHECK(has(off, "attribute 'uv' (corner"));
    CHECK_FALSE(has(off, "attribute 'color'"));
    CHECK(has(stl, "attribute 'color' (vertex"));
}

TEST_CASE("a mesh that a format holds whole is saved without a word") {
    LoggedContext logged;
    encode_mesh(obj_mesh(4), "obj", {}, logged.context);
    encode_mesh(ply_mesh(4), "ply", {}, logged.context);
    encode_mesh(off_mesh(4), "off", {}, logged.context);
    encode_mesh(prism(4), "stl", {}, logged.context);
    CHECK(logged.log().empty());
}

TEST_CASE("PLY keeps attributes whose names would mean something else") {
    Mesh mesh = prism(3);
    unsigned seed = 0;
    for (const char* name : {"x", "red", "position", "a b", "a_b", "a_0", "a_1", "w_2", "100%25",
                             "region_z", "texture_u2", "\u00e4\n", " "}) {
        add(mesh, name, Domain::vertex, 1, ScalarType::float32, ++seed);
    }
    add(mesh, "w", Domain::vertex, 2, ScalarType::float32, ++seed);
    add(mesh, "region_y", Domain::vertex, 2, ScalarType::uint8, ++seed);
    add(mesh, "vertex_index", Domain::face, 1, ScalarType::float32, ++seed);
    add(mesh, "group", Domain::face, 1, ScalarType::float32, ++seed);
    add_labels(mesh, "group", {"a b", "", "\u00e4%\n#"});
    add_labels(mesh, "my kind", {"one"});
    mesh.set_region("z", Region(mesh.shared_topology(), {0, 5}));
    mesh.set_region("left h\u00e4nd", Region(mesh.shared_topology(), {1, 2}));
    mesh.set_region("none", Region(mesh.shared_topology(), {}));
    for (const bool binary : {true, false}) {
        const Mesh back = round_trip(mesh, "ply", {.binary = binary});
        for (const Attribute& attribute : mesh.attributes().all()) {
            CAPTURE(attribute.name);
            const Attribute* found = back.attributes().find(attribute.name);
            REQUIRE(found);
            CHECK(same_numbers(found->values, attribute.values));
        }
        check_same_regions(back, mesh);
        CHECK(label_of_each_face(back, "group") == label_of_each_face(mesh, "group"));
        CHECK(label_of_each_face(back, "my kind") == label_of_each_face(mesh, "my kind"));
    }
}

TEST_CASE("PLY keeps everything that a mesh can have on vertices, corners and faces") {
    Mesh mesh = prism(5);
    unsigned seed = 0;
    const auto floats = [&](const char* name, Domain domain, Index width) {
        add(mesh, name, domain, width, ScalarType::float32, ++seed);
    };
    floats("uv", Domain::vertex, 2);
    floats("uv2", Domain::vertex, 2);
    floats("uv10", Domain::vertex, 2);
    floats("uv3", Domain::corner, 2);
    floats("uv4", Domain::face, 2);
    floats("tangent", Domain::vertex, 4);
    floats("joints", Domain::vertex, 8);
    floats("weights", Domain::vertex, 8);
    floats("morph.1.position", Domain::vertex, 3);
    floats("morph.2.normal", Domain::corner, 3);
    floats("normal", Domain::corner, 3);
    floats("face_normal", Domain::face, 3);
    add(mesh, "color", Domain::corner, 4, ScalarType::uint8, ++seed);
    add(mesh, "color2", Domain::vertex, 3, ScalarType::uint8, ++seed);
    add(mesh, "face_color", Domain::face, 3, ScalarType::uint8, ++seed);
    for (const Index width : {1, 2, 3, 5, 16}) {
        floats(("v" + std::to_string(width)).c_str(), Domain::vertex, width);
        floats(("c " + std::to_string(width)).c_str(), Domain::corner, width);
        floats(("f." + std::to_string(width)).c_str(), Domain::face, width);
    }
    clear_element(mesh, "normal", 3);
    add_labels(mesh, "object", {"one", "two words"});
    add_labels(mesh, "smoothing", {"off"});
    mesh.attributes().labels()["object"].of_face[3] = kNoIndex;
    mesh.material_libraries() = {"a.mtl", "b c.mtl"};
    mesh.set_region("head", Region(mesh.shared_topology(), {0, 1, 2}));
    for (const bool binary : {true, false}) {
        LoggedContext logged;
        const Mesh back =
            decode_mesh(encode_mesh(mesh, "ply", {.binary = binary}, logged.context), "ply");
        check_same_mesh(back, mesh);
        check_same_regions(back, mesh);
        CHECK(back.report().empty());
        CHECK(logged.log().empty());
    }
}

TEST_CASE("OBJ keeps regions with their names") {
    Mesh mesh = obj_mesh(5);
    for (const char* name : {"plain", "two  words", "\u00e4%20", "back\\", "#1", "a:b"}) {
        mesh.set_region(name, Region(mesh.shared_topology(), {1, 2, 7}));
    }
    const Mesh back = round_trip(mesh, "obj");
    check_same_mesh(back, mesh);
    check_same_regions(back, mesh);
}

TEST_CASE("an attribute that does not fit the mesh is an error, not a crash") {
    Mesh mesh = prism(3);
    mesh.attributes().add({"uv", Domain::corner, 2, ScalarType::float32, {1, 2, 3}});
    CHECK(error_of([&] { encode_mesh(mesh, "obj"); }).code() == ErrorCode::invalid_argument);
    mesh = prism(3);
    mesh.attributes().labels()["group"] = {{"a"}, {0, 0, 0, 0, 1}};
    CHECK(error_of([&] { encode_mesh(mesh, "obj"); }).code() == ErrorCode::invalid_argument);
}
