// ClosedPatch of seam_patch.h: its flips, and steps allowed after closing.
#include "kernel/merge/sew/seam_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

constexpr int kPasses = 10;
// Rings around a seam that is kept as it is.
constexpr int kKeptRings = 2;
// Edges of a surface that turns by more than this are not flipped.
constexpr double kCrease = 30.0 * kDegree;
// A flip must make the smallest angle greater by this part, so that equal shapes do not flip back
// and forth and rounding does not decide.
constexpr double kGain = 1e-6;
// Angles (radians) that differ by less are equal.
constexpr double kSameAngle = 1e-9;

// Angle between two normals; any value if one has no length.
double normal_angle(const Vec3& n, const Vec3& m) {
    return n.squaredNorm() > 0.0 && m.squaredNorm() > 0.0 ? angle_between(n, m) : kPi;
}

Vec3 normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a);
}

// Whether two faces as they were before a seam meet in an edge of their surface that would show
// if it went.
bool is_crease(const Mesh& mesh, Index f, Index g) {
    if (f == g) return false;
    const Vec3 n = area_vector(mesh, f), m = area_vector(mesh, g);
    if (n.isZero(0.0) || m.isZero(0.0)) return false;
    return angle_between(n, m) > kCrease;
}

}  // namespace

ClosedPatch::ClosedPatch(SeamFaces faces, std::span<const std::vector<Index>> seams)
    : faces_(std::move(faces)) {
    for (const std::vector<Index>& seam : seams) {
        for (std::size_t k = 0; k < seam.size(); ++k) {
            seam_edges_.insert(edge_key(seam[k], seam[(k + 1) % seam.size()]));
        }
        seam_vertices_.insert(seam_vertices_.end(), seam.begin(), seam.end());
    }
    std::sort(seam_vertices_.begin(), seam_vertices_.end());
    separate_inner_edges();
}

bool ClosedPatch::is_on_seam(Index a, Index b) const {
    return seam_edges_.contains(edge_key(a, b));
}

// An edge inside both sides that joins the seam's vertices would have four faces. It is flipped on
// one side.
void ClosedPatch::separate_inner_edges() {
    for (const Index a : seam_vertices_) {
        for (const Index c : faces_.neighbors(a)) {
            const bool shared = a < c && !is_on_seam(a, c) && faces_.left_of(a, c, 0) != kNoIndex &&
                                faces_.left_of(a, c, 1) != kNoIndex;
            if (!shared) continue;
            bool done = false;
            for (const std::size_t side : {1, 0}) {
                for (const auto& [x, y] : {std::pair(a, c), std::pair(c, a)}) {
                    const Index face = faces_.left_of(x, y, side);
                    if (face != kNoIndex) faces_.triangulate(face);
                }
                Diagonal diagonal;
                done = find_diagonal(a, c, side, diagonal) && can_flip(diagonal);
                if (!done) continue;
                flip(diagonal);
                break;
            }
            if (done) continue;
            throw Error(ErrorCode::nonmanifold_edge,
                        "both sides of a seam have an inner edge between the same two of its "
                        "vertices; subdivide one of the meshes near the seam",
                        {ElementKind::vertex, 2, {a, c}});
        }
    }
}

bool ClosedPatch::find_diagonal(Index a, Index c, std::size_t side, Diagonal& diagonal) const {
    diagonal.left = faces_.left_of(a, c, side);
    diagonal.right = faces_.left_of(c, a, side);
    if (diagonal.left == kNoIndex || diagonal.right == kNoIndex) return false;
    const std::vector<SeamCorner>& left = faces_.faces()[diagonal.left].corners;
    const std::vector<SeamCorner>& right = faces_.faces()[diagonal.right].corners;
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

bool ClosedPatch::can_flip(const Diagonal& quad) const {
    const Index a = quad.a.vertex, b = quad.b.vertex, c = quad.c.vertex, d = quad.d.vertex;
    const bool complete = faces_.is_complete(a) && faces_.is_complete(b) && faces_.is_complete(c) &&
                          faces_.is_complete(d);
    const bool inner = !is_on_seam(a, c);
    return complete && inner && b != d && !faces_.has_edge(b, d);
}

void ClosedPatch::keep_edges_near(std::span<const Index> vertices) {
    kept_.insert(vertices.begin(), vertices.end());
    for (int ring = 0; ring < kKeptRings; ++ring) {
        const std::vector<Index> reached(kept_.begin(), kept_.end());
        for (const Index v : reached) {
            for (const Index w : faces_.neighbors(v)) kept_.insert(w);
        }
    }
}

bool ClosedPatch::is_kept(const Diagonal& quad) const {
    return kept_.contains(quad.a.vertex) || kept_.contains(quad.b.vertex) ||
           kept_.contains(quad.c.vertex) || kept_.contains(quad.d.vertex);
}

void ClosedPatch::flip(const Diagonal& quad) {
    faces_.replace_both(quad.left, {quad.a, quad.b, quad.d}, quad.right, {quad.b, quad.c, quad.d});
}

bool ClosedPatch::same_chart(const Diagonal& quad) const {
    const SeamFace &left = faces_.faces()[quad.left], &right = faces_.faces()[quad.right];
    for (const auto& [kind, labels] : faces_.mesh().attributes().labels()) {
        if (labels.of_face[left.origin] != labels.of_face[right.origin]) return false;
    }
    for (const SeamCorner& corner : right.corners) {
        if (corner.vertex == quad.a.vertex && !faces_.same_values(corner, quad.a)) return false;
        if (corner.vertex == quad.c.vertex && !faces_.same_values(corner, quad.c)) return false;
    }
    return true;
}

// The angle between a face with `normal` on the left of an edge and the face on its right.
void ClosedPatch::add_dihedral(Index from, Index to, const Vec3& normal,
                               Dihedrals& greatest) const {
    const Index other = faces_.left_of(to, from);
    if (other == kNoIndex) return;
    const bool on_seam = is_on_seam(from, to);
    double& angle = on_seam ? greatest.seam : greatest.other;
    angle = std::max(angle, normal_angle(normal, faces_.area_vector(faces_.faces()[other])));
}

// At the seams and next to them. Faces without area have none.
ClosedPatch::Dihedrals ClosedPatch::max_dihedrals() const {
    Dihedrals greatest;
    std::unordered_set<Index> near(seam_vertices_.begin(), seam_vertices_.end());
    for (const Index v : seam_vertices_) {
        for (const Index w : faces_.neighbors(v)) near.insert(w);
    }
    for (const SeamFace& face : faces_.faces()) {
        if (face.corners.empty()) continue;
        const Vec3 normal = faces_.area_vector(face);
        if (!(normal.squaredNorm() > 0.0)) continue;
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const Index from = face.corners[k].vertex;
            const Index to = face.corners[(k + 1) % face.corners.size()].vertex;
            const Index other = faces_.left_of(to, from);
            if (!near.contains(from) && !near.contains(to)) continue;
            if (other == kNoIndex || faces_.area_vector(faces_.faces()[other]).isZero(0.0))
                continue;
            add_dihedral(from, to, normal, greatest);
        }
    }
    return greatest;
}

bool ClosedPatch::improves(const Diagonal& quad, const Dihedrals& allowed) const {
    const Index ia = quad.a.vertex, ib = quad.b.vertex, ic = quad.c.vertex, id = quad.d.vertex;
    const Vec3 a = faces_.position(ia), b = faces_.position(ib), c = faces_.position(ic),
               d = faces_.position(id);
    const double old_angle = std::min(smallest_angle(a, c, d), smallest_angle(c, a, b));
    const double new_angle = std::min(smallest_angle(a, b, d), smallest_angle(b, c, d));
    if (!(new_angle > old_angle * (1.0 + kGain) + kSameAngle)) return false;
    const Index left = faces_.faces()[quad.left].origin, right = faces_.faces()[quad.right].origin;
    if (is_crease(faces_.mesh(), left, right)) return false;
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

Index ClosedPatch::flip_all_once(const Dihedrals& allowed) {
    Index flips = 0;
    for (std::size_t f = 0; f < faces_.faces().size(); ++f) {
        for (std::size_t k = 0; k < 3 && faces_.faces()[f].corners.size() == 3; ++k) {
            const Index a = faces_.faces()[f].corners[k].vertex,
                        c = faces_.faces()[f].corners[(k + 1) % 3].vertex;
            Diagonal quad;
            if (!find_diagonal(a, c, faces_.is_source(faces_.faces()[f]) ? 1 : 0, quad)) continue;
            if (is_kept(quad) || !can_flip(quad) || !improves(quad, allowed) || !same_chart(quad))
                continue;
            flip(quad);
            ++flips;
        }
    }
    return flips;
}

// Pairs of faces of the patch that run through one another. Vertices at one place count as one, so
// that the faces need not be connected.
std::vector<FacePair> ClosedPatch::crossings(const Context& context) const {
    std::vector<Vec3> points;
    std::vector<Index> number, vertices;
    FaceList faces;
    for (std::size_t f = 0; f < faces_.faces().size(); ++f) {
        if (faces_.faces()[f].corners.empty()) continue;
        vertices.clear();
        for (const SeamCorner& corner : faces_.faces()[f].corners) {
            vertices.push_back(count_of(points));
            points.push_back(faces_.position(corner.vertex));
        }
        faces.add(vertices);
        number.push_back(index_of(f));
    }
    std::vector<FacePair> pairs =
        self_intersections(Mesh(std::move(points), std::move(faces), context), {}, context);
    for (FacePair& pair : pairs) pair = {number[pair.first], number[pair.second]};
    return pairs;
}

Index ClosedPatch::flip_edges(double allowed_dihedral, const Context& context) {
    const Dihedrals greatest = max_dihedrals();
    const Dihedrals allowed{std::min(allowed_dihedral, greatest.seam),
                            std::min(allowed_dihedral, greatest.other)};
    const std::vector<FacePair> before = crossings(context);
    SeamFaces old = faces_;
    Index flips = 0;
    for (int pass = 0; pass < kPasses; ++pass) {
        const Index more = flip_all_once(allowed);
        flips += more;
        if (more == 0) break;
    }
    if (flips == 0) return 0;
    const std::vector<FacePair> after = crossings(context);
    if (std::includes(before.begin(), before.end(), after.begin(), after.end())) return flips;
    faces_ = std::move(old);
    return 0;
}

}  // namespace lissom
