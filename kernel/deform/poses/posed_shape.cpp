#include "kernel/deform/poses/posed_shape.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// Between these angles shifts across the axis fade from screws to straight lines: the axis of a
// full turn lies at infinity.
constexpr double kScrewEnd = 200.0 * kDegree, kLineBegin = 280.0 * kDegree;

// A triangle that moves by this fraction of its component's motion counts half as one that stays.
constexpr double kCalmFraction = 0.01;

constexpr Index kEdgeGrain = 1024;

// The screw that turns by `turn` and takes a point along by `shift`.
Screw full_screw(const Vec3& turn, const Vec3& shift) {
    const double angle = turn.norm();
    if (!(angle > 0.0)) return {turn, shift, Vec3::Zero()};
    const Vec3 axis = turn / angle, along = axis.dot(shift) * axis;
    const double part = 1.0 - smooth_step((angle - kScrewEnd) / (kLineBegin - kScrewEnd));
    Screw screw{turn, along, Vec3::Zero()};
    if (part > 0.0) {
        Mat3 path;
        for (Index k = 0; k < 3; ++k) path.col(k) = Screw{turn, Vec3::Unit(k)}.shift(1.0);
        screw.velocity += part * (path.inverse() * (shift - along));
    }
    screw.remainder = shift - screw.shift(1.0);
    return screw;
}

Vec3 center_of(const Triangle& triangle, std::span<const Vec3> positions) {
    return (positions[at(triangle[0])] + positions[at(triangle[1])] + positions[at(triangle[2])]) /
           3.0;
}

Vec3 shift_of(const Triangle& triangle, std::span<const Vec3> from, std::span<const Vec3> to) {
    Vec3 shift = Vec3::Zero();
    for (const Index v : triangle) shift += to[at(v)] - from[at(v)];
    return shift / 3.0;
}

// The shift of a triangle's centre in a sum of shapes.
Vec3 blended_shift(Index t, const Triangle& triangle, std::span<const Vec3> rest,
                   std::span<const ShapeShare> shares) {
    Screw sum;
    for (const auto& [shape, share] : shares) {
        const Screw screw =
            full_screw(shape->turns[at(t)].turn, shift_of(triangle, rest, shape->positions));
        sum.turn += share * screw.turn;
        sum.velocity += share * screw.velocity;
        sum.remainder += share * screw.remainder;
    }
    return sum.shift(1.0) + sum.remainder;
}

// The greatest squared motion of a triangle's centre.
double squared_motion(const Triangle& triangle, std::span<const Vec3> rest,
                      std::span<const ShapeShare> shares) {
    double motion = 0.0;
    for (const auto& [shape, share] : shares) {
        motion = std::max(motion, shift_of(triangle, rest, shape->positions).squaredNorm());
    }
    return motion;
}

double area_of(const TriangleEdges& edges) {
    return edges.first.cross(edges.second).norm();
}

}  // namespace

std::size_t PosedShape::memory_bytes() const {
    return positions.size() * sizeof(Vec3) + turns.size() * sizeof(SurfaceTurn) +
           stretches.size() * sizeof(TriangleEdges);
}

PosedShape posed_shape(const PoseTriangles& triangles, std::span<const Vec3> rest,
                       std::vector<Vec3> positions, std::span<const SurfaceTurn> before,
                       const Context& context) {
    PosedShape shape;
    shape.turns = surface_turns(triangles, rest, positions, before, context);
    shape.stretches.resize(triangles.triangles.size());
    context.parallel_for(0, count_of(shape.stretches), kEdgeGrain, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            const Triangle& triangle = triangles.triangles[at(t)];
            const TriangleEdges from = edges_of(triangle, rest), to = edges_of(triangle, positions);
            const Mat3 back = shape.turns[at(t)].rotation().transpose();
            shape.stretches[at(t)] = {back * to.first - from.first, back * to.second - from.second};
        }
    });
    shape.positions = std::move(positions);
    return shape;
}

void blend_edges(const PoseTriangles& triangles, std::span<const Vec3> rest,
                 std::span<const ShapeShare> shares, std::vector<TriangleEdges>& edges,
                 const Context& context) {
    edges.resize(triangles.triangles.size());
    const auto blend = [&](Index t) {
        TriangleEdges sum = edges_of(triangles.triangles[at(t)], rest);
        SurfaceTurn turn;
        for (const auto& [shape, share] : shares) {
            turn.turn += share * shape->turns[at(t)].turn;
            turn.local += share * shape->turns[at(t)].local;
            sum.first += share * shape->stretches[at(t)].first;
            sum.second += share * shape->stretches[at(t)].second;
        }
        const Mat3 rotation = turn.rotation();
        edges[at(t)] = {rotation * sum.first, rotation * sum.second};
    };
    context.parallel_for(0, count_of(edges), kEdgeGrain, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) blend(t);
    });
}

void place_floating(const PoseTriangles& triangles, std::span<const Index> component_of_vertex,
                    std::span<const char> floats, std::span<const Vec3> rest,
                    std::span<const ShapeShare> shares, std::vector<FloatingSum>& sums,
                    std::span<Vec3> positions) {
    sums.assign(floats.size(), {});
    const auto for_each_triangle = [&](const auto& use) {
        for (Index t = 0; t < triangles.surface_count(); ++t) {
            const Triangle& triangle = triangles.triangles[at(t)];
            const Index component = component_of_vertex[at(triangle[0])];
            if (floats[at(component)]) use(t, triangle, sums[at(component)]);
        }
    };
    for_each_triangle([&](Index, const Triangle& triangle, FloatingSum& sum) {
        const double area = area_of(edges_of(triangle, rest));
        sum.area += area;
        sum.motion += area * squared_motion(triangle, rest, shares);
    });
    for_each_triangle([&](Index t, const Triangle& triangle, FloatingSum& sum) {
        const double mean = sum.area > 0.0 ? sum.motion / sum.area : 0.0;
        const double calm = kCalmFraction * kCalmFraction * mean;
        const double motion = squared_motion(triangle, rest, shares) + calm;
        // Without area, or motion, all triangles count the same.
        const double area = sum.area > 0.0 ? area_of(edges_of(triangle, rest)) / sum.area : 1.0;
        const double weight = motion > 0.0 ? area * mean / motion : area;
        const Vec3 goal = center_of(triangle, rest) + blended_shift(t, triangle, rest, shares);
        sum.weight += weight;
        sum.shift += weight * (goal - center_of(triangle, positions));
    });
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const FloatingSum& sum = sums[at(triangles.base[at(component_of_vertex[v])])];
        if (sum.weight > 0.0) positions[v] += sum.shift / sum.weight;
    }
}

}  // namespace lissom
