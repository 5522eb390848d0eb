#include "kernel/merge/merge_side.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "kernel/merge/provenance.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// A volume this part of that of a ball with the same area says which way the surface looks.
constexpr double kClearVolume = 1e-3;
// Segments that come closer than this part of the loop's length cross.
constexpr double kCrossing = 1e-9;

Elements elements_of(std::span<const Index> vertices) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : vertices) elements.add(v);
    return elements;
}

// The boundary loop that `path` runs along.
const std::vector<Index>& loop_of(const Mesh& mesh, const Path& path, const std::string& name) {
    if (!path.on_mesh() || !path.is_boundary()) {
        const Elements elements = elements_of(path.vertices());
        const std::string at = elements.count > 0 ? " at " + describe(elements) : "";
        const char* open = path.closed() ? "" : ", which is open,";
        throw Error(ErrorCode::not_a_boundary,
                    "a path of the " + name + at + open +
                        " is not one of its open boundaries; take one of those, or cut the mesh "
                        "along it first",
                    elements);
    }
    for (const std::vector<Index>& loop : mesh.topology().boundary_loops()) {
        if (std::find(loop.begin(), loop.end(), path.vertices().front()) != loop.end()) return loop;
    }
    throw Error(ErrorCode::internal, "a boundary has no loop");
}

double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto to_segment = [](const Vec3& p, const Vec3& from, const Vec3& to) {
        const Vec3 side = to - from;
        const double squared = side.squaredNorm();
        const double t = squared > 0.0 ? std::clamp((p - from).dot(side) / squared, 0.0, 1.0) : 0.0;
        return (p - from - t * side).norm();
    };
    const Vec3 u = b - a, v = d - c, normal = u.cross(v);
    const double squared = normal.squaredNorm();
    if (squared > 1e-24 * u.squaredNorm() * v.squaredNorm()) {
        const double s = (c - a).cross(v).dot(normal) / squared;
        const double t = (c - a).cross(u).dot(normal) / squared;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
            return std::abs((c - a).dot(normal)) / std::sqrt(squared);
        }
    }
    return std::min(
        {to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
}

// Sweeps along the axis in which the loop is longest.
void require_simple(const Mesh& mesh, const std::vector<Index>& loop, const std::string& name) {
    const std::size_t n = loop.size();
    Box box;
    for (const Index v : loop) box.extend(mesh.position(v));
    const double tolerance = kCrossing * box.diagonal();
    Index axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.position(loop[k % n]); };
    const auto low = [&](std::size_t k) { return std::min(at(k)[axis], at(k + 1)[axis]); };
    const auto high = [&](std::size_t k) { return std::max(at(k)[axis], at(k + 1)[axis]); };
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t a = order[i];
        for (std::size_t j = i + 1; j < n && low(order[j]) <= high(a) + tolerance; ++j) {
            const std::size_t b = order[j], apart = a < b ? b - a : a - b;
            if (apart <= 1 || apart == n - 1) continue;
            if (segment_distance(at(a), at(a + 1), at(b), at(b + 1)) > tolerance) continue;
            const std::vector<Index> ends{loop[a], loop[(a + 1) % n], loop[b], loop[(b + 1) % n]};
            Elements elements = elements_of(ends);
            throw Error(ErrorCode::boundary_conflict,
                        "a boundary of the " + name + " crosses itself at " + describe(elements) +
                            "; move these vertices apart, or cut the mesh along another curve",
                        elements);
        }
    }
}

// Moves a loop to a new mesh by the vertices that stayed.
std::vector<Index> carried_loop(const std::vector<Index>& loop, const std::vector<Index>& kept) {
    std::vector<Index> result;
    for (const Index v : loop) result.push_back(kept[v]);
    return result;
}

}  // namespace

Region MergeSide::carried(const Region& given) const {
    std::vector<Index> vertices;
    for (Index v = 0; v < map.vertices.size(); ++v) {
        const auto sources = map.vertices[v];
        if (!sources.empty() && std::all_of(sources.begin(), sources.end(), [&](const auto& s) {
                return given.contains(s.element);
            })) {
            vertices.push_back(v);
        }
    }
    return Region(mesh.shared_topology(), std::move(vertices));
}

MergeSide make_side(const Mesh& mesh, const std::vector<Path>& boundaries,
                    const std::string& name) {
    MergeSide side{mesh, identity_map(mesh.topology()), {}, {}, {}, {}, false};
    for (const Path& path : boundaries) {
        if (path.on_mesh())
            require_same_topology(mesh, path.topology(), "a boundary of the " + name);
        const std::vector<Index>& loop = loop_of(mesh, path, name);
        if (std::find(side.loops.begin(), side.loops.end(), loop) != side.loops.end()) {
            Elements elements = elements_of(loop);
            throw Error(ErrorCode::boundary_conflict,
                        "two joins use the boundary of the " + name + " at " + describe(elements) +
                            "; each boundary can be joined once",
                        elements);
        }
        require_simple(mesh, loop, name);
        side.loops.push_back(loop);
        side.turns.push_back(mean_turn(mesh, Path(mesh.shared_topology(), loop, true)));
    }
    side.trimmed.assign(side.loops.size(), 0);
    return side;
}

void orient(MergeSide& side, const Context& context) {
    const double ball = std::pow(area(side.mesh), 1.5) / (6.0 * std::sqrt(kPi));
    if (!(volume(side.mesh) < -kClearVolume * ball)) return;
    const MeshMap map = flipped_map(side.mesh.topology());
    flip(side.mesh, context);
    side.map = composed(map, side.map);
    side.flipped = true;
    for (std::vector<Index>& loop : side.loops) std::reverse(loop.begin(), loop.end());
}

void trim_jagged(MergeSide& side, double max_turn, const Context& context) {
    for (std::size_t k = 0; k < side.loops.size(); ++k) {
        const Path boundary(side.mesh.shared_topology(), side.loops[k], true);
        // A loop of few vertices turns by much without being jagged.
        const double smooth = 2.0 * kPi / side.loops[k].size();
        if (side.turns[k] - smooth <= max_turn) continue;
        if (!side.fits.empty() && side.fits[k]) continue;
        try {
            Trim trimmed = trim(side.mesh, boundary, {}, context);
            const std::vector<Index> kept =
                kept_vertices(trimmed.map.vertices, side.mesh.vertex_count());
            for (std::size_t other = 0; other < side.loops.size(); ++other) {
                side.loops[other] = other == k ? trimmed.boundary.vertices()
                                               : carried_loop(side.loops[other], kept);
            }
            side.map = composed(trimmed.map, side.map);
            side.mesh = std::move(trimmed.mesh);
            side.trimmed[k] = 1;
        } catch (const Error& error) {
            // Without room for a smooth line, a jagged seam is better than none.
            if (error.code() != ErrorCode::boundary_conflict) throw;
            side.untrimmed.push_back(error.message());
        }
    }
}

}  // namespace lissom
