#include "kernel/hair/field_stage.h"

#include <algorithm>

#include "kernel/hair/curve/constraint_kind.h"
#include "kernel/hair/derived_style.h"

namespace lissom {
namespace {

// Claims that say something, in the order of edits.
std::vector<const CurveClaim*> in_edit_order(const std::vector<CurveClaim>& claims) {
    std::vector<const CurveClaim*> order;
    for (const CurveClaim& claim : claims) {
        if (!claim.constraints.empty()) order.push_back(&claim);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const CurveClaim* a, const CurveClaim* b) { return a->edit < b->edit; });
    return order;
}

// Points that curves style: beyond the end of a stream hair falls on.
std::vector<Index> points_of_curves(const std::vector<CurveClaim>& claims) {
    std::vector<Index> points;
    for (const CurveClaim& claim : claims) {
        if (claim.owner == kScalpOwner) continue;
        for (const GridConstraint& one : claim.constraints) {
            if (one.tag != static_cast<int>(ConstraintKind::stop)) points.push_back(one.point);
        }
    }
    return points;
}

bool has_rows_of(const CurveClaim& a, const CurveClaim& b) {
    return a.owner == b.owner &&
           std::equal(a.constraints.begin(), a.constraints.end(), b.constraints.begin(),
                      b.constraints.end(), [](const GridConstraint& x, const GridConstraint& y) {
                          return x.point == y.point && x.weight == y.weight;
                      });
}

}  // namespace

bool FieldStage::solved(const std::vector<CurveClaim>& claims) const {
    const std::vector<const CurveClaim*> now = in_edit_order(claims);
    return field_.solved() && std::equal(given_.begin(), given_.end(), now.begin(), now.end(),
                                         [](const CurveClaim& a, const CurveClaim* b) {
                                             return a.owner == b->owner &&
                                                    a.constraints == b->constraints;
                                         });
}

// All from the first owner on whose rows differ is given anew.
void FieldStage::give(const std::vector<CurveClaim>& claims) {
    std::vector<CurveClaim> now;
    for (const CurveClaim* claim : in_edit_order(claims)) now.push_back(*claim);
    std::size_t kept = 0;
    const std::size_t most = std::min(given_.size(), now.size());
    while (kept < most && has_rows_of(given_[kept], now[kept])) ++kept;
    for (std::size_t i = kept; i < given_.size(); ++i) field_.set_constraints(given_[i].owner, {});
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (i < kept && given_[i].constraints == now[i].constraints) continue;
        field_.set_constraints(now[i].owner, now[i].constraints);
    }
    given_ = std::move(now);
}

void FieldStage::solve(const std::vector<CurveClaim>& claims, FieldGravity gravity,
                       const Context& context) {
    if (solved(claims)) return;
    gravity.styled = points_of_curves(claims);
    try {
        give(claims);
    } catch (...) {
        field_.clear_constraints();
        given_.clear();
        throw;
    }
    field_.solve(context, gravity);
}

}  // namespace lissom
