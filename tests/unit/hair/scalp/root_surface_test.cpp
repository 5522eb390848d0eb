#include "kernel/hair/scalp/root_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;

TEST_CASE("darts are even in area, whatever the sizes of faces") {
    // Between two parallel planes lies as much of a sphere wherever they are (Archimedes); the
    // faces of this one are the smaller the nearer they are to its poles.
    constexpr double kRadius = 0.09;
    const Mesh mesh = make_sphere({.radius = kRadius, .segments = 64});
    ScalpOptions options;
    options.hints = {Vec3::UnitY(), Vec3::UnitZ()};
    options.region = select_plane(mesh, Vec3(0, -1e-6, 0), Vec3::UnitY());
    const Scalp scalp(mesh, options);
    const RootSurface surface(mesh, scalp, {});
    constexpr int kDarts = 20000, kSlices = 5;
    std::array<int, kSlices> count{};
    for (int k = 0; k < kDarts; ++k) {
        CountedRandom random(1, static_cast<std::uint64_t>(k));
        const double height = surface.position(surface.random_dart(random)).y() / kRadius;
        ++count[at(std::clamp(static_cast<Index>(height * kSlices), 0, kSlices - 1))];
    }
    for (const int one : count) CHECK(std::abs(one * kSlices - kDarts) < 0.06 * kDarts);
}
