#include "bindings/c/origins.h"

namespace lissom::c {
namespace {

OriginList list_of_origins(const ElementMap& map, std::span<const Index> counts) {
    OriginList list;
    for (Index i = 0; i < map.size(); ++i) {
        Index element = map.main_source(i), input = element == kNoIndex ? kNoIndex : 0;
        while (input != kNoIndex && at(input) < counts.size() && element >= counts[at(input)]) {
            element -= counts[at(input++)];
        }
        list.input.push_back(input);
        list.element.push_back(element);
    }
    return list;
}

}  // namespace

std::shared_ptr<Origins> origins_of(const Mesh& mesh, const MeshMap& map,
                                    const InputCounts& counts) {
    auto made = std::make_shared<Origins>();
    made->topology = mesh.shared_topology();
    made->vertices = list_of_origins(map.vertices, counts.vertices);
    made->faces = list_of_origins(map.faces, counts.faces);
    return made;
}

}  // namespace lissom::c
