/// Helpers shared by the tests of strands.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strands.h"
#include "tests/unit/hair/threads.h"
#include "tests/unit/support.h"

namespace lissom::test {

/// Strands of these points.
inline Strands strands_of(const std::vector<std::vector<Vec3>>& lists) {
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (const std::vector<Vec3>& list : lists) {
        for (const Vec3& p : list) {
            for (const double x : p) points.push_back(static_cast<float>(x));
        }
        offsets.push_back(static_cast<Index>(points.size() / 3));
    }
    return {std::move(points), std::move(offsets)};
}

/// Curved strands of 4 to 23 points, up to 0.2 metres long, rooted on a square of 0.2 metres.
inline Strands random_hair(Index count, unsigned seed = 1) {
    std::mt19937 generator(seed);
    const auto random = [&] { return generator() / 4294967296.0 - 0.5; };
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        std::vector<Vec3> points = {Vec3(0.2 * random(), 0.0, 0.2 * random())};
        Vec3 direction(random(), 1.0, random());
        const int segments = 3 + static_cast<int>(generator() % 20);
        for (int k = 0; k < segments; ++k) {
            direction += 0.3 * Vec3(random(), random() - 0.2, random());
            points.push_back(points.back() + 0.01 * direction.normalized());
        }
        lists.push_back(points);
    }
    return strands_of(lists);
}

/// Hair with everything that strands can hold.
inline Strands rich_hair(Index count, unsigned seed = 1) {
    Strands strands = random_hair(count, seed);
    const auto n = static_cast<std::size_t>(count);
    StrandWidths widths;
    widths.domain = StrandDomain::strand;
    StrandValues<Eigen::Vector3f> colors{{0.1f, 0.2f, 0.3f}, StrandDomain::point};
    StrandValues<float> transparency{0.25f};
    StrandRoots roots;
    std::vector<Index> groups;
    std::vector<std::uint32_t> ids;
    for (std::size_t s = 0; s < n; ++s) {
        const auto x = static_cast<float>(s) / static_cast<float>(n);
        widths.values.push_back(1e-4f * (1.0f + x));
        roots.faces.push_back(static_cast<Index>(7 * s));
        roots.barycentrics.emplace_back(x, 1.0f - x, 0.0f);
        roots.uvs.emplace_back(x, x * x);
        const auto v = static_cast<Index>(5 * s);
        roots.triangles.push_back({v, v + 2, v + 1});
        groups.push_back(static_cast<Index>(s % 3) - 1);
        ids.push_back(static_cast<std::uint32_t>(1000 + s));
    }
    widths.profile = {1.0f, 0.5f, 0.25f};
    for (Index p = 0; p < strands.point_count(); ++p) {
        const auto x = static_cast<float>(p) / static_cast<float>(strands.point_count());
        colors.values.emplace_back(x, 0.5f, 1.0f - x);
    }
    strands.set_widths(widths);
    strands.set_colors(colors);
    strands.set_transparency(transparency);
    strands.set_roots(roots);
    strands.set_groups(groups, {"fringe", "back hair"});
    strands.set_ids(ids);
    strands.set_comment("a test");
    return strands;
}

inline bool same_points(const StrandView& a, const StrandView& b) {
    return a.cols() == b.cols() && a == b;
}

}  // namespace lissom::test
