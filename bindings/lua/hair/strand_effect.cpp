// The options that operators on strands share.
#include "bindings/lua/hair/strand_effect.h"

#include <utility>

#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/hair/strands/strand_place.h"
#include "kernel/hair/strands/strand_selection.h"

namespace lissom::lua {
namespace {

// Masks of a region, of a group, of given numbers, or of a function, which was asked before.
std::vector<float> mask_of(const Call& call, std::span<const float> asked) {
    const Strands& strands = strands_of(call);
    const Kind kind = call.kind("mask");
    if (kind == Kind::function) return {asked.begin(), asked.end()};
    std::vector<float> mask;
    if (kind == Kind::numbers) {
        for (const double x : call.numbers("mask")) mask.push_back(static_cast<float>(x));
        return mask;
    }
    mask.assign(at(strands.size()), 0.0f);
    if (kind == Kind::string) {
        const Index group = strands.find_group(call.string("mask"));
        if (group == kNoIndex) {
            throw Error(ErrorCode::out_of_range, std::string("the strands have no group called '") +
                                                     call.string("mask") + "'");
        }
        for (Index s = 0; s < strands.size(); ++s) {
            if (strands.group(s) == group) mask[at(s)] = 1.0f;
        }
        return mask;
    }
    for (const Index s : strands_in_region(call, "mask")) mask[at(s)] = 1.0f;
    return mask;
}

Parameter factor_field() {
    return number("factor", "Part of the effect; 0 changes nothing.").defaults(1.0).between(0, 1);
}

Parameter mask_field() {
    return either("mask",
                  {numbers("mask", "One number for each strand, 0 to 1."),
                   string("mask", "The name of a group: its strands alone."),
                   object("mask", "lissom.Region",
                          "Strands rooted on a face of a region of the head that they grew on."),
                   function("mask",
                            "fun(strand: integer, x: number, y: number, z: number): "
                            "number|boolean",
                            "Asked with the root of each strand.")},
                  "Part of the effect on each strand, 0 to 1.")
        .optional("all strands");
}

}  // namespace

const std::vector<ErrorCode> kOperatorErrors = {ErrorCode::invalid_argument,
                                                ErrorCode::out_of_range, ErrorCode::not_finite,
                                                ErrorCode::memory_limit, ErrorCode::cancelled};

std::vector<Index> strands_in_region(const Call& call, const char* option) {
    const auto region = call.object<RegionObject>(option);
    const Strands& strands = strands_of(call);
    std::vector<Index> list = strands_rooted_in(strands, region->current());
    if (may_be_rooted_on(strands, region->mesh->mesh)) return list;
    throw Error(ErrorCode::invalid_argument,
                "the strands did not grow on the mesh of this region; give a region of their head");
}

std::vector<Parameter> effect_fields(const StrandOperatorOptions& d, bool lengths) {
    std::vector<Parameter> fields = {
        factor_field(), mask_field(),
        either("shape",
               {number("shape",
                       "The effect grows with this power of the place along the strand, 0 "
                       "at the root and 1 at the tip; 0 is the same everywhere.")
                    .at_least(0),
                numbers("shape",
                        "Parts of the effect, 0 to 1, at equal steps from the root to the "
                        "tip.")},
               "Course of the effect along the strand.")
            .optional(d.profile.empty() ? (d.shape == 0.0 ? "0" : "0.7") : "from 0 to 1")};
    if (d.profile.empty() && d.shape == 1.0) fields.back() = fields.back().optional("1");
    if (lengths) {
        fields.push_back(
            boolean("keep_length", "Segments keep their lengths.").defaults(d.keep_length));
    }
    fields.push_back(
        integer("seed", "Another seed gives another result of the same kind.").defaults(1));
    return fields;
}

std::vector<Parameter> part_fields() {
    return {factor_field(), mask_field()};
}

std::vector<Parameter> with_fields(std::vector<Parameter> own, std::vector<Parameter> more) {
    for (Parameter& field : more) own.push_back(std::move(field));
    return own;
}

std::span<const float> ask_mask(Call& call) {
    return ask_roots(call, "mask");
}

std::span<const float> ask_roots(Call& call, const char* option) {
    if (!call.has(option) || call.kind(option) != Kind::function) return {};
    lua_State* L = call.lua();
    const auto self = call.self<StrandsObject>();
    const Index count = self->strands.size();
    auto* answers = call.scratch<float>(at(count) + 1);
    for (Index s = 0; s < count; ++s) {
        if (!self.get() || self->strands.size() != count) {
            call.reject(option, "the function must not change or close the strands");
        }
        lua_pushvalue(L, call.stack_index(option));
        call.push_id(s);
        call.push_coordinates(self->strands.root(s).cast<double>());
        lua_call(L, 4, 1);
        answers[s] = lua_type(L, -1) == LUA_TNUMBER ? static_cast<float>(lua_tonumber(L, -1))
                                                    : static_cast<float>(lua_toboolean(L, -1));
        lua_pop(L, 1);
    }
    if (!self.get() || self->strands.size() != count) {
        call.reject(option, "the function must not change or close the strands");
    }
    return {answers, at(count)};
}

void read_part(const Call& call, std::span<const float> asked, StrandOperatorOptions& options) {
    options.factor = call.number("factor");
    if (call.has("mask")) options.mask = mask_of(call, asked);
}

void read_effect(const Call& call, std::span<const float> asked, StrandOperatorOptions& options,
                 bool lengths) {
    read_part(call, asked, options);
    options.seed = static_cast<std::uint64_t>(call.integer("seed"));
    if (lengths) options.keep_length = call.boolean("keep_length");
    if (!call.has("shape")) return;
    options.profile.clear();
    if (call.kind("shape") == Kind::number) {
        options.shape = call.number("shape");
    } else {
        const auto numbers = call.numbers("shape");
        options.profile.assign(numbers.begin(), numbers.end());
    }
}

}  // namespace lissom::lua
