#include "kernel/merge/provenance.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace lissom {
namespace {

ElementMap shifted_behind(const ElementMap& first, const ElementMap& second, Index shift) {
    ElementMap result;
    result.reserve(first.size() + second.size());
    for (Index i = 0; i < first.size(); ++i) result.add_blend(first[i]);
    std::vector<ElementMap::Source> sources;
    for (Index i = 0; i < second.size(); ++i) {
        sources.assign(second[i].begin(), second[i].end());
        for (ElementMap::Source& s : sources) s.element += shift;
        result.add_blend(sources);
    }
    return result;
}

}  // namespace

MeshMap identity_map(const Topology& topology) {
    return {ElementMap::identity(topology.vertex_count()),
            ElementMap::identity(topology.corner_count()),
            ElementMap::identity(topology.face_count())};
}

MeshMap part_map(const MeshPart& part, const Topology& old) {
    MeshMap map{ElementMap::copies(part.vertex_map), {}, ElementMap::copies(part.face_map)};
    for (Index f = 0; f < part.mesh.face_count(); ++f) {
        const Index from = part.face_map[f];
        const std::span<const Index> face = part.mesh.topology().face(f), was = old.face(from);
        for (const Index v : face) {
            const auto place = std::find(was.begin(), was.end(), part.vertex_map[v]);
            map.corners.add_copy(old.first_corner(from) + index_of(place - was.begin()));
        }
    }
    return map;
}

MeshMap flipped_map(const Topology& topology) {
    MeshMap map = identity_map(topology);
    std::vector<Index> corners;
    for (Index f = 0; f < topology.face_count(); ++f) {
        const auto n = count_of(topology.face(f));
        for (Index k = 0; k < n; ++k) corners.push_back(topology.first_corner(f) + (n - k) % n);
    }
    map.corners = ElementMap::copies(corners);
    return map;
}

ElementMap composed(const ElementMap& outer, const ElementMap& inner) {
    ElementMap result;
    result.reserve(outer.size());
    std::vector<ElementMap::Source> sources;
    for (Index i = 0; i < outer.size(); ++i) {
        if (outer[i].size() == 1) {
            result.add_blend(inner[outer[i].front().element]);
            continue;
        }
        sources.clear();
        for (const ElementMap::Source& between : outer[i]) {
            for (const ElementMap::Source& s : inner[between.element]) {
                sources.push_back({s.element, between.weight * s.weight});
            }
        }
        result.add_blend(sources);
    }
    return result;
}

MeshMap composed(const MeshMap& outer, const MeshMap& inner) {
    return {composed(outer.vertices, inner.vertices), composed(outer.corners, inner.corners),
            composed(outer.faces, inner.faces)};
}

MeshMap appended_map(const MeshMap& first, const MeshMap& second, const Topology& first_origin) {
    return {shifted_behind(first.vertices, second.vertices, first_origin.vertex_count()),
            shifted_behind(first.corners, second.corners, first_origin.corner_count()),
            shifted_behind(first.faces, second.faces, first_origin.face_count())};
}

namespace {

// The two maps that lead on from elements below and from a count on.
struct TwoMaps {
    Index count = 0;
    const ElementMap* first = nullptr;
    const ElementMap& second;
    Index shift = 0;

    // Adds the sources of an element, with a weight.
    void add(Index element, double weight, std::vector<ElementMap::Source>& sources) const {
        if (element < count && !first) return sources.push_back({element, weight});
        const ElementMap& map = element < count ? *first : second;
        const Index by = element < count ? 0 : shift;
        for (const ElementMap::Source& s : map[element < count ? element : element - count]) {
            sources.push_back({s.element + by, weight * s.weight});
        }
    }
};

ElementMap composed_of_two(const ElementMap& outer, const TwoMaps& inner) {
    ElementMap result;
    result.reserve(outer.size());
    std::vector<ElementMap::Source> sources;
    for (Index i = 0; i < outer.size(); ++i) {
        const std::span<const ElementMap::Source> between = outer[i];
        if (between.size() == 1 && between[0].element < inner.count && !inner.first) {
            result.add_copy(between[0].element);
            continue;
        }
        sources.clear();
        for (const ElementMap::Source& s : between) {
            inner.add(s.element, between.size() == 1 ? 1.0 : s.weight, sources);
        }
        result.add_blend(sources);
    }
    return result;
}

}  // namespace

MeshMap composed_of_two(const MeshMap& outer, const Topology& first_between, const MeshMap* first,
                        const MeshMap& second, const Topology& first_origin) {
    const auto one = [&](const ElementMap& map, Index between, const ElementMap* before,
                         const ElementMap& after, Index shift) {
        return composed_of_two(map, {between, before, after, shift});
    };
    return {one(outer.vertices, first_between.vertex_count(), first ? &first->vertices : nullptr,
                second.vertices, first_origin.vertex_count()),
            one(outer.corners, first_between.corner_count(), first ? &first->corners : nullptr,
                second.corners, first_origin.corner_count()),
            one(outer.faces, first_between.face_count(), first ? &first->faces : nullptr,
                second.faces, first_origin.face_count())};
}

std::vector<Index> kept_vertices(const ElementMap& map, Index old_count) {
    std::vector<Index> kept(old_count, kNoIndex);
    for (Index i = 0; i < map.size(); ++i) {
        if (map[i].size() == 1 && kept[map[i].front().element] == kNoIndex) {
            kept[map[i].front().element] = i;
        }
    }
    return kept;
}

namespace {

// Place of each vertex on the mesh whose vertices have the numbers from `begin` on in the map; NaN
// for one that was not on it.
std::vector<Vec3> places_on(const MeshMap& map, const Mesh& mesh, Index begin) {
    std::vector<Vec3> places;
    places.reserve(at(map.vertices.size()));
    for (Index v = 0; v < map.vertices.size(); ++v) {
        Vec3 sum = Vec3::Zero();
        double weight = 0.0;
        for (const ElementMap::Source& from : map.vertices[v]) {
            if (from.element < begin || from.element >= begin + mesh.vertex_count()) continue;
            sum += from.weight * mesh.position(from.element - begin);
            weight += from.weight;
        }
        places.push_back(weight > 0.0 ? Vec3(sum / weight) : Vec3(Vec3::Constant(NAN)));
    }
    return places;
}

}  // namespace

std::vector<Vec3> places_on_second(const MeshMap& map, const Mesh& second, Index first_count) {
    return places_on(map, second, first_count);
}

std::vector<Vec3> places_on_first(const MeshMap& map, const Mesh& first) {
    return places_on(map, first, 0);
}

}  // namespace lissom
