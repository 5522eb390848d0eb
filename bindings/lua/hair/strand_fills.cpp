// lissom.Strands: more hair of little, and the roots of given hair.
#include <memory>
#include <utility>

#include "bindings/lua/hair/strand_effect.h"
#include "kernel/hair/operators/strand_attach.h"
#include "kernel/hair/operators/strand_fill.h"
#include "kernel/hair/scalp/roots.h"

namespace lissom::lua {
namespace {

// The roots of new hair, in metres of strands.
std::vector<Root> new_roots(const Call& call, const HairstyleObject& style) {
    const Scalp& scalp = style.content->scalp();
    RootOptions options;
    options.count = call.integer("count");
    options.seed = static_cast<std::uint64_t>(call.integer("seed"));
    std::vector<Root> roots = make_roots(style.head->mesh, scalp, options, call.context());
    for (Root& root : roots) root.position *= scalp.unit();
    return roots;
}

int interpolate_strands(Call& call) {
    const auto style = call.object<HairstyleObject>("style");
    const auto result = call.create<StrandsObject>();
    const bool done = call.attempt([&] {
        const std::shared_ptr<const Scalp> scalp = style->style().shared_scalp();
        InterpolateOptions options;
        options.near = call.integer("near");
        options.apart = call.number("apart") * kDegree;
        options.points = call.integer("points");
        auto made = std::make_shared<StrandsObject>(
            interpolate(strands_of(call), new_roots(call, *style.get()), options, call.context()));
        made->grown_on = scalp;
        result.set(std::move(made));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int duplicate_strands(Call& call) {
    DuplicateOptions options;
    options.copies = call.integer("copies");
    options.radius = call.number("radius");
    options.tip = call.number("tip");
    options.seed = static_cast<std::uint64_t>(call.integer("seed"));
    return change_strands(call, [&](Strands& s) { duplicate(s, options, call.context()); });
}

int blend_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        BlendOptions options;
        read_effect(call, asked, options);
        options.guides = call.integer("guides");
        options.near = call.integer("near");
        blend(strands, options, call.context());
    });
}

int attach_strands(Call& call) {
    const auto self = call.self<StrandsObject>();
    const auto style = call.object<HairstyleObject>("head");
    return change_strands(call, [&](Strands& strands) {
        attach(strands, style->head->mesh, style->style().scalp(), {call.boolean("snap")},
               call.context());
        self->grown_on = style->style().shared_scalp();
    });
}

Parameter near_field() {
    return integer("near", "Number of guides around a root that a strand is between.")
        .defaults(index_of(InterpolateOptions{}.near))
        .at_least(1);
}

Function interpolate_method() {
    const InterpolateOptions d;
    return {
        .name = "interpolate",
        .body = interpolate_strands,
        .summary =
            "Grows hair between these strands as guides: each new strand is the mean of the "
            "nearest, from a root of its own on the scalp.",
        .options =
            {object("style", "lissom.Hairstyle", "A style on the head of the guides."),
             integer("count", "Number of new strands.").defaults(20000).at_least(0), near_field(),
             number("apart",
                    "Guides that are combed to another side than the nearest, by more than "
                    "this angle, do not count, as at a parting.")
                 .in("degrees")
                 .defaults(75)
                 .above(0)
                 .between(0, 180),
             integer("points", "Points of each strand.").defaults(index_of(d.points)).at_least(2),
             integer("seed", "Another seed gives other roots.").defaults(1).at_least(0)},
        .results = {{"lissom.Strands", "strands", "The new strands."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::region_empty,
                   ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = kStyle +
                   "local guides = style:grow{ count = 40, length = 0.1 }\n"
                   "assert(#guides:interpolate{ style = style, count = 500 } == 500)"};
}

Function duplicate_method() {
    const DuplicateOptions d;
    return {
        .name = "duplicate",
        .body = duplicate_strands,
        .summary = "Adds copies beside each strand, behind all others.",
        .options =
            {integer("copies", "Copies of each strand.").defaults(index_of(d.copies)).at_least(0),
             meters("radius", "Their roots lie so far from the strand at most.")
                 .defaults(d.radius)
                 .at_least(0),
             number("tip", "Factor of that distance at the tip: 0 brings them to one point.")
                 .defaults(d.tip)
                 .at_least(0),
             integer("seed", "Another seed gives other places.").defaults(1)},
        .results = kSelfStrands,
        .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = kTwoStrands + "assert(#hair:duplicate{ copies = 3 } == 8)"};
}

Function blend_method() {
    const BlendOptions d;
    return {.name = "blend",
            .body = blend_strands,
            .summary =
                "Moves strands towards the mean of the guides around them, so that "
                "neighbours become alike.",
            .options =
                with_fields({integer("guides", "Number of guides: the strands of the lowest ids.")
                                 .defaults(index_of(d.guides))
                                 .at_least(1),
                             near_field()},
                            effect_fields(d)),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:blend{ guides = 1, factor = 0.5 }"};
}

Function attach_method() {
    return {.name = "attach",
            .body = attach_strands,
            .summary =
                "Roots strands at the nearest places of a head, as hair that was drawn or "
                "loaded: they get faces and texture coordinates.",
            .options = {object("head", "lissom.Hairstyle", "A style on the head."),
                        boolean("snap", "Moves each strand so that its root lies on the surface.")
                            .defaults(AttachOptions{}.snap)},
            .results = kSelfStrands,
            .errors = {ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = kStyle +
                       "local hair = lissom.strands{ points = { { 0, 1, 0 }, { 0, 1.1, 0 } }, "
                       "counts = { 2 } }\n"
                       "assert(hair:attach{ head = style }:root(1).face)"};
}

}  // namespace

std::vector<Function> strand_fill_methods() {
    return {interpolate_method(), duplicate_method(), blend_method(), attach_method()};
}

}  // namespace lissom::lua
