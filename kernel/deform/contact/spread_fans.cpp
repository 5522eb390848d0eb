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

// The faces around a vertex with at most kRoom neighbours. Rows have a number for each of its
// edges, from the vertex to its neighbours; behind the last stands the first again.
template <int kRoom>
class Fan {
  public:
    Fan(const Topology& topology, const LocalShape& shape, Index v)
        : topology_(topology),
          shape_(shape),
          v_(v),
          count_(topology.valence(v)),
          face_count_(count_of(topology.faces_around(v))) {}

    bool is_spread() {
        take_edges();
        if (!edges_are_long()) return false;
        take_areas();
        return faces_look_up() && lies_in_one_turn() && quads_lie_between_edges();
    }

  private:
    using Row = Eigen::Array<float, kRoom, 1>;
    using Edges = std::array<float, at(kRoom) + 1>;

    static Eigen::Map<const Row> row(const Edges& edges) {
        return Eigen::Map<const Row>(edges.data());
    }
    // The same of the next edge.
    static Eigen::Map<const Row> next(const Edges& edges) {
        return Eigen::Map<const Row>(edges.data() + 1);
    }

    void take_edges() {
        const std::span<const Index> ring = topology_.neighbors(v_);
        const LocalPoint& center = shape_.points[at(v_)];
        for (std::size_t i = 0; i <= at(kRoom); ++i) {
            const LocalPoint edge = shape_.points[at(ring[i < ring.size() ? i : 0])] - center;
            x_[i] = edge[0];
            y_[i] = edge[1];
            z_[i] = edge[2];
        }
        square_ = row(x_).square() + row(y_).square() + row(z_).square();
    }

    bool edges_are_long() const {
        const float shortest = square_.minCoeff(), longest = square_.maxCoeff();
        const float least = kShortest * shape_.extent;
        return shortest > least * least && shortest > kShortestOfFan * kShortestOfFan * longest;
    }

    // Twice the areas of the triangles between neighbouring edges, as vectors, and their sum.
    void take_areas() {
        area_x_ = row(y_) * next(z_) - row(z_) * next(y_);
        area_y_ = row(z_) * next(x_) - row(x_) * next(z_);
        area_z_ = row(x_) * next(y_) - row(y_) * next(x_);
        normal_ = Vec3f(area_x_.sum(), area_y_.sum(), area_z_.sum());
        if (face_count_ == count_) return;
        // From the last edge to the first there is no face.
        const Index gap = count_ - 1;
        normal_ -= Vec3f(area_x_[gap], area_y_[gap], area_z_[gap]);
    }

    // Whether all corners at the vertex are seen as turning left, by an angle to spare.
    bool faces_look_up() const {
        const float limit = kLeastSine * kLeastSine * normal_.squaredNorm();
        const Row along = area_x_ * normal_.x() + area_y_ * normal_.y() + area_z_ * normal_.z();
        std::array<float, at(kRoom) + 1> squares;
        for (std::size_t i = 0; i <= at(kRoom); ++i)
            squares[i] = square_[i < at(count_) ? index_of(i) : 0];
        const Row spare = along.square() - limit * square_ * next(squares);
        const Row least = along.min(spare);
        float of_faces = least[0];
        for (Index i = 1; i < face_count_; ++i) of_faces = std::min(of_faces, least[i]);
        return of_faces > 0.0F;
    }

    // Whether the edges, which turn left from one to the next, go round once at most. An open fan
    // leaves a quarter of a turn free.
    bool lies_in_one_turn() const {
        const Vec3f side = normal_.cross(edge(0));
        const Row across = row(x_) * side.x() + row(y_) * side.y() + row(z_) * side.z();
        int rounds = 0;
        bool is_below = false;
        for (Index i = 1; i < count_; ++i) {
            const bool below = across[i] < 0.0F;
            rounds += is_below && !below;
            is_below = below;
        }
        if (face_count_ == count_) return is_below && rounds == 0;
        const std::size_t last = at(count_ - 1);
        const float ahead = side.cross(normal_).dot(edge(last));
        return rounds == 0 && !(is_below && ahead > 0.0F);
    }

    // Whether each quad is seen between its two edges at the vertex; larger polygons are not asked.
    bool quads_lie_between_edges() const {
        if (topology_.is_triangle_mesh()) return true;
        const std::span<const Index> faces = topology_.faces_around(v_);
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const std::span<const Index> corners = topology_.face(faces[i]);
            if (corners.size() > 4) return false;
            if (corners.size() == 4 && !lies_between_edges(opposite(corners), i)) return false;
        }
        return true;
    }

    Index opposite(std::span<const Index> quad) const {
        const auto own = std::find(quad.begin(), quad.end(), v_) - quad.begin();
        return quad[at((index_of(own) + 2) % 4)];
    }

    bool lies_between_edges(Index v, std::size_t i) const {
        const Vec3f across =
            (shape_.points[at(v)] - shape_.points[at(v_)]).template head<3>().matrix();
        return turns_left(edge(i), across) && turns_left(across, edge(i + 1));
    }

    bool turns_left(const Vec3f& from, const Vec3f& to) const {
        const float left = from.cross(to).dot(normal_);
        const float limit = kLeastSine * kLeastSine * normal_.squaredNorm();
        return left > 0.0F && left * left > limit * from.squaredNorm() * to.squaredNorm();
    }

    Vec3f edge(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }

    const Topology& topology_;
    const LocalShape& shape_;
    Index v_, count_, face_count_;
    Edges x_, y_, z_;
    Row square_, area_x_, area_y_, area_z_;
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
