#include "kernel/merge/paste/part/draped_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/merge/turned.h"

namespace lissom {
namespace {

// The step of differences, in radii.
constexpr double kDrapeStep = 1e-3;
// Edges of the ground are softer the higher a point is, so that they do not cut the faces of a foot
// into teeth: the radius of the circle that is looked at, in heights, and its points.
constexpr double kSoftness = 0.6;
constexpr int kAround = 6;
// Edges of the part up to this height, in radii, are lifted if they cut into the ground, so often
// at most, and by no more than this.
constexpr double kLowEdge = 0.3, kMaxLift = 0.3, kMinLift = 1e-4;
constexpr int kLifts = 4;
// Ground that stands higher, in radii, is no part of a corner.
constexpr double kHighestGround = 1.0;

Vec3 mean_point(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
}

std::vector<Vec3> loop_points(const PastePart& part) {
    std::vector<Vec3> points;
    for (const Index v : part.loop) points.push_back(part.mesh.position(v));
    return points;
}

// The direction that a closed line of points runs around counter-clockwise.
Vec3 axis_of(std::span<const Vec3> loop, const Vec3& middle) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < loop.size(); ++k) {
        sum += (loop[k] - middle).cross(loop[(k + 1) % loop.size()] - middle);
    }
    return sum.stableNormalized();
}

// For each point of a closed line half of the way between its neighbours.
std::vector<double> lengths_of(std::span<const Vec3> loop) {
    std::vector<double> lengths;
    const std::size_t n = loop.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &before = loop[(k + n - 1) % n], &after = loop[(k + 1) % n];
        lengths.push_back(0.5 * ((loop[k] - before).norm() + (after - loop[k]).norm()));
    }
    return lengths;
}

bool has_directions(const Mesh& mesh) {
    const auto& all = mesh.attributes().all();
    return std::any_of(all.begin(), all.end(), [](const Attribute& attribute) {
        const AttributeRole role = role_of(attribute);
        return role == AttributeRole::normal || role == AttributeRole::tangent;
    });
}

}  // namespace

Vec3 loop_axis(const PastePart& part) {
    const std::vector<Vec3> loop = loop_points(part);
    return axis_of(loop, mean_point(loop));
}

std::vector<double> heights_over_boundary(const PastePart& part) {
    PasteSimilarity same;
    const Drape drape(part, loop_points(part), same, 1.0);
    std::vector<double> heights;
    for (const Vec3& p : part.mesh.positions()) {
        heights.push_back(drape.tip() < 0.0 ? -drape.height_at(p) : drape.height_at(p));
    }
    return heights;
}

Drape::Drape(const PastePart& part, std::span<const Vec3> images, const PasteSimilarity& similarity,
             double scale, Ground ground)
    : part_(part), similarity_(similarity), scale_(scale) {
    const std::vector<Vec3> loop = loop_points(part);
    from_ = mean_point(loop);
    to_ = mean_point(images);
    axis_ = similarity.rotation * axis_of(loop, from_);
    for (const Vec3& p : images) radius_ += (p - to_).norm() / static_cast<double>(images.size());
    for (const Vec3& p : loop) rim_.push_back(stood(p));
    length_ = lengths_of(rim_);
    measure_heights();
    stand(images);
    ground_ = std::move(ground);
    clear_ground();
    for (std::size_t k = 0; k < rim_.size(); ++k) {
        lack_[k] -= sunk(rim_[k]) * axis_;
    }
}

// The tip's height, with the boundary where it is.
void Drape::measure_heights() {
    lack_.assign(rim_.size(), Vec3::Zero());
    for (const Vec3& p : part_.mesh.positions()) {
        const double height = foot_at(stood(p)).height;
        if (std::abs(height) > std::abs(tip_)) tip_ = height;
    }
}

void Drape::raise(double height, std::span<const Vec3> images) {
    to_ += height * axis_;
    for (std::size_t k = 0; k < rim_.size(); ++k) {
        rim_[k] += height * axis_;
        lack_[k] = images[k] - rim_[k];
    }
}

// Moves the part along its axis until its boundary touches: a dent from below, all else from above.
void Drape::stand(std::span<const Vec3> images) {
    images_.assign(images.begin(), images.end());
    double most = (images[0] - rim_[0]).dot(axis_);
    for (std::size_t k = 1; k < rim_.size(); ++k) {
        const double above = (images[k] - rim_[k]).dot(axis_);
        most = tip_ < 0.0 ? std::min(most, above) : std::max(most, above);
    }
    raise(most, images);
}

// Lifts the part off what of the ground stands out of the boundary's disk, as a corner does.
void Drape::clear_ground() {
    if (!ground_ || tip_ < 0.0) return;
    double most = 0.0;
    for (const Vec3& p : part_.mesh.positions()) {
        const Vec3 placed = stood(p);
        most = std::max(most, sunk(placed - foot_at(placed).height * axis_));
    }
    if (most < kHighestGround * radius_) raise(most, images_);
}

double Drape::depth() const {
    double most = 0.0;
    for (std::size_t k = 0; k < rim_.size(); ++k) {
        most = std::max(most, std::abs((images_[k] - rim_[k]).dot(axis_)));
    }
    return most;
}

Vec3 Drape::stood(const Vec3& point) const {
    return to_ + scale_ * (similarity_.rotation * (point - from_));
}

// Poisson's integral over the boundary, seen along the axis: weights are lengths over squares.
Drape::Foot Drape::foot_at(const Vec3& stood) const {
    Foot foot;
    double sum = 0.0, base = 0.0;
    const double least = 1e-12 * radius_ * radius_;
    for (std::size_t k = 0; k < rim_.size(); ++k) {
        const Vec3 way = stood - rim_[k];
        const double along = way.dot(axis_);
        const double square = std::max(way.squaredNorm() - along * along, least);
        const double weight = length_[k] / square;
        foot.draw += weight * lack_[k];
        base += weight * along;
        sum += weight;
    }
    foot.draw /= sum;
    foot.height = base / sum;
    return foot;
}

// How far the ground lies from a point of the disk, along the axis.
double Drape::sunk(const Vec3& on_disk) const {
    if (!ground_) return 0.0;
    const std::optional<Vec3> below = ground_(on_disk, axis_);
    return below ? (*below - on_disk).dot(axis_) : 0.0;
}

// The same in the mean over a circle around the point.
double Drape::sunk_around(const Vec3& on_disk, double radius) const {
    const Vec3 along = axis_.unitOrthogonal(), across = axis_.cross(along);
    double sum = 0.0;
    for (int k = 0; k < kAround; ++k) {
        const double angle = 2.0 * kPi * k / kAround;
        sum += sunk(on_disk + radius * (std::cos(angle) * along + std::sin(angle) * across));
    }
    return sum / kAround;
}

Vec3 Drape::drawn(const Vec3& point) const {
    const Vec3 placed = stood(point);
    const Foot foot = foot_at(placed);
    const double part = tip_ != 0.0 ? std::clamp(foot.height / tip_, 0.0, 1.0) : 0.0;
    const double ground =
        sunk_around(placed - foot.height * axis_, kSoftness * std::abs(foot.height));
    return placed + (1.0 - part) * (1.0 - part) * (foot.draw + ground * axis_);
}

Mat3 Drape::gradient_at(const Vec3& point, double step) const {
    Mat3 gradient;
    const Vec3 here = drawn(point);
    for (int k = 0; k < 3; ++k) {
        gradient.col(k) = (drawn(point + step * Vec3::Unit(k)) - here) / step;
    }
    return gradient;
}

// How far the middle of an edge lies below the ground.
double Drape::cut_by(const Vec3& from, const Vec3& to) const {
    const double depth = sunk(0.5 * (from + to));
    return depth < kMaxLift * radius_ ? depth : 0.0;
}

// Lifts vertices until no edge between them cuts through edges of the ground.
void Drape::lift(std::vector<Vec3>& positions, const Context& context) const {
    const Topology& topology = part_.mesh.topology();
    std::vector<char> low, on_rim(positions.size(), 0);
    for (const Index v : part_.loop) on_rim[at(v)] = 1;
    for (const Vec3& point : part_.mesh.positions()) {
        low.push_back(foot_at(stood(point)).height < kLowEdge * radius_ ? 1 : 0);
    }
    for (int round = 0; round < kLifts; ++round) {
        context.checkpoint();
        std::vector<double> rise(positions.size(), 0.0);
        bool any = false;
        for (Index v = 0; v < topology.vertex_count(); ++v) {
            if (!low[at(v)]) continue;
            for (const Index n : topology.neighbors(v)) {
                if (n < v || !low[at(n)] || (on_rim[at(v)] && on_rim[at(n)])) continue;
                const double depth = cut_by(positions[at(v)], positions[at(n)]);
                if (!(depth > kMinLift * radius_)) continue;
                const double each = on_rim[at(v)] || on_rim[at(n)] ? 2.0 * depth : depth;
                if (!on_rim[at(v)]) rise[at(v)] = std::max(rise[at(v)], each);
                if (!on_rim[at(n)]) rise[at(n)] = std::max(rise[at(n)], each);
                any = true;
            }
        }
        if (!any) return;
        for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += rise[v] * axis_;
    }
}

MovedPart Drape::moved(const Context& context) const {
    const Mesh& mesh = part_.mesh;
    const double step = kDrapeStep * radius_ / scale_;
    const bool turns = has_directions(mesh);
    BoundaryDeformation moved;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (v % 256 == 0) context.checkpoint();
        const Vec3& point = mesh.position(v);
        moved.positions.push_back(drawn(point));
        moved.transforms.push_back(
            scale_ * (turns ? nearest_rotation(gradient_at(point, step)) : similarity_.rotation));
    }
    for (std::size_t k = 0; k < part_.loop.size(); ++k) {
        moved.positions[at(part_.loop[k])] = images_[k];
    }
    if (ground_ && tip_ > 0.0) lift(moved.positions, context);
    MovedPart result{mesh, {}, std::vector<Vec3>(part_.loop.size(), Vec3::Zero())};
    result.mesh.set_positions(moved.positions);
    turn_directions(mesh, Region::all(mesh.shared_topology()), moved, result.mesh);
    return result;
}

}  // namespace lissom
