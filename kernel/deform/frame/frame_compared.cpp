// Preparation and frames of the methods that the thesis compares its own with.
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

void find_sources(const Preparation& next, ComparedMethod& compared) {
    const Patch& patch = next.patch();
    compared.source.assign(patch.vertex_count, kNoIndex);
    std::map<std::pair<Index, Index>, Index> number;
    for (Index v = 0; v < patch.vertex_count; ++v) {
        if (!next.known.gradient[v]) continue;
        const Index owner = next.owner[v];
        const GradientSource source{owner, owner == kConstrained ? v : kNoIndex};
        const auto count = count_of(compared.sources);
        const auto entry = number.emplace(std::pair(source.owner, source.vertex), count);
        if (entry.second) compared.sources.push_back(source);
        compared.source[v] = entry.first->second;
    }
}

void count_costs(Preparation& next, const ComparisonCosts& costs) {
    DeformStats& stats = next.costs;
    for (Index v = 0; v < next.patch().real_count; ++v) {
        stats.free_vertices += !next.known.position[v];
    }
    stats.constrained_vertices = next.rest->region().size() - stats.free_vertices;
    stats.first_nonzeros = costs.first_nonzeros;
    stats.second_nonzeros = costs.second_nonzeros;
    stats.factor_bytes = costs.factor_bytes;
    stats.first_factor_seconds = costs.first_seconds;
    stats.second_factor_seconds = costs.second_seconds;
    stats.factorizations = stats.free_vertices > 0 ? 1 : 0;
}

// The identity if the surroundings hold the region, else the transform of the first handle.
Affine comparison_base(const Preparation& prepared, const Poses& poses) {
    const Rings& rings = prepared.rings();
    for (Index v = 0; v < prepared.patch().real_count; ++v) {
        if (prepared.owner[v] == kPinned && rings.count(v) > 0) return {};
    }
    const auto& handles = prepared.constraints->handles;
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (handles[h] && handles[h]->options.position) return poses.handles[h].local_transform;
    }
    return {};
}

std::vector<SourceMotion> source_motions(const ComparedMethod& compared, const FrameInput& motion) {
    std::vector<SourceMotion> motions;
    for (const GradientSource& source : compared.sources) {
        SourceMotion m;
        if (source.owner >= 0) m.gradient = motion.pose(source.owner).transform.linear;
        if (source.owner == kConstrained)
            m.gradient = *motion.asked().at.at(source.vertex).gradient;
        m.rotation = source.owner >= 0 ? motion.pose(source.owner).turn
                                       : turn_near(nearest_rotation(m.gradient), Vec3::Zero());
        motions.push_back(m);
    }
    return motions;
}

}  // namespace

void require_plain_holds(const ConstraintSet& constraints, const DeformOptions& options) {
    if (options.method == DeformMethod::implicit) return;
    if (!changes_patch(constraints, options.transition)) return;
    throw Error(ErrorCode::unsupported,
                "method " + std::string(method_name(options.method)) +
                    " holds vertices exactly; weights, stiffness, and points in faces or on edges "
                    "are for method implicit");
}

void require_comparison(const DeformOptions& options) {
    if (options.method == DeformMethod::implicit || options.comparison) return;
    throw Error(ErrorCode::unsupported,
                "method " + std::string(method_name(options.method)) +
                    " is not part of this program, which was built without kernel/thesis; use "
                    "method implicit");
}

void prepare_comparison(Preparation& next, const Context& context) {
    require_comparison(next.rest->options());
    const Patch& patch = next.patch();
    ComparedMethod& compared = next.method.emplace<ComparedMethod>();
    find_sources(next, compared);
    const ComparisonProblem problem{patch, next.known, compared.source, count_of(compared.sources),
                                    next.rest->options()};
    try {
        compared.method = problem.options.comparison(problem, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
        std::vector<Index> vertices(patch.real_count);
        std::iota(vertices.begin(), vertices.end(), 0);
        refuse_singular(patch, error, vertices);
    }
    count_costs(next, compared.method->costs());
}

DeformFrame solve_compared(const std::shared_ptr<const Preparation>& preparation,
                           const Poses& poses, FrameScratch::State& scratch,
                           const Context& context) {
    const Preparation& prepared = *preparation;
    const Patch& patch = prepared.patch();
    const auto& compared = std::get<ComparedMethod>(prepared.method);
    const FrameInput motion(prepared, poses, target_rhs(preparation, poses.targets, scratch.asked));
    const std::vector<SourceMotion> motions = source_motions(compared, motion);
    std::vector<Vec3> at(patch.real_count, Vec3::Zero());
    std::vector<Mat3> transforms(at.size(), Mat3::Identity());
    for (Index v = 0; v < patch.real_count; ++v) {
        if (prepared.known.position[v]) at[v] = motion.known_position(v);
    }
    compared.method->solve({motions, comparison_base(prepared, poses)}, at, transforms, context);
    std::vector<Vec3> positions;
    std::vector<Mat3> gradients;
    for (const Index v : patch.of_region) {
        positions.push_back(at[v] + patch.origin);
        gradients.push_back(transforms[v]);
    }
    DeformFrame frame = framed(preparation, motion, scratch, std::move(positions));
    frame.gradients = std::move(gradients);
    return frame;
}

}  // namespace lissom
