#include "kernel/mesh/repair.h"

#include <utility>

namespace lissom {

Mesh repair(Soup soup, const RepairOptions&, const Context& context, Report report) {
    Mesh mesh(std::move(soup.positions), std::move(soup.faces), context);
    mesh.attributes() = std::move(soup.attributes);
    for (auto& [name, vertices] : soup.regions)
        mesh.set_region(name, Region(mesh.shared_topology(), std::move(vertices)));
    mesh.set_report(std::move(report));
    return mesh;
}

}  // namespace lissom
