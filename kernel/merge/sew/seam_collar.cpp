#include "kernel/merge/sew/seam_collar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/sew/seam_guard.h"
#include "kernel/merge/sheet/seam_sheet.h"

namespace lissom {
namespace {

// A side whose edges are this many times as long as the seam's is sparse.
constexpr double kSparse = 1.5;
// Triangles at the seam that are thinner have no reliable normals: they are made anew on any side.
constexpr double kSliver = 2.0 * kDegree;
// How fast edges grow with the distance from the seam: 1.43 times a ring.
constexpr double kGradation = 0.5;
constexpr double kSharp = 20.0 * kDegree, kAllEdges = 1.0 * kDegree;
// Dihedral angles up to these may arise.
constexpr double kFlippedDihedral = 20.0 * kDegree, kRemeshedDihedral = 10.0 * kDegree;
constexpr double kGoodSeamAngle = 15.0 * kDegree, kSameQuality = 1e-6;
// Lengths that are this much greater are greater, so that rounding does not decide.
constexpr double kClearlyLonger = 1.0 + 1e-9;

double median_edge(std::vector<double> values) {
    const auto middle = values.begin() + (values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Points of a seam may lie as good as upon one another: edges beside them are not to become as
// short, but at least this share of the seam's mean edge.
constexpr double kShortest = 0.1;

// The length that edges should have around one seam: that of the seam's edges on it, growing with
// the distance up to that of the side. Points of the seam in their order, in a tree of boxes.
class SeamSizes {
  public:
    SeamSizes(std::vector<Vec3> seam, double greatest)
        : seam_(std::move(seam)), greatest_(greatest) {
        const std::size_t n = seam_.size();
        double sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            length_.push_back(0.5 * ((seam_[(k + 1) % n] - seam_[k]).norm() +
                                     (seam_[(k + n - 1) % n] - seam_[k]).norm()));
            sum += length_.back();
        }
        const double shortest = kShortest * sum / static_cast<double>(n);
        for (double& length : length_) length = std::max(length, shortest);
        build(0, n);
    }

    double at(const Vec3& p) const {
        double best = greatest_;
        search(0, p, best);
        return best;
    }

  private:
    static constexpr std::size_t kLeaf = 4;

    struct Node {
        Box box;
        double least = std::numeric_limits<double>::infinity();
        std::size_t begin = 0, end = 0, second = 0;
    };

    std::size_t build(std::size_t begin, std::size_t end) {
        const std::size_t node = nodes_.size();
        nodes_.emplace_back();
        Node made{{}, std::numeric_limits<double>::infinity(), begin, end, 0};
        for (std::size_t k = begin; k < end; ++k) {
            made.box.extend(seam_[k]);
            made.least = std::min(made.least, length_[k]);
        }
        if (end - begin > kLeaf) {
            const std::size_t middle = (begin + end) / 2;
            build(begin, middle);
            made.second = build(middle, end);
        }
        nodes_[node] = made;
        return node;
    }

    void search(std::size_t node, const Vec3& p, double& best) const {
        const Node& at = nodes_[node];
        const Vec3 outside = (at.box.min - p).cwiseMax(p - at.box.max).cwiseMax(Vec3::Zero());
        if (at.least + kGradation * outside.norm() >= best) return;
        if (at.second != 0) {
            search(node + 1, p, best);
            search(at.second, p, best);
            return;
        }
        for (std::size_t k = at.begin; k < at.end; ++k) {
            best = std::min(best, length_[k] + kGradation * (p - seam_[k]).norm());
        }
    }

    std::vector<Vec3> seam_;
    std::vector<double> length_;
    double greatest_;
    std::vector<Node> nodes_;
};

// One side of one seam.
class CollarSide {
  public:
    CollarSide(const Sewn& sewn, std::size_t seam, SeamSide side)
        : mesh_(sewn.mesh), sewn_(sewn), seam_(sewn.seams[seam]), side_(side) {}

    double seam_edge() const {
        double sum = 0.0;
        for (std::size_t k = 0; k < seam_.size(); ++k) {
            sum += distance(seam_[k], seam_[(k + 1) % seam_.size()]);
        }
        return sum / seam_.size();
    }

    // The median edge of the first two rings beside the seam; if these have no edges, of those
    // to the seam.
    double side_edge() const {
        const RingEdges edges = ring_edges();
        return edges.inner.empty() ? to_seam(edges) : median_edge(edges.inner);
    }

    // The median edge between the seam and the first ring beside it. Needles that stand on the
    // seam have it long and the ring's own edges short.
    double edge_to_seam() const { return to_seam(ring_edges()); }

    // The faces of the side that touch the seam, or are connected with those that do by vertices at
    // which edges should be shorter than the side's.
    std::vector<Index> faces(const SeamSizes& sizes, double side_edge) const {
        std::set<Index> faces;
        std::unordered_map<Index, char> seen;
        std::vector<Index> open(seam_);
        for (const Index v : seam_) seen.emplace(v, 1);
        while (!open.empty()) {
            const Index v = open.back();
            open.pop_back();
            for (const Index f : side_faces(v)) {
                if (!faces.insert(f).second) continue;
                for (const Index w : mesh_.topology().face(f)) {
                    if (!seen.emplace(w, 1).second) continue;
                    if (sizes.at(mesh_.position(w)) < side_edge) open.push_back(w);
                }
            }
        }
        return {faces.begin(), faces.end()};
    }

    // Smallest angle of the triangles at the seam.
    double smallest_angle() const {
        double least = kPi;
        for (const Index v : seam_) {
            for (const Index f : side_faces(v)) {
                if (mesh_.topology().face(f).size() != 3) continue;
                least = std::min(least, smallest_face_angle(mesh_, f));
            }
        }
        return least;
    }

    std::vector<Vec3> points() const {
        std::vector<Vec3> points;
        for (const Index v : seam_) points.push_back(mesh_.position(v));
        return points;
    }

  private:
    // Lengths of edges between vertices of the first two rings, and of those from there to the
    // seam.
    struct RingEdges {
        std::vector<double> inner, outer;
    };

    static double to_seam(const RingEdges& edges) {
        return edges.outer.empty() ? 0.0 : median_edge(edges.outer);
    }

    RingEdges ring_edges() const {
        const std::set<Index> on(seam_.begin(), seam_.end());
        const std::set<Index> near = first_rings(on);
        RingEdges edges;
        for (const Index v : near) {
            for (const Index w : mesh_.topology().neighbors(v)) {
                if (near.contains(w) && v < w) edges.inner.push_back(distance(v, w));
                if (on.contains(w)) edges.outer.push_back(distance(v, w));
            }
        }
        return edges;
    }

    std::set<Index> first_rings(const std::set<Index>& on) const {
        std::set<Index> near;
        std::vector<Index> front(on.begin(), on.end());
        for (int ring = 0; ring < 2; ++ring) {
            std::vector<Index> next;
            for (const Index v : front) {
                for (const Index f : side_faces(v)) {
                    for (const Index w : mesh_.topology().face(f)) {
                        if (!on.contains(w) && near.insert(w).second) next.push_back(w);
                    }
                }
            }
            front = std::move(next);
        }
        return near;
    }

    double distance(Index a, Index b) const {
        return (mesh_.position(a) - mesh_.position(b)).norm();
    }

    std::vector<Index> side_faces(Index v) const {
        std::vector<Index> faces;
        for (const Index f : mesh_.topology().faces_around(v)) {
            if (sewn_.side_of_face[f] == side_) faces.push_back(f);
        }
        return faces;
    }

    const Mesh& mesh_;
    const Sewn& sewn_;
    const std::vector<Index>& seam_;
    SeamSide side_;
};

// A sewn mesh with sheets in the place of some of its faces: its shape, and its attributes if asked
// for.
class Remade {
  public:
    // Errors: as Mesh::Mesh, if the new faces do not fit those around them.
    Remade(const Sewn& old, std::span<const SeamSheet> sheets, const Context& context)
        : old_(old), sheets_(sheets) {
        find_moved();
        for (const SeamSheet& sheet : sheets) {
            sheet_number_.emplace_back(at(sheet.vertex_count()), kNoIndex);
        }
        add_vertices();
        add_faces();
        shape_ = Mesh(std::move(positions_), std::move(faces_), context);
        for (const std::vector<Index>& seam : old.seams) {
            std::vector<Index>& renumbered = seams_.emplace_back();
            for (const Index v : seam) renumbered.push_back(number_[v]);
        }
    }

    const Mesh& shape() const { return shape_; }
    const std::vector<std::vector<Index>>& seams() const { return seams_; }
    // The faces made.
    const std::vector<Index>& made() const { return made_; }

    // From the elements of the new mesh to those of the old one.
    const MeshMap& step() {
        if (step_) return *step_;
        step_.emplace();
        step_->vertices.reserve(count_of(vertex_from_));
        step_->faces.reserve(count_of(face_from_));
        step_->corners.reserve(
            std::max(old_.mesh.topology().corner_count(), 3 * count_of(face_from_)));
        for (const Origin& from : vertex_from_) {
            if (from.sheet) {
                step_->vertices.add_blend(from.sheet->vertex_sources(from.element));
            } else {
                step_->vertices.add_copy(from.element);
            }
        }
        for (const Origin& from : face_from_) {
            if (from.sheet) {
                add_made_face(*from.sheet, triangles_[from.element]);
            } else {
                add_old_face(from.element);
            }
        }
        return *step_;
    }

    // The whole of it; to be asked for once, and last.
    Sewn sewn(const Context& context) {
        const MeshMap& map = step();
        Sewn result;
        result.mesh = std::move(shape_);
        carry(old_.mesh, map, result.mesh, context);
        result.map = composed(map, old_.map);
        result.place = places();
        result.side_of_face = std::move(sides_);
        result.seams = std::move(seams_);
        result.report = old_.report;
        result.first_source_vertex = first_source_vertex_;
        result.kept = old_.kept;
        return result;
    }

  private:
    static constexpr Index kGone = -2;

    // Vertices that sheets have moved stay in their places.
    Places places() const {
        Places place;
        // A mesh that was made elsewhere has none.
        if (old_.place.faces.empty()) return place;
        for (const Origin& from : vertex_from_) {
            const Index old = from.sheet ? from.sheet->mesh_vertex(from.element) : from.element;
            place.vertices.push_back(old == kNoIndex ? kNoIndex : old_.place.vertices[at(old)]);
        }
        for (const Origin& from : face_from_) {
            place.faces.push_back(from.sheet ? kNoIndex : old_.place.faces[at(from.element)]);
        }
        return place;
    }

    // An element of the old mesh, or, in a sheet, a vertex of that or a triangle made.
    struct Origin {
        const SeamSheet* sheet = nullptr;
        Index element = kNoIndex;
    };

    SeamSide side_of(const SeamSheet& sheet) const {
        return old_.side_of_face[sheet.faces().front()];
    }

    void find_moved() {
        number_.assign(old_.mesh.vertex_count(), kNoIndex);
        for (const SeamSheet& sheet : sheets_) {
            for (Index v = 0; v < sheet.vertex_count(); ++v) {
                const Index at = sheet.mesh_vertex(v);
                if (at == kNoIndex) continue;
                if (!sheet.is_used(v)) number_[at] = kGone;
                if (sheet.has_moved(v)) moved_.emplace(at, Origin{&sheet, v});
            }
        }
    }

    Index next_number() const { return count_of(positions_); }

    // New elements on a side come after the rest of it.
    void add_vertices() {
        for (Index v = 0; v < old_.mesh.vertex_count(); ++v) {
            if (v == old_.first_source_vertex) begin_source_vertices();
            if (number_[v] == kGone) continue;
            number_[v] = next_number();
            const auto moved = moved_.find(v);
            if (moved != moved_.end()) {
                add_vertex(*moved->second.sheet, moved->second.element);
            } else {
                positions_.push_back(old_.mesh.position(v));
                vertex_from_.push_back({nullptr, v});
            }
        }
        // The source may have no vertices but those of the seam.
        if (old_.first_source_vertex == old_.mesh.vertex_count()) begin_source_vertices();
        add_made_vertices(SeamSide::source);
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            for (Index v = 0; v < sheets_[s].vertex_count(); ++v) {
                const Index at = sheets_[s].mesh_vertex(v);
                if (at != kNoIndex) sheet_number_[s][v] = number_[at];
            }
        }
    }

    void begin_source_vertices() {
        add_made_vertices(SeamSide::target);
        first_source_vertex_ = next_number();
    }

    void add_made_vertices(SeamSide side) {
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            const SeamSheet& sheet = sheets_[s];
            for (Index v = 0; v < sheet.vertex_count() && side_of(sheet) == side; ++v) {
                if (sheet.mesh_vertex(v) != kNoIndex || !sheet.is_used(v)) continue;
                sheet_number_[s][v] = next_number();
                add_vertex(sheet, v);
            }
        }
    }

    void add_vertex(const SeamSheet& sheet, Index v) {
        positions_.push_back(sheet.position(v));
        vertex_from_.push_back({&sheet, v});
    }

    void add_faces() {
        std::vector<char> replaced(old_.mesh.face_count(), 0);
        for (const SeamSheet& sheet : sheets_) {
            for (const Index f : sheet.faces()) replaced[f] = 1;
        }
        bool at_source = false;
        std::vector<Index> vertices;
        for (Index f = 0; f < old_.mesh.face_count(); ++f) {
            if (!at_source && old_.side_of_face[f] == SeamSide::source) {
                add_triangles(SeamSide::target);
                at_source = true;
            }
            if (replaced[f]) continue;
            vertices.clear();
            for (const Index v : old_.mesh.topology().face(f)) vertices.push_back(number_[v]);
            add_face(vertices, {nullptr, f}, old_.side_of_face[f]);
        }
        add_triangles(SeamSide::source);
    }

    void add_triangles(SeamSide side) {
        for (std::size_t s = 0; s < sheets_.size(); ++s) {
            if (side_of(sheets_[s]) != side) continue;
            for (const Triangle& t : sheets_[s].triangles()) {
                std::array<Index, 3> vertices{};
                for (std::size_t k = 0; k < 3; ++k) vertices[k] = sheet_number_[s][t[k]];
                made_.push_back(faces_.size());
                add_face(vertices, {&sheets_[s], count_of(triangles_)}, side);
                triangles_.push_back(t);
            }
        }
    }

    void add_face(std::span<const Index> vertices, const Origin& from, SeamSide side) {
        faces_.add(vertices);
        face_from_.push_back(from);
        sides_.push_back(side);
    }

    void add_old_face(Index f) {
        const Topology& topology = old_.mesh.topology();
        const Index first = topology.first_corner(f), count = count_of(topology.face(f));
        for (Index k = 0; k < count; ++k) step_->corners.add_copy(first + k);
        step_->faces.add_copy(f);
    }

    void add_made_face(const SeamSheet& sheet, const Triangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
            step_->corners.add_blend(sheet.corner_sources(t, k));
        }
        step_->faces.add_copy(sheet.face_source(t));
    }

    const Sewn& old_;
    std::span<const SeamSheet> sheets_;
    std::unordered_map<Index, Origin> moved_;
    std::vector<Index> number_;
    std::vector<std::vector<Index>> sheet_number_;
    std::vector<Vec3> positions_;
    FaceList faces_;
    Mesh shape_;
    std::vector<std::vector<Index>> seams_;
    std::vector<SeamSide> sides_;
    std::vector<Index> made_;
    std::vector<Triangle> triangles_;
    std::vector<Origin> vertex_from_, face_from_;
    Index first_source_vertex_ = 0;
    std::optional<MeshMap> step_;
};

// Nothing if the new faces do not fit those around them: a sheet does not see edges beyond it.
std::optional<Remade> remade_with(const Sewn& old, std::span<const SeamSheet> sheets,
                                  const Context& context) {
    try {
        return std::optional<Remade>(std::in_place, old, sheets, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::nonmanifold_edge &&
            error.code() != ErrorCode::nonmanifold_vertex &&
            error.code() != ErrorCode::duplicate_face) {
            throw;
        }
        return std::nullopt;
    }
}

// Whether the seams are no worse for it, and nothing runs through anything that did not. `before`
// is the quality of the old seams.
bool is_kept(const Sewn& old, const SeamQuality& before, Remade& remade, const Context& context) {
    const SeamQuality after = seam_quality(remade.shape(), remade.seams());
    const double least = std::min(before.smallest_angle, kGoodSeamAngle);
    const auto map = [&]() -> const MeshMap& { return remade.step(); };
    return after.max_dihedral <= before.max_dihedral + kSameQuality &&
           after.max_near <= before.max_near + kSameQuality &&
           after.smallest_angle >= least - kSameQuality &&
           !adds_crossings(old.mesh, remade.shape(), map, remade.made(), context);
}

// Edges of a side that turn by more than this are not flipped once the seam was smoothed.
constexpr double kFlippedCrease = 30.0 * kDegree;

// Collars that take away more than this many cubes of the seam's radius bite edges of the side.
// They may add: faces towards a finer loop enclose more than those they replace.
constexpr double kCollarBite = 0.03;

double volume_below(const Mesh& mesh, std::span<const Index> faces, const Vec3& apex) {
    double sum = 0.0;
    for (const Index f : faces) {
        const Vec3 arm = mesh.position(mesh.topology().face(f)[0]) - apex;
        sum += arm.dot(area_vector(mesh, f)) / 6.0;
    }
    return sum;
}

// Returns whether the faces made enclose less than those that they replace.
bool bites(const Sewn& old, std::span<const Index> faces, std::size_t seam, const Remade& remade) {
    const std::vector<Index>& loop = old.seams[seam];
    const Vec3& apex = old.mesh.position(loop.front());
    const double change =
        volume_below(remade.shape(), remade.made(), apex) - volume_below(old.mesh, faces, apex);
    const double radius = loop_radius(old.mesh, loop);
    return change < -kCollarBite * radius * radius * radius;
}

// The smallest angle of the triangles made that touch a seam.
double min_angle_beside(const Remade& remade, std::size_t seam) {
    const Mesh& mesh = remade.shape();
    const std::set<Index> on(remade.seams()[seam].begin(), remade.seams()[seam].end());
    double least = kPi;
    for (const Index f : remade.made()) {
        const std::span<const Index> face = mesh.topology().face(f);
        if (std::none_of(face.begin(), face.end(), [&](Index v) { return on.contains(v); })) {
            continue;
        }
        least = std::min(least, smallest_face_angle(mesh, f));
    }
    return least;
}

SheetLimits limits_of(const SeamQuality& now, double allowed) {
    return {std::min(allowed, now.max_dihedral), std::min(allowed, now.max_near)};
}

void make_collar(Sewn& sewn, std::size_t seam, SeamSide side, const Context& context) {
    const CollarSide at(sewn, seam, side);
    const double seam_edge = at.seam_edge();
    // A side may have no edges but the seam's, and slivers beside it.
    double side_edge = std::max(at.side_edge(), seam_edge);
    const bool sparse = side_edge > kClearlyLonger * kSparse * seam_edge;
    if (!sparse && !(at.smallest_angle() < kSliver)) return;
    // Needles would become thousands of triangles each if none were to be longer than they are
    // wide.
    if (!sparse) side_edge = std::max(side_edge, at.edge_to_seam());
    const SeamSizes sizes(at.points(), side_edge);
    const std::vector<Index> faces = at.faces(sizes, side_edge);
    const SeamQuality now = seam_quality(sewn.mesh, sewn.seams);
    const SheetLimits limits = limits_of(now, kRemeshedDihedral);
    const SheetLimits flips = limits_of(now, kFlippedDihedral);
    // If sharp edges alone leave slivers, or faces that run through one another, all do better.
    std::vector<SeamSheet> sheets;
    sheets.reserve(2);
    std::optional<Remade> best;
    double least = 0.0;
    for (const double sharp : {kSharp, kAllEdges}) {
        SeamSheet& sheet = sheets.emplace_back(sewn.mesh, faces, sewn.seams, sharp, context);
        sheet.remesh([&](const Vec3& p) { return sizes.at(p); }, limits, flips, context);
        std::optional<Remade> remade = remade_with(sewn, {&sheet, 1}, context);
        if (!remade) continue;
        const double angle = min_angle_beside(*remade, seam);
        if (best && angle <= least + kSameQuality) continue;
        if (bites(sewn, faces, seam, *remade)) continue;
        if (!is_kept(sewn, now, *remade, context)) continue;
        best.emplace(*std::move(remade));
        least = angle;
        if (least > kGoodSeamAngle) break;
    }
    if (!best) return;
    Sewn made = best->sewn(context);
    made.report.collar_removed += count_of(faces);
    made.report.collar_added += count_of(best->made());
    sewn = std::move(made);
}

}  // namespace

void make_collars(Sewn& sewn, const Context& context) {
    for (std::size_t seam = 0; seam < sewn.seams.size(); ++seam) {
        if (!sewn.kept.empty() && sewn.kept[seam]) continue;
        for (const SeamSide side : {SeamSide::target, SeamSide::source}) {
            make_collar(sewn, seam, side, context);
        }
    }
}

void flip_near_seams(Sewn& sewn, const Context& context) {
    const Topology& topology = sewn.mesh.topology();
    std::set<Index> near;
    for (const std::vector<Index>& seam : worked_seams(sewn)) {
        for (const Index v : seam) {
            near.insert(v);
            near.insert(topology.neighbors(v).begin(), topology.neighbors(v).end());
        }
    }
    std::set<Index> faces[2];
    for (const Index v : near) {
        for (const Index f : topology.faces_around(v)) {
            if (topology.face(f).size() != 3) continue;
            faces[sewn.side_of_face[f] == SeamSide::source ? 1 : 0].insert(f);
        }
    }
    const SeamQuality now = seam_quality(sewn.mesh, sewn.seams);
    const SheetLimits limits = limits_of(now, kFlippedDihedral);
    std::vector<SeamSheet> sheets;
    sheets.reserve(2);
    Index flips = 0;
    for (const std::set<Index>& side : faces) {
        if (side.empty()) continue;
        SeamSheet& sheet =
            sheets.emplace_back(sewn.mesh, std::vector<Index>(side.begin(), side.end()), sewn.seams,
                                kFlippedCrease, context);
        flips += sheet.flip_edges(limits, context);
    }
    if (flips == 0) return;
    std::optional<Remade> remade = remade_with(sewn, sheets, context);
    if (!remade || !is_kept(sewn, now, *remade, context)) return;
    sewn = remade->sewn(context);
    sewn.report.flipped += flips;
}

}  // namespace lissom
