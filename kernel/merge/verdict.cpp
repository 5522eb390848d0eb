#include "kernel/merge/verdict.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace lissom {
namespace {

constexpr double kRadian = 180.0 / kPi;
// Pairs of real models whose seams nobody sees turn by up to this angle at one edge, in radians.
constexpr double kSteep = 30.0 / kRadian;
// And by up to this in the mean along it; a paste may meet its target at a crease, which is the
// greatest angle around it and about two thirds of that in the mean.
constexpr double kSteepMean = 20.0 / kRadian, kMeanOfCrease = 2.0 / 3.0;
// Or this many times the angle that edges beside the boundaries turned by before: spikes on plates
// and beside edges of CAD models look right up to 1.28 times.
constexpr double kMoreSteep = 1.3;
// Triangles thinner than this have no reliable normals.
constexpr double kThin = 2.0 / kRadian;
// Bands of real models that look smooth are up to 1.34 times as rough as their sides were, crumpled
// ones 1.5 times and more. Edges that turn by less in the mean do not show beside flat sides.
constexpr double kRougher = 1.4, kFlatEnough = 8.0 / kRadian;
// Limits of one side by itself, by eye on 270 merges and pastes of real models: a smooth source may
// become 1.6 times as rough, and a rough one, whose edges turn by 14 degrees then, 1.4 times. Of
// merged sources above both that look right all but one with a frilled rim are at most 1.3 times as
// rough as they were, dented and crumpled ones 1.42 to 2.9 times. Pasted ones bend to meet their
// target, and look right up to 1.55 times.
constexpr double kSourceRougher = 1.6, kFlatSource = 11.0 / kRadian;
constexpr double kRoughRougher = 1.4, kRoughSource = 14.0 / kRadian;
// Targets change at the seam only: the roughest that looks right is 1.2 times as rough as it was,
// torn ones 1.46 times and more, a smooth one from 1.5 degrees to 7.
constexpr double kTargetRougher = 1.3, kFlatTarget = 5.0 / kRadian;
// A source whose grain became this many times as coarse, and whose edges turn like wrinkles along
// this many radii more than before, is crumpled, however many creases it has: of 40 merges and
// pastes of real models six that look so are 1.35 times as coarse and more and gained 4 radii and
// more, good ones as coarse gained .2 at most.
constexpr double kCoarserGrain = 1.3, kWrinkled = 2.0;
// Length of the edges of a merge that turn by 20 degrees more than at rest, in radii: about that of
// the seam. Of 48 merges of real models those that look right have up to 4.9, frayed and torn ones
// 7 and more.
constexpr double kCrumpledEdges = 6.0;
// Folds shorter than this, in radii of the seam, do not show: of merges and pastes of real models
// those of up to .13 look right, of .27 and more they do not.
constexpr double kFold = 0.15;
// Length of the edges of one side that turn by more than 60 degrees and did not before, in radii:
// of 60 merges and pastes of real models with coarse or rugged sides good ones gained up to 1.1,
// ones with a slit, a ridge or torn faces 1.5 and more.
constexpr double kSharpened = 1.3;
// Width of the vertices of the source that became thorns or pits, in radii: of 57 merges and pastes
// of real models those that look right have up to .2, ones with a thorn or tatters at the rim .25
// and more.
constexpr double kThorns = 0.22;
// A part that keeps less of its volume has visibly caved in. Of 62 merges of real models those that
// look right keep .45 and more: heads on flat or long boundaries lose the most.
constexpr double kVolumeKept = 0.4;
// A part that leaves less of the target's area replaces it.
constexpr double kAreaKept = 0.5;
// Length of sharp edges that a paste may take, and the depth of a bite at one place, in radii of
// the seam: smoothing takes less at an edge that a seam crosses.
constexpr double kBitten = 0.3, kBittenDepth = 0.15;
// Limit of the angle between planes on either side of a seam on surfaces that were flat, and of its
// ratio to the angle before on others: in the mean, and along a tenth of it. In 80 merges of real
// models, good ones beside flat sides bend by up to 31 and 51 degrees, bad ones by 43 in the mean
// and more.
constexpr double kBent = 35.0 / kRadian, kBentMost = 60.0 / kRadian, kMoreBent = 1.3;
// Limit of the outward turn of a source's rim: of 62 merges of real models smooth jaws, brims and
// manes turn by up to 54 degrees and look right, and no smooth one that looks bad turns by less.
constexpr double kFlared = 65.0 / kRadian;
// A rim whose side became this much rougher as well hangs over the seam like a bag or a lip: 13
// that look bad stand out by 23 degrees and more and are 1.1 times as rough as they were and more,
// good ones stand out by 21.6 at most or are at most 1.05 times as rough; two good ones of low
// polygons are in between.
constexpr double kBagged = 22.5 / kRadian, kCrumpled = 1.08;
// Of 142 merges and pastes of real models good ones that had tips lack up to 78 degrees there, or
// 1.34 times as much as before; visible ones lack 103 and more, or 1.36 times as much. Beside
// surfaces that lacked 9 degrees at most smaller ones show: five bad ones lack 53 to 75 there, good
// ones 56 at most, which is 1.5 times 9 and 42 more.
constexpr double kSpiked = 88.0 / kRadian, kMoreSpiked = 1.35;
constexpr double kSpikedFlat = 45.0 / kRadian, kSpikedBeside = 1.5;

[[gnu::format(printf, 1, 2)]] std::string text_of(const char* format, ...) {
    char text[256];
    va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    return text;
}

std::string angle_text(double radians) {
    return text_of("%.*f degrees", radians * kRadian < 10.0 ? 1 : 0, radians * kRadian);
}

std::string joined_by(const std::vector<std::string>& texts, const char* separator) {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
    return all;
}

double steepest_rim(const MergeReport& report) {
    return std::max(report.source_rim.max_near, report.target_rim.max_near);
}

// A paste may meet its target at a crease.
bool is_paste(const MergeReport& report) {
    return report.crease > 0.0;
}

bool all_fit(const MergeReport& report) {
    return !report.joins.empty() && std::all_of(report.joins.begin(), report.joins.end(),
                                                [](const JoinReport& join) { return join.fits; });
}

// The angle that a thirtieth of a seam exceeds; of drafts, whose bands are not measured, that of
// the steepest edge.
double steep_seam(const MergeReport& report) {
    double steep = 0.0;
    for (const JoinReport& join : report.joins) {
        if (!(join.band.radius > 0.0)) return report.seam.after.max_dihedral;
        steep = std::max(steep, join.band.steep);
    }
    return report.joins.empty() ? report.seam.after.max_dihedral : steep;
}

// The same beside the boundaries before; of drafts, that of the steepest edge there.
double steep_before(const MergeReport& report) {
    double steep = 0.0;
    for (const JoinReport& join : report.joins) {
        if (!(join.band.radius > 0.0)) return steepest_rim(report);
        steep = std::max(steep, join.band.rest_steep);
    }
    return report.joins.empty() ? steepest_rim(report) : steep;
}

// A steep seam is good if the surface was as steep beside it, or if it is so along a short part,
// which is said.
std::string beside_text(const MergeReport& report) {
    const double steepest = report.seam.after.max_dihedral;
    if (steepest <= kSteep) return "";
    if (all_fit(report)) return "as the parts were given, ";
    if (steep_seam(report) <= kSteep || steepest > steepest_rim(report)) {
        return "though by at most " + angle_text(steep_seam(report)) +
               " along all but a thirtieth of it, ";
    }
    return "as beside the boundaries before (" + angle_text(steepest_rim(report)) + "), ";
}

using Reasons = std::vector<MergeReason>;

// Names the join concerned, of several.
std::string at_join(const MergeReport& report, Index join) {
    return report.joins.size() > 1 ? " at join " + std::to_string(join + 1) : "";
}

// A remedy, if an operation has it.
struct Help {
    bool counts;
    const char* text;
};

// "a, b or c" of those that count.
std::string remedy_of(std::initializer_list<Help> all) {
    std::vector<std::string> texts;
    for (const Help& help : all) {
        if (help.counts) texts.emplace_back(help.text);
    }
    if (texts.size() < 2) return joined_by(texts, "");
    const std::string last = texts.back();
    texts.pop_back();
    return joined_by(texts, ", ") + " or " + last;
}

constexpr const char* kKeys = "give keys that turn the part less";
constexpr const char* kMove = "move, turn or shrink the part";
constexpr const char* kFair = "use the seam \"fair\"";
constexpr const char* kTransition = "use a transition";
constexpr const char* kSmooth = "smooth more";
constexpr const char* kSubdivide = "subdivide the coarser side";
constexpr const char* kCut = "cut the parts at smoother places of like size";

std::string remedy_of_crossings(CrossingPlace place, const OpenOptions& open) {
    if (place == CrossingPlace::source) {
        return remedy_of({{open.fixed,
                           "fix the region of the source that they lie in (`fixed`), "
                           "since the deformation of the source causes them"},
                          {open.keys, kKeys},
                          {open.moves, kMove},
                          {true, "cut the source along a boundary more like the target's"}});
    }
    return remedy_of(
        {{open.moves, kMove}, {open.keys, kKeys}, {true, "cut the part or the target elsewhere"}});
}

const char* place_text(CrossingPlace place) {
    switch (place) {
        case CrossingPlace::seam:
            return " at the seam";
        case CrossingPlace::source:
            return " of the source, away from the seam";
        case CrossingPlace::target:
            return " of the target, away from the seam";
        case CrossingPlace::between:
            break;
    }
    return " of source and target, away from the seam";
}

void note_crossings(const CrossingGroup& group, const std::string& where, const OpenOptions& open,
                    Reasons& reasons) {
    const std::string count = std::to_string(group.pairs);
    reasons.push_back({MergeFault::crossings, kNoIndex, static_cast<double>(group.pairs), 0.0,
                       count + (group.pairs == 1 ? " pair" : " pairs") + " of faces" + where +
                           (group.pairs == 1 ? " runs" : " run") +
                           " through one another that did not before",
                       remedy_of_crossings(group.place, open), group.faces});
}

void judge_crossings(const MergeReport& report, const OpenOptions& open, Reasons& reasons) {
    if (report.intersections.empty()) return;
    if (report.crossings.empty()) {
        CrossingGroup all;
        all.pairs = count_of(report.intersections);
        return note_crossings(all, "", open, reasons);
    }
    for (const CrossingGroup& group : report.crossings) {
        if (group.shallow || group.hidden) continue;
        const std::string middle = text_of(" (around %.3g, %.3g, %.3g)", group.middle.x(),
                                           group.middle.y(), group.middle.z());
        note_crossings(group, place_text(group.place) + middle, open, reasons);
    }
}

void judge_sides(const MergeReport& report, const OpenOptions& open, Reasons& reasons) {
    for (Index j = 0; j < count_of(report.joins); ++j) {
        if (!report.joins[at(j)].same_side) continue;
        reasons.push_back({MergeFault::side, j, 0.0, 0.0,
                           "both parts lie on the same side of join " + std::to_string(j + 1) +
                               ", so that the source turns over",
                           remedy_of({{true, "put the source on the other side"},
                                      {open.free, "use the free configuration"}})});
    }
}

// Thorns and pits of a source that had none there.
void judge_pinched(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const JoinReport& join = report.joins[at(j)];
    if (join.fits || !(join.band.pinched > kThorns)) return;
    reasons.push_back({MergeFault::folds, j, join.band.pinched, kThorns,
                       text_of("the source has thorns or pits beside the seam%s that it did not "
                               "have, %.2f of its radius wide together",
                               at_join(report, j).c_str(), join.band.pinched),
                       remedy_of({{open.fair, kFair}, {open.moves, kMove}, {true, kCut}})});
}

// Edges that turn sharply and did not: slits, ridges and teeth.
void judge_sharpened(const MergeReport& report, Index j, const OpenOptions& open,
                     Reasons& reasons) {
    const JoinReport& join = report.joins[at(j)];
    if (join.fits || !(join.band.sharpened > kSharpened))
        return judge_pinched(report, j, open, reasons);
    reasons.push_back({MergeFault::folds, j, join.band.sharpened, kSharpened,
                       text_of("the surface is creased beside the seam%s: its edges turn by more "
                               "than 60 degrees along %.1f of its radius more than before",
                               at_join(report, j).c_str(), join.band.sharpened),
                       remedy_of({{open.fair, kFair}, {true, kCut}, {open.smooth, kSmooth}})});
}

double fold_limit(const BandQuality& band) {
    return band.rest_folded + kFold;
}

bool folds_back(const BandQuality& band) {
    return band.folded > fold_limit(band);
}

void judge_folds(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const BandQuality& band = report.joins[at(j)].band;
    if (!folds_back(band)) return judge_sharpened(report, j, open, reasons);
    reasons.push_back({MergeFault::folds, j, band.folded, fold_limit(band),
                       text_of("the surface folds back beside the seam%s, along %.2f of its "
                               "radius (%.2f before)",
                               at_join(report, j).c_str(), band.folded, band.rest_folded),
                       remedy_of({{true, kCut}, {open.keys, kKeys}, {true, kSubdivide}})});
}

// Roughness of a part of a band, how it was, and how rough it may be.
struct Roughness {
    const char* where;
    double now, before, limit;
};

void tell_roughness(const MergeReport& report, Index j, const Roughness& found,
                    const OpenOptions& open, Reasons& reasons) {
    reasons.push_back(
        {MergeFault::roughness, j, found.now, found.limit,
         text_of("the %s the seam%s is rough: its edges turn by %s, and turned by %s before",
                 found.where, at_join(report, j).c_str(), angle_text(found.now).c_str(),
                 angle_text(found.before).c_str()),
         remedy_of({{true, kCut},
                    {open.no_transition, "leave the transition out"},
                    {open.smooth, kSmooth}})});
}

// Limit of a source that was that rough.
double source_limit(double before, bool pasted) {
    const double limit = std::max(kSourceRougher * before, kFlatSource);
    return pasted ? limit : std::min(limit, std::max(kRoughRougher * before, kRoughSource));
}

double target_limit(double before) {
    return std::max(kTargetRougher * before, kFlatTarget);
}

constexpr const char* kBetweenCreases = "target between its creases beside";

// Pits, slits and frayed rims of sides too rough for their roughness to tell. The part of a paste
// may be laid over edges of its target.
void judge_crumpled(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const double crumpled = report.joins[at(j)].band.crumpled;
    if (is_paste(report) || report.joins[at(j)].fits || !(crumpled > kCrumpledEdges)) return;
    reasons.push_back({MergeFault::folds, j, crumpled, kCrumpledEdges,
                       text_of("the surface is crumpled beside the seam%s: edges along %.1f of its "
                               "radius turn by over 20 degrees more than before, or the other way",
                               at_join(report, j).c_str(), crumpled),
                       remedy_of({{true, kCut},
                                  {open.keys, kKeys},
                                  {open.no_transition, "leave the transition out"}})});
}

// A source with creases, beside which its roughness tells little.
void judge_wrinkles(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const BandQuality& band = report.joins[at(j)].band;
    const Roughness found{"source between its creases beside", band.source_grain,
                          band.rest_source_grain,
                          std::max(kCoarserGrain * band.rest_source_grain, kFlatSource)};
    const bool wrinkled = !report.joins[at(j)].fits && band.wrinkled > kWrinkled;
    if (wrinkled && found.now > found.limit) {
        return tell_roughness(report, j, found, open, reasons);
    }
    judge_crumpled(report, j, open, reasons);
}

// Both sides together, else one that was smoother than the other.
void judge_roughness(const MergeReport& report, Index j, const OpenOptions& open,
                     Reasons& reasons) {
    const BandQuality& band = report.joins[at(j)].band;
    const Roughness all[] = {{"surface around", band.roughness, band.rest_roughness,
                              std::max(kRougher * band.rest_roughness, kFlatEnough)},
                             {"source beside", band.source_roughness, band.rest_source_roughness,
                              source_limit(band.rest_source_roughness, is_paste(report))},
                             {"target beside", band.target_roughness, band.rest_target_roughness,
                              target_limit(band.rest_target_roughness)},
                             {kBetweenCreases, band.target_grain, band.rest_target_grain,
                              target_limit(band.rest_target_grain)}};
    for (const Roughness& found : all) {
        if (found.now > found.limit) return tell_roughness(report, j, found, open, reasons);
    }
    judge_wrinkles(report, j, open, reasons);
}

void judge_volume(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const BandQuality& band = report.joins[at(j)].band;
    for (const auto& [side, kept] :
         {std::pair("source", band.source_volume), std::pair("target", band.target_volume)}) {
        const bool covered = is_paste(report) && side == std::string_view("target");
        if (!(kept < (covered ? kAreaKept : kVolumeKept))) continue;
        if (covered) {
            reasons.push_back(
                {MergeFault::volume, j, kept, kAreaKept,
                 text_of("the part takes the place of %.0f %% of the target's surface",
                         100.0 * (1.0 - kept)),
                 "make the part smaller, or mark a smaller region of the source"});
            continue;
        }
        reasons.push_back(
            {MergeFault::volume, j, kept, kVolumeKept,
             kept > 0.0 ? text_of("the %s lost %.0f %% of its volume%s", side, 100.0 * (1.0 - kept),
                                  at_join(report, j).c_str())
                        : text_of("the %s turned inside out%s", side, at_join(report, j).c_str()),
             remedy_of({{open.keys, kKeys},
                        {open.fixed, "fix a region of the source that keeps its shape (`fixed`)"},
                        {open.moves, "put it on the other side of the boundary"},
                        {true, "cut the parts along boundaries that are more alike"}})});
    }
}

void judge_bend(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    // Parts that fit bend as they were given.
    if (report.joins[at(j)].fits) return;
    const BandQuality& band = report.joins[at(j)].band;
    const double limit = std::max(kMoreBent * band.rest_bend, kBent + report.crease);
    const double most = std::max(kMoreBent * band.rest_max_bend, kBentMost + report.crease);
    const bool all_around = band.bend > limit;
    if (!all_around && !(band.max_bend > most)) return;
    const double value = all_around ? band.bend : band.max_bend;
    const double before = all_around ? band.rest_bend : band.rest_max_bend;
    reasons.push_back(
        {MergeFault::bend, j, value, all_around ? limit : most,
         text_of("the surface bends by %s from one side of the seam%s to the other%s, "
                 "and by %s beside the boundaries before",
                 angle_text(value).c_str(), at_join(report, j).c_str(),
                 all_around ? "" : " along a tenth of it", angle_text(before).c_str()),
         remedy_of({{open.fair, kFair},
                    {open.transition, kTransition},
                    {true, "cut both parts at places of the same shape"}})});
}

// Whether the source crumples beside its seam; a rim that does not may turn outward more.
bool is_crumpled(const BandQuality& band) {
    return band.source_roughness > kCrumpled * band.rest_source_roughness;
}

void judge_flare(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const BandQuality& band = report.joins[at(j)].band;
    const bool bag = is_crumpled(band);
    const double limit = bag ? kBagged : kFlared;
    // Parts that fit move as a whole.
    if (report.joins[at(j)].fits || !(band.flare > limit)) return;
    reasons.push_back({MergeFault::flare, j, band.flare, limit,
                       text_of("the rim of the source %s beside the seam%s: it turns outward by "
                               "%s more than before",
                               bag ? "crumples and stands out" : "stands out",
                               at_join(report, j).c_str(), angle_text(band.flare).c_str()),
                       remedy_of({{true, kCut}, {open.moves, kMove}})});
}

// Limit of tips beside surfaces whose sharpest was `before`.
double spike_limit(double before) {
    const double beside = std::min(kSpiked, kSpikedFlat + kSpikedBeside * before);
    return std::max(beside, kMoreSpiked * before);
}

void judge_spike(const MergeReport& report, Index j, const OpenOptions& open, Reasons& reasons) {
    const BandQuality& band = report.joins[at(j)].band;
    const double limit = spike_limit(band.rest_spike);
    if (report.joins[at(j)].fits || !(band.spike > limit)) return;
    reasons.push_back({MergeFault::spike, j, band.spike, limit,
                       text_of("the surface comes to a point beside the seam%s: %s are missing to "
                               "flat there, and %s were before",
                               at_join(report, j).c_str(), angle_text(band.spike).c_str(),
                               angle_text(band.rest_spike).c_str()),
                       remedy_of({{open.fair, kFair}, {open.moves, kMove}, {true, kCut}})});
}

constexpr const char* kNotSought = "faces that run through one another were not looked for";

void note_seam(double turn, double limit, const std::string& text, const OpenOptions& open,
               Reasons& reasons) {
    reasons.push_back({MergeFault::seam, kNoIndex, turn, limit, text,
                       remedy_of({{open.fair, kFair},
                                  {open.transition, kTransition},
                                  {open.smooth, kSmooth},
                                  {true, kSubdivide}})});
}

// All of the seams together: at their steep edges, else in the mean.
void judge_seam(const MergeReport& report, const OpenOptions& open, Reasons& reasons) {
    if (all_fit(report)) return;
    const double turn = steep_seam(report), before = steep_before(report);
    const double limit = std::max(kSteep, before);
    if (turn > limit) {
        return note_seam(turn, limit,
                         "the surface turns by " + angle_text(turn) + " across the seam, and by " +
                             angle_text(before) + " beside the boundaries before",
                         open, reasons);
    }
    double rough = 0.0;
    for (const JoinReport& join : report.joins) rough = std::max(rough, join.band.rest_roughness);
    const double mean = report.seam.after.rms_dihedral;
    const double usual = std::max({kSteepMean, kMeanOfCrease * report.crease, kMoreSteep * rough});
    if (!(mean > usual)) return;
    note_seam(mean, usual,
              "the surface turns by " + angle_text(mean) + " in the mean across the seam, and by " +
                  angle_text(rough) + " at the edges beside the boundaries before",
              open, reasons);
}

void judge_places(const MergeReport& report, const OpenOptions& open, Reasons& reasons) {
    for (std::size_t j = 0; j < report.joins.size(); ++j) {
        const JoinReport& join = report.joins[j];
        if (!join.guessed || join.any_turn || join.certainty >= kCertain) continue;
        reasons.push_back(
            {MergeFault::place, index_of(j), join.certainty, kCertain,
             "the match of the boundaries of join " + std::to_string(j + 1) + " is a guess",
             remedy_of({{open.keys, "give a key: one point of each boundary that meet"},
                        {!open.keys, "say which directions of both models belong together"}})});
    }
}

void judge_slivers(const MergeReport& report, const OpenOptions& open, Reasons& reasons) {
    // Every vertex is kept, even if those of one part lie close to those of the other.
    if (all_fit(report)) return;
    const SeamQuality& seam = report.seam.after;
    double thinnest = kThin;
    for (const SeamQuality* rim : {&report.source_rim, &report.target_rim}) {
        if (rim->smallest_angle > 0.0) thinnest = std::min(thinnest, rim->smallest_angle);
        // Sewing divides polygons.
        if (rim->polygon_angle > 0.0) thinnest = std::min(thinnest, rim->polygon_angle);
    }
    // Both are 0 without triangles.
    const bool triangles = seam.smallest_angle > 0.0 || seam.low_angle > 0.0;
    if (!(triangles && seam.smallest_angle < thinnest)) return;
    reasons.push_back(
        {MergeFault::slivers, kNoIndex, seam.smallest_angle, thinnest,
         "triangles at the seam have angles down to " + angle_text(seam.smallest_angle),
         remedy_of({{open.collar, "leave the collar on"}, {true, kSubdivide}})});
}

void judge_bite(const MergeReport& report, const OpenOptions& open, Reasons& reasons) {
    const TargetBite& bite = report.bite;
    if (!is_bitten(bite)) return;
    const bool deep = bite.depth > kBittenDepth;
    reasons.push_back(
        {MergeFault::bite, kNoIndex, deep ? bite.depth : bite.length, deep ? kBittenDepth : kBitten,
         text_of("the part bites into sharp edges of the target, along %.2f of its "
                 "radius and %.2f deep",
                 bite.length, bite.depth),
         remedy_of({{open.moves, "move the part off the edge, make it smaller"},
                    {true, "mark a region that reaches less far around the feature"}})});
}

Reasons reasons_of(const MergeReport& report, const OpenOptions& open) {
    Reasons reasons;
    judge_crossings(report, open, reasons);
    judge_sides(report, open, reasons);
    for (const auto& judge_join :
         {judge_folds, judge_roughness, judge_volume, judge_bend, judge_flare, judge_spike}) {
        for (Index j = 0; j < count_of(report.joins); ++j) judge_join(report, j, open, reasons);
    }
    judge_bite(report, open, reasons);
    judge_seam(report, open, reasons);
    judge_places(report, open, reasons);
    judge_slivers(report, open, reasons);
    return reasons;
}

// Faces that ran through one another before are told, but are no fault of the merge.
std::string crossings_text(const MergeReport& report, const OpenOptions& open) {
    if (!open.sought) return kNotSought;
    std::string text = "no faces run through one another that did not before";
    if (report.known_intersections > 0) {
        text += " (" + std::to_string(report.known_intersections) + " pairs did)";
    }
    Index touching = 0, hidden = 0;
    for (const CrossingGroup& group : report.crossings) {
        (group.shallow ? touching : hidden) += group.pairs;
    }
    std::vector<std::string> but;
    if (touching > 0) {
        but.push_back(std::to_string(touching) +
                      (touching == 1 ? " pair that touches" : " pairs that touch"));
    }
    if (hidden > 0) {
        but.push_back(std::to_string(hidden) +
                      (hidden == 1 ? " pair inside, which is hidden from outside"
                                   : " pairs inside, which are hidden from outside"));
    }
    return but.empty() ? text : text + ", but for " + joined_by(but, " and ");
}

}  // namespace

const char* fault_name(MergeFault fault) {
    switch (fault) {
        case MergeFault::crossings:
            return "crossings";
        case MergeFault::side:
            return "side";
        case MergeFault::folds:
            return "folds";
        case MergeFault::roughness:
            return "roughness";
        case MergeFault::volume:
            return "volume";
        case MergeFault::bend:
            return "bend";
        case MergeFault::flare:
            return "flare";
        case MergeFault::spike:
            return "spike";
        case MergeFault::seam:
            return "seam";
        case MergeFault::place:
            return "place";
        case MergeFault::slivers:
            return "slivers";
        case MergeFault::bite:
            return "bite";
        case MergeFault::left_out:
            break;
    }
    return "left out";
}

Verdict verdict_of(const MergeReport& report, const OpenOptions& open) {
    Reasons reasons = reasons_of(report, open);
    if (!reasons.empty()) {
        std::vector<std::string> faults;
        for (const MergeReason& reason : reasons) faults.push_back(reason.text);
        if (!open.sought) faults.emplace_back(kNotSought);
        return {false, "not good: " + joined_by(faults, "; "), std::move(reasons)};
    }
    return {true,
            "good: the surface turns by at most " + angle_text(report.seam.after.max_dihedral) +
                " across the seam, " + beside_text(report) + "and " + crossings_text(report, open),
            {}};
}

bool has_only_thorns(const MergeReport& report) {
    const auto is_thorn = [&](const MergeReason& reason) {
        if (reason.fault != MergeFault::folds || reason.join == kNoIndex) return false;
        const BandQuality& band = report.joins[at(reason.join)].band;
        return !folds_back(band) && !(band.sharpened > kSharpened) &&
               !(band.crumpled > kCrumpledEdges);
    };
    return !report.reasons.empty() &&
           std::all_of(report.reasons.begin(), report.reasons.end(), is_thorn);
}

bool is_bitten(const TargetBite& bite) {
    return bite.depth > kBittenDepth || bite.length > kBitten;
}

void judge(MergeReport& report, const OpenOptions& open) {
    Verdict verdict = verdict_of(report, open);
    report.ok = verdict.good;
    report.verdict = std::move(verdict.text);
    report.reasons = std::move(verdict.reasons);
}

}  // namespace lissom
