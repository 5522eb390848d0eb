#include "kernel/mesh/query/self_intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/triangle_intersection.h"

namespace lissom {
namespace {

constexpr Index kPairLeafSize = 4;
constexpr Index kIntersectionGrain = 1024;

bool overlap(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

// A hierarchy of boxes over some triangles, halved along the longest side.
class PairTree {
  public:
    PairTree(std::span<const Box> boxes, std::vector<Index> items)
        : boxes_(boxes), items_(std::move(items)) {
        centers_.reserve(boxes.size());
        for (const Box& box : boxes) centers_.push_back(box.center());
        if (!items_.empty()) build(0, count_of(items_));
    }

    // Calls visit(item) for the items whose boxes overlap `box`.
    template <typename Visit>
    void visit(const Box& box, const Visit& visit) const {
        if (!nodes_.empty()) descend(0, box, visit);
    }

  private:
    // The first child of an inner node follows it; `second` is 0 in a leaf.
    struct Node {
        Box box;
        Index begin, end, second = 0;
    };

    Index build(Index begin, Index end) {
        const auto at = count_of(nodes_);
        nodes_.push_back({{}, begin, end});
        Box box, centers;
        for (Index i = begin; i < end; ++i) {
            box.extend(boxes_[items_[i]].min);
            box.extend(boxes_[items_[i]].max);
            centers.extend(centers_[items_[i]]);
        }
        nodes_[at].box = box;
        if (end - begin <= kPairLeafSize) return at;
        int axis = 0;
        (centers.max - centers.min).maxCoeff(&axis);
        const Index middle = begin + (end - begin) / 2;
        std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                         [&](Index a, Index b) {
                             const double x = centers_[a][axis], y = centers_[b][axis];
                             return x != y ? x < y : a < b;
                         });
        build(begin, middle);
        const Index second = build(middle, end);
        nodes_[at].second = second;
        return at;
    }

    template <typename Visit>
    void descend(Index at, const Box& box, const Visit& visit) const {
        const Node& node = nodes_[at];
        if (!overlap(node.box, box)) return;
        if (node.second > 0) {
            descend(at + 1, box, visit);
            descend(node.second, box, visit);
            return;
        }
        for (Index i = node.begin; i < node.end; ++i) {
            if (overlap(boxes_[items_[i]], box)) visit(items_[i]);
        }
    }

    std::span<const Box> boxes_;
    std::vector<Vec3> centers_;
    std::vector<Index> items_;
    std::vector<Node> nodes_;
};

bool same_place(const Vec3& a, const Vec3& b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// Numbers the corners of two triangles so that those at one place have one number.
void number_by_place(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q, Triangle& a,
                     Triangle& b) {
    a = {0, 1, 2};
    b = {3, 4, 5};
    for (std::size_t k = 1; k < 3; ++k) {
        for (std::size_t j = k; j-- > 0;) {
            if (same_place(p[k], p[j])) a[k] = a[j];
            if (same_place(q[k], q[j])) b[k] = b[j];
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 3; j-- > 0;) {
            if (same_place(q[k], p[j])) b[k] = a[j];
        }
    }
}

class Search {
  public:
    Search(const Mesh& mesh, const SelfIntersectionOptions& options)
        : mesh_(mesh),
          tolerance_(options.tolerance),
          in_faces_(flags(options.faces)),
          in_against_(flags(options.against)),
          triangulation_(
              triangulate_faces(mesh.topology(), mesh.positions(), faces_that_may_meet())) {
        boxes_.reserve(triangulation_.triangles.size());
        longest_.reserve(triangulation_.triangles.size());
        for (const Triangle& t : triangulation_.triangles) {
            boxes_.push_back(box_of(t));
            longest_.push_back(longest_side_of(t));
        }
    }

    std::vector<FacePair> find(const Context& context) const {
        std::vector<Index> first = chosen(in_faces_), second = chosen(in_against_);
        if (first.size() > second.size()) std::swap(first, second);
        const PairTree tree(boxes_, std::move(first));
        const auto count = count_of(second);
        std::vector<std::vector<FacePair>> found((count + kIntersectionGrain - 1) /
                                                 kIntersectionGrain);
        context.parallel_for(0, count, kIntersectionGrain, [&](Index begin, Index end) {
            context.checkpoint();
            for (Index i = begin; i < end; ++i) {
                tree.visit(boxes_[second[i]], [&](Index other) {
                    test(second[i], other, found[begin / kIntersectionGrain]);
                });
            }
        });
        std::vector<FacePair> pairs;
        for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }

  private:
    std::vector<char> flags(const std::optional<std::vector<Index>>& faces) const {
        const std::size_t count = mesh_.face_count();
        if (!faces) return std::vector<char>(count, 1);
        require_faces(mesh_.topology(), *faces);
        std::vector<char> chosen(count, 0);
        for (const Index f : *faces) chosen[f] = 1;
        return chosen;
    }

    // Returns the box of some vertices, with room for touching faces.
    Box box_of(std::span<const Index> vertices) const {
        Box box;
        for (const Index v : vertices) box.extend(mesh_.position(v));
        const Vec3 margin = Vec3::Constant(tolerance_ * box.diagonal());
        return {box.min - margin, box.max + margin};
    }

    double longest_side_of(const Triangle& t) const {
        double squared = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 side = mesh_.position(t[k]) - mesh_.position(t[(k + 1) % 3]);
            squared = std::max(squared, side.squaredNorm());
        }
        return std::sqrt(squared);
    }

    // Returns the faces of either set that are near the other.
    std::vector<Index> faces_that_may_meet() const {
        Box of_faces, of_others;
        const Index count = mesh_.face_count();
        std::vector<Box> boxes;
        boxes.reserve(at(count));
        for (Index f = 0; f < count; ++f) {
            boxes.push_back(box_of(mesh_.topology().face(f)));
            if (in_faces_[at(f)]) extend(of_faces, boxes.back());
            if (in_against_[at(f)]) extend(of_others, boxes.back());
        }
        std::vector<Index> faces;
        for (Index f = 0; f < count; ++f) {
            const Box& box = boxes[at(f)];
            if ((in_faces_[at(f)] && overlap(box, of_others)) ||
                (in_against_[at(f)] && overlap(box, of_faces))) {
                faces.push_back(f);
            }
        }
        return faces;
    }

    static void extend(Box& box, const Box& by) {
        box.extend(by.min);
        box.extend(by.max);
    }

    std::vector<Index> chosen(const std::vector<char>& face_chosen) const {
        std::vector<Index> triangles;
        for (std::size_t t = 0; t < triangulation_.triangles.size(); ++t) {
            if (face_chosen[triangulation_.face[t]]) triangles.push_back(index_of(t));
        }
        return triangles;
    }

    void test(Index t, Index u, std::vector<FacePair>& found) const {
        const Index f = triangulation_.face[t], g = triangulation_.face[u];
        if (f == g) return;
        // A pair that both triangles will be asked about is tested once.
        const bool twice = in_faces_[f] && in_faces_[g] && in_against_[f] && in_against_[g];
        if (twice && t > u) return;
        Triangle a = triangulation_.triangles[t], b = triangulation_.triangles[u];
        std::array<Vec3, 3> p, q;
        for (int k = 0; k < 3; ++k) {
            p[k] = mesh_.position(a[k]);
            q[k] = mesh_.position(b[k]);
        }
        number_by_place(p, q, a, b);
        const double longest = std::max(longest_[at(t)], longest_[at(u)]);
        if (triangles_intersect(a, p, b, q, tolerance_ * longest)) {
            found.push_back({std::min(f, g), std::max(f, g)});
        }
    }

    const Mesh& mesh_;
    double tolerance_;
    std::vector<char> in_faces_, in_against_;
    Triangulation triangulation_;
    std::vector<Box> boxes_;
    std::vector<double> longest_;
};

}  // namespace

std::vector<FacePair> self_intersections(const Mesh& mesh, const SelfIntersectionOptions& options,
                                         const Context& context) {
    if (!(options.tolerance >= 0.0 && options.tolerance <= 1.0)) {
        throw Error(ErrorCode::invalid_argument, "tolerance must lie between 0 and 1");
    }
    Progress progress(context, "self-intersections");
    // Boxes of triangles and a tree of them.
    constexpr std::size_t kBytesPerCorner = 120;
    const MemoryCharge working =
        context.charge(kBytesPerCorner * at(mesh.topology().corner_count()), "self-intersections");
    return Search(mesh, options).find(context);
}

}  // namespace lissom
