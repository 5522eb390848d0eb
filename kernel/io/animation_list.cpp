#include "kernel/io/animation_list.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "kernel/io/gltf/asset.h"

namespace lissom {
namespace {

// The last of the times, which are stored as 32-bit numbers in ascending order.
double last_time(const KeptAccessor& times) {
    const Json* greatest = member(times.json, "max");
    if (greatest && greatest->is_array() && !greatest->empty() && greatest->front().is_number()) {
        return greatest->front().get<double>();
    }
    if (!times.bytes || times.bytes->size() < sizeof(float)) return 0.0;
    const auto* bytes = reinterpret_cast<const unsigned char*>(times.bytes->data() +
                                                               times.bytes->size() - sizeof(float));
    const std::uint32_t bits =
        bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
    float time = 0.0f;
    std::memcpy(&time, &bits, sizeof time);
    return time;
}

AnimationInfo info_of(const Json& animation, const std::vector<KeptAccessor>& accessors) {
    AnimationInfo info;
    info.name = text_member(animation, "name");
    const Json* samplers = member(animation, "samplers");
    if (!samplers || !samplers->is_array()) return info;
    for (const Json& sampler : *samplers) {
        const Json* input = member(sampler, "input");
        if (!input || !input->is_number_unsigned()) continue;
        const auto number = input->get<std::uint64_t>();
        if (number >= accessors.size()) continue;
        const Json* count = member(accessors[static_cast<std::size_t>(number)].json, "count");
        if (count && count->is_number_unsigned()) {
            info.frames = std::max(info.frames, count->get<std::size_t>());
        }
        info.seconds =
            std::max(info.seconds, last_time(accessors[static_cast<std::size_t>(number)]));
    }
    return info;
}

}  // namespace

std::vector<AnimationInfo> animations_of(const Mesh& mesh) {
    std::vector<AnimationInfo> list;
    const auto* asset = dynamic_cast<const GltfAsset*>(mesh.asset().get());
    const Json* animations = asset ? member(asset->json, "animations") : nullptr;
    if (!animations || !animations->is_array()) return list;
    for (const Json& animation : *animations) {
        list.push_back(info_of(animation, asset->accessors));
    }
    return list;
}

}  // namespace lissom
