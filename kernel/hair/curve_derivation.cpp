#include "kernel/hair/curve_derivation.h"

#include <cmath>
#include <string>
#include <utility>

#include "kernel/hair/curve/curve.h"

namespace lissom {
namespace {

// A dividing curve may be drawn this far from the head.
constexpr double kFarthestParting = 0.05;

// Fraction of a tail's radius, from its spine, that hair fills.
constexpr double kFilled = 0.9;

void require_length(double length, const char* message) {
    if (length >= 0.0 && std::isfinite(length)) return;
    throw Error(ErrorCode::invalid_argument, message);
}

// Returns the tilts of the hints, else of the options.
TiltFit acting_tilt(const DividingLine& line, const DividingCurve& dividing) {
    TiltFit fit = fit_tilt(line, dividing.hints);
    if (fit.left.pieces == 0) fit.left.tilt = dividing.options.left;
    if (fit.right.pieces == 0) fit.right.tilt = dividing.options.right;
    return fit;
}

class Derivation {
  public:
    Derivation(const Scalp& scalp, const DistanceGrid& distances)
        : scalp_(scalp), distances_(distances), step_(distances.layout().step) {}

    DerivedCurve operator()(const StreamCurve& stream) const {
        require_length(stream.clearance, "the clearance of a stream curve must be 0 or more");
        DerivedCurve result;
        std::vector<Vec3> fine = smooth_curve(stream.points, 0.5 * step_);
        push_out(fine, distances_, stream.clearance);
        result.course = resampled_curve(fine, step_);
        result.constraints = stream_constraints(distances_.layout(), result.course, stream.options);
        return result;
    }

    DerivedCurve operator()(const DividingCurve& dividing) const {
        require_length(dividing.gap, "the gap of a dividing curve must be 0 or more");
        DerivedCurve result;
        std::vector<Vec3> fine = smooth_curve(dividing.points, 0.5 * step_);
        for (Vec3& p : fine) p = on_head(p).position;
        std::vector<Vec3> normals;
        for (const Vec3& p : resampled_curve(fine, step_)) {
            const OnHead found = on_head(p);
            result.course.push_back(found.position);
            normals.push_back(found.normal);
        }
        result.line.emplace(result.course, normals);
        result.tilt = acting_tilt(*result.line, dividing);
        DividingOptions options = dividing.options;
        options.left = result.tilt->left.tilt;
        options.right = result.tilt->right.tilt;
        result.constraints = dividing_constraints(distances_, result.course, normals, options);
        result.gap = dividing.gap;
        return result;
    }

    DerivedCurve operator()(const Ponytail& ponytail) const {
        require(ponytail.ragged >= 0.0 && ponytail.ragged <= 1.0,
                "ragged of a ponytail must be from 0 to 1");
        require_length(ponytail.tail_length.value_or(0.0),
                       "the tail length of a ponytail must be 0 or more");
        DerivedCurve result;
        const PonytailShape shape =
            ponytail_shape(smooth_curve(ponytail.spine, 0.5 * step_), step_, ponytail.options);
        result.course = shape.spine;
        result.constraints = ponytail_constraints(distances_, shape, ponytail.options);
        const PonytailSection& first = shape.tie();
        std::optional<double> length = ponytail.tail_length;
        if (!length && ponytail.options.fidelity == HairFidelity::lissom) {
            length = curve_length(std::span(shape.spine).subspan(shape.first));
        }
        require(length || ponytail.ragged == 0.0,
                "ragged of a ponytail needs its tail_length: give one, or leave ragged out");
        const auto from = shape.spine.begin() + shape.first;
        result.tie = HairTie{first.center, first.direction, first.radius,
                             length,       ponytail.ragged, {from, shape.spine.end()}};
        if (ponytail.options.spread > 0.0) result.tie->radii = filled_radii(shape);
        return result;
    }

  private:
    // Radii that hair fills, at the points of a tail's spine from the tie on.
    static std::vector<double> filled_radii(const PonytailShape& shape) {
        std::vector<double> radii;
        for (const PonytailSection& s : shape.sections) radii.push_back(kFilled * s.radius);
        radii.resize(shape.spine.size() - shape.first, radii.back());
        return radii;
    }

    struct OnHead {
        Vec3 position, normal;
    };

    OnHead on_head(const Vec3& point) const {
        const SurfacePoint found = scalp_.tree().nearest(scalp_.from_metres(point));
        const Vec3 on = scalp_.to_metres(found.position);
        const double away = (on - point).norm();
        if (away > kFarthestParting) {
            throw Error(ErrorCode::out_of_range, "the dividing curve is " + std::to_string(away) +
                                                     " m from the head; draw it on the scalp");
        }
        const Vec3 normal = scalp_.normal_at(found.triangle, found.barycentric);
        return {on, scalp_.frame().axes.transpose() * normal};
    }

    const Scalp& scalp_;
    const DistanceGrid& distances_;
    double step_;
};

}  // namespace

DerivedCurve derive(const StyleCurve& curve, const Scalp& scalp, const DistanceGrid& distances) {
    return std::visit(Derivation(scalp, distances), curve.shape);
}

}  // namespace lissom
