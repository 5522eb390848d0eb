#include "kernel/hair/curve/dividing_curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/hair/curve/constraint_kind.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"
#include "kernel/hair/curve/grid_range.h"

namespace lissom {
namespace {

// Nearer to the curve's plane than this, in steps, a point belongs to no side.
constexpr double kOnPlane = 1e-3;
// Points as far from the curve as the reach, as on a parting in the middle of a grid, are beyond it
// on both sides for any rounding.
constexpr double kTie = 1e-9;
// Beyond the curve's ends points still take constraints up to this, in steps.
constexpr double kBeyond = 0.5;
// Sine of the least angle between the curve and the scalp's normal.
constexpr double kMinSine = 1e-3;

double default_ramp(const DividingOptions& options) {
    return options.fidelity == HairFidelity::thesis ? 0.0 : 0.87;
}

// The options with all lengths known.
struct Rule {
    double step, sigma, height, reach, thickness, wall_width, wall_height, ramp;

    Rule(const DividingOptions& o, double d)
        : step(d),
          sigma(o.sigma.value_or(1.0 * d)),
          height(o.height.value_or(0.5 * d)),
          reach(o.reach.value_or(2.5 * sigma)),
          thickness(o.thickness.value_or(0.8 * d)),
          wall_width(o.wall_width.value_or(1.2 * d)),
          wall_height(o.wall_height.value_or(2.6 * d)),
          ramp(o.ramp.value_or(default_ramp(o) * d)) {}

    double bell(double u) const { return std::exp(-0.5 * std::pow((u - sigma) / sigma, 2)); }
    double gaussian(double u) const { return height * (bell(u) - std::exp(-0.5)); }
    double slope(double u) const { return -height * (u - sigma) / (sigma * sigma) * bell(u); }

    double width() const { return std::max(reach, wall_width); }
    /// Signed distances to the head that points with constraints have.
    double lowest() const { return std::min(-height * std::exp(-0.5) - thickness, 0.0); }
    double highest() const { return gaussian(sigma) + std::max(thickness, wall_height); }
};

void require_dividing(const DividingOptions& o, const Rule& rule) {
    for (const auto& tilt : {o.left, o.right}) {
        for (const double angle : {tilt.start, tilt.end}) {
            require(std::abs(angle) <= 0.5 * kPi + 1e-9,
                    "the tilt of a dividing curve must be from -90 to 90 degrees");
        }
    }
    require(rule.sigma > 0.0 && std::isfinite(rule.sigma),
            "sigma of a dividing curve must be above 0");
    for (const double length :
         {rule.height, rule.reach, rule.thickness, rule.wall_width, rule.wall_height, rule.ramp}) {
        require(length >= 0.0 && std::isfinite(length),
                "height, reach, thickness and the wall of a dividing curve must be 0 or more");
    }
    require(o.separation >= 0.0 && o.separation <= 1.0,
            "separation of a dividing curve must be from 0 to 1");
    require_curve_weight(o.weight);
}

using Cell = std::array<Index, 3>;

// Outward normal of the surface of equal distance at a grid point, or zero.
Vec3 surface_normal(const DistanceGrid& distances, const Cell& at) {
    Vec3 gradient = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        Cell low = at, high = at;
        low[axis] = std::max(at[axis] - 1, 0);
        high[axis] = std::min(at[axis] + 1, distances.layout().counts[axis] - 1);
        const double change =
            distances.at(high[0], high[1], high[2]) - distances.at(low[0], low[1], low[2]);
        gradient[axis] = change / (high[axis] - low[axis]);
    }
    const double length = gradient.norm();
    return length > 0.0 ? Vec3(gradient / length) : gradient;
}

// Vectors at grid points around one dividing curve.
class Divider {
  public:
    Divider(const DistanceGrid& distances, const DividingLine& line, const DividingOptions& options,
            const Rule& rule)
        : distances_(distances), line_(line), options_(options), rule_(rule) {}

    struct Said {
        Vec3 vector;
        ConstraintKind kind;
    };

    /// Returns the claim on a grid point, if any.
    std::optional<Said> at(const Cell& cell) const {
        const double v = distances_.at(cell[0], cell[1], cell[2]);
        if (v < rule_.lowest() || v > rule_.highest()) return std::nullopt;
        const DividingPlace place =
            line_.place(distances_.layout().point(cell[0], cell[1], cell[2]));
        const double u = std::abs(place.across);
        if (u < kOnPlane * rule_.step || std::abs(place.beyond) > kBeyond * rule_.step) return {};
        // The other side of the head, or a curve that is not on it.
        if (std::abs(place.height - v) > u + rule_.step) return std::nullopt;
        const double g = rule_.gaussian(u);
        const bool along = u < (1.0 - kTie) * rule_.reach && std::abs(v - g) < rule_.thickness;
        const bool above = u < rule_.wall_width && v > 0.0 && v < g + rule_.wall_height;
        if (!along && !(above && options_.separation > 0.0)) return std::nullopt;

        Vec3 normal = surface_normal(distances_, cell);
        if (normal.dot(place.normal) < 0.5) normal = place.normal;
        const double tilt = tilt_at(place);
        const Vec3 level = flow(place, tilt, normal);
        if (!along) {
            return Said{fade(options_.separation * level, place), ConstraintKind::separation};
        }
        const Vec3 up = rule_.slope(u) * std::cos(tilt) * normal;
        return Said{fade((level + up).normalized(), place), ConstraintKind::parting};
    }

  private:
    double tilt_at(const DividingPlace& place) const {
        const auto& tilt = place.across > 0.0 ? options_.right : options_.left;
        return tilt.start + place.along * (tilt.end - tilt.start);
    }

    /// Away from the curve, turned by the tilt, in the plane that `normal` is normal to.
    static Vec3 flow(const DividingPlace& place, double tilt, const Vec3& normal) {
        const Vec3 away = place.across > 0.0 ? place.right : Vec3(-place.right);
        const Vec3 turned = std::cos(tilt) * away + std::sin(tilt) * place.tangent;
        const Vec3 level = turned - normal.dot(turned) * normal;
        return level.normalized();
    }

    /// With the part across the curve growing evenly from the curve to the end of the ramp.
    Vec3 fade(const Vec3& vector, const DividingPlace& place) const {
        const double u = std::abs(place.across);
        if (!(u < rule_.ramp)) return vector;
        return vector - (1.0 - u / rule_.ramp) * vector.dot(place.right) * place.right;
    }

    const DistanceGrid& distances_;
    const DividingLine& line_;
    const DividingOptions& options_;
    const Rule& rule_;
};

// The local frames of Figure 4.4 along a curve, for one side of it: x points away from the curve, y
// is the scalp's normal, and z the tangent turned by the tilt.
class LocalFrames {
  public:
    struct Frame {
        Vec3 origin, x, y, z;
    };
    // Position of a point in the xy-plane through it.
    struct Place {
        double u = 0.0, v = 0.0, distance = 0.0;
        Vec3 x = Vec3::Zero(), y = Vec3::Zero();
    };

    // `side`: 1 for the right one, -1 for the left one.
    LocalFrames(const DividingLine& line, std::span<const Vec3> points,
                const DividingOptions& options, double side) {
        const auto& tilt = side > 0.0 ? options.right : options.left;
        for (const Vec3& p : points) {
            const DividingPlace on = line.place(p);
            const double angle = tilt.start + on.along * (tilt.end - tilt.start);
            const Vec3 away = side * on.right;
            frames_.push_back({p, std::cos(angle) * away + std::sin(angle) * on.tangent, on.normal,
                               std::cos(angle) * on.tangent - std::sin(angle) * away});
        }
    }

    // In the plane whose origin is nearest; none on the other side, or more than `beyond` before
    // the first plane or behind the last one.
    std::optional<Place> place(const Vec3& point, double beyond) const {
        std::optional<Place> best;
        const auto consider = [&](const Frame& frame) {
            const Vec3 from = point - frame.origin;
            const Place here{from.dot(frame.x), from.dot(frame.y), from.norm(), frame.x, frame.y};
            if (here.u > 0.0 && (!best || here.distance < best->distance)) best = here;
        };
        for (std::size_t i = 0; i + 1 < frames_.size(); ++i) {
            const double from = ahead(point, i), to = ahead(point, i + 1);
            if (from >= 0.0 && to <= 0.0 && from > to) consider(between(i, from / (from - to)));
        }
        if (const double d = ahead(point, 0); d < 0.0 && d >= -beyond) consider(frames_.front());
        if (const double d = ahead(point, frames_.size() - 1); d > 0.0 && d <= beyond) {
            consider(frames_.back());
        }
        return best;
    }

  private:
    double ahead(const Vec3& point, std::size_t i) const {
        return (point - frames_[i].origin).dot(frames_[i].z);
    }

    Frame between(std::size_t i, double t) const {
        const Frame &a = frames_[i], &b = frames_[i + 1];
        const Vec3 z = ((1.0 - t) * a.z + t * b.z).normalized();
        const Vec3 y = (1.0 - t) * a.y + t * b.y, up = (y - y.dot(z) * z).normalized();
        const Vec3 x = (1.0 - t) * a.x + t * b.x;
        const Vec3 across = (x - x.dot(z) * z - x.dot(up) * up).normalized();
        return {(1.0 - t) * a.origin + t * b.origin, across, up, z};
    }

    std::vector<Frame> frames_;
};

// Vectors at grid points around one dividing curve, in the local planes alone (section 4.5).
class PlaneDivider {
  public:
    PlaneDivider(const GridLayout& layout, const DividingLine& line, std::span<const Vec3> points,
                 const DividingOptions& options, const Rule& rule)
        : layout_(layout),
          right_(line, points, options, 1.0),
          left_(line, points, options, -1.0),
          separation_(options.separation),
          rule_(rule) {}

    std::optional<Divider::Said> at(const Cell& cell) const {
        const std::optional<LocalFrames::Place> found =
            place(layout_.point(cell[0], cell[1], cell[2]));
        if (!found || found->u < kOnPlane * rule_.step) return std::nullopt;
        const double u = found->u, v = found->v, g = rule_.gaussian(u);
        if (u < (1.0 - kTie) * rule_.reach && std::abs(v - g) < rule_.thickness) {
            const Vec3 along = (found->x + rule_.slope(u) * found->y).normalized();
            return Divider::Said{faded(along, *found), ConstraintKind::parting};
        }
        const bool above = u < rule_.wall_width && v > 0.0 && v < g + rule_.wall_height;
        if (!above || !(separation_ > 0.0)) return std::nullopt;
        return Divider::Said{faded(separation_ * found->x, *found), ConstraintKind::separation};
    }

  private:
    std::optional<LocalFrames::Place> place(const Vec3& point) const {
        const auto a = right_.place(point, kBeyond * rule_.step),
                   b = left_.place(point, kBeyond * rule_.step);
        if (!a || !b) return a ? a : b;
        return a->distance <= b->distance ? a : b;
    }

    Vec3 faded(const Vec3& vector, const LocalFrames::Place& place) const {
        if (!(place.u < rule_.ramp)) return vector;
        return vector - (1.0 - place.u / rule_.ramp) * vector.dot(place.x) * place.x;
    }

    const GridLayout& layout_;
    LocalFrames right_, left_;
    double separation_;
    const Rule& rule_;
};

}  // namespace

DividingOptions with_lengths(DividingOptions options, double step) {
    const Rule rule(options, step);
    options.sigma = rule.sigma;
    options.height = rule.height;
    options.reach = rule.reach;
    options.thickness = rule.thickness;
    options.wall_width = rule.wall_width;
    options.wall_height = rule.wall_height;
    options.ramp = rule.ramp;
    return options;
}

DividingLine::DividingLine(std::span<const Vec3> points, std::span<const Vec3> normals) {
    require_curve(points);
    require(points.size() == normals.size(), "a dividing curve needs one normal for each point");
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0 && points[i] == points[i - 1]) continue;
        if (!normals[i].allFinite()) {
            throw Error(ErrorCode::not_finite,
                        "normal " + std::to_string(i) + " of the dividing curve is not finite");
        }
        points_.push_back(points[i]);
        normals_.push_back(normals[i]);
    }
    tangents_ = curve_tangents(points_);
    lengths_ = arc_lengths(points_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        Vec3& normal = normals_[i];
        const double length = normal.norm();
        normal -= normal.dot(tangents_[i]) * tangents_[i];
        if (i > 0) longest_segment_ = std::max(longest_segment_, lengths_[i] - lengths_[i - 1]);
        require(normal.norm() > kMinSine * length,
                "a dividing curve runs along the scalp's normal; draw it on the scalp");
        normal.normalize();
    }
}

DividingPlace DividingLine::place(const Vec3& point) const {
    const CurveFoot foot = foot_on_curve(points_, point);
    const auto between = [&](const std::vector<Vec3>& values) -> Vec3 {
        return (1.0 - foot.t) * values[foot.segment] + foot.t * values[foot.segment + 1];
    };
    DividingPlace place;
    place.tangent = between(tangents_).normalized();
    const Vec3 normal = between(normals_);
    place.normal = (normal - normal.dot(place.tangent) * place.tangent).normalized();
    place.right = place.tangent.cross(place.normal);
    const Vec3 from = point - foot.point;
    place.across = from.dot(place.right);
    place.height = from.dot(place.normal);
    place.beyond = foot.beyond;
    place.along = arc_length_at(lengths_, foot) / lengths_.back();
    return place;
}

double DividingLine::skin_distance(const Vec3& point) const {
    const DividingPlace at = place(point);
    // The skin may arch as high over a segment.
    const double off = std::max(0.0, std::abs(at.height) - 0.5 * longest_segment_);
    return std::hypot(at.across, at.beyond, off);
}

std::vector<GridConstraint> dividing_constraints(const DistanceGrid& distances,
                                                 std::span<const Vec3> points,
                                                 std::span<const Vec3> normals,
                                                 const DividingOptions& options) {
    const DividingLine line(points, normals);
    const GridLayout& layout = distances.layout();
    const Rule rule(options, layout.step);
    require_dividing(options, rule);
    const Divider divider(distances, line, options, rule);
    const PlaneDivider planes(layout, line, points, options, rule);
    const bool literal = options.fidelity == HairFidelity::thesis;

    Box box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 margin = Vec3::Constant(rule.width() + rule.highest() - rule.lowest());
    std::vector<GridConstraint> result;
    for_grid_points_in(layout, {box.min - margin, box.max + margin}, [&](const Cell& cell) {
        const auto said = literal ? planes.at(cell) : divider.at(cell);
        if (!said) return;
        result.push_back({layout.index(cell[0], cell[1], cell[2]), said->vector, options.weight,
                          static_cast<int>(said->kind)});
    });
    if (result.empty()) {
        throw Error(ErrorCode::out_of_range,
                    "no point of the grid is near the dividing curve and the head; draw the curve "
                    "on the scalp and longer than a step of the grid, or enlarge the volume");
    }
    return result;
}

}  // namespace lissom
