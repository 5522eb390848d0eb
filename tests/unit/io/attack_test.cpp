// Files made to harm: refused or read, with memory bounded by the size of the file and in linear
// time.

#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

struct Attack {
    const char* extension;
    std::string bytes;
};

std::string repeated(std::string_view text, std::size_t count) {
    std::string result;
    result.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) result += text;
    return result;
}

std::string ply_header(const std::string& format, const std::string& declarations) {
    return "ply\nformat " + format + " 1.0\n" + declarations + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kIndices = "property list uchar int vertex_indices\n";

std::string stl_with_count(std::uint32_t count) {
    return Bytes(std::string(80, ' ')).add(count, 0.f, 0.f, 0.f);
}

std::string binary_off(std::uint32_t vertices, std::uint32_t faces, bool big) {
    return Bytes("OFF BINARY\n", big).add(vertices, faces, std::uint32_t{0}, 0.f, 1.f, 2.f);
}

std::vector<Attack> refused_files() {
    std::vector<Attack> list;
    for (const char* huge :
         {"2147483647", "2147483648", "4294967297", "9223372036854775807", "9223372036854775808",
          "99999999999999999999999", "-1", "-9223372036854775808"}) {
        const std::string n = huge;
        list.push_back({"off", "OFF\n" + n + " 1 0\n0 0 0\n"});
        list.push_back({"off", "OFF\n1 " + n + " 0\n0 0 0\n"});
        list.push_back({"off", "OFF\n1 1 0\n0 0 0\n" + n + " 0 0 0\n"});
        list.push_back({"off", "OFF\n1 1 0\n0 0 0\n3 0 0 " + n + "\n"});
        list.push_back(
            {"ply", ply_header("ascii", "element vertex " + n + "\n" + kXyz) + "0 0 0\n"});
        list.push_back({"ply", ply_header("ascii", "element vertex 1\n" + kXyz +
                                                       "element face 1\n" + kIndices) +
                                   "0 0 0\n3 0 0 " + n + "\n"});
        list.push_back({"ply", ply_header("ascii", "element vertex 1\n" + kXyz +
                                                       "element face 1\n" + kIndices) +
                                   "0 0 0\n" + n + " 0 0 0\n"});
        list.push_back({"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + n + "0\n"});
    }
    for (const std::uint32_t count : {5u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
        list.push_back({"stl", stl_with_count(count)});
        for (const bool big : {false, true}) {
            list.push_back({"off", binary_off(count, 1, big)});
            list.push_back({"off", binary_off(1, count, big)});
        }
    }
    return list;
}

// Repetitive files of `size` bytes or a little more.
std::vector<Attack> large_files(std::size_t size) {
    const auto lines = [&](std::string_view line) {
        return repeated(line, size / line.size() + 1);
    };
    const std::string points = "element vertex 3\n" + kXyz;
    return {
        {"obj", std::string(size, 'v')},
        {"obj", std::string(size, ' ')},
        {"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + lines(" 1 2 3")},
        {"obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + lines("f 1/9/9 2/9/9 3/9/9\n")},
        {"obj", lines("f 1/1 2/1 3/1\n")},
        {"obj", lines("#\n")},
        {"obj", lines("\\\n")},
        {"obj", lines("g a\ng b\n")},
        {"obj", lines("g region:a\np\n")},
        {"obj", "v 0 0 0\ng region:a\np" + lines(" 1")},
        {"obj", "mtllib " + lines("a.mtl ")},
        {"obj", "v 0 0 0\n" + std::string(size, '\0')},
        {"off", "OFF\n" + lines("# c\n")},
        {"off", "OFF\n1 1 0\n" + lines("0 ")},
        {"off", "OFF\n1 1 0\n0 0 0\n" + std::to_string(size / 4) + " " + lines("0 ")},
        {"ply", "ply\nformat ascii 1.0\n" + lines("comment lissom a 0\n")},
        {"ply", "ply\nformat ascii 1.0\n" + lines("comment lissom_mtllib a\n") + "end_header\n"},
        {"ply", ply_header("ascii", points + "element face 1\n" + kIndices) +
                    "0 0 0\n1 0 0\n0 1 0\n" + std::to_string(size / 4) + " " + lines("0 ")},
        {"ply", ply_header("binary_little_endian",
                           "element junk " + std::to_string(size) + "\nproperty uchar a\n") +
                    std::string(size, 'j')},
        {"ply", ply_header("binary_little_endian",
                           points + "element face " + std::to_string(size / 40) +
                               "\nproperty list uchar uchar vertex_indices\n" +
                               repeated("property list uchar double corner_16_a\n", 1) +
                               repeated("property uchar p\n", 1)) +
                    std::string(size, '\0')},
        {"stl", "solid " + std::string(size, 'a')},
        {"stl", lines("solid\nendsolid\n")},
        {"stl",
         lines("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
               "0\nendloop\nendfacet\nendsolid\n")},
    };
}

// Reads or refuses; a refusal is short, and printable.
void check_handled(const Attack& attack, const Context& context = {}) {
    CAPTURE(attack.extension);
    CAPTURE(attack.bytes.substr(0, 200));
    try {
        decode_mesh(attack.bytes, attack.extension, {}, context);
    } catch (const Error& error) {
        CAPTURE(error.message());
        CHECK(error.code() != ErrorCode::internal);
        CHECK(error.message().size() < 400);
    }
}

}  // namespace

TEST_CASE("counts and indices that no file can hold are refused") {
    for (const Attack& attack : refused_files()) {
        CAPTURE(attack.extension);
        CAPTURE(attack.bytes);
        const Error error = error_of([&] { decode_mesh(attack.bytes, attack.extension); });
        CAPTURE(error.message());
        const ErrorCode code = error.code();
        CHECK((code == ErrorCode::file_too_large || code == ErrorCode::file_syntax ||
               code == ErrorCode::file_truncated || code == ErrorCode::face_index));
    }
}

TEST_CASE("large repetitive files are handled within a multiple of their size") {
    constexpr std::size_t kSize = 1 << 20;
    for (const Attack& attack : large_files(kSize)) {
        ContextOptions options;
        options.memory_limit = 512 * attack.bytes.size();
        check_handled(attack, Context(std::move(options)));
    }
}

TEST_CASE("absent values of corners cannot take much more memory than the file") {
    std::string lists;
    for (int i = 0; i < 200; ++i) {
        lists += "property list uchar double corner_16_a" + std::to_string(i) + "\n";
    }
    constexpr std::size_t kFaces = 2500;
    std::string row("\3\0\1\2", 4);
    row.resize(204, '\0');
    Bytes bytes(ply_header("binary_little_endian",
                           "element vertex 3\n" + kXyz + "element face " + std::to_string(kFaces) +
                               "\nproperty list uchar uchar vertex_indices\n" + lists));
    bytes.add(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f);
    const Error error =
        error_of([&] { decode_mesh(std::string(bytes) + repeated(row, kFaces), "ply"); });
    CHECK(error.code() == ErrorCode::file_too_large);
}

TEST_CASE("messages show no bytes that cannot be printed") {
    const std::string junk = "\x01\x7f\x80\xff\xc2\x9b\xed\xa0\x80\xf8\xc3";
    for (const Attack& attack : std::vector<Attack>{
             {"obj", "v 0 0 0\n" + junk + " 1\n"},
             {"obj", "v 0 0 " + junk + "\n"},
             {"off", junk + "\n1 1 0\n"},
             {"off", "OFF\n1 1 " + junk + "\n"},
             {"stl", junk + "\nsolid\n"},
             {"ply", "ply\n" + junk + "\n"},
             {"ply", ply_header("ascii", "element " + junk + " 999999999\n")},
             {"ply", ply_header("ascii", "element " + junk + " 3\nproperty int a\n") + "1\n"},
             {"ply", ply_header("ascii", "element vertex 1\nproperty int " + junk + "\n")}}) {
        CAPTURE(attack.extension);
        const Error error = error_of([&] { decode_mesh(attack.bytes, attack.extension); });
        for (const char c : error.message()) {
            const auto byte = static_cast<unsigned char>(c);
            CHECK((byte >= 0x20 && byte < 0x7f));
        }
    }
    const Error error = error_of([] { decode_mesh("v 0 0 \xc3\xa4\n", "obj"); });
    CHECK(error.message().find("'\xc3\xa4'") != std::string::npos);
}
