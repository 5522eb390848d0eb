#include "kernel/sketch/gizmo.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr std::array<std::string_view, 15> kPartNames{
    "move-x",   "move-y",   "move-z",      "move-yz", "move-zx", "move-xy", "move-view", "rotate-x",
    "rotate-y", "rotate-z", "rotate-view", "scale-x", "scale-y", "scale-z", "scale-all"};

// Places of the parts, as fractions of the size. If all are shown they keep out of each other's
// way.
constexpr double kShaftStart = 0.18;
constexpr double kPlaneNear = 0.28, kPlaneFar = 0.48;
constexpr double kBarbLength = 0.12, kBarbWidth = 0.05;

struct Layout {
    double arrow, ring, view_ring, box, uniform;
};

Layout layout_of(GizmoMode mode) {
    if (mode == GizmoMode::all) return {1.3, 0.9, 1.1, 0.65, 1.3};
    return {1.0, 1.0, 1.15, 1.0, 0.0};
}

// Axes whose picture is shorter than this fraction of their length are seen end-on, and planes
// whose picture is this much smaller than they are, from the side.
constexpr double kEndOn = 0.15, kFromTheSide = 0.3;
// Rings that are turned to the viewer by more than this cosine are shown whole.
constexpr double kFacing = 0.98;
constexpr int kRingSegments = 64;

// Values of a gizmo reused in one view.
struct Frame {
    const View& view;
    Vec3 origin, to_eye;
    Mat3 axes;
    double length;

    Frame(const Gizmo& gizmo, const View& seen)
        : view(seen),
          origin(gizmo.origin()),
          axes(gizmo.axes(seen.camera)),
          length(gizmo.length(seen)) {
        const Camera& camera = seen.camera;
        to_eye = camera.is_ortho() ? Vec3(-camera.forward())
                                   : Vec3((camera.eye() - origin).normalized());
    }

    Vec3 point(const Vec3& direction, double fraction) const {
        return origin + fraction * length * direction;
    }
    bool is_end_on(const Vec3& axis) const { return axis.cross(to_eye).norm() < kEndOn; }
    bool is_from_side(const Vec3& normal) const {
        return std::abs(normal.dot(to_eye)) < kFromTheSide;
    }
};

GizmoPart axis_part(GizmoPart first, int k) {
    return static_cast<GizmoPart>(static_cast<int>(first) + k);
}

GizmoRole axis_role(int k) {
    return static_cast<GizmoRole>(k);
}

void add_arrow(const Frame& frame, int k, double tip, GizmoShape& shape) {
    const Vec3 axis = frame.axes.col(k);
    if (frame.is_end_on(axis)) return;
    const GizmoPart part = axis_part(GizmoPart::move_x, k);
    shape.lines.push_back(
        {part, axis_role(k), {frame.point(axis, kShaftStart), frame.point(axis, tip)}});
    // Barbs seen in full from the camera.
    const Vec3 aside = kBarbWidth * frame.length * axis.cross(frame.to_eye).normalized();
    const Vec3 back = frame.point(axis, tip - kBarbLength);
    shape.lines.push_back(
        {part, axis_role(k), {back + aside, frame.point(axis, tip), back - aside}, true});
}

void add_plane(const Frame& frame, int k, GizmoShape& shape) {
    if (frame.is_from_side(frame.axes.col(k))) return;
    const Vec3 a = frame.axes.col((k + 1) % 3), b = frame.axes.col((k + 2) % 3);
    const auto corner = [&](double along_a, double along_b) {
        return Vec3(frame.origin + frame.length * (along_a * a + along_b * b));
    };
    shape.lines.push_back({axis_part(GizmoPart::move_yz, k),
                           axis_role(k),
                           {corner(kPlaneNear, kPlaneNear), corner(kPlaneFar, kPlaneNear),
                            corner(kPlaneFar, kPlaneFar), corner(kPlaneNear, kPlaneFar)},
                           true});
}

// The circle about `axis`, or the half of it that is turned to the camera.
GizmoLine ring(const Frame& frame, GizmoPart part, GizmoRole role, const Vec3& axis,
               double radius) {
    GizmoLine line{part, role, {}};
    const bool whole = std::abs(axis.dot(frame.to_eye)) > kFacing;
    Vec3 front = frame.to_eye - axis.dot(frame.to_eye) * axis;
    if (whole) front = axis.unitOrthogonal();
    front.normalize();
    const Vec3 aside = axis.cross(front);
    const int segments = whole ? kRingSegments : kRingSegments / 2;
    for (int i = 0; i <= segments; ++i) {
        const double angle = 2.0 * kPi * i / kRingSegments - (whole ? 0.0 : 0.5 * kPi);
        line.points.push_back(
            frame.point(std::cos(angle) * front + std::sin(angle) * aside, radius));
    }
    return line;
}

void add_box(const Frame& frame, int k, double place, bool with_shaft, GizmoShape& shape) {
    const Vec3 axis = frame.axes.col(k);
    if (frame.is_end_on(axis)) return;
    const GizmoPart part = axis_part(GizmoPart::scale_x, k);
    if (with_shaft) {
        shape.lines.push_back(
            {part, axis_role(k), {frame.point(axis, kShaftStart), frame.point(axis, place)}});
    }
    shape.points.push_back({part, axis_role(k), frame.point(axis, place)});
}

// ---- distances in the picture

struct Distance {
    double pixels = std::numeric_limits<double>::infinity();
    double depth = std::numeric_limits<double>::infinity();
    bool inside = false;
};

Distance distance_to(const GizmoPoint& point, const View& view, const Vec2& cursor) {
    const Vec3 seen = view.project(point.position);
    return {(seen.head<2>() - cursor).norm(), seen.z()};
}

// Lines of a gizmo are short beside its depth; lines that reach behind the camera are not dragged.
Distance distance_to(const GizmoLine& line, const View& view, const Vec2& cursor) {
    std::vector<Vec3> seen;
    for (const Vec3& p : line.points) seen.push_back(view.project(p));
    Distance best;
    bool inside = false;
    const std::size_t n = seen.size();
    for (std::size_t i = 0; i < (line.closed ? n : n - 1); ++i) {
        const Vec3 &a = seen[i], &b = seen[(i + 1) % n];
        if (!a.allFinite() || !b.allFinite()) return {};
        const Vec2 along = (b - a).head<2>(), to_cursor = cursor - a.head<2>();
        const double square = along.squaredNorm();
        const double t = square > 0.0 ? std::clamp(to_cursor.dot(along) / square, 0.0, 1.0) : 0.0;
        const double pixels = std::max(0.0, (t * along - to_cursor).norm() - 0.5 * line.width);
        if (pixels < best.pixels) best = {pixels, a.z() + t * (b.z() - a.z())};
        if ((a.y() <= cursor.y()) != (b.y() <= cursor.y())) {
            const double x = a.x() + (cursor.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
            if (x > cursor.x()) inside = !inside;
        }
    }
    best.inside = line.closed && inside;
    return best;
}

bool is_plane(GizmoPart part) {
    return part == GizmoPart::move_yz || part == GizmoPart::move_zx || part == GizmoPart::move_xy;
}

}  // namespace

std::string_view part_name(GizmoPart part) {
    return kPartNames[static_cast<std::size_t>(part)];
}

std::optional<GizmoPart> find_part(std::string_view name) {
    const auto* const found = std::find(kPartNames.begin(), kPartNames.end(), name);
    if (found == kPartNames.end()) return std::nullopt;
    return static_cast<GizmoPart>(found - kPartNames.begin());
}

Vec3 role_color(GizmoRole role, bool highlighted) {
    if (highlighted) return {1.0, 0.83, 0.25};
    switch (role) {
        case GizmoRole::x:
            return {0.86, 0.24, 0.27};
        case GizmoRole::y:
            return {0.44, 0.70, 0.20};
        case GizmoRole::z:
            return {0.22, 0.47, 0.89};
        case GizmoRole::view:
            break;
    }
    return {0.78, 0.78, 0.78};
}

Gizmo::Gizmo(const GizmoOptions& options) : options_(options) {
    if (!options.origin.allFinite() || !options.local.allFinite()) {
        throw Error(ErrorCode::not_finite, "the gizmo's origin or axes are NaN or infinite");
    }
    require(std::isfinite(options.size) && options.size > 0.0,
            "the gizmo's size is a number of pixels and must be positive");
    const Mat3 square = options.local.transpose() * options.local;
    require((square - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-6,
            "the gizmo's local axes must be orthogonal and of unit length: take the scale out");
}

Mat3 Gizmo::axes(const Camera& camera) const {
    if (options_.axes == GizmoAxes::world) return Mat3::Identity();
    if (options_.axes == GizmoAxes::local) return options_.local;
    Mat3 axes;
    axes << camera.right(), camera.up(), -camera.forward();
    return axes;
}

double Gizmo::length(const View& view) const {
    return options_.size * view.pixel_length(view.camera.to_camera(options_.origin).z());
}

bool Gizmo::is_seen(const View& view) const {
    return view.camera.is_ortho() || view.camera.to_camera(options_.origin).z() > 0.0;
}

GizmoShape Gizmo::shape(const View& view) const {
    GizmoShape shape;
    if (!is_seen(view)) return shape;
    const Frame frame(*this, view);
    const Layout layout = layout_of(options_.mode);
    const Vec3 center = options_.origin;
    const auto shows = [&](GizmoMode mode) {
        return options_.mode == mode || options_.mode == GizmoMode::all;
    };
    if (shows(GizmoMode::rotate)) {
        for (int k = 0; k < 3; ++k) {
            shape.lines.push_back(ring(frame, axis_part(GizmoPart::rotate_x, k), axis_role(k),
                                       frame.axes.col(k), layout.ring));
        }
        shape.lines.push_back(
            ring(frame, GizmoPart::rotate_view, GizmoRole::view, frame.to_eye, layout.view_ring));
    }
    if (shows(GizmoMode::move)) {
        for (int k = 0; k < 3; ++k) add_plane(frame, k, shape);
        for (int k = 0; k < 3; ++k) add_arrow(frame, k, layout.arrow, shape);
        shape.points.push_back({GizmoPart::move_view, GizmoRole::view, center, 7.0});
    }
    if (shows(GizmoMode::scale)) {
        const bool alone = options_.mode == GizmoMode::scale;
        for (int k = 0; k < 3; ++k) add_box(frame, k, layout.box, alone, shape);
        const Vec3 aside = (view.camera.right() + view.camera.up()).normalized();
        shape.points.push_back({GizmoPart::scale_all, GizmoRole::view,
                                frame.point(aside, layout.uniform), alone ? 7.0 : 5.0});
    }
    return shape;
}

std::optional<GizmoPart> Gizmo::hit(const View& view, const Vec2& cursor, double reach) const {
    const GizmoShape shown = shape(view);
    // A part under the cursor comes first, then distance and depth.
    enum { on_point, on_line, in_plane, near_line, nothing };
    using Rank = std::tuple<int, double, double>;
    Rank best{nothing, 0.0, 0.0};
    std::optional<GizmoPart> found;
    const auto offer = [&](GizmoPart part, const Rank& rank) {
        if (rank < best) std::tie(best, found) = std::tuple(rank, part);
    };
    for (const GizmoPoint& point : shown.points) {
        const Distance d = distance_to(point, view, cursor);
        if (d.pixels <= std::max(reach, point.radius))
            offer(point.part, {on_point, d.pixels, d.depth});
    }
    for (const GizmoLine& line : shown.lines) {
        const Distance d = distance_to(line, view, cursor);
        const bool inside = d.inside && is_plane(line.part);
        if (!inside && !(d.pixels <= reach)) continue;
        const int rank = inside ? in_plane : d.pixels <= 0.4 * reach ? on_line : near_line;
        offer(line.part, {rank, inside ? 0.0 : d.pixels, d.depth});
    }
    return found;
}

}  // namespace lissom
