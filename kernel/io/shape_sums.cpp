#include "kernel/io/shape_sums.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Shapes = std::vector<std::vector<float>>;

// Numbers of all shapes that are worked on at a time.
constexpr std::size_t kChunk = 3 * 1024;

// One column a shape: its numbers from `first` on.
MatrixXf chunk_of(const Shapes& shapes, std::size_t first, std::size_t count) {
    MatrixXf chunk(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(shapes.size()));
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        std::copy_n(shapes[s].data() + first, count,
                    chunk.col(static_cast<Eigen::Index>(s)).data());
    }
    return chunk;
}

// Calls use(first number, chunk).
template <typename Use>
void for_each_chunk(const Shapes& shapes, const Context& context, const Use& use) {
    const std::size_t length = shapes.front().size();
    for (std::size_t first = 0; first < length; first += kChunk) {
        context.checkpoint();
        use(first, chunk_of(shapes, first, std::min(kChunk, length - first)));
    }
}

// Products of all pairs of shapes, errors of directions weighing as much as those of positions.
MatrixXd products(const Shapes& shapes, const ShapeTolerance& tolerance, const Context& context) {
    const auto count = static_cast<Eigen::Index>(shapes.size());
    const auto scale = static_cast<float>(tolerance.position / tolerance.direction);
    MatrixXd sums = MatrixXd::Zero(count, count);
    for_each_chunk(shapes, context, [&](std::size_t first, MatrixXf chunk) {
        const std::size_t end = first + static_cast<std::size_t>(chunk.rows());
        const std::size_t split = std::clamp(tolerance.position_numbers, first, end);
        chunk.bottomRows(static_cast<Eigen::Index>(end - split)) *= scale;
        sums += (chunk.transpose() * chunk).cast<double>();
    });
    return sums;
}

// Principal components of the shapes, strongest first: a column for each, with a weight of each
// shape. The largest weight is positive, so that the answer is one.
MatrixXd components_of(const MatrixXd& products) {
    MatrixXd vectors = Eigen::SelfAdjointEigenSolver<MatrixXd>(products).eigenvectors();
    vectors = vectors.rowwise().reverse().eval();
    for (Eigen::Index c = 0; c < vectors.cols(); ++c) {
        Eigen::Index place = 0;
        vectors.col(c).cwiseAbs().maxCoeff(&place);
        if (vectors(place, c) < 0.0) vectors.col(c) = -vectors.col(c);
    }
    return vectors;
}

// The greatest distances of the sums of the first components from the shapes.
struct SumError {
    double position = 0.0, direction = 0.0;

    void look_at(const MatrixXf& differences, std::size_t first, std::size_t position_numbers) {
        for (Eigen::Index row = 0; row < differences.rows(); row += 3) {
            const double distance = std::sqrt(static_cast<double>(
                differences.middleRows<3>(row).colwise().squaredNorm().maxCoeff()));
            const bool is_position = first + static_cast<std::size_t>(row) < position_numbers;
            double& greatest = is_position ? position : direction;
            greatest = std::max(greatest, distance);
        }
    }
};

SumError error_of(const Shapes& shapes, const MatrixXd& components, Eigen::Index count,
                  const ShapeTolerance& tolerance, const Context& context) {
    const MatrixXf used = components.leftCols(count).cast<float>();
    SumError error;
    for_each_chunk(shapes, context, [&](std::size_t first, const MatrixXf& chunk) {
        const MatrixXf parts = chunk * used;
        error.look_at(chunk - parts * used.transpose(), first, tolerance.position_numbers);
    });
    return error;
}

// The least number of components that keep the tolerance, if the error falls with their number.
Eigen::Index needed_count(const Shapes& shapes, const MatrixXd& components,
                          const ShapeTolerance& tolerance, const Context& context) {
    Eigen::Index too_few = -1, enough = components.cols();
    while (enough - too_few > 1) {
        // Few are needed as a rule.
        const Eigen::Index tried = too_few + std::max<Eigen::Index>(1, (enough - too_few) / 4);
        const SumError error = error_of(shapes, components, tried, tolerance, context);
        const bool keeps =
            error.position <= tolerance.position && error.direction <= tolerance.direction;
        (keeps ? enough : too_few) = tried;
    }
    return enough;
}

}  // namespace

ShapeSums sum_shapes(const Shapes& shapes, const ShapeTolerance& tolerance,
                     const Context& context) {
    ShapeSums sums;
    if (shapes.empty()) return sums;
    const MatrixXd components = components_of(products(shapes, tolerance, context));
    const Eigen::Index count = needed_count(shapes, components, tolerance, context);
    const SumError error = error_of(shapes, components, count, tolerance, context);
    sums.max_error = error.position;
    sums.max_direction_error = error.direction;
    const auto length = shapes.front().size();
    const MemoryCharge charge = context.charge(
        static_cast<std::size_t>(count) * length * sizeof(float), "sums of baked shapes");
    MatrixXd used = components.leftCols(count);
    const Eigen::RowVectorXd largest = used.cwiseAbs().colwise().maxCoeff();
    sums.parts.assign(static_cast<std::size_t>(count), std::vector<float>(length));
    const MatrixXf makes = (used * largest.asDiagonal()).cast<float>();
    for_each_chunk(shapes, context, [&](std::size_t first, const MatrixXf& chunk) {
        const MatrixXf parts = chunk * makes;
        for (Eigen::Index c = 0; c < count; ++c) {
            std::copy_n(parts.col(c).data(), parts.rows(),
                        sums.parts[static_cast<std::size_t>(c)].data() + first);
        }
    });
    for (Eigen::Index s = 0; s < used.rows(); ++s) {
        std::vector<float>& weights = sums.weights.emplace_back();
        for (Eigen::Index c = 0; c < count; ++c) {
            weights.push_back(static_cast<float>(used(s, c) / largest[c]));
        }
    }
    return sums;
}

}  // namespace lissom
