#include "kernel/merge/paste/placement/plane_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

// Value of a vertex that changes its sign, over the mean side of the line.
constexpr double kSpeckValue = 1e-3;

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// Sides of a closed line by the rows of the plane that they pass through.
class LineRows {
  public:
    explicit LineRows(std::span<const Vec2> line) : line_(line), rows_(line.size()) {
        low_ = high_ = line.front().y();
        for (const Vec2& p : line) {
            low_ = std::min(low_, p.y());
            high_ = std::max(high_, p.y());
        }
        for (std::size_t k = 0; k < line.size(); ++k) {
            const double a = line[k].y(), b = line[(k + 1) % line.size()].y();
            for (std::size_t r = row(std::min(a, b)); r <= row(std::max(a, b)); ++r) {
                rows_[r].push_back(k);
            }
        }
    }

    bool contains(const Vec2& p) const {
        bool inside = false;
        if (!(p.y() >= low_ && p.y() <= high_)) return false;
        for (const std::size_t k : rows_[row(p.y())]) {
            const Vec2 &a = line_[k], &b = line_[(k + 1) % line_.size()];
            if ((a.y() > p.y()) == (b.y() > p.y())) continue;
            const double t = (p.y() - a.y()) / (b.y() - a.y());
            if (p.x() < a.x() + t * (b.x() - a.x())) inside = !inside;
        }
        return inside;
    }

  private:
    std::size_t row(double y) const {
        const double height = high_ - low_;
        const double part = height > 0.0 ? (y - low_) / height : 0.0;
        const auto count = static_cast<double>(rows_.size());
        return static_cast<std::size_t>(std::clamp(part * count, 0.0, count - 1.0));
    }

    std::span<const Vec2> line_;
    std::vector<std::vector<std::size_t>> rows_;
    double low_ = 0.0, high_ = 0.0;
};

double distance_to(std::span<const Vec2> line, const Vec2& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < line.size(); ++k) {
        const Vec2 &a = line[k], &b = line[(k + 1) % line.size()];
        const Vec2 along = b - a;
        const double square = along.squaredNorm();
        const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, (p - a - t * along).squaredNorm());
    }
    return std::sqrt(least);
}

double mean_side(std::span<const Vec2> line) {
    double sum = 0.0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        sum += (line[(k + 1) % line.size()] - line[k]).norm();
    }
    return sum / static_cast<double>(line.size());
}

// Those of `vertices` with one sign in connected sets, the largest first.
std::vector<std::vector<Index>> sets_of_sign(const Topology& topology,
                                             std::span<const Index> vertices,
                                             const std::vector<double>& value, bool positive) {
    std::vector<std::vector<Index>> sets;
    std::vector<char> open(value.size(), 0);
    for (const Index v : vertices) open[at(v)] = (value[at(v)] > 0.0) == positive ? 1 : 0;
    for (const Index start : vertices) {
        std::vector<Index> set;
        const auto reach = [&](Index v) {
            if (!open[at(v)]) return;
            open[at(v)] = 0;
            set.push_back(v);
        };
        reach(start);
        for (std::size_t i = 0; i < set.size(); ++i) {
            for (const Index n : topology.neighbors(set[i])) reach(n);
        }
        if (!set.empty()) sets.push_back(std::move(set));
    }
    std::stable_sort(sets.begin(), sets.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return sets;
}

// Whether a set has a neighbour of its sign that is none of the vertices with a place in the plane.
bool goes_on(const Topology& topology, const std::vector<Index>& set,
             const std::vector<char>& known, const std::vector<double>& value) {
    return std::any_of(set.begin(), set.end(), [&](Index v) {
        const auto around = topology.neighbors(v);
        return std::any_of(around.begin(), around.end(), [&](Index n) {
            return !known[at(n)] && (value[at(n)] > 0.0) == (value[at(v)] > 0.0);
        });
    });
}

void leave_one_hole(const Topology& topology, std::span<const Index> vertices, double speck,
                    std::vector<double>& value) {
    std::vector<char> known(value.size(), 0);
    for (const Index v : vertices) known[at(v)] = 1;
    auto inside = sets_of_sign(topology, vertices, value, true);
    const auto part = std::stable_partition(inside.begin(), inside.end(), [&](const auto& set) {
        return goes_on(topology, set, known, value);
    });
    // Without a set that goes on beyond the plane the largest stays.
    const auto first_speck = part == inside.begin() && !inside.empty() ? part + 1 : part;
    std::vector<std::vector<Index>> specks(first_speck, inside.end());
    for (const std::vector<Index>& set : sets_of_sign(topology, vertices, value, false)) {
        const bool open =
            std::any_of(set.begin(), set.end(), [&](Index v) { return topology.is_boundary(v); });
        if (!open && !goes_on(topology, set, known, value)) specks.push_back(set);
    }
    for (const std::vector<Index>& set : specks) {
        for (const Index v : set) value[at(v)] = value[at(v)] > 0.0 ? -speck : speck;
    }
}

}  // namespace

bool crosses_itself(std::span<const Vec2> line) {
    const std::size_t n = line.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = line[i], &b = line[(i + 1) % n];
        const double left = std::min(a.x(), b.x()), right = std::max(a.x(), b.x());
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j + 1 == n) continue;
            const Vec2 &c = line[j], &d = line[(j + 1) % n];
            if (std::max(c.x(), d.x()) < left || std::min(c.x(), d.x()) > right) continue;
            const double at_c = cross(b - a, c - a), at_d = cross(b - a, d - a);
            const double at_a = cross(d - c, a - c), at_b = cross(d - c, b - c);
            if (at_c * at_d < 0.0 && at_a * at_b < 0.0) return true;
        }
    }
    return false;
}

std::vector<char> lie_inside(std::span<const Vec2> points, std::span<const Vec2> line) {
    const LineRows rows(line);
    std::vector<char> inside;
    for (const Vec2& point : points) inside.push_back(rows.contains(point) ? 1 : 0);
    return inside;
}

bool set_line_values(const Topology& topology, std::span<const Index> vertices,
                     std::span<const Vec2> uv, std::span<const Vec2> line,
                     std::vector<double>& value) {
    const LineRows rows(line);
    const double far = mean_side(line);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        value[at(vertices[k])] = rows.contains(uv[k]) ? far : -far;
    }
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const bool inside = value[at(vertices[k])] > 0.0;
        const auto around = topology.neighbors(vertices[k]);
        if (std::any_of(around.begin(), around.end(),
                        [&](Index n) { return (value[at(n)] > 0.0) != inside; })) {
            near.push_back(k);
        }
    }
    for (const std::size_t k : near) {
        double& v = value[at(vertices[k])];
        v = std::copysign(distance_to(line, uv[k]), v);
    }
    leave_one_hole(topology, vertices, kSpeckValue * far, value);
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](Index v) { return value[at(v)] > 0.0; });
}

}  // namespace lissom
