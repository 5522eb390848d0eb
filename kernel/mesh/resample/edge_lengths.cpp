#include "kernel/mesh/resample/edge_lengths.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

constexpr double kSteepestLength = 0.5;
constexpr int kPasses = 8;

double curvature_at(const Mesh& mesh, const std::vector<Vec3>& normals, Index v) {
    double curvature = 0.0;
    for (const Index u : mesh.topology().neighbors(v)) {
        const double length = (mesh.position(u) - mesh.position(v)).norm();
        if (!(length > 0.0)) continue;
        curvature = std::max(curvature, (normals[at(u)] - normals[at(v)]).norm() / length);
    }
    return curvature;
}

// The mean over the ring: single edges are noisy.
std::vector<double> curvatures(const Mesh& mesh) {
    const std::vector<Vec3> normals = vertex_normals(mesh);
    std::vector<double> raw, smooth;
    for (Index v = 0; v < mesh.vertex_count(); ++v) raw.push_back(curvature_at(mesh, normals, v));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        double sum = raw[at(v)];
        for (const Index u : mesh.topology().neighbors(v)) sum += raw[at(u)];
        smooth.push_back(sum / (1.0 + mesh.topology().valence(v)));
    }
    return smooth;
}

// Lengths grow from short ones no faster than the surface goes on.
void limit_slope(const Mesh& mesh, std::vector<double>& lengths) {
    for (int pass = 0; pass < kPasses; ++pass) {
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            for (const Index u : mesh.topology().neighbors(v)) {
                const double distance = (mesh.position(u) - mesh.position(v)).norm();
                lengths[at(v)] =
                    std::min(lengths[at(v)], lengths[at(u)] + kSteepestLength * distance);
            }
        }
    }
}

}  // namespace

std::vector<double> edge_lengths(const Mesh& mesh, const EdgeLengths& wanted) {
    std::vector<double> lengths(at(mesh.vertex_count()), wanted.longest);
    if (wanted.error == 0.0) return lengths;
    const std::vector<double> curvature = curvatures(mesh);
    for (std::size_t v = 0; v < lengths.size(); ++v) {
        if (!(curvature[v] > 0.0)) continue;
        const double length = std::sqrt(8.0 * wanted.error / curvature[v]);
        lengths[v] = std::clamp(length, wanted.shortest, wanted.longest);
    }
    limit_slope(mesh, lengths);
    return lengths;
}

}  // namespace lissom
