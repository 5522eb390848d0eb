#include "kernel/deform/boundary/common_gradients.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernel/core/extended.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/thesis_options.h"

using namespace lissom;

namespace {

// A bumpy bowl whose open boundary is held, with two features and both systems.
struct FeaturedBowl {
    DeformOptions options;
    WorkingPatch work;
    std::vector<std::vector<Index>> features;
    KnownMask known;
    GradientStencils gradients;
    GradientSystem first;
    RotationSystem second;
    GradientResidual energy;
    CommonGradients common;

    explicit FeaturedBowl(const DeformOptions& how)
        : options(how),
          work(bowl(), options),
          features(patches(work)),
          known(knowledge(work, features)),
          gradients(make_gradients(work.patch, work.rings, work.geometry, known,
                                   Vec3(-0.1, 0.3, 0.2), options)),
          first(work, gradients, known, options, {}),
          second(work, known.position, options, {}),
          energy(work, gradients, known, options),
          common(work, features, first, energy, second) {
        first.factor({});
        second.factor({});
        second.finish({});
        common.prepare({});
    }

    static Patch bowl() {
        GridOptions grid;
        grid.size = {2.0, 2.0};
        grid.segments = {14, 14};
        Mesh mesh = make_grid(grid);
        for (Vec3& p : mesh.edit_positions()) {
            p.y() = 0.5 * p.squaredNorm() + 0.06 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.z());
        }
        return build_patch(mesh, Region::all(mesh.shared_topology()), 1);
    }

    static std::vector<std::vector<Index>> patches(const WorkingPatch& work) {
        std::vector<std::vector<Index>> result(2);
        for (Index v = 0; v < work.patch.real_count; ++v) {
            const Vec3 p = work.patch.rest[v] + work.patch.origin;
            if (work.patch.on_boundary[v]) continue;
            if ((p - Vec3(-0.4, 0.1, 0.0)).norm() < 0.35) result[0].push_back(v);
            if ((p - Vec3(0.5, 0.2, 0.3)).norm() < 0.3) result[1].push_back(v);
        }
        return result;
    }

    static KnownMask knowledge(const WorkingPatch& work,
                               const std::vector<std::vector<Index>>& features) {
        const auto n = static_cast<std::size_t>(work.patch.vertex_count);
        KnownMask known{std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 1)};
        const auto know = [&](Index v) {
            known.position[v] = known.gradient[v] = 1;
            known.gradient_wanted[v] = 0;
        };
        for (Index v = 0; v < work.patch.real_count; ++v) {
            if (work.patch.on_boundary[v]) know(v);
        }
        for (const auto& feature : features) {
            for (const Index v : feature) know(v);
        }
        return known;
    }

    // The solution with values at random on the boundary where features stay.
    void solve_first(std::vector<Vec3>& x, std::vector<Mat3>& m) const {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        x.assign(static_cast<std::size_t>(work.patch.vertex_count), Vec3::Zero());
        m.assign(x.size(), Mat3::Zero());
        for (Index v = 0; v < work.patch.real_count; ++v) {
            if (!work.patch.on_boundary[v]) continue;
            x[v] = Vec3(unit(random), unit(random), unit(random));
            for (double& entry : m[v].reshaped()) entry = unit(random);
        }
        const std::vector<Index>& free = first.free_vertices();
        std::vector<Extended> right(3 * free.size());
        for (int d = 0; d < 3; ++d) {
            first.right_hand_side([&](Index k) { return x[k][d]; },
                                  [&](Index k) { return Vec3(m[k].row(d)); },
                                  right.data() + static_cast<std::size_t>(d) * free.size());
        }
        const std::vector<double> columns = first.solve(right, 3);
        for (std::size_t r = 0; r < free.size(); ++r) {
            for (std::size_t d = 0; d < 3; ++d) x[free[r]][d] = columns[d * free.size() + r];
        }
    }

    // What the energy still pulls at the affine map of each feature.
    double pull_on_features(const std::vector<Vec3>& x, const std::vector<Mat3>& m) const {
        std::vector<Mat3> by_gradient;
        const std::vector<Vec3> by_position = energy.find(x, m, &by_gradient);
        double most = 0.0;
        for (const auto& feature : features) {
            Vec3 move = Vec3::Zero();
            Mat3 map = Mat3::Zero();
            for (const Index v : feature) {
                move += by_position[v];
                map += by_position[v] * common.arm(v).transpose() + by_gradient[v];
            }
            most = std::max({most, move.norm(), map.norm()});
        }
        return most;
    }
};

}  // namespace

TEST_CASE("no affine map of a feature has less energy than the common gradient's") {
    for (const DeformOptions& how : {DeformOptions{}, test::thesis_or_default()}) {
        const FeaturedBowl bowl(how);
        std::vector<Vec3> x;
        std::vector<Mat3> m;
        bowl.solve_first(x, m);
        const double before = bowl.pull_on_features(x, m);
        bowl.common.release_first(x, m);
        CHECK(bowl.pull_on_features(x, m) < 1e-6 * before);
        // The free vertices are still where the energy is least.
        const std::vector<Vec3> left = bowl.energy.find(x, m);
        for (const Index v : bowl.first.free_vertices()) CHECK(left[v].norm() < 1e-6 * before);
        for (const auto& feature : bowl.features) {
            const Index one = feature.front();
            CHECK(m[one].norm() > 1e-3);
            for (const Index v : feature) {
                CHECK((m[v] - m[one]).norm() < 1e-12);
                const Vec3 arm = m[one] * (bowl.common.arm(v) - bowl.common.arm(one));
                CHECK((x[v] - x[one] - arm).norm() < 1e-9);
            }
        }
    }
}

TEST_CASE("in the second system no force is left on a feature") {
    for (const DeformOptions& how : {DeformOptions{}, test::thesis_or_default()}) {
        const FeaturedBowl bowl(how);
        std::vector<PaddedMat3> turns;
        std::vector<Vec4> x(bowl.work.patch.vertex_count, Vec4::Zero());
        for (Index v = 0; v < bowl.work.patch.real_count; ++v) {
            const Vec3& p = bowl.work.patch.rest[v];
            Mat3 turn;
            turn << 0, -p.x(), p.z(), p.x(), 0, -p.y(), -p.z(), p.y(), 0;
            turns.push_back(padded_columns(turn));
            if (bowl.work.patch.on_boundary[v]) x[v] = padded(Vec3(p.y(), p.z(), p.x()));
        }
        bowl.second.solve(turns, x, false, {});
        RotationSystem::Scratch scratch;
        const auto force = [&](Index f) {
            return bowl.second.force(turns.data(), x, bowl.common.vertices(f), scratch, {}).norm();
        };
        const double before = std::max(force(0), force(1));
        bowl.common.release_second(turns, x, {});
        CHECK(std::max(force(0), force(1)) < 1e-6 * before);
    }
}
