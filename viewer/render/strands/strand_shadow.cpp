#include "viewer/render/strands/strand_shadow.h"

#include <algorithm>
#include <cmath>

#include "viewer/render/draw/studio_light.h"
#include "viewer/render/strands/strand_extinction.h"

namespace lissom {
namespace {

using Eigen::Vector3f;

std::uint8_t to_byte(float share) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}
}  // namespace

StrandShadow::StrandShadow(std::span<const ViewStrands> strands,
                           std::span<const ViewTriangle> triangles, const Context& context)
    : grid_(fit_grid(strands, triangles)) {
    const std::size_t bytes_a_point = (6 + kExtinctionParts * 3) * sizeof(float);
    const MemoryCharge working = context.charge(grid_.size() * bytes_a_point, "shadows of strands");
    charge_ = context.charge(grid_.size() * (sizeof(Corner) + 4), "shadows of strands");
    Progress progress(context, "render: shadows of hair");
    progress.step(0.2);
    const std::vector<float> hair = hair_extinction(grid_, strands, {}, context);
    std::vector<float> everything = hair;
    add_mesh_extinction(grid_, everything, triangles);
    scalp_color_ = mean_root_color(strands);
    progress.step(0.8);
    compute(hair, everything, scalp_tint(grid_, strands), context);
}

void StrandShadow::compute(const std::vector<float>& hair, const std::vector<float>& everything,
                           const std::vector<float>& tint, const Context& context) {
    const std::vector<AmbientDirection> around = ambient_directions();
    const auto directions = count_of(around);
    const Index grain = directions / kExtinctionParts;
    std::vector<std::array<std::vector<float>, 2>> ambient(kExtinctionParts);
    std::array<std::vector<float>, 3> lights;
    Progress progress(context, "render: shadows of hair");
    context.parallel_for(0, 3, 1, [&](Index which, Index) {
        lights[which] = light_through(grid_, which == 2 ? hair : everything,
                                      which == 1 ? kRimLight.direction : kKeyLight.direction);
    });
    // Each chunk adds one direction at a time, so that progress can be told in between.
    for (Index round = 0; round < grain; ++round) {
        progress.update(round + 1, grain + 1);
        context.parallel_for(0, kExtinctionParts, 1, [&](Index chunk, Index) {
            const AmbientDirection& from = around[chunk * grain + round];
            for (std::size_t which = 0; which < 2; ++which) {
                std::vector<float>& sum = ambient[chunk][which];
                sum.resize(grid_.size(), 0.0f);
                const auto light =
                    light_through(grid_, which == 0 ? everything : hair, from.direction);
                for (std::size_t p = 0; p < light.size(); ++p) sum[p] += from.weight * light[p];
            }
        });
    }
    light_.resize(grid_.size());
    on_meshes_.resize(4 * grid_.size());
    for (std::size_t i = 0; i < grid_.size(); ++i) {
        std::array<float, 2> open{0.0f, 0.0f};
        for (const auto& part : ambient) {
            open[0] += part[0][i];
            open[1] += part[1][i];
        }
        light_[i] = {lights[0][i], lights[1][i], open[0], 0.0f};
        on_meshes_[4 * i] = to_byte(lights[2][i]);
        on_meshes_[4 * i + 1] = to_byte(open[1]);
        on_meshes_[4 * i + 2] = to_byte(tint[i]);
        on_meshes_[4 * i + 3] = 255;
    }
}

StrandLight StrandShadow::light(const Vector3f& position) const {
    static const Vector3f to_key = kKeyLight.direction.normalized();
    static const Vector3f to_rim = kRimLight.direction.normalized();
    StrandLight result{0.0f, 0.0f, 0.0f};
    const float nearer = kTowardsLight * grid_.step;
    for_each_corner(grid_, position + nearer * to_key,
                    [&](std::size_t i, float weight) { result.key += weight * light_[i][0]; });
    for_each_corner(grid_, position + nearer * to_rim,
                    [&](std::size_t i, float weight) { result.rim += weight * light_[i][1]; });
    for_each_corner(grid_, position,
                    [&](std::size_t i, float weight) { result.ambient += weight * light_[i][2]; });
    return result;
}

}  // namespace lissom
