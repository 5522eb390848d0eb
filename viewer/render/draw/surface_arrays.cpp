#include "viewer/render/draw/surface_arrays.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/measures.h"
#include "viewer/render/draw/image/colormap.h"
#include "viewer/render/draw/shading_normals.h"

namespace lissom {
namespace {

constexpr Index kGrain = 4096;

using Bytes = std::array<std::uint8_t, 4>;

std::array<float, 3> to_floats(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void require_values(const Mesh& mesh, const std::vector<double>& values) {
    if (values.empty() || values.size() == at(mesh.vertex_count())) return;
    throw Error(ErrorCode::invalid_argument,
                std::to_string(values.size()) + " values were given to draw on a mesh of " +
                    std::to_string(mesh.vertex_count()) + " vertices; give one a vertex");
}

// Colours of a mesh's faces and corners, as MeshStyle ranks them.
class SurfaceColors {
  public:
    SurfaceColors(const Mesh& mesh, const MeshStyle& style)
        : mesh_(mesh),
          style_(style),
          attribute_(style.vertex_colors ? mesh.attributes().find("color") : nullptr),
          paint_(mesh.face_count(), Paint::own) {
        if (attribute_ && attribute_->width < 3) attribute_ = nullptr;
        for (std::size_t i = 0; i < style.parts.size(); ++i) paint_part(index_of(i));
        if (style.region) paint_faces(*style.region, Paint::region, "the region to draw");
        if (!style.values.empty()) paint_values();
        for (const Region& handle : style.handles) {
            paint_faces(handle, Paint::handle, "the handle to draw");
        }
    }

    Bytes at(Index face, Index corner, Index vertex) const {
        switch (paint_[face]) {
            case Paint::region:
                return to_bytes(style_.region_color);
            case Paint::part:
                return to_bytes(style_.parts[part_[face]].color);
            case Paint::handle:
                return to_bytes(style_.handle_color);
            case Paint::no_value:
                return to_bytes(kNoValueColor);
            default:
                return attribute_ ? attribute_at(face, corner, vertex) : to_bytes(style_.color);
        }
    }

    bool has_values(Index face) const { return paint_[face] == Paint::value; }

  private:
    enum class Paint : char { own, part, region, handle, value, no_value };

    void paint_faces(const Region& region, Paint paint, std::string_view what) {
        require_same_topology(mesh_, region.topology(), what);
        for (const Index f : region.faces()) paint_[f] = paint;
    }

    void paint_part(Index part) {
        const Region& region = style_.parts[part].region;
        paint_faces(region, Paint::part, "a part to draw");
        part_.resize(mesh_.face_count());
        for (const Index f : region.faces()) part_[f] = part;
    }

    void paint_values() {
        const auto has_value = [&](Index v) { return std::isfinite(style_.values[v]); };
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const std::span<const Index> face = mesh_.topology().face(f);
            const bool known = std::all_of(face.begin(), face.end(), has_value);
            paint_[f] = known ? Paint::value : Paint::no_value;
        }
    }

    Bytes attribute_at(Index face, Index corner, Index vertex) const {
        const Index element = attribute_->domain == Domain::face     ? face
                              : attribute_->domain == Domain::corner ? corner
                                                                     : vertex;
        const std::span<const double> parts = attribute_->at(element);
        const bool known =
            std::isfinite(parts[0]) && std::isfinite(parts[1]) && std::isfinite(parts[2]);
        return to_bytes(known ? Color{parts[0], parts[1], parts[2]} : style_.color);
    }

    const Mesh& mesh_;
    const MeshStyle& style_;
    const Attribute* attribute_;
    std::vector<Paint> paint_;
    // Part that paints each face.
    std::vector<Index> part_;
};

// The flags of kEdgeFlags for a triangle of a polygon with `sides` sides.
std::uint32_t edge_flags(const Triangle& corners, Index first_corner, Index sides) {
    std::uint32_t flags = 0;
    for (int i = 0; i < 3; ++i) {
        const Index from = corners[(i + 1) % 3] - first_corner;
        const Index to = corners[(i + 2) % 3] - first_corner;
        if (to == (from + 1) % sides) flags |= 1u << i;
    }
    return flags;
}

// A normal for every corner, towards the outside.
std::vector<Vec3> normals_for(const Topology& topology, std::span<const Vec3> positions,
                              const MeshStyle& style, const Context& context) {
    if (style.shading == Shading::smooth) {
        return corner_normals(topology, positions, style.crease, context);
    }
    const std::vector<Vec3> of_face = face_normals(topology, positions, context);
    std::vector<Vec3> result;
    result.reserve(topology.corner_count());
    for (Index f = 0; f < topology.face_count(); ++f) {
        result.insert(result.end(), topology.face(f).size(), of_face[f]);
    }
    return result;
}

float place_on_scale(double value, const ValueRange& range) {
    const double extent = range.high - range.low;
    return static_cast<float>(extent > 0.0 ? (value - range.low) / extent : 0.5);
}

// Calls `write(triangle, corner of it, corner of the mesh)` for all; a mirrored triangle goes round
// the other way.
template <typename Write>
void for_each_corner(const SurfaceTriangles& triangles, const Context& context,
                     const Write& write) {
    const int second = triangles.mirrored ? 2 : 1;
    const Index count = count_of(triangles.faces->triangles);
    context.parallel_for(0, count, kGrain, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            write(t, 0, 0);
            write(t, 1, second);
            write(t, 2, 3 - second);
        }
    });
}

std::size_t entry(Index triangle, int corner) {
    return 3 * at(triangle) + corner;
}

std::array<float, 3> turned_if(bool mirrored, const std::array<float, 3>& v) {
    return mirrored ? std::array<float, 3>{-v[0], -v[1], -v[2]} : v;
}

// Flags of a triangle that goes round the other way.
std::uint32_t turned_round(std::uint32_t flags) {
    constexpr std::uint32_t kSwapped = 6;
    return (flags & ~kSwapped) | ((flags & 2) << 1) | ((flags & 4) >> 1);
}

// The same bits: NaN, which stands for no value, equals itself.
bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

bool same_attribute(const Attribute* a, const Attribute* b) {
    if (!a || !b) return a == b;
    return a->domain == b->domain && a->width == b->width && same_numbers(a->values, b->values);
}

bool same_positions(const DrawnMesh& a, const DrawnMesh& b) {
    return a.mesh == b.mesh && a.transform == b.transform;
}

}  // namespace

bool SurfaceTriangles::same_as(const SurfaceTriangles& other) const {
    return mirrored == other.mirrored &&
           (faces == other.faces || faces->corners == other.faces->corners);
}

std::vector<Vec3> picture_positions(const Mesh& mesh, const Affine& to_picture) {
    std::vector<Vec3> result;
    result.reserve(mesh.positions().size());
    for (const Vec3& p : mesh.positions()) result.push_back(to_picture(p));
    return result;
}

SurfaceTriangles surface_triangles(const Mesh& mesh, std::span<const Vec3> positions,
                                   const Affine& to_picture, const SurfaceTriangles* known) {
    const bool keep = known && mesh.topology().is_triangle_mesh();
    return {
        keep ? known->faces
             : std::make_shared<const Triangulation>(triangulate_faces(mesh.topology(), positions)),
        to_picture.linear.determinant() < 0.0};
}

std::vector<SurfaceVertex> surface_vertices(const Mesh& mesh, const MeshStyle& style,
                                            std::span<const Vec3> positions,
                                            const SurfaceTriangles& triangles,
                                            const Context& context) {
    const Triangulation& faces = *triangles.faces;
    const std::vector<Vec3> normals = normals_for(mesh.topology(), positions, style, context);
    std::vector<SurfaceVertex> vertices(3 * faces.triangles.size());
    for_each_corner(triangles, context, [&](Index t, int to, int from) {
        vertices[entry(t, to)] = {
            to_floats(positions[faces.triangles[t][from]]),
            turned_if(triangles.mirrored, to_floats(normals[faces.corners[t][from]]))};
    });
    return vertices;
}

std::vector<SurfaceColor> surface_colors(const Mesh& mesh, const MeshStyle& style,
                                         const ValueRange& range, const SurfaceTriangles& triangles,
                                         const Context& context) {
    require_values(mesh, style.values);
    const Topology& topology = mesh.topology();
    const SurfaceColors colors(mesh, style);
    const Triangulation& faces = *triangles.faces;
    const auto flags_of = [&](Index t) {
        const Index face = faces.face[t];
        const Index sides = count_of(topology.face(face));
        const std::uint32_t edges =
            edge_flags(faces.corners[t], topology.first_corner(face), sides);
        return (triangles.mirrored ? turned_round(edges) : edges) |
               (colors.has_values(face) ? kValueFlag : 0u);
    };
    std::vector<SurfaceColor> result(3 * faces.triangles.size());
    for_each_corner(triangles, context, [&](Index t, int to, int from) {
        const Index v = faces.triangles[t][from];
        const float value = style.values.empty() ? 0.0f : place_on_scale(style.values[v], range);
        result[entry(t, to)] = {colors.at(faces.face[t], faces.corners[t][from], v), value,
                                flags_of(t)};
    });
    return result;
}

bool same_vertices(const DrawnMesh& a, const DrawnMesh& b) {
    return same_positions(a, b) && a.style.shading == b.style.shading &&
           a.style.crease == b.style.crease;
}

bool same_colors(const DrawnMesh& a, const DrawnMesh& b) {
    const MeshStyle &s = a.style, &t = b.style;
    const bool same_attributes =
        a.mesh == b.mesh || !s.vertex_colors ||
        same_attribute(a.mesh->attributes().find("color"), b.mesh->attributes().find("color"));
    return same_attributes && s.vertex_colors == t.vertex_colors && s.color == t.color &&
           s.region == t.region && s.region_color == t.region_color && s.handles == t.handles &&
           s.handle_color == t.handle_color && s.parts == t.parts &&
           same_numbers(s.values, t.values);
}

bool same_marks(const DrawnMesh& a, const DrawnMesh& b) {
    const MeshStyle &s = a.style, &t = b.style;
    if (s.boundaries != t.boundaries || s.vertex_normals != t.vertex_normals ||
        s.face_normals != t.face_normals || s.handles != t.handles || s.parts != t.parts) {
        return false;
    }
    const bool has_lines = s.boundaries || s.vertex_normals || s.face_normals;
    if (!has_lines && s.handles.empty() && s.parts.empty()) return true;
    return same_positions(a, b) && s.handle_color == t.handle_color && s.line_width == t.line_width;
}

namespace {

void add_boundaries(const DrawnMesh& drawn, Overlay& marks) {
    const auto& loops = drawn.mesh->topology().boundary_loops();
    for (std::size_t i = 0; i < loops.size(); ++i) {
        DrawnLine line{{}, true, category_color(i), drawn.style.line_width};
        for (const Index v : loops[i]) {
            line.points.push_back(drawn.transform(drawn.mesh->position(v)));
        }
        marks.lines.push_back(std::move(line));
    }
}

// Those of `region` that it holds no face of, and none beside.
void add_loose_vertices(const DrawnMesh& drawn, const Region& region, const Color& color,
                        Overlay& marks) {
    const Topology& topology = drawn.mesh->topology();
    std::vector<char> held(topology.vertex_count(), 0);
    for (const Index f : region.faces()) {
        for (const Index v : topology.face(f)) held[v] = 1;
    }
    for (const Index v : region.vertices()) {
        const auto ring = topology.neighbors(v);
        const bool beside =
            std::any_of(ring.begin(), ring.end(), [&](Index n) { return held[n] != 0; });
        if (held[v] || beside) continue;
        marks.points.push_back(
            {drawn.transform(drawn.mesh->position(v)), color, 1.5 * drawn.style.line_width});
    }
}

// Normals that are drawn of one kind.
constexpr std::size_t kMaxNormals = 30000;
constexpr double kNormalWidth = 1.5;

// Lines from `begins` along `normals` of the mesh.
void add_normals(const DrawnMesh& drawn, const std::vector<Vec3>& begins,
                 const std::vector<Vec3>& normals, const Color& color, Overlay& marks) {
    const double length = 0.5 * mean_edge_length(*drawn.mesh) *
                          std::cbrt(std::abs(drawn.transform.linear.determinant()));
    const Mat3 turned = drawn.transform.linear.inverse().transpose();
    const std::size_t stride = begins.size() / kMaxNormals + 1;
    for (std::size_t i = 0; i < begins.size(); i += stride) {
        const Vec3 begin = drawn.transform(begins[i]);
        const Vec3 end = begin + length * (turned * normals[i]).normalized();
        if (end.allFinite()) marks.lines.push_back({{begin, end}, false, color, kNormalWidth});
    }
}

std::vector<Vec3> face_middles(const Mesh& mesh) {
    std::vector<Vec3> middles;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        Vec3 sum = Vec3::Zero();
        for (const Index v : face) sum += mesh.position(v);
        middles.push_back(sum / static_cast<double>(face.size()));
    }
    return middles;
}

}  // namespace

Overlay build_marks(const DrawnMesh& drawn) {
    Overlay marks;
    if (drawn.style.boundaries) add_boundaries(drawn, marks);
    const Mesh& mesh = *drawn.mesh;
    const MeshStyle& style = drawn.style;
    for (const Region& handle : style.handles) {
        add_loose_vertices(drawn, handle, style.handle_color, marks);
    }
    for (const DrawnRegion& part : style.parts) {
        add_loose_vertices(drawn, part.region, part.color, marks);
    }
    if (style.vertex_normals) {
        add_normals(drawn, {mesh.positions().begin(), mesh.positions().end()}, vertex_normals(mesh),
                    kVertexNormalColor, marks);
    }
    if (style.face_normals) {
        add_normals(drawn, face_middles(mesh), face_normals(mesh), kFaceNormalColor, marks);
    }
    return marks;
}

std::optional<ValueRange> range_of_values(const std::vector<DrawnMesh>& meshes) {
    ValueRange range{std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
    for (const DrawnMesh& drawn : meshes) {
        for (const double value : drawn.style.values) {
            if (!std::isfinite(value)) continue;
            range.low = std::min(range.low, value);
            range.high = std::max(range.high, value);
        }
    }
    if (range.low > range.high) return std::nullopt;
    return range;
}

}  // namespace lissom
