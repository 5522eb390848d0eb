// The band of triangles between two loops, and seams made with it.

#include "kernel/merge/sew/seam_band.h"

#include <Eigen/Geometry>
#include <random>

#include "kernel/merge/sew/sew.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

std::vector<Vec3> noisy_circle(Index count, double height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    std::vector<Vec3> points;
    for (Index k = 0; k < count; ++k) {
        const double angle = 2.0 * kPi * (k + noise(random)) / count;
        points.emplace_back(std::cos(angle) + noise(random), height + noise(random),
                            -std::sin(angle) + noise(random));
    }
    return points;
}

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

double area_of(const std::vector<BandTriangle>& band, const std::vector<Vec3>& first,
               const std::vector<Vec3>& second) {
    double sum = 0.0;
    for (const BandTriangle& t : band) {
        const std::vector<Vec3>& along = t.of_first ? first : second;
        const std::vector<Vec3>& other = t.of_first ? second : first;
        sum += area_of(along[t.edge], along[(t.edge + 1) % along.size()], other[t.apex]);
    }
    return sum;
}

// The least area over all bands that begin with the edge between point `start` of the first loop
// and point 0 of the second.
double min_area(const std::vector<Vec3>& first, const std::vector<Vec3>& second,
                std::size_t start) {
    const std::size_t n = first.size(), m = second.size();
    std::vector<std::vector<double>> cost(n + 1, std::vector<double>(m + 1, 1e300));
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t c = 0; c <= m; ++c) {
            if (i == 0 && c == 0) cost[0][0] = 0.0;
            const Vec3 &p = first[(start + i) % n], &q = second[c % m];
            if (i > 0) {
                cost[i][c] = std::min(cost[i][c],
                                      cost[i - 1][c] + area_of(first[(start + i - 1) % n], p, q));
            }
            if (c > 0) {
                cost[i][c] = std::min(cost[i][c], cost[i][c - 1] + area_of(second[c - 1], q, p));
            }
        }
    }
    return cost[n][m];
}

}  // namespace

TEST_CASE("band: the least area of all starts, on random loops") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto first = noisy_circle(3 + seed, 0.0, seed);
        const auto second = noisy_circle(3 + (7 * seed) % 11, 1.0, seed + 100);
        const std::vector<BandTriangle> band = min_area_band(first, second);
        CHECK(band.size() == first.size() + second.size());
        double best = 1e300;
        for (std::size_t start = 0; start < first.size(); ++start) {
            best = std::min(best, min_area(first, second, start));
        }
        CHECK(area_of(band, first, second) == doctest::Approx(best).epsilon(1e-12));
    }
}

TEST_CASE("band: a tube stays a manifold tube, and the source's loop is the seam") {
    for (const auto& counts : {std::pair<Index, Index>{24, 24}, {24, 31}, {40, 9}, {3, 50}}) {
        const Index n = counts.first, m = counts.second;
        CAPTURE(n);
        CAPTURE(m);
        const SewScene scene = two_tubes(n, m);
        const Sewn sewn =
            sew(scene.target, scene.source, scene.joins, {.kind = SeamKind::band, .smooth = 0});
        CHECK(euler_characteristic(sewn.mesh.topology()) == 0);
        CHECK(sewn.mesh.topology().boundary_loops().size() == 2);
        CHECK(sewn.report.band_removed == n);
        CHECK(sewn.report.band_added == n + m);
        CHECK(static_cast<Index>(sewn.seams[0].size()) == m);
        CHECK(sewn.mesh.vertex_count() ==
              scene.target.vertex_count() - n + scene.source.vertex_count());
        if (n > 20 && m > 20) {
            CHECK(area(sewn.mesh) ==
                  doctest::Approx(area(scene.target) + area(scene.source)).epsilon(0.02));
        }
    }
}

TEST_CASE("band: refused where the target is a single band") {
    SewScene scene{make_tube(12, -1.0, 1.0, 1.0, 1), make_tube(12, 0.0, 1.0), {}};
    add_join(scene, boundary_towards(scene.target, 1.0), boundary_towards(scene.source, -1.0),
             Vec3(1.0, 0.0, 1e-3));
    const auto sew_band = [&] {
        sew(scene.target, scene.source, scene.joins, {.kind = SeamKind::band});
    };
    CHECK(error_of(sew_band).code() == ErrorCode::boundary_conflict);
    CHECK(sew(scene.target, scene.source, scene.joins).mesh.topology().boundary_loops().size() ==
          2);
}
