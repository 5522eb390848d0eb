#include "kernel/mesh/unwrap/flat_chart.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/mesh/parameterize/parameterize.h"

namespace lissom {
namespace {

constexpr Index kFlatIterations = 10;
// Holes that are closed and not cut to the outline: at most so many edges, and so long.
constexpr std::size_t kSmallHole = 64;
constexpr double kShortHole = 0.1;
constexpr int kMostCuts = 4;
constexpr double kOutliers = 0.02;

// The vertices of faces once edges are cut: corners that edges join share one.
class OpenFaces {
  public:
    OpenFaces(const FaceGraph& graph, std::span<const Index> faces,
              const std::unordered_set<Index>& cut)
        : graph_(graph), faces_(faces) {
        number_corners();
        join_corners(cut);
        number_vertices();
    }

    Index vertex_count() const { return count_of(positions_); }
    const std::vector<Vec3>& positions() const { return positions_; }
    const FaceList& list() const { return list_; }
    // The vertex of each corner of the faces, in turn.
    const std::vector<Index>& places() const { return places_; }

    // The corner of the mesh that runs from a vertex to another, or kNoIndex.
    Index corner_along(Index from, Index to) const {
        const auto found = corner_of_edge_.find(pair_key(from, to));
        return found == corner_of_edge_.end() ? kNoIndex : found->second;
    }

  private:
    void number_corners() {
        const Topology& topology = graph_.mesh().topology();
        for (const Index f : faces_) {
            for (Index c = topology.first_corner(f); c < topology.first_corner(f + 1); ++c) {
                number_[c] = count_of(corners_);
                corners_.push_back(c);
            }
        }
        root_.resize(corners_.size());
        std::iota(root_.begin(), root_.end(), 0);
    }

    Index root(Index corner) {
        while (root_[at(corner)] != corner) {
            root_[at(corner)] = root_[at(root_[at(corner)])];
            corner = root_[at(corner)];
        }
        return corner;
    }

    void join(Index a, Index b) {
        const Index x = root(a), y = root(b);
        root_[at(std::max(x, y))] = std::min(x, y);
    }

    void join_corners(const std::unordered_set<Index>& cut) {
        for (const Index c : corners_) {
            const Index twin = graph_.twin(c);
            const auto other = twin == kNoIndex ? number_.end() : number_.find(twin);
            if (other == number_.end() || cut.contains(c) || cut.contains(twin)) continue;
            join(number_.at(c), number_.at(graph_.next(twin)));
            join(number_.at(graph_.next(c)), other->second);
        }
    }

    void number_vertices() {
        const Topology& topology = graph_.mesh().topology();
        std::vector<Index> vertex(corners_.size(), kNoIndex);
        for (Index i = 0; i < count_of(corners_); ++i) {
            const Index of = root(i);
            if (vertex[at(of)] == kNoIndex) {
                vertex[at(of)] = count_of(positions_);
                positions_.push_back(
                    graph_.mesh().position(topology.faces().vertices[at(corners_[at(of)])]));
            }
            places_.push_back(vertex[at(of)]);
        }
        std::size_t first = 0;
        for (const Index f : faces_) {
            const std::size_t count = topology.face(f).size();
            list_.add(std::span(places_).subspan(first, count));
            for (std::size_t k = 0; k < count; ++k) {
                const Index to = places_[first + (k + 1) % count];
                corner_of_edge_[pair_key(places_[first + k], to)] = corners_[first + k];
            }
            first += count;
        }
    }

    const FaceGraph& graph_;
    std::span<const Index> faces_;
    std::unordered_map<Index, Index> number_;
    std::vector<Index> corners_, root_, places_;
    std::vector<Vec3> positions_;
    FaceList list_;
    std::unordered_map<std::uint64_t, Index> corner_of_edge_;
};

double loop_length_of(const Mesh& part, std::span<const Index> loop) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        length += (part.position(loop[(i + 1) % loop.size()]) - part.position(loop[i])).norm();
    }
    return length;
}

// The shortest way over inner vertices from one loop to any of the others that are not small.
std::vector<Index> way_between_loops(const Mesh& part, Index from, const std::vector<bool>& small) {
    const Topology& topology = part.topology();
    const auto& loops = topology.boundary_loops();
    std::vector<Index> loop_of(at(part.vertex_count()), kNoIndex), before = loop_of;
    for (Index l = 0; l < count_of(loops); ++l) {
        for (const Index v : loops[at(l)]) loop_of[at(v)] = l;
    }
    std::vector<double> cost(at(part.vertex_count()), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const Index v : loops[at(from)]) {
        cost[at(v)] = 0.0;
        queue.push({0.0, v});
    }
    while (!queue.empty()) {
        const auto [so_far, v] = queue.top();
        queue.pop();
        if (so_far > cost[at(v)]) continue;
        const Index loop = loop_of[at(v)];
        if (loop != kNoIndex && loop != from) {
            if (small[at(loop)]) continue;
            std::vector<Index> way = {v};
            while (before[at(way.back())] != kNoIndex) way.push_back(before[at(way.back())]);
            return way;
        }
        for (const Index w : topology.neighbors(v)) {
            const double next = so_far + (part.position(w) - part.position(v)).norm();
            if (next >= cost[at(w)] || loop_of[at(w)] == from) continue;
            cost[at(w)] = next;
            before[at(w)] = v;
            queue.push({next, w});
        }
    }
    return {};
}

class ChartFlattener {
  public:
    ChartFlattener(const FaceGraph& graph, std::span<const Index> faces, const Context& context)
        : graph_(graph), faces_(faces), context_(context) {}

    std::optional<FlatChart> run(double stretch) {
        std::unordered_set<Index> cut;
        for (int i = 0; i <= kMostCuts; ++i) {
            const OpenFaces open(graph_, faces_, cut);
            const Mesh part(open.positions(), open.list(), context_);
            if (handles(part.topology()) != 0 || part.topology().is_closed()) return {};
            if (!cut_open(part, open, cut)) return laid_out(part, open, stretch);
        }
        return {};
    }

  private:
    static Index handles(const Topology& topology) {
        const Index euler = topology.vertex_count() - topology.edge_count() + topology.face_count();
        return (2 - count_of(topology.boundary_loops()) - euler) / 2;
    }

    // Adds a seam between two loops that are not small; false if there is one such loop alone.
    static bool cut_open(const Mesh& part, const OpenFaces& open, std::unordered_set<Index>& cut) {
        const auto& loops = part.topology().boundary_loops();
        std::vector<double> lengths;
        for (const auto& loop : loops) lengths.push_back(loop_length_of(part, loop));
        const auto longest = std::max_element(lengths.begin(), lengths.end());
        std::vector<bool> small;
        for (std::size_t l = 0; l < loops.size(); ++l) {
            small.push_back(loops[l].size() <= kSmallHole && lengths[l] < kShortHole * *longest);
        }
        const auto outer = static_cast<std::size_t>(longest - lengths.begin());
        if (std::count(small.begin(), small.end(), false) == 1) return false;
        const std::vector<Index> way = way_between_loops(part, index_of(outer), small);
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            for (const Index c :
                 {open.corner_along(way[i], way[i + 1]), open.corner_along(way[i + 1], way[i])}) {
                if (c != kNoIndex) cut.insert(c);
            }
        }
        return way.size() > 1;
    }

    std::optional<FlatChart> laid_out(const Mesh& part, const OpenFaces& open, double stretch) {
        std::vector<Index> all(at(part.face_count()));
        std::iota(all.begin(), all.end(), 0);
        ParameterizeOptions options;
        options.maximum_iterations = kFlatIterations;
        const Parameterization map = parameterize(part, all, options, context_);
        if (!map.flipped.empty() || map.boundary_crossings > 0) return {};
        if (count_of(map.vertex) != part.vertex_count()) return {};
        FlatChart chart;
        chart.faces.assign(faces_.begin(), faces_.end());
        chart.places = open.places();
        chart.uv = map.uv;
        const auto triangles = map.surface_triangles();
        chart.triangles.assign(triangles.begin(), triangles.end());
        measure_stretches(part, chart);
        if (chart.stretch() > stretch) return {};
        return chart;
    }

    // By the singular values of the map from each triangle's own plane.
    static void measure_stretches(const Mesh& part, FlatChart& chart) {
        for (const Triangle& t : chart.triangles) {
            const Vec3 &a = part.position(t[0]), &b = part.position(t[1]), &c = part.position(t[2]);
            const Vec3 u = b - a, v = c - a, normal = u.cross(v);
            const double doubled = normal.norm();
            chart.areas.push_back(0.5 * doubled);
            if (doubled <= 1e-8 * u.squaredNorm() || u.norm() == 0.0) {
                chart.stretches.push_back(1.0);
                continue;
            }
            Eigen::Matrix2d own, flat;
            own << u.norm(), v.dot(u) / u.norm(), 0.0, doubled / u.norm();
            flat.col(0) = chart.uv[at(t[1])] - chart.uv[at(t[0])];
            flat.col(1) = chart.uv[at(t[2])] - chart.uv[at(t[0])];
            const Eigen::Matrix2d map = flat * own.inverse();
            const Eigen::Vector2d values = Eigen::JacobiSVD<Eigen::Matrix2d>(map).singularValues();
            chart.stretches.push_back(std::max(values[0], 1.0 / std::max(values[1], 1e-9)));
        }
    }

    const FaceGraph& graph_;
    std::span<const Index> faces_;
    const Context& context_;
};

// One face, seen along its normal.
FlatChart single_face(const FaceGraph& graph, Index face) {
    const Mesh& mesh = graph.mesh();
    const std::span<const Index> corners = mesh.topology().face(face);
    const Vec3& origin = mesh.position(corners[0]);
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        normal +=
            (mesh.position(corners[k]) - origin).cross(mesh.position(corners[k + 1]) - origin);
    }
    const Vec3 up = normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
    const Vec3 across = up.unitOrthogonal(), along = up.cross(across);
    FlatChart chart;
    chart.faces = {face};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 way = mesh.position(corners[k]) - origin;
        chart.places.push_back(index_of(k));
        chart.uv.emplace_back(way.dot(across), way.dot(along));
        if (k < 2) continue;
        chart.triangles.push_back({0, index_of(k) - 1, index_of(k)});
        chart.stretches.push_back(1.0);
        chart.areas.push_back(graph.area(face) / static_cast<double>(corners.size() - 2));
    }
    return chart;
}

}  // namespace

double FlatChart::area() const {
    return std::accumulate(areas.begin(), areas.end(), 0.0);
}

double FlatChart::stretch() const {
    std::vector<std::size_t> order(stretches.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return stretches[i] > stretches[j]; });
    double above = 0.0;
    const double most = kOutliers * area();
    for (const std::size_t t : order) {
        above += areas[t];
        if (above > most) return stretches[t];
    }
    return 1.0;
}

std::optional<FlatChart> flatten(const FaceGraph& graph, std::span<const Index> faces,
                                 double stretch, const Context& context) {
    if (faces.size() == 1) return single_face(graph, faces[0]);
    try {
        return ChartFlattener(graph, faces, context).run(stretch);
    } catch (const Error& error) {
        // Faces that cannot be laid out in one piece are to be halved.
        const ErrorCode code = error.code();
        if (code == ErrorCode::cancelled || code == ErrorCode::memory_limit) throw;
        return {};
    }
}

}  // namespace lissom
