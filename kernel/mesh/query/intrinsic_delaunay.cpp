#include "kernel/mesh/query/intrinsic_delaunay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/roots.h"

namespace lissom {
namespace {

constexpr double kMollification = 1e-5;
// Sums of cotangents above this count as Delaunay, so that rounding cannot flip back and forth.
constexpr double kTolerance = 1e-9;
constexpr std::size_t kMaximumFlipsPerEdge = 100;

Index next_side(Index side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}
Index previous_side(Index side) {
    return side % 3 == 0 ? side + 2 : side - 1;
}

// Apex of a triangle whose base runs from the origin to (base, 0), above the base.
Vec2 apex(double base, double right, double left) {
    const double x = (base * base + left * left - right * right) / (2.0 * base);
    return {x, std::sqrt(std::max(0.0, left * left - x * x))};
}

}  // namespace

IntrinsicDelaunay::IntrinsicDelaunay(std::span<const Triangle> triangles,
                                     std::span<const Vec3> positions, const Context& context)
    : triangles_(triangles.begin(), triangles.end()) {
    lengths_.reserve(triangles_.size());
    for (const Triangle& t : triangles_) {
        lengths_.push_back({(positions[t[1]] - positions[t[0]]).norm(),
                            (positions[t[2]] - positions[t[1]]).norm(),
                            (positions[t[0]] - positions[t[2]]).norm()});
    }
    glue();
    mollify();
    flip_to_delaunay(context);
}

void IntrinsicDelaunay::glue() {
    struct Side {
        Index low, high, side;
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (int s = 0; s < 3; ++s) {
            const Index a = triangles_[t][s], b = triangles_[t][(s + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), index_of(3 * t) + s});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.side < b.side;
    });
    twin_.assign(sides.size(), kNoIndex);
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const Side &a = sides[i - 1], &b = sides[i];
        if (a.low != b.low || a.high != b.high || twin_[a.side] != kNoIndex) continue;
        twin_[a.side] = b.side;
        twin_[b.side] = a.side;
    }
}

void IntrinsicDelaunay::mollify() {
    const double slack = kMollification * mean_length();
    double growth = 0.0;
    for (const std::array<double, 3>& l : lengths_) {
        for (int s = 0; s < 3; ++s) {
            growth = std::max(growth, slack + l[s] - l[(s + 1) % 3] - l[(s + 2) % 3]);
        }
    }
    for (std::array<double, 3>& l : lengths_) {
        for (double& length : l) length += growth;
    }
}

double IntrinsicDelaunay::mean_length() const {
    double sum = 0.0;
    for (const std::array<double, 3>& l : lengths_) sum += l[0] + l[1] + l[2];
    return lengths_.empty() ? 0.0 : sum / (3.0 * lengths_.size());
}

std::array<Vec2, 3> IntrinsicDelaunay::layout(std::size_t triangle) const {
    const auto& [base, right, left] = lengths_[triangle];
    return {Vec2(0.0, 0.0), Vec2(base, 0.0), apex(base, right, left)};
}

// Heron's formula in Kahan's order, which keeps its digits for needles.
double IntrinsicDelaunay::area(std::size_t triangle) const {
    std::array<double, 3> l = lengths_[triangle];
    std::sort(l.begin(), l.end(), std::greater<>());
    const auto [a, b, c] = l;
    const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    return 0.25 * std::sqrt(std::max(0.0, product));
}

std::array<double, 3> IntrinsicDelaunay::cotangents(std::size_t triangle) const {
    const std::array<double, 3>& l = lengths_[triangle];
    const double four_areas = 4.0 * area(triangle);
    std::array<double, 3> result{};
    if (!(four_areas > 0.0)) return result;
    for (int corner = 0; corner < 3; ++corner) {
        const double next = l[corner], opposite = l[(corner + 1) % 3], before = l[(corner + 2) % 3];
        result[corner] = (next * next + before * before - opposite * opposite) / four_areas;
    }
    return result;
}

bool IntrinsicDelaunay::is_delaunay(Index side) const {
    const Index twin = twin_[side];
    if (twin == kNoIndex || twin / 3 == side / 3) return true;
    const double here = cotangents(side / 3)[(side + 2) % 3];
    // The corner opposite to side s is corner s + 2 of the triangle.
    const double there = cotangents(twin / 3)[(twin % 3 + 2) % 3];
    return here + there >= -kTolerance;
}

void IntrinsicDelaunay::flip_to_delaunay(const Context& context) {
    std::vector<Index> queue;
    for (Index side = 0; side < count_of(twin_); ++side) {
        if (twin_[side] > side) queue.push_back(side);
    }
    std::size_t flips_left = kMaximumFlipsPerEdge * queue.size();
    for (std::size_t steps = 1; !queue.empty() && flips_left > 0; ++steps) {
        if (steps % 4096 == 0) context.checkpoint();
        const Index side = queue.back();
        queue.pop_back();
        if (is_delaunay(side)) continue;
        flip(side);
        --flips_left;
        // After the flip the four outer sides are those beside sides 1 of both triangles.
        for (const Index triangle : {side / 3, twin_[side] / 3}) {
            for (int s = 0; s < 3; ++s) queue.push_back(3 * triangle + s);
        }
    }
}

void IntrinsicDelaunay::set_triangle(Index triangle, const Triangle& vertices,
                                     const std::array<double, 3>& lengths,
                                     const std::array<Index, 3>& twins) {
    triangles_[triangle] = vertices;
    lengths_[triangle] = lengths;
    for (int s = 0; s < 3; ++s) {
        twin_[3 * triangle + s] = twins[s];
        if (twins[s] != kNoIndex) twin_[twins[s]] = 3 * triangle + s;
    }
}

void IntrinsicDelaunay::flip(Index side) {
    const Index other = twin_[side];
    const Index f = side / 3, g = other / 3;
    // The diamond: triangle f = (a, b, c) above the edge from a to b, g = (b, a, d) below it.
    const Index f1 = next_side(side), f2 = previous_side(side);
    const Index g1 = next_side(other), g2 = previous_side(other);
    const Index a = triangles_[f][side % 3], b = triangles_[f][f1 % 3], c = triangles_[f][f2 % 3];
    const Index d = triangles_[g][g2 % 3];
    const double ab = lengths_[f][side % 3], bc = lengths_[f][f1 % 3], ca = lengths_[f][f2 % 3];
    const double ad = lengths_[g][g1 % 3], db = lengths_[g][g2 % 3];
    const Vec2 above = apex(ab, bc, ca), below = apex(ab, db, ad);
    const double cd = hypotenuse(above.x() - below.x(), above.y() + below.y());

    // The new triangles are f = (a, d, c) and g = (d, b, c), with the new edge as sides 1 and 2. A
    // side that was glued to one of the diamond's own has moved with it.
    const std::array<Index, 4> old{g1, f2, g2, f1};
    const std::array<Index, 4> moved{3 * f, 3 * f + 2, 3 * g, 3 * g + 1};
    std::array<Index, 4> outer{};
    for (int i = 0; i < 4; ++i) {
        outer[i] = twin_[old[i]];
        const auto own = std::find(old.begin(), old.end(), outer[i]);
        if (own != old.end()) outer[i] = moved[own - old.begin()];
    }
    set_triangle(f, {a, d, c}, {ad, cd, ca}, {outer[0], 3 * g + 2, outer[1]});
    set_triangle(g, {d, b, c}, {db, bc, cd}, {outer[2], outer[3], 3 * f + 1});
}

}  // namespace lissom
