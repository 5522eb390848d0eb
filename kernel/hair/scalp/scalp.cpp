#include "kernel/hair/scalp/scalp.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <unordered_map>

#include "kernel/core/roots.h"
#include "kernel/hair/scalp/hairline.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

constexpr double kAverageWidth = 0.155;

// Metres in the usual unit that makes this the width of a person's head.
std::optional<double> usual_unit(double width) {
    // Metre, centimetre, millimetre, decimetre, inch. With the foot a model of a head that is 1
    // high would be one.
    for (const double unit : {1.0, 0.01, 0.001, 0.1, 0.0254}) {
        if (width * unit > 0.12 && width * unit < 0.2) return unit;
    }
    return std::nullopt;
}

// Relief of a scalp: mean curvature of the surface, of any sign, times the radius of the head. Bald
// heads have 0.8 to 1.2, coarse ones up to 2.1, heads with modelled hair 2.6 to 16.
constexpr double kBaldRelief = 2.2, kHairyRelief = 3.0;
constexpr const char* kModelledHair = "its hair seems to be modelled";

// Names an edge by its vertices in ascending order.
std::size_t edge_name(Index a, Index b, Index vertices) {
    return at(std::min(a, b)) * at(vertices) + at(std::max(a, b));
}

double relief_of(const Mesh& head, const Region& region, double width) {
    const std::vector<Vec3> normals = face_normals(head);
    const std::vector<double> areas = face_areas(head);
    std::unordered_map<std::size_t, Index> face_beside;
    double bend = 0.0, area = 0.0;
    for (const Index f : region.faces()) {
        area += areas[f];
        const auto corners = head.topology().face(f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Index a = corners[i], b = corners[(i + 1) % corners.size()];
            const auto found = face_beside.try_emplace(edge_name(a, b, head.vertex_count()), f);
            if (found.second) continue;
            const double cosine = normals[found.first->second].dot(normals[f]);
            bend += std::acos(std::clamp(cosine, -1.0, 1.0)) *
                    (head.position(b) - head.position(a)).norm();
        }
    }
    return area > 0.0 ? 0.25 * bend * width / area : 0.0;
}

void doubt_modelled_hair(const Mesh& head, const Region& region, HeadFrame& frame) {
    const double relief = relief_of(head, region, frame.width);
    const double part = std::clamp((relief - kBaldRelief) / (kHairyRelief - kBaldRelief), 0.0, 1.0);
    if (!(part > 0.0)) return;
    frame.confidence *= 1.0 - part;
    frame.doubt = kModelledHair;
}

// Below this confidence a guess is told.
constexpr double kDoubtful = 0.5;

void tell_doubts(const Scalp& scalp, const ScalpOptions& options, const Context& context) {
    const HeadFrame& frame = scalp.frame();
    const bool all_given = options.hints.up && options.hints.front && options.region;
    if (scalp.confidence() < kDoubtful && !all_given) {
        std::ostringstream message;
        message.precision(2);
        message << "place and direction of the head are a guess (confidence " << scalp.confidence()
                << "), because " << frame.doubt
                << (frame.doubt == kModelledHair
                        ? "; hair would grow on it: take it off, or give the region"
                        : "; look at up and front of the scalp, or give up, front and region");
        context.log(LogLevel::warning, message.str());
    }
    if (!scalp.knows_unit()) {
        std::ostringstream message;
        message.precision(3);
        message << "the unit of the head is not known: it is " << frame.width
                << " wide, and hair is made as for an average head of 0.155 m; the option `unit`, "
                   "metres for one unit of the head, says otherwise";
        context.log(LogLevel::warning, message.str());
    }
}

// The region of a mesh says where hair grows unless a hairline is given.
bool is_default(const std::vector<HairlinePoint>& hairline) {
    const std::vector<HairlinePoint> usual = default_hairline();
    return std::equal(hairline.begin(), hairline.end(), usual.begin(), usual.end(),
                      [](const HairlinePoint& a, const HairlinePoint& b) {
                          return a.azimuth == b.azimuth && a.elevation == b.elevation;
                      });
}

void require_options(const Mesh& head, const ScalpOptions& options) {
    if (options.unit && !(*options.unit > 0.0 && std::isfinite(*options.unit))) {
        throw Error(ErrorCode::invalid_argument, "unit must be a finite number of metres above 0");
    }
    if (!(options.softness >= 0.0 && options.softness <= 0.1)) {
        throw Error(ErrorCode::invalid_argument, "softness must lie between 0 and 0.1 metres");
    }
    if (options.region) {
        require_same_topology(head, options.region->topology(), "the scalp's region");
    }
    require_hairline(options.hairline);
}

HeadFrame checked_frame(const Mesh& head, const ScalpOptions& options, const Context& context) {
    require_options(head, options);
    return guess_head_frame(head, options.hints, context);
}

}  // namespace

Scalp::Scalp(const Mesh& head, const ScalpOptions& options, const Context& context)
    : options_(options),
      frame_(checked_frame(head, options, context)),
      scale_(frame_.width / kAverageWidth),
      unit_(options.unit.value_or(usual_unit(frame_.width).value_or(kAverageWidth / frame_.width))),
      hairline_(options.hairline),
      softness_(options.softness * scale_),
      region_(Region::none(head.shared_topology())),
      normals_(vertex_normals(head)),
      tree_(head, context) {
    charge_ = context.charge(head.vertex_count() * (sizeof(Vec3) + sizeof(double)), "the scalp");
    knows_unit_ = options.unit || usual_unit(frame_.width);
    choose_region(head, options);
    if (region_.empty() || root_faces_.empty()) {
        throw Error(ErrorCode::region_empty,
                    guessed_ ? "no face of the head lies above the hairline; give a region"
                             : "the scalp's region holds no face of the head");
    }
    if (guessed_) doubt_modelled_hair(head, region_, frame_);
    tell_doubts(*this, options, context);
}

void Scalp::choose_region(const Mesh& head, const ScalpOptions& options) {
    const Region* named = is_default(options.hairline) ? head.find_region("scalp") : nullptr;
    guessed_ = !options.region && !named;
    if (guessed_) {
        guess_region(head);
    } else {
        set_given_region(head, options.region ? *options.region : *named, options.softness);
    }
}

void Scalp::set_given_region(const Mesh& head, const Region& region, double softness) {
    region_ = region;
    root_faces_ = region.faces();
    margins_ = margins_of_region(head, region, softness * scale_);
}

void Scalp::guess_region(const Mesh& head) {
    skull_ = SkullOverEars(tree_, frame_);
    const HairlineTest test{frame_, hairline_, softness_, skull_};
    margins_ = margins_of_hairline(head, normals_, test);
    std::vector<Index> vertices;
    for (Index v = 0; v < head.vertex_count(); ++v) {
        if (test.inside(margins_[v])) vertices.push_back(v);
    }
    region_ = Region(head.shared_topology(), std::move(vertices));
    for (Index f = 0; f < head.face_count(); ++f) {
        const auto face = head.topology().face(f);
        if (std::any_of(face.begin(), face.end(), [&](Index v) { return margins_[v] > 0.0; })) {
            root_faces_.push_back(f);
        }
    }
}

// The back of an ear faces the head: skin ends where the surface turns, and not at a vertex before.
bool Scalp::faces_outward(const Triangle& triangle, const Vec3& barycentric,
                          const Vec3& position) const {
    return normal_at(triangle, barycentric).dot(position - frame_.center) > 0.0;
}

double Scalp::margin_at(const Triangle& triangle, const Vec3& barycentric,
                        const Vec3& position) const {
    double interpolated = 0.0;
    bool bald = false, all_bald = true;
    for (int corner = 0; corner < 3; ++corner) {
        const double margin = margins_[triangle[corner]];
        interpolated += barycentric[corner] * margin;
        bald = bald || HairlineTest::bald(margin);
        all_bald = all_bald && HairlineTest::bald(margin);
    }
    if (!guessed_ || all_bald || (bald && !faces_outward(triangle, barycentric, position)))
        return interpolated;
    return HairlineTest{frame_, hairline_, softness_, skull_}.margin_at(position);
}

Vec3 Scalp::vector_of(const ScalpDirection& direction) const {
    const double flat = std::cos(direction.elevation);
    return frame_.axes * Vec3(flat * std::sin(direction.azimuth), std::sin(direction.elevation),
                              flat * std::cos(direction.azimuth));
}

ScalpDirection Scalp::direction_of(const Vec3& point) const {
    const Vec3 p = frame_.local(point);
    return {std::atan2(p.x(), p.z()), std::atan2(p.y(), hypotenuse(p.x(), p.z()))};
}

Vec3 Scalp::normal_at(const Triangle& triangle, const Vec3& barycentric) const {
    Vec3 sum = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
        sum += barycentric[corner] * normals_[triangle[corner]];
    }
    const double length = sum.norm();
    return length > 0.0 ? Vec3(sum / length) : Vec3::Zero();
}

std::optional<SurfacePoint> Scalp::surface_in(const ScalpDirection& direction) const {
    const Vec3 ray = vector_of(direction);
    const auto leaves = [&](const SurfacePoint& hit) { return hit.normal.dot(ray) > 0.0; };
    const std::optional<SurfacePoint> first = tree_.pick(frame_.center, ray);
    if (!first || leaves(*first)) return first;
    const std::vector<SurfacePoint> hits = tree_.pick_all(frame_.center, ray);
    const auto found = std::find_if(hits.begin(), hits.end(), leaves);
    return found == hits.end() ? std::nullopt : std::optional(*found);
}

ScalpPoint Scalp::at(const ScalpDirection& direction, double lift) const {
    if (!std::isfinite(direction.azimuth) || !std::isfinite(direction.elevation) ||
        !std::isfinite(lift)) {
        throw Error(ErrorCode::not_finite, "azimuth, elevation or lift is NaN or infinite");
    }
    if (const std::optional<SurfacePoint> hit = surface_in(direction)) {
        const Vec3 normal = normal_at(hit->triangle, hit->barycentric);
        return {hit->position + lift * scale_ * normal, normal, *hit};
    }
    const auto degrees = [](double angle) {
        return std::to_string(std::lround(angle * 180.0 / kPi));
    };
    throw Error(ErrorCode::out_of_range, "the head has no surface at azimuth " +
                                             degrees(direction.azimuth) + ", elevation " +
                                             degrees(direction.elevation) + " degrees");
}

Box Scalp::default_box() const {
    const Box metres = default_volume();
    Box box;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 p = metres.min;
        for (int axis = 0; axis < 3; ++axis) {
            if ((corner >> axis) & 1) p[axis] = metres.max[axis];
        }
        box.extend(from_metres(p));
    }
    return box;
}

}  // namespace lissom
