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
// Offset of points for queries of the nearest, in edges.
constexpr double kAside = 1e-8;
// In place of an angle that has not been asked for.
constexpr double kNotMeasured = -1.0;

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

// Whether one of a triangle's edges runs from a to b.
bool is_along(const Triangle& t, Index a, Index b) {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
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
            add_vertex_lists();
        }
        add_empty(1);
        enter(index_of(t), triangle);
        first_.face.push_back(parts.face[t]);
        first_.corners.push_back(parts.corners[t]);
        first_.vertices.push_back(parts.triangles[t]);
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
            if (!find_quad(a, c, quad) || first_.face[quad.left] != first_.face[quad.right])
                continue;
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
        corners[k] = {first_.vertices[quad.left][k], first_.corners[quad.left][k]};
        corners[3 + k] = {first_.vertices[quad.right][k], first_.corners[quad.right][k]};
    }
    for (const Index f : {quad.left, quad.right}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = mesh_vertex_[triangles_[f][k]];
            const auto at = std::find_if(corners.begin(), corners.end(),
                                         [&](const auto& corner) { return corner.first == v; });
            first_.vertices[f][k] = v;
            first_.corners[f][k] = at->second;
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
    if (first_.face[left] == first_.face[right]) return false;
    for (const auto& [kind, labels] : mesh_.attributes().labels()) {
        if (labels.of_face[first_.face[left]] != labels.of_face[first_.face[right]]) return true;
    }
    for (const Index v : {a, c}) {
        const auto corner = [&](Index f) {
            std::size_t k = 0;
            while (triangles_[f][k] != v) ++k;
            return first_.corners[f][k];
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
            const Vec3 &n = normal_[f], &m = normal_[other];
            const bool is_sharp =
                !n.isZero(0.0) && !m.isZero(0.0) && angle_between(n, m) > sharp + kSheetAngle;
            if (is_sharp || is_chart_border(f, other, a, c)) add_feature(a, c);
        }
    }
}

// The triangles at first, none of which knows its neighbours, so that they need be no manifold.
void SeamSheet::make_rest(const Context& context) {
    FaceList list;
    for (const Triangle& t : triangles_) {
        const auto first = count_of(first_.points);
        for (const Index v : t) first_.points.push_back(x_[v]);
        list.add({first, first + 1, first + 2});
    }
    first_.tree.emplace(Mesh(first_.points, std::move(list)), context);
    for (std::size_t t = 0; t + 2 < first_.points.size() && first_.aside.isZero(0.0); t += 3) {
        const Vec3 u = first_.points[t + 1] - first_.points[t],
                   w = first_.points[t + 2] - first_.points[t];
        const Vec3 n = u.cross(w);
        if (n.norm() > kFlatShape * u.squaredNorm()) {
            first_.aside = kAside * (0.37 * u + 0.61 * w + 0.53 * u.norm() * n.normalized());
        }
    }
}

SurfacePoint SeamSheet::nearest_at_first(const Vec3& p) const {
    return first_.tree->nearest(p + first_.aside);
}

void SeamSheet::add_vertex_lists() {
    around_.emplace_back();
    changed_.push_back(0);
    features_at_.push_back(0);
}

void SeamSheet::add_empty(std::size_t count) {
    const std::size_t size = triangles_.size() + count;
    triangles_.resize(size, {kNoIndex, kNoIndex, kNoIndex});
    normal_.resize(size, Vec3::Zero());
    angle_.resize(size, kNotMeasured);
    useless_.resize(size, {0, 0, 0});
    refused_.resize(size, {0, 0, 0});
}

Index SeamSheet::left_of(Index a, Index b) const {
    // A fan has many triangles at its apex, and few at the other end of each edge.
    for (const Index f : around_[a].size() < around_[b].size() ? around_[a] : around_[b]) {
        if (is_along(triangles_[f], a, b)) return f;
    }
    return kNoIndex;
}

bool SeamSheet::is_on_seam(Index a, Index b) const {
    return fixed_[a] && fixed_[b] && seam_.contains(key(a, b));
}

void SeamSheet::enter(Index f, const Triangle& triangle) {
    triangles_[f] = triangle;
    for (const Index v : triangle) around_[v].push_back(f);
    ++clock_;
    note_change(f);
}

// After a triangle was made, or one of its vertices has moved.
void SeamSheet::note_change(Index f) {
    normal_[f] = normal(triangles_[f], kNoIndex, Vec3::Zero());
    angle_[f] = kNotMeasured;
    for (const Index v : triangles_[f]) changed_[v] = clock_;
}

void SeamSheet::leave(Index f) {
    for (const Index v : triangles_[f]) std::erase(around_[v], f);
    triangles_[f] = {kNoIndex, kNoIndex, kNoIndex};
}

std::vector<Index> SeamSheet::ring(Index v) const {
    std::vector<Index> found;
    found.reserve(2 * around_[v].size());
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

void SeamSheet::add_feature(Index a, Index b) {
    if (!features_.insert(key(a, b)).second) return;
    ++features_at_[a];
    ++features_at_[b];
}

void SeamSheet::remove_feature(Index a, Index b) {
    if (features_.erase(key(a, b)) == 0) return;
    --features_at_[a];
    --features_at_[b];
}

bool SeamSheet::is_feature(Index a, Index b) const {
    return !is_free(a) && !is_free(b) && features_.contains(key(a, b));
}

// True if exactly two feature edges, in line, meet at a vertex.
bool SeamSheet::is_sliding(Index v, std::array<Index, 2>& along) const {
    if (features_at_[v] != 2) return false;
    std::size_t count = 0;
    for (const Index w : ring(v)) {
        if (!is_feature(v, w)) continue;
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

double SeamSheet::min_angle(const Triangle& t, Index moved, const Vec3& to) const {
    const auto at = [&](std::size_t k) -> const Vec3& { return t[k] == moved ? to : x_[t[k]]; };
    return smallest_angle(at(0), at(1), at(2));
}

double SeamSheet::min_angle_of(Index f) {
    if (angle_[f] == kNotMeasured) angle_[f] = min_angle(triangles_[f], kNoIndex, Vec3::Zero());
    return angle_[f];
}

// The angles of triangles that are there.
SeamSheet::Star SeamSheet::star_of(std::span<const Index> faces) {
    facets_.clear();
    for (const Index f : faces) facets_.push_back({triangles_[f], normal_[f], min_angle_of(f)});
    return measured(faces);
}

// Measures of new triangles, in place of others, with a vertex at `to` that only these have.
SeamSheet::Star SeamSheet::star_with(std::span<const Triangle> triangles,
                                     std::span<const Index> instead_of, Index moved,
                                     const Vec3& to) {
    facets_.clear();
    for (const Triangle& t : triangles) {
        facets_.push_back({t, normal(t, moved, to), min_angle(t, moved, to)});
    }
    return measured(instead_of);
}

// The angles of the facets. Each edge between two of them is measured once.
SeamSheet::Star SeamSheet::measured(std::span<const Index> instead_of) const {
    Star star;
    GreatestAngle seam, other;
    const auto add = [&](Index a, Index b, const Vec3& n, const Vec3& m) {
        GreatestAngle& greatest = is_on_seam(a, b) ? seam : other;
        if (n.isZero(0.0) || m.isZero(0.0)) {
            greatest.add(kPi);
        } else {
            greatest.add(n, m);
        }
    };
    const auto facet_left_of = [&](Index a, Index b) {
        std::size_t i = 0;
        while (i < facets_.size() && !is_along(facets_[i].corners, a, b)) ++i;
        return i;
    };
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        const Facet& facet = facets_[i];
        star.angle = std::min(star.angle, facet.angle);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = facet.corners[k], b = facet.corners[(k + 1) % 3];
            const std::size_t j = facet_left_of(b, a);
            if (j < facets_.size()) {
                if (i < j) add(a, b, facet.normal, facets_[j].normal);
                continue;
            }
            const Index f = left_of(b, a);
            if (f != kNoIndex &&
                std::find(instead_of.begin(), instead_of.end(), f) == instead_of.end()) {
                add(a, b, facet.normal, normal_[f]);
            } else if (fixed_[a] && fixed_[b]) {
                const auto beyond = beyond_.find(key(a, b));
                if (beyond != beyond_.end()) add(a, b, facet.normal, beyond->second);
            }
        }
    }
    star.seam = seam.value();
    star.other = other.value();
    return star;
}

bool SeamSheet::is_allowed(const Star& before, const Star& after, const SheetLimits& limits,
                           double good_angle) {
    return after.seam <= std::max(before.seam, limits.seam) + kSheetAngle &&
           after.other <= std::max(before.other, limits.other) + kSheetAngle &&
           after.angle >= std::min(before.angle, good_angle) - kSheetAngle;
}

// Whether a triangle turns by more than `greatest` when it becomes another.
bool SeamSheet::turns(std::span<const Index> before, std::span<const Triangle> after, Index moved,
                      const Vec3& to, double greatest) const {
    for (std::size_t i = 0; i < after.size(); ++i) {
        const Vec3 &old = normal_[before[i]], now = normal(after[i], moved, to);
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
    const Vec3 weights = weights_near(first_.points[3 * at], first_.points[3 * at + 1],
                                      first_.points[3 * at + 2], point.position);
    return weighted_sources(first_.vertices[at], weights);
}

Index SeamSheet::face_source(const Triangle& t) const {
    return first_.face[nearest_at_first((x_[t[0]] + x_[t[1]] + x_[t[2]]) / 3.0).face];
}

// Read a little towards the middle of the triangle, so that it is in its own chart if two meet.
std::vector<ElementMap::Source> SeamSheet::corner_sources(const Triangle& t, std::size_t k) const {
    const Vec3 middle = (x_[t[0]] + x_[t[1]] + x_[t[2]]) / 3.0, &x = x_[t[k]];
    const std::size_t at = nearest_at_first(x + kTowards * (middle - x)).face;
    const Vec3 weights = weights_near(first_.points[3 * at], first_.points[3 * at + 1],
                                      first_.points[3 * at + 2], x);
    return weighted_sources(first_.corners[at], weights);
}

}  // namespace lissom
