#include "kernel/mesh/repair/carry_soup.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "kernel/core/numbers/bits.h"

namespace lissom {
namespace {

// The elements of the file from which those of the mesh take their values.
struct SoupSources {
    std::span<const Index> file_corners;
    const CornerFaces& work;
    const FanVertices& fans;
    // The mesh's vertex at each of its corners, which `fans` no longer has.
    std::span<const Index> fan_of_corner;
    bool corners_unchanged;

    SoupSources(std::span<const Index> corners, const CornerFaces& faces,
                const FanVertices& vertices, const Topology& topology)
        : file_corners(corners),
          work(faces),
          fans(vertices),
          fan_of_corner(topology.faces().vertices) {
        corners_unchanged = faces.corner_source.size() == file_corners.size() &&
                            std::is_sorted(faces.corner_source.begin(), faces.corner_source.end());
    }

    // Whether the faces are the `file_count` of the file. A face without corners may be gone
    // although all corners stay.
    bool faces_unchanged(std::size_t file_count) const {
        return corners_unchanged && work.face_source.size() == file_count &&
               std::adjacent_find(work.face_source.begin(), work.face_source.end(),
                                  std::greater_equal<>()) == work.face_source.end();
    }
    std::size_t corner_count() const { return work.corner_source.size(); }
    // The vertex of the file at a corner of the mesh.
    Index vertex_at(std::size_t corner) const { return file_corners[work.corner_source[corner]]; }
    std::vector<Index> vertices_at_corners() const {
        std::vector<Index> vertices;
        vertices.reserve(corner_count());
        for (std::size_t c = 0; c < corner_count(); ++c) vertices.push_back(vertex_at(c));
        return vertices;
    }
};

bool same_values(std::span<const double> a, std::span<const double> b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
        return bits_as<std::uint64_t>(x) == bits_as<std::uint64_t>(y) || x == y;
    });
}

Attribute taken(const Attribute& old, Domain domain, const std::vector<Index>& sources) {
    Attribute result{old.name, domain, old.width, old.type, {}};
    result.values.reserve(sources.size() * old.width);
    for (const Index source : sources) {
        const std::span<const double> values = old.at(source);
        result.values.insert(result.values.end(), values.begin(), values.end());
    }
    return result;
}

bool differs_at_a_vertex(const Attribute& old, const SoupSources& sources) {
    for (std::size_t c = 0; c < sources.corner_count(); ++c) {
        const Index here = sources.vertex_at(c);
        const Index first = sources.fans.source[sources.fan_of_corner[c]];
        if (here != first && !same_values(old.at(here), old.at(first))) return true;
    }
    return false;
}

Attribute carried(Attribute&& old, const SoupSources& sources) {
    if (old.domain == Domain::face) {
        if (sources.faces_unchanged(old.size())) return std::move(old);
        return taken(old, Domain::face, sources.work.face_source);
    }
    if (old.domain == Domain::corner) {
        if (sources.corners_unchanged) return std::move(old);
        return taken(old, Domain::corner, sources.work.corner_source);
    }
    if (sources.fans.unchanged) return std::move(old);
    const bool is_skin = old.name == "joints" || old.name == "weights";
    if (is_skin || !differs_at_a_vertex(old, sources))
        return taken(old, Domain::vertex, sources.fans.source);
    return taken(old, Domain::corner, sources.vertices_at_corners());
}

void carry_labels(AttributeSet&& old, const SoupSources& sources, AttributeSet& result) {
    for (auto& [kind, labels] : old.labels()) {
        FaceLabels& kept = result.labels()[kind];
        if (sources.faces_unchanged(labels.of_face.size())) {
            kept = std::move(labels);
            continue;
        }
        kept.names = std::move(labels.names);
        kept.of_face.reserve(sources.work.face_source.size());
        for (const Index f : sources.work.face_source) kept.of_face.push_back(labels.of_face[f]);
    }
}

std::vector<Index> carried_region(const std::vector<Index>& vertices, std::size_t file_vertices,
                                  const SoupSources& sources, const Topology& topology) {
    std::vector<char> inside(file_vertices, 0);
    for (const Index v : vertices) inside[v] = 1;
    std::vector<Index> kept;
    for (std::size_t c = 0; c < sources.corner_count(); ++c) {
        if (inside[sources.vertex_at(c)]) kept.push_back(sources.fan_of_corner[c]);
    }
    const std::vector<Index>& source = sources.fans.source;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (topology.is_isolated(v) && inside[source[at(v)]]) kept.push_back(v);
    }
    return kept;
}

std::vector<Vec3> carried_positions(Soup& soup, const FanVertices& fans) {
    if (fans.unchanged) return std::move(soup.positions);
    std::vector<Vec3> positions;
    positions.reserve(fans.source.size());
    for (const Index v : fans.source) positions.push_back(soup.positions[v]);
    return positions;
}

[[noreturn]] void refuse_misfit(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what + " does not fit the vertices and faces given");
}

}  // namespace

void require_attributes_fit(const Soup& soup) {
    const std::size_t counts[] = {soup.positions.size(), soup.faces.vertices.size(),
                                  at(soup.faces.size())};
    for (const Attribute& a : soup.attributes.all()) {
        if (a.values.size() != counts[static_cast<int>(a.domain)] * a.width)
            refuse_misfit("attribute \"" + a.name + '"');
    }
    for (const auto& [kind, labels] : soup.attributes.labels()) {
        if (labels.of_face.size() != counts[2]) refuse_misfit("list of labels \"" + kind + '"');
    }
    const bool is_known = std::all_of(soup.same_as.begin(), soup.same_as.end(),
                                      [&](Index v) { return v >= 0 && at(v) < counts[0]; });
    if (!is_known || (!soup.same_as.empty() && soup.same_as.size() != counts[0]))
        refuse_misfit("list of vertices that are the same");
    for (const auto& [name, vertices] : soup.regions) {
        const bool fits = std::all_of(vertices.begin(), vertices.end(),
                                      [&](Index v) { return v >= 0 && at(v) < counts[0]; });
        if (!fits) refuse_misfit("region \"" + name + '"');
    }
}

Mesh carry_soup(Soup soup, std::span<const Index> file_corners, CornerFaces work, FanVertices fans,
                const std::vector<Index>& twin, const Context& context) {
    const std::size_t file_vertices = soup.positions.size();
    FaceList faces{std::move(work.faces.offsets), std::move(fans.of_corner)};
    // Freed before the half-edges take their memory.
    work.faces = {};
    work.face_of_corner = {};
    auto topology = Topology::create_paired(count_of(fans.source), std::move(faces), twin, context);
    const SoupSources sources(file_corners, work, fans, *topology);
    Mesh mesh(carried_positions(soup, fans), std::move(topology), context);
    for (Attribute& attribute : soup.attributes.all()) {
        context.checkpoint();
        mesh.attributes().add(carried(std::move(attribute), sources));
    }
    carry_labels(std::move(soup.attributes), sources, mesh.attributes());
    mesh.attributes().recount();
    for (const auto& [name, vertices] : soup.regions) {
        mesh.set_region(name,
                        Region(mesh.shared_topology(),
                               carried_region(vertices, file_vertices, sources, mesh.topology())));
    }
    return mesh;
}

}  // namespace lissom
