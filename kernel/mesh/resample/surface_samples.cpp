#include "kernel/mesh/resample/surface_samples.h"

#include <algorithm>
#include <utility>

namespace lissom {
namespace {

// Smaller weights come from rounding.
constexpr double kLeastWeight = 1e-12;

}  // namespace

SurfaceSamples::SurfaceSamples(const Mesh& mesh, const std::vector<Index>& charts,
                               const Context& context)
    : mesh_(mesh), chart_of_(charts) {
    const Index count = charts.empty() ? 0 : *std::max_element(charts.begin(), charts.end()) + 1;
    charts_.resize(at(count));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        charts_[at(charts[at(f)])].faces.push_back(f);
    }
    for (Chart& chart : charts_) {
        std::vector<Vec3> positions;
        std::vector<Triangle> triangles;
        for (const Index f : chart.faces) {
            const Index first = count_of(positions);
            triangles.push_back({first, first + 1, first + 2});
            for (const Index v : mesh.topology().face(f)) positions.push_back(mesh.position(v));
        }
        chart.tree =
            std::make_unique<SpatialTree>(std::move(positions), std::move(triangles), context);
    }
}

SurfaceSamples::Sample SurfaceSamples::nearest(Index face, const Vec3& point) const {
    const Chart& chart = charts_[at(chart_of_[at(face)])];
    const SurfacePoint hit = chart.tree->nearest(point);
    const Index f = chart.faces[at(hit.face)];
    Sample sample{hit.position, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const double weight = hit.barycentric[static_cast<Eigen::Index>(k)];
        if (!(weight > kLeastWeight)) continue;
        const Index corner = hit.triangle[k] % 3;
        sample.vertices.push_back({mesh_.topology().face(f)[at(corner)], weight});
        sample.corners.push_back({mesh_.topology().first_corner(f) + corner, weight});
    }
    return sample;
}

}  // namespace lissom
