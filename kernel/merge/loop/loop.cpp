#include "kernel/merge/loop/loop.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Smoothing under which arc length is measured, in loop lengths.
constexpr double kLengthSigma = 0.03;
// A Gaussian ends at this many sigmas.
constexpr double kTubeReach = 3.0;
// Ignore interior vertices nearer to the boundary than this many fan radii, when the turn of its
// normal is extrapolated; and clamp that turn to so many radians.
constexpr double kMinReach = 1.5;
constexpr double kMaxTurn = 0.35;
// A face beyond those at the boundary goes on with their surface if it turns by less than this
// about the boundary, radians: caps and floors do not.
constexpr double kGoesOn = 0.6;

// The normal of the triangles around a vertex, weighted by angle, and how far from the vertex they
// stand for in the mean: their middles by the same weights.
struct FanNormal {
    Vec3 normal = Vec3::Zero(), middle = Vec3::Zero();
};

// The faces around a vertex; at a hub of very many those alone that lie nearest to its neighbour
// `beside`.
std::span<const Index> faces_beside(const Topology& topology, Index v, Index beside) {
    constexpr std::ptrdiff_t kMostFaces = 256;
    const std::span<const Index> faces = topology.faces_around(v);
    const auto count = std::ssize(faces);
    if (count <= kMostFaces) return faces;
    const auto ring = topology.neighbors(v);
    const auto place = std::find(ring.begin(), ring.end(), beside) - ring.begin();
    const auto first = std::clamp<std::ptrdiff_t>(place - kMostFaces / 2, 0, count - kMostFaces);
    return faces.subspan(static_cast<std::size_t>(first), kMostFaces);
}

// Mean normal of those triangles of some faces at `v` whose unit normals `counts` takes; zero
// without any.
template <typename Counts>
FanNormal fan_normal_of(const Mesh& mesh, Index v, std::span<const Index> faces,
                        const Counts& counts) {
    FanNormal fan;
    double total = 0.0;
    const Triangulation around = triangulate_faces(mesh.topology(), mesh.positions(), faces);
    for (const Triangle& t : around.triangles) {
        for (int k = 0; k < 3; ++k) {
            if (t[k] != v) continue;
            const Vec3 a = mesh.position(t[(k + 1) % 3]) - mesh.position(v);
            const Vec3 b = mesh.position(t[(k + 2) % 3]) - mesh.position(v);
            const Vec3 normal = a.cross(b).normalized();
            if (!counts(normal)) continue;
            const double angle = angle_between(a, b);
            fan.normal += angle * normal;
            fan.middle += angle * (a + b) / 3.0;
            total += angle;
        }
    }
    if (total > 0.0) fan.middle /= total;
    fan.normal.normalize();
    return fan;
}

FanNormal fan_normal(const Mesh& mesh, Index v) {
    return fan_normal_of(mesh, v, mesh.topology().faces_around(v),
                         [](const Vec3&) { return true; });
}

// Seen along `axis`.
Vec3 seen_along(const Vec3& v, const Vec3& axis) {
    return v - v.dot(axis) * axis;
}

// The normal of the surface on the boundary itself, seen along it: that of the faces there is one a
// little inside, and goes on as it turned from the vertices within to there. Without it a surface
// that bends across the seam would be straightened. Only faces that go on with the surface count
// within: with one ring of faces, those vertices lie on a cap as well.
Vec3 boundary_normal(const Mesh& mesh, Index v, const Vec3& tangent) {
    const FanNormal at = fan_normal(mesh, v);
    const Vec3 own = seen_along(at.normal, tangent).normalized();
    const auto goes_on = [&](const Vec3& normal) {
        return angle_between(seen_along(normal, tangent), own) <= kGoesOn;
    };
    Vec3 inner = Vec3::Zero(), arm = Vec3::Zero();
    double count = 0.0;
    for (const Index n : mesh.topology().neighbors(v)) {
        if (mesh.topology().is_boundary(n)) continue;
        const auto faces = faces_beside(mesh.topology(), n, v);
        const Vec3 normal = seen_along(fan_normal_of(mesh, n, faces, goes_on).normal, tangent);
        if (!(normal.norm() > 0.0)) continue;
        inner += normal.normalized();
        arm += mesh.position(n) - mesh.position(v);
        count += 1.0;
    }
    if (count == 0.0) return at.normal;
    inner.normalize();
    const double near = at.middle.norm(), far = at.middle.normalized().dot(arm) / count;
    if (!(far > kMinReach * near)) return at.normal;
    const Vec3 beyond = near / (far - near) * (own - inner);
    return (own + std::min(1.0, kMaxTurn / std::max(beyond.norm(), 1e-12)) * beyond).normalized();
}

std::vector<Vec3> normals_at(const Mesh& mesh, std::span<const Index> vertices, LoopMeasure measure,
                             const Context& context) {
    std::vector<Vec3> normals;
    const std::size_t n = vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
        context.checkpoint();
        if (measure == LoopMeasure::raw) {
            normals.push_back(fan_normal(mesh, vertices[k]).normal);
            continue;
        }
        const Vec3 chord =
            mesh.position(vertices[(k + 1) % n]) - mesh.position(vertices[(k + n - 1) % n]);
        normals.push_back(boundary_normal(mesh, vertices[k], chord.normalized()));
    }
    return normals;
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const double length = v.norm();
    return length > 0.0 ? Vec3(v / length) : otherwise;
}

// A unit vector across `v`.
Vec3 across(const Vec3& v) {
    Index least = 0;
    v.cwiseAbs().minCoeff(&least);
    return v.cross(Vec3(Vec3::Unit(least))).normalized();
}

}  // namespace

Loop::Loop(const Mesh& mesh, std::vector<Index> vertices, LoopMeasure measure,
           const Context& context)
    : vertices_(std::move(vertices)) {
    const auto refuse = [&](const char* why) {
        Elements elements{ElementKind::vertex, 0, {}};
        for (const Index v : vertices_) elements.add(v);
        throw Error(ErrorCode::boundary_conflict, "the boundary at " + describe(elements) + why,
                    elements);
    };
    if (size() < 3) refuse(" has fewer than 3 vertices and cannot be joined; cut the mesh there");
    for (const Index v : vertices_) points_.push_back(mesh.position(v));
    for (Index k = 0; k < size(); ++k) {
        arc_.push_back(length_);
        edges_.push_back((points_[(k + 1) % size()] - points_[k]).norm());
        length_ += edges_.back();
    }
    if (!(length_ > 0.0)) refuse(" has no length; cut the mesh there");
    normals_ = normals_at(mesh, vertices_, measure, context);
    find_moments();
    find_parameters(measure);
    if (!(radius_ > 1e-9 * length_)) refuse(" encloses nothing; cut the mesh there");
}

Loop Loop::renumbered(std::vector<Index> vertices) const {
    Loop result = *this;
    result.vertices_ = std::move(vertices);
    return result;
}

void Loop::find_moments() {
    const auto exactly = [&](const auto& of_edge) {
        for (Index k = 0; k < size(); ++k) of_edge(points_[k], points_[(k + 1) % size()], edge(k));
    };
    const Vec3 first = points_.front();
    Vec3 sum = Vec3::Zero();
    exactly(
        [&](const Vec3& a, const Vec3& b, double l) { sum += 0.5 * l * (a + b - 2.0 * first); });
    center_ = first + sum / length_;
    double squares = 0.0;
    exactly([&](const Vec3& a, const Vec3& b, double l) {
        const Vec3 p = a - center_, q = b - center_;
        squares += l / 3.0 * (p.squaredNorm() + q.squaredNorm() + p.dot(q));
    });
    radius_ = std::sqrt(squares / length_);
}

// Gaussian along the true arc length; a vertex counts as much as half the edges at it.
std::vector<Vec3> Loop::smoothed(std::span<const Vec3> values, double sigma) const {
    // A little more, so that rounding does not decide about vertices just there.
    const double reach = (kTubeReach * sigma + 1e-9) * length_;
    std::vector<Vec3> result;
    const auto mass = [&](Index k) { return 0.5 * (edge(k) + edge((k + size() - 1) % size())); };
    for (Index k = 0; k < size(); ++k) {
        double total = mass(k);
        Vec3 sum = total * values[k];
        const auto add = [&](Index other, double distance) {
            const double x = distance / (sigma * length_);
            const double weight = mass(other) * std::exp(-0.5 * x * x);
            total += weight;
            sum += weight * values[other];
        };
        double ahead = edge(k), behind = edge((k + size() - 1) % size());
        for (Index n = 1; n < size() && ahead < std::min(reach, 0.5 * length_); ++n) {
            add((k + n) % size(), ahead);
            ahead += edge((k + n) % size());
        }
        for (Index n = 1; n < size() && behind < std::min(reach, 0.5 * length_); ++n) {
            add((k + size() - n) % size(), behind);
            behind += edge((k + 2 * size() - n - 1) % size());
        }
        result.push_back(total > 0.0 ? Vec3(sum / total) : values[k]);
    }
    return result;
}

// A little of the true length keeps parameters apart if smoothing brings points together.
void Loop::find_parameters(LoopMeasure measure) {
    if (measure == LoopMeasure::raw) {
        for (const double arc : arc_) parameters_.push_back(arc / length_);
        return;
    }
    const std::vector<Vec3> curve = smoothed(points_, kLengthSigma);
    double total = 0.0;
    for (Index k = 0; k < size(); ++k) {
        parameters_.push_back(total);
        total += (curve[(k + 1) % size()] - curve[k]).norm() + 1e-3 * edge(k);
    }
    for (double& u : parameters_) u /= total;
}

double Loop::parameter_of(const LoopPoint& place) const {
    const double from = parameters_[place.segment];
    const double to = place.segment + 1 < size() ? parameters_[place.segment + 1] : 1.0;
    return from + place.t * (to - from);
}

LoopPoint Loop::place_at(double parameter) const {
    double u = parameter - std::floor(parameter);
    if (u >= 1.0) u = 0.0;
    const auto after = std::upper_bound(parameters_.begin(), parameters_.end(), u);
    const auto k = index_of(after - parameters_.begin()) - 1;
    const double to = k + 1 < size() ? parameters_[k + 1] : 1.0;
    const double width = to - parameters_[k];
    const double t = width > 0.0 ? (u - parameters_[k]) / width : 0.0;
    return t < 1.0 ? LoopPoint{k, t} : LoopPoint{(k + 1) % size(), 0.0};
}

LoopPoint Loop::nearest(const Vec3& point, double& distance) const {
    LoopPoint best;
    distance = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < size(); ++k) {
        const Vec3& a = points_[k];
        const Vec3 side = points_[(k + 1) % size()] - a;
        const double squared = side.squaredNorm();
        const double t =
            squared > 0.0 ? std::clamp((point - a).dot(side) / squared, 0.0, 1.0) : 0.0;
        const double d = (point - a - t * side).norm();
        if (d >= distance) continue;
        distance = d;
        best = t < 1.0 ? LoopPoint{k, t} : LoopPoint{(k + 1) % size(), 0.0};
    }
    return best;
}

std::vector<double> Loop::tangent_lengths() const {
    std::vector<double> result;
    for (Index k = 0; k < size(); ++k) {
        result.push_back(0.5 *
                         (points_[(k + 1) % size()] - points_[(k + size() - 1) % size()]).norm());
    }
    return result;
}

std::vector<Mat3> Loop::frames(double sigma) const {
    std::vector<Vec3> tangents, normals = normals_;
    for (Index k = 0; k < size(); ++k) {
        const Vec3 chord = points_[(k + 1) % size()] - points_[(k + size() - 1) % size()];
        tangents.push_back(unit_or(chord, Vec3::Zero()));
    }
    if (sigma > 0.0) {
        tangents = smoothed(tangents, sigma);
        normals = smoothed(normals, sigma);
    }
    std::vector<Mat3> frames;
    Vec3 last = Vec3::UnitX();
    for (Index k = 0; k < size(); ++k) {
        const Vec3 t = unit_or(tangents[k], last);
        last = t;
        const Vec3 n = unit_or(normals[k] - normals[k].dot(t) * t, across(t));
        Mat3 frame;
        frame << t, n, t.cross(n);
        frames.push_back(frame);
    }
    return frames;
}

Vec3 Loop::axis() const {
    Vec3 area = Vec3::Zero();
    for (Index k = 0; k < size(); ++k) {
        area += (points_[k] - center_).cross(points_[(k + 1) % size()] - center_);
    }
    return area.norm() > 1e-12 * length_ * length_ ? Vec3(area.normalized()) : Vec3(Vec3::Zero());
}

double Loop::mean_turn() const {
    double sum = 0.0;
    for (Index k = 0; k < size(); ++k) {
        const Vec3 before = points_[k] - points_[(k + size() - 1) % size()];
        sum += angle_between(before, points_[(k + 1) % size()] - points_[k]);
    }
    return sum / size();
}

}  // namespace lissom
