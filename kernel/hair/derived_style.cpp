#include "kernel/hair/derived_style.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace lissom {
namespace {

// Who yields to whom at a grid point.
constexpr int kScalpRank = -1, kCurveRank = 0, kDividingRank = 1;

// A stream that ends nearer to a tie than this, and points to it, leads into it.
constexpr double kGatherReach = 0.09;

std::shared_ptr<const DerivedCurve> derived_before(const DerivedStyle& before,
                                                   const PlacedCurve& wanted, bool gathered) {
    for (std::size_t c = 0; c < before.ids.size(); ++c) {
        const PlacedCurve& one = before.inputs.curves[c];
        if (one.id == wanted.id && one.curve.shape == wanted.curve.shape &&
            before.curves[c]->gathered == gathered) {
            return before.curves[c];
        }
    }
    return nullptr;
}

DerivedCurve derive_gathered(const StyleCurve& curve, const StyleGround& ground) {
    StyleCurve leading = curve;
    std::get<StreamCurve>(leading.shape).options.stop_length = 0.0;
    DerivedCurve result = derive(leading, ground.scalp, ground.distances);
    result.gathered = true;
    return result;
}

DerivedCurve derive(const StyleCurve& curve, bool gathered, std::size_t place,
                    const StyleGround& ground) {
    try {
        if (gathered) return derive_gathered(curve, ground);
        return derive(curve, ground.scalp, ground.distances);
    } catch (const Error& error) {
        if (!ground.names_curves) throw;
        throw Error(error.code(),
                    "curve " + std::to_string(place - ground.known + 1) + ": " + error.what());
    }
}

bool leads_to(const StreamCurve& stream, const HairTie& tie) {
    const std::vector<Vec3>& points = stream.points;
    if (points.size() < 2 || stream.options.stop_length == 0.0) return false;
    const Vec3 to_tie = tie.center - points.back();
    return to_tie.norm() < kGatherReach &&
           to_tie.dot(points.back() - points[points.size() - 2]) > 0;
}

// The curves of a style one after the other, each with its result of before if that stands.
class StyleDerivation {
  public:
    StyleDerivation(const StyleInputs& inputs, const DerivedStyle& before,
                    const StyleGround& ground, const Context& context)
        : inputs_(inputs), before_(before), ground_(ground), context_(context) {}

    std::vector<std::shared_ptr<const DerivedCurve>> curves() const {
        std::vector<std::shared_ptr<const DerivedCurve>> result(inputs_.curves.size());
        for (std::size_t c = 0; c < result.size(); ++c) result[c] = curve(c, false);
        if (!ground_.gathers) return result;
        for (std::size_t c = 0; c < result.size(); ++c) {
            if (leads_to_a_tie(inputs_.curves[c].curve, result)) result[c] = curve(c, true);
        }
        return result;
    }

  private:
    std::shared_ptr<const DerivedCurve> curve(std::size_t c, bool gathered) const {
        const PlacedCurve& one = inputs_.curves[c];
        if (auto derived = derived_before(before_, one, gathered)) return derived;
        context_.checkpoint();
        return std::make_shared<DerivedCurve>(derive(one.curve, gathered, c, ground_));
    }

    bool leads_to_a_tie(const StyleCurve& curve,
                        const std::vector<std::shared_ptr<const DerivedCurve>>& derived) const {
        const StreamCurve* stream = std::get_if<StreamCurve>(&curve.shape);
        if (stream == nullptr) return false;
        for (std::size_t c = 0; c < derived.size(); ++c) {
            if (!inputs_.curves[c].curve.enabled || !derived[c]->tie) continue;
            if (leads_to(*stream, *derived[c]->tie)) return true;
        }
        return false;
    }

    const StyleInputs& inputs_;
    const DerivedStyle& before_;
    const StyleGround& ground_;
    const Context& context_;
};

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
    style.curves = StyleDerivation(inputs, before, ground, context).curves();
    for (const PlacedCurve& one : inputs.curves) style.ids.push_back(one.id);
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
