#include "kernel/hair/dynamics/rods.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/rotation.h"

namespace lissom {
namespace {

// Segments are not shorter than this, in metres, for those that have no length at rest.
constexpr double kLeastSegment = 1e-6;
// Earth's gravity, by which the length that tells a stiffness has its meaning.
constexpr double kEarth = 9.81;
// Seconds over which hair's own damping takes away a change of its bend.
constexpr double kBendDamping = 0.02;
constexpr int kMaxLengthRounds = 6;
constexpr double kLengthError = 1e-5;
// Of rods between held points that are straight: their system has no single answer.
constexpr double kLeastPivot = 1e-6;
constexpr std::size_t kMaxRodPoints = 256;

Vec3 direction_between(const Vec3& from, const Vec3& to, const Vec3& otherwise) {
    const Vec3 along = to - from;
    const double norm = along.norm();
    return norm > 0.0 ? Vec3(along / norm) : otherwise;
}

// Change of a unit direction as it turns by the least rotation of another one, `along`: a matrix on
// the change of that.
Mat3 carried(const Vec3& along, const Vec3& direction) {
    return along.dot(direction) * Mat3::Identity() - along * direction.transpose();
}

}  // namespace

Rods::Rods(const HairRig& rig) : count_(rig.guide_count()), points_(rig.points) {
    rest_.reserve(rig.curves.size());
    for (const Eigen::Vector3f& p : rig.curves) rest_.push_back(p.cast<double>());
    lengths_.assign(rest_.size(), 0.0);
    bends_.resize(rest_.size());
    inverse_masses_.resize(rest_.size());
    for (Index r = 0; r < count_; ++r) {
        prepare_masses(r);
        root_frames_.push_back(rig.root_frames[at(r)].cast<double>().normalized());
        prepare_bends(r);
    }
    for (const TiedPoints& tied : rig.ties) {
        for (const Index p : tied.points) inverse_masses_[at(p)] = 0.0;
    }
}

// Half of the segments beside a point are its mass.
void Rods::prepare_masses(Index rod) {
    const std::size_t first = at(rod * points_), last = first + at(points_) - 1;
    for (std::size_t k = first; k < last; ++k) {
        lengths_[k] = std::max((rest_[k + 1] - rest_[k]).norm(), kLeastSegment);
    }
    for (std::size_t k = first; k <= last; ++k) {
        const double before = k > first ? lengths_[k - 1] : 0.0;
        inverse_masses_[k] = 2.0 / (before + lengths_[k]);
    }
    inverse_masses_[first] = inverse_masses_[first + 1] = 0.0;
}

void Rods::prepare_bends(Index rod) {
    const std::size_t first = at(rod * points_);
    Eigen::Quaterniond frame = root_frames_[at(rod)];
    Vec3 along = frame * Vec3::UnitZ();
    for (std::size_t k = first; k + 2 < first + at(points_); ++k) {
        const Vec3 next = direction_between(rest_[k + 1], rest_[k + 2], along);
        const Eigen::Quaterniond turned = (min_rotation(along, next) * frame).normalized();
        bends_[k].next = frame.conjugate() * next;
        bends_[k].turn = frame.conjugate() * turned;
        frame = turned;
        along = next;
    }
}

void Rods::hold(std::span<Vec3> places, const Affine& head, Index rod) const {
    for (std::size_t k = at(rod * points_); k < at((rod + 1) * points_); ++k) {
        if (inverse_masses_[k] == 0.0) places[k] = head(rest_[k]);
    }
}

void Rods::bend(std::span<Vec3> places, const RodStep& step, Index rod) const {
    const std::size_t first = at(rod * points_);
    Eigen::Quaterniond frame = Eigen::Quaterniond(step.head.linear) * root_frames_[at(rod)];
    for (std::size_t k = first; k + 2 < first + at(points_); ++k) {
        const Vec3 target = frame * bends_[k].next;
        bend_at(places, target, step, index_of(k));
        const Vec3 next = direction_between(places[k + 1], places[k + 2], target);
        frame = (min_rotation(target, next) * frame * bends_[k].turn).normalized();
    }
}

// The constraint is the difference of the direction behind the next point from the target, which
// turns with the segment before that point; its energy is that of an elastic rod.
void Rods::bend_at(std::span<Vec3> places, const Vec3& target, const RodStep& step,
                   Index point) const {
    const std::size_t k = at(point);
    if (inverse_masses_[k + 1] + inverse_masses_[k + 2] == 0.0) return;
    const Vec3 along = direction_between(places[k], places[k + 1], target);
    const Vec3 next = direction_between(places[k + 1], places[k + 2], target);
    const Mat3 before = carried(along, target) / lengths_[k];
    const Mat3 behind = (Mat3::Identity() - next * next.transpose()) / lengths_[k + 1];
    const std::array<Mat3, 3> slopes{before, -(before + behind), behind};
    const double rigidity = kEarth * std::pow(step.stiffness, 3);
    const double compliance = 0.5 * (lengths_[k] + lengths_[k + 1]) / rigidity;
    const double damped = kBendDamping / step.seconds;
    Mat3 system = compliance / (step.seconds * step.seconds) * Mat3::Identity();
    Vec3 off = target - next;
    for (std::size_t i = 0; i < 3; ++i) {
        const Mat3 answer = inverse_masses_[k + i] * slopes[i] * slopes[i].transpose();
        system += (1.0 + damped) * answer;
        off -= damped * slopes[i] * (places[k + i] - step.before[k + i]);
    }
    const Vec3 push = system.ldlt().solve(off);
    for (std::size_t i = 0; i < 3; ++i) {
        places[k + i] += inverse_masses_[k + i] * slopes[i].transpose() * push;
    }
}

void Rods::keep_lengths(std::span<Vec3> places, Index rod) const {
    for (int round = 0; round < kMaxLengthRounds; ++round) {
        if (correct_lengths(places, rod) < kLengthError) return;
    }
}

// One round. The corrections of all segments are a tridiagonal system, as a segment shares a point
// with the next one alone. Returns the greatest error before it, as a part of the length.
double Rods::correct_lengths(std::span<Vec3> places, Index rod) const {
    const std::size_t first = at(rod * points_), segments = at(points_) - 1;
    std::array<Vec3, kMaxRodPoints> along;
    std::array<double, kMaxRodPoints> upper, push;
    double error = 0.0;
    for (std::size_t j = 0; j < segments; ++j) {
        const std::size_t k = first + j;
        along[j] = direction_between(places[k], places[k + 1], Vec3::UnitZ());
        const bool is_free = inverse_masses_[k] + inverse_masses_[k + 1] > 0.0;
        push[j] = is_free ? lengths_[k] - (places[k + 1] - places[k]).norm() : 0.0;
        error = std::max(error, std::abs(push[j]) / lengths_[k]);
    }
    if (error < kLengthError) return error;
    for (std::size_t j = 0; j < segments; ++j) {
        const double before = inverse_masses_[first + j], after = inverse_masses_[first + j + 1];
        const double lower = j > 0 ? -before * along[j].dot(along[j - 1]) : 0.0;
        double diagonal = before + after > 0.0 ? before + after : 1.0;
        if (j > 0) {
            diagonal -= lower * upper[j - 1];
            push[j] -= lower * push[j - 1];
        }
        diagonal = std::max(diagonal, kLeastPivot * (before + after));
        upper[j] = j + 1 < segments ? -after * along[j].dot(along[j + 1]) / diagonal : 0.0;
        push[j] /= diagonal;
    }
    for (std::size_t j = segments - 1; j-- > 0;) push[j] -= upper[j] * push[j + 1];
    for (std::size_t j = 0; j < segments; ++j) {
        places[first + j] -= inverse_masses_[first + j] * push[j] * along[j];
        places[first + j + 1] += inverse_masses_[first + j + 1] * push[j] * along[j];
    }
    return error;
}

std::size_t Rods::memory_bytes() const {
    return rest_.size() * (sizeof(Vec3) + 2 * sizeof(double) + sizeof(Bend)) +
           root_frames_.size() * sizeof(Eigen::Quaterniond);
}

}  // namespace lissom
