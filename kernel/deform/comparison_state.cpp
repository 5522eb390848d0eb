// What a Deformer does differently for a comparison method.
#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
// Errors: unsupported where something is held softly or at points that are not vertices, or is
// stiff.
void Deformer::State::require_plain_holds() const {
    if (!holds().change_patch()) return;
    throw Error(ErrorCode::unsupported,
                "method " + std::string(method_name(options.method)) +
                    " holds vertices exactly; weights, stiffness, and points in faces or on edges "
                    "are for method implicit");
}

void Deformer::State::find_sources(Prepared& next) const {
    const Patch& patch = next.work->patch;
    next.source.assign(static_cast<std::size_t>(patch.vertex_count), kNoIndex);
    std::map<std::pair<Index, Index>, Index> number;
    for (Index v = 0; v < patch.vertex_count; ++v) {
        if (!next.known.gradient[v]) continue;
        const Index owner = next.owner[v];
        const GradientSource source{owner, owner == kConstrained ? v : kNoIndex};
        const auto count = static_cast<Index>(next.sources.size());
        const auto entry = number.emplace(std::pair(source.owner, source.vertex), count);
        if (entry.second) next.sources.push_back(source);
        next.source[v] = entry.first->second;
    }
}

void Deformer::State::prepare_comparison(Prepared& next, const Context& context) {
    const Patch& patch = next.work->patch;
    find_sources(next);
    const ComparisonProblem problem{patch, next.known, next.source,
                                    static_cast<Index>(next.sources.size()), options};
    try {
        next.comparison = make_comparison(problem, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
        std::vector<Index> vertices(static_cast<std::size_t>(patch.real_count));
        std::iota(vertices.begin(), vertices.end(), 0);
        refuse_singular(error, vertices);
    }
    const ComparisonCosts costs = next.comparison->costs();
    stats.free_vertices = 0;
    for (Index v = 0; v < patch.real_count; ++v) stats.free_vertices += !next.known.position[v];
    stats.constrained_vertices = region.size() - stats.free_vertices;
    stats.displaced_vertices = 0;
    stats.first_nonzeros = costs.first_nonzeros;
    stats.second_nonzeros = costs.second_nonzeros;
    stats.factor_bytes = costs.factor_bytes;
    stats.assemble_seconds = stats.basis_seconds = 0.0;
    stats.first_factor_seconds = costs.first_seconds;
    stats.second_factor_seconds = costs.second_seconds;
    stats.factorizations += stats.free_vertices > 0 ? 1 : 0;
}

// The identity where the surroundings hold the region, else the transform of the first handle.
Affine Deformer::State::comparison_base() const {
    const Patch& patch = prepared->work->patch;
    const Rings& rings = prepared->work->rings;
    for (Index v = 0; v < patch.real_count; ++v) {
        if (prepared->owner[v] == kPinned && rings.count(v) > 0) return {};
    }
    for (const HandleState& h : handles) {
        if (!h.removed && h.options.position) return h.in_patch;
    }
    return {};
}

std::vector<SourceMotion> Deformer::State::source_motions() const {
    std::vector<SourceMotion> motions;
    for (const GradientSource& source : prepared->sources) {
        SourceMotion motion;
        if (source.owner >= 0) motion.gradient = handles[source.owner].transform.linear;
        if (source.owner == kConstrained) motion.gradient = *asked.at(source.vertex).gradient;
        motion.rotation = source.owner >= 0
                              ? handles[source.owner].turn
                              : turn_near(nearest_rotation(motion.gradient), Vec3::Zero());
        motions.push_back(motion);
    }
    return motions;
}

void Deformer::State::solve_comparison(const Context& context) {
    const Patch& patch = prepared->work->patch;
    const std::vector<SourceMotion> motions = source_motions();
    std::vector<Vec3> at(static_cast<std::size_t>(patch.real_count), Vec3::Zero());
    std::vector<Mat3> transforms(at.size(), Mat3::Identity());
    for (Index v = 0; v < patch.real_count; ++v) {
        if (prepared->known.position[v]) at[v] = known_position(v);
    }
    prepared->comparison->solve({motions, comparison_base()}, at, transforms, context);
    next_positions.resize(rest.size());
    for (Index row = 0; row < region.size(); ++row) {
        const Index v = patch.of_region[row];
        if (!prepared->known.position[v]) next_positions[row] = at[v] + patch.origin;
    }
    show_next();
    for (Index row = 0; row < region.size(); ++row) {
        gradients[row] = transforms[patch.of_region[row]];
    }
    gradients_current = true;
}

}  // namespace lissom
