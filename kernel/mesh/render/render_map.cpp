#include "kernel/mesh/render/render_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/normals_in_place.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// An attribute with the number of each vertex of the buffer, for the way through `repair`.
constexpr const char* kNumbers = "lissom.render";

template <typename Vector>
Attribute vertex_attribute(const char* name, const std::vector<Vector>& list) {
    constexpr int kWidth = Vector::RowsAtCompileTime;
    Attribute attribute{name, Domain::vertex, kWidth, ScalarType::float32, {}};
    attribute.values.reserve(list.size() * kWidth);
    for (const Vector& value : list) {
        attribute.values.insert(attribute.values.end(), value.data(), value.data() + kWidth);
    }
    return attribute;
}

void require_fit(std::size_t count, std::size_t vertices, const char* name) {
    if (count == 0 || count == vertices) return;
    throw Error(ErrorCode::invalid_argument, std::string(name) + ": there are " +
                                                 std::to_string(count) + " for " +
                                                 std::to_string(vertices) + " vertices");
}

Soup soup_of(RenderBuffer& buffer) {
    const std::size_t count = buffer.positions.size();
    require_fit(buffer.normals.size(), count, "normals");
    require_fit(buffer.uvs.size(), count, "uvs");
    Soup soup;
    Attribute numbers{kNumbers, Domain::vertex, 1, ScalarType::float64, {}};
    for (std::size_t i = 0; i < count; ++i) numbers.values.push_back(static_cast<double>(i));
    soup.attributes.add(std::move(numbers));
    if (!buffer.uvs.empty()) soup.attributes.add(vertex_attribute("uv", buffer.uvs));
    if (!buffer.normals.empty()) soup.attributes.add(vertex_attribute("normal", buffer.normals));
    soup.positions = std::move(buffer.positions);
    soup.faces = std::move(buffer.faces);
    return soup;
}

// The element of an attribute's values at a corner.
Index element_at(const Mesh& mesh, const Attribute& attribute, Index face, Index k) {
    if (attribute.domain == Domain::vertex) return mesh.topology().face(face)[at(k)];
    return attribute.domain == Domain::face ? face : mesh.topology().first_corner(face) + k;
}

template <typename Visit>
void for_each_corner(const Topology& topology, const Visit& visit) {
    for (Index f = 0; f < topology.face_count(); ++f) {
        for (Index k = 0; k < count_of(topology.face(f)); ++k) {
            visit(f, k, topology.first_corner(f) + k);
        }
    }
}

void read_numbers(const Mesh& mesh, const Attribute& numbers, RenderMap& map) {
    map.of_corner.resize(at(mesh.topology().corner_count()));
    for_each_corner(mesh.topology(), [&](Index f, Index k, Index corner) {
        const auto render = static_cast<Index>(numbers.at(element_at(mesh, numbers, f, k))[0]);
        map.of_corner[at(corner)] = render;
        if (map.vertex[at(render)] != kNoIndex) return;
        map.vertex[at(render)] = mesh.topology().face(f)[at(k)];
        map.corner[at(render)] = corner;
    });
}

using Place = std::array<double, 3>;

Place place_of(const Vec3& p) {
    return {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0};
}

// Vertices of dropped faces lie on those at their places.
void place_dropped(const std::vector<Vec3>& given, const Mesh& mesh, RenderMap& map) {
    const auto is_dropped = [](Index v) { return v == kNoIndex; };
    if (std::none_of(map.vertex.begin(), map.vertex.end(), is_dropped)) return;
    std::map<Place, Index> at_place;
    for (Index v = mesh.vertex_count(); v-- > 0;) at_place[place_of(mesh.position(v))] = v;
    for (std::size_t i = 0; i < map.vertex.size(); ++i) {
        if (map.vertex[i] != kNoIndex) continue;
        const auto found = at_place.find(place_of(given[i]));
        if (found != at_place.end()) map.vertex[i] = found->second;
    }
}

// Render vertices of each vertex of the mesh.
std::vector<std::vector<Index>> on_vertices(const RenderMap& map) {
    std::vector<std::vector<Index>> lists(at(map.topology->vertex_count()));
    for (Index i = 0; i < map.size(); ++i) {
        if (map.vertex[at(i)] != kNoIndex) lists[at(map.vertex[at(i)])].push_back(i);
    }
    return lists;
}

bool is_crease(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) > kCreaseAngle;
}

// Numbers the groups of one normal; all of a vertex are one without normals.
template <typename NormalOf>
void number_smooth(RenderMap& map, bool has_normals, const NormalOf& normal_of) {
    map.smooth.assign(map.vertex.size(), kNoIndex);
    for (const std::vector<Index>& list : on_vertices(map)) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            Index& own = map.smooth[at(list[i])];
            for (std::size_t j = 0; j < i && own == kNoIndex; ++j) {
                const bool apart = has_normals && is_crease(normal_of(list[i]), normal_of(list[j]));
                if (!apart) own = map.smooth[at(list[j])];
            }
            if (own == kNoIndex) own = map.smooth_count++;
        }
    }
}

// Attributes whose values tell the render vertices of one vertex apart.
std::vector<const Attribute*> telling_attributes(const Mesh& mesh) {
    std::vector<const Attribute*> list;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (attribute.domain == Domain::corner) list.push_back(&attribute);
    }
    return list;
}

bool same_values(const std::vector<const Attribute*>& attributes, Index a, Index b) {
    return std::all_of(attributes.begin(), attributes.end(), [&](const Attribute* one) {
        const auto first = one->at(a), second = one->at(b);
        return std::memcmp(first.data(), second.data(), first.size_bytes()) == 0;
    });
}

// Whether the texture coordinates of each face run the other way; empty without any.
std::vector<char> mirrored_faces(const Mesh& mesh) {
    const Attribute* uv = mesh.attributes().find("uv");
    if (!uv || uv->width != 2 || uv->domain == Domain::face) return {};
    std::vector<char> mirrored;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        double area = 0.0;
        const Index n = count_of(mesh.topology().face(f));
        for (Index k = 0; k < n; ++k) {
            const auto a = uv->at(element_at(mesh, *uv, f, k)),
                       b = uv->at(element_at(mesh, *uv, f, (k + 1) % n));
            area += a[0] * b[1] - a[1] * b[0];
        }
        mirrored.push_back(static_cast<char>(area < 0.0));
    }
    return mirrored;
}

// Corners in sets that grow together.
class CornerSets {
  public:
    explicit CornerSets(Index count) : parent_(at(count)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    Index first_of(Index corner) {
        while (parent_[at(corner)] != corner) {
            corner = parent_[at(corner)] = parent_[at(parent_[at(corner)])];
        }
        return corner;
    }
    void unite(Index a, Index b) {
        const Index first = first_of(a), second = first_of(b);
        parent_[at(std::max(first, second))] = std::min(first, second);
    }

  private:
    std::vector<Index> parent_;
};

// Corners of one render vertex that are joined by edges on which both faces have the same values.
CornerSets fans_of(const Mesh& mesh, const RenderMap& map) {
    CornerSets fans(mesh.topology().corner_count());
    std::unordered_map<std::uint64_t, std::pair<Index, Index>> open;
    for_each_corner(mesh.topology(), [&](Index f, Index k, Index corner) {
        const bool is_last = k + 1 == count_of(mesh.topology().face(f));
        const Index next = is_last ? corner - k : corner + 1;
        const Index from = map.of_corner[at(corner)], to = map.of_corner[at(next)];
        const auto found = open.find(pair_key(to, from));
        if (found == open.end()) {
            open[pair_key(from, to)] = {corner, next};
            return;
        }
        fans.unite(corner, found->second.second);
        fans.unite(next, found->second.first);
    });
    return fans;
}

// Gives each fan of faces at a vertex its own render vertex: seams that meet at the vertex part
// them, though the values there are the same, and each fan has its own tangent.
void part_fans(const Mesh& mesh, RenderMap& map) {
    CornerSets fans = fans_of(mesh, map);
    std::vector<Index> number(map.of_corner.size(), kNoIndex);
    RenderMap parted{map.topology, {}, {}, {}, {}, 0};
    for_each_corner(mesh.topology(), [&](Index f, Index k, Index corner) {
        Index& own = number[at(fans.first_of(corner))];
        if (own == kNoIndex) {
            own = parted.size();
            parted.vertex.push_back(mesh.topology().face(f)[at(k)]);
            parted.corner.push_back(corner);
        }
        parted.of_corner.push_back(own);
    });
    map = std::move(parted);
}

Vec3 normal_at(const Attribute& normals, Index element) {
    const auto n = normals.at(element);
    return {n[0], n[1], n[2]};
}

void require_map_of(const RenderMap& map, const Mesh& mesh) {
    require_same_topology(mesh, map.topology, "the map of render vertices");
}

}  // namespace

WeldedBuffer weld_buffer(RenderBuffer buffer, const RepairOptions& options,
                         const Context& context) {
    const std::vector<Vec3> given = buffer.positions;
    const std::vector<Vec3> normals = buffer.normals;
    WeldedBuffer made{repair(soup_of(buffer), options, context), {}};
    RenderMap& map = made.map;
    map.topology = made.mesh.shared_topology();
    map.vertex.assign(given.size(), kNoIndex);
    map.corner.assign(given.size(), kNoIndex);
    read_numbers(made.mesh, *made.mesh.attributes().find(kNumbers), map);
    made.mesh.attributes().remove(kNumbers);
    place_dropped(given, made.mesh, map);
    number_smooth(map, !normals.empty(), [&](Index i) -> const Vec3& { return normals[at(i)]; });
    return made;
}

RenderMap render_map(const Mesh& mesh, const Context& context) {
    context.checkpoint();
    RenderMap map;
    map.topology = mesh.shared_topology();
    map.of_corner.resize(at(mesh.topology().corner_count()));
    const auto telling = telling_attributes(mesh);
    const std::vector<char> mirrored = mirrored_faces(mesh);
    std::vector<std::vector<std::pair<Index, Index>>> known(at(mesh.vertex_count()));
    for_each_corner(mesh.topology(), [&](Index f, Index k, Index corner) {
        const Index v = mesh.topology().face(f)[at(k)];
        for (const auto& [render, face] : known[at(v)]) {
            if (!mirrored.empty() && mirrored[at(f)] != mirrored[at(face)]) continue;
            if (!same_values(telling, corner, map.corner[at(render)])) continue;
            map.of_corner[at(corner)] = render;
            return;
        }
        map.of_corner[at(corner)] = map.size();
        known[at(v)].emplace_back(map.size(), f);
        map.vertex.push_back(v);
        map.corner.push_back(corner);
    });
    if (!mirrored.empty()) part_fans(mesh, map);
    const Attribute* normals = mesh.attributes().find("normal");
    const bool has_normals = normals && normals->domain == Domain::corner && normals->width == 3;
    number_smooth(map, has_normals,
                  [&](Index i) { return normal_at(*normals, map.corner[at(i)]); });
    return map;
}

std::vector<Triangle> render_triangles(const RenderMap& map, const Mesh& mesh) {
    require_map_of(map, mesh);
    std::vector<Triangle> triangles = triangulate_faces(mesh.topology(), mesh.positions()).corners;
    for (Triangle& triangle : triangles) {
        for (Index& corner : triangle) corner = map.of_corner[at(corner)];
    }
    return triangles;
}

void find_render_normals(const RenderMap& map, const Mesh& mesh, std::vector<Vec3>& sums,
                         std::vector<Vec3>& normals) {
    require_map_of(map, mesh);
    sums.assign(at(map.smooth_count), Vec3::Zero());
    Vec3 normal = Vec3::Zero();
    for_each_corner(mesh.topology(), [&](Index f, Index k, Index corner) {
        const auto face = mesh.topology().face(f);
        const Index n = count_of(face);
        if (k == 0) normal = normal_of_face(mesh, f);
        const double angle =
            corner_angle(mesh.position(face[at((k + n - 1) % n)]), mesh.position(face[at(k)]),
                         mesh.position(face[at((k + 1) % n)]), normal);
        sums[at(map.smooth[at(map.of_corner[at(corner)])])] += angle * normal;
    });
    for (Vec3& sum : sums) {
        const double length = sum.norm();
        sum = length > 0.0 ? Vec3(sum / length) : Vec3::Zero();
    }
    normals.assign(map.vertex.size(), Vec3::Zero());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (map.smooth[i] != kNoIndex) normals[i] = sums[at(map.smooth[i])];
    }
}

std::vector<Vec3> render_normals(const RenderMap& map, const Mesh& mesh) {
    std::vector<Vec3> sums, normals;
    find_render_normals(map, mesh, sums, normals);
    return normals;
}

std::vector<Tangent> render_tangents(const RenderMap& map, const Mesh& mesh, std::string_view uv) {
    const Attribute* found = mesh.attributes().find(uv);
    if (!found || found->width != 2 || found->domain == Domain::face) {
        throw Error(ErrorCode::out_of_range, "the mesh has no texture coordinates '" +
                                                 std::string(uv) + "' on its vertices or corners");
    }
    const std::vector<Triangle> triangles = render_triangles(map, mesh);
    const std::vector<Vec3> normals = render_normals(map, mesh);
    std::vector<Vec3> positions(map.vertex.size(), Vec3::Zero());
    std::vector<Vec2> uvs(map.vertex.size(), Vec2::Zero());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (map.corner[i] == kNoIndex) continue;
        positions[i] = mesh.position(map.vertex[i]);
        const auto value =
            found->at(found->domain == Domain::vertex ? map.vertex[i] : map.corner[i]);
        uvs[i] = {value[0], value[1]};
    }
    const std::vector<Tangent> of_corner = corner_tangents({positions, normals, uvs, triangles});
    std::vector<Tangent> tangents(positions.size());
    // The first triangle at a render vertex decides.
    for (std::size_t t = triangles.size(); t-- > 0;) {
        for (std::size_t k = 3; k-- > 0;) tangents[at(triangles[t][k])] = of_corner[3 * t + k];
    }
    return tangents;
}

}  // namespace lissom
