// The last steps of a paste: the part is deformed, the target opened, and both are sewn.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/clock.h"
#include "kernel/core/memory_error.h"
#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/blend/fair_spots.h"
#include "kernel/merge/blend/relax_faults.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/creases.h"
#include "kernel/merge/crossings.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/mend.h"
#include "kernel/merge/paste/laid_part.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/part/source_rest.h"
#include "kernel/merge/paste/part/target_bite.h"
#include "kernel/merge/paste/part/target_piece.h"
#include "kernel/merge/paste/part_trial.h"
#include "kernel/merge/paste/paste_state.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/sew/seam_collar.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/merge/verdict.h"
#include "kernel/mesh/edit/joined_content.h"
#include "kernel/mesh/edit/joined_morphs.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// A seam without a collar must be this much better than one with it.
constexpr double kPlainBetter = 0.9;
constexpr double kSteepSeam = 20.0 * kDegree;
// A boundary whose seam turns by more than this gives way to the loop of edges.
constexpr double kFoldedSeam = 90.0 * kDegree;

// Creases of the target end there, which smoothing the seam would bend.
std::vector<Index> kept_creases(const OpenedTarget& opened) {
    return creased_vertices(opened.mesh, vertices_near(opened.mesh, {&opened.loop, 1}));
}

// Creases and flat faces of the target, which a band that is bent leaves as they are.
std::vector<Index> shaped_vertices(const OpenedTarget& opened) {
    std::vector<Index> vertices(at(opened.mesh.vertex_count()));
    std::iota(vertices.begin(), vertices.end(), 0);
    const std::vector<Index> creased = creased_vertices(opened.mesh, vertices);
    const std::vector<Index> flat = flat_vertices(opened.mesh);
    vertices.clear();
    std::set_union(creased.begin(), creased.end(), flat.begin(), flat.end(),
                   std::back_inserter(vertices));
    return vertices;
}

Sewn sewn_with(const LaidPart& laid, const PasteMergeOptions& options, bool finished, bool collar,
               const Context& context) {
    SewOptions how;
    how.smooth = finished ? options.smooth : 0;
    if (how.smooth > 0) how.firm = kept_creases(laid.opened);
    how.collar = collar;
    how.flip = finished;
    const LoopPair pairs[] = {laid.pair};
    return sew(laid.opened.mesh, laid.trial.moved.mesh, pairs, how, context);
}

double turns(const Sewn& sewn) {
    return sewn.report.after.max_dihedral;
}
// Whether a seam is so steep that its faces turn over.
bool folds(const Sewn& sewn) {
    return turns(sewn) > kFoldedSeam;
}

// A draft whose faces turn over beside its seam, smoothed there as far as that helps.
Sewn relaxed_draft(const LaidPart& laid, Sewn draft, const Context& context) {
    const std::vector<Index> firm = became_of(draft, kept_creases(laid.opened));
    const std::vector<Vec3> rest =
        places_on_second(draft.map, laid.trial.part().mesh, laid.opened.mesh.vertex_count());
    for (Index rings = 1; rings <= kRelaxRings && folds(draft); rings *= 2) {
        Sewn relaxed = draft;
        if (!relax_faults(relaxed, {{}, firm, rest}, rings, context)) break;
        if (turns(relaxed) < turns(draft)) draft = std::move(relaxed);
    }
    return draft;
}

// As it is, or finished and smoothed if its faces turn over.
Sewn sewn_draft(const LaidPart& laid, const PasteMergeOptions& options, const Context& context) {
    Sewn draft = sewn_with(laid, options, false, false, context);
    for (const bool collar : {false, true}) {
        if (!folds(draft)) return draft;
        Sewn finished = sewn_with(laid, options, true, collar, context);
        if (turns(finished) < turns(draft)) draft = std::move(finished);
    }
    return folds(draft) ? relaxed_draft(laid, std::move(draft), context) : draft;
}

Sewn sewn_well(const LaidPart& laid, const PasteMergeOptions& options, const Context& context) {
    if (options.draft) return sewn_draft(laid, options, context);
    const auto angles = [](const Sewn& sewn) {
        return sewn.report.after.max_dihedral + sewn.report.after.max_near;
    };
    Sewn sewn = sewn_with(laid, options, true, options.collar, context);
    if (!(sewn.report.collar_added > 0 && sewn.report.after.max_dihedral > kSteepSeam)) {
        return sewn;
    }
    Sewn plain = sewn_with(laid, options, true, false, context);
    return angles(plain) <= kPlainBetter * angles(sewn) ? std::move(plain) : std::move(sewn);
}

// Ratio of two bites, each length times depth, below which the lesser is worth another boundary.
constexpr double kSparedMore = 0.8;

struct SewnPart {
    LaidPart laid;
    Sewn sewn;
    TargetBite bite;
};

TargetBite bite_of(std::span<const SharpEdge> edges, const LaidPart& laid, const Sewn& sewn,
                   const Context& context) {
    std::vector<Vec3> seam;
    for (const Index v : sewn.seams[0]) seam.push_back(sewn.mesh.position(v));
    const PastePart& part = laid.trial.part();
    return target_bite(
        edges, seam,
        {sewn.mesh, sewn.side_of_face, volume_over(laid.trial.moved.mesh, part.loop) < 0.0},
        context);
}

// Of the edges that the target has, or that a cleared one has left.
TargetBite bite_on(const PartTrials& trials, const TargetPiece& target, const LaidPart& laid,
                   const Sewn& sewn, const Context& context) {
    return bite_of(trials.left ? *trials.left : sharp_edges(target.mesh(), context), laid, sewn,
                   context);
}

SewnPart sewn_along(const PartTrials& trials, const TargetPiece& target, PartTrial trial,
                    const PasteMergeOptions& options, const Context& context) {
    SewnPart result{
        laid_part(trials, target.mesh(), target.chart_vertices(), std::move(trial), context),
        {},
        {}};
    result.sewn = sewn_well(result.laid, options, context);
    if (options.draft) return result;
    result.bite = bite_on(trials, target, result.laid, result.sewn, context);
    return result;
}

// Steep or rough places along the boundary on the source may be so on the target.
void note_source(const SourceRest& rest, MergeReport& report) {
    BandQuality& band = report.joins[0].band;
    band.rest_steep = std::max(band.rest_steep, rest.steep);
    band.rest_roughness = std::max(band.rest_roughness, rest.roughness);
    band.rest_bend = std::max(band.rest_bend, rest.bend);
    band.rest_max_bend = std::max(band.rest_max_bend, rest.max_bend);
    band.source_volume =
        std::max(band.source_volume, std::min(1.0, band.source_volume + rest.dome));
}

bool is_inside_out(const Mesh& mesh) {
    return mesh.topology().is_closed() && volume(mesh) < 0.0;
}

// Of meshes that look to different sides the one that is inside out has to turn.
void warn_of_sides(const Mesh& target, const Mesh& source, std::vector<std::string>& warnings) {
    const bool target_inward = is_inside_out(target), source_inward = is_inside_out(source);
    if (target_inward == source_inward) return;
    warnings.push_back(std::string(target_inward ? "the target" : "the source") +
                       " is inside out, so that the part grows inward; mesh:flip() turns it");
}

// A part whose boundary makes it much larger or smaller than it was asked to be.
constexpr double kOtherSize = 1.5;

void warn_of_size(double made, double asked, std::vector<std::string>& warnings) {
    if (made < kOtherSize * asked && asked < kOtherSize * made) return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "the part is %.2g times the size that was asked for, since its boundary is; "
                  "size = \"lock\" keeps the size",
                  made / asked);
    warnings.emplace_back(text);
}

double area_on(const Mesh& mesh, std::span<const Index> faces) {
    double sum = 0.0;
    for (const Index f : faces) sum += 0.5 * area_vector(mesh, f).norm();
    return sum;
}

// The share of the target's area that the part leaves.
double area_kept(const Mesh& target, const Sewn& sewn) {
    const double before = area(target);
    const double after = area_on(sewn.mesh, faces_on(sewn.side_of_face, SeamSide::target));
    return before > 0.0 ? std::min(1.0, after / before) : 1.0;
}

// `sewn` is that of the whole target.
MergeReport merge_report(const Mesh& target, const Mesh& source, const SewnPart& pasted,
                         const Sewn& sewn, double crease, const PasteMergeOptions& options,
                         const Context& context) {
    const LaidPart& laid = pasted.laid;
    MergeReport report;
    report.crease = crease;
    report.bite = pasted.bite;
    const PastePart& part = laid.trial.part();
    const std::vector<Index> loops[] = {part.loop, laid.opened.loop};
    report.source_rim = seam_quality(part.mesh, {&loops[0], 1});
    report.target_rim = seam_quality(laid.opened.mesh, {&loops[1], 1});
    JoinReport join;
    join.source_size = count_of(part.loop);
    join.target_size = count_of(laid.opened.loop);
    join.scale = laid.trial.scale;
    report.joins.push_back(join);
    const NamedSide sides[] = {{"the part", &part.mesh}, {"the target", &target}};
    report.warnings = absence_warnings(sides);
    report.deform = laid.trial.moved.stats;
    report.seam = sewn.report;
    if (!options.draft) warn_of_sides(target, source, report.warnings);
    for (std::string& conflict : morph_conflicts(target, part.mesh)) {
        report.warnings.push_back(std::move(conflict));
    }
    const bool sought = options.find_intersections && !options.draft;
    if (sought) {
        Crossings found = new_crossings(target, part.mesh, sewn, context);
        report.intersections = std::move(found.pairs);
        report.known_intersections = found.known;
        report.crossings = crossing_groups(sewn, report.intersections, context);
    }
    if (!options.draft) {
        const std::vector<Index> of_target = faces_on(sewn.side_of_face, SeamSide::target);
        const std::vector<Index> of_source = faces_on(sewn.side_of_face, SeamSide::source);
        const std::vector<Vec3> rest = places_on_second(sewn.map, part.mesh, target.vertex_count());
        const std::vector<Vec3> target_rest = places_on_first(sewn.map, target);
        report.joins[0].band =
            band_quality({&sewn.mesh, of_target, sewn.seams[0], false, target_rest},
                         {&sewn.mesh, of_source, sewn.seams[0], false, rest, true},
                         {&laid.opened.mesh, {}, laid.opened.loop, true},
                         {&part.mesh, {}, part.loop}, join.scale, false, context);
        note_source(source_rest(source, part, context), report);
        report.joins[0].band.target_volume = area_kept(target, sewn);
    }
    OpenOptions open;
    open.sought = sought;
    open.moves = true;
    open.smooth = !options.draft && report.seam.smoothed >= options.smooth;
    open.collar = !options.draft && !options.collar;
    judge(report, open);
    return report;
}

// If the seam turns faces over, takes the boundary, along edges or the outline, that turns least,
// and is distorted no more than the outline.
void unfold(const PartTrials& trials, const TargetPiece& target,
            const std::optional<PasteDistortion>& outline_near, const PasteMergeOptions& options,
            SewnPart& whole, const Context& context) {
    const auto attempt = [&](PartTrial trial) {
        if (outline_near && trial.near.energy > outline_near->energy) return;
        SewnPart next = sewn_along(trials, target, std::move(trial), options, context);
        if (turns(next.sewn) < turns(whole.sewn)) whole = std::move(next);
    };
    if (folds(whole.sewn)) attempt(trials.along_loop(context));
    if (folds(whole.sewn) && outline_near) attempt(outline_trial(trials, context));
}

// Whether, of two pastes that do not fold, the first leaves more of the target's edges intact.
bool spares_more(const SewnPart& next, const SewnPart& whole) {
    const auto taken = [](const TargetBite& bite) { return bite.length * bite.depth; };
    return !folds(next.sewn) && taken(next.bite) < kSparedMore * taken(whole.bite);
}

// If sharp edges of the target lie between the boundary and the feature, the feature alone is
// pasted: the surface around it stays.
void spare_edges(const PartTrials& trials, const TargetPiece& target,
                 const PasteMergeOptions& options, SewnPart& whole, const Context& context) {
    if (!is_bitten(whole.bite)) return;
    try {
        PartTrial tight = tight_trial(trials, context);
        SewnPart next = sewn_along(trials, target, std::move(tight), options, context);
        if (spares_more(next, whole)) whole = std::move(next);
    } catch (const Error& error) {
        // There is no room for that.
        if (error.code() != ErrorCode::boundary_conflict) throw;
    }
}

// How many kinds of faults a verdict would find first.
int faults_of(const SewnPart& pasted, const Context& context) {
    const LaidPart& laid = pasted.laid;
    const Crossings found =
        new_crossings(laid.opened.mesh, laid.trial.part().mesh, pasted.sewn, context);
    const auto groups = crossing_groups(pasted.sewn, found.pairs, context);
    const bool crosses = std::any_of(groups.begin(), groups.end(),
                                     [](const CrossingGroup& group) { return !group.shallow; });
    return (folds(pasted.sewn) ? 1 : 0) + (is_bitten(pasted.bite) ? 1 : 0) + (crosses ? 1 : 0);
}

// The part on sharp edges of the target; nothing if there are none or it has no room.
std::optional<SewnPart> sewn_on_edges(const PartTrials& trials, const TargetPiece& target,
                                      const PasteMergeOptions& options, const Context& context) {
    std::optional<PartTrial> draped = draped_trial(trials, context);
    if (!draped) return std::nullopt;
    try {
        return sewn_along(trials, target, *std::move(draped), options, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
        return std::nullopt;
    }
}

// The part on a piece of the target, along the boundary that folds least.
SewnPart sewn_along_best(const PartTrials& trials, const TargetPiece& target, bool other_allowed,
                         PasteReport& report, const PasteMergeOptions& options,
                         const Context& context) {
    BestTrial best = best_trial(trials, options.compare && other_allowed, context);
    report.outline_near = best.outline_near;
    SewnPart result = sewn_along(trials, target, std::move(best.trial), options, context);
    if (!options.draft) {
        unfold(trials, target, report.outline_near, options, result, context);
        if (other_allowed && !trials.options.thesis)
            spare_edges(trials, target, options, result, context);
    }
    return result;
}

// The same, unless it stands better on sharp edges.
SewnPart sewn_onto(const PartTrials& trials, const TargetPiece& target, bool other_allowed,
                   PasteReport& report, const PasteMergeOptions& options, const Context& context) {
    std::optional<SewnPart> on_edges = sewn_on_edges(trials, target, options, context);
    if (on_edges && options.draft) return *std::move(on_edges);
    const int faults = on_edges ? faults_of(*on_edges, context) : 0;
    if (on_edges && faults == 0) return *std::move(on_edges);
    SewnPart best = sewn_along_best(trials, target, other_allowed, report, options, context);
    const bool better = on_edges && faults <= faults_of(best, context);
    return better ? *std::move(on_edges) : std::move(best);
}

// Parts that a piece of the target may have; whether along another boundary than the one found.
struct PasteTrialsOn {
    const PartTrials& trials;
    const TargetPiece& piece;
    bool other_allowed = true;
};

// A part in the whole target, and its report.
struct JudgedPart {
    SewnPart pasted;
    PastedOn made;
    MergeReport report;
};

// Sews parts onto a piece of the target and judges the whole.
class PasteJudge {
  public:
    PasteJudge(const Mesh& target, const Mesh& source, const PasteTrialsOn& on, double crease,
               const PasteOrigins& origins, const PasteMergeOptions& options)
        : target_(target),
          source_(source),
          on_(on),
          crease_(crease),
          origins_(origins),
          options_(options) {}

    // Nothing if the piece is too small for it.
    std::optional<JudgedPart> judged(SewnPart pasted, const Context& context) const {
        const LaidPart& laid = pasted.laid;
        // Only ways that may be left for others are needed again.
        Sewn sewn = options_.mend ? pasted.sewn : std::move(pasted.sewn);
        std::optional<PastedOn> made =
            on_.piece.put_back(laid.opened, laid.trial.part(), std::move(sewn), origins_, context);
        if (!made) return std::nullopt;
        MergeReport report =
            merge_report(target_, source_, pasted, made->sewn, crease_, options_, context);
        return JudgedPart{std::move(pasted), *std::move(made), std::move(report)};
    }

    // The part, or the same sewn another way that has fewer faults.
    JudgedPart mended(JudgedPart best, const Context& context) const {
        if (!may_change()) return best;
        const std::string plain_faults = best.report.ok ? "" : fault_names(best.report);
        fair(best, context);
        if (best.report.ok && !plain_faults.empty()) {
            note_mended(plain_faults, "its crumpled places are fair", best.report);
        }
        return has_surface_faults(best.report) ? mended_otherwise(std::move(best), context) : best;
    }

  private:
    // The same sewn another way, if it has fewer faults.
    JudgedPart mended_otherwise(JudgedPart best, const Context& context) const {
        const std::string faults = fault_names(best.report);
        const SewnPart plain = best.pasted;
        std::string taken;
        // The least change first.
        if (has_only_thorns(best.report) && relax(best, context)) taken = "its thorns are smoothed";
        for (const auto& [way, name] : kWays) {
            if (best.report.ok) break;
            std::optional<JudgedPart> other = attempt(way, plain, context);
            if (other) fair(*other, context);
            if (!other || !is_better(other->report, best.report, !taken.empty())) continue;
            best = *std::move(other);
            taken = name;
        }
        if (relax(best, context)) {
            taken += (taken.empty() ? "" : " and ") + std::string("its folds are smoothed");
        }
        if (!taken.empty()) note_mended(faults, taken, best.report);
        return best;
    }

    enum class Way { fair, transition, outline, tight };
    static constexpr std::pair<Way, const char*> kWays[] = {
        {Way::fair, "it is fair"},
        {Way::transition, "a transition is made"},
        {Way::outline, "the marked outline is taken"},
        {Way::tight, "the feature's own outline is taken"}};

    bool may_change() const {
        return options_.mend && !options_.draft && options_.collar && options_.smooth > 0 &&
               !on_.trials.options.thesis;
    }

    // Fairs the places at which a side crumpled, as far as that leaves fewer and no more faults.
    void fair(JudgedPart& best, const Context& context) const {
        for (Index rings = kMinSpotRings; rings <= kMaxSpotRings && is_crumpled(best.report);
             ++rings) {
            std::optional<JudgedPart> tried = faired(best, rings, context);
            if (!tried) break;
            if (is_fairer(tried->report, best.report)) best = *std::move(tried);
        }
    }

    std::optional<JudgedPart> attempt(Way way, const SewnPart& plain,
                                      const Context& context) const {
        const bool other_boundary = way == Way::outline || way == Way::tight;
        if (other_boundary && !(on_.other_allowed && options_.compare)) return std::nullopt;
        try {
            return judged(other_boundary ? along_other(way, context) : bent(way, plain, context),
                          context);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::memory_limit) {
                throw;
            }
            // There is no room for that way.
            return std::nullopt;
        }
    }

    SewnPart along_other(Way way, const Context& context) const {
        PartTrial trial = way == Way::outline ? outline_trial(on_.trials, context)
                                              : tight_trial(on_.trials, context);
        return sewn_along(on_.trials, on_.piece, std::move(trial), options_, context);
    }

    SewnPart bent(Way way, SewnPart part, const Context& context) const {
        Sewn& sewn = part.sewn;
        const std::vector<Index> firm = became_of(sewn, shaped_vertices(part.laid.opened));
        if (way == Way::fair) {
            SeamFairing how;
            how.firm = firm;
            fair_seam(sewn.mesh, sewn.seams, how, context);
            flip_near_seams(sewn, context);
        } else {
            TransitionOptions how;
            how.firm = firm;
            blend_transition(sewn, suitable_widths(sewn, context), how, context);
        }
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
        part.bite = bite_on(on_.trials, on_.piece, part.laid, sewn, context);
        return part;
    }

    // Takes folds and crossings away, as far as that leaves fewer faults. Returns whether it did.
    bool relax(JudgedPart& best, const Context& context) const {
        bool better = false;
        std::optional<JudgedPart> tried = best;
        for (Index rings = 1; rings <= kRelaxRings && tried && !tried->report.ok; rings *= 2) {
            tried = relaxed(*tried, rings, context);
            if (!tried || !is_better(tried->report, best.report, false)) continue;
            best = *tried;
            better = true;
        }
        return better;
    }

    // Fair at the places at which a side crumpled; nothing if there are none.
    std::optional<JudgedPart> faired(const JudgedPart& from, Index rings,
                                     const Context& context) const {
        SewnPart part = from.pasted;
        Sewn& sewn = part.sewn;
        const Mesh& target = part.laid.opened.mesh;
        const std::vector<Vec3> source =
            places_on_second(sewn.map, part.laid.trial.part().mesh, target.vertex_count());
        const std::vector<Vec3> rest = places_on_first(sewn.map, target);
        const std::vector<Index> firm = became_of(sewn, shaped_vertices(part.laid.opened));
        if (!fair_spots(sewn, {source, rest, firm, rings}, context)) return std::nullopt;
        part.bite = bite_on(on_.trials, on_.piece, part.laid, sewn, context);
        return judged(std::move(part), context);
    }

    // Smoothed at folds, crossings, thorns and pits; nothing if it has none.
    std::optional<JudgedPart> relaxed(const JudgedPart& from, Index rings,
                                      const Context& context) const {
        SewnPart part = from.pasted;
        Sewn& sewn = part.sewn;
        const LaidPart& laid = part.laid;
        const Crossings found =
            new_crossings(laid.opened.mesh, laid.trial.part().mesh, sewn, context);
        const std::vector<Index> firm = became_of(sewn, kept_creases(laid.opened));
        const std::vector<Index> crossing =
            showing_faces(crossing_groups(sewn, found.pairs, context));
        const std::vector<Vec3> rest =
            places_on_second(sewn.map, laid.trial.part().mesh, laid.opened.mesh.vertex_count());
        if (!relax_faults(sewn, {crossing, firm, rest}, rings, context)) return std::nullopt;
        part.bite = bite_on(on_.trials, on_.piece, laid, sewn, context);
        return judged(std::move(part), context);
    }

    const Mesh &target_, &source_;
    const PasteTrialsOn& on_;
    double crease_;
    const PasteOrigins& origins_;
    const PasteMergeOptions& options_;
};

}  // namespace

PasteResult Paste::merge(const PasteMergeOptions& options, const Context& context) try {
    State& state = *state_;
    Progress progress(context, "paste");
    const auto start = Clock::now();
    const PlacedFeature& placed = state.placed;
    const RingSurface surface(*state.used->map, *state.triangles, placed.images);
    const bool refines = options.compare && !state.options.thesis && !options.draft;
    const bool settles = refines && state.optimized && !state.bound_to_boundary() &&
                         state.options.correspondence == PasteCorrespondence::closest;
    const PartTrials trials{state.options,
                            state.regions,
                            surface,
                            *state.ring,
                            placed,
                            state.parts,
                            options.lock_scale,
                            refines,
                            settles,
                            state.edges_to_stand_on(context),
                            options.draft ? std::nullopt : state.edges_left(context)};
    PasteReport report;
    report.search = placed.loop.report;
    report.source_map = state.source_map.quality();
    report.target_map = state.used->map->target().quality();
    report.angle = placed.angle;
    report.angle_chosen = placed.angle_chosen;
    report.upright = placed.upright;
    report.draft = options.draft;
    report.clearing = state.clearing;
    // Along another boundary more of the target would go than was told.
    const bool other_allowed = state.covers(placed) && !state.bound_to_boundary();
    progress.step(0.6);
    const PasteOrigins origins{state.altered ? &*state.altered : nullptr,
                               state.as_given().topology(), !options.draft,
                               options.find_intersections && !options.draft};
    const auto pasted_on = [&](const TargetPiece& piece) -> std::optional<JudgedPart> {
        const PasteTrialsOn on{trials, piece, other_allowed};
        const PasteJudge judge(state.target, state.source, on, state.options.crease, origins,
                               options);
        std::optional<JudgedPart> part = judge.judged(
            sewn_onto(trials, piece, other_allowed, report, options, context), context);
        if (part) part = judge.mended(*std::move(part), context);
        return part;
    };
    std::optional<JudgedPart> done = pasted_on(state.target_piece(context));
    progress.step(0.4);
    if (!done) {
        done = pasted_on(TargetPiece::whole(state.target, state.used->map->target()));
    }
    const SewnPart& pasted = done->pasted;
    const PartTrial& trial = pasted.laid.trial;
    Sewn& sewn = done->made.sewn;
    report.scale = trial.scale;
    report.smooth = trial.smooth;
    report.kept_outline = trial.outline;
    report.tight = trial.tight;
    report.draped = trial.draped;
    report.joined = state.regions.joined;
    report.near = pasted.laid.near;
    report.laid = trial.near;
    if (!options.draft) warn_of_size(trial.scale, placed.placement.scale, done->report.warnings);
    report.feature =
        feature_distortion(trial.part(), trial.moved.mesh, report.scale, state.regions.feature);
    PasteResult result{{}, std::move(report)};
    result.merged.report = std::move(done->report);
    result.merged.report.solve_seconds = seconds_since(start);
    result.merged.provenance = std::move(done->made.provenance);
    result.report.euler_characteristic = euler_characteristic(sewn.mesh.topology());
    result.report.expected_characteristic = euler_characteristic(state.target.topology()) +
                                            euler_characteristic(trial.part().mesh.topology()) - 1;
    result.merged.mesh = std::move(sewn.mesh);
    result.merged.side_of_face = std::move(sewn.side_of_face);
    result.merged.seams = std::move(sewn.seams);
    return result;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

// On the faces of the chart alone, or, if the boundary touches their border, on those around too.
LaidPart Paste::State::laid_on_ground(const PartTrials& trials, const PartTrial& trial,
                                      const Context& context) {
    try {
        const PasteGround& small = ground(context);
        return laid_part(trials, small.mesh, small.vertices, trial, context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::boundary_conflict) throw;
    }
    const TargetPiece& piece = target_piece(context);
    return laid_part(trials, piece.mesh(), piece.chart_vertices(), trial, context);
}

// The part as a draft of `merge` has it.
LaidPart Paste::State::drafted(const PartTrials& trials, const PasteDraftOptions& wanted,
                               const Context& context) {
    const bool free = covers(placed) && !bound_to_boundary();
    if (const auto draped = draped_trial(trials, context)) {
        try {
            return laid_on_ground(trials, *draped, context);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::boundary_conflict) throw;
        }
    }
    const BestTrial best = best_trial(trials, wanted.compare && free, context);
    return laid_on_ground(trials, best.trial, context);
}

PasteDraft Paste::draft(const PasteDraftOptions& options, const Context& context) try {
    State& state = *state_;
    const PlacedFeature& placed = state.placed;
    const RingSurface surface(*state.used->map, *state.triangles, placed.images);
    const PartTrials trials{
        state.options, state.regions,      surface, *state.ring, placed,
        state.parts,   options.lock_scale, false,   false,       state.edges_to_stand_on(context)};
    const LaidPart laid = state.drafted(trials, options, context);
    return {part_at_seam(laid), laid.trial.part().loop, laid.trial.scale,
            laid.trial.smooth,  laid.trial.outline,     laid.near,
            laid.trial.near};
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
