// Measures of a deformed surface.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/frame/deform_warnings.h"
#include "kernel/deform/frame/tears.h"
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

std::string counted(std::size_t count, const char* one, const char* many) {
    return count == 0 ? std::string("no ") + many
                      : std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string verdict_of(const DeformReport& report) {
    std::string kinds;
    for (const DeformWarning& warning : report.warnings) {
        kinds += (kinds.empty() ? "" : ", ") + std::string(harm_name(warning.harm));
    }
    return kinds.empty() ? "ok" : kinds;
}

}  // namespace

std::string report_text(const DeformReport& report) {
    char number[64];
    std::snprintf(number, sizeof number, ": edges stretch up to %.3g times, ", report.stretch);
    std::string text =
        verdict_of(report) + number + counted(report.flipped.size(), "folded face", "folded faces");
    if (report.crossings) {
        text += ", " +
                counted(report.crossings->size(), "pair of faces crosses", "pairs of faces cross");
    }
    if (!report.tears.empty()) text += ", " + counted(report.tears.size(), "tear", "tears");
    if (report.volume_change) {
        std::snprintf(number, sizeof number, ", volume %+.3g %%", 100.0 * *report.volume_change);
        text += number;
    }
    for (const DeformWarning& warning : report.warnings) {
        text += std::string("\n  ") + harm_name(warning.harm) + ": " + warning.message;
    }
    return text;
}

DeformReport report_of(const Deformer& deformer, const Mesh& mesh,
                       const DeformReportOptions& options, const Context& given) {
    const auto& s = DeformerAccess::state(deformer);
    return with_memory_errors([&] {
        Mesh now = mesh, rest = mesh;
        deformer.apply_to(now);
        apply_rest(deformer, rest);
        const Comparison comparison(now, rest, deformer.region(), s.chosen(given));
        DeformReport report;
        const AskedSize asked = asked_size(s.shown->poses);
        const auto stretched = comparison.measure_edges(stretch_limit(asked), report);
        comparison.measure_volume(report);
        report.flipped = comparison.flipped();
        if (options.crossings) report.crossings = comparison.new_crossings();
        const auto& preparation = s.preparation;
        if (preparation && preparation->rest == s.rest &&
            preparation->constraints == s.constraints) {
            report.tears = tears_of(*preparation, s.poses);
        }
        report.warnings = warnings_of(report, asked, stretched, s.options());
        if (!report.tears.empty()) {
            report.warnings.insert(report.warnings.begin(),
                                   tear_warning(*preparation, report.tears));
        }
        return report;
    });
}

}  // namespace lissom
