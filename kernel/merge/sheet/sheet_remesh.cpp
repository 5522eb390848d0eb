#include "kernel/merge/sheet/sheet_remesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace lissom {
namespace {

constexpr int kRounds = 6, kSweeps = 12;
// Edges are split above and collapsed below these parts of the length wanted.
constexpr double kTooLong = 4.0 / 3.0, kTooShort = 4.0 / 5.0;
constexpr double kCollapseTurn = 45.0 * kPi / 180.0, kOver = 0.5 * kPi;
// Angles of triangles above these may become smaller by collapses, and by moves.
constexpr double kCollapsedAngle = 20.0 * kPi / 180.0, kMovedAngle = 25.0 * kPi / 180.0;
// Lengths are sorted in steps of this part of a wanted length, so that rounding does not decide.
constexpr double kLengthStep = 1e-6;

// The sheet that is worked on, the surface that it stays on, and the lengths wanted at its
// vertices.
struct SheetWork {
    SheetTriangles& sheet;
    const SheetRest& rest;
    const SheetSize& size_at;
    SheetLimits limits;
    StarMeter meter;
    std::vector<double> size;

    double wanted(Index a, Index b) const { return 0.5 * (size[at(a)] + size[at(b)]); }
    double length(Index a, Index b) const { return (sheet.x[b] - sheet.x[a]).norm(); }
};

// Puts the new vertex `m` on the surface if that does no harm to the triangles that are to be.
void lift(SheetWork& work, Index m, const std::array<Index, 2>& faces,
          const std::array<Triangle, 4>& after) {
    SheetTriangles& sheet = work.sheet;
    const Vec3 on_surface = work.rest.nearest(sheet.x[m]);
    double flat = kPi;
    for (const Triangle& t : after) flat = std::min(flat, sheet.min_angle(t));
    const SheetStar now = work.meter.of(faces);
    const SheetStar then = work.meter.with(after, faces, m, on_surface);
    const bool holds = then.angle >= 0.5 * flat && is_allowed(now, then, work.limits, 0.0);
    if (holds) sheet.x[m] = on_surface;
}

// Splits an edge in its middle: on the edge if it is a feature, else on the surface if that does no
// harm.
bool split(SheetWork& work, Index a, Index c) {
    SheetTriangles& sheet = work.sheet;
    const std::optional<SheetQuad> quad = quad_at(sheet, a, c);
    if (!quad) return false;
    const Index left = quad->left, right = quad->right, d = quad->d, b = quad->b;
    const Index m = sheet.vertex_count();
    sheet.add_vertex(0.5 * (sheet.x[a] + sheet.x[c]), kNoIndex);
    const std::array<Triangle, 4> after{{{a, m, d}, {m, c, d}, {c, m, b}, {m, a, b}}};
    if (sheet.is_feature(a, c)) {
        sheet.remove_feature(a, c);
        sheet.add_feature(a, m);
        sheet.add_feature(m, c);
    } else {
        lift(work, m, {left, right}, after);
    }
    work.size.push_back(work.size_at(sheet.x[m]));
    sheet.leave(left);
    sheet.leave(right);
    sheet.add_empty(2);
    const auto next = count_of(sheet.triangles) - 2;
    sheet.enter(left, after[0]);
    sheet.enter(next, after[1]);
    sheet.enter(right, after[2]);
    sheet.enter(next + 1, after[3]);
    return true;
}

// Whether a surface without the edge is one still: the link condition (Dey et al. 1999), and no
// edge becomes too long.
bool may_join(const SheetWork& work, Index gone, Index kept) {
    const SheetTriangles& sheet = work.sheet;
    const std::vector<Index> of_gone = sheet.ring(gone), of_kept = sheet.ring(kept);
    std::vector<Index> common;
    std::set_intersection(of_gone.begin(), of_gone.end(), of_kept.begin(), of_kept.end(),
                          std::back_inserter(common));
    if (common.size() != 2) return false;
    double longest = 0.0;
    for (const Index w : of_gone) longest = std::max(longest, work.length(gone, w));
    for (const Index w : of_gone) {
        if (w == kept || w == common[0] || w == common[1]) continue;
        const double length = work.length(kept, w);
        if (sheet.outer_edges.contains(edge_key(kept, w))) return false;
        if (length > kTooLong * work.wanted(kept, w) && length > longest) return false;
    }
    return true;
}

// The triangles that change in a collapse, and what they become.
struct Collapsed {
    std::vector<Index> faces;
    std::vector<Triangle> after;
};

Collapsed collapsed_star(const SheetTriangles& sheet, Index gone, Index kept) {
    Collapsed result;
    for (const Index f : sheet.around[gone]) {
        Triangle t = sheet.triangles[f];
        if (std::find(t.begin(), t.end(), kept) != t.end()) continue;
        result.faces.push_back(f);
        std::replace(t.begin(), t.end(), gone, kept);
        result.after.push_back(t);
    }
    return result;
}

bool collapse(SheetWork& work, Index gone, Index kept) {
    SheetTriangles& sheet = work.sheet;
    if (sheet.fixed[gone] || !quad_at(sheet, gone, kept)) return false;
    std::array<Index, 2> along{kNoIndex, kNoIndex};
    const bool free = sheet.is_free(gone);
    if (!free && !(sheet.is_feature(gone, kept) && sheet.is_sliding(gone, along))) return false;
    if (!may_join(work, gone, kept)) return false;
    const Collapsed changing = collapsed_star(sheet, gone, kept);
    const std::vector<Triangle>& after = changing.after;
    if (after.empty() || sheet.turns(changing.faces, after, kCollapseTurn)) return false;
    const std::vector<Index> faces = sheet.around[gone];
    const SheetStar now = work.meter.of(faces), then = work.meter.with(after, faces);
    if (!is_allowed(now, then, work.limits, kCollapsedAngle)) return false;
    for (const Index f : faces) sheet.leave(f);
    for (std::size_t i = 0; i < after.size(); ++i) sheet.enter(changing.faces[i], after[i]);
    if (!free) {
        sheet.remove_feature(gone, along[0]);
        sheet.remove_feature(gone, along[1]);
        sheet.add_feature(along[0], along[1]);
    }
    return true;
}

// From a vertex to the mean of the triangles around it, dense ones counting more; nothing if they
// have no area.
std::optional<Vec3> way_to_mean(const SheetWork& work, Index v) {
    const SheetTriangles& sheet = work.sheet;
    Vec3 mean = Vec3::Zero();
    double sum = 0.0;
    for (const Index f : sheet.around[v]) {
        const Triangle& t = sheet.triangles[f];
        const double size = (work.size[t[0]] + work.size[t[1]] + work.size[t[2]]) / 3.0;
        const double weight = sheet.normal[f].norm() / (size * size * size * size);
        mean += weight * (sheet.x[t[0]] + sheet.x[t[1]] + sheet.x[t[2]]) / 3.0;
        sum += weight;
    }
    if (!(sum > 0.0) || !std::isfinite(sum)) return std::nullopt;
    return mean / sum - sheet.x[v];
}

// The part of a way that leads along the feature to either neighbour, half the edge at most.
Vec3 along_feature(const SheetTriangles& sheet, Index v, const std::array<Index, 2>& along,
                   const Vec3& way) {
    const Vec3 next = sheet.x[along[0]] - sheet.x[v], last = sheet.x[along[1]] - sheet.x[v];
    const double on = way.dot(next) / next.squaredNorm(), back = way.dot(last) / last.squaredNorm();
    return on > back ? Vec3(std::clamp(on, 0.0, 0.5) * next)
                     : Vec3(std::clamp(back, 0.0, 0.5) * last);
}

void relax(SheetWork& work, Index v) {
    SheetTriangles& sheet = work.sheet;
    if (sheet.fixed[v] || sheet.around[v].empty()) return;
    std::array<Index, 2> along{kNoIndex, kNoIndex};
    const bool free = sheet.is_free(v);
    if (!free && !sheet.is_sliding(v, along)) return;
    std::optional<Vec3> way = way_to_mean(work, v);
    if (!way) return;
    if (!free) way = along_feature(sheet, v, along, *way);
    std::vector<Triangle> star;
    for (const Index f : sheet.around[v]) star.push_back(sheet.triangles[f]);
    const SheetStar now = work.meter.of(sheet.around[v]);
    for (const double part : {1.0, 0.5}) {
        Vec3 to = sheet.x[v] + part * *way;
        if (free) to = work.rest.nearest(to);
        if (sheet.turns(sheet.around[v], star, kOver, v, to)) continue;
        const SheetStar then = work.meter.with(star, sheet.around[v], v, to);
        if (!is_allowed(now, then, work.limits, kMovedAngle)) continue;
        work.size[v] = work.size_at(to);
        sheet.move(v, to);
        return;
    }
}

// Inner edges whose length, over that wanted, is one to be changed.
template <typename Predicate>
std::vector<std::array<Index, 2>> edges_by_length(const SheetWork& work, const Predicate& is_wanted,
                                                  bool longest_first) {
    const SheetTriangles& sheet = work.sheet;
    const double step = kLengthStep * *std::max_element(work.size.begin(), work.size.end());
    std::vector<std::pair<double, std::array<Index, 2>>> edges;
    for (const Triangle& t : sheet.triangles) {
        for (std::size_t k = 0; k < 3 && t[0] != kNoIndex; ++k) {
            const Index a = t[k], c = t[(k + 1) % 3];
            const double length = work.length(a, c);
            if (a > c || !is_wanted(length / work.wanted(a, c)) || sheet.left_of(c, a) == kNoIndex)
                continue;
            const double steps = std::floor(length / step + 0.5);
            edges.push_back({longest_first ? -steps : steps, {a, c}});
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<Index, 2>> ends;
    for (const auto& edge : edges) ends.push_back(edge.second);
    return ends;
}

Index split_long(SheetWork& work) {
    Index splits = 0;
    const auto too_long = [](double ratio) { return ratio > kTooLong; };
    for (const auto& [a, c] : edges_by_length(work, too_long, true)) {
        splits += split(work, a, c) ? 1 : 0;
    }
    return splits;
}

void collapse_short(SheetWork& work) {
    const auto too_short = [](double ratio) { return ratio < kTooShort; };
    for (const auto& [a, c] : edges_by_length(work, too_short, false)) {
        if (!quad_at(work.sheet, a, c)) continue;
        if (!(work.length(a, c) < kTooShort * work.wanted(a, c))) continue;
        if (!collapse(work, c, a)) collapse(work, a, c);
    }
}

}  // namespace

void remesh(SheetTriangles& sheet, const SheetRest& rest, FlipMemory& memory, const SheetSize& size,
            const SheetLimits& limits, const SheetLimits& flips, const Context& context) {
    SheetWork work{sheet, rest, size, limits, StarMeter(sheet), {}};
    for (const Vec3& x : sheet.x) work.size.push_back(size(x));
    for (int round = 0; round < kRounds; ++round) {
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            const Index splits = split_long(work);
            flip_edges(sheet, memory, flips, context);
            if (splits == 0) break;
        }
        collapse_short(work);
        flip_edges(sheet, memory, flips, context);
        for (Index v = 0; v < sheet.vertex_count(); ++v) relax(work, v);
        flip_edges(sheet, memory, flips, context);
    }
}

}  // namespace lissom
