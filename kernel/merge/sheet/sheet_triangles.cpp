#include "kernel/merge/sheet/sheet_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

// Two feature edges in line turn by less than this.
const double kInLine = std::cos(15.0 * kPi / 180.0);
// Triangles whose height is a smaller part of their length have no normal but that of rounding.
constexpr double kFlatShape = 1e-10;
// In place of an angle that has not been asked for.
constexpr double kNotMeasured = -1.0;
constexpr Triangle kGone = {kNoIndex, kNoIndex, kNoIndex};

}  // namespace

void SheetTriangles::add_vertex(const Vec3& position, Index of_mesh) {
    x.push_back(position);
    mesh_vertex.push_back(of_mesh);
    fixed.push_back(0);
    around.emplace_back();
    changed.push_back(0);
    features_at_.push_back(0);
}

void SheetTriangles::add_empty(std::size_t count) {
    const std::size_t size = triangles.size() + count;
    triangles.resize(size, kGone);
    normal.resize(size, Vec3::Zero());
    angle_.resize(size, kNotMeasured);
}

void SheetTriangles::enter(Index f, const Triangle& triangle) {
    triangles[f] = triangle;
    for (const Index v : triangle) around[v].push_back(f);
    ++clock;
    note_change(f);
}

void SheetTriangles::leave(Index f) {
    for (const Index v : triangles[f]) std::erase(around[v], f);
    triangles[f] = kGone;
}

void SheetTriangles::move(Index v, const Vec3& to) {
    x[v] = to;
    ++clock;
    for (const Index f : around[v]) note_change(f);
}

// After a triangle was made, or one of its vertices has moved.
void SheetTriangles::note_change(Index f) {
    normal[f] = normal_of(triangles[f]);
    angle_[f] = kNotMeasured;
    for (const Index v : triangles[f]) changed[v] = clock;
}

Index SheetTriangles::left_of(Index a, Index b) const {
    // A fan has many triangles at its apex, and few at the other end of each edge.
    for (const Index f : around[a].size() < around[b].size() ? around[a] : around[b]) {
        if (is_along(triangles[f], a, b)) return f;
    }
    return kNoIndex;
}

std::vector<Index> SheetTriangles::ring(Index v) const {
    std::vector<Index> found;
    found.reserve(2 * around[v].size());
    for (const Index f : around[v]) {
        for (const Index w : triangles[f]) {
            if (w != v) found.push_back(w);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

bool SheetTriangles::is_joined(Index a, Index b) const {
    return left_of(a, b) != kNoIndex || left_of(b, a) != kNoIndex ||
           outer_edges.contains(edge_key(a, b));
}

bool SheetTriangles::is_on_seam(Index a, Index b) const {
    return fixed[a] && fixed[b] && seam.contains(edge_key(a, b));
}

void SheetTriangles::add_feature(Index a, Index b) {
    if (!features_.insert(edge_key(a, b)).second) return;
    ++features_at_[a];
    ++features_at_[b];
}

void SheetTriangles::remove_feature(Index a, Index b) {
    if (features_.erase(edge_key(a, b)) == 0) return;
    --features_at_[a];
    --features_at_[b];
}

bool SheetTriangles::is_feature(Index a, Index b) const {
    return !is_free(a) && !is_free(b) && features_.contains(edge_key(a, b));
}

bool SheetTriangles::is_sliding(Index v, std::array<Index, 2>& along) const {
    if (features_at_[v] != 2) return false;
    std::size_t count = 0;
    for (const Index w : ring(v)) {
        if (!is_feature(v, w)) continue;
        if (count < 2) along[count] = w;
        ++count;
    }
    if (count != 2) return false;
    const Vec3 to = (x[along[0]] - x[v]).normalized(), from = (x[v] - x[along[1]]).normalized();
    return to.dot(from) > kInLine;
}

Vec3 SheetTriangles::normal_of(const Triangle& t, Index moved, const Vec3& to) const {
    const auto at = [&](std::size_t k) -> const Vec3& { return t[k] == moved ? to : x[t[k]]; };
    const Vec3 u = at(1) - at(0), w = at(2) - at(0), n = u.cross(w);
    const double longest = std::max(u.squaredNorm(), w.squaredNorm());
    return n.norm() > kFlatShape * longest ? n : Vec3(Vec3::Zero());
}

double SheetTriangles::min_angle(const Triangle& t, Index moved, const Vec3& to) const {
    const auto at = [&](std::size_t k) -> const Vec3& { return t[k] == moved ? to : x[t[k]]; };
    return smallest_angle(at(0), at(1), at(2));
}

double SheetTriangles::min_angle_of(Index f) {
    if (angle_[f] == kNotMeasured) angle_[f] = min_angle(triangles[f]);
    return angle_[f];
}

bool SheetTriangles::turns(std::span<const Index> before, std::span<const Triangle> after,
                           double limit, Index moved, const Vec3& to) const {
    for (std::size_t i = 0; i < after.size(); ++i) {
        const Vec3 &old = normal[before[i]], now = normal_of(after[i], moved, to);
        if (!old.isZero(0.0) && angle_between(old, now) > limit) return true;
    }
    return false;
}

}  // namespace lissom
