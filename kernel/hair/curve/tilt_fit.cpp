#include "kernel/hair/curve/tilt_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/error.h"
#include "kernel/core/roots.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/length_text.h"

namespace lissom {
namespace {

// Length of the pieces that hints are read in, in metres: longer than the jitter of a hand.
constexpr double kPiece = 0.003;
// Nearer to the curve than this, in metres, a piece belongs to no side.
constexpr double kNoSide = 0.001;
// Share of the weight of all pieces that holds both ends of a side to one tilt.
constexpr double kEvenness = 0.01;
// A hint that runs towards the curve by more than this angle was drawn from its other end.
constexpr double kTowards = 10.0 * kDegree;

// A straight piece of a hint as seen from the curve.
struct HintPiece {
    double along = 0.0, angle = 0.0, weight = 0.0;
};

// Why a piece of a hint does not count.
enum class HintMiss { none, far, beyond, on_curve };

HintMiss miss_of(const DividingPlace& place) {
    if (std::max(std::abs(place.across), std::abs(place.height)) > kHintReach) return HintMiss::far;
    if (place.beyond != 0.0) return HintMiss::beyond;
    return std::abs(place.across) < kNoSide ? HintMiss::on_curve : HintMiss::none;
}

// Calls visit(place, way) for each piece of a hint, with its middle and its direction and length.
template <typename Visit>
void for_each_piece(const DividingLine& line, const std::vector<Vec3>& hint, const Visit& visit) {
    const std::vector<Vec3> points = resampled_curve(hint, kPiece);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        visit(line.place(0.5 * (points[i] + points[i + 1])), Vec3(points[i + 1] - points[i]));
    }
}

// The angle nearest to `other` that differs from `angle` by whole turns.
double turned_near(double angle, double other) {
    return other + std::remainder(angle - other, 2.0 * kPi);
}

// The pieces of one hint on one side; `sign` is 1 on the right and -1 on the left.
std::vector<HintPiece> pieces_beside(const DividingLine& line, const std::vector<Vec3>& hint,
                                     double sign) {
    std::vector<HintPiece> pieces;
    Vec2 general = Vec2::Zero();
    for_each_piece(line, hint, [&](const DividingPlace& place, const Vec3& way) {
        if (miss_of(place) != HintMiss::none || sign * place.across < 0.0) return;
        const Vec2 level(sign * way.dot(place.right), way.dot(place.tangent));
        if (level.norm() == 0.0) return;
        general += level;
        pieces.push_back({place.along, std::atan2(level.y(), level.x()), level.norm()});
    });
    const bool towards = general.x() < -std::sin(kTowards) * general.norm();
    const double mean = std::atan2(general.y(), general.x()) - (towards ? kPi : 0.0);
    for (HintPiece& piece : pieces) {
        piece.angle =
            turned_near(piece.angle - (towards ? kPi : 0.0), std::remainder(mean, 2.0 * kPi));
    }
    return pieces;
}

// Sums of the normal equations: of the weights by products of (1 - s) and s, and of the angles.
struct TiltSums {
    double weight = 0.0;
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
    Vec2 right = Vec2::Zero();

    explicit TiltSums(std::span<const HintPiece> pieces) {
        for (const HintPiece& piece : pieces) {
            const Vec2 shares(1.0 - piece.along, piece.along);
            weight += piece.weight;
            matrix += piece.weight * shares * shares.transpose();
            right += piece.weight * piece.angle * shares;
        }
    }
    DividingOptions::Tilt solved() const {
        Eigen::Matrix2d even;
        even << 1.0, -1.0, -1.0, 1.0;
        const Vec2 tilt = (matrix + kEvenness * weight * even).ldlt().solve(right);
        return {std::clamp(tilt[0], -0.5 * kPi, 0.5 * kPi),
                std::clamp(tilt[1], -0.5 * kPi, 0.5 * kPi)};
    }
};

SideTilt side_tilt(const DividingLine& line, std::span<const std::vector<Vec3>> hints,
                   double sign) {
    std::vector<HintPiece> pieces;
    for (const std::vector<Vec3>& hint : hints) {
        const std::vector<HintPiece> own = pieces_beside(line, hint, sign);
        pieces.insert(pieces.end(), own.begin(), own.end());
    }
    SideTilt side;
    side.pieces = count_of(pieces);
    if (pieces.empty()) return side;
    const TiltSums sums(pieces);
    side.tilt = sums.solved();
    double squares = 0.0;
    for (const HintPiece& p : pieces) {
        const double tilt = side.tilt.start + p.along * (side.tilt.end - side.tilt.start);
        squares += p.weight * std::pow(p.angle - tilt, 2);
    }
    side.error = std::sqrt(squares / sums.weight);
    return side;
}

}  // namespace

TiltFit fit_tilt(const DividingLine& line, std::span<const std::vector<Vec3>> hints) {
    return {side_tilt(line, hints, -1.0), side_tilt(line, hints, 1.0)};
}

void require_hint(const DividingLine& line, const std::vector<Vec3>& hint) {
    HintMiss why = HintMiss::far;
    double nearest = std::numeric_limits<double>::infinity();
    for_each_piece(line, hint, [&](const DividingPlace& place, const Vec3&) {
        const HintMiss miss = miss_of(place);
        if (miss != HintMiss::far) why = why == HintMiss::none ? why : miss;
        nearest = std::min(nearest, hypotenuse(place.across, place.height));
    });
    if (why == HintMiss::none) return;
    std::string text = "the hint is nowhere beside the dividing curve: ";
    if (why == HintMiss::far) {
        text += "it comes no nearer than " + length_text(nearest) + " m; draw it within " +
                length_text(kHintReach) + " m of the curve";
    } else if (why == HintMiss::beyond) {
        text += "it lies beyond the curve's ends; draw it beside the curve, or lengthen the curve";
    } else {
        text += "it runs along it; draw it away from the curve, as hair shall flow";
    }
    throw Error(ErrorCode::out_of_range, text);
}

}  // namespace lissom
