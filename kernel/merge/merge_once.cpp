#include "kernel/merge/merge_once.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace lissom {
namespace {

// The mean distance from the points of one list to the nearest of the other.
double mean_distance(std::span<const Vec3> from, std::span<const Vec3> to) {
    double sum = 0.0;
    for (const Vec3& p : from) {
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& q : to) least = std::min(least, (p - q).squaredNorm());
        sum += std::sqrt(least);
    }
    return sum / static_cast<double>(from.size());
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

}  // namespace

Join nearest_join(const Mesh& source, const Mesh& target, const Context& context) {
    const std::vector<Path> from = open_boundaries(source, "source");
    const std::vector<Path> to = open_boundaries(target, "target");
    const auto a = points_of(source, from), b = points_of(target, to);
    std::pair<std::size_t, std::size_t> best{0, 0};
    double least = std::numeric_limits<double>::infinity();
    const bool one_mesh = &source == &target;
    for (std::size_t i = 0; i < a.size(); ++i) {
        context.checkpoint();
        for (std::size_t j = one_mesh ? i + 1 : 0; j < b.size(); ++j) {
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
