// A handle that changes its size: the surface beside it goes no further than the handle asks.
#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_of(Index across) {
    BarOptions options;
    options.across = across;
    options.along = 5 * across;
    return make_scene(make_bar(options));
}

/// Greatest and least half width of a bar of width 1 along y, over its free vertices on edges.
struct Widths {
    double least = 1e300, greatest = 0.0;
};

Widths widths_of(const Scene& scene, const std::vector<Vec3>& x) {
    Widths widths;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const Vec3& rest = scene.mesh.position(v);
        if (std::min(std::abs(rest.x()), std::abs(rest.z())) < 0.49) continue;
        if (std::binary_search(scene.low.begin(), scene.low.end(), v)) continue;
        if (std::binary_search(scene.high.begin(), scene.high.end(), v)) continue;
        const double half = std::max(std::abs(x[v].x()), std::abs(x[v].z()));
        widths.least = std::min(widths.least, half);
        widths.greatest = std::max(widths.greatest, half);
    }
    return widths;
}

std::vector<Vec3> scaled(const Scene& scene, const Vec3& factors, const DeformOptions& options,
                         const HandleOptions& handle = {}) {
    Deformer d(scene.mesh, scene.all(), options);
    d.add_handle(scene.region(scene.low));
    const HandleId high = d.add_handle(scene.region(scene.high), handle);
    d.set_transform(high, scaling(factors, Vec3::Zero()), d.handle(high).center);
    return d.solve();
}

}  // namespace

TEST_CASE("scaled handle: no free vertex lies further out than the handle asks, however coarse") {
    for (const Index across : {2, 3, 6, 12}) {
        const Scene scene = bar_of(across);
        CAPTURE(across);
        for (const SecondSystem second : {SecondSystem::blend, SecondSystem::poisson}) {
            for (const LocalSize size : {LocalSize::keep, LocalSize::scale}) {
                for (const int refine : {0, 1, 2}) {
                    DeformOptions options;
                    options.second = second;
                    options.local_size = size;
                    options.refine = refine;
                    for (const double factor : {2.0, 0.5, 3.0}) {
                        CAPTURE(factor);
                        CAPTURE(refine);
                        CAPTURE(static_cast<int>(second));
                        CAPTURE(static_cast<int>(size));
                        const Widths w =
                            widths_of(scene, scaled(scene, Vec3::Constant(factor), options));
                        CHECK(w.greatest < 0.5 * std::max(1.0, factor) + 0.02);
                        CHECK(w.least > 0.5 * std::min(1.0, factor) - 0.05);
                    }
                }
            }
        }
    }
}

TEST_CASE("scaled handle: one that draws asks for no more than one that holds") {
    const Scene scene = bar_of(3);
    HandleOptions drawing;
    for (const double weight : {0.1, 1.0, 100.0, 1e6}) {
        drawing.weight = weight;
        CHECK(widths_of(scene, scaled(scene, Vec3::Constant(2.0), {}, drawing)).greatest < 1.01);
    }
    DeformOptions edges;
    edges.second = SecondSystem::poisson;
    for (const Vec3& factors : {Vec3(2.0, 2.0, 2.0), Vec3(2.0, 1.0, 0.6)}) {
        const std::vector<Vec3> exact = scaled(scene, factors, edges);
        CHECK(max_distance(exact, scaled(scene, factors, edges, drawing)) < 0.01);
    }
}

TEST_CASE("scaled handle: one that holds positions only asks for no more either") {
    const Scene scene = bar_of(3);
    HandleOptions positions;
    positions.gradient = false;
    const Widths w = widths_of(scene, scaled(scene, Vec3::Constant(2.0), {}, positions));
    CHECK(w.greatest < 1.01);
    CHECK(w.least > 0.49);
}
