#include "kernel/mesh/cut/cut_parts.h"

#include <algorithm>
#include <limits>

#include "kernel/mesh/cut/cut_concerns.h"
#include "kernel/mesh/cut/split.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_connected(const std::vector<ContourLine>& lines) {
    Elements edges{ElementKind::edge, 0, {}};
    for (const ContourLine& line : lines) {
        for (const Crossing& c : line.crossings) edges.add_edge(c.positive, c.negative);
    }
    throw Error(ErrorCode::boundary_conflict,
                "the cut does not separate the mesh: its two sides are connected elsewhere; cut "
                "all lines of the plane at once, or cut elsewhere",
                std::move(edges));
}

// Spreads sides from the ends of crossed edges over all edges that are not crossed.
class SideFlood {
  public:
    SideFlood(const Mesh& mesh, const std::vector<ContourLine>& lines)
        : topology_(mesh.topology()), lines_(lines), crossed_(lines) {
        side_.assign(topology_.vertex_count(), 0);
        at_line_.assign(side_.size(), 0);
        for (const ContourLine& line : lines) {
            for (const Crossing& c : line.crossings) {
                start(c.positive, 1);
                start(c.negative, -1);
            }
        }
    }

    std::vector<signed char> sides() {
        for (std::size_t i = 0; i < queue_.size(); ++i) {
            const Index v = queue_[i];
            for (const Index n : topology_.neighbors(v)) {
                const bool crossed = at_line_[v] && at_line_[n] && crossed_.find(v, n) != kNoIndex;
                if (!crossed) reach(n, side_[v]);
            }
        }
        return std::move(side_);
    }

  private:
    void start(Index v, signed char side) {
        at_line_[v] = 1;
        reach(v, side);
    }

    void reach(Index v, signed char side) {
        if (side_[v] == side) return;
        if (side_[v] != 0) refuse_connected(lines_);
        side_[v] = side;
        queue_.push_back(v);
    }

    const Topology& topology_;
    const std::vector<ContourLine>& lines_;
    CrossedEdges crossed_;
    std::vector<signed char> side_;
    std::vector<char> at_line_;
    std::vector<Index> queue_;
};

}  // namespace

void require_cuttable(const Mesh& mesh, const CutOptions& options) {
    if (mesh.face_count() == 0) {
        throw Error(ErrorCode::mesh_empty, "the mesh has no faces to cut");
    }
    if (!(options.slide >= 0.0 && options.slide <= 0.45)) {
        throw Error(ErrorCode::invalid_argument,
                    "slide is a fraction of an edge's length and must lie between 0 and 0.45");
    }
}

std::vector<signed char> sides_of(const Mesh& mesh, const std::vector<ContourLine>& lines) {
    return SideFlood(mesh, lines).sides();
}

Index assign_whole_components(const Mesh& mesh, std::vector<signed char>& side,
                              const SideOfComponent& side_of) {
    const Topology& topology = mesh.topology();
    std::vector<std::vector<Index>> vertices(topology.component_count());
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (side[v] == 0) vertices[topology.components()[v]].push_back(v);
    }
    Index count = 0;
    for (const std::vector<Index>& component : vertices) {
        if (component.empty()) continue;
        const signed char chosen = side_of(component);
        for (const Index v : component) side[v] = chosen;
        count += !topology.is_isolated(component[0]);
    }
    return count;
}

signed char side_near(const Mesh& mesh, const std::vector<signed char>& side, const Vec3& seed) {
    if (!seed.allFinite()) throw Error(ErrorCode::not_finite, "the seed is NaN or infinite");
    double least = std::numeric_limits<double>::infinity();
    signed char found = 1;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double distance = (mesh.position(v) - seed).squaredNorm();
        if (side[v] == 0 || distance >= least) continue;
        least = distance;
        found = side[v];
    }
    return found;
}

Cut cut_along(const Mesh& mesh, CutLines found, CutSides sides, const CutOptions& options,
              const Context& context) {
    const MemoryCharge working = context.charge(2 * mesh.memory_bytes(), "cutting a mesh");
    CutReport report = std::move(found.report);
    report.whole_components = sides.whole_components;
    add_concerns(mesh, found.lines, report);
    add_kept_fraction(mesh, found.lines, sides, report);
    add_outlines(mesh, found.lines, sides, report);
    const Splitting splitting{std::move(found.lines), std::move(sides.side), options.slide};
    SplitResult parts = split(mesh, splitting, context);
    report.slid_vertices = std::move(parts.slid);
    report.divided_faces = parts.divided_faces;
    if (sides.kept < 0) std::swap(parts.positive, parts.negative);
    Cut cut;
    for (std::size_t i = 0; i < splitting.lines.size(); ++i) {
        cut.lines.push_back({parts.positive.lines[i], parts.negative.lines[i]});
    }
    cut.kept = {std::move(parts.positive.mesh), std::move(parts.positive.map)};
    cut.rest = {std::move(parts.negative.mesh), std::move(parts.negative.map)};
    cut.report = std::move(report);
    return cut;
}

CutPreview preview_along(const Mesh& mesh, const CutLines& found,
                         const std::function<CutSides()>& decide) {
    CutPreview preview;
    preview.report = found.report;
    add_concerns(mesh, found.lines, preview.report);
    signed char kept = 1;
    try {
        const CutSides sides = decide();
        kept = sides.kept;
        preview.report.whole_components = sides.whole_components;
        add_kept_fraction(mesh, found.lines, sides, preview.report);
        add_outlines(mesh, found.lines, sides, preview.report);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
        preview.report.warnings.push_back(
            {CutConcern::not_separating, error.message(), error.elements()});
    }
    for (const ContourLine& line : found.lines) {
        const Path path(line.points(mesh), line.closed);
        preview.lines.push_back(kept > 0 ? path : path.reversed());
    }
    for (const ContourLine& line : found.others) {
        preview.others.emplace_back(line.points(mesh), line.closed);
    }
    return preview;
}

}  // namespace lissom
