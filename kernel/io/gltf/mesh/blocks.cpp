#include "kernel/io/gltf/mesh/blocks.h"

#include <algorithm>

namespace lissom {
namespace {

bool share_vertices(const VertexBlock& block, const tinygltf::Primitive& primitive) {
    if (block.targets != primitive.targets) return false;
    for (const auto& [name, accessor] : primitive.attributes) {
        const auto same = block.attributes.find(name);
        if (same == block.attributes.end() ? name == "POSITION" : same->second != accessor) {
            return false;
        }
    }
    return primitive.attributes.contains("POSITION");
}

}  // namespace

std::vector<VertexBlock> blocks_of(const std::vector<const tinygltf::Primitive*>& primitives) {
    // Only the latest are tried, so that many primitives do not take quadratic time.
    constexpr int kTried = 16;
    std::vector<VertexBlock> blocks;
    // By accessor of positions.
    std::map<int, std::vector<std::size_t>> candidates;
    for (const tinygltf::Primitive* primitive : primitives) {
        const int position = primitive->attributes.at("POSITION");
        std::vector<std::size_t>& list = candidates[position];
        const auto begin = list.size() > kTried ? list.end() - kTried : list.begin();
        const auto found = std::find_if(begin, list.end(), [&](std::size_t b) {
            return share_vertices(blocks[b], *primitive);
        });
        if (found == list.end()) {
            list.push_back(blocks.size());
            blocks.push_back({primitive->attributes, primitive->targets, {primitive}, {}, 0});
        } else {
            VertexBlock& block = blocks[*found];
            block.attributes.insert(primitive->attributes.begin(), primitive->attributes.end());
            block.primitives.push_back(primitive);
        }
    }
    return blocks;
}

}  // namespace lissom
