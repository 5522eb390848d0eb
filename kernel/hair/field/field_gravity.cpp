#include "kernel/hair/field/field_gravity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

// Hair nearer to the head than the first length lies on it, beyond the second it hangs.
constexpr double kLies = 0.015, kHangs = 0.045;

// Of hair that lies on the head: parts of its direction to the back.
constexpr double kBackOverHead = 0.25, kBackOverFace = 0.35;

// Half of the width of the line over the face from which hair goes to the sides.
constexpr double kMiddle = 0.006;

// Least distance of fallen hair from curves, in steps of the grid.
constexpr double kHeldSteps = 1.5;

// The face ends below over this range of heights.
constexpr double kBelowFace = -0.2, kChin = -0.1;

// The face is where z is greater than this multiple of |x|, softened by kSoftFace.
constexpr double kFaceSlope = 0.6, kSoftFace = 0.03;

double smooth_step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Returns how much a point is over the face, or over the part of the head that hair would fall
// from into it.
double face_share(const Vec3& p) {
    const double across = std::sqrt(p.x() * p.x() + kMiddle * kMiddle);
    return smooth_step(-kSoftFace, kSoftFace, p.z() - kFaceSlope * across) *
           smooth_step(kBelowFace, kChin, p.y());
}

Vec3 unit_or(const Vec3& v, const Vec3& other) {
    const double length = v.norm();
    return length > 1e-6 ? Vec3(v / length) : other;
}

const Vec3& nearest_of(std::span<const Vec3> ties, const Vec3& point) {
    return *std::min_element(ties.begin(), ties.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - point).squaredNorm() < (b - point).squaredNorm();
    });
}

// Squared distances to the nearest point of a set on a grid, in steps, one line of points after the
// other (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, 2012).
class SquaredDistances {
  public:
    SquaredDistances(const GridLayout& layout, std::span<const Index> points,
                     const Context& context)
        : counts_(layout.counts), values_(layout.size(), kFar) {
        for (const Index point : points) values_[at(point)] = 0.0f;
        for (std::size_t axis = 0; axis < 3; ++axis) sweep(axis, context);
    }

    double operator[](std::size_t point) const { return values_[point]; }

  private:
    static constexpr float kFar = 1e12f;

    // Lower envelope of parabolas over one line.
    struct Envelope {
        explicit Envelope(Index count) : line(at(count)), apex(at(count)), from(at(count) + 1) {}

        void lower() {
            const Index count = index_of(line.size());
            Index last = 0;
            apex[0] = 0;
            from[0] = -std::numeric_limits<double>::infinity();
            for (Index i = 1; i < count; ++i) {
                while (last > 0 && crossing(apex[at(last)], i) <= from[at(last)]) --last;
                const double x = crossing(apex[at(last)], i);
                if (x <= from[at(last)]) {
                    apex[at(last)] = i;
                } else {
                    ++last;
                    apex[at(last)] = i;
                    from[at(last)] = x;
                }
            }
            from[at(last) + 1] = std::numeric_limits<double>::infinity();
        }

        double crossing(Index a, Index b) const {
            const double fa = line[at(a)] + static_cast<double>(a) * a;
            const double fb = line[at(b)] + static_cast<double>(b) * b;
            return (fb - fa) / (2.0 * (b - a));
        }

        std::vector<double> line;
        std::vector<Index> apex;
        std::vector<double> from;
    };

    void sweep(std::size_t axis, const Context& context) {
        const std::array<std::size_t, 3> strides{1, at(counts_[0]), at(counts_[0]) * counts_[1]};
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        context.parallel_for(0, counts_[u] * counts_[v], 64, [&](Index begin, Index end) {
            Envelope envelope(counts_[axis]);
            for (Index row = begin; row < end; ++row) {
                float* first = values_.data() + strides[u] * at(row % counts_[u]) +
                               strides[v] * at(row / counts_[u]);
                lower_line(first, strides[axis], envelope);
            }
        });
    }

    static void lower_line(float* first, std::size_t stride, Envelope& envelope) {
        const std::size_t count = envelope.line.size();
        for (std::size_t i = 0; i < count; ++i) envelope.line[i] = first[i * stride];
        envelope.lower();
        std::size_t part = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = static_cast<double>(i);
            while (envelope.from[part + 1] < x) ++part;
            const double from = static_cast<double>(envelope.apex[part]);
            first[i * stride] = static_cast<float>((x - from) * (x - from) +
                                                   envelope.line[at(envelope.apex[part])]);
        }
    }

    std::array<Index, 3> counts_;
    std::vector<float> values_;
};

}  // namespace

Vec3 fallen_direction(const Vec3& point, double distance, const Vec3& outward,
                      std::span<const Vec3> ties) {
    const double lies = 1.0 - smooth_step(kLies, kHangs, distance);
    const double face = face_share(point);
    const double side = point.x() / std::sqrt(point.x() * point.x() + kMiddle * kMiddle);
    const Vec3 hanging(0.0, -1.0, -kBackOverHead * lies);
    const Vec3 aside(side, 0.0, -kBackOverFace);
    Vec3 way = (1.0 - face) * hanging + face * aside;
    if (!ties.empty()) {
        const Vec3 to_tie = unit_or(nearest_of(ties, point) - point, -Vec3::UnitZ());
        way += lies * (to_tie - way);
    }
    const Vec3 normal = unit_or(outward, Vec3::Zero());
    const Vec3 along = way - std::min(lies * way.dot(normal), 0.0) * normal;
    return unit_or(along, -Vec3::UnitZ());
}

void add_gravity(std::span<float> values, std::span<const float> gradients,
                 const GridLayout& layout, const FieldGravity& gravity, const Context& context) {
    if (gravity.amount == 0.0) return;
    const SquaredDistances squared(layout, gravity.styled, context);
    const double held = std::max(gravity.held, kHeldSteps * layout.step);
    context.parallel_for(0, layout.size(), 1024, [&](Index begin, Index end) {
        for (std::size_t i = at(begin); i < at(end); ++i) {
            const double away = layout.step * std::sqrt(squared[i]);
            const double share = gravity.amount * smooth_step(held, held + gravity.fade, away);
            if (share == 0.0) continue;
            const Vec3 outward(gradients[4 * i], gradients[4 * i + 1], gradients[4 * i + 2]);
            const Vec3 fallen = fallen_direction(layout.point(index_of(i)), values[4 * i + 3],
                                                 outward, gravity.ties);
            for (std::size_t k = 0; k < 3; ++k) {
                float& v = values[4 * i + k];
                v += static_cast<float>(share * (fallen[static_cast<Eigen::Index>(k)] - v));
            }
        }
    });
}

}  // namespace lissom
