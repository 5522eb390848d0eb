// lissom.Camera: picking under a pixel.
#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/pick_targets.h"
#include "kernel/sketch/picking.h"

namespace lissom::lua {
namespace {

// In the order of PickKind.
constexpr std::array<const char*, 6> kKindNames{"point",    "polyline", "vertex",
                                                "boundary", "edge",     "face"};

using KindFlags = std::array<bool, kKindNames.size()>;

// Step 1: which kinds are asked for.
KindFlags read_kinds(const Call& call) {
    KindFlags flags{};
    if (!call.has("kinds")) {
        flags.back() = true;
        return flags;
    }
    if (call.kind("kinds") == Kind::choice) {
        flags[static_cast<std::size_t>(call.integer("kinds"))] = true;
        return flags;
    }
    for (const char* name : call.strings("kinds")) {
        const auto* const found =
            std::find_if(kKindNames.begin(), kKindNames.end(),
                         [&](const char* kind) { return std::strcmp(kind, name) == 0; });
        if (found == kKindNames.end()) {
            call.reject("kinds", "point, polyline, vertex, boundary, edge or face expected");
        }
        flags[static_cast<std::size_t>(found - kKindNames.begin())] = true;
    }
    return flags;
}

PickOptions pick_options(const Call& call, const KindFlags& flags) {
    PickOptions options;
    options.kinds.clear();
    for (std::size_t i = 0; i < flags.size(); ++i) {
        if (flags[i]) options.kinds.push_back(static_cast<PickKind>(i));
    }
    options.radius = call.number("radius");
    options.through = call.boolean("through");
    options.back_faces = call.boolean("back_faces");
    return options;
}

// The two vertices of an edge or of a segment of a boundary.
void push_ends(const Call& call, const PickTargets& targets, const PickHit& hit) {
    const Topology& topology = targets.mesh(hit.object)->mesh.topology();
    std::array<Index, 2> ends{};
    if (hit.kind == PickKind::edge) {
        ends = {topology.edge(hit.index).first, topology.edge(hit.index).second};
    } else {
        const auto& loop = topology.boundary_loops()[at(hit.index)];
        ends = {loop[at(hit.segment)], loop[at(hit.segment + 1) % loop.size()]};
    }
    call.set_field("ends", call.push_ids(ends));
}

int push_hit(const Call& call, const PickTargets& targets, const PickHit& found) {
    const PickHit hit = targets.known(found);
    lua_createtable(call.lua(), 0, 14);
    call.set_field("kind", call.push(kKindNames[static_cast<std::size_t>(hit.kind)]));
    targets.push_fields(call, hit.object);
    call.set_field("index", call.push_id(hit.index));
    call.set_field("position", call.push_vector(hit.position));
    call.set_field("depth", call.push(hit.depth));
    call.set_field("pixels", call.push(hit.pixels));
    if (hit.segment != kNoIndex) {
        call.set_field("segment", call.push_id(hit.segment));
        call.set_field("along", call.push(hit.along));
    }
    if (hit.face == kNoIndex) return 1;
    call.set_field("face", call.push_id(hit.face));
    call.set_field("triangle", call.push_ids(hit.triangle));
    call.set_field("bary", call.push_vector(hit.barycentric));
    call.set_field("vertex", call.push_id(hit.vertex));
    call.set_field("normal", call.push_vector(hit.normal));
    if (hit.segment != kNoIndex) push_ends(call, targets, hit);
    return 1;
}

// Finds the elements under the pixel; false if that failed.
bool find(Call& call, PickTargets& targets, std::vector<PickHit>& hits, std::size_t most) {
    const auto camera = call.self<CameraObject>();
    const KindFlags flags = read_kinds(call);
    const PictureSize size = SizeRequest::picture(call);
    return call.attempt([&] {
        targets.read(call);
        if (call.has("points")) {
            targets.add_points(call.points("points"), call.boolean("points_on_top"));
        }
        const View view{camera->camera, size};
        const Vec2 cursor(call.number("x"), call.number("y"));
        if (flags[static_cast<std::size_t>(PickKind::polyline)]) {
            targets.add_hair(call, view, cursor, call.number("radius"));
        }
        hits = pick_all(targets.scene(), view, cursor, pick_options(call, flags), most);
    });
}

int pick_first(Call& call) {
    auto& targets = call.hold<PickTargets>();
    auto& hits = call.hold<std::vector<PickHit>>();
    if (!find(call, targets, hits, 1)) return call.fail();
    targets.charge(call);
    if (!hits.empty()) return push_hit(call, targets, hits.front());
    lua_pushnil(call.lua());
    return 1;
}

int pick_everything(Call& call) {
    auto& targets = call.hold<PickTargets>();
    auto& hits = call.hold<std::vector<PickHit>>();
    if (!find(call, targets, hits, static_cast<std::size_t>(call.integer("most")))) {
        return call.fail();
    }
    targets.charge(call);
    return push_list(call, hits, [&](const auto& hit) { push_hit(call, targets, hit); });
}

std::vector<Parameter> pick_fields() {
    std::vector<Parameter> fields = target_options();
    const std::vector<std::string> names(kKindNames.begin(), kKindNames.end());
    const std::vector<Parameter> more{
        number("x", "Pixels from the left edge of the picture."),
        number("y", "Pixels from its top."),
        size_argument(),
        points("points", "Points of the world, such as the middles of handles.").optional(),
        boolean("points_on_top", "They are drawn over everything, and no surface hides them.")
            .defaults(true),
        either("kinds", {choice("kind", names, "One kind."), strings("kinds", "Several.")},
               "Kinds to look for, in this order of preference regardless of the order given: "
               "point, polyline, vertex, boundary, edge, face.")
            .optional("\"face\""),
        number("radius", "Distance from the pixel within which all but faces are picked.")
            .at_least(0)
            .defaults(8.0)
            .in("pixels"),
        boolean("through", "Includes elements hidden by surfaces.").defaults(false),
        boolean("back_faces",
                "Faces that are seen from behind count; if not, they neither are picked nor hide "
                "anything.")
            .defaults(true)};
    fields.insert(fields.end(), more.begin(), more.end());
    return fields;
}

}  // namespace

std::vector<Function> pick_methods_of_camera() {
    std::vector<Parameter> all_fields = pick_fields();
    all_fields.push_back(integer("most", "At most so many.").at_least(1).defaults(1000));
    const std::string setup =
        "local box = lissom.shapes.box()\n"
        "local camera = lissom.camera{ eye = { 0, 0, 5 } }\n";
    const std::vector<ErrorCode> errors{ErrorCode::invalid_argument, ErrorCode::memory_limit,
                                        ErrorCode::cancelled};
    return {
        {.name = "pick",
         .body = pick_first,
         .summary = "Picks under a pixel: of the kinds looked for the first that has anything "
                    "within the radius, and of that the nearest in pixels that no surface hides.",
         .options = pick_fields(),
         .results = {{"lissom.PickHit?", "hit", "nil if there is nothing."}},
         .errors = errors,
         .example = setup + R"(local x, y = camera:project({ 0.5, 0.5, 0.5 })
local hit = camera:pick{ mesh = box, x = x + 3, y = y, kinds = { "vertex", "face" } }
assert(hit.kind == "vertex" and hit.position[3] == 0.5 and hit.mesh == box))"},
        {.name = "pick_all",
         .body = pick_everything,
         .summary = "All that lies under a pixel, in the order in which pick prefers it; with "
                    "`through` all faces along the ray.",
         .options = all_fields,
         .results = {{"lissom.PickHit[]", "hits", "A list."}},
         .errors = errors,
         .example =
             setup + R"(local hits = camera:pick_all{ mesh = box, x = 640, y = 480, through = true }
assert(#hits == 2 and hits[1].depth == 4.5 and hits[2].depth == 5.5))"}};
}

std::vector<Record> pick_records() {
    return {
        {"lissom.PickHit",
         "Something under a pixel. For a point or a free line the fields of surfaces are nil.",
         {{"string", "kind", "point, polyline, vertex, boundary, edge or face."},
          {"string?", "object", "Its name in the scene, if one was given."},
          {"lissom.Mesh?", "mesh", "The mesh of a surface."},
          {"integer", "index",
           "Number of the point, vertex, face or strand; of the loop in mesh:boundaries(); of the "
           "curve in its hairstyle."},
          {"lissom.Vector", "position", "The point in the world."},
          {"lissom.Vector?", "normal",
           "Unit normal in the world; at vertices and edges the mean of the faces around."},
          {"integer?", "face", "The face at the point."},
          {"integer[]?", "triangle", "Vertices of the triangle of that face that contains it."},
          {"number[]?", "bary", "Its barycentric coordinates in that triangle."},
          {"integer?", "vertex", "The nearest vertex of that triangle."},
          {"integer[]?", "ends", "The two vertices of an edge, or of a segment of a boundary."},
          {"integer?", "segment",
           "Segment of a line or boundary: it lies between this point and the next."},
          {"number?", "along", "Place along the edge or segment, 0 to 1."},
          {"number", "depth", "Along the view, in the unit of the world."},
          {"number", "pixels", "From the pixel that was asked about; 0 for faces."}}},
        {"lissom.Selected",
         "Selection on one surface.",
         {{"string?", "object", "Its name in the scene, if one was given."},
          {"lissom.Mesh", "mesh", "The mesh."},
          {"lissom.Region", "region", "The selected vertices, or those of the selected faces."},
          {"integer[]", "faces", "The selected faces; empty for a selection of vertices."},
          {"lissom.Region", "unseen",
           "Vertices inside the shape that are not seen; empty for a selection of faces."}}}};
}

}  // namespace lissom::lua
