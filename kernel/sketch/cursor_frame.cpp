#include "kernel/sketch/cursor_frame.h"

#include <limits>

namespace lissom {

CursorFrame::CursorFrame(const View& view, const Vec2& pixel, const PickScene::Object& object)
    : ortho_(view.camera.is_ortho()) {
    const Camera& camera = view.camera;
    scale_ = 1.0 / view.pixel_length(1.0);
    Mat3 shear = Mat3::Identity();
    const Vec2 from_middle(pixel.x() - 0.5 * view.size.width, 0.5 * view.size.height - pixel.y());
    if (ortho_) {
        shift_.head<2>() = from_middle / scale_;
    } else {
        shear.col(2).head<2>() = -from_middle / scale_;
    }
    Mat3 axes;
    axes << camera.right().transpose(), camera.up().transpose(), camera.forward().transpose();
    axes_ = shear * axes * object.to_world.linear;
    origin_ = object.to_local(camera.eye());
    backwards_ = -(object.to_local.linear * camera.forward());
}

Vec2 CursorFrame::min_pixels(const Box& box) const {
    const Vec3 center = from_ray(box.center());
    const Vec3 reach = axes_.cwiseAbs() * (0.5 * (box.max - box.min));
    const double farthest = center.z() + reach.z();
    if (!is_in_front(farthest)) return Vec2::Constant(std::numeric_limits<double>::infinity());
    const double scale = ortho_ ? scale_ : scale_ / farthest;
    return scale * (center.cwiseAbs() - reach).head<2>().cwiseMax(0.0);
}

Vec3 CursorFrame::to_eye(const Vec3& local) const {
    return ortho_ ? Vec3(from_ray(local).z() * backwards_) : Vec3(origin_ - local);
}

}  // namespace lissom
