#include "kernel/deform/contact/spread_fans.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace lissom {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr Index kFanGrain = 2048;
// Fans of more faces are left to the exact test.
constexpr Index kFewFaces = 8, kMostFaces = 24;
// The least sine of a projected angle. Triangles at wider angles keep apart by far more than
// self_intersections takes for touching.
constexpr float kLeastSine = 0.02F;
// Shorter edges, as a share of the extent, lose their direction to rounding; and so do edges that
// are short beside others of the fan.
constexpr float kShortest = 1e-4F, kShortestOfFan = 2e-3F;

// The edges from a vertex to its neighbours, by coordinate, and their squared lengths. Behind the
// last one stands the first again, as often as there is room.
template <std::size_t kRoom>
struct Spokes {
    std::array<float, kRoom + 1> x, y, z, square;
};

// The faces around a vertex with at most kRoom neighbours.
template <std::size_t kRoom>
class Fan {
  public:
    Fan(const Topology& topology, const LocalShape& shape, Index v)
        : topology_(topology),
          shape_(shape),
          v_(v),
          count_(topology.neighbors(v).size()),
          face_count_(topology.faces_around(v).size()) {}

    bool is_spread() {
        if (!take_spokes()) return false;
        take_areas();
        return faces_look_up() && lies_in_one_turn() && polygons_are_convex();
    }

  private:
    bool take_spokes() {
        const std::span<const Index> ring = topology_.neighbors(v_);
        const LocalPoint& center = shape_.points[at(v_)];
        for (std::size_t i = 0; i <= kRoom; ++i) {
            const LocalPoint spoke = shape_.points[at(ring[i < count_ ? i : 0])] - center;
            spokes_.x[i] = spoke[0];
            spokes_.y[i] = spoke[1];
            spokes_.z[i] = spoke[2];
        }
        float shortest = std::numeric_limits<float>::max(), longest = 0.0F;
        for (std::size_t i = 0; i <= kRoom; ++i) {
            spokes_.square[i] = spokes_.x[i] * spokes_.x[i] + spokes_.y[i] * spokes_.y[i] +
                                spokes_.z[i] * spokes_.z[i];
            shortest = std::min(shortest, spokes_.square[i]);
            longest = std::max(longest, spokes_.square[i]);
        }
        const float least = kShortest * shape_.extent;
        return shortest > least * least && shortest > kShortestOfFan * kShortestOfFan * longest;
    }

    // Twice the areas of the triangles between neighbouring spokes, as vectors, and their sum.
    void take_areas() {
        const auto& [x, y, z, square] = spokes_;
        for (std::size_t i = 0; i < kRoom; ++i) {
            x_[i] = y[i] * z[i + 1] - z[i] * y[i + 1];
            y_[i] = z[i] * x[i + 1] - x[i] * z[i + 1];
            z_[i] = x[i] * y[i + 1] - y[i] * x[i + 1];
        }
        normal_.setZero();
        for (std::size_t i = 0; i < face_count_; ++i) normal_ += Vec3f(x_[i], y_[i], z_[i]);
    }

    // Whether all corners at the vertex are seen as turning left, by an angle to spare.
    bool faces_look_up() const {
        const float limit = kLeastSine * kLeastSine * normal_.squaredNorm();
        std::array<float, kRoom> along, spare;
        for (std::size_t i = 0; i < kRoom; ++i) {
            along[i] = x_[i] * normal_.x() + y_[i] * normal_.y() + z_[i] * normal_.z();
            spare[i] = along[i] * along[i] - limit * spokes_.square[i] * spokes_.square[i + 1];
        }
        float least = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < face_count_; ++i) {
            least = std::min(least, std::min(along[i], spare[i]));
        }
        return least > 0.0F;
    }

    // Whether the spokes, which turn left from one to the next, go round once at most. An open fan
    // leaves a quarter of a turn free.
    bool lies_in_one_turn() const {
        const Vec3f first(spokes_.x[0], spokes_.y[0], spokes_.z[0]);
        const Vec3f side = normal_.cross(first);
        int rounds = 0;
        bool is_below = false;
        for (std::size_t i = 1; i < count_; ++i) {
            const bool below = along(side, i) < 0.0F;
            if (is_below && !below) ++rounds;
            is_below = below;
        }
        if (face_count_ == count_) return is_below && rounds == 0;
        return rounds == 0 && !(is_below && along(side.cross(normal_), count_ - 1) > 0.0F);
    }

    float along(const Vec3f& direction, std::size_t i) const {
        return direction.dot(Vec3f(spokes_.x[i], spokes_.y[i], spokes_.z[i]));
    }

    bool polygons_are_convex() const {
        if (topology_.is_triangle_mesh()) return true;
        for (const Index f : topology_.faces_around(v_)) {
            const std::span<const Index> corners = topology_.face(f);
            if (corners.size() > 4 || (corners.size() == 4 && !is_convex(corners))) return false;
        }
        return true;
    }

    bool is_convex(std::span<const Index> quad) const {
        const float limit = kLeastSine * kLeastSine * normal_.squaredNorm();
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3f in = point(quad[(k + 1) % 4]) - point(quad[k]);
            const Vec3f out = point(quad[(k + 2) % 4]) - point(quad[(k + 1) % 4]);
            const float left = in.cross(out).dot(normal_);
            if (!(left > 0.0F && left * left > limit * in.squaredNorm() * out.squaredNorm())) {
                return false;
            }
        }
        return true;
    }

    Vec3f point(Index v) const { return shape_.points[at(v)].template head<3>().matrix(); }

    const Topology& topology_;
    const LocalShape& shape_;
    Index v_;
    std::size_t count_, face_count_;
    Spokes<kRoom> spokes_;
    std::array<float, kRoom> x_, y_, z_;
    Vec3f normal_;
};

bool is_spread(const Topology& topology, const LocalShape& shape, Index v) {
    const Index count = topology.valence(v);
    if (count < 2 || count > kMostFaces) return false;
    if (count <= kFewFaces) return Fan<kFewFaces>(topology, shape, v).is_spread();
    return Fan<kMostFaces>(topology, shape, v).is_spread();
}

}  // namespace

void find_spread_fans(const Topology& topology, const LocalShape& shape,
                      std::span<const Index> vertices, std::vector<char>& spread,
                      const Context& context) {
    context.parallel_for(0, count_of(vertices), kFanGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Index v = vertices[at(i)];
            spread[at(v)] = is_spread(topology, shape, v);
        }
    });
}

}  // namespace lissom
