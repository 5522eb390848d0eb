#include "kernel/deform/frame/tears.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace lissom {
namespace {

// Slips up to so many lengths of the gap can be bridged without harm.
constexpr double kBridged = 1.5;
constexpr int kMaxRings = 10;

// Image of p under the holder of local vertex v: constraints by their own vertex, others stay.
Vec3 taken(const Preparation& prepared, const Poses& poses, Index v, const Vec3& p) {
    const Index owner = prepared.owner[at(v)];
    if (owner >= 0) return poses.handles[at(owner)].local_transform(p);
    if (owner != kConstrained) return p;
    for (std::size_t t = 0; t < prepared.constraints->targets.size(); ++t) {
        const Target& target = *prepared.constraints->targets[t];
        if (!target.is_hard_vertex() || target.row.front().first != v) continue;
        const Patch& patch = prepared.patch();
        return p + poses.targets[t].position - patch.origin - patch.rest[at(v)];
    }
    return p;
}

double slip_of(const Preparation& prepared, const Poses& poses, const HandleGap& gap) {
    const std::vector<Vec3>& rest = prepared.patch().rest;
    const Vec3 middle = 0.5 * (rest[at(gap.first)] + rest[at(gap.second)]);
    const Vec3 parted =
        taken(prepared, poses, gap.first, middle) - taken(prepared, poses, gap.second, middle);
    return gap.length > 0.0 ? parted.norm() / gap.length : 0.0;
}

}  // namespace

std::vector<Tear> tears_of(const Preparation& preparation, const Poses& poses) {
    const Patch& patch = preparation.patch();
    std::vector<Tear> tears;
    for (const HandleGap& gap : preparation.gaps) {
        if (gap.first >= patch.mesh_count() || gap.second >= patch.mesh_count()) continue;
        const double slip = slip_of(preparation, poses, gap);
        if (!(slip > kBridged)) continue;
        tears.push_back(
            {{patch.mesh_vertex[at(gap.first)], patch.mesh_vertex[at(gap.second)]}, slip});
    }
    std::stable_sort(tears.begin(), tears.end(),
                     [](const Tear& a, const Tear& b) { return a.slip > b.slip; });
    return tears;
}

DeformWarning tear_warning(const Preparation& preparation, const std::vector<Tear>& tears) {
    const Tear& worst = tears.front();
    // Each ring makes the gap longer by about two edges.
    const int needed = static_cast<int>(std::ceil(0.5 * (worst.slip / kBridged - 1.0)));
    const int rings = preparation.rest->options().free_rings + std::max(needed, 1);
    char text[400];
    std::snprintf(
        text, sizeof text,
        "handles nearly touch and part by %.3g times the length between them, so that the "
        "surface there is torn; leave more of it free between them, or make the "
        "deformation with free_rings = %d",
        worst.slip, std::min(rings, kMaxRings));
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Tear& tear : tears) {
        for (const Index v : tear.vertices) vertices.add(v);
    }
    return {DeformHarm::torn, text, std::move(vertices)};
}

}  // namespace lissom
