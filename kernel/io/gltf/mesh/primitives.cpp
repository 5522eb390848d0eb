#include "kernel/io/gltf/mesh/primitives.h"

#include <map>
#include <set>
#include <utility>

#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

FaceList join_triangles(std::vector<Index> v) {
    FaceList faces;
    const std::size_t count = v.size() / 3;
    faces.vertices = std::move(v);
    faces.vertices.resize(3 * count);
    faces.offsets.reserve(count + 1);
    for (std::size_t t = 1; t <= count; ++t) faces.offsets.push_back(index_of(3 * t));
    return faces;
}

FaceList join_strip(const std::vector<Index>& v) {
    FaceList faces;
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        const Index a = v[i], b = v[i + 1 + i % 2], c = v[i + 2 - i % 2];
        if (a != b && b != c && c != a) faces.add({a, b, c});
    }
    return faces;
}

FaceList join_fan(const std::vector<Index>& v) {
    FaceList faces;
    for (std::size_t i = 0; i + 2 < v.size(); ++i) faces.add({v[i + 1], v[i + 2], v[0]});
    return faces;
}

FaceList join_polygons(const std::vector<Index>& v) {
    FaceList faces;
    std::vector<Index> polygon;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        const bool goes_on = !polygon.empty() && polygon[0] == v[i] && polygon.back() == v[i + 1];
        if (goes_on) {
            polygon.push_back(v[i + 2]);
            continue;
        }
        if (!polygon.empty()) faces.add(polygon);
        polygon.assign({v[i], v[i + 1], v[i + 2]});
    }
    if (!polygon.empty()) faces.add(polygon);
    return faces;
}

}  // namespace

PrimitiveShape shape_of_mode(int mode) {
    if (mode == TINYGLTF_MODE_POINTS) return PrimitiveShape::points;
    if (mode >= TINYGLTF_MODE_LINE && mode <= TINYGLTF_MODE_LINE_STRIP) {
        return PrimitiveShape::lines;
    }
    if (mode >= TINYGLTF_MODE_TRIANGLES && mode <= TINYGLTF_MODE_TRIANGLE_FAN) {
        return PrimitiveShape::faces;
    }
    refuse(ErrorCode::file_syntax,
           "a primitive has the mode " + std::to_string(mode) + ", which does not exist");
}

FaceList join_primitive(std::vector<Index> indices, const PrimitiveJoin& join,
                        std::size_t& left_over) {
    if (join.mode == TINYGLTF_MODE_TRIANGLES) {
        left_over += indices.size() % 3;
        return join.has_polygons ? join_polygons(indices) : join_triangles(std::move(indices));
    }
    if (indices.size() < 3) left_over += indices.size();
    return join.mode == TINYGLTF_MODE_TRIANGLE_STRIP ? join_strip(indices) : join_fan(indices);
}

bool outline_of(const FaceList& faces, Index first, Index count, std::vector<Index>& outline) {
    outline.clear();
    std::map<Index, Index> next;
    std::set<std::pair<Index, Index>> edges;
    for (Index f = first; f < first + count; ++f) {
        const std::span<const Index> face = faces[f];
        for (std::size_t k = 0; k < face.size(); ++k)
            edges.emplace(face[k], face[(k + 1) % face.size()]);
    }
    std::size_t length = 0;
    for (const auto& [from, to] : edges) {
        if (edges.contains({to, from})) continue;
        ++length;
        if (!next.emplace(from, to).second) return false;
    }
    for (Index v = faces[first][0]; outline.size() < length; v = next[v]) {
        if (!next.contains(v)) return false;
        outline.push_back(v);
    }
    return length > 2 && next[outline.back()] == outline.front();
}

}  // namespace lissom
