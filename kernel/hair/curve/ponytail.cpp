#include "kernel/hair/curve/ponytail.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/curve/constraint_kind.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"
#include "kernel/hair/curve/grid_range.h"
#include "kernel/hair/curve/length_text.h"
#include "kernel/hair/curve/stream_curve.h"

namespace lissom {
namespace {

// Hair is led into the tie from this many steps in front of it, within this fraction of its radius.
constexpr double kLeading = 1.0, kLeadingCore = 0.7;
constexpr double kDefaultRadius = 1.5;     // in steps
constexpr double kDefaultRing = 2.5;       // in steps
constexpr double kDefaultClearance = 1.5;  // in steps
constexpr double kDefaultLead = 1.5;       // in steps
constexpr double kBehindTie = 0.5;         // the ring continues behind C1, in steps
constexpr double kThesisLead = 0.5;        // in steps: points nearest to the plane of C1
constexpr double kSectionMargin = 0.6;     // beyond the radius of a cross section, in steps
constexpr double kSpreading = 0.5;         // of the length from C1 to C2
constexpr double kShortest = 1e-6;         // parts of a spine shorter than this many steps are none
// The shape of a tail without profiles: it has swollen at this share of its length, and narrows
// from that one on to this share of its radius.
constexpr double kSwollen = 0.45, kNarrowing = 0.55, kNarrowed = 0.45;

// A drawn section encloses nothing if its area is this share of its length squared.
constexpr double kNoArea = 1e-9;
// Sines of the angle between the spine and the view that a section was drawn in, up to which it is
// drawn as it is, and from which it is an ellipse that is right across the spine alone: 10 and 25
// degrees.
constexpr double kSeenAlong = 0.17, kSeenAside = 0.42;
// Ends of a section that are farther apart than this share of its width do not go round the spine:
// 0.59 if a fifth is missing, 1 for half a ring.
constexpr double kOpen = 0.75;
// A profile crosses the spine if it has more than this share of its area on the other side.
constexpr double kCrossing = 0.05;
// Profiles lie on one side if the mean cosine between them is above this one.
constexpr double kSameSide = 0.5;

void require_ponytail(const PonytailOptions& o) {
    require(!o.radius || (*o.radius > 0.0 && std::isfinite(*o.radius)),
            "the radius of a ponytail must be above 0");
    require(o.share >= 0.0 && o.share <= 1.0, "share of a ponytail must be from 0 to 1");
    require(o.fullness > -1.0 && std::isfinite(o.fullness),
            "fullness of a ponytail must be above -1");
    require(o.inner >= 0.0 && o.inner <= o.outer && std::isfinite(o.outer),
            "inner and outer of a ponytail must be 0 or more, and inner no more than outer");
    require(o.tightness >= 0.0 && o.tightness <= 1.0,
            "tightness of a ponytail must be from 0 to 1");
    require(is_length(o.ring.value_or(0.0)) && is_length(o.lead.value_or(0.0)) &&
                is_length(o.clearance.value_or(0.0)) && is_length(o.stop_length),
            "ring, lead, clearance and stop_length of a ponytail must be lengths of 0 or more");
    require(std::isfinite(o.spread), "spread of a ponytail must be finite");
    require(is_length(o.grip), "grip of a ponytail must be 0 or more");
    require_curve_weight(o.weight);
}

double smooth_ramp(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// A spine and places on it by arc length.
struct Spine {
    std::vector<Vec3> points;
    std::vector<double> lengths;

    explicit Spine(std::span<const Vec3> given) {
        require_curve(given);
        points = without_repeated_points(given);
        lengths = arc_lengths(points);
    }
    double length() const { return lengths.back(); }
    double place_of(const CurveFoot& foot) const { return arc_length_at(lengths, foot); }

    // From one arc length to another, in segments of about a step.
    std::vector<Vec3> part(double from, double to, double step) const {
        std::vector<Vec3> result{point_at_arc_length(points, lengths, from)};
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (lengths[i] > from && lengths[i] < to) result.push_back(points[i]);
        }
        result.push_back(point_at_arc_length(points, lengths, to));
        return resampled_curve(result, step);
    }
};

// The closed polyline that was drawn around a spine.
struct DrawnSection {
    Vec3 center = Vec3::Zero();
    /// Mean distance from the center: the radius of a circle that is drawn around the spine, in its
    /// cross section.
    double mean_distance = 0.0;
    /// Unit normal of the plane that it lies in, about; zero if it encloses nothing.
    Vec3 normal = Vec3::Zero();
};

DrawnSection drawn_section(const std::vector<Vec3>& polyline) {
    require_curve(polyline);
    std::vector<Vec3> middles;
    std::vector<double> weights;
    double length = 0.0;
    DrawnSection result;
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < polyline.size(); ++i) {
        const Vec3 &a = polyline[i], &b = polyline[(i + 1) % polyline.size()];
        middles.push_back(0.5 * (a + b));
        weights.push_back((b - a).norm());
        length += weights.back();
        result.center += weights.back() * middles.back();
        area += (a - polyline[0]).cross(b - polyline[0]);
    }
    result.center /= length;
    for (std::size_t i = 0; i < middles.size(); ++i) {
        result.mean_distance += weights[i] / length * (middles[i] - result.center).norm();
    }
    if (area.norm() > kNoArea * length * length) result.normal = area.normalized();
    return result;
}

// Half of how far a polyline reaches along a unit vector.
double half_extent(const std::vector<Vec3>& polyline, const Vec3& along) {
    double least = along.dot(polyline[0]), most = least;
    for (const Vec3& p : polyline) {
        least = std::min(least, along.dot(p));
        most = std::max(most, along.dot(p));
    }
    return 0.5 * (most - least);
}

// The radius that a drawn section means. A ring that is seen from aside is drawn as an ellipse,
// which is as wide as the ring across the spine alone.
double section_radius(const std::vector<Vec3>& polyline, const DrawnSection& section,
                      const Vec3& spine_direction) {
    const Vec3 across = section.normal.cross(spine_direction);
    const double aside = smooth_ramp(kSeenAlong, kSeenAside, across.norm());
    if (!(aside > 0.0)) return section.mean_distance;
    const double extent = half_extent(polyline, across.normalized());
    return section.mean_distance + aside * (extent - section.mean_distance);
}

// Half of a ring would be closed by a chord through the spine.
void require_closed(const std::vector<Vec3>& polyline, double radius) {
    const double apart = (polyline.back() - polyline.front()).norm();
    require(apart <= kOpen * 2.0 * radius,
            "the section of the ponytail is open: its ends are " + length_text(apart) +
                " m apart, and it is " + length_text(2.0 * radius) +
                " m wide; draw it all the way round the spine, or give the radius alone");
}

// A profile: offsets from a spine over the arc length along it.
class Profile {
  public:
    Profile(const Spine& spine, const std::vector<Vec3>& drawn, double step) {
        require_curve(drawn);
        for (const Vec3& p : resampled_curve(drawn, 0.5 * step)) {
            const CurveFoot foot = foot_on_curve(spine.points, p);
            if (foot.beyond != 0.0) continue;
            samples_.push_back({spine.place_of(foot), foot.distance, p - foot.point});
        }
        require(samples_.size() > 1, "a profile of a ponytail must lie beside its spine");
        std::stable_sort(samples_.begin(), samples_.end(),
                         [](const Sample& a, const Sample& b) { return a.at < b.at; });
        require(crossed_share() <= kCrossing,
                "a profile of a ponytail crosses its spine; draw it along one side of the tail");
    }

    double begin() const { return samples_.front().at; }
    double end() const { return samples_.back().at; }
    double radius(double at) const {
        const auto [behind, share] = find(at);
        const Sample &a = samples_[behind - 1], &b = samples_[behind];
        return a.distance + share * (b.distance - a.distance);
    }
    // From the spine.
    Vec3 offset(double at) const {
        const auto [behind, share] = find(at);
        const Sample &a = samples_[behind - 1], &b = samples_[behind];
        return a.offset + share * (b.offset - a.offset);
    }

  private:
    struct Sample {
        double at, distance;
        Vec3 offset;
    };

    // The sample behind an arc length, but never the first one, and the share of the way to it from
    // the one before.
    std::pair<std::size_t, double> find(double at) const {
        const auto found = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, at,
                                            [](double x, const Sample& s) { return x < s.at; });
        const std::size_t behind = found - samples_.begin();
        const double from = samples_[behind - 1].at, to = samples_[behind].at;
        return {behind, to > from ? std::clamp((at - from) / (to - from), 0.0, 1.0) : 0.0};
    }

    // How much of the area between profile and spine lies on the lesser side. The sides turn with
    // the spine, so each sample is compared with the one before.
    double crossed_share() const {
        double areas[2] = {0.0, 0.0};
        int side = 0;
        Vec3 last = Vec3::Zero();
        for (const Sample& sample : samples_) {
            if (sample.offset.dot(last) < 0.0) side = 1 - side;
            areas[side] += sample.distance;
            if (sample.distance > 0.0) last = sample.offset;
        }
        const double whole = areas[0] + areas[1];
        return whole > 0.0 ? std::min(areas[0], areas[1]) / whole : 0.0;
    }

    std::vector<Sample> samples_;
};

// Returns the mean cosine of the angle between two profiles as seen along the spine, over the
// length that both cover.
double cosine_between(const Profile& a, const Profile& b, double from, double to) {
    constexpr int kPlaces = 32;
    double dots = 0.0, lengths = 0.0;
    for (int i = 0; i <= kPlaces; ++i) {
        const double at = from + (to - from) * i / kPlaces;
        const Vec3 u = a.offset(at), v = b.offset(at);
        dots += u.dot(v);
        lengths += u.norm() * v.norm();
    }
    return lengths > 0.0 ? dots / lengths : 0.0;
}

std::vector<Profile> profiles_of(const Spine& spine, const PonytailOptions& options, double step) {
    std::vector<Profile> result;
    for (const std::vector<Vec3>& drawn : options.profiles) {
        if (!drawn.empty()) result.emplace_back(spine, drawn, step);
    }
    if (result.size() < 2 || options.profiles[0] == options.profiles[1]) return result;
    const double from = std::max(result[0].begin(), result[1].begin());
    const double to = std::min(result[0].end(), result[1].end());
    require(from < to,
            "the profiles of the ponytail have no part of its spine in common; draw both along the "
            "same part of the tail");
    require(cosine_between(result[0], result[1], from, to) < kSameSide,
            "both profiles of the ponytail lie on one side of its spine; draw them on either side, "
            "or give one alone");
    return result;
}

// Centers and widths of a spine's cross sections, by arc length.
struct Outline {
    double first = 0.0, last = 0.0;
    double radius = 0.0;
    double fullness = 0.0, length = 0.0;
    std::vector<Profile> profiles;

    // Returns the first arc length covered by all profiles.
    double begin_of_profiles() const {
        return std::max(profiles.front().begin(), profiles.back().begin());
    }
    double end_of_profiles() const {
        return std::min(profiles.front().end(), profiles.back().end());
    }
    double drawn(double at) const {
        return 0.5 * (profiles.front().radius(at) + profiles.back().radius(at));
    }
    double radius_at(double at) const {
        if (!profiles.empty()) return radius * drawn(at) / drawn(first);
        const double t = length > first ? (at - first) / (length - first) : 0.0;
        return radius * (1.0 + fullness * smooth_ramp(0.0, kSwollen, t)) *
               (1.0 - (1.0 - kNarrowed) * smooth_ramp(kNarrowing, 1.0, t));
    }
};

// Puts the tie at the crossing of a drawn section and the spine.
void place_section(const Spine& spine, const std::vector<Vec3>& polyline, Outline& outline) {
    const DrawnSection section = drawn_section(polyline);
    const CurveFoot foot = foot_on_curve(spine.points, section.center);
    const Vec3 way = spine.points[foot.segment + 1] - spine.points[foot.segment];
    outline.radius = section_radius(polyline, section, way.normalized());
    require_closed(polyline, outline.radius);
    require(foot.distance <= outline.radius,
            "the spine of the ponytail must pass through its cross section");
    outline.first = spine.place_of(foot);
}

Outline outline_of(const Spine& spine, double step, const PonytailOptions& options) {
    Outline outline;
    outline.profiles = profiles_of(spine, options, step);
    outline.length = spine.length();
    outline.fullness = options.fullness;
    const bool drawn = !outline.profiles.empty();
    if (drawn) outline.first = outline.begin_of_profiles();
    outline.radius = kDefaultRadius * step;
    if (drawn) outline.radius = outline.drawn(outline.first);
    if (!options.section.empty()) place_section(spine, options.section, outline);
    if (options.radius) outline.radius = *options.radius;
    outline.last = outline.first + options.share * (outline.length - outline.first);
    if (drawn) outline.last = outline.end_of_profiles();

    require(outline.last >= outline.first,
            "the profiles of the ponytail end before its cross section");
    require(outline.radius > 0.0 && (!drawn || outline.drawn(outline.first) > 0.0),
            "the profiles of the ponytail must keep away from its spine at the tie");
    return outline;
}

// A tie that is wider than the volume, or in the head, gathers nothing.
void require_place(const DistanceGrid& distances, const PonytailSection& tie) {
    const Box box = distances.layout().box();
    const double most = 0.5 * (box.max - box.min).minCoeff();
    if (tie.radius > most) {
        throw Error(ErrorCode::invalid_argument,
                    "the radius of the ponytail's tie is " + length_text(tie.radius) +
                        " m, but can be " + length_text(most) +
                        " m at most, half of the least extent of the hairstyle's volume");
    }
    const double height = distances.value(tie.center);
    if (height < 0.0) {
        throw Error(
            ErrorCode::invalid_argument,
            "the tie of the ponytail lies " + length_text(-height) +
                " m inside the head; begin its spine outside, best at least the radius of " +
                length_text(tie.radius) + " m above the scalp");
    }
}

// Claims of a ponytail on the points of a grid.
class Tail {
  public:
    Tail(const DistanceGrid& distances, const PonytailShape& shape, const PonytailOptions& options)
        : distances_(distances),
          layout_(distances.layout()),
          shape_(shape),
          options_(options),
          literal_(options.fidelity == HairFidelity::thesis),
          clearance_(options.clearance.value_or(steps(kDefaultClearance, 0.0))),
          lead_(options.lead.value_or(steps(kDefaultLead, kThesisLead))),
          inner_(options.inner * shape.tie().radius),
          outer_(std::max(options.outer * shape.tie().radius,
                          inner_ + options.ring.value_or(steps(kDefaultRing, 0.0)))) {
        for (const PonytailSection& section : shape.sections) centers_.push_back(section.center);
        lengths_ = arc_lengths(centers_);
    }

    // Holds all points that take vectors of the cross sections and of the ring.
    Box box() const {
        double reach = outer_;
        Box box;
        for (const PonytailSection& section : shape_.sections) {
            reach = std::max(reach, section.radius);
            box.extend(section.center);
        }
        const Vec3 margin = Vec3::Constant(reach + layout_.step);
        return {box.min - margin, box.max + margin};
    }

    // Along the surface of revolution (purple).
    std::optional<Vec3> longitudinal(const Vec3& point) const {
        if (centers_.size() < 2) return std::nullopt;
        const CurveFoot foot = foot_on_curve(centers_, point);
        if (foot.beyond < 0.0 || foot.beyond > kBehindTie * layout_.step) return std::nullopt;
        const PonytailSection &a = shape_.sections[foot.segment],
                              &b = shape_.sections[foot.segment + 1];
        const double radius = a.radius + foot.t * (b.radius - a.radius);
        if (foot.distance > radius + kSectionMargin * layout_.step) return std::nullopt;
        if (catches_hair(point, arc_length_at(lengths_, foot))) return std::nullopt;
        const Vec3 direction = ((1.0 - foot.t) * a.direction + foot.t * b.direction).normalized();
        const Vec3 from = point - foot.point;
        const Vec3 outward = from - from.dot(direction) * direction;
        double slope = (b.radius - a.radius) / (b.center - a.center).norm();
        const double inside = 1.0 - outward.squaredNorm() / (radius * radius);
        slope += std::max(0.0, inside) * radius * spreading(arc_length_at(lengths_, foot));
        const double outside = std::max(0.0, outward.norm() - radius);
        slope -= options_.grip * outside / layout_.step;
        return (direction + slope / radius * outward).normalized();
    }

    // Into C1 from just in front of it. Streams from all sides cancel out on its axis, and hair
    // would stop there. Not in the thesis.
    std::optional<Vec3> leading(const Vec3& point) const {
        const PonytailSection& tie = shape_.tie();
        const Vec3 from = point - tie.center;
        const double height = from.dot(tie.direction);
        if (!(options_.grip > 0.0) || height >= 0.0 || height < -kLeading * layout_.step) {
            return std::nullopt;
        }
        const Vec3 outward = from - height * tie.direction;
        if (outward.norm() > kLeadingCore * tie.radius || distances_.inside(point)) {
            return std::nullopt;
        }
        return (tie.direction - outward / tie.radius).normalized();
    }

    // To the center of C1 (green).
    std::optional<Vec3> centripetal(const Vec3& point) const {
        if (!(options_.tightness > 0.0)) return std::nullopt;
        if (!literal_ && distances_.inside(point)) return std::nullopt;
        const PonytailSection& tie = shape_.tie();
        const Vec3 from = point - tie.center;
        const double height = from.dot(tie.direction);
        if (height < -lead_ || height > kBehindTie * layout_.step) return std::nullopt;
        const double radius = (from - height * tie.direction).norm();
        if (radius < inner_ || radius > outer_) return std::nullopt;
        return -options_.tightness * from.normalized();
    }

    // Along the spine behind C2 (blue). Whether any of it is inside the grid.
    bool splat_spine(VectorSplat& splat) const {
        const std::vector<Vec3>& spine = shape_.spine;
        bool inside = false;
        double at = lengths_.empty() ? 0.0 : lengths_.back();
        for (std::size_t i = shape_.last(); i + 1 < spine.size(); ++i) {
            const Vec3 middle = 0.5 * (spine[i] + spine[i + 1]);
            at += (spine[i + 1] - spine[i]).norm();
            if (catches_hair(middle, at)) continue;
            const Vec3 way = (spine[i + 1] - spine[i]).normalized();
            inside = splat.add(middle, way, ConstraintKind::spine) || inside;
        }
        const Vec3 tangent = (spine.back() - spine[spine.size() - 2]).normalized();
        const double extra = std::ceil(options_.stop_length / layout_.step);
        const double last = std::min(extra, steps_across(layout_));
        for (double k = 1.0; k <= last; k += 1.0) {
            const Vec3 middle = spine.back() + (k - 0.5) * layout_.step * tangent;
            if (catches_hair(middle, at)) continue;
            splat.add(middle, (1.0 - k / extra) * tangent, ConstraintKind::stop);
        }
        return inside;
    }

    // A ring that is asked for must have an effect.
    void require_ring(bool found) const {
        if (!literal_ || found || !(options_.tightness > 0.0)) return;
        throw Error(ErrorCode::invalid_argument,
                    "no grid point lies in the ring from " + length_text(inner_) + " to " +
                        length_text(outer_) +
                        " m around the ponytail's tie, as the grid's step "
                        "is " +
                        length_text(layout_.step) +
                        " m; give the tie a radius of at least one step, raise the resolution, or "
                        "give the ring a width by `ring`");
    }

  private:
    // A default length, given in steps.
    double steps(double usual, double thesis) const {
        return (literal_ ? thesis : usual) * layout_.step;
    }

    // Growth of distances from the spine at an arc length behind C1, as a share a unit of length:
    // a parabola, so that hair still closes up at the tie.
    double spreading(double behind) const {
        const double length = kSpreading * lengths_.back(), t = std::min(1.0, behind / length);
        return 6.0 * options_.spread / length * t * (1.0 - t);
    }

    // Returns whether hair outside the tail grows through a point of it, this far behind C1.
    bool catches_hair(const Vec3& point, double behind) const {
        if (literal_ && !(clearance_ > 0.0)) return false;
        return behind > clearance_ && distances_.value(point) < clearance_;
    }

    const DistanceGrid& distances_;
    const GridLayout& layout_;
    const PonytailShape& shape_;
    const PonytailOptions& options_;
    bool literal_;
    double clearance_, lead_, inner_, outer_;
    std::vector<Vec3> centers_;
    std::vector<double> lengths_;
};

void require_inside(bool inside) {
    if (inside) return;
    throw Error(ErrorCode::out_of_range,
                "the ponytail lies outside the volume of the hairstyle; enlarge the volume, or "
                "draw its spine nearer to the head");
}

}  // namespace

PonytailOptions with_lengths(PonytailOptions options, double step) {
    const bool literal = options.fidelity == HairFidelity::thesis;
    options.ring = options.ring.value_or(literal ? 0.0 : kDefaultRing * step);
    options.lead = options.lead.value_or(literal ? kThesisLead * step : kDefaultLead * step);
    options.clearance = options.clearance.value_or(literal ? 0.0 : kDefaultClearance * step);
    return options;
}

PonytailShape ponytail_shape(std::span<const Vec3> spine, double step,
                             const PonytailOptions& options) {
    const Spine whole(spine);
    require(step > 0.0 && std::isfinite(step), "the step along a curve must be above 0");
    require_ponytail(options);
    const Outline outline = outline_of(whole, step, options);
    PonytailShape shape;
    std::size_t last = 0;
    const auto append = [&](double from, double to) {
        if (to - from > kShortest * step) {
            const std::vector<Vec3> part = whole.part(from, to, step);
            if (!shape.spine.empty()) shape.spine.pop_back();
            shape.spine.insert(shape.spine.end(), part.begin(), part.end());
        }
        return shape.spine.empty() ? 0 : shape.spine.size() - 1;
    };
    shape.first = append(0.0, outline.first);
    last = append(outline.first, outline.last);
    append(outline.last, whole.length());

    const std::vector<Vec3> tangents = curve_tangents(shape.spine);
    const std::vector<double> lengths = arc_lengths(shape.spine);
    for (std::size_t i = shape.first; i <= last; ++i) {
        const double share = last > shape.first ? (lengths[i] - lengths[shape.first]) /
                                                      (lengths[last] - lengths[shape.first])
                                                : 0.0;
        const double at = outline.first + share * (outline.last - outline.first);
        shape.sections.push_back({shape.spine[i], tangents[i], outline.radius_at(at)});
    }
    return shape;
}

std::vector<GridConstraint> ponytail_constraints(const DistanceGrid& distances,
                                                 const PonytailShape& shape,
                                                 const PonytailOptions& options) {
    require_ponytail(options);
    require(!shape.sections.empty() && shape.spine.size() > 1 && shape.last() < shape.spine.size(),
            "the shape of a ponytail needs a spine with cross sections");
    require_place(distances, shape.tie());
    const GridLayout& layout = distances.layout();
    const Tail tail(distances, shape, options);
    // The first kind that names a point counts.
    std::map<Index, GridConstraint> vectors;
    const auto at_points = [&](ConstraintKind kind, const auto& rule) {
        for_grid_points_in(layout, tail.box(), [&](const std::array<Index, 3>& at) {
            const std::optional<Vec3> vector = rule(layout.point(at[0], at[1], at[2]));
            const Index point = layout.index(at[0], at[1], at[2]);
            if (!vector) return;
            vectors.insert({point, {point, *vector, options.weight, static_cast<int>(kind)}});
        });
    };
    const auto gather = [&] {
        at_points(ConstraintKind::gather,
                  [&](const Vec3& point) { return tail.centripetal(point); });
    };
    if (options.fidelity == HairFidelity::thesis) {
        gather();
        tail.require_ring(!vectors.empty());
    }
    at_points(ConstraintKind::section, [&](const Vec3& point) { return tail.longitudinal(point); });
    at_points(ConstraintKind::section, [&](const Vec3& point) { return tail.leading(point); });
    VectorSplat spine(layout, options.fidelity);
    require_inside(tail.splat_spine(spine) || !vectors.empty());
    for (const GridConstraint& c : spine.constraints(options.weight)) vectors.emplace(c.point, c);
    gather();

    std::vector<GridConstraint> result;
    for (const auto& [point, constraint] : vectors) result.push_back(constraint);
    return result;
}

}  // namespace lissom
