#include "kernel/deform/contact/contact_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "kernel/deform/contact/spread_fans.h"
#include "kernel/mesh/query/triangle_intersection.h"

namespace lissom {
namespace {

// The hierarchy, positions in both precisions and flags.
constexpr std::size_t kContactBytesPerCorner = 140;
// That of SelfIntersectionOptions.
const double kTouching = SelfIntersectionOptions{}.tolerance;
// Triangles on one side of the plane of another, by this share of the extent, are apart.
constexpr double kClearlyApart = 1e-7;

double longest_side(const std::array<Vec3, 3>& corners) {
    double squared = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        squared = std::max(squared, (corners[k] - corners[(k + 1) % 3]).squaredNorm());
    }
    return std::sqrt(squared);
}

// Whether two polygons lie apart along a normal of the first, by more than `distance`.
bool are_apart(std::span<const Vec3> a, std::span<const Vec3> b, double distance) {
    const Vec3 normal = a.size() == 3 ? Vec3((a[1] - a[0]).cross(a[2] - a[0]))
                                      : Vec3((a[2] - a[0]).cross(a[3] - a[1]));
    const double gap = distance * normal.cwiseAbs().sum();
    double low = 0.0, high = 0.0;
    for (std::size_t k = 1; k < a.size(); ++k) {
        const double height = normal.dot(a[k] - a[0]);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vec3& p : b) {
        const double height = normal.dot(p - a[0]);
        least = std::min(least, height);
        most = std::max(most, height);
    }
    return least > high + gap || most < low - gap;
}

}  // namespace

ContactSearch::ContactSearch(std::shared_ptr<const Topology> topology, std::vector<Vec3> rest,
                             const Context& context)
    : topology_(std::move(topology)),
      charge_(context.charge(kContactBytesPerCorner * at(topology_->corner_count()), "contacts")),
      rest_(std::move(rest)),
      tree_(*topology_, rest_, context),
      spread_(at(topology_->vertex_count()), 0) {
    set_parts(std::vector<Index>(rest_.size(), kNoIndex));
    prepare(rest_, context);
    known_ = pairs(context);
}

std::vector<FacePair> ContactSearch::find(std::span<const Vec3> shape, std::span<const Index> part,
                                          const Context& context) {
    if (!std::equal(part.begin(), part.end(), part_.begin(), part_.end())) set_parts(part);
    prepare(shape, context);
    const std::vector<FacePair> found = pairs(context);
    std::vector<FacePair> added;
    std::set_difference(found.begin(), found.end(), known_.begin(), known_.end(),
                        std::back_inserter(added));
    return added;
}

void ContactSearch::set_parts(std::span<const Index> part) {
    part_.clear();
    std::vector<Index> part_of_face(at(topology_->face_count()));
    std::vector<char> is_loose(at(topology_->vertex_count()), 0);
    for (Index f = 0; f < topology_->face_count(); ++f) {
        const auto corners = topology_->face(f);
        Index common = part[at(corners.front())];
        for (const Index v : corners) {
            if (part[at(v)] != common) common = kNoIndex;
        }
        part_of_face[at(f)] = common;
        if (common != kNoIndex) continue;
        for (const Index v : corners) is_loose[at(v)] = 1;
    }
    loose_.clear();
    for (Index v = 0; v < topology_->vertex_count(); ++v) {
        if (is_loose[at(v)]) loose_.push_back(v);
    }
    std::fill(spread_.begin(), spread_.end(), 0);
    tree_.set_parts(part_of_face);
    part_.assign(part.begin(), part.end());
}

void ContactSearch::prepare(std::span<const Vec3> shape, const Context& context) {
    shape_ = shape;
    local_.set(shape, context);
    tree_.fit(local_, context);
    find_spread_fans(*topology_, local_, loose_, spread_, context);
    tree_.set_plain(spread_, context);
}

std::vector<FacePair> ContactSearch::pairs(const Context& context) const {
    const std::vector<FaceTree::Task> tasks = tree_.tasks();
    std::vector<std::vector<FacePair>> found(tasks.size());
    context.parallel_for(0, count_of(tasks), 1, [&](Index begin, Index end) {
        PolygonRoom room;
        for (Index t = begin; t < end; ++t) {
            tree_.visit(tasks[at(t)], [&](Index i, Index j) {
                if (!meet(i, j, room)) return;
                const Index f = tree_.face(i), g = tree_.face(j);
                found[at(t)].push_back({std::min(f, g), std::max(f, g)});
            });
        }
    });
    std::vector<FacePair> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

bool ContactSearch::meet(Index slot, Index other, PolygonRoom& room) const {
    const auto a = tree_.corners(slot), b = tree_.corners(other);
    if (share_spread_fan(a, b)) return false;
    if (a.size() > 3 || b.size() > 3) return polygons_meet(a, b, room);
    return corners_meet(corners_at(a), corners_at(b));
}

bool ContactSearch::share_spread_fan(std::span<const Index> a, std::span<const Index> b) const {
    for (const Index v : a) {
        for (const Index w : b) {
            if (v == w && spread_[at(v)]) return true;
        }
    }
    return false;
}

bool ContactSearch::polygons_meet(std::span<const Index> f, std::span<const Index> g,
                                  PolygonRoom& room) const {
    room.f.set(f, shape_);
    room.g.set(g, shape_);
    const double apart = kClearlyApart * static_cast<double>(local_.extent);
    if (are_apart(room.f.points, room.g.points, apart)) return false;
    if (are_apart(room.g.points, room.f.points, apart)) return false;
    room.f.triangulate(room.room);
    room.g.triangulate(room.room);
    for (const Triangle& a : room.f.triangles) {
        for (const Triangle& b : room.g.triangles) {
            if (corners_meet(room.f.corners(a), room.g.corners(b))) return true;
        }
    }
    return false;
}

void ContactSearch::Polygon::set(std::span<const Index> vertices, std::span<const Vec3> shape) {
    points.clear();
    for (const Index v : vertices) points.push_back(shape[at(v)]);
}

void ContactSearch::Polygon::triangulate(TriangulationRoom& room) {
    triangles.clear();
    triangulate_polygon(points, triangles, room);
}

bool ContactSearch::corners_meet(const Corners& a, const Corners& b) const {
    const double apart = kClearlyApart * static_cast<double>(local_.extent);
    if (are_apart(a, b, apart) || are_apart(b, a, apart)) return false;
    return triangles_meet(a, b, kTouching * std::max(longest_side(a), longest_side(b)));
}

ContactSearch::Corners ContactSearch::corners_at(std::span<const Index> vertices) const {
    return {shape_[at(vertices[0])], shape_[at(vertices[1])], shape_[at(vertices[2])]};
}

}  // namespace lissom
