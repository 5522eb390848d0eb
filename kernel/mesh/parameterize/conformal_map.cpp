#include "kernel/mesh/parameterize/conformal_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <unordered_map>
#include <utility>

#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

// Added to the energy, as a part of the spread, so that its matrix has an inverse: far below the
// second eigenvalue, which is about the square of an edge's length over that of the boundary.
constexpr double kShift = 1e-9;
// Steps of Lanczos iteration, and the residual beside the eigenvalue at which it ends.
constexpr Index kMaximumSteps = 60;
constexpr double kResidual = 1e-10;

// Vertices of the open boundary and the fraction of its length at each, with sum 1.
struct BoundarySpread {
    std::vector<Index> vertex;
    std::vector<double> fraction;
    // Start of the search: the longest loop around a circle by arc length, the others on 0.
    ComplexVector start;
};

BoundarySpread boundary_spread(const Chart& chart) {
    BoundarySpread spread;
    std::vector<Complex> start;
    double total = 0.0;
    for (const std::vector<Index>& loop : chart.open_loops) {
        const double length = loop_length(chart, loop);
        const auto side = [&](std::size_t i) {
            const Index from = loop[i % loop.size()], to = loop[(i + 1) % loop.size()];
            return (chart.positions[to] - chart.positions[from]).norm();
        };
        double along = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            spread.vertex.push_back(loop[i]);
            spread.fraction.push_back(0.5 * (side(i) + side(i + loop.size() - 1)));
            const bool first = &loop == chart.open_loops.data();
            start.push_back(first ? std::polar(1.0, 2.0 * kPi * along / length) : Complex(0.0));
            along += side(i);
        }
        total += length;
    }
    for (double& fraction : spread.fraction) fraction /= total;
    spread.start = Eigen::Map<const ComplexVector>(start.data(), std::ssize(start));
    return spread;
}

// Edges in the sum for the area of the image, by pair_key(low, high): positive if the boundary runs
// from the lower vertex to the higher.
using AreaEdges = std::unordered_map<std::uint64_t, double>;

AreaEdges area_edges(const Chart& chart) {
    AreaEdges edges;
    for (const std::vector<Index>& loop : chart.open_loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index a = loop[i], b = loop[(i + 1) % loop.size()];
            edges[pair_key(std::min(a, b), std::max(a, b))] = a < b ? 1.0 : -1.0;
        }
    }
    return edges;
}

// Twice the conformal energy over u and v of all vertices in turn, from the matrix of the Dirichlet
// energy and the edges of the area.
SymmetricMatrix conformal_matrix(const SymmetricMatrix& laplacian, const AreaEdges& area,
                                 const BoundarySpread& spread) {
    std::vector<double> shift(at(laplacian.size()), 0.0);
    for (std::size_t i = 0; i < spread.vertex.size(); ++i) {
        shift[spread.vertex[i]] += kShift * spread.fraction[i];
    }
    SymmetricMatrix matrix;
    matrix.begin.reserve(2 * laplacian.begin.size());
    matrix.row.reserve(2 * laplacian.row.size() + 4 * area.size());
    matrix.value.reserve(matrix.row.capacity());
    const auto add = [&](Index row, double value) {
        matrix.row.push_back(row);
        matrix.value.push_back(value);
    };
    for (Index v = 0; v < laplacian.size(); ++v) {
        for (const Index part : {0, 1}) {
            const Index first = laplacian.begin[v];
            add(2 * v + part, laplacian.value[first] + shift[v]);
            for (Index e = first + 1; e < laplacian.begin[v + 1]; ++e) {
                const Index w = laplacian.row[e];
                const auto found = area.find(pair_key(v, w));
                const double half = found == area.end() ? 0.0 : 0.5 * found->second;
                if (part == 1 && half != 0.0) add(2 * w, half);
                add(2 * w + part, laplacian.value[e]);
                if (part == 0 && half != 0.0) add(2 * w + 1, -half);
            }
            matrix.begin.push_back(count_of(matrix.row));
        }
    }
    return matrix;
}

// The inverse of the energy after the spread. It depends on the values at the boundary alone, and
// Lanczos iteration needs no others.
class ConformalInverse {
  public:
    ConformalInverse(const SymmetricMatrix& matrix, const BoundarySpread& spread,
                     const Context& context)
        : spread_(spread), values_(at(matrix.size())) {
        system_.analyze(matrix, context);
        system_.factor(matrix, context);
    }

    // Values at all vertices, without their mean over the boundary.
    std::vector<Vec2> everywhere(const ComplexVector& boundary) {
        solve(boundary);
        const Complex mean = mean_of(at_boundary());
        std::vector<Vec2> result;
        result.reserve(values_.size() / 2);
        for (std::size_t i = 0; i < values_.size(); i += 2) {
            result.emplace_back(values_[i] - mean.real(), values_[i + 1] - mean.imag());
        }
        return result;
    }

    ComplexVector operator()(const ComplexVector& boundary) {
        solve(boundary);
        return centered(at_boundary());
    }

    ComplexVector centered(ComplexVector values) const {
        values.array() -= mean_of(values);
        return values;
    }

    Complex product(const ComplexVector& a, const ComplexVector& b) const {
        Complex sum = 0.0;
        for (Eigen::Index i = 0; i < a.size(); ++i) {
            sum += spread_.fraction[i] * std::conj(a[i]) * b[i];
        }
        return sum;
    }
    double length(const ComplexVector& a) const { return std::sqrt(product(a, a).real()); }

  private:
    Complex mean_of(const ComplexVector& values) const {
        Complex sum = 0.0;
        for (Eigen::Index i = 0; i < values.size(); ++i) sum += spread_.fraction[i] * values[i];
        return sum;
    }

    void solve(const ComplexVector& boundary) {
        std::fill(values_.begin(), values_.end(), 0.0);
        for (std::size_t i = 0; i < spread_.vertex.size(); ++i) {
            const Complex value = spread_.fraction[i] * boundary[index_of(i)];
            values_[2 * at(spread_.vertex[i])] += value.real();
            values_[2 * at(spread_.vertex[i]) + 1] += value.imag();
        }
        system_.solve(values_, values_, 1);
    }

    ComplexVector at_boundary() const {
        ComplexVector result(std::ssize(spread_.vertex));
        for (std::size_t i = 0; i < spread_.vertex.size(); ++i) {
            const std::size_t v = 2 * at(spread_.vertex[i]);
            result[index_of(i)] = Complex(values_[v], values_[v + 1]);
        }
        return result;
    }

    const BoundarySpread& spread_;
    SparseSystem system_;
    std::vector<double> values_;
};

// The eigenvector of the greatest eigenvalue of the inverse, at the boundary.
class ConformalLanczos {
  public:
    explicit ConformalLanczos(ConformalInverse& inverse) : inverse_(inverse) {}

    ComplexVector find(ComplexVector next, const Context& context) {
        next = inverse_.centered(std::move(next));
        double length = inverse_.length(next);
        for (Index step = 0; step < kMaximumSteps && length > 0.0; ++step) {
            context.checkpoint();
            basis_.push_back(next / length);
            next = inverse_(basis_.back());
            diagonal_.push_back(inverse_.product(basis_.back(), next).real());
            for (int pass = 0; pass < 2; ++pass) {
                for (const ComplexVector& v : basis_) next -= inverse_.product(v, next) * v;
            }
            length = inverse_.length(next);
            if (converged(length)) break;
            beside_.push_back(length);
        }
        ComplexVector result = ComplexVector::Zero(basis_[0].size());
        for (std::size_t i = 0; i < basis_.size(); ++i) {
            result += weights_[index_of(i)] * basis_[i];
        }
        return result;
    }

  private:
    bool converged(double residual) {
        const Index n = count_of(diagonal_);
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
        for (Index i = 0; i < n; ++i) matrix(i, i) = diagonal_[i];
        for (Index i = 1; i < n; ++i) matrix(i, i - 1) = matrix(i - 1, i) = beside_[i - 1];
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solution(matrix);
        // Eigen frees a vector before it allocates a longer one: without memory it would be freed
        // twice.
        weights_ = Eigen::VectorXd(solution.eigenvectors().col(n - 1));
        return residual * std::abs(weights_[n - 1]) <= kResidual * solution.eigenvalues()[n - 1];
    }

    ConformalInverse& inverse_;
    std::vector<ComplexVector> basis_;
    // Entries of the tridiagonal matrix of the inverse in this basis.
    std::vector<double> diagonal_, beside_;
    Eigen::VectorXd weights_;
};

}  // namespace

std::vector<Vec2> conformal_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                                const Context& context) {
    const BoundarySpread spread = boundary_spread(chart);
    require(spread.start.size() > 0 && std::isfinite(spread.fraction[0]),
            "the outline of the faces has no length; choose a larger region");
    const SymmetricMatrix matrix =
        conformal_matrix(chart_laplacian(chart, shapes), area_edges(chart), spread);
    ConformalInverse inverse(matrix, spread, context);
    return inverse.everywhere(ConformalLanczos(inverse).find(spread.start, context));
}

}  // namespace lissom
