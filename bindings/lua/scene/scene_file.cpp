// lissom.load_scene, Scene:save, and the parameters that a scene keeps.
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/core/script_parameters.h"
#include "bindings/lua/scene/scene_object.h"
#include "kernel/scene/scene_file.h"

namespace lissom::lua {
namespace {

int save_scene_file(Call& call) {
    const auto self = call.self<SceneObject>();
    const char* path = call.string("path");
    SceneSaveOptions options;
    if (call.has("form")) options.form = call.choice<SceneForm>("form");
    options.history = call.boolean("history");
    auto& left_out = call.hold<std::vector<std::string>>();
    const bool done = call.attempt([&] {
        left_out =
            save_scene(self->scene, call.file(path, FileUse::write), options, call.context());
    });
    if (!done) return call.fail();
    call.push_argument();
    push_list(call, left_out, [&](const std::string& name) { call.push(std::string_view(name)); });
    return 2;
}

int load_scene_file(Call& call) {
    const char* path = call.string("path");
    const double bytes = call.number("history");
    const auto result = call.create<SceneObject>();
    const bool done = call.attempt([&] {
        SceneOptions options;
        options.history_bytes = static_cast<std::size_t>(bytes);
        options.account = call.context().memory();
        auto made = std::make_shared<SceneObject>(options);
        load_scene(call.file(path, FileUse::read), made->scene, *script_item_maker(),
                   call.context());
        result.set(std::move(made));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// ---- Parameters

// The values of a table by their names, without conversions: a number is not its text.
int put_values(Call& call, SceneParameters& values) {
    lua_State* L = call.lua();
    const int table = call.stack_index("values");
    lua_pushnil(L);
    while (lua_next(L, table)) {
        const int type = lua_type(L, -1);
        const char* name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : nullptr;
        if (!name || (type != LUA_TBOOLEAN && type != LUA_TNUMBER && type != LUA_TSTRING)) {
            call.reject("values", "names with booleans, numbers or strings expected");
        }
        std::size_t size = 0;
        const char* text = type == LUA_TSTRING ? lua_tolstring(L, -1, &size) : "";
        const bool flag = lua_toboolean(L, -1) != 0;
        const double number = type == LUA_TNUMBER ? lua_tonumber(L, -1) : 0.0;
        const bool done = call.attempt_quick([&] {
            SceneParameter& value = values[name];
            if (type == LUA_TBOOLEAN) value = flag;
            if (type == LUA_TNUMBER) value = number;
            if (type == LUA_TSTRING) value = std::string(text, size);
        });
        if (!done) return call.fail();
        lua_pop(L, 1);
    }
    return 0;
}

int set_scene_parameters(Call& call) {
    const auto self = call.self<SceneObject>();
    const char* owner = call.string("owner");
    auto& values = call.hold<SceneParameters>();
    if (call.kind("values") == Kind::table) {
        if (const int failed = put_values(call, values)) return failed;
    } else {
        const auto set = call.object<ParameterSet>("values");
        const bool done = call.attempt_quick([&] {
            for (const ScriptParameter& p : set->list) {
                if (p.value) values[p.name] = *p.value;
            }
        });
        if (!done) return call.fail();
    }
    const bool done =
        call.attempt_quick([&] { self->scene.set_parameters(owner, std::move(values)); });
    return done ? call.push_argument() : call.fail();
}

int scene_parameters(Call& call) {
    const auto self = call.self<SceneObject>();
    const auto& all = self->scene.parameters();
    const auto found = all.find(std::string_view(call.string("owner")));
    if (found == all.end()) {
        lua_pushnil(call.lua());
        return 1;
    }
    lua_createtable(call.lua(), 0, count_of(found->second));
    for (const auto& [name, value] : found->second) {
        std::visit(
            [&, &name = name](const auto& x) {
                if constexpr (std::is_same_v<std::decay_t<decltype(x)>, std::string>) {
                    call.set_field(name.c_str(), call.push(std::string_view(x)));
                } else {
                    call.set_field(name.c_str(), call.push(x));
                }
            },
            value);
    }
    return 1;
}

Parameter owner_argument() {
    return string("owner", "Their owner: the name of the tool or script.");
}

const std::string kSaved = R"(local scene = lissom.scene{}
scene:add("bar", lissom.shapes.bar())
local path = os.tmpname()
assert(scene:save(path))
)";

}  // namespace

std::vector<Function> scene_file_methods() {
    return {
        {.name = "save",
         .body = save_scene_file,
         .summary =
             "Writes the scene, whole or not at all: objects with their looks, regions, handles, "
             "curves and parameters, to the bit. A file is an uncompressed tar archive. A folder "
             "is for looking at and for version control: scene.json describes the scene, meshes "
             "and strands are OBJ files under the names of the objects, lists of numbers are text, "
             "and only changed files are written; other files in it stay.",
         .arguments = {string("path",
                              "A file, usually with the extension .lissom, or a folder: one that "
                              "is there, ends with \"/\", or has no extension and is new.")},
         .options = {choice("form", {"automatic", "file", "folder"},
                            "Kind of file to write, whichever the path looks like.")
                         .optional("automatic"),
                     boolean("history",
                             "Keeps the steps too: in a folder as its file history.tar, in which "
                             "steps share their common content.")
                         .defaults(false)},
         .results = {{"lissom.Scene", "scene", "The scene itself."},
                     {"string[]", "left_out",
                      "Content without a place in the file, a sentence each: materials and "
                      "skeletons of meshes."}},
         .effect = Effect::unheard,
         .errors = {ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                    ErrorCode::file_too_large, ErrorCode::invalid_argument, ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = kSaved + "os.remove(path)"},
        {.name = "set_parameters",
         .body = set_scene_parameters,
         .summary = "Keeps values of a tool or script with the scene: they are saved with it. They "
                    "are no part of its history nor of its hash. A lissom.tool_host does this with "
                    "the parameters of its tools.",
         .arguments = {owner_argument(),
                       either("values",
                              {table("table",
                                     "Booleans, numbers and strings by name; none: "
                                     "forgets the kept values."),
                               object("params", "lissom.Params", "All of its values.")},
                              "The new values, in place of the former ones.")},
         .results = {{"lissom.Scene", "scene", "The scene itself."}},
         .errors = {ErrorCode::not_finite, ErrorCode::memory_limit},
         .example = R"(local scene = lissom.scene{}
scene:set_parameters("bend", { angle = 30, mirror = true })
assert(scene:parameters("bend").angle == 30))"},
        {.name = "parameters",
         .body = scene_parameters,
         .summary = "The values that are kept for a tool or script.",
         .arguments = {owner_argument()},
         .results = {{"table|nil", "values", "By name; nil if there are none."}},
         .example = R"(local scene = lissom.scene{}
assert(scene:parameters("bend") == nil))"}};
}

Function load_scene_function() {
    return {.name = "load_scene",
            .body = load_scene_file,
            .summary =
                "Reads a scene that scene:save has written, with its parameters, and with its "
                "history if that was saved. A folder that was edited by hand is read as it is "
                "then, without the history.",
            .arguments = {string("path", "The file or the folder.")},
            .options = {history_option()},
            .results = {{"lissom.Scene", "scene", "A scene with the same hash."}},
            .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory,
                       ErrorCode::file_empty, ErrorCode::file_unreadable, ErrorCode::file_syntax,
                       ErrorCode::file_truncated, ErrorCode::unsupported, ErrorCode::face_index,
                       ErrorCode::unsafe_path, ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = kSaved + R"(local again = assert(lissom.load_scene(path))
assert(again:hash() == scene:hash())
os.remove(path))"};
}

}  // namespace lissom::lua
