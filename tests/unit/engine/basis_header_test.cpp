// The evaluator that engines use gives what the kernel gives, and survives whatever it is opened
// on.
#include <cmath>
#include <cstring>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/triangulate.h"
#include "tests/unit/engine/basis_scene.h"
#include "tests/unit/engine/header_in_c.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// In sizes of the surface: a few roundings of floats.
constexpr double kTolerance = 1e-6;

lissom_basis opened(const std::string& bytes) {
    lissom_basis basis;
    REQUIRE(lissom_basis_open(&basis, bytes.data(), bytes.size()) == LISSOM_BASIS_OK);
    return basis;
}

std::vector<float> evaluated(const lissom_basis& basis, const std::vector<float>& transforms) {
    std::vector<float> out(3 * std::size_t{basis.vertex_count});
    lissom_basis_evaluate(&basis, transforms.data(), 0, basis.vertex_count, out.data(), 12);
    return out;
}

// The distance of the evaluators in C and C++ from the preview, in sizes.
double error_of_evaluators(BasisScene scene) {
    const std::vector<Vec3> wanted = scene.deformer.solve(FrameQuality::preview);
    const std::string bytes = encode_basis(make_engine_basis(scene.deformer));
    const lissom_basis basis = opened(bytes);
    const std::vector<float> in_cpp = evaluated(basis, local_rows(basis, scene.transforms));
    std::vector<float> in_c(in_cpp.size());
    const std::vector<double> rows = rows_of(scene.transforms);
    REQUIRE(evaluate_in_c(bytes.data(), bytes.size(), rows.data(), scene.transforms.size(), 0,
                          basis.vertex_count, in_c.data()) == 0);
    const double error = std::max(max_distance(in_cpp, basis.origin, wanted),
                                  max_distance(in_c, basis.origin, wanted));
    return error / scene.size;
}

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
    for (Vec3& p : mesh.edit_positions()) p = scale * p + offset;
    return mesh;
}

}  // namespace

TEST_CASE("the evaluator gives the kernel's preview, for one handle to six") {
    for (int handles = 1; handles <= 6; ++handles) {
        CAPTURE(handles);
        CHECK(error_of_evaluators(make_basis_scene(make_cactus(), handles, true)) < kTolerance);
        CHECK(error_of_evaluators(make_basis_scene(make_bar({}), handles)) < kTolerance);
        CHECK(error_of_evaluators(make_basis_scene(make_bar({}), handles, true)) < kTolerance);
    }
}

TEST_CASE("the evaluator gives the kernel's preview on real meshes") {
    double greatest = 0.0;
    for (const char* name : {"lion.off", "cactus_cinolib.off", "dinosaur.obj", "bar_botsch.off",
                             "cad_block.off", "fertility.off"}) {
        const auto path = data_file(std::string("models/") + name);
        if (!path) continue;
        CAPTURE(name);
        for (const int handles : {2, 5}) {
            const double error = error_of_evaluators(make_basis_scene(load_mesh(*path), handles));
            CHECK(error < kTolerance);
            greatest = std::max(greatest, error);
        }
    }
    MESSAGE("greatest error " << greatest << " of the size");
}

TEST_CASE("a mesh may lie far from its origin and have any scale") {
    for (const double scale : {1e-6, 1.0, 1e6}) {
        const Mesh bar = moved(make_bar({}), scale, Vec3::Zero());
        const double size = surface_radius(bar);
        for (const double offset : {1e2, 1e4, 1e6}) {
            CAPTURE(scale);
            CAPTURE(offset);
            const Mesh far = moved(bar, 1.0, offset * size * Vec3(1, -0.7, 0.3));
            CHECK(error_of_evaluators(make_basis_scene(far, 3)) < kTolerance);
            CHECK(error_of_evaluators(make_basis_scene(far, 2, true)) < kTolerance);
        }
    }
}

TEST_CASE("handles at the identity give the rest shape to the bit") {
    BasisScene scene = make_basis_scene(make_cactus(), 3);
    const std::string bytes = encode_basis(make_engine_basis(scene.deformer));
    const lissom_basis basis = opened(bytes);
    std::vector<float> still(36);
    for (std::size_t h = 0; h < 3; ++h) lissom_basis_identity(still.data() + 12 * h);
    const std::vector<float> out = evaluated(basis, still);
    CHECK(std::memcmp(out.data(), basis.rest, out.size() * sizeof(float)) == 0);
    CHECK(max_distance(out, basis.origin, rest_positions_of(scene.deformer)) <
          kTolerance * scene.size);
}

TEST_CASE("vertex constraints are part of the rest positions") {
    BasisScene scene = make_basis_scene(make_bar({}), 2);
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (std::abs(places_along(scene.mesh)[static_cast<std::size_t>(v)] - 0.5) > 0.02) continue;
        scene.deformer.constrain(
            VertexConstraint{v, scene.mesh.position(v) + Vec3(0.3, 0.1, 0), std::nullopt});
    }
    CHECK(error_of_evaluators(std::move(scene)) < kTolerance);
}

TEST_CASE("soft handles, gradients alone, points of faces and removed handles are evaluated too") {
    const Mesh bar = make_bar({});
    const Region all = Region::all(bar.shared_topology());
    BasisScene scene{bar, Deformer(bar, all), {}, surface_radius(bar)};
    Deformer& edit = scene.deformer;
    edit.add_handle(slab(bar, 0, 5));
    const HandleId gone = edit.add_handle(slab(bar, 1, 5));
    edit.add_handle(slab(bar, 2, 5), {.weight = 10.0});
    edit.add_handle(slab(bar, 3, 5), {.position = false});
    edit.add_handle(slab(bar, 4, 5), {.gradient = false});
    edit.remove_handle(gone);
    std::mt19937 random(5);
    for (const HandleId id : edit.handles()) {
        scene.transforms.push_back(some_move(edit.handle(id).center, scene.size, random));
        edit.set_transform(id, scene.transforms.back());
    }
    CHECK(error_of_evaluators(std::move(scene)) < kTolerance);
}

TEST_CASE("ranges of vertices, strides and the mesh's own order give the same numbers") {
    BasisScene scene = make_basis_scene(make_cactus(), 2, true);
    const std::string bytes = encode_basis(make_engine_basis(scene.deformer));
    const lissom_basis basis = opened(bytes);
    const std::vector<float> transforms = local_rows(basis, scene.transforms);
    const std::vector<float> whole = evaluated(basis, transforms);
    const std::uint32_t n = basis.vertex_count;
    REQUIRE(n < basis.mesh_vertex_count);

    constexpr float kUntouched = 77.0f;
    std::vector<float> strided(5 * std::size_t{n}, kUntouched);
    for (std::uint32_t first = 0; first < n; first += 101) {
        lissom_basis_evaluate(&basis, transforms.data(), first, 101, &strided[5 * first], 20);
    }
    std::vector<float> scattered(4 * std::size_t{basis.mesh_vertex_count}, kUntouched);
    lissom_basis_scatter(&basis, transforms.data(), 0, n / 2, scattered.data(), 16);
    lissom_basis_scatter(&basis, transforms.data(), n / 2, UINT32_MAX, scattered.data(), 16);
    bool same = true;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            same = same && strided[5 * i + k] == whole[3 * i + k] &&
                   scattered[4 * basis.vertices[i] + k] == whole[3 * i + k];
        }
        same = same && strided[5 * i + 3] == kUntouched && strided[5 * i + 4] == kUntouched;
    }
    CHECK(same);
    CHECK(std::count(scattered.begin(), scattered.end(), kUntouched) ==
          static_cast<std::ptrdiff_t>(scattered.size() - 3 * n));
    lissom_basis_evaluate(&basis, transforms.data(), n, 5, nullptr, 12);
    lissom_basis_evaluate(&basis, transforms.data(), UINT32_MAX, UINT32_MAX, nullptr, 12);
}

TEST_CASE("handles have names and centers") {
    BasisScene scene = make_basis_scene(make_bar({}), 3);
    const std::vector<std::string> names = {"hip", "K\u00f6rper"};
    const std::string bytes = encode_basis(make_engine_basis(scene.deformer, names));
    const lissom_basis basis = opened(bytes);
    CHECK(std::string(lissom_basis_handle_name(&basis, 1)) == "K\u00f6rper");
    CHECK(std::string(lissom_basis_handle_name(&basis, 2)).empty());
    CHECK(std::string(lissom_basis_handle_name(&basis, 3)).empty());
    CHECK(lissom_basis_find_handle(&basis, "hip") == 0);
    CHECK(lissom_basis_find_handle(&basis, "K\u00f6rper") == 1);
    CHECK(lissom_basis_find_handle(&basis, "hi") == 3);
    CHECK(lissom_basis_find_handle(&basis, "hips") == 3);
    const Vec3 center = scene.deformer.handle(scene.deformer.handles()[1]).center;
    for (int k = 0; k < 3; ++k) {
        CHECK(basis.origin[k] + static_cast<double>(basis.handles[1].center[k]) ==
              doctest::Approx(center[k]).epsilon(1e-6));
    }
}

TEST_CASE("normals of a sphere point outward with length one") {
    const Mesh sphere = make_sphere();
    std::vector<float> positions, normals(4 * static_cast<std::size_t>(sphere.vertex_count()));
    for (const Vec3& p : sphere.positions()) {
        for (const double x : p) positions.push_back(static_cast<float>(x));
    }
    std::vector<std::uint32_t> triangles;
    for (Index f = 0; f < sphere.face_count(); ++f) {
        const auto face = sphere.topology().face(f);
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            for (const Index v : {face[0], face[k], face[k + 1]}) {
                triangles.push_back(static_cast<std::uint32_t>(v));
            }
        }
    }
    triangles.insert(triangles.end(), {0, 1, UINT32_MAX});
    const auto n = static_cast<std::uint32_t>(sphere.vertex_count());
    lissom_basis_normals(positions.data(), 12, n, triangles.data(),
                         static_cast<std::uint32_t>(triangles.size() / 3), normals.data(), 16);
    double length_error = 0.0, least = 1.0;
    for (Index v = 0; v < sphere.vertex_count(); ++v) {
        const std::size_t i = 4 * static_cast<std::size_t>(v);
        const Vec3 normal(normals[i], normals[i + 1], normals[i + 2]);
        length_error = std::max(length_error, std::abs(normal.norm() - 1.0));
        least = std::min(least, normal.dot(sphere.position(v).normalized()));
    }
    CHECK(length_error < 1e-6);
    CHECK(least > 0.99);
}

TEST_CASE("normals are those of the kernel, however a surface is divided into triangles") {
    // Long and short triangles at each vertex, so that weights by area would turn the normals.
    Mesh bar = make_bar({});
    triangulate(bar);
    for (Vec3& p : bar.edit_positions())
        p = Vec3(p.x() * p.x() * p.x(), 2.0 * p.y(), p.z() + 0.3 * p.y() * p.x());
    std::vector<float> positions, normals(3 * at(bar.vertex_count()));
    for (const Vec3& p : bar.positions()) {
        for (const double x : p) positions.push_back(static_cast<float>(1e-20 * x));
    }
    std::vector<std::uint32_t> triangles;
    for (const Index v : bar.topology().faces().vertices) triangles.push_back(std::uint32_t(v));
    lissom_basis_normals(positions.data(), 12, std::uint32_t(bar.vertex_count()), triangles.data(),
                         std::uint32_t(bar.face_count()), normals.data(), 12);
    const std::vector<Vec3> expected = vertex_normals(bar);
    double worst = 0.0;
    for (Index v = 0; v < bar.vertex_count(); ++v) {
        const float* const n = &normals[3 * at(v)];
        worst = std::max(worst, (Vec3(n[0], n[1], n[2]) - expected[at(v)]).norm());
    }
    CHECK(worst < 1e-4);
}

TEST_CASE("what is no basis is told apart") {
    BasisScene scene = make_basis_scene(make_bar({}), 2);
    const std::string good = encode_basis(make_engine_basis(scene.deformer));
    lissom_basis basis;
    const auto status = [&](const std::string& bytes, std::size_t from = 0) {
        return lissom_basis_open(&basis, bytes.data() + from, bytes.size() - from);
    };
    const auto with_byte = [&](std::size_t at, char value) {
        std::string bytes = good;
        bytes[at] = value;
        return bytes;
    };
    CHECK(status(good) == LISSOM_BASIS_OK);
    CHECK(status(good + "more") == LISSOM_BASIS_OK);
    CHECK(lissom_basis_open(&basis, nullptr, 0) == LISSOM_BASIS_TRUNCATED);
    CHECK(status(with_byte(0, 'x')) == LISSOM_BASIS_NOT_A_BASIS);
    CHECK(status(with_byte(8, 2)) == LISSOM_BASIS_UNKNOWN_VERSION);
    CHECK(status(with_byte(12, 3)) == LISSOM_BASIS_DAMAGED);
    CHECK(status("x" + good, 1) == LISSOM_BASIS_NOT_ALIGNED);
    CHECK(status(with_byte(good.size() - 1, 'x')) == LISSOM_BASIS_DAMAGED);
    for (const std::size_t size : {0, 5, 8, 40, 63, 64, 1000}) {
        CHECK(status(good.substr(0, size)) == LISSOM_BASIS_TRUNCATED);
    }
    for (int s = LISSOM_BASIS_OK; s <= LISSOM_BASIS_UNSUPPORTED_MACHINE; ++s) {
        const std::string text = lissom_basis_status_text(static_cast<lissom_basis_status>(s));
        CHECK(text != "unknown status");
    }
}
