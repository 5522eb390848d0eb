#include "kernel/mesh/edit/append.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/edit/corner_twins.h"
#include "kernel/mesh/edit/joined_content.h"
#include "kernel/mesh/edit/joined_morphs.h"
#include "kernel/mesh/topology.h"

namespace lissom {
namespace {

void require_room(std::int64_t count, std::int64_t more, const char* what) {
    if (count + more <= std::numeric_limits<Index>::max()) return;
    throw Error(ErrorCode::out_of_range, "together the meshes have " +
                                             std::to_string(count + more) + " " + what +
                                             ", more than can be numbered");
}

// Both assets as one; `renames` gets the labels of `other` that mean something else in `mesh`.
std::shared_ptr<const Asset> joined_asset(const Mesh& mesh, const Mesh& other,
                                          LabelRenames& renames) {
    if (!mesh.asset()) return other.asset();
    if (!other.asset() || other.asset() == mesh.asset()) return mesh.asset();
    return mesh.asset()->joined(*other.asset(), renames);
}

FaceList joined_faces(const Mesh& mesh, const Mesh& other) {
    FaceList faces = mesh.topology().faces();
    const Index vertices = mesh.vertex_count(), corners = mesh.topology().corner_count();
    for (const Index v : other.topology().faces().vertices) faces.vertices.push_back(v + vertices);
    for (Index f = 0; f < other.face_count(); ++f) {
        faces.offsets.push_back(other.topology().faces().offsets[f + 1] + corners);
    }
    return faces;
}

// Neither mesh gets new edges, so that nothing needs to be checked or paired again.
std::shared_ptr<const Topology> joined_topology(const Mesh& mesh, const Mesh& other,
                                                const Context& context) {
    std::vector<Index> twin = corner_twins(mesh.topology());
    const Index corners = mesh.topology().corner_count();
    for (const Index t : corner_twins(other.topology())) {
        twin.push_back(t == kNoIndex ? kNoIndex : t + corners);
    }
    return Topology::create_paired(mesh.vertex_count() + other.vertex_count(),
                                   joined_faces(mesh, other), twin, context);
}

}  // namespace

std::vector<std::string> append(Mesh& mesh, const Mesh& other, const Context& context) {
    const NamedSide sides[] = {{"the mesh", &mesh}, {"the appended mesh", &other}};
    std::vector<std::string> warnings = absence_warnings(sides);
    append_with(mesh, other, AbsentValues::shown, context);
    return warnings;
}

void append_with(Mesh& mesh, const Mesh& other, AbsentValues absent, const Context& context) {
    require_complete_attributes(mesh);
    require_complete_attributes(other);
    require_room(mesh.vertex_count(), other.vertex_count(), "vertices");
    require_room(mesh.topology().corner_count(), other.topology().corner_count(), "corners");
    Progress progress(context, "append");
    const MemoryCharge working =
        context.charge((mesh.memory_bytes() + other.memory_bytes()) / 2, "appending a mesh");

    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    positions.insert(positions.end(), other.positions().begin(), other.positions().end());
    Mesh result(std::move(positions), joined_topology(mesh, other, context), context);
    LabelRenames renames;
    const std::vector<MorphTarget> morphs = joined_morphs(mesh, other);
    result.set_asset(with_morphs(joined_asset(mesh, other, renames), morphs));
    const std::optional<Mesh> first = with_morph_numbers(mesh, morphs),
                              second = with_morph_numbers(other, morphs);
    JoinedContent content =
        joined_content(first ? *first : mesh, second ? *second : other, renames, context, absent);
    result.attributes() = std::move(content.attributes);
    for (auto& [name, vertices] : content.regions) {
        result.set_region(name, Region(result.shared_topology(), std::move(vertices)));
    }
    result.material_libraries() = std::move(content.material_libraries);
    mesh.replace_by(std::move(result));
}

}  // namespace lissom
