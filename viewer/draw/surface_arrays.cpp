#include "viewer/draw/surface_arrays.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/triangulation.h"
#include "viewer/draw/colormap.h"
#include "viewer/draw/shading_normals.h"

namespace lissom {
namespace {

constexpr Index kGrain = 4096;

using Bytes = std::array<std::uint8_t, 4>;

std::array<float, 3> to_floats(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void require_values(const Mesh& mesh, const std::vector<double>& values) {
    if (values.empty() || values.size() == static_cast<std::size_t>(mesh.vertex_count())) return;
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
          paint_(static_cast<std::size_t>(mesh.face_count()), Paint::own) {
        if (attribute_ && attribute_->width < 3) attribute_ = nullptr;
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
    enum class Paint : char { own, region, handle, value, no_value };

    void paint_faces(const Region& region, Paint paint, std::string_view what) {
        require_same_topology(mesh_, region.topology(), what);
        for (const Index f : region.faces()) paint_[f] = paint;
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

std::vector<Vec3> transformed(std::span<const Vec3> positions, const Affine& transform) {
    std::vector<Vec3> result;
    result.reserve(positions.size());
    for (const Vec3& p : positions) result.push_back(transform(p));
    return result;
}

// A normal for every corner, towards the outside.
std::vector<Vec3> normals_for(const Topology& topology, std::span<const Vec3> positions,
                              const MeshStyle& style, const Context& context) {
    if (style.shading == Shading::smooth) {
        return corner_normals(topology, positions, style.crease, context);
    }
    const std::vector<Vec3> of_face = face_normals(topology, positions, context);
    std::vector<Vec3> result;
    result.reserve(static_cast<std::size_t>(topology.corner_count()));
    for (Index f = 0; f < topology.face_count(); ++f) {
        result.insert(result.end(), topology.face(f).size(), of_face[f]);
    }
    return result;
}

float place_on_scale(double value, const ValueRange& range) {
    const double extent = range.high - range.low;
    return static_cast<float>(extent > 0.0 ? (value - range.low) / extent : 0.5);
}

// Turns a triangle round, so that it is seen from its other side.
void turn_round(SurfaceVertex* triangle) {
    constexpr std::uint32_t kSwapped = 6;
    std::swap(triangle[1], triangle[2]);
    for (int i = 0; i < 3; ++i) {
        std::uint32_t& flags = triangle[i].flags;
        flags = (flags & ~kSwapped) | ((flags & 2) << 1) | ((flags & 4) >> 1);
        for (float& part : triangle[i].normal) part = -part;
    }
}

}  // namespace

std::vector<SurfaceVertex> build_surface(const Mesh& mesh, const MeshStyle& style,
                                         const Affine& to_picture, const ValueRange& range,
                                         const Context& context) {
    require_values(mesh, style.values);
    const Topology& topology = mesh.topology();
    const SurfaceColors colors(mesh, style);
    const std::vector<Vec3> positions = transformed(mesh.positions(), to_picture);
    const Triangulation triangulation = triangulate_faces(topology, positions);
    const std::vector<Vec3> normals = normals_for(topology, positions, style, context);
    const bool mirrored = to_picture.linear.determinant() < 0.0;

    const Index count = static_cast<Index>(triangulation.triangles.size());
    std::vector<SurfaceVertex> vertices(3 * static_cast<std::size_t>(count));
    context.parallel_for(0, count, kGrain, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            const Index face = triangulation.face[t];
            const Triangle& corners = triangulation.corners[t];
            const Index sides = static_cast<Index>(topology.face(face).size());
            const std::uint32_t flags = edge_flags(corners, topology.first_corner(face), sides) |
                                        (colors.has_values(face) ? kValueFlag : 0u);
            SurfaceVertex* const triangle = vertices.data() + 3 * static_cast<std::size_t>(t);
            for (int i = 0; i < 3; ++i) {
                const Index v = triangulation.triangles[t][i];
                const float value =
                    style.values.empty() ? 0.0f : place_on_scale(style.values[v], range);
                triangle[i] = {to_floats(positions[v]), to_floats(normals[corners[i]]),
                               colors.at(face, corners[i], v), value, flags};
            }
            if (mirrored) turn_round(triangle);
        }
    });
    return vertices;
}

namespace {

void add_boundaries(const DrawnMesh& drawn, SurfaceMarks& marks) {
    const auto& loops = drawn.mesh->topology().boundary_loops();
    for (std::size_t i = 0; i < loops.size(); ++i) {
        DrawnLine line{{}, true, category_color(i), drawn.style.line_width};
        for (const Index v : loops[i]) {
            line.points.push_back(drawn.transform(drawn.mesh->position(v)));
        }
        marks.lines.push_back(std::move(line));
    }
}

void add_loose_vertices(const DrawnMesh& drawn, const Region& handle, SurfaceMarks& marks) {
    const Topology& topology = drawn.mesh->topology();
    std::vector<char> held(static_cast<std::size_t>(topology.vertex_count()), 0);
    for (const Index f : handle.faces()) {
        for (const Index v : topology.face(f)) held[v] = 1;
    }
    for (const Index v : handle.vertices()) {
        if (held[v]) continue;
        marks.points.push_back({drawn.transform(drawn.mesh->position(v)), drawn.style.handle_color,
                                1.5 * drawn.style.line_width});
    }
}

}  // namespace

SurfaceMarks build_marks(const DrawnMesh& drawn) {
    SurfaceMarks marks;
    if (drawn.style.boundaries) add_boundaries(drawn, marks);
    for (const Region& handle : drawn.style.handles) add_loose_vertices(drawn, handle, marks);
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
