// What a refinement may not do: fold the surface, dig a moat beside a handle, or flare its rim.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

/// A surface with a still handle and a moved one.
struct Pose {
    std::string name;
    Mesh mesh;
    std::vector<Index> still, moved;
    Affine move;
};

template <typename Where>
std::vector<Index> vertices_where(const Mesh& mesh, const Where& where) {
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (where(mesh.position(v))) vertices.push_back(v);
    }
    return vertices;
}

std::vector<Vec3> solved(const Pose& pose, LocalSize size, int refine) {
    DeformOptions options;
    options.local_size = size;
    options.refine = refine;
    const auto topology = pose.mesh.shared_topology();
    Deformer deformer(pose.mesh, Region::all(topology), options);
    deformer.add_handle(Region(topology, pose.still));
    const HandleId moved = deformer.add_handle(Region(topology, pose.moved));
    deformer.set_transform(moved, pose.move, deformer.handle_center(moved));
    return deformer.solve();
}

Pose plate(double scale, double lift) {
    Pose pose{"plate", make_grid({{2.0, 2.0}, {40, 40}}), {}, {}, {}};
    pose.still =
        vertices_where(pose.mesh, [](const Vec3& p) { return p.cwiseAbs().maxCoeff() > 0.94; });
    pose.moved = vertices_where(pose.mesh, [](const Vec3& p) { return p.norm() < 0.3; });
    pose.move = translation(lift * Vec3::UnitY()) * scaling(Vec3::Constant(scale), Vec3::Zero());
    return pose;
}

Pose ball(double scale, double lift) {
    Pose pose{"ball", make_sphere({1.0, 24}), {}, {}, {}};
    pose.still = vertices_where(pose.mesh, [](const Vec3& p) { return p.y() < -0.5; });
    pose.moved = vertices_where(pose.mesh, [](const Vec3& p) { return p.y() > 0.93; });
    pose.move = translation(lift * Vec3::UnitY()) * scaling(Vec3::Constant(scale), Vec3::Zero());
    return pose;
}

/// How far the free vertices reach: down, to the centre, and from the axis.
struct Reach {
    double lowest = 1e300, nearest = 1e300, widest = 0.0;
};

Reach reach_of(const Pose& pose, const std::vector<Vec3>& x) {
    Reach reach;
    for (Index v = 0; v < pose.mesh.vertex_count(); ++v) {
        if (std::binary_search(pose.still.begin(), pose.still.end(), v)) continue;
        if (std::binary_search(pose.moved.begin(), pose.moved.end(), v)) continue;
        reach.lowest = std::min(reach.lowest, x[v].y());
        reach.nearest = std::min(reach.nearest, x[v].norm());
        reach.widest = std::max(reach.widest, std::hypot(x[v].x(), x[v].z()));
    }
    return reach;
}

// In radii; without the guard these rims flared by 0.21, and 0.32 where the handle trebles.
constexpr double kSlack = 0.03;

}  // namespace

TEST_CASE("refine: no moat beside a handle that grows, and no flare of its rim") {
    for (const LocalSize size : {LocalSize::keep, LocalSize::scale}) {
        for (const double scale : {0.5, 1.5, 2.0, 3.0}) {
            for (const Pose& pose : {plate(scale, 0.0), ball(scale, 0.0)}) {
                CAPTURE(pose.name);
                CAPTURE(scale);
                const Reach without = reach_of(pose, solved(pose, size, 0));
                for (int refine = 1; refine <= 2; ++refine) {
                    const Reach with = reach_of(pose, solved(pose, size, refine));
                    CHECK(with.lowest > without.lowest - kSlack);
                    CHECK(with.nearest > without.nearest - kSlack);
                    CHECK(with.widest < without.widest + kSlack);
                }
            }
        }
    }
}

TEST_CASE("refine: the surface does not run through itself where without it does not") {
    int sound = 0;
    for (const double degrees : {120.0, 180.0, 270.0}) {
        CAPTURE(degrees);
        Pose pose{"bar", make_bar({1.0, 4.0, 6, 24}), {}, {}, {}};
        const Box box = bounds(pose.mesh);
        pose.still =
            vertices_where(pose.mesh, [&](const Vec3& p) { return p.y() < box.min.y() + 1.3; });
        pose.moved =
            vertices_where(pose.mesh, [&](const Vec3& p) { return p.y() > box.max.y() - 1.3; });
        for (const Vec3& axis : {Vec3(Vec3::UnitY()), Vec3(Vec3::UnitX())}) {
            pose.move = rotation(axis, degrees * kPi / 180.0, Vec3::Zero());
            const auto crossings = [&](int refine) {
                Mesh mesh = pose.mesh;
                mesh.set_positions(solved(pose, LocalSize::keep, refine));
                return self_intersections(mesh).size();
            };
            const std::size_t plain = crossings(0);
            if (plain > 0) continue;
            ++sound;
            CHECK(crossings(1) == 0);
            CHECK(crossings(2) == 0);
        }
    }
    CHECK(sound > 0);
}
