#include "kernel/deform/poses/turn_field.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// A rotation vector may change by this many times the angle between two rotations. It changes by
// more near full turns, whose axis is in doubt.
constexpr double kMaxAmplification = 4.0;
constexpr double kNoChange = 1e-9;

// Ranks pairs with a flat triangle behind all others, whose squared distance is at most 8.
constexpr double kFlatCost = 100.0;

constexpr Index kTriangleGrain = 1024;

Vec3 least_turn(const Mat3& rotation) {
    return turn_near(rotation, Vec3::Zero());
}

// Goes on from a rotation to a near one.
SurfaceTurn gone_on(const SurfaceTurn& from, const Mat3& to) {
    const Vec3 step = least_turn(to * from.rotation().transpose());
    const Vec3 nearest = turn_near(to, from.turn);
    const double change = (nearest - from.turn).norm();
    if (change <= kMaxAmplification * step.norm() + kNoChange || from.turn.isZero(0.0)) {
        return {nearest, Vec3::Zero()};
    }
    const Vec3 axis = from.turn.normalized();
    const Vec3 turn = from.turn + axis.dot(step) * axis;
    return {turn, least_turn(rotation_of_turn(turn).transpose() * to)};
}

class TurnWalk {
  public:
    TurnWalk(const PoseTriangles& triangles, std::span<const Vec3> rest,
             std::span<const Vec3> posed, std::span<const SurfaceTurn> before,
             const Context& context)
        : triangles_(triangles),
          before_(before),
          rotation_(triangles.triangles.size(), Mat3::Identity()),
          is_flat_(triangles.triangles.size(), 0),
          is_done_(triangles.triangles.size(), 0),
          turn_(triangles.triangles.size()) {
        context.parallel_for(0, triangles.surface_count(), kTriangleGrain,
                             [&](Index begin, Index end) {
                                 for (Index t = begin; t < end; ++t) find_rotation(t, rest, posed);
                             });
    }

    std::vector<SurfaceTurn> run(const Context& context) {
        for (const Index seed : seeds()) {
            if (is_done_[at(seed)]) continue;
            context.checkpoint();
            walk_from(seed);
        }
        const Index first_link = triangles_.surface_count();
        for (Index i = 0; i < count_of(triangles_.hosts); ++i) {
            turn_[at(first_link + i)] = turn_[at(triangles_.hosts[at(i)])];
        }
        return std::move(turn_);
    }

  private:
    struct Step {
        double cost;
        Index to, from;
        bool operator<(const Step& other) const {
            return std::tie(other.cost, other.to, other.from) < std::tie(cost, to, from);
        }
    };

    void find_rotation(Index t, std::span<const Vec3> rest, std::span<const Vec3> posed) {
        const TriangleEdges before = edges_of(triangles_.triangles[at(t)], rest);
        const TriangleEdges after = edges_of(triangles_.triangles[at(t)], posed);
        is_flat_[at(t)] = is_flat(before) || is_flat(after);
        if (is_flat_[at(t)]) return;
        rotation_[at(t)] = nearest_rotation(edge_frame(after) * edge_frame(before).inverse());
    }

    SurfaceTurn before(Index t) const { return before_.empty() ? SurfaceTurn{} : before_[at(t)]; }

    // All triangles, those first that turn least, flat ones last.
    std::vector<Index> seeds() const {
        std::vector<double> cost;
        for (Index t = 0; t < triangles_.surface_count(); ++t) {
            cost.push_back(is_flat_[at(t)]
                               ? kFlatCost
                               : (rotation_[at(t)] - before(t).rotation()).squaredNorm());
        }
        std::vector<Index> order(cost.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
                         [&](Index a, Index b) { return cost[at(a)] < cost[at(b)]; });
        return order;
    }

    void walk_from(Index seed) {
        take(seed, before(seed));
        while (!open_.empty()) {
            const Step step = open_.top();
            open_.pop();
            if (!is_done_[at(step.to)]) take(step.to, turn_[at(step.from)]);
        }
    }

    void take(Index t, const SurfaceTurn& from) {
        turn_[at(t)] = is_flat_[at(t)] ? from : gone_on(from, rotation_[at(t)]);
        is_done_[at(t)] = 1;
        for (const Index next : triangles_.neighbor[at(t)]) {
            if (next == kNoIndex || is_done_[at(next)]) continue;
            const bool flat = is_flat_[at(t)] || is_flat_[at(next)];
            const double distance = (rotation_[at(t)] - rotation_[at(next)]).squaredNorm();
            open_.push({flat ? kFlatCost : distance, next, t});
        }
    }

    const PoseTriangles& triangles_;
    std::span<const SurfaceTurn> before_;
    std::vector<Mat3> rotation_;
    std::vector<char> is_flat_, is_done_;
    std::vector<SurfaceTurn> turn_;
    std::priority_queue<Step> open_;
};

}  // namespace

Mat3 SurfaceTurn::rotation() const {
    return rotation_of_turn(turn) * rotation_of_turn(local);
}

std::vector<SurfaceTurn> surface_turns(const PoseTriangles& triangles, std::span<const Vec3> rest,
                                       std::span<const Vec3> posed,
                                       std::span<const SurfaceTurn> before,
                                       const Context& context) {
    return TurnWalk(triangles, rest, posed, before, context).run(context);
}

}  // namespace lissom
