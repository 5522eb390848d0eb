#include "kernel/thesis/transition/thesis_transition.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/extended.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "kernel/thesis/fidelity.h"

namespace lissom {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;
using Columns = Eigen::MatrixX3d;

void check(const TransitionMesh& side, const TransitionMesh& other) {
    const std::size_t n = side.mesh->vertex_count();
    require_vertices(side.mesh->topology(), side.region);
    if (side.position_known.size() != n || side.gradient_known.size() != n ||
        side.position.size() != n || side.gradient.size() != n ||
        side.region.size() != side.counterpart.size()) {
        throw Error(ErrorCode::invalid_argument,
                    "a transition needs one value for each vertex and one counterpart for each "
                    "vertex of its region");
    }
    for (const BandPlace& place : side.counterpart) {
        require_vertices(other.mesh->topology(), place.vertices);
    }
}

KnownMask knowledge_of(const TransitionMesh& side, const WorkingPatch& work) {
    const std::size_t n = work.patch.vertex_count;
    KnownMask known{std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 0)};
    for (Index i = 0; i < work.patch.real_count; ++i) {
        const Index v = work.patch.mesh_vertex[i];
        known.position[i] = side.position_known[v];
        known.gradient[i] = side.gradient_known[v];
    }
    for (std::size_t i = 0; i < n; ++i) {
        known.gradient_wanted[i] = !known.gradient[i] && work.rings.count(index_of(i)) > 0;
    }
    return known;
}

// One mesh with its operators.
struct ThesisSide {
    ThesisSide(const TransitionMesh& from, const DeformOptions& options)
        : given(from),
          work(build_patch(*from.mesh, Region::all(from.mesh->shared_topology()), 0), options),
          known(knowledge_of(from, work)),
          stencils(make_gradients(work.patch, work.rings, work.geometry, known, -work.patch.origin,
                                  options)) {}

    Index size() const { return work.patch.vertex_count; }
    bool has_gradient(Index i) const { return known.gradient[i] || stencils.defined[i]; }

    const TransitionMesh& given;
    WorkingPatch work;
    KnownMask known;
    GradientStencils stencils;
};

// The quadratic form of both meshes over their stacked vertices, those of the source last.
class Assembler {
  public:
    Assembler(const ThesisSide& target, const ThesisSide& source)
        : sides_{&target, &source},
          offset_{0, target.size()},
          size_(target.size() + source.size()),
          delta_(Columns::Zero(size_, 3)),
          transformed_(size_, size_),
          transformed_constant_(Columns::Zero(size_, 3)) {
        Entries laplacian, coherence;
        std::array<Entries, 3> gradient;
        gradient_constant_.fill(delta_);
        for (std::size_t s = 0; s < 2; ++s) {
            add_rows(s, laplacian, gradient);
            add_pairs(s, coherence);
        }
        laplacian_ = made(laplacian, size_);
        coherence_ = made(coherence, size_);
        for (std::size_t d = 0; d < 3; ++d) {
            gradient_[d] = made(gradient[d], size_);
            const auto delta = delta_.col(static_cast<Eigen::Index>(d)).asDiagonal();
            transformed_ += delta * gradient_[d];
            transformed_constant_ += delta * gradient_constant_[d];
        }
    }

    Index size() const { return size_; }
    Index offset(std::size_t side) const { return offset_[side]; }

    // Half the Hessian of E_L + E_R + weight E_T, and half its linear part.
    void assemble(double weight, Matrix& matrix, Columns& linear) const {
        const Matrix residual = laplacian_ - transformed_;
        matrix = residual.transpose() * residual;
        linear = -(residual.transpose() * transformed_constant_);
        for (std::size_t d = 0; d < 3; ++d) {
            const Matrix left = gradient_[d].transpose() * coherence_;
            matrix += left * gradient_[d];
            linear += left * gradient_constant_[d];
        }
        const Matrix between = counterparts();
        const Matrix difference = between * transformed_;
        matrix += weight * Matrix(difference.transpose() * difference);
        linear += weight * (difference.transpose() * (between * transformed_constant_));
    }

    // M_i of stacked positions.
    Mat3 gradient(std::size_t side, Index i, const Columns& x) const {
        const ThesisSide& s = *sides_[side];
        if (s.known.gradient[i]) return s.given.gradient[s.work.patch.mesh_vertex[i]];
        if (!s.stencils.defined[i]) return Mat3::Identity();
        Mat3 m = x.row(offset_[side] + i).transpose() * s.stencils.self[i].transpose();
        for (Index e = s.work.rings.begin[i]; e < s.work.rings.begin[i + 1]; ++e) {
            m += x.row(offset_[side] + s.work.rings.neighbor[e]).transpose() *
                 s.stencils.neighbor[e].transpose();
        }
        return m;
    }

  private:
    Matrix made(const Entries& entries, Index rows) const {
        Matrix matrix(rows, size_);
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    }

    // L and M, and delta for vertices with a term in Eq 2.6.
    void add_rows(std::size_t number, Entries& laplacian, std::array<Entries, 3>& gradient) {
        const ThesisSide& side = *sides_[number];
        const Rings& rings = side.work.rings;
        for (Index i = 0; i < rings.size(); ++i) {
            const Index row = offset_[number] + i;
            const bool known = side.known.gradient[i] != 0;
            const bool has_term = side.has_gradient(i) && side.work.laplacian.weight[i] > 0.0;
            if (has_term) {
                delta_.row(row) =
                    side.work.laplacian.apply(rings, side.stencils.displaced_rest, i).transpose();
                laplacian.emplace_back(row, row, side.work.laplacian.self[i]);
            }
            for (std::size_t d = 0; d < 3; ++d) {
                const auto k = static_cast<Eigen::Index>(d);
                if (known) {
                    gradient_constant_[d].row(row) =
                        side.given.gradient[side.work.patch.mesh_vertex[i]].col(k).transpose();
                } else if (side.stencils.defined[i]) {
                    gradient[d].emplace_back(row, row, side.stencils.self[i][k]);
                }
            }
            for (Index e = rings.begin[i]; e < rings.begin[i + 1]; ++e) {
                const Index column = offset_[number] + rings.neighbor[e];
                if (has_term) {
                    laplacian.emplace_back(row, column, side.work.laplacian.neighbor[e]);
                }
                for (std::size_t d = 0; !known && side.stencils.defined[i] && d < 3; ++d) {
                    gradient[d].emplace_back(row, column, side.stencils.neighbor[e][index_of(d)]);
                }
            }
        }
    }

    // The pairs SF of Eq 2.7: two rings, each pair from both its ends.
    void add_pairs(std::size_t number, Entries& coherence) const {
        const ThesisSide& side = *sides_[number];
        const Rings& rings = side.work.rings;
        std::vector<Index> near;
        for (Index i = 0; i < rings.size(); ++i) {
            if (!side.has_gradient(i)) continue;
            near.clear();
            for (const Index j : rings.ring(i)) {
                near.push_back(j);
                near.insert(near.end(), rings.ring(j).begin(), rings.ring(j).end());
            }
            std::sort(near.begin(), near.end());
            near.erase(std::unique(near.begin(), near.end()), near.end());
            for (const Index j : near) {
                if (j == i || !side.has_gradient(j)) continue;
                const Index row = offset_[number] + i;
                coherence.emplace_back(row, row, 2.0);
                coherence.emplace_back(row, offset_[number] + j, -2.0);
            }
        }
    }

    // Rows e_i - sum_j b_j e_j over both transition regions.
    Matrix counterparts() const {
        Entries entries;
        Index row = 0;
        for (std::size_t s = 0; s < 2; ++s) {
            const TransitionMesh& given = sides_[s]->given;
            for (std::size_t r = 0; r < given.region.size(); ++r, ++row) {
                entries.emplace_back(row, offset_[s] + given.region[r], 1.0);
                for (std::size_t k = 0; k < 3; ++k) {
                    entries.emplace_back(row, offset_[1 - s] + given.counterpart[r].vertices[k],
                                         -given.counterpart[r].weights[k]);
                }
            }
        }
        return made(entries, row);
    }

    std::array<const ThesisSide*, 2> sides_;
    std::array<Index, 2> offset_;
    Index size_;
    Columns delta_;
    Matrix laplacian_, coherence_, transformed_;
    std::array<Matrix, 3> gradient_;
    std::array<Columns, 3> gradient_constant_;
    Columns transformed_constant_;
};

SymmetricMatrix lower_part(const Matrix& matrix, const std::vector<Index>& row_of, Index rows) {
    std::vector<Triplet> entries;
    for (Index j = 0; j < matrix.outerSize(); ++j) {
        if (row_of[j] == kNoIndex) continue;
        for (Matrix::InnerIterator e(matrix, j); e; ++e) {
            const Index i = row_of[e.row()];
            if (i != kNoIndex && i >= row_of[j]) entries.push_back({i, row_of[j], e.value()});
        }
    }
    return symmetric_from_triplets(rows, entries);
}

// Solves for the unknown entries.
void minimise(const Matrix& matrix, const Columns& linear, const std::vector<Index>& row_of,
              Index rows, Columns& x, const Context& context) {
    if (rows == 0) return;
    const Columns gradient = matrix * x + linear;
    const std::size_t n = rows;
    std::vector<double> b(3 * n);
    for (std::size_t i = 0; i < row_of.size(); ++i) {
        if (row_of[i] == kNoIndex) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            b[k * n + row_of[i]] = -gradient(index_of(i), index_of(k));
        }
    }
    const SymmetricMatrix free = lower_part(matrix, row_of, rows);
    SparseSystem system;
    system.analyze(free, context);
    system.factor(free, context);
    const std::vector<Extended> exact(b.begin(), b.end());
    system.solve_refined(free, exact, b, 3);
    for (std::size_t i = 0; i < row_of.size(); ++i) {
        if (row_of[i] == kNoIndex) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            x(index_of(i), index_of(k)) += b[k * n + row_of[i]];
        }
    }
}

// Displaced vertices come back by v = M (v - v') + v' (section 2.4.3).
TransitionShape shape_of(const ThesisSide& side, std::size_t number, const Assembler& assembler,
                         const Columns& x, const Vec3& origin) {
    TransitionShape shape{side.given.position,
                          std::vector<Mat3>(side.given.position.size(), Mat3::Identity())};
    for (Index i = 0; i < side.work.patch.real_count; ++i) {
        const Index v = side.work.patch.mesh_vertex[i];
        shape.gradients[v] = assembler.gradient(number, i, x);
        if (side.known.position[i]) continue;
        const Vec3 back = side.work.patch.rest[i] - side.stencils.displaced_rest[i];
        shape.positions[v] =
            origin + x.row(assembler.offset(number) + i).transpose() + shape.gradients[v] * back;
    }
    return shape;
}

}  // namespace

ThesisTransition thesis_transition(const TransitionMesh& target, const TransitionMesh& source,
                                   double weight, const Context& context) {
    if (!(weight >= 0.0 && std::isfinite(weight))) {
        throw Error(ErrorCode::invalid_argument,
                    "the weight of a transition must be 0 or a finite number above it");
    }
    check(target, source);
    check(source, target);
    Progress progress(context, "transition");
    progress.step(0.5);
    const DeformOptions options = thesis_deform_options();
    const std::array<ThesisSide, 2> sides{ThesisSide(target, options), ThesisSide(source, options)};
    const Assembler assembler(sides[0], sides[1]);
    Matrix matrix;
    Columns linear;
    assembler.assemble(weight, matrix, linear);

    progress.step(0.5);
    const Vec3 origin = sides[0].work.patch.origin;
    Columns x = Columns::Zero(assembler.size(), 3);
    std::vector<Index> row_of(assembler.size(), kNoIndex);
    Index rows = 0;
    for (std::size_t s = 0; s < 2; ++s) {
        for (Index i = 0; i < sides[s].size(); ++i) {
            const Index row = assembler.offset(s) + i;
            if (sides[s].known.position[i]) {
                const Index v = sides[s].work.patch.mesh_vertex[i];
                x.row(row) = (sides[s].given.position[v] - origin).transpose();
            } else {
                row_of[row] = rows++;
            }
        }
    }
    minimise(matrix, linear, row_of, rows, x, context);
    return {shape_of(sides[0], 0, assembler, x, origin),
            shape_of(sides[1], 1, assembler, x, origin)};
}

}  // namespace lissom
