#include "kernel/deform/holds/handle_gaps.h"

#include <algorithm>
#include <map>
#include <utility>

namespace lissom {
namespace {

bool is_held(const HolderMap& holding, Index v) {
    const Index owner = holding.owner[at(v)];
    return holding.known.position[at(v)] && owner != kFree && owner != kLoose;
}

double distance(const WorkingPatch& work, Index a, Index b) {
    return (work.patch.rest[at(a)] - work.patch.rest[at(b)]).norm();
}

// Neighbours of a free vertex that are held, the nearest of each holder.
std::map<Index, Index> holders_around(const WorkingPatch& work, const HolderMap& holding, Index v) {
    std::map<Index, Index> nearest;
    for (const Index n : work.rings.ring(v)) {
        if (n >= work.patch.real_count || !is_held(holding, n)) continue;
        const auto [place, is_new] = nearest.emplace(holding.owner[at(n)], n);
        if (!is_new && distance(work, v, n) < distance(work, v, place->second)) place->second = n;
    }
    return nearest;
}

// How many edges lie between each vertex of a handle and its vertices at gaps; kNoIndex for those
// that none leads to.
std::vector<Index> hops_from_gaps(const WorkingPatch& work, const HolderMap& holding) {
    std::vector<Index> hops(holding.owner.size(), kNoIndex), front;
    const auto reach = [&](Index v, Index hop) {
        if (holding.owner[at(v)] < 0 || hops[at(v)] != kNoIndex) return;
        hops[at(v)] = hop;
        front.push_back(v);
    };
    for (const HandleGap& gap : handle_gaps(work, holding)) {
        reach(gap.first, 0);
        reach(gap.second, 0);
    }
    for (std::size_t next = 0; next < front.size(); ++next) {
        const Index v = front[next];
        for (const Index n : work.rings.ring(v)) {
            if (n < work.patch.real_count && holding.owner[at(n)] == holding.owner[at(v)]) {
                reach(n, hops[at(v)] + 1);
            }
        }
    }
    return hops;
}

}  // namespace

std::vector<HandleGap> handle_gaps(const WorkingPatch& work, const HolderMap& holding) {
    std::vector<HandleGap> near, far;
    for (Index v = 0; v < work.patch.real_count; ++v) {
        if (is_held(holding, v)) {
            for (const Index n : work.rings.ring(v)) {
                if (n <= v || n >= work.patch.real_count || !is_held(holding, n)) continue;
                if (holding.owner[at(n)] == holding.owner[at(v)]) continue;
                near.push_back({v, n, distance(work, v, n)});
            }
            continue;
        }
        const std::map<Index, Index> around = holders_around(work, holding, v);
        for (auto a = around.begin(); a != around.end(); ++a) {
            for (auto b = std::next(a); b != around.end(); ++b) {
                far.push_back({a->second, b->second,
                               distance(work, v, a->second) + distance(work, v, b->second)});
            }
        }
    }
    near.insert(near.end(), far.begin(), far.end());
    return near;
}

void free_gap_rings(const WorkingPatch& work, int rings, HolderMap& holding) {
    if (rings == 0) return;
    const std::vector<Index> hops = hops_from_gaps(work, holding);
    // The deepest vertex of each handle; one that no gap leads to is deep enough.
    std::map<Index, Index> deepest;
    for (Index v = 0; v < work.patch.real_count; ++v) {
        if (holding.owner[at(v)] < 0) continue;
        Index& most = deepest[holding.owner[at(v)]];
        most = std::max(most, hops[at(v)] == kNoIndex ? rings : hops[at(v)]);
    }
    for (Index v = 0; v < work.patch.real_count; ++v) {
        const Index hop = hops[at(v)];
        if (hop == kNoIndex || hop >= std::min(rings, deepest[holding.owner[at(v)]])) continue;
        holding.owner[at(v)] = kFree;
        holding.known.position[at(v)] = holding.known.gradient[at(v)] = 0;
    }
}

}  // namespace lissom
