#include "kernel/mesh/fill/bridge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Vertices of a boundary, and the part of its length that lies before each.
struct Rim {
    std::vector<Index> vertices;
    std::vector<Vec3> points;
    std::vector<double> fractions;
    double length = 0.0;

    Index size() const { return count_of(vertices); }
    Index vertex(Index k) const { return vertices[at(k % size())]; }
    const Vec3& point(Index k) const { return points[at(k % size())]; }
    // Grows by 1 with each round.
    double fraction(Index k) const {
        const Index rounds = k / size();
        return fractions[at(k % size())] + rounds;
    }

    Vec3 point_at(double fraction) const {
        const double t = fraction - std::floor(fraction);
        const auto next = std::upper_bound(fractions.begin(), fractions.end(), t);
        const Index k = index_of(next - fractions.begin()) - 1;
        const double width = this->fraction(k + 1) - this->fraction(k);
        const double part = width > 0.0 ? (t - this->fraction(k)) / width : 0.0;
        return (1.0 - part) * point(k) + part * point(k + 1);
    }
};

Rim rim_of(const Mesh& mesh, std::vector<Index> loop) {
    Rim rim{std::move(loop), {}, {}, 0.0};
    for (const Index v : rim.vertices) rim.points.push_back(mesh.position(v));
    for (Index k = 0; k < rim.size(); ++k) {
        rim.fractions.push_back(rim.length);
        rim.length += (rim.point(k + 1) - rim.point(k)).norm();
    }
    for (Index k = 0; k < rim.size(); ++k) {
        double& fraction = rim.fractions[at(k)];
        fraction = rim.length > 0.0 ? fraction / rim.length : k / double(rim.size());
    }
    return rim;
}

// The boundary with the surface on its left, from its smallest vertex.
const std::vector<Index>& rim_loop(const Mesh& mesh, const Path& path) {
    if (path.on_mesh()) require_same_topology(mesh, path.topology(), "the boundary");
    if (path.is_boundary()) {
        const Index smallest = *std::min_element(path.vertices().begin(), path.vertices().end());
        for (const std::vector<Index>& loop : mesh.topology().boundary_loops()) {
            if (loop[0] == smallest) return loop;
        }
    }
    throw Error(ErrorCode::not_a_boundary,
                "only open boundaries of the mesh can be bridged; take two of its boundaries");
}

Vec3 centre(const Rim& rim) {
    const Vec3 sum = std::accumulate(rim.points.begin(), rim.points.end(), Vec3(Vec3::Zero()));
    return sum / rim.size();
}

Vec3 area_of(const Rim& rim) {
    Vec3 sum = Vec3::Zero();
    for (Index k = 0; k < rim.size(); ++k) {
        sum += 0.5 * (rim.point(k) - rim.point(0)).cross(rim.point(k + 1) - rim.point(0));
    }
    return sum;
}

// A way between the boundaries is along their axes if its cosine with them is above this.
constexpr double kAlong = 0.7;

// Both run the same way along the strip. Beside one another in a surface they turn against each
// other and the strip is a handle; one behind the other, or one within the other, they may not.
void require_facing(const Rim& a, const Rim& b) {
    const Vec3 first = area_of(a), second = area_of(b), way = centre(b) - centre(a);
    const double size = first.norm() * second.norm();
    if (!(first.dot(second) < -kAlong * size)) return;
    const double distance = way.norm();
    const bool along = std::abs(way.dot(first)) > kAlong * distance * first.norm() &&
                       std::abs(way.dot(second)) > kAlong * distance * second.norm();
    const bool within = distance < std::sqrt(std::min(first.norm(), second.norm()) / kPi);
    if (!along && !within) return;
    throw Error(ErrorCode::inconsistent_orientation,
                "the surfaces at the two boundaries face opposite sides: a tube between them would "
                "have one side only; turn one part over first (flip), or choose another boundary",
                {ElementKind::vertex, 2, {a.vertex(0), b.vertex(0)}});
}

// Points along a boundary that are compared with those of the other.
constexpr Index kCompared = 64;

double distance_from(const Rim& a, const Rim& b, Index start) {
    double sum = 0.0;
    for (Index k = 0; k < kCompared; ++k) {
        const double t = k / double(kCompared);
        sum += (a.point_at(a.fraction(0) + t) - b.point_at(b.fraction(start) + t)).squaredNorm();
    }
    return sum;
}

// Triangles between two boundaries that run the same way.
class Strip {
  public:
    Strip(const Mesh& mesh, const Rim& a, const Rim& b)
        : mesh_(mesh), a_(a), b_(b), scale_(0.5 * (a.length + b.length)) {}

    // Whether each triangle goes on along the first boundary, from vertex 0 of it and `start()`.
    std::vector<char> steps(const Context& context) {
        choose_start(context);
        const std::size_t n = at(a_.size()), m = at(b_.size());
        const MemoryCharge working = context.charge((n + 1) * (m + 1), "bridging boundaries");
        along_a_.assign((n + 1) * (m + 1), 0);
        find_cheapest(context);
        std::vector<char> steps;
        for (std::size_t i = n, j = m; i + j > 0;) {
            steps.push_back(along_a_[i * (m + 1) + j]);
            --(steps.back() ? i : j);
        }
        std::reverse(steps.begin(), steps.end());
        return steps;
    }

    Index start() const { return start_; }

  private:
    bool taken(Index i, Index j) const {
        const std::span<const Index> around = mesh_.topology().neighbors(a_.vertex(i));
        return std::find(around.begin(), around.end(), b_.vertex(start_ + j)) != around.end();
    }

    void choose_start(const Context& context) {
        double best = kInfinite;
        Index found = kNoIndex;
        for (start_ = 0; start_ < b_.size(); ++start_) {
            context.checkpoint();
            if (taken(0, 0)) continue;
            const double distance = distance_from(a_, b_, start_);
            if (distance < best) {
                best = distance;
                found = start_;
            }
        }
        if (found == kNoIndex) refuse();
        start_ = found;
    }

    double cost(Index i, Index j) const {
        if (taken(i, j)) return kInfinite;
        const double shift =
            (a_.fraction(i) - a_.fraction(0)) - (b_.fraction(start_ + j) - b_.fraction(start_));
        return (a_.point(i) - b_.point(start_ + j)).squaredNorm() + scale_ * scale_ * shift * shift;
    }

    void find_cheapest(const Context& context) {
        const Index n = a_.size(), m = b_.size();
        std::vector<double> before(at(m) + 1, kInfinite), row(at(m) + 1);
        for (Index i = 0; i <= n; ++i) {
            context.checkpoint();
            for (Index j = 0; j <= m; ++j) {
                const double along_a = before[at(j)];
                const double along_b = j > 0 ? row[at(j - 1)] : kInfinite;
                const bool first = i == 0 && j == 0;
                // Along one boundary alone the strip would end in an edge that it has already.
                const bool pinched = (i == n && j == 0) || (i == 0 && j == m);
                along_a_[at(i) * (at(m) + 1) + at(j)] = along_a < along_b;
                row[at(j)] = first     ? 0.0
                             : pinched ? kInfinite
                                       : std::min(along_a, along_b) + cost(i, j);
            }
            std::swap(before, row);
        }
        if (!std::isfinite(before[at(m)])) refuse();
    }

    [[noreturn]] void refuse() const {
        throw Error(ErrorCode::boundary_conflict,
                    "edges of the mesh join the two boundaries already and leave no strip between "
                    "them; subdivide the faces there, or fill one of the boundaries",
                    {ElementKind::vertex, 2, {a_.vertex(0), b_.vertex(0)}});
    }

    const Mesh& mesh_;
    const Rim& a_;
    const Rim& b_;
    double scale_;
    Index start_ = 0;
    std::vector<char> along_a_;
};

// The face that runs along a boundary edge, and its corners.
struct RimFace {
    const Topology& topology;
    Index face = kNoIndex;

    RimFace(const Topology& mesh_topology, Index from, Index to) : topology(mesh_topology) {
        for (const Index f : topology.faces_around(from)) {
            const std::span<const Index> around = topology.face(f);
            const std::size_t k = place(f, from);
            if (around[(k + 1) % around.size()] == to) face = f;
        }
    }
    Index corner(Index v) const { return topology.first_corner(face) + index_of(place(face, v)); }

  private:
    std::size_t place(Index f, Index v) const {
        const std::span<const Index> around = topology.face(f);
        return static_cast<std::size_t>(std::find(around.begin(), around.end(), v) -
                                        around.begin());
    }
};

// The mesh while triangles are added to it.
class BridgedMesh {
  public:
    explicit BridgedMesh(const Mesh& mesh)
        : mesh_(mesh),
          topology_(mesh.topology()),
          faces_(topology_.faces()),
          map_{ElementMap::identity(mesh.vertex_count()),
               ElementMap::identity(topology_.corner_count()),
               ElementMap::identity(mesh.face_count())} {}

    // Over the edge that the surface has from `from` to `to`, to a vertex of the other boundary.
    void add(Index from, Index to, Index tip, const RimFace& beside_tip) {
        const RimFace beside(topology_, from, to);
        faces_.add(Triangle{to, from, tip});
        map_.faces.add_copy(beside.face);
        beside_.push_back(beside.face);
        map_.corners.add_copy(beside.corner(to));
        map_.corners.add_copy(beside.corner(from));
        map_.corners.add_copy(beside_tip.corner(tip));
    }

    Mesh finish(const Context& context) {
        std::vector<Vec3> positions(mesh_.positions().begin(), mesh_.positions().end());
        return derive(mesh_, std::move(positions), std::move(faces_), map_, context);
    }

    const Topology& topology() const { return topology_; }
    const std::vector<Index>& beside() const { return beside_; }

  private:
    const Mesh& mesh_;
    const Topology& topology_;
    std::vector<Index> beside_;
    FaceList faces_;
    MeshMap map_;
};

void add_strip(const Rim& a, const Rim& b, const std::vector<char>& steps, Index start,
               BridgedMesh& result) {
    Index i = 0, j = start;
    for (const char along_a : steps) {
        // The surface has the edges of `a` in its own order, and those of `b` in the other.
        if (along_a) {
            const RimFace beside(result.topology(), b.vertex(j + 1), b.vertex(j));
            result.add(a.vertex(i), a.vertex(i + 1), b.vertex(j), beside);
            ++i;
        } else {
            const RimFace beside(result.topology(), a.vertex(i), a.vertex(i + 1));
            result.add(b.vertex(j + 1), b.vertex(j), a.vertex(i), beside);
            ++j;
        }
    }
}

}  // namespace

BridgeReport bridge(Mesh& mesh, const Path& a, const Path& b, const Context& context) {
    const std::vector<Index>& first = rim_loop(mesh, a);
    const std::vector<Index>& second = rim_loop(mesh, b);
    if (first[0] == second[0]) {
        throw Error(ErrorCode::boundary_conflict,
                    "a boundary cannot be bridged to itself; take two of the mesh, or fill it",
                    {ElementKind::vertex, 1, {first[0]}});
    }
    Progress progress(context, "bridge");
    const MemoryCharge working = context.charge(2 * mesh.memory_bytes(), "bridging boundaries");
    const Rim rim_a = rim_of(mesh, first), rim_b = rim_of(mesh, {second.rbegin(), second.rend()});
    require_facing(rim_a, rim_b);
    Strip strip(mesh, rim_a, rim_b);
    const std::vector<char> steps = strip.steps(context);
    BridgedMesh result(mesh);
    add_strip(rim_a, rim_b, steps, strip.start(), result);
    BridgeReport report{mesh.face_count(), count_of(steps), result.beside()};
    mesh.replace_by(result.finish(context));
    return report;
}

}  // namespace lissom
