#include "kernel/deform/levels/surface_binding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/frame_blocks.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/nearest_on_triangle.h"

namespace lissom {
namespace {

// Rounds in which shares are blended with those of the neighbours.
constexpr int kShareRounds = 2;
// Shares are whole multiples of this, so that they sum to 1 to the bit and motions that all have
// in common are kept.
constexpr double kShareUnit = 1.0 / (1 << 20);

// A few vertices with their shares, in the making.
class Shares {
  public:
    void add(Index vertex, double share) {
        for (std::size_t k = 0; k < count_; ++k) {
            if (entry_[k].second != vertex) continue;
            entry_[k].first += share;
            return;
        }
        if (count_ < entry_.size()) entry_[count_++] = {share, vertex};
    }
    void add(const SurfaceFollow& follow, double share) {
        for (std::size_t k = 0; k < SurfaceFollow::kMost && follow.share[k] > 0.0F; ++k) {
            add(follow.vertex[k], share * double(follow.share[k]));
        }
    }

    // The greatest ones, in whole units.
    SurfaceFollow rounded() {
        const auto end = entry_.begin() + std::ptrdiff_t(count_);
        std::sort(entry_.begin(), end, [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        const std::size_t kept = std::min(count_, SurfaceFollow::kMost);
        double sum = 0.0, left = 1.0;
        for (std::size_t k = 0; k < kept; ++k) sum += entry_[k].first;
        SurfaceFollow follow;
        for (std::size_t k = 1; k < kept; ++k) {
            const double share = std::floor(entry_[k].first / sum / kShareUnit) * kShareUnit;
            if (!(share > 0.0)) break;
            follow.vertex[k] = entry_[k].second;
            follow.share[k] = static_cast<float>(share);
            left -= share;
        }
        follow.vertex[0] = entry_[0].second;
        follow.share[0] = static_cast<float>(left);
        return follow;
    }

  private:
    std::array<std::pair<double, Index>, 64> entry_;
    std::size_t count_ = 0;
};

// The nearest triangle of those around a vertex and around the corners of the nearest of them.
class NearestCorners {
  public:
    NearestCorners(const Mesh& thinned, Index onto, const Vec3& p) : thinned_(thinned), p_(p) {
        look_around(onto);
        const Index first = best_;
        if (first == kNoIndex) return;
        for (const Index v : thinned.topology().face(first)) {
            if (v != onto) look_around(v);
        }
    }

    SurfaceFollow shares() const {
        Shares shares;
        if (best_ == kNoIndex) return {};
        const std::span<const Index> face = thinned_.topology().face(best_);
        for (int k = 0; k < 3; ++k) shares.add(face[at(k)], found_.barycentric[k]);
        return shares.rounded();
    }

  private:
    void look_around(Index v) {
        for (const Index f : thinned_.topology().faces_around(v)) {
            const std::span<const Index> face = thinned_.topology().face(f);
            const PointOfTriangle found =
                nearest_on_triangle({thinned_.position(face[0]), thinned_.position(face[1]),
                                     thinned_.position(face[2])},
                                    p_);
            if (best_ != kNoIndex && !(found.squared_distance < found_.squared_distance)) continue;
            found_ = found;
            best_ = f;
        }
    }

    const Mesh& thinned_;
    const Vec3& p_;
    Index best_ = kNoIndex;
    PointOfTriangle found_{};
};

SurfaceFollow blended(const Topology& topology, std::span<const SurfaceFollow> follows, Index v) {
    const std::span<const Index> ring = topology.neighbors(v);
    Shares shares;
    shares.add(follows[at(v)], 0.5);
    for (const Index n : ring) shares.add(follows[at(n)], 0.5 / double(ring.size()));
    return shares.rounded();
}

// Sum over the edges around a vertex of (edge now) (edge before)^T, and its normals: the rotation
// nearest to it fits the edges best.
Mat3 turned_edges(const Mesh& rest, std::span<const Vec3> moved, Index v) {
    Mat3 sum = Mat3::Zero();
    Vec3 before = Vec3::Zero(), now = Vec3::Zero();
    double square = 0.0;
    const std::span<const Index> ring = rest.topology().neighbors(v);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Index n = ring[i], next = ring[(i + 1) % ring.size()];
        const Vec3 rest_edge = rest.position(n) - rest.position(v);
        const Vec3 edge = moved[at(n)] - moved[at(v)];
        sum += edge * rest_edge.transpose();
        square += rest_edge.squaredNorm();
        if (i + 1 == ring.size() && rest.topology().is_boundary(v)) break;
        before += rest_edge.cross(rest.position(next) - rest.position(v));
        now += edge.cross(moved[at(next)] - moved[at(v)]);
    }
    const double lengths = before.norm() * now.norm();
    if (lengths > 0.0) sum += square / lengths * (now * before.transpose());
    return sum;
}

double edge_scale(const Mesh& rest, std::span<const Vec3> moved, Index v) {
    double before = 0.0, now = 0.0;
    for (const Index n : rest.topology().neighbors(v)) {
        before += (rest.position(n) - rest.position(v)).squaredNorm();
        now += (moved[at(n)] - moved[at(v)]).squaredNorm();
    }
    return before > 0.0 ? std::sqrt(now / before) : 1.0;
}

}  // namespace

std::vector<SurfaceFollow> bind_surface(const Mesh& triangles, const ThinnedSurface& thinned,
                                        const Context& context) {
    const Topology& topology = triangles.topology();
    std::vector<SurfaceFollow> follows(at(triangles.vertex_count())), next;
    for_each_part(context, triangles.vertex_count(), [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            const Index onto = thinned.onto[at(v)];
            if (onto == kNoIndex) continue;
            follows[at(v)] = NearestCorners(thinned.mesh, onto, triangles.position(v)).shares();
        }
    });
    for (int round = 0; round < kShareRounds; ++round) {
        next = follows;
        for_each_part(context, triangles.vertex_count(), [&](Index begin, Index end) {
            for (Index v = begin; v < end; ++v) {
                if (thinned.onto[at(v)] == kNoIndex) continue;
                next[at(v)] = blended(topology, follows, v);
            }
        });
        follows.swap(next);
    }
    return follows;
}

std::vector<Affine> surface_motions(const Mesh& thinned, std::span<const Vec3> moved, bool scales,
                                    const Context& context) {
    std::vector<Affine> motions(at(thinned.vertex_count()));
    for_each_part(context, thinned.vertex_count(), [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            Mat3 linear = nearest_rotation(turned_edges(thinned, moved, v));
            if (scales) linear *= edge_scale(thinned, moved, v);
            motions[at(v)] = {linear, moved[at(v)] - linear * thinned.position(v)};
        }
    });
    return motions;
}

}  // namespace lissom
