// lissom.render.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "bindings/lua/core/file_path.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/buffer.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/path_object.h"
#include "bindings/lua/scene/scene_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "kernel/hair/strands/strand_place.h"
#include "kernel/io/stream/file.h"
#include "viewer/lua/paint.h"
#include "viewer/lua/png_file.h"
#include "viewer/lua/viewer_library.h"
#include "viewer/render/draw/region_colors.h"
#include "viewer/render/draw/scene_drawing.h"
#include "viewer/render/draw/style_marks.h"

namespace lissom::lua {
namespace {

// ---- The renderer of a Lua state: made by its first picture, ended with the state.

using RendererSlot = std::unique_ptr<Renderer>;
// Keys of Lua's registry: the held value, and its address.
const char kHeldKey = 0, kRendererKey = 0;

RendererSlot& renderer_slot(const Call& call) {
    lua_State* L = call.lua();
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kRendererKey);
    if (void* known = lua_touserdata(L, -1)) return *static_cast<RendererSlot*>(known);
    lua_pop(L, 1);
    auto& slot = call.hold<RendererSlot>();
    lua_pushvalue(L, -1);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kHeldKey);
    lua_pushlightuserdata(L, &slot);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kRendererKey);
    return slot;
}

// ---- Who sees pictures beside their files

const char kListenerKey = 0;

const PictureListener* picture_listener(lua_State* L) {
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kListenerKey);
    const auto* listener = static_cast<const PictureListener*>(lua_touserdata(L, -1));
    lua_pop(L, 1);
    return listener;
}

// ---- The script's options. All of these run inside `attempt`.

void require_count(std::size_t given, std::size_t meshes, const char* what) {
    if (given == meshes) return;
    throw Error(ErrorCode::invalid_argument, std::to_string(given) + " " + what +
                                                 " were given for " + std::to_string(meshes) +
                                                 " meshes; give one for each");
}

double line_width(const Call& call) {
    return call.has("line_width") ? call.number("line_width") : MeshStyle{}.line_width;
}

MeshStyle read_style(const Call& call) {
    MeshStyle style;
    style.vertex_colors = call.boolean("vertex_colors");
    style.shading = call.choice<Shading>("shading");
    if (call.has("crease")) style.crease = call.number("crease") * kDegree;
    style.wire = call.boolean("wire");
    if (call.has("wire_width")) style.wire_width = call.number("wire_width");
    style.boundaries = call.boolean("boundaries");
    style.line_width = line_width(call);
    return style;
}

// Shares the mesh with the script, which does nothing else while its picture is drawn.
std::shared_ptr<const Mesh> mesh_of(const std::shared_ptr<MeshObject>& object) {
    return {object, &object->mesh};
}

// A style without a mesh or strands is drawn on its head.
void add_meshes(const Call& call, Picture& picture) {
    const MeshStyle style = read_style(call);
    if (call.has("style") && !call.has("mesh") && !call.has("meshes") && !call.has("strands")) {
        picture.meshes.push_back({mesh_of(call.object<HairstyleObject>("style")->head), style});
    }
    if (!call.has("mesh") && !call.has("meshes")) return;
    if (call.has("mesh")) {
        picture.meshes.push_back({mesh_of(call.object<MeshObject>("mesh").share()), style});
        return;
    }
    for (std::size_t i = 0; i < call.object_count("meshes"); ++i) {
        picture.meshes.push_back({mesh_of(call.object_at<MeshObject>("meshes", i).share()), style});
    }
}

void add_scene(const Call& call, Picture& picture) {
    if (!call.has("scene")) return;
    SceneDrawing drawing = drawing_of(call.object<SceneObject>("scene")->scene.objects());
    picture.meshes = std::move(drawing.meshes);
    for (DrawnStrands& strands : drawing.strands) {
        picture.strands.push_back({std::move(strands), std::nullopt});
    }
    picture.marks.lines = std::move(drawing.lines);
    picture.marks.points = std::move(drawing.points);
    require(!picture.meshes.empty() || !picture.strands.empty() || !picture.marks.lines.empty() ||
                !picture.marks.points.empty(),
            "the scene shows nothing; add objects, or make some visible", ErrorCode::mesh_empty);
}

// ---- Strands

HairLobe read_lobe(const Call& call, HairLobe lobe, const char* strength, const char* exponent,
                   const char* shift) {
    if (call.has(strength)) lobe.strength = call.number(strength);
    if (call.has(exponent)) lobe.exponent = call.number(exponent);
    if (call.has(shift)) lobe.shift = call.number(shift) * kDegree;
    return lobe;
}

StrandStyle read_hair(const Call& call) {
    StrandStyle style;
    if (!call.has("hair")) return style;
    if (call.has("hair.color")) style.color = parse_color(call.string("hair.color"));
    if (call.has("hair.level")) style.level = call.number("hair.level");
    if (call.has("hair.count")) style.count = call.integer("hair.count");
    style.primary = read_lobe(call, style.primary, "hair.primary", "hair.primary_exponent",
                              "hair.primary_shift");
    style.secondary = read_lobe(call, style.secondary, "hair.secondary", "hair.secondary_exponent",
                                "hair.secondary_shift");
    if (call.has("hair.shift_jitter")) {
        style.shift_jitter = call.number("hair.shift_jitter") * kDegree;
    }
    const struct {
        const char* name;
        double& value;
    } numbers[] = {{"hair.strand_tone", style.strand_tone}, {"hair.clump_tone", style.clump_tone},
                   {"hair.clump_size", style.clump_size},   {"hair.root_tone", style.root_tone},
                   {"hair.tip_tone", style.tip_tone},       {"hair.shadow", style.shadow},
                   {"hair.scalp_tint", style.scalp_tint}};
    for (const auto& number : numbers) {
        if (call.has(number.name)) number.value = call.number(number.name);
    }
    return style;
}

// Several strands and several meshes: one for each. Else the strands grow on the only mesh, or the
// only strands on the first.
PictureStrands placed_strands(const Call& call, const Ref<StrandsObject>& object,
                              std::size_t number, const StrandStyle& style,
                              const Picture& picture) {
    const Strands& strands = object->strands;
    PictureStrands result{{{object.share(), &strands}, style, {}}, std::nullopt};
    const std::vector<DrawnMesh>& meshes = picture.meshes;
    if (meshes.empty()) return result;
    const std::size_t mesh = meshes.size() == 1 ? 0 : number;
    if (meshes.size() == 1 || call.kind("strands") == Kind::objects) result.mesh = mesh;
    result.drawn.transform = meshes[mesh].transform;
    if (call.has("hair.unit")) {
        result.drawn.style.unit = call.number("hair.unit");
    } else if (const auto unit = unit_of_roots(strands, *meshes[mesh].mesh)) {
        result.drawn.style.unit = *unit;
    } else {
        const std::string doubt =
            doubt_about_unit(strands, *meshes[mesh].mesh, result.drawn.style.unit);
        if (!doubt.empty()) call.context().log(LogLevel::warning, doubt);
    }
    return result;
}

void add_strands(const Call& call, Picture& picture) {
    if (!call.has("strands")) return;
    const StrandStyle style = read_hair(call);
    if (call.kind("strands") == Kind::object) {
        const auto strands = call.object<StrandsObject>("strands");
        picture.strands.push_back(placed_strands(call, strands, 0, style, picture));
        return;
    }
    const std::size_t count = call.object_count("strands");
    if (picture.meshes.size() > 1) require_count(count, picture.meshes.size(), "strands");
    for (std::size_t i = 0; i < count; ++i) {
        const auto strands = call.object_at<StrandsObject>("strands", i);
        picture.strands.push_back(placed_strands(call, strands, i, style, picture));
    }
}

void color_meshes(const Call& call, Picture& picture) {
    if (!call.has("color")) return;
    if (call.kind("color") == Kind::string) {
        for (DrawnMesh& drawn : picture.meshes) paint_mesh(drawn.style, call.string("color"));
        return;
    }
    const auto colors = call.strings("color");
    require_count(colors.size(), picture.meshes.size(), "colours");
    for (std::size_t i = 0; i < colors.size(); ++i) {
        paint_mesh(picture.meshes[i].style, colors[i]);
    }
}

void move_meshes(const Call& call, Picture& picture) {
    if (!call.has("offsets")) return;
    const auto offsets = call.points("offsets");
    require_count(offsets.size(), picture.meshes.size(), "offsets");
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        picture.meshes[i].transform = translation(offsets[i]);
    }
}

void paint_regions(const Call& call, Picture& picture) {
    if (!call.has("region")) return;
    if (call.kind("region") == Kind::string) return paint_region(picture, call.string("region"));
    paint_region(picture, call.object<RegionObject>("region")->current());
}

// The named regions in colours of their own, with a legend.
void paint_all_regions(const Call& call, Picture& picture) {
    if (!call.has("regions")) return;
    std::vector<std::string> names;
    if (call.kind("regions") == Kind::strings) {
        for (const char* name : call.strings("regions")) {
            require_region(picture, name);
            names.emplace_back(name);
        }
        if (names.empty()) return;
    } else if (!call.boolean("regions")) {
        return;
    }
    picture.legend_parts = color_regions(picture.meshes, names);
    picture.legend_label = "regions";
}

void paint_handles(const Call& call, Picture& picture) {
    if (!call.has("handles")) return;
    if (call.kind("handles") == Kind::strings) {
        for (const char* name : call.strings("handles")) paint_handle(picture, name);
        return;
    }
    for (std::size_t i = 0; i < call.object_count("handles"); ++i) {
        paint_handle(picture, call.object_at<RegionObject>("handles", i)->current());
    }
}

void paint_scalars(const Call& call, Picture& picture) {
    if (!call.has("scalars")) return;
    switch (call.kind("scalars")) {
        case Kind::string:
            return paint_values(picture, call.string("scalars"));
        case Kind::object: {
            const auto values = call.object<BufferObject>("scalars")->numbers();
            return paint_values(picture, std::vector<double>(values.begin(), values.end()));
        }
        default: {
            const auto values = call.numbers("scalars");
            return paint_values(picture, std::vector<double>(values.begin(), values.end()));
        }
    }
}

void read_scale(const Call& call, Picture& picture) {
    if (call.has("legend")) picture.legend = call.boolean("legend");
    if (call.has("label")) picture.legend_label = call.string("label");
    if (!call.has("range")) return;
    const auto ends = call.numbers("range");
    if (ends.size() != 2) {
        throw Error(ErrorCode::invalid_argument, "the range of values is {low, high}");
    }
    picture.range = ValueRange{ends[0], ends[1]};
}

// Paths are drawn at the place of their meshes.
Affine place_of(const Picture& picture, const Mesh& mesh) {
    for (const DrawnMesh& drawn : picture.meshes) {
        if (drawn.mesh.get() == &mesh) return drawn.transform;
    }
    return {};
}

void add_paths(const Call& call, Picture& picture) {
    const double width = line_width(call);
    for (std::size_t i = 0; call.has("paths") && i < call.object_count("paths"); ++i) {
        const auto object = call.object_at<PathObject>("paths", i);
        const Mesh& mesh = object->mesh->mesh;
        const Affine place = place_of(picture, mesh);
        DrawnLine line{object->current().points(mesh), object->current().closed(),
                       category_color(i), width};
        for (Vec3& point : line.points) point = place(point);
        picture.marks.lines.push_back(std::move(line));
    }
}

void add_points(const Call& call, Picture& picture) {
    if (!call.has("points")) return;
    for (const Vec3& point : call.points("points")) {
        picture.marks.points.push_back({point, kHandleColor, 1.5 * line_width(call)});
    }
}

StyleMarks read_marks(const Call& call, const Scalp& scalp) {
    StyleMarks marks;
    marks.width = line_width(call);
    if (!call.has("style_marks")) return marks;
    marks.curves = call.boolean("style_marks.curves");
    marks.constraints = call.boolean("style_marks.constraints");
    if (!call.boolean("style_marks.field")) return marks;
    FieldSlice slice;
    if (call.has("style_marks.point")) {
        slice.point = scalp.to_metres(call.vector("style_marks.point"));
    }
    if (call.has("style_marks.normal")) {
        slice.normal = scalp.frame().axes.transpose() * call.vector("style_marks.normal");
    }
    if (call.has("style_marks.spacing")) slice.spacing = call.number("style_marks.spacing");
    marks.field = slice;
    return marks;
}

// A style is drawn at the place of its head.
void add_style(const Call& call, Picture& picture) {
    if (!call.has("style")) return;
    const auto object = call.object<HairstyleObject>("style");
    Hairstyle& style = object->style();
    const Mesh& head = object->head->mesh;
    const StyleMarks marks = read_marks(call, style.scalp());
    if (marks.field) style.solve(call.context());
    const Affine place = place_of(picture, head);
    const auto add = [&](std::vector<DrawnLine> lines, std::vector<DrawnLine>& to) {
        for (DrawnLine& line : lines) {
            for (Vec3& point : line.points) point = place(point);
            to.push_back(std::move(line));
        }
    };
    add(style_lines(style, marks), picture.marks.lines);
    if (call.has("style_marks") && call.boolean("style_marks.legend")) {
        picture.legend_parts = style_legend(style, marks);
        picture.legend_label = "field";
    }
    NamedMarks field = field_marks(style);
    add(std::move(field.lines), picture.field_marks.lines);
    picture.field_marks.names = std::move(field.names);
}

RenderOptions read_options(const Call& call, const SizeRequest& size) {
    RenderOptions options;
    options.width = size.width;
    options.height = size.height;
    const std::string background = call.string("background");
    options.background =
        background == "transparent" ? std::nullopt : std::optional<Color>(parse_color(background));
    options.samples = call.integer("samples");
    options.supersample = call.integer("supersample");
    options.occlusion = call.number("occlusion");
    return options;
}

Picture compose(const Call& call, const ViewRequest& view, const SizeRequest& size) {
    Picture picture;
    if (call.has("camera")) picture.camera = call.object<CameraObject>("camera")->camera;
    picture.view = view.view;
    picture.framing = view.framing;
    picture.columns = call.integer("columns");
    picture.fit_each = call.has("fit") && call.integer("fit") == 1;
    if (call.has("captions")) {
        for (const char* caption : call.strings("captions")) picture.captions.emplace_back(caption);
    }
    picture.options = read_options(call, size);
    add_scene(call, picture);
    add_meshes(call, picture);
    color_meshes(call, picture);
    move_meshes(call, picture);
    add_strands(call, picture);
    add_style(call, picture);
    paint_regions(call, picture);
    paint_all_regions(call, picture);
    paint_handles(call, picture);
    paint_scalars(call, picture);
    read_scale(call, picture);
    add_paths(call, picture);
    add_points(call, picture);
    return picture;
}

// Objects of a scene have looks of their own.
void check_scene_options(const Call& call) {
    for (const char* option : {"mesh", "meshes", "offsets", "strands", "hair", "style", "color",
                               "region", "handles", "scalars", "crease", "wire_width"}) {
        if (call.has(option)) {
            call.reject(option, "the objects of a scene say it themselves: use scene:set");
        }
    }
    const bool plain = call.boolean("vertex_colors") && !call.boolean("wire") &&
                       !call.boolean("boundaries") &&
                       call.choice<Shading>("shading") == Shading::smooth;
    if (!plain || call.integer("columns") > 0) {
        call.reject("scene", "its objects say themselves how they look: use scene:set");
    }
}

void check_content(const Call& call) {
    if (call.has("scene")) check_scene_options(call);
    if (call.has("mesh") && call.has("meshes")) {
        call.reject("mesh", "give either 'mesh', one, or 'meshes', a list");
    }
    const bool has_mesh = call.has("mesh") || call.has("meshes");
    if (!has_mesh && !call.has("strands") && !call.has("style") && !call.has("scene")) {
        call.reject("mesh", "give 'mesh', one, 'meshes', a list, 'strands', 'style' or 'scene'");
    }
    if (!has_mesh && call.integer("columns") > 0) {
        call.reject("columns", "it needs 'mesh' or 'meshes'");
    }
}

// Options that do nothing without another.
void check_needs(const Call& call) {
    const struct {
        const char* option;
        bool met;
        const char* need;
    } needs[] = {{"hair", call.has("strands"), "it needs 'strands'"},
                 {"range", call.has("scalars"), "it needs 'scalars'"},
                 {"legend", call.has("scalars"), "it needs 'scalars'"},
                 {"label", call.has("scalars"), "it needs 'scalars'"},
                 {"fit", call.integer("columns") > 0, "it needs 'columns'"},
                 {"captions", call.integer("columns") > 0, "it needs 'columns'"},
                 {"wire_width", call.boolean("wire"), "it needs 'wire = true'"},
                 {"style_marks", call.has("style"), "it needs 'style'"}};
    for (const auto& row : needs) {
        if (call.has(row.option) && !row.met) call.reject(row.option, row.need);
    }
    for (const char* option : {"style_marks.point", "style_marks.normal", "style_marks.spacing"}) {
        if (call.has("style_marks") && call.has(option) && !call.boolean("style_marks.field")) {
            call.reject(option, "it needs 'field = true'");
        }
    }
    const bool has_lines = call.has("style") || call.boolean("boundaries") || call.has("paths") ||
                           call.has("points") || call.has("handles");
    if (call.has("line_width") && !has_lines) {
        call.reject("line_width", "it needs 'boundaries', 'paths', 'points', 'handles' or 'style'");
    }
}

// Options that exclude each other.
void check_alternatives(const Call& call) {
    if (call.has("hair.level") && call.has("hair.count")) {
        call.reject("hair.count", "give either 'level', a share, or 'count', a number");
    }
    for (const char* option : {"view", "up", "parallel", "margin"}) {
        if (call.has(option) && call.has("camera")) {
            call.reject(option, "it describes a standard view; leave it out or leave out 'camera'");
        }
    }
    if (call.has("regions") && call.has("scalars")) {
        call.reject("regions", "give either 'regions' or 'scalars'");
    }
    if (call.has("crease") && call.choice<Shading>("shading") == Shading::flat) {
        call.reject("crease", "it is for smooth shading");
    }
}

int render(Call& call) {
    check_content(call);
    check_needs(call);
    check_alternatives(call);
    const ViewRequest view = ViewRequest::read(call);
    const SizeRequest size = SizeRequest::read(call, "size");
    const char* file = call.string("file");
    RendererSlot& renderer = renderer_slot(call);
    const bool done = call.attempt([&] {
        require_picture_path(file_path(file));
        require_folder_of(call.file(file, FileUse::write));
        const Picture picture = compose(call, view, size);
        if (const PictureListener* listener = picture_listener(call.lua())) (*listener)(picture);
        if (!renderer) renderer = std::make_unique<Renderer>();
        const Image image = draw_picture(*renderer, picture, call.context());
        save_picture(image, call.file(file, FileUse::write), call.context());
    });
    return done ? call.push(file) : call.fail();
}

// ---- Description

// A number of few digits.
std::string text_of(double value) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.4g", value);
    return {text.data(), at(length)};
}

std::vector<Parameter> lobe_options(const std::string& name, const char* help) {
    return {number(name, help).at_least(0.0),
            number(name + "_exponent", "Its sharpness.").at_least(0.0),
            number(name + "_shift", "Its lean towards the tip; negative: to the root.")
                .between(-180.0, 180.0)
                .in("degrees")};
}

// `text`: the defaults, in the order of the options.
void append_lobe(std::vector<Parameter>& to, std::vector<Parameter> lobe, const HairLobe& usual) {
    to.push_back(lobe[0].optional(text_of(usual.strength)));
    to.push_back(lobe[1].optional(text_of(usual.exponent)));
    to.push_back(lobe[2].optional(text_of(usual.shift / kDegree)));
}

std::vector<Parameter> hair_options() {
    const StrandStyle s;
    std::vector<Parameter> result{
        string("color", "Colour of all strands, instead of their own.")
            .optional("the strands' own, else a brown"),
        number("level",
               "Part of the strands to draw, the first of them; the fewer, the wider each, so that "
               "they cover as much.")
            .above(0.0)
            .between(0.0, 1.0)
            .optional("1"),
        integer("count", "The same as a number of strands.").at_least(1).optional("all"),
        number("unit", "Length of the mesh's unit; strands are in metres.")
            .above(0.0)
            .in("metres")
            .optional("that of the places of the roots on the mesh, else 1")};
    append_lobe(result, lobe_options("primary", "Strength of the white reflection."), s.primary);
    append_lobe(result, lobe_options("secondary", "Strength of the coloured reflection."),
                s.secondary);
    const auto share = [&](const char* name, const char* help, double usual) {
        result.push_back(number(name, help).between(0.0, 1.0).optional(text_of(usual)));
    };
    result.push_back(number("shift_jitter", "Random lean of reflections, by strand.")
                         .between(0.0, 180.0)
                         .in("degrees")
                         .optional(text_of(s.shift_jitter / kDegree)));
    share("strand_tone", "Random difference of strands' brightness.", s.strand_tone);
    share("clump_tone", "The same for clumps of strands with neighbouring roots.", s.clump_tone);
    result.push_back(number("clump_size", "Distance of the middles of these clumps at the roots.")
                         .above(0.0)
                         .in("metres")
                         .optional(text_of(s.clump_size)));
    result.push_back(number("root_tone", "Factor of the colour at the root.")
                         .between(0.0, 10.0)
                         .optional(text_of(s.root_tone)));
    result.push_back(number("tip_tone", "Factor of the colour at the tip.")
                         .between(0.0, 10.0)
                         .optional(text_of(s.tip_tone)));
    result.push_back(
        number("shadow", "Strength of the shadows of strands on each other and on meshes; 0: none.")
            .between(0.0, 100.0)
            .optional(text_of(s.shadow)));
    share("scalp_tint", "Part of the hair's colour that the scalp takes at dense roots.",
          s.scalp_tint);
    return result;
}

std::vector<Parameter> content_options() {
    const MeshStyle style;
    return {
        object("mesh", "lissom.Mesh", "The mesh to draw; may be left out if strands are drawn.")
            .optional(),
        objects("meshes", "lissom.Mesh", "Several meshes to draw, instead of `mesh`.").optional(),
        object("scene", "lissom.Scene",
               "A scene to draw instead: its visible objects at their places, by their styles.")
            .optional(),
        points("offsets", "Moves each mesh by a vector, in the picture only.").optional(),
        integer("columns",
                "0: all meshes in one space. Else each in a cell of its own, this many a row, "
                "all seen by the same camera.")
            .defaults(0)
            .at_least(0),
        choice("fit", {"all", "each"},
               "In cells, a view frames all meshes at one scale, or each by itself.")
            .optional("all"),
        strings("captions", "In cells, a line of text below each mesh.").optional(),
        either("color", {string("name", "One for all."), strings("names", "One for each mesh.")},
               "Colour of the meshes: \"#rrggbb\" or one of " + std::string(color_names()) +
                   "; with \"#rrggbbaa\" they are seen through, the less so the greater aa is.")
            .optional("clay"),
        boolean("vertex_colors", "Draws the attribute \"color\" if a mesh has it.")
            .defaults(style.vertex_colors),
        choice("shading", {"smooth", "flat"}, "flat shows the faces.").defaults("smooth"),
        number("crease", "Smooth shading keeps edges sharp if faces meet at more than this angle.")
            .between(0.0, 180.0)
            .in("degrees")
            .optional("50"),
        boolean("wire", "Draws the edges of the faces.").defaults(style.wire),
        number("wire_width", "Their width.").above(0.0).in("pixels").optional("1"),
        either("strands",
               {object("strands", "lissom.Strands", "Hair on the mesh, or alone."),
                objects("list", "lissom.Strands",
                        "Several on the only mesh, or one for each of several.")},
               "Hair to draw, in metres. It hides paths and points.")
            .optional(),
        options("hair", hair_options(),
                "Appearance of the strands. Light goes through them by their colour: dual "
                "scattering (Zinke et al. 2008).")
            .optional(),
        object("style", "lissom.Hairstyle",
               "A hairstyle whose curves to draw: streams cyan, dividing curves red, ponytails "
               "purple. Without a mesh or strands on its head.")
            .optional(),
        options("style_marks",
                {boolean("curves", "Draws the curves.").defaults(true),
                 boolean("constraints",
                         "Draws style:constraints() as arrows: along streams, spines and partings "
                         "blue, at ends and partings of hair red, around tails purple, into ties "
                         "green, those of avoid_scalp grey.")
                     .defaults(false),
                 boolean("field", "Draws the field as arrows on a plane through the volume.")
                     .defaults(false),
                 boolean("legend", "Explains the colours of arrows at the right.").defaults(false),
                 vector("point", "A point of the plane.")
                     .in("mesh units")
                     .optional("the center of the head"),
                 vector("normal", "Normal of the plane.").optional("the head's left"),
                 number("spacing", "Between neighbouring arrows.")
                     .in("metres")
                     .above(0.0)
                     .optional("a step of the grid")},
                "Drawn parts of the style.")
            .optional(),
        either("region",
               {object("region", "lissom.Region", "A region of a mesh."),
                string("name", "A region by its name, on every mesh that has it.")},
               "The region of interest, drawn in blue.")
            .optional(),
        either("regions",
               {boolean("all", "All named regions of the meshes."),
                strings("names", "Some of them, by their names.")},
               "Named regions, drawn each in a colour of its own, with a legend; the smaller of "
               "overlapping ones.")
            .optional(),
        either("handles",
               {strings("names", "Regions by their names, on every mesh that has them."),
                objects("regions", "lissom.Region", "Regions of the meshes.")},
               "Handles, drawn in purple; single vertices as balls.")
            .optional(),
        boolean("boundaries", "Draws the open boundaries, each in a colour of its own.")
            .defaults(style.boundaries),
        objects("paths", "lissom.Path", "Paths to draw as lines.").optional(),
        points("points", "Points to draw as balls.").optional(),
        number("line_width", "Width of boundaries and paths; balls are three times as wide.")
            .above(0.0)
            .in("pixels")
            .optional("4"),
        either("scalars",
               {string("name", "An attribute of the vertices, on every mesh that has it."),
                object("buffer", "lissom.Buffer", "One number a vertex."),
                numbers("list", "One number a vertex.")},
               "Numbers to draw in the colours of a scale.")
            .optional(),
        numbers("range", "{low, high}: the numbers at the ends of the scale.")
            .optional("the least and the greatest"),
        boolean("legend", "Draws the scale with its numbers.").optional("true"),
        string("label", "Stands above the scale.").optional("the name of the scalars")};
}

std::vector<Parameter> picture_options() {
    const RenderOptions options;
    return {
        string("file", "The picture to write; its name ends with .png."),
        size_argument(),
        object("camera", "lissom.Camera", "Camera of the picture, instead of `view`.").optional(),
        string("background", "A colour as for `color`, or \"transparent\".").defaults("white"),
        integer(
            "samples",
            "Samples a pixel along edges of meshes: 1, 2, 4, ... as far as the driver has them.")
            .defaults(options.samples)
            .at_least(1),
        integer("supersample",
                "Pixels drawn along each side of one in the picture; 2 is for print.")
            .defaults(options.supersample)
            .between(1, 4),
        number("occlusion", "Darkness of folds and contacts; 0 draws faster.")
            .defaults(options.occlusion)
            .between(0.0, 1.0)};
}

}  // namespace

void set_picture_listener(lua_State* L, const PictureListener* listener) {
    lua_pushlightuserdata(L, const_cast<PictureListener*>(listener));
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kListenerKey);
}

std::vector<Function> render_functions() {
    std::vector<Parameter> options = content_options();
    for (Parameter& option : picture_options()) options.push_back(std::move(option));
    for (Parameter& option : view_options()) options.push_back(std::move(option));
    return {
        {.name = "render",
         .body = render,
         .summary = "Draws meshes and hair into a picture file. Needs no window and no display.",
         .options = options,
         .results = {{"string", "file", "The file that was written."}},
         .errors = {ErrorCode::no_display, ErrorCode::unknown_format, ErrorCode::file_write_failed,
                    ErrorCode::file_is_directory, ErrorCode::mesh_empty,
                    ErrorCode::invalid_argument, ErrorCode::out_of_range,
                    ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local path = os.tmpname() .. ".png"
local mesh = lissom.shapes.cactus{ vertices = 2000 }
local file, problem = lissom.try(lissom.render, { mesh = mesh, file = path, size = { 320, 240 },
    view = "front", region = "left_arm", handles = { "left_tip" } })
assert(file == path or problem.code == "no_display", problem)
os.remove(path))"}};
}

}  // namespace lissom::lua
