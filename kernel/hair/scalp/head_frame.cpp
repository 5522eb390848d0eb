#include "kernel/hair/scalp/head_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "kernel/core/roots.h"
#include "kernel/hair/scalp/head_landmarks.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

constexpr double kCenterDepth = 0.65;  // of the frame's center below the top, in widths
constexpr int kMirrorSamples = 300;
// Least width of a head's slice over the root of the whole surface's area; of a body it is 0.11.
// Narrower parts are a bump on the head, or a nose.
constexpr double kMinWidth = 0.07;

// The part of the mesh that is the head, as points and edges.
struct Part {
    std::vector<Vec3> points;
    std::vector<std::pair<Vec3, Vec3>> edges;
    double min_width = 0.0;
    double area = 0.0;
};

Part part_of(const Mesh& mesh, const std::vector<Index>& vertices) {
    Part part;
    std::vector<char> in(mesh.vertex_count(), 0);
    for (const Index v : vertices) {
        in[v] = 1;
        part.points.push_back(mesh.position(v));
    }
    for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
        const auto [a, b] = mesh.topology().edge(e);
        if (in[a]) part.edges.emplace_back(mesh.position(a), mesh.position(b));
    }
    part.min_width = kMinWidth * std::sqrt(area(mesh));
    const std::vector<double> areas = face_areas(mesh);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (in[mesh.topology().face(f)[0]]) part.area += areas[f];
    }
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

// Returns the depth below the top at which the part above is as wide as twice the depth, from the
// vertices alone; 0 if there is none.
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
        if (2.0 * depth >= part.min_width && high > low && high - low <= 2.0 * depth) {
            return depth;
        }
    }
    return 0.0;
}

// Returns the depth near `depth` at which the width is exactly twice the depth.
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
        sum += std::abs(hypotenuse(d.x() / slice.width(), d.y() / slice.length()) - 1.0);
    }
    return 0.5 * sum / slice.points.size();
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
        const Vec3& q = near[near.size() * i / kMirrorSamples];
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

// ---- Which way it looks

struct Candidate {
    HeadFrame frame;
    double score = 0.0;
    bool has_eyes = false;
};

// By how much the length of the slice over its width is out of the range of heads.
double unusual_aspect(const HeadFrame& frame) {
    const double aspect = frame.length / frame.width;
    return std::max({0.0, 1.05 - aspect, aspect - 1.6});
}

// An opening this long is the rim of a mask.
constexpr double kMask = 2.2;

double score_of(const HeadFrame& frame, double flatness, bool has_eyes,
                const Landmarks& landmarks) {
    double score = std::clamp(frame.forwardness, -0.2, 0.2) - 4.0 * frame.asymmetry -
                   4.0 * frame.roughness - 2.0 * std::max(0.0, flatness - 0.65) +
                   0.05 * frame.axes(1, 1) + 0.02 * frame.axes(2, 2) + (has_eyes ? 0.3 : 0.0);
    const double up = frame.up().dot(landmarks.from_opening),
                 front = frame.front().dot(landmarks.from_opening);
    // Neither the crown nor the face is open.
    score -= 0.3 * std::max(0.0, -up) + 0.3 * std::max(0.0, -front);
    if (landmarks.opening > kMask && front > 0.8) return score + 0.5;
    return score - 2.0 * unusual_aspect(frame);
}

std::optional<Candidate> candidate_for(const Part& part, const SpatialTree& tree,
                                       const Landmarks& landmarks, const Mat3& axes) {
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
    const double flatness = flatness_of(part, axes, top, depth, frame.width);
    result.has_eyes = std::any_of(landmarks.pairs.begin(), landmarks.pairs.end(),
                                  [&](const EyePair& pair) { return are_eyes(pair, frame); });
    result.score = score_of(frame, flatness, result.has_eyes, landmarks);
    return result;
}

// ---- How sure that is

double rising(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Share of directions from the center, above it, that the surface lies in.
double coverage_of(const SpatialTree& tree, const HeadFrame& frame) {
    constexpr int kRows = 6, kColumns = 24;
    int hits = 0;
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const double up = (row + 0.5) / kRows, flat = std::sqrt(1.0 - up * up);
            const double azimuth = 2.0 * kPi * (column + 0.5) / kColumns;
            const Vec3 ray(flat * std::sin(azimuth), up, flat * std::cos(azimuth));
            hits += tree.pick(frame.center, frame.axes * ray).has_value();
        }
    }
    return static_cast<double>(hits) / (kRows * kColumns);
}

struct Reason {
    double sure;
    const char* doubt;
};

// `lead`: of its score before that of the second best directions.
void set_confidence(Candidate& best, double lead, const HeadHints& hints) {
    HeadFrame& frame = best.frame;
    const bool has_front = hints.front || best.has_eyes, has_all = hints.front && hints.up;
    const Reason reasons[] = {
        {rising(0.70, 0.95, frame.coverage), "a part of the head is missing"},
        {1.0 - rising(0.0, 0.15, unusual_aspect(frame)), "it is too long or too short for a head"},
        {1.0 - rising(0.05, 0.10, frame.asymmetry), "its two sides differ"},
        {1.0 - rising(0.035, 0.07, frame.roughness), "it is not round above the ears"},
        {has_front ? 1.0 : rising(0.0, 0.04, frame.forwardness), "front and back are alike"},
        {has_all ? 1.0 : rising(0.0, 0.08, lead), "other directions fit nearly as well"}};
    frame.confidence = 1.0;
    for (const Reason& reason : reasons) frame.confidence *= reason.sure;
    const Reason& worst =
        *std::min_element(std::begin(reasons), std::end(reasons),
                          [](const Reason& a, const Reason& b) { return a.sure < b.sure; });
    if (worst.sure < 1.0) frame.doubt = worst.doubt;
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

// All frames that the hints allow. If only the front is known it is taken as exact.
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

// How much better the first candidate is than the best that stands otherwise.
double lead_of(const std::vector<Candidate>& found) {
    const Mat3& axes = found.front().frame.axes;
    for (const Candidate& other : found) {
        const Mat3 turn = axes.transpose() * other.frame.axes;
        if (turn.trace() < 1.0 + 2.0 * std::cos(kPi / 6.0)) {
            return found.front().score - other.score;
        }
    }
    return std::numeric_limits<double>::infinity();
}

// Directions along no axis of the mesh, by the line through the eyes and the greatest opening: of
// heads that stand aslant.
std::vector<Mat3> slanted_axes(const Landmarks& landmarks) {
    constexpr double kAslant = 5.0 * kPi / 180.0, kOpeningAslant = 20.0 * kPi / 180.0;
    constexpr std::size_t kMaxPairs = 4;
    const auto slant = [](const Vec3& v) {
        return std::acos(std::min(1.0, v.cwiseAbs().maxCoeff()));
    };
    std::vector<Mat3> result;
    const auto add = [&](const Vec3& up, const Vec3& rough_front) {
        const Vec3 front = rough_front - rough_front.dot(up) * up;
        if (front.norm() > 0.5) result.push_back(axes_of(up, front.normalized()));
    };
    const Vec3& opening = landmarks.from_opening;
    std::vector<Vec3> rough_ups = directions(std::nullopt, "up");
    if (opening.norm() > 0.5) rough_ups.push_back(opening);
    std::vector<EyePair> pairs = landmarks.pairs;
    std::stable_sort(pairs.begin(), pairs.end(), [](const EyePair& a, const EyePair& b) {
        return a.one.radius + a.other.radius > b.one.radius + b.other.radius;
    });
    std::size_t taken = 0;
    for (const EyePair& pair : pairs) {
        const Vec3 left = (pair.one.center - pair.other.center).normalized();
        if (slant(left) < kAslant || ++taken > kMaxPairs) continue;
        for (const Vec3& rough : rough_ups) {
            const Vec3 level = rough - rough.dot(left) * left;
            if (level.norm() < 0.7) continue;
            const Vec3 up = level.normalized();
            add(up, left.cross(up));
            add(up, -left.cross(up));
        }
    }
    if (opening.norm() > 0.5 && slant(opening) > kOpeningAslant) {
        for (const Vec3& front : directions(std::nullopt, "front")) add(opening, front);
    }
    return result;
}

}  // namespace

std::vector<Index> largest_component(const Mesh& mesh) {
    const std::vector<Index>& component = mesh.topology().components();
    const std::vector<double> areas = face_areas(mesh);
    std::vector<double> sum(mesh.topology().component_count(), 0.0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        sum[component[mesh.topology().face(f)[0]]] += areas[f];
    }
    const auto largest = index_of(std::max_element(sum.begin(), sum.end()) - sum.begin());
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (component[v] == largest) vertices.push_back(v);
    }
    return vertices;
}

HeadFrame guess_head_frame(const Mesh& mesh, const HeadHints& hints, const Context& context) {
    // Bonus of the mesh's own axes.
    constexpr double kAxisBonus = 0.15;
    std::vector<Mat3> choices = possible_axes(hints);
    const std::size_t along_axes = choices.size();
    const SpatialTree tree(mesh, context);
    const std::vector<Index> vertices = largest_component(mesh);
    const Part part = part_of(mesh, vertices);
    const Landmarks landmarks = landmarks_of(mesh, vertices, part.area);
    if (!hints.up && !hints.front) {
        const std::vector<Mat3> slanted = slanted_axes(landmarks);
        choices.insert(choices.end(), slanted.begin(), slanted.end());
    }
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        context.checkpoint();
        std::optional<Candidate> one = candidate_for(part, tree, landmarks, choices[i]);
        if (!one) continue;
        if (i < along_axes) one->score += kAxisBonus;
        found.push_back(std::move(*one));
    }
    if (found.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    "the mesh is not like a head: nowhere is it as wide as twice the depth below "
                    "its top; give a head, or its up direction");
    }
    // The first of equally good ones.
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    Candidate& best = found.front();
    best.frame.coverage = coverage_of(tree, best.frame);
    set_confidence(best, lead_of(found), hints);
    return best.frame;
}

}  // namespace lissom
