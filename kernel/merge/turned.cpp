#include "kernel/merge/turned.h"

#include <vector>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/rest_directions.h"

namespace lissom {

void turn_directions(const Mesh& rest, const Region& region, const BoundaryDeformation& deformed,
                     Mesh& moved) {
    RestDirections(rest, region).apply_to(moved, deformed.transforms);
    std::vector<double> scale(moved.vertex_count(), 1.0);
    const std::vector<Index>& ids = region.vertices();
    for (std::size_t row = 0; row < ids.size(); ++row) {
        scale[ids[row]] = uniform_scale(deformed.transforms[row]);
    }
    for (Attribute& attribute : moved.attributes().all()) {
        if (role_of(attribute) != AttributeRole::morph_position) continue;
        for (Index i = 0; i < attribute.size(); ++i) {
            const Index v =
                attribute.domain == Domain::vertex ? i : moved.topology().faces().vertices[i];
            for (double& x : attribute.at(i)) x *= scale[v];
        }
    }
}

}  // namespace lissom
