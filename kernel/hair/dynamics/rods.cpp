#include "kernel/hair/dynamics/rods.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/rotation.h"
#include "kernel/hair/dynamics/rod_system.h"

namespace lissom {
namespace {

// Segments are not shorter than this, in metres, for those that have no length at rest.
constexpr double kLeastSegment = 1e-6;
// Of points that do not move.
constexpr double kHeldMass = 1.0;
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

// An implicit step: the moves d of the points for which M d + h^2 (forces of bends behind d) = 0,
// by one step of Newton's method from the places that points would have without bends. A system of
// all points at once, as a rod is far stiffer from end to end than from point to point.
void Rods::bend(std::span<Vec3> places, const RodStep& step, Index rod) const {
    const std::size_t first = at(rod * points_);
    RodSystem system(at(points_));
    for (std::size_t k = 0; k < at(points_); ++k) {
        const double mobility = inverse_masses_[first + k];
        system.add(k, k, (mobility > 0.0 ? 1.0 / mobility : kHeldMass) * Mat3::Identity());
    }
    Eigen::Quaterniond frame = Eigen::Quaterniond(step.head.linear) * root_frames_[at(rod)];
    for (std::size_t k = first; k + 2 < first + at(points_); ++k) {
        const Vec3 target = frame * bends_[k].next;
        const Vec3 next = direction_between(places[k + 1], places[k + 2], target);
        add_bend(places, {target, next}, step, {k, first}, system);
        frame = (min_rotation(target, next) * frame * bends_[k].turn).normalized();
    }
    system.solve();
    for (std::size_t k = 0; k < at(points_); ++k) {
        if (inverse_masses_[first + k] > 0.0) places[first + k] += system.result(k);
    }
}

// The constraint is the difference of the direction behind the next point from the target, which
// turns with the segment before that point; its energy is that of an elastic rod, and its change is
// damped.
void Rods::add_bend(std::span<const Vec3> places, const Directions& now, const RodStep& step,
                    const Place& here, RodSystem& system) const {
    const std::size_t k = here.point;
    const Vec3 along = direction_between(places[k], places[k + 1], now.target);
    const Mat3 before = carried(along, now.target) / lengths_[k];
    const Mat3 behind = (Mat3::Identity() - now.next * now.next.transpose()) / lengths_[k + 1];
    const std::array<Mat3, 3> slopes{before, -(before + behind), behind};
    const double rigidity = kEarth * std::pow(step.stiffness, 3);
    const double stiff =
        rigidity / (0.5 * (lengths_[k] + lengths_[k + 1])) * step.seconds * step.seconds;
    const double damped = kBendDamping / step.seconds;
    Vec3 off = now.target - now.next;
    for (std::size_t i = 0; i < 3; ++i) {
        off -= damped * (slopes[i] * (places[k + i] - step.before[k + i]));
    }
    const std::size_t row = k - here.first;
    for (std::size_t i = 0; i < 3; ++i) {
        if (inverse_masses_[k + i] == 0.0) continue;
        system.push(row + i, stiff * (slopes[i].transpose() * off));
        for (std::size_t j = 0; j <= i; ++j) {
            if (inverse_masses_[k + j] == 0.0) continue;
            system.add(row + i, row + j,
                       stiff * (1.0 + damped) * (slopes[i].transpose() * slopes[j]));
        }
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
