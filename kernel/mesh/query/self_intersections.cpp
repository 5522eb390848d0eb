#include "kernel/mesh/query/self_intersections.h"

#include "kernel/mesh/query/crossing_search.h"

namespace lissom {

std::vector<FacePair> self_intersections(const Mesh& mesh, const SelfIntersectionOptions& options,
                                         const Context& context) {
    Progress progress(context, "self-intersections");
    return CrossingSearch(mesh.shared_topology(), options, context).find(mesh.positions(), context);
}

}  // namespace lissom
