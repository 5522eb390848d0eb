#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Mesh obj(const std::string& text) {
    return decode_mesh(text, "obj");
}

Error obj_error(const std::string& text) {
    return error_of([&] { obj(text); });
}

// Checks the code and the 1-based line of an error.
void check_error(const std::string& text, ErrorCode code, Index line) {
    CAPTURE(text);
    const Error error = obj_error(text);
    CAPTURE(error.message());
    CHECK(error.code() == code);
    REQUIRE(error.elements().kind == ElementKind::line);
    CHECK(error.elements().ids == std::vector<Index>{line - 1});
    CHECK(error.message().starts_with("line " + std::to_string(line) + ": "));
}

}  // namespace

TEST_CASE("OBJ faces of any size refer to vertices by number, from the start or from the end") {
    const Mesh mesh = obj(kSquare + "v 2 0 0\nf 1 2 3 4\nf -4 -1 -3\n");
    CHECK(mesh.vertex_count() == 5);
    CHECK(face_of(mesh, 0) == std::vector<Index>{0, 1, 2, 3});
    CHECK(face_of(mesh, 1) == std::vector<Index>{1, 4, 2});
}

TEST_CASE("OBJ indices of all forms give corners their values") {
    const Mesh mesh = obj(kSquare +
                          "vt 0.25 0.5\nvt 0.75\nvn 0 0 1\n"
                          "f 1/1/1 2/2/-1 3//1 4/-2\n");
    const Attribute* uv = mesh.attributes().find("uv");
    const Attribute* normal = mesh.attributes().find("normal");
    REQUIRE(uv);
    REQUIRE(normal);
    CHECK(uv->domain == Domain::corner);
    CHECK(same_numbers(uv->values, {0.25, 0.5, 0.75, 0.0, kNan, kNan, 0.25, 0.5}));
    CHECK(same_numbers(normal->values, {0, 0, 1, 0, 0, 1, 0, 0, 1, kNan, kNan, kNan}));
}

TEST_CASE("OBJ attributes that no corner uses are absent") {
    CHECK(obj(kSquare + "vt 0 0\nvn 0 0 1\nf 1 2 3\n").attributes().all().empty());
}

TEST_CASE("OBJ indices may refer to what comes later in the file") {
    const Mesh mesh = obj("f 1/1 2/1 3/1\n" + kSquare + "vt 0.5 0.5\n");
    CHECK(mesh.face_count() == 1);
    CHECK(mesh.attributes().find("uv")->values[0] == 0.5);
}

TEST_CASE("OBJ is read whatever its blanks, comments and line ends") {
    const Mesh expected = obj(kSquare + "f 1 2 3 4\n");
    for (const std::string& text : {
             std::string("v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n"),
             std::string("v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4"),
             std::string("# c\n\n \tv\t0 0  0 \n\tv 1 0 0#c\nv 1 1 0 # c\nv 0 1 0\n\n  f 1 2 3 4"),
             std::string("v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\\\n 3 4\n"),
             std::string("v +0 0 0\nv 1.0 0e5 0\nv 1E0 +1. 0\nv 0 1 .0\nf +1 2 3 4 "),
         }) {
        CAPTURE(text);
        check_same_mesh(obj(text), expected);
    }
}

TEST_CASE("OBJ vertices may have a weight, which is skipped with a word about it") {
    LoggedContext logged;
    const Mesh mesh =
        decode_mesh("v 0 0 0 1\nv 1 0 0 2\nv 0 1 0 0.5\nf 1 2 3\n", "obj", {}, logged.context);
    CHECK(mesh.position(1) == Vec3(1, 0, 0));
    CHECK(mesh.attributes().all().empty());
    CHECK(logged.mentions("2 weights of vertices"));
}

TEST_CASE("OBJ vertices may have colours, some or all of them") {
    const Mesh mesh = obj("v 0 0 0\nv 1 0 0 1 0.5 0.25\nv 0 1 0\nf 1 2 3\n");
    const Attribute* color = mesh.attributes().find("color");
    REQUIRE(color);
    CHECK(color->domain == Domain::vertex);
    CHECK(color->width == 3);
    CHECK(same_numbers(color->values, {kNan, kNan, kNan, 1, 0.5, 0.25, kNan, kNan, kNan}));
    const Mesh bytes = obj("v 0 0 0 255 51 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
    CHECK(bytes.attributes().find("color")->type == ScalarType::uint8);
    CHECK(bytes.attributes().find("color")->values[1] == 0.2);
    const Mesh with_alpha = obj("v 0 0 0 1 1 1\nv 1 0 0 1 0.5 0.25 0.5\nv 0 1 0\nf 1 2 3\n");
    CHECK(same_numbers(with_alpha.attributes().find("color")->values,
                       {1, 1, 1, 1, 1, 0.5, 0.25, 0.5, kNan, kNan, kNan, kNan}));
}

TEST_CASE("OBJ names of groups, objects, materials and smoothing hold until the next") {
    const Mesh mesh = obj(kSquare +
                          "v 2 0 0\nv 2 1 0\no left side\ng a  b\nusemtl red # 1\ns 1\nf 1 2 3\n"
                          "g\ns 0\nf 1 3 4\ng #c\nusemtl blue\no right\ns off\nf 2 5 3\nf 5 6 3\n");
    const auto labels = [&](const char* kind) { return label_of_each_face(mesh, kind); };
    using Names = std::vector<std::string>;
    CHECK(labels("object") == Names{"left side", "left side", "right", "right"});
    CHECK(labels("group") == Names{"a b", "", "#c", "#c"});
    CHECK(labels("material") == Names{"red # 1", "red # 1", "blue", "blue"});
    CHECK(labels("smoothing") == Names{"1", "off", "off", "off"});
}

TEST_CASE("OBJ names that no face has leave no trace") {
    const Mesh mesh = obj("o unused\n" + kSquare + "o used\nf 1 2 3\ng after\n");
    CHECK(mesh.attributes().labels().size() == 1);
    CHECK(mesh.attributes().labels().at("object").names == std::vector<std::string>{"used"});
}

TEST_CASE("OBJ material files are kept, with blanks in their names") {
    const Mesh mesh = obj("mtllib a.mtl my file.mtl\nmtllib other\n" + kSquare + "f 1 2 3\n");
    CHECK(mesh.material_libraries() == std::vector<std::string>{"a.mtl", "my file.mtl", "other"});
}

TEST_CASE("OBJ statements without a place in a mesh are skipped and counted") {
    LoggedContext logged;
    const Mesh mesh =
        decode_mesh(kSquare + "l 1 2\nl 2 3 \\\n 4\np 1\nvp 0 0\nmy_ext x y\nf 1 2 3\n", "obj", {},
                    logged.context);
    CHECK(mesh.face_count() == 1);
    CHECK(logged.mentions("2 lines"));
    CHECK(logged.mentions("1 points"));
    CHECK(logged.mentions("1 of 'my_ext'"));
}

TEST_CASE("OBJ errors name the line") {
    check_error(kSquare + "f 1 2 5\n", ErrorCode::face_index, 5);
    check_error(kSquare + "f 1 2 0\n", ErrorCode::face_index, 5);
    check_error(kSquare + "\n#\nf 1 2 -5\n", ErrorCode::face_index, 7);
    check_error(kSquare + "f 1 2 99999999999999999999\n", ErrorCode::face_index, 5);
    check_error(kSquare + "f 1 2 -99999999999999999999\n", ErrorCode::face_index, 5);
    check_error(kSquare + "f 1 2 2147483648\n", ErrorCode::face_index, 5);
    check_error(kSquare + "f 1 2 3.5\n", ErrorCode::file_syntax, 5);
    check_error(kSquare + "f 1 2 x\n", ErrorCode::file_syntax, 5);
    check_error(kSquare + "f 1/x 2 3\n", ErrorCode::file_syntax, 5);
    check_error("v 0 0\n", ErrorCode::file_syntax, 1);
    check_error("v 0 0 0\r\nv 0 0 zero\r\n", ErrorCode::file_syntax, 2);
    check_error("v 0 0 0 1 1\n", ErrorCode::file_syntax, 1);
    check_error("v 0 0 0 1 1 1 1 1\n", ErrorCode::file_syntax, 1);
    check_error("vt 0 0 0 0\n", ErrorCode::file_syntax, 1);
    check_error("vn 0 0\n", ErrorCode::file_syntax, 1);
    check_error("v 0 0 0\n\x01\x02\n", ErrorCode::file_syntax, 2);
}

TEST_CASE("OBJ corners that refer to values which do not exist have none, and are counted") {
    for (const char* dangling : {"2", "0", "-2", "3000000000", "-3000000000", "9223372036854775807",
                                 "-9223372036854775808", "99999999999999999999"}) {
        CAPTURE(dangling);
        const Mesh mesh =
            obj(kSquare + "vt 0.5 0.25\nf 1/1 2/" + dangling + " 3\nf 1/-1 3 4/" + dangling + "\n");
        CHECK(same_numbers(mesh.attributes().find("uv")->values,
                           {.5, .25, kNan, kNan, kNan, kNan, .5, .25, kNan, kNan, kNan, kNan}));
        const Finding* finding = mesh.report().find(FindingKind::indices_dangling);
        REQUIRE(finding);
        CHECK(finding->count == 2);
        CHECK(finding->element == ElementKind::line);
        CHECK(finding->in_file);
        CHECK(finding->ids == std::vector<Index>{5, 6});
        CHECK(finding->message == "texture coordinates on lines 6 and 7");
    }
    const Mesh normals = obj(kSquare + "f 1//1 2//1 3//1\n");
    CHECK(normals.attributes().all().empty());
    CHECK(normals.report().find(FindingKind::indices_dangling)->count == 3);
}

TEST_CASE("OBJ values that are not finite are absent, and counted") {
    const Mesh mesh =
        obj("v 0 0 0 nan 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 1 inf 1\nvt nan 0\nvt 1 1e999\n"
            "vt 1 1\nvn 0 0 -inf\nf 1/1/1 2/2/1 3/3/1\n");
    CHECK(same_numbers(mesh.attributes().find("uv")->values, {kNan, kNan, kNan, kNan, 1, 1}));
    CHECK(same_numbers(mesh.attributes().find("color")->values,
                       {kNan, kNan, kNan, 1, .5, 0, kNan, kNan, kNan}));
    const Finding* finding = mesh.report().find(FindingKind::values_not_finite);
    REQUIRE(finding);
    CHECK(finding->count == 5);
    CHECK(finding->message ==
          "texture coordinates on lines 4 and 5; normals on line 7; colours on lines 1 and 3");
}

TEST_CASE("OBJ regions are groups of points, and label no faces") {
    const Mesh mesh = obj(kSquare +
                          "f 1 2 3 4\ng region:left%20h\u00e4nd\np 1 -1\np 3\ng region:none\n"
                          "g region:faces\nf 4 3 2 5\ng other\np 1\nv 2 0 0\n");
    using Names = std::vector<std::string>;
    CHECK(label_of_each_face(mesh, "group") == Names{"", "region:faces"});
    REQUIRE(mesh.regions().size() == 2);
    REQUIRE(mesh.find_region("left h\u00e4nd"));
    CHECK(mesh.find_region("left h\u00e4nd")->vertices() == std::vector<Index>{0, 2, 3});
    CHECK(mesh.find_region("none")->empty());
    CHECK(mesh.report().find(FindingKind::content_skipped)->message == "1 points");
    check_error(kSquare + "f 1 2 3\ng region:a\np 9\n", ErrorCode::face_index, 7);
    check_error(kSquare + "f 1 2 3\ng region:a\np 0\n", ErrorCode::face_index, 7);
}

TEST_CASE("OBJ regions have short lines") {
    Mesh mesh = prism(120);
    mesh.set_region("all", Region::all(mesh.shared_topology()));
    const std::string text = encode_mesh(mesh, "obj");
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = text.find("\np ", at)) != std::string::npos; ++at) ++lines;
    CHECK(lines == 5);
    CHECK(decode_mesh(text, "obj").find_region("all")->size() == 240);
}

TEST_CASE("the first of the largest OBJ indices is the one named") {
    check_error(kSquare + "f 1 2 3\nf 1 2 9\nf 1 2 8\nf 1 3 9\n", ErrorCode::face_index, 6);
}

TEST_CASE("text that is not OBJ is refused") {
    check_error("hello world\nthis is no mesh\n", ErrorCode::file_syntax, 1);
    check_error("<html>\n", ErrorCode::file_syntax, 1);
    check_error(std::string("\0\0\0\0", 4), ErrorCode::file_syntax, 1);
}

TEST_CASE("OBJ faces that are no polygons are mended, or refused where nothing may be") {
    CHECK(obj(kSquare + "f 1 2\nf\nf 1 2 2 3\n").face_count() == 1);
    const auto strict_error = [](const std::string& text) {
        return error_of([&] { decode_mesh(text, "obj", {.repair = false}); });
    };
    CHECK(strict_error(kSquare + "f 1 2\n").code() == ErrorCode::face_too_small);
    CHECK(strict_error(kSquare + "f\n").code() == ErrorCode::face_too_small);
    CHECK(strict_error(kSquare + "f 1 2 2\n").code() == ErrorCode::repeated_vertex);
}

TEST_CASE("OBJ positions that are not finite are refused by name") {
    for (const char* bad : {"nan", "inf", "-inf", "1e999"}) {
        const Error error =
            obj_error("v 0 0 0\nv 1 0 0\nv 0 " + std::string(bad) + " 0\nf 1 2 3\n");
        CHECK(error.code() == ErrorCode::not_finite);
        CHECK(error.elements().ids == std::vector<Index>{2});
    }
}

TEST_CASE("OBJ values are written once, however many corners have them") {
    Mesh mesh = prism(4);
    mesh.attributes().add({"uv", Domain::corner, 2, ScalarType::float64,
                           std::vector<double>(2 * mesh.topology().corner_count(), 0.5)});
    const std::string text = encode_mesh(mesh, "obj");
    CHECK(text.find("vt 0.5 0.5\n") != std::string::npos);
    CHECK(text.find("vt") == text.rfind("vt"));
}

TEST_CASE("vertex attributes become corner values in OBJ") {
    Mesh mesh = prism(3);
    mesh.attributes().add({"uv", Domain::vertex, 2, ScalarType::float64, numbers(12, 1)});
    const Mesh back = round_trip(mesh, "obj");
    const Attribute* uv = back.attributes().find("uv");
    REQUIRE(uv);
    REQUIRE(uv->domain == Domain::corner);
    for (Index c = 0; c < back.topology().corner_count(); ++c) {
        const Index v = back.topology().faces().vertices[c];
        CHECK(uv->at(c)[0] == mesh.attributes().find("uv")->at(v)[0]);
    }
}

TEST_CASE("names cannot break the lines of an OBJ file") {
    Mesh mesh = prism(3);
    FaceLabels labels;
    labels.of_face = {0, 0, 0, 0, 0};
    labels.names = {"two\nlines\\"};
    mesh.attributes().labels()["object"] = labels;
    CHECK(label_of_each_face(round_trip(mesh, "obj"), "object")[0] == "two_lines_");
}

TEST_CASE("polypaint in comments is the colour of the vertices") {
    const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const Mesh mesh = decode_mesh(plain + "#MRGB ffff0000FF00ff00\n#MRGB 000000ff\n", "obj");
    const Attribute* color = mesh.attributes().find("color");
    REQUIRE(color);
    CHECK(color->values == std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
    CHECK(color->type == ScalarType::uint8);
    CHECK(mesh.report().find(FindingKind::content_skipped)->message.find("1 masks") !=
          std::string::npos);
    // Colours of the vertices themselves count more; a comment about polypaint is none.
    const Mesh own =
        decode_mesh("v 0 0 0 0.5 0.5 0.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#MRGB ffff0000\n", "obj");
    CHECK(own.attributes().find("color")->at(0)[0] == 0.5);
    CHECK_FALSE(decode_mesh(plain + "# see #MRGB ffff0000\n", "obj").attributes().find("color"));
    CHECK(decode_mesh(plain + "#MRGB ffff0000\n", "obj").report().findings().empty());
    CHECK(std::isnan(
        decode_mesh(plain + "#MRGB ffff0000\n", "obj").attributes().find("color")->at(1)[0]));
    for (const char* damaged : {"#MRGB ffff000\n", "#MRGB ffff00zz\n", "#MRGB ffff0000f",
                                "#MRGB \xff\xff\xff\xff\xff\xff\xff\xff",
                                "#MRGB ffffffffffffffffffffffffffffffffffffffff\n"}) {
        CAPTURE(damaged);
        const Mesh read = decode_mesh(plain + damaged, "obj");
        CHECK(read.face_count() == 1);
        CHECK(read.report().find(FindingKind::content_skipped));
    }
    for (const char* none : {"#MRGB", "#MRGB \n"}) {
        CHECK_FALSE(decode_mesh(plain + none, "obj").attributes().find("color"));
    }
}
