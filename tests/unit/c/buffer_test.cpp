// Vertex buffers of engines: seams, index types, strides, normals and tangents per render vertex.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/render/render_map.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/c/host.h"

namespace lissom::test {
namespace {

using Point = std::array<float, 3>;

// A grid rolled to a tube and cut along random seams, as an exporter writes it.
struct EngineBuffer {
    std::vector<Point> positions;
    std::vector<std::array<float, 2>> uvs;
    std::vector<std::uint32_t> corners;

    Index size() const { return count_of(positions); }
};

EngineBuffer tube(int around, int along, unsigned seed) {
    std::mt19937 random(seed);
    EngineBuffer buffer;
    // A vertex for each place and each chart of texture coordinates.
    std::map<std::array<int, 3>, std::uint32_t> known;
    const auto vertex = [&](int i, int j, int chart) {
        const auto [found, is_new] = known.try_emplace({i, j, chart}, buffer.size());
        if (!is_new) return found->second;
        const double angle = 6.283185307179586 * (i % around) / around;
        buffer.positions.push_back({static_cast<float>(std::cos(angle)),
                                    static_cast<float>(2.0 * j / along),
                                    static_cast<float>(std::sin(angle))});
        buffer.uvs.push_back(
            {static_cast<float>(i) / static_cast<float>(around) + 3.0f * static_cast<float>(chart),
             static_cast<float>(j) / static_cast<float>(along)});
        return found->second;
    };
    for (int j = 0; j < along; ++j) {
        for (int i = 0; i < around; ++i) {
            const int chart = static_cast<int>(random() % 3);
            const auto a = vertex(i, j, chart), b = vertex(i + 1, j, chart),
                       c = vertex(i + 1, j + 1, chart), d = vertex(i, j + 1, chart);
            buffer.corners.insert(buffer.corners.end(), {a, c, b, a, d, c});
        }
    }
    return buffer;
}

// The same vertices among others of a host, `stride` bytes apart.
std::vector<unsigned char> interleaved(const EngineBuffer& buffer, std::size_t stride) {
    std::vector<unsigned char> bytes(stride * buffer.positions.size(), 0xab);
    for (std::size_t i = 0; i < buffer.positions.size(); ++i) {
        std::memcpy(bytes.data() + i * stride, buffer.positions[i].data(), 12);
    }
    return bytes;
}

template <typename Number>
std::vector<Number> as_numbers(const std::vector<std::uint32_t>& list) {
    return {list.begin(), list.end()};
}

lissom_buffer welded_buffer(const EngineBuffer& from) {
    lissom_buffer buffer = lissom_default_buffer();
    buffer.positions = {from.positions.data(), from.positions.size(), 0, LISSOM_FLOAT32};
    buffer.corners = {from.corners.data(), from.corners.size(), 0, LISSOM_UINT32};
    buffer.uvs = {from.uvs.data(), from.uvs.size(), 0, LISSOM_FLOAT32};
    return buffer;
}

struct Welded {
    lissom_mesh mesh{};
    lissom_render_map map{};
};

Welded weld(const Host& host, const lissom_buffer& buffer) {
    Welded made;
    const lissom_status status = lissom_mesh_create_welded(host, &buffer, &made.mesh, &made.map);
    REQUIRE_MESSAGE(status == LISSOM_OK, host.message());
    return made;
}

std::vector<Index> vertices_of(const Host& host, lissom_render_map map) {
    std::vector<Index> list(at(lissom_render_map_size(host, map)));
    const lissom_output out{list.data(), list.size(), 0, LISSOM_INT32};
    REQUIRE(lissom_render_map_read_vertices(host, map, &out) == LISSOM_OK);
    return list;
}

std::vector<Vec3> render_points(const Host& host, const Welded& welded) {
    std::vector<Vec3> points(at(lissom_render_map_size(host, welded.map)), Vec3(9, 9, 9));
    const lissom_output out{points.data(), points.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_render_map_read_positions(host, welded.map, welded.mesh, &out) == LISSOM_OK);
    return points;
}

std::vector<Vec3> render_normals_of(const Host& host, const Welded& welded) {
    std::vector<Vec3> normals(at(lissom_render_map_size(host, welded.map)));
    const lissom_output out{normals.data(), normals.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_render_map_read_normals(host, welded.map, welded.mesh, &out) == LISSOM_OK);
    return normals;
}

std::vector<Vec4> tangents_of(const Host& host, const Welded& welded) {
    std::vector<Vec4> tangents(at(lissom_render_map_size(host, welded.map)));
    const lissom_output out{tangents.data(), tangents.size(), 0, LISSOM_FLOAT64};
    REQUIRE_MESSAGE(
        lissom_render_map_read_tangents(host, welded.map, welded.mesh, nullptr, &out) == LISSOM_OK,
        host.message());
    return tangents;
}

// Every triangle in turn from its smallest corner.
std::multiset<std::array<std::uint32_t, 3>> triangle_set(const std::vector<std::uint32_t>& list) {
    std::multiset<std::array<std::uint32_t, 3>> set;
    for (std::size_t i = 0; i < list.size(); i += 3) {
        std::array<std::uint32_t, 3> one{list[i], list[i + 1], list[i + 2]};
        std::rotate(one.begin(), std::min_element(one.begin(), one.end()), one.end());
        set.insert(one);
    }
    return set;
}

}  // namespace

TEST_CASE("fans of faces that seams part at a vertex have a render vertex and a tangent each") {
    // Four triangles around a vertex: texture coordinates of two opposite ones are turned, so that
    // seams run along all four edges although the values at the vertex itself are the same.
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    FaceList faces;
    for (const std::array<Index, 3>& face :
         {std::array<Index, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}) {
        faces.add(face);
    }
    Mesh mesh(points, faces);
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float64, {}};
    for (Index f = 0; f < 4; ++f) {
        for (Index k = 0; k < 3; ++k) {
            const Vec3& p = mesh.position(mesh.topology().face(f)[at(k)]);
            const double x = f % 2 == 0 ? p.x() : -p.y(), y = f % 2 == 0 ? p.y() : p.x();
            uv.values.insert(uv.values.end(), {x, y});
        }
    }
    mesh.attributes().add(std::move(uv));
    const RenderMap map = render_map(mesh);
    CHECK(map.size() == 12);
    const std::vector<Tangent> tangents = render_tangents(map, mesh, "uv");
    for (Index f = 0; f < 4; ++f) {
        const Vec3 wanted = f % 2 == 0 ? Vec3(1, 0, 0) : Vec3(0, -1, 0);
        const Index corner = mesh.topology().first_corner(f);
        CHECK((tangents[at(map.of_corner[at(corner)])].direction - wanted).norm() < 1e-12);
    }
    mesh.attributes().remove("uv");
    CHECK(render_map(mesh).size() == 5);
}

TEST_CASE("a buffer with random seams is welded as equal places are, and its vertices come back") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        const EngineBuffer buffer = tube(5 + static_cast<int>(seed), 4, seed);
        const Host host;
        const Welded welded = weld(host, welded_buffer(buffer));
        std::map<Point, Index> places;
        for (const Point& point : buffer.positions) places.try_emplace(point, count_of(places));
        CHECK(lissom_mesh_vertex_count(host, welded.mesh) == count_of(places));
        REQUIRE(lissom_render_map_size(host, welded.map) == buffer.size());
        const std::vector<Index> map = vertices_of(host, welded.map);
        std::map<Index, Index> of_place;
        for (std::size_t i = 0; i < map.size(); ++i) {
            REQUIRE(map[i] >= 0);
            CHECK(of_place.try_emplace(places[buffer.positions[i]], map[i]).first->second ==
                  map[i]);
        }
        const std::vector<Vec3> points = render_points(host, welded);
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (int k = 0; k < 3; ++k) CHECK(points[i][k] == buffer.positions[i][at(k)]);
        }
        std::vector<std::uint32_t> triangles(
            3 * at(lissom_render_map_triangle_count(host, welded.map)));
        const lissom_output out{triangles.data(), triangles.size() / 3, 0, LISSOM_UINT32};
        REQUIRE(lissom_render_map_read_triangles(host, welded.map, welded.mesh, &out) == LISSOM_OK);
        CHECK(triangle_set(triangles) == triangle_set(buffer.corners));
    }
}

TEST_CASE("normals do not see a seam of texture coordinates, but keep creases") {
    const EngineBuffer buffer = tube(12, 4, 3);
    const Host host;
    const Welded welded = weld(host, welded_buffer(buffer));
    const std::vector<Index> map = vertices_of(host, welded.map);
    std::vector<Vec3> of_mesh(at(lissom_mesh_vertex_count(host, welded.mesh)));
    const lissom_output out{of_mesh.data(), of_mesh.size(), 0, LISSOM_FLOAT64};
    REQUIRE(lissom_mesh_read_normals(host, welded.mesh, &out) == LISSOM_OK);
    const std::vector<Vec3> normals = render_normals_of(host, welded);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        CHECK((normals[i] - of_mesh[at(map[i])]).norm() < 1e-14);
    }
    // A roof with a crease along its ridge: each side has its own normal, before and after a bend.
    const float roof[][3] = {{0, 1, 0}, {0, 1, 1}, {1, 0, 0},  {1, 0, 1},
                             {0, 1, 0}, {0, 1, 1}, {-1, 0, 0}, {-1, 0, 1}};
    const float given[][3] = {{1, 1, 0},  {1, 1, 0},  {1, 1, 0},  {1, 1, 0},
                              {-1, 1, 0}, {-1, 1, 0}, {-1, 1, 0}, {-1, 1, 0}};
    const std::uint8_t corners[] = {0, 1, 2, 2, 1, 3, 4, 6, 5, 6, 7, 5};
    lissom_buffer edged = lissom_default_buffer();
    edged.positions = {roof, 8, 0, LISSOM_FLOAT32};
    edged.normals = {given, 8, 0, LISSOM_FLOAT32};
    edged.corners = {corners, 12, 0, LISSOM_UINT8};
    const Welded sides = weld(host, edged);
    CHECK(lissom_mesh_vertex_count(host, sides.mesh) == 6);
    for (const double x : {1.0, 2.0}) {
        const lissom_transform wide{{x, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
        REQUIRE(lissom_mesh_transform(host, sides.mesh, &wide) == LISSOM_OK);
    }
    const std::vector<Vec3> creased = render_normals_of(host, sides);
    for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 wanted = Vec3(i < 4 ? 1.0 : -1.0, 2.0, 0.0).normalized();
        CHECK((creased[i] - wanted).norm() < 1e-12);
    }
}

TEST_CASE("indices of 8, 16 and 32 bits and strides of 12 to 48 bytes make the same mesh") {
    const EngineBuffer buffer = tube(6, 4, 5);
    REQUIRE(buffer.size() < 256);
    const Host host;
    const std::uint64_t wanted = host.hash(weld(host, welded_buffer(buffer)).mesh);
    const auto bytes = as_numbers<std::uint8_t>(buffer.corners);
    const auto words = as_numbers<std::uint16_t>(buffer.corners);
    const lissom_input indices[] = {
        {bytes.data(), bytes.size(), 0, LISSOM_UINT8},
        {words.data(), words.size(), 0, LISSOM_UINT16},
        {buffer.corners.data(), buffer.corners.size(), 0, LISSOM_INT32}};
    for (const std::size_t stride : {12u, 16u, 32u, 48u}) {
        CAPTURE(stride);
        const auto vertices = interleaved(buffer, stride);
        for (const lissom_input& corners : indices) {
            lissom_buffer given = welded_buffer(buffer);
            given.positions = {vertices.data(), buffer.positions.size(), stride, LISSOM_FLOAT32};
            given.corners = corners;
            const Welded welded = weld(host, given);
            CHECK(host.hash(welded.mesh) == wanted);
            // Back into the host's vertices: bytes between them stay.
            auto out_bytes = vertices;
            const lissom_output out{out_bytes.data(), buffer.positions.size(), stride,
                                    LISSOM_FLOAT32};
            REQUIRE(lissom_render_map_read_positions(host, welded.map, welded.mesh, &out) ==
                    LISSOM_OK);
            CHECK(out_bytes == vertices);
            const std::size_t count = buffer.corners.size() / 3;
            std::vector<std::uint8_t> small(3 * count);
            const lissom_output triangles{small.data(), count, 0, LISSOM_UINT8};
            CHECK(lissom_render_map_read_triangles(host, welded.map, welded.mesh, &triangles) ==
                  LISSOM_OK);
            CHECK(triangle_set({small.begin(), small.end()}) == triangle_set(buffer.corners));
        }
    }
}

TEST_CASE("indices that a format cannot hold and overlapping strides are refused") {
    const EngineBuffer buffer = tube(30, 20, 1);
    REQUIRE(buffer.size() > 256);
    const Host host;
    const Welded welded = weld(host, welded_buffer(buffer));
    std::vector<std::uint8_t> small(buffer.corners.size(), 7);
    const lissom_output bytes{small.data(), small.size() / 3, 0, LISSOM_UINT8};
    CHECK(lissom_render_map_read_triangles(host, welded.map, welded.mesh, &bytes) ==
          LISSOM_OUT_OF_RANGE);
    CHECK(std::count(small.begin(), small.end(), 7) == static_cast<long>(small.size()));
    std::vector<float> room(4 * at(buffer.size()));
    for (const std::size_t stride : {1u, 4u, 8u, 11u}) {
        const lissom_output out{room.data(), at(buffer.size()), stride, LISSOM_FLOAT32};
        CHECK(lissom_mesh_read_positions(host, welded.mesh, &out) == LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_mesh_read_normals(host, welded.mesh, &out) == LISSOM_INVALID_ARGUMENT);
        CHECK(
            lissom_mesh_read_triangles(
                host, welded.mesh,
                std::array{lissom_output{room.data(), buffer.corners.size(), stride, LISSOM_UINT32}}
                    .data()) == LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_render_map_read_positions(host, welded.map, welded.mesh, &out) ==
              LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_render_map_read_tangents(host, welded.map, welded.mesh, nullptr, &out) ==
              LISSOM_INVALID_ARGUMENT);
        CHECK(lissom_mesh_read_attribute(
                  host, welded.mesh, "uv",
                  std::array{lissom_output{room.data(), room.size(), stride < 8 ? stride : 7,
                                           LISSOM_FLOAT32}}
                      .data()) != LISSOM_OK);
    }
    lissom_output unknown{room.data(), room.size(), 0, static_cast<lissom_format>(55)};
    CHECK(lissom_mesh_read_positions(host, welded.mesh, &unknown) == LISSOM_INVALID_ARGUMENT);
    std::uint32_t beyond[] = {0, 1, 99999};
    lissom_buffer bad = welded_buffer(buffer);
    bad.corners = {beyond, 3, 0, LISSOM_UINT32};
    Welded none;
    CHECK(lissom_mesh_create_welded(host, &bad, &none.mesh, &none.map) == LISSOM_FACE_INDEX);
    bad = welded_buffer(buffer);
    bad.uvs.count = 3;
    CHECK(lissom_mesh_create_welded(host, &bad, &none.mesh, &none.map) == LISSOM_INVALID_ARGUMENT);
    bad = welded_buffer(buffer);
    bad.weld = static_cast<lissom_weld>(55);
    CHECK(lissom_mesh_create_welded(host, &bad, &none.mesh, &none.map) == LISSOM_INVALID_ARGUMENT);
    CHECK(none.mesh.id == 0);
    CHECK(none.map.id == 0);
}

TEST_CASE("buffers of nothing, of one triangle, and of broken faces") {
    const Host host;
    lissom_buffer buffer = lissom_default_buffer();
    const Welded nothing = weld(host, buffer);
    CHECK(lissom_mesh_vertex_count(host, nothing.mesh) == 0);
    CHECK(lissom_render_map_size(host, nothing.map) == 0);
    const float points[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {5, 5, 5}};
    const std::uint16_t corners[] = {0, 1, 2, 1, 3, 2, 0, 0, 1};
    buffer.positions = {points, 5, 0, LISSOM_FLOAT32};
    buffer.corners = {corners, 3, 0, LISSOM_UINT16};
    CHECK(lissom_mesh_face_count(host, weld(host, buffer).mesh) == 1);
    // The second triangle has no area once it is welded, the third none at all: they are dropped,
    // vertex 3 lies on 1, and vertex 4 on nothing.
    buffer.corners.count = 9;
    buffer.weld = LISSOM_WELD_ALL;
    const Welded repaired = weld(host, buffer);
    CHECK(lissom_mesh_face_count(host, repaired.mesh) == 1);
    CHECK(vertices_of(host, repaired.map) == std::vector<Index>{0, 1, 2, 1, -1});
    const std::vector<Vec3> places = render_points(host, repaired);
    CHECK(places[3] == Vec3(1, 0, 0));
    CHECK(places[4] == Vec3(9, 9, 9));
    buffer.repair = false;
    Welded none;
    CHECK(lissom_mesh_create_welded(host, &buffer, &none.mesh, &none.map) != LISSOM_OK);
}

TEST_CASE("a map is refused after a change of topology, and a new one has what the mesh has") {
    const EngineBuffer buffer = tube(8, 4, 9);
    const Host host;
    const Welded welded = weld(host, welded_buffer(buffer));
    // A mirror turns the faces: another topology.
    const lissom_transform mirror{{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    REQUIRE(lissom_mesh_transform(host, welded.mesh, &mirror) == LISSOM_OK);
    std::vector<double> room(4 * at(buffer.size()));
    const lissom_output out{room.data(), at(buffer.size()), 0, LISSOM_FLOAT64};
    CHECK(lissom_render_map_read_positions(host, welded.map, welded.mesh, &out) ==
          LISSOM_TOPOLOGY_MISMATCH);
    CHECK(lissom_render_map_read_normals(host, welded.map, welded.mesh, &out) ==
          LISSOM_TOPOLOGY_MISMATCH);
    Welded again{welded.mesh, {}};
    REQUIRE(lissom_render_map_create(host, welded.mesh, &again.map) == LISSOM_OK);
    // Diagonal faces of one chart are two fans at their vertex: it is drawn twice.
    const std::int32_t size = lissom_render_map_size(host, again.map);
    CHECK(size >= buffer.size());
    std::vector<double> uvs(2 * at(size));
    const lissom_output pairs{uvs.data(), uvs.size() / 2, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_render_map_read_attribute(host, again.map, again.mesh, "uv", &pairs) ==
            LISSOM_OK);
    using Drawn = std::array<double, 5>;
    std::set<Drawn> wanted, found;
    const std::vector<Vec3> points = render_points(host, again);
    for (std::size_t i = 0; i < points.size(); ++i) {
        found.insert({points[i][0], points[i][1], points[i][2], uvs[2 * i], uvs[2 * i + 1]});
    }
    for (std::size_t i = 0; i < at(buffer.size()); ++i) {
        const Point& p = buffer.positions[i];
        wanted.insert({-p[0] + 0.0, p[1], p[2], buffer.uvs[i][0], buffer.uvs[i][1]});
    }
    CHECK(found == wanted);
    CHECK(lissom_render_map_release(host, again.map) == LISSOM_OK);
    CHECK_FALSE(lissom_render_map_is_valid(host, again.map));
}

TEST_CASE("tangents run along the texture and are at right angles to normals, in every space") {
    for (int bits = 0; bits < 8; ++bits) {
        CAPTURE(bits);
        auto options = lissom_default_context_options();
        options.space = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
        const Host host(options);
        const EngineBuffer buffer = tube(16, 4, 2);
        const Welded welded = weld(host, welded_buffer(buffer));
        const std::vector<Vec3> normals = render_normals_of(host, welded);
        const std::vector<Vec4> tangents = tangents_of(host, welded);
        for (std::size_t i = 0; i < tangents.size(); ++i) {
            const Vec3 tangent = tangents[i].head<3>();
            CHECK(tangent.norm() == doctest::Approx(1.0));
            CHECK(std::abs(tangent.dot(normals[i])) < 1e-12);
            // The texture's v runs up the tube.
            const Vec3 bitangent = tangents[i][3] * normals[i].cross(tangent);
            CHECK(bitangent.dot(Vec3::UnitY()) > 0.99);
            const Point& p = buffer.positions[i];
            CHECK(tangent.dot(Vec3(-p[2], 0, p[0])) > 0.9);
        }
    }
}

TEST_CASE("mirrored texture coordinates meet in two tangents") {
    // Two quads whose texture is mirrored at the edge between them.
    const double points[][3] = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
    const double uvs[][2] = {{1, 0}, {0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}};
    const std::int32_t corners[] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    const Host host;
    lissom_buffer buffer = lissom_default_buffer();
    buffer.positions = {points, 6, 0, LISSOM_FLOAT64};
    buffer.uvs = {uvs, 6, 0, LISSOM_FLOAT64};
    buffer.corners = {corners, 12, 0, LISSOM_INT32};
    const Welded given = weld(host, buffer);
    CHECK(lissom_render_map_size(host, given.map) == 6);
    Welded apart{given.mesh, {}};
    REQUIRE(lissom_render_map_create(host, given.mesh, &apart.map) == LISSOM_OK);
    CHECK(lissom_render_map_size(host, apart.map) == 8);
    const std::vector<Vec3> places = render_points(host, apart);
    const std::vector<Vec4> tangents = tangents_of(host, apart);
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        const bool is_left = tangents[i][0] < 0.0;
        (is_left ? left : right) += 1;
        if (places[i][0] != 0.0) CHECK(is_left == (places[i][0] < 0.0));
        CHECK(tangents[i][3] == (is_left ? -1.0 : 1.0));
    }
    CHECK(left == 4);
    CHECK(right == 4);
}

TEST_CASE("100,000 render vertices are welded and read") {
    const EngineBuffer buffer = tube(200, 250, 4);
    REQUIRE(buffer.size() > 100000);
    const Host host;
    const Welded welded = weld(host, welded_buffer(buffer));
    CHECK(lissom_mesh_vertex_count(host, welded.mesh) == 200 * 251);
    std::vector<std::int16_t> packed(4 * at(buffer.size()));
    const lissom_output normals{packed.data(), at(buffer.size()), 8, LISSOM_SNORM16};
    REQUIRE(lissom_render_map_read_normals(host, welded.map, welded.mesh, &normals) == LISSOM_OK);
    REQUIRE(lissom_render_map_read_tangents(host, welded.map, welded.mesh, nullptr, &normals) ==
            LISSOM_OK);
    for (std::size_t i = 0; i < packed.size(); i += 4) {
        const Vec3 t(packed[i], packed[i + 1], packed[i + 2]);
        REQUIRE(std::abs(t.norm() - 32767.0) < 2.0);
        REQUIRE(std::abs(packed[i + 3]) == 32767);
    }
}

TEST_CASE("attributes of every kind go in and out as views, in every space") {
    for (int bits = 0; bits < 8; ++bits) {
        CAPTURE(bits);
        auto options = lissom_default_context_options();
        options.space = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
        const Host host(options);
        const lissom_mesh mesh = host.add(make_box({}));
        struct Case {
            const char* name;
            lissom_domain domain;
            int width;
        };
        for (const Case& one :
             {Case{"uv", LISSOM_ON_CORNERS, 2}, Case{"uv2", LISSOM_ON_VERTICES, 2},
              Case{"color", LISSOM_ON_CORNERS, 4}, Case{"normal", LISSOM_ON_CORNERS, 3},
              Case{"tangent", LISSOM_ON_CORNERS, 4}, Case{"weights", LISSOM_ON_VERTICES, 4},
              Case{"morph.1.position", LISSOM_ON_VERTICES, 3}, Case{"heat", LISSOM_ON_FACES, 1}}) {
            CAPTURE(std::string(one.name));
            const int counts[] = {8, 24, 6};
            const auto count = at(counts[one.domain]), width = at(one.width);
            // Among other data of the host.
            const std::size_t stride = 4 * (width + 2);
            std::vector<float> given(count * (width + 2), 77.0f);
            for (std::size_t i = 0; i < count; ++i) {
                for (std::size_t k = 0; k < width; ++k) {
                    given[i * (width + 2) + k] =
                        static_cast<float>(i) + 0.25f * static_cast<float>(k);
                }
            }
            const lissom_input in{given.data(), count, stride, LISSOM_FLOAT32};
            REQUIRE_MESSAGE(lissom_mesh_write_attribute(host, mesh, one.name, one.domain, one.width,
                                                        &in) == LISSOM_OK,
                            host.message());
            lissom_attribute shape = lissom_default_attribute();
            REQUIRE(lissom_mesh_find_attribute(host, mesh, one.name, &shape) == LISSOM_OK);
            CHECK(std::string(shape.name) == one.name);
            CHECK(shape.domain == one.domain);
            CHECK(shape.width == one.width);
            CHECK(shape.count == counts[one.domain]);
            std::vector<float> back(given.size(), 77.0f);
            const lissom_output out{back.data(), count, stride, LISSOM_FLOAT32};
            REQUIRE(lissom_mesh_read_attribute(host, mesh, one.name, &out) == LISSOM_OK);
            CHECK(back == given);
            const lissom_output overlapping{back.data(), count, 4 * width - 1, LISSOM_FLOAT32};
            CHECK(lissom_mesh_read_attribute(host, mesh, one.name, &overlapping) ==
                  LISSOM_INVALID_ARGUMENT);
        }
        CHECK(lissom_mesh_attribute_count(host, mesh) == 8);
        CHECK(lissom_mesh_remove_attribute(host, mesh, "heat") == LISSOM_OK);
        CHECK(lissom_mesh_remove_attribute(host, mesh, "heat") == LISSOM_OUT_OF_RANGE);
    }
}

TEST_CASE("colours of bytes are numbers from 0 to 1, and shapes that no mesh has are refused") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    std::uint8_t colors[8][4];
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 4; ++k) colors[i][k] = static_cast<std::uint8_t>(30 * i + k);
    }
    const lissom_input in{colors, 8, 0, LISSOM_UNORM8};
    const auto write = [&](const char* name, lissom_domain domain, int width,
                           const lissom_input& list) {
        return lissom_mesh_write_attribute(host, mesh, name, domain, width, &list);
    };
    REQUIRE(write("color", LISSOM_ON_VERTICES, 4, in) == LISSOM_OK);
    double read[8][4];
    const lissom_output out{read, 8, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_mesh_read_attribute(host, mesh, "color", &out) == LISSOM_OK);
    CHECK(read[7][3] == doctest::Approx(213.0 / 255.0));
    std::uint8_t back[8][4];
    const lissom_output bytes{back, 8, 0, LISSOM_UNORM8};
    REQUIRE(lissom_mesh_read_attribute(host, mesh, "color", &bytes) == LISSOM_OK);
    CHECK(std::memcmp(back, colors, sizeof colors) == 0);
    const std::uint8_t five[8][5] = {};
    CHECK(write("color", LISSOM_ON_VERTICES, 5, {five, 8, 0, LISSOM_UNORM8}) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(write("color", LISSOM_ON_FACES, 4, in) == LISSOM_INVALID_ARGUMENT);
    CHECK(write("color", static_cast<lissom_domain>(7), 4, in) == LISSOM_INVALID_ARGUMENT);
    CHECK(write("", LISSOM_ON_VERTICES, 4, in) == LISSOM_INVALID_ARGUMENT);
    CHECK(write("heat", LISSOM_ON_VERTICES, 0, in) == LISSOM_INVALID_ARGUMENT);
    CHECK(write("uv", LISSOM_ON_VERTICES, 4, in) == LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_mesh_attribute_count(host, mesh) == 1);
}

// The value of a half float, from its bits.
double half_value(int bits) {
    const int exponent = bits >> 10 & 31, digits = bits & 1023;
    const double size =
        exponent == 0 ? digits * std::exp2(-24.0) : (1024 + digits) * std::exp2(exponent - 25.0);
    return bits & 0x8000 ? -size : size;
}

TEST_CASE("half floats go in and out bit by bit, and numbers go to the nearest of them") {
    const Host host;
    const Mesh own = make_sphere({.segments = 104});
    const lissom_mesh mesh = host.add(own);
    const std::size_t count = at(own.vertex_count());
    constexpr int kInfinity = 0x7c00;
    REQUIRE(count > 2 * std::size_t{kInfinity});
    std::vector<std::uint16_t> halves(count, 0);
    for (int i = 0; i < kInfinity; ++i) {
        halves[at(2 * i)] = static_cast<std::uint16_t>(i);
        halves[at(2 * i + 1)] = static_cast<std::uint16_t>(i | 0x8000);
    }
    const lissom_input in{halves.data(), count, 0, LISSOM_FLOAT16};
    const auto write = [&](const lissom_input& list) {
        return lissom_mesh_write_attribute(host, mesh, "heat", LISSOM_ON_VERTICES, 1, &list);
    };
    REQUIRE(write(in) == LISSOM_OK);
    std::vector<std::uint16_t> back(count, 7);
    std::vector<double> numbers(count, 0.0);
    const lissom_output out{back.data(), count, 0, LISSOM_FLOAT16};
    const lissom_output plain{numbers.data(), count, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_mesh_read_attribute(host, mesh, "heat", &out) == LISSOM_OK);
    REQUIRE(lissom_mesh_read_attribute(host, mesh, "heat", &plain) == LISSOM_OK);
    CHECK(back == halves);
    std::size_t right = 0;
    for (std::size_t i = 0; i < count; ++i) right += numbers[i] == half_value(halves[i]);
    CHECK(right == count);

    // Between two neighbours, nearer to either, and at the middle, where the even one is taken.
    for (int i = 0; i + 1 < kInfinity; ++i) {
        const double a = half_value(i), b = half_value(i + 1);
        const double share = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 0.375 : 0.625;
        numbers[at(i)] = a + share * (b - a);
    }
    REQUIRE(write({numbers.data(), count, 0, LISSOM_FLOAT64}) == LISSOM_OK);
    REQUIRE(lissom_mesh_read_attribute(host, mesh, "heat", &out) == LISSOM_OK);
    right = 0;
    for (int i = 0; i + 1 < kInfinity; ++i) {
        const int up = i % 3 == 0 ? i % 2 : i % 3 == 1 ? 0 : 1;
        right += back[at(i)] == i + up;
    }
    CHECK(right == kInfinity - 1);
    numbers[0] = 1e6;
    numbers[1] = -1e6;
    REQUIRE(write({numbers.data(), count, 0, LISSOM_FLOAT64}) == LISSOM_OK);
    REQUIRE(lissom_mesh_read_attribute(host, mesh, "heat", &out) == LISSOM_OK);
    CHECK(back[0] == 0x7bff);
    CHECK(back[1] == 0xfbff);
    for (const int bits : {kInfinity, kInfinity | 0x8000, 0x7e00}) {
        halves[5] = static_cast<std::uint16_t>(bits);
        CHECK(write(in) == LISSOM_NOT_FINITE);
    }
    std::vector<std::uint16_t> places(3 * count);
    const lissom_output triples{places.data(), count, 0, LISSOM_FLOAT16};
    REQUIRE(lissom_mesh_read_positions(host, mesh, &triples) == LISSOM_OK);
    CHECK(half_value(places[30]) == doctest::Approx(own.position(10).x()).epsilon(1e-3));
    CHECK(lissom_mesh_read_normals(host, mesh, &triples) == LISSOM_OK);
    const lissom_input moved{places.data(), count, 0, LISSOM_FLOAT16};
    CHECK(lissom_mesh_set_positions(host, mesh, &moved) == LISSOM_OK);
}

TEST_CASE("numbers beyond the range of a format are the nearest that it holds") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    const double values[8] = {-2, 2, -1, 1e300, -1e300, 70000, -70000, 0.25};
    const lissom_input in{values, 8, 0, LISSOM_FLOAT64};
    REQUIRE(lissom_mesh_write_attribute(host, mesh, "wear", LISSOM_ON_VERTICES, 1, &in) ==
            LISSOM_OK);
    const auto read = [&](auto number, lissom_format format) {
        std::vector<decltype(number)> list(8);
        const lissom_output out{list.data(), 8, 0, format};
        REQUIRE(lissom_mesh_read_attribute(host, mesh, "wear", &out) == LISSOM_OK);
        return list;
    };
    CHECK(read(std::int8_t{}, LISSOM_SNORM8) ==
          std::vector<std::int8_t>{-127, 127, -127, 127, -127, 127, -127, 32});
    CHECK(read(std::int16_t{}, LISSOM_SNORM16) ==
          std::vector<std::int16_t>{-32767, 32767, -32767, 32767, -32767, 32767, -32767, 8192});
    CHECK(read(std::uint8_t{}, LISSOM_UNORM8) ==
          std::vector<std::uint8_t>{0, 255, 0, 255, 0, 255, 0, 64});
    CHECK(
        read(std::uint16_t{}, LISSOM_FLOAT16) ==
        std::vector<std::uint16_t>{0xc000, 0x4000, 0xbc00, 0x7bff, 0xfbff, 0x7bff, 0xfbff, 0x3400});
    CHECK(read(std::int32_t{}, LISSOM_INT32) ==
          std::vector<std::int32_t>{-2, 2, -1, INT32_MAX, INT32_MIN, 70000, -70000, 0});
    constexpr float kMost = std::numeric_limits<float>::max();
    CHECK(read(0.0f, LISSOM_FLOAT32) ==
          std::vector<float>{-2, 2, -1, kMost, -kMost, 70000, -70000, 0.25f});
}

TEST_CASE("names that are not UTF-8 are refused, those of other languages are not") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    const double values[8] = {};
    const lissom_input in{values, 8, 0, LISSOM_FLOAT64};
    const auto write = [&](const char* name) {
        return lissom_mesh_write_attribute(host, mesh, name, LISSOM_ON_VERTICES, 1, &in);
    };
    CHECK(write("\xe6\xb3\xa2 \xf0\x9f\x98\x80 \xc3\xa9") == LISSOM_OK);
    const std::uint64_t before = host.hash(mesh);
    for (const char* name : {"a\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80"}) {
        CAPTURE(std::string(name));
        CHECK(write(name) == LISSOM_INVALID_ARGUMENT);
        CHECK(host.message().find("UTF-8") != std::string::npos);
        const std::int32_t labels[6] = {};
        const lissom_input of_faces{labels, 6, 0, LISSOM_INT32};
        CHECK(lissom_mesh_write_labels(host, mesh, "group", &name, 1, &of_faces) ==
              LISSOM_INVALID_ARGUMENT);
        lissom_region all{};
        REQUIRE(lissom_region_all(host, mesh, &all) == LISSOM_OK);
        CHECK(lissom_mesh_set_region(host, mesh, name, all) == LISSOM_INVALID_ARGUMENT);
    }
    CHECK(host.hash(mesh) == before);
}

TEST_CASE("labels of faces are lists of numbers and names") {
    const Host host;
    const lissom_mesh mesh = host.add(make_box({}));
    const char* names[] = {"wood", "glass"};
    const std::int32_t given[] = {0, 1, 1, -1, 0, 1};
    const lissom_input in{given, 6, 0, LISSOM_INT32};
    REQUIRE(lissom_mesh_write_labels(host, mesh, "material", names, 2, &in) == LISSOM_OK);
    CHECK(lissom_mesh_label_count(host, mesh, "material") == 2);
    CHECK(lissom_mesh_label_count(host, mesh, "group") == 0);
    const char* name = nullptr;
    REQUIRE(lissom_mesh_label_name(host, mesh, "material", 1, &name) == LISSOM_OK);
    CHECK(std::string(name) == "glass");
    std::int32_t back[6];
    const lissom_output out{back, 6, 0, LISSOM_INT32};
    REQUIRE(lissom_mesh_read_labels(host, mesh, "material", &out) == LISSOM_OK);
    CHECK(std::equal(given, given + 6, back));
    const std::int32_t nameless[] = {0, 1, 2, 0, 0, 0};
    const lissom_input bad{nameless, 6, 0, LISSOM_INT32};
    CHECK(lissom_mesh_write_labels(host, mesh, "material", names, 2, &bad) == LISSOM_OUT_OF_RANGE);
    CHECK(lissom_mesh_label_name(host, mesh, "material", 2, &name) == LISSOM_OUT_OF_RANGE);
    CHECK(lissom_mesh_read_labels(host, mesh, "group", &out) == LISSOM_OUT_OF_RANGE);
}

TEST_CASE("the result of a merge tells where its vertices and faces come from") {
    const Host host;
    const Mesh ball = make_sphere();
    const lissom_mesh whole = host.add(ball);
    const double middle[] = {0, 0, 0}, up[] = {0, 1, 0};
    lissom_mesh upper{}, lower{}, merged{};
    REQUIRE(lissom_cut_by_plane(host, whole, middle, up, nullptr, &upper, &lower) == LISSOM_OK);
    const lissom_transform lift{{1, 0, 0, 0, 0, 1, 0, 0.3, 0, 0, 1, 0}};
    REQUIRE(lissom_mesh_transform(host, upper, &lift) == LISSOM_OK);
    REQUIRE(lissom_merge(host, upper, lower, nullptr, 0, nullptr, &merged, nullptr) == LISSOM_OK);
    const auto count = at(lissom_mesh_vertex_count(host, merged));
    std::vector<Index> inputs(count), elements(count);
    const lissom_output in{inputs.data(), count, 0, LISSOM_INT32};
    const lissom_output of{elements.data(), count, 0, LISSOM_INT32};
    REQUIRE(lissom_mesh_read_vertex_origins(host, merged, &in, &of) == LISSOM_OK);
    const std::vector<Vec3> points = host.positions(merged), target = host.positions(lower);
    std::size_t same = 0, of_source = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (inputs[i] == 0) {
            REQUIRE(at(elements[i]) < target.size());
            same += (points[i] - target[at(elements[i])]).norm() < 1e-9 ? 1 : 0;
        } else if (inputs[i] == 1) {
            CHECK(elements[i] < lissom_mesh_vertex_count(host, upper));
            ++of_source;
        } else {
            CHECK(elements[i] == -1);
        }
    }
    CHECK(same > target.size() / 2);
    CHECK(of_source > 50);
    const auto faces = at(lissom_mesh_face_count(host, merged));
    std::vector<Index> of_faces(faces);
    const lissom_output f{of_faces.data(), faces, 0, LISSOM_INT32};
    CHECK(lissom_mesh_read_face_origins(host, merged, &f, nullptr) == LISSOM_OK);
    CHECK(lissom_mesh_read_face_origins(host, lower, &f, nullptr) == LISSOM_OUT_OF_RANGE);
}

TEST_CASE("values of strands go in and out, and groups keep their names") {
    const Host host;
    const float points[][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 3, 0}};
    const std::uint16_t offsets[] = {0, 2, 5};
    const lissom_input list{points, 5, 0, LISSOM_FLOAT32}, starts{offsets, 3, 0, LISSOM_UINT16};
    lissom_strands strands{};
    REQUIRE(lissom_strands_create(host, &list, &starts, &strands) == LISSOM_OK);
    const auto has = [&](lissom_strand_value value) {
        return lissom_strands_has(host, strands, value);
    };
    CHECK(has(LISSOM_STRAND_WIDTH) == 1);
    CHECK(has(LISSOM_STRAND_COLOR) == 0);
    CHECK(has(LISSOM_STRAND_ROOT_FACE) == 0);
    const float widths[] = {1, 2, 3, 4, 5};
    const lissom_input per_point{widths, 5, 0, LISSOM_FLOAT32};
    REQUIRE(lissom_strands_write_at_points(host, strands, LISSOM_STRAND_WIDTH, &per_point) ==
            LISSOM_OK);
    float read[5];
    const lissom_output out{read, 5, 0, LISSOM_FLOAT32};
    REQUIRE(lissom_strands_read_at_points(host, strands, LISSOM_STRAND_WIDTH, &out) == LISSOM_OK);
    CHECK(std::equal(widths, widths + 5, read));
    const std::int32_t faces[] = {7, 9}, guides[] = {-1, 0}, groups[] = {1, -1};
    const auto write = [&](lissom_strand_value value, const std::int32_t* values) {
        const lissom_input in{values, 2, 0, LISSOM_INT32};
        return lissom_strands_write(host, strands, value, &in);
    };
    const auto numbers = [&](lissom_strand_value value) {
        std::vector<std::int32_t> values(2);
        const lissom_output ids{values.data(), 2, 0, LISSOM_INT32};
        REQUIRE(lissom_strands_read(host, strands, value, &ids) == LISSOM_OK);
        return values;
    };
    CHECK(write(LISSOM_STRAND_ROOT_FACE, faces) == LISSOM_OK);
    CHECK(numbers(LISSOM_STRAND_ROOT_FACE) == std::vector<std::int32_t>{7, 9});
    const float weights[][3] = {{1, 0, 0}, {0, 0.5f, 0.5f}};
    const lissom_input barycentrics{weights, 2, 0, LISSOM_FLOAT32};
    CHECK(lissom_strands_write(host, strands, LISSOM_STRAND_ROOT_BARYCENTRIC, &barycentrics) ==
          LISSOM_OK);
    float back[2][3];
    const lissom_output triple{back, 2, 0, LISSOM_FLOAT32};
    CHECK(lissom_strands_read(host, strands, LISSOM_STRAND_ROOT_BARYCENTRIC, &triple) == LISSOM_OK);
    CHECK(std::memcmp(back, weights, sizeof back) == 0);
    CHECK(has(LISSOM_STRAND_ROOT_TRIANGLE) == 0);
    const std::int32_t triangles[][3] = {{1, 2, 3}, {4, 6, 5}};
    const lissom_input vertices{triangles, 2, 0, LISSOM_INT32};
    REQUIRE(lissom_strands_write(host, strands, LISSOM_STRAND_ROOT_TRIANGLE, &vertices) ==
            LISSOM_OK);
    std::int32_t corners[2][3];
    const lissom_output of_roots{corners, 2, 0, LISSOM_INT32};
    CHECK(lissom_strands_read(host, strands, LISSOM_STRAND_ROOT_TRIANGLE, &of_roots) == LISSOM_OK);
    CHECK(std::memcmp(corners, triangles, sizeof corners) == 0);
    CHECK(write(LISSOM_STRAND_GUIDE, guides) == LISSOM_OK);
    CHECK(numbers(LISSOM_STRAND_GUIDE) == std::vector<std::int32_t>{-1, 0});
    CHECK(write(LISSOM_STRAND_GROUP, groups) == LISSOM_OUT_OF_RANGE);
    CHECK(host.message().find("group 1 ") != std::string::npos);
    const double far[15] = {1e200};
    const lissom_input beyond{far, 5, 0, LISSOM_FLOAT64};
    CHECK(lissom_strands_set_points(host, strands, &beyond) == LISSOM_NOT_FINITE);
    CHECK(lissom_strands_write_at_points(host, strands, LISSOM_STRAND_COLOR, &beyond) ==
          LISSOM_NOT_FINITE);
    const char* names[] = {"fringe", "crown"};
    REQUIRE(lissom_strands_set_groups(host, strands, names, 2) == LISSOM_OK);
    CHECK(write(LISSOM_STRAND_GROUP, groups) == LISSOM_OK);
    CHECK(numbers(LISSOM_STRAND_GROUP) == std::vector<std::int32_t>{1, -1});
    const char* name = nullptr;
    REQUIRE(lissom_strands_group_name(host, strands, 1, &name) == LISSOM_OK);
    CHECK(std::string(name) == "crown");
    CHECK(lissom_strands_group_count(host, strands) == 2);
    const lissom_output narrow{read, 5, 2, LISSOM_FLOAT32};
    CHECK(lissom_strands_read(host, strands, LISSOM_STRAND_WIDTH, &narrow) ==
          LISSOM_INVALID_ARGUMENT);
    CHECK(lissom_strands_read(host, strands, LISSOM_STRAND_COLOR, &out) == LISSOM_OUT_OF_RANGE);
    CHECK(lissom_strands_read(host, strands, static_cast<lissom_strand_value>(55), &out) ==
          LISSOM_INVALID_ARGUMENT);
    const lissom_input short_list{widths, 1, 0, LISSOM_FLOAT32};
    CHECK(lissom_strands_write(host, strands, LISSOM_STRAND_WIDTH, &short_list) ==
          LISSOM_INVALID_ARGUMENT);
}

}  // namespace lissom::test
