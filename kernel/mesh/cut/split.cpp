#include "kernel/mesh/cut/split.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "kernel/mesh/cut/contour_slide.h"

namespace lissom {
namespace {

using Sources = std::vector<ElementMap::Source>;

// A vertex of the split mesh: an old one, or a crossing, numbered after all old ones.
using Node = Index;

Sources blend(Index from, Index to, double t) {
    return {{from, 1.0 - t}, {to, t}};
}

// A corner of a new face.
struct Point {
    Node node;
    Sources corner;
};

// Squared length of a diagonal counts as equal within this fraction, so that rounding in a turned
// copy of the mesh does not change the choice.
constexpr double kTie = 1e-6;

// The faces of both parts are gathered here; each part numbers its vertices when it is made.
struct PartBuilder {
    std::vector<Node> nodes;
    std::vector<Index> offsets{0};
    MeshMap map;

    void add_face(Index old_face, std::span<const Point> points) {
        for (const Point& p : points) {
            nodes.push_back(p.node);
            map.corners.add_blend(p.corner);
        }
        offsets.push_back(count_of(nodes));
        map.faces.add_copy(old_face);
    }

    // An old face as it was.
    void copy_face(const Topology& topology, Index f) {
        const std::span<const Index> face = topology.face(f);
        nodes.insert(nodes.end(), face.begin(), face.end());
        offsets.push_back(count_of(nodes));
        for (Index c = topology.first_corner(f); c < topology.first_corner(f + 1); ++c) {
            map.corners.add_copy(c);
        }
        map.faces.add_copy(f);
    }
};

class Splitter {
  public:
    Splitter(const Mesh& mesh, const Splitting& splitting, const Context& context)
        : mesh_(mesh),
          topology_(mesh.topology()),
          splitting_(splitting),
          crossed_(splitting.lines),
          slides_(slide_vertices(mesh, splitting.lines, splitting.side, splitting.slide, crossed_,
                                 context)) {
        find_divided_faces();
        find_slid_corners();
    }

    SplitResult result(const Context& context) {
        distribute_faces(context);
        SplitResult result;
        result.divided_faces = count_of(divided_);
        for (Index v = 0; v < topology_.vertex_count(); ++v) {
            if (slides_.has(v)) result.slid.push_back(v);
        }
        result.positive = part(1, context);
        result.negative = part(-1, context);
        return result;
    }

  private:
    void find_divided_faces() {
        is_divided_.assign(topology_.face_count(), 0);
        for (const ContourLine& line : splitting_.lines) {
            for (const Index f : line.faces) is_divided_[f] = 1;
        }
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (is_divided_[f] && stays_whole(f)) is_divided_[f] = 0;
            if (is_divided_[f]) divided_.push_back(f);
        }
    }

    // A line need not pass through the inside of a face that it touches: it may follow an edge or
    // pass through one vertex. If more vertices slid, a triangle of the face may lie between them.
    bool stays_whole(Index f) const {
        signed char side = 0;
        int slid = 0;
        for (const Index v : topology_.face(f)) {
            if (slides_.has(v)) {
                ++slid;
                continue;
            }
            if (side == -splitting_.side[v]) return false;
            side = splitting_.side[v];
        }
        return slid <= 2;
    }

    signed char side_of_whole(Index f) const {
        for (const Index v : topology_.face(f)) {
            if (!slides_.has(v)) return splitting_.side[v];
        }
        return splitting_.side[topology_.face(f)[0]];
    }

    void find_slid_corners() {
        for (Index v = 0; v < topology_.vertex_count(); ++v) {
            if (!slides_.has(v)) continue;
            const Crossing& c = crossed_[slides_.crossing_of[v]];
            const double t = v == c.positive ? c.t : 1.0 - c.t;
            const auto pairs = corners_along(mesh_, v, c.other(v));
            const std::span<const Index> faces = topology_.faces_around(v);
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                if (!pairs[i]) continue;
                const std::span<const Index> face = topology_.face(faces[i]);
                const auto k = std::find(face.begin(), face.end(), v) - face.begin();
                slid_corners_.emplace(topology_.first_corner(faces[i]) + index_of(k),
                                      blend((*pairs[i])[0], (*pairs[i])[1], t));
            }
        }
    }

    Sources corner_sources(Index corner) const {
        const auto found = slid_corners_.find(corner);
        return found == slid_corners_.end() ? Sources{{corner, 1.0}} : found->second;
    }

    PartBuilder& builder(signed char side) { return side > 0 ? positive_ : negative_; }

    void distribute_faces(const Context& context) {
        const Triangulation divided = triangulate_faces(topology_, mesh_.positions(), divided_);
        std::size_t next = 0;
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (f % 8192 == 0) context.checkpoint();
            if (!is_divided_[f]) {
                give_whole_face(f);
                continue;
            }
            for (; next < divided.face.size() && divided.face[next] == f; ++next) {
                divide_triangle(f, divided.triangles[next], divided.corners[next]);
            }
        }
    }

    void give_whole_face(Index f) {
        const std::span<const Index> face = topology_.face(f);
        PartBuilder& part = builder(side_of_whole(f));
        const bool any_slid =
            std::any_of(face.begin(), face.end(), [&](Index v) { return slides_.has(v); });
        if (!any_slid) return part.copy_face(topology_, f);
        std::vector<Point> points;
        for (std::size_t k = 0; k < face.size(); ++k) {
            points.push_back({face[k], corner_sources(topology_.first_corner(f) + index_of(k))});
        }
        part.add_face(f, points);
    }

    // The points of a triangle that lie in each part, those on the line in both.
    void divide_triangle(Index f, const Triangle& t, const Triangle& corners) {
        std::vector<Point> positive, negative;
        bool crossed = false;
        for (int k = 0; k < 3; ++k) {
            const int l = (k + 1) % 3;
            const Point here{t[k], corner_sources(corners[k])};
            if (slides_.has(t[k]) || splitting_.side[t[k]] > 0) positive.push_back(here);
            if (slides_.has(t[k]) || splitting_.side[t[k]] < 0) negative.push_back(here);
            const Index crossing = crossed_.find(t[k], t[l]);
            if (crossing == kNoIndex) continue;
            crossed = true;
            if (slides_.has(t[k]) || slides_.has(t[l])) continue;
            const bool descends = t[k] == crossed_[crossing].positive;
            const Point on_line{
                topology_.vertex_count() + crossing,
                blend(corners[descends ? k : l], corners[descends ? l : k], crossed_[crossing].t)};
            positive.push_back(on_line);
            negative.push_back(on_line);
        }
        if (crossed) {
            add_polygon(positive_, f, positive);
            add_polygon(negative_, f, negative);
        } else {
            add_polygon(builder(splitting_.side[t[0]]), f,
                        splitting_.side[t[0]] > 0 ? positive : negative);
        }
    }

    void add_polygon(PartBuilder& part, Index f, const std::vector<Point>& p) const {
        if (p.size() == 3) part.add_face(f, p);
        if (p.size() != 4) return;
        if (first_diagonal_is_better(p)) {
            part.add_face(f, std::array{p[0], p[1], p[2]});
            part.add_face(f, std::array{p[0], p[2], p[3]});
        } else {
            part.add_face(f, std::array{p[0], p[1], p[3]});
            part.add_face(f, std::array{p[1], p[2], p[3]});
        }
    }

    // Delaunay: the angles that face the diagonal sum to less than a half turn.
    bool first_diagonal_is_better(const std::vector<Point>& p) const {
        std::array<Vec3, 4> x;
        for (std::size_t k = 0; k < 4; ++k) x[k] = position(p[k].node);
        const auto cotangent = [&](int at, int a, int b) {
            const Vec3 u = x[a] - x[at], v = x[b] - x[at];
            const double sine = u.cross(v).norm();
            return sine > 0.0 ? u.dot(v) / sine : 0.0;
        };
        return cotangent(1, 0, 2) + cotangent(3, 2, 0) >= -kTie;
    }

    Vec3 position(Node node) const {
        const Index crossing = node - topology_.vertex_count();
        return crossing >= 0 ? crossed_[crossing].point(mesh_)
                             : position_after(mesh_, slides_, crossed_, node);
    }

    SplitPart part(signed char side, const Context& context) {
        PartBuilder& built = builder(side);
        std::vector<Index> number = numbers(built, side);
        SplitPart part;
        std::vector<Vec3> positions;
        for (Node node = 0; node < static_cast<Node>(number.size()); ++node) {
            if (number[node] == kNoIndex) continue;
            positions.push_back(position(node));
            add_vertex(built.map.vertices, node);
        }
        FaceList faces{std::move(built.offsets), std::move(built.nodes)};
        for (Index& v : faces.vertices) v = number[v];
        part.mesh = derive(mesh_, std::move(positions), std::move(faces), built.map, context);
        part.map = std::move(built.map);
        for (std::size_t i = 0; i < splitting_.lines.size(); ++i) {
            part.lines.push_back(path(i, side, number, part.mesh));
        }
        return part;
    }

    // New numbers of the nodes that the part's faces use, and of its vertices without faces.
    std::vector<Index> numbers(const PartBuilder& built, signed char side) const {
        std::vector<Index> number(topology_.vertex_count() + crossed_.size(), kNoIndex);
        for (const Node node : built.nodes) number[node] = 0;
        Index next = 0;
        for (Node node = 0; node < static_cast<Node>(number.size()); ++node) {
            const bool loose = node < topology_.vertex_count() && topology_.is_isolated(node) &&
                               splitting_.side[node] == side;
            if (number[node] == 0 || loose) number[node] = next++;
        }
        return number;
    }

    void add_vertex(ElementMap& map, Node node) const {
        const Index crossing = node < topology_.vertex_count() ? slides_.crossing_of[node]
                                                               : node - topology_.vertex_count();
        if (crossing == kNoIndex) return map.add_copy(node);
        const Crossing& c = crossed_[crossing];
        map.add_blend(blend(c.positive, c.negative, c.t));
    }

    Path path(std::size_t line, signed char side, const std::vector<Index>& number,
              const Mesh& mesh) const {
        std::vector<Index> vertices;
        for (const Node node : nodes_of(line)) vertices.push_back(number[node]);
        const Path forward(mesh.shared_topology(), vertices, splitting_.lines[line].closed);
        return side > 0 ? forward : forward.reversed();
    }

    // The nodes of a line in order: a crossing that ends slid to is replaced by them.
    std::vector<Node> nodes_of(std::size_t line) const {
        const auto n = count_of(splitting_.lines[line].crossings);
        const bool closed = splitting_.lines[line].closed;
        std::vector<Node> nodes;
        for (Index i = 0; i < n; ++i) {
            const Index crossing = crossed_.first(line) + i;
            const Crossing& c = crossed_[crossing];
            const bool p = slides_.has(c.positive), q = slides_.has(c.negative);
            if (!p && !q) {
                nodes.push_back(topology_.vertex_count() + crossing);
            } else if (p != q) {
                push_different(nodes, p ? c.positive : c.negative);
            } else {
                // The line comes along the edge, or only past the end that both neighbours share.
                for (const Index step : {-1, 1}) push_different(nodes, shared_end(line, i, step));
            }
        }
        if (closed && nodes.size() > 1 && nodes.front() == nodes.back()) nodes.pop_back();
        return nodes;
    }

    static void push_different(std::vector<Node>& nodes, Node node) {
        const bool same = !nodes.empty() && nodes.back() == node;
        if (node != kNoIndex && !same) nodes.push_back(node);
    }

    // The end that a crossing shares with the one before (step -1) or after it (step 1) on its
    // line; kNoIndex if there is none.
    Index shared_end(std::size_t line, Index i, Index step) const {
        const std::vector<Crossing>& c = splitting_.lines[line].crossings;
        const auto n = count_of(c);
        const bool ends = i + step < 0 || i + step >= n;
        if (ends && !splitting_.lines[line].closed) return kNoIndex;
        const Crossing& other = c[(i + step + n) % n];
        return other.positive == c[i].positive ? c[i].positive : c[i].negative;
    }

    const Mesh& mesh_;
    const Topology& topology_;
    const Splitting& splitting_;
    CrossedEdges crossed_;
    Slides slides_;
    std::vector<char> is_divided_;
    std::vector<Index> divided_;
    std::map<Index, Sources> slid_corners_;
    PartBuilder positive_, negative_;
};

}  // namespace

SplitResult split(const Mesh& mesh, const Splitting& splitting, const Context& context) {
    return Splitter(mesh, splitting, context).result(context);
}

}  // namespace lissom
