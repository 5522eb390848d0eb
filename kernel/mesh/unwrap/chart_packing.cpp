#include "kernel/mesh/unwrap/chart_packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

// Widths of the square that are tried, as parts of the least that could hold all charts.
constexpr double kFirstWidth = 1.05, kLastWidth = 1.7, kWidthStep = 0.05;
// Widths over the height of the highest chart, if that is more.
constexpr double kLeastWidth = 0.6;
constexpr int kGapRounds = 4;
constexpr double kHuge = std::numeric_limits<double>::infinity();

double wedge(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// Convex hull, counter-clockwise (Andrew 1979).
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    std::vector<Vec2> hull;
    const auto add = [&](const Vec2& p, std::size_t base) {
        while (hull.size() >= base + 2 &&
               wedge(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
            hull.pop_back();
        }
        hull.push_back(p);
    };
    for (const Vec2& p : points) add(p, 0);
    const std::size_t base = hull.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) add(points[i], base);
    hull.pop_back();
    return hull;
}

void turn(std::vector<Vec2>& points, const Vec2& axis) {
    for (Vec2& p : points) p = {p.dot(axis), wedge(axis, p)};
}

std::pair<Vec2, Vec2> box_of(const std::vector<Vec2>& points) {
    Vec2 low = Vec2::Constant(kHuge), high = -low;
    for (const Vec2& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return {low, high};
}

// Turns a chart so that the rectangle around it along the axes is the smallest, upright, and begins
// at the origin. One of its sides lies on an edge of the hull.
void set_upright(FlatChart& chart) {
    const std::vector<Vec2> hull = hull_of(chart.uv);
    Vec2 best = Vec2::UnitX();
    double least = kHuge;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        if (edge.norm() == 0.0) continue;
        std::vector<Vec2> turned = hull;
        turn(turned, edge.normalized());
        const auto [low, high] = box_of(turned);
        const double area = (high - low).prod();
        if (area >= least) continue;
        least = area;
        best = edge.normalized();
    }
    turn(chart.uv, best);
    auto [low, high] = box_of(chart.uv);
    if (high.x() - low.x() > high.y() - low.y()) {
        turn(chart.uv, Vec2::UnitY());
        std::tie(low, high) = box_of(chart.uv);
    }
    for (Vec2& p : chart.uv) p -= low;
}

// The outline of a chart from below and above, by columns of a grid.
struct ChartOutline {
    std::vector<double> bottom, top;
    double height = 0.0;
};

// Takes the part of a segment over each column.
void take_segment(const Vec2& a, const Vec2& b, double cell, ChartOutline& outline) {
    const Vec2 &left = a.x() <= b.x() ? a : b, &right = a.x() <= b.x() ? b : a;
    const auto last = static_cast<double>(outline.bottom.size() - 1);
    const auto column = [&](double x) {
        return static_cast<std::size_t>(std::clamp(std::floor(x / cell), 0.0, last));
    };
    const double width = right.x() - left.x();
    const auto height_at = [&](double x) {
        const double t = width > 0.0 ? std::clamp((x - left.x()) / width, 0.0, 1.0) : 0.0;
        return left.y() + t * (right.y() - left.y());
    };
    for (std::size_t c = column(left.x()); c <= column(right.x()); ++c) {
        const double from = std::max(left.x(), static_cast<double>(c) * cell);
        const double to = std::min(right.x(), static_cast<double>(c + 1) * cell);
        for (const double y :
             {height_at(from), height_at(to), c == column(left.x()) ? left.y() : height_at(to),
              c == column(right.x()) ? right.y() : height_at(from)}) {
            outline.bottom[c] = std::min(outline.bottom[c], y);
            outline.top[c] = std::max(outline.top[c], y);
        }
    }
}

// With a column of `cell` on both sides, and as much above.
ChartOutline outline_of(const FlatChart& chart, double cell) {
    const auto [low, high] = box_of(chart.uv);
    const auto columns = static_cast<std::size_t>(std::floor(high.x() / cell)) + 1;
    ChartOutline own;
    own.bottom.assign(columns, kHuge);
    own.top.assign(columns, -kHuge);
    for (const Triangle& t : chart.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            take_segment(chart.uv[at(t[k])], chart.uv[at(t[(k + 1) % 3])], cell, own);
        }
    }
    ChartOutline wide = own;
    wide.bottom.push_back(kHuge);
    wide.top.push_back(-kHuge);
    for (std::size_t c = 0; c < wide.bottom.size(); ++c) {
        if (c > 0) {
            wide.bottom[c] = std::min(wide.bottom[c], own.bottom[c - 1]);
            wide.top[c] = std::max(wide.top[c], own.top[c - 1]);
        }
        wide.top[c] += cell;
        wide.height = std::max(wide.height, wide.top[c]);
    }
    return wide;
}

struct ChartSeat {
    int quarter = 0;
    Vec2 place = Vec2::Zero();
    double height = 0.0;
};

void turn_quarters(FlatChart& chart, int quarters) {
    for (int i = 0; i < quarters; ++i) turn(chart.uv, Vec2::UnitY());
    const Vec2 low = box_of(chart.uv).first;
    for (Vec2& p : chart.uv) p -= low;
}

// Sets charts into a strip of so many columns, one after the other.
class Strip {
  public:
    Strip(std::size_t columns, double cell) : cell_(cell), skyline_(columns, 0.0) {}

    // Returns false if the chart is wider than the strip however it is turned.
    bool seat(const std::array<ChartOutline, 4>& outlines, ChartSeat& seat) {
        double least = kHuge, wasted = kHuge;
        std::size_t best = 0;
        for (int q = 0; q < 4; ++q) {
            const ChartOutline& outline = outlines[static_cast<std::size_t>(q)];
            if (outline.bottom.size() > skyline_.size()) continue;
            for (std::size_t c = 0; c + outline.bottom.size() <= skyline_.size(); ++c) {
                const auto [y, waste] = rest(outline, c);
                const double top = y + outline.height;
                if (top > least || (top == least && waste >= wasted)) continue;
                least = top;
                wasted = waste;
                best = c;
                seat = {q, {static_cast<double>(c) * cell_, y}, top};
            }
        }
        if (least == kHuge) return false;
        const ChartOutline& taken = outlines[static_cast<std::size_t>(seat.quarter)];
        for (std::size_t i = 0; i < taken.top.size(); ++i) {
            skyline_[best + i] = std::max(skyline_[best + i], seat.place.y() + taken.top[i]);
        }
        height_ = std::max(height_, seat.height);
        return true;
    }

    double height() const { return height_; }

  private:
    // How deep an outline sinks at a column, and the area below it that stays free.
    std::pair<double, double> rest(const ChartOutline& outline, std::size_t column) const {
        double y = 0.0, waste = 0.0;
        for (std::size_t i = 0; i < outline.bottom.size(); ++i) {
            y = std::max(y, skyline_[column + i] - outline.bottom[i]);
        }
        for (std::size_t i = 0; i < outline.bottom.size(); ++i) {
            waste += y + outline.bottom[i] - skyline_[column + i];
        }
        return {y, waste};
    }

    double cell_ = 0.0, height_ = 0.0;
    std::vector<double> skyline_;
};

// The seats of all charts in a strip of a width, `cell` apart, and the side of the square around
// them; infinite if one does not fit.
std::pair<double, std::vector<ChartSeat>> seats_in(const std::vector<FlatChart>& charts,
                                                   const std::vector<std::size_t>& order,
                                                   double width, double cell) {
    Strip strip(static_cast<std::size_t>(std::max(1.0, std::floor(width / cell))), cell);
    std::vector<ChartSeat> seats(charts.size());
    for (const std::size_t i : order) {
        std::array<ChartOutline, 4> outlines;
        FlatChart turned = charts[i];
        for (std::size_t q = 0; q < 4; ++q) {
            outlines[q] = outline_of(turned, cell);
            turn_quarters(turned, 1);
        }
        if (!strip.seat(outlines, seats[i])) return {kHuge, {}};
    }
    return {std::max(width, strip.height()), std::move(seats)};
}

}  // namespace

double pack_charts(std::vector<FlatChart>& charts, double gap, const Context& context) {
    double area = 0.0;
    for (FlatChart& chart : charts) {
        set_upright(chart);
        area += chart.area();
    }
    std::vector<std::size_t> order(charts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return box_of(charts[i].uv).second.y() > box_of(charts[j].uv).second.y();
    });
    std::pair<double, std::vector<ChartSeat>> best{kHuge, {}};
    double least = std::max(std::sqrt(area), kLeastWidth * box_of(charts[order[0]].uv).second.y());
    if (least == 0.0) least = 1.0;
    for (double part = kFirstWidth; part < kLastWidth || best.first == kHuge;
         part *= 1.0 + kWidthStep) {
        context.checkpoint();
        // The gap is a part of the side, which may be the height.
        double side = part * least;
        for (int round = 0; round < kGapRounds; ++round) {
            auto made = seats_in(charts, order, part * least, gap * side);
            const bool is_wide = made.first <= 1.001 * side;
            side = made.first;
            if (is_wide && made.first < best.first) best = std::move(made);
            if (is_wide || side == kHuge) break;
        }
    }
    for (std::size_t i = 0; i < charts.size(); ++i) {
        turn_quarters(charts[i], best.second[i].quarter);
        for (Vec2& p : charts[i].uv) p += best.second[i].place;
    }
    return best.first;
}

}  // namespace lissom
