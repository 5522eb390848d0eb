// Sharp edges of a surface, and the grain of rough ones.
#include "kernel/merge/paste/part/target_bite.h"

#include <doctest/doctest.h>

#include <cmath>

#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// A sheet with ribs: the surface goes up and down with x.
Mesh ribbed(double height, double jitter) {
    std::vector<Vec3> positions;
    FaceList faces;
    constexpr Index n = 40;
    for (Index j = 0; j <= n; ++j) {
        for (Index i = 0; i <= n; ++i) {
            const double noise = jitter * std::sin(37.0 * i + 91.0 * j);
            positions.emplace_back(i, height * std::sin(1.1 * i) + noise, j);
        }
    }
    for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
            const Index a = j * (n + 1) + i;
            faces.add({a, a + n + 1, a + n + 2, a + 1});
        }
    }
    return {std::move(positions), std::move(faces)};
}

}  // namespace

TEST_CASE("edges of a box are sharp, and so are creases of a sheet that is smooth beside them") {
    CHECK(sharp_edges(make_box({}), {}).size() >= 12);
}

TEST_CASE("ribs of a rough surface are grain and no sharp edges") {
    // Rough ribs turn by more than the limit of a sharp edge at many edges, smooth ones at as many.
    const std::size_t smooth = sharp_edges(ribbed(0.8, 0.0), {}).size();
    CHECK(smooth > 400);
    CHECK(sharp_edges(ribbed(0.8, 0.25), {}).size() < smooth);
}
