// Flips of edges in a patch around a seam.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/merge/sew/seam_patch.h"

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

constexpr int kPasses = 10;
// A flip must make the smallest angle greater by this part, so that equal shapes do not flip back
// and forth and rounding does not decide.
constexpr double kGain = 1e-6;
// Angles (radians) that differ by less are equal.
constexpr double kSameAngle = 1e-9;

// Angle between two normals; where one has no length it may be anything.
double normal_angle(const Vec3& n, const Vec3& m) {
    return n.squaredNorm() > 0.0 && m.squaredNorm() > 0.0 ? angle_between(n, m) : kPi;
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min(
        {angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)});
}

Vec3 normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a);
}

}  // namespace

bool SeamPatch::find_diagonal(Index a, Index c, std::size_t side, Diagonal& diagonal) const {
    diagonal.left = left_of(a, c, side);
    diagonal.right = left_of(c, a, side);
    if (diagonal.left == kNoIndex || diagonal.right == kNoIndex) return false;
    const std::vector<SeamCorner>& left = faces_[diagonal.left].corners;
    const std::vector<SeamCorner>& right = faces_[diagonal.right].corners;
    if (left.size() != 3 || right.size() != 3) return false;
    for (std::size_t k = 0; k < 3; ++k) {
        if (left[k].vertex == a) {
            diagonal.a = left[k];
            diagonal.c = left[(k + 1) % 3];
            diagonal.d = left[(k + 2) % 3];
        }
        if (right[k].vertex == c) diagonal.b = right[(k + 2) % 3];
    }
    return true;
}

bool SeamPatch::can_flip(const Diagonal& quad) const {
    const Index a = quad.a.vertex, b = quad.b.vertex, c = quad.c.vertex, d = quad.d.vertex;
    const bool complete = is_complete(a) && is_complete(b) && is_complete(c) && is_complete(d);
    const bool inner = !seam_edges_.contains(key(std::min(a, c), std::max(a, c)));
    return complete && inner && b != d && !has_edge(b, d);
}

// The values of a corner attribute at a corner of the patch, compared without rounding in the way.
bool SeamPatch::same_values(const SeamCorner& p, const SeamCorner& q) const {
    for (const Attribute& attribute : mesh_.attributes().all()) {
        if (attribute.domain != Domain::corner) continue;
        for (Index k = 0; k < attribute.width; ++k) {
            const auto value = [&](const SeamCorner& corner) {
                const double first = attribute.at(corner.first)[k];
                if (corner.second == kNoIndex) return first;
                return (1.0 - corner.t) * first + corner.t * attribute.at(corner.second)[k];
            };
            const double x = value(p), y = value(q);
            if (std::isnan(x) && std::isnan(y)) continue;
            if (!(std::abs(x - y) <= 1e-9 * (std::abs(x) + std::abs(y)))) return false;
        }
    }
    return true;
}

bool SeamPatch::same_chart(const Diagonal& quad) const {
    const SeamFace &left = faces_[quad.left], &right = faces_[quad.right];
    for (const auto& [kind, labels] : mesh_.attributes().labels()) {
        if (labels.of_face[left.origin] != labels.of_face[right.origin]) return false;
    }
    for (const SeamCorner& corner : right.corners) {
        if (corner.vertex == quad.a.vertex && !same_values(corner, quad.a)) return false;
        if (corner.vertex == quad.c.vertex && !same_values(corner, quad.c)) return false;
    }
    return true;
}

void SeamPatch::flip(const Diagonal& quad) {
    leave(quad.left);
    leave(quad.right);
    faces_[quad.left].corners = {quad.a, quad.b, quad.d};
    faces_[quad.right].corners = {quad.b, quad.c, quad.d};
    enter(quad.left);
    enter(quad.right);
}

Vec3 SeamPatch::area_vector(const SeamFace& face) const {
    Vec3 sum = Vec3::Zero();
    const Vec3& origin = position(face.corners[0].vertex);
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
        sum +=
            normal(origin, position(face.corners[k].vertex), position(face.corners[k + 1].vertex));
    }
    return sum;
}

// The angle between a face with `normal` on the left of an edge and the face on its right.
void SeamPatch::add_dihedral(Index from, Index to, const Vec3& normal, Dihedrals& greatest) const {
    const Index other = left_of(to, from);
    if (other == kNoIndex) return;
    const bool on_seam = seam_edges_.contains(key(std::min(from, to), std::max(from, to)));
    double& angle = on_seam ? greatest.seam : greatest.other;
    angle = std::max(angle, normal_angle(normal, area_vector(faces_[other])));
}

// At the seams and next to them. Faces without area have none.
SeamPatch::Dihedrals SeamPatch::greatest_dihedrals() const {
    Dihedrals greatest;
    std::unordered_set<Index> near(seam_vertices_.begin(), seam_vertices_.end());
    for (const Index v : seam_vertices_) {
        for (const Index w : neighbors(v)) near.insert(w);
    }
    for (const SeamFace& face : faces_) {
        if (face.corners.empty()) continue;
        const Vec3 normal = area_vector(face);
        if (!(normal.squaredNorm() > 0.0)) continue;
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const Index from = face.corners[k].vertex;
            const Index to = face.corners[(k + 1) % face.corners.size()].vertex;
            const Index other = left_of(to, from);
            if (!near.contains(from) && !near.contains(to)) continue;
            if (other == kNoIndex || area_vector(faces_[other]).isZero(0.0)) continue;
            add_dihedral(from, to, normal, greatest);
        }
    }
    return greatest;
}

bool SeamPatch::improves(const Diagonal& quad, const Dihedrals& allowed) const {
    const Index ia = quad.a.vertex, ib = quad.b.vertex, ic = quad.c.vertex, id = quad.d.vertex;
    const Vec3 a = position(ia), b = position(ib), c = position(ic), d = position(id);
    const double old_angle = std::min(smallest_angle(a, c, d), smallest_angle(c, a, b));
    const double new_angle = std::min(smallest_angle(a, b, d), smallest_angle(b, c, d));
    if (!(new_angle > old_angle * (1.0 + kGain) + kSameAngle)) return false;
    const Vec3 old_left = normal(a, c, d), old_right = normal(c, a, b);
    const Vec3 new_left = normal(a, b, d), new_right = normal(b, c, d);
    Dihedrals before{0.0, normal_angle(old_left, old_right)};
    add_dihedral(ic, id, old_left, before);
    add_dihedral(id, ia, old_left, before);
    add_dihedral(ia, ib, old_right, before);
    add_dihedral(ib, ic, old_right, before);
    Dihedrals after{0.0, normal_angle(new_left, new_right)};
    add_dihedral(ic, id, new_right, after);
    add_dihedral(id, ia, new_left, after);
    add_dihedral(ia, ib, new_left, after);
    add_dihedral(ib, ic, new_right, after);
    return after.seam <= std::max(before.seam, allowed.seam) + kSameAngle &&
           after.other <= std::max(before.other, allowed.other) + kSameAngle;
}

Index SeamPatch::flip_all_once(const Dihedrals& allowed) {
    Index flips = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        for (std::size_t k = 0; k < 3 && faces_[f].corners.size() == 3; ++k) {
            const Index a = faces_[f].corners[k].vertex, c = faces_[f].corners[(k + 1) % 3].vertex;
            Diagonal quad;
            if (!find_diagonal(a, c, is_source(faces_[f]) ? 1 : 0, quad)) continue;
            if (!can_flip(quad) || !improves(quad, allowed) || !same_chart(quad)) continue;
            flip(quad);
            ++flips;
        }
    }
    return flips;
}

// Pairs of faces of the patch that run through one another. Vertices at one place count as one, so
// that the faces need not be connected.
std::vector<FacePair> SeamPatch::crossings(const Context& context) const {
    std::vector<Vec3> points;
    std::vector<Index> number, vertices;
    FaceList faces;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        if (faces_[f].corners.empty()) continue;
        vertices.clear();
        for (const SeamCorner& corner : faces_[f].corners) {
            vertices.push_back(static_cast<Index>(points.size()));
            points.push_back(position(corner.vertex));
        }
        faces.add(vertices);
        number.push_back(static_cast<Index>(f));
    }
    std::vector<FacePair> pairs =
        self_intersections(Mesh(std::move(points), std::move(faces)), {}, context);
    for (FacePair& pair : pairs) pair = {number[pair.first], number[pair.second]};
    return pairs;
}

Index SeamPatch::flip_edges(double allowed_dihedral, const Context& context) {
    const Dihedrals greatest = greatest_dihedrals();
    const Dihedrals allowed{std::min(allowed_dihedral, greatest.seam),
                            std::min(allowed_dihedral, greatest.other)};
    const std::vector<FacePair> before = crossings(context);
    const auto old_faces = faces_;
    const auto old_edges = edges_;
    const auto old_faces_at = faces_at_;
    Index flips = 0;
    for (int pass = 0; pass < kPasses; ++pass) {
        const Index more = flip_all_once(allowed);
        flips += more;
        if (more == 0) break;
    }
    if (flips == 0) return 0;
    const std::vector<FacePair> after = crossings(context);
    if (std::includes(before.begin(), before.end(), after.begin(), after.end())) return flips;
    faces_ = old_faces;
    edges_ = old_edges;
    faces_at_ = old_faces_at;
    return 0;
}

}  // namespace lissom
