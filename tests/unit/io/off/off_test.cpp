#include <cstring>

#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const std::string kTriangle = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

Mesh off(const std::string& text) {
    return decode_mesh(text, "off");
}

Error off_error(const std::string& text) {
    return error_of([&] { off(text); });
}

void check_error(const std::string& text, ErrorCode code, Index line) {
    CAPTURE(text);
    const Error error = off_error(text);
    CAPTURE(error.message());
    CHECK(error.code() == code);
    CHECK(error.elements().ids == std::vector<Index>{line - 1});
}

}  // namespace

TEST_CASE("OFF is read whatever its keyword, counts, comments and line breaks") {
    const Mesh expected = off("OFF\n3 1 3\n" + kTriangle);
    CHECK(expected.vertex_count() == 3);
    CHECK(face_of(expected, 0) == std::vector<Index>{0, 1, 2});
    for (const std::string& text :
         {"OFF\n3 1\n" + kTriangle, "OFF 3 1 3\n" + kTriangle, "3 1 3\n" + kTriangle,
          "# c\n\nOFF # c\n# c\n3 1 0 # c\n" + kTriangle,
          std::string("OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n"),
          std::string("OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2"),
          std::string("OFF\n3\n1\n\n0\n0 0 1\n0 0 0\n1 0\n3\n0\n\n1 2"),
          std::string("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2")}) {
        CAPTURE(text);
        check_same_mesh(off(text), expected);
    }
}

TEST_CASE("the counts of OFF tell where its records end, whatever its lines") {
    const Mesh square = off("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
    for (const char* text : {
             "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2\n3 0 2 3\n",
             "OFF\n4 2 0\n0 0 0 1 0 0 1\n1 0 0 1 0\n3 0 1 2\n3 0 2 3\n",
             "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 3 0 2 3\n",
             "OFF\n4 2 0\n0 0\n0\n1 0\n0\n1 1\n0\n0 1\n0\n3 0\n1 2\n3\n0 2 3\n",
             "OFF\n4 2\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
             "OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3",
         }) {
        CAPTURE(text);
        check_same_mesh(off(text), square);
    }
    const Mesh colored =
        off("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n");
    for (const char* text :
         {"COFF\n3 1 0\n0 0 0\n255 0 0 255\n1 0 0\n0 255 0 255\n0 1 0\n0 0 255 255\n3 0 1 2\n",
          "COFF\n3 1 0\n0 0 0 255 0 0 255 1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n"}) {
        CAPTURE(text);
        check_same_mesh(off(text), colored);
    }
    const Mesh three =
        off("COFF\n3 1 0\n0 0 0\n255 0 0\n1 0 0\n0 255 0\n0 1 0\n0 0 255\n3 0 1 2\n");
    CHECK(three.position(1) == Vec3(1, 0, 0));
    CHECK(three.attributes().find("color")->width == 3);
}

TEST_CASE("OFF that goes on after its last face is refused, but for a list of edges") {
    const Mesh mesh = off("OFF\n3 1 2\n" + kTriangle + "2 0 1\n2 1 2\n");
    CHECK(mesh.report().find(FindingKind::content_skipped)->message == "2 edges");
    check_error("OFF\n3 1 0\n" + kTriangle + "3 0 2 1\n", ErrorCode::file_syntax, 7);
    check_error("OFF\n2 1 0\n" + kTriangle, ErrorCode::file_syntax, 6);
}

TEST_CASE("the keyword of OFF tells what vertices have") {
    const Mesh mesh =
        off("STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 51 0.1 0.2\n1 0 0 0 0 1 0 255 0 0.3 0.4\n"
            "0 1 0 0 0 1 0 0 255 0.5 0.6\n3 0 1 2\n");
    CHECK(mesh.attributes().find("normal")->values ==
          std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(mesh.attributes().find("uv")->values == std::vector<double>{.1, .2, .3, .4, .5, .6});
    const Attribute* color = mesh.attributes().find("color");
    CHECK(color->type == ScalarType::uint8);
    CHECK(color->values == std::vector<double>{1, 0, 0.2, 0, 1, 0, 0, 0, 1});
    CHECK(color->domain == Domain::vertex);
}

TEST_CASE(
    "OFF colours of vertices have three or four values, or are absent in spite of the keyword") {
    const auto width = [](const std::string& vertex, const std::string& keyword) {
        const std::string text = keyword + "\n3 1 0\n0 0 0" + vertex + "\n1 0 0" + vertex +
                                 "\n0 1 0" + vertex + "\n3 0 1 2\n";
        const Mesh mesh = off(text);
        const Attribute* color = mesh.attributes().find("color");
        return color ? color->width : 0;
    };
    CHECK(width(" 1 0.5 0", "COFF") == 3);
    CHECK(width(" 1 0.5 0 1", "COFF") == 4);
    CHECK(width("", "COFF") == 0);
    CHECK(width(" 10 20 30 255", "OFF") == 4);
}

TEST_CASE("OFF colours of faces are bytes or fractions, where they are given") {
    const Mesh fractions =
        off("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1 0 0.5\n3 0 2 3\n");
    const Attribute* color = fractions.attributes().find("color");
    REQUIRE(color);
    CHECK(color->domain == Domain::face);
    CHECK(color->type == ScalarType::float32);
    CHECK(same_numbers(color->values, {1, 0, 0.5, kNan, kNan, kNan}));

    const Mesh bytes =
        off("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 51\n3 0 2 3 0 0 0 102\n");
    color = bytes.attributes().find("color");
    CHECK(color->type == ScalarType::uint8);
    CHECK(color->values == std::vector<double>{1, 0, 0.2, 1, 0, 0, 0, 0.4});
}

TEST_CASE("OFF colours of faces beside those of vertices are called face_color") {
    const Mesh mesh =
        off("COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2 0.5 0.5 0.5\n");
    CHECK(mesh.attributes().find("color")->domain == Domain::vertex);
    CHECK(mesh.attributes().find("face_color")->domain == Domain::face);
    check_same_mesh(round_trip(mesh, "off"), mesh);
}

TEST_CASE("OFF indices into a colour map are skipped with a word about it") {
    LoggedContext logged;
    const Mesh mesh =
        decode_mesh("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n", "off", {}, logged.context);
    CHECK(mesh.attributes().all().empty());
    CHECK(logged.mentions("colour map"));
}

TEST_CASE("binary OFF is read as Geomview writes it") {
    Bytes bytes("# a comment\nOFF BINARY\n", true);
    bytes.add(std::int32_t{4}, std::int32_t{2}, std::int32_t{0});
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) bytes.add(x);
    bytes.add(std::int32_t{3}, std::int32_t{0}, std::int32_t{1}, std::int32_t{2}, std::int32_t{0});
    bytes.add(std::int32_t{3}, std::int32_t{0}, std::int32_t{2}, std::int32_t{3}, std::int32_t{3},
              1.f, 0.5f, 0.f);
    const Mesh mesh = off(bytes);
    CHECK(mesh.position(2) == Vec3(1, 1, 0));
    CHECK(face_of(mesh, 1) == std::vector<Index>{0, 2, 3});
    CHECK(same_numbers(mesh.attributes().find("color")->values, {kNan, kNan, kNan, 1, 0.5, 0}));
}

TEST_CASE("binary OFF is read with little endian numbers and no colours") {
    Bytes bytes("NOFF BINARY\n");
    bytes.add(std::uint32_t{3}, std::uint32_t{1}, std::uint32_t{0});
    for (const float x : {0.f, 1.f, 2.f}) bytes.add(x, x * x, 0.f, 0.f, 0.f, 1.f);
    bytes.add(std::uint32_t{3}, std::uint32_t{0}, std::uint32_t{1}, std::uint32_t{2});
    const Mesh mesh = off(bytes);
    CHECK(mesh.position(2) == Vec3(2, 4, 0));
    CHECK(mesh.attributes().find("normal")->values ==
          std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1});
}

TEST_CASE("the byte order of binary OFF is found where both counts are possible") {
    // Read in the wrong order, 65536 vertices would be 256.
    Bytes bytes("OFF BINARY\n");
    bytes.add(std::uint32_t{65536}, std::uint32_t{21846}, std::uint32_t{0});
    for (int i = 0; i < 65536; ++i) bytes.add(float(i), float(i % 7), 0.f);
    for (std::uint32_t i = 0; i < 65535; i += 3) bytes.add(std::uint32_t{3}, i, i + 1, i + 2);
    bytes.add(std::uint32_t{3}, std::uint32_t{65533}, std::uint32_t{65534}, std::uint32_t{65535});
    CHECK(off(bytes).vertex_count() == 65536);
}

TEST_CASE("binary OFF that is cut short says so") {
    Bytes bytes("OFF BINARY\n");
    bytes.add(std::uint32_t{3}, std::uint32_t{1}, std::uint32_t{0}, 0.f, 0.f, 0.f, 1.f, 0.f);
    const Error error = off_error(bytes);
    CHECK(error.code() == ErrorCode::file_truncated);
    CHECK(error.message().find("1 of 3 vertices") != std::string::npos);
    CHECK(off_error("OFF BINARY\nab").code() == ErrorCode::file_truncated);
}

TEST_CASE("OFF errors say where and what") {
    check_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ErrorCode::face_index, 6);
    check_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", ErrorCode::face_index, 6);
    check_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999999999\n", ErrorCode::face_index, 6);
    check_error("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", ErrorCode::file_syntax, 4);
    check_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", ErrorCode::file_syntax, 6);
    check_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 2 3 4 5\n", ErrorCode::file_syntax, 6);
    check_error("OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n", ErrorCode::file_syntax, 3);
    check_error("OFF\n-3 1 0\n", ErrorCode::file_syntax, 2);
    check_error("OFF\n10000000000 1 0\n", ErrorCode::file_too_large, 2);
    check_error("OFF\n3 99999999999999999999 0\n" + kTriangle, ErrorCode::file_too_large, 2);
    check_error("OFF\n1000 1 0\n" + kTriangle, ErrorCode::file_truncated, 2);
    check_error("FOO\n3 1 0\n", ErrorCode::file_syntax, 1);
    check_error("4OFF\n3 1 0\n", ErrorCode::unsupported, 1);
    check_error("nOFF\n4\n3 1 0\n", ErrorCode::unsupported, 1);
}

TEST_CASE("OFF that ends early tells how much was found") {
    const auto message = [](const std::string& text) {
        const Error error = off_error(text);
        CHECK(error.code() == ErrorCode::file_truncated);
        return error.message();
    };
    CHECK(message("OFF\n3 1 0\n0 0 0\n1 0").find("1 of 3 vertices") != std::string::npos);
    CHECK(message("OFF\n3 2 0\n" + kTriangle).find("1 of 2 faces") != std::string::npos);
    CHECK(message("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9999 0 1").find("0 of 1 faces") !=
          std::string::npos);
    CHECK(message("OFF\n3").find("counts") != std::string::npos);
}
