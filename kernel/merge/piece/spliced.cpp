#include "kernel/merge/piece/spliced.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "kernel/mesh/edit/corner_twins.h"
#include "kernel/mesh/edit/joined_content.h"
#include "kernel/mesh/edit/joined_morphs.h"
#include "kernel/mesh/topology.h"

namespace lissom {
namespace {

bool is_vertex_chart(const Attribute& attribute) {
    const AttributeRole role = role_of(attribute);
    return attribute.domain == Domain::vertex &&
           (role == AttributeRole::texture_coordinates || role == AttributeRole::tangent);
}

// The mesh itself if there is nothing to split.
const Mesh& with_split_charts(const Mesh& mesh, std::optional<Mesh>& copy) {
    const auto& all = mesh.attributes().all();
    if (std::none_of(all.begin(), all.end(), is_vertex_chart)) return mesh;
    split_charts(copy.emplace(mesh));
    return *copy;
}

// The faces of the new mesh, with the corners of both that theirs are.
class SplicedFaces {
  public:
    SplicedFaces(const Mesh& first, const Mesh& second, const SplicedElements& elements)
        : first_(first.topology()), second_(second.topology()) {
        corners_.reserve(at(first_.corner_count()));
        faces_.vertices.reserve(at(first_.corner_count()));
        faces_.offsets.reserve(elements.faces.size() + 1);
        for (const Index f : elements.faces) {
            const bool is_first = f < first_.face_count();
            const Topology& of = is_first ? first_ : second_;
            const Index face = is_first ? f : f - first_.face_count();
            const Index vertices = is_first ? 0 : first_.vertex_count();
            const Index corners = is_first ? 0 : first_.corner_count();
            for (Index c = of.first_corner(face); c < of.first_corner(face + 1); ++c) {
                corners_.push_back(c + corners);
                const Index v = of.faces().vertices[at(c)] + vertices;
                faces_.vertices.push_back(elements.number[at(v)]);
            }
            faces_.offsets.push_back(count_of(corners_));
        }
    }

    const std::vector<Index>& corners() const { return corners_; }
    FaceList take() { return std::move(faces_); }

    // Like `corner_twins`, for the new faces.
    std::vector<Index> twins() const {
        std::vector<Index> number(at(first_.corner_count() + second_.corner_count()), kNoIndex);
        for (std::size_t c = 0; c < corners_.size(); ++c) number[at(corners_[c])] = index_of(c);
        const std::vector<Index> first = corner_twins(first_), second = corner_twins(second_);
        std::vector<Index> twin;
        twin.reserve(corners_.size());
        std::vector<Index> open;
        for (const Index c : corners_) {
            const bool is_first = c < first_.corner_count();
            const Index old = is_first ? first[at(c)] : second[at(c - first_.corner_count())];
            const Index other = is_first || old == kNoIndex ? old : old + first_.corner_count();
            twin.push_back(other == kNoIndex ? kNoIndex : number[at(other)]);
            if (twin.back() == kNoIndex) open.push_back(count_of(twin) - 1);
        }
        pair(open, twin);
        return twin;
    }

  private:
    struct Side {
        std::array<Index, 2> edge;
        Index corner;
        bool operator<(const Side& other) const { return edge < other.edge; }
    };

    Index next(Index corner) const {
        const auto end = std::upper_bound(faces_.offsets.begin(), faces_.offsets.end(), corner);
        return corner + 1 < *end ? corner + 1 : *(end - 1);
    }

    // Pairs the corners whose edges were borders of one mesh or of its remainder.
    void pair(std::span<const Index> open, std::vector<Index>& twin) const {
        std::vector<Side> sides;
        for (const Index c : open) {
            sides.push_back({{faces_.vertices[at(c)], faces_.vertices[at(next(c))]}, c});
        }
        std::sort(sides.begin(), sides.end());
        for (const Side& side : sides) {
            const Side back{{side.edge[1], side.edge[0]}, kNoIndex};
            const auto other = std::lower_bound(sides.begin(), sides.end(), back);
            if (other != sides.end() && other->edge == back.edge) {
                twin[at(side.corner)] = other->corner;
            }
        }
    }

    const Topology &first_, &second_;
    FaceList faces_;
    std::vector<Index> corners_;
};

Attribute taken(const Attribute& old, std::span<const Index> elements) {
    Attribute result{old.name, old.domain, old.width, old.type, {}};
    result.values.reserve(elements.size() * at(old.width));
    for (const Index element : elements) {
        const std::span<const double> values = old.at(element);
        result.values.insert(result.values.end(), values.begin(), values.end());
    }
    return result;
}

void take_content(const JoinedContent& content, const SplicedElements& elements,
                  const std::vector<Index>& corners, Mesh& mesh, const Context& context) {
    for (const Attribute& attribute : content.attributes.all()) {
        context.checkpoint();
        mesh.attributes().add(
            taken(attribute, attribute.domain == Domain::vertex   ? elements.vertices
                             : attribute.domain == Domain::corner ? corners
                                                                  : elements.faces));
    }
    for (const auto& [kind, old] : content.attributes.labels()) {
        FaceLabels labels{old.names, {}};
        labels.of_face.reserve(elements.faces.size());
        for (const Index f : elements.faces) labels.of_face.push_back(old.of_face[at(f)]);
        mesh.attributes().labels().emplace(kind, std::move(labels));
    }
    mesh.attributes().recount();
    for (const auto& [name, vertices] : content.regions) {
        std::vector<char> inside(elements.number.size(), 0);
        for (const Index v : vertices) inside[at(v)] = 1;
        std::vector<Index> kept;
        for (std::size_t v = 0; v < elements.vertices.size(); ++v) {
            if (inside[at(elements.vertices[v])]) kept.push_back(index_of(v));
        }
        mesh.set_region(name, Region(mesh.shared_topology(), std::move(kept)));
    }
    mesh.material_libraries() = content.material_libraries;
}

}  // namespace

void split_charts(Mesh& mesh) {
    for (Attribute& attribute : mesh.attributes().all()) {
        if (!is_vertex_chart(attribute)) continue;
        std::vector<double> values;
        for (const Index v : mesh.topology().faces().vertices) {
            const std::span<const double> at = std::as_const(attribute).at(v);
            values.insert(values.end(), at.begin(), at.end());
        }
        attribute.domain = Domain::corner;
        attribute.values = std::move(values);
    }
    mesh.attributes().recount();
}

Mesh spliced(const Mesh& first, const Mesh& second, const SplicedElements& elements,
             const Context& context) {
    const MemoryCharge working =
        context.charge(first.memory_bytes() + second.memory_bytes(), "putting a piece back");
    SplicedFaces faces(first, second, elements);
    const std::vector<Index> twins = faces.twins(), corners = faces.corners();
    std::vector<Vec3> positions;
    positions.reserve(elements.vertices.size());
    for (const Index v : elements.vertices) {
        const bool is_first = v < first.vertex_count();
        positions.push_back(is_first ? first.position(v)
                                     : second.position(v - first.vertex_count()));
    }
    const Index vertices = count_of(positions);
    Mesh mesh(std::move(positions), Topology::create_paired(vertices, faces.take(), twins, context),
              context);
    std::optional<Mesh> first_copy, second_copy;
    const std::optional<Mesh> renumbered = with_morph_numbers(first, joined_morphs(first, second));
    take_content(joined_content(with_split_charts(renumbered ? *renumbered : first, first_copy),
                                with_split_charts(second, second_copy), {}, context),
                 elements, corners, mesh, context);
    mesh.set_asset(second.asset());
    return mesh;
}

}  // namespace lissom
