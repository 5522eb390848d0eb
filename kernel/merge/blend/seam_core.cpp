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
constexpr double kMinCoreWeight = 0.05;

// Weight of each value's former one, for parts that nothing around the core holds.
constexpr double kHold = 1e-7;

// Unconstrained vertices would drift: the farthest of each component stay if all of it moves.
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
    const auto step = [&](std::size_t k, const std::vector<Vec3>& x) {
        const Index i = vertices_[k];
        Vec3 mean = Vec3::Zero();
        for (const Index j : band.ring(i)) mean += x[at(j)];
        mean /= band.ring(i).size();
        const Vec3 way = mean - x[at(i)], along = band.normal(i).dot(way) * band.normal(i);
        return Vec3(strength_[k] * (way - along));
    };
    std::vector<char> stays;
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
        const Index i = vertices_[k];
        double shortest = std::numeric_limits<double>::infinity();
        for (const Index j : band.ring(i)) {
            shortest = std::min(shortest, (band.position(j) - band.position(i)).norm());
        }
        const bool is_long = step(k, band.shape(0)).norm() > kLongestStep * shortest;
        stays.push_back(is_long || !band.moves(i) ? 1 : 0);
    }
    for (Index s = 0; s < band.shape_count(); ++s) {
        std::vector<Vec3> next = band.shape(s);
        for (std::size_t k = 0; k < vertices_.size(); ++k) {
            if (!stays[k]) next[at(vertices_[k])] += step(k, band.shape(s));
        }
        band.set_shape(s, std::move(next));
    }
    band.measure();
}

std::vector<std::vector<Vec3>> SeamCore::relaxed(const BandSystem& band,
                                                 std::span<const std::vector<double>> curvature,
                                                 const Context& context) const {
    std::vector<Values> values(curvature.size());
    std::vector<std::vector<Vec3>> wanted(curvature.size());
    for (std::size_t s = 0; s < curvature.size(); ++s) {
        values[s].assign(curvature[s].size(), Vec4::Zero());
        wanted[s].assign(curvature[s].size(), Vec3::Zero());
        for (Index i = 0; i < band.vertex_count(); ++i) {
            if (!band.is_row(i)) continue;
            const double own = curvature[s][at(i)];
            values[s][at(i)] << own, band.normal(i);
            wanted[s][at(i)] = band.coordinates(i, index_of(s)) +
                               (own - band.curvature(i, index_of(s))) * band.normal(i);
        }
    }
    values = fill(band, std::move(values), context);
    for (std::size_t s = 0; s < values.size(); ++s) {
        for (const Index i : vertices_) {
            const Vec4& value = values[s][at(i)];
            wanted[s][at(i)] = value[0] * value.tail<3>().normalized();
        }
    }
    return wanted;
}

std::vector<std::vector<double>> SeamCore::filled(const BandSystem& band,
                                                  std::span<const std::vector<double>> curvature,
                                                  const Context& context) const {
    std::vector<Values> values;
    for (const std::vector<double>& of_shape : curvature) {
        Values& all = values.emplace_back(of_shape.size(), Vec4::Zero());
        for (std::size_t i = 0; i < all.size(); ++i) all[i][0] = of_shape[i];
    }
    values = fill(band, std::move(values), context);
    std::vector<std::vector<double>> result;
    for (const Values& all : values) {
        std::vector<double>& of_shape = result.emplace_back();
        for (const Vec4& value : all) of_shape.push_back(value[0]);
    }
    return result;
}

std::vector<SeamCore::Values> SeamCore::fill(const BandSystem& band, std::vector<Values> values,
                                             const Context& context) const {
    if (vertices_.empty()) return values;
    const auto n = vertices_.size();
    std::vector<Triplet> entries;
    std::vector<std::vector<double>> right(values.size(), std::vector<double>(4 * n, 0.0));
    for (const Index i : vertices_) {
        const auto add = [&](double weight, Index from, bool is_known) {
            entries.push_back({unknown_[i], unknown_[i], weight});
            if (!is_known) return;
            for (std::size_t s = 0; s < values.size(); ++s) {
                const Vec4& value = values[s][at(from)];
                for (std::size_t k = 0; k < 4; ++k) {
                    right[s][k * n + at(unknown_[i])] += weight * value[static_cast<Index>(k)];
                }
            }
        };
        add(kHold, i, true);
        for (std::size_t e = 0; e < band.ring(i).size(); ++e) {
            const Index j = band.ring(i)[e];
            // Rows on open boundaries have no mean curvature.
            if (!contains(j) && (!band.is_row(j) || band.on_boundary(j))) continue;
            const double weight = std::max(kMinCoreWeight, band.cotangents(i)[e]);
            add(weight, j, !contains(j));
            if (contains(j)) entries.push_back({unknown_[i], unknown_[j], -weight});
        }
    }
    const SymmetricMatrix matrix = symmetric_from_triplets(index_of(n), entries);
    SparseSystem system;
    system.analyze(matrix, context);
    system.factor(matrix, context);
    for (std::size_t s = 0; s < values.size(); ++s) {
        system.solve(right[s], right[s], 4);
        for (const Index i : vertices_) {
            for (std::size_t k = 0; k < 4; ++k) {
                values[s][at(i)][static_cast<Index>(k)] = right[s][k * n + at(unknown_[i])];
            }
        }
    }
    return values;
}

}  // namespace lissom
