#include "bindings/lua/merge/merge_options.h"

#include <string>
#include <utility>

#include "bindings/lua/deform/thesis_parts.h"
#include "bindings/lua/mesh/mesh_object.h"

namespace lissom::lua {
namespace {

void add_direction(const Call& call, const char* source, const char* target, MergeOptions& to) {
    to.directions.push_back({call.vector(source), call.vector(target)});
}

void read_transition(const Call& call, MergeOptions& to) {
    // The thesis smooths seams without a transition only.
    if (to.thesis && !call.has("smooth")) to.smooth = 0;
    if (call.kind("transition") == Kind::boolean) {
        to.auto_transition = true;
        return;
    }
    to.source_transition = call.number("transition.source");
    to.target_transition = call.number("transition.target");
    to.transition_weight = call.number("transition.weight");
}

// Whether an option may be given if boundaries of one mesh are bridged and nothing is deformed.
enum class Bridge { taken, refused };

// All about one option.
struct OptionRow {
    Parameter parameter;
    Bridge bridge;
    // Reads it if it was given or has a default; null for options that are read apart.
    void (*read)(const Call& call, MergeOptions& to);
};

// A merge that is dragged leaves out slow steps: those that are `slow` by default.
std::vector<OptionRow> option_rows(bool slow) {
    return {
        {table("joins",
               "List of { source = boundary, target = boundary, keys = { { s, t }, ... } }: which "
               "boundaries meet, and points that do: vertices of the boundaries, or points {x, y, "
               "z} on them, the source's first. Between keys arc length decides. Without keys the "
               "directions below decide, or else `place`; the report says which turn was taken and "
               "how certain it is. All sources lie on one mesh; targets may lie on several, and "
               "each boundary is in one join.")
             .optional("the boundaries of source and target that lie nearest to each other, one "
                       "join for each target"),
         Bridge::taken, nullptr},
        {choice("place", {"as placed", "shape"},
                "Turn of joins without keys and directions about the axis of the boundary. "
                "as placed: least from how the source lies beside the target, so that a part that "
                "was laid roughly, or both as they were modelled, come right; the result is the "
                "same if both are moved together, or if the source is moved without a turn and "
                "scaled. shape: as the shapes of both parts suggest, the same wherever the source "
                "lies; the report says how certain that is. A part that must be turned over by "
                "more than 150 degrees is placed by shape as well.")
             .defaults("as placed"),
         Bridge::taken,
         [](const Call& call, MergeOptions& to) { to.place = call.choice<Place>("place"); }},
        {axis(
             "source_up",
             "A direction of the source that is to lie the way `target_up` does, for joins without "
             "keys. It counts as far as it lies in the plane of the boundary: that of a neck's "
             "axis says little.")
             .optional(),
         Bridge::refused, nullptr},
        {axis("target_up", "The direction of the targets that belongs to it.").optional(),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) {
             add_direction(call, "source_up", "target_up", to);
         }},
        {axis("source_front", "Another direction of the source: the view of a face.").optional(),
         Bridge::refused, nullptr},
        {axis("target_front", "The direction of the targets that belongs to it.").optional(),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) {
             add_direction(call, "source_front", "target_front", to);
         }},
        {choice("configuration", {"free", "fixed"},
                "free: the source comes from any place, turned and scaled to fit (thesis 3.3.1). "
                "fixed: it stays in place and bends near the boundaries (3.3.2).")
             .defaults("free"),
         Bridge::taken,
         [](const Call& call, MergeOptions& to) {
             to.configuration = call.choice<Configuration>("configuration");
         }},
        {objects("fixed", "lissom.Region",
                 "Regions of the source that keep their shape: in the free configuration each "
                 "moves as a whole, in the fixed one it stays.")
             .optional("none"),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) {
             for (std::size_t i = 0; i < call.object_count("fixed"); ++i) {
                 to.fixed.push_back(call.object_at<RegionObject>("fixed", i)->current());
             }
         }},
        {choice("features", {"common", "fitted"},
                "Similarity by which those of the free configuration move. common: each "
                "has one deformation gradient, an unknown of the systems (thesis 3.5). fitted: the "
                "surface is deformed without them first, and again with the fitted similarity: "
                "less distortion around them, by 5 to 44 % on four merges of real models, in up "
                "to twice the time.")
             .optional("\"fitted\"")
             .thesis("3.5", "\"common\""),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) {
             to.feature_motion = call.choice<FeatureMotion>("features");
         }},
        {number("reach",
                "fixed configuration: how far from its boundaries the source deforms, along edges.")
             .above(0)
             .in("units of the source")
             .optional("all of it if `fixed` is given, else three radii of the boundary"),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.reach = call.number("reach"); }},
        {choice("frames", {"turn", "keep"},
                "fixed configuration: whether the surface at the boundary turns to meet the "
                "target's, or keeps its directions as in the thesis, which leaves a crease.")
             .optional("\"turn\"")
             .thesis("3.3.2", "\"keep\""),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.turn_frames = call.integer("frames") == 0; }},
        {choice("seam", {"conform", "fair", "band"},
                "conform: vertices of both boundaries are inserted into the faces of the other "
                "side. fair: then the surface around the seam is bent smooth, but for flat faces "
                "and creases of the target, unless a transition does that. band: a band of the "
                "target's faces is replaced, as in the thesis.")
             .optional("\"conform\"")
             .thesis("3.3.1", "\"band\""),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.seam = call.choice<SeamKind>("seam"); }},
        {integer(
             "smooth",
             "Umbrella steps at the seam, at most: the first that would fold it is the last. With "
             "0 and without a collar no vertex of the target moves.")
             .between(0, 1000)
             .optional("3"),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.smooth = call.integer("smooth"); }},
        {boolean("collar",
                 "Makes the faces of a side anew if its edges are more than 1.5 times as long as "
                 "the seam's, from small to large; sharp edges keep their shape.")
             .optional("true")
             .thesis("3.3.1", "false"),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.collar = call.boolean("collar"); }},
        {options("transition",
                 {number("source", "Width on the source.")
                      .at_least(0)
                      .in("units of the source")
                      .defaults(0.0),
                  number("target", "Width on the target.")
                      .at_least(0)
                      .in("units of the target")
                      .defaults(0.0),
                  number("weight",
                         "w_T of thesis 3.3.3, for fidelity = \"thesis\", which needs both widths.")
                      .above(0)
                      .defaults(0.1)},
                 "Bands on either side of the seam in which details of both fade into each other; "
                 "`true` chooses widths that suit each seam: .9 of its radius, at least three "
                 "edges, at most half of the side; flat faces of the target stay flat then. If the "
                 "surface has no room for a width, the band is narrower and a warning says so.")
             .or_true()
             .optional("none"),
         Bridge::refused, [](const Call& call, MergeOptions& to) { read_transition(call, to); }},
        {boolean("trim",
                 "Boundaries with teeth are cut to smooth lines first, and the report says "
                 "so.")
             .optional("true")
             .thesis("3.3.1", "false"),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.trim = call.boolean("trim"); }},
        {number("max_turn", "Mean turn of a boundary at its vertices above which it is trimmed.")
             .between(0, 180)
             .in("degrees")
             .defaults(20.0),
         Bridge::taken,
         [](const Call& call, MergeOptions& to) {
             to.max_turn = call.number("max_turn") * kPi / 180.0;
         }},
        {boolean("subdivide",
                 "Faces of the source at a boundary are split once if its edges are more than "
                 "1.5 times as long as those they meet. Edges more than 3 times as long as edges "
                 "inside the source are split until they are not, and those of the target with "
                 "them (thesis 2.5).")
             .optional("true")
             .thesis("2.5", "false, as which boundaries have too few vertices is not said"),
         Bridge::refused,
         [](const Call& call, MergeOptions& to) { to.subdivide = call.boolean("subdivide"); }},
        {boolean("intersections",
                 "Looks for faces that run through one another and did not before, for the report.")
             .defaults(slow),
         Bridge::taken,
         [](const Call& call, MergeOptions& to) {
             to.find_intersections = call.boolean("intersections");
         }},
        {boolean(
             "mend",
             "If neither `seam` nor `transition` is given, fairs the places beside the seams at "
             "which a side became crumpled. If the verdict still finds fault with the surface "
             "there, sews again with the seam fair and then with a transition, and keeps the "
             "result with fewest faults; a warning says so. Takes the time of sewing up to three "
             "times. Not without smoothing or collar.")
             .defaults(slow),
         Bridge::taken,
         [](const Call& call, MergeOptions& to) {
             // A seam that is asked for is made.
             to.mend = call.boolean("mend") && !call.has("seam") && !call.has("transition");
         }},
        {choice("fidelity", {"default", "thesis"},
                "thesis: section 3.3 to the letter, for comparison, unless another option "
                "differs; the page thesis.md of the reference names all of it.")
             .defaults("default"),
         Bridge::taken, nullptr},
    };
}

}  // namespace

std::vector<Parameter> described_merge_options(bool slow) {
    std::vector<Parameter> parameters;
    for (OptionRow& row : option_rows(slow)) parameters.push_back(std::move(row.parameter));
    return parameters;
}

void check_directions(const Call& call) {
    constexpr std::pair<const char*, const char*> kPairs[] = {{"source_up", "target_up"},
                                                              {"source_front", "target_front"}};
    for (const auto& [source, target] : kPairs) {
        if (call.has(source) == call.has(target)) continue;
        call.reject(call.has(source) ? source : target,
                    "directions come in pairs: source_up with target_up, source_front with "
                    "target_front");
    }
}

MergeOptions merge_options(const Call& call) {
    MergeOptions options;
    if (call.integer("fidelity") == 1) {
        options = literal_merge_options(call.choice<Configuration>("configuration"));
    }
    for (const OptionRow& row : option_rows(true)) {
        if (row.read && call.has(row.parameter.name.c_str())) row.read(call, options);
    }
    return options;
}

void require_bridge_options(const Call& call) {
    const auto refuse = [](const std::string& name) {
        throw Error(ErrorCode::invalid_argument,
                    name +
                        " does not apply if source and target are one mesh: its boundaries are "
                        "bridged and nothing is deformed; leave it out, or merge a copy");
    };
    for (const OptionRow& row : option_rows(true)) {
        const std::string& name = row.parameter.name;
        if (row.bridge == Bridge::refused && call.has(name.c_str())) refuse(name);
    }
    const MergeOptions options = merge_options(call), defaults;
    if (options.configuration != defaults.configuration) refuse("configuration = \"fixed\"");
    if (options.place != defaults.place) refuse("place = \"shape\"");
    if (options.thesis) refuse("fidelity = \"thesis\"");
}

}  // namespace lissom::lua
