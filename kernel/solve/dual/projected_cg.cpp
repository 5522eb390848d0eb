#include "kernel/solve/dual/projected_cg.h"

#include <algorithm>

#include "kernel/core/error.h"

namespace lissom {
namespace {

using Vectors = std::vector<Vec3>;

// The preconditioner needs some 10 to 30; many more mean that it does not fit the matrix.
constexpr int kMaxIterations = 1000;

Vec3 sum_of(std::span<const Vec3> v) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& x : v) sum += x;
    return sum;
}

Vec3 dot(const Vectors& a, const Vectors& b) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].cwiseProduct(b[i]);
    return sum;
}

double greatest(std::span<const Vec3> v) {
    double most = 0.0;
    for (const Vec3& x : v) most = std::max(most, x.cwiseAbs().maxCoeff());
    return most;
}

// to += factor from, a factor for each component.
void add(Vectors& to, const Vec3& factor, const Vectors& from) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor.cwiseProduct(from[i]);
}

// Component by component; 0 if the divisor vanished.
Vec3 ratio(const Vec3& a, const Vec3& b) {
    Vec3 quotient = Vec3::Zero();
    for (int c = 0; c < kComponents; ++c) {
        if (b[c] > 0.0) quotient[c] = a[c] / b[c];
    }
    return quotient;
}

}  // namespace

void ProjectedCG::update(const ConstraintRows& rows, const Context& context) {
    factor_.update(green_, rows, context);
    rows_ = rows;
    const Vectors ones(rows.size(), Vec3::Ones());
    ones_.resize(rows.size());
    factor_.apply(ones, ones_);
    ones_sum_ = sum_of(ones_).x();
}

// y = (G + W^-2) x.
void ProjectedCG::multiply(const Vectors& x, Vectors& y, FieldWorkspace& workspace,
                           const Context& context) const {
    FieldSink sink;
    sink.components = workspace.second.get();
    green_.apply_at(rows_.point, x, workspace.first.get(), workspace.second.get(), sink, context);
    const GridSize& size = green_.size();
    for (std::size_t i = 0; i < x.size(); ++i) {
        y[i] = vector_at(workspace.second.get(), size, size.index(rows_.point[i])) +
               x[i] / (rows_.weight[i] * rows_.weight[i]);
    }
}

DualSolution ProjectedCG::solve(std::span<const Vec3> g, const Vec3& total,
                                FieldWorkspace& workspace, const Context& context) const {
    const std::size_t count = g.size();
    DualSolution solution;
    Vectors& x = solution.multiplier;
    // Not from the last solution: the result must not depend on history.
    x.assign(count, total / static_cast<double>(count));

    Vectors product(count), r(g.begin(), g.end()), z(count), p(count, Vec3::Zero());
    multiply(x, product, workspace, context);
    add(r, -Vec3::Ones(), product);
    const double enough = tolerance_ * greatest(g);
    Vec3 rz_before = Vec3::Zero();
    for (int iteration = 0;; ++iteration) {
        factor_.apply(r, z);
        // The constant is taken out of the residual, or it would drown the rest.
        const Vec3 constant = sum_of(z) / ones_sum_;
        solution.constant += constant;
        for (Vec3& v : r) v -= constant;
        if (greatest(r) <= enough) return solution;
        if (iteration == kMaxIterations) {
            throw Error(ErrorCode::not_positive_definite,
                        "the constraints of the grid did not converge; use weights that differ "
                        "less, or a greater tolerance");
        }
        add(z, -constant, ones_);
        const Vec3 rz = dot(r, z), beta = ratio(rz, rz_before);
        for (std::size_t i = 0; i < count; ++i) p[i] = z[i] + beta.cwiseProduct(p[i]);
        multiply(p, product, workspace, context);
        const Vec3 alpha = ratio(rz, dot(p, product));
        add(x, alpha, p);
        add(r, -alpha, product);
        rz_before = rz;
    }
}

}  // namespace lissom
