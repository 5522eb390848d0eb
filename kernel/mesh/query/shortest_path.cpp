#include "kernel/mesh/query/shortest_path.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

namespace lissom {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr std::size_t kCheckEvery = 4096;

}  // namespace

ShortestPaths::ShortestPaths(const Mesh& mesh)
    : mesh_(mesh),
      distance_(mesh.vertex_count(), kUnreached),
      previous_(mesh.vertex_count(), kNoIndex) {}

void ShortestPaths::clear() {
    for (const Index v : visited_) distance_[v] = kUnreached;
    visited_.clear();
    queue_.clear();
}

void ShortestPaths::reach(Index v, double distance, Index from) {
    if (distance_[v] == kUnreached) visited_.push_back(v);
    distance_[v] = distance;
    previous_[v] = from;
    queue_.emplace_back(distance, v);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void ShortestPaths::run(double limit, Index target, const Context& context) {
    for (std::size_t steps = 1; !queue_.empty(); ++steps) {
        if (steps % kCheckEvery == 0) context.checkpoint();
        std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
        const auto [distance, v] = queue_.back();
        queue_.pop_back();
        if (v == target) return;
        if (distance > distance_[v]) continue;
        for (const Index n : mesh_.topology().neighbors(v)) {
            const double next = distance + (mesh_.position(n) - mesh_.position(v)).norm();
            if (next < distance_[n] && next <= limit) reach(n, next, v);
        }
    }
}

const std::vector<double>& ShortestPaths::from(std::span<const Index> sources, double limit,
                                               const Context& context) {
    clear();
    for (const Index v : sources) {
        if (distance_[v] > 0.0) reach(v, 0.0, kNoIndex);
    }
    run(limit, kNoIndex, context);
    return distance_;
}

std::vector<Index> ShortestPaths::between(Index from, Index to, const Context& context) {
    const std::vector<Index>& component = mesh_.topology().components();
    if (component[from] != component[to]) {
        throw Error(ErrorCode::invalid_argument,
                    "no edges lead from vertex " + std::to_string(from) + " to vertex " +
                        std::to_string(to) + "; they lie in different components",
                    {ElementKind::vertex, 2, {from, to}});
    }
    clear();
    reach(from, 0.0, kNoIndex);
    run(kUnreached, to, context);
    std::vector<Index> path;
    for (Index v = to; v != kNoIndex; v = previous_[v]) path.push_back(v);
    std::reverse(path.begin(), path.end());
    return path;
}

}  // namespace lissom
