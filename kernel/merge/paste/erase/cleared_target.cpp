#include "kernel/merge/paste/erase/cleared_target.h"

#include <utility>
#include <vector>

#include "kernel/merge/paste/erase/erase_feature.h"
#include "kernel/merge/provenance.h"

namespace lissom {

Region region_under(const Mesh& target, const SurfacePoint& point, double radius,
                    const Context& context) {
    context.checkpoint();
    const Topology& topology = target.topology();
    std::vector<char> seen(at(target.vertex_count()), 0);
    std::vector<Index> reached;
    const auto reach = [&](Index v) {
        if (std::exchange(seen[at(v)], 1)) return;
        reached.push_back(v);
    };
    for (const Index v : topology.face(point.face)) reach(v);
    for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const Index n : topology.neighbors(reached[i])) {
            if ((target.position(n) - point.position).norm() <= radius) reach(n);
        }
    }
    return {target.shared_topology(), std::move(reached)};
}

ClearedTarget cleared_target(const Mesh& target, const std::optional<Region>& onto,
                             const Region& gone, const Context& context) {
    ErasedFeature erased = erase_feature(target, gone, {}, context);
    ClearedTarget result{std::move(erased.mesh), std::move(erased.map), std::nullopt};
    if (!onto) return result;
    require_same_topology(target, onto->topology(), "the target's region");
    const bool meets = !onto->intersected(gone).empty();
    const std::vector<char> inside = onto->mask();
    std::vector<Index> vertices;
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        const Index from = result.map.vertices.main_source(v);
        if (from == kNoIndex ? meets : inside[at(from)] != 0) vertices.push_back(v);
    }
    result.onto.emplace(result.mesh.shared_topology(), std::move(vertices));
    return result;
}

}  // namespace lissom
