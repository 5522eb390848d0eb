#include <sstream>

#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const std::string kVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kBody = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string ascii(const std::string& declarations, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + declarations + "end_header\n" + body;
}

Mesh ply(const std::string& text) {
    return decode_mesh(text, "ply");
}

Error ply_error(const std::string& text) {
    return error_of([&] { ply(text); });
}

void check_error(const std::string& text, ErrorCode code, Index line) {
    CAPTURE(text);
    const Error error = ply_error(text);
    CAPTURE(error.message());
    CHECK(error.code() == code);
    CHECK(error.elements().ids == std::vector<Index>{line - 1});
}

const std::vector<double>& values_of(const Mesh& mesh, std::string_view name) {
    const Attribute* attribute = mesh.attributes().find(name);
    REQUIRE(attribute);
    return attribute->values;
}

}  // namespace

TEST_CASE("PLY text is read whatever its comments, line ends and line breaks") {
    const Mesh expected = ply(ascii(kVertices + kFaces, kBody));
    CHECK(expected.position(2) == Vec3(0, 1, 0));
    CHECK(face_of(expected, 0) == std::vector<Index>{0, 1, 2});

    std::string crlf, cr;
    for (const char c : ascii(kVertices + kFaces, kBody)) {
        crlf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    for (const std::string& text :
         {crlf, cr, ascii("comment a\nobj_info b\n\n" + kVertices + "comment c\n" + kFaces, kBody),
          ascii(kVertices + kFaces, "0 0\n0 1 0 0 0 1 0\n\n3\n0\n1\n2"),
          ascii("element vertex 3\nproperty float32 x\nproperty double y\nproperty int8 z\n"
                "element face 1\nproperty list int32 uint16 vertex_index\n",
                kBody),
          ascii(kFaces + kVertices, "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n")}) {
        CAPTURE(text);
        check_same_mesh(ply(text), expected);
    }
}

TEST_CASE("PLY text keeps all digits of its numbers") {
    CHECK(ply(ascii(kVertices + kFaces, "0.123456789012345 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"))
              .position(0)
              .x() == 0.123456789012345);
}

TEST_CASE("binary PLY of both byte orders is read") {
    for (const bool big : {false, true}) {
        Bytes bytes(std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\n" +
                        "element vertex 3\nproperty short x\nproperty double y\nproperty float z\n"
                        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                        "element face 1\nproperty list ushort uint vertex_indices\nend_header\n",
                    big);
        for (int i = 0; i < 3; ++i) {
            bytes.add(std::int16_t(-i), i * i / 3.0, 0.5f, std::uint8_t(i), std::uint8_t(51),
                      std::uint8_t(255));
        }
        bytes.add(std::uint16_t{3}, std::uint32_t{0}, std::uint32_t{1}, std::uint32_t{2});
        const Mesh mesh = ply(bytes);
        CHECK(mesh.position(2) == Vec3(-2, 4 / 3.0, 0.5));
        CHECK(face_of(mesh, 0) == std::vector<Index>{0, 1, 2});
        CHECK(values_of(mesh, "color") ==
              std::vector<double>{0, 0.2, 1, 1 / 255.0, 0.2, 1, 2 / 255.0, 0.2, 1});
    }
}

TEST_CASE("binary PLY data may begin with the byte of a line feed") {
    // 10 is the float32 0x41200000, whose big-endian form begins with 0x41; 0x0a begins 0x0a000000.
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
        const std::string nl = line_end;
        Bytes bytes("ply" + nl + "format binary_little_endian 1.0" + nl + "element vertex 1" + nl +
                    "property uchar x" + nl + "property uchar y" + nl + "property uchar z" + nl +
                    "end_header" + nl);
        bytes.add(std::uint8_t{10}, std::uint8_t{13}, std::uint8_t{10});
        CHECK(ply(bytes).position(0) == Vec3(10, 13, 10));
    }
}

TEST_CASE("PLY properties with a meaning become attributes with a name") {
    const Mesh mesh = ply(
        ascii("element vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n"
              "property float x\nproperty float y\nproperty float z\nproperty float s\n"
              "property float t\nproperty ushort red\nproperty ushort green\nproperty ushort blue\n"
              "property ushort alpha\nproperty float quality\n" +
                  kFaces,
              "0 0 1 0 0 0 .1 .2 65535 0 0 13107 7\n0 0 1 1 0 0 .3 .4 0 65535 0 0 8\n"
              "0 0 1 0 1 0 .5 .6 0 0 65535 0 9\n3 0 1 2\n"));
    CHECK(mesh.position(1) == Vec3(1, 0, 0));
    CHECK(values_of(mesh, "normal") == std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(values_of(mesh, "uv") == std::vector<double>{.1, .2, .3, .4, .5, .6});
    CHECK(mesh.attributes().find("uv")->domain == Domain::vertex);
    CHECK(values_of(mesh, "color") == std::vector<double>{1, 0, 0, 0.2, 0, 1, 0, 0, 0, 0, 1, 0});
    CHECK(mesh.attributes().find("color")->type == ScalarType::uint16);
    CHECK(values_of(mesh, "quality") == std::vector<double>{7, 8, 9});
}

TEST_CASE("PLY texture coordinates go by several names") {
    for (const std::string& names :
         {std::string("s t"), std::string("u v"), std::string("texture_u texture_v")}) {
        const std::size_t blank = names.find(' ');
        const Mesh mesh = ply(ascii(kVertices + "property float " + names.substr(0, blank) +
                                        "\nproperty float " + names.substr(blank + 1) + "\n",
                                    "0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n"));
        CHECK(values_of(mesh, "uv") == std::vector<double>{1, 2, 3, 4, 5, 6});
    }
}

TEST_CASE("PLY faces have texture coordinates, colours and other numbers") {
    const Mesh mesh = ply(
        ascii("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
              "texcoord\n"
              "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int part\n",
              "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 .1 .2 .3 .4 .5 .6 255 0 0 5\n3 0 2 3 0 0 255 "
              "0 6\n"));
    CHECK(same_numbers(values_of(mesh, "uv"),
                       {.1, .2, .3, .4, .5, .6, kNan, kNan, kNan, kNan, kNan, kNan}));
    CHECK(mesh.attributes().find("uv")->domain == Domain::corner);
    CHECK(values_of(mesh, "color") == std::vector<double>{1, 0, 0, 0, 1, 0});
    CHECK(values_of(mesh, "part") == std::vector<double>{5, 6});
    CHECK(mesh.attributes().find("part")->domain == Domain::face);
    CHECK(mesh.attributes().find("part")->type == ScalarType::int32);
}

TEST_CASE("PLY faces and vertices may have properties of the same name") {
    const Mesh mesh =
        ply(ascii(kVertices +
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property float quality\n" +
                      kFaces +
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property float quality\n",
                  "0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 0 1 2 255 255 255 8\n"));
    CHECK(mesh.attributes().find("color")->domain == Domain::vertex);
    CHECK(values_of(mesh, "face_color") == std::vector<double>{1, 1, 1});
    CHECK(values_of(mesh, "face_quality") == std::vector<double>{8});
    check_same_mesh(round_trip(mesh, "ply"), mesh);
}

TEST_CASE("PLY properties with numbers at their end are one attribute") {
    const Mesh mesh =
        ply(ascii(kVertices + "property float w_0\nproperty float w_1\nproperty float w_2\n"
                              "property float a_0\nproperty uchar a_1\nproperty float b_1\n",
                  "0 0 0 1 2 3 4 5 6\n1 0 0 1 2 3 4 5 6\n0 1 0 1 2 3 4 5 6\n"));
    CHECK(values_of(mesh, "w") == std::vector<double>{1, 2, 3, 1, 2, 3, 1, 2, 3});
    CHECK(mesh.attributes().find("w")->width == 3);
    CHECK(mesh.attributes().find("a_0")->width == 1);
    CHECK(mesh.attributes().find("a_1")->width == 1);
    CHECK(mesh.attributes().find("b_1")->width == 1);
}

TEST_CASE("unknown PLY elements and lists are skipped and named") {
    LoggedContext logged;
    const Mesh mesh =
        decode_mesh(ascii("element camera 2\nproperty float a\nproperty list uchar float b\n" +
                              kVertices + "property list uchar int neighbours\nelement empty 3\n" +
                              kFaces + "element tail 1\nproperty int a\n",
                          "1 2 8 9\n1 0\n0 0 0 1 7\n1 0 0 0\n0 1 0 2 8 9\n3 0 1 2\n5\n"),
                    "ply", {}, logged.context);
    CHECK(mesh.position(1) == Vec3(1, 0, 0));
    CHECK(mesh.face_count() == 1);
    CHECK(logged.mentions("'camera'"));
    CHECK(logged.mentions("'neighbours' of 'vertex'"));
    CHECK(logged.mentions("'tail'"));
}

TEST_CASE("PLY labels and regions that are damaged are reported or stay numbers") {
    const std::string start =
        "comment lissom group 0 a%20b\ncomment lissom group 2 c\n"
        "comment lissom\ncomment lissom group\n" +
        kVertices;
    const Mesh mesh = ply(ascii(start + "property uchar region_a\nproperty uchar region_b\n" +
                                    kFaces + "property int group\nproperty int part\n",
                                "0 0 0 0 1\n1 0 0 1 2\n0 1 0 1 0\n3 0 1 2 0 7\n"));
    CHECK(label_of_each_face(mesh, "group") == std::vector<std::string>{"a b"});
    CHECK(mesh.find_region("a")->vertices() == std::vector<Index>{1, 2});
    CHECK_FALSE(mesh.find_region("b"));
    CHECK(values_of(mesh, "region_b") == std::vector<double>{1, 2, 0});
    const Mesh dangling =
        ply(ascii(start + kFaces + "property int group\n", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5\n"));
    CHECK(label_of_each_face(dangling, "group") == std::vector<std::string>{""});
    CHECK(dangling.report().find(FindingKind::indices_dangling)->count == 1);
}

TEST_CASE("infinite values in PLY are absent and counted, NaN is absent") {
    const Mesh mesh =
        ply(ascii(kVertices + "property float s\nproperty float t\nproperty float q\n" + kFaces,
                  "0 0 0 inf 1 nan\n1 0 0 2 3 4\n0 1 0 nan nan 5\n3 0 1 2\n"));
    CHECK(same_numbers(values_of(mesh, "uv"), {kNan, kNan, 2, 3, kNan, kNan}));
    CHECK(mesh.report().find(FindingKind::values_not_finite)->count == 1);
    CHECK(mesh.report().find(FindingKind::values_not_finite)->message == "'uv'");
}

TEST_CASE("lists of PLY faces that are too short or long are counted and absent") {
    const Mesh mesh = ply(ascii(kVertices + kFaces +
                                    "property list uchar float texcoord\n"
                                    "property list uchar float corner_1_heat\n",
                                "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 2 0 0 3 7 8 9\n"));
    CHECK(values_of(mesh, "heat") == std::vector<double>{7, 8, 9});
    CHECK(mesh.report().find(FindingKind::content_skipped)->message ==
          "1 lists of another length than their face");
}

TEST_CASE("PLY triangle strips become triangles") {
    const Mesh mesh =
        ply(ascii("element vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                  "element tristrips 1\nproperty list int int vertex_indices\n",
                  "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 5 5\n9 0 1 2 3 -1 4 2 3 3\n"));
    REQUIRE(mesh.face_count() == 3);
    CHECK(face_of(mesh, 0) == std::vector<Index>{0, 1, 2});
    CHECK(face_of(mesh, 1) == std::vector<Index>{2, 1, 3});
    CHECK(face_of(mesh, 2) == std::vector<Index>{4, 2, 3});
}

TEST_CASE("PLY points without faces are a mesh without faces") {
    const Mesh mesh = ply(ascii(kVertices, "0 0 0\n1 0 0\n0 1 0\n"));
    CHECK(mesh.vertex_count() == 3);
    CHECK(mesh.face_count() == 0);
}

TEST_CASE("PLY headers that cannot be read are refused with their line") {
    check_error("plx\n", ErrorCode::file_syntax, 1);
    check_error("ply\nformat ascii 1.0\nhello\n", ErrorCode::file_syntax, 3);
    check_error("ply\nformat unicode 1.0\n", ErrorCode::file_syntax, 2);
    check_error("ply\nelement vertex 0\nend_header\n", ErrorCode::file_syntax, 3);
    check_error(ascii("property float x\n", ""), ErrorCode::file_syntax, 3);
    check_error(ascii("element vertex many\n", ""), ErrorCode::file_syntax, 3);
    check_error(ascii("element vertex -1\n", ""), ErrorCode::file_syntax, 3);
    check_error(ascii("element vertex 1\nelement vertex 1\n", ""), ErrorCode::file_syntax, 4);
    check_error(ascii("element vertex 1\nproperty quad x\n", ""), ErrorCode::file_syntax, 4);
    check_error(ascii("element vertex 1\nproperty float\n", ""), ErrorCode::file_syntax, 4);
    check_error(ascii("element vertex 1\nproperty list uchar x\n", ""), ErrorCode::file_syntax, 4);
    check_error(ascii("element vertex 10000000000\n", ""), ErrorCode::file_too_large, 3);
    check_error(ascii("element junk 99999999999999999999\n", ""), ErrorCode::file_too_large, 3);
    CHECK(ply_error("ply\nformat ascii 1.0\nelement vertex 1\n").code() ==
          ErrorCode::file_truncated);
    CHECK(ply_error(ascii("", "")).code() == ErrorCode::file_syntax);
    CHECK(ply_error(ascii("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"))
              .code() == ErrorCode::file_syntax);
    CHECK(ply_error(ascii(kVertices + "element face 1\nproperty float a\n", kBody)).code() ==
          ErrorCode::file_syntax);
    std::string many = "element vertex 1\n";
    for (int i = 0; i < 20000; ++i) many += "property float p" + std::to_string(i) + "\n";
    CHECK(ply_error(ascii(many, "")).code() == ErrorCode::file_syntax);
}

TEST_CASE("PLY text that cannot be read is refused with its line") {
    const std::string header = kVertices + kFaces;
    check_error(ascii(header, "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n"), ErrorCode::file_syntax, 11);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), ErrorCode::face_index, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), ErrorCode::face_index, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n3 0 1 1e12\n"), ErrorCode::face_index, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n3 0 1 1e300\n"), ErrorCode::file_syntax, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n3 0 1 nan\n"), ErrorCode::file_syntax, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n3 0 1 0.5\n"), ErrorCode::file_syntax, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), ErrorCode::file_syntax, 13);
    check_error(ascii(header, "0 0 0\n1 0 0\n0 1 0\nnan 0 1 2\n"), ErrorCode::file_syntax, 13);
}

TEST_CASE("binary PLY errors name the face") {
    Bytes bytes("ply\nformat binary_little_endian 1.0\n" + kVertices + kFaces + "end_header\n");
    for (int i = 0; i < 9; ++i) bytes.add(float(i * i));
    bytes.add(std::uint8_t{3}, std::int32_t{0}, std::int32_t{1}, std::int32_t{7});
    const Error error = ply_error(bytes);
    CHECK(error.code() == ErrorCode::face_index);
    CHECK(error.elements().kind == ElementKind::face);
    CHECK(error.elements().ids == std::vector<Index>{0});
}

TEST_CASE("PLY that ends early tells how much was found") {
    const auto message = [](const std::string& text) {
        const Error error = ply_error(text);
        CHECK(error.code() == ErrorCode::file_truncated);
        return error.message();
    };
    CHECK(message(ascii(kVertices + kFaces, "0 0 0\n1 0")).find("1 of 3 vertices") !=
          std::string::npos);
    CHECK(message(ascii(kVertices + kFaces, "0 0 0\n1 0 0\n0 1 0\n3 0")).find("0 of 1 faces") !=
          std::string::npos);
    CHECK(
        message(ascii(kVertices + kFaces, "0 0 0\n1 0 0\n0 1 0\n9999 0 1")).find("0 of 1 faces") !=
        std::string::npos);
    Bytes bytes("ply\nformat binary_little_endian 1.0\n" + kVertices + kFaces + "end_header\n");
    bytes.add(0.f, 0.f, 0.f, 1.f);
    CHECK(message(bytes).find("1 of 3 vertices") != std::string::npos);
}

TEST_CASE("PLY positions that are not finite are refused by name") {
    const Error error = ply_error(ascii(kVertices + kFaces, "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"));
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.elements().ids == std::vector<Index>{1});
}

TEST_CASE("PLY positions are floats where nothing is lost by it, and doubles otherwise") {
    Mesh mesh = prism(3);
    CHECK(encode_mesh(mesh, "ply").find("property double x") != std::string::npos);
    for (Index v = 0; v < mesh.vertex_count(); ++v) mesh.set_position(v, Vec3(v, 0.5, -0.25));
    CHECK(encode_mesh(mesh, "ply").find("property float x") != std::string::npos);
}

TEST_CASE("whole numbers in PLY text are written as such") {
    Mesh mesh = prism(3);
    mesh.attributes().add(
        {"id", Domain::vertex, 1, ScalarType::int32, std::vector<double>(6, 1000000.0)});
    const std::string text = encode_mesh(mesh, "ply", {.binary = false});
    CHECK(text.find(" 1000000\n") != std::string::npos);
}

TEST_CASE("PLY integers that cannot hold an attribute give way to doubles") {
    Mesh mesh = prism(3);
    mesh.attributes().add({"half", Domain::vertex, 1, ScalarType::uint8, {0, 1, 2, 3, 4, 5.5}});
    mesh.attributes().add({"large", Domain::vertex, 1, ScalarType::int16, {0, 1, 2, 3, 4, 40000}});
    mesh.attributes().add({"none", Domain::vertex, 1, ScalarType::uint32, {0, 1, 2, 3, 4, kNan}});
    const Mesh back = round_trip(mesh, "ply");
    for (const char* name : {"half", "large", "none"}) {
        CHECK(back.attributes().find(name)->type == ScalarType::float64);
        CHECK(same_numbers(back.attributes().find(name)->values,
                           mesh.attributes().find(name)->values));
    }
}

TEST_CASE("faces of more than 255 vertices fit into PLY") {
    Mesh mesh = prism(300);
    mesh.attributes().add({"uv", Domain::corner, 2, ScalarType::float64,
                           numbers(2 * mesh.topology().corner_count(), 3)});
    check_same_mesh(round_trip(mesh, "ply"), mesh);
}

TEST_CASE("r g b are colours in PLY as red green blue are") {
    for (const std::string& names :
         {std::string("r g b"), std::string("diffuse_red diffuse_green diffuse_blue"),
          std::string("r g b a")}) {
        CAPTURE(names);
        std::string properties, row;
        std::istringstream words(names);
        for (std::string name; words >> name;) {
            properties += "property uchar " + name + "\n";
            row += row.empty() ? " 255" : " 51";
        }
        const Mesh mesh = decode_mesh(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
            "property float y\nproperty float z\n" +
                properties +
                "element face 1\nproperty list uchar int vertex_indices\n"
                "end_header\n0 0 0" +
                row + "\n1 0 0" + row + "\n0 1 0" + row + "\n3 0 1 2\n",
            "ply");
        const Attribute* color = mesh.attributes().find("color");
        REQUIRE(color);
        CHECK(mesh.attributes().all().size() == 1);
        CHECK(color->width == (names.ends_with("a") ? 4 : 3));
        CHECK(color->at(1)[0] == 1.0);
        CHECK(color->at(1)[1] == doctest::Approx(0.2));
    }
    Mesh own = prism(4);
    own.attributes().add(
        {"r", Domain::vertex, 1, ScalarType::float32, std::vector<double>(8, 0.5)});
    own.attributes().add(
        {"g", Domain::vertex, 1, ScalarType::float32, std::vector<double>(8, 0.5)});
    own.attributes().add(
        {"b", Domain::vertex, 1, ScalarType::float32, std::vector<double>(8, 0.5)});
    check_same_mesh(round_trip(own, "ply"), own);
}

TEST_CASE("a picture that a PLY file names is the texture of its faces") {
    const TemporaryFolder folder;
    const std::string picture = std::string("\x89PNG\r\n\x1a\n") + "pixels";
    write_bytes(folder / "skin one.png", picture);
    const auto file = [](const std::string& comments, const std::string& number,
                         const std::string& value) {
        return "ply\nformat ascii 1.0\n" + comments + kVertices + kFaces + number +
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2" + value + "\n";
    };
    const auto load = [&](const std::string& text) {
        write_bytes(folder / "a.ply", text);
        return load_mesh(folder / "a.ply");
    };
    const Mesh one = load(file("comment TextureFile skin one.png\n", "", ""));
    CHECK(label_of_each_face(one, "material") == std::vector<std::string>{"skin one.png"});
    CHECK(encode_mesh(one, "glb").find(picture) != std::string::npos);
    CHECK(one.report().findings().empty());
    const std::string two = "comment TextureFile gone.png\ncomment TextureFile ../skin one.png\n";
    const Mesh second = load(file(two, "property int texnumber\n", " 1"));
    CHECK(label_of_each_face(second, "material") == std::vector<std::string>{"../skin one.png"});
    CHECK(second.report().find(FindingKind::files_missing)->count == 2);
    for (const char* bad : {" -1", " 2", " 2147483647"}) {
        CHECK(label_of_each_face(load(file(two, "property int texnumber\n", bad)), "material") ==
              std::vector<std::string>{""});
    }
    CHECK(load(file("comment TextureFile\n", "", "")).face_count() == 1);
}
