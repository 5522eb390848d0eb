#include "kernel/solve/field/boundary_correction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr int kMaxCorrections = 300;

class Correction {
  public:
    Correction(const BoundaryProblem& problem, FieldWorkspace& workspace, const Context& context)
        : problem_(problem),
          size_(problem.green.size()),
          count_(at(size_.count())),
          workspace_(workspace),
          context_(context),
          charge_(context.charge(kCorrectionFields * field_entries(size_) * sizeof(double),
                                 "the thesis's boundary weights")),
          residual_(make_field(size_)),
          step_(make_field(size_)),
          direction_(make_field(size_)),
          product_(make_field(size_)) {}

    void run(std::span<const Vec3> multipliers, double* field) {
        start(multipliers, field);
        Vec3 rz_before = Vec3::Zero(), alpha = Vec3::Zero();
        for (int iteration = 0; iteration < kMaxCorrections; ++iteration) {
            precondition();
            if (greatest(step_.get()) <= problem_.tolerance) {
                add(field, Vec3::Ones(), step_.get());
                return;
            }
            const Vec3 rz = dot(residual_.get(), step_.get());
            // This form of beta tolerates a preconditioner solved only to a tolerance.
            const Vec3 change = -alpha.cwiseProduct(dot(product_.get(), step_.get()));
            turn(iteration == 0 ? Vec3(Vec3::Zero()) : ratio(change, rz_before));
            multiply();
            alpha = ratio(rz, dot(direction_.get(), product_.get()));
            add(field, alpha, direction_.get());
            add(residual_.get(), -alpha, product_.get());
            rz_before = rz;
        }
        throw Error(ErrorCode::not_positive_definite,
                    "the boundary weights of the thesis did not converge; use a greater tolerance");
    }

  private:
    // U W^2 (c - U' t) is U lambda, so the residual is U lambda - A0 t.
    void start(std::span<const Vec3> multipliers, const double* field) {
        problem_.exact.apply(field, residual_.get(), workspace_.first.get(), context_);
        for (std::size_t i = 0; i < 3 * count_; ++i) residual_[i] = -residual_[i];
        const ConstraintRows& rows = problem_.dual.rows();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t at = size_.index(rows.point[i]);
            for (int c = 0; c < kComponents; ++c) residual_[c * count_ + at] += multipliers[i][c];
        }
        std::fill_n(direction_.get(), 3 * count_, 0.0);
        std::fill_n(product_.get(), 3 * count_, 0.0);
    }

    // step = (zero-flux system)^-1 residual. With u = A0+ r: (G + W^-2) lambda - 1 a = U'u,
    // 1' lambda = 1' r, step = u - A0+ U lambda + a.
    void precondition() {
        std::copy_n(residual_.get(), 3 * count_, step_.get());
        Vec3 total;
        for (int c = 0; c < kComponents; ++c) total[c] = sum(residual_.get() + c * count_);
        problem_.green.apply(step_.get(), workspace_.first.get(), context_);
        const ConstraintRows& rows = problem_.dual.rows();
        std::vector<Vec3> g;
        g.reserve(rows.size());
        for (const GridPoint& p : rows.point) {
            g.push_back(vector_at(step_.get(), size_, size_.index(p)));
        }
        const DualSolution dual = problem_.dual.solve(g, total, workspace_, context_);
        FieldSink sink;
        sink.components = workspace_.second.get();
        sink.constant = dual.constant;
        problem_.green.apply_at(rows.point, dual.multiplier, workspace_.first.get(),
                                workspace_.second.get(), sink, context_);
        add(step_.get(), -Vec3::Ones(), workspace_.second.get());
        // U't is W^-2 lambda; W^2 would amplify the error left by inexact multipliers.
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t at = size_.index(rows.point[i]);
            const double square = rows.weight[i] * rows.weight[i];
            for (int c = 0; c < kComponents; ++c) {
                step_[c * count_ + at] = dual.multiplier[i][c] / square;
            }
        }
    }

    // product = (A0 + U W^2 U') direction.
    void multiply() {
        problem_.exact.apply(direction_.get(), product_.get(), workspace_.first.get(), context_);
        const ConstraintRows& rows = problem_.dual.rows();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t at = size_.index(rows.point[i]);
            const double square = rows.weight[i] * rows.weight[i];
            for (int c = 0; c < kComponents; ++c) {
                product_[c * count_ + at] += square * direction_[c * count_ + at];
            }
        }
    }

    void turn(const Vec3& beta) {
        for (int c = 0; c < kComponents; ++c) {
            double* p = direction_.get() + c * count_;
            const double* z = step_.get() + c * count_;
            for (std::size_t i = 0; i < count_; ++i) p[i] = z[i] + beta[c] * p[i];
        }
        context_.checkpoint();
    }

    void add(double* to, const Vec3& factor, const double* from) const {
        for (int c = 0; c < kComponents; ++c) {
            for (std::size_t i = c * count_; i < (c + 1) * count_; ++i)
                to[i] += factor[c] * from[i];
        }
    }

    double sum(const double* x) const {
        return Eigen::Map<const Eigen::VectorXd>(x, size_.count()).sum();
    }

    Vec3 dot(const double* a, const double* b) const {
        Vec3 result;
        for (int c = 0; c < kComponents; ++c) {
            result[c] = Eigen::Map<const Eigen::VectorXd>(a + c * count_, size_.count())
                            .dot(Eigen::Map<const Eigen::VectorXd>(b + c * count_, size_.count()));
        }
        return result;
    }

    double greatest(const double* x) const {
        return Eigen::Map<const Eigen::VectorXd>(x, 3 * size_.count()).cwiseAbs().maxCoeff();
    }

    static Vec3 ratio(const Vec3& a, const Vec3& b) {
        Vec3 quotient = Vec3::Zero();
        for (int c = 0; c < kComponents; ++c) {
            if (b[c] > 0.0) quotient[c] = a[c] / b[c];
        }
        return quotient;
    }

    const BoundaryProblem& problem_;
    GridSize size_;
    std::size_t count_;
    FieldWorkspace& workspace_;
    const Context& context_;
    MemoryCharge charge_;
    FieldBuffer residual_, step_, direction_, product_;
};

}  // namespace

void correct_boundary(const BoundaryProblem& problem, std::span<const Vec3> multipliers,
                      double* field, FieldWorkspace& workspace, const Context& context) {
    Correction(problem, workspace, context).run(multipliers, field);
}

}  // namespace lissom
