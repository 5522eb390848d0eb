#include "viewer/window/session/tool_bench.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/scene/scene_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/tools/tools.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/io/record/file_rules.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/edit/transform.h"
#include "viewer/lua/shown_values.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;

// Key of Lua's registry: its address. The host of the state.
const char kHostOfBench = 0;

// The region that all tools share.
constexpr std::string_view kSelected = "selected";
constexpr Color kLabelColor{0.95, 0.95, 0.95};

constexpr std::array kButtonNames{"left", "right", "middle"};

// ---- Plain tables, read without calling anything of the script's.

// Pushes a field of the table at `index`, or nil.
void push_raw(lua_State* L, int index, const char* key) {
    index = lua::absolute_index(L, index);
    if (!lua_istable(L, index)) return lua_pushnil(L);
    lua_pushstring(L, key);
    lua_rawget(L, index);
}

double raw_number(lua_State* L, int index, const char* key, double usual) {
    push_raw(L, index, key);
    const double value = lua_type(L, -1) == LUA_TNUMBER ? lua_tonumber(L, -1) : usual;
    lua_pop(L, 1);
    return value;
}

bool raw_flag(lua_State* L, int index, const char* key) {
    push_raw(L, index, key);
    const bool value = lua_toboolean(L, -1) != 0;
    lua_pop(L, 1);
    return value;
}

std::string raw_text(lua_State* L, int index, const char* key) {
    push_raw(L, index, key);
    std::string text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
    lua_pop(L, 1);
    return text;
}

Color raw_color(lua_State* L, int index, const Color& usual) {
    const std::string text = raw_text(L, index, "color");
    return text.empty() ? usual : parse_color(text);
}

// {x, y, z} on top of the stack.
Vec3 read_point(lua_State* L, int count) {
    Vec3 point = Vec3::Zero();
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, -1, i + 1);
        point[i] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
    return point;
}

std::vector<Vec3> raw_points(lua_State* L, int index, const char* key, int count) {
    std::vector<Vec3> points;
    push_raw(L, index, key);
    const std::size_t length = lua_istable(L, -1) ? lua::raw_length(L, -1) : 0;
    for (std::size_t i = 0; i < length; ++i) {
        lua_rawgeti(L, -1, static_cast<int>(i) + 1);
        if (lua_istable(L, -1)) points.push_back(read_point(L, count));
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return points;
}

Vec3 raw_point(lua_State* L, int index, const char* key, int count) {
    push_raw(L, index, key);
    const Vec3 point = lua_istable(L, -1) ? read_point(L, count) : Vec3(Vec3::Zero());
    lua_pop(L, 1);
    return point;
}

// Reads three rows of four numbers; the identity if there are none.
Affine raw_transform(lua_State* L, int index, const char* key) {
    Affine transform;
    push_raw(L, index, key);
    for (int row = 0; lua_istable(L, -1) && row < 3; ++row) {
        lua_rawgeti(L, -1, row + 1);
        for (int column = 0; lua_istable(L, -1) && column < 4; ++column) {
            lua_rawgeti(L, -1, column + 1);
            double& part = column < 3 ? transform.linear(row, column) : transform.translation[row];
            part = lua_tonumber(L, -1);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return transform;
}

// Calls `visit` with each entry of the list `key`, a table on top of the stack.
template <typename Visit>
void for_each_entry(lua_State* L, int table, const char* key, const Visit& visit) {
    push_raw(L, table, key);
    const std::size_t length = lua_istable(L, -1) ? lua::raw_length(L, -1) : 0;
    for (std::size_t i = 0; i < length; ++i) {
        lua_rawgeti(L, -1, static_cast<int>(i) + 1);
        if (lua_istable(L, -1)) visit(lua_gettop(L));
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
}

template <typename Object>
Object* raw_object(lua_State* L, int index, const char* key) {
    push_raw(L, index, key);
    lua::Holder* holder = lua::find_holder(L, -1, Object::kTypeName);
    lua_pop(L, 1);
    return holder ? static_cast<Object*>(holder->object.get()) : nullptr;
}

// ---- Marks of a tool: the table at `list`.

Overlay overlay_of(lua_State* L, int list) {
    Overlay overlay;
    for_each_entry(L, list, "points", [&](int one) {
        const Color color = raw_color(L, one, kHandleColor);
        const double radius = raw_number(L, one, "radius", 5.0);
        for (const Vec3& p : raw_points(L, one, "points", 3)) {
            overlay.points.push_back({p, color, radius});
        }
    });
    for_each_entry(L, list, "lines", [&](int one) {
        overlay.lines.push_back({raw_points(L, one, "points", 3), raw_flag(L, one, "closed"),
                                 raw_color(L, one, kWireColor), raw_number(L, one, "width", 3.0)});
    });
    return overlay;
}

ToolOutline circle(const Vec3& middle, double radius) {
    constexpr int kCorners = 64;
    ToolOutline outline;
    outline.closed = true;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * kPi * i / kCorners;
        outline.pixels.emplace_back(middle.x() + radius * std::cos(angle),
                                    middle.y() + radius * std::sin(angle));
    }
    return outline;
}

ToolMarks marks_of(lua_State* L, int list) {
    ToolMarks marks;
    for_each_entry(L, list, "labels", [&](int one) {
        marks.labels.push_back(
            {raw_point(L, one, "at", 3), raw_text(L, one, "text"), raw_color(L, one, kLabelColor)});
    });
    for_each_entry(L, list, "outlines", [&](int one) {
        ToolOutline outline;
        for (const Vec3& p : raw_points(L, one, "pixels", 2))
            outline.pixels.emplace_back(p.head(2));
        outline.closed = raw_flag(L, one, "closed");
        outline.color = raw_color(L, one, kLabelColor);
        outline.width = raw_number(L, one, "width", 1.5);
        outline.opacity = raw_number(L, one, "opacity", 1.0);
        marks.outlines.push_back(std::move(outline));
    });
    for_each_entry(L, list, "surfaces", [&](int one) {
        ToolSurface surface{raw_points(L, one, "from", 3), raw_points(L, one, "to", 3),
                            raw_color(L, one, kHandleColor), raw_number(L, one, "opacity", 0.25)};
        marks.surfaces.push_back(std::move(surface));
    });
    for_each_entry(L, list, "circles", [&](int one) {
        ToolOutline outline =
            circle(raw_point(L, one, "at", 2), raw_number(L, one, "radius", 20.0));
        outline.color = raw_color(L, one, kLabelColor);
        marks.outlines.push_back(std::move(outline));
    });
    return marks;
}

// ---- Calls

// Calls the function of tools that is named by upvalue 1 with the list at upvalue 2. To find the
// first of them runs Lua, which may be cancelled like the call.
int call_packed(lua_State* L) {
    lua::push_tool_function(L, lua_tostring(L, lua_upvalueindex(1)));
    const int count = static_cast<int>(lua_tointeger(L, lua_upvalueindex(3)));
    for (int i = 1; i <= count; ++i) lua_rawgeti(L, lua_upvalueindex(2), i);
    lua_call(L, count, LUA_MULTRET);
    return lua_gettop(L);
}

void push_numbers(lua_State* L, const char* key, const Vec3& value) {
    lua_createtable(L, 3, 0);
    for (int i = 0; i < 3; ++i) {
        lua_pushnumber(L, value[i]);
        lua_rawseti(L, -2, i + 1);
    }
    lua_setfield(L, -2, key);
}

void push_look(lua_State* L, const ToolInput& input) {
    lua_newtable(L);
    push_numbers(L, "eye", input.camera.eye());
    push_numbers(L, "target", input.camera.target());
    push_numbers(L, "up", input.camera.up());
    if (input.camera.is_ortho()) {
        lua_pushnumber(L, *input.camera.options().ortho);
        lua_setfield(L, -2, "ortho");
    } else {
        lua_pushnumber(L, input.camera.fov() / kDegree);
        lua_setfield(L, -2, "fov");
    }
    lua_createtable(L, 2, 0);
    lua_pushinteger(L, input.size.width);
    lua_rawseti(L, -2, 1);
    lua_pushinteger(L, input.size.height);
    lua_rawseti(L, -2, 2);
    lua_setfield(L, -2, "size");
    if (input.up != ViewUp::z) return;
    lua_pushboolean(L, 1);
    lua_setfield(L, -2, "z_up");
}

void push_event(lua_State* L, const ToolInput& input, bool is_late) {
    lua_newtable(L);
    const auto flag = [&](const char* key, bool down) {
        if (!down) return;
        lua_pushboolean(L, 1);
        lua_setfield(L, -2, key);
    };
    flag("shift", input.modifiers.shift);
    flag("ctrl", input.modifiers.ctrl);
    flag("alt", input.modifiers.alt);
    flag("late", is_late);
    if (input.kind == ToolInput::Kind::key) {
        lua_pushstring(L, input.key.c_str());
        return lua_setfield(L, -2, "key");
    }
    lua_pushnumber(L, input.at.x());
    lua_setfield(L, -2, "x");
    lua_pushnumber(L, input.at.y());
    lua_setfield(L, -2, "y");
    if (input.kind == ToolInput::Kind::wheel) {
        lua_pushnumber(L, input.lines);
        lua_setfield(L, -2, "lines");
    }
    if (input.kind != ToolInput::Kind::press) return;
    lua_pushstring(L, kButtonNames[static_cast<std::size_t>(input.button)]);
    lua_setfield(L, -2, "button");
}

std::string label_of(const NamedObject& object) {
    const auto* item = dynamic_cast<const lua::ScriptItem*>(object.item.get());
    const auto surface = item ? item->surface() : nullptr;
    if (!surface || object.item->kind() != ItemKind::mesh) return object.name;
    return object.name + "  (" + std::to_string(surface->mesh.face_count()) + " faces)";
}

// A place in the library's own Lua text says nothing to a person.
void without_own_place(std::string& message) {
    if (!message.starts_with(lua::kOwnLuaText)) return;
    const std::size_t end = message.find(": ");
    if (end != std::string::npos) message.erase(0, end + 2);
}

constexpr std::array kVerbs{"press", "move", "release", "wheel", "key", "cancel", "undo", "redo"};

}  // namespace

// ---- Calls: `count` arguments are on top of the stack; results take their place.

cli::ScriptResult ToolBench::call(const char* method, int count) {
    lua_State* L = script_.lua();
    lua_createtable(L, count, 0);
    lua_insert(L, -count - 1);
    for (int i = count; i >= 1; --i) lua_rawseti(L, -i - 1, i);
    lua_pushstring(L, method);
    lua_insert(L, -2);
    lua_pushinteger(L, count);
    lua_pushcclosure(L, call_packed, 3);
    revive_scene();
    cli::ScriptResult result = script_.call_function();
    revive_scene();
    without_own_place(result.message);
    return result;
}

void ToolBench::push_host() const {
    lua::raw_get_pointer(script_.lua(), LUA_REGISTRYINDEX, &kHostOfBench);
}

// The tool in hand, or nil.
void ToolBench::push_tool() const {
    push_host();
    push_raw(script_.lua(), -1, "tool");
    lua_remove(script_.lua(), -2);
}

bool ToolState::operator==(const ToolState& other) const {
    return tool == other.tool && word == other.word && prompt == other.prompt &&
           steps == other.steps && place == other.place && objects == other.objects &&
           overlay == other.overlay && marks == other.marks;
}

// ---- Scenes

namespace {

void push_paths(lua_State* L, const std::vector<std::string>& paths) {
    lua_createtable(L, static_cast<int>(paths.size()), 0);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        lua_pushstring(L, paths[i].c_str());
        lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
}

// The options of lissom.load that are not its defaults.
void push_load_options(lua_State* L, const LoadOptions& options) {
    lua_newtable(L);
    const auto set = [&](const char* key, const char* value) {
        lua_pushstring(L, value);
        lua_setfield(L, -2, key);
    };
    if (options.weld == Weld::seams) set("weld", "seams");
    if (options.weld == Weld::all) set("weld", "all");
    if (options.weld == Weld::none) set("weld", "none");
    if (options.up != UpAxis::none) set("up", options.up == UpAxis::y ? "y" : "z");
    if (options.unit != 1.0) {
        lua_pushnumber(L, options.unit);
        lua_setfield(L, -2, "unit");
    }
    if (options.repair) return;
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "repair");
}

}  // namespace

cli::ScriptResult ToolBench::open(const std::vector<std::string>& paths,
                                  const LoadOptions& options) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_paths(L, paths);
    push_load_options(L, options);
    cli::ScriptResult result = call("open", 2);
    if (result.status == cli::kSuccess) result = take_values(top + 1, lua_gettop(L));
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::take_values(int first, int last) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    for (int i = first; i <= last; ++i) lua_pushvalue(L, i);
    cli::ScriptResult result = call("host_of", last - first + 1);
    if (result.status == cli::kSuccess) {
        has_scene_ = lua_istable(L, -1);
        lua_pushvalue(L, -1);
        lua::raw_set_pointer(L, LUA_REGISTRYINDEX, &kHostOfBench);
    }
    lua_settop(L, top);
    return result;
}

bool ToolBench::is_tool(int first, int last) {
    if (first != last) return false;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    lua_pushvalue(L, first);
    const bool done = call("is_tool", 1).status == cli::kSuccess;
    const bool is = done && lua_toboolean(L, -1) != 0;
    lua_settop(L, top);
    return is;
}

std::string ToolBench::tool_name(int index) {
    return raw_text(script_.lua(), index, "name");
}

bool ToolBench::has_scene_among(int first, int last) const {
    for (int i = first; i <= last; ++i) {
        if (lua::find_holder(script_.lua(), i, lua::SceneObject::kTypeName)) return true;
    }
    return false;
}

void ToolBench::publish_scene() {
    lua_State* L = script_.lua();
    push_host();
    push_raw(L, -1, "scene");
    lua_setglobal(L, "scene");
    lua_pop(L, 1);
}

cli::ScriptResult ToolBench::save(const std::string& path, std::string& left_out) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushstring(L, path.c_str());
    cli::ScriptResult result = call("save", 2);
    if (result.status == cli::kSuccess) left_out = lua_tostring(L, -1);
    lua_settop(L, top);
    return result;
}

namespace {

// Moves a copy of a mesh or of hair to its place in the scene.
void move_copy(const lua::Holder& holder, const Affine& place) {
    if (place.is_identity()) return;
    if (holder.type_name == lua::StrandsObject::kTypeName) {
        return transform(static_cast<lua::StrandsObject*>(holder.object.get())->strands, place);
    }
    auto* copy = static_cast<lua::MeshObject*>(holder.object.get());
    transform(copy->mesh, place);
    copy->changed();
}

// Returns whether the ending of `path` names one of these formats; true without a path.
bool is_among(const std::string& path, const std::vector<std::string>& extensions) {
    const std::string extension = normalized_extension(fs::path(path).extension().string());
    return path.empty() ||
           std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

}  // namespace

// A copy of an object, its file and its name and place are at `first`: writes it as it stands in
// the scene.
cli::ScriptResult ToolBench::write_export(int first, std::string& told) {
    lua_State* L = script_.lua();
    const lua::Holder* holder = lua::find_holder(L, first, lua::MeshObject::kTypeName);
    if (!holder) holder = lua::find_holder(L, first, lua::StrandsObject::kTypeName);
    try {
        move_copy(*holder, raw_transform(L, first + 2, "transform"));
    } catch (const Error& error) {
        cli::ScriptResult failed;
        failed.status = cli::kFailure;
        failed.message = error.message();
        return failed;
    }
    push_host();
    for (int i = 0; i < 3; ++i) lua_pushvalue(L, first + i);
    cli::ScriptResult result = call("write_export", 4);
    if (result.status == cli::kSuccess) told = lua_tostring(L, -1);
    return result;
}

cli::ScriptResult ToolBench::export_object(const std::string& path, std::string& told) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushstring(L, path.c_str());
    lua_pushboolean(L, is_among(path, writable_extensions()) ? 1 : 0);
    lua_pushboolean(L, is_among(path, writable_strand_extensions()) ? 1 : 0);
    cli::ScriptResult result = call("export", 4);
    if (result.status == cli::kSuccess) result = write_export(top + 1, told);
    lua_settop(L, top);
    return result;
}

// ---- Tools

cli::ScriptResult ToolBench::use(const std::string& word, const std::string& told) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushstring(L, word.c_str());
    lua_pushstring(L, told.c_str());
    cli::ScriptResult result = call("use", 3);
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::take(const ToolInput& input, bool is_late) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    cli::ScriptResult result;
    if (input.kind == ToolInput::Kind::look) {
        push_look(L, input);
        result = call("look", 2);
    } else {
        lua_pushstring(L, kVerbs[static_cast<std::size_t>(input.kind)]);
        push_event(L, input, is_late);
        result = call("method", 3);
    }
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::show(const std::string& name, bool visible) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushliteral(L, "show");
    lua_pushstring(L, name.c_str());
    lua_pushboolean(L, visible ? 1 : 0);
    cli::ScriptResult result = call("method", 4);
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::set(const std::string& name, const lua::ParameterValue& value) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushliteral(L, "set");
    lua_newtable(L);
    if (const auto* flag = std::get_if<bool>(&value)) lua_pushboolean(L, *flag ? 1 : 0);
    if (const auto* number = std::get_if<double>(&value)) lua_pushnumber(L, *number);
    if (const auto* text = std::get_if<std::string>(&value)) lua_pushstring(L, text->c_str());
    lua_setfield(L, -2, name.c_str());
    cli::ScriptResult result = call("method", 3);
    lua_settop(L, top);
    return result;
}

std::vector<fs::path> ToolBench::tool_files(const std::string& word) {
    std::vector<fs::path> files;
    if (word.empty()) return files;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    lua_pushstring(L, word.c_str());
    if (call("tool_files", 1).status == cli::kSuccess && lua_istable(L, -1)) {
        for (int i = 1; i <= static_cast<int>(lua::raw_length(L, top + 1)); ++i) {
            lua_rawgeti(L, top + 1, i);
            if (lua_type(L, -1) == LUA_TSTRING) files.emplace_back(lua_tostring(L, -1));
            lua_pop(L, 1);
        }
    }
    lua_settop(L, top);
    return files;
}

bool ToolBench::is_held() const {
    lua_State* L = script_.lua();
    push_host();
    push_raw(L, -1, "held");
    const bool held = lua_istable(L, -1);
    lua_pop(L, 2);
    return held;
}

bool ToolBench::recover() {
    if (!has_scene_) return true;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushliteral(L, "recover");
    const bool done = call("method", 2).status == cli::kSuccess;
    lua_settop(L, top);
    return done;
}

bool ToolBench::holds(int first, int last) {
    if (!has_scene_) return false;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    for (int i = first; i <= last; ++i) lua_pushvalue(L, i);
    const bool done = call("holds", last - first + 2).status == cli::kSuccess;
    const bool held = done && lua_toboolean(L, -1) != 0;
    lua_settop(L, top);
    return held;
}

void ToolBench::begin_outside() {
    if (!has_scene_) return;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushliteral(L, "begin_outside");
    call("method", 2);
    lua_settop(L, top);
}

bool ToolBench::changed_outside(const std::string& line, bool failed) {
    if (!has_scene_) return false;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushliteral(L, "changed_outside");
    lua_pushlstring(L, line.data(), line.size());
    lua_pushboolean(L, failed ? 1 : 0);
    const bool done = call("method", 4).status == cli::kSuccess;
    const bool changed = done && lua_toboolean(L, -1) != 0;
    lua_settop(L, top);
    return changed;
}

// A scene that a script has closed is open again: the window has it still.
void ToolBench::revive_scene() {
    lua_State* L = script_.lua();
    push_host();
    push_raw(L, -1, "scene");
    lua::Holder* holder = lua::find_holder(L, -1, lua::SceneObject::kTypeName);
    if (holder && !holder->object) holder->object = scene_;
    if (holder) scene_ = holder->object;
    lua_pop(L, 2);
}

std::optional<std::string> ToolBench::kept() {
    if (!has_scene_) return std::nullopt;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    std::optional<std::string> text;
    if (call("keep", 1).status == cli::kSuccess && lua_type(L, -1) == LUA_TSTRING) {
        text = lua_tostring(L, -1);
    }
    lua_settop(L, top);
    return text;
}

cli::ScriptResult ToolBench::restore(const std::string& kept, bool selects) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushlstring(L, kept.data(), kept.size());
    lua_pushboolean(L, selects ? 1 : 0);
    cli::ScriptResult result = call("restore", 3);
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::record(const char* method, const std::vector<std::string>& open,
                                    const LoadOptions& options) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushstring(L, method);
    push_paths(L, open);
    push_load_options(L, options);
    lua_pushboolean(L, 1);
    cli::ScriptResult result = call("method", 5);
    lua_settop(L, top);
    return result;
}

std::optional<std::string> ToolBench::text_of(const char* method) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua_pushstring(L, method);
    std::optional<std::string> text;
    if (call("method", 2).status == cli::kSuccess && lua_type(L, -1) == LUA_TSTRING) {
        text = lua_tostring(L, -1);
    }
    lua_settop(L, top);
    return text;
}

// ---- Playing

namespace {

// Key of Lua's registry: its address. The recording that is played.
const char kPlaying = 0;

template <typename Visit>
void for_each_item(lua_State* L, int list, const Visit& visit) {
    const std::size_t length = lua_istable(L, list) ? lua::raw_length(L, list) : 0;
    for (std::size_t i = 0; i < length; ++i) {
        lua_rawgeti(L, list, static_cast<int>(i) + 1);
        visit();
        lua_pop(L, 1);
    }
}

}  // namespace

cli::ScriptResult ToolBench::open_recording(const std::string& path,
                                            std::vector<std::string>& files,
                                            std::vector<double>& times) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    play_differs_ = false;
    lua_pushstring(L, path.c_str());
    cli::ScriptResult result = call("open_recording", 1);
    if (result.status == cli::kSuccess) {
        for_each_item(L, top + 2, [&] { files.emplace_back(lua_tostring(L, -1)); });
        for_each_item(L, top + 4, [&] { times.push_back(lua_tonumber(L, -1)); });
        lua_pushvalue(L, top + 3);
        lua::raw_set_pointer(L, LUA_REGISTRYINDEX, &kPlaying);
        result = take_values(top + 1, top + 1);
    }
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::play(std::size_t place, PlayedEvent& done) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    lua::raw_get_pointer(L, LUA_REGISTRYINDEX, &kPlaying);
    lua_pushinteger(L, static_cast<lua_Integer>(place) + 1);
    cli::ScriptResult result = call("play", 3);
    if (result.status == cli::kSuccess) {
        lua_settop(L, top + 3);
        if (lua_type(L, top + 1) == LUA_TSTRING) done.difference = lua_tostring(L, top + 1);
        play_differs_ = lua_toboolean(L, top + 2) != 0;
        if (lua_type(L, top + 3) == LUA_TSTRING) done.tool = lua_tostring(L, top + 3);
    }
    lua_settop(L, top);
    return result;
}

std::string ToolBench::event_kind(std::size_t place) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    lua::raw_get_pointer(L, LUA_REGISTRYINDEX, &kPlaying);
    lua_pushinteger(L, static_cast<lua_Integer>(place) + 1);
    const bool done = call("event_kind", 2).status == cli::kSuccess;
    std::string kind = done && lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
    lua_settop(L, top);
    return kind;
}

PlayedHand ToolBench::hand() const {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    PlayedHand hand;
    push_host();
    if (const auto* seen = raw_object<lua::CameraObject>(L, -1, "camera"))
        hand.camera = seen->camera;
    const Vec3 size = raw_point(L, top + 1, "size", 2);
    hand.size = {static_cast<int>(size.x()), static_cast<int>(size.y())};
    hand.at = {raw_number(L, top + 1, "x", -1.0), raw_number(L, top + 1, "y", -1.0)};
    hand.is_down = is_held();
    lua_settop(L, top);
    return hand;
}

// ---- Results

cli::ScriptResult ToolBench::draw() {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    cli::ScriptResult result = call("draw", 1);
    lua_settop(L, top);
    return result;
}

void ToolBench::paint_regions(Picture& picture) {
    lua_State* L = script_.lua();
    for (DrawnMesh& drawn : picture.meshes) {
        const Region* selected = drawn.mesh->find_region(kSelected);
        if (selected && !drawn.style.region) drawn.style.region = *selected;
    }
    for_each_entry(L, lua_gettop(L), "regions", [&](int one) {
        const auto* mesh = raw_object<lua::MeshObject>(L, one, "mesh");
        const auto* region = raw_object<lua::RegionObject>(L, one, "region");
        if (!mesh || !region) return;
        for (DrawnMesh& drawn : picture.meshes) {
            if (drawn.mesh.get() != &mesh->mesh) continue;
            if (region->region.topology() != drawn.mesh->shared_topology()) continue;
            drawn.style.parts.push_back({region->region, raw_color(L, one, kRegionColor)});
        }
    });
}

// Meshes that the tool shows though they are not in the scene.
void ToolBench::add_meshes(Picture& picture) {
    lua_State* L = script_.lua();
    for_each_entry(L, lua_gettop(L), "meshes", [&](int one) {
        push_raw(L, one, "mesh");
        lua::Holder* holder = lua::find_holder(L, -1, lua::MeshObject::kTypeName);
        lua_pop(L, 1);
        const auto object = holder ? std::static_pointer_cast<lua::MeshObject>(holder->object)
                                   : std::shared_ptr<lua::MeshObject>();
        if (!object || object->mesh.face_count() == 0) return;
        DrawnMesh drawn{std::shared_ptr<const Mesh>(object, &object->mesh)};
        drawn.transform = raw_transform(L, one, "transform");
        drawn.style.color = raw_color(L, one, drawn.style.color);
        drawn.style.raised = true;
        picture.meshes.push_back(std::move(drawn));
    });
}

Picture ToolBench::picture() {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    push_raw(L, -1, "scene");
    Picture picture = lua::picture_of_values(L, top + 2, top + 2);
    push_raw(L, top + 1, "drawn");
    picture.tool_marks = overlay_of(L, lua_gettop(L));
    paint_regions(picture);
    add_meshes(picture);
    lua_settop(L, top);
    return picture;
}

bool ToolBench::is_empty() {
    if (!has_scene_) return true;
    lua_State* L = script_.lua();
    push_host();
    const auto* object = raw_object<lua::SceneObject>(L, -1, "scene");
    lua_pop(L, 1);
    return !object || object->scene.objects().empty();
}

std::vector<std::string> ToolBench::names_of(const Picture& picture) {
    lua_State* L = script_.lua();
    push_host();
    const auto* object = raw_object<lua::SceneObject>(L, -1, "scene");
    lua_pop(L, 1);
    std::vector<std::string> names;
    for (const DrawnMesh& drawn : picture.meshes) {
        std::string name = "mesh " + std::to_string(names.size() + 1);
        for (const auto& named : object ? object->scene.objects() : ObjectList()) {
            if (named->id.value == drawn.object) name = named->name;
        }
        names.push_back(std::move(name));
    }
    return names;
}

ToolState ToolBench::state() {
    ToolState state;
    state.has_scene = has_scene_;
    if (!has_scene_) return state;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    const int host = top + 1;
    state.prompt = raw_text(L, host, "prompted");
    push_raw(L, host, "drawn");
    state.marks = marks_of(L, lua_gettop(L));
    state.overlay = overlay_of(L, lua_gettop(L));
    push_tool();
    if (lua_istable(L, -1)) {
        state.tool = raw_text(L, -1, "name");
        state.word = raw_text(L, host, "word");
        const auto* parameters = raw_object<lua::ParameterSet>(L, -1, "params");
        if (parameters) state.parameters = parameters->list;
    }
    if (const auto* object = raw_object<lua::SceneObject>(L, host, "scene")) {
        for (const auto& named : object->scene.objects()) {
            // A deformation is seen by its mesh.
            if (named->item->kind() == ItemKind::deformation) continue;
            state.objects.push_back({named->name, label_of(*named), named->look.visible});
        }
        const HistoryReport history = object->scene.history();
        for (const auto& step : history.steps) state.steps.push_back(step.name);
        state.place = history.place;
    }
    lua_settop(L, top);
    return state;
}

ToolBench::Looked ToolBench::looked() {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push_host();
    Looked seen;
    if (call("looked", 1).status == cli::kSuccess) {
        lua::Holder* holder = lua::find_holder(L, -2, lua::CameraObject::kTypeName);
        if (holder) seen.camera = static_cast<lua::CameraObject*>(holder->object.get())->camera;
        if (lua_isboolean(L, -1)) seen.up = lua_toboolean(L, -1) ? ViewUp::z : ViewUp::y;
    }
    lua_settop(L, top);
    return seen;
}

// ---- Files

std::vector<std::string> shipped_tools() {
    std::vector<std::string> names;
    const std::string folder = cli::Script::shipped_scripts();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "tools", error)) {
        const std::string name = entry.path().stem().string();
        // The window does its work if no tool is in hand.
        if (entry.path().extension() == ".lua" && name != "navigate") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

namespace {

fs::path data_folder() {
    const char* const data = std::getenv("XDG_DATA_HOME");
    if (data && *data) return fs::path(data) / "lissom";
    const char* const home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".local" / "share" / "lissom" : fs::path();
}

}  // namespace

std::vector<std::string> own_tools() {
    std::vector<std::string> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(data_folder() / "tools", error)) {
        if (entry.path().extension() == ".lua") files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace lissom::window
