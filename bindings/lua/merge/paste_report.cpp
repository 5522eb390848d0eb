// Reports of a paste for scripts.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/merge/paste_object.h"

namespace lissom::lua {
namespace {

constexpr double kInDegrees = 180.0 / kPi;

const char* stop_name(PasteStop stop) {
    if (stop == PasteStop::converged) return "converged";
    return stop == PasteStop::cycle ? "cycle" : "iterations";
}

const char* map_method_name(ParameterizeMethod method) {
    if (method == ParameterizeMethod::arap) return "arap";
    return method == ParameterizeMethod::lscm ? "lscm" : "tutte";
}

void push_distortion(const Call& call, const PasteDistortion& distortion) {
    lua_createtable(call.lua(), 0, 3);
    call.set_field("anisotropy", call.push(distortion.anisotropy));
    call.set_field("energy", call.push(distortion.energy));
    call.set_field("faces", call.push(distortion.faces));
}

void push_map_quality(const Call& call, const MapQuality& map) {
    lua_createtable(call.lua(), 0, 7);
    call.set_field("method", call.push(map_method_name(map.method)));
    call.set_field("faces", call.push(map.faces));
    call.set_field("flipped", call.push(map.flipped));
    call.set_field("flipped_fill", call.push(map.flipped_fill));
    call.set_field("crossings", call.push(map.crossings));
    call.set_field("min_scale", call.push(map.min_scale));
    call.set_field("max_scale", call.push(map.max_scale));
}

}  // namespace

int push_paste_search(const Call& call, const PasteSearch& search) {
    lua_createtable(call.lua(), 0, 11);
    call.set_field("energy", call.push_numbers(search.energy));
    call.set_field("misfit", call.push_numbers(search.misfit));
    if (search.outline_energy) {
        call.set_field("outline_energy", call.push(*search.outline_energy));
    }
    if (search.outline_misfit) {
        call.set_field("outline_misfit", call.push(*search.outline_misfit));
    }
    if (search.smooth_energy) call.set_field("smooth_energy", call.push(*search.smooth_energy));
    if (search.smooth_misfit) call.set_field("smooth_misfit", call.push(*search.smooth_misfit));
    call.set_field("stop", call.push(stop_name(search.stop)));
    call.set_field("kept_outline", call.push(search.kept_outline));
    call.set_field("scale", call.push(search.scale));
    call.set_field("loop_size", call.push(search.loop_size));
    call.set_field("closest_rounds", call.push(search.closest_rounds));
    return 1;
}

int push_clearing(const Call& call, const PasteClearing& clearing) {
    lua_createtable(call.lua(), 0, 3);
    call.set_field("faces", call.push(clearing.faces));
    call.set_field("area", call.push(clearing.area));
    call.set_field("height", call.push(clearing.height));
    return 1;
}

int push_paste_report(const Call& call, const PasteReport& report) {
    lua_createtable(call.lua(), 0, 20);
    push_paste_search(call, report.search);
    call.set_field("search");
    push_map_quality(call, report.source_map);
    call.set_field("source_map");
    push_map_quality(call, report.target_map);
    call.set_field("target_map");
    call.set_field("angle", call.push(kInDegrees * report.angle));
    call.set_field("angle_chosen", call.push(report.angle_chosen));
    call.set_field("upright", call.push(report.upright));
    call.set_field("scale", call.push(report.scale));
    push_distortion(call, report.near);
    call.set_field("near");
    push_distortion(call, report.laid);
    call.set_field("laid");
    push_distortion(call, report.feature);
    call.set_field("feature");
    if (report.outline_near) {
        push_distortion(call, *report.outline_near);
        call.set_field("outline_near");
    }
    if (report.clearing) {
        push_clearing(call, *report.clearing);
        call.set_field("clearing");
    }
    call.set_field("kept_outline", call.push(report.kept_outline));
    call.set_field("tight", call.push(report.tight));
    call.set_field("draped", call.push(report.draped));
    call.set_field("joined", call.push(report.joined));
    call.set_field("smooth", call.push(report.smooth));
    call.set_field("draft", call.push(report.draft));
    call.set_field("euler_characteristic", call.push(report.euler_characteristic));
    call.set_field("expected_characteristic", call.push(report.expected_characteristic));
    return 1;
}

int push_paste_draft(const Call& call, const PasteDraft& draft) {
    lua_createtable(call.lua(), 0, 5);
    call.set_field("scale", call.push(draft.scale));
    call.set_field("smooth", call.push(draft.smooth));
    call.set_field("kept_outline", call.push(draft.kept_outline));
    push_distortion(call, draft.near);
    call.set_field("near");
    push_distortion(call, draft.laid);
    call.set_field("laid");
    return 1;
}

std::vector<Record> paste_records() {
    return {
        {"lissom.PasteSearch",
         "Result of the search for the boundary.",
         {{"number[]", "energy", "Energy of the first loop and after each iteration."},
          {"number[]", "misfit",
           "The mean difference of the loop's edges from their images, over their length."},
          {"number|nil", "outline_energy",
           "Measures of the outline of the region, if all of it lies on the target's region."},
          {"number|nil", "outline_misfit", "The same of the misfit."},
          {"number|nil", "smooth_energy",
           "Measures of the boundary free of edges, if one was found that costs no more than "
           "the loop."},
          {"number|nil", "smooth_misfit", "The same of the misfit."},
          {"string", "stop", "converged, iterations or cycle: why it ended."},
          {"boolean", "kept_outline", "Nothing better than the outline was found."},
          {"number", "scale", "Growth of the loop, as a factor."},
          {"integer", "loop_size", "Vertices of the loop."},
          {"integer", "closest_rounds", "Rounds of nearest points that were kept."}}},
        {"lissom.PasteMapQuality",
         "Quality of the map of a surface into the plane.",
         {{"string", "method", "arap, lscm or tutte."},
          {"integer", "faces", "Faces that were laid out."},
          {"integer", "flipped", "Faces that are turned over."},
          {"integer", "flipped_fill", "Number of turned triangles in the hole of the feature."},
          {"integer", "crossings", "Pairs of boundary edges that cross."},
          {"number", "min_scale", "Least factor by which it changes a length."},
          {"number", "max_scale", "The greatest."}}},
        {"lissom.PasteDistortion",
         "Distortion of the part's faces.",
         {{"number", "anisotropy", "95th percentile of greatest over least stretch of a face."},
          {"number", "energy", "Mean squared difference of the stretches from 1, after scaling."},
          {"integer", "faces", "Number of these faces."}}},
        {"lissom.PasteClearing",
         "Part of a target that is removed under a part.",
         {{"integer", "faces", "Number of faces, of the target as it is split there."},
          {"number", "area", "Their area."},
          {"number", "height",
           "How far they stand out of the surface that takes their place, or are sunk in it, at "
           "most."}}},
        {"lissom.PasteDraft",
         "Report of a draft of a paste.",
         {{"number", "scale", "Growth of the part, as a factor."},
          {"boolean", "smooth", "The boundary runs through faces."},
          {"boolean", "kept_outline", "It is the outline, if the surface is distorted less there."},
          {"lissom.PasteDistortion", "near", "Within three rings of the boundary."},
          {"lissom.PasteDistortion", "laid",
           "The same once the part lies on the edge of its hole."}}},
        {"lissom.PasteReport",
         "Report of a paste.",
         {{"lissom.PasteSearch", "search", "Search for the boundary."},
          {"lissom.PasteMapQuality", "source_map", "The map of the ring."},
          {"lissom.PasteMapQuality", "target_map", "The map of the target's region."},
          {"number", "angle", "Angle of the placement, in degrees."},
          {"boolean", "angle_chosen", "It was not given, and is the best of twelve."},
          {"boolean", "upright",
           "Neither `toward` nor an angle was given, and the part's `up` points the same way on "
           "the target, as far as the surface allows."},
          {"number", "scale", "Growth of the part, as a factor."},
          {"lissom.PasteDistortion", "near", "Within three rings of the boundary."},
          {"lissom.PasteDistortion", "laid",
           "The same once the part lies on the target as it was opened."},
          {"lissom.PasteDistortion", "feature", "In the feature."},
          {"lissom.PasteDistortion|nil", "outline_near",
           "Near the outline of the region, were it the boundary."},
          {"lissom.PasteClearing|nil", "clearing",
           "The part of the target removed under the part, if any."},
          {"boolean", "kept_outline",
           "The outline was pasted along, since the surface there is distorted less."},
          {"boolean", "tight",
           "The feature's own outline was pasted along, since more of the target's sharp edges "
           "stays there."},
          {"boolean", "draped",
           "The feature stands on sharp edges of the target: it kept its shape, and its foot was "
           "drawn down to the surface."},
          {"boolean", "joined",
           "The region had several outlines, such as those around a handle's feet: the surface "
           "between them came along with the feature, inside one outline."},
          {"boolean", "smooth", "The boundary runs through faces."},
          {"boolean", "draft", "It is a draft: merged without that option its seam is better."},
          {"integer", "euler_characteristic", "Euler characteristic of the result."},
          {"integer", "expected_characteristic",
           "The one expected from the target and the part."}}}};
}

}  // namespace lissom::lua
