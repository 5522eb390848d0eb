#include "kernel/sketch/visibility.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace lissom {

Visibility::Visibility(const PickScene& scene, const View& view, bool back_faces)
    : scene_(scene), view_(view), back_faces_(back_faces) {
    frames_.reserve(scene.objects().size());
    for (const PickScene::Object& object : scene.objects()) {
        frames_.emplace_back(view, Vec2::Zero(), object);
    }
}

bool Visibility::is_hidden(Index object, const Vec3& local, double slack) const {
    const Vec3 world = scene_.object(object).to_world(local);
    const double depth = view_.camera.to_camera(world).z();
    const double way = view_.camera.is_ortho() ? depth : (view_.camera.eye() - world).norm();
    // Rounding error of a point on its way from one frame to another.
    const double rounding = 16.0 * std::numeric_limits<double>::epsilon();
    for (Index i = 0; i < count_of(frames_); ++i) {
        const PickScene::Object& other = scene_.object(i);
        if (!other.surface) continue;
        const Vec3 point = i == object ? local : other.to_local(world);
        const Vec3 towards = frames_[at(i)].to_eye(point);
        HideOptions hide{.eye = towards.norm(), .back_faces = back_faces_};
        if (!(hide.eye > 0.0 && way > 0.0)) continue;
        hide.slack = slack / way * hide.eye;
        if (i != object) {
            const double reach = world.norm() + other.to_world.translation.norm();
            hide.touching = rounding * reach * other.to_local.linear.norm();
        }
        if (other.surface->hides(point, towards, hide)) return true;
    }
    return false;
}

bool Visibility::faces_eye(Index object, Index face, std::span<const Index> vertices) const {
    const SpatialTree& surface = *scene_.object(object).surface;
    const auto turned_to_eye = [&](const Triangle& t) {
        const Vec3 a = surface.positions()[at(t[0])], b = surface.positions()[at(t[1])],
                   c = surface.positions()[at(t[2])];
        return frames_[at(object)].to_eye(a).dot((b - a).cross(c - a)) > 0.0;
    };
    const auto corners = surface.topology().face(face);
    if (corners.size() == 3) return turned_to_eye({corners[0], corners[1], corners[2]});
    const auto triangles = triangles_with(surface, face, vertices);
    return std::any_of(triangles.begin(), triangles.end(), turned_to_eye);
}

bool Visibility::vertex_faces_eye(Index object, Index v) const {
    const auto faces = scene_.object(object).surface->topology().faces_around(v);
    return std::any_of(faces.begin(), faces.end(),
                       [&](Index f) { return faces_eye(object, f, std::span(&v, 1)); });
}

std::vector<Triangle> triangles_with(const SpatialTree& surface, Index face,
                                     std::span<const Index> vertices) {
    auto triangles =
        triangulate_faces(surface.topology(), surface.positions(), std::span(&face, 1)).triangles;
    std::erase_if(triangles, [&](const Triangle& t) {
        return std::any_of(vertices.begin(), vertices.end(),
                           [&](Index v) { return std::find(t.begin(), t.end(), v) == t.end(); });
    });
    return triangles;
}

Vec3 face_vector(const SpatialTree& surface, Index face) {
    const auto corners = surface.topology().face(face);
    const auto position = [&](std::size_t k) { return surface.positions()[at(corners[k])]; };
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        sum += (position(k) - position(0)).cross(position(k + 1) - position(0));
    }
    return 0.5 * sum;
}

}  // namespace lissom
