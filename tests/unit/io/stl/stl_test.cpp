#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

using Corner = std::array<float, 3>;

std::string facet(const Corner& a, const Corner& b, const Corner& c) {
    std::string text = "facet normal 0 0 0\nouter loop\n";
    for (const Corner& p : {a, b, c}) {
        text += "vertex";
        for (const float x : p) text += " " + std::to_string(x);
        text += "\n";
    }
    return text + "endloop\nendfacet\n";
}

std::string binary(const std::string& header, const std::vector<std::array<Corner, 3>>& triangles) {
    std::string padded = header;
    padded.resize(80, '\0');
    Bytes bytes(padded);
    bytes.add(static_cast<std::uint32_t>(triangles.size()));
    for (const auto& triangle : triangles) {
        bytes.add(0.f, 0.f, 0.f);
        for (const Corner& p : triangle) bytes.add(p[0], p[1], p[2]);
        bytes.add(std::uint16_t{0xabcd});
    }
    return bytes;
}

constexpr Corner kA{0, 0, 0}, kB{1, 0, 0}, kC{1, 1, 0}, kD{0, 1, 0};

Mesh stl(const std::string& text) {
    return decode_mesh(text, "stl");
}

ErrorCode stl_error(const std::string& text) {
    return error_of([&] { stl(text); }).code();
}

}  // namespace

TEST_CASE("STL text and binary give the same welded mesh") {
    const Mesh text = stl("solid\n" + facet(kA, kB, kC) + facet(kA, kC, kD) + "endsolid\n");
    const Mesh bytes = stl(binary("", {{kA, kB, kC}, {kA, kC, kD}}));
    CHECK(text.vertex_count() == 4);
    CHECK(face_of(text, 1) == std::vector<Index>{0, 2, 3});
    check_same_mesh(text, bytes);
}

TEST_CASE("binary STL may begin with the word solid") {
    CHECK(stl(binary("solid facet", {{kA, kB, kC}})).face_count() == 1);
}

TEST_CASE("binary STL may have bytes after its triangles") {
    CHECK(stl(binary("", {{kA, kB, kC}}) + "tail").face_count() == 1);
}

TEST_CASE("STL text is read in any case and with any blanks") {
    const Mesh mesh =
        stl("SOLID a\r\n  Facet Normal 0 0 1 Outer Loop\r\nVertex 0 0 0 VERTEX 1 0 0\r\n\tvertex 0 "
            "1 0\r\n"
            "EndLoop\r\nEndFacet\r\nEndSolid a");
    CHECK(mesh.face_count() == 1);
}

TEST_CASE("negative zero is welded with zero") {
    CHECK(stl(binary("", {{kA, kB, kC}, {Corner{-0.f, 0, -0.f}, kC, kD}})).vertex_count() == 4);
}

TEST_CASE("triangles that collapse are dropped with their number, and leave no vertex") {
    LoggedContext logged;
    const Corner far{9, 9, 9};
    const Mesh mesh =
        decode_mesh(binary("", {{kA, kB, kC}, {far, far, kB}, {kA, kB, kA}, {kB, kB, kB}}), "stl",
                    {}, logged.context);
    CHECK(mesh.face_count() == 1);
    CHECK(mesh.vertex_count() == 3);
    CHECK(mesh.report().find(FindingKind::faces_collapsed)->count == 3);
}

TEST_CASE("the solids of STL text are objects") {
    const Corner up{0, 0, 1};
    const Mesh mesh = stl("solid left part\n" + facet(kA, kB, kC) + "endsolid left part\nsolid\n" +
                          facet(kA, kC, kD) + "endsolid\nsolid empty\nendsolid\nsolid right\n" +
                          facet(kB, kA, up) + "endsolid right");
    CHECK(label_of_each_face(mesh, "object") == std::vector<std::string>{"left part", "", "right"});
    CHECK(mesh.vertex_count() == 5);
}

TEST_CASE("STL keeps the objects of its faces in text") {
    Mesh mesh = stl("solid\n" + facet(kA, kB, kC) + facet(kA, kC, kD) + "endsolid\n");
    mesh.attributes().labels()["object"] = {{"one", "two"}, {1, 0}};
    const Mesh back = round_trip(mesh, "stl", {.binary = false});
    CHECK(label_of_each_face(back, "object") == std::vector<std::string>{"two", "one"});
}

TEST_CASE("STL polygons are triangulated and their normals point outwards") {
    const Mesh mesh = prism(5);
    const std::string bytes = encode_mesh(mesh, "stl");
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, 4);
    CHECK(count == 5 * 2 + 2 * 3);
    CHECK(bytes.size() == 84 + 50 * count);
    const Vec3 center(0, 7, -0.2);
    for (std::uint32_t t = 0; t < count; ++t) {
        float raw[12];
        std::memcpy(raw, bytes.data() + 84 + 50 * t, sizeof(raw));
        const Vec3 normal(raw[0], raw[1], raw[2]), corner(raw[3], raw[4], raw[5]);
        CHECK(normal.norm() == doctest::Approx(1.0));
        CHECK(normal.dot(corner - center) > 0.0);
    }
}

TEST_CASE("STL text keeps every digit of positions") {
    const Mesh mesh = prism(4);
    const Mesh back = round_trip(mesh, "stl", {.binary = false});
    REQUIRE(back.vertex_count() == mesh.vertex_count());
    for (const Vec3& p : mesh.positions()) {
        CHECK(std::find(back.positions().begin(), back.positions().end(), p) !=
              back.positions().end());
    }
}

TEST_CASE("positions beyond the range of binary STL are refused by name, but not by text") {
    Mesh mesh = prism(3);
    mesh.set_position(4, Vec3(1e39, 0, 0));
    const Error error = error_of([&] { encode_mesh(mesh, "stl"); });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.elements().ids == std::vector<Index>{4});
    CHECK(round_trip(mesh, "stl", {.binary = false}).vertex_count() == 6);
}

TEST_CASE("STL errors have codes") {
    CHECK(stl_error("hello world") == ErrorCode::file_syntax);
    CHECK(stl_error("solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 x") ==
          ErrorCode::file_syntax);
    CHECK(stl_error("solid\nfacet normal 0 0 0\nouter ring\n") == ErrorCode::file_syntax);
    CHECK(stl_error("solid\n" + facet(kA, kB, kC)) == ErrorCode::file_truncated);
    CHECK(stl_error("solid\n" + facet(kA, kB, kC).substr(0, 50)) == ErrorCode::file_truncated);
    const std::string whole = binary("", {{kA, kB, kC}, {kA, kC, kD}});
    CHECK(stl_error(whole.substr(0, 180)) == ErrorCode::file_truncated);
    CHECK(stl_error(whole.substr(0, 82)) == ErrorCode::file_truncated);
    std::string huge = whole;
    huge[83] = '\x7f';
    CHECK(stl_error(huge) == ErrorCode::file_truncated);
    CHECK(stl_error(binary("", {{kA, kB, Corner{NAN, 0, 0}}})) == ErrorCode::not_finite);
}

TEST_CASE("an STL error in text names the line, an early end the triangles found") {
    const Error syntax = error_of([&] { stl("solid\n" + facet(kA, kB, kC) + "face\n"); });
    CHECK(syntax.elements().ids == std::vector<Index>{8});
    const Error end = error_of([&] {
        stl(binary("", {{kA, kB, kC}, {kA, kC, kD}}).substr(0, 180));
    });
    CHECK(end.message().find("1 of 2 triangles") != std::string::npos);
}

TEST_CASE("binary STL whose header announces no triangles has those that follow") {
    std::string bytes = binary("", {{kA, kB, kC}, {kA, kC, kD}});
    for (const char filler : {'\0', '\xff'}) {
        for (std::size_t i = 80; i < 84; ++i) bytes[i] = filler;
        const LoggedContext logged;
        CHECK(decode_mesh(bytes, "stl", {}, logged.context).face_count() == 2);
        CHECK(logged.mentions("2 follow"));
    }
    for (std::size_t i = 80; i < 84; ++i) bytes[i] = '\0';
    CHECK(stl(bytes.substr(0, 84)).face_count() == 0);
    CHECK(stl(bytes.substr(0, 84) + "tail").face_count() == 0);
    CHECK(stl(bytes.substr(0, bytes.size() - 1)).face_count() == 0);
    for (std::size_t i = 80; i < 84; ++i) bytes[i] = '\xff';
    CHECK(stl_error(bytes.substr(0, bytes.size() - 1)) == ErrorCode::file_too_large);
}
