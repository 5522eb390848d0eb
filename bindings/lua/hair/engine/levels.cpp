// strands:shell and strands:silhouette_error: the coarsest level of hair, and the measure of all.
#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/hair/engine/cards_object.h"
#include "bindings/lua/hair/engine/strand_check.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strand_effect.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/hair/levels/hair_shell.h"
#include "kernel/hair/levels/hair_silhouette.h"
#include "kernel/mesh/edit/transform.h"

namespace lissom::lua {
namespace {

int make_hair_shell(Call& call) {
    return new_mesh(call, [&] {
        ShellOptions options;
        options.triangles = call.integer("triangles");
        options.cell = call.number("cell");
        options.level = call.number("level");
        options.clearance = call.number("clearance");
        double unit = 1.0;
        if (call.has("style")) {
            const Hairstyle& style = call.object<HairstyleObject>("style")->style();
            options.distance = distance_to_head(style);
            unit = style.scalp().unit();
        }
        Mesh mesh = make_shell(strands_of(call), options, call.context());
        if (unit != 1.0) transform(mesh, scaling(Vec3::Constant(1.0 / unit), Vec3::Zero()));
        return mesh;
    });
}

// Inside Call::attempt only.
SilhouetteError silhouette_error_of(const Call& call, const HairSilhouette& all) {
    if (call.has("strands")) {
        return all.compare(call.object<StrandsObject>("strands")->strands, call.number("widen"),
                           call.context());
    }
    if (call.has("cards")) {
        const auto cards = call.object<CardsObject>("cards");
        return all.compare(cards->cards, cards->strands, call.context());
    }
    Mesh mesh = call.object<MeshObject>("mesh")->mesh;
    const double unit = call.number("unit");
    if (unit != 1.0) transform(mesh, scaling(Vec3::Constant(unit), Vec3::Zero()));
    return all.compare(mesh, call.context());
}

int measure_silhouette(Call& call) {
    auto& error = call.hold<SilhouetteError>();
    const bool done = call.attempt([&] {
        const int given = (call.has("strands") ? 1 : 0) + (call.has("cards") ? 1 : 0) +
                          (call.has("mesh") ? 1 : 0);
        require(given == 1, "give one level: strands, cards or mesh");
        SilhouetteOptions options;
        options.views = call.integer("views");
        options.pixel = call.number("pixel");
        const HairSilhouette all(strands_of(call), options, call.context());
        error = silhouette_error_of(call, all);
    });
    if (!done) return call.fail();
    return push_silhouette(call, error);
}

Function shell_method() {
    const ShellOptions d;
    return {
        .name = "shell",
        .body = make_hair_shell,
        .summary =
            "Makes one surface around the hair, its coarsest level of detail, with the "
            "attributes \"normal\" and, if the strands have colours, \"color\", darker where less "
            "light arrives. Strands apart from the others are outside of it.",
        .options =
            {integer("triangles", "Triangles wanted.")
                 .defaults(d.triangles)
                 .between(20, kMaxShellTriangles),
             meters("cell",
                    "Distance of the places at which the density of hair is "
                    "measured; smaller details vanish.")
                 .defaults(d.cell)
                 .between(0.001, 0.1),
             number("level",
                    "The shell runs where hair is this part, below 1, as dense as most of it is.")
                 .defaults(d.level)
                 .above(0)
                 .between(0, 1),
             meters("clearance", "Least distance from the head of `style`.")
                 .defaults(d.clearance)
                 .at_least(0),
             object("style", "lissom.Hairstyle",
                    "A style on the head of the strands: there is no surface below "
                    "hair on the skin, and the mesh is in the unit of the head.")
                 .optional("none: the surface is closed, in metres")},
        .results = {{"lissom.Mesh", "mesh", "The surface."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite, ErrorCode::memory_limit,
                   ErrorCode::cancelled},
        .example = kLock +
                   "local shell = hair:shell{ triangles = 200 }\n"
                   "assert(shell:is_closed() and shell:face_count() <= 210)"};
}

Function silhouette_method() {
    const SilhouetteOptions d;
    return {
        .name = "silhouette_error",
        .body = measure_silhouette,
        .summary =
            "Compares the silhouette of a level of detail with that of the hair, from all "
            "sides: the part of the hair's silhouette that only one of the two covers.",
        .options =
            {object("strands", "lissom.Strands", "A level of fewer strands or points.")
                 .optional("none"),
             number("widen", "Factor of the widths of `strands`.").defaults(1.0).above(0),
             object("cards", "lissom.Cards", "A level of cards, with the strands drawn on them.")
                 .optional("none"),
             object("mesh", "lissom.Mesh", "A level that is a surface, as `strands:shell` makes.")
                 .optional("none"),
             number("unit", "Length of a unit of `mesh`.").defaults(1.0).above(0).in("metres"),
             integer("views",
                     "Directions around the hair, and as many again from 30 degrees above.")
                 .defaults(d.views)
                 .between(1, 64),
             meters("pixel", "Size of a pixel.").defaults(d.pixel).between(0.0005, 0.1)},
        .results = {{"lissom.SilhouetteError", "error", "0 for equal silhouettes."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite, ErrorCode::memory_limit,
                   ErrorCode::cancelled},
        .example = kLock +
                   "hair:set_widths{ width = 0.001 }\n"
                   "local few = hair:copy():resample{ count = 3 }\n"
                   "assert(hair:silhouette_error{ strands = few }.mean < 0.01)"};
}

}  // namespace

int push_silhouette(const Call& call, const SilhouetteError& error) {
    lua_createtable(call.lua(), 0, 2);
    call.set_field("mean", call.push(error.mean));
    call.set_field("worst", call.push(error.worst));
    return 1;
}

std::vector<Function> strand_level_methods() {
    return {shell_method(), silhouette_method(), hair_levels_method()};
}

std::vector<Record> strand_level_records() {
    std::vector<Record> records = hair_level_records();
    records.push_back(
        {"lissom.SilhouetteError",
         "Difference of silhouettes, as a part of the silhouette of all hair.",
         {{"number", "mean", "Over all views."}, {"number", "worst", "In one view."}}});
    return records;
}

}  // namespace lissom::lua
