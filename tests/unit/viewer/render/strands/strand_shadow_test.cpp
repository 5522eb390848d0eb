#include "viewer/render/strands/strand_shadow.h"

#include <cmath>
#include <numeric>

#include "tests/unit/viewer/render/strands/strand_support.h"

using namespace lissom;
using doctest::Approx;
using Eigen::Vector3f;

namespace {

ViewGrid cube(Index count, float step) {
    return {Vector3f::Zero(), step, {count, count, count}};
}

}  // namespace

TEST_CASE("strand shadow: what is splatted is all there, around its place") {
    const ViewGrid grid = cube(5, 0.5f);
    std::vector<float> values(grid.size(), 0.0f);
    splat(grid, values, {0.7f, 1.2f, 1.9f}, 3.0f);
    Vector3f center = Vector3f::Zero();
    for (Index k = 0; k < 5; ++k) {
        for (Index j = 0; j < 5; ++j) {
            for (Index i = 0; i < 5; ++i) {
                center +=
                    values[grid.index(i, j, k)] * 0.5f * Eigen::Vector3i(i, j, k).cast<float>();
            }
        }
    }
    CHECK(std::accumulate(values.begin(), values.end(), 0.0f) == Approx(3.0));
    CHECK((center / 3.0f - Vector3f(0.7f, 1.2f, 1.9f)).norm() < 1e-5f);
    const std::vector<float> before = values;
    splat(grid, values, {-0.1f, 1.0f, 1.0f}, 1.0f);
    splat(grid, values, {1.0f, 2.01f, 1.0f}, 1.0f);
    splat(grid, values, {1.0f, std::nanf(""), 1.0f}, 1.0f);
    CHECK(values == before);
    splat(grid, values, {2.0f, 2.0f, 2.0f}, 1.0f);
    CHECK(values[grid.index(4, 4, 4)] == 1.0f);
}

TEST_CASE("strand shadow: light falls off exponentially in an even medium") {
    const ViewGrid grid = cube(21, 0.1f);
    const std::vector<float> even(grid.size(), 0.8f);
    for (const Vector3f& to_light :
         {Vector3f(0, 0, 2), Vector3f(0, -1, 0), Vector3f(1, 0.2f, -0.3f)}) {
        const std::vector<float> light = light_through(grid, even, to_light);
        const Vector3f d = to_light.normalized();
        int major = 0;
        d.cwiseAbs().maxCoeff(&major);
        // Points of the middle, whose rays do not leave through the sides: 4 planes deep.
        Eigen::Vector3i at = Eigen::Vector3i::Constant(10);
        at[major] = d[major] > 0.0f ? 16 : 4;
        // The plane that light enters by counts half.
        const double way = 0.1 * (4 + 0.5) / std::abs(d[major]);
        CHECK(light[grid.index(at[0], at[1], at[2])] == Approx(std::exp(-0.8 * way)).epsilon(1e-4));
    }
}

TEST_CASE("strand shadow: it lies behind, away from the light, and nowhere else") {
    const ViewGrid grid = cube(31, 0.1f);
    std::vector<float> block(grid.size(), 0.0f);
    for (Index i = 13; i <= 17; ++i) {
        for (Index j = 13; j <= 17; ++j) block[grid.index(i, j, 15)] = 60.0f;
    }
    const std::vector<float> light = light_through(grid, block, {0.0f, 1.0f, 1.0f});
    const auto at = [&](Index i, Index j, Index k) { return light[grid.index(i, j, k)]; };
    CHECK(at(15, 15, 25) == 1.0f);
    CHECK(at(15, 7, 7) < 0.05f);
    CHECK(at(15, 23, 7) == Approx(1.0));
    CHECK(at(3, 7, 7) == Approx(1.0));
    for (const float l : light) CHECK_MESSAGE((l >= 0.0f && l <= 1.0f), l);
    const std::vector<float> clear(grid.size(), 0.0f);
    for (const float l : light_through(grid, clear, {1, 2, 3})) REQUIRE(l == Approx(1.0));
}

TEST_CASE("strand shadow: strands shade what is below them, more strands more") {
    // A mat of strands in a horizontal plane, 20 cm wide, under the key light.
    const auto mat = [](Index count) {
        std::vector<std::vector<Vec3>> lines;
        for (Index s = 0; s < count; ++s) {
            const double z = 0.2 * (s + 0.5) / count - 0.1;
            std::vector<Vec3> line;
            for (int i = 0; i <= 40; ++i) line.emplace_back(0.005 * i - 0.1, 0.0, z);
            lines.push_back(line);
        }
        // Something far below, so that the grid reaches there.
        lines.push_back({Vec3(0, -0.05, 0), Vec3(0, -0.051, 0)});
        return test::strands_of(lines, 1e-3);
    };
    const auto light_below = [&](Index count, const StrandStyle& style) {
        const Strands strands = mat(count);
        const Snapshot drawing = test::drawing_of(strands, style);
        const auto scene = view_strands(drawing, Mat4::Identity(), Vec3::Zero());
        return StrandShadow(scene, {}).light({0.0f, -0.03f, 0.0f});
    };
    const StrandLight thin = light_below(100, {}), dense = light_below(400, {});
    CHECK(thin.key < 0.95f);
    CHECK(dense.key < thin.key - 0.1f);
    CHECK(dense.ambient < thin.ambient);
    CHECK(dense.key > 0.0f);
    StrandStyle none;
    none.shadow = 0.0;
    CHECK(light_below(400, none).key == Approx(1.0).epsilon(1e-4));
    // A prefix stands for all.
    StrandStyle part;
    part.count = 4000;
    const Strands all = test::curtain(8000, 0.0, 5e-4);
    const Snapshot whole = test::drawing_of(all), half = test::drawing_of(all, part);
    const auto light = [](const Snapshot& drawing) {
        const auto scene = view_strands(drawing, Mat4::Identity(), Vec3::Zero());
        return StrandShadow(scene, {}).light({0.1f, 0.0f, -0.03f});
    };
    CHECK(light(half).key == Approx(light(whole).key).epsilon(0.05));
}

TEST_CASE("strand shadow: a mesh shades strands behind it, not those on it") {
    Mesh square = test::make_square();
    for (Vec3& p : square.edit_positions()) p *= 0.1;
    const Strands strands =
        test::strands_of({{Vec3(0, 0, 0.004), Vec3(0.01, 0, 0.004)},
                          {Vec3(0.03, -0.03, -0.05), Vec3(0.04, -0.03, -0.05)}});
    Snapshot drawing = test::drawing_of(strands);
    drawing.meshes.push_back({test::shared(square)});
    const auto drawn = view_strands(drawing, Mat4::Identity(), Vec3::Zero());
    const auto triangles = view_triangles(drawing, Mat4::Identity(), Vec3::Zero());
    const StrandShadow shadow(drawn, triangles);
    CHECK(shadow.light({0.005f, 0.0f, 0.004f}).key > 0.8f);
    CHECK(shadow.light({0.035f, -0.03f, -0.05f}).key < 0.1f);
}

TEST_CASE("strand shadow: the scalp takes the hair's colour where many roots are") {
    std::vector<std::vector<Vec3>> lines;
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j < 60; ++j) {
            const Vec3 root(0.0008 * i, 0.0008 * j, 0);
            lines.push_back({root, root + Vec3(0, 0, 0.05)});
        }
    }
    lines.push_back({Vec3(0.12, 0, 0), Vec3(0.12, 0, 0.05)});
    Strands strands = test::strands_of(lines);
    strands.set_colors({Eigen::Vector3f(0.5f, 0.25f, 0.125f)});
    const Snapshot drawing = test::drawing_of(strands);
    const auto drawn = view_strands(drawing, Mat4::Identity(), Vec3::Zero());
    const StrandShadow shadow(drawn, {});
    const auto tint = [&](const Vector3f& p) {
        const ViewGrid& grid = shadow.grid();
        const Vector3f at = ((p - grid.origin) / grid.step).array().round();
        const auto i = grid.index(Index(at.x()), Index(at.y()), Index(at.z()));
        return shadow.on_meshes()[4 * i + 2] / 255.0;
    };
    CHECK(tint({0.024f, 0.024f, 0.0f}) == Approx(0.7).epsilon(0.02));
    CHECK(tint({0.12f, 0.0f, 0.0f}) < 0.1);
    CHECK(tint({0.08f, 0.024f, 0.0f}) == 0.0);
    CHECK(shadow.scalp_color()[0] == Approx(2.0 * shadow.scalp_color()[1]));
}

TEST_CASE("strand shadow: few wide strands tint the scalp as many thin ones do") {
    const auto tint = [](int along, float width) {
        std::vector<std::vector<Vec3>> lines;
        for (int i = 0; i < along; ++i) {
            for (int j = 0; j < along; ++j) {
                const Vec3 root(0.05 * i / along, 0.05 * j / along, 0);
                lines.push_back({root, root + Vec3(0, 0, 0.05)});
            }
        }
        Strands strands = test::strands_of(lines);
        StrandWidths widths;
        widths.common = width;
        strands.set_widths(widths);
        const Snapshot drawing = test::drawing_of(strands);
        const StrandShadow shadow(view_strands(drawing, Mat4::Identity(), Vec3::Zero()), {});
        const ViewGrid& grid = shadow.grid();
        const Vector3f at =
            ((Vector3f(0.025f, 0.025f, 0.0f) - grid.origin) / grid.step).array().round();
        const auto i = grid.index(Index(at.x()), Index(at.y()), Index(at.z()));
        return shadow.on_meshes()[4 * i + 2] / 255.0;
    };
    // As on a head of 5,000 and of 80,000 strands that cover as much, and of 5,000 thin ones.
    CHECK(tint(14, 8e-4f) == Approx(0.7).epsilon(0.05));
    CHECK(tint(56, 5e-5f) == Approx(0.7).epsilon(0.05));
    CHECK(tint(14, 1e-4f) < 0.25);
}

TEST_CASE("strand shadow: the tint of evenly rooted skin has no rings") {
    std::vector<std::vector<Vec3>> lines;
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j < 60; ++j) {
            const Vec3 root(0.0008 * i, 0.0008 * j, 0.37 * 0.0008 * i);
            lines.push_back({root, root + Vec3(0, 0, 0.05)});
        }
    }
    const Strands strands = test::strands_of(lines);
    const Snapshot drawing = test::drawing_of(strands);
    const StrandShadow shadow(view_strands(drawing, Mat4::Identity(), Vec3::Zero()), {});
    const ViewGrid& grid = shadow.grid();
    for (int k = 0; k <= 40; ++k) {
        const float x = 0.016f + 0.0004f * static_cast<float>(k);
        const Vector3f p(x, 0.024f, 0.37f * x);
        const Vector3f at = ((p - grid.origin) / grid.step).array().round();
        const auto i = grid.index(Index(at.x()), Index(at.y()), Index(at.z()));
        CHECK(shadow.on_meshes()[4 * i + 2] / 255.0 == Approx(0.7).epsilon(0.02));
    }
}

TEST_CASE("strand shadow: no strands, or only broken ones, are no shade") {
    const Strands nothing;
    const double nan = std::nan("");
    const Strands broken = test::strands_of({{Vec3(nan, 0, 0), Vec3(0, nan, 0)}, {Vec3(0, 0, 0)}});
    for (const Strands* strands : {&nothing, &broken}) {
        const Snapshot drawing = test::drawing_of(*strands);
        const auto drawn = view_strands(drawing, Mat4::Identity(), Vec3::Zero());
        const StrandShadow shadow(drawn, {});
        CHECK(shadow.light({0, 0, 0}).key == Approx(1.0));
    }
}
