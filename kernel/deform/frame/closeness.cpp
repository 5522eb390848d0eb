#include "kernel/deform/frame/closeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

// In half the diagonal of the box around the surface: the reach, and the first spacing of samples.
constexpr double kReach = 0.15;
constexpr double kSpacing = 0.02;

// Samples at most; the spacing grows by this factor until they are fewer, and the reach with it.
constexpr std::size_t kSamples = 6000;
constexpr double kCoarser = 1.25;
constexpr double kReachSpacings = 2.0;

// Pairs that lie this many reaches apart at rest count fully, from one on more and more.
constexpr double kFullyApart = 1.5;

using GridCell = std::array<std::int64_t, 3>;

Box box_around(std::span<const Vec3> shape, std::span<const Index> vertices) {
    Box box;
    for (const Index v : vertices) box.extend(shape[at(v)]);
    return box;
}

// The vertex nearest to the centre of each cell.
std::vector<Index> samples_of(const Mesh& mesh, double spacing) {
    std::map<GridCell, std::pair<double, Index>> nearest;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.position(v) / spacing;
        const Vec3 center = p.array().round();
        const GridCell cell{std::llround(p.x()), std::llround(p.y()), std::llround(p.z())};
        const double off = (p - center).squaredNorm();
        const auto [place, fresh] = nearest.try_emplace(cell, off, v);
        if (!fresh && off < place->second.first) place->second = {off, v};
    }
    std::vector<Index> samples;
    for (const auto& [cell, sample] : nearest) samples.push_back(sample.second);
    std::sort(samples.begin(), samples.end());
    return samples;
}

}  // namespace

Closeness::Closeness(const Mesh& rest, std::span<const Index> moving) : rest_(rest) {
    const double size = 0.5 * box_around(rest.positions(), moving).diagonal();
    if (!(size > 0.0)) return;
    double spacing = kSpacing * size;
    for (samples_ = samples_of(rest, spacing); samples_.size() > kSamples;) {
        spacing *= kCoarser;
        samples_ = samples_of(rest, spacing);
    }
    reach_ = std::max(kReach * size, kReachSpacings * spacing);
    for (const Index v : samples_) {
        moves_.push_back(std::binary_search(moving.begin(), moving.end(), v) ? 1 : 0);
    }
}

double Closeness::operator()(std::span<const Vec3> shape) {
    int axis = 0;
    const Box box = box_around(shape, samples_);
    if (!samples_.empty()) (box.max - box.min).maxCoeff(&axis);
    sort_along(shape, axis);
    const auto place = [&](std::size_t n) { return shape[at(samples_[order_[n]])][axis]; };
    double nearest = 1.0;
    for (std::size_t m = 0; m < order_.size(); ++m) {
        for (std::size_t n = m + 1; n < order_.size(); ++n) {
            if (!(place(n) - place(m) < nearest * reach_)) break;
            nearest = std::min(nearest, of_pair(order_[m], order_[n], shape));
        }
    }
    return nearest;
}

double Closeness::of_pair(std::size_t i, std::size_t j, std::span<const Vec3> shape) const {
    const Vec3 now = shape[at(samples_[i])] - shape[at(samples_[j])];
    if (!(now.squaredNorm() < reach_ * reach_) || !(moves_[i] || moves_[j])) return 1.0;
    const double before = (rest_.position(samples_[i]) - rest_.position(samples_[j])).norm();
    const double apart = (before / reach_ - 1.0) / (kFullyApart - 1.0);
    return std::max(now.norm() / std::min(0.5 * before, reach_), 1.0 - apart);
}

void Closeness::sort_along(std::span<const Vec3> shape, int axis) {
    order_.resize(samples_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) {
        const double x = shape[at(samples_[i])][axis], y = shape[at(samples_[j])][axis];
        return x != y ? x < y : i < j;
    });
}

}  // namespace lissom
