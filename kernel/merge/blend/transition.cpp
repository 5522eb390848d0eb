#include "kernel/merge/blend/transition.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/blend/band_chart.h"
#include "kernel/merge/blend/band_map.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/merge/blend/seam_core.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/region.h"

namespace lissom {
namespace {

// Parts of the room on a side that a band may take: bands of two seams must not meet, and of a
// side that a band would cover the end stays.
constexpr double kShareBetweenSeams = 0.5;
constexpr double kShareOfSide = 0.9;

// Width that suits a seam: this many of its radii, at least so many edges of the side, and at most
// this share of the side, whose end is to stay recognisable.
constexpr double kSuitableRadii = 0.9, kSuitableEdges = 3.0, kSuitableShare = 0.5;

// Angles up to these do not show among the details that fade across a seam: smoothing may have left
// smaller ones, and a transition need not. It may leave more across the seam itself, if it removes
// steeper edges beside it.
constexpr double kFaint = 10.0 * kDegree, kFaintFade = 20.0 * kDegree;

SeamQuality faint_angles() {
    SeamQuality quality;
    quality.max_dihedral = kFaintFade;
    quality.max_near = kFaint;
    return quality;
}

void check_transition(const Sewn& sewn, std::span<const TransitionWidths> widths,
                      const TransitionOptions& options) {
    if (widths.size() != sewn.seams.size()) {
        throw Error(ErrorCode::invalid_argument,
                    "a transition needs one pair of widths for each seam");
    }
    for (const TransitionWidths& w : widths) {
        for (const double width : {w.target, w.source}) {
            if (width >= 0.0 && std::isfinite(width)) continue;
            throw Error(ErrorCode::invalid_argument,
                        "the width of a transition must be 0 or a finite length above it");
        }
    }
    if (options.core < 1 || options.umbrella < 0 || options.passes < 1) {
        throw Error(ErrorCode::invalid_argument,
                    "a transition needs a core of 1 ring or more, 0 umbrella steps or more and "
                    "1 pass or more");
    }
}

double smoothstep(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// One side of a seam.
struct Side {
    BandChart chart;
    // How far details are read and how far vertices move: 0, or the same.
    double read = 0.0, width = 0.0;
};

// Both sides of one seam.
struct Transition {
    Side target, source;

    bool moves_seam() const { return target.width > 0.0 && source.width > 0.0; }
    // Share that a vertex on the seam has in its own curvature.
    double own_share() const { return moves_seam() ? 0.5 : 0.0; }
};

// Number of the seam at each vertex, or kNoIndex.
std::vector<Index> seams_at(const Sewn& sewn) {
    std::vector<Index> seam_at(sewn.mesh.vertex_count(), kNoIndex);
    for (std::size_t k = 0; k < sewn.seams.size(); ++k) {
        for (const Index v : sewn.seams[k]) seam_at[v] = index_of(k);
    }
    return seam_at;
}

double room_on(const BandChart& chart, Index seam, std::span<const Index> seam_at) {
    double room = std::min(kShareOfSide * chart.farthest, chart.end);
    for (std::size_t i = 0; i < chart.vertex.size(); ++i) {
        const Index other = seam_at[chart.vertex[i]];
        if (other == kNoIndex || other == seam) continue;
        room = std::min(room, kShareBetweenSeams * chart.distance[i]);
    }
    return room;
}

// Median length of the edges that leave the seam's neighbours on one side; 0 without any.
double edge_beside(const Sewn& sewn, std::span<const Index> seam, SeamSide side) {
    const Topology& topology = sewn.mesh.topology();
    std::vector<char> on_seam(topology.vertex_count(), 0);
    for (const Index v : seam) on_seam[v] = 1;
    std::vector<Index> ring;
    for (const Index v : seam) {
        for (const Index f : topology.faces_around(v)) {
            if (sewn.side_of_face[f] != side) continue;
            for (const Index w : topology.face(f)) {
                if (!on_seam[w]) ring.push_back(w);
            }
        }
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    std::vector<double> lengths;
    for (const Index v : ring) {
        for (const Index w : topology.neighbors(v)) {
            if (!on_seam[w]) {
                lengths.push_back((sewn.mesh.position(v) - sewn.mesh.position(w)).norm());
            }
        }
    }
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + (lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

double suitable_width(const Sewn& sewn, Index seam, SeamSide side, std::span<const Index> seam_at,
                      const Context& context) {
    const std::vector<Index>& loop = sewn.seams[seam];
    double length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        length +=
            (sewn.mesh.position(loop[(k + 1) % loop.size()]) - sewn.mesh.position(loop[k])).norm();
    }
    const double width = std::max(kSuitableRadii * length / (2.0 * kPi),
                                  kSuitableEdges * edge_beside(sewn, loop, side));
    // A chart of twice the width knows whether half of the side is less than the width.
    const BandChart chart = make_band_chart(sewn, loop, side, 2.0 * width, context);
    return std::min({width, kSuitableShare * chart.farthest, room_on(chart, seam, seam_at)});
}

Transition make_transition(const Sewn& sewn, Index seam, const TransitionWidths& widths,
                           std::span<const Index> seam_at, const Context& context) {
    const auto make_side = [&](SeamSide side, double width, double otherwise) {
        Side result;
        if (!(width > 0.0 || otherwise > 0.0)) return result;
        const double read = width > 0.0 ? width : otherwise;
        result.chart = make_band_chart(sewn, sewn.seams[seam], side, read, context);
        result.read = std::min(read, room_on(result.chart, seam, seam_at));
        result.width = width > 0.0 ? result.read : 0.0;
        return result;
    };
    return {make_side(SeamSide::target, widths.target, widths.source),
            make_side(SeamSide::source, widths.source, widths.target)};
}

// Vertices up to `reach` on a side.
template <typename Use>
void for_each_within(const Side& side, double reach, const Use& use) {
    for (std::size_t i = 0; i < side.chart.vertex.size(); ++i) {
        if (side.chart.distance[i] < reach) use(i, side.chart.vertex[i]);
    }
}

// The vertices that details are read at, or that move.
Region region_of(const Sewn& sewn, std::span<const Transition> transitions, double Side::*reach) {
    std::vector<Index> vertices;
    for (const Transition& t : transitions) {
        for (const Side* side : {&t.target, &t.source}) {
            for_each_within(*side, side->*reach,
                            [&](std::size_t, Index v) { vertices.push_back(v); });
        }
    }
    return {sewn.mesh.shared_topology(), std::move(vertices)};
}

// Without the seams of which a side stays, and without open boundaries.
Region moving_region(const Sewn& sewn, std::span<const Transition> transitions) {
    std::vector<Index> fixed;
    for (std::size_t k = 0; k < transitions.size(); ++k) {
        if (transitions[k].moves_seam()) continue;
        fixed.insert(fixed.end(), sewn.seams[k].begin(), sewn.seams[k].end());
    }
    for (const std::vector<Index>& loop : sewn.mesh.topology().boundary_loops()) {
        fixed.insert(fixed.end(), loop.begin(), loop.end());
    }
    return region_of(sewn, transitions, &Side::width)
        .minus(Region(sewn.mesh.shared_topology(), std::move(fixed)));
}

// Reads curvatures, given for the local vertices of a band system, on one side of a seam.
class CurvatureReader {
  public:
    CurvatureReader(const Side& side, std::span<const Index> local, std::span<const double> values)
        : map_(side.chart, side.read), local_(local), values_(values) {}

    Index flipped() const { return map_.flipped(); }

    // Returns the value at coordinates, or `own` outside the map.
    double at(double angle, double distance, double own, Index& unmapped) const {
        std::optional<BandPlace> place = map_.locate(angle, distance);
        unmapped += place ? 0 : 1;
        if (!place) place = map_.nearest(angle, distance);
        if (!place) return own;
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += place->weights[k] * values_[local_[place->vertices[k]]];
        }
        return sum;
    }

  private:
    BandMap map_;
    std::span<const Index> local_;
    std::span<const double> values_;
};

// The curvatures of one side towards those of the other.
TransitionBand blend_side(const Side& side, const Side& across, double own_share,
                          std::span<const Index> local, std::span<const double> values,
                          std::vector<double>& blended) {
    TransitionBand result{side.width};
    if (!(side.width > 0.0)) return result;
    if (across.read > 0.0) {
        const CurvatureReader other(across, local, values);
        for_each_within(side, side.width, [&](std::size_t i, Index v) {
            const double way = side.chart.distance[i] / side.width;
            const double share = own_share + (1.0 - own_share) * smoothstep(way);
            const double own = values[local[v]];
            blended[local[v]] = share * own + (1.0 - share) * other.at(side.chart.angle[i], way,
                                                                       own, result.unmapped);
            ++result.vertices;
        });
    }
    result.flipped = BandMap(side.chart, side.read).flipped();
    return result;
}

std::vector<Index> local_numbers(const BandSystem& band, Index vertex_count) {
    std::vector<Index> local(vertex_count, kNoIndex);
    for (Index i = 0; i < band.vertex_count(); ++i) local[band.mesh_vertex(i)] = i;
    return local;
}

// The curvatures of the shape and of each morph, blended within the bands; adds these to `report`.
std::vector<std::vector<double>> blended_curvatures(
    std::span<const Transition> transitions, std::span<const Index> local,
    const std::vector<std::vector<double>>& curvature, TransitionReport& report) {
    std::vector<std::vector<double>> blended = curvature;
    for (const Transition& t : transitions) {
        const auto blend = [&](const Side& side, const Side& across) {
            for (std::size_t s = 1; s < blended.size(); ++s) {
                blend_side(side, across, t.own_share(), local, curvature[s], blended[s]);
            }
            return blend_side(side, across, t.own_share(), local, curvature[0], blended[0]);
        };
        report.target.push_back(blend(t.target, t.source));
        report.source.push_back(blend(t.source, t.target));
    }
    return blended;
}

}  // namespace

std::vector<TransitionWidths> suitable_widths(const Sewn& sewn, const Context& context) {
    const std::vector<Index> seam_at = seams_at(sewn);
    std::vector<TransitionWidths> widths;
    for (Index k = 0; k < count_of(sewn.seams); ++k) {
        widths.push_back({suitable_width(sewn, k, SeamSide::target, seam_at, context),
                          suitable_width(sewn, k, SeamSide::source, seam_at, context)});
    }
    return widths;
}

TransitionReport blend_transition(Sewn& sewn, std::span<const TransitionWidths> widths,
                                  const TransitionOptions& options, const Context& context) {
    check_transition(sewn, widths, options);
    Progress progress(context, "blend the transition");
    progress.step(0.5);
    const std::vector<Index> seam_at = seams_at(sewn);
    std::vector<Transition> transitions;
    for (std::size_t k = 0; k < widths.size(); ++k) {
        transitions.push_back(make_transition(sewn, index_of(k), widths[k], seam_at, context));
    }
    TransitionReport report;
    const Region moving =
        moving_region(sewn, transitions).minus(Region(sewn.mesh.shared_topology(), options.firm));
    report.moved = moving.vertices();

    progress.step(0.5);
    const Region read = region_of(sewn, transitions, &Side::read);
    if (read.empty()) {
        report.target.resize(widths.size());
        report.source.resize(widths.size());
        return report;
    }
    const std::vector<Index> rings = seam_rings(sewn.mesh.topology(), sewn.seams, options.core);
    BandSystem band(read, moving, sewn.mesh.positions());
    band.take_morphs(sewn.mesh);
    const SeamCore core(band, rings, options.core);
    const std::vector<std::vector<double>> curvature =
        core.filled(band, band.curvatures(), context);
    const std::vector<std::vector<double>> blended = blended_curvatures(
        transitions, local_numbers(band, sewn.mesh.vertex_count()), curvature, report);
    if (moving.empty()) return report;
    for (Index i = 0; i < options.umbrella; ++i) core.umbrella(band);
    for (Index pass = 0; pass < options.passes; ++pass) {
        band.bend(core.relaxed(band, blended, context), context);
    }
    report.kept = band.write_guarded(sewn.mesh, sewn.seams, faint_angles(), context);
    return report;
}

}  // namespace lissom
