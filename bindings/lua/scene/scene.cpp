// lissom.scene: Scene.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/scene/scene_object.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

// ---- lissom.scene

int make_scene(Call& call) {
    const double bytes = call.number("history");
    const auto result = call.create<SceneObject>();
    const bool done = call.attempt_quick([&] {
        SceneOptions given;
        given.history_bytes = static_cast<std::size_t>(bytes);
        given.account = call.context().memory();
        result.set(std::make_shared<SceneObject>(given));
    });
    return done ? 1 : call.fail();
}

// ---- Objects

// The object called `name`; hints at the nearest name if there is none.
const NamedObject& object_called(const Scene& scene, const char* name) {
    if (const NamedObject* found = scene.find(name)) return *found;
    std::vector<std::string_view> names;
    for (const auto& object : scene.objects()) names.push_back(object->name);
    throw Error(ErrorCode::out_of_range,
                std::string("the scene has no object '") + name + "'" + name_hint(name, names));
}

// Runs work(Scene&), which changes the scene of a method, and returns that.
template <typename Work>
int change_scene(Call& call, const Work& work) {
    const auto self = call.self<SceneObject>();
    if (!call.attempt_quick([&] { work(self->scene); })) return call.fail();
    call.charge(self);
    return call.push_argument();
}

int add_object(Call& call) {
    const auto self = call.self<SceneObject>();
    const char* name = call.string("name");
    const ItemArgument object = ItemArgument::read(call, 3);
    object.remember(call);
    const bool done =
        call.attempt_quick([&] { self->scene.add(name, object.item(), changed_look(call, {})); });
    if (!done) return call.fail();
    call.charge(self);
    return call.push_argument(object.index);
}

// The item is held, for a collection while it is pushed may remove it.
int get_object(Call& call) {
    const auto self = call.self<SceneObject>();
    const char* name = call.string("name");
    auto& held = call.hold<std::shared_ptr<SceneItem>>();
    const ScriptItem* item = nullptr;
    const bool found = call.attempt_quick([&] {
        held = object_called(self->scene, name).item;
        item = dynamic_cast<const ScriptItem*>(held.get());
        require(item, "this object belongs to the host", ErrorCode::unsupported);
    });
    return found ? item->push(call) : call.fail();
}

int remove_object(Call& call) {
    const char* name = call.string("name");
    return change_scene(call, [&](Scene& scene) { scene.remove(object_called(scene, name).id); });
}

int rename_object(Call& call) {
    const char* name = call.string("name");
    const char* new_name = call.string("new_name");
    return change_scene(
        call, [&](Scene& scene) { scene.rename(object_called(scene, name).id, new_name); });
}

int move_object(Call& call) {
    const char* name = call.string("name");
    const Index place = call.id("place");
    return change_scene(call,
                        [&](Scene& scene) { scene.reorder(object_called(scene, name).id, place); });
}

int set_object(Call& call) {
    const char* name = call.string("name");
    return change_scene(call, [&](Scene& scene) {
        const NamedObject& object = object_called(scene, name);
        scene.set_look(object.id, changed_look(call, object.look));
    });
}

int object_info(Call& call) {
    const auto self = call.self<SceneObject>();
    const char* name = call.string("name");
    const NamedObject* object = nullptr;
    if (!call.attempt_quick([&] { object = &object_called(self->scene, name); })) {
        return call.fail();
    }
    return push_entry(call, *object);
}

int object_names(Call& call) {
    const ObjectList& objects = call.self<SceneObject>()->scene.objects();
    return push_list(call, objects,
                     [&](const auto& object) { call.push(std::string_view(object->name)); });
}

// ---- Steps

// Refuses to end a step that a running scene:step has opened.
void require_own_step(const SceneObject& self) {
    require(self.scene.depth() != self.step_depth || self.step_depth == 0,
            "the step that runs ends with its function; here is none of its own to end");
}

int begin_step(Call& call) {
    const char* name = call.string("name");
    return change_scene(call, [&](Scene& scene) { scene.begin(name); });
}

int commit_step(Call& call) {
    const auto self = call.self<SceneObject>();
    bool changed = false;
    const bool done = call.attempt_quick([&] {
        require_own_step(*self);
        changed = self->scene.commit();
    });
    if (!done) return call.fail();
    call.charge(self);
    return call.push(changed);
}

int roll_back_step(Call& call) {
    const auto self = call.self<SceneObject>();
    return change_scene(call, [&](Scene& scene) {
        require_own_step(*self);
        scene.rollback();
    });
}

// Ends the step at `depth` that a function ran in; if that failed, or left a step open, all changes
// since are taken back.
bool end_run(Call& call, Scene& scene, std::size_t depth, bool failed) {
    return call.attempt_quick([&] {
        const auto roll_back = [&] {
            while (scene.depth() > depth) scene.rollback();
        };
        if (failed) return roll_back();
        try {
            require(scene.depth() == depth + 1,
                    "the function of a step began a step and did not end it");
            scene.commit();
        } catch (...) {
            roll_back();
            throw;
        }
    });
}

// The scene is held, for the function may close it.
int run_step(Call& call) {
    const auto self = call.self<SceneObject>();
    lua_State* L = call.lua();
    const char* name = call.string("name");
    auto& held = call.hold<std::shared_ptr<SceneObject>>();
    const bool began = call.attempt_quick([&] {
        held = self.share();
        held->scene.begin(name);
    });
    if (!began) return call.fail();
    const std::size_t depth = held->scene.depth() - 1, outer = held->step_depth;
    held->step_depth = depth + 1;
    const int top = lua_gettop(L);
    lua_pushvalue(L, call.stack_index("action"));
    const int status = lua_pcall(L, 0, LUA_MULTRET, 0);
    held->step_depth = outer;
    if (!end_run(call, held->scene, depth, status != 0)) return call.fail();
    if (status != 0) return lua_error(L);
    if (self.get()) call.charge(self);
    return lua_gettop(L) - top;
}

int step_depth(Call& call) {
    return call.push_count(call.self<SceneObject>()->scene.depth());
}

// The name of the step that `move` undid or did again, or nil.
template <typename Move>
int move_in_history(Call& call, const Move& move) {
    const auto self = call.self<SceneObject>();
    auto& name = call.hold<std::optional<std::string>>();
    if (!call.attempt_quick([&] { name = move(self->scene); })) return call.fail();
    if (name) return call.push(std::string_view(*name));
    lua_pushnil(call.lua());
    return 1;
}

int undo_step(Call& call) {
    return move_in_history(call, [](Scene& scene) { return scene.undo(); });
}

int redo_step(Call& call) {
    return move_in_history(call, [](Scene& scene) { return scene.redo(); });
}

int scene_history(Call& call) {
    const auto self = call.self<SceneObject>();
    auto& report = call.hold<HistoryReport>();
    if (!call.attempt_quick([&] { report = self->scene.history(); })) return call.fail();
    lua_State* L = call.lua();
    lua_createtable(L, count_of(report.steps), 4);
    for (std::size_t i = 0; i < report.steps.size(); ++i) {
        lua_createtable(L, 0, 2);
        call.set_field("name", call.push(std::string_view(report.steps[i].name)));
        call.set_field("bytes", call.push_count(report.steps[i].bytes));
        lua_rawseti(L, -2, index_of(i) + 1);
    }
    call.set_field("place", call.push_count(report.place));
    call.set_field("bytes", call.push_count(report.bytes));
    call.set_field("limit", call.push_count(report.limit));
    call.set_field("dropped", call.push_count(report.dropped));
    return 1;
}

int clear_history(Call& call) {
    return change_scene(call, [](Scene& scene) { scene.clear_history(); });
}

int scene_hash(Call& call) {
    const auto self = call.self<SceneObject>();
    std::uint64_t value = 0;
    if (!call.attempt_quick([&] { value = self->scene.hash(); })) return call.fail();
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return call.push(text);
}

int scene_length(Call& call) {
    return call.push_count(call.self<SceneObject>()->scene.objects().size());
}

int scene_text(Call& call) {
    const auto self = call.self<SceneObject>();
    lua_pushfstring(call.lua(), "lissom.Scene: %d objects, %d steps",
                    count_of(self->scene.objects()), count_of(self->scene.history().steps));
    return 1;
}

// ---- Descriptions

const std::string kBarScene = R"(local scene = lissom.scene{}
local bar = scene:add("bar", lissom.shapes.bar())
)";

const std::vector<Result> kSceneSelf = {{"lissom.Scene", "scene", "The scene itself."}};

Parameter name_argument() {
    return string("name", "The name of the object.");
}

std::vector<Function> object_methods() {
    return {
        {.name = "add",
         .body = add_object,
         .summary = "Adds an object under a name, behind all others. The scene holds the object "
                    "itself, not a copy: changes of the object show in the scene.",
         .arguments = {string("name", "A name that no object of the scene has."),
                       item_argument("object", "The object to add.")},
         .options = look_fields(),
         .results = {{"any", "object", "The object."}},
         .effect = Effect::changes,
         .errors = {ErrorCode::invalid_argument, ErrorCode::singular_transform,
                    ErrorCode::memory_limit},
         .example = kBarScene + R"(bar:transform{ scale = 2 }
assert(scene:get("bar") == bar))"},
        {.name = "get",
         .body = get_object,
         .summary = "The object of a name.",
         .arguments = {name_argument()},
         .results = {{"any", "object", "The very object that was added."}},
         .errors = {ErrorCode::out_of_range},
         .example = kBarScene + R"(assert(scene:get("bar"):vertex_count() == #bar)
assert(not lissom.try(scene.get, scene, "ball")))"},
        {.name = "info",
         .body = object_info,
         .summary = "Number, kind, place and look of an object.",
         .arguments = {name_argument()},
         .results = {{"lissom.SceneEntry", "entry", "A table of its own."}},
         .errors = {ErrorCode::out_of_range},
         .example = kBarScene + R"(assert(scene:info("bar").kind == "mesh"))"},
        {.name = "names",
         .body = object_names,
         .summary = "The names of all objects, in their order.",
         .results = {{"string[]", "names", "A list."}},
         .example = kBarScene + R"(assert(scene:names()[1] == "bar"))"},
        {.name = "remove",
         .body = remove_object,
         .summary = "Takes an object out of the scene. The object itself lives on.",
         .arguments = {name_argument()},
         .results = kSceneSelf,
         .errors = {ErrorCode::out_of_range, ErrorCode::memory_limit},
         .example = kBarScene + R"(scene:remove("bar")
assert(#scene == 0 and scene:undo() == "remove bar"))"},
        {.name = "rename",
         .body = rename_object,
         .summary = "Gives an object another name.",
         .arguments = {name_argument(), string("new_name", "A name that no other object has.")},
         .results = kSceneSelf,
         .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument, ErrorCode::memory_limit},
         .example = kBarScene + R"(scene:rename("bar", "beam")
assert(scene:get("beam") == bar))"},
        {.name = "move",
         .body = move_object,
         .summary = "Gives an object another place in the order.",
         .arguments = {name_argument(), id("place", "Its place; 1 is the first.")},
         .results = kSceneSelf,
         .errors = {ErrorCode::out_of_range, ErrorCode::memory_limit},
         .example = kBarScene + R"(scene:add("box", lissom.shapes.box())
scene:move("box", 1)
assert(scene:names()[1] == "box"))"},
        {.name = "set",
         .body = set_object,
         .summary = "Changes an object's place and style; options that are left out stay.",
         .arguments = {name_argument()},
         .options = look_fields(),
         .results = kSceneSelf,
         .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument,
                    ErrorCode::singular_transform, ErrorCode::memory_limit},
         .example =
             kBarScene +
             R"(scene:set("bar", { visible = false, style = { wire = true, color = "#3366cc" } })
assert(not scene:info("bar").visible))"}};
}

std::vector<Function> step_methods() {
    const std::vector<ErrorCode> history_errors = {ErrorCode::invalid_argument,
                                                   ErrorCode::memory_limit};
    const std::vector<Result> step_name = {
        {"string|nil", "name", "The name of the step; nil if there is none."}};
    return {
        {.name = "step",
         .body = run_step,
         .summary =
             "Runs a function whose changes of the scene and its objects are one step, which undo "
             "takes back. After an error in it the scene and its objects are as they were, and the "
             "error goes on. A step inside a step becomes part of that. The function cannot yield; "
             "in a coroutine use begin and commit.",
         .arguments = {string("name", "Its name for undo."),
                       function("action", "fun(): any", "The function to run.")},
         .results = {{"any", "...", "The results of the function."}},
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + R"(local before = scene:hash()
scene:step("grow", function() bar:transform{ scale = 2 } end)
scene:undo()
assert(scene:hash() == before))"},
        {.name = "begin",
         .body = begin_step,
         .summary = "Opens a step, for instance when a drag begins; commit or rollback ends it.",
         .arguments = {string("name", "Its name for undo.")},
         .results = kSceneSelf,
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + R"(scene:begin("drag")
for i = 1, 10 do bar:transform{ translate = { 0.1, 0, 0 } } end
scene:commit()
assert(scene:undo() == "drag"))"},
        {.name = "commit",
         .body = commit_step,
         .summary = "Ends the step opened last. A step in which nothing changed is none.",
         .results = {{"boolean", "changed", "Whether anything changed."}},
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + R"(scene:begin("nothing")
assert(not scene:commit()))"},
        {.name = "rollback",
         .body = roll_back_step,
         .summary = "Ends the step opened last and takes back its changes.",
         .results = kSceneSelf,
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + R"(local before = scene:hash()
scene:begin("drag")
bar:transform{ scale = 2 }
scene:rollback()
assert(scene:hash() == before))"},
        {.name = "depth",
         .body = step_depth,
         .summary = "Number of steps that are open.",
         .results = {{"integer", "depth", "0 outside steps."}},
         .effect = Effect::unheard,
         .example = kBarScene + R"(scene:begin("drag")
assert(scene:depth() == 1)
scene:rollback())"},
        {.name = "undo",
         .body = undo_step,
         .summary = "Takes back the last step: the contents go back into the objects themselves. "
                    "Changes outside a step are a step called \"edited\".",
         .results = step_name,
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + R"(bar:transform{ scale = 2 }
assert(scene:undo() == "edited")
assert(scene:redo() == "edited"))"},
        {.name = "redo",
         .body = redo_step,
         .summary = "Does the step again that was undone last. A new step forgets those that were "
                    "undone.",
         .results = step_name,
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + "scene:undo()\nassert(scene:redo() == 'add bar')"},
        {.name = "history",
         .body = scene_history,
         .summary = "The steps, and their memory.",
         .results = {{"lissom.History", "history", "A table of its own."}},
         .example = kBarScene + R"(local history = scene:history()
assert(#history == 1 and history.place == 1 and history[1].name == "add bar"))"},
        {.name = "clear_history",
         .body = clear_history,
         .summary = "Forgets all steps; the scene stays as it is.",
         .results = kSceneSelf,
         .effect = Effect::unheard,
         .errors = history_errors,
         .example = kBarScene + "assert(not scene:clear_history():undo())"},
        {.name = "hash",
         .body = scene_hash,
         .summary = "Hash of names, order, looks and contents of all objects; the same on every "
                    "machine, whatever led to the scene.",
         .results = {{"string", "hash", "16 hexadecimal digits."}},
         .errors = {ErrorCode::memory_limit},
         .example = kBarScene + R"(local other = lissom.scene{}
other:add("bar", lissom.shapes.bar())
assert(other:hash() == scene:hash()))"}};
}

}  // namespace

Parameter history_option() {
    return number("history",
                  "Memory that its history may take beside one copy of the present content; the "
                  "oldest steps are forgotten beyond it. 0: it has none.")
        .in("bytes")
        .between(0, 1e15)
        .defaults(static_cast<double>(SceneOptions{}.history_bytes));
}

Type scene_type() {
    Type type{.name = "lissom.Scene",
              .summary = "Named objects in an order, with a history of their changes."};
    type.operators = {{"__len", scene_length, "#scene", "number of objects"},
                      {"__tostring", scene_text, "tostring(scene)", "its size"}};
    type.methods = object_methods();
    for (Function& method : step_methods()) type.methods.push_back(std::move(method));
    for (Function& method : scene_file_methods()) type.methods.push_back(std::move(method));
    return type;
}

std::vector<Function> scene_functions() {
    return {load_scene_function(),
            {.name = "scene",
             .body = make_scene,
             .summary = "Makes an empty scene.",
             .options = {history_option()},
             .results = {{"lissom.Scene", "scene", "Give it objects by add."}},
             .errors = {ErrorCode::memory_limit},
             .example = kBarScene + R"(scene:step("bend", function()
    local deformer = lissom.deformer(bar)
    deformer:add_handle(bar:region("bottom"))
    deformer:add_handle(bar:region("top")):rotate{ axis = "z", angle = 60 }
    deformer:solve()
end)
assert(scene:undo() == "bend"))"}};
}

}  // namespace lissom::lua
