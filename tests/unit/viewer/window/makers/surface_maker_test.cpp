#include "viewer/window/makers/surface_maker.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"

using namespace lissom;
using namespace lissom::window;
using test::shared;

namespace {

// Waits until the maker has something.
SurfaceMaker::Result made_by(SurfaceMaker& maker) {
    for (int i = 0; i < 6000; ++i) {
        if (auto result = maker.take()) return std::move(*result);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("nothing was made");
    return {};
}

std::vector<SurfaceNeeds> needs_of(const DrawnMesh& drawn) {
    return GpuScene().needs({.meshes = {drawn}});
}

bool same_bytes(const PreparedSurface& a, const PreparedSurface& b) {
    const auto same = [](const auto& x, const auto& y) {
        const auto p = std::as_bytes(std::span(x)), q = std::as_bytes(std::span(y));
        return std::equal(p.begin(), p.end(), q.begin(), q.end());
    };
    return same(a.vertices, b.vertices) && same(a.colors, b.colors) && same(a.quick, b.quick);
}

}  // namespace

TEST_CASE("surface maker: what is made beside the window is what prepare makes") {
    std::atomic<int> told{0};
    SurfaceMaker maker(2, [&] { ++told; });
    const DrawnMesh ball{shared(make_sphere())};
    maker.make(needs_of(ball), 7);
    const SurfaceMaker::Result result = made_by(maker);
    CHECK(result.number == 7);
    CHECK(result.error.empty());
    REQUIRE(result.surfaces.size() == 1);
    CHECK(same_bytes(result.surfaces[0], prepare(needs_of(ball)[0])));
    CHECK(result.surfaces[0].groups != nullptr);
    CHECK_FALSE(maker.take());
    while (told == 0) std::this_thread::yield();
}

TEST_CASE("surface maker: of many that follow each other the last is made") {
    SurfaceMaker maker(2, [] {});
    for (std::uint64_t i = 1; i <= 40; ++i) {
        DrawnMesh drawn{shared(make_cactus({.vertices = 2000}))};
        drawn.transform.linear *= static_cast<double>(i);
        maker.make(needs_of(drawn), i);
        if (i % 10 != 0) continue;
        // What is given back meanwhile ends there, too.
        maker.end({prepare(needs_of(drawn)[0])});
    }
    std::uint64_t last = 0;
    while (last < 40) {
        const std::uint64_t number = made_by(maker).number;
        CHECK(number > last);
        last = number;
    }
}

TEST_CASE("surface maker: what cannot be shown is told, and the next is made") {
    SurfaceMaker maker(1, [] {});
    DrawnMesh wrong{shared(make_sphere())};
    std::vector<SurfaceNeeds> needs = needs_of(wrong);
    needs[0].drawn.style.values = {1.0, 2.0};
    maker.make(needs, 1);
    const SurfaceMaker::Result refused = made_by(maker);
    CHECK(refused.surfaces.empty());
    CHECK(refused.error.find("2 values") != std::string::npos);
    maker.make(needs_of(wrong), 2);
    CHECK(made_by(maker).error.empty());
}

TEST_CASE("surface maker: it ends in the middle of its work") {
    for (int i = 0; i < 5; ++i) {
        SurfaceMaker maker(2, [] {});
        maker.make(needs_of({shared(make_cactus({.vertices = 20000}))}), 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(2 * i));
    }
}
