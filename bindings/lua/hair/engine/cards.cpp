// lissom.Cards: hair as strips of triangles, with the strands that are drawn on them.
#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/hair/engine/cards_object.h"

#include <cstdio>
#include <memory>
#include <string>

#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strand_effect.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/mesh/edit/transform.h"

namespace lissom::lua {
namespace {

CardOptions read_cards(const Call& call) {
    CardOptions options;
    options.count = call.integer("count");
    if (call.has("triangles")) options.triangles = call.integer("triangles");
    options.sections = call.integer("sections");
    options.crossed = call.boolean("crossed");
    options.slots = call.integer("slots");
    options.coverage = call.number("coverage");
    options.bend = call.number("bend");
    options.clearance = call.number("clearance");
    return options;
}

int make_strand_cards(Call& call) {
    const auto result = call.create<CardsObject>();
    const bool on_head = call.has("style");
    if (!on_head && call.has("cap") && call.boolean("cap")) {
        call.reject("cap", "it needs 'style', whose head it lies on");
    }
    const bool done = call.attempt([&] {
        CardOptions options = read_cards(call);
        const Strands& strands = strands_of(call);
        double unit = 1.0;
        if (on_head) {
            const Hairstyle& style = call.object<HairstyleObject>("style")->style();
            options.distance = distance_to_head(style);
            unit = style.scalp().unit();
        }
        HairCards cards = make_cards(strands, options, call.context());
        if (on_head && (!call.has("cap") || call.boolean("cap"))) {
            add_cap(cards, strands, call.object<HairstyleObject>("style")->head->mesh,
                    {.unit = unit}, call.context());
        }
        Mesh mesh = card_mesh(cards, strands, options, call.context());
        if (unit != 1.0) transform(mesh, scaling(Vec3::Constant(1.0 / unit), Vec3::Zero()));
        result.set(std::make_shared<CardsObject>(std::move(cards), strands, std::move(mesh)));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

const CardsObject& cards_of(const Call& call) {
    return *call.self<CardsObject>().get();
}

int cards_size(Call& call) {
    return call.push(count_of(cards_of(call).cards.cards));
}

int cards_text(Call& call) {
    char text[96];
    const CardsObject& cards = cards_of(call);
    const int length = std::snprintf(text, sizeof text, "lissom.Cards: %d cards, %d slots",
                                     count_of(cards.cards.cards), count_of(cards.cards.slots));
    return call.push(std::string_view(text, at(length)));
}

int cards_mesh(Call& call) {
    return new_mesh(call, [&] { return cards_of(call).mesh; });
}

int cards_stats(Call& call) {
    const CardsObject& cards = cards_of(call);
    lua_createtable(call.lua(), 0, 5);
    call.set_field("cards", call.push(count_of(cards.cards.cards)));
    call.set_field("slots", call.push(count_of(cards.cards.slots)));
    call.set_field("triangles", call.push(cards.mesh.face_count()));
    call.set_field("covered", call.push(cards.cards.covered));
    call.set_field("rms", call.push(cards.cards.rms));
    return 1;
}

const std::string kCards = kTwoStrands + "local cards = hair:cards{ count = 2, sections = 3 }\n";

std::vector<Function> cards_methods() {
    return {{.name = "mesh",
             .body = cards_mesh,
             .summary =
                 "The triangles: a copy, in the unit of the head of `style`, else in metres. It "
                 "has \"uv\", \"normal\", \"tangent\" towards the tip, \"color\" (light from all "
                 "around, and alpha that ends the cap), \"color2\" (the same light, 0 at the root "
                 "to 1 at the tip, a number of the card) and the material \"hair\".",
             .results = {{"lissom.Mesh", "mesh", "The mesh."}},
             .errors = {ErrorCode::memory_limit},
             .example = kCards + "assert(cards:mesh():face_count() == 8)"},
            {.name = "stats",
             .body = cards_stats,
             .summary = "Counts, and how well the strands lie on their cards.",
             .results = {{"lissom.CardStats", "stats", "The measures."}},
             .example = kCards + "assert(cards:stats().cards == 2)"}};
}

}  // namespace

Function cards_method() {
    const CardOptions d;
    return {
        .name = "cards",
        .body = make_strand_cards,
        .summary =
            "Makes cards: strips of triangles along clusters of strands, as games draw hair. "
            "`lissom.bake_cards` makes their pictures.",
        .options =
            {integer("count", "Number of cards.").defaults(d.count).between(1, kMaxCards),
             integer("triangles", "Triangles of all cards, instead of `sections`.")
                 .at_least(2)
                 .optional("as sections say"),
             integer("sections", "Points along each card.").defaults(d.sections).between(2, 64),
             boolean("crossed",
                     "Clusters about as thick as wide, such as ringlets, have two cards that "
                     "cross, and there are fewer clusters.")
                 .defaults(d.crossed),
             integer("slots", "Pictures in the atlas, which cards that are alike share.")
                 .defaults(d.slots)
                 .between(1, 256),
             number("coverage", "Part of the points of its strands that a card is wide enough for.")
                 .defaults(d.coverage)
                 .above(0)
                 .between(0, 1),
             number("bend",
                    "Normals are those of the card at 0, and those of the head below it at 1.")
                 .defaults(d.bend)
                 .between(0, 1),
             meters("clearance", "Least distance of cards from the head of `style`.")
                 .defaults(d.clearance)
                 .at_least(0),
             object("style", "lissom.Hairstyle", "A style on the head of the strands.")
                 .optional("none: cards may go through the head"),
             boolean("cap", "Adds the skin below the hair, a little over it, in its colour.")
                 .optional("true with `style`")},
        .results = {{"lissom.Cards", "cards", "The cards, with a copy of the strands."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite, ErrorCode::memory_limit,
                   ErrorCode::cancelled},
        .example = kTwoStrands + "assert(#hair:cards{ count = 2 } == 2)"};
}

Type cards_type() {
    return {.name = "lissom.Cards",
            .summary = "Strips of triangles that stand for strands, and slots of an atlas.",
            .methods = cards_methods(),
            .operators = {{"__len", cards_size, "#cards", "number of cards"},
                          {"__tostring", cards_text, "tostring(cards)", "counts"}}};
}

std::vector<Record> cards_records() {
    return {{"lissom.CardStats",
             "Measures of cards.",
             {{"integer", "cards", "Number of cards."},
              {"integer", "slots", "Pictures in the atlas, that of the cap among them."},
              {"integer", "triangles", "Number of triangles, those of the cap among them."},
              {"number", "covered", "Part of the strands' points that lie on their cards."},
              {"number", "rms", "Distance of strands from the plane of their card, in metres."}}}};
}

}  // namespace lissom::lua
