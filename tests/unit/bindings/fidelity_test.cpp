// The table of what differs from the thesis names every option that the fidelity changes.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "bindings/lua/reference/departures.h"
#include "kernel/deform/options.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/merge/merge.h"
#include "kernel/thesis/fidelity.h"
#include "tests/unit/bindings/lua_state.h"

namespace lissom::lua {
namespace {

// All that it binds by name: a field more, and this does not compile until it is told whether the
// thesis has it otherwise.
using Names = std::set<std::string>;

void note(Names& names, const char* name, bool differs) {
    if (differs) names.insert(name);
}

Names of_deformer() {
    const auto& [method, second, size, volume, weights, refine, coherence, coherence_weight,
                 threshold, flat, loose, free_rings, borders, displacement, scale_free, transition,
                 level_vertices, comparison] = DeformOptions{};
    const DeformOptions t = thesis_deform_options();
    Names names;
    note(names, "method", method != t.method);
    note(names, "second", second != t.second);
    note(names, "local_size", size != t.local_size);
    note(names, "volume", volume != t.volume);
    note(names, "weights", weights != t.weights);
    note(names, "refine", refine != t.refine);
    note(names, "coherence", coherence != t.coherence);
    note(names, "coherence_weight", coherence_weight != t.coherence_weight);
    note(names, "degenerate_threshold", threshold != t.degenerate_threshold);
    note(names, "flat", flat != t.flat);
    note(names, "loose", loose != t.loose);
    note(names, "free_rings", free_rings != t.free_rings);
    note(names, "subdivide_borders", borders != t.subdivide_borders);
    note(names, "displacement", displacement != t.displacement);
    note(names, "transition", transition != t.transition);
    note(names, "levels", level_vertices != t.level_vertices);
    // A matter without an option.
    CHECK(scale_free != t.scale_free);
    CHECK((comparison == t.comparison));
    return names;
}

Names of_merge() {
    const auto& [configuration, place, fixed, motion, reach, frames, seam, smooth, collar,
                 source_width, target_width, suit, weight, trim, turn, refine, intersections, mend,
                 directions, thesis] = MergeOptions{};
    const MergeOptions t = thesis_merge_options(Configuration::fixed);
    CHECK(thesis_merge_options().configuration == configuration);
    CHECK(thesis_merge_options().turn_frames);
    CHECK(place == t.place);
    Names names;
    note(names, "fixed", fixed.size() != t.fixed.size());
    note(names, "features", motion != t.feature_motion);
    note(names, "reach", reach != t.reach);
    note(names, "frames", frames != t.turn_frames);
    note(names, "seam", seam != t.seam);
    note(names, "smooth", smooth != t.smooth);
    note(names, "collar", collar != t.collar);
    note(names, "transition",
         suit != t.auto_transition || source_width != t.source_transition ||
             target_width != t.target_transition);
    note(names, "weight", weight != t.transition_weight);
    note(names, "trim", trim != t.trim);
    note(names, "max_turn", turn != t.max_turn);
    note(names, "subdivide", refine != t.subdivide);
    note(names, "intersections", intersections != t.find_intersections);
    CHECK(mend == t.mend);
    CHECK(directions.size() == t.directions.size());
    CHECK(thesis != t.thesis);
    return names;
}

Names of_style() {
    const auto& [resolution, volume, field, gravity, fidelity] = HairstyleOptions{};
    const auto& [boundary, solver, tension, dense_limit, tolerance, refinements] = field;
    const HairstyleOptions t = style_options_with(HairFidelity::thesis);
    Names names;
    note(names, "resolution", resolution != t.resolution);
    note(names, "volume", volume.has_value() != t.volume.has_value());
    note(names, "boundary", boundary != t.field.boundary);
    note(names, "solver", solver != t.field.solver);
    note(names, "tension", tension != t.field.tension);
    note(names, "gravity", gravity != t.gravity);
    CHECK(dense_limit == t.field.dense_limit);
    CHECK(tolerance == t.field.tolerance);
    CHECK(refinements == t.field.refinements);
    CHECK(fidelity != t.fidelity);
    return names;
}

Names of_stream() {
    const auto& [points, options, clearance] = StreamCurve{};
    const auto& [stop_length, weight, fidelity] = options;
    const StreamCurve t = curve_with<StreamCurve>(HairFidelity::thesis);
    Names names;
    note(names, "points", points != t.points);
    note(names, "clearance", clearance != t.clearance);
    note(names, "stop", stop_length != t.options.stop_length);
    note(names, "weight", weight != t.options.weight);
    CHECK(fidelity != t.options.fidelity);
    return names;
}

Names of_dividing() {
    const auto& [points, options, gap, hints] = DividingCurve{};
    const auto& [left, right, sigma, height, reach, thickness, separation, wall_width, wall_height,
                 ramp, weight, fidelity] = options;
    const DividingCurve t = curve_with<DividingCurve>(HairFidelity::thesis);
    Names names;
    note(names, "points", points != t.points);
    note(names, "gap", gap != t.gap);
    note(names, "hints", hints != t.hints);
    note(names, "left", left != t.options.left);
    note(names, "right", right != t.options.right);
    note(names, "sigma", sigma != t.options.sigma);
    note(names, "height", height != t.options.height);
    note(names, "reach", reach != t.options.reach);
    note(names, "thickness", thickness != t.options.thickness);
    note(names, "separation", separation != t.options.separation);
    note(names, "wall_width", wall_width != t.options.wall_width);
    note(names, "wall_height", wall_height != t.options.wall_height);
    note(names, "weight", weight != t.options.weight);
    // Follows from the fidelity where it is absent.
    note(names, "ramp", !ramp && fidelity != t.options.fidelity);
    return names;
}

Names of_ponytail() {
    const auto& [spine, options, tail_length, ragged] = Ponytail{};
    const auto& [radius, section, profiles, share, fullness, inner, outer, ring, lead, tightness,
                 grip, spread, clearance, stop_length, weight, fidelity] = options;
    const Ponytail t = curve_with<Ponytail>(HairFidelity::thesis);
    Names names;
    note(names, "spine", spine != t.spine);
    note(names, "ragged", ragged != t.ragged);
    note(names, "radius", radius != t.options.radius);
    note(names, "section", section != t.options.section);
    note(names, "profiles", profiles != t.options.profiles);
    note(names, "share", share != t.options.share);
    note(names, "fullness", fullness != t.options.fullness);
    note(names, "inner", inner != t.options.inner);
    note(names, "outer", outer != t.options.outer);
    note(names, "tightness", tightness != t.options.tightness);
    note(names, "grip", grip != t.options.grip);
    note(names, "spread", spread != t.options.spread);
    note(names, "stop", stop_length != t.options.stop_length);
    note(names, "weight", weight != t.options.weight);
    // These follow from the fidelity where they are absent.
    const bool literal = fidelity != t.options.fidelity;
    note(names, "ring", !ring && literal);
    note(names, "lead", !lead && literal);
    note(names, "free", !clearance && literal);
    note(names, "tail_length", !tail_length && literal);
    return names;
}

Names of_growth() {
    const auto& [length, variation, length_map, masks, segment, min_speed, max_turn, max_segments,
                 lift, start_outward, cap_speed, avoid, clearance, layer, ramp, ties, cuts, spare,
                 placement, seed] = GrowthOptions{};
    const GrowthOptions t = growth_options_with(HairFidelity::thesis);
    Names names{"length", "roots"};
    note(names, "variation", variation != t.variation);
    note(names, "lengths", length_map != t.length_map);
    CHECK(masks == t.masks);
    note(names, "segment", segment != t.segment);
    note(names, "min_speed", min_speed != t.min_speed);
    note(names, "max_turn", max_turn != t.max_turn);
    note(names, "max_segments", max_segments != t.max_segments);
    note(names, "lift", lift != t.lift);
    note(names, "avoid", avoid != t.avoid);
    note(names, "clearance", clearance != t.clearance);
    note(names, "layer", layer != t.layer);
    note(names, "ramp", ramp != t.ramp);
    note(names, "seed", seed != t.seed);
    // Matters without an option, and what the style sets.
    CHECK(start_outward != t.start_outward);
    CHECK(cap_speed != t.cap_speed);
    CHECK(ties.size() == t.ties.size());
    CHECK(cuts.size() == t.cuts.size());
    CHECK(spare == t.spare_tied);
    CHECK(placement.translation == t.placement.translation);
    return names;
}

// What the table has of a function: "`ring` of `hairstyle:add_ponytail`".
Names told_of(const std::vector<Departure>& all, const std::string& call) {
    Names names;
    for (const Departure& one : all) {
        if (one.option.empty() || !one.subject.ends_with("of `" + call + "`")) continue;
        CHECK(one.by == kByFidelity);
        CHECK(one.usual != one.thesis);
        names.insert(one.option);
    }
    return names;
}

}  // namespace

TEST_CASE("the table of what differs from the thesis names every option that fidelity changes") {
    const std::vector<Departure> all = departures(kernel_registry());
    CHECK(told_of(all, "lissom.deformer") == of_deformer());
    CHECK(told_of(all, "lissom.merge") == of_merge());
    CHECK(told_of(all, "lissom.hairstyle") == of_style());
    CHECK(told_of(all, "hairstyle:add_stream") == of_stream());
    CHECK(told_of(all, "hairstyle:add_dividing") == of_dividing());
    CHECK(told_of(all, "hairstyle:add_ponytail") == of_ponytail());
    CHECK(told_of(all, "hairstyle:grow") == of_growth());
    std::string section = "2";
    for (const Departure& one : all) {
        CAPTURE(one.subject);
        CHECK(section <= one.section);
        section = one.section;
        CHECK(!one.usual.empty());
        CHECK(!one.thesis.empty());
    }
}

}  // namespace lissom::lua
