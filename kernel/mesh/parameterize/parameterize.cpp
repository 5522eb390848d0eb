#include "kernel/mesh/parameterize/parameterize.h"

#include <algorithm>
#include <utility>

#include "kernel/mesh/parameterize/chart.h"
#include "kernel/mesh/parameterize/conformal_map.h"
#include "kernel/mesh/parameterize/convex_map.h"
#include "kernel/mesh/parameterize/map_quality.h"
#include "kernel/mesh/parameterize/rigid_map.h"
#include "kernel/mesh/parameterize/triangle_shape.h"

namespace lissom {
namespace {

// Lays out a chart, and keeps the quality of each method's map.
class ChartLayout {
  public:
    ChartLayout(const Chart& chart, const ParameterizeOptions& options, const Context& context)
        : chart_(chart), options_(options), context_(context), shapes_(triangle_shapes(chart)) {}

    Parameterization run() {
        Progress progress(context_, "parameterize");
        progress.step(0.5);
        result_.uv = first_map();
        scale_to_area(chart_, shapes_, result_.uv);
        result_.method = options_.method;
        progress.step(0.5);
        if (options_.method == ParameterizeMethod::arap) make_rigid();
        place_by_outline(chart_, result_.uv);
        measure();
        return std::move(result_);
    }

  private:
    std::vector<Vec2> first_map() const try {
        return options_.method == ParameterizeMethod::tutte
                   ? convex_map(chart_, shapes_, context_)
                   : conformal_map(chart_, shapes_, context_);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
        throw Error(ErrorCode::not_positive_definite,
                    "the triangles of these faces are too thin to be laid out; remesh them, or "
                    "use the method tutte");
    }

    // Whole iterations; if they end with flips, also iterations that stop short of flips.
    RigidMap best_rigid_map() const {
        const auto with = [&](RigidSteps steps) {
            return rigid_map(chart_, shapes_, result_.uv, steps, options_.maximum_iterations,
                             context_);
        };
        RigidMap whole = with(RigidSteps::whole);
        if (!whole.ends_with_flips()) return whole;
        RigidMap shorter = with(RigidSteps::short_of_flips);
        return shorter.reached() < whole.reached() ? std::move(shorter) : std::move(whole);
    }

    // Kept if it flips nothing and adds no crossing of boundaries.
    void make_rigid() {
        result_.method = ParameterizeMethod::lscm;
        RigidMap rigid = best_rigid_map();
        result_.energy = std::move(rigid.energy);
        if (rigid.iterations == 0 ||
            crossing_edges(chart_.loops, rigid.uv) > crossing_edges(chart_.loops, result_.uv)) {
            return;
        }
        result_.method = ParameterizeMethod::arap;
        result_.iterations = rigid.iterations;
        result_.uv = std::move(rigid.uv);
    }

    void measure() {
        for (const Index t : flipped_triangles(chart_.triangles, result_.uv)) {
            if (chart_.is_fill(t)) {
                ++result_.flipped_fill;
            } else {
                add_once(result_.flipped, chart_.face[t]);
            }
        }
        for (std::size_t t = 0; t < chart_.face.size(); ++t) {
            if (shapes_[t].degenerate) add_once(result_.degenerate, chart_.face[t]);
        }
        const ScaleRange range = scale_range(chart_, shapes_, result_.uv);
        result_.min_scale = range.least;
        result_.max_scale = range.greatest;
        result_.boundary_crossings = crossing_edges(chart_.loops, result_.uv);
    }

    // The triangles of a face follow one another.
    static void add_once(std::vector<Index>& faces, Index face) {
        if (faces.empty() || faces.back() != face) faces.push_back(face);
    }

    const Chart& chart_;
    const ParameterizeOptions& options_;
    const Context& context_;
    std::vector<TriangleShape> shapes_;
    Parameterization result_;
};

}  // namespace

Parameterization parameterize(const Mesh& mesh, std::span<const Index> faces,
                              const ParameterizeOptions& options, const Context& context) {
    require(options.maximum_iterations >= 0, "maximum_iterations must be 0 or more");
    Chart chart = make_chart(mesh, faces, options.fill, options.close_holes, context);
    Parameterization result = ChartLayout(chart, options, context).run();
    result.vertex = std::move(chart.vertex);
    result.triangles = std::move(chart.triangles);
    result.face = std::move(chart.face);
    result.loops = std::move(chart.loops);
    return result;
}

Parameterization parameterize(const Mesh& mesh, const Region& region,
                              const ParameterizeOptions& options, const Context& context) {
    require_same_topology(mesh, region.topology(), "the region");
    return parameterize(mesh, region.faces(), options, context);
}

}  // namespace lissom
