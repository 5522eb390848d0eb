#include "kernel/mesh/query/crossing_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "kernel/mesh/query/triangle_intersection.h"

namespace lissom {
namespace {

constexpr Index kIntersectionGrain = 1024;

// Pairs between two looks at whether to stop. At a hub one triangle alone may have as many.
constexpr std::size_t kPairsPerCheckpoint = 1 << 14;

// Boxes of triangles and a tree of them.
constexpr std::size_t kSearchBytesPerCorner = 120;

void extend(Box& box, const Box& by) {
    box.extend(by.min);
    box.extend(by.max);
}

// Returns the tolerance of the options.
double tolerance_of(const SelfIntersectionOptions& options) {
    if (options.tolerance >= 0.0 && options.tolerance <= 1.0) return options.tolerance;
    throw Error(ErrorCode::invalid_argument, "tolerance must lie between 0 and 1");
}

}  // namespace

CrossingSearch::CrossingSearch(std::shared_ptr<const Topology> topology,
                               const SelfIntersectionOptions& options, const Context& context)
    : topology_(std::move(topology)),
      tolerance_(tolerance_of(options)),
      in_faces_(flags(options.faces)),
      in_against_(flags(options.against)),
      charge_(context.charge(kSearchBytesPerCorner * at(topology_->corner_count()),
                             "self-intersections")) {}

std::vector<FacePair> CrossingSearch::find(std::span<const Vec3> positions,
                                           const Context& context) {
    prepare(positions);
    const Index count = count_of(asked_);
    std::vector<std::vector<FacePair>> found(
        at((count + kIntersectionGrain - 1) / kIntersectionGrain));
    context.parallel_for(0, count, kIntersectionGrain, [&](Index begin, Index end) {
        std::size_t pairs = 0;
        for (Index i = begin; i < end; ++i) {
            const Index t = asked_[at(i)];
            tree_.visit(boxes_[at(t)], [&](Index other) {
                if (pairs++ % kPairsPerCheckpoint == 0) context.checkpoint();
                const FacePair pair = pair_if_they_meet(t, other);
                if (pair.first != kNoIndex) found[at(begin / kIntersectionGrain)].push_back(pair);
            });
        }
    });
    std::vector<FacePair> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

bool CrossingSearch::finds_others(std::span<const Vec3> positions, std::span<const FacePair> known,
                                  const Context& context) {
    reserve();
    prepare(positions);
    std::atomic<bool> found = false;
    const auto search = [&](Index begin, Index end) {
        std::size_t pairs = 0;
        for (Index i = begin; i < end && !found.load(std::memory_order_relaxed); ++i) {
            const Index t = asked_[at(i)];
            tree_.visit(boxes_[at(t)], [&](Index other) {
                if (pairs++ % kPairsPerCheckpoint == 0) context.checkpoint();
                const FacePair pair = pair_if_they_meet(t, other);
                if (pair.first == kNoIndex) return;
                if (!std::binary_search(known.begin(), known.end(), pair)) found = true;
            });
        }
    };
    // A function that refers to one thing takes no memory.
    context.parallel_for(0, count_of(asked_), kIntersectionGrain,
                         [&search](Index begin, Index end) { search(begin, end); });
    return found;
}

std::vector<char> CrossingSearch::flags(const std::optional<std::vector<Index>>& faces) const {
    const std::size_t count = at(topology_->face_count());
    if (!faces) return std::vector<char>(count, 1);
    require_faces(*topology_, *faces);
    std::vector<char> chosen(count, 0);
    for (const Index f : *faces) chosen[at(f)] = 1;
    return chosen;
}

// Room for all faces: another shape may bring others near to one another.
void CrossingSearch::reserve() {
    const std::size_t faces = at(topology_->face_count());
    const std::size_t triangles = at(topology_->corner_count()) - 2 * faces;
    face_boxes_.reserve(faces);
    near_.reserve(faces);
    boxes_.reserve(triangles);
    longest_.reserve(triangles);
    triangulation_.triangles.reserve(triangles);
    triangulation_.corners.reserve(triangles);
    triangulation_.face.reserve(triangles);
    asked_.reserve(triangles);
    in_tree_.reserve(triangles);
    tree_.reserve(triangles, triangles);
}

void CrossingSearch::prepare(std::span<const Vec3> positions) {
    positions_ = positions;
    find_faces_that_may_meet();
    triangulate_faces(*topology_, positions, near_, triangulation_, triangulation_room_);
    boxes_.clear();
    longest_.clear();
    for (const Triangle& t : triangulation_.triangles) {
        boxes_.push_back(box_of(t));
        longest_.push_back(longest_side_of(t));
    }
    choose(in_faces_, in_tree_);
    choose(in_against_, asked_);
    if (in_tree_.size() > asked_.size()) std::swap(in_tree_, asked_);
    tree_.build(boxes_, in_tree_);
}

// Returns the box of some vertices, with room for touching faces.
Box CrossingSearch::box_of(std::span<const Index> vertices) const {
    Box box;
    for (const Index v : vertices) box.extend(positions_[at(v)]);
    const Vec3 margin = Vec3::Constant(tolerance_ * box.diagonal());
    return {box.min - margin, box.max + margin};
}

double CrossingSearch::longest_side_of(const Triangle& t) const {
    double squared = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = positions_[at(t[k])] - positions_[at(t[(k + 1) % 3])];
        squared = std::max(squared, side.squaredNorm());
    }
    return std::sqrt(squared);
}

// Finds the faces of either set that are near the other.
void CrossingSearch::find_faces_that_may_meet() {
    Box of_faces, of_others;
    const Index count = topology_->face_count();
    face_boxes_.clear();
    near_.clear();
    for (Index f = 0; f < count; ++f) {
        face_boxes_.push_back(box_of(topology_->face(f)));
        if (in_faces_[at(f)]) extend(of_faces, face_boxes_.back());
        if (in_against_[at(f)]) extend(of_others, face_boxes_.back());
    }
    for (Index f = 0; f < count; ++f) {
        const Box& box = face_boxes_[at(f)];
        if ((in_faces_[at(f)] && boxes_overlap(box, of_others)) ||
            (in_against_[at(f)] && boxes_overlap(box, of_faces))) {
            near_.push_back(f);
        }
    }
}

void CrossingSearch::choose(const std::vector<char>& face_chosen,
                            std::vector<Index>& triangles) const {
    triangles.clear();
    for (std::size_t t = 0; t < triangulation_.triangles.size(); ++t) {
        if (face_chosen[at(triangulation_.face[t])]) triangles.push_back(index_of(t));
    }
}

// Returns the faces of two triangles if these meet, and no faces otherwise.
FacePair CrossingSearch::pair_if_they_meet(Index t, Index u) const {
    const Index f = triangulation_.face[at(t)], g = triangulation_.face[at(u)];
    if (f == g) return {};
    // A pair that both triangles will be asked about is tested once.
    const bool twice =
        in_faces_[at(f)] && in_faces_[at(g)] && in_against_[at(f)] && in_against_[at(g)];
    if (twice && t > u) return {};
    const Triangle &a = triangulation_.triangles[at(t)], &b = triangulation_.triangles[at(u)];
    std::array<Vec3, 3> p, q;
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = positions_[at(a[k])];
        q[k] = positions_[at(b[k])];
    }
    const double longest = std::max(longest_[at(t)], longest_[at(u)]);
    if (!triangles_meet(p, q, tolerance_ * longest)) return {};
    return {std::min(f, g), std::max(f, g)};
}

}  // namespace lissom
