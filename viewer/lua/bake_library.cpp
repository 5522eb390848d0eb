// lissom.bake_cards.
#include <memory>
#include <string>

#include "bindings/lua/core/file_path.h"
#include "bindings/lua/hair/engine/cards_object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/io/gltf/textured.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/stream/file.h"
#include "viewer/lua/paint.h"
#include "viewer/lua/png_file.h"
#include "viewer/lua/viewer_library.h"
#include "viewer/render/cards/card_atlas.h"
#include "viewer/render/cards/card_preview.h"
#include "viewer/render/draw/image/color.h"

namespace lissom::lua {
namespace {

CardAtlasOptions read_bake(const Call& call) {
    CardAtlasOptions options;
    options.size = call.integer("size");
    options.cutoff = call.number("cutoff");
    if (call.has("color")) options.style.color = parse_color(call.string("color"));
    const struct {
        const char* name;
        double& value;
    } numbers[] = {{"strand_tone", options.style.strand_tone},
                   {"clump_tone", options.style.clump_tone},
                   {"root_tone", options.style.root_tone},
                   {"tip_tone", options.style.tip_tone}};
    for (const auto& number : numbers) number.value = call.number(number.name);
    return options;
}

void save_one(const Call& call, const char* option, const Image& image) {
    if (!call.has(option)) return;
    save_picture(image, call.file(call.string(option), FileUse::write), call.context());
}

// Inside Call::attempt only.
void save_card_mesh(const Call& call, const CardsObject& cards, const CardAtlas& atlas,
                    double cutoff) {
    Mesh mesh = cards.mesh;
    TexturedMaterial material;
    material.color_png = encode_png(atlas.color);
    material.flow_png = encode_png(atlas.flow);
    material.cutoff = cutoff;
    set_material(mesh, material);
    save_mesh(mesh, call.file(call.string("mesh"), FileUse::write), {}, call.context());
}

int bake_cards(Call& call) {
    const auto preview = call.create<MeshObject>();
    const auto ribbons = call.create<StrandsObject>();
    const auto cap = call.create<MeshObject>();
    const bool done = call.attempt([&] {
        for (const char* option : {"file", "flow", "data"}) {
            if (call.has(option)) require_picture_path(file_path(call.string(option)));
        }
        const auto cards = call.object<CardsObject>("cards");
        const CardAtlasOptions options = read_bake(call);
        const CardAtlas atlas = bake_atlas(cards->cards, cards->strands, options, call.context());
        save_one(call, "file", atlas.color);
        save_one(call, "flow", atlas.flow);
        save_one(call, "data", atlas.data);
        if (call.has("mesh")) save_card_mesh(call, *cards, atlas, options.cutoff);
        CardPreviewOptions drawn;
        drawn.across = call.integer("across");
        drawn.cutoff = options.cutoff;
        preview.set(std::make_shared<MeshObject>(
            card_preview(cards->cards, cards->mesh, atlas, drawn, call.context())));
        ribbons.set(std::make_shared<StrandsObject>(
            card_ribbons(cards->cards, atlas, drawn, call.context())));
        cap.set(std::make_shared<MeshObject>(
            cap_preview(cards->cards, cards->mesh, atlas, drawn, call.context())));
    });
    if (!done) return call.fail();
    call.charge(preview);
    call.charge(ribbons);
    call.charge(cap);
    return 3;
}

}  // namespace

std::vector<Function> bake_functions() {
    const CardAtlasOptions d;
    const auto tone = [](const char* name, const char* help, double usual, double most) {
        return number(name, help).defaults(usual).between(0.0, most);
    };
    return {
        {.name = "bake_cards",
         .body = bake_cards,
         .summary =
             "Bakes the pictures of hair cards, without light: colour with alpha, flow and data, "
             "and saves the cards with them. Needs no display.",
         .options =
             {object("cards", "lissom.Cards", "Cards that strands:cards made."),
              string("file", "The colours as .png; alpha is steep about `cutoff`.")
                  .optional("none"),
              string("flow",
                     "As .png, like a normal map: direction towards the tip across (red) and from "
                     "tip to root (green), height over the card of -5 to 5 mm (blue).")
                  .optional("none"),
              string("data",
                     "As .png: 0 at the root to 1 at the tip (red), a number of the strand "
                     "(green), covered part of the texel (blue).")
                  .optional("none"),
              string("mesh", "The cards as .glb with colours and flow inside.").optional("none"),
              integer("across", "Faces of the preview, and ribbons, across each card.")
                  .defaults(CardPreviewOptions{}.across)
                  .between(2, 256),
              integer("size", "Texels along each side.").defaults(d.size).between(64, 8192),
              number("cutoff", "Alpha below it is not drawn.")
                  .defaults(d.cutoff)
                  .between(0.01, 0.99),
              string("color", "Colour of all strands, instead of their own.")
                  .optional("the strands' own, else a brown"),
              tone("strand_tone", "Random difference of strands' brightness.", d.style.strand_tone,
                   1.0),
              tone("clump_tone", "The same for clumps of strands with neighbouring roots.",
                   d.style.clump_tone, 1.0),
              tone("root_tone", "Factor of the colour at the root.", d.style.root_tone, 10.0),
              tone("tip_tone", "Factor of the colour at the tip.", d.style.tip_tone, 10.0)},
         .results = {{"lissom.Mesh", "preview",
                      "The cards without what is clear, as faces of the colours of their parts, "
                      "for renderers without textures such as lissom.render."},
                     {"lissom.Strands", "ribbons",
                      "The cards without the cap and without what is clear, as strands along them "
                      "in the colours of their parts: lissom.render lights them as hair."},
                     {"lissom.Mesh", "cap", "The cap alone, as in `preview`."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::unknown_format,
                    ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local hair = lissom.strands{
    points = { { 0, 0, 0 }, { 0, 0.1, 0 }, { 0, 0.2, 0 }, { 0.01, 0, 0 }, { 0.02, 0.1, 0 } },
    counts = { 3, 2 } }
local path = os.tmpname() .. ".png"
local preview = lissom.bake_cards{ cards = hair:cards{ count = 2 }, file = path, size = 128 }
assert(preview:face_count() > 0)
os.remove(path))"}};
}

}  // namespace lissom::lua
