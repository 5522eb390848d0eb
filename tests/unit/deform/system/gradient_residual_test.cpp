#include "kernel/deform/system/gradient_residual.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernel/core/extended.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// A bumpy bowl whose open boundary is held, with its first system.
struct Bowl {
    DeformOptions options;
    WorkingPatch work;
    KnownMask known;
    GradientStencils gradients;
    GradientSystem system;

    Bowl()
        : work(bowl(), options),
          known(knowledge(work)),
          gradients(make_gradients(work.patch, work.rings, work.geometry, known,
                                   Vec3(-0.1, 0.3, 0.2), options)),
          system(work, gradients, known, options, {}) {
        system.factor({});
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

    static KnownMask knowledge(const WorkingPatch& work) {
        const auto n = static_cast<std::size_t>(work.patch.vertex_count);
        KnownMask known{std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 1)};
        for (Index v = 0; v < work.patch.real_count; ++v) {
            if (!work.patch.on_boundary[v]) continue;
            known.position[v] = known.gradient[v] = 1;
            known.gradient_wanted[v] = 0;
        }
        return known;
    }

    // What is held at random, and the solution that the matrix gives for it.
    void solve(std::vector<Vec3>& x, std::vector<Mat3>& m) const {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        x.assign(static_cast<std::size_t>(work.patch.vertex_count), Vec3::Zero());
        m.assign(x.size(), Mat3::Zero());
        for (Index v = 0; v < work.patch.real_count; ++v) {
            if (!known.position[v]) continue;
            x[v] = Vec3(unit(random), unit(random), unit(random));
            for (double& entry : m[v].reshaped()) entry = unit(random);
        }
        const std::vector<Index>& free = system.free_vertices();
        std::vector<Extended> right(3 * free.size());
        for (int d = 0; d < 3; ++d) {
            system.right_hand_side([&](Index k) { return x[k][d]; },
                                   [&](Index k) { return Vec3(m[k].row(d)); },
                                   right.data() + static_cast<std::size_t>(d) * free.size());
        }
        const std::vector<double> columns = system.solve(right, 3);
        for (std::size_t r = 0; r < free.size(); ++r) {
            for (std::size_t d = 0; d < 3; ++d) x[free[r]][d] = columns[d * free.size() + r];
        }
    }
};

}  // namespace

TEST_CASE("the residual of the energy is that of the matrix") {
    const Bowl bowl;
    std::vector<Vec3> x;
    std::vector<Mat3> m;
    bowl.solve(x, m);
    const GradientResidual residual(bowl.work, bowl.gradients, bowl.known, bowl.options);
    const std::vector<Vec3> at_solution = residual.find(x, m);
    // A step off the solution comes back by the matrix.
    const std::vector<Index>& free = bowl.system.free_vertices();
    std::vector<Vec3> moved = x;
    for (const Index v : free) moved[v] += Vec3(std::sin(v), std::cos(2.0 * v), 0.1);
    const std::vector<Vec3> off = residual.find(moved, m);
    std::vector<double> columns(3 * free.size());
    double least = 0.0, most = 0.0;
    for (std::size_t r = 0; r < free.size(); ++r) {
        least = std::max(least, at_solution[free[r]].norm());
        most = std::max(most, off[free[r]].norm());
        for (std::size_t d = 0; d < 3; ++d) columns[d * free.size() + r] = off[free[r]][d];
    }
    CHECK(least < 1e-9 * most);
    bowl.system.solve_roughly(columns, columns, 3);
    for (std::size_t r = 0; r < free.size(); ++r) {
        const Vec3 step(columns[r], columns[free.size() + r], columns[2 * free.size() + r]);
        CHECK((moved[free[r]] + step - x[free[r]]).norm() < 1e-8);
    }
}
