#include "kernel/mesh/query/spatial_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "kernel/mesh/query/nearest_on_triangle.h"

namespace lissom {
namespace {

// Rounding error of distances, as a fraction of them; an upper bound far below visible sizes.
constexpr double kBoxRounding = 1e-13;
// Points that are as near as this fraction of a surface's size are at one place.
constexpr double kSamePlace = 1e-9;

double squared_distance(const Box& box, const Vec3& p) {
    return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).squaredNorm();
}

// The edge function of two sheared points. Both triangles at an edge see the same value with
// opposite signs for every compiler, because the vertices are taken in one order.
double edge_function(Index a, const Vec3& pa, Index b, const Vec3& pb) {
    if (a > b) return -edge_function(b, pb, a, pa);
    return pa.x() * pb.y() - pa.y() * pb.x();
}

void require_finite(const Vec3& v, const char* what) {
    if (v.allFinite()) return;
    throw Error(ErrorCode::not_finite, std::string(what) + " is NaN or infinite");
}

}  // namespace

// A ray prepared for the tests: its main axis as z, the shear that turns it into that axis, and the
// error of a hit by rounding.
struct SpatialTree::Line {
    Vec3 origin, direction, inverse;
    std::array<int, 3> axis{};
    double shear_x = 0.0, shear_y = 0.0, padding = 0.0;

    Line(const Vec3& from, const Vec3& towards, const Box& box) : origin(from) {
        require_finite(from, "the origin of the ray");
        require_finite(towards, "the direction of the ray");
        const double largest = towards.cwiseAbs().maxCoeff(&axis[2]);
        if (!(largest > 0.0)) {
            throw Error(ErrorCode::invalid_argument, "the direction of the ray has no length");
        }
        direction = (towards / largest).normalized();
        inverse = direction.cwiseInverse();
        axis[0] = (axis[2] + 1) % 3;
        axis[1] = (axis[2] + 2) % 3;
        shear_x = direction[axis[0]] / direction[axis[2]];
        shear_y = direction[axis[1]] / direction[axis[2]];
        padding = kBoxRounding * (box.diagonal() + (box.center() - origin).norm());
    }

    // Returns the entry of the ray into the box, or infinity if it misses it.
    double entry(const Box& box) const {
        double in = 0.0, out = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            const double low = box.min[k] - padding - origin[k];
            const double high = box.max[k] + padding - origin[k];
            if (direction[k] == 0.0) {
                if (low > 0.0 || high < 0.0) return std::numeric_limits<double>::infinity();
                continue;
            }
            const double a = low * inverse[k], b = high * inverse[k];
            in = std::max(in, std::min(a, b));
            out = std::min(out, std::max(a, b));
        }
        return in <= out * (1.0 + kBoxRounding) ? in * (1.0 - kBoxRounding)
                                                : std::numeric_limits<double>::infinity();
    }

    // Returns a point in the sheared frame, with the ray as the z axis.
    Vec3 shear(const Vec3& p) const {
        const Vec3 d = p - origin;
        return {d[axis[0]] - shear_x * d[axis[2]], d[axis[1]] - shear_y * d[axis[2]], d[axis[2]]};
    }
};

SpatialTree::SpatialTree(const Mesh& mesh, const Context& context)
    : positions_(mesh.positions().begin(), mesh.positions().end()),
      topology_(mesh.shared_topology()),
      revision_(mesh.revision()) {
    if (mesh.face_count() == 0) {
        throw Error(ErrorCode::mesh_empty, "a spatial tree needs a mesh with faces");
    }
    Progress progress(context, "spatial tree");
    // A box for each triangle, and lists that are sorted.
    constexpr std::size_t kBytesPerCorner = 64;
    const MemoryCharge working =
        context.charge(kBytesPerCorner * at(mesh.topology().corner_count()), "a spatial tree");
    Triangulation triangulation = triangulate_faces(mesh.topology(), mesh.positions());
    triangles_ = std::move(triangulation.triangles);
    faces_ = std::move(triangulation.face);
    build(context);
}

SpatialTree::SpatialTree(std::vector<Vec3> positions, std::vector<Triangle> triangles,
                         const Context& context)
    : positions_(std::move(positions)),
      triangles_(std::move(triangles)),
      faces_(triangles_.size()) {
    if (triangles_.empty()) {
        throw Error(ErrorCode::mesh_empty, "a spatial tree needs triangles");
    }
    std::iota(faces_.begin(), faces_.end(), 0);
    build(context);
}

void SpatialTree::build(const Context& context) {
    std::vector<Box> boxes(triangles_.size());
    for (std::size_t t = 0; t < boxes.size(); ++t) boxes[t] = box_of(index_of(t));
    boxes_ = BoxTree(boxes, context);
    charge_ = context.charge(memory_bytes(), "a spatial tree");
}

void SpatialTree::refit(const Mesh& mesh, const Context& context) {
    if (!topology_ || mesh.shared_topology() != topology_) {
        throw Error(ErrorCode::topology_mismatch,
                    "the mesh has another topology than the one that the spatial tree was built "
                    "for; build a new tree");
    }
    // How polygons are divided depends on the shape, but not into how many triangles.
    std::optional<Triangulation> divided;
    if (!topology_->is_triangle_mesh()) divided = triangulate_faces(*topology_, mesh.positions());
    context.checkpoint();
    if (divided) triangles_ = std::move(divided->triangles);
    std::copy(mesh.positions().begin(), mesh.positions().end(), positions_.begin());
    boxes_.refit([this](Index triangle) { return box_of(triangle); });
    revision_ = mesh.revision();
}

Box SpatialTree::box_of(Index triangle) const {
    Box box;
    for (const Index v : triangles_[triangle]) box.extend(positions_[v]);
    return box;
}

std::optional<SpatialTree::Hit> SpatialTree::nearest_triangle(const Vec3& point,
                                                              double limit) const {
    require_finite(point, "the point");
    Hit best;
    double best_square = limit * limit;
    std::array<std::pair<double, Index>, BoxTree::kStackSize> stack;
    std::size_t size = 0;
    stack[size++] = {squared_distance(bounds(), point), 0};
    while (size > 0) {
        const auto [lower_bound, at] = stack[--size];
        if (lower_bound > best_square * (1.0 + kBoxRounding)) continue;
        const BoxTree::Node& node = boxes_.node(at);
        for (const Index t : boxes_.items(node)) {
            const auto [a, b, c] = triangles_[t];
            const auto candidate =
                nearest_on_triangle({positions_[a], positions_[b], positions_[c]}, point);
            const double square = candidate.squared_distance;
            const bool first =
                best.triangle == kNoIndex ? square <= best_square : t < best.triangle;
            if (square < best_square || (square == best_square && first)) {
                best = {t, candidate.barycentric, std::sqrt(square)};
                best_square = square;
            }
        }
        if (node.count > 0) continue;
        // The nearer child is put on top.
        std::pair<double, Index> near{squared_distance(boxes_.node(node.first).box, point),
                                      node.first};
        std::pair<double, Index> far{squared_distance(boxes_.node(node.first + 1).box, point),
                                     node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    if (best.triangle == kNoIndex) return std::nullopt;
    return best;
}

SurfacePoint SpatialTree::nearest(const Vec3& point) const {
    const auto hit = nearest_triangle(point, std::numeric_limits<double>::infinity());
    if (!hit || !std::isfinite(hit->distance)) {
        throw Error(ErrorCode::not_finite,
                    "squares of distances between the point and the surface are beyond the range "
                    "of numbers; bring both to a size below 1e150");
    }
    return surface_point(*hit);
}

std::optional<SurfacePoint> SpatialTree::nearest_within(const Vec3& point, double limit) const {
    const std::optional<Hit> hit = nearest_triangle(point, limit);
    if (!hit || !(limit >= 0.0)) return std::nullopt;
    return surface_point(*hit);
}

std::optional<SpatialTree::Hit> SpatialTree::hit_triangle(Index triangle, const Line& ray) const {
    const auto [a, b, c] = triangles_[triangle];
    const Vec3 pa = ray.shear(positions_[a]), pb = ray.shear(positions_[b]),
               pc = ray.shear(positions_[c]);
    const Vec3 weight(edge_function(b, pb, c, pc), edge_function(c, pc, a, pa),
                      edge_function(a, pa, b, pb));
    if (weight.minCoeff() < 0.0 && weight.maxCoeff() > 0.0) return std::nullopt;
    const double sum = weight.sum();
    if (sum == 0.0) return std::nullopt;
    const Vec3 barycentric = weight / sum;
    const double depth = barycentric.dot(Vec3(pa.z(), pb.z(), pc.z()));
    const double distance = depth / ray.direction[ray.axis[2]];
    if (!(distance >= 0.0)) return std::nullopt;
    return Hit{triangle, barycentric, distance};
}

// Calls visit(hit) for all hits in boxes that the ray enters before `limit`, which visit may lower.
template <typename Visit>
void SpatialTree::visit_along(const Line& ray, const double& limit, const Visit& visit) const {
    std::array<std::pair<double, Index>, BoxTree::kStackSize> stack;
    std::size_t size = 0;
    stack[size++] = {ray.entry(bounds()), 0};
    while (size > 0) {
        const auto [entry, at] = stack[--size];
        if (!(entry <= limit) || !std::isfinite(entry)) continue;
        const BoxTree::Node& node = boxes_.node(at);
        for (const Index t : boxes_.items(node)) {
            if (const std::optional<Hit> hit = hit_triangle(t, ray)) visit(*hit);
        }
        if (node.count > 0) continue;
        std::pair<double, Index> near{ray.entry(boxes_.node(node.first).box), node.first};
        std::pair<double, Index> far{ray.entry(boxes_.node(node.first + 1).box), node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
}

// Twice the area of a triangle, along its normal.
Vec3 SpatialTree::area_normal(Index triangle) const {
    const auto [a, b, c] = triangles_[triangle];
    return (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]);
}

std::optional<SurfacePoint> SpatialTree::pick(const Vec3& origin, const Vec3& direction,
                                              const RayOptions& options) const {
    const Line ray(origin, direction, bounds());
    Hit best;
    best.distance = options.limit;
    visit_along(ray, best.distance, [&](const Hit& hit) {
        if (!(hit.distance <= best.distance)) return;
        if (hit.distance == best.distance && best.triangle != kNoIndex &&
            hit.triangle > best.triangle) {
            return;
        }
        if (!options.back_faces && area_normal(hit.triangle).dot(ray.direction) >= 0.0) return;
        best = hit;
    });
    if (best.triangle == kNoIndex) return std::nullopt;
    return surface_point(best);
}

bool SpatialTree::hides(const Vec3& point, const Vec3& towards, const HideOptions& options) const {
    const Line ray(point, towards, bounds());
    const double coordinates =
        std::max(bounds().min.cwiseAbs().maxCoeff(), bounds().max.cwiseAbs().maxCoeff());
    const double rounding = kSamePlace * bounds().diagonal() +
                            8.0 * std::numeric_limits<double>::epsilon() * coordinates;
    const double touching = std::max(options.touching, rounding);
    bool hidden = false;
    double limit = options.eye;
    visit_along(ray, limit, [&](const Hit& hit) {
        if (!(hit.distance <= limit) || hit.distance <= options.slack) return;
        const auto [a, b, c] = triangles_[hit.triangle];
        const std::array corners{positions_[a], positions_[b], positions_[c]};
        // Most query points lie at a corner.
        const auto touches = [&](const Vec3& p) {
            return (p - point).squaredNorm() <= touching * touching;
        };
        if (std::any_of(corners.begin(), corners.end(), touches)) return;
        if (!options.back_faces && area_normal(hit.triangle).dot(ray.direction) <= 0.0) return;
        if (nearest_on_triangle(corners, point).squared_distance <= touching * touching) return;
        hidden = true;
        limit = -1.0;
    });
    return hidden;
}

std::vector<SurfacePoint> SpatialTree::pick_all(const Vec3& origin, const Vec3& direction) const {
    const Line ray(origin, direction, bounds());
    std::vector<Hit> hits;
    visit_along(ray, std::numeric_limits<double>::infinity(),
                [&](const Hit& hit) { hits.push_back(hit); });
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
    });
    std::vector<SurfacePoint> points;
    for (const Hit& hit : hits) points.push_back(surface_point(hit));
    return points;
}

SurfacePoint SpatialTree::surface_point(const Hit& hit) const {
    SurfacePoint point;
    point.face = faces_[hit.triangle];
    point.triangle = triangles_[hit.triangle];
    point.barycentric = hit.barycentric;
    point.distance = hit.distance;
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) {
        corners[k] = positions_[point.triangle[k]];
        point.position += hit.barycentric[k] * corners[k];
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const double square = (corners[k] - point.position).squaredNorm();
        const Index v = point.triangle[k];
        if (square > nearest || (square == nearest && v > point.vertex)) continue;
        nearest = square;
        point.vertex = v;
    }
    point.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = point.normal.norm();
    if (length > 0.0) point.normal /= length;
    return point;
}

std::size_t SpatialTree::memory_bytes() const {
    return positions_.size() * sizeof(Vec3) + triangles_.size() * sizeof(Triangle) +
           faces_.size() * sizeof(Index) + boxes_.memory_bytes();
}

}  // namespace lissom
