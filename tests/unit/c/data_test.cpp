#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

// A tetrahedron without symmetry whose faces look outward, in a host's space.
struct Tetrahedron {
    float positions[4][5] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}};  // with gaps
    std::uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
};

lissom_mesh add(const Host& host, const Tetrahedron& shape) {
    const lissom_input points{shape.positions, 4, 5 * sizeof(float), LISSOM_FLOAT32};
    const lissom_input faces{shape.corners, 12, 0, LISSOM_UINT32};
    lissom_mesh mesh{};
    REQUIRE(lissom_mesh_create(host, &points, &faces, nullptr, &mesh) == LISSOM_OK);
    return mesh;
}

// The mesh as the kernel has it, by a file, which keeps the kernel's space.
Mesh as_kernel(const Host& host, lissom_mesh mesh) {
    lissom_bytes bytes{};
    REQUIRE(lissom_mesh_encode(host, mesh, "obj", nullptr, &bytes) == LISSOM_OK);
    const std::string text(static_cast<const char*>(bytes.data), bytes.size);
    std::vector<Vec3> points;
    FaceList faces;
    std::size_t line = 0;
    while (line < text.size()) {
        double x, y, z;
        int a, b, c;
        if (std::sscanf(text.c_str() + line, "v %lf %lf %lf", &x, &y, &z) == 3) {
            points.emplace_back(x, y, z);
        } else if (std::sscanf(text.c_str() + line, "f %d %d %d", &a, &b, &c) == 3) {
            faces.add({a - 1, b - 1, c - 1});
        }
        line = text.find('\n', line) + 1;
    }
    return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("in every space of a host meshes come in facing outward, and go out as they came") {
    for (int bits = 0; bits < 8; ++bits) {
        CAPTURE(bits);
        auto options = lissom_default_context_options();
        options.space = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
        const Host host(options);
        Tetrahedron shape;
        // Faces of the host look outward: the corners above do so, seen counter-clockwise, in a
        // right-handed space.
        const bool mirrored = (bits & 2) != 0, clockwise = (bits & 4) != 0;
        if (mirrored != clockwise) {
            for (int f = 0; f < 4; ++f)
                std::swap(shape.corners[3 * f + 1], shape.corners[3 * f + 2]);
        }
        const lissom_mesh mesh = add(host, shape);
        const Mesh kernel = as_kernel(host, mesh);
        CHECK(volume(kernel) == doctest::Approx(5.0));
        // What is up for the host is up for the kernel.
        const Vec3 up = kernel.position((bits & 1) != 0 ? 3 : 2);
        CHECK(up.isApprox(Vec3(0, (bits & 1) != 0 ? 5 : 3, 0)));

        float out[4][4];
        const lissom_output points{out, 4, sizeof out[0], LISSOM_FLOAT32};
        REQUIRE(lissom_mesh_read_positions(host, mesh, &points) == LISSOM_OK);
        for (int v = 0; v < 4; ++v) CHECK(std::memcmp(out[v], shape.positions[v], 12) == 0);
        std::uint32_t corners[12];
        const lissom_output triangles{corners, 4, 0, LISSOM_UINT32};
        REQUIRE(lissom_mesh_read_triangles(host, mesh, &triangles) == LISSOM_OK);
        CHECK(std::memcmp(corners, shape.corners, sizeof corners) == 0);

        // A transform of the host's space does to its points what it says.
        const lissom_transform move{{0, -1, 0, 7, 1, 0, 0, 8, 0, 0, 1, 9}};
        REQUIRE(lissom_mesh_transform(host, mesh, &move) == LISSOM_OK);
        REQUIRE(lissom_mesh_read_positions(host, mesh, &points) == LISSOM_OK);
        for (int v = 0; v < 4; ++v) {
            const float* p = shape.positions[v];
            CHECK(
                Vec3(out[v][0], out[v][1], out[v][2]).isApprox(Vec3(7 - p[1], 8 + p[0], 9 + p[2])));
        }
        double least[3], greatest[3];
        REQUIRE(lissom_mesh_bounds(host, mesh, least, greatest) == LISSOM_OK);
        CHECK(Vec3(least[0], least[1], least[2]).isApprox(Vec3(4, 8, 9)));
        CHECK(Vec3(greatest[0], greatest[1], greatest[2]).isApprox(Vec3(7, 10, 14)));
    }
}

TEST_CASE("polygons keep their corners, and lists without room are refused") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    CHECK(lissom_mesh_face_count(host, mesh) == 6);
    CHECK(lissom_mesh_corner_count(host, mesh) == 24);
    CHECK(lissom_mesh_triangle_count(host, mesh) == 12);
    CHECK(lissom_mesh_boundary_count(host, mesh) == 0);
    std::int32_t corners[24], sizes[6];
    const lissom_output c{corners, 24, 0, LISSOM_INT32}, s{sizes, 6, 0, LISSOM_INT32};
    CHECK(lissom_mesh_read_faces(host, mesh, &c, &s) == LISSOM_OK);
    for (const auto size : sizes) CHECK(size == 4);
    const lissom_output tight{corners, 23, 0, LISSOM_INT32};
    CHECK(lissom_mesh_read_faces(host, mesh, &tight, nullptr) == LISSOM_OUT_OF_RANGE);
    const lissom_output floats{corners, 24, 0, LISSOM_FLOAT32};
    CHECK(lissom_mesh_read_faces(host, mesh, &floats, nullptr) == LISSOM_INVALID_ARGUMENT);
    const lissom_output nowhere{nullptr, 8, 0, LISSOM_FLOAT32};
    CHECK(lissom_mesh_read_positions(host, mesh, &nowhere) == LISSOM_INVALID_ARGUMENT);
}

TEST_CASE("lists of the host that make no sense are refused") {
    const Host host;
    const Tetrahedron shape;
    const lissom_input points{shape.positions, 4, 5 * sizeof(float), LISSOM_FLOAT32};
    lissom_mesh mesh{};
    const auto create = [&](const lissom_input& p, const lissom_input& c, const lissom_input* s) {
        return lissom_mesh_create(host, &p, &c, s, &mesh);
    };
    const lissom_input faces{shape.corners, 12, 0, LISSOM_UINT32};
    CHECK(create(points, {shape.corners, 11, 0, LISSOM_UINT32}, nullptr) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(create(points, {shape.corners, 12, 0, LISSOM_FLOAT32}, nullptr) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(create({shape.positions, 4, 8, LISSOM_FLOAT32}, faces, nullptr) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(create({nullptr, 4, 0, LISSOM_FLOAT32}, faces, nullptr) == LISSOM_INVALID_ARGUMENT);
    const std::uint32_t huge[] = {0, 1, 0xffffffffu};
    CHECK(create(points, {huge, 3, 0, LISSOM_UINT32}, nullptr) == LISSOM_OUT_OF_RANGE);
    const std::uint32_t sizes[] = {3, 3, 3};
    const lissom_input three{sizes, 3, 0, LISSOM_UINT32};
    CHECK(create(points, faces, &three) == LISSOM_INVALID_ARGUMENT);
    const double nan[] = {0, 0, 0, 1, 0, 0, 0, NAN, 0, 0, 0, 1};
    CHECK(create({nan, 4, 0, LISSOM_FLOAT64}, faces, nullptr) == LISSOM_NOT_FINITE);
    CHECK(lissom_object_count(host) == 0);
    CHECK(create(points, faces, nullptr) == LISSOM_OK);
}

TEST_CASE(
    "positions beyond a format's range are its greatest numbers, and normals are of unit length") {
    const Host host;
    Mesh shape = make_box({});
    for (Vec3& p : shape.edit_positions()) p *= 1e200;
    const lissom_mesh mesh = host.add(shape);
    float points[8][3], normals[8][3];
    const lissom_output p{points, 8, 0, LISSOM_FLOAT32}, n{normals, 8, 0, LISSOM_FLOAT32};
    REQUIRE(lissom_mesh_read_positions(host, mesh, &p) == LISSOM_OK);
    REQUIRE(lissom_mesh_read_normals(host, mesh, &n) == LISSOM_OK);
    for (std::size_t v = 0; v < 8; ++v) {
        double square = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(std::abs(points[v][k]) == std::numeric_limits<float>::max());
            square += double{normals[v][k]} * normals[v][k];
        }
        CHECK(square == doctest::Approx(1.0));
    }
}

TEST_CASE("normals are written as bytes and shorts too") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    std::int8_t bytes[8][4] = {};
    std::int16_t shorts[8][4] = {};
    const lissom_output b{bytes, 8, sizeof bytes[0], LISSOM_SNORM8},
        s{shorts, 8, sizeof shorts[0], LISSOM_SNORM16};
    REQUIRE(lissom_mesh_read_normals(host, mesh, &b) == LISSOM_OK);
    REQUIRE(lissom_mesh_read_normals(host, mesh, &s) == LISSOM_OK);
    for (std::size_t v = 0; v < 8; ++v) {
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(std::abs(bytes[v][k]) == 73);
            CHECK(std::abs(std::abs(shorts[v][k] / 32767.0) - 1.0 / std::sqrt(3.0)) < 1e-4);
        }
        CHECK(bytes[v][3] == 0);
    }
}

TEST_CASE("an error of wrong vertices names all of them") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    const std::int32_t vertices[] = {0, -1, 99999, -7};
    const lissom_input list{vertices, 4, 0, LISSOM_INT32};
    lissom_region region{};
    CHECK(lissom_region_of_vertices(host, mesh, &list, &region) == LISSOM_OUT_OF_RANGE);
    const lissom_error& error = *lissom_last_error(host);
    CHECK(error.element == LISSOM_VERTEX);
    REQUIRE(error.element_count == 3);
    CHECK(std::vector<std::int32_t>(error.ids, error.ids + 3) ==
          std::vector<std::int32_t>{-1, 99999, -7});
    const std::uint32_t large[] = {0, 3000000000u};
    const lissom_input unsigned_list{large, 2, 0, LISSOM_UINT32};
    CHECK(lissom_region_of_vertices(host, mesh, &unsigned_list, &region) == LISSOM_OUT_OF_RANGE);
    CHECK(host.message().find("3000000000") != std::string::npos);
}

TEST_CASE("a region grows and shrinks by any number of rings") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({.segments = {4, 4, 4}}));
    const double up[] = {0, 1, 0}, origin[] = {0, 0, 0};
    lissom_region top{}, result{};
    REQUIRE(lissom_region_plane(host, mesh, origin, up, &top) == LISSOM_OK);
    for (const std::int32_t rings : {INT32_MIN, INT32_MIN + 1, -100}) {
        REQUIRE(lissom_region_grow(host, top, rings, &result) == LISSOM_OK);
        CHECK(lissom_region_size(host, result) == 0);
    }
    REQUIRE(lissom_region_grow(host, top, INT32_MAX, &result) == LISSOM_OK);
    CHECK(lissom_region_size(host, result) == lissom_mesh_vertex_count(host, mesh));
}

TEST_CASE("a file of no bytes is empty, and wrong faces of a buffer are of no file") {
    const Host host;
    lissom_mesh mesh{};
    CHECK(lissom_mesh_decode(host, "", 0, "obj", nullptr, &mesh) == LISSOM_FILE_EMPTY);
    const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint16_t corners[] = {0, 1, 7};
    lissom_buffer buffer = lissom_default_buffer();
    buffer.positions = {points, 3, 0, LISSOM_FLOAT32};
    buffer.corners = {corners, 3, 0, LISSOM_UINT16};
    CHECK(lissom_mesh_create_welded(host, &buffer, &mesh, nullptr) == LISSOM_FACE_INDEX);
    CHECK(host.message().find("outside the 3 given") != std::string::npos);
}

TEST_CASE("regions select, combine and are kept with their mesh") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({.segments = {4, 4, 4}}));
    const double up[] = {0, 1, 0}, origin[] = {0, 0, 0};
    lissom_region top{}, rest{}, none{}, all{}, named{};
    REQUIRE(lissom_region_plane(host, mesh, origin, up, &top) == LISSOM_OK);
    REQUIRE(lissom_region_invert(host, top, &rest) == LISSOM_OK);
    REQUIRE(lissom_region_combine(host, top, rest, LISSOM_INTERSECTION, &none) == LISSOM_OK);
    REQUIRE(lissom_region_combine(host, top, rest, LISSOM_UNION, &all) == LISSOM_OK);
    CHECK(lissom_region_size(host, none) == 0);
    CHECK(lissom_region_size(host, all) == lissom_mesh_vertex_count(host, mesh));
    REQUIRE(lissom_mesh_set_region(host, mesh, "top", top) == LISSOM_OK);
    REQUIRE(lissom_region_named(host, mesh, "top", &named) == LISSOM_OK);
    CHECK(lissom_region_size(host, named) == lissom_region_size(host, top));
    CHECK(lissom_region_named(host, mesh, "tip", &named) == LISSOM_OUT_OF_RANGE);
    const lissom_mesh other = host.add(make_box({}));
    lissom_region foreign{}, mixed{};
    REQUIRE(lissom_region_all(host, other, &foreign) == LISSOM_OK);
    CHECK(lissom_region_combine(host, top, foreign, LISSOM_UNION, &mixed) ==
          LISSOM_TOPOLOGY_MISMATCH);
}

TEST_CASE("files go through the host where it opens them") {
    std::map<std::string, std::string> files;
    auto options = lissom_default_context_options();
    options.user = &files;
    options.read_file = [](void* user, const char* path, lissom_sink* sink, void* argument) {
        const auto& table = *static_cast<std::map<std::string, std::string>*>(user);
        const auto found = table.find(path);
        if (found == table.end()) return false;
        // In two pieces.
        const std::size_t half = found->second.size() / 2;
        sink(argument, found->second.data(), half);
        sink(argument, found->second.data() + half, found->second.size() - half);
        return true;
    };
    options.write_file = [](void* user, const char* path, const void* bytes, std::size_t size) {
        (*static_cast<std::map<std::string, std::string>*>(user))[path] =
            std::string(static_cast<const char*>(bytes), size);
        return true;
    };
    const Host host(options);
    const lissom_mesh mesh = host.add(make_box({}));
    REQUIRE(lissom_mesh_save(host, mesh, "pack/box.ply", nullptr) == LISSOM_OK);
    CHECK(files.count("pack/box.ply") == 1);
    lissom_mesh back{};
    REQUIRE(lissom_mesh_load(host, "pack/box.ply", nullptr, &back) == LISSOM_OK);
    CHECK(host.positions(back) == host.positions(mesh));
    CHECK(lissom_mesh_load(host, "pack/none.ply", nullptr, &back) == LISSOM_FILE_NOT_FOUND);
}

TEST_CASE("a stride that leads around the end of memory is refused, for lists of both ways") {
    const Host host;
    const lissom_mesh mesh = add(host, {});
    double numbers[12] = {};
    std::int32_t integers[12] = {};
    for (std::size_t back = 1; back <= 64; ++back) {
        const std::size_t stride = std::size_t{0} - back;
        const lissom_output out{numbers, 4, stride, LISSOM_FLOAT64};
        CHECK(lissom_mesh_read_positions(host, mesh, &out) == LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_mesh_read_normals(host, mesh, &out) == LISSOM_INVALID_ARGUMENT);
        const lissom_output ids{integers, 4, stride, LISSOM_INT32};
        CHECK(lissom_mesh_read_triangles(host, mesh, &ids) == LISSOM_INVALID_ARGUMENT);
        const lissom_input in{numbers, 4, stride, LISSOM_FLOAT64};
        CHECK(lissom_mesh_set_positions(host, mesh, &in) == LISSOM_INVALID_ARGUMENT);
        const lissom_input few{integers, 2, stride, LISSOM_INT32};
        lissom_region region{};
        CHECK(lissom_region_of_vertices(host, mesh, &few, &region) == LISSOM_INVALID_ARGUMENT);
    }
    CHECK(std::all_of(numbers, numbers + 12, [](double n) { return n == 0.0; }));
}

}  // namespace lissom::test
