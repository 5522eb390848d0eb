#include "kernel/hair/field/distance_grid.h"

#include <algorithm>

#include "kernel/hair/field/closed_surface.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;

namespace {

GridLayout layout_of(const Mesh& mesh, Index resolution) {
    return fit_grid(test::grown(bounds(mesh), 0.2), resolution);
}

// The sphere without its cap above `height`.
Mesh open_sphere(double height) {
    const Mesh sphere = make_sphere({.segments = 24});
    return remove(sphere, select_plane(sphere, Vec3(0, height, 0), Vec3::UnitY())).mesh;
}

// The same faces, each with vertices of its own.
Mesh torn(const Mesh& mesh) {
    std::vector<Vec3> positions;
    FaceList faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face;
        for (const Index v : mesh.topology().face(f)) {
            face.push_back(static_cast<Index>(positions.size()));
            positions.push_back(mesh.position(v));
        }
        faces.add(face);
    }
    return {std::move(positions), std::move(faces)};
}

// Share of random grid points whose sign differs from that of the winding number over one half.
double wrong_signs(const Mesh& mesh, const DistanceGrid& grid, int count) {
    test::RandomPoints random(3);
    const test::WindingNumber winding_number(mesh);
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
        const Index at = static_cast<Index>(random.uniform(0, grid.layout().size()));
        const auto& counts = grid.layout().counts;
        const Vec3 p = grid.layout().point(at % counts[0], at / counts[0] % counts[1],
                                           at / (counts[0] * counts[1]));
        wrong += (grid.values()[at] < 0.0F) != (winding_number(p) > 0.5);
    }
    return static_cast<double>(wrong) / count;
}

void check_exact(const Mesh& mesh, const DistanceGridOptions& options) {
    const GridLayout layout = layout_of(mesh, 8000);
    const DistanceGrid grid(mesh, layout, options);
    const SpatialTree tree(mesh);
    const double size = bounds(mesh).diagonal();
    double far = 0.0;
    for (Index k = 0; k < layout.counts[2]; ++k) {
        for (Index j = 0; j < layout.counts[1]; ++j) {
            for (Index i = 0; i < layout.counts[0]; ++i) {
                const double exact = tree.nearest(layout.point(i, j, k)).distance;
                const double off = std::abs(std::abs(grid.at(i, j, k)) - exact);
                if (exact < options.band * layout.step) CHECK(off < 1e-6 * size);
                far = std::max(far, off);
            }
        }
    }
    CHECK(far < 2.0 * layout.step);
}

}  // namespace

TEST_CASE("distances near the surface are exact, those beyond within two steps") {
    check_exact(make_sphere({.segments = 8}), {});
    check_exact(make_torus({.segments = 20, .tube_segments = 10}), {});
    check_exact(make_box({.size = {1, 2, 3}}), {.band = 2.0});
    check_exact(make_cactus({.vertices = 2000}), {.band = 1e6});
}

TEST_CASE("signs are those of the winding number") {
    for (const Mesh& mesh :
         {make_sphere({.segments = 8}), make_torus({.segments = 20, .tube_segments = 10}),
          make_box({.size = {1, 2, 3}}), make_cactus({.vertices = 2000})}) {
        CHECK(wrong_signs(mesh, DistanceGrid(mesh, layout_of(mesh, 10000)), 500) == 0.0);
    }
}

TEST_CASE("grid planes through vertices, edges and faces lose no sign") {
    const Mesh box = make_box({.segments = {4, 4, 4}});
    GridLayout layout{{17, 17, 17}, Vec3::Constant(-1.0), 0.125};
    const DistanceGrid grid(box, layout);
    for (Index k = 0; k < 17; ++k) {
        for (Index j = 0; j < 17; ++j) {
            for (Index i = 0; i < 17; ++i) {
                const double out = layout.point(i, j, k).cwiseAbs().maxCoeff() - 0.5;
                if (std::abs(out) > 1e-9) CHECK((grid.at(i, j, k) < 0.0F) == (out < 0.0));
            }
        }
    }
}

TEST_CASE("an open sphere is as if its hole were closed by a disc") {
    const Mesh mesh = open_sphere(0.6);
    const DistanceGrid grid(mesh, layout_of(mesh, 30000));
    double rim = -1.0;
    for (const Vec3& p : mesh.positions()) rim = std::max(rim, p.y());
    CHECK(grid.value(Vec3(0, rim - 0.1, 0)) == doctest::Approx(-0.1).epsilon(0.15));
    CHECK(grid.value(Vec3(0, rim + 0.1, 0)) == doctest::Approx(0.1).epsilon(0.15));
    CHECK(grid.inside(Vec3(0.9, 0, 0)));
    CHECK(!grid.inside(Vec3(0, 1, 0)));
    CHECK(close_surface(mesh).first_cap < close_surface(mesh).triangles.size());
}

TEST_CASE("unwelded faces and holes with torn rims stay closed") {
    for (const Mesh& mesh : {make_box({.segments = {3, 3, 3}}), make_sphere({.segments = 8})}) {
        const Mesh pieces = torn(mesh);
        CHECK(close_surface(pieces).first_cap == close_surface(pieces).triangles.size());
        const GridLayout layout = layout_of(mesh, 8000);
        const DistanceGrid whole(mesh, layout), grid(pieces, layout);
        CHECK(std::equal(whole.values().begin(), whole.values().end(), grid.values().begin()));
    }
    const Mesh open = open_sphere(0.6);
    const GridLayout layout = layout_of(open, 8000);
    const DistanceGrid whole(open, layout), grid(torn(open), layout);
    for (std::size_t i = 0; i < whole.values().size(); ++i) {
        CHECK(grid.values()[i] == doctest::Approx(whole.values()[i]).epsilon(1e-5));
    }
}

TEST_CASE("overlapping components are one solid and an inward mesh is turned") {
    const Mesh two = make_sphere({.segments = 8});
    const Mesh other = test::moved(two, translation(Vec3(0.8, 0, 0)));
    Mesh both = two;
    append(both, other);
    const DistanceGrid grid(both, layout_of(both, 20000));
    CHECK(grid.inside(Vec3(0.4, 0, 0)));
    CHECK(grid.inside(Vec3(1.6, 0, 0)));
    CHECK(!grid.inside(Vec3(0.4, 0.98, 0)));
    const Mesh mirrored = test::moved(two, scaling(Vec3(-1, 1, 1), Vec3::Zero()));
    CHECK(DistanceGrid(mirrored, layout_of(mirrored, 8000)).inside(Vec3(0.1, 0.2, 0.3)));
}

TEST_CASE("values interpolate and gradients are their derivatives") {
    const Mesh mesh = make_sphere({.segments = 16});
    const DistanceGrid grid(mesh, layout_of(mesh, 60000));
    test::RandomPoints random(5);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random.in_box(test::grown(grid.layout().box(), 0.3));
        const auto sample = grid.sample(p);
        if (grid.layout().box().contains(p)) {
            CHECK(std::abs(sample.value - (p.norm() - 1.0)) < 0.03 + 0.5 * grid.layout().step);
        }
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 h = 1e-7 * Vec3::Unit(axis);
            const double slope = (grid.value(p + h) - grid.value(p - h)) / 2e-7;
            CHECK(std::abs(slope - sample.gradient[axis]) < 1e-4);
        }
    }
    const Vec3 p = Vec3(0.7, 0.5, -0.6);
    CHECK(grid.sample(p).gradient.normalized().dot(p.normalized()) > 0.99);
    CHECK(std::isnan(grid.value(Vec3(test::kNaN, 0, 0))));
}

TEST_CASE("distances follow a change of scale and place") {
    const Mesh mesh = make_torus({.segments = 20, .tube_segments = 10});
    const GridLayout layout = layout_of(mesh, 8000);
    const DistanceGrid grid(mesh, layout);
    for (const double scale : {1e-3, 1e4}) {
        const Vec3 shift = scale * Vec3(11, -7, 5);
        const Affine map = translation(shift) * scaling(Vec3::Constant(scale), Vec3::Zero());
        const GridLayout image{layout.counts, map(layout.origin), scale * layout.step};
        const DistanceGrid scaled(test::moved(mesh, map), image);
        for (std::size_t i = 0; i < grid.values().size(); ++i) {
            CHECK(std::abs(scaled.values()[i] - scale * grid.values()[i]) < 1e-5 * scale);
        }
    }
}

TEST_CASE("the number of threads does not change a bit") {
    const Mesh mesh = make_cactus({.vertices = 2000});
    const GridLayout layout = layout_of(mesh, 30000);
    const DistanceGrid one(mesh, layout, {}, test::threads(1));
    const DistanceGrid two(mesh, layout, {}, test::threads(2));
    CHECK(std::equal(one.values().begin(), one.values().end(), two.values().begin()));
}

TEST_CASE("real heads: signs survive necks and eye holes") {
    for (const char* name :
         {"ict_head.obj", "makehuman_head.obj", "LeePerrySmith.glb", "african_head.obj",
          "digitalsalon_head.obj", "face_scan_open.obj", "hairstep_usc_head.obj",
          "max_planck_decimated.obj", "max_planck_fprotais.obj", "sintel-collider.obj",
          "sintel_head.obj", "WaltHead.obj", "human_neutral.obj", "ict_generic_neutral.obj"}) {
        const auto mesh = test::load_head(name);
        if (!mesh) continue;
        CAPTURE(name);
        const DistanceGrid grid(*mesh, layout_of(*mesh, 20000), {}, test::threads(2));
        // An open rim that is not flat closes a little otherwise than the winding number does.
        CHECK(wrong_signs(*mesh, grid, 100) <= (mesh->topology().is_closed() ? 0.0 : 0.01));
    }
}

TEST_CASE("grids without sense are refused, and memory is charged") {
    const auto code = [](const auto& action) { return test::error_of(action).code(); };
    const Mesh mesh = make_box();
    const GridLayout layout = layout_of(mesh, 8000);
    CHECK(code([&] { DistanceGrid(Mesh(), layout); }) == ErrorCode::mesh_empty);
    CHECK(code([&] { DistanceGrid(mesh, {}); }) == ErrorCode::invalid_argument);
    CHECK(code([&] {
              DistanceGrid(mesh, {{9, 9, 9}, Vec3::Zero(), test::kNaN});
          }) == ErrorCode::invalid_argument);
    CHECK(code([&] { DistanceGrid(mesh, layout, {.band = test::kNaN}); }) ==
          ErrorCode::invalid_argument);
    ContextOptions options;
    options.memory_limit = 1'000'000;
    CHECK(code([&] { DistanceGrid(mesh, layout_of(mesh, 2'000'000), {}, Context(options)); }) ==
          ErrorCode::memory_limit);
    const Context context;
    context.cancel();
    CHECK(code([&] { DistanceGrid(mesh, layout, {}, context); }) == ErrorCode::cancelled);
    context.clear_cancel();
    {
        const DistanceGrid grid(mesh, layout, {}, context);
        CHECK(context.memory()->used() == grid.memory_bytes());
    }
    CHECK(context.memory()->used() == 0);
}
