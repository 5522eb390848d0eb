#include "kernel/mesh/unwrap/face_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "kernel/mesh/edit/corner_twins.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

constexpr double kSmoothAngle = 20.0 * kPi / 180.0, kSharpAngle = 110.0 * kPi / 180.0;
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr int kSmoothRounds = 4, kGiveRounds = 20;

// Costs of ways over some faces of a graph.
class FaceWays {
  public:
    FaceWays(const FaceGraph& graph, std::span<const Index> faces, const Context& context)
        : graph_(graph),
          faces_(faces.begin(), faces.end()),
          context_(context),
          size_(std::sqrt(graph.area(faces))) {
        std::sort(faces_.begin(), faces_.end());
        cost_.assign(faces_.size(), kFar);
        source_.assign(faces_.size(), 0);
    }

    // Place of a face among the faces, or the number of faces.
    std::size_t place_of(Index face) const {
        const auto found = std::lower_bound(faces_.begin(), faces_.end(), face);
        const bool has = found != faces_.end() && *found == face;
        return has ? static_cast<std::size_t>(found - faces_.begin()) : faces_.size();
    }

    // Costs from the nearest of some places (Dijkstra).
    void run(std::span<const std::size_t> starts) {
        std::fill(cost_.begin(), cost_.end(), kFar);
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (std::size_t i = 0; i < starts.size(); ++i) {
            cost_[starts[i]] = 0.0;
            source_[starts[i]] = static_cast<int>(i);
            queue.push({0.0, starts[i]});
        }
        while (!queue.empty()) {
            const double cost = queue.top().first;
            const std::size_t place = queue.top().second;
            queue.pop();
            if (cost > cost_[place]) continue;
            for_each_neighbor(place, [&](std::size_t other, Index corner) {
                const double way = cost + graph_.step(corner, size_);
                if (way >= cost_[other]) return;
                cost_[other] = way;
                source_[other] = source_[place];
                queue.push({way, other});
            });
        }
        context_.checkpoint();
    }

    std::size_t farthest() const {
        const auto most = std::max_element(cost_.begin(), cost_.end());
        return static_cast<std::size_t>(most - cost_.begin());
    }

    // Faces go over to the half of most of their neighbours, so that the border is short.
    void smooth() {
        for (int round = 0; round < kSmoothRounds; ++round) {
            for (std::size_t place = 0; place < faces_.size(); ++place) {
                double other_side = 0.0, same_side = 0.0;
                for_each_neighbor(place, [&](std::size_t other, Index corner) {
                    const double weight =
                        graph_.edge_length(corner) * (1.0 - 0.9 * graph_.sharpness(corner));
                    (source_[other] == source_[place] ? same_side : other_side) += weight;
                });
                if (other_side > same_side) source_[place] = 1 - source_[place];
            }
        }
    }

    std::array<std::vector<Index>, 2> sides() const {
        std::array<std::vector<Index>, 2> lists;
        for (std::size_t place = 0; place < faces_.size(); ++place) {
            lists[static_cast<std::size_t>(source_[place])].push_back(faces_[place]);
        }
        return lists;
    }

  private:
    template <typename Work>
    void for_each_neighbor(std::size_t place, const Work& work) const {
        const Index face = faces_[place];
        const Topology& topology = graph_.mesh().topology();
        for (Index c = topology.first_corner(face); c < topology.first_corner(face + 1); ++c) {
            const Index twin = graph_.twin(c);
            if (twin == kNoIndex) continue;
            const std::size_t other = place_of(graph_.face_of(twin));
            if (other < faces_.size()) work(other, c);
        }
    }

    const FaceGraph& graph_;
    std::vector<Index> faces_;
    const Context& context_;
    double size_ = 0.0;
    std::vector<double> cost_;
    std::vector<int> source_;
};

// Until no part with a neighbour is small, or for so many rounds.
void give_small_parts_away(const FaceGraph& graph, double least, std::vector<Index>& part,
                           std::vector<double>& areas) {
    const double limit = least * std::accumulate(areas.begin(), areas.end(), 0.0);
    for (int round = 0; round < kGiveRounds; ++round) {
        std::map<std::pair<Index, Index>, double> borders;
        for (Index c = 0; c < graph.mesh().topology().corner_count(); ++c) {
            if (graph.twin(c) == kNoIndex) continue;
            const Index own = part[at(graph.face_of(c))];
            const Index other = part[at(graph.face_of(graph.twin(c)))];
            if (own != other && areas[at(own)] < limit) {
                borders[{own, other}] += graph.edge_length(c);
            }
        }
        std::vector<std::pair<double, Index>> longest(areas.size(), {0.0, kNoIndex});
        for (const auto& [pair, length] : borders) {
            auto& best = longest[at(pair.first)];
            if (length > best.first) best = {length, pair.second};
        }
        // If two small ones want one another, the first goes.
        std::vector<Index> goes(areas.size());
        std::iota(goes.begin(), goes.end(), 0);
        for (Index p = 0; p < count_of(goes); ++p) {
            const Index to = longest[at(p)].second;
            if (to != kNoIndex && goes[at(to)] == to) goes[at(p)] = to;
        }
        bool any = false;
        for (Index p = 0; p < count_of(goes); ++p) {
            if (goes[at(p)] == p) continue;
            areas[at(goes[at(p)])] += std::exchange(areas[at(p)], 0.0);
            any = true;
        }
        for (Index& p : part) p = goes[at(p)];
        if (!any) return;
    }
}

}  // namespace

FaceGraph::FaceGraph(const Mesh& mesh, double crease)
    : mesh_(mesh), crease_(crease), twins_(corner_twins(mesh.topology())) {
    const Topology& topology = mesh.topology();
    std::vector<Vec3> normals, corners;
    for (Index f = 0; f < topology.face_count(); ++f) {
        corners.clear();
        for (const Index v : topology.face(f)) {
            corners.push_back(mesh.position(v));
            faces_.push_back(f);
        }
        Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            middle += corners[k] / static_cast<double>(corners.size());
            normal +=
                (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
        }
        areas_.push_back(0.5 * normal.norm());
        middles_.push_back(middle);
        normals.push_back(normal.normalized());
    }
    for (Index c = 0; c < topology.corner_count(); ++c) {
        double sharp = 1.0;
        if (twins_[at(c)] != kNoIndex) {
            const Vec3 &a = normals[at(faces_[at(c)])], &b = normals[at(face_of(twins_[at(c)]))];
            const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
            sharp = std::clamp((angle - kSmoothAngle) / (kSharpAngle - kSmoothAngle), 0.0, 1.0);
        }
        sharpness_.push_back(sharp);
    }
}

double FaceGraph::area(std::span<const Index> faces) const {
    double sum = 0.0;
    for (const Index f : faces) sum += area(f);
    return sum;
}

Index FaceGraph::next(Index corner) const {
    const Index face = face_of(corner), last = mesh_.topology().first_corner(face + 1) - 1;
    return corner < last ? corner + 1 : mesh_.topology().first_corner(face);
}

double FaceGraph::edge_length(Index corner) const {
    const std::vector<Index>& vertices = mesh_.topology().faces().vertices;
    return (mesh_.position(vertices[at(next(corner))]) - mesh_.position(vertices[at(corner)]))
        .norm();
}

double FaceGraph::step(Index corner, double size) const {
    const Vec3& here = middles_[at(face_of(corner))];
    const Vec3& there = middles_[at(face_of(twin(corner)))];
    const double sharp = sharpness(corner);
    return (here - there).norm() + crease_ * size * sharp * sharp;
}

std::vector<std::vector<Index>> connected_parts(const FaceGraph& graph,
                                                std::span<const Index> faces) {
    std::vector<Index> sorted(faces.begin(), faces.end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> seen(sorted.size(), false);
    const Topology& topology = graph.mesh().topology();
    std::vector<std::vector<Index>> parts;
    for (std::size_t start = 0; start < sorted.size(); ++start) {
        if (seen[start]) continue;
        seen[start] = true;
        std::vector<Index> part = {sorted[start]};
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Index end = topology.first_corner(part[i] + 1);
            for (Index c = topology.first_corner(part[i]); c < end; ++c) {
                if (graph.twin(c) == kNoIndex) continue;
                const Index other = graph.face_of(graph.twin(c));
                const auto found = std::lower_bound(sorted.begin(), sorted.end(), other);
                if (found == sorted.end() || *found != other) continue;
                const auto place = static_cast<std::size_t>(found - sorted.begin());
                if (seen[place]) continue;
                seen[place] = true;
                part.push_back(other);
            }
        }
        std::sort(part.begin(), part.end());
        parts.push_back(std::move(part));
    }
    return parts;
}

std::vector<std::vector<Index>> parts_between_creases(const FaceGraph& graph, double sharpness,
                                                      double least) {
    const Topology& topology = graph.mesh().topology();
    std::vector<Index> part(at(topology.face_count()), kNoIndex);
    std::vector<double> areas;
    for (Index start = 0; start < topology.face_count(); ++start) {
        if (part[at(start)] != kNoIndex) continue;
        const Index number = count_of(areas);
        areas.push_back(0.0);
        part[at(start)] = number;
        std::vector<Index> queue = {start};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            areas.back() += graph.area(queue[i]);
            const Index end = topology.first_corner(queue[i] + 1);
            for (Index c = topology.first_corner(queue[i]); c < end; ++c) {
                if (graph.twin(c) == kNoIndex || graph.sharpness(c) >= sharpness) continue;
                const Index other = graph.face_of(graph.twin(c));
                if (std::exchange(part[at(other)], number) != number) queue.push_back(other);
            }
        }
    }
    give_small_parts_away(graph, least, part, areas);
    std::vector<std::vector<Index>> lists(areas.size());
    for (Index f = 0; f < topology.face_count(); ++f) lists[at(part[at(f)])].push_back(f);
    std::vector<std::vector<Index>> parts;
    for (const std::vector<Index>& list : lists) {
        for (std::vector<Index>& one : connected_parts(graph, list))
            parts.push_back(std::move(one));
    }
    return parts;
}

std::vector<std::vector<Index>> halves(const FaceGraph& graph, std::span<const Index> faces,
                                       const Context& context) {
    FaceWays ways(graph, faces, context);
    const std::size_t any[] = {0};
    ways.run(any);
    const std::size_t first[] = {ways.farthest()};
    ways.run(first);
    const std::size_t both[] = {first[0], ways.farthest()};
    ways.run(both);
    ways.smooth();
    std::vector<std::vector<Index>> parts;
    for (const std::vector<Index>& side : ways.sides()) {
        for (std::vector<Index>& part : connected_parts(graph, side)) {
            parts.push_back(std::move(part));
        }
    }
    if (parts.size() > 1) return parts;
    // One face is always cut off, so that halving ends.
    std::vector<Index> rest(faces.begin(), faces.end());
    std::sort(rest.begin(), rest.end());
    parts = {{rest.front()}};
    rest.erase(rest.begin());
    for (std::vector<Index>& part : connected_parts(graph, rest)) parts.push_back(std::move(part));
    return parts;
}

}  // namespace lissom
