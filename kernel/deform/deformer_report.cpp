// What a deformation did to the surface.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deform_warnings.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/tears.h"
#include "kernel/mesh/measure/distortion.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// A mesh whose volume is smaller, in cubes of its size, has none to speak of.
constexpr double kNoVolume = 1e-6;

std::vector<Index> faces_around(const Region& region) {
    const Topology& topology = *region.topology();
    std::vector<Index> faces;
    for (const Index v : region.vertices()) {
        const auto around = topology.faces_around(v);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

class Comparison {
  public:
    Comparison(const Mesh& now, const Mesh& rest, const Region& region, const Context& context)
        : now_(now), rest_(rest), region_(region), context_(context) {}

    // Returns the edges beyond `limit`.
    std::vector<StretchedEdge> measure_edges(double limit, DeformReport& report) const {
        std::vector<StretchedEdge> beyond;
        const Topology& topology = now_.topology();
        for (Index e = 0; e < topology.edge_count(); ++e) {
            const auto [a, b] = topology.edge(e);
            if (!region_.contains(a) && !region_.contains(b)) continue;
            const double before = (rest_.position(a) - rest_.position(b)).norm();
            const double after = (now_.position(a) - now_.position(b)).norm();
            if (!(before > 0.0)) continue;
            const double factor = std::max(after / before, before / after);
            if (factor > limit) beyond.push_back({a, b, factor});
            if (!(factor > report.stretch)) continue;
            report.stretch = factor;
            report.stretched = {a, b};
        }
        return beyond;
    }

    void measure_volume(DeformReport& report) const {
        const double before = volume(rest_), size = surface_radius(rest_);
        if (!(std::abs(before) > kNoVolume * size * size * size)) return;
        report.volume_change = volume(now_) / before - 1.0;
    }

    std::vector<Index> flipped() const { return flipped_faces(now_, rest_, faces_around(region_)); }

    std::vector<FacePair> new_crossings() const {
        SelfIntersectionOptions options;
        options.faces = faces_around(region_);
        const std::vector<FacePair> before = self_intersections(rest_, options, context_);
        const std::vector<FacePair> after = self_intersections(now_, options, context_);
        std::vector<FacePair> added;
        std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                            std::back_inserter(added));
        return added;
    }

  private:
    const Mesh &now_, &rest_;
    const Region& region_;
    const Context& context_;
};

}  // namespace

DeformReport Deformer::report(const Mesh& mesh, const DeformReportOptions& options,
                              const Context& context) const {
    return with_memory_errors([&] {
        Mesh now = mesh, rest = mesh;
        apply_to(now);
        apply_rest_to(rest);
        const Comparison comparison(now, rest, region(), context);
        DeformReport report;
        const AskedSize asked = asked_size(state_->shown->poses);
        const auto stretched = comparison.measure_edges(stretch_limit(asked), report);
        comparison.measure_volume(report);
        report.flipped = comparison.flipped();
        if (options.crossings) report.crossings = comparison.new_crossings();
        const auto& preparation = state_->preparation;
        if (preparation && preparation->rest == state_->rest &&
            preparation->holds == state_->holds) {
            report.tears = tears_of(*preparation, state_->poses);
        }
        report.warnings = warnings_of(report, asked, stretched, state_->options());
        if (!report.tears.empty()) {
            report.warnings.insert(report.warnings.begin(),
                                   tear_warning(*preparation, report.tears));
        }
        return report;
    });
}

}  // namespace lissom
