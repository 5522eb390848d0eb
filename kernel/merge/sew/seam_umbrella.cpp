#include "kernel/merge/sew/seam_umbrella.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lissom {
namespace {

constexpr double kStep = 0.5;

struct Moving {
    Index vertex;
    double step;
    std::vector<Index> neighbors;
};

std::vector<Moving> moving_vertices(const SeamPatch& patch) {
    std::vector<Index> next;
    for (const Index v : patch.seam_vertices()) {
        const std::vector<Index> ring = patch.neighbors(v);
        next.insert(next.end(), ring.begin(), ring.end());
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    std::vector<Moving> moving;
    for (const Index v : next) {
        if (patch.is_open(v)) continue;
        const bool on_seam =
            std::binary_search(patch.seam_vertices().begin(), patch.seam_vertices().end(), v);
        moving.push_back({v, on_seam ? kStep : 0.5 * kStep, patch.neighbors(v)});
    }
    return moving;
}

}  // namespace

void smooth_seams(SeamPatch& patch, Index times) {
    if (times == 0) return;
    const std::vector<Moving> moving = moving_vertices(patch);
    std::vector<Vec3> to(moving.size());
    for (Index i = 0; i < times; ++i) {
        for (std::size_t k = 0; k < moving.size(); ++k) {
            const auto& [vertex, step, neighbors] = moving[k];
            Vec3 mean = Vec3::Zero();
            for (const Index w : neighbors) mean += patch.position(w);
            mean /= static_cast<double>(neighbors.size());
            to[k] = patch.position(vertex) + step * (mean - patch.position(vertex));
        }
        for (std::size_t k = 0; k < moving.size(); ++k) patch.move(moving[k].vertex, to[k]);
    }
}

}  // namespace lissom
