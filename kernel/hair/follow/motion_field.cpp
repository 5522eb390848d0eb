#include "kernel/hair/follow/motion_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lissom {
namespace {

// Metres; wider for hair that would need more nodes.
constexpr double kFieldStep = 0.02;
constexpr double kMostNodes = 200000.0;
// Square metres that are added to squares of distances.
constexpr double kNearest = 1e-4;
constexpr Index kFieldRows = 128;

Box box_of(std::span<const float> points) {
    Box box;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        const Vec3 p(points[i], points[i + 1], points[i + 2]);
        if (p.allFinite()) box.extend(p);
    }
    return box;
}

}  // namespace

MotionField::MotionField(std::span<const float> points, const HeadMotion& head,
                         std::vector<Index> samples, const Context& context)
    : samples_(std::move(samples)) {
    const Box box = box_of(points);
    if (box.empty()) return;
    lay_out(box);
    mark(points);
    charge_ = context.charge(memory_bytes() + used_.size() * samples_.size() * sizeof(float),
                             "hair that follows");
    weigh(head, context);
}

void MotionField::lay_out(const Box& box) {
    const Vec3 size = box.max - box.min;
    double step = kFieldStep;
    const auto nodes = [&] { return (size / step + Vec3::Constant(3.0)).prod(); };
    while (nodes() > kMostNodes) step *= 1.25;
    origin_.head<3>() = (box.min - Vec3::Constant(0.5 * step)).cast<float>().array();
    per_step_ = static_cast<float>(1.0 / step);
    for (std::size_t i = 0; i < 3; ++i) {
        counts_[i] = static_cast<Index>(size[index_of(i)] / step) + 3;
        // The last cell takes what rounding would put behind it.
        most_[index_of(i)] = static_cast<float>(counts_[i]) - 1.001f;
    }
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const auto bit = [&](unsigned k) { return static_cast<Index>(corner >> k & 1u); };
        steps_[corner] = (bit(2) * counts_[1] + bit(1)) * counts_[0] + bit(0);
    }
    nodes_.assign(at(counts_[0]) * at(counts_[1]) * at(counts_[2]), Node::Zero());
}

void MotionField::mark(std::span<const float> points) {
    std::vector<char> marks(nodes_.size(), 0);
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        const Eigen::Array3f p(points[i], points[i + 1], points[i + 2]);
        if (!p.isFinite().all()) continue;
        const Eigen::Array3i low =
            ((p - origin_.head<3>()) * per_step_).max(0.0f).min(most_).cast<int>();
        const Index first = (low[2] * counts_[1] + low[1]) * counts_[0] + low[0];
        for (const Index step : steps_) marks[at(first + step)] = 1;
    }
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i]) used_.push_back(index_of(i));
    }
}

void MotionField::weigh(const HeadMotion& head, const Context& context) {
    weights_.resize(count_of(used_), count_of(samples_));
    motions_.resize(count_of(samples_), 16);
    const double step = 1.0 / double{per_step_};
    context.parallel_for(0, count_of(used_), kFieldRows, [&](Index begin, Index end) {
        std::vector<double> row(samples_.size());
        for (Index i = begin; i < end; ++i) {
            const Index node = used_[at(i)], x = node % counts_[0], y = node / counts_[0];
            const Index z = y / counts_[1];
            const Vec3 cell(x, y % counts_[1], z);
            const Vec3 place = origin_.head<3>().matrix().cast<double>() + step * cell;
            double sum = 0.0;
            for (std::size_t j = 0; j < samples_.size(); ++j) {
                const double d = (head.rest()[at(samples_[j])] - place).squaredNorm() + kNearest;
                sum += row[j] = 1.0 / (d * d);
            }
            for (std::size_t j = 0; j < samples_.size(); ++j) {
                weights_(i, index_of(j)) = static_cast<float>(row[j] / sum);
            }
        }
    });
}

void MotionField::move(const HeadMotion& head, const Context& context) {
    const Vec3 origin = origin_.head<3>().matrix().cast<double>();
    for (std::size_t j = 0; j < samples_.size(); ++j) {
        const std::size_t v = at(samples_[j]);
        const Vec4& q = head.rotations()[v];
        const Eigen::Quaterniond turn =
            q.isZero(0.0) ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(q);
        const Mat3 linear = head.scale() * turn.toRotationMatrix();
        const Vec3 offset = linear * (origin - head.rest()[v]) + head.places()[v] - origin;
        Eigen::Matrix4f motion = Eigen::Matrix4f::Zero();
        motion.topLeftCorner<3, 3>() = (linear - Mat3::Identity()).cast<float>();
        motion.topRightCorner<3, 1>() = offset.cast<float>();
        motions_.row(index_of(j)) = Eigen::Map<const Eigen::Matrix<float, 1, 16>>(motion.data());
    }
    context.parallel_for(0, count_of(used_), kFieldRows, [&](Index begin, Index end) {
        Eigen::Matrix<float, Eigen::Dynamic, 16, Eigen::RowMajor, kFieldRows, 16> rows(end - begin,
                                                                                       16);
        rows.noalias() = weights_.middleRows(begin, end - begin) * motions_;
        for (Index i = begin; i < end; ++i) {
            nodes_[at(used_[at(i)])] = Eigen::Map<const Node>(rows.data() + 16 * (i - begin));
        }
    });
}

std::size_t MotionField::memory_bytes() const {
    return nodes_.size() * sizeof(Node) + used_.size() * sizeof(Index) +
           static_cast<std::size_t>(weights_.size() + motions_.size()) * sizeof(float);
}

std::vector<Index> spread_vertices(std::span<const Vec3> places, std::span<const Index> among,
                                   Index count) {
    std::vector<Index> chosen;
    if (among.empty()) return chosen;
    Vec3 middle = Vec3::Zero();
    for (const Index v : among) middle += places[at(v)] / static_cast<double>(among.size());
    std::vector<double> distances;
    for (const Index v : among) distances.push_back((places[at(v)] - middle).squaredNorm());
    bool first = true;
    while (count_of(chosen) < count) {
        const auto farthest = std::max_element(distances.begin(), distances.end());
        if (!first && !(*farthest > 0.0)) break;
        const Index v = among[static_cast<std::size_t>(farthest - distances.begin())];
        chosen.push_back(v);
        for (std::size_t i = 0; i < among.size(); ++i) {
            const double d = (places[at(among[i])] - places[at(v)]).squaredNorm();
            distances[i] = first ? d : std::min(distances[i], d);
        }
        first = false;
    }
    return chosen;
}

}  // namespace lissom
