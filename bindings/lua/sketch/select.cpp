// lissom.Camera: selection in a part of a picture.
#include <array>
#include <memory>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/pick_targets.h"
#include "kernel/sketch/screen_select.h"

namespace lissom::lua {
namespace {

std::vector<Vec2> pixels_of(const Call& call, const char* path) {
    std::vector<Vec2> result;
    for (const auto& [x, y] : call.pixels(path)) result.emplace_back(x, y);
    return result;
}

std::vector<Selected> selected(const Call& call, const PickTargets& targets, const View& view,
                               const SelectOptions& options) {
    if (call.has("rectangle")) {
        const auto corners = pixels_of(call, "rectangle");
        return select_rectangle(targets.scene(), view, corners[0], corners[1], options,
                                call.context());
    }
    if (call.has("lasso")) {
        return select_lasso(targets.scene(), view, pixels_of(call, "lasso"), options,
                            call.context());
    }
    const auto stroke = pixels_of(call, "brush.stroke");
    return select_brush(targets.scene(), view,
                        {.stroke = stroke, .radius = call.number("brush.radius")}, options,
                        call.context());
}

// The known regions of the surfaces, in their order; several of one mesh are joined in `joined`.
std::vector<const Region*> known_regions(const Call& call, const PickTargets& targets,
                                         std::vector<std::unique_ptr<Region>>& joined) {
    std::vector<const Region*> known(targets.scene().objects().size(), nullptr);
    const std::size_t count = call.has("known") ? call.object_count("known") : 0;
    for (std::size_t k = 0; k < count; ++k) {
        const auto region = call.object_at<RegionObject>("known", k);
        for (Index i = 0; i < count_of(known); ++i) {
            if (targets.mesh(i) != region->mesh) continue;
            const Region& added = region->current();
            const Region*& here = known[at(i)];
            joined.push_back(std::make_unique<Region>(here ? here->united(added) : added));
            here = joined.back().get();
        }
    }
    return known;
}

// Sets a field of the table on top of the stack.
bool set_region(Call& call, const char* field, const std::shared_ptr<MeshObject>& mesh,
                Region& vertices) {
    const auto region = call.create<RegionObject>();
    const bool done = call.attempt_quick(
        [&] { region.set(std::make_shared<RegionObject>(mesh, std::move(vertices))); });
    if (!done) return false;
    call.charge(region);
    call.set_field(field);
    return true;
}

bool push_selected(Call& call, const PickTargets& targets, Selected& one) {
    lua_createtable(call.lua(), 0, 5);
    targets.push_fields(call, one.object);
    call.set_field("faces", call.push_ids(one.faces));
    return set_region(call, "region", targets.mesh(one.object), one.vertices) &&
           set_region(call, "unseen", targets.mesh(one.object), one.unseen);
}

int select_in_picture(Call& call) {
    const auto camera = call.self<CameraObject>();
    const int shapes = call.has("rectangle") + call.has("lasso") + call.has("brush");
    if (shapes != 1) call.reject("rectangle", "give one of rectangle, lasso and brush");
    if (call.has("rectangle") && call.pixels("rectangle").size() != 2) {
        call.reject("rectangle", "two opposite corners {{x, y}, {x, y}} expected");
    }
    const PictureSize size = SizeRequest::picture(call);
    SelectOptions options{.kind = call.choice<SelectKind>("what"),
                          .through = call.boolean("through"),
                          .back_faces = call.boolean("back_faces")};
    if (call.has("known") && options.kind == SelectKind::faces) {
        call.reject("known",
                    "known vertices are left out of a selection of vertices, not of faces");
    }
    auto& targets = call.hold<PickTargets>();
    auto& found = call.hold<std::vector<Selected>>();
    const bool done = call.attempt([&] {
        targets.read(call);
        std::vector<std::unique_ptr<Region>> joined;
        const std::vector<const Region*> known = known_regions(call, targets, joined);
        options.known = known;
        found = selected(call, targets, {camera->camera, size}, options);
    });
    if (!done) return call.fail();
    targets.charge(call);
    lua_createtable(call.lua(), count_of(found), 0);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (!push_selected(call, targets, found[i])) return call.fail();
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

}  // namespace

Function select_method_of_camera() {
    std::vector<Parameter> fields = target_options();
    const std::vector<Parameter> more{
        pixels("rectangle", "Two opposite corners, {{x, y}, {x, y}}.").optional(),
        pixels("lasso",
               "An outline, which is closed: selects elements that it goes around at least once.")
            .optional(),
        options("brush",
                {pixels("stroke", "Positions of its middle; one point is a dab."),
                 number("radius", "Radius of the disk.").at_least(0).defaults(20.0).in("pixels")},
                "A disk that is moved along a stroke.")
            .optional(),
        size_argument(),
        choice("what", {"vertices", "faces"},
               "Vertices that are seen inside; or faces of which the centroid of a triangle is, "
               "and under a brush also those that it touches.")
            .defaults("vertices"),
        boolean("through", "Includes elements hidden by surfaces.").defaults(false),
        boolean("back_faces",
                "Faces that are seen from behind count; if not, neither they nor their vertices "
                "are selected, and they hide nothing.")
            .defaults(true),
        objects("known", "lissom.Region",
                "Vertices that were found before, or found unseen by the same camera, which are "
                "left out: the cost of a long stroke then depends only on the new vertices "
                "under it.")
            .optional()};
    fields.insert(fields.end(), more.begin(), more.end());
    return {.name = "select",
            .body = select_in_picture,
            .summary =
                "Selects the visible elements in a rectangle, inside a lasso or under a brush. "
                "Pixels may lie outside the picture.",
            .options = std::move(fields),
            .results = {{"lissom.Selected[]", "selected", "One for each surface, in order."}},
            .errors = {ErrorCode::invalid_argument, ErrorCode::topology_mismatch,
                       ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = R"(local box = lissom.shapes.box()
local camera = lissom.camera{ eye = { 0, 0, 5 } }
local found = camera:select{ mesh = box, rectangle = { { 0, 0 }, { 1280, 480 } } }
assert(#found[1].region == 2)               -- the upper front edge; the edge behind it is hidden
assert(#found[1].unseen == 2)
local all = { mesh = box, rectangle = { { 0, 0 }, { 1280, 960 } }, known = { found[1].region } }
assert(#camera:select(all)[1].region == 2)  -- the lower front edge)"};
}

}  // namespace lissom::lua
