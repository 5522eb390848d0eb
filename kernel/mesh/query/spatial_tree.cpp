#include "kernel/mesh/query/spatial_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

constexpr Index kLeafSize = 4;
constexpr int kBins = 16;
// Below this depth nodes are halved, so that no path is longer than kStackSize.
constexpr int kMaximumFreeDepth = 48;
constexpr std::size_t kStackSize = 128;
// What rounding may do to distances, as a fraction of them; far above it, far below what is
// visible.
constexpr double kRounding = 1e-13;

double surface(const Box& box) {
    if (box.empty()) return 0.0;
    const Vec3 d = box.max - box.min;
    return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

void extend(Box& box, const Box& other) {
    box.min = box.min.cwiseMin(other.min);
    box.max = box.max.cwiseMax(other.max);
}

double squared_distance(const Box& box, const Vec3& p) {
    return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).squaredNorm();
}

struct Candidate {
    Vec3 barycentric;
    double squared_distance;
};

Candidate nearest_on_edge(const std::array<Vec3, 3>& corners, int from, const Vec3& p) {
    const int to = (from + 1) % 3;
    const Vec3 along = corners[to] - corners[from];
    const double square = along.squaredNorm();
    const double t =
        square > 0.0 ? std::clamp((p - corners[from]).dot(along) / square, 0.0, 1.0) : 0.0;
    Vec3 barycentric = Vec3::Zero();
    barycentric[from] = 1.0 - t;
    barycentric[to] = t;
    return {barycentric, (corners[from] + t * along - p).squaredNorm()};
}

// The foot of the perpendicular where it lies inside, else the nearest point of an edge; the latter
// also where the triangle has no area worth the name.
Candidate nearest_on_triangle(const std::array<Vec3, 3>& corners, const Vec3& p) {
    const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], ap = p - corners[0];
    const Vec3 normal = ab.cross(ac);
    const double square = normal.squaredNorm();
    if (square > kRounding * kRounding * ab.squaredNorm() * ac.squaredNorm()) {
        const double b = ap.cross(ac).dot(normal) / square, c = ab.cross(ap).dot(normal) / square;
        if (b >= 0.0 && c >= 0.0 && b + c <= 1.0) {
            const Vec3 foot = corners[0] + b * ab + c * ac;
            return {{1.0 - b - c, b, c}, (foot - p).squaredNorm()};
        }
    }
    Candidate best = nearest_on_edge(corners, 0, p);
    for (const int from : {1, 2}) {
        const Candidate other = nearest_on_edge(corners, from, p);
        if (other.squared_distance < best.squared_distance) best = other;
    }
    return best;
}

// The edge function of two sheared points. Both triangles at an edge see the same value with
// opposite signs, whatever the compiler makes of the products, because the vertices are taken in
// one order.
double edge_function(Index a, const Vec3& pa, Index b, const Vec3& pb) {
    if (a > b) return -edge_function(b, pb, a, pa);
    return pa.x() * pb.y() - pa.y() * pb.x();
}

void require_finite(const Vec3& v, const char* what) {
    if (v.allFinite()) return;
    throw Error(ErrorCode::not_finite, std::string(what) + " is NaN or infinite");
}

}  // namespace

// A ray with what each test needs: the axis it runs along most as z, the shear that turns it into
// that axis, and how far rounding may move a hit.
struct SpatialTree::Ray {
    Vec3 origin, direction, inverse;
    std::array<int, 3> axis{};
    double shear_x = 0.0, shear_y = 0.0, padding = 0.0;

    Ray(const Vec3& from, const Vec3& towards, const Box& box) : origin(from) {
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
        padding = kRounding * (box.diagonal() + (box.center() - origin).norm());
    }

    // Where the ray enters the box, or infinity where it misses it.
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
        return in <= out * (1.0 + kRounding) ? in * (1.0 - kRounding)
                                             : std::numeric_limits<double>::infinity();
    }

    // A point in the sheared frame, where the ray is the z axis.
    Vec3 shear(const Vec3& p) const {
        const Vec3 d = p - origin;
        return {d[axis[0]] - shear_x * d[axis[2]], d[axis[1]] - shear_y * d[axis[2]], d[axis[2]]};
    }
};

SpatialTree::SpatialTree(const Mesh& mesh, const Context& context)
    : positions_(mesh.positions().begin(), mesh.positions().end()), revision_(mesh.revision()) {
    if (mesh.face_count() == 0) {
        throw Error(ErrorCode::mesh_empty, "a spatial tree needs a mesh with faces");
    }
    Triangulation triangulation = triangulate_faces(mesh.topology(), mesh.positions());
    triangles_ = std::move(triangulation.triangles);
    faces_ = std::move(triangulation.face);
    build(context);
    charge_ = context.charge(memory_bytes(), "a spatial tree");
}

void SpatialTree::build(const Context& context) {
    Progress progress(context, "spatial tree");
    std::vector<Box> boxes(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (const Index v : triangles_[t]) boxes[t].extend(positions_[v]);
    }
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), 0);

    std::vector<std::pair<Index, int>> open{{0, 0}};
    nodes_.push_back({{}, 0, count_of(order_)});
    for (std::size_t steps = 0; !open.empty(); ++steps) {
        if (steps % 4096 == 0) context.checkpoint();
        const auto [at, depth] = open.back();
        open.pop_back();
        Node node = nodes_[at];
        for (Index i = 0; i < node.count; ++i) extend(node.box, boxes[order_[node.first + i]]);
        nodes_[at].box = node.box;
        if (node.count <= kLeafSize) continue;
        const Index middle = split(node, order_, boxes, depth >= kMaximumFreeDepth);
        const auto children = count_of(nodes_);
        nodes_.push_back({{}, node.first, middle - node.first});
        nodes_.push_back({{}, middle, node.first + node.count - middle});
        nodes_[at].first = children;
        nodes_[at].count = 0;
        open.emplace_back(children, depth + 1);
        open.emplace_back(children + 1, depth + 1);
    }
}

// Divides the triangles of a node by the surface area heuristic over bins of box centers (Wald
// 2007), or in two halves where that finds nothing or `halve` is asked for. Returns where the
// second part begins.
Index SpatialTree::split(const Node& node, std::vector<Index>& order, const std::vector<Box>& boxes,
                         bool halve) const {
    const auto begin = order.begin() + node.first, end = begin + node.count;
    Box centers;
    for (auto i = begin; i != end; ++i) centers.extend(boxes[*i].center());
    int axis = 0;
    const double extent = (centers.max - centers.min).maxCoeff(&axis);
    const auto bin_of = [&](Index t) {
        const double where = (boxes[t].center()[axis] - centers.min[axis]) / extent;
        return std::min(kBins - 1, static_cast<int>(where * kBins));
    };
    int best = 0;
    if (extent > 0.0 && !halve) {
        std::array<Box, kBins> bin_box;
        std::array<Index, kBins> bin_count{};
        for (auto i = begin; i != end; ++i) {
            extend(bin_box[bin_of(*i)], boxes[*i]);
            ++bin_count[bin_of(*i)];
        }
        std::array<double, kBins> cost{};
        Box left, right;
        for (int b = 1, n = 0; b < kBins; ++b) {
            extend(left, bin_box[b - 1]);
            n += bin_count[b - 1];
            cost[b] = surface(left) * n;
        }
        for (int b = kBins - 1, n = 0; b > 0; --b) {
            extend(right, bin_box[b]);
            n += bin_count[b];
            cost[b] += surface(right) * n;
            const bool divides = n > 0 && n < node.count;
            if (divides && (best == 0 || cost[b] < cost[best])) best = b;
        }
    }
    if (best > 0) {
        const auto middle =
            std::stable_partition(begin, end, [&](Index t) { return bin_of(t) < best; });
        return node.first + index_of(middle - begin);
    }
    const auto middle = begin + node.count / 2;
    std::nth_element(begin, middle, end, [&](Index a, Index b) {
        const double at_a = boxes[a].center()[axis], at_b = boxes[b].center()[axis];
        return at_a != at_b ? at_a < at_b : a < b;
    });
    return node.first + node.count / 2;
}

std::optional<SpatialTree::Hit> SpatialTree::nearest_triangle(const Vec3& point,
                                                              double limit) const {
    require_finite(point, "the point");
    Hit best;
    double best_square = limit * limit;
    std::array<std::pair<double, Index>, kStackSize> stack;
    std::size_t size = 0;
    stack[size++] = {squared_distance(nodes_[0].box, point), 0};
    while (size > 0) {
        const auto [lower_bound, at] = stack[--size];
        if (lower_bound > best_square * (1.0 + kRounding)) continue;
        const Node& node = nodes_[at];
        for (Index i = 0; i < node.count; ++i) {
            const Index t = order_[node.first + i];
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
        std::pair<double, Index> near{squared_distance(nodes_[node.first].box, point), node.first};
        std::pair<double, Index> far{squared_distance(nodes_[node.first + 1].box, point),
                                     node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    if (best.triangle == kNoIndex) return std::nullopt;
    return best;
}

SurfacePoint SpatialTree::nearest(const Vec3& point) const {
    return surface_point(*nearest_triangle(point, std::numeric_limits<double>::infinity()));
}

std::optional<SurfacePoint> SpatialTree::nearest_within(const Vec3& point, double limit) const {
    const std::optional<Hit> hit = nearest_triangle(point, limit);
    if (!hit || !(limit >= 0.0)) return std::nullopt;
    return surface_point(*hit);
}

std::optional<SpatialTree::Hit> SpatialTree::hit_triangle(Index triangle, const Ray& ray) const {
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
void SpatialTree::visit_along(const Ray& ray, const double& limit, const Visit& visit) const {
    std::array<std::pair<double, Index>, kStackSize> stack;
    std::size_t size = 0;
    stack[size++] = {ray.entry(nodes_[0].box), 0};
    while (size > 0) {
        const auto [entry, at] = stack[--size];
        if (!(entry <= limit) || !std::isfinite(entry)) continue;
        const Node& node = nodes_[at];
        for (Index i = 0; i < node.count; ++i) {
            if (const std::optional<Hit> hit = hit_triangle(order_[node.first + i], ray))
                visit(*hit);
        }
        if (node.count > 0) continue;
        std::pair<double, Index> near{ray.entry(nodes_[node.first].box), node.first};
        std::pair<double, Index> far{ray.entry(nodes_[node.first + 1].box), node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
}

std::optional<SurfacePoint> SpatialTree::pick(const Vec3& origin, const Vec3& direction) const {
    const Ray ray(origin, direction, nodes_[0].box);
    Hit best;
    best.distance = std::numeric_limits<double>::infinity();
    visit_along(ray, best.distance, [&](const Hit& hit) {
        if (hit.distance > best.distance) return;
        if (hit.distance == best.distance && hit.triangle > best.triangle) return;
        best = hit;
    });
    if (best.triangle == kNoIndex) return std::nullopt;
    return surface_point(best);
}

std::vector<SurfacePoint> SpatialTree::pick_all(const Vec3& origin, const Vec3& direction) const {
    const Ray ray(origin, direction, nodes_[0].box);
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

Box SpatialTree::bounds() const {
    return nodes_[0].box;
}

std::size_t SpatialTree::memory_bytes() const {
    return positions_.size() * sizeof(Vec3) + triangles_.size() * sizeof(Triangle) +
           (faces_.size() + order_.size()) * sizeof(Index) + nodes_.size() * sizeof(Node);
}

}  // namespace lissom
