#include "kernel/deform/frame/deform_warnings.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace lissom {
namespace {

// Results on models of all kinds were looked at: up to these figures they look as asked, beyond
// them smeared, crumpled or shrunk. A volume that a pull adds to is seldom seen as a fault.
constexpr double kStretch = 3.0;
constexpr double kLostVolume = 0.25;
constexpr double kAddedVolume = 0.75;

constexpr std::string_view kRefine = ", or make the deformation with refine = 2";

template <typename... Values>
std::string text(const char* format, Values... values) {
    std::array<char, 400> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, values...);
    return buffer.data();
}

// "3 faces".
std::string counted(const Elements& elements) {
    return std::to_string(elements.count) + ' ' + std::string(kind_name(elements.kind)) +
           (elements.count == 1 ? "" : "s");
}

std::string with_refinement(std::string message, const DeformOptions& options) {
    const bool helps = options.refine == 0 && options.method == DeformMethod::implicit;
    return helps ? message.append(kRefine) : message;
}

void warn_of_stretch(const DeformReport& report, const std::vector<StretchedEdge>& stretched,
                     const DeformOptions& options, std::vector<DeformWarning>& warnings) {
    if (stretched.empty()) return;
    Elements edges{ElementKind::edge, 0, {}};
    for (const StretchedEdge& edge : stretched) edges.add_edge(edge.first, edge.second);
    const std::string names = counted(edges);
    warnings.push_back(
        {DeformHarm::stretched,
         with_refinement(
             text("the length of %s changed by a factor of up to %.3g; move the handles "
                  "less, or leave more of the surface free around them",
                  names.c_str(), report.stretch),
             options),
         std::move(edges)});
}

void warn_of_folds(const DeformReport& report, const DeformOptions& options,
                   std::vector<DeformWarning>& warnings) {
    if (report.flipped.empty()) return;
    Elements faces{ElementKind::face, 0, {}};
    for (const Index f : report.flipped) faces.add(f);
    const std::string names = counted(faces);
    warnings.push_back(
        {DeformHarm::folded,
         with_refinement(text("%s folded over; turn the handles less, or let another handle "
                              "between them take a share of the turn",
                              names.c_str()),
                         options),
         std::move(faces)});
}

void warn_of_crossings(const DeformReport& report, std::vector<DeformWarning>& warnings) {
    if (!report.crossings || report.crossings->empty()) return;
    std::vector<Index> ids;
    for (const FacePair& pair : *report.crossings) {
        ids.push_back(pair.first);
        ids.push_back(pair.second);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    Elements faces{ElementKind::face, 0, {}};
    for (const Index f : ids) faces.add(f);
    const std::string names = counted(faces);
    warnings.push_back({DeformHarm::crossing,
                        text("the surface runs through itself at %s; move the handles less, or "
                             "hold one of the parts that meet by a handle of its own",
                             names.c_str()),
                        std::move(faces)});
}

void warn_of_volume(const DeformReport& report, const AskedSize& asked,
                    std::vector<DeformWarning>& warnings) {
    if (!report.volume_change) return;
    const double now = 1.0 + *report.volume_change;
    const char* message = nullptr;
    if (now < (1.0 - kLostVolume) * asked.min_volume) {
        message =
            "the volume is %.0f %% smaller than at rest: parts that are turned far get thin; "
            "spread the turn over a longer free part, or over further handles between";
    } else if (now > (1.0 + kAddedVolume) * asked.max_volume) {
        message =
            "the volume is %.0f %% larger than at rest; move the handles less, or hold the parts "
            "that swell by handles of their own";
    }
    if (!message) return;
    warnings.push_back(
        {DeformHarm::volume, text(message, 100.0 * std::abs(*report.volume_change)), {}});
}

}  // namespace

const char* harm_name(DeformHarm harm) {
    constexpr std::array kNames{"torn", "stretched", "folded", "crossing", "volume"};
    return kNames[static_cast<std::size_t>(harm)];
}

AskedSize asked_size(const Poses& poses) {
    AskedSize asked;
    for (const HandlePose& pose : poses.handles) {
        const Mat3& linear = pose.transform.linear;
        const Vec3 lengths = linear.jacobiSvd().singularValues();
        if (!(lengths[2] > 0.0)) continue;
        asked.length = std::max({asked.length, lengths[0], 1.0 / lengths[2]});
        const double volume = std::abs(linear.determinant());
        asked.min_volume = std::min(asked.min_volume, volume);
        asked.max_volume = std::max(asked.max_volume, volume);
    }
    return asked;
}

double stretch_limit(const AskedSize& asked) {
    return kStretch * asked.length;
}

std::vector<DeformWarning> warnings_of(const DeformReport& report, const AskedSize& asked,
                                       const std::vector<StretchedEdge>& stretched,
                                       const DeformOptions& options) {
    std::vector<DeformWarning> warnings;
    warn_of_stretch(report, stretched, options, warnings);
    warn_of_folds(report, options, warnings);
    warn_of_crossings(report, warnings);
    warn_of_volume(report, asked, warnings);
    return warnings;
}

}  // namespace lissom
