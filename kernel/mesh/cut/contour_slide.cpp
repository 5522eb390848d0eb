#include "kernel/mesh/cut/contour_slide.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace lissom {
namespace {

// Limit of a face corner's move off its plane by a slide, as a fraction of the edge slid along.
constexpr double kMaxOffPlane = 0.06;
// A face's smallest angle may be halved by a slide, but not below this one.
constexpr double kSmallAngle = 10.0 * kPi / 180.0;
// Crossings stay this far from the ends of their edge if those do not slide. Seams may be displaced
// by as much.
constexpr double kMinFraction = 0.03;

double angle(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

bool is_boundary_edge(const Topology& topology, Index a, Index b) {
    const std::span<const Index> ring = topology.neighbors(a);
    return topology.is_boundary(a) && (ring.front() == b || ring.back() == b);
}

Index local_corner(std::span<const Index> face, Index v) {
    return index_of(std::find(face.begin(), face.end(), v) - face.begin());
}

// Decides slides one by one; each must keep the earlier decisions valid.
class Slider {
  public:
    Slider(const Mesh& mesh, const std::vector<ContourLine>& lines,
           const std::vector<signed char>& side, double limit, const CrossedEdges& crossed)
        : mesh_(mesh), topology_(mesh.topology()), side_(side), limit_(limit), crossed_(crossed) {
        for (const ContourLine& line : lines) {
            triangles_.insert(triangles_.end(), line.triangles.begin(), line.triangles.end());
        }
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            for (const Index v : triangles_[i]) at_vertex_.emplace_back(v, i);
        }
        std::sort(at_vertex_.begin(), at_vertex_.end());
        slides_.crossing_of.assign(topology_.vertex_count(), kNoIndex);
    }

    Slides decide(const Context& context) {
        for (const Candidate& c : candidates()) {
            context.checkpoint();
            slides_.crossing_of[c.vertex] = c.crossing;
            if (!keeps_line_simple(c.vertex) || !keeps_surface(c) || !keeps_seams(c)) {
                slides_.crossing_of[c.vertex] = kNoIndex;
            }
        }
        return std::move(slides_);
    }

  private:
    struct Candidate {
        Index vertex, crossing;
        double fraction, length;
    };

    // One slide for each vertex that may: the shortest. In the order in which they are tried.
    std::vector<Candidate> candidates() const {
        std::vector<Candidate> all;
        for (Index i = 0; i < crossed_.size(); ++i) {
            const Crossing& c = crossed_[i];
            const double length = (mesh_.position(c.positive) - mesh_.position(c.negative)).norm();
            all.push_back({c.positive, i, c.t, c.t * length});
            all.push_back({c.negative, i, 1.0 - c.t, (1.0 - c.t) * length});
        }
        std::erase_if(
            all, [&](const Candidate& c) { return !(c.fraction <= limit_) || leaves_boundary(c); });
        std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
            return std::tie(a.vertex, a.length, a.crossing) <
                   std::tie(b.vertex, b.length, b.crossing);
        });
        const auto same = [](const auto& a, const auto& b) { return a.vertex == b.vertex; };
        all.erase(std::unique(all.begin(), all.end(), same), all.end());
        std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
            return std::tie(a.fraction, a.vertex) < std::tie(b.fraction, b.vertex);
        });
        return all;
    }

    bool leaves_boundary(const Candidate& c) const {
        return topology_.is_boundary(c.vertex) &&
               !is_boundary_edge(topology_, c.vertex, crossed_[c.crossing].other(c.vertex));
    }

    template <typename Visit>
    void for_each_triangle_at(Index v, const Visit& visit) const {
        auto i = std::lower_bound(at_vertex_.begin(), at_vertex_.end(),
                                  std::pair<Index, std::size_t>(v, 0));
        for (; i != at_vertex_.end() && i->first == v; ++i) {
            const Triangle& t = triangles_[i->second];
            const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            visit(t[(k + 1) % 3], t[(k + 2) % 3]);
        }
    }

    // Around every vertex on the line there must be one run of each side.
    bool keeps_line_simple(Index v) const {
        bool simple = passes_once(v);
        for_each_triangle_at(v, [&](Index a, Index b) {
            if (!simple) return;
            if (slides_.has(a)) simple = passes_once(a);
            if (simple && slides_.has(b)) simple = passes_once(b);
        });
        return simple;
    }

    // Both sides of an edge from a vertex to another one on the line.
    struct Spoke {
        Index to;
        signed char left, right;
    };

    Spoke& spoke(std::vector<Spoke>& spokes, Index v, Index to) const {
        const auto found =
            std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& s) { return s.to == to; });
        if (found != spokes.end()) return *found;
        return spokes.emplace_back(Spoke{to, side_[v], side_[v]});
    }

    bool passes_once(Index v) const {
        std::vector<Spoke> spokes;
        int changes = 0;
        bool flat = false;
        for_each_triangle_at(v, [&](Index a, Index b) {
            const bool slid_a = slides_.has(a), slid_b = slides_.has(b);
            flat = flat || (slid_a && slid_b);
            if (slid_a && !slid_b) spoke(spokes, v, a).left = side_[b];
            if (slid_b && !slid_a) spoke(spokes, v, b).right = side_[a];
            if (!slid_a && !slid_b && side_[a] != side_[b]) ++changes;
        });
        for (const Spoke& s : spokes) {
            changes += s.left != s.right && !is_boundary_edge(topology_, v, s.to);
        }
        return !flat && changes == (topology_.is_boundary(v) ? 1 : 2);
    }

    bool keeps_surface(const Candidate& c) const {
        if (c.fraction == 0.0) return true;
        const Vec3& old = mesh_.position(c.vertex);
        const Vec3 moved = crossed_[c.crossing].point(mesh_);
        const Index toward = crossed_[c.crossing].other(c.vertex);
        const double most = kMaxOffPlane * (mesh_.position(toward) - old).norm();
        for (const Index f : topology_.faces_around(c.vertex)) {
            const std::span<const Index> face = topology_.face(f);
            const std::size_t n = face.size();
            const std::size_t k = local_corner(face, c.vertex);
            const Vec3 a = position(face[(k + 1) % n]), b = position(face[(k + n - 1) % n]);
            if (!keeps_face(old, moved, a, b, most)) return false;
        }
        return true;
    }

    static bool keeps_face(const Vec3& old, const Vec3& moved, const Vec3& a, const Vec3& b,
                           double max_off_plane) {
        const Vec3 before = (a - old).cross(b - old), after = (a - moved).cross(b - moved);
        const double area = before.norm();
        if (!(area > 0.0)) return true;
        if (!(before.dot(after) > 0.5 * area * after.norm())) return false;
        if (std::abs(before.dot(moved - old)) > max_off_plane * area) return false;
        const double least = std::min(0.5 * smallest_angle(old, a, b), kSmallAngle);
        return smallest_angle(moved, a, b) >= least;
    }

    bool keeps_seams(const Candidate& c) const {
        if (c.fraction <= kMinFraction) return true;
        const auto pairs = corners_along(mesh_, c.vertex, crossed_[c.crossing].other(c.vertex));
        return std::all_of(pairs.begin(), pairs.end(), [](const auto& p) { return p.has_value(); });
    }

    Vec3 position(Index v) const { return position_after(mesh_, slides_, crossed_, v); }

    const Mesh& mesh_;
    const Topology& topology_;
    const std::vector<signed char>& side_;
    double limit_;
    const CrossedEdges& crossed_;
    std::vector<Triangle> triangles_;
    // Pairs of a vertex and a crossed triangle around it, in order.
    std::vector<std::pair<Index, std::size_t>> at_vertex_;
    Slides slides_;
};

// True if the attributes of both faces go on across the edge they share at `v`.
bool is_seamless(const Mesh& mesh, Index f, Index g, Index v) {
    const Topology& topology = mesh.topology();
    const Index c = topology.first_corner(f) + local_corner(topology.face(f), v);
    const Index d = topology.first_corner(g) + local_corner(topology.face(g), v);
    for (const Attribute& attribute : mesh.attributes().all()) {
        const AttributeRole role = role_of(attribute);
        if (attribute.domain != Domain::corner || role == AttributeRole::normal ||
            role == AttributeRole::tangent) {
            continue;
        }
        const std::span<const double> a = attribute.at(c), b = attribute.at(d);
        for (std::size_t k = 0; k < a.size(); ++k) {
            if (a[k] != b[k] && !(std::isnan(a[k]) && std::isnan(b[k]))) return false;
        }
    }
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        if (labels.of_face[f] != labels.of_face[g]) return false;
    }
    return true;
}

// The faces around one vertex that have been given the corners they slide between.
class CornerWalk {
  public:
    CornerWalk(const Mesh& mesh, Index v, Index toward)
        : mesh_(mesh), v_(v), faces_(mesh.topology().faces_around(v)), pairs_(faces_.size()) {
        for (std::size_t i = 0; i < faces_.size(); ++i) start_at(i, toward);
        const std::vector<std::size_t> starts = found_;
        for (const std::size_t start : starts) {
            walk(start, 1);
            walk(start, faces_.size() - 1);
        }
    }

    std::vector<std::optional<CornerPair>> pairs() const { return pairs_; }

  private:
    void start_at(std::size_t i, Index toward) {
        const Topology& topology = mesh_.topology();
        const std::span<const Index> face = topology.face(faces_[i]);
        const Index there = local_corner(face, toward);
        if (there == count_of(face)) return;
        const Index first = topology.first_corner(faces_[i]);
        pairs_[i] = CornerPair{first + local_corner(face, v_), first + there};
        found_.push_back(i);
    }

    void walk(std::size_t i, std::size_t step) {
        const bool around = !mesh_.topology().is_boundary(v_);
        const std::size_t n = faces_.size();
        for (std::size_t next = (i + step) % n; !pairs_[next]; next = (next + step) % n) {
            const std::size_t last = step == 1 ? n - 1 : 0;
            if (!around && i == last) return;
            if (!is_seamless(mesh_, faces_[i], faces_[next], v_)) return;
            pairs_[next] = pairs_[i];
            i = next;
        }
    }

    const Mesh& mesh_;
    Index v_;
    std::span<const Index> faces_;
    std::vector<std::optional<CornerPair>> pairs_;
    std::vector<std::size_t> found_;
};

}  // namespace

Slides slide_vertices(const Mesh& mesh, const std::vector<ContourLine>& lines,
                      const std::vector<signed char>& side, double limit, CrossedEdges& crossed,
                      const Context& context) {
    Slides slides = Slider(mesh, lines, side, limit, crossed).decide(context);
    for (Index i = 0; i < crossed.size(); ++i) {
        Crossing& c = crossed[i];
        if (slides.has(c.positive) || slides.has(c.negative)) continue;
        c.t = std::clamp(c.t, kMinFraction, 1.0 - kMinFraction);
    }
    return slides;
}

Vec3 position_after(const Mesh& mesh, const Slides& slides, const CrossedEdges& crossed, Index v) {
    return slides.has(v) ? crossed[slides.crossing_of[v]].point(mesh) : mesh.position(v);
}

std::vector<std::optional<CornerPair>> corners_along(const Mesh& mesh, Index v, Index toward) {
    return CornerWalk(mesh, v, toward).pairs();
}

}  // namespace lissom
