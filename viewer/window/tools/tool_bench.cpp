#include "viewer/window/tools/tool_bench.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/scene/scene_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/tools/tool_view.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/io/record/file_rules.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/edit/transform.h"
#include "viewer/lua/shown_values.h"
#include "viewer/window/tools/tool_marks.h"
#include "viewer/window/tools/tool_values.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;

// Keys of Lua's registry: their addresses. The host of the state, and the recording that is played.
const char kHostOfBench = 0, kPlaying = 0;
constexpr RegistryValue kHost{&kHostOfBench};

using lua::ToolCall;

// Calls by the kind of an input.
constexpr std::array kInputs{ToolCall::press,  ToolCall::move, ToolCall::release,
                             ToolCall::wheel,  ToolCall::tick, ToolCall::key,
                             ToolCall::cancel, ToolCall::undo, ToolCall::redo};

template <typename Object>
std::shared_ptr<Object> object_at(lua_State* L, int index) {
    const lua::Holder* holder = lua::find_holder(L, index, Object::kTypeName);
    return holder ? std::static_pointer_cast<Object>(holder->object.shared()) : nullptr;
}

// Returns the object in a field of the host, or null.
template <typename Object>
std::shared_ptr<Object> host_field(lua_State* L, const char* key) {
    push(L, kHost);
    push_raw(L, -1, key);
    auto object = object_at<Object>(L, -1);
    lua_pop(L, 2);
    return object;
}

// Makes the call of tools at upvalue 1 with the list at upvalue 2. To find the
// first of them runs Lua, which may be cancelled like the call.
int call_packed(lua_State* L) {
    lua::push_tool_call(L, static_cast<ToolCall>(lua_tointeger(L, lua_upvalueindex(1))));
    const int count = static_cast<int>(lua_tointeger(L, lua_upvalueindex(3)));
    for (int i = 1; i <= count; ++i) lua_rawgeti(L, lua_upvalueindex(2), i);
    lua_call(L, count, LUA_MULTRET);
    return lua_gettop(L);
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

StackValues on_stack(StackRange values) {
    return {values.first, values.last};
}

}  // namespace

// Calls a function of tools: `count` arguments are on top of the stack; results take their place.
cli::ScriptResult ToolBench::call(ToolCall called, int count) {
    lua_State* L = script_.lua();
    lua_createtable(L, count, 0);
    lua_insert(L, -count - 1);
    for (int i = count; i >= 1; --i) lua_rawseti(L, -i - 1, i);
    lua_pushinteger(L, static_cast<lua_Integer>(called));
    lua_insert(L, -2);
    lua_pushinteger(L, count);
    lua_pushcclosure(L, call_packed, 3);
    revive_scene();
    cli::ScriptResult result = script_.call_function();
    revive_scene();
    without_own_place(result.message);
    return result;
}

// The same with values of C++: reads as many results as are asked for; the stack stays as it is.
template <typename... Results, typename... Arguments>
cli::ScriptResult ToolBench::ask(std::tuple<Results&...> results, ToolCall called,
                                 const Arguments&... arguments) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    int count = 0;
    ((count += push(L, arguments)), ...);
    cli::ScriptResult result = call(called, count);
    if (result.status == cli::kSuccess) {
        int index = top;
        std::apply([&](auto&... values) { (read(L, ++index, values), ...); }, results);
    }
    lua_settop(L, top);
    return result;
}

namespace {

bool is_declared_alike(const lua::ScriptParameter& a, const lua::ScriptParameter& b) {
    return a.name == b.name && a.group == b.group && a.default_value == b.default_value;
}

}  // namespace

bool ToolState::operator==(const ToolState& other) const {
    return std::equal(parameters.begin(), parameters.end(), other.parameters.begin(),
                      other.parameters.end(), is_declared_alike) &&
           tool == other.tool && word == other.word && ticks == other.ticks &&
           prompt == other.prompt && steps == other.steps && place == other.place &&
           objects == other.objects && overlay == other.overlay && marks == other.marks;
}

// ---- Scenes

cli::ScriptResult ToolBench::open(const std::vector<std::string>& paths,
                                  const LoadOptions& options) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push(L, paths);
    push(L, options);
    cli::ScriptResult result = call(ToolCall::open, 2);
    if (result.status == cli::kSuccess) result = take_values({top + 1, lua_gettop(L)});
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::take_values(StackRange values) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    cli::ScriptResult result = call(ToolCall::host_of, push(L, on_stack(values)));
    if (result.status == cli::kSuccess) {
        has_scene_ = lua_istable(L, -1);
        read(L, -1, kHost);
    }
    lua_settop(L, top);
    return result;
}

std::optional<std::string> ToolBench::tool_among(StackRange values) {
    bool is_tool = false;
    if (values.first != values.last) return std::nullopt;
    ask(std::tie(is_tool), ToolCall::is_tool, on_stack(values));
    if (!is_tool) return std::nullopt;
    std::string name;
    read_field(script_.lua(), values.first, "name", name);
    return name;
}

bool ToolBench::has_scene_among(StackRange values) const {
    for (int i = values.first; i <= values.last; ++i) {
        if (lua::find_holder(script_.lua(), i, lua::SceneObject::kTypeName)) return true;
    }
    return false;
}

bool ToolBench::holds(StackRange values) {
    bool held = false;
    if (has_scene_) ask(std::tie(held), ToolCall::holds, kHost, on_stack(values));
    return held;
}

bool ToolBench::is_empty() {
    if (!has_scene_) return true;
    const auto object = host_field<lua::SceneObject>(script_.lua(), "scene");
    return !object || object->scene.objects().empty();
}

void ToolBench::publish_scene() {
    lua_State* L = script_.lua();
    push(L, kHost);
    push_raw(L, -1, "scene");
    lua_setglobal(L, "scene");
    lua_pop(L, 1);
}

cli::ScriptResult ToolBench::save(const std::string& path, std::string& left_out) {
    return ask(std::tie(left_out), ToolCall::save, kHost, path);
}

namespace {

// Moves a copy of a mesh or of hair to its place in the scene.
void move_copy(lua_State* L, int index, const Affine& place) {
    if (place.is_identity()) return;
    if (const auto hair = object_at<lua::StrandsObject>(L, index)) {
        return transform(hair->strands, place);
    }
    const auto copy = object_at<lua::MeshObject>(L, index);
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
    try {
        Affine place;
        read_field(L, first + 2, "transform", place);
        move_copy(L, first, place);
    } catch (const Error& error) {
        cli::ScriptResult failed;
        failed.status = cli::kFailure;
        failed.message = error.message();
        return failed;
    }
    return ask(std::tie(told), ToolCall::write_export, kHost, StackValues{first, first + 2});
}

cli::ScriptResult ToolBench::export_object(const std::string& path, std::string& told) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push(L, kHost);
    push(L, path);
    push(L, is_among(path, writable_extensions()));
    push(L, is_among(path, writable_strand_extensions()));
    cli::ScriptResult result = call(ToolCall::export_object, 4);
    if (result.status == cli::kSuccess) result = write_export(top + 1, told);
    lua_settop(L, top);
    return result;
}

// A scene that a script has closed is open again: the window has it still.
void ToolBench::revive_scene() {
    lua_State* L = script_.lua();
    push(L, kHost);
    push_raw(L, -1, "scene");
    lua::Holder* holder = lua::find_holder(L, -1, lua::SceneObject::kTypeName);
    if (holder && !holder->object) holder->object = scene_;
    if (holder) scene_ = holder->object.shared();
    lua_pop(L, 2);
}

// ---- Tools

cli::ScriptResult ToolBench::use(const std::string& word, const std::string& told) {
    return ask(std::tie(), ToolCall::use, kHost, word, told);
}

std::vector<fs::path> ToolBench::tool_files(const std::string& word) {
    std::vector<std::string> files;
    if (!word.empty()) ask(std::tie(files), ToolCall::tool_files, word);
    return {files.begin(), files.end()};
}

bool ToolBench::is_held() const {
    lua_State* L = script_.lua();
    push(L, kHost);
    push_raw(L, -1, "held");
    const bool held = lua_istable(L, -1);
    lua_pop(L, 2);
    return held;
}

cli::ScriptResult ToolBench::take(const ToolInput& input, bool is_late) {
    if (input.kind == ToolInput::Kind::look)
        return ask(std::tie(), ToolCall::look, kHost, Look{input});
    return ask(std::tie(), kInputs[static_cast<std::size_t>(input.kind)], kHost,
               HandEvent{input, is_late});
}

cli::ScriptResult ToolBench::show(const std::string& name, bool visible) {
    return ask(std::tie(), ToolCall::show, kHost, name, visible);
}

cli::ScriptResult ToolBench::set(const std::string& name, const lua::ParameterValue& value) {
    return ask(std::tie(), ToolCall::set, kHost, ToolSetting{name, value});
}

bool ToolBench::recover() {
    return !has_scene_ || ask(std::tie(), ToolCall::recover, kHost).status == cli::kSuccess;
}

void ToolBench::begin_outside() {
    if (has_scene_) ask(std::tie(), ToolCall::begin_outside, kHost);
}

bool ToolBench::changed_outside(const std::string& line, bool failed) {
    bool changed = false;
    if (has_scene_) ask(std::tie(changed), ToolCall::changed_outside, kHost, line, failed);
    return changed;
}

std::optional<std::string> ToolBench::kept() {
    std::optional<std::string> text;
    if (has_scene_) ask(std::tie(text), ToolCall::keep, kHost);
    return text;
}

cli::ScriptResult ToolBench::restore(const std::string& kept, bool selects) {
    return ask(std::tie(), ToolCall::restore, kHost, kept, selects);
}

cli::ScriptResult ToolBench::record(Transcript transcript, const std::vector<std::string>& open,
                                    const LoadOptions& options) {
    if (transcript == Transcript::journal) {
        return ask(std::tie(), ToolCall::keep_journal, kHost, open, options);
    }
    constexpr bool kTimed = true;
    return ask(std::tie(), ToolCall::record, kHost, open, options, kTimed);
}

std::optional<std::string> ToolBench::text_of(Transcript transcript) {
    const bool is_journal = transcript == Transcript::journal;
    std::optional<std::string> text;
    ask(std::tie(text), is_journal ? ToolCall::journal_text : ToolCall::recording, kHost);
    return text;
}

// ---- Playing

cli::ScriptResult ToolBench::open_recording(const std::string& path, Recording& opened) {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push(L, path);
    cli::ScriptResult result = call(ToolCall::open_recording, 1);
    if (result.status == cli::kSuccess) {
        read(L, top + 2, opened.files);
        read(L, top + 3, RegistryValue{&kPlaying});
        read(L, top + 4, opened.times);
        read(L, top + 5, opened.kinds);
        result = take_values({top + 1, top + 1});
    }
    lua_settop(L, top);
    return result;
}

cli::ScriptResult ToolBench::play(std::size_t place, PlayedEvent& done) {
    return ask(std::tie(done.difference, done.differs, done.tool), ToolCall::play, kHost,
               RegistryValue{&kPlaying}, static_cast<lua_Integer>(place) + 1);
}

// Of the host at a stack index.
PlayedHand ToolBench::hand(int host) const {
    lua_State* L = script_.lua();
    PlayedHand hand;
    if (const auto seen = host_field<lua::CameraObject>(L, "camera")) hand.camera = seen->camera;
    std::vector<double> size;
    read_field(L, host, "size", size);
    if (size.size() == 2) hand.size = {static_cast<int>(size[0]), static_cast<int>(size[1])};
    hand.at = {-1.0, -1.0};
    read_field(L, host, "x", hand.at.x());
    read_field(L, host, "y", hand.at.y());
    hand.is_down = is_held();
    return hand;
}

// ---- Results

cli::ScriptResult ToolBench::draw() {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push(L, kHost);
    cli::ScriptResult result = call(ToolCall::draw, 1);
    if (result.status == cli::kSuccess) {
        const auto seen = object_at<lua::CameraObject>(L, top + 1);
        if (seen) camera_ = seen->camera;
        if (lua_isboolean(L, top + 2)) up_ = lua_toboolean(L, top + 2) ? ViewUp::z : ViewUp::y;
    }
    lua_settop(L, top);
    return result;
}

namespace {

std::vector<std::string> names_of(const Picture& picture, const lua::SceneObject* object) {
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

}  // namespace

ToolPicture ToolBench::picture() {
    lua_State* L = script_.lua();
    const int top = lua_gettop(L);
    push(L, kHost);
    push_raw(L, -1, "scene");
    ToolPicture seen{lua::picture_of_values(L, top + 2, top + 2), {}};
    lua_settop(L, top);
    if (const auto view = host_field<lua::ToolViewObject>(L, "drawn")) {
        seen.picture.tool_marks = overlay_of(*view);
        paint_regions(*view, seen.picture);
        add_meshes(*view, seen.picture);
    }
    seen.names = names_of(seen.picture, host_field<lua::SceneObject>(L, "scene").get());
    return seen;
}

// Adds the objects and steps of the scene.
void ToolBench::look_at_scene(ToolState& state) const {
    const auto object = host_field<lua::SceneObject>(script_.lua(), "scene");
    if (!object) return;
    for (const auto& named : object->scene.objects()) {
        // A deformation is seen by its mesh.
        if (named->item->kind() == ItemKind::deformation) continue;
        const bool is_curve = named->item->kind() == ItemKind::polyline;
        state.objects.push_back({named->name, label_of(*named), named->look.visible, is_curve});
    }
    const HistoryReport history = object->scene.history();
    for (const auto& step : history.steps) state.steps.push_back(step.name);
    state.place = history.place;
}

ToolState ToolBench::state() {
    ToolState state;
    state.has_scene = has_scene_;
    if (!has_scene_) return state;
    lua_State* L = script_.lua();
    const int top = lua_gettop(L), host = top + 1;
    push(L, kHost);
    read_field(L, host, "prompted", state.prompt);
    if (const auto view = host_field<lua::ToolViewObject>(L, "drawn")) {
        state.marks = marks_of(*view);
        state.overlay = overlay_of(*view);
    }
    push_raw(L, host, "tool");
    if (lua_istable(L, -1)) {
        read_field(L, host + 1, "name", state.tool);
        read_field(L, host, "word", state.word);
        push_raw(L, host + 1, "tick");
        state.ticks = lua_isfunction(L, -1);
        lua_pop(L, 1);
        push_raw(L, host + 1, "params");
        if (const auto set = object_at<lua::ParameterSet>(L, -1)) state.parameters = set->list;
    }
    look_at_scene(state);
    state.hand = hand(host);
    state.camera = std::exchange(camera_, std::nullopt);
    state.up = std::exchange(up_, std::nullopt);
    lua_settop(L, top);
    return state;
}

}  // namespace lissom::window
