// lissom.shapes: generated meshes.
#include "kernel/mesh/shapes/shapes.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/mesh/shapes/head.h"

namespace lissom::lua {
namespace {

// Segments along each of N axes: one number for all, or a list.
template <std::size_t N>
void read_segments(const Call& call, std::array<Index, N>& segments) {
    if (!call.has("segments")) return;
    if (call.kind("segments") == Kind::integer) {
        segments.fill(call.integer("segments"));
        return;
    }
    const auto list = call.ids("segments");
    if (list.size() != N) {
        call.reject("segments",
                    N == 3 ? "integer or {x, y, z} expected" : "integer or {x, z} expected");
    }
    std::copy(list.begin(), list.end(), segments.begin());
}

int box(Call& call) {
    BoxOptions options;
    if (call.has("size")) options.size = call.vector("size");
    read_segments(call, options.segments);
    return new_mesh(call, [&] { return make_box(options, call.context()); });
}

int bar(Call& call) {
    const BarOptions options{call.number("width"), call.number("length"), call.integer("across"),
                             call.integer("along")};
    return new_mesh(call, [&] { return make_bar(options, call.context()); });
}

int sphere(Call& call) {
    const SphereOptions options{call.number("radius"), call.integer("segments"),
                                call.choice<SphereKind>("kind")};
    return new_mesh(call, [&] { return make_sphere(options, call.context()); });
}

int cylinder(Call& call) {
    CylinderOptions options;
    options.radius = call.number("radius");
    options.height = call.number("height");
    options.segments = call.integer("segments");
    options.rings = call.integer("rings");
    options.caps = call.boolean("caps");
    options.cap_rings = call.integer("cap_rings");
    return new_mesh(call, [&] { return make_cylinder(options, call.context()); });
}

int grid(Call& call) {
    GridOptions options;
    if (call.has("size") && call.kind("size") == Kind::number) {
        options.size = Vec2::Constant(call.number("size"));
    } else if (call.has("size")) {
        const auto size = call.numbers("size");
        if (size.size() != 2) call.reject("size", "number or {x, z} expected");
        options.size = {size[0], size[1]};
    }
    read_segments(call, options.segments);
    return new_mesh(call, [&] { return make_grid(options, call.context()); });
}

int torus(Call& call) {
    const TorusOptions options{call.number("radius"), call.number("tube_radius"),
                               call.integer("segments"), call.integer("tube_segments")};
    return new_mesh(call, [&] { return make_torus(options, call.context()); });
}

int cactus(Call& call) {
    const CactusOptions options{call.number("height"), call.integer("vertices"),
                                call.integer("ribs"), call.number("rib_depth"),
                                call.number("thorns")};
    return new_mesh(call, [&] { return make_cactus(options, call.context()); });
}

int head(Call& call) {
    const HeadOptions options{call.number("height"), call.integer("vertices")};
    return new_mesh(call, [&] { return make_head(options, call.context()); });
}

Parameter length(const std::string& name, double value, const std::string& help) {
    return number(name, help).defaults(value).above(0).in("mesh units");
}

Parameter count(const std::string& name, int value, int least, const std::string& help) {
    return integer(name, help).defaults(value).at_least(least);
}

Parameter segments(const std::string& help, const std::string& default_text) {
    return either("segments",
                  {integer("n", "For all axes.").at_least(1),
                   integers("list", "One for each axis.").at_least(1)},
                  help)
        .optional(default_text);
}

}  // namespace

std::vector<Function> shape_functions() {
    const std::vector<Result> mesh = {{"lissom.Mesh", "mesh", "A new mesh that faces outward."}};
    const std::vector<ErrorCode> errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range};
    const BarOptions bar_defaults;
    const SphereOptions sphere_defaults;
    const CylinderOptions cylinder_defaults;
    const TorusOptions torus_defaults;
    const CactusOptions cactus_defaults;
    const HeadOptions head_defaults;
    return {
        {.name = "shapes.box",
         .body = box,
         .summary =
             "An axis-aligned box of quads around the origin. Regions: left, right, bottom, top, "
             "back, front.",
         .options = {factors("size", "Length of its sides.").optional("1"),
                     segments("Quads along x, y and z.", "1")},
         .results = mesh,
         .errors = errors,
         .example = "local box = lissom.shapes.box{ size = { 1, 2, 3 }, segments = { 2, 4, 6 } }"},
        {.name = "shapes.bar",
         .body = bar,
         .summary = "A bar of quads with a square cross section along y. Regions: bottom, top.",
         .options = {length("width", bar_defaults.width, "Side of the cross section."),
                     length("length", bar_defaults.length, "Length along y."),
                     count("across", bar_defaults.across, 1, "Quads across each side."),
                     count("along", bar_defaults.along, 1, "Quads along the bar.")},
         .results = mesh,
         .errors = errors,
         .example = "local bar = lissom.shapes.bar{ length = 8, along = 64 }"},
        {.name = "shapes.sphere",
         .body = sphere,
         .summary = "A sphere around the origin.",
         .options = {length("radius", sphere_defaults.radius, "Its radius."),
                     count(
                         "segments", sphere_defaults.segments, 1,
                         "Divisions of each edge of the cube or icosahedron that it is made from."),
                     choice("kind", {"quads", "triangles"},
                            "From a cube's quads, or an icosahedron.")
                         .defaults("quads")},
         .results = mesh,
         .errors = errors,
         .example = "local ball = lissom.shapes.sphere{ radius = 2, kind = 'triangles' }"},
        {.name = "shapes.cylinder",
         .body = cylinder,
         .summary =
             "A cylinder along y around the origin. Regions: bottom, top, and caps if there are "
             "any.",
         .options = {length("radius", cylinder_defaults.radius, "Its radius."),
                     length("height", cylinder_defaults.height, "Its height."),
                     count("segments", cylinder_defaults.segments, 3, "Quads around."),
                     count("rings", cylinder_defaults.rings, 1, "Quads along."),
                     boolean("caps", "Closes the ends.").defaults(cylinder_defaults.caps),
                     count("cap_rings", cylinder_defaults.cap_rings, 1, "Rings of each cap.")},
         .results = mesh,
         .errors = errors,
         .example = "local tube = lissom.shapes.cylinder{ height = 3, caps = false }"},
        {.name = "shapes.grid",
         .body = grid,
         .summary = "An open rectangle of quads in the xz plane that faces +y. Region: border.",
         .options = {either("size",
                            {number("side", "Both sides.").above(0),
                             numbers("list", "{x, z}.").above(0)},
                            "Length of its sides.")
                         .optional("1"),
                     segments("Quads along x and z.", "10")},
         .results = mesh,
         .errors = errors,
         .example = "local grid = lissom.shapes.grid{ size = { 2, 1 }, segments = { 20, 10 } }"},
        {.name = "shapes.torus",
         .body = torus,
         .summary = "A torus of quads around the y axis.",
         .options = {length("radius", torus_defaults.radius,
                            "Radius of the circle in the tube's middle."),
                     length("tube_radius", torus_defaults.tube_radius,
                            "Radius of the tube; the smaller one."),
                     count("segments", torus_defaults.segments, 3, "Quads around the axis."),
                     count("tube_segments", torus_defaults.tube_segments, 3,
                           "Quads around the tube.")},
         .results = mesh,
         .errors = errors,
         .example = "local ring = lissom.shapes.torus{ tube_radius = 0.2 }"},
        {.name = "shapes.cactus",
         .body = cactus,
         .summary = "A saguaro with two arms that stands on y = 0. Regions: base, tip, left_arm, "
                    "right_arm, left_tip, right_tip.",
         .options = {length("height", cactus_defaults.height, "Its height."),
                     integer("vertices", "Vertices wanted; the result is within 10 %.")
                         .defaults(cactus_defaults.vertices)
                         .between(2000, 1000000),
                     integer("ribs", "Ribs around the trunk: 0, or 4 to 40.")
                         .defaults(cactus_defaults.ribs)
                         .between(0, 40),
                     number("rib_depth",
                            "Depth of the grooves as a fraction of the trunk's radius.")
                         .defaults(cactus_defaults.rib_depth)
                         .between(0, 0.3),
                     number("thorns", "Height of the thorns as a fraction of the trunk's radius.")
                         .defaults(cactus_defaults.thorns)
                         .between(0, 0.2)},
         .results = mesh,
         .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::cancelled},
         .example = "local cactus = lissom.shapes.cactus{ vertices = 2000, ribs = 8 }"},
        {.name = "shapes.head",
         .body = head,
         .summary = "A bald, stylised head with neck and shoulders that faces +z, to show hair on; "
                    "symmetric in x, the origin between the ears. Regions: scalp, ears, bottom.",
         .options = {number("height", "From the bottom of the bust to the crown.")
                         .defaults(head_defaults.height)
                         .above(0)
                         .in("metres"),
                     integer("vertices", "Vertices wanted; the result is within 10 %.")
                         .defaults(head_defaults.vertices)
                         .between(3000, 500000)},
         .results = mesh,
         .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = "local head = lissom.shapes.head{ vertices = 5000 }"}};
}

}  // namespace lissom::lua
