#include "kernel/merge/sew/seam_sheet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Two feature edges in line turn by less than this.
const double kInLine = std::cos(15.0 * kPi / 180.0);
// Angles that differ by less are equal, so that rounding does not decide.
constexpr double kSheetAngle = 1e-7;
// How far towards its triangle a corner is read, and weights that do not count.
constexpr double kTowards = 1e-4, kNoWeight = 1e-7;
// Triangles whose height is a smaller part of their length have no normal but that of rounding.
constexpr double kFlatShape = 1e-10;
// How far points are put aside to ask what is nearest, in edges.
constexpr double kAside = 1e-8;

double smallest_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min(
        {angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)});
}

// Barycentric coordinates of the point of a triangle near `p`, which lies on it or next to it.
Vec3 weights_near(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 n = (b - a).cross(c - a);
    const double square = n.squaredNorm();
    if (!(square > 0.0)) return {1.0, 0.0, 0.0};
    Vec3 w((b - p).cross(c - p).dot(n), (c - p).cross(a - p).dot(n), (a - p).cross(b - p).dot(n));
    w /= square;
    for (Index k = 0; k < 3; ++k) w[k] = w[k] > kNoWeight ? w[k] : 0.0;
    return w / w.sum();
}

std::vector<ElementMap::Source> weighted_sources(const Triangle& elements, const Vec3& weights) {
    std::vector<ElementMap::Source> sources;
    for (std::size_t k = 0; k < 3; ++k) {
        const double weight = weights[index_of(k)];
        if (weight > 0.0) sources.push_back({elements[k], weight});
    }
    return sources;
}

}  // namespace

SeamSheet::SeamSheet(const Mesh& mesh, std::vector<Index> faces,
                     std::span<const std::vector<Index>> seams, double sharp,
                     const Context& context)
    : mesh_(mesh), faces_(std::move(faces)) {
    take_faces();
    mark_borders(seams);
    mark_features(sharp);
    make_rest(context);
}

void SeamSheet::take_faces() {
    const Triangulation parts = triangulate_faces(mesh_.topology(), mesh_.positions(), faces_);
    std::unordered_map<Index, Index> local;
    for (std::size_t t = 0; t < parts.triangles.size(); ++t) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = parts.triangles[t][k];
            const auto [at, made] = local.emplace(v, count_of(x_));
            triangle[k] = at->second;
            if (!made) continue;
            x_.push_back(mesh_.position(v));
            mesh_vertex_.push_back(v);
            around_.emplace_back();
        }
        add_empty(1);
        enter(index_of(t), triangle);
        rest_face_.push_back(parts.face[t]);
        rest_corners_.push_back(parts.corners[t]);
        rest_vertices_.push_back(parts.triangles[t]);
    }
    fixed_.assign(x_.size(), 0);
    find_outer_edges();
    separate_diagonals();
}

// Edges none of whose faces are in the sheet, so that the sheet's own may go and come back.
void SeamSheet::find_outer_edges() {
    const Topology& topology = mesh_.topology();
    std::unordered_map<Index, Index> local;
    for (Index v = 0; v < vertex_count(); ++v) local.emplace(mesh_vertex_[v], v);
    std::vector<Index> sorted = faces_;
    std::sort(sorted.begin(), sorted.end());
    const auto is_of_sheet = [&](Index f) {
        return f != kNoIndex && std::binary_search(sorted.begin(), sorted.end(), f);
    };
    for (Index v = 0; v < vertex_count(); ++v) {
        for (const Index w : topology.neighbors(mesh_vertex_[v])) {
            const auto other = local.find(w);
            if (other == local.end() || other->second < v) continue;
            if (is_of_sheet(face_left_of(topology, mesh_vertex_[v], w)) ||
                is_of_sheet(face_left_of(topology, w, mesh_vertex_[v]))) {
                continue;
            }
            outer_edges_.insert(key(v, other->second));
        }
    }
}

// Diagonals of the sheet's polygons that join vertices which an edge of the mesh joins too.
void SeamSheet::separate_diagonals() {
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = triangles_[f][k], c = triangles_[f][(k + 1) % 3];
            Quad quad;
            if (!find_quad(a, c, quad) || rest_face_[quad.left] != rest_face_[quad.right]) continue;
            const auto joined = mesh_.topology().neighbors(mesh_vertex_[a]);
            if (std::find(joined.begin(), joined.end(), mesh_vertex_[c]) == joined.end()) continue;
            if (is_joined(quad.b, quad.d)) continue;
            turn_diagonal(quad);
            keep_at_first(quad);
        }
    }
}

// After a flip that the sheet begins with.
void SeamSheet::keep_at_first(const Quad& quad) {
    std::array<std::pair<Index, Index>, 6> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = {rest_vertices_[quad.left][k], rest_corners_[quad.left][k]};
        corners[3 + k] = {rest_vertices_[quad.right][k], rest_corners_[quad.right][k]};
    }
    for (const Index f : {quad.left, quad.right}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = mesh_vertex_[triangles_[f][k]];
            const auto at = std::find_if(corners.begin(), corners.end(),
                                         [&](const auto& corner) { return corner.first == v; });
            rest_vertices_[f][k] = v;
            rest_corners_[f][k] = at->second;
        }
    }
}

void SeamSheet::mark_borders(std::span<const std::vector<Index>> seams) {
    for (const Triangle& t : std::vector<Triangle>(triangles_)) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (left_of(b, a) != kNoIndex) continue;
            fixed_[a] = fixed_[b] = 1;
            const Index beyond = face_left_of(mesh_.topology(), mesh_vertex_[b], mesh_vertex_[a]);
            if (beyond != kNoIndex) beyond_.emplace(key(a, b), clear_area_vector(mesh_, beyond));
        }
    }
    // A vertex with faces outside the sheet that touches it in one point stays as well.
    std::unordered_map<Index, Index> local;
    std::vector<Index> sorted = faces_;
    std::sort(sorted.begin(), sorted.end());
    for (Index v = 0; v < vertex_count(); ++v) {
        local.emplace(mesh_vertex_[v], v);
        for (const Index f : mesh_.topology().faces_around(mesh_vertex_[v])) {
            if (!std::binary_search(sorted.begin(), sorted.end(), f)) fixed_[v] = 1;
        }
    }
    for (const std::vector<Index>& seam : seams) {
        for (std::size_t k = 0; k < seam.size(); ++k) {
            const auto a = local.find(seam[k]), b = local.find(seam[(k + 1) % seam.size()]);
            if (a != local.end()) fixed_[a->second] = 1;
            if (a != local.end() && b != local.end()) seam_.insert(key(a->second, b->second));
        }
    }
}

bool SeamSheet::same_values(Index p, Index q) const {
    for (const Attribute& attribute : mesh_.attributes().all()) {
        if (attribute.domain != Domain::corner) continue;
        for (Index k = 0; k < attribute.width; ++k) {
            const double x = attribute.at(p)[k], y = attribute.at(q)[k];
            if (std::isnan(x) && std::isnan(y)) continue;
            if (!(std::abs(x - y) <= 1e-9 * (std::abs(x) + std::abs(y)))) return false;
        }
    }
    return true;
}

// Whether labels or attributes of corners differ across the edge between two first triangles.
bool SeamSheet::is_chart_border(Index left, Index right, Index a, Index c) const {
    if (rest_face_[left] == rest_face_[right]) return false;
    for (const auto& [kind, labels] : mesh_.attributes().labels()) {
        if (labels.of_face[rest_face_[left]] != labels.of_face[rest_face_[right]]) return true;
    }
    for (const Index v : {a, c}) {
        const auto corner = [&](Index f) {
            std::size_t k = 0;
            while (triangles_[f][k] != v) ++k;
            return rest_corners_[f][k];
        };
        if (!same_values(corner(left), corner(right))) return true;
    }
    return false;
}

void SeamSheet::mark_features(double sharp) {
    for (Index f = 0; f < count_of(triangles_); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = triangles_[f][k], c = triangles_[f][(k + 1) % 3];
            const Index other = left_of(c, a);
            if (other == kNoIndex || other < f) continue;
            const Vec3 n = normal(triangles_[f], kNoIndex, Vec3::Zero()),
                       m = normal(triangles_[other], kNoIndex, Vec3::Zero());
            const bool is_sharp =
                !n.isZero(0.0) && !m.isZero(0.0) && angle_between(n, m) > sharp + kSheetAngle;
            if (is_sharp || is_chart_border(f, other, a, c)) features_.insert(key(a, c));
        }
    }
}

// The triangles at first, none of which knows its neighbours, so that they need be no manifold.
void SeamSheet::make_rest(const Context& context) {
    FaceList list;
    for (const Triangle& t : triangles_) {
        const auto first = count_of(rest_points_);
        for (const Index v : t) rest_points_.push_back(x_[v]);
        list.add({first, first + 1, first + 2});
    }
    rest_.emplace(Mesh(rest_points_, std::move(list)), context);
    for (std::size_t t = 0; t + 2 < rest_points_.size() && aside_.isZero(0.0); t += 3) {
        const Vec3 u = rest_points_[t + 1] - rest_points_[t],
                   w = rest_points_[t + 2] - rest_points_[t];
        const Vec3 n = u.cross(w);
        if (n.norm() > kFlatShape * u.squaredNorm()) {
            aside_ = kAside * (0.37 * u + 0.61 * w + 0.53 * u.norm() * n.normalized());
        }
    }
}

SurfacePoint SeamSheet::nearest_at_first(const Vec3& p) const {
    return rest_->nearest(p + aside_);
}

void SeamSheet::add_empty(std::size_t count) {
    const std::size_t size = triangles_.size() + count;
    triangles_.resize(size, {kNoIndex, kNoIndex, kNoIndex});
    changed_.resize(size, 0);
    tried_.resize(size, {0, 0, 0});
}

Index SeamSheet::left_of(Index a, Index b) const {
    for (const Index f : around_[a]) {
        const Triangle& t = triangles_[f];
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] == a && t[(k + 1) % 3] == b) return f;
        }
    }
    return kNoIndex;
}

void SeamSheet::enter(Index f, const Triangle& triangle) {
    triangles_[f] = triangle;
    changed_[f] = ++clock_;
    for (const Index v : triangle) around_[v].push_back(f);
}

void SeamSheet::leave(Index f) {
    for (const Index v : triangles_[f]) std::erase(around_[v], f);
    triangles_[f] = {kNoIndex, kNoIndex, kNoIndex};
}

std::vector<Index> SeamSheet::ring(Index v) const {
    std::vector<Index> found;
    for (const Index f : around_[v]) {
        for (const Index w : triangles_[f]) {
            if (w != v) found.push_back(w);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

bool SeamSheet::is_joined(Index a, Index b) const {
    return left_of(a, b) != kNoIndex || left_of(b, a) != kNoIndex ||
           outer_edges_.contains(key(a, b));
}

// True where exactly two feature edges, in line, meet at a vertex.
bool SeamSheet::is_sliding(Index v, std::array<Index, 2>& along) const {
    std::size_t count = 0;
    for (const Index w : ring(v)) {
        if (!features_.contains(key(v, w))) continue;
        if (count < 2) along[count] = w;
        ++count;
    }
    if (count != 2) return false;
    const Vec3 to = (x_[along[0]] - x_[v]).normalized(), from = (x_[v] - x_[along[1]]).normalized();
    return to.dot(from) > kInLine;
}

Vec3 SeamSheet::normal(const Triangle& t, Index moved, const Vec3& to) const {
    const auto at = [&](std::size_t k) -> const Vec3& { return t[k] == moved ? to : x_[t[k]]; };
    const Vec3 u = at(1) - at(0), w = at(2) - at(0), n = u.cross(w);
    const double longest = std::max(u.squaredNorm(), w.squaredNorm());
    return n.norm() > kFlatShape * longest ? n : Vec3(Vec3::Zero());
}

double SeamSheet::least_angle(const Triangle& t) const {
    return smallest_angle_of(x_[t[0]], x_[t[1]], x_[t[2]]);
}

// The angles of triangles that are there or would be, in place of others, with a vertex at `to`.
SeamSheet::Star SeamSheet::measure(std::span<const Triangle> triangles,
                                   std::span<const Index> instead_of, Index moved,
                                   const Vec3& to) const {
    std::vector<Vec3> normals;
    for (const Triangle& t : triangles) normals.push_back(normal(t, moved, to));
    const auto across = [&](Index a, Index b, Vec3& other) {
        for (std::size_t j = 0; j < triangles.size(); ++j) {
            for (std::size_t m = 0; m < 3; ++m) {
                if (triangles[j][m] != b || triangles[j][(m + 1) % 3] != a) continue;
                other = normals[j];
                return true;
            }
        }
        const Index f = left_of(b, a);
        if (f != kNoIndex &&
            std::find(instead_of.begin(), instead_of.end(), f) == instead_of.end()) {
            other = normal(triangles_[f], moved, to);
            return true;
        }
        const auto beyond = beyond_.find(key(a, b));
        if (beyond == beyond_.end()) return false;
        other = beyond->second;
        return true;
    };
    Star star;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        const auto at = [&](std::size_t k) -> const Vec3& { return t[k] == moved ? to : x_[t[k]]; };
        star.angle = std::min(star.angle, smallest_angle_of(at(0), at(1), at(2)));
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 other;
            if (!across(t[k], t[(k + 1) % 3], other)) continue;
            const bool flat = normals[i].isZero(0.0) || other.isZero(0.0);
            const double angle = flat ? kPi : angle_between(normals[i], other);
            double& greatest = seam_.contains(key(t[k], t[(k + 1) % 3])) ? star.seam : star.other;
            greatest = std::max(greatest, angle);
        }
    }
    return star;
}

bool SeamSheet::is_allowed(const Star& before, const Star& after, const SheetLimits& limits,
                           double good_angle) {
    return after.seam <= std::max(before.seam, limits.seam) + kSheetAngle &&
           after.other <= std::max(before.other, limits.other) + kSheetAngle &&
           after.angle >= std::min(before.angle, good_angle) - kSheetAngle;
}

// Whether a triangle turns by more than `greatest` when it becomes another.
bool SeamSheet::turns(std::span<const Triangle> before, std::span<const Triangle> after,
                      Index moved, const Vec3& to, double greatest) const {
    for (std::size_t i = 0; i < after.size(); ++i) {
        const Vec3 old = normal(before[i], kNoIndex, Vec3::Zero()),
                   now = normal(after[i], moved, to);
        if (!old.isZero(0.0) && angle_between(old, now) > greatest) return true;
    }
    return false;
}

bool SeamSheet::has_moved(Index v) const {
    return mesh_vertex_[v] == kNoIndex || x_[v] != mesh_.position(mesh_vertex_[v]);
}

std::vector<Triangle> SeamSheet::triangles() const {
    std::vector<Triangle> result;
    for (const Triangle& t : triangles_) {
        if (t[0] != kNoIndex) result.push_back(t);
    }
    return result;
}

std::vector<ElementMap::Source> SeamSheet::vertex_sources(Index v) const {
    const SurfacePoint point = nearest_at_first(x_[v]);
    const std::size_t at = point.face;
    const Vec3 weights = weights_near(rest_points_[3 * at], rest_points_[3 * at + 1],
                                      rest_points_[3 * at + 2], point.position);
    return weighted_sources(rest_vertices_[at], weights);
}

Index SeamSheet::face_source(const Triangle& t) const {
    return rest_face_[nearest_at_first((x_[t[0]] + x_[t[1]] + x_[t[2]]) / 3.0).face];
}

// Read a little towards the middle of the triangle, so that it is its own chart's where two meet.
std::vector<ElementMap::Source> SeamSheet::corner_sources(const Triangle& t, std::size_t k) const {
    const Vec3 middle = (x_[t[0]] + x_[t[1]] + x_[t[2]]) / 3.0, &x = x_[t[k]];
    const std::size_t at = nearest_at_first(x + kTowards * (middle - x)).face;
    const Vec3 weights =
        weights_near(rest_points_[3 * at], rest_points_[3 * at + 1], rest_points_[3 * at + 2], x);
    return weighted_sources(rest_corners_[at], weights);
}

}  // namespace lissom
