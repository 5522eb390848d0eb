// lissom.Hairstyle: drawing on a style with the tools, without a window.
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/tools/tool_calls.h"

namespace lissom::lua {
namespace {

// The tools do the work, which are Lua.
int sketch_style(Call& call) {
    lua_State* L = call.lua();
    push_tool_call(L, ToolCall::sketch);
    lua_pushvalue(L, 1);
    lua_pushvalue(L, call.stack_index("strokes"));
    lua_createtable(L, 0, 3);
    if (call.has("camera")) {
        lua_pushvalue(L, call.stack_index("camera"));
        lua_setfield(L, -2, "camera");
    }
    call.set_field("strands", call.push(call.integer("strands")));
    const PictureSize size = SizeRequest::picture(call);
    lua_createtable(L, 2, 0);
    lua_pushinteger(L, size.width);
    lua_rawseti(L, -2, 1);
    lua_pushinteger(L, size.height);
    lua_rawseti(L, -2, 2);
    lua_setfield(L, -2, "size");
    if (lua_pcall(L, 3, 2, 0) == 0) return 2;
    if (lua_type(L, -1) != LUA_TSTRING) lua_error(L);
    call.raise(lua_tostring(L, -1));
}

}  // namespace

Function sketch_method_of_hairstyle() {
    return {
        .name = "sketch",
        .body = sketch_style,
        .summary =
            "Draws on the style by the tools of the window: each stroke is a drag of a tool, "
            "with its meaning there. All strokes are done, or, if a tool refuses one, none: the "
            "error names the stroke and the reason.",
        .arguments = {table("strokes",
                            "A list of lissom.SketchStroke. Fields that a stroke leaves out, "
                            "but for its points or its key, are those of the one before.")},
        .options = {object("camera", "lissom.Camera", "Camera of the first stroke, in mesh units.")
                        .optional("the strokes say it"),
                    size_argument(),
                    integer("strands", "Number of strands that the tools grow, to be returned.")
                        .defaults(0)
                        .between(0, 200000)},
        .results = {{"lissom.Sketched[]", "done", "One for each stroke."},
                    {"lissom.Strands?", "hair", "The grown hair."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::handle_removed, ErrorCode::cancelled},
        .example = kStyle + R"(local camera = lissom.camera{ eye = { 0, 0, 3 }, fov = 12 }
-- Of the tools that come with the program: tool = "stream", or "parting", "ponytail", "comb", ...
local flow = lissom.tool{ name = "flow", release = function(self, ev)
    local to = { azimuth = -70, elevation = 10, lift = 0.02 }
    style:add_stream{ points = { style:at{ azimuth = -20, elevation = 60 }, style:at(to) } }
end }
local done = style:sketch({ { tool = flow, points = { { 600, 300 }, { 640, 480 } } } },
    { camera = camera })
assert(#done[1].added == 1))"};
}

std::vector<Record> sketch_records() {
    return {{"lissom.SketchStroke",
             "A stroke for `hairstyle:sketch`, a click, or a key.",
             {{"string|table?", "tool",
               "Name of the tool, \"stream\", \"parting\", \"ponytail\", ..., or a tool."},
              {"number[][]?", "points",
               "Pixels {x, y} from press to release; a single one is a click."},
              {"string?", "key", "A key in place of points, as \"tab\"."},
              {"lissom.Camera?", "camera", "The camera that the head is seen by, in mesh units."},
              {"table?", "params", "Values of the tool's parameters, by name."},
              {"boolean?", "shift", "Held down during this stroke; false by default."},
              {"boolean?", "ctrl", "The same."},
              {"boolean?", "alt", "The same."}}},
            {"lissom.Sketched",
             "Result of a stroke of `hairstyle:sketch`.",
             {{"string", "tool", "The tool that it was drawn with."},
              {"lissom.Curve[]", "added", "New curves of the style."},
              {"boolean", "changed", "Whether the style is another than before."}}}};
}

}  // namespace lissom::lua
