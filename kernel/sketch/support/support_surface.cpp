#include "kernel/sketch/support/support_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Nearer to the line of sight than this, the plane of tangent and line of sight is noise.
constexpr double kAlongSight = 15.0 * kDegree;
// Limit of a strip's width as a fraction of the curve's radius of curvature.
constexpr double kOfBend = 0.8;
constexpr int kExtensionRulings = 8;
// Share of a triangle by which a ray may miss it, so that no rounding opens a seam between two.
constexpr double kRim = 1e-7;

void require_lengths(const SupportOptions& o) {
    if (is_length(o.width) && o.width > 0.0 && is_length(o.extension) && is_length(o.end)) return;
    throw Error(
        ErrorCode::invalid_argument,
        "a supporting surface needs a width above 0, and an extension and end of 0 or more");
}

std::vector<Vec3> distinct_points(std::span<const Vec3> curve) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (!curve[i].allFinite()) {
            throw Error(ErrorCode::not_finite,
                        "point " + std::to_string(i + 1) + " of the curve is not finite");
        }
        if (points.empty() || curve[i] != points.back()) points.push_back(curve[i]);
    }
    if (points.size() >= 2) return points;
    throw Error(ErrorCode::invalid_argument, "a curve needs two points that differ");
}

// Unit vector from the viewpoint to a point.
Vec3 sight(const Camera& camera, const Vec3& point) {
    if (camera.is_ortho()) return camera.forward();
    const Vec3 way = point - camera.eye();
    if (way.norm() > 0.0) return way.normalized();
    throw Error(ErrorCode::invalid_argument,
                "the curve passes through the viewpoint; look at it from elsewhere");
}

std::vector<double> lengths_along(std::span<const Vec3> points) {
    std::vector<double> lengths(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        lengths[i] = lengths[i - 1] + (points[i] - points[i - 1]).norm();
    }
    return lengths;
}

// Unit tangents: the mean of those of the segments beside a point; at a reversal of the curve, that
// of the segment before.
std::vector<Vec3> tangents_along(std::span<const Vec3> points) {
    std::vector<Vec3> tangents;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 before = i > 0 ? Vec3((points[i] - points[i - 1]).normalized()) : Vec3::Zero();
        const Vec3 after =
            i + 1 < points.size() ? Vec3((points[i + 1] - points[i]).normalized()) : Vec3::Zero();
        const Vec3 mean = before + after;
        tangents.push_back(mean.norm() > 1e-9 ? Vec3(mean.normalized()) : before);
    }
    return tangents;
}

// Direction of the last `end` of the curve.
Vec3 end_direction(std::span<const Vec3> points, std::span<const double> lengths, double end) {
    std::size_t i = points.size() - 2;
    while (i > 0 && lengths.back() - lengths[i] < end) --i;
    const Vec3 way = points.back() - points[i];
    if (way.norm() > 0.0) return way.normalized();
    return (points.back() - points[points.size() - 2]).normalized();
}

// Returns the radius of the circle through the points before and behind; infinite if they are in
// line.
double bend_radius(std::span<const Vec3> points, std::size_t i) {
    if (i == 0 || i + 1 >= points.size()) return std::numeric_limits<double>::infinity();
    const Vec3 a = points[i] - points[i - 1], b = points[i + 1] - points[i];
    const double area = a.cross(b).norm();
    return area > 0.0 ? a.norm() * b.norm() * (a + b).norm() / (2.0 * area)
                      : std::numeric_limits<double>::infinity();
}

// Returns the normals of the triangles of segment and viewpoint, with one sign along the curve;
// along the line of sight that of the points before.
std::vector<Vec3> strip_directions(std::span<const Vec3> tangents, std::span<const Vec3> sights,
                                   const Vec3& otherwise) {
    std::vector<Vec3> across(tangents.size());
    for (std::size_t i = 0; i < tangents.size(); ++i) across[i] = sights[i].cross(tangents[i]);
    const auto clear = std::find_if(across.begin(), across.end(), [](const Vec3& one) {
        return one.norm() >= std::sin(kAlongSight);
    });
    Vec3 last = clear != across.end() ? Vec3(clear->normalized()) : otherwise;
    for (Vec3& one : across) {
        if (one.dot(last) < 0.0) one = -one;
        const double sine = one.norm(), share = std::min(1.0, sine / std::sin(kAlongSight));
        const Vec3 own = sine > 0.0 ? Vec3(one / sine) : last;
        const Vec3 blend = share * own + (1.0 - share) * last;
        last = one = blend.norm() > 0.0 ? Vec3(blend.normalized()) : last;
    }
    return across;
}

// The part of a curve's length whose tangent is near the line of sight.
double end_on_share(std::span<const double> lengths, std::span<const Vec3> tangents,
                    std::span<const Vec3> sights) {
    double sum = 0.0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (tangents[i].cross(sights[i]).norm() >= std::sin(kAlongSight)) continue;
        const double before = i > 0 ? lengths[i - 1] : lengths[i];
        const double after = i + 1 < lengths.size() ? lengths[i + 1] : lengths[i];
        sum += 0.5 * (after - before);
    }
    return sum / lengths.back();
}

}  // namespace

SupportSurface::SupportSurface(std::span<const Vec3> curve, const Camera& camera,
                               const SupportOptions& options)
    : mode_(options.mode) {
    require_lengths(options);
    std::vector<Vec3> points = distinct_points(curve);
    const std::size_t count = points.size();
    std::vector<double> lengths = lengths_along(points);
    length_ = lengths.back();
    tangents_ = tangents_along(points);
    const Vec3 end = end_direction(points, lengths, options.end);
    for (int i = 1; options.extension > 0.0 && i <= kExtensionRulings; ++i) {
        points.emplace_back(points[count - 1] + options.extension * i / kExtensionRulings * end);
        lengths.push_back(length_ + options.extension * i / kExtensionRulings);
        tangents_.push_back(end);
    }
    std::vector<Vec3> sights;
    for (const Vec3& point : points) sights.push_back(sight(camera, point));
    end_on_ = end_on_share(std::span(lengths).first(count), tangents_, sights);

    const bool strip = mode_ == SupportMode::strip;
    const std::vector<Vec3> across =
        strip ? strip_directions(tangents_, sights, camera.right()) : sights;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double most =
            strip ? kOfBend * bend_radius(points, i) : std::numeric_limits<double>::infinity();
        rulings_.push_back({points[i], across[i], std::min(options.width, most), lengths[i]});
    }
}

double SupportSurface::seen_from(const Camera& camera) const {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i + 1 < rulings_.size(); ++i) {
        const Ruling& ruling = rulings_[i];
        const Vec3 normal = tangents_[i].cross(ruling.direction);
        const double length = rulings_[i + 1].along - ruling.along;
        if (ruling.along >= length_ || !(normal.norm() > 0.0)) continue;
        sum += length * std::abs(normal.normalized().dot(sight(camera, ruling.center)));
        weight += length;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

// Adds the hits of the two triangles between a ruling and the next.
void SupportSurface::add_hits(std::size_t first, const Ray& ray, std::vector<Hit>& hits) const {
    struct Corner {
        Vec3 at;
        double along, across;
    };
    const auto corner = [&](std::size_t i, double side) {
        const Ruling& r = rulings_[i];
        return Corner{r.center + side * r.reach * r.direction, r.along, side * r.reach};
    };
    const std::array<Corner, 4> quad{corner(first, -1.0), corner(first + 1, -1.0),
                                     corner(first + 1, 1.0), corner(first, 1.0)};
    for (const auto& [i, j] : {std::pair(1, 2), std::pair(2, 3)}) {
        const Corner &a = quad[0], &b = quad[i], &c = quad[j];
        Mat3 sides;
        sides << b.at - a.at, c.at - a.at, -ray.direction;
        const Vec3 share = sides.inverse() * (ray.origin - a.at);
        const double u = share.x(), v = share.y(), distance = share.z();
        // Also false if the ray runs along the triangle.
        const bool inside = u >= -kRim && v >= -kRim && u + v <= 1.0 + kRim;
        if (!(inside && distance >= 0.0)) continue;
        const double rest = 1.0 - u - v;
        hits.push_back({ray.origin + distance * ray.direction, distance,
                        rest * a.along + u * b.along + v * c.along,
                        rest * a.across + u * b.across + v * c.across});
    }
}

std::vector<SupportSurface::Hit> SupportSurface::hits(const Ray& ray) const {
    std::vector<Hit> hits;
    for (std::size_t i = 0; i + 1 < rulings_.size(); ++i) add_hits(i, ray, hits);
    std::sort(hits.begin(), hits.end(),
              [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
    return hits;
}

Mesh SupportSurface::mesh(const Context& context) const {
    std::vector<Vec3> positions;
    FaceList faces;
    for (const Ruling& r : rulings_) {
        positions.emplace_back(r.center - r.reach * r.direction);
        positions.emplace_back(r.center + r.reach * r.direction);
    }
    for (Index i = 0; i + 1 < count_of(rulings_); ++i) {
        faces.add({2 * i, 2 * i + 2, 2 * i + 3});
        faces.add({2 * i, 2 * i + 3, 2 * i + 1});
    }
    return Mesh(std::move(positions), std::move(faces), context);
}

}  // namespace lissom
