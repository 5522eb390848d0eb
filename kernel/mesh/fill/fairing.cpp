#include "kernel/mesh/fill/fairing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// Cotangents are kept above this, so that every system is positive definite.
constexpr double kMinWeight = 1e-3;
// Times that the shape of least change of curvature is sought, each with the operators of the one
// before.
constexpr int kVariationPasses = 2;

// The Laplacian at the vertices of a region and around it: row v is sum_w weight (x_v - x_w),
// divided by the vertex's area.
struct Laplacian {
    struct Row {
        Index vertex = kNoIndex;
        double area = 1.0;
        std::map<Index, double> weights;
    };
    std::vector<Row> rows;
};

// The region's vertices in ascending order, then their neighbours outside.
std::vector<Index> with_neighbors(const Region& region) {
    std::vector<Index> vertices = region.vertices();
    const Region around = region.grown(1).minus(region);
    vertices.insert(vertices.end(), around.vertices().begin(), around.vertices().end());
    return vertices;
}

std::vector<Index> faces_at(const Topology& topology, std::span<const Index> vertices) {
    std::vector<Index> faces;
    for (const Index v : vertices) {
        const std::span<const Index> around = topology.faces_around(v);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

Laplacian uniform_laplacian(const Topology& topology, const Region& region) {
    Laplacian result;
    for (const Index v : region.vertices()) {
        Laplacian::Row row{v, 1.0, {}};
        for (const Index n : topology.neighbors(v)) row.weights[n] = 1.0;
        result.rows.push_back(std::move(row));
    }
    return result;
}

Laplacian cotangent_laplacian(const Topology& topology, std::span<const Vec3> positions,
                              const Region& region) {
    const std::vector<Index> vertices = with_neighbors(region);
    std::vector<Index> row_of(topology.vertex_count(), kNoIndex);
    Laplacian result;
    for (const Index v : vertices) {
        row_of[v] = count_of(result.rows);
        result.rows.push_back({v, 0.0, {}});
    }
    const std::vector<Index> faces = faces_at(topology, vertices);
    double total = 0.0;
    for (const Triangle& t : triangulate_faces(topology, positions, faces).triangles) {
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const Vec3 u = positions[a] - positions[c], v = positions[b] - positions[c];
            const double area = u.cross(v).norm();
            const double weight = area > 0.0 ? 0.5 * u.dot(v) / area : 0.0;
            if (row_of[a] != kNoIndex) result.rows[row_of[a]].weights[b] += weight;
            if (row_of[b] != kNoIndex) result.rows[row_of[b]].weights[a] += weight;
            if (row_of[c] != kNoIndex) result.rows[row_of[c]].area += area / 6.0;
            total += area / 6.0;
        }
    }
    const double min_area = 1e-6 * total / vertices.size();
    for (Laplacian::Row& row : result.rows) {
        row.area = std::max(row.area, min_area);
        for (auto& [n, weight] : row.weights) weight = std::max(weight, kMinWeight);
    }
    return result;
}

// A system over the region's vertices: the matrix on the free ones and the right side from the
// others.
class FairingSystem {
  public:
    FairingSystem(const Region& region, std::span<const Vec3> positions)
        : region_(&region),
          positions_(positions.begin(), positions.end()),
          unknown_(positions.size(), kNoIndex) {
        for (Index i = 0; i < region.size(); ++i) unknown_[region.vertices()[i]] = i;
    }

    // Rows of a symmetric Laplacian, each set to zero.
    void add_membrane(const Laplacian& laplacian) {
        for (const Laplacian::Row& row : laplacian.rows) {
            const std::vector<std::pair<Index, double>> one{{row.vertex, 1.0}};
            add_product(one, terms(row), 1.0);
        }
    }

    // The squares of all rows, each weighted by its area.
    void add_plate(const Laplacian& laplacian) {
        for (const Laplacian::Row& row : laplacian.rows) {
            const auto all = terms(row);
            add_product(all, all, 1.0 / row.area);
        }
    }

    // The squared differences of rows at both ends of an edge: the change of the mean curvature.
    void add_variation(const Laplacian& laplacian, const Topology& topology) {
        std::map<Index, const Laplacian::Row*> row_of;
        for (const Laplacian::Row& row : laplacian.rows) {
            if (!topology.is_boundary(row.vertex)) row_of[row.vertex] = &row;
        }
        for (const auto& [v, row] : row_of) {
            for (const auto& [n, weight] : row->weights) {
                const auto other = row_of.find(n);
                if (n < v || other == row_of.end()) continue;
                const Terms change = difference(*row, *other->second);
                add_product(change, change, weight);
            }
        }
    }

    std::vector<Vec3> solve(const Context& context) {
        const SymmetricMatrix matrix = symmetric_from_triplets(region_->size(), entries_);
        system_.analyze(matrix, context);
        system_.factor(matrix, context);
        return solved(positions_);
    }

    // The same system for other values of the vertices around, once it was solved.
    std::vector<Vec3> solved(std::vector<Vec3> x) const {
        const std::size_t n = at(region_->size());
        std::vector<double> right(3 * n, 0.0);
        for (const Known& known : known_) {
            for (std::size_t k = 0; k < 3; ++k) {
                right[k * n + at(known.row)] -=
                    known.value * x[at(known.vertex)][static_cast<Index>(k)];
            }
        }
        system_.solve(right, right, 3);
        for (std::size_t i = 0; i < n; ++i) {
            Vec3& to = x[at(region_->vertices()[i])];
            for (std::size_t k = 0; k < 3; ++k) to[static_cast<Index>(k)] = right[k * n + i];
        }
        return x;
    }

  private:
    using Terms = std::vector<std::pair<Index, double>>;

    static Terms terms(const Laplacian::Row& row) {
        Terms result{{row.vertex, 0.0}};
        for (const auto& [n, weight] : row.weights) {
            result.front().second += weight;
            result.emplace_back(n, -weight);
        }
        return result;
    }

    // Row a less row b, each divided by its area.
    static Terms difference(const Laplacian::Row& a, const Laplacian::Row& b) {
        std::map<Index, double> sum;
        for (const auto& [v, weight] : terms(a)) sum[v] += weight / a.area;
        for (const auto& [v, weight] : terms(b)) sum[v] -= weight / b.area;
        return {sum.begin(), sum.end()};
    }

    // Contribution of a vertex outside the region to the right side of a row.
    struct Known {
        Index row, vertex;
        double value;
    };

    // Adds scale * left^T right: to the matrix between unknowns, to the right side for known
    // positions.
    void add_product(const Terms& left, const Terms& right, double scale) {
        for (const auto& [v, a] : left) {
            const Index row = unknown_[v];
            if (row == kNoIndex) continue;
            for (const auto& [w, b] : right) {
                const double value = scale * a * b;
                if (unknown_[w] != kNoIndex) {
                    if (unknown_[w] <= row) entries_.push_back({row, unknown_[w], value});
                    continue;
                }
                known_.push_back({row, w, value});
            }
        }
    }

    const Region* region_;
    std::vector<Vec3> positions_;
    std::vector<Index> unknown_;
    std::vector<Triplet> entries_;
    std::vector<Known> known_;
    SparseSystem system_;
};

}  // namespace

void fair(Mesh& mesh, const Region& region, FairContinuity continuity, const Context& context) {
    require_same_topology(mesh, region.topology(), "the region");
    if (region.empty()) return;
    Progress progress(context, "fair");
    progress.step(0.3);
    FairingSystem membrane(region, mesh.positions());
    membrane.add_membrane(uniform_laplacian(mesh.topology(), region));
    const std::vector<Vec3> flat = membrane.solve(context);
    progress.step(0.7);
    FairingSystem last(region, flat);
    last.add_plate(cotangent_laplacian(mesh.topology(), flat, region));
    std::vector<Vec3> shape = last.solve(context);
    if (continuity == FairContinuity::curvature) {
        const Region around = region.grown(1);
        for (int pass = 0; pass < kVariationPasses; ++pass) {
            last = FairingSystem(region, shape);
            last.add_variation(cotangent_laplacian(mesh.topology(), shape, around),
                               mesh.topology());
            shape = last.solve(context);
        }
    }
    // The solution of the last system does not depend on the old positions of its unknowns.
    const MorphColumns morphs =
        mapped_morphs(mesh, [&](std::vector<Vec3> x) { return last.solved(std::move(x)); });
    mesh.set_positions(std::move(shape));
    set_morphs(mesh, morphs);
}

}  // namespace lissom
