// Distances for collisions with parts that are thinner than the steps of the grid.
#include "kernel/hair/field/thin_parts.h"

#include <doctest/doctest.h>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// As interpolation between grid points has it.
double interpolated(const GridLayout& layout, const std::vector<float>& values, const Vec3& p) {
    const Vec3 at = (p - layout.origin) / layout.step;
    const Eigen::Vector3i cell = at.array().floor().cast<int>();
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
        const Eigen::Vector3i up(c & 1, (c >> 1) & 1, c >> 2);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double t = at[axis] - cell[axis];
            weight *= up[axis] ? t : 1.0 - t;
        }
        const Eigen::Vector3i corner = cell + up;
        sum += weight *
               values[static_cast<std::size_t>(layout.index(corner.x(), corner.y(), corner.z()))];
    }
    return sum;
}

}  // namespace

TEST_CASE("thin parts: a plate between grid points is seen, wherever it stands") {
    const Mesh plate = make_box({.size = Vec3(1.0, 1.0, 0.02)});
    for (const double shift : {0.0, 0.21, 0.37}) {
        GridLayout layout = fit_grid({Vec3::Constant(-0.8), Vec3::Constant(0.8)}, 8000);
        REQUIRE(layout.step > 0.05);
        layout.origin.z() += shift * layout.step;
        const DistanceGrid distances(plate, layout);
        const std::vector<float> kept_out = collision_distances(distances, plate);
        RandomPoints random(3);
        double before = 0.0, after = -1.0;
        for (int i = 0; i < 500; ++i) {
            const Vec3 p(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                         random.uniform(-0.01, 0.01));
            before = std::max(before, distances.value(p));
            after = std::max(after, interpolated(layout, kept_out, p));
        }
        CHECK(before > 0.15 * layout.step);
        CHECK(after < 1.3 * kTrustedDistance * layout.step);
        // Two steps away nothing has changed.
        for (std::size_t i = 0; i < kept_out.size(); ++i) {
            if (distances.values()[i] > 2.0 * layout.step) {
                CHECK(kept_out[i] == distances.values()[i]);
            }
        }
    }
}

TEST_CASE("thin parts: where the surface is smooth beside the steps nothing changes") {
    const Mesh sphere = make_sphere({.radius = 1.0});
    const DistanceGrid distances(sphere,
                                 fit_grid({Vec3::Constant(-1.3), Vec3::Constant(1.3)}, 60000));
    const std::vector<float> kept_out = collision_distances(distances, sphere);
    CHECK(std::equal(kept_out.begin(), kept_out.end(), distances.values().begin()));
}
