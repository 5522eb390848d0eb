#include "kernel/mesh/edit/joined_content.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "kernel/core/geometry.h"
#include "kernel/mesh/edit/label_adder.h"

namespace lissom {
namespace {

// The element of `domain` that a corner belongs to, for every corner.
std::vector<Index> element_of_corner(const Topology& topology, Domain domain) {
    if (domain == Domain::vertex) return topology.faces().vertices;
    std::vector<Index> faces;
    faces.reserve(topology.corner_count());
    for (Index f = 0; f < topology.face_count(); ++f) {
        faces.insert(faces.end(), topology.face(f).size(), f);
    }
    return faces;
}

Attribute on_corners(const Attribute& old, const Topology& topology) {
    if (old.domain == Domain::corner) return old;
    Attribute result{old.name, Domain::corner, old.width, old.type, {}};
    for (const Index element : element_of_corner(topology, old.domain)) {
        const std::span<const double> values = old.at(element);
        result.values.insert(result.values.end(), values.begin(), values.end());
    }
    return result;
}

// Numbers that the narrower attribute lacks are NaN, but colors without alpha are opaque.
Attribute widened(const Attribute& old, Index width) {
    if (old.width == width) return old;
    Attribute result{old.name, old.domain, width, old.type, {}};
    result.values.assign(at(old.size()) * width, kNone);
    for (Index i = 0; i < old.size(); ++i) {
        const std::span<const double> from = old.at(i);
        const std::span<double> to = result.at(i);
        std::copy(from.begin(), from.end(), to.begin());
        if (old.name == "color" && old.width == 3 && width == 4 && !std::isnan(from[0]))
            to[3] = 1.0;
    }
    return result;
}

ScalarType common_type(ScalarType a, ScalarType b) {
    if (a == b) return a;
    const auto is_wide = [](ScalarType t) {
        return t == ScalarType::float64 || t == ScalarType::int32 || t == ScalarType::uint32;
    };
    return is_wide(a) || is_wide(b) ? ScalarType::float64 : ScalarType::float32;
}

Attribute absent(const Attribute& like, const Topology& topology, AbsentValues values) {
    Attribute result{like.name, like.domain, like.width, like.type, {}};
    const std::size_t count = element_count(topology, like.domain);
    result.values.assign(count * like.width,
                         values == AbsentValues::shown ? shown_value(like) : kNone);
    return result;
}

Attribute joined(const Attribute& first, const Topology& first_topology, const Attribute& second,
                 const Topology& second_topology) {
    if (first.domain != second.domain) {
        return joined(on_corners(first, first_topology), first_topology,
                      on_corners(second, second_topology), second_topology);
    }
    const Index width = std::max(first.width, second.width);
    Attribute result = widened(first, width);
    const Attribute tail = widened(second, width);
    result.type = common_type(first.type, second.type);
    result.values.insert(result.values.end(), tail.values.begin(), tail.values.end());
    return result;
}

AttributeSet joined_attributes(const Mesh& mesh, const Mesh& other, AbsentValues values) {
    AttributeSet result;
    for (const Attribute& a : mesh.attributes().all()) {
        const Attribute* b = other.attributes().find(a.name);
        result.add(joined(a, mesh.topology(), b ? *b : absent(a, other.topology(), values),
                          other.topology()));
    }
    for (const Attribute& b : other.attributes().all()) {
        if (mesh.attributes().find(b.name)) continue;
        result.add(
            joined(absent(b, mesh.topology(), values), mesh.topology(), b, other.topology()));
    }
    return result;
}

bool lacks(const NamedSide& side, const Attribute& attribute) {
    return side.mesh->vertex_count() > 0 && !side.mesh->attributes().find(attribute.name);
}

std::string absence_warning(const NamedSide& side, const Attribute& attribute) {
    const bool color = role_of(attribute) == AttributeRole::color;
    return side.name + " has no " + (color ? "colors" : "texture coordinates") + " (\"" +
           attribute.name + "\"): " + (color ? "it is white there" : "they are 0, 0 there") +
           "; give it its own before";
}

const std::string& renamed(const LabelRenames& renames, const std::string& kind,
                           const std::string& name) {
    const auto of_kind = renames.find(kind);
    if (of_kind == renames.end()) return name;
    const auto found = of_kind->second.find(name);
    return found == of_kind->second.end() ? name : found->second;
}

void join_labels(const Mesh& mesh, const Mesh& other, const LabelRenames& renames,
                 AttributeSet& result, const Context& context) {
    result.labels() = mesh.attributes().labels();
    for (const auto& [kind, labels] : other.attributes().labels()) {
        context.checkpoint();
        FaceLabels& joined = result.labels()[kind];
        joined.of_face.resize(mesh.face_count(), kNoIndex);
        LabelAdder adder(joined);
        std::vector<Index> renumbered;
        for (const std::string& name : labels.names) {
            renumbered.push_back(adder.add(renamed(renames, kind, name)));
        }
        for (const Index label : labels.of_face) {
            joined.of_face.push_back(label == kNoIndex ? kNoIndex : renumbered[label]);
        }
    }
    const auto faces = at(mesh.face_count()) + other.face_count();
    for (auto& [kind, labels] : result.labels()) labels.of_face.resize(faces, kNoIndex);
}

std::map<std::string, std::vector<Index>, std::less<>> joined_regions(const Mesh& mesh,
                                                                      const Mesh& other) {
    std::map<std::string, std::vector<Index>, std::less<>> regions;
    for (const auto& [name, region] : mesh.regions()) regions[name] = region.vertices();
    for (const auto& [name, region] : other.regions()) {
        for (const Index v : region.vertices()) regions[name].push_back(v + mesh.vertex_count());
    }
    return regions;
}

std::vector<std::string> joined_libraries(const Mesh& mesh, const Mesh& other) {
    std::vector<std::string> all = mesh.material_libraries();
    for (const std::string& library : other.material_libraries()) {
        if (std::find(all.begin(), all.end(), library) == all.end()) all.push_back(library);
    }
    return all;
}

}  // namespace

JoinedContent joined_content(const Mesh& mesh, const Mesh& other, const LabelRenames& renames,
                             const Context& context, AbsentValues absent) {
    require_complete_attributes(mesh);
    require_complete_attributes(other);
    JoinedContent content{joined_attributes(mesh, other, absent), joined_regions(mesh, other),
                          joined_libraries(mesh, other)};
    join_labels(mesh, other, renames, content.attributes, context);
    return content;
}

double shown_value(const Attribute& attribute) {
    switch (role_of(attribute)) {
        case AttributeRole::color:
            return 1.0;
        case AttributeRole::texture_coordinates:
            return 0.0;
        default:
            return kNone;
    }
}

std::vector<std::string> absence_warnings(std::span<const NamedSide> sides) {
    std::vector<std::string> warnings;
    std::set<std::string> told;
    for (const NamedSide& having : sides) {
        for (const Attribute& attribute : having.mesh->attributes().all()) {
            if (std::isnan(shown_value(attribute)) || !told.insert(attribute.name).second) continue;
            for (const NamedSide& side : sides) {
                if (lacks(side, attribute)) warnings.push_back(absence_warning(side, attribute));
            }
        }
    }
    return warnings;
}

}  // namespace lissom
