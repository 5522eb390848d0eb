#include "kernel/mesh/measure/measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "kernel/core/hasher.h"
#include "kernel/mesh/measure/flat_face.h"
#include "kernel/mesh/measure/normals_in_place.h"
#include "kernel/mesh/measure/scale.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

Vec3 mean(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return points.empty() ? sum : Vec3(sum / count_of(points));
}

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

double longest_edge_squared(const Mesh& mesh, Index f) {
    const std::span<const Index> face = mesh.topology().face(f);
    double longest = 0.0;
    Index last = face.back();
    for (const Index v : face) {
        longest = std::max(longest, (mesh.position(v) - mesh.position(last)).squaredNorm());
        last = v;
    }
    return longest;
}

// Areas of faces: of the triangles that they are split into.
class FaceArea {
  public:
    explicit FaceArea(const Mesh& mesh) : mesh_(mesh) {}

    double of(Index f) {
        const std::span<const Index> face = mesh_.topology().face(f);
        if (face.size() == 3) return triangle(face, {0, 1, 2});
        points_.clear();
        triangles_.clear();
        for (const Index v : face) points_.push_back(mesh_.position(v));
        triangulate_polygon(points_, triangles_);
        double sum = 0.0;
        for (const Triangle& t : triangles_) sum += triangle(face, t);
        return sum;
    }

  private:
    double triangle(std::span<const Index> face, const Triangle& t) const {
        return triangle_area(mesh_.position(face[t[0]]), mesh_.position(face[t[1]]),
                             mesh_.position(face[t[2]]));
    }

    const Mesh& mesh_;
    std::vector<Vec3> points_;
    std::vector<Triangle> triangles_;
};

struct Surface {
    double area = 0.0;
    Vec3 centroid = Vec3::Zero();
};

// Moments are taken about a point of the mesh, so that a far offset from the origin costs no
// digits.
Surface surface_of(const Mesh& mesh, const Triangulation& surface) {
    Surface result;
    const Vec3 origin = mesh.position(0);
    for (const Triangle& t : surface.triangles) {
        const Vec3 a = mesh.position(t[0]) - origin, b = mesh.position(t[1]) - origin,
                   c = mesh.position(t[2]) - origin;
        const double weight = triangle_area(a, b, c);
        result.area += weight;
        result.centroid += weight / 3.0 * (a + b + c);
    }
    if (result.area > 0.0) {
        result.centroid = origin + result.centroid / result.area;
    } else {
        result.centroid = mean(mesh.positions());
    }
    return result;
}

// The unit normal of a polygon whose k-th corner is `corner(k)`; nothing if its size is too far
// from 1 for products of lengths.
template <typename Corner>
std::optional<Vec3> measured_normal(std::size_t count, const Corner& corner) {
    Vec3 area = Vec3::Zero();
    double longest = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 next = corner((k + 1) % count);
        area += 0.5 * (corner(k) - corner(0)).cross(next - corner(0));
        longest = std::max(longest, (next - corner(k)).squaredNorm());
    }
    if (!is_measurable(longest)) return std::nullopt;
    const double size = area.norm();
    return size > kFlatFace * longest ? Vec3(area / size) : Vec3(Vec3::Zero());
}

// The unit normal of a polygon whose k-th corner is `corner(k)`, of any size.
template <typename Corner>
Vec3 normal_of_corners(std::size_t count, const Corner& corner) {
    if (const auto normal = measured_normal(count, corner)) return *normal;
    const double scale = scale_to_unit(count, corner);
    return measured_normal(count, [&](std::size_t k) -> Vec3 { return scale * corner(k); })
        .value_or(Vec3(Vec3::Zero()));
}

}  // namespace

Box bounds(const Mesh& mesh) {
    Box box;
    for (const Vec3& p : mesh.positions()) box.extend(p);
    return box;
}

Box bounds(const Mesh& mesh, const Region& region) {
    require_same_topology(mesh, region.topology(), "the region");
    Box box;
    for (const Index v : region.vertices()) box.extend(mesh.position(v));
    return box;
}

Vec3 center(const Mesh& mesh, const Region& region) {
    require_same_topology(mesh, region.topology(), "the region");
    if (region.empty()) {
        throw Error(ErrorCode::region_empty, "a region without vertices has no center");
    }
    Vec3 sum = Vec3::Zero();
    for (const Index v : region.vertices()) sum += mesh.position(v);
    return sum / count_of(region);
}

Vec3 surface_centroid(const Mesh& mesh) {
    if (mesh.vertex_count() == 0) return Vec3::Zero();
    return surface_of(mesh, triangulate_faces(mesh.topology(), mesh.positions())).centroid;
}

double surface_radius(const Mesh& mesh) {
    if (mesh.vertex_count() == 0) return 0.0;
    const Triangulation triangulation = triangulate_faces(mesh.topology(), mesh.positions());
    const auto [area, centroid] = surface_of(mesh, triangulation);
    double sum = 0.0;
    if (area > 0.0) {
        for (const Triangle& t : triangulation.triangles) {
            const Vec3 a = mesh.position(t[0]) - centroid, b = mesh.position(t[1]) - centroid,
                       c = mesh.position(t[2]) - centroid;
            // The integral of |x|^2 over a triangle is area / 6 times the sum over pairs of
            // corners, which equals area / 12 times the following.
            sum +=
                triangle_area(a, b, c) / 12.0 *
                (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (a + b + c).squaredNorm());
        }
        return std::sqrt(sum / area);
    }
    for (const Vec3& p : mesh.positions()) sum += (p - centroid).squaredNorm();
    return std::sqrt(sum / mesh.vertex_count());
}

std::vector<double> face_areas(const Mesh& mesh) {
    std::vector<double> areas;
    areas.reserve(mesh.face_count());
    FaceArea area(mesh);
    for (Index f = 0; f < mesh.face_count(); ++f) areas.push_back(area.of(f));
    return areas;
}

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (const double face : face_areas(mesh)) sum += face;
    return sum;
}

double volume(const Mesh& mesh) {
    if (mesh.vertex_count() == 0) return 0.0;
    const Vec3 origin = bounds(mesh).center();
    const auto cone = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
    };
    double sum = 0.0;
    for (const Triangle& t : triangulate_faces(mesh.topology(), mesh.positions()).triangles) {
        sum += cone(mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2]));
    }
    for (const std::vector<Index>& loop : mesh.topology().boundary_loops()) {
        Vec3 apex = Vec3::Zero();
        for (const Index v : loop) apex += mesh.position(v) / count_of(loop);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index next = loop[(i + 1) % loop.size()];
            sum += cone(mesh.position(next), mesh.position(loop[i]), apex);
        }
    }
    return sum;
}

Index euler_characteristic(const Topology& topology) {
    Index used = 0;
    for (Index v = 0; v < topology.vertex_count(); ++v) used += topology.is_isolated(v) ? 0 : 1;
    return used - topology.edge_count() + topology.face_count();
}

Index genus(const Topology& topology) {
    Index components = topology.component_count();
    for (Index v = 0; v < topology.vertex_count(); ++v)
        components -= topology.is_isolated(v) ? 1 : 0;
    const auto loops = count_of(topology.boundary_loops());
    return (2 * components - loops - euler_characteristic(topology)) / 2;
}

Vec3 polygon_normal(std::span<const Vec3> corners) {
    return normal_of_corners(corners.size(),
                             [&](std::size_t k) -> const Vec3& { return corners[k]; });
}

double corner_angle(const Vec3& before, const Vec3& corner, const Vec3& after, const Vec3& normal) {
    Vec3 a = after - corner, b = before - corner;
    if (!is_measurable(a.squaredNorm()) || !is_measurable(b.squaredNorm())) {
        const Vec3 points[] = {before, corner, after};
        const double scale = scale_to_unit(3, [&](std::size_t k) { return points[k]; });
        a = (scale * after - scale * corner).stableNormalized();
        b = (scale * before - scale * corner).stableNormalized();
    }
    const double angle = std::atan2(a.cross(b).dot(normal), a.dot(b));
    return angle < 0.0 ? angle + 2.0 * kPi : angle;
}

Vec3 normal_of_face(const Mesh& mesh, Index f) {
    const std::span<const Index> face = mesh.topology().face(f);
    return normal_of_corners(face.size(),
                             [&](std::size_t k) -> const Vec3& { return mesh.position(face[k]); });
}

std::vector<Vec3> face_normals(const Mesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(at(mesh.face_count()));
    for (Index f = 0; f < mesh.face_count(); ++f) normals.push_back(normal_of_face(mesh, f));
    return normals;
}

void find_vertex_normals(const Mesh& mesh, std::span<Vec3> normals) {
    std::fill(normals.begin(), normals.end(), Vec3::Zero());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        const Vec3 of_face = normal_of_face(mesh, f);
        const std::size_t n = face.size();
        for (std::size_t k = 0; k < n; ++k) {
            const double angle =
                corner_angle(mesh.position(face[(k + n - 1) % n]), mesh.position(face[k]),
                             mesh.position(face[(k + 1) % n]), of_face);
            normals[at(face[k])] += angle * of_face;
        }
    }
    for (Vec3& n : normals) {
        const double length = n.norm();
        n = length > 0.0 ? Vec3(n / length) : Vec3::Zero();
    }
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
    std::vector<Vec3> normals(at(mesh.vertex_count()));
    find_vertex_normals(mesh, normals);
    return normals;
}

double mean_edge_length(const Mesh& mesh) {
    const Topology& topology = mesh.topology();
    if (topology.edge_count() == 0) return 0.0;
    double sum = 0.0;
    for (Index e = 0; e < topology.edge_count(); ++e) {
        const auto [a, b] = topology.edge(e);
        sum += (mesh.position(a) - mesh.position(b)).norm();
    }
    return sum / topology.edge_count();
}

std::vector<Index> zero_area_faces(const Mesh& mesh) {
    std::vector<Index> flat;
    FaceArea area(mesh);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (area.of(f) <= kFlatFace * longest_edge_squared(mesh, f)) flat.push_back(f);
    }
    return flat;
}

namespace {

// The order in which attributes were added is not content.
std::vector<const Attribute*> by_name(const AttributeSet& attributes) {
    std::vector<const Attribute*> list;
    for (const Attribute& a : attributes.all()) list.push_back(&a);
    std::sort(list.begin(), list.end(),
              [](const Attribute* a, const Attribute* b) { return a->name < b->name; });
    return list;
}

}  // namespace

std::uint64_t hash(const Mesh& mesh) {
    Hasher hasher;
    hasher.add(mesh.vertex_count());
    for (const Vec3& p : mesh.positions()) {
        for (int k = 0; k < 3; ++k) hasher.add(p[k]);
    }
    hasher.add(mesh.topology().faces().offsets);
    hasher.add(mesh.topology().faces().vertices);
    for (const Attribute* a : by_name(mesh.attributes())) {
        hasher.add(std::string_view(a->name));
        hasher.add(static_cast<Index>(a->domain));
        hasher.add(a->width);
        hasher.add(static_cast<Index>(a->type));
        hasher.add(a->values);
    }
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        hasher.add(std::string_view(kind));
        hasher.add(static_cast<std::uint64_t>(labels.names.size()));
        for (const std::string& name : labels.names) hasher.add(std::string_view(name));
        hasher.add(labels.of_face);
    }
    for (const auto& [name, region] : mesh.regions()) {
        hasher.add(std::string_view(name));
        hasher.add(region.vertices());
    }
    for (const std::string& file : mesh.material_libraries()) hasher.add(std::string_view(file));
    return hasher.value();
}

}  // namespace lissom
