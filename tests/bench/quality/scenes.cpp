#include "tests/bench/quality/scenes.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"

namespace lissom::bench {
namespace {

constexpr double kBarLength = 5.0, kBarWidth = 1.0;
constexpr Index kBarAlong = 171;

Move turn(const std::string& name, double degrees, const Vec3& axis, const Vec3& about) {
    return {name + " " + std::to_string(static_cast<int>(degrees)), degrees,
            [=](double share) { return rotation(axis, share * degrees * kDegree, about); }};
}

// The free part, from y = -half to half, becomes an arc towards +x.
Move bend_bar(double degrees, double half) {
    return {"bend " + std::to_string(static_cast<int>(degrees)), degrees, [=](double share) {
                const double angle = share * degrees * kDegree;
                if (angle == 0.0) return Affine{};
                const double radius = 2.0 * half / angle;
                const Vec3 end(radius * (1.0 - std::cos(angle)), radius * std::sin(angle) - half,
                               0.0);
                const Vec3 base(0.0, half, 0.0);
                return translation(end - base) * rotation(-Vec3::UnitZ(), angle, base);
            }};
}

// Parts of the armadillo, as shares of its bounding box and of the size of its surface.
const Vec3 kLeftHand(0.97, 0.83, 0.87), kRightHand(0.05, 0.86, 0.87), kHead(0.52, 0.82, 0.75);
constexpr double kHandRadius = 0.25, kSoles = 0.03;

enum class Role { free, still, moved };

// Tells vertices of a mesh by where they lie in its bounding box.
class Part {
  public:
    explicit Part(const Mesh& mesh)
        : mesh_(mesh), box_(bounds(mesh)), size_(surface_radius(mesh)) {}

    Vec3 point(const Vec3& share) const {
        return box_.min + share.cwiseProduct(box_.max - box_.min);
    }
    Vec3 share(Index v) const {
        return (mesh_.position(v) - box_.min).cwiseQuotient(box_.max - box_.min);
    }
    bool within(Index v, const Vec3& center, double radius) const {
        return (mesh_.position(v) - point(center)).norm() < radius * size_;
    }
    template <typename RoleOf>
    QualityScene scene(const std::string& name, const RoleOf& role_of) const {
        QualityScene scene{name, mesh_, {}, {}, {}};
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            const Role role = role_of(v);
            if (role == Role::still) scene.still.push_back(v);
            if (role == Role::moved) scene.moved.push_back(v);
        }
        return scene;
    }

  private:
    const Mesh& mesh_;
    Box box_;
    double size_;
};

std::vector<Move> arm_moves(const Part& part) {
    std::vector<Move> moves;
    for (const double angle : {60.0, 100.0, 150.0}) {
        moves.push_back(turn("raise", angle, Vec3::UnitZ(), part.point({0.70, 0.72, 0.5})));
    }
    return moves;
}

std::vector<Move> body_moves(const Part& part) {
    const Vec3 middle = part.point({0.5, 0.5, 0.5});
    return {turn("twist", 90.0, Vec3::UnitY(), middle), turn("bend", 60.0, Vec3::UnitX(), middle)};
}

}  // namespace

std::vector<Index> QualityScene::held() const {
    std::vector<Index> all = still;
    all.insert(all.end(), moved.begin(), moved.end());
    std::sort(all.begin(), all.end());
    return all;
}

QualityScene bar_scene() {
    BarOptions options;
    options.width = kBarWidth;
    options.length = kBarLength;
    options.across = 36;
    options.along = kBarAlong;
    QualityScene scene{"bar", make_bar(options), {}, {}, {}};
    triangulate(scene.mesh);
    const double half = (0.5 - 2.5 / kBarAlong) * kBarLength;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const double y = scene.mesh.position(v).y();
        if (y < -half) scene.still.push_back(v);
        if (y > half) scene.moved.push_back(v);
    }
    for (const double angle : {90.0, 135.0, 170.0, 270.0, 360.0}) {
        scene.moves.push_back(turn("twist", angle, Vec3::UnitY(), Vec3::Zero()));
    }
    for (const double angle : {90.0, 135.0, 180.0, 270.0}) {
        scene.moves.push_back(bend_bar(angle, half));
    }
    scene.moves.push_back({"sideways", 0.0, [](double share) {
                               return translation(Vec3(2.0 * share * kBarWidth, 0.0, 0.0));
                           }});
    return scene;
}

QualityScene arm_scene(const Mesh& armadillo) {
    const Part part(armadillo);
    QualityScene scene = part.scene("armadillo arm", [&](Index v) {
        if (part.within(v, kLeftHand, kHandRadius)) return Role::moved;
        const bool still = part.share(v).y() < kSoles || part.within(v, kRightHand, kHandRadius);
        return still ? Role::still : Role::free;
    });
    scene.moves = arm_moves(part);
    return scene;
}

QualityScene body_scene(const Mesh& armadillo) {
    const Part part(armadillo);
    QualityScene scene = part.scene("armadillo body", [&](Index v) {
        if (part.within(v, kHead, kHandRadius)) return Role::moved;
        return part.share(v).y() < kSoles ? Role::still : Role::free;
    });
    scene.moves = body_moves(part);
    return scene;
}

QualityScene small_arm_scene(const Mesh& armadillo) {
    const Part part(armadillo);
    QualityScene scene = part.scene("armadillo arm alone", [&](Index v) {
        if (part.within(v, kLeftHand, kHandRadius)) return Role::moved;
        return part.share(v).x() > 0.68 && part.share(v).y() > 0.55 ? Role::free : Role::still;
    });
    scene.moves = arm_moves(part);
    return scene;
}

QualityScene waist_scene(const Mesh& armadillo) {
    const Part part(armadillo);
    QualityScene scene = part.scene("armadillo waist", [&](Index v) {
        const Vec3 share = part.share(v);
        if (share.y() > 0.66) return Role::moved;
        const bool tail = share.z() < 0.28 && share.y() > 0.2;
        return share.y() < 0.35 && !tail ? Role::still : Role::free;
    });
    scene.moves = body_moves(part);
    return scene;
}

}  // namespace lissom::bench
