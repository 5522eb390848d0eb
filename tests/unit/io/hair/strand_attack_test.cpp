// Damaged hair files, and those made to harm: read or refused, in memory bounded by their size.
#include <array>
#include <cstdint>

#include "kernel/io/strand_file.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/damage.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

std::string hair_file(std::uint32_t strands, std::uint32_t points, std::uint32_t arrays,
                      std::uint32_t segments, const std::string& data) {
    std::string bytes =
        Bytes("HAIR").add(strands, points, arrays, segments, 0.1f, 0.0f, 1.0f, 1.0f, 1.0f);
    bytes.resize(128, '\0');
    return bytes + data;
}

std::string usda(const std::string& body) {
    return "#usda 1.0\ndef BasisCurves \"h\"\n{\nuniform token type = \"linear\"\n" + body + "}\n";
}

std::string repeated(std::string_view text, std::size_t count) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i) result += text;
    return result;
}

ErrorCode code_of(const std::string& bytes, const std::string& extension) {
    return error_of([&] { decode_strands(bytes, extension); }).code();
}

bool is_read(const std::string& bytes, const std::string& extension) {
    try {
        decode_strands(bytes, extension);
        return true;
    } catch (const Error&) {
        return false;
    }
}

bool is_handled(const std::string& bytes, const std::string& extension) {
    ContextOptions options;
    options.memory_limit = 64 * bytes.size() + (1 << 16);
    try {
        const Strands strands = decode_strands(bytes, extension, {}, Context(options));
        return strand_statistics(strands).not_finite == 0;
    } catch (const Error& error) {
        return error.code() != ErrorCode::internal && !error.message().empty() &&
               error.message().size() < 400;
    }
}

constexpr std::string_view kLetters = "0123456789-.()[]{}\"=, \n";

struct Sample {
    std::string extension, bytes;
};

std::vector<Sample> samples() {
    const Strands strands = rich_hair(6);
    std::vector<Sample> list;
    for (const std::string& extension : readable_strand_extensions()) {
        list.push_back({extension, encode_strands(strands, extension).bytes});
    }
    list.push_back(
        {"usda",
         "#usda 1.0\ndef Xform \"a\"{\ndef BasisCurves \"h\"\n{\nuniform token basis = "
         "\"bspline\"\nuniform token wrap = \"pinned\"\nint[] curveVertexCounts = [4, 5]\n"
         "point3f[] points = [" +
             repeated("(0,1,2),", 9) +
             "]\nfloat[] widths = [1,2,3,4,5,6,7,8,9] (interpolation = \"varying\")\n}}\n"});
    list.push_back(
        {"usda",
         "#usda 1.0\n/* a */ def Xform \"a\" ( active = true references = @@@b@@@ ){\n"
         "double3 xformOp:translate:p = (1,2,3) // b\nfloat3 xformOp:rotateXYZ = (1,2,3)\n"
         "matrix4d xformOp:transform = ((1,0,0,0),(0,1,0,0),(0,0,1,0),(1,2,3,1))\n"
         "quatf xformOp:orient = (1,0,0,1)\nuniform token[] xformOpOrder = "
         "[\"!resetXformStack!\", \"xformOp:translate:p\", \"xformOp:rotateXYZ\", "
         "\"xformOp:transform\", \"xformOp:orient\", \"!invert!xformOp:translate:p\"]\n"
         "token visibility = \"inherited\"\ndef BasisCurves \"h\"\n{\nuniform token type = "
         "\"linear\"\nint[] curveVertexCounts = [2, 2]\npoint3f[] points = [" +
             repeated("(0,1,2),", 4) +
             "]\ncolor3f[] primvars:displayColor = [(1,0,0),(0,0,1)] (interpolation = "
             "\"uniform\")\n"
             "int[] primvars:displayColor:indices = [1, 0]\n}}\n"});
    return list;
}

}  // namespace

TEST_CASE("a hair file that is cut short anywhere is read or refused") {
    for (const Sample& sample : samples()) {
        CAPTURE(sample.extension);
        for (std::size_t size = 0; size < sample.bytes.size(); size += 3) {
            CAPTURE(size);
            CHECK(is_handled(sample.bytes.substr(0, size), sample.extension));
        }
    }
}

TEST_CASE("a binary hair file that is cut short is refused") {
    for (const char* extension : {"hair", "data", "tfx"}) {
        const std::string bytes = encode_strands(rich_hair(6), extension).bytes;
        for (std::size_t size = 4; size < bytes.size(); size += 5) {
            CAPTURE(size);
            const ErrorCode code = code_of(bytes.substr(0, size), extension);
            CHECK((code == ErrorCode::file_truncated || code == ErrorCode::file_too_large));
        }
    }
}

TEST_CASE("a .ply file of hair that is cut short is refused") {
    const std::string bytes = encode_strands(rich_hair(6), "ply").bytes;
    const std::size_t header = bytes.find("end_header\n") + 11;
    for (std::size_t size = 0; size < bytes.size(); size += 5) {
        CAPTURE(size);
        CHECK_FALSE(is_read(bytes.substr(0, size), "ply"));
        if (size < header) continue;
        CHECK(code_of(bytes.substr(0, size), "ply") == ErrorCode::file_truncated);
    }
}

TEST_CASE("a hair file with damaged bytes is read or refused") {
    std::mt19937 random(7);
    for (const Sample& sample : samples()) {
        CAPTURE(sample.extension);
        // Without damage it is read, and with some of it.
        int read = 0;
        for (int i = 0; i < 1000; ++i) {
            CAPTURE(i);
            const std::string bytes = damaged(sample.bytes, random, kLetters);
            CHECK(is_handled(bytes, sample.extension));
            read += is_read(bytes, sample.extension);
        }
        CHECK_NOTHROW(decode_strands(sample.bytes, sample.extension));
        CHECK(read >= 20);
    }
}

TEST_CASE("noise is refused or read as hair") {
    std::mt19937 random(8);
    for (const std::string& extension : readable_strand_extensions()) {
        for (int i = 0; i < 200; ++i) {
            std::string bytes(random() % 300, '\0');
            for (char& c : bytes) c = static_cast<char>(random());
            CHECK(is_handled(bytes, extension));
            CHECK(is_handled("HAIR" + bytes, extension));
            CHECK(is_handled("#usda 1.0\n" + bytes, extension));
        }
    }
}

TEST_CASE("counts of .hair that no file can hold are refused before memory is taken") {
    const std::string data(24, '\0');
    for (const std::uint32_t huge : {3u, 1000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
        CAPTURE(huge);
        for (const std::uint32_t arrays : {2u, 3u, 31u}) {
            CHECK(is_handled(hair_file(huge, 2, arrays, 1, data), "hair"));
            CHECK(is_handled(hair_file(1, huge, arrays, 1, data), "hair"));
            CHECK(is_handled(hair_file(huge, huge, arrays, huge, data), "hair"));
            const ErrorCode code = code_of(hair_file(huge, huge, arrays, 0, data), "hair");
            CHECK((code == ErrorCode::file_truncated || code == ErrorCode::file_too_large));
        }
        CHECK(code_of(hair_file(1, 2, 2, huge, data), "hair") == ErrorCode::file_syntax);
    }
}

TEST_CASE(".hair that contradicts itself is refused") {
    const std::string two(24, '\0'), segments("\5\0\1\0", 4);
    CHECK(code_of(hair_file(1, 2, 2, 2, two), "hair") == ErrorCode::file_syntax);
    CHECK(code_of(hair_file(1, 2, 1, 1, two), "hair") == ErrorCode::unsupported);
    const Error error =
        error_of([&] { decode_strands(hair_file(2, 2, 3, 0, segments + two), "hair"); });
    CHECK(error.code() == ErrorCode::file_syntax);
    CHECK(error.elements().kind == ElementKind::strand);
    CHECK(code_of("HAIL" + two, "hair") == ErrorCode::file_syntax);
}

TEST_CASE("numbers that are not finite are refused with the strand they are in") {
    const float inf = std::numeric_limits<float>::infinity();
    const std::string points =
        Bytes().add(0.f, 0.f, 0.f, 1.f, 1.f, 1.f, 2.f, inf, 2.f, 3.f, 3.f, 3.f);
    const Error hair = error_of([&] { decode_strands(hair_file(2, 4, 2, 1, points), "hair"); });
    CHECK(hair.code() == ErrorCode::not_finite);
    CHECK(hair.elements().ids == std::vector<Index>{1});
    const std::string data = Bytes().add(std::int32_t{2}, std::int32_t{1}, 0.f, 0.f, 0.f,
                                         std::int32_t{1}, 0.f, 0.f, std::nanf(""));
    const Error salon = error_of([&] { decode_strands(data, "data"); });
    CHECK(salon.code() == ErrorCode::not_finite);
    CHECK(salon.elements().ids == std::vector<Index>{1});
    const Error text = error_of([&] {
        decode_strands(
            usda("int[] curveVertexCounts = [2]\npoint3f[] points = [(0,0,0),\n(0,nan,0)]\n"),
            "usda");
    });
    CHECK((text.code() == ErrorCode::not_finite || text.code() == ErrorCode::file_syntax));
    CHECK(text.message().starts_with("line 7: "));
    CHECK(code_of(usda("point3f[] points = [(0,1e39,0)]\n"), "usda") == ErrorCode::not_finite);
    const std::string header = hair_file(0, 0, 2, 0, "");
    std::string bad = header;
    bad[22] = '\x80';
    bad[23] = '\x7f';
    CHECK(code_of(bad, "hair") == ErrorCode::not_finite);
}

TEST_CASE("counts of .data that no file can hold are refused") {
    for (const std::int32_t count : {2, 1000000, 0x7fffffff, -1}) {
        CAPTURE(count);
        const ErrorCode strands =
            code_of(Bytes().add(count, std::int32_t{1}, 0.f, 0.f, 0.f), "data");
        CHECK((strands == ErrorCode::file_truncated || strands == ErrorCode::file_too_large ||
               strands == ErrorCode::file_syntax));
        const Error error = error_of([&] {
            decode_strands(std::string(Bytes().add(std::int32_t{1}, count, 0.f, 0.f, 0.f)), "data");
        });
        CHECK(error.elements().kind == ElementKind::strand);
    }
}

TEST_CASE("USDA that contradicts itself is refused with the line") {
    const std::string two = "point3f[] points = [(0,0,0), (0,1,0)]\n";
    for (const std::string& body :
         {two + "int[] curveVertexCounts = [3]\n", two + "int[] curveVertexCounts = [1]\n",
          two + "int[] curveVertexCounts = [1, 0, 1]\n",
          two + "int[] curveVertexCounts = [-2, 4]\n", two + "int[] curveVertexCounts = [1e99]\n",
          two + "int[] curveVertexCounts = [1.5, .5]\n", two,
          std::string("point3f[] points = [0, 1]\nint[] curveVertexCounts = [1]\n"),
          two + "int[] curveVertexCounts = [2]\nfloat[] widths = [1,2,3]\n",
          two + "int[] curveVertexCounts = [2]\nint[] primvars:group:indices = [0]\n",
          two + "int[] curveVertexCounts = [2]\nint[] primvars:rootFace = [0]\n",
          two + "int[] curveVertexCounts = [2]\nuint[] primvars:strandId = [-1]\n",
          std::string("point3f[] points = [(0, x, 0)]\n"), std::string("point3f[] points = )\n")}) {
        CAPTURE(body);
        const Error error = error_of([&] { decode_strands(usda(body), "usda"); });
        CHECK(error.code() == ErrorCode::file_syntax);
        CHECK(error.message().starts_with("line "));
    }
}

TEST_CASE("large repetitive USDA is handled in bounded memory and time") {
    constexpr std::size_t kSize = 1 << 20;
    const auto filled = [&](std::string_view text) { return repeated(text, kSize / text.size()); };
    for (const std::string& bytes :
         {"#usda 1.0\n" + filled("("),
          "#usda 1.0\n" + filled("["),
          "#usda 1.0\n" + filled("\""),
          "#usda 1.0\n" + filled("def \"a\"{"),
          "#usda 1.0\n" + filled("def BasisCurves \"a\"{}\n"),
          "#usda 1.0\n" + filled("def BasisCurves \"a\"{int[] curveVertexCounts=[1]\n"
                                 "point3f[] points=[0,0,0] uniform token type = \"linear\"}\n"),
          usda("a = " + filled("[")),
          usda("a = (" + filled("1,") + ")\n"),
          usda("point3f[] points = [" + filled("1,") + "]\n"),
          usda(filled("b\n")),
          usda(filled("b = 1\n")),
          "#usda 1.0\n" + filled("#"),
          "#usda 1.0\n" + filled("}"),
          "#usda 1.0\n" + filled("'''"),
          "#usda 1.0\n" + filled("\\"),
          "#usda 1.0\n" + filled("variantSet \"a\" = {"),
          "#usda 1.0\n" + filled("/*"),
          "#usda 1.0\n" + filled("/**/"),
          "#usda 1.0\n" + filled("//\n"),
          "#usda 1.0\n" + filled("@@@\n"),
          "#usda 1.0\n" + filled("def A \"a\" ( b = "),
          "#usda 1.0\n" +
              filled("def A \"a\" { uniform token[] xformOpOrder = [\"xformOp:scale\"]\n"),
          usda("int[] primvars:st:indices = [" + filled("0,") +
               "]\nfloat2[] primvars:st = [(0,0)]\n"),
          usda("uniform token[] xformOpOrder = [" + filled("\"xformOp:scale\",") + "]\n")}) {
        CAPTURE(bytes.substr(0, 80));
        CHECK(is_handled(bytes, "usda"));
    }
}

TEST_CASE("messages about USDA show no bytes that cannot be printed") {
    const Error error =
        error_of([] { decode_strands(usda("point3f[] points = [\x01\xff\x7f]\n"), "usda"); });
    for (const char c : error.message()) CHECK((c >= 0x20 && c < 0x7f));
}

TEST_CASE("strands of no points in .data are left out, and the log counts them") {
    const std::string gap = Bytes().add(std::int32_t{3}, std::int32_t{2}, 0.f, 0.f, 0.f, 1.f, 0.f,
                                        0.f, std::int32_t{0}, std::int32_t{1}, 5.f, 5.f, 5.f);
    const LoggedContext logged;
    const Strands strands = decode_strands(gap, "data", {}, logged.context);
    CHECK(strands.size() == 2);
    CHECK(strands.root(1) == Eigen::Vector3f(5, 5, 5));
    CHECK(logged.mentions("1 of 3 strands"));
    const std::string none = Bytes().add(std::int32_t{2}, std::int32_t{0}, std::int32_t{0});
    CHECK(decode_strands(none, "data").empty());
    CHECK(code_of(Bytes().add(std::int32_t{2}, std::int32_t{0}), "data") ==
          ErrorCode::file_truncated);
    CHECK(code_of(Bytes().add(std::int32_t{1}, std::int32_t{-1}), "data") ==
          ErrorCode::file_syntax);
    for (std::size_t size = 0; size < gap.size(); ++size) {
        CHECK_FALSE(is_read(gap.substr(0, size), "data"));
    }
}

namespace {

std::string tfx_file(std::uint32_t strands, std::uint32_t points,
                     const std::array<std::uint32_t, 5>& offsets, const std::string& data) {
    std::string bytes = Bytes().add(4.0f, strands, points, offsets[0], offsets[1], offsets[2],
                                    offsets[3], offsets[4]);
    bytes.resize(160, '\0');
    return bytes + data;
}

std::string ply_text(const std::string& elements, const std::string& rows) {
    return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + rows;
}

constexpr const char* kThreeVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kRows = "0 0 0\n0 1 0\n0 2 0\n";

}  // namespace

TEST_CASE("counts and offsets of .tfx that the file does not hold are refused") {
    const std::string data(64, '\0');
    for (const std::uint32_t huge : {5u, 1000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
        CAPTURE(huge);
        for (const auto& file :
             {tfx_file(huge, 4, {160}, data), tfx_file(1, huge, {160}, data),
              tfx_file(huge, huge, {160}, data), tfx_file(1, 4, {huge}, data),
              tfx_file(1, 4, {160, huge}, data), tfx_file(1, 4, {160, 0, 0, 0, huge}, data)}) {
            CHECK(is_handled(file, "tfx"));
            CHECK_FALSE(is_read(file, "tfx"));
        }
    }
    CHECK(is_read(tfx_file(1, 4, {160}, data), "tfx"));
    CHECK(code_of(tfx_file(1, 4, {100}, data), "tfx") == ErrorCode::file_syntax);
    CHECK(code_of(tfx_file(1, 4, {0}, data), "tfx") == ErrorCode::file_syntax);
    CHECK(code_of(tfx_file(1, 4, {161}, data), "tfx") == ErrorCode::file_truncated);
    CHECK(code_of(std::string(300, 'x'), "tfx") == ErrorCode::file_syntax);
    CHECK(code_of(tfx_file(1, 4, {160}, data).substr(0, 100), "tfx") == ErrorCode::file_truncated);
}

TEST_CASE(".tfx with numbers that are not finite is refused with the strand") {
    std::string points;
    for (int p = 0; p < 8; ++p) {
        points += Bytes().add(0.f, p == 6 ? std::nanf("") : 1.f * p, 0.f, std::nanf(""));
    }
    const Error error = error_of([&] { decode_strands(tfx_file(2, 4, {160}, points), "tfx"); });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.elements().ids == std::vector<Index>{1});
    // Whether a point moves may be any number.
    points.replace(6 * 16 + 4, 4, Bytes().add(1.f));
    CHECK(is_read(tfx_file(2, 4, {160}, points), "tfx"));
    const std::string widths = Bytes().add(1.f, std::nanf(""));
    const Error width = error_of([&] {
        decode_strands(tfx_file(2, 4, {160, 0, 0, 288}, points + widths), "tfx");
    });
    CHECK(width.code() == ErrorCode::not_finite);
    CHECK(width.elements().ids == std::vector<Index>{1});
}

TEST_CASE("edges of .ply become strands whatever their order; branches and rings are refused") {
    const std::string elements = std::string(
        "element vertex 6\nproperty double x\nproperty double "
        "y\nproperty double z\nelement edge 3\nproperty int "
        "vertex1\nproperty int vertex2\n");
    const std::string points = "0 0 0\n0 1 0\n0 2 0\n5 0 0\n5 1 0\n9 9 9\n";
    const LoggedContext logged;
    const Strands strands =
        decode_strands(ply_text(elements, points + "4 3\n2 1\n0 1\n"), "ply", {}, logged.context);
    REQUIRE(strands.size() == 2);
    CHECK(strands.point_count(0) == 3);
    CHECK(strands.root(0) == Eigen::Vector3f(0, 0, 0));
    CHECK(strands.root(1) == Eigen::Vector3f(5, 0, 0));
    CHECK(logged.mentions("1 vertices without edges"));
    for (const char* edges :
         {"0 1\n1 2\n1 3\n", "0 1\n1 2\n2 0\n", "0 1\n0 1\n1 2\n", "0 0\n1 2\n2 3\n"}) {
        CAPTURE(edges);
        const Error error =
            error_of([&] { decode_strands(ply_text(elements, points + edges), "ply"); });
        CHECK(error.code() == ErrorCode::file_syntax);
        CHECK(error.elements().kind == ElementKind::vertex);
    }
    for (const char* edges : {"0 1\n1 6\n3 4\n", "-1 0\n1 2\n3 4\n", "0 0.5\n1 2\n3 4\n"}) {
        CHECK(code_of(ply_text(elements, points + edges), "ply") == ErrorCode::face_index);
    }
}

TEST_CASE(".ply tells strands by lists or by numbers of segments") {
    const std::string list = std::string(kThreeVertices) +
                             "element polyline 2\nproperty list uchar int vertex_indices\n";
    const Strands listed =
        decode_strands(ply_text(list, std::string(kRows) + "2 2 1\n1 0\n"), "ply");
    REQUIRE(listed.size() == 2);
    CHECK(listed.root(0) == Eigen::Vector3f(0, 2, 0));
    CHECK(listed.point_count(1) == 1);
    CHECK(code_of(ply_text(list, std::string(kRows) + "2 2 3\n1 0\n"), "ply") ==
          ErrorCode::face_index);
    CHECK(code_of(ply_text(list, std::string(kRows) + "0\n1 0\n"), "ply") ==
          ErrorCode::file_syntax);
    CHECK(code_of(ply_text(list, std::string(kRows) + "2 2 1\n1"), "ply") ==
          ErrorCode::file_truncated);
    const std::string counts =
        std::string(kThreeVertices) + "element strand 1\nproperty ushort nsegs\n";
    CHECK(decode_strands(ply_text(counts, std::string(kRows) + "2\n"), "ply").point_count(0) == 3);
    for (const char* bad : {"1\n", "3\n", "-1\n", "1.5\n", "1e30\n"}) {
        CHECK(code_of(ply_text(counts, kRows + std::string(bad)), "ply") == ErrorCode::file_syntax);
    }
    CHECK(code_of(ply_text(kThreeVertices, kRows), "ply") == ErrorCode::unsupported);
    CHECK(code_of(ply_text(counts, "0 0 0\n0 nan 0\n0 2 0\n2\n"), "ply") != ErrorCode::internal);
}
