#include "kernel/sketch/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Smallest sine of the angle between the view and `up` that still fixes the picture's turn.
constexpr double kMinimumUpSine = 1e-9;

void require_valid(const CameraOptions& options) {
    if (!options.eye.allFinite() || !options.target.allFinite() || !options.up.allFinite()) {
        throw Error(ErrorCode::not_finite, "the camera's eye, target or up is NaN or infinite");
    }
    require(options.eye != options.target,
            "the camera's eye and target are the same point; move one of them");
    if (options.ortho) {
        require(
            std::isfinite(*options.ortho) && *options.ortho > 0.0,
            "the camera's ortho is the height of the picture in world units and must be positive");
    } else {
        require(options.fov > 0.0 && options.fov < kPi,
                "the camera's opening angle (fov) must lie between 0 and 180 degrees");
    }
}

// Rows: right, up, forward.
Mat3 camera_axes(const CameraOptions& options) {
    const Vec3 forward = (options.target - options.eye).normalized();
    const Vec3 right = forward.cross(options.up);
    require(right.norm() > kMinimumUpSine * options.up.norm(),
            "the camera's up runs along its view; choose another up");
    Mat3 axes;
    axes.row(0) = right.normalized();
    axes.row(1) = axes.row(0).transpose().cross(forward);
    axes.row(2) = forward;
    return axes;
}

}  // namespace

Camera::Camera(const CameraOptions& options) : options_(options) {
    require_valid(options);
    axes_ = camera_axes(options);
}

double Camera::half_height(double depth) const {
    return options_.ortho ? 0.5 * *options_.ortho : depth * std::tan(0.5 * options_.fov);
}

Vec3 Camera::project(const Vec3& world, const PictureSize& size) const {
    const Vec3 p = to_camera(world);
    const double pixels = 0.5 * size.height / half_height(p.z());
    if (!is_ortho() && p.z() <= 0.0) return {std::nan(""), std::nan(""), p.z()};
    return {0.5 * size.width + pixels * p.x(), 0.5 * size.height - pixels * p.y(), p.z()};
}

Vec3 Camera::unproject(const Vec3& pixel_and_depth, const PictureSize& size) const {
    const double depth = pixel_and_depth.z();
    const double pixel = half_height(depth) / (0.5 * size.height);
    return to_world({pixel * (pixel_and_depth.x() - 0.5 * size.width),
                     pixel * (0.5 * size.height - pixel_and_depth.y()), depth});
}

Ray Camera::ray(double x, double y, const PictureSize& size) const {
    const Vec3 on_ray = unproject({x, y, 1.0}, size);
    if (is_ortho()) return {unproject({x, y, 0.0}, size), forward()};
    return {eye(), (on_ray - eye()).normalized()};
}

namespace {

constexpr std::array<std::string_view, 7> kViewNames{"front", "back",   "left",         "right",
                                                     "top",   "bottom", "three-quarter"};

constexpr double kThreeQuarterAzimuth = 35.0 * kPi / 180.0;
constexpr double kThreeQuarterElevation = 20.0 * kPi / 180.0;

// From the object to the camera, and the picture's up, with y up and z to the front.
struct ViewAxes {
    Vec3 outward;
    Vec3 up;
};

ViewAxes axes_of(StandardView view) {
    switch (view) {
        case StandardView::front:
            return {Vec3::UnitZ(), Vec3::UnitY()};
        case StandardView::back:
            return {-Vec3::UnitZ(), Vec3::UnitY()};
        case StandardView::left:
            return {-Vec3::UnitX(), Vec3::UnitY()};
        case StandardView::right:
            return {Vec3::UnitX(), Vec3::UnitY()};
        case StandardView::top:
            return {Vec3::UnitY(), -Vec3::UnitZ()};
        case StandardView::bottom:
            return {-Vec3::UnitY(), Vec3::UnitZ()};
        case StandardView::three_quarter:
            break;
    }
    const double level = std::cos(kThreeQuarterElevation);
    return {Vec3(level * std::sin(kThreeQuarterAzimuth), std::sin(kThreeQuarterElevation),
                 level * std::cos(kThreeQuarterAzimuth)),
            Vec3::UnitY()};
}

// Turns axes given for y upwards into those for z upwards: a quarter turn about x.
Vec3 to_world_up(const Vec3& direction, ViewUp up) {
    return up == ViewUp::y ? direction : Vec3(direction.x(), -direction.z(), direction.y());
}

void require_valid(std::span<const Vec3> points, const FramingOptions& options) {
    require(!points.empty(), "there is nothing to frame; give the camera explicitly");
    require(std::isfinite(options.aspect) && options.aspect > 0.0,
            "the picture's aspect ratio must be positive");
    require(options.margin >= 0.0 && options.margin < 0.5,
            "the margin is a share of the picture and must lie between 0 and 0.5");
    require(options.fov > 0.0 && options.fov < kPi,
            "the camera's opening angle (fov) must lie between 0 and 180 degrees");
    const bool finite =
        std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
    if (!finite) throw Error(ErrorCode::not_finite, "points to frame are NaN or infinite");
}

// The nearest pair of planes through one axis of the picture that hold all points between them: the
// distance of their line of intersection, before depth 0, and its crossing of the axis.
struct Fit {
    double distance;
    double center;
};

// Planes that open with slope `tangent` against the depth; 0 is without perspective, and `distance`
// is then half the width between them.
Fit fit_axis(std::span<const Vec3> points, int axis, double tangent) {
    double high = -std::numeric_limits<double>::infinity(), low = high;
    for (const Vec3& p : points) {
        high = std::max(high, p[axis] - tangent * p.z());
        low = std::max(low, -p[axis] - tangent * p.z());
    }
    const double width = 0.5 * (high + low);
    return {tangent > 0.0 ? width / tangent : width, 0.5 * (high - low)};
}

Box box_of(std::span<const Vec3> points) {
    Box box;
    for (const Vec3& p : points) box.extend(p);
    return box;
}

// Extent that stands in for one that is zero, and the least share of the extent in front of the
// eye.
constexpr double kPointExtent = 1.0;
constexpr double kNearShare = 1e-3;

// Moves `camera`, which looks from `eye` at the origin, so that it shows `points`; they are given
// in its axes about the point `center`.
void fit_camera(CameraOptions& camera, std::span<const Vec3> points, const Vec3& center,
                double extent, const FramingOptions& options) {
    const Camera axes(camera);
    const double used = 1.0 - 2.0 * options.margin;
    const double tangent = options.ortho ? 0.0 : used * std::tan(0.5 * options.fov);
    const Fit x = fit_axis(points, 0, options.aspect * tangent);
    const Fit y = fit_axis(points, 1, tangent);
    double nearest = 0.0;
    for (const Vec3& p : points) nearest = std::max(nearest, kNearShare * extent - p.z());

    double distance = extent;
    if (options.ortho) {
        const double half = std::max(x.distance / options.aspect, y.distance);
        camera.ortho = 2.0 * std::max(half, kNearShare * extent) / used;
    } else {
        distance = std::max({x.distance, y.distance, nearest});
    }
    camera.target = center + x.center * axes.right() + y.center * axes.up();
    camera.eye = camera.target - distance * axes.forward();
}

}  // namespace

std::string_view view_name(StandardView view) {
    return kViewNames[static_cast<std::size_t>(view)];
}

std::optional<StandardView> find_view(std::string_view name) {
    const auto* const found = std::find(kViewNames.begin(), kViewNames.end(), name);
    if (found == kViewNames.end()) return std::nullopt;
    return static_cast<StandardView>(found - kViewNames.begin());
}

Camera frame_points(StandardView view, std::span<const Vec3> points,
                    const FramingOptions& options) {
    require_valid(points, options);
    const ViewAxes axes = axes_of(view);
    CameraOptions camera;
    camera.eye = to_world_up(axes.outward, options.up);
    camera.up = to_world_up(axes.up, options.up);
    camera.fov = options.fov;

    const Box box = box_of(points);
    const Camera direction(camera);
    std::vector<Vec3> local;
    local.reserve(points.size());
    for (const Vec3& p : points) {
        local.push_back(direction.to_camera(p - box.center() + camera.eye));
    }
    double extent = box.diagonal();
    if (extent == 0.0) {
        extent = kPointExtent;
        local = {Vec3(0.0, -0.5 * extent, 0.0), Vec3(0.0, 0.5 * extent, 0.0)};
    }
    fit_camera(camera, local, box.center(), extent, options);
    return Camera(camera);
}

Camera frame_box(StandardView view, const Box& box, const FramingOptions& options) {
    require(!box.empty(), "the bounding box is empty; give the camera explicitly");
    std::array<Vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        corners[i] = {(i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                      (i & 4 ? box.max : box.min).z()};
    }
    return frame_points(view, corners, options);
}

}  // namespace lissom
