// lissom.tool, lissom.tool_host, lissom.replay and the prompts of lissom.pick.
#include "bindings/lua/tools/tools.h"

#include <array>
#include <chrono>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/failure.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/host/script_files.h"
#include "bindings/lua/scene/scene_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/tools/tool_calls.h"
#include "bindings/lua/tools/tool_text.h"
#include "bindings/lua/tools/tool_view.h"
#include "kernel/core/clock.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

constexpr const char* kChunk = "=lissom tools";

// Key of Lua's registry: its address. The functions of the text.
const char kToolFunctions = 0;

struct Piece {
    int next = 0;
};

const char* read_piece(lua_State*, void* state, std::size_t* size) {
    auto* piece = static_cast<Piece*>(state);
    const char* text = kToolText[piece->next];
    if (!text) return nullptr;
    ++piece->next;
    *size = std::strlen(text);
    return text;
}

// From a scene and a depth: the step opened there is ended by the host alone from now on. Returns
// the depth for which that held before.
int guard_step(lua_State* L) {
    Holder* holder = find_holder(L, 1, SceneObject::kTypeName);
    auto* scene = holder ? static_cast<SceneObject*>(holder->object.get()) : nullptr;
    if (!scene) return luaL_error(L, "the scene was closed");
    lua_pushinteger(L, static_cast<lua_Integer>(scene->step_depth));
    scene->step_depth = static_cast<std::size_t>(lua_tointeger(L, 2));
    return 1;
}

// Seconds on a clock that only runs forwards.
int push_seconds(lua_State* L) {
    lua_pushnumber(L, std::chrono::duration<double>(Clock::now().time_since_epoch()).count());
    return 1;
}

// From a name and a list of valid ones: the hint behind an error about it.
int push_name_hint(lua_State* L) {
    Failure failure;
    std::string hint;
    failure.guard([&] {
        std::vector<std::string> names;
        for (int i = 1; i <= static_cast<int>(raw_length(L, 2)); ++i) {
            lua_rawgeti(L, 2, i);
            if (const char* name = lua_tostring(L, -1)) names.emplace_back(name);
            lua_pop(L, 1);
        }
        const char* name = lua_tostring(L, 1);
        hint = name_hint(name ? name : "", {names.begin(), names.end()});
    });
    lua_pushlstring(L, hint.data(), hint.size());
    return 1;
}

// new_error(text, code): an error object, of invalid_argument without a code.
int make_error(lua_State* L) {
    lua_settop(L, 2);
    Failure failure;
    failure.set(ErrorCode::invalid_argument, luaL_checkstring(L, 1));
    push_error(L, failure);
    if (lua_isnil(L, 2)) return 1;
    lua_pushvalue(L, 2);
    lua_setfield(L, -2, "code");
    return 1;
}

// error(text, level) of the text: as Lua's, but for an error object with the place of that level.
int raise_at_level(lua_State* L) {
    const int level = static_cast<int>(luaL_optinteger(L, 2, 1));
    lua_settop(L, 1);
    if (lua_type(L, 1) != LUA_TSTRING || level == 0) return lua_error(L);
    make_error(L);
    luaL_where(L, level);
    std::size_t size = 0;
    const char* place = lua_tolstring(L, -1, &size);
    if (size > 2 && std::strncmp(place, kOwnLuaText, std::strlen(kOwnLuaText)) != 0) {
        lua_pushlstring(L, place, size - 2);
        lua_setfield(L, -3, "place");
    }
    lua_pop(L, 1);
    return lua_error(L);
}

// A field of an event for the text: { kind =, required =, min =, max =, unit =, choices = }.
void push_event_field(lua_State* L, const Parameter& field) {
    lua_createtable(L, 0, 5);
    const char* kind = field.kind == Kind::boolean  ? "boolean"
                       : field.kind == Kind::number ? "number"
                                                    : "string";
    lua_pushstring(L, kind);
    lua_setfield(L, -2, "kind");
    lua_pushboolean(L, field.required ? 1 : 0);
    lua_setfield(L, -2, "required");
    lua_pushnumber(L, field.min);
    lua_setfield(L, -2, "min");
    lua_pushnumber(L, field.max);
    lua_setfield(L, -2, "max");
    lua_pushstring(L, field.unit.c_str());
    lua_setfield(L, -2, "unit");
    if (field.choices.empty()) return;
    lua_createtable(L, count_of(field.choices), 0);
    for (std::size_t i = 0; i < field.choices.size(); ++i) {
        lua_pushstring(L, field.choices[i].c_str());
        lua_rawseti(L, -2, index_of(i) + 1);
    }
    lua_setfield(L, -2, "choices");
}

// { mouse =, wheel =, clock =, key = }: fields by their names, and their names in order.
void push_event_fields(lua_State* L) {
    constexpr std::array kNames{"mouse", "wheel", "clock", "key"};
    lua_createtable(L, 0, 4);
    for (const EventKind kind :
         {EventKind::mouse, EventKind::wheel, EventKind::clock, EventKind::key}) {
        const std::vector<Parameter>& fields = event_fields(kind);
        lua_createtable(L, count_of(fields), count_of(fields));
        for (std::size_t i = 0; i < fields.size(); ++i) {
            lua_pushstring(L, fields[i].name.c_str());
            lua_rawseti(L, -2, index_of(i) + 1);
            push_event_field(L, fields[i]);
            lua_setfield(L, -2, fields[i].name.c_str());
        }
        lua_setfield(L, -2, kNames[static_cast<std::size_t>(kind)]);
    }
}

// Runs the text and keeps its results.
void load_tool_functions(lua_State* L) {
    Piece piece;
#if LUA_VERSION_NUM >= 502
    const int status = lua_load(L, read_piece, &piece, kChunk, "t");
#else
    const int status = lua_load(L, read_piece, &piece, kChunk);
#endif
    if (status != 0) lua_error(L);
    open(L, find_state(L)->host);
    lua_pushcfunction(L, hear_calls);
    lua_pushcfunction(L, guard_step);
    lua_pushcfunction(L, push_seconds);
    lua_pushcfunction(L, load_script_file);
    lua_pushcfunction(L, find_script_file);
    lua_pushcfunction(L, push_name_hint);
    lua_pushcfunction(L, make_error);
    lua_pushcfunction(L, raise_at_level);
    lua_pushcfunction(L, new_tool_view);
    lua_pushcfunction(L, push_tool_marks);
    push_event_fields(L);
    lua_call(L, 12, 1);
    lua_pushvalue(L, -1);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kToolFunctions);
}

// Whether the message on top of the stack begins with the script's place.
bool has_place(lua_State* L) {
    push_place(L);
    const char* place = lua_tostring(L, -1);
    const bool has = *place && std::strncmp(lua_tostring(L, -2), place, std::strlen(place)) == 0;
    lua_pop(L, 1);
    return has;
}

// The error of the text on top of the stack is the script's, whose place stands before it.
[[noreturn]] void raise_here(const Call& call) {
    lua_State* L = call.lua();
    if (lua_type(L, -1) != LUA_TSTRING || has_place(L)) lua_error(L);
    const char* text = lua_tostring(L, -1);
    if (std::strncmp(text, kOwnLuaText, std::strlen(kOwnLuaText)) == 0) {
        const char* end = std::strchr(text + std::strlen(kOwnLuaText), ':');
        if (end && end[1] == ' ') text = end + 2;
    }
    call.raise(text);
}

// Calls the text's function below `count` arguments; its one result stays.
int finish_call(const Call& call, int count) {
    if (lua_pcall(call.lua(), count, 1, 0) != 0) raise_here(call);
    return 1;
}

// Like finish_call, for functions that run tools: their errors have a place already.
int finish_tool_call(const Call& call, int count) {
    lua_call(call.lua(), count, 1);
    return 1;
}

void push_given(const Call& call, const char* path) {
    if (call.has(path)) {
        lua_pushvalue(call.lua(), call.stack_index(path));
    } else {
        lua_pushnil(call.lua());
    }
}

// ---- Tools and hosts

int make_tool(Call& call) {
    push_tool_call(call.lua(), ToolCall::tool);
    push_given(call, "tool");
    return finish_call(call, 1);
}

int load_tool(Call& call) {
    push_tool_call(call.lua(), ToolCall::load_tool);
    call.push(call.string("name"));
    return finish_call(call, 1);
}

// The option table that a function was called with, which stands behind its arguments.
int make_host(Call& call) {
    push_tool_call(call.lua(), ToolCall::host);
    lua_pushvalue(call.lua(), 1);
    return finish_tool_call(call, 1);
}

// Pushes the path of the script that has called, or nil, and its folder with its separator, or "".
void push_script_place(lua_State* L) {
    constexpr int kDeepest = 10;
    lua_Debug frame;
    for (int level = 1; level < kDeepest && lua_getstack(L, level, &frame) != 0; ++level) {
        lua_getinfo(L, "S", &frame);
        if (std::strcmp(frame.what, "C") == 0) continue;
        if (frame.source[0] != '@') break;
        const char* path = frame.source + 1;
        const char* end = path + std::strlen(path);
        while (end != path && !std::strchr("/\\", end[-1])) --end;
        lua_pushstring(L, path);
        lua_pushlstring(L, path, static_cast<std::size_t>(end - path));
        return;
    }
    lua_pushnil(L);
    lua_pushliteral(L, "");
}

int replay(Call& call) {
    lua_State* L = call.lua();
    push_tool_call(L, ToolCall::replay);
    lua_pushvalue(L, 1);
    lua_createtable(L, 0, 4);
    push_script_place(L);
    lua_setfield(L, -3, "folder");
    lua_setfield(L, -2, "path");
    for (const char* name : {"scene", "tools"}) {
        if (!call.has(name)) continue;
        lua_getfield(L, 2, name);
        lua_setfield(L, -2, name);
    }
    return finish_tool_call(call, 2);
}

// ---- Prompts: each yields a request, which its host answers.

constexpr std::array kPickKinds{"point", "vertex", "face", "edge", "boundary", "object"};

// Pixels from the cursor within which a click answers.
constexpr double kVertexRadius = 30.0, kRadius = 16.0;

void push_request(const Call& call, const char* kind) {
    if (lua_pushthread(call.lua()) == 1) {
        call.raise("lissom.pick asks a hand, inside the run function of a tool");
    }
    lua_createtable(call.lua(), 0, 5);
    call.set_field("kind", call.push(kind));
    call.set_field("prompt", call.push(call.string("prompt")));
}

template <std::size_t Kind>
int ask_for_place(Call& call) {
    push_request(call, kPickKinds[Kind]);
    const bool is_vertex = std::strcmp(kPickKinds[Kind], "vertex") == 0;
    call.set_field("radius", call.push(is_vertex ? kVertexRadius : kRadius));
    call.set_field("optional", call.push(call.boolean("optional")));
    if (call.has("object")) call.set_field("object", call.push(call.string("object")));
    return lua_yield(call.lua(), 1);
}

int ask_for_number(Call& call) {
    push_request(call, "number");
    if (call.has("default")) call.set_field("default", call.push(call.number("default")));
    return lua_yield(call.lua(), 1);
}

int ask_for_consent(Call& call) {
    push_request(call, "confirm");
    return lua_yield(call.lua(), 1);
}

// ---- Descriptions

const std::string kHostExample = R"(local scene = lissom.scene{}
scene:add("ball", lissom.shapes.sphere())
local camera = lissom.camera{ eye = { 0, 0, 5 } }
)";

Parameter prompt_field() {
    return string("prompt", "The question to the person, in a line.");
}

template <std::size_t Kind>
Function place_prompt(const std::string& help) {
    const std::string kind = kPickKinds[Kind];
    return {.name = "pick." + kind,
            .body = ask_for_place<Kind>,
            .summary = "Asks for " + help +
                       " and waits for a click there, inside the run function of a tool.",
            .options = {prompt_field(),
                        boolean("optional", "The Enter key answers too, with nil.").defaults(false),
                        string("object", "Only on the object of the scene with this name.")
                            .optional("any")},
            .results = {{"lissom.PickHit?", "hit",
                         "The clicked element; for a boundary it has the Boundary too, "
                         "`boundary`."}},
            .example = kHostExample + "local asked\n" + R"(local tool = lissom.tool{ name = "ask",
    run = function() asked = lissom.pick.)" +
                       kind +
                       R"({ prompt = "Click", optional = true } or "none" end }
lissom.tool_host{ scene = scene, camera = camera, tool = tool }:key{ key = "enter" }
assert(asked == "none"))"};
}

std::vector<Function> prompt_functions() {
    return {place_prompt<0>("a point of a surface"),
            place_prompt<1>("a vertex"),
            place_prompt<2>("a face"),
            place_prompt<3>("an edge"),
            place_prompt<4>("an open boundary"),
            place_prompt<5>("an object"),
            {.name = "pick.number",
             .body = ask_for_number,
             .summary = "Asks for a number, which is typed and ended by Enter.",
             .options = {prompt_field(),
                         number("default", "The value of Enter alone.").optional("none")},
             .results = {{"number", "number", "The typed number."}},
             .example = kHostExample + R"(local width
local tool = lissom.tool{ name = "ask", run = function()
    width = lissom.pick.number{ prompt = "Width?" }
end }
lissom.tool_host{ scene = scene, camera = camera, tool = tool }:type("2.5"):key{ key = "enter" }
assert(width == 2.5))"},
            {.name = "pick.confirm",
             .body = ask_for_consent,
             .summary = "Waits for the Enter key.",
             .options = {prompt_field()},
             .results = {{"boolean", "done", "true"}},
             .example = kHostExample + R"(local done
local tool = lissom.tool{ name = "ask", run = function()
    done = lissom.pick.confirm{ prompt = "Enter ends" }
end }
lissom.tool_host{ scene = scene, camera = camera, tool = tool }:key{ key = "enter" }
assert(done))"}};
}

const std::string kPushTool = R"(local tool = lissom.tool{
    name = "push",
    params = { step = { type = "number", default = 0.1 } },
    press = function(self, ev)
        local hit = ev:hit()
        if not hit then return end
        local x, y, z = hit.mesh:position(hit.vertex)
        hit.mesh:set_position(hit.vertex, x, y, z + self.params.step)
    end,
}
)";

std::vector<Parameter> modifier_fields() {
    return {boolean("shift", "Whether this key is down.").optional(),
            boolean("ctrl", "Likewise.").optional(), boolean("alt", "Likewise.").optional()};
}

// Fields before those of the modifiers.
std::vector<Parameter> with_modifiers(std::vector<Parameter> fields) {
    for (Parameter& field : modifier_fields()) fields.push_back(std::move(field));
    return fields;
}

std::vector<Parameter> place_fields() {
    const auto pixels_of = [](const char* name, const char* help) {
        return number(name, help).between(-1e9, 1e9).in("pixels");
    };
    return {pixels_of("x", "From the left edge of the picture."),
            pixels_of("y", "From the top of the picture.")};
}

std::vector<Parameter> mouse_fields() {
    std::vector<Parameter> fields = place_fields();
    fields.push_back(choice("button", {"left", "right", "middle"},
                            "The button, left if it is left out; of a press.")
                         .optional("left"));
    fields.push_back(
        number("pressure", "Of a pen, 0 to 1; 1 if it is left out, as a mouse has none.")
            .between(0, 1)
            .optional("1"));
    fields.push_back(
        boolean("late", "Whether a later place of the same drag is known already; of a move.")
            .optional());
    return with_modifiers(std::move(fields));
}

std::vector<Parameter> wheel_fields() {
    std::vector<Parameter> fields = place_fields();
    fields.push_back(number("lines", "Turn of the wheel: upwards is above 0.").between(-1e6, 1e6));
    return with_modifiers(std::move(fields));
}

std::vector<Parameter> clock_fields() {
    return {number("seconds", "Time since the last tick, or since the press.")
                .in("seconds")
                .between(0, 10)};
}

// Fields of a table for editors.
std::vector<Result> described(const std::vector<Parameter>& fields) {
    std::vector<Result> results;
    for (const Parameter& field : fields) {
        const char* type = field.kind == Kind::boolean  ? "boolean"
                           : field.kind == Kind::number ? "number"
                                                        : "string";
        results.push_back({type + std::string(field.required ? "" : "?"), field.name, field.help});
    }
    return results;
}

std::vector<Result> host_fields() {
    return {
        {"lissom.Scene", "scene", "The scene that the tools work on."},
        {"lissom.Camera", "camera", "The camera that it is seen by."},
        {"integer[]", "size", "{width, height} of the picture in pixels."},
        {"table?", "tool", "The present tool."},
        {"fun(self: any, tool: table?, word: string?): lissom.ToolHost", "use",
         "Another tool, or none; `word` is its word in a recording, if that is not its name."},
        {"fun(self: any, camera: lissom.Camera, size: integer[]?): lissom.ToolHost", "look",
         "Another camera and size of the picture."},
        {"fun(self: any, event: lissom.MouseEvent): lissom.ToolHost", "press",
         "A button went down: a step of the scene begins."},
        {"fun(self: any, event: lissom.MouseEvent): lissom.ToolHost", "move",
         "The cursor moved: a drag while a button is down."},
        {"fun(self: any, event: lissom.MouseEvent): lissom.ToolHost", "release",
         "The button came up: the step ends."},
        {"fun(self: any, event: lissom.MouseEvent): lissom.ToolHost", "click",
         "Press and release."},
        {"fun(self: any, event: lissom.WheelEvent): lissom.ToolHost", "wheel",
         "The wheel turned: part of the gesture while a button is down, else a step of its own."},
        {"fun(self: any, event: lissom.ClockEvent): lissom.ToolHost", "tick",
         "Time passed while a button is down: part of the gesture."},
        {"fun(self: any, event: lissom.KeyEvent): lissom.ToolHost", "key", "A key was pressed."},
        {"fun(self: any, text: string): lissom.ToolHost", "type", "A key for each character."},
        {"fun(self: any, values: table): lissom.ToolHost", "set", "Sets parameters of the tool."},
        {"fun(self: any): lissom.ToolHost", "cancel",
         "Escape: takes the present gesture back; the tool forgets its beginnings."},
        {"fun(self: any): string?", "undo",
         "The scene's undo, which a running gesture only cancels; the name of the step."},
        {"fun(self: any): string?", "redo", "The scene's redo."},
        {"fun(self: any, name: string, visible: boolean): lissom.ToolHost", "show",
         "Shows or hides an object: a step of its own."},
        {"fun(self: any): lissom.ToolMarks", "draw", "Marks of the tool over the picture."},
        {"fun(self: any): string?", "prompt", "The question to the person, or the tool's help."},
        {"fun(self: any, open: string[]?): lissom.ToolHost", "record",
         "Begins a recording, before a tool is used; `open` names the files of the scene."},
        {"fun(self: any): string", "recording",
         "The text of the recording: a script that does all again."},
        {"fun(self: any, open: string[]?): lissom.ToolHost", "keep_journal",
         "Begins a journal: the calls that the tools make; `open` as for record."},
        {"fun(self: any): string", "journal_text",
         "The journal: a script of calls that makes the same scene, to be read and changed."},
        {"fun(self: any): lissom.ToolHost", "recover",
         "Takes back the changes of a tool that was stopped from outside, for instance by a "
         "limit of instructions."}};
}

}  // namespace

const std::vector<Parameter>& event_fields(EventKind kind) {
    static const std::array kFields{
        mouse_fields(), wheel_fields(), clock_fields(),
        with_modifiers({string("key", "\"enter\", \"escape\", \"a\", ...")})};
    return kFields[static_cast<std::size_t>(kind)];
}

void push_tool_functions(lua_State* L) {
    luaL_checkstack(L, LUA_MINSTACK, "no room for tools");
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kToolFunctions);
    if (lua_istable(L, -1)) return;
    lua_pop(L, 1);
    load_tool_functions(L);
}

std::vector<Function> tool_functions() {
    std::vector<Function> functions{
        {.name = "tool",
         .body = make_tool,
         .summary =
             "Makes a tool: functions that are called with a hand's input. press, drag and "
             "release, or run, a coroutine that asks by lissom.pick, of which clicks are the "
             "answers unless press returns true; tick, called about 30 times a second while a "
             "button is down; move, wheel, key, changed (of a parameter), draw, activate, "
             "deactivate, cancel. All take the tool itself and a "
             "lissom.ToolEvent, draw a lissom.ToolView. From press to release is one step of "
             "the scene, any other call is one of its own; after an error the scene is as "
             "before. A release that returns false takes the gesture back, for what is only shown. "
             "drag is called with every place that the hand came to. The table's other "
             "keys are the tool's own.",
         .arguments = {table("tool", "name, help, params (as for lissom.params) and functions.")},
         .results = {{"table", "tool", "The same table; `tool.params` are the values now."}},
         .errors = {ErrorCode::invalid_argument},
         .example = kPushTool + R"(assert(tool.params.step == 0.1))"},
        {.name = "load_tool",
         .body = load_tool,
         .summary = "Reads a tool from its file, each time a new one.",
         .arguments = {string(
             "name",
             "A file that ends with .lua, or the name of one that ships: \"select\", "
             "\"deform\", ... (tools/NAME.lua on package.path).")},
         .results = {{"table", "tool", "The result of the file."}},
         .errors = {ErrorCode::invalid_argument},
         .example = "local _, message = pcall(lissom.load_tool, 'no_such_tool')\n"
                    "assert(tostring(message):find('no_such_tool'))"},
        {.name = "tool_host",
         .body = make_host,
         .summary = "Runs tools without a window: calls them with a hand's input. Errors of a "
                    "tool go on once the scene is as before.",
         .options = {object("scene", "lissom.Scene", "The scene that the tools work on."),
                     object("camera", "lissom.Camera", "The camera that it is seen by."),
                     size_argument(),
                     choice("up", {"y", "z"}, "The axis of the world that points up in views.")
                         .defaults("y"),
                     table("tool", "The first tool.").optional("none")},
         .results = {{"lissom.ToolHost", "host", "Call its methods."}},
         .example = kHostExample + kPushTool + R"(local before = scene:hash()
local host = lissom.tool_host{ scene = scene, camera = camera, tool = tool }
host:click{ x = 640, y = 480 }
assert(scene:hash() ~= before and host:undo() == "push" and scene:hash() == before))"},
        {.name = "replay",
         .body = replay,
         .summary =
             "Repeats a recording, and compares the hash of the scene before it, after each "
             "step and at the end. A recording is a script that calls this; the files that it "
             "names are looked for from its own folder.",
         .arguments = {either("recording",
                              {string("file", "A file of a recording."),
                               table("table", "The argument of lissom.replay in such a file.")},
                              "The recorded events.")},
         .options = {object("scene", "lissom.Scene",
                            "The scene to work on; else the files that the recording names are "
                            "opened.")
                         .optional(),
                     table("tools", "Tools by which those of the same names are replaced: a list.")
                         .optional("none")},
         .results = {{"lissom.Scene", "scene", "The scene as it is then."}},
         .example = kHostExample + kPushTool +
                    R"(local host = lissom.tool_host{ scene = scene, camera = camera }
host:record():use(tool):click{ x = 640, y = 480 }
local text = host:recording():gsub('require%("lissom"%)%.replay', '')
local recorded = assert(load(text))()
host:undo()
assert(lissom.replay(recorded, { scene = scene, tools = { tool } }):hash() == recorded.after))"}};
    for (Function& prompt : prompt_functions()) functions.push_back(std::move(prompt));
    return functions;
}

std::vector<Record> tool_records() {
    return {
        {"lissom.ToolHost", "Calls tools with a hand's input.", host_fields()},
        {"lissom.MouseEvent", "An event of a mouse.", described(event_fields(EventKind::mouse))},
        {"lissom.WheelEvent",
         "Motion of the wheel: part of the gesture while a button is down, else a step of its own.",
         described(event_fields(EventKind::wheel))},
        {"lissom.ClockEvent", "Time that passed while a button is down.",
         described(event_fields(EventKind::clock))},
        {"lissom.KeyEvent", "A key that was pressed.", described(event_fields(EventKind::key))},
        {"lissom.ToolEvent",
         "Argument of a tool's functions.",
         {{"number?", "x", "Pixels from the left edge of the picture."},
          {"number?", "y", "Pixels from its top."},
          {"number[]?", "start", "Pixel at which the button went down, {x, y}."},
          {"string?", "button", "left, right or middle."},
          {"number", "pressure", "Of a pen, 0 to 1; 1 of a mouse."},
          {"string?", "key", "The key, of key."},
          {"number?", "lines", "Turn of the wheel, of wheel: upwards is above 0."},
          {"number?", "seconds", "Time since the last tick, of tick."},
          {"string?", "parameter", "The parameter that was set, of changed."},
          {"boolean", "shift", "Whether this key is down."},
          {"boolean", "ctrl", "Likewise."},
          {"boolean", "alt", "Likewise."},
          {"boolean?", "late",
           "For drag, a later place of the same drag is known already: a slow tool takes this "
           "one, and leaves out marks that only show until then."},
          {"lissom.Camera", "camera", "The camera that the scene is seen by."},
          {"lissom.Scene", "scene", "The scene."},
          {"integer[]", "size", "{width, height} of the picture in pixels."},
          {"\"y\"|\"z\"", "up", "The axis of the world that points up in views."},
          {"fun(self: any): any", "ray", "Origin and direction, as camera:ray."},
          {"fun(self: any): lissom.PickHit?", "hit", "The surface under the cursor."},
          {"fun(self: any, options: table?): lissom.PickHit?", "pick",
           "camera:pick of the scene at the cursor."},
          {"fun(self: any, options: table): lissom.Selected[]", "select",
           "camera:select of the scene."},
          {"fun(self: any, camera: lissom.Camera)", "look",
           "From now on the scene is seen by this camera; no step of the scene."}}},
        {"lissom.ToolMarks",
         "Marks of a tool, as the tables it was drawn with.",
         {{"table[]", "points", "Balls."},
          {"table[]", "lines", "Lines in the world."},
          {"table[]", "labels", "Text at points."},
          {"table[]", "outlines", "Lines in the picture."},
          {"table[]", "circles", "Circles in the picture."},
          {"table[]", "regions", "Coloured vertices."},
          {"table[]", "surfaces", "Surfaces between two lines."},
          {"table[]", "meshes", "Meshes that are not in the scene."}}}};
}

}  // namespace lissom::lua
