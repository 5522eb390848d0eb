// strands:check: faults of hair that engines do not take, with the calls that mend them.
#include "kernel/hair/strands/strand_check.h"

#include <algorithm>
#include <iterator>

#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/hair/engine/cards_object.h"
#include "bindings/lua/hair/engine/strand_check.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strand_effect.h"
#include "bindings/lua/hair/strands_methods.h"

namespace lissom::lua {
namespace {

struct FaultText {
    StrandFault fault;
    const char* code;
    const char* remedy;
};

constexpr FaultText kFaults[] = {
    {StrandFault::not_finite, "not_finite", "hair:select{ strands = } with the others"},
    {StrandFault::no_length, "no_length", "hair:select{ strands = } with the others"},
    {StrandFault::few_points, "few_points", "hair:resample{ count = }"},
    {StrandFault::many_points, "many_points", "hair:resample{ count = }"},
    {StrandFault::large_group, "large_group", "hair:select{ first = }"},
    {StrandFault::no_widths, "no_widths", "hair:set_widths{ width = 75e-6 }"},
    {StrandFault::no_root_uvs, "no_root_uvs",
     "head:parameterize{}, then grow again or hair:attach{ head = style }"},
    {StrandFault::off_head, "off_head", "hair:attach{ head = style }"},
    {StrandFault::inside_head, "inside_head", "hair:push_out{ head = style }"},
    {StrandFault::duplicate_roots, "duplicate_roots", "hair:select{ strands = } with the others"},
    {StrandFault::wrong_unit, "wrong_unit", "hair:transform{ scale = }"},
    {StrandFault::wrong_axis, "wrong_axis",
     "hair:transform{ rotate = }; { axis = \"x\", angle = -90 } turns z up"},
    {StrandFault::lost_guide, "lost_guide", "hair:guides{ count = }"},
    {StrandFault::short_guide, "short_guide", "hair:guides{ count = }"},
    {StrandFault::many_triangles, "many_triangles", "hair:cards{ triangles = }"},
};

const FaultText& text_of(StrandFault fault) {
    return *std::find_if(std::begin(kFaults), std::end(kFaults),
                         [&](const FaultText& text) { return text.fault == fault; });
}

void push_finding(Call& call, const StrandCheckFinding& finding) {
    const FaultText& text = text_of(finding.fault);
    lua_createtable(call.lua(), 0, 6);
    call.set_field("code", call.push(std::string_view(text.code)));
    call.set_field("severity",
                   call.push(std::string_view(finding.is_warning ? "warning" : "error")));
    call.set_field("count", call.push(finding.count));
    call.set_field("strands", call.push_ids(finding.strands));
    call.set_field("message", call.push(std::string_view(finding.message)));
    call.set_field("remedy", call.push(std::string_view(text.remedy)));
}

int check(Call& call) {
    const bool on_head = call.has("head"), has_cards = call.has("cards");
    auto& findings = call.hold<std::vector<StrandCheckFinding>>();
    const bool done = call.attempt([&] {
        StrandCheckOptions options;
        options.target = call.choice<StrandTarget>("target");
        options.root_distance = call.number("root_distance");
        options.depth = call.number("depth");
        if (on_head) {
            options.distance = distance_to_head(call.object<HairstyleObject>("head")->style());
        }
        if (has_cards) {
            options.triangles = call.object<CardsObject>("cards")->mesh.face_count();
        }
        findings = check_strands(strands_of(call), options, call.context());
    });
    if (!done) return call.fail();
    bool ok = true;
    lua_createtable(call.lua(), 0, 2);
    lua_createtable(call.lua(), count_of(findings), 0);
    for (Index i = 0; i < count_of(findings); ++i) {
        push_finding(call, findings[at(i)]);
        lua_rawseti(call.lua(), -2, i + 1);
        ok = ok && findings[at(i)].is_warning;
    }
    lua_setfield(call.lua(), -2, "findings");
    call.set_field("ok", call.push(ok));
    return 1;
}

}  // namespace

Function strand_check_method() {
    const StrandCheckOptions d;
    return {.name = "check",
            .body = check,
            .summary =
                "Searches for faults that an engine stumbles over: broken, short or doubled "
                "strands, widths, root UVs, roots off the head, unit and up axis, guides that do "
                "not reach, limits of points, groups and cards. Each has a remedy.",
            .options =
                {choice("target", {"unreal", "unity", "godot", "film"},
                        "Receiver of the hair, whose limits count.")
                     .defaults("unreal"),
                 object("head", "lissom.Hairstyle", "A style on the head of the strands.")
                     .optional("none: roots and depth are not checked"),
                 object("cards", "lissom.Cards", "Cards that stand for the hair.").optional("none"),
                 meters("root_distance", "Distance from the head that a root may have.")
                     .defaults(d.root_distance)
                     .at_least(0),
                 meters("depth", "Depth that a point may have in the head.")
                     .defaults(d.depth)
                     .at_least(0)},
            .results = {{"lissom.StrandCheck", "check", "The faults found."}},
            .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = kTwoStrands + R"(hair:set_widths{ width = 0 }
local found = hair:check{ target = "unreal" }
assert(not found.ok and found.findings[1].code == "no_widths")
print(found.findings[1].message, found.findings[1].remedy))"};
}

std::vector<Record> strand_check_records() {
    return {{"lissom.StrandCheck",
             "Faults of hair.",
             {{"boolean", "ok", "Whether there are no errors; warnings may remain."},
              {"lissom.StrandFault[]", "findings", "Each kind of fault once."}}},
            {"lissom.StrandFault",
             "One kind of fault.",
             {{"string", "code",
               "not_finite, no_length, few_points, many_points, large_group, no_widths, "
               "no_root_uvs, off_head, inside_head, duplicate_roots, wrong_unit, wrong_axis, "
               "lost_guide, short_guide or many_triangles."},
              {"string", "severity", "\"error\", or \"warning\" if the target takes it."},
              {"integer", "count", "Number of strands, or of triangles for many_triangles."},
              {"integer[]", "strands", "The strands; empty if it is a fault of all hair."},
              {"string", "message", "The fault with its limit."},
              {"string", "remedy", "A call that mends it."}}}};
}

}  // namespace lissom::lua
