// Splits, collapses, flips and moves in a sheet beside a seam.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/sew/seam_sheet.h"

namespace lissom {
namespace {

constexpr int kRounds = 6, kSweeps = 12, kFlipPasses = 10;
// Edges are split above and collapsed below these parts of the length wanted.
constexpr double kTooLong = 4.0 / 3.0, kTooShort = 4.0 / 5.0;
constexpr double kMaxTurn = 45.0 * kPi / 180.0, kOver = 0.5 * kPi;
// Angles of triangles above these may become smaller by collapses, and by moves.
constexpr double kCollapsedAngle = 20.0 * kPi / 180.0, kMovedAngle = 25.0 * kPi / 180.0;
constexpr double kFlipGain = 1e-6;
// Lengths are sorted in steps of this part of a wanted length, so that rounding does not decide.
constexpr double kLengthStep = 1e-6;

}  // namespace

// The triangles on the left and right of an inner edge from a to c, and those after a flip.
bool SeamSheet::find_quad(Index a, Index c, Quad& quad) const {
    quad.left = left_of(a, c);
    quad.right = left_of(c, a);
    if (quad.left == kNoIndex || quad.right == kNoIndex) return false;
    const auto apex = [&](Index f) {
        for (const Index v : triangles_[f]) {
            if (v != a && v != c) return v;
        }
        return kNoIndex;
    };
    quad.d = apex(quad.left);
    quad.b = apex(quad.right);
    quad.before = {{{a, c, quad.d}, {c, a, quad.b}}};
    quad.after = {{{a, quad.b, quad.d}, {quad.b, c, quad.d}}};
    return true;
}

// Whether a flip makes the smallest angle greater.
bool SeamSheet::is_rounder(const Quad& quad) {
    const double least = std::min(min_angle_of(quad.left), min_angle_of(quad.right));
    const double wanted = least * (1.0 + kFlipGain) + kFlipGain;
    return std::all_of(quad.after.begin(), quad.after.end(), [&](const Triangle& t) {
        return min_angle(t, kNoIndex, Vec3::Zero()) > wanted;
    });
}

void SeamSheet::turn_diagonal(const Quad& quad) {
    leave(quad.left);
    leave(quad.right);
    enter(quad.left, quad.after[0]);
    enter(quad.right, quad.after[1]);
}

// Whether a flip keeps to the limits, and turns no triangle over.
bool SeamSheet::may_flip(const Quad& quad, const SheetLimits& limits) {
    if (quad.b == quad.d || is_joined(quad.b, quad.d)) return false;
    const std::array<Index, 2> faces{quad.left, quad.right};
    const Star now = star_of(faces);
    const Star then = star_with(quad.after, faces, kNoIndex, Vec3::Zero());
    if (!is_allowed(now, then, limits, kPi)) return false;
    const Vec3 mean = normal_[quad.left] + normal_[quad.right];
    return std::all_of(quad.after.begin(), quad.after.end(), [&](const Triangle& t) {
        return normal(t, kNoIndex, Vec3::Zero()).dot(mean) > 0.0;
    });
}

// Flips edge `k` of a triangle if that is of use. Most are of none, and are not measured again
// until a triangle at their ends has changed; nor are those that may not be.
bool SeamSheet::flip(Index f, std::size_t k, const SheetLimits& limits) {
    const Index a = triangles_[f][k], c = triangles_[f][(k + 1) % 3];
    const std::uint32_t at_ends = std::max(changed_[a], changed_[c]);
    if (useless_[f][k] >= at_ends) return false;
    Quad quad;
    if (is_feature(a, c) || !find_quad(a, c, quad)) {
        useless_[f][k] = clock_;
        return false;
    }
    if (refused_[f][k] >= std::max({at_ends, changed_[quad.b], changed_[quad.d]})) return false;
    if (!is_rounder(quad)) {
        useless_[f][k] = clock_;
        return false;
    }
    if (!may_flip(quad, limits)) {
        refused_[f][k] = clock_;
        return false;
    }
    turn_diagonal(quad);
    return true;
}

Index SeamSheet::flip_edges(const SheetLimits& limits, const Context& context) {
    // Refusals under other limits do not hold for these.
    if (limits.seam != flip_limits_.seam || limits.other != flip_limits_.other) {
        std::fill(refused_.begin(), refused_.end(), std::array<std::uint32_t, 3>{0, 0, 0});
        flip_limits_ = limits;
    }
    Index flips = 0;
    for (int pass = 0; pass < kFlipPasses; ++pass) {
        context.checkpoint();
        const Index before = flips;
        for (Index f = 0; f < count_of(triangles_); ++f) {
            for (std::size_t k = 0; k < 3 && triangles_[f][0] != kNoIndex; ++k) {
                if (flip(f, k, limits)) ++flips;
            }
        }
        if (flips == before) break;
    }
    return flips;
}

// Splits an edge in its middle: on the edge if it is a feature, else on the surface if that does no
// harm.
bool SeamSheet::split(Index a, Index c, const SheetLimits& limits) {
    const Index left = left_of(a, c), right = left_of(c, a);
    if (left == kNoIndex || right == kNoIndex) return false;
    const auto apex = [&](Index f) {
        for (const Index v : triangles_[f]) {
            if (v != a && v != c) return v;
        }
        return kNoIndex;
    };
    const Index d = apex(left), b = apex(right), m = vertex_count();
    const Vec3 middle = 0.5 * (x_[a] + x_[c]);
    x_.push_back(middle);
    mesh_vertex_.push_back(kNoIndex);
    fixed_.push_back(0);
    add_vertex_lists();
    const std::array<Triangle, 4> after{{{a, m, d}, {m, c, d}, {c, m, b}, {m, a, b}}};
    if (is_feature(a, c)) {
        remove_feature(a, c);
        add_feature(a, m);
        add_feature(m, c);
    } else {
        const std::array<Index, 2> faces{left, right};
        const Vec3 on_surface = nearest_at_first(middle).position;
        double flat = kPi;
        for (const Triangle& t : after) {
            flat = std::min(flat, min_angle(t, kNoIndex, Vec3::Zero()));
        }
        const Star now = star_of(faces), then = star_with(after, faces, m, on_surface);
        const bool holds = then.angle >= 0.5 * flat && is_allowed(now, then, limits, 0.0);
        if (holds) x_[m] = on_surface;
    }
    size_.push_back(size_at_(x_[m]));
    leave(left);
    leave(right);
    add_empty(2);
    const auto next = count_of(triangles_) - 2;
    enter(left, after[0]);
    enter(next, after[1]);
    enter(right, after[2]);
    enter(next + 1, after[3]);
    return true;
}

bool SeamSheet::collapse(Index gone, Index kept, const SheetLimits& limits) {
    if (fixed_[gone] || left_of(gone, kept) == kNoIndex || left_of(kept, gone) == kNoIndex) {
        return false;
    }
    std::array<Index, 2> along{kNoIndex, kNoIndex};
    const bool free = is_free(gone);
    if (!free && !(is_feature(gone, kept) && is_sliding(gone, along))) return false;
    const std::vector<Index> of_gone = ring(gone), of_kept = ring(kept);
    // The link condition (Dey et al. 1999).
    std::vector<Index> common;
    std::set_intersection(of_gone.begin(), of_gone.end(), of_kept.begin(), of_kept.end(),
                          std::back_inserter(common));
    if (common.size() != 2) return false;
    double longest = 0.0;
    for (const Index w : of_gone) longest = std::max(longest, (x_[w] - x_[gone]).norm());
    for (const Index w : of_gone) {
        if (w == kept || w == common[0] || w == common[1]) continue;
        const double length = (x_[w] - x_[kept]).norm();
        if (outer_edges_.contains(key(kept, w))) return false;
        if (length > kTooLong * wanted(kept, w) && length > longest) return false;
    }
    const std::vector<Index> faces = around_[gone];
    std::vector<Triangle> after;
    std::vector<Index> changing;
    for (const Index f : faces) {
        Triangle t = triangles_[f];
        if (std::find(t.begin(), t.end(), kept) != t.end()) continue;
        changing.push_back(f);
        std::replace(t.begin(), t.end(), gone, kept);
        after.push_back(t);
    }
    if (after.empty() || turns(changing, after, kNoIndex, Vec3::Zero(), kMaxTurn)) return false;
    const Star now = star_of(faces), then = star_with(after, faces, kNoIndex, Vec3::Zero());
    if (!is_allowed(now, then, limits, kCollapsedAngle)) return false;
    for (const Index f : faces) leave(f);
    for (std::size_t i = 0; i < after.size(); ++i) enter(changing[i], after[i]);
    if (!free) {
        remove_feature(gone, along[0]);
        remove_feature(gone, along[1]);
        add_feature(along[0], along[1]);
    }
    return true;
}

// Towards the mean of the triangles around it, dense ones counting more.
void SeamSheet::relax(Index v, const SheetLimits& limits) {
    if (fixed_[v] || around_[v].empty()) return;
    std::array<Index, 2> along{kNoIndex, kNoIndex};
    const bool free = is_free(v);
    if (!free && !is_sliding(v, along)) return;
    Vec3 mean = Vec3::Zero();
    double sum = 0.0;
    std::vector<Triangle> star;
    for (const Index f : around_[v]) {
        const Triangle& t = triangles_[f];
        star.push_back(t);
        const double size = (size_[t[0]] + size_[t[1]] + size_[t[2]]) / 3.0;
        const double weight = normal_[f].norm() / (size * size * size * size);
        mean += weight * (x_[t[0]] + x_[t[1]] + x_[t[2]]) / 3.0;
        sum += weight;
    }
    if (!(sum > 0.0) || !std::isfinite(sum)) return;
    Vec3 way = mean / sum - x_[v];
    if (!free) {
        const Vec3 next = x_[along[0]] - x_[v], last = x_[along[1]] - x_[v];
        const double on = way.dot(next) / next.squaredNorm(),
                     back = way.dot(last) / last.squaredNorm();
        way = on > back ? Vec3(std::clamp(on, 0.0, 0.5) * next)
                        : Vec3(std::clamp(back, 0.0, 0.5) * last);
    }
    const Star now = star_of(around_[v]);
    for (const double part : {1.0, 0.5}) {
        Vec3 to = x_[v] + part * way;
        if (free) to = nearest_at_first(to).position;
        if (turns(around_[v], star, v, to, kOver)) continue;
        if (!is_allowed(now, star_with(star, around_[v], v, to), limits, kMovedAngle)) continue;
        x_[v] = to;
        size_[v] = size_at_(to);
        ++clock_;
        for (const Index f : around_[v]) note_change(f);
        return;
    }
}

std::vector<std::array<Index, 2>> SeamSheet::edges_by_length(
    const std::function<bool(double)>& is_wanted, bool longest_first) const {
    const double step = kLengthStep * *std::max_element(size_.begin(), size_.end());
    std::vector<std::pair<double, std::array<Index, 2>>> edges;
    for (const Triangle& t : triangles_) {
        for (std::size_t k = 0; k < 3 && t[0] != kNoIndex; ++k) {
            const Index a = t[k], c = t[(k + 1) % 3];
            const double length = (x_[c] - x_[a]).norm();
            if (a > c || !is_wanted(length / wanted(a, c)) || left_of(c, a) == kNoIndex) continue;
            const double steps = std::floor(length / step + 0.5);
            edges.push_back({longest_first ? -steps : steps, {a, c}});
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<Index, 2>> ends;
    for (const auto& edge : edges) ends.push_back(edge.second);
    return ends;
}

Index SeamSheet::split_long(const SheetLimits& limits) {
    Index splits = 0;
    const auto too_long = [](double ratio) { return ratio > kTooLong; };
    for (const auto& [a, c] : edges_by_length(too_long, true))
        splits += split(a, c, limits) ? 1 : 0;
    return splits;
}

void SeamSheet::collapse_short(const SheetLimits& limits) {
    const auto too_short = [](double ratio) { return ratio < kTooShort; };
    for (const auto& [a, c] : edges_by_length(too_short, false)) {
        if (left_of(a, c) == kNoIndex || left_of(c, a) == kNoIndex) continue;
        if (!((x_[c] - x_[a]).norm() < kTooShort * wanted(a, c))) continue;
        if (!collapse(c, a, limits)) collapse(a, c, limits);
    }
}

void SeamSheet::remesh(const Size& size, const SheetLimits& limits, const SheetLimits& flips,
                       const Context& context) {
    size_at_ = size;
    size_.clear();
    for (const Vec3& x : x_) size_.push_back(size(x));
    for (int round = 0; round < kRounds; ++round) {
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            const Index splits = split_long(limits);
            flip_edges(flips, context);
            if (splits == 0) break;
        }
        collapse_short(limits);
        flip_edges(flips, context);
        for (Index v = 0; v < vertex_count(); ++v) relax(v, limits);
        flip_edges(flips, context);
    }
}

}  // namespace lissom
