// lissom.load_scene, and Scene:save.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/library.h"
#include "bindings/lua/scene/scene_object.h"
#include "kernel/scene/scene_file.h"

namespace lissom::lua {
namespace {

int save_scene_file(Call& call) {
    const auto self = call.self<SceneObject>();
    const char* path = call.string("path");
    auto& left_out = call.hold<std::vector<std::string>>();
    const bool done =
        call.attempt([&] { left_out = save_scene(self->scene, path, call.context()); });
    if (!done) return call.fail();
    call.push_argument();
    lua_createtable(call.lua(), count_of(left_out), 0);
    for (std::size_t i = 0; i < left_out.size(); ++i) {
        call.push(std::string_view(left_out[i]));
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 2;
}

int load_scene_file(Call& call) {
    const char* path = call.string("path");
    const double bytes = call.number("history");
    const auto result = call.create<SceneObject>();
    const bool done = call.attempt([&] {
        SceneOptions options;
        options.history_bytes = static_cast<std::size_t>(bytes);
        auto made = std::make_shared<SceneObject>(options);
        load_scene(path, made->scene, *script_item_maker(), call.context());
        result.set(std::move(made));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

const std::string kSaved = R"(local scene = lissom.scene{}
scene:add("bar", lissom.shapes.bar())
local path = os.tmpname()
assert(scene:save(path))
)";

}  // namespace

Function scene_save_method() {
    return {.name = "save",
            .body = save_scene_file,
            .summary =
                "Writes the scene into one file: objects with their looks, regions, handles and "
                "curves, to the bit, but not its history. The file is an uncompressed tar archive.",
            .arguments = {string("path", "The file, usually with the extension .lissom.")},
            .results = {{"lissom.Scene", "scene",
                         "The scene itself; nil, message, code where the "
                         "file could not be written."},
                        {"string[]", "left_out",
                         "What had no place in the file, a sentence each: "
                         "materials and skeletons of meshes."}},
            .errors = {ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                       ErrorCode::file_too_large, ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = kSaved + "os.remove(path)"};
}

Function load_scene_function() {
    return {
        .name = "load_scene",
        .body = load_scene_file,
        .summary = "Reads a scene that scene:save has written.",
        .arguments = {string("path", "The file.")},
        .options = {history_option()},
        .results = {{"lissom.Scene", "scene",
                     "A scene with the same hash; nil, message, code where there is none."}},
        .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory, ErrorCode::file_empty,
                   ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::file_truncated,
                   ErrorCode::unsupported, ErrorCode::memory_limit, ErrorCode::cancelled},
        .example = kSaved + R"(local again = assert(lissom.load_scene(path))
assert(again:hash() == scene:hash())
os.remove(path))"};
}

}  // namespace lissom::lua
