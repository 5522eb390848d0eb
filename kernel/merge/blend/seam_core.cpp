#include "kernel/merge/blend/seam_core.h"

#include <algorithm>
#include <limits>

namespace lissom {
namespace {

constexpr double kUmbrellaStrength = 0.5;
// The most that an umbrella step moves a vertex, in its shortest edge.
constexpr double kLongestStep = 0.25;

// Cotangents count as at least this when the core is filled, which keeps its values between those
// around it.
constexpr double kLeastCoreWeight = 0.05;

// Pulls each value to the one it had, where nothing around the core holds it.
constexpr double kHold = 1e-7;

// Vertices that nothing holds would drift: the farthest of each component stay where all of it
// moves.
std::vector<char> held_components(const Topology& topology, std::span<const Index> rings) {
    std::vector<char> held(topology.component_count(), 0);
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (rings[v] == kNoIndex || topology.is_boundary(v)) held[topology.components()[v]] = 1;
    }
    return held;
}

}  // namespace

std::vector<Index> seam_rings(const Topology& topology, std::span<const std::vector<Index>> seams,
                              Index limit) {
    std::vector<Index> rings(topology.vertex_count(), kNoIndex);
    std::vector<Index> front, next;
    const auto reach = [&](Index v, Index ring) {
        if (rings[v] != kNoIndex) return;
        rings[v] = ring;
        next.push_back(v);
    };
    for (const std::vector<Index>& seam : seams) {
        for (const Index v : seam) reach(v, 0);
    }
    for (Index ring = 1; ring <= limit; ++ring) {
        front.swap(next);
        next.clear();
        for (const Index v : front) {
            for (const Index n : topology.neighbors(v)) reach(n, ring);
        }
    }
    return rings;
}

Region seam_band(const std::shared_ptr<const Topology>& topology, std::span<const Index> rings) {
    const std::vector<Index>& component = topology->components();
    const std::vector<char> held = held_components(*topology, rings);
    std::vector<Index> farthest(held.size(), 0), band;
    for (Index v = 0; v < topology->vertex_count(); ++v) {
        farthest[component[v]] = std::max(farthest[component[v]], rings[v]);
    }
    for (Index v = 0; v < topology->vertex_count(); ++v) {
        if (rings[v] == kNoIndex || topology->is_boundary(v)) continue;
        if (!held[component[v]] && rings[v] == farthest[component[v]]) continue;
        band.push_back(v);
    }
    return {topology, std::move(band)};
}

SeamCore::SeamCore(const BandSystem& band, std::span<const Index> rings, Index width)
    : unknown_(band.vertex_count(), kNoIndex) {
    for (Index i = 0; i < band.vertex_count(); ++i) {
        const Index ring = rings[band.mesh_vertex(i)];
        if (!band.is_row(i) || band.on_boundary(i) || ring == kNoIndex || ring >= width) continue;
        if (!band.moves(i) && ring > 0) continue;
        unknown_[i] = count_of(vertices_);
        vertices_.push_back(i);
        strength_.push_back(kUmbrellaStrength * (width - ring) / width);
    }
}

void SeamCore::umbrella(BandSystem& band) const {
    std::vector<Vec3> next;
    next.reserve(vertices_.size());
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
        const Index i = vertices_[k];
        Vec3 mean = Vec3::Zero();
        double shortest = std::numeric_limits<double>::infinity();
        for (const Index j : band.ring(i)) {
            mean += band.position(j);
            shortest = std::min(shortest, (band.position(j) - band.position(i)).norm());
        }
        mean /= band.ring(i).size();
        const Vec3 way = mean - band.position(i), along = band.normal(i).dot(way) * band.normal(i);
        Vec3 step = strength_[k] * (way - along);
        if (step.norm() > kLongestStep * shortest) step.setZero();
        next.push_back(band.position(i) + step);
    }
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
        if (band.moves(vertices_[k])) band.set_position(vertices_[k], next[k]);
    }
    band.measure();
}

std::vector<Vec3> SeamCore::relaxed(const BandSystem& band, std::span<const double> curvature,
                                    const Context& context) const {
    std::vector<Vec4> values(curvature.size(), Vec4::Zero());
    std::vector<Vec3> wanted(curvature.size(), Vec3::Zero());
    for (Index i = 0; i < band.vertex_count(); ++i) {
        if (!band.is_row(i)) continue;
        values[i] << curvature[i], band.normal(i);
        wanted[i] = band.coordinates(i) + (curvature[i] - band.curvature(i)) * band.normal(i);
    }
    values = fill(band, std::move(values), context);
    for (const Index i : vertices_) {
        wanted[i] = values[i][0] * values[i].tail<3>().normalized();
    }
    return wanted;
}

std::vector<double> SeamCore::filled(const BandSystem& band, std::span<const double> curvature,
                                     const Context& context) const {
    std::vector<Vec4> values(curvature.size(), Vec4::Zero());
    for (std::size_t i = 0; i < values.size(); ++i) values[i][0] = curvature[i];
    values = fill(band, std::move(values), context);
    std::vector<double> result;
    for (const Vec4& value : values) result.push_back(value[0]);
    return result;
}

std::vector<Vec4> SeamCore::fill(const BandSystem& band, std::vector<Vec4> values,
                                 const Context& context) const {
    if (vertices_.empty()) return values;
    const auto n = vertices_.size();
    std::vector<Triplet> entries;
    std::vector<double> b(4 * n, 0.0);
    for (const Index i : vertices_) {
        const auto add = [&](double weight, const Vec4& value) {
            entries.push_back({unknown_[i], unknown_[i], weight});
            for (std::size_t k = 0; k < 4; ++k) b[k * n + unknown_[i]] += weight * value[k];
        };
        add(kHold, values[i]);
        for (std::size_t e = 0; e < band.ring(i).size(); ++e) {
            const Index j = band.ring(i)[e];
            // Rows on open boundaries have no mean curvature.
            if (!contains(j) && (!band.is_row(j) || band.on_boundary(j))) continue;
            const double weight = std::max(kLeastCoreWeight, band.cotangents(i)[e]);
            add(weight, contains(j) ? Vec4(Vec4::Zero()) : values[j]);
            if (contains(j)) entries.push_back({unknown_[i], unknown_[j], -weight});
        }
    }
    const SymmetricMatrix matrix = symmetric_from_triplets(index_of(n), entries);
    SparseSystem system;
    system.analyze(matrix, context);
    system.factor(matrix, context);
    system.solve(b, b, 4);
    for (const Index i : vertices_) {
        for (std::size_t k = 0; k < 4; ++k) values[i][k] = b[k * n + unknown_[i]];
    }
    return values;
}

}  // namespace lissom
