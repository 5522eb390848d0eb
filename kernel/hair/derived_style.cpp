#include "kernel/hair/derived_style.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace lissom {
namespace {

// Who yields to whom at a grid point.
constexpr int kScalpRank = -1, kCurveRank = 0, kDividingRank = 1;

std::shared_ptr<const DerivedCurve> derived_before(const DerivedStyle& before,
                                                   const PlacedCurve& wanted) {
    for (std::size_t c = 0; c < before.ids.size(); ++c) {
        const PlacedCurve& one = before.inputs.curves[c];
        if (one.id == wanted.id && one.curve.shape == wanted.curve.shape) return before.curves[c];
    }
    return nullptr;
}

DerivedCurve derive(const StyleCurve& curve, std::size_t place, const StyleGround& ground) {
    try {
        return derive(curve, ground.scalp, ground.distances);
    } catch (const Error& error) {
        if (!ground.names_curves) throw;
        throw Error(error.code(),
                    "curve " + std::to_string(place - ground.known + 1) + ": " + error.what());
    }
}

std::vector<CurveClaim> settled_claims(const DerivedStyle& style) {
    std::vector<CurveClaim> claims = {
        {style.inputs.scalp_step, kScalpRank, kScalpOwner, style.inputs.scalp_edit}};
    for (std::size_t c = 0; c < style.ids.size(); ++c) {
        const PlacedCurve& one = style.inputs.curves[c];
        if (!one.curve.enabled) continue;
        const bool divides = std::holds_alternative<DividingCurve>(one.curve.shape);
        claims.push_back({style.curves[c]->constraints, divides ? kDividingRank : kCurveRank,
                          one.id.value, one.edit});
    }
    settle_conflicts(claims);
    return claims;
}

}  // namespace

const DerivedCurve& DerivedStyle::derived(CurveId id) const {
    return *curves[&placed_curve(inputs, id) - inputs.curves.data()];
}

DerivedStyle derive_style(StyleInputs inputs, const DerivedStyle& before, const StyleGround& ground,
                          const Context& context) {
    DerivedStyle style;
    for (const PlacedCurve& one : inputs.curves) {
        std::shared_ptr<const DerivedCurve> derived = derived_before(before, one);
        if (!derived) {
            context.checkpoint();
            derived = std::make_shared<DerivedCurve>(derive(one.curve, style.ids.size(), ground));
        }
        style.ids.push_back(one.id);
        style.curves.push_back(std::move(derived));
    }
    style.inputs = std::move(inputs);
    style.claims = settled_claims(style);
    return style;
}

std::vector<GridConstraint> decisive_constraints(const DerivedStyle& style,
                                                 std::vector<ConstraintOwner>& owners) {
    struct Decisive {
        const CurveClaim* claim;
        const GridConstraint* constraint;
    };
    std::map<Index, Decisive> decisive;
    for (const CurveClaim& claim : style.claims) {
        for (const GridConstraint& one : claim.constraints) {
            const auto [found, is_new] = decisive.try_emplace(one.point, Decisive{&claim, &one});
            if (is_new || found->second.claim->rank > claim.rank) continue;
            found->second = {&claim, &one};
        }
    }
    std::vector<GridConstraint> result;
    for (const auto& [point, said] : decisive) {
        result.push_back(*said.constraint);
        owners.push_back(said.claim->owner);
    }
    return result;
}

}  // namespace lissom
