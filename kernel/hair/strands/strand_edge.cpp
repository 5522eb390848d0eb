#include "kernel/hair/strands/strand_edge.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strand_random.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr std::uint64_t kBabyStream = 51, kBabyLengthStream = 52, kStrayStream = 53;
// Baby hair is so much finer than the strands around it.
constexpr float kBabyWidth = 0.7f;

bool is_edge_factor(double x) {
    return x > 0.0 && x <= 1.0;
}

void require_edge(const Strands& strands, const std::vector<float>& inside,
                  const StrandEdgeOptions& options) {
    require(is_edge_factor(options.width) && is_edge_factor(options.length),
            "the width and the length at the edge must be above 0, and at most 1");
    require(options.baby >= 0.0 && options.baby <= 1.0,
            "the share of baby hair must be from 0 to 1");
    require(options.baby_length > 0.0 && std::isfinite(options.baby_length),
            "the length of baby hair must be positive and finite");
    require(options.stray >= 0.0 && std::isfinite(options.stray),
            "stray must be finite and not negative");
    require(inside.size() == at(strands.size()),
            "places at the edge must be as many as the strands");
}

double random_part(std::uint64_t bits) {
    return 0.5 + 0.5 * signed_random(bits);
}

// Whether each strand is baby hair.
std::vector<char> baby_hair(const Strands& strands, const std::vector<float>& inside,
                            const StrandEdgeOptions& options) {
    std::vector<char> baby(inside.size());
    for (Index s = 0; s < strands.size(); ++s) {
        const double chance = options.baby * (1.0 - inside[at(s)]);
        baby[at(s)] = random_part(mixed(options.seed, strands.id(s), kBabyStream)) < chance;
    }
    return baby;
}

// Widths of points or of strands times a factor of each strand.
StrandWidths finer(const Strands& strands, const std::vector<float>& factors) {
    StrandWidths widths = strands.widths();
    if (widths.domain == StrandDomain::point) {
        for (Index s = 0; s < strands.size(); ++s) {
            for (Index p = strands.first_point(s); p < strands.offsets()[at(s) + 1]; ++p) {
                widths.values[at(p)] *= factors[at(s)];
            }
        }
        return widths;
    }
    if (widths.domain == StrandDomain::all) widths.values.assign(factors.size(), widths.common);
    widths.domain = StrandDomain::strand;
    for (std::size_t s = 0; s < factors.size(); ++s) widths.values[s] *= factors[s];
    return widths;
}

double left_length(std::uint32_t id, double whole, double inside, bool baby,
                   const StrandEdgeOptions& options) {
    if (!baby) return options.length + (1.0 - options.length) * inside;
    const double part = random_part(mixed(options.seed, id, kBabyLengthStream));
    return std::min(1.0, options.baby_length * (0.4 + 0.6 * part) / whole);
}

// Baby hair leaves its way in a direction of its own.
void lead_astray(Strands& strands, const std::vector<char>& baby, const StrandEdgeOptions& options,
                 const Context& context) {
    StrandOperatorOptions effect;
    effect.mask.assign(baby.begin(), baby.end());
    Vec3 middle = Vec3::Zero();
    for (Index s = 0; s < strands.size(); ++s) {
        middle += strands.root(s).cast<double>() / strands.size();
    }
    const auto change = [&](StrandWork& work) {
        // Off the head, not into it.
        Vec3 away = options.stray * random_vector(options.seed, work.id(), kStrayStream);
        if (away.dot(work.old_point(0) - middle) < 0.0) away = -away;
        for (Index k = 1; k < work.count(); ++k) {
            const double t = work.t(k);
            work.set_point(k, work.old_point(k) + t * t * away);
        }
        work.restore_lengths();
    };
    change_strands(strands, effect, change, context);
}

}  // namespace

std::vector<float> inside_hairline(const Strands& strands, const Mesh& head, const Scalp& scalp,
                                   double reach) {
    require(reach > 0.0 && std::isfinite(reach), "the reach of an edge must be positive");
    const StrandRoots& roots = strands.roots();
    require(
        roots.faces.size() == at(strands.size()) && roots.barycentrics.size() == at(strands.size()),
        "the strands have no roots on a head; grow them with a style on it, or use "
        "hair:attach");
    const double softness = std::max(scalp.options().softness, 1e-4);
    std::vector<float> inside;
    for (std::size_t s = 0; s < roots.faces.size(); ++s) {
        const Index face = roots.faces[s];
        require(face == kNoIndex || (face >= 0 && face < head.face_count()),
                "the strands are rooted on another head");
        if (face == kNoIndex) {
            inside.push_back(1.0f);
            continue;
        }
        const auto triangle = root_triangle(roots, index_of(s), head);
        require(triangle.has_value(), "the strands are rooted on another head");
        const Vec3 barycentric = roots.barycentrics[s].cast<double>();
        const Vec3 position = *root_place(roots, index_of(s), head);
        const double margin = scalp.margin_at(*triangle, barycentric, position);
        inside.push_back(static_cast<float>(smooth_step(0.0, reach / softness, margin)));
    }
    return inside;
}

void soften_edge(Strands& strands, const std::vector<float>& inside,
                 const StrandEdgeOptions& options, const Context& context) {
    require_edge(strands, inside, options);
    Progress progress(context, "soften the edge of hair");
    const std::vector<char> baby = baby_hair(strands, inside, options);
    std::vector<float> factors;
    for (std::size_t s = 0; s < inside.size(); ++s) {
        const auto width = static_cast<float>(options.width);
        factors.push_back((width + (1.0f - width) * inside[s]) * (baby[s] ? kBabyWidth : 1.0f));
    }
    const auto part = [&](Index s, const std::vector<double>&, double) {
        const double whole = length(strands.strand(s));
        if (!(whole > 0.0) || !std::isfinite(whole)) return 1.0;
        return left_length(strands.id(s), whole, inside[at(s)], baby[at(s)], options);
    };
    Strands made = shortened(strands, part, context);
    made.set_widths(finer(made, factors));
    lead_astray(made, baby, options, context);
    strands = std::move(made);
}

}  // namespace lissom
