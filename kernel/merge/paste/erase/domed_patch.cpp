#include "kernel/merge/paste/erase/domed_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// A vertex of the rim, half the length of its edges, and the way that the surface around goes on.
struct RimWay {
    Vec3 position, way;
    double length;
};

std::vector<RimWay> rim_ways(const Mesh& mesh, const std::vector<Index>& rim, Index first_new) {
    std::vector<RimWay> ways;
    for (std::size_t k = 0; k < rim.size(); ++k) {
        const Index before = rim[(k + rim.size() - 1) % rim.size()];
        const Index after = rim[(k + 1) % rim.size()];
        const Vec3& here = mesh.position(rim[k]);
        const Vec3 along = (mesh.position(after) - mesh.position(before)).stableNormalized();
        Vec3 way = Vec3::Zero();
        for (const Index n : mesh.topology().neighbors(rim[k])) {
            if (n >= first_new || std::find(rim.begin(), rim.end(), n) != rim.end()) continue;
            const Vec3 from = here - mesh.position(n);
            way += (from - along.dot(from) * along).stableNormalized();
        }
        const double length =
            0.5 * ((mesh.position(after) - here).norm() + (mesh.position(before) - here).norm());
        ways.push_back({here, way.stableNormalized(), length});
    }
    return ways;
}

double distance_to_rim(const std::vector<RimWay>& rim, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rim.size(); ++k) {
        const Vec3& a = rim[k].position;
        const Vec3 side = rim[(k + 1) % rim.size()].position - a;
        const double square = side.squaredNorm();
        const double t = square > 0.0 ? std::clamp((p - a).dot(side) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, (p - a - t * side).norm());
    }
    return least;
}

// The sine of the slope, over a plane, at which the surface around comes to a point: the mean over
// the rim, weighted towards near points.
double slope_at(const std::vector<RimWay>& rim, const Vec3& p, const Vec3& up) {
    double sum = 0.0, weights = 0.0;
    for (const RimWay& one : rim) {
        const double square = (one.position - p).squaredNorm();
        if (!(square > 0.0)) return one.way.dot(up);
        sum += one.length / square * one.way.dot(up);
        weights += one.length / square;
    }
    return std::clamp(sum / weights, -1.0, 1.0);
}

// Height of a cap over a disk of radius `reach` whose slope at the rim has this sine, `inward` from
// it.
double cap_height(double reach, double sine, double inward) {
    if (!(std::abs(sine) > 1e-6)) return 0.0;
    const double radius = reach / std::abs(sine), rest = reach - inward;
    const double height = std::sqrt(std::max(0.0, radius * radius - rest * rest)) -
                          std::sqrt(std::max(0.0, radius * radius - reach * reach));
    return std::copysign(height, sine);
}

}  // namespace

void dome(Mesh& mesh, const FillReport& patch, const Path& hole) {
    const std::vector<RimWay> rim = rim_ways(mesh, hole.vertices(), patch.first_vertex);
    Vec3 up = Vec3::Zero();
    for (Index f = patch.first_face; f < mesh.face_count(); ++f) up += area_vector(mesh, f);
    up.stableNormalize();
    std::vector<double> inward;
    double reach = 0.0;
    for (Index v = patch.first_vertex; v < mesh.vertex_count(); ++v) {
        inward.push_back(distance_to_rim(rim, mesh.position(v)));
        reach = std::max(reach, inward.back());
    }
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (std::size_t k = 0; k < inward.size(); ++k) {
        Vec3& p = positions[at(patch.first_vertex) + k];
        p += cap_height(reach, slope_at(rim, p, up), inward[k]) * up;
    }
    mesh.set_positions(std::move(positions));
}

}  // namespace lissom
