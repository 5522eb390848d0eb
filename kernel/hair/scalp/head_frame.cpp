#include "kernel/hair/scalp/head_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

constexpr double kCenterDepth = 0.65;  // of the frame's center below the top, in widths
constexpr int kMirrorSamples = 300;
// Least width of a head's slice over the root of the whole surface's area; of a body it is 0.11.
// What is narrower is a bump on the head, or a nose.
constexpr double kLeastWidth = 0.07;

// The part of the mesh that is the head, as points and edges.
struct Part {
    std::vector<Vec3> points;
    std::vector<std::pair<Vec3, Vec3>> edges;
    double least_width = 0.0;
};

Part part_of(const Mesh& mesh, const std::vector<Index>& vertices) {
    Part part;
    std::vector<char> in(static_cast<std::size_t>(mesh.vertex_count()), 0);
    for (const Index v : vertices) {
        in[v] = 1;
        part.points.push_back(mesh.position(v));
    }
    for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
        const auto [a, b] = mesh.topology().edge(e);
        if (in[a]) part.edges.emplace_back(mesh.position(a), mesh.position(b));
    }
    part.least_width = kLeastWidth * std::sqrt(area(mesh));
    return part;
}

// Extents of a horizontal slice, in the axes of a frame.
struct Slice {
    std::vector<Vec2> points;  // left, front
    double left_low = 0.0, left_high = 0.0, front_low = 0.0, front_high = 0.0;

    double width() const { return left_high - left_low; }
    double length() const { return front_high - front_low; }
    Vec2 center() const { return {0.5 * (left_low + left_high), 0.5 * (front_low + front_high)}; }
};

Slice slice_at(const Part& part, const Mat3& axes, double height) {
    Slice slice;
    for (const auto& [a, b] : part.edges) {
        const double ha = axes.col(1).dot(a), hb = axes.col(1).dot(b);
        if ((ha > height) == (hb > height)) continue;
        const Vec3 p = a + (height - ha) / (hb - ha) * (b - a);
        slice.points.emplace_back(axes.col(0).dot(p), axes.col(2).dot(p));
    }
    if (slice.points.empty()) return slice;
    slice.left_low = slice.front_low = std::numeric_limits<double>::infinity();
    slice.left_high = slice.front_high = -slice.left_low;
    for (const Vec2& p : slice.points) {
        slice.left_low = std::min(slice.left_low, p.x());
        slice.left_high = std::max(slice.left_high, p.x());
        slice.front_low = std::min(slice.front_low, p.y());
        slice.front_high = std::max(slice.front_high, p.y());
    }
    return slice;
}

// Depth below the top at which what lies above is as wide as twice the depth, from the vertices
// alone; 0 where there is none.
double rough_depth(const Part& part, const Mat3& axes, double& top) {
    std::vector<std::pair<double, double>> by_height;
    for (const Vec3& p : part.points) {
        by_height.emplace_back(-axes.col(1).dot(p), axes.col(0).dot(p));
    }
    std::sort(by_height.begin(), by_height.end());
    top = -by_height.front().first;
    double low = by_height.front().second, high = low;
    for (const auto& [down, across] : by_height) {
        low = std::min(low, across);
        high = std::max(high, across);
        const double depth = down + top;
        if (2.0 * depth >= part.least_width && high > low && high - low <= 2.0 * depth) {
            return depth;
        }
    }
    return 0.0;
}

// The depth where the width is exactly twice the depth, near `depth`.
double refined_depth(const Part& part, const Mat3& axes, double top, double depth) {
    double shallow = 0.5 * depth, deep = 1.5 * depth;
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (shallow + deep);
        const bool wider = slice_at(part, axes, top - middle).width() > 2.0 * middle;
        (wider ? shallow : deep) = middle;
    }
    return 0.5 * (shallow + deep);
}

// Mean distance of the slice to the ellipse through its extents, in widths.
double roughness_of(const Slice& slice) {
    double sum = 0.0;
    for (const Vec2& p : slice.points) {
        const Vec2 d = 2.0 * (p - slice.center());
        sum += std::abs(std::hypot(d.x() / slice.width(), d.y() / slice.length()) - 1.0);
    }
    return 0.5 * sum / static_cast<double>(slice.points.size());
}

// Mean distance of the points of the head to the mirror image of its surface, in widths.
double asymmetry_of(const Part& part, const SpatialTree& tree, const HeadFrame& frame) {
    std::vector<Vec3> near;
    for (const Vec3& p : part.points) {
        const Vec3 q = frame.local(p);
        if (q.y() > -0.8 * frame.width && q.norm() < 1.2 * frame.width) near.push_back(q);
    }
    if (near.empty()) return 1.0;
    double sum = 0.0;
    for (int i = 0; i < kMirrorSamples; ++i) {
        const Vec3& q = near[near.size() * static_cast<std::size_t>(i) / kMirrorSamples];
        sum += tree.nearest(frame.world(Vec3(-q.x(), q.y(), q.z()))).distance;
    }
    return sum / (kMirrorSamples * frame.width);
}

// From the eyes to the chin the face stays in front while the back goes in to the neck.
double forwardness_of(const Part& part, const HeadFrame& frame) {
    constexpr int kSlices = 10;
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < kSlices; ++i) {
        const double down = (0.25 + 0.5 * i / (kSlices - 1)) * frame.width;
        const Slice slice = slice_at(part, frame.axes, frame.up().dot(frame.center) - down);
        double low = 0.0, high = 0.0;
        for (const Vec2& p : slice.points) {
            const double across = p.x() - frame.left().dot(frame.center);
            const double along = p.y() - frame.front().dot(frame.center);
            if (std::abs(across) > 0.1 * frame.width || std::abs(along) > frame.length) continue;
            low = std::min(low, along);
            high = std::max(high, along);
        }
        if (slice.points.empty()) continue;
        sum += high + low;
        ++count;
    }
    return count > 0 ? sum / (count * frame.length) : 0.0;
}

// How much of the slice's width the head has at a tenth of its depth: about 0.45 for a round top, 1
// for a flat one.
double flatness_of(const Part& part, const Mat3& axes, double top, double depth, double width) {
    return slice_at(part, axes, top - 0.1 * depth).width() / width;
}

struct Candidate {
    HeadFrame frame;
    double score = 0.0;
};

std::optional<Candidate> candidate_for(const Part& part, const SpatialTree& tree,
                                       const Mat3& axes) {
    double top = 0.0;
    const double rough = rough_depth(part, axes, top);
    if (!(rough > 0.0)) return std::nullopt;
    const double depth = refined_depth(part, axes, top, rough);
    const Slice slice = slice_at(part, axes, top - depth);
    Candidate result;
    HeadFrame& frame = result.frame;
    frame.axes = axes;
    frame.width = slice.width();
    frame.length = slice.length();
    if (!(frame.width > 0.0 && frame.length > 0.0)) return std::nullopt;
    frame.center =
        axes * Vec3(slice.center().x(), top - kCenterDepth * frame.width, slice.center().y());
    frame.roughness = roughness_of(slice);
    frame.asymmetry = asymmetry_of(part, tree, frame);
    frame.forwardness = forwardness_of(part, frame);
    const double flat = flatness_of(part, axes, top, depth, frame.width);
    const double aspect = frame.length / frame.width;
    result.score = std::clamp(frame.forwardness, -0.2, 0.2) - 4.0 * frame.asymmetry -
                   4.0 * frame.roughness - 2.0 * std::max(0.0, flat - 0.65) -
                   2.0 * std::max({0.0, 1.05 - aspect, aspect - 1.6}) + 0.05 * axes(1, 1) +
                   0.02 * axes(2, 2);
    return result;
}

Vec3 unit_hint(const Vec3& hint, const char* name) {
    if (!hint.allFinite()) {
        throw Error(ErrorCode::not_finite, std::string(name) + " is NaN or infinite");
    }
    if (!(hint.norm() > 0.0)) {
        throw Error(ErrorCode::invalid_argument, std::string(name) + " has no length");
    }
    return hint.normalized();
}

Mat3 axes_of(const Vec3& up, const Vec3& front) {
    Mat3 axes;
    axes << up.cross(front), up, front;
    return axes;
}

std::vector<Vec3> directions(const std::optional<Vec3>& hint, const char* name) {
    if (hint) return {unit_hint(*hint, name)};
    std::vector<Vec3> all;
    for (int axis = 0; axis < 3; ++axis) {
        all.emplace_back(Vec3::Unit(axis));
        all.emplace_back(-Vec3::Unit(axis));
    }
    return all;
}

// All frames that the hints allow. Where only the front is known it is taken as exact.
std::vector<Mat3> possible_axes(const HeadHints& hints) {
    std::vector<Mat3> result;
    for (const Vec3& up : directions(hints.up, "up")) {
        for (const Vec3& front : directions(hints.front, "front")) {
            const bool keep_front = hints.front && !hints.up;
            const Vec3 upright = keep_front ? front : Vec3(front - front.dot(up) * up);
            const Vec3 vertical = keep_front ? Vec3(up - front.dot(up) * front) : up;
            if (upright.norm() < 0.5 && !hints.front) continue;
            if (upright.norm() < 1e-6 || vertical.norm() < 0.5) continue;
            result.push_back(axes_of(vertical.normalized(), upright.normalized()));
        }
    }
    if (result.empty()) {
        throw Error(ErrorCode::invalid_argument, "up and front point along one line");
    }
    return result;
}

}  // namespace

std::vector<Index> largest_component(const Mesh& mesh) {
    const std::vector<Index>& component = mesh.topology().components();
    const std::vector<double> areas = face_areas(mesh);
    std::vector<double> sum(static_cast<std::size_t>(mesh.topology().component_count()), 0.0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        sum[component[mesh.topology().face(f)[0]]] += areas[f];
    }
    const auto largest = static_cast<Index>(std::max_element(sum.begin(), sum.end()) - sum.begin());
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (component[v] == largest) vertices.push_back(v);
    }
    return vertices;
}

HeadFrame guess_head_frame(const Mesh& mesh, const HeadHints& hints, const Context& context) {
    const std::vector<Mat3> choices = possible_axes(hints);
    const SpatialTree tree(mesh, context);
    const Part part = part_of(mesh, largest_component(mesh));
    std::optional<Candidate> best;
    for (const Mat3& axes : choices) {
        context.checkpoint();
        const std::optional<Candidate> candidate = candidate_for(part, tree, axes);
        if (candidate && (!best || candidate->score > best->score)) best = candidate;
    }
    if (best) return best->frame;
    throw Error(ErrorCode::invalid_argument,
                "the mesh is not like a head: nowhere is it as wide as twice the depth below its "
                "top; give a head, or its up direction");
}

}  // namespace lissom
