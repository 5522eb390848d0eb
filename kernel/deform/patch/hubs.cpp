#include "kernel/deform/patch/hubs.h"

#include <algorithm>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// The systems count vertices of fewer neighbours by themselves.
constexpr Index kHubNeighbors = 256;
// Entries of matrices are numbered by Index, with room for fill.
constexpr std::size_t kMaxPairs = std::size_t{1} << 28;
// An entry of either system, and its copy in the part of one thread.
constexpr std::size_t kBytesPerPair = 64;

std::size_t pairs_at(const Rings& rings, Index v) {
    const std::size_t n = at(rings.count(v));
    return rings.count(v) > kHubNeighbors ? n * n / 2 : 0;
}

[[noreturn]] void refuse_hubs(const Patch& patch, const Rings& rings) {
    Elements hubs{ElementKind::vertex, 0, {}};
    Index most = 0;
    for (Index v = 0; v < patch.mesh_count(); ++v) {
        if (pairs_at(rings, v) == 0) continue;
        hubs.add(patch.mesh_vertex[at(v)]);
        most = std::max(most, rings.count(v));
    }
    throw Error(ErrorCode::unsupported,
                describe(hubs) + ": up to " + std::to_string(most) +
                    " neighbours of one vertex would be coupled in pairs; split the long faces "
                    "there, as mesh:remesh does, or leave the vertex out of the region",
                hubs);
}

}  // namespace

MemoryCharge charge_hubs(const Patch& patch, const Rings& rings, const Context& context) {
    std::size_t pairs = 0;
    for (Index v = 0; v < rings.size(); ++v) pairs += pairs_at(rings, v);
    if (pairs > kMaxPairs) refuse_hubs(patch, rings);
    return context.charge(pairs * kBytesPerPair, "vertices of very many neighbours");
}

}  // namespace lissom
