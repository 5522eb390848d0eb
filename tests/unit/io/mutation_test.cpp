// Damaged files: whatever the bytes are, a reader returns a mesh or throws an Error.
#include <functional>

#include "tests/unit/io/damage.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A small mesh with everything that a format can hold.
Mesh rich_mesh() {
    Mesh mesh = prism(5);
    const Index vertices = mesh.vertex_count(), corners = mesh.topology().corner_count();
    mesh.attributes().add({"color", Domain::vertex, 3, ScalarType::uint8,
                           rounded_to_bytes(numbers(3 * vertices, 1))});
    mesh.attributes().add({"uv", Domain::corner, 2, ScalarType::float32, numbers(2 * corners, 2)});
    mesh.attributes().add(
        {"normal", Domain::vertex, 3, ScalarType::float32, numbers(3 * vertices, 3)});
    mesh.attributes().add({"w", Domain::face, 2, ScalarType::int16, std::vector<double>(14, 5.0)});
    mesh.attributes().labels()["object"] = {{"one", "two"}, {0, 0, 1, 1, 0, 0, 1}};
    mesh.material_libraries() = {"a.mtl"};
    mesh.set_region("left hand", Region(mesh.shared_topology(), {0, 1, 4}));
    mesh.attributes().add({"uv2", Domain::corner, 2, ScalarType::float32, numbers(2 * corners, 4)});
    return mesh;
}

std::string binary_off_sample() {
    Bytes bytes("OFF BINARY\n", true);
    bytes.add(std::int32_t{4}, std::int32_t{2}, std::int32_t{5});
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) bytes.add(x);
    for (const std::int32_t i : {3, 0, 1, 2, 0, 3, 0, 2, 3, 0}) bytes.add(i);
    return bytes;
}

constexpr std::string_view kLetters = "0123456789-. \n";

struct Sample {
    std::string extension, bytes;
};

std::vector<Sample> samples() {
    const Mesh mesh = rich_mesh();
    return {{"obj", encode_mesh(mesh, "obj")},
            {"ply", encode_mesh(mesh, "ply")},
            {"ply", encode_mesh(mesh, "ply", {.endianness = Endianness::big})},
            {"ply", encode_mesh(mesh, "ply", {.binary = false})},
            {"off", encode_mesh(mesh, "off")},
            {"off", binary_off_sample()},
            {"glb", encode_mesh(mesh, "glb")},
            {"gltf", encode_mesh(mesh, "gltf")},
            {"stl", encode_mesh(mesh, "stl")},
            {"stl", encode_mesh(mesh, "stl", {.binary = false})}};
}

// Checks that the bytes are read or refused as they should be; whether they were read.
bool is_read(const std::string& bytes, const std::string& extension) {
    try {
        decode_mesh(bytes, extension);
        return true;
    } catch (const Error& error) {
        CHECK(error.code() != ErrorCode::internal);
        CHECK_FALSE(error.message().empty());
        return false;
    }
}

}  // namespace

TEST_CASE("a file that is cut short anywhere is read or refused") {
    for (const Sample& sample : samples()) {
        CAPTURE(sample.extension);
        for (std::size_t size = 0; size < sample.bytes.size(); size += 7) {
            CAPTURE(size);
            is_read(sample.bytes.substr(0, size), sample.extension);
        }
    }
}

TEST_CASE("a file with damaged bytes is read or refused") {
    std::mt19937 random(7);
    for (const Sample& sample : samples()) {
        CAPTURE(sample.extension);
        int read = 0;
        for (int i = 0; i < 200; ++i) {
            CAPTURE(i);
            read += is_read(damaged(sample.bytes, random, kLetters), sample.extension);
        }
        // Some damage does no harm: what is undamaged is read.
        CHECK(is_read(sample.bytes, sample.extension));
        CHECK(read >= 5);
    }
}

TEST_CASE("noise is refused or read, under every extension") {
    std::mt19937 random(8);
    for (const std::string& extension : readable_extensions()) {
        for (int i = 0; i < 50; ++i) {
            std::string bytes(random() % 300, '\0');
            for (char& c : bytes) c = static_cast<char>(random());
            is_read(bytes, extension);
        }
    }
}
