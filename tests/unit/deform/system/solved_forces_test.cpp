// Forces on groups of held vertices where the second system would take the free ones.
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// The responses of the vertices at both ends of a scene.
std::vector<RotationSystem::Response> responses_of(const RotationSystem& system, const Scene& scene,
                                                   std::size_t count) {
    std::vector<Vec4> x(count, Vec4::Zero());
    for (const Index v : scene.low) x[v][0] = 1.0;
    for (const Index v : scene.high) x[v][1] = 1.0;
    RotationSystem::Scratch scratch;
    system.solve({}, x, false, scratch, {});
    return system.responses(x, 2, scratch, {});
}

}  // namespace

TEST_CASE("forces where the free vertices would lie need no solution, from any guess") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 6, 30}));
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson}) {
        DeformOptions options;
        options.second = second;
        const WorkingPatch work(build_patch(scene.mesh, scene.all(), 2), options);
        const auto count = static_cast<std::size_t>(work.patch.vertex_count);
        std::vector<char> held(count, 0);
        for (const Index v : scene.low) held[v] = 1;
        for (const Index v : scene.high) held[v] = 1;
        RotationSystem system(work, held, options, {});
        system.factor({});
        system.finish({});
        CHECK(!system.has_ties());
        std::vector<PaddedMat3> turns(count);
        std::vector<Vec4> x(count, Vec4::Zero());
        for (std::size_t v = 0; v < count; ++v) {
            const double t = work.patch.rest[v].y();
            turns[v] = padded_columns(rotation(Vec3::UnitY(), t, Vec3::Zero()).linear);
            x[v] = padded(Vec3(0.3 * t, t, std::sin(9.0 * static_cast<double>(v))));
        }
        const auto responses = responses_of(system, scene, count);
        const Context threads = [] {
            ContextOptions two;
            two.threads = 2;
            return Context(two);
        }();
        RotationSystem::Scratch scratch;
        std::vector<Vec3> forces;
        for (const RotationSystem::Response& response : responses) {
            forces.push_back(system.solved_force(turns.data(), x, response, scratch, {}));
            CHECK(system.solved_force(turns.data(), x, response, scratch, threads) ==
                  forces.back());
        }
        system.solve(turns, x, false, {});
        for (std::size_t g = 0; g < 2; ++g) {
            const Vec3 expected =
                system.force(turns.data(), x, g == 0 ? scene.low : scene.high, scratch, {});
            CHECK(expected.norm() > 1e-3);
            CHECK((forces[g] - expected).norm() < 1e-8 * expected.norm());
        }
    }
}
