#include <algorithm>
#include <cmath>

#include "kernel/core/memory_error.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/cut_parts.h"
#include "kernel/mesh/cut/surface_curve.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// The line is smoothed by a Gaussian of this many edges, but of no less than this fraction of its
// length.
constexpr double kSmoothedEdges = 2.0, kMinSmoothing = 0.01;

// Distances are known in a band that reaches this many edges beyond the path.
constexpr double kBandEdges = 3.0;

// A path may come back to a vertex on less than this part of its way.
constexpr std::size_t kDetour = 8;

void require_smoothing(double smoothing) {
    if (smoothing > 0.0 && smoothing <= 0.1) return;
    throw Error(ErrorCode::invalid_argument,
                "smoothing is a fraction of the line's length, above 0 and at most 0.1");
}

Elements vertices(std::span<const Index> ids) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : ids) elements.add(v);
    return elements;
}

// The vertices that the path goes through, or those nearest to its points.
std::vector<Index> stations(const Mesh& mesh, const Path& path, const Context& context) {
    if (path.on_mesh()) {
        require_same_topology(mesh, path.topology(), "the path");
        return path.vertices();
    }
    const SpatialTree tree(mesh, context);
    std::vector<Index> stations;
    for (const Vec3& p : path.points()) {
        const Index v = tree.nearest(p).vertex;
        if (stations.empty() || stations.back() != v) stations.push_back(v);
    }
    if (stations.size() > 1 && stations.front() == stations.back()) stations.pop_back();
    return stations;
}

// Returns a loop of vertices without short detours that come back to a vertex: shortest ways to
// picked points beside the loop go there and back again.
std::vector<Index> without_detours(const std::vector<Index>& loop) {
    const std::size_t longest = loop.size() / kDetour;
    std::vector<Index> kept;
    for (const Index v : loop) {
        const auto reach = static_cast<std::ptrdiff_t>(std::min(longest, kept.size()));
        const auto end = kept.rbegin() + reach;
        const auto before = std::find(kept.rbegin(), end, v);
        if (before == end) {
            kept.push_back(v);
        } else {
            kept.erase(before.base(), kept.end());
        }
    }
    return kept;
}

// The closed loop of edges that the path stands for.
std::vector<Index> loop_through(const Mesh& mesh, const Path& path, const Context& context) {
    if (!path.closed()) {
        throw Error(ErrorCode::invalid_argument,
                    "only a closed path can be cut along; close it, or cut by a plane");
    }
    const std::vector<Index> through = stations(mesh, path, context);
    if (through.size() < 3) {
        throw Error(ErrorCode::invalid_argument,
                    "the path needs points near at least 3 different vertices of the mesh",
                    vertices(through));
    }
    std::vector<Index> loop =
        without_detours(path_through(mesh, through, true, context).vertices());
    // The way back to the start may make a detour too.
    std::rotate(loop.begin(), loop.begin() + (loop.size() / 2), loop.end());
    loop = without_detours(loop);
    std::vector<Index> sorted = loop, repeated;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (sorted[i] == sorted[i - 1]) repeated.push_back(sorted[i]);
    }
    if (repeated.empty()) return loop;
    throw Error(ErrorCode::invalid_argument,
                "the path comes through a vertex more than once; place its points so that the "
                "shortest ways between them do not meet",
                vertices(repeated));
}

// The smooth line along a loop of edges, and the curve it follows.
class SmoothLine {
  public:
    SmoothLine(const Mesh& mesh, const std::vector<Index>& loop, const std::vector<Vec3>& normals,
               double max_smoothing, const Context& context)
        : mesh_(mesh),
          loop_(loop),
          edge_(edge_length_at(mesh, loop)),
          curve_(mesh, loop, normals, smoothing(max_smoothing)) {
        find(context);
    }

    const SurfaceCurve& curve() const { return curve_; }
    const ContourLine& contour() const { return contour_; }

  private:
    double smoothing(double most) const {
        const double length = Path(mesh_.shared_topology(), loop_, true).length(mesh_);
        return std::min(most, std::max(kSmoothedEdges * edge_ / length, kMinSmoothing));
    }

    void find(const Context& context) {
        double deviation = 0.0;
        for (const Index v : loop_) {
            deviation = std::max(deviation, curve_.nearest(mesh_.position(v)).distance);
        }
        const double width = deviation + kBandEdges * edge_;
        const CurveDistances distances = distances_to_curve(mesh_, curve_, loop_, width, context);
        const LevelSet levels = level_set(mesh_.topology(), distances.left, 0.0);
        std::vector<ContourLine> lines = contour_along(mesh_, levels, distances, context);
        if (lines.empty()) refuse();
        contour_ = std::move(lines[0]);
    }

    [[noreturn]] void refuse() const {
        throw Error(ErrorCode::boundary_conflict,
                    "no smooth closed line runs along the path: it meets an open boundary, crosses "
                    "itself or turns too sharply for the edges there; move it, or subdivide the "
                    "mesh",
                    vertices(loop_));
    }

    const Mesh& mesh_;
    const std::vector<Index>& loop_;
    double edge_;
    SurfaceCurve curve_;
    ContourLine contour_;
};

// The outlines of a region inside the mesh.
std::vector<std::vector<Index>> inner_outlines(const CutRegion& cut) {
    const Topology& topology = *cut.region.topology();
    const auto on_boundary = [&](Index v) { return topology.is_boundary(v); };
    std::vector<std::vector<Index>> loops = cut.region.boundaries();
    if (loops.empty() && cut.region.faces().empty()) {
        throw Error(ErrorCode::region_empty,
                    "the region contains no whole face of the mesh; enlarge it");
    }
    std::erase_if(loops, [&](const std::vector<Index>& loop) {
        return Path(cut.region.topology(), loop, true).is_boundary();
    });
    for (const std::vector<Index>& loop : loops) {
        if (std::none_of(loop.begin(), loop.end(), on_boundary)) continue;
        throw Error(ErrorCode::boundary_conflict,
                    "the outline of the region runs into an open boundary of the mesh; let the "
                    "region hold all of that boundary or stay away from it",
                    vertices(loop));
    }
    if (!loops.empty()) return loops;
    throw Error(ErrorCode::invalid_argument,
                "the region has no outline inside the mesh to cut along; choose a part of a "
                "component");
}

// Two lines must not cross an edge both: they would meet.
void require_apart(const std::vector<ContourLine>& lines) {
    std::vector<std::pair<Index, Index>> edges;
    for (const ContourLine& line : lines) {
        for (const Crossing& c : line.crossings) {
            edges.emplace_back(std::min(c.positive, c.negative), std::max(c.positive, c.negative));
        }
    }
    std::sort(edges.begin(), edges.end());
    Elements shared{ElementKind::edge, 0, {}};
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i] == edges[i - 1]) shared.add_edge(edges[i].first, edges[i].second);
    }
    if (shared.count == 0) return;
    throw Error(ErrorCode::boundary_conflict,
                "two outlines of the region are too close to cut both; smooth or grow the region, "
                "or subdivide the mesh",
                std::move(shared));
}

// A path that is cut along, as vertices and as the smooth line near them.
struct FollowedPath {
    std::vector<Index> loop;
    SmoothLine line;

    FollowedPath(const Mesh& mesh, const CutPath& path, const Context& context)
        : loop(loop_through(mesh, path.path, context)),
          line(mesh, loop, vertex_normals(mesh), path.smoothing, context) {}
};

CutSides sides_by(const Mesh& mesh, const CutPath& path, const SmoothLine& line) {
    CutSides sides{sides_of(mesh, {line.contour()})};
    sides.named = path.seed.has_value();
    if (path.seed) sides.kept = side_near(mesh, sides.side, *path.seed);
    sides.whole_components =
        assign_whole_components(mesh, sides.side, [&](const auto& component) -> signed char {
            Vec3 mean = Vec3::Zero();
            for (const Index v : component) {
                mean += mesh.position(v) / count_of(component);
            }
            return line.curve().nearest(mean).left >= 0.0 ? 1 : -1;
        });
    return sides;
}

void require_path(const Mesh& mesh, const CutPath& path, const CutOptions& options) {
    require_cuttable(mesh, options);
    require_smoothing(path.smoothing);
}

CutLines lines_of(const Mesh& mesh, const CutRegion& region, const CutOptions& options,
                  const Context& context) {
    require_cuttable(mesh, options);
    require_smoothing(region.smoothing);
    require_same_topology(mesh, region.region.topology(), "the region");
    const std::vector<Vec3> normals = vertex_normals(mesh);
    CutLines found;
    for (const std::vector<Index>& loop : inner_outlines(region)) {
        found.lines.push_back(SmoothLine(mesh, loop, normals, region.smoothing, context).contour());
    }
    require_apart(found.lines);
    return found;
}

CutSides sides_by(const Mesh& mesh, const CutRegion& region,
                  const std::vector<ContourLine>& lines) {
    CutSides sides{sides_of(mesh, lines), 1, true, true};
    const std::vector<char> inside = region.region.mask();
    sides.whole_components =
        assign_whole_components(mesh, sides.side, [&](const auto& component) -> signed char {
            const auto count = std::count_if(component.begin(), component.end(),
                                             [&](Index v) { return inside[v] != 0; });
            return 2 * count > std::ssize(component) ? 1 : -1;
        });
    return sides;
}

}  // namespace

Cut cut(const Mesh& mesh, const CutPath& path, const CutOptions& options,
        const Context& context) try {
    require_path(mesh, path, options);
    Progress progress(context, "cut");
    progress.step(0.6);
    const FollowedPath followed(mesh, path, context);
    CutSides sides = sides_by(mesh, path, followed.line);
    progress.step(0.4);
    return cut_along(mesh, {{followed.line.contour()}, {}, {}}, std::move(sides), options, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

CutPreview preview_cut(const Mesh& mesh, const CutPath& path, const CutOptions& options,
                       const Context& context) try {
    require_path(mesh, path, options);
    const FollowedPath followed(mesh, path, context);
    return preview_along(mesh, {{followed.line.contour()}, {}, {}},
                         [&] { return sides_by(mesh, path, followed.line); });
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

Cut cut(const Mesh& mesh, const CutRegion& region, const CutOptions& options,
        const Context& context) try {
    Progress progress(context, "cut");
    progress.step(0.6);
    CutLines found = lines_of(mesh, region, options, context);
    CutSides sides = sides_by(mesh, region, found.lines);
    progress.step(0.4);
    return cut_along(mesh, std::move(found), std::move(sides), options, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

CutPreview preview_cut(const Mesh& mesh, const CutRegion& region, const CutOptions& options,
                       const Context& context) try {
    const CutLines found = lines_of(mesh, region, options, context);
    return preview_along(mesh, found, [&] { return sides_by(mesh, region, found.lines); });
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
