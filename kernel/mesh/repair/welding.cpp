#include "kernel/mesh/repair/welding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "kernel/mesh/directed_edges.h"
#include "kernel/mesh/measure/orientation.h"
#include "kernel/mesh/value_pool.h"

namespace lissom {
namespace {

// A face at an edge, seen along the edge.
struct Wing {
    Index corner;
    bool ascending;
    double angle;
};

// Angle, counter-clockwise about the axis, from a face behind which the inside lies to the next one
// in front of it. Faces at the same place bound no space between them.
double opening(const Wing& from, const Wing& to) {
    constexpr double kSame = 1e-9;
    const double angle = std::fmod(to.angle - from.angle + 4.0 * kPi, 2.0 * kPi);
    return angle < kSame ? 2.0 * kPi : angle;
}

}  // namespace

Welding::Welding(std::span<const Vec3> positions, const CornerFaces& work)
    : positions_(positions),
      work_(&work),
      twin_(work.faces.vertices.size(), kNoIndex),
      is_seam_(twin_.size(), 0),
      attempts_(work.faces.size(), 0) {}

void Welding::weld(Index a, Index b) {
    twin_[a] = b;
    twin_[b] = a;
}

void Welding::open(Index corner) {
    const Index other = std::exchange(twin_[corner], kNoIndex);
    if (other != kNoIndex) twin_[other] = kNoIndex;
}

bool Welding::is_closed() const {
    return std::none_of(twin_.begin(), twin_.end(), [](Index t) { return t == kNoIndex; });
}

bool Welding::weld_regular_edges() {
    regular_ = true;
    const DirectedEdges edges(count_of(positions_), work_->faces);
    edges.for_each_edge([&](std::span<const Index> corners) {
        if (corners.size() == 1) return;
        const bool pair = corners.size() == 2;
        if (pair && edges.ascending(corners[0]) != edges.ascending(corners[1]))
            return weld(corners[0], corners[1]);
        regular_ = false;
    });
    return regular_;
}

void Welding::weld_edges(Report& report) {
    Finding crowded{FindingKind::edges_nonmanifold, ElementKind::edge, true, 0, {}, {}};
    Finding one_sided{FindingKind::edges_unorientable, ElementKind::edge, true, 0, {}, {}};
    const DirectedEdges edges(count_of(positions_), work_->faces);
    edges.for_each_edge([&](std::span<const Index> corners) {
        if (corners.size() == 1) return;
        const Index low = edges.low(corners[0]), high = edges.high(corners[0]);
        if (corners.size() == 2 && edges.ascending(corners[0]) != edges.ascending(corners[1]))
            return weld(corners[0], corners[1]);
        if (corners.size() > 2) {
            std::vector<DirectedCorner> directed;
            for (const Index c : corners) directed.push_back({c, edges.ascending(c)});
            weld_around_edge(directed, (positions_[high] - positions_[low]).normalized());
        }
        Finding& finding = corners.size() > 2 ? crowded : one_sided;
        ++finding.count;
        finding.ids.insert(finding.ids.end(), {low, high});
    });
    if (crowded.count > 0) report.add(std::move(crowded));
    if (one_sided.count > 0) report.add(std::move(one_sided));
}

void Welding::weld_around_edge(std::span<const DirectedCorner> corners, const Vec3& axis) {
    // More faces than this at one edge bound no solid; they stay apart.
    constexpr std::size_t kMost = 64;
    if (corners.size() > kMost) return;
    std::vector<Wing> wings;
    Vec3 right = Vec3::Zero();
    for (const auto& [c, ascending] : corners) {
        const Vec3 normal = vector_area(positions_, work_->faces[work_->face_of_corner[c]]);
        const Vec3 into = ascending ? normal.cross(axis) : axis.cross(normal);
        if (right.isZero(0.0)) right = into;
        wings.push_back({c, ascending, std::atan2(into.dot(axis.cross(right)), into.dot(right))});
    }
    std::vector<std::tuple<double, Index, Index>> candidates;
    for (const Wing& back : wings) {
        for (const Wing& front : wings) {
            if (!back.ascending && front.ascending)
                candidates.emplace_back(opening(back, front), back.corner, front.corner);
        }
    }
    std::sort(candidates.begin(), candidates.end());
    for (const auto& [angle, back, front] : candidates) {
        if (twin_[back] == kNoIndex && twin_[front] == kNoIndex) weld(back, front);
    }
}

bool Welding::back_to_back(Index a, Index b) const {
    const Vec3 one = vector_area(positions_, work_->faces[work_->face_of_corner[a]]);
    const Vec3 other = vector_area(positions_, work_->faces[work_->face_of_corner[b]]);
    constexpr double kOpposite = -0.99985;  // cosine of 179 degrees
    return one.dot(other) < kOpposite * one.norm() * other.norm();
}

void Welding::weld_seams(std::span<const Index> label_of_face) {
    ValuePool<3> places;
    std::vector<Index> place(positions_.size(), kNoIndex);
    const auto place_of = [&](Index v) {
        const Vec3& p = positions_[v];
        if (place[v] == kNoIndex) place[v] = places.add({p.x(), p.y(), p.z()});
        return place[v];
    };
    std::vector<OpenEdge> edges;
    for (Index c = 0; c < count_of(twin_); ++c) {
        if (twin_[c] != kNoIndex) continue;
        const Index from = place_of(work_->faces.vertices[c]);
        const Index to = place_of(work_->faces.vertices[work_->next(c)]);
        const Index face = work_->face_source[work_->face_of_corner[c]];
        const Index label = label_of_face.empty() ? kNoIndex : label_of_face[face];
        if (from != to)
            edges.push_back({std::min(from, to), std::max(from, to), label, c, from < to});
    }
    std::sort(edges.begin(), edges.end(), [](const OpenEdge& a, const OpenEdge& b) {
        return std::tie(a.low, a.high, a.label, a.corner) <
               std::tie(b.low, b.high, b.label, b.corner);
    });
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && edges[end].same_place(edges[i])) ++end;
        weld_seam(std::span(edges).subspan(i, end - i));
    }
}

// Open edges at one place: a pair is a seam. If more lie there, as in copies of a torn surface,
// edges that bound the same piece of space belong together, if none is left over.
void Welding::weld_seam(std::span<const OpenEdge> edges) {
    const auto ascending =
        std::count_if(edges.begin(), edges.end(), [](const OpenEdge& e) { return e.ascending; });
    if (2 * at(ascending) != edges.size()) return;
    if (edges.size() == 2) {
        if (!back_to_back(edges[0].corner, edges[1].corner)) weld(edges[0].corner, edges[1].corner);
    } else {
        std::vector<DirectedCorner> directed;
        for (const OpenEdge& e : edges) directed.push_back({e.corner, e.ascending});
        const Index c = edges[0].corner;
        const Vec3 along = positions_[work_->faces.vertices[work_->next(c)]] -
                           positions_[work_->faces.vertices[c]];
        weld_around_edge(directed, (edges[0].ascending ? along : Vec3(-along)).normalized());
    }
    for (const OpenEdge& e : edges) is_seam_[e.corner] = twin_[e.corner] != kNoIndex;
}

// Gives the corners around the vertex of one corner the number of their fan: once around; if that
// ends at an open edge, the other way for the rest. Returns the lowest vertex that they have.
Index Welding::number_fan(Index corner, Index fan, std::vector<Index>& of_corner) const {
    Index lowest = work_->faces.vertices[corner];
    const auto add = [&](Index at) {
        of_corner[at] = fan;
        lowest = std::min(lowest, work_->faces.vertices[at]);
    };
    Index at = corner;
    do {
        add(at);
        at = twin_[work_->previous(at)];
    } while (at != kNoIndex && at != corner);
    if (at != kNoIndex) return lowest;
    for (Index across = twin_[corner]; across != kNoIndex; across = twin_[at]) {
        at = work_->next(across);
        add(at);
    }
    return lowest;
}

namespace {

// The order of fans: the first of each of `vertices` keeps its place, further ones go to the end.
std::vector<Index> order_of_fans(const std::vector<Index>& source, std::size_t vertices) {
    const auto fan_count = count_of(source);
    std::vector<Index> first_fan(vertices, kNoIndex);
    for (Index fan = 0; fan < fan_count; ++fan) {
        Index& first = first_fan[source[fan]];
        if (first == kNoIndex) first = fan;
    }
    std::vector<Index> order;
    order.reserve(source.size());
    for (const Index fan : first_fan) {
        if (fan != kNoIndex) order.push_back(fan);
    }
    const auto first_count = std::ssize(order);
    for (Index fan = 0; fan < fan_count; ++fan) {
        if (first_fan[source[fan]] != fan) order.push_back(fan);
    }
    std::stable_sort(order.begin() + first_count, order.end(),
                     [&](Index a, Index b) { return source[a] < source[b]; });
    return order;
}

}  // namespace

FanVertices Welding::fans() const {
    FanVertices result;
    result.of_corner.assign(twin_.size(), kNoIndex);
    std::vector<Index> source;
    source.reserve(positions_.size());
    for (Index c = 0; c < count_of(twin_); ++c) {
        if (result.of_corner[c] != kNoIndex) continue;
        source.push_back(number_fan(c, count_of(source), result.of_corner));
    }
    const std::vector<Index> order = order_of_fans(source, positions_.size());
    std::vector<Index> number(order.size());
    for (Index i = 0; i < count_of(order); ++i) {
        number[order[i]] = i;
        result.source.push_back(source[order[i]]);
    }
    for (Index& fan : result.of_corner) fan = number[fan];
    result.unchanged =
        result.of_corner == work_->faces.vertices && result.source.size() == positions_.size();
    return result;
}

void Welding::open_seams_at(Index corner) {
    for (const bool clockwise : {true, false}) {
        Index at = corner;
        do {
            const Index edge = clockwise ? at : work_->previous(at);
            const Index across = twin_[edge];
            if (is_seam_[edge]) open(edge);
            if (across == kNoIndex) break;
            at = clockwise ? work_->next(across) : across;
        } while (at != corner);
    }
}

// First the seams at both ends of a doubled edge are opened; if that does not help, the edge
// itself; and in the end the face stands alone, so that there is an end.
void Welding::open_around(Index corner) {
    const Index f = work_->face_of_corner[corner];
    if (attempts_[f] == 1) {
        open_seams_at(corner);
        open_seams_at(work_->next(corner));
    } else if (attempts_[f] == 2) {
        open(corner);
    } else {
        for (Index c = work_->faces.offsets[f]; c < work_->faces.offsets[f + 1]; ++c) open(c);
    }
}

std::vector<Index> Welding::doubled_edges(const FanVertices& vertices) {
    FaceList faces;
    faces.offsets = work_->faces.offsets;
    faces.vertices = vertices.of_corner;
    std::vector<Index> doubled;
    const DirectedEdges edges(count_of(vertices.source), faces);
    edges.for_each_edge([&](std::span<const Index> corners) {
        if (corners.size() == 1) return;
        if (corners.size() == 2 && edges.ascending(corners[0]) != edges.ascending(corners[1]))
            return weld(corners[0], corners[1]);
        doubled.insert(doubled.end(), corners.begin(), corners.end());
    });
    // A face that a fan passes twice is joined to itself.
    std::vector<Index> last_face(vertices.source.size(), kNoIndex);
    for (Index c = 0; c < count_of(faces.vertices); ++c) {
        Index& last = last_face[faces.vertices[c]];
        if (last == work_->face_of_corner[c]) doubled.push_back(c);
        last = work_->face_of_corner[c];
    }
    return doubled;
}

FanVertices Welding::number_fans() {
    // Only input made to take long needs more rounds.
    constexpr int kMaxRounds = 100;
    FanVertices vertices = fans();
    for (int round = 0; !(regular_ && vertices.unchanged); ++round) {
        if (round == kMaxRounds) {
            std::fill(twin_.begin(), twin_.end(), kNoIndex);
            return fans();
        }
        const std::vector<Index> doubled = doubled_edges(vertices);
        if (doubled.empty()) break;
        std::vector<Index> faces;
        for (const Index c : doubled) faces.push_back(work_->face_of_corner[c]);
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        for (const Index f : faces) attempts_[f] = std::min<char>(attempts_[f] + 1, 3);
        for (const Index c : doubled) open_around(c);
        vertices = fans();
    }
    return vertices;
}

}  // namespace lissom
