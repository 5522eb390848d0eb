// Compressed glTF files: those of other programs, our own, and corrupt ones.
#include <doctest/doctest.h>
#ifdef __linux__
#include <sys/resource.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "kernel/io/gltf/file/draco.h"
#include "kernel/io/gltf/file/meshopt.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/damage.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr Compression kKinds[] = {Compression::meshopt, Compression::draco};

bool has_codec(Compression kind) {
    return kind == Compression::meshopt ? has_meshopt() : has_draco();
}

SaveOptions compressed_by(Compression kind, int quantize = 0) {
    SaveOptions options;
    options.compression = kind;
    options.quantize = quantize;
    return options;
}

double max_distance(const Mesh& a, const Mesh& b) {
    REQUIRE(a.vertex_count() == b.vertex_count());
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v)).norm());
    }
    return greatest;
}

// A sphere with all kinds of values that a file has for vertices, a region and polygons.
Mesh rich_sphere() {
    SphereOptions options;
    options.segments = 14;
    Mesh mesh = make_sphere(options);
    Attribute uv{"uv", Domain::vertex, 2, ScalarType::float32, {}};
    Attribute heat{"heat", Domain::vertex, 1, ScalarType::float32, {}};
    Attribute move{"morph.1.position", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.position(v);
        uv.values.insert(uv.values.end(), {0.5 + 0.4 * p.x(), 0.5 + 0.4 * p.y()});
        heat.values.push_back(static_cast<float>(p.z()));
        for (int k = 0; k < 3; ++k) {
            move.values.push_back(p.y() > 0.7 ? static_cast<float>(0.1 * p[k]) : 0.0);
        }
    }
    for (double& x : uv.values) x = static_cast<float>(x);
    mesh.attributes().add(std::move(uv));
    mesh.attributes().add(std::move(heat));
    mesh.attributes().add(std::move(move));
    std::vector<Vec3> rounded;
    for (const Vec3& p : mesh.positions()) rounded.push_back(p.cast<float>().cast<double>());
    mesh.set_positions(std::move(rounded));
    return mesh;
}

}  // namespace

TEST_CASE("compressed glTF files of other programs are read") {
    struct Expected {
        const char* name;
        bool draco;
        Index vertices, faces;
        Vec3 least, largest;
    };
    // Counts and bounds as the accessors of the files tell them, with the nodes applied.
    const std::vector<Expected> files{
        {"gltf/draco_Box_Draco.glb", true, 8, 12, {-.5, -.5, -.5}, {.5, .5, .5}},
        {"gltf/draco_BoxMetaDraco/BoxMetaDraco.gltf", true, 8, 12, {-.5, -.5, 1.5}, {.5, .5, 2.5}},
        {"gltf/gltftr_DracoSparseMesh/DracoSparseMesh.gltf",
         true,
         56,
         102,
         {-0.0396516, 0.0495865, 0.028699},
         {-0.0134827, 0.0891258, 0.0316506}},
        {"gltf/gltftr_DenseSphere.glb",
         true,
         15362,
         30720,
         {-0.924286, -0.930305, -0.924854},
         {0.924286, 0.930305, 0.924854}},
        {"gltf/gltftr_BoxMeshopt.glb", false, 8, 12, {-.5, -.5, -.5}, {.5, .5, .5}},
        {"gltf/meshopt_pirate.glb",
         false,
         2703,
         5010,
         {-0.760582, -0.001088, -0.229468},
         {0.760505, 1.90396, 0.225777}}};
    for (const Expected& expected : files) {
        const auto path = data_file(expected.name);
        if (!path || !(expected.draco ? has_draco() : has_meshopt())) continue;
        CAPTURE(expected.name);
        const Mesh mesh = load_mesh(*path);
        CHECK(mesh.vertex_count() == expected.vertices);
        CHECK(mesh.face_count() == expected.faces);
        const Box box = bounds(mesh);
        CHECK((box.min - expected.least).norm() < 1e-4 * box.diagonal());
        CHECK((box.max - expected.largest).norm() < 1e-4 * box.diagonal());
        const Attribute* normals = mesh.attributes().find("normal");
        for (std::size_t i = 0; normals && i < normals->values.size(); i += 3) {
            const double length =
                Vec3(normals->values[i], normals->values[i + 1], normals->values[i + 2]).norm();
            REQUIRE(std::abs(length - 1.0) < 0.02);
        }
    }
}

TEST_CASE("compressed files without quantisation hold the mesh to the bit") {
    const Mesh mesh = rich_sphere();
    for (const Compression kind : kKinds) {
        if (!has_codec(kind)) continue;
        CAPTURE(static_cast<int>(kind));
        for (const char* extension : {"glb", "gltf"}) {
            const std::string bytes = encode_mesh(mesh, extension, compressed_by(kind));
            const Mesh back = decode_mesh(bytes, extension);
            CHECK(back.positions().size() == mesh.positions().size());
            CHECK(max_distance(mesh, back) == 0.0);
            CHECK(back.topology().faces().vertices == mesh.topology().faces().vertices);
            // Texture coordinates are turned, which rounds them.
            const Mesh plain = decode_mesh(encode_mesh(mesh, extension), extension);
            for (const char* name : {"uv", "heat", "morph.1.position"}) {
                REQUIRE(back.attributes().find(name));
                const std::vector<double>& now = back.attributes().find(name)->values;
                CHECK(now == plain.attributes().find(name)->values);
            }
        }
    }
}

TEST_CASE("quantised compressed files are small and their error is that of their bits") {
    const Mesh mesh = rich_sphere();
    const std::size_t plain = encode_mesh(mesh, "glb").size();
    for (const Compression kind : kKinds) {
        if (!has_codec(kind)) continue;
        for (const int bits : {8, 12, 14}) {
            CAPTURE(static_cast<int>(kind));
            CAPTURE(bits);
            const std::string bytes = encode_mesh(mesh, "glb", compressed_by(kind, bits));
            MESSAGE("bytes ", bytes.size(), " of ", plain);
            // One of its attributes is not quantised, and Draco leaves morph targets as they are.
            CHECK(bytes.size() < plain * 7 / 10);
            const Mesh back = decode_mesh(bytes, "glb");
            // Half a step in each of three coordinates.
            const double step = 2.0 / (1 << bits);
            const double error = max_distance(mesh, back);
            CHECK(error <= step);
            CHECK(error > step / 100.0);
        }
    }
}

namespace {

// The rich sphere with a material for each third of its faces.
Mesh three_materials() {
    Mesh mesh = rich_sphere();
    FaceLabels materials;
    materials.names = {"red", "blue", "green"};
    for (Index f = 0; f < mesh.face_count(); ++f) materials.of_face.push_back(f / 5 % 3);
    mesh.attributes().labels()["material"] = materials;
    mesh.set_region("cap", Region(mesh.shared_topology(), {0, 3, 17, 40}));
    return mesh;
}

std::array<double, 6> content_of(const Mesh& mesh, Index vertex) {
    const Vec3& p = mesh.position(vertex);
    const auto move = mesh.attributes().find("morph.1.position")->at(vertex);
    return {p[0],
            p[1],
            p[2],
            mesh.attributes().find("heat")->at(vertex)[0],
            mesh.attributes().find("uv")->at(vertex)[0],
            move[1]};
}

// Positions with their values, in an order of their own.
std::vector<std::array<double, 6>> sorted_content(const Mesh& mesh,
                                                  const std::vector<Index>& vertices) {
    std::vector<std::array<double, 6>> content;
    for (const Index v : vertices) content.push_back(content_of(mesh, v));
    std::sort(content.begin(), content.end());
    return content;
}

std::vector<Index> all_vertices(const Mesh& mesh) {
    std::vector<Index> all(at(mesh.vertex_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) all[at(v)] = v;
    return all;
}

}  // namespace

TEST_CASE(
    "objects of several materials are compressed, a primitive each, and are one surface again") {
    const Mesh mesh = three_materials();
    const Mesh plain = decode_mesh(encode_mesh(mesh, "glb"), "glb");
    for (const Compression kind : kKinds) {
        if (!has_codec(kind)) continue;
        CAPTURE(static_cast<int>(kind));
        const LoggedContext logged;
        const std::string bytes = encode_mesh(mesh, "glb", compressed_by(kind), logged.context);
        CHECK_FALSE(logged.mentions("not compressed"));
        const Mesh back = decode_mesh(bytes, "glb");
        CHECK(back.vertex_count() == mesh.vertex_count());
        CHECK(back.attributes().labels().at("material").of_face ==
              plain.attributes().labels().at("material").of_face);
        CHECK(sorted_content(back, all_vertices(back)) ==
              sorted_content(plain, all_vertices(plain)));
        REQUIRE(back.find_region("cap"));
        CHECK(sorted_content(back, back.find_region("cap")->vertices()) ==
              sorted_content(plain, plain.find_region("cap")->vertices()));
        if (kind != Compression::draco) continue;
        const Json json = json_of_glb(bytes);
        for (const Json& primitive : json["meshes"][0]["primitives"]) {
            CHECK(primitive["extensions"].contains("KHR_draco_mesh_compression"));
        }
    }
}

TEST_CASE("quantised primitives of several materials meet without gaps") {
    const Mesh mesh = three_materials();
    for (const Compression kind : kKinds) {
        if (!has_codec(kind)) continue;
        for (const int bits : {8, 11, 14}) {
            CAPTURE(bits);
            const Mesh back =
                decode_mesh(encode_mesh(mesh, "glb", compressed_by(kind, bits)), "glb");
            CHECK(back.vertex_count() == mesh.vertex_count());
            CHECK(back.topology().boundary_loops().empty());
        }
    }
}

TEST_CASE(
    "an object whose materials meet where another vertex lies is left as it is, and that is told") {
    if (!has_draco()) return;
    // Two boxes of one object that touch at a corner, where the materials of both meet.
    Mesh mesh = make_box();
    Mesh other = make_box();
    const Box box = bounds(mesh);
    for (Vec3& p : other.edit_positions()) p += box.max - box.min;
    append(mesh, other);
    FaceLabels materials;
    materials.names = {"red", "blue", "green"};
    for (Index f = 0; f < mesh.face_count(); ++f) materials.of_face.push_back(f / 2 % 3);
    mesh.attributes().labels()["material"] = materials;
    const LoggedContext logged;
    const std::string bytes =
        encode_mesh(mesh, "glb", compressed_by(Compression::draco), logged.context);
    CHECK(logged.mentions("not compressed by Draco"));
    CHECK(decode_mesh(bytes, "glb").vertex_count() == mesh.vertex_count());
}

TEST_CASE("without compression quantised numbers are integers, as fine as asked for") {
    Mesh mesh = rich_sphere();
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (const Vec3& n : vertex_normals(mesh)) {
        normals.values.insert(normals.values.end(), n.data(), n.data() + 3);
    }
    mesh.attributes().add(std::move(normals));
    const std::string plain = encode_mesh(mesh, "glb");
    for (const int bits : {6, 8, 12, 15}) {
        CAPTURE(bits);
        const std::string bytes = encode_mesh(mesh, "glb", compressed_by(Compression::none, bits));
        CHECK(bytes.size() < plain.size());
        const Json json = json_of_glb(bytes);
        CHECK(json["extensionsRequired"][0] == "KHR_mesh_quantization");
        const Mesh back = decode_mesh(bytes, "glb"), same = decode_mesh(plain, "glb");
        for (const char* name : {"uv", "normal", "morph.1.position"}) {
            CAPTURE(name);
            const std::vector<double>& now = back.attributes().find(name)->values;
            const std::vector<double>& then = same.attributes().find(name)->values;
            REQUIRE(now.size() == then.size());
            double worst = 0.0;
            for (std::size_t i = 0; i < now.size(); ++i) {
                worst = std::max(worst, std::abs(now[i] - then[i]));
            }
            const bool is_direction = std::string(name) == "normal";
            const double step = std::ldexp(1.0, is_direction ? -std::max(8, bits / 2) : 1 - bits);
            CHECK(worst <= 0.51 * step);
            CHECK(worst > 0.0);
        }
    }
}

TEST_CASE("compression is refused where it cannot be") {
    const Mesh mesh = make_box();
    for (const Compression kind : kKinds) {
        CHECK(error_of([&] { encode_mesh(mesh, "obj", compressed_by(kind)); }).code() ==
              ErrorCode::invalid_argument);
        if (!has_codec(kind)) {
            CHECK(error_of([&] { encode_mesh(mesh, "glb", compressed_by(kind)); }).code() ==
                  ErrorCode::unsupported);
        }
        CHECK(error_of([&] { encode_mesh(mesh, "glb", compressed_by(kind, 21)); }).code() ==
              ErrorCode::invalid_argument);
        CHECK(error_of([&] { encode_mesh(mesh, "glb", compressed_by(kind, -1)); }).code() ==
              ErrorCode::invalid_argument);
    }
    CHECK(error_of([&] {
              encode_mesh(mesh, "obj", compressed_by(Compression::none, 12));
          }).code() == ErrorCode::invalid_argument);
}

#ifdef __linux__
TEST_CASE("corrupt compressed files are refused or read, in bounded memory") {
    const auto peak = [] {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        return usage.ru_maxrss / 1024;
    };
    const char* more = std::getenv("LISSOM_MUTANTS");
    const int count = more ? std::atoi(more) : 500;
    const Mesh sphere = rich_sphere();
    int read = 0;
    for (const Compression kind : kKinds) {
        if (!has_codec(kind)) continue;
        for (const int bits : {0, 12}) {
            const std::string sound = encode_mesh(sphere, "glb", compressed_by(kind, bits));
            // The text in front stays as it is in most of them, so that the codec meets the rest.
            const std::size_t binary = sound.find("BIN") + 4;
            const long before = peak();
            std::mt19937 random(7);
            for (int i = 0; i < count / 2; ++i) {
                CAPTURE(i);
                std::string bytes = sound;
                if (i % 5 == 0) {
                    bytes = damaged(bytes, random, "0123456789");
                } else {
                    for (int change = 0; change < 1 + i % 4; ++change) {
                        const std::size_t reach =
                            i % 2 == 0 ? std::min<std::size_t>(200, sound.size() - binary)
                                       : sound.size() - binary;
                        bytes[binary + random() % reach] = static_cast<char>(random());
                    }
                }
                try {
                    decode_mesh(bytes, "glb");
                    ++read;
                } catch (const Error&) {
                }
            }
            CHECK(peak() - before < 256);
        }
    }
    MESSAGE(read, " mutants were read");
}
#endif
