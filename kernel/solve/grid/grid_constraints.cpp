#include "kernel/solve/grid/grid_constraints.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/error.h"
#include "kernel/solve/grid/constraint_weight.h"

namespace lissom {
namespace {

void require_valid(const GridConstraint& constraint, const GridSize& size) {
    const Elements element{ElementKind::row, 1, {constraint.point}};
    if (constraint.point < 0 || constraint.point >= size.count()) {
        throw Error(ErrorCode::out_of_range,
                    "a constraint lies outside the grid of " + std::to_string(size.count()) +
                        " points; leave it out or make the grid larger",
                    element);
    }
    if (!constraint.value.allFinite() || !std::isfinite(constraint.weight)) {
        throw Error(ErrorCode::not_finite,
                    "the vector or the weight of a constraint is not finite; give numbers",
                    element);
    }
    if (constraint.weight < kMinConstraintWeight || constraint.weight > kMaxConstraintWeight) {
        throw Error(ErrorCode::invalid_argument,
                    "the weight of a constraint must lie between 1e-6 and 1e9", element);
    }
}

// A later constraint at the same point would hide an earlier one.
void require_unique(const std::vector<GridConstraint>& constraints) {
    std::vector<Index> points;
    for (const GridConstraint& constraint : constraints) points.push_back(constraint.point);
    std::sort(points.begin(), points.end());
    Elements repeated;
    repeated.kind = ElementKind::row;
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i] == points[i - 1]) repeated.add(points[i]);
    }
    if (repeated.count > 0) {
        throw Error(ErrorCode::invalid_argument,
                    "an owner constrains a grid point twice; give each point once", repeated);
    }
}

bool same_rows(const std::vector<GridConstraint>& a, const std::vector<GridConstraint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const GridConstraint& one, const GridConstraint& other) {
                          return one.point == other.point && one.weight == other.weight;
                      });
}

struct Entry {
    Index point;
    double weight;
    Vec3 value;
    std::uint64_t stamp;
};

// Entries [begin, end), all of one point. One alone stays as it is, to the bit.
MergedConstraint merge(const Entry* begin, const Entry* end) {
    MergedConstraint merged{begin->point, begin->weight, begin->value, begin->stamp};
    if (end - begin == 1) return merged;
    double square = 0.0;
    Vec3 sum = Vec3::Zero();
    for (const Entry* e = begin; e != end; ++e) {
        square += e->weight * e->weight;
        sum += e->weight * e->weight * e->value;
        merged.weight = std::max(merged.weight, e->weight);
        merged.stamp = std::min(merged.stamp, e->stamp);
    }
    merged.value = sum / square;
    return merged;
}

}  // namespace

void GridConstraints::set(ConstraintOwner owner, std::vector<GridConstraint> constraints) {
    for (const GridConstraint& constraint : constraints) require_valid(constraint, size_);
    require_unique(constraints);
    std::sort(constraints.begin(), constraints.end(),
              [](const GridConstraint& a, const GridConstraint& b) { return a.point < b.point; });
    const auto old = owners_.find(owner);
    if (old == owners_.end() && constraints.empty()) return;
    ++version_;
    if (constraints.empty()) {
        owners_.erase(old);
        ++stamp_;
        return;
    }
    const bool same = old != owners_.end() && same_rows(old->second.constraints, constraints);
    const std::uint64_t stamp = same ? old->second.stamp : ++stamp_;
    owners_[owner] = {std::move(constraints), stamp};
}

void GridConstraints::clear() {
    owners_.clear();
    ++stamp_;
    ++version_;
}

std::span<const GridConstraint> GridConstraints::of(ConstraintOwner owner) const {
    const auto at = owners_.find(owner);
    if (at == owners_.end()) return {};
    return at->second.constraints;
}

std::vector<ConstraintOwner> GridConstraints::owners() const {
    std::vector<ConstraintOwner> result;
    for (const auto& entry : owners_) result.push_back(entry.first);
    return result;
}

std::vector<MergedConstraint> GridConstraints::merged() const {
    std::vector<Entry> entries;
    for (const auto& entry : owners_) {
        for (const GridConstraint& c : entry.second.constraints) {
            entries.push_back({c.point, c.weight, c.value, entry.second.stamp});
        }
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.point < b.point; });
    std::vector<MergedConstraint> result;
    result.reserve(entries.size());
    for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
        while (end < entries.size() && entries[end].point == entries[i].point) ++end;
        result.push_back(merge(entries.data() + i, entries.data() + end));
    }
    return result;
}

}  // namespace lissom
