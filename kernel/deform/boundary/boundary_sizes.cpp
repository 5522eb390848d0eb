#include "kernel/deform/boundary/boundary_sizes.h"

#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

// Scales that differ by less are one scale.
constexpr double kSameScale = 1e-12;
// Lower bound of the weights of the harmonic interpolation, so that it never leaves the range of
// the interpolated values.
constexpr double kMinWeight = 1e-3;

// The least and the greatest of the sizes that are given.
struct SizeRange {
    double min = 0.0, max = 0.0;
};

SizeRange given_sizes(const BoundarySystems& from, const std::vector<double>& size) {
    SizeRange range{size[from.held_local.front()], size[from.held_local.front()]};
    for (Index v = 0; v < from.work.patch.surface_count; ++v) {
        const bool is_given = from.known.position[v] && from.common->feature_of(v) == kNoIndex &&
                              from.work.rings.count(v) > 0;
        if (!is_given) continue;
        range.min = std::min(range.min, size[v]);
        range.max = std::max(range.max, size[v]);
    }
    return range;
}

}  // namespace

// Calls use(row, neighbour, weight) for all neighbours of the vertices with a row; neighbours in
// the same row do not count for it.
template <typename Use>
void BoundarySizes::for_each_entry(const BoundarySystems& from, const Use& use) const {
    for (Index v = 0; v < count_of(row_); ++v) {
        const Index row = row_[v];
        if (row == kNoIndex) continue;
        for (Index e = from.work.rings.begin[v]; e < from.work.rings.begin[v + 1]; ++e) {
            const Index u = from.work.rings.neighbor[e];
            if (row_[u] == row) continue;
            use(row, u, std::max(from.work.geometry.cotangent[e], kMinWeight));
        }
    }
}

// One row a free vertex, and one a feature.
void BoundarySizes::factor(const BoundarySystems& from, const Context& context) {
    row_.assign(at(from.work.patch.surface_count), kNoIndex);
    rows_ = from.common->size();
    for (Index v = 0; v < from.work.patch.surface_count; ++v) {
        row_[v] = from.common->feature_of(v);
        if (!from.known.position[v]) row_[v] = rows_++;
    }
    std::vector<Triplet> entries;
    for_each_entry(from, [&](Index row, Index u, double weight) {
        entries.push_back({row, row, weight});
        const Index other = row_[u];
        if (other != kNoIndex && other < row) entries.push_back({row, other, -weight});
    });
    const SymmetricMatrix matrix = symmetric_from_triplets(rows_, entries);
    system_ = std::make_unique<SparseSystem>();
    system_->analyze(matrix, context);
    system_->factor(matrix, context);
}

void BoundarySizes::solve(const BoundarySystems& from, std::vector<double>& size,
                          const Context& context) {
    if (!system_) factor(from, context);
    std::vector<double> b(at(rows_), 0.0);
    for_each_entry(from, [&](Index row, Index u, double weight) {
        if (row_[u] == kNoIndex) b[at(row)] += weight * std::log(size[u]);
    });
    system_->solve(b, b, 1);
    for (std::size_t v = 0; v < row_.size(); ++v) {
        if (row_[v] != kNoIndex) size[v] = std::exp(b[at(row_[v])]);
    }
}

std::vector<double> BoundarySizes::interpolated(const BoundarySystems& from,
                                                std::vector<double> size, const Context& context) {
    const SizeRange given = given_sizes(from, size);
    if (given.max > given.min * (1.0 + kSameScale)) {
        if (from.common->size() > 0 || from.has_free()) solve(from, size, context);
        return size;
    }
    for (Index v = 0; v < from.work.patch.surface_count; ++v) {
        if (!from.known.position[v] || from.common->feature_of(v) != kNoIndex) size[v] = given.min;
    }
    return size;
}

}  // namespace lissom
