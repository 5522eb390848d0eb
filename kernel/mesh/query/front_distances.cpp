#include "kernel/mesh/query/front_distances.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "kernel/core/roots.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

constexpr double kBehindFront = std::numeric_limits<double>::infinity();
constexpr std::size_t kStepsBetweenChecks = 4096;
// A smaller gain, relative to the distance, is rounding, which could loop endlessly.
constexpr double kMinGain = 1e-10;

// The distance to `corner` of a source that is as far from two points as they say, on the other
// side of the line through them; infinity if there is none, or the way to it does not run between
// them.
double through_side(const Vec3& corner, const Vec3& from, double from_distance, const Vec3& to,
                    double to_distance) {
    const Vec3 side = to - from, edge = corner - from;
    const double length = side.norm();
    if (length == 0.0) return kBehindFront;
    const auto layout = [&](double along, double squared) {
        return Vec2(along, std::sqrt(std::max(0.0, squared - along * along)));
    };
    const double along =
        0.5 * (length + (from_distance - to_distance) * (from_distance + to_distance) / length);
    const double height = from_distance * from_distance - along * along;
    // A corner of the triangle that is the source itself has height 0, up to rounding.
    if (height < -1e-9 * length * length) return kBehindFront;
    const Vec2 source = layout(along, from_distance * from_distance);
    const Vec2 seen = layout(edge.dot(side) / length, edge.squaredNorm());
    const double depth = source.y() + seen.y();
    if (depth == 0.0) return kBehindFront;
    const double crossing = (source.x() * seen.y() + seen.x() * source.y()) / depth;
    if (crossing < 0.0 || crossing > length) return kBehindFront;
    return hypotenuse(source.x() - seen.x(), depth);
}

class Front {
  public:
    explicit Front(const Mesh& mesh);

    void start(Index v, double distance, Index source) {
        if (distance < distance_[v]) reach(v, distance, source);
    }
    std::vector<double> advance(double limit, const Context& context);

  private:
    void reach(Index v, double distance, Index source);
    void offer(Index v, double distance, Index source);
    void cross(const Triangle& corners, Index v);

    std::span<const Vec3> positions_;
    std::vector<Triangle> triangles_;
    // Triangles around each vertex: around_[first_[v]] .. around_[first_[v + 1] - 1].
    std::vector<Index> first_, around_;
    std::vector<double> distance_;
    // Source of each vertex: two vertices of one triangle agree on its position.
    std::vector<Index> source_;
    std::vector<std::pair<double, Index>> queue_;
};

Front::Front(const Mesh& mesh)
    : positions_(mesh.positions()),
      triangles_(triangulate_faces(mesh.topology(), mesh.positions()).triangles),
      first_(mesh.vertex_count() + 1, 0),
      around_(3 * triangles_.size()),
      distance_(mesh.vertex_count(), kBehindFront),
      source_(mesh.vertex_count(), kNoIndex) {
    for (const Triangle& t : triangles_) {
        for (const Index v : t) ++first_[v + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (Index t = 0; t < count_of(triangles_); ++t) {
        for (const Index v : triangles_[t]) around_[next[v]++] = t;
    }
}

void Front::reach(Index v, double distance, Index source) {
    distance_[v] = distance;
    source_[v] = source;
    queue_.emplace_back(distance, v);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void Front::offer(Index v, double distance, Index source) {
    if (distance < distance_[v] * (1.0 - kMinGain)) reach(v, distance, source);
}

// The way to the other two corners of a triangle: along the side from v, and through a side at v.
void Front::cross(const Triangle& corners, Index v) {
    for (int i = 0; i < 3; ++i) {
        const Index to = corners[i];
        if (to == v) continue;
        const Index other = corners[0] + corners[1] + corners[2] - to - v;
        const Vec3 &at = positions_[to], &from = positions_[v];
        offer(to, distance_[v] + (at - from).norm(), source_[v]);
        if (source_[other] != source_[v]) continue;
        const double across =
            through_side(at, from, distance_[v], positions_[other], distance_[other]);
        offer(to, across, source_[v]);
    }
}

std::vector<double> Front::advance(double limit, const Context& context) {
    for (std::size_t steps = 1; !queue_.empty(); ++steps) {
        if (steps % kStepsBetweenChecks == 0) context.checkpoint();
        std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
        const auto [distance, v] = queue_.back();
        queue_.pop_back();
        if (distance > limit) break;
        if (distance > distance_[v]) continue;
        for (Index i = first_[v]; i < first_[v + 1]; ++i) cross(triangles_[around_[i]], v);
    }
    for (double& d : distance_) {
        if (d > limit) d = kBehindFront;
    }
    return std::move(distance_);
}

void require_limit(double limit) {
    if (limit >= 0.0) return;
    throw Error(ErrorCode::invalid_argument, "the limit of a distance must be 0 or more");
}

}  // namespace

std::vector<double> front_distances(const Mesh& mesh, std::span<const Index> sources, double limit,
                                    const Context& context) {
    require_vertices(mesh.topology(), sources);
    require_limit(limit);
    if (sources.empty()) {
        throw Error(ErrorCode::invalid_argument, "distances need at least one source");
    }
    Front front(mesh);
    for (const Index v : sources) front.start(v, 0.0, v);
    return front.advance(limit, context);
}

std::vector<double> front_distances(const Mesh& mesh, const SurfacePoint& point, double limit,
                                    const Context& context) {
    require_vertices(mesh.topology(), point.triangle);
    require_limit(limit);
    Front front(mesh);
    for (const Index corner : point.triangle) {
        front.start(corner, (mesh.position(corner) - point.position).norm(), 0);
    }
    return front.advance(limit, context);
}

}  // namespace lissom
