// strands:levels: levels of detail of strands, cards and a shell in one call.
#include "kernel/hair/levels/hair_levels.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/engine/cards_object.h"
#include "bindings/lua/hair/engine/strand_check.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strand_effect.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/mesh/edit/transform.h"

namespace lissom::lua {
namespace {

// A level of cards of a script, as plain data.
struct CardLevelSpec {
    int count, triangles, sections;
};

std::span<const StrandLevelOptions> read_strand_levels(Call& call) {
    if (!call.has("strands")) return {};
    const auto count = raw_length(call.lua(), call.stack_index("strands"));
    auto* levels = call.scratch<StrandLevelOptions>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("strands", index_of(i) + 1);
        StrandLevelOptions& level = levels[i] = {};
        if (call.has("strands.count")) level.count = call.integer("strands.count");
        if (call.has("strands.screen_size")) level.screen_size = call.number("strands.screen_size");
        if (call.has("strands.points")) level.points = call.integer("strands.points");
        if (call.has("strands.widen")) level.widen = call.number("strands.widen");
    }
    return {levels, count};
}

std::span<const CardLevelSpec> read_card_levels(Call& call) {
    if (!call.has("cards")) return {};
    const auto count = raw_length(call.lua(), call.stack_index("cards"));
    auto* levels = call.scratch<CardLevelSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("cards", index_of(i) + 1);
        levels[i] = {call.integer("cards.count"),
                     call.has("cards.triangles") ? call.integer("cards.triangles") : 0,
                     call.integer("cards.sections")};
    }
    return {levels, count};
}

// The options that do not depend on the head. Inside Call::attempt only.
HairLevelOptions level_options_of(const Call& call, std::span<const StrandLevelOptions> strands,
                                  std::span<const CardLevelSpec> cards) {
    HairLevelOptions options;
    if (!call.has("strands") && !call.has("cards") && !call.has("shell")) {
        options = usual_hair_levels();
    }
    options.strands.insert(options.strands.end(), strands.begin(), strands.end());
    for (const CardLevelSpec& level : cards) {
        CardOptions made;
        made.count = level.count;
        made.triangles = level.triangles;
        made.sections = level.sections;
        options.cards.push_back(made);
    }
    if (call.has("shell")) {
        options.shell.emplace();
        options.shell->triangles = call.integer("shell.triangles");
        options.shell->cell = call.number("shell.cell");
    }
    for (CardOptions& level : options.cards) level.slots = call.integer("slots");
    options.by_group = call.integer("of") == 1;
    if (call.has("width")) options.width = call.number("width");
    options.silhouette.views = call.integer("views");
    options.silhouette.pixel = call.number("pixel");
    return options;
}

void put_on_head(const Hairstyle& style, const Mesh* head, HairLevelOptions& options) {
    const auto distance = distance_to_head(style);
    for (CardOptions& level : options.cards) level.distance = distance;
    if (options.shell) options.shell->distance = distance;
    options.head = head;
    options.cap.unit = style.scalp().unit();
}

// A level with its objects, which the collector owns once they are pushed.
struct LevelEntry {
    HairLevelKind kind;
    std::string group;
    double widen, screen_size;
    SilhouetteError silhouette;
    std::shared_ptr<StrandsObject> strands;
    std::shared_ptr<CardsObject> cards;
    std::shared_ptr<MeshObject> mesh;
};

LevelEntry entry_of(HairLevel level, const std::vector<std::string>& groups, double unit,
                    const std::shared_ptr<const Scalp>& grown_on) {
    LevelEntry entry{level.kind, {}, level.widen, level.screen_size, level.silhouette, {}, {}, {}};
    if (level.group != kNoIndex) entry.group = groups[at(level.group)];
    if (unit != 1.0) transform(level.mesh, scaling(Vec3::Constant(1.0 / unit), Vec3::Zero()));
    if (level.kind == HairLevelKind::strands) {
        entry.strands = std::make_shared<StrandsObject>(std::move(level.strands));
        entry.strands->grown_on = grown_on;
    } else if (level.kind == HairLevelKind::cards) {
        entry.cards = std::make_shared<CardsObject>(
            std::move(level.cards), std::move(level.strands), std::move(level.mesh));
    } else {
        entry.mesh = std::make_shared<MeshObject>(std::move(level.mesh));
    }
    return entry;
}

template <typename Object>
int push_made(const Call& call, const std::shared_ptr<Object>& object) {
    const auto ref = call.create<Object>();
    ref.set(object);
    // An object that returns its mesh then returns this one.
    if constexpr (std::is_same_v<Object, MeshObject>) call.remember(ref.get());
    call.charge(ref);
    return 1;
}

void push_level(const Call& call, const LevelEntry& level) {
    lua_createtable(call.lua(), 0, 6);
    const char* const kinds[] = {"strands", "cards", "shell"};
    call.set_field("kind", call.push(kinds[static_cast<int>(level.kind)]));
    if (!level.group.empty()) call.set_field("group", call.push(level.group));
    call.set_field("screen_size", call.push(level.screen_size));
    if (level.strands) {
        call.set_field("strands", push_made(call, level.strands));
        call.set_field("widen", call.push(level.widen));
    }
    if (level.cards) call.set_field("cards", push_made(call, level.cards));
    if (level.mesh) call.set_field("mesh", push_made(call, level.mesh));
    call.set_field("silhouette", push_silhouette(call, level.silhouette));
}

int make_levels(Call& call) {
    const auto strands = read_strand_levels(call);
    const auto cards = read_card_levels(call);
    const bool on_head = call.has("style");
    if (!on_head && call.has("cap") && call.boolean("cap")) {
        call.reject("cap", "it needs 'style', whose head it lies on");
    }
    const bool caps = on_head && (!call.has("cap") || call.boolean("cap"));
    auto& entries = call.hold<std::vector<LevelEntry>>();
    const bool done = call.attempt([&] {
        HairLevelOptions options = level_options_of(call, strands, cards);
        double unit = 1.0;
        if (on_head) {
            const auto object = call.object<HairstyleObject>("style");
            const Hairstyle& style = object->style();
            unit = style.scalp().unit();
            put_on_head(style, caps ? &object->head->mesh : nullptr, options);
        }
        const auto self = call.self<StrandsObject>();
        for (HairLevel& level : make_hair_levels(self->strands, options, call.context())) {
            entries.push_back(
                entry_of(std::move(level), self->strands.group_names(), unit, self->grown_on));
        }
    });
    if (!done) return call.fail();
    return push_list(call, entries, [&](const LevelEntry& level) { push_level(call, level); });
}

std::vector<Parameter> strand_level_fields() {
    return {
        integer("count", "Number of strands, at most those of the hair; else give `screen_size`.")
            .at_least(1)
            .optional("as `screen_size` says"),
        number("screen_size",
               "Part of a picture's height that the level is for: so large a part of the "
               "strands is kept.")
            .above(0)
            .between(0, 1)
            .optional("as `count` says"),
        integer("points", "Points of each strand.").between(2, 100'000).optional("they stay"),
        number("widen", "Factor of the widths.")
            .above(0)
            .optional("all strands / kept strands, which keeps the thickness")};
}

std::vector<Parameter> card_level_fields() {
    const CardOptions d;
    return {integer("count", "Number of cards.").defaults(d.count).between(1, kMaxCards),
            integer("triangles", "Triangles of all cards, instead of `sections`.")
                .at_least(2)
                .optional("as sections say"),
            integer("sections", "Points along each card.").defaults(d.sections).between(2, 64)};
}

std::vector<Parameter> shell_level_fields() {
    const ShellOptions d;
    return {integer("triangles", "Triangles wanted.")
                .defaults(d.triangles)
                .between(20, kMaxShellTriangles),
            meters("cell", "Distance of the places at which the density of hair is measured.")
                .defaults(d.cell)
                .between(0.001, 0.1)};
}

std::vector<Parameter> hair_level_options() {
    const HairLevelOptions d;
    return {
        option_list("strands", strand_level_fields(),
                    "Up to eight levels of strands, finest first.")
            .optional("none; with neither strands, cards nor shell: three of each, and a shell"),
        option_list("cards", card_level_fields(), "Up to eight levels of cards, finest first.")
            .optional("none"),
        options("shell", shell_level_fields(), "The last level, one surface; {} for the defaults.")
            .optional("none"),
        choice(
            "of", {"all", "groups"},
            "Levels of all hair, or of each group, which then has its part of each count; groups "
            "that cover no pixel have none.")
            .defaults("all"),
        integer("slots", "Pictures in the atlas of each level of cards.")
            .defaults(CardOptions{}.slots)
            .between(1, 256),
        object("style", "lissom.Hairstyle",
               "A style on the head of the strands: cards and shell stay out of it, and are in the "
               "unit of the head.")
            .optional("none: cards may go through the head, and the shell is closed"),
        boolean("cap", "Adds the skin below the hair to cards, in its colour.")
            .optional("true with `style`"),
        meters("width",
               "Diameter that stands for full hair in silhouettes and on cards: a few thousand "
               "strands of a natural one leave holes.")
            .above(0)
            .optional("their own"),
        integer("views", "Directions around the hair, and as many again from 30 degrees above.")
            .defaults(d.silhouette.views)
            .between(1, 64),
        meters("pixel", "Size of a pixel of silhouettes.")
            .defaults(d.silhouette.pixel)
            .between(0.0005, 0.1)};
}

}  // namespace

Function hair_levels_method() {
    return {
        .name = "levels",
        .body = make_levels,
        .summary =
            "Makes levels of detail, finest first: fewer and wider strands, then cards, then a "
            "shell. Each tells the error of its silhouette, and up to what part of a picture's "
            "height it suffices. Strands of a level are those of the first n, for every n, spread "
            "over the head.",
        .options = hair_level_options(),
        .results = {{"lissom.HairLevel[]", "levels", "The levels, group by group."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite, ErrorCode::memory_limit,
                   ErrorCode::cancelled},
        .example = kLock +
                   "local levels = hair:levels{ width = 0.001, cards = { { count = 10 } },\n"
                   "    strands = { { count = 200 }, { screen_size = 0.5, points = 4 } } }\n"
                   "assert(#levels[2].strands == 100 and levels[3].kind == \"cards\")"};
}

std::vector<Record> hair_level_records() {
    return {
        {"lissom.HairLevel",
         "A level of detail.",
         {{"string", "kind", "\"strands\", \"cards\" or \"shell\"."},
          {"string|nil", "group", "The group whose level it is."},
          {"number", "screen_size", "Part of a picture's height up to which it suffices."},
          {"lissom.SilhouetteError", "silhouette", "Its difference from all hair, from all sides."},
          {"lissom.Strands|nil", "strands", "The strands, as wide as they cover the head."},
          {"number|nil", "widen", "The factor by which they are wider."},
          {"lissom.Cards|nil", "cards", "The cards."},
          {"lissom.Mesh|nil", "mesh", "The shell."}}}};
}

}  // namespace lissom::lua
