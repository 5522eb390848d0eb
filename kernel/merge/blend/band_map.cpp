#include "kernel/merge/blend/band_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

// Weights down to this count as inside, so that points on edges are found.
constexpr double kEdgeTolerance = 1e-9;

// The turn that differs from `angle` by a whole number and is nearest to `reference`.
double unwrapped(double angle, double reference) {
    return angle - std::round(angle - reference);
}

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

BandMap::BandMap(const BandChart& chart, double width) {
    for (const Triangle& t : chart.triangles) add_cell(chart, t, width);
    build_bins();
}

// Triangles on the target's side have their angle grow to the right of the way out, those on the
// source's to the left.
void BandMap::add_cell(const BandChart& chart, const Triangle& t, double width) {
    Cell cell;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        cell.vertices[k] = chart.vertex[t[k]];
        const double angle =
            k == 0 ? chart.angle[t[0]] : unwrapped(chart.angle[t[k]], cell.at[0].x());
        cell.at[k] = {angle, chart.distance[t[k]] / width};
        nearest = std::min(nearest, cell.at[k].y());
    }
    if (nearest > 1.0) return;
    const double turn = chart.side == SeamSide::target ? 1.0 : -1.0;
    if (!(turn * twice_area(cell.at[0], cell.at[1], cell.at[2]) > 0.0)) {
        ++flipped_;
        return;
    }
    for (const Vec2& p : cell.at) farthest_ = std::max(farthest_, p.y());
    cells_.push_back(cell);
}

void BandMap::build_bins() {
    // About one cell a bin; bands are longer around than away.
    const auto side = std::sqrt(cells_.size());
    around_ = std::max(1, index_of(std::lround(2.0 * side)));
    away_ = std::max(1, index_of(std::lround(0.5 * side)));
    const auto visit = [&](const auto& use) {
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            const auto& [a, b, d] = cells_[c].at;
            const Vec2 low = a.cwiseMin(b).cwiseMin(d), high = a.cwiseMax(b).cwiseMax(d);
            const auto first = static_cast<Index>(std::floor(low.x() * around_));
            const auto last = static_cast<Index>(std::floor(high.x() * around_));
            for (Index column = first; column <= std::min(last, first + around_ - 1); ++column) {
                for (Index row = row_of(low.y()); row <= row_of(high.y()); ++row) {
                    use(((column % around_ + around_) % around_) * away_ + row, index_of(c));
                }
            }
        }
    };
    bin_begin_.assign(at(around_) * away_ + 1, 0);
    visit([&](Index bin, Index) { ++bin_begin_[bin + 1]; });
    for (std::size_t i = 1; i < bin_begin_.size(); ++i) bin_begin_[i] += bin_begin_[i - 1];
    bin_.resize(bin_begin_.back());
    std::vector<Index> fill(bin_begin_.begin(), bin_begin_.end() - 1);
    visit([&](Index bin, Index cell) { bin_[fill[bin]++] = cell; });
}

Index BandMap::row_of(double distance) const {
    const double row = farthest_ > 0.0 ? std::floor(distance / farthest_ * away_) : 0.0;
    return static_cast<Index>(std::clamp(row, 0.0, away_ - 1.0));
}

bool BandMap::place_in(const Cell& cell, const Vec2& at, BandPlace& place) const {
    const auto& [a, b, c] = cell.at;
    const Vec2 p(unwrapped(at.x(), (a.x() + b.x() + c.x()) / 3.0), at.y());
    const double whole = twice_area(a, b, c);
    const double u = twice_area(p, b, c) / whole, v = twice_area(a, p, c) / whole;
    if (std::min({u, v, 1.0 - u - v}) < -kEdgeTolerance) return false;
    place = {cell.vertices, {u, v, 1.0 - u - v}};
    return true;
}

std::optional<BandPlace> BandMap::locate(double angle, double distance) const {
    if (cells_.empty() || distance > farthest_) return std::nullopt;
    const auto column = static_cast<Index>(std::floor(angle * around_)) % around_;
    const Index bin = column * away_ + row_of(distance);
    BandPlace place;
    for (Index e = bin_begin_[bin]; e < bin_begin_[bin + 1]; ++e) {
        if (place_in(cells_[bin_[e]], {angle, distance}, place)) return place;
    }
    return std::nullopt;
}

std::optional<BandPlace> BandMap::nearest(double angle, double distance) const {
    std::optional<BandPlace> place;
    double least = std::numeric_limits<double>::infinity();
    for (const Cell& cell : cells_) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 p(unwrapped(angle, cell.at[k].x()), distance);
            const double d = (p - cell.at[k]).squaredNorm();
            if (d >= least) continue;
            least = d;
            place = BandPlace{cell.vertices, {0.0, 0.0, 0.0}};
            place->weights[k] = 1.0;
        }
    }
    return place;
}

}  // namespace lissom
