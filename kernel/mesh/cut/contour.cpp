#include "kernel/mesh/cut/contour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lissom {
namespace {

std::uint64_t key_of(Index a, Index b) {
    return pair_key(std::min(a, b), std::max(a, b));
}

// Zeros that hang together take one side: the negative one if they have no positive neighbour but a
// negative one.
void decide_zeros(const Topology& topology, LevelSet& levels) {
    std::vector<Index> zeros;
    const auto is_open = [&](Index v) { return levels.value[v] == 0.0 && levels.side[v] == 0; };
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (!is_open(v)) continue;
        bool positive = false, negative = false;
        zeros.assign(1, v);
        levels.side[v] = 1;
        for (std::size_t i = 0; i < zeros.size(); ++i) {
            for (const Index n : topology.neighbors(zeros[i])) {
                positive = positive || levels.value[n] > 0.0;
                negative = negative || levels.value[n] < 0.0;
                if (!is_open(n)) continue;
                levels.side[n] = 1;
                zeros.push_back(n);
            }
        }
        if (positive || !negative) continue;
        for (const Index zero : zeros) levels.side[zero] = -1;
    }
}

// Faces that have vertices on both sides and values at all.
std::vector<Index> mixed_faces(const Topology& topology, const LevelSet& levels) {
    std::vector<Index> faces;
    for (Index f = 0; f < topology.face_count(); ++f) {
        bool positive = false, negative = false, complete = true;
        for (const Index v : topology.face(f)) {
            positive = positive || levels.side[v] > 0;
            negative = negative || levels.side[v] < 0;
            complete = complete && levels.side[v] != 0;
        }
        if (positive && negative && complete) faces.push_back(f);
    }
    return faces;
}

// Joins the pieces of contours, one in each mixed triangle, to lines. A piece enters its triangle
// across the edge that the triangle runs from + to -, and leaves across the one from - to +.
class Tracer {
  public:
    Tracer(const Mesh& mesh, const LevelSet& levels)
        : mesh_(mesh),
          levels_(levels),
          triangulation_(triangulate_faces(mesh.topology(), mesh.positions(),
                                           mixed_faces(mesh.topology(), levels))) {
        for (std::size_t i = 0; i < triangulation_.triangles.size(); ++i) add_piece(i);
    }

    std::vector<ContourLine> lines(const Context& context) {
        std::vector<ContourLine> lines;
        std::vector<char> done(pieces_.size(), 0);
        // Open lines first, from their starts.
        for (const bool open : {true, false}) {
            for (std::size_t i = 0; i < pieces_.size(); ++i) {
                const bool starts = !piece_leaving_at_.contains(pieces_[i].enter);
                if (done[i] || starts != open) continue;
                context.checkpoint();
                lines.push_back(follow(i, done));
            }
        }
        std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
            return *std::min_element(a.faces.begin(), a.faces.end()) <
                   *std::min_element(b.faces.begin(), b.faces.end());
        });
        return lines;
    }

  private:
    struct Piece {
        std::size_t triangle;
        std::uint64_t enter, leave;
    };

    void add_piece(std::size_t i) {
        const Triangle& t = triangulation_.triangles[i];
        Piece piece{i, 0, 0};
        bool crossed = false;
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (levels_.side[a] == levels_.side[b]) continue;
            crossed = true;
            (levels_.side[a] > 0 ? piece.enter : piece.leave) = key_of(a, b);
        }
        if (!crossed) return;
        const bool first_entering = piece_entering_at_.emplace(piece.enter, pieces_.size()).second;
        const bool first_leaving = piece_leaving_at_.emplace(piece.leave, pieces_.size()).second;
        if (!first_entering || !first_leaving) refuse_shared_diagonal(t);
        pieces_.push_back(piece);
    }

    [[noreturn]] static void refuse_shared_diagonal(const Triangle& t) {
        throw Error(ErrorCode::nonmanifold_edge,
                    "polygons that the cut crosses share a diagonal; triangulate the mesh first",
                    {ElementKind::vertex, 3, {t[0], t[1], t[2]}});
    }

    ContourLine follow(std::size_t piece, std::vector<char>& done) const {
        ContourLine line;
        const std::uint64_t start = pieces_[piece].enter;
        line.crossings.push_back(crossing(start));
        while (true) {
            done[piece] = 1;
            const Piece& here = pieces_[piece];
            line.triangles.push_back(triangulation_.triangles[here.triangle]);
            line.faces.push_back(triangulation_.face[here.triangle]);
            line.closed = here.leave == start;
            if (line.closed) return line;
            line.crossings.push_back(crossing(here.leave));
            const auto next = piece_entering_at_.find(here.leave);
            if (next == piece_entering_at_.end()) break;
            piece = next->second;
        }
        line.clipped =
            !ends_at_boundary(line.crossings.front()) || !ends_at_boundary(line.crossings.back());
        return line;
    }

    Crossing crossing(std::uint64_t key) const {
        Index a = index_of(key >> 32), b = index_of(key & 0xffffffffu);
        if (levels_.side[a] < 0) std::swap(a, b);
        const double from = std::abs(levels_.value[a]), to = std::abs(levels_.value[b]);
        return {a, b, from + to > 0.0 ? from / (from + to) : 0.5};
    }

    bool ends_at_boundary(const Crossing& end) const {
        const std::span<const Index> ring = mesh_.topology().neighbors(end.positive);
        return mesh_.topology().is_boundary(end.positive) &&
               (ring.front() == end.negative || ring.back() == end.negative);
    }

    const Mesh& mesh_;
    const LevelSet& levels_;
    Triangulation triangulation_;
    std::vector<Piece> pieces_;
    std::unordered_map<std::uint64_t, std::size_t> piece_entering_at_, piece_leaving_at_;
};

}  // namespace

LevelSet level_set(const Topology& topology, std::vector<double> value, double tolerance) {
    LevelSet levels{std::move(value), {}};
    levels.side.assign(levels.value.size(), 0);
    for (std::size_t v = 0; v < levels.value.size(); ++v) {
        double& x = levels.value[v];
        if (std::abs(x) <= tolerance) x = 0.0;
        if (x != 0.0 && !std::isnan(x)) levels.side[v] = x > 0.0 ? 1 : -1;
    }
    decide_zeros(topology, levels);
    return levels;
}

Vec3 Crossing::point(const Mesh& mesh) const {
    return (1.0 - t) * mesh.position(positive) + t * mesh.position(negative);
}

std::vector<Vec3> ContourLine::points(const Mesh& mesh) const {
    std::vector<Vec3> points;
    points.reserve(crossings.size());
    for (const Crossing& c : crossings) points.push_back(c.point(mesh));
    return points;
}

std::vector<ContourLine> trace_contours(const Mesh& mesh, const LevelSet& levels,
                                        const Context& context) {
    return Tracer(mesh, levels).lines(context);
}

CrossedEdges::CrossedEdges(const std::vector<ContourLine>& lines) {
    for (const ContourLine& line : lines) {
        first_.push_back(size());
        for (const Crossing& c : line.crossings) {
            number_.emplace(key_of(c.positive, c.negative), size());
            crossings_.push_back(c);
        }
    }
}

Index CrossedEdges::find(Index a, Index b) const {
    const auto found = number_.find(key_of(a, b));
    return found == number_.end() ? kNoIndex : found->second;
}

}  // namespace lissom
