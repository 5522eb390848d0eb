#include "kernel/thesis/transition/thesis_band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/patch/operators.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// Cotangents count as at least this, so that no triangle of the square turns over.
constexpr double kMinCotangent = 0.05;
constexpr double kNotReached = std::numeric_limits<double>::infinity();

using Edge = std::pair<Index, Index>;

[[noreturn]] void refuse(SeamSide side, const char* what) {
    throw Error(ErrorCode::invalid_argument, std::string("the transition region of the ") +
                                                 (side == SeamSide::target ? "target" : "source") +
                                                 " " + what);
}

double fraction_of(double turn) {
    return turn - std::floor(turn);
}

// The faces of the region, with those that hang together with the loop.
MeshPart region_of(const Mesh& mesh, SeamSide side, std::span<const Index> loop, double width,
                   const Context& context) {
    const std::vector<double> path = edge_distances(mesh, loop, width, context);
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        const auto near = [&](Index v) { return path[v] < width; };
        if (std::all_of(face.begin(), face.end(), near)) faces.push_back(f);
    }
    if (faces.empty()) refuse(side, "is narrower than its faces; make it wider");
    // Attributes stay behind.
    const Mesh shape({mesh.positions().begin(), mesh.positions().end()}, mesh.shared_topology());
    const MeshPart all = extract_faces(shape, faces, context);
    const std::vector<Index>& component = all.mesh.topology().components();
    Index wanted = kNoIndex;
    for (Index v = 0; v < all.mesh.vertex_count() && wanted == kNoIndex; ++v) {
        if (all.vertex_map[v] == loop.front()) wanted = component[v];
    }
    std::vector<Index> kept;
    for (Index f = 0; f < all.mesh.face_count(); ++f) {
        if (component[all.mesh.topology().face(f)[0]] == wanted) kept.push_back(all.face_map[f]);
    }
    if (kept.empty()) refuse(side, "is narrower than its faces; make it wider");
    return extract_faces(shape, kept, context);
}

// The outlines of a region beside that at one of its vertices, the longest first.
std::vector<std::vector<Index>> other_outlines(const Mesh& region, Index at_loop) {
    const auto length = [&](const std::vector<Index>& outline) {
        double sum = 0.0;
        for (std::size_t k = 0; k < outline.size(); ++k) {
            sum +=
                (region.position(outline[(k + 1) % outline.size()]) - region.position(outline[k]))
                    .norm();
        }
        return sum;
    };
    std::vector<std::vector<Index>> others;
    for (const std::vector<Index>& outline : region.topology().boundary_loops()) {
        if (std::find(outline.begin(), outline.end(), at_loop) != outline.end()) continue;
        others.push_back(outline);
    }
    const auto farthest =
        std::max_element(others.begin(), others.end(),
                         [&](const auto& a, const auto& b) { return length(a) < length(b); });
    if (farthest != others.end()) std::iter_swap(others.begin(), farthest);
    return others;
}

// The region opened to a disk and laid over the square. Vertices are those of the region, and
// behind them one for each outline that is neither the loop nor the far end.
class Square {
  public:
    Square(const Mesh& region, const BandLoop& loop, std::vector<Index> local_loop)
        : region_(region),
          given_(loop),
          loop_(std::move(local_loop)),
          start_(loop.start),
          points_(region.positions().begin(), region.positions().end()),
          triangles_(triangulate_faces(region.topology(), region.positions()).triangles),
          own_triangles_(triangles_.size()) {
        require_band();
        close_outlines();
        find_cut();
        fix_sides();
    }

    // Along the seam and away from it, 0 to 1, of every vertex of the region.
    std::vector<Vec2> solve(const Context& context) const;
    std::vector<Vec2> solve_rows(const Rings& rings, const RingGeometry& geometry,
                                 const std::vector<Index>& row, Index rows,
                                 const Context& context) const;
    Index start() const { return start_; }
    const std::vector<Index>& cut() const { return cut_; }
    std::span<const Triangle> triangles() const { return {triangles_.data(), own_triangles_}; }

  private:
    void require_band() const;
    void close_outlines();
    std::vector<Index> path_from(Index first) const;
    void find_cut();
    void mark_left();
    void fix_sides();
    bool seam_turns_left() const { return given_.side == SeamSide::source; }
    Vec2 fixed_value(Index v, Index seen_from) const;

    const Mesh& region_;
    const BandLoop& given_;
    std::vector<Index> loop_, far_, cut_;
    Index start_;
    std::vector<Vec3> points_;
    std::vector<Triangle> triangles_;
    std::size_t own_triangles_;
    // Coordinates of vertices on the sides; those of the cut are on both, `left_` holds the edges
    // from them to their left side.
    std::map<Index, Vec2> fixed_;
    std::set<Index> on_cut_;
    std::set<Edge> left_;
};

void Square::require_band() const {
    const auto& outlines = region_.topology().boundary_loops();
    std::size_t edges = 3 * triangles_.size(), on_loop = 0;
    for (const std::vector<Index>& outline : outlines) {
        edges += outline.size();
        if (std::find(outline.begin(), outline.end(), loop_[start_]) != outline.end()) {
            on_loop = outline.size();
        }
    }
    if (on_loop != loop_.size()) refuse(given_.side, "is narrower than its faces; make it wider");
    if (outlines.size() < 2) {
        refuse(given_.side, "reaches beyond the farthest vertex of its part; make it narrower");
    }
    const auto characteristic = static_cast<std::ptrdiff_t>(points_.size() + triangles_.size()) -
                                static_cast<std::ptrdiff_t>(edges / 2);
    if (characteristic != 2 - std::ssize(outlines)) {
        refuse(given_.side, "has a handle and cannot be unrolled; make it narrower");
    }
}

void Square::close_outlines() {
    const std::vector<std::vector<Index>> others = other_outlines(region_, loop_[start_]);
    far_ = others.front();
    for (const std::vector<Index>& outline : std::span(others).subspan(1)) {
        const auto center = count_of(points_);
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < outline.size(); ++k) {
            sum += points_[outline[k]];
            triangles_.push_back({outline[(k + 1) % outline.size()], outline[k], center});
        }
        points_.emplace_back(sum / count_of(outline));
    }
}

// The shortest path from a vertex of the loop to the far end that leaves the loop at once.
std::vector<Index> Square::path_from(Index first) const {
    std::vector<double> way(region_.vertex_count(), kNotReached);
    std::vector<Index> before(way.size(), kNoIndex);
    std::vector<char> barred(way.size(), 0), end(way.size(), 0);
    for (const Index v : loop_) barred[v] = 1;
    for (const Index v : far_) end[v] = 1;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    way[first] = 0.0;
    front.emplace(0.0, first);
    while (!front.empty()) {
        const auto [d, v] = front.top();
        front.pop();
        if (d > way[v]) continue;
        if (end[v]) {
            std::vector<Index> path;
            for (Index at = v; at != kNoIndex; at = before[at]) path.push_back(at);
            std::reverse(path.begin(), path.end());
            return path;
        }
        for (const Index n : region_.topology().neighbors(v)) {
            const double to = d + (points_[n] - points_[v]).norm();
            if (barred[n] || !(to < way[n])) continue;
            way[n] = to;
            before[n] = v;
            front.emplace(to, n);
        }
    }
    return {};
}

// A vertex of the loop with no edge into the region passes the cut on to the next.
void Square::find_cut() {
    const auto n = count_of(loop_);
    for (Index step = 0; step < n && cut_.empty(); ++step) {
        start_ = (given_.start + step) % n;
        cut_ = path_from(loop_[start_]);
    }
    if (cut_.size() < 2) refuse(given_.side, "is too narrow to be cut open; make it wider");
    on_cut_.insert(cut_.begin(), cut_.end());
    mark_left();
}

// Turns about every vertex of the cut over the elements on its left.
void Square::mark_left() {
    std::map<Edge, Index> third;
    for (const Triangle& t : triangles_) {
        for (std::size_t k = 0; k < 3; ++k) third[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    }
    const auto sweep = [&](Index v, Index from, Index until, bool onward) {
        while (true) {
            const auto next = third.find(onward ? Edge{v, from} : Edge{from, v});
            if (next == third.end() || next->second == until) return;
            from = next->second;
            left_.insert({v, from});
        }
    };
    for (std::size_t k = 0; k < cut_.size(); ++k) {
        const Index before = k > 0 ? cut_[k - 1] : kNoIndex;
        if (k + 1 < cut_.size()) {
            sweep(cut_[k], cut_[k + 1], before, true);
        } else {
            sweep(cut_[k], before, kNoIndex, false);
        }
    }
}

void Square::fix_sides() {
    const double origin = given_.fraction[start_];
    for (std::size_t k = 0; k < loop_.size(); ++k) {
        fixed_[loop_[k]] = {fraction_of(given_.fraction[k] - origin), 0.0};
    }
    // Outlines have the region on their left, so that the far end of a target runs against the
    // seam.
    std::rotate(far_.begin(), std::find(far_.begin(), far_.end(), cut_.back()), far_.end());
    if (!seam_turns_left()) std::reverse(far_.begin() + 1, far_.end());
    std::vector<Vec3> points;
    for (const Index v : far_) points.push_back(points_[v]);
    const std::vector<double> around = loop_fractions(points);
    for (std::size_t k = 0; k < far_.size(); ++k) fixed_[far_[k]] = {around[k], 1.0};
    std::vector<double> along{0.0};
    for (std::size_t k = 1; k < cut_.size(); ++k) {
        along.push_back(along.back() + (points_[cut_[k]] - points_[cut_[k - 1]]).norm());
    }
    for (std::size_t k = 0; k < cut_.size(); ++k) {
        fixed_[cut_[k]] = {0.0, along.back() > 0.0 ? along[k] / along.back() : 0.0};
    }
}

Vec2 Square::fixed_value(Index v, Index seen_from) const {
    Vec2 value = fixed_.at(v);
    if (on_cut_.count(v) > 0 && (left_.count({v, seen_from}) > 0) != seam_turns_left()) {
        value.x() = 1.0;
    }
    return value;
}

std::vector<Vec2> Square::solve(const Context& context) const {
    WeightedTriangles weighted;
    for (const Triangle& t : triangles_) weighted.add(t, 1.0, 0);
    const Rings rings = build_rings(count_of(points_), weighted);
    const RingGeometry geometry = ring_geometry(rings, weighted, points_);
    std::vector<Index> row(points_.size(), kNoIndex);
    Index rows = 0;
    for (Index v = 0; v < rings.size(); ++v) {
        if (fixed_.count(v) == 0 && rings.count(v) > 0) row[v] = rows++;
    }
    std::vector<Vec2> free(rows, Vec2::Zero());
    if (rows > 0) free = solve_rows(rings, geometry, row, rows, context);
    std::vector<Vec2> result;
    for (Index v = 0; v < region_.vertex_count(); ++v) {
        result.emplace_back(row[v] == kNoIndex ? fixed_.at(v) : free[row[v]]);
    }
    return result;
}

// The harmonic values of the vertices that have rows.
std::vector<Vec2> Square::solve_rows(const Rings& rings, const RingGeometry& geometry,
                                     const std::vector<Index>& row, Index rows,
                                     const Context& context) const {
    const std::size_t n = rows;
    std::vector<Triplet> entries;
    std::vector<double> b(2 * n, 0.0);
    for (Index v = 0; v < rings.size(); ++v) {
        if (row[v] == kNoIndex) continue;
        for (Index e = rings.begin[v]; e < rings.begin[v + 1]; ++e) {
            const Index w = rings.neighbor[e];
            const double weight = std::max(kMinCotangent, geometry.cotangent[e]);
            entries.push_back({row[v], row[v], weight});
            if (row[w] != kNoIndex) {
                entries.push_back({row[v], row[w], -weight});
                continue;
            }
            const Vec2 value = weight * fixed_value(w, v);
            b[row[v]] += value.x();
            b[n + row[v]] += value.y();
        }
    }
    const SymmetricMatrix matrix = symmetric_from_triplets(rows, entries);
    SparseSystem system;
    system.analyze(matrix, context);
    system.factor(matrix, context);
    system.solve(b, b, 2);
    std::vector<Vec2> values;
    for (std::size_t i = 0; i < n; ++i) values.emplace_back(b[i], b[n + i]);
    return values;
}

std::vector<double> own_fractions(const Mesh& mesh, std::span<const Index> loop) {
    std::vector<Vec3> points;
    for (const Index v : loop) points.push_back(mesh.position(v));
    return loop_fractions(points);
}

// A region with the loop in its numbers.
struct LocalRegion {
    MeshPart part;
    std::vector<Index> loop;
};

LocalRegion local_region(const Mesh& mesh, SeamSide side, std::span<const Index> loop, double width,
                         const Context& context) {
    LocalRegion result;
    result.part = region_of(mesh, side, loop, width, context);
    std::map<Index, Index> local;
    for (std::size_t i = 0; i < result.part.vertex_map.size(); ++i) {
        local.emplace(result.part.vertex_map[i], index_of(i));
    }
    for (const Index v : loop) {
        if (local.count(v) == 0) refuse(side, "is narrower than its faces; make it wider");
        result.loop.push_back(local.at(v));
    }
    return result;
}

}  // namespace

BandLoop target_band_loop(const Mesh& target, std::vector<Index> loop, Index start) {
    std::vector<double> fractions = own_fractions(target, loop);
    return {SeamSide::target, std::move(loop), std::move(fractions), start};
}

ThesisRegion make_thesis_region(const Mesh& mesh, SeamSide side, std::span<const Index> loop,
                                double width, const Context& context) {
    const LocalRegion region = local_region(mesh, side, loop, width, context);
    const auto others = other_outlines(region.part.mesh, region.loop.front());
    if (others.empty()) {
        refuse(side, "reaches beyond the farthest vertex of its part; make it narrower");
    }
    ThesisRegion result{region.part.face_map, {}};
    for (const Index v : others.front()) result.end.push_back(region.part.vertex_map[v]);
    std::reverse(result.end.begin(), result.end.end());
    return result;
}

Index cut_end(const Mesh& mesh, const BandLoop& loop, double width, const Context& context) {
    LocalRegion region = local_region(mesh, loop.side, loop.vertices, width, context);
    const Square square(region.part.mesh, loop, std::move(region.loop));
    return region.part.vertex_map[square.cut().back()];
}

BandLoop source_band_loop(const Mesh& target, const LoopPair& pair, Index start) {
    const std::vector<double> at = own_fractions(target, pair.target);
    BandLoop loop{SeamSide::source, pair.source, {}, start};
    for (const LoopPoint& place : pair.on_target) {
        const std::size_t k = place.segment;
        const double end = k + 1 < at.size() ? at[k + 1] : 1.0;
        loop.fraction.push_back(at[k] + place.t * (end - at[k]));
    }
    return loop;
}

ThesisBand make_thesis_band(const Mesh& mesh, const BandLoop& loop, double width,
                            const Context& context) {
    LocalRegion local = local_region(mesh, loop.side, loop.vertices, width, context);
    const MeshPart& region = local.part;
    const Square square(region.mesh, loop, std::move(local.loop));
    const std::vector<Vec2> at = square.solve(context);
    ThesisBand band;
    band.width = width;
    band.chart.side = loop.side;
    band.chart.vertex = region.vertex_map;
    band.chart.triangles.assign(square.triangles().begin(), square.triangles().end());
    const double origin = loop.fraction[square.start()];
    for (std::size_t i = 0; i < at.size(); ++i) {
        band.chart.angle.push_back(fraction_of(origin + at[i].x()));
        band.chart.distance.push_back(width * at[i].y());
    }
    for (const Index v : square.cut()) band.cut.push_back(region.vertex_map[v]);
    return band;
}

}  // namespace lissom
