#include "kernel/merge/merge_once.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace lissom {
namespace {

// Points that a long boundary is measured at; they tell as well which one is nearest.
constexpr std::size_t kMeasuredPoints = 512;

// The mean distance from the points of one list to the nearest of the other.
double mean_distance(std::span<const Vec3> from, std::span<const Vec3> to) {
    const std::size_t step = (from.size() + kMeasuredPoints - 1) / kMeasuredPoints;
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < from.size(); i += step) {
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& q : to) least = std::min(least, (from[i] - q).squaredNorm());
        sum += std::sqrt(least);
        count += 1.0;
    }
    return sum / count;
}

double box_distance(const Box& a, const Box& b) {
    return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0).norm();
}

std::vector<Path> open_boundaries(const Mesh& mesh, const char* side) {
    std::vector<Path> found = boundaries(mesh);
    if (!found.empty()) return found;
    throw Error(ErrorCode::not_a_boundary,
                std::string("the ") + side + " is closed: cut it open at the place of the seam");
}

std::vector<std::vector<Vec3>> points_of(const Mesh& mesh, const std::vector<Path>& paths) {
    std::vector<std::vector<Vec3>> points;
    for (const Path& path : paths) points.push_back(path.points(mesh));
    return points;
}

std::vector<Box> boxes_of(const std::vector<std::vector<Vec3>>& lists) {
    std::vector<Box> boxes(lists.size());
    for (std::size_t i = 0; i < lists.size(); ++i) {
        for (const Vec3& p : lists[i]) boxes[i].extend(p);
    }
    return boxes;
}

}  // namespace

Join nearest_join(const Mesh& source, const Mesh& target, const Context& context) {
    const std::vector<Path> from = open_boundaries(source, "source");
    const std::vector<Path> to = open_boundaries(target, "target");
    const auto a = points_of(source, from), b = points_of(target, to);
    const std::vector<Box> a_boxes = boxes_of(a), b_boxes = boxes_of(b);
    std::pair<std::size_t, std::size_t> best{0, 0};
    double least = std::numeric_limits<double>::infinity();
    const bool one_mesh = &source == &target;
    for (std::size_t i = 0; i < a.size(); ++i) {
        context.checkpoint();
        for (std::size_t j = one_mesh ? i + 1 : 0; j < b.size(); ++j) {
            if (2.0 * box_distance(a_boxes[i], b_boxes[j]) > least) continue;
            context.checkpoint();
            const double distance = mean_distance(a[i], b[j]) + mean_distance(b[j], a[i]);
            if (distance >= least) continue;
            least = distance;
            best = {i, j};
        }
    }
    if (one_mesh && from.size() < 2) {
        throw Error(ErrorCode::not_a_boundary,
                    "source and target are one mesh with one boundary; a bridge needs two");
    }
    return {from[best.first], to[best.second]};
}

MergeResult merge(const Mesh& source, const Mesh& target, std::vector<Join> joins,
                  const MergeOptions& options, const Context& context) {
    if (joins.empty()) joins.push_back(nearest_join(source, target, context));
    return Merger(source, target, std::move(joins), options, context).solve(context);
}

}  // namespace lissom
