#include "bindings/c/script/host.h"

#include <optional>
#include <string_view>

#include "bindings/c/script_host.h"
#include "bindings/lua/core/error_object.h"
#include "bindings/lua/deform/deform_object.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/host/counted_state.h"

namespace lissom::c {
namespace {

// Instructions between two looks at whether the host has cancelled.
constexpr int kInstructions = 10000;
// Instructions of a finalizer when the state is closed.
constexpr int kFinalInstructions = 10'000'000;

// Keys of Lua's registry: their addresses.
const char kHostKey = 0;

ScriptHost& host_of(lua_State* L) {
    lua::raw_get_pointer(L, LUA_REGISTRYINDEX, &kHostKey);
    auto* host = static_cast<ScriptHost*>(lua_touserdata(L, -1));
    lua_pop(L, 1);
    return *host;
}

void stop_where_cancelled(lua_State* L, lua_Debug*);

void look_for_cancel(lua_State* L) {
    lua_sethook(L, stop_where_cancelled, LUA_MASKCOUNT, kInstructions);
}

// A script that catches the error gets it again at once, until the cancel is cleared.
void stop_where_cancelled(lua_State* L, lua_Debug*) {
    if (!host_of(L).working().cancelled()) {
        if (lua_gethookcount(L) == 1) look_for_cancel(L);
        return;
    }
    lua_sethook(L, stop_where_cancelled, LUA_MASKCALL | LUA_MASKCOUNT, 1);
    lua::drop_handlers(L);
    luaL_error(L, "cancelled [cancelled]");
}

// Ends finalizers that run on while no script runs, or the state is closed: nobody can cancel them.
void end_finalizer(lua_State* L, lua_Debug*) {
    lua_sethook(L, end_finalizer, LUA_MASKCALL | LUA_MASKCOUNT, 1);
    lua::drop_handlers(L);
    luaL_error(L, "a finalizer has run for too long");
}

// print of scripts: to the log of the host.
int print_to_log(lua_State* L) {
    if (lua::find_state(L)->only_help) return 0;
    lua::push_printed(L);
    const auto& options = host_of(L).context().options;
    if (options.log) options.log(options.user, LISSOM_INFO, lua_tostring(L, -1));
    return 0;
}

struct Opening {
    ScriptHost* host;
    const lua::HostOptions* options;
    lua::Stoppable* stoppable;
};

// Runs in protected mode.
int prepare_state(lua_State* L) {
    const auto* opening = static_cast<const Opening*>(lua_touserdata(L, 1));
    luaL_openlibs(L);
    lua_gc(L, LUA_GCGEN, 0, 0);
    lua_pushlightuserdata(L, opening->host);
    lua::raw_set_pointer(L, LUA_REGISTRYINDEX, &kHostKey);
    lua_pushcfunction(L, print_to_log);
    lua_setglobal(L, "print");
    lua_getglobal(L, "os");
    lua_pushcfunction(L, lua::refuse_exit);
    lua_setfield(L, -2, "exit");
    lua::open(L, *opening->options);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, "lissom");
    opening->stoppable->open(L);
    opening->stoppable->open_finalizers(L);
    look_for_cancel(L);
    return 0;
}

// The rest is that of the context itself, which takes the place of the state's own.
ContextOptions state_options(lissom_context& context) {
    ContextOptions options;
    const lissom_context_options& host = context.options;
    options.threads = host.threads;
    options.memory = context.kernel.memory();
    options.files = context.kernel.files();
    if (host.log) {
        options.log = [&host](LogLevel level, std::string_view message) {
            host.log(host.user, static_cast<lissom_log_level>(level), std::string(message).c_str());
        };
    }
    return options;
}

}  // namespace

LuaReference::~LuaReference() {
    if (const auto own = host.lock()) luaL_unref(own->lua(), LUA_REGISTRYINDEX, reference);
}

ScriptHost::~ScriptHost() {
    context_.message_counter = nullptr;
    if (!L_ || sandbox_) return;
    lua_sethook(L_, end_finalizer, LUA_MASKCOUNT, kFinalInstructions);
    lua_close(L_);
}

void ScriptHost::open_sandbox(lua::SandboxLimits limits) {
    require(!sandbox_,
            "this context has its sandbox already; make another context for other limits");
    require(!L_, "scripts have run in this context already; make another context for the sandbox");
    lua::HostOptions options;
    options.context = state_options(context_);
    auto made = std::make_unique<lua::Sandbox>(
        std::move(limits), std::move(options), [this](std::string_view text) {
            const auto& host = context_.options;
            const std::string line(text.substr(0, text.size() - 1));
            if (host.log) host.log(host.user, LISSOM_INFO, line.c_str());
        });
    made->work_in(context_.kernel);
    sandbox_ = std::move(made);
    L_ = sandbox_->lua();
    context_.message_counter = this;
}

bool ScriptHost::count(LogLevel level, std::size_t bytes) noexcept {
    return level != LogLevel::warning || sandbox_->count_shown(bytes);
}

int ScriptHost::call(int arguments, int results) {
    if (sandbox_) return sandbox_->call(arguments, results);
    lua_State* L = lua();
    look_for_cancel(L);
    const int status = lua_pcall(L, arguments, results, 0);
    // While the cancel lasts, it ends the finalizers of what the script leaves over too.
    look_for_cancel(L);
    if (working().cancelled()) lua_gc(L, LUA_GCCOLLECT, 0);
    // The host reads results and messages by calls that nothing protects, and that run no code of
    // Lua but finalizers.
    lua_sethook(L, end_finalizer, LUA_MASKCOUNT, kFinalInstructions);
    return status;
}

void ScriptHost::work_in(const Context& context) {
    working_ = context;
    if (sandbox_) return sandbox_->work_in(context);
    lua::find_state(lua())->context = context;
    stoppable_.follow(context);
}

std::vector<Held> ScriptHost::known_objects() {
    std::vector<Held> known;
    context_.objects.for_each([&](std::uint64_t id, ObjectTable::Object& object) {
        if (object.scripted) known.emplace_back(id, object.kind);
    });
    return known;
}

lua_State* ScriptHost::lua() {
    if (L_) return L_;
    lua::OwnedState state(lua_newstate(lua::allocate_counted, context_.kernel.memory().get()));
    lua_State* L = state.get();
    if (!L) throw Error(ErrorCode::memory_limit, "there is not enough memory for a Lua state");
    lua::HostOptions options;
    options.context = state_options(context_);
    Opening opening{this, &options, &stoppable_};
    lua_pushcfunction(L, prepare_state);
    lua_pushlightuserdata(L, &opening);
    if (lua_pcall(L, 1, 0, 0) != LUA_OK) {
        const char* text = lua_tostring(L, -1);
        throw Error(ErrorCode::memory_limit, text ? text : "the Lua state cannot be opened");
    }
    // Operations of scripts are those of the context: its cancel, progress and memory.
    lua::find_state(L)->context = context_.kernel;
    stoppable_.follow(context_.kernel);
    L_ = state.release();
    return L_;
}

// ---- Objects

namespace {

// Forgets dead objects, before there are many of them.
template <typename Map>
void forget_expired(Map& map, std::size_t alive) {
    if (map.size() < 2 * alive + 64) return;
    std::erase_if(map, [](const auto& entry) { return entry.second.expired(); });
}

}  // namespace

void ScriptHost::keep(const void* content, const std::shared_ptr<void>& object) {
    forget_expired(around_, context_.objects.size());
    around_[content] = object;
}

Sharing ScriptHost::sharing() {
    Sharing sharing;
    sharing.make_mesh = [this](Mesh&& mesh) {
        const auto object = std::make_shared<lua::MeshObject>(std::move(mesh));
        keep(&object->mesh, object);
        return std::shared_ptr<Mesh>(object, &object->mesh);
    };
    sharing.make_strands = [this](Strands&& strands) {
        const auto object = std::make_shared<lua::StrandsObject>(std::move(strands));
        keep(&object->strands, object);
        return std::shared_ptr<Strands>(object, &object->strands);
    };
    sharing.changed = [this](const Mesh& mesh) {
        if (const auto object = known<lua::MeshObject>(&mesh)) object->changed();
    };
    sharing.belongs = [this](const void* object, const Mesh& mesh) {
        forget_expired(owners_, context_.objects.size());
        owners_[object] = known<lua::MeshObject>(&mesh);
    };
    return sharing;
}

template <typename T>
std::shared_ptr<T> ScriptHost::known(const void* content) {
    const auto found = around_.find(content);
    return found == around_.end() ? nullptr : std::static_pointer_cast<T>(found->second.lock());
}

namespace {

// Runs in protected mode.
int make_reference(lua_State* L) {
    lua_pushinteger(L, luaL_ref(L, LUA_REGISTRYINDEX));
    return 1;
}

// Keeps the value at `index` in Lua's registry.
int reference_to(lua_State* L, int index) {
    index = lua_absindex(L, index);
    lua_pushcfunction(L, make_reference);
    lua_pushvalue(L, index);
    const bool made = lua_pcall(L, 1, 1, 0) == LUA_OK;
    const int reference = made ? static_cast<int>(lua_tointeger(L, -1)) : LUA_NOREF;
    lua_pop(L, 1);
    require(made, "there is no memory left for a handle", ErrorCode::memory_limit);
    return reference;
}

[[noreturn]] void refuse_without_mesh() {
    throw StatusError(
        LISSOM_INVALID_HANDLE,
        "the mesh that the object belongs to was released, or has another topology by "
        "now");
}

}  // namespace

std::shared_ptr<lua::MeshObject> ScriptHost::mesh_of_region(const Region& region) {
    std::shared_ptr<lua::MeshObject> owner;
    context_.objects.for_each([&](std::uint64_t, ObjectTable::Object& object) {
        if (owner || object.kind != Kind::mesh) return;
        const auto* mesh = static_cast<const Mesh*>(object.content.get());
        if (mesh->shared_topology() == region.topology()) owner = known<lua::MeshObject>(mesh);
    });
    if (!owner) refuse_without_mesh();
    return owner;
}

std::shared_ptr<lua::MeshObject> ScriptHost::mesh_of_object(const void* content) {
    const auto found = owners_.find(content);
    auto owner = found == owners_.end() ? nullptr : found->second.lock();
    if (!owner) refuse_without_mesh();
    return owner;
}

std::shared_ptr<void> ScriptHost::object_of(Kind kind, const std::shared_ptr<void>& content) {
    if (auto object = known<void>(content.get())) return object;
    std::shared_ptr<void> made;
    if (kind == Kind::region) {
        const Region& region = *std::static_pointer_cast<Region>(content);
        return std::make_shared<lua::RegionObject>(mesh_of_region(region), region);
    }
    if (kind == Kind::deformer) {
        made = std::make_shared<lua::DeformObject>(mesh_of_object(content.get()),
                                                   std::static_pointer_cast<Deformer>(content));
    } else {
        made = std::make_shared<lua::HairstyleObject>(mesh_of_object(content.get()),
                                                      std::static_pointer_cast<Hairstyle>(content));
    }
    keep(content.get(), made);
    return made;
}

ScriptObject ScriptHost::holder_of(std::uint64_t id) {
    constexpr std::pair<Kind, const char*> kTypes[] = {
        {Kind::mesh, lua::MeshObject::kTypeName},
        {Kind::region, lua::RegionObject::kTypeName},
        {Kind::deformer, lua::DeformObject::kTypeName},
        {Kind::hairstyle, lua::HairstyleObject::kTypeName},
        {Kind::strands, lua::StrandsObject::kTypeName}};
    for (const auto& [kind, name] : kTypes) {
        if (!context_.objects.find(id, kind)) continue;
        context_.objects.find(id, kind)->scripted = true;
        return {name, object_of(kind, context_.share<void>(id, kind))};
    }
    throw StatusError(
        LISSOM_INVALID_HANDLE,
        "the handle names no object that scripts know: it was released, or is a merger "
        "or a paste");
}

std::uint64_t ScriptHost::known_handle(Kind kind, const void* content) {
    std::uint64_t known = 0;
    context_.objects.for_each([&](std::uint64_t id, ObjectTable::Object& object) {
        if (object.kind == kind && object.content.get() == content) known = id;
    });
    return known;
}

std::uint64_t ScriptHost::handle_of(int index) {
    const lua::Holder* found = lua::find_holder(lua(), index, nullptr);
    if (!found || !found->object) {
        throw Error(ErrorCode::invalid_argument, "a result is closed, or no object of the library");
    }
    const std::string_view type = found->type_name;
    const auto handle = [&](Kind kind, std::shared_ptr<void> content) {
        if (const std::uint64_t known = known_handle(kind, content.get())) {
            context_.objects.find(known, kind)->scripted = true;
            return known;
        }
        keep(content.get(), found->object.shared());
        return add_handle(kind, std::move(content));
    };
    if (type == lua::MeshObject::kTypeName) {
        const auto object = std::static_pointer_cast<lua::MeshObject>(found->object.shared());
        return handle(Kind::mesh, {object, &object->mesh});
    }
    if (type == lua::RegionObject::kTypeName) {
        const auto object = std::static_pointer_cast<lua::RegionObject>(found->object.shared());
        return handle(Kind::region, {object, &object->region});
    }
    if (type == lua::StrandsObject::kTypeName) {
        const auto object = std::static_pointer_cast<lua::StrandsObject>(found->object.shared());
        return handle(Kind::strands, {object, &object->strands});
    }
    if (type == lua::DeformObject::kTypeName) {
        const auto object = std::static_pointer_cast<lua::DeformObject>(found->object.shared());
        return handle(Kind::deformer, {object, &object->deformer()});
    }
    if (type == lua::HairstyleObject::kTypeName) {
        const auto object = std::static_pointer_cast<lua::HairstyleObject>(found->object.shared());
        return handle(Kind::hairstyle, {object, &object->style()});
    }
    auto reference = std::make_shared<LuaReference>();
    reference->host = weak_from_this();
    reference->reference = reference_to(lua(), index);
    return add_handle(Kind::object, std::move(reference));
}

namespace {

// An object that is not in Lua yet.
struct NewObject {
    lua::State* state;
    const char* type;
    const std::shared_ptr<void>* object;
};

// Protected: (NewObject*). Returns its userdata.
int push_new_object(lua_State* L) {
    const auto* given = static_cast<const NewObject*>(lua_touserdata(L, 1));
    // In a statement of its own: a Lua error there would leave a copy of the object behind.
    lua::Holder* const holder = lua::push_holder(L, *given->state, given->type, 0);
    holder->object = *given->object;
    return 1;
}

}  // namespace

std::uint64_t ScriptHost::add_object(const char* type, const std::shared_ptr<void>& object) {
    lua_State* L = lua();
    NewObject given{&binding(), type, &object};
    lua_pushcfunction(L, push_new_object);
    lua_pushlightuserdata(L, &given);
    const bool made = lua_pcall(L, 1, 1, 0) == LUA_OK;
    auto reference = std::make_shared<LuaReference>();
    reference->host = weak_from_this();
    if (made) reference->reference = reference_to(L, -1);
    lua_pop(L, 1);
    require(made, "there is no memory left for an object", ErrorCode::memory_limit);
    const std::uint64_t id = context_.add(Kind::object, std::move(reference));
    context_.objects.find(id, Kind::object)->scripted = true;
    return id;
}

std::shared_ptr<void> ScriptHost::object_of_type(std::uint64_t id, const char* type) {
    const auto reference = context_.share<LuaReference>(id, Kind::object);
    lua_State* L = lua();
    lua_rawgeti(L, LUA_REGISTRYINDEX, reference->reference);
    const lua::Holder* found = lua::find_holder(L, -1, nullptr);
    lua_pop(L, 1);
    const bool fits = found && std::string_view(found->type_name) == type;
    return fits ? found->object.shared() : nullptr;
}

std::uint64_t ScriptHost::add_handle(Kind kind, std::shared_ptr<void> content) {
    new_handles_.push_back(0);
    const std::uint64_t id = context_.add(kind, std::move(content));
    context_.objects.find(id, kind)->scripted = true;
    return new_handles_.back() = id;
}

void ScriptHost::drop_new_handles() noexcept {
    for (const std::uint64_t id : new_handles_) context_.objects.release(id);
    new_handles_.clear();
}

ScriptHost& scripts_of(lissom_context& context) {
    if (context.scripts->busy()) {
        throw StatusError(LISSOM_BUSY, "a job runs a script in this context; finish the job first");
    }
    return *context.scripts;
}

namespace {

// An error of Lua as plain data.
struct LuaError {
    bool is_object = false;
    lua::Failure failure;
    // With its place and code.
    std::string text;
};

// Protected: (LuaError*, error).
int read_lua_error(lua_State* L) {
    auto* error = static_cast<LuaError*>(lua_touserdata(L, 1));
    error->is_object = lua::is_error_object(L, 2);
    if (error->is_object) lua::read_error(L, 2, error->failure);
    const bool has_text = error->is_object || lua_type(L, 2) == LUA_TSTRING;
    const char* text = has_text ? lua::push_error_text(L, 2) : "the error is no text";
    // Exceptions must not pass through Lua.
    lua::Failure lost;
    if (!lost.guard([&] { error->text = text; })) return luaL_error(L, "%s", lost.message);
    return 0;
}

LuaError error_at_top(lua_State* L) {
    LuaError error;
    lua_pushcfunction(L, read_lua_error);
    lua_insert(L, -2);
    lua_pushlightuserdata(L, &error);
    lua_insert(L, -2);
    if (lua_pcall(L, 2, 0, 0) != LUA_OK) error.text = "not enough memory";
    return error;
}

// The code in brackets at the end of a message.
std::optional<ErrorCode> code_in(std::string_view message) {
    const std::size_t open = message.rfind('[');
    if (open == std::string_view::npos || !message.ends_with(']')) return std::nullopt;
    const std::string_view name = message.substr(open + 1, message.size() - open - 2);
    for (const ErrorCode code : all_codes()) {
        if (code_name(code) == name) return code;
    }
    return std::nullopt;
}

bool passes_scripts(ErrorCode code) {
    return code == ErrorCode::cancelled || code == ErrorCode::memory_limit;
}

}  // namespace

void throw_lua_error(lua_State* L, lissom_status status) {
    const LuaError error = error_at_top(L);
    const lua::Failure& failure = error.failure;
    const bool of_script = status == LISSOM_SCRIPT_ERROR;
    Elements elements{failure.kind, failure.count, {}};
    elements.ids.assign(failure.ids, failure.ids + failure.id_count);
    if (error.text == "not enough memory") {
        throw Error(ErrorCode::memory_limit,
                    "a script needs more memory than the context has left");
    }
    if (error.is_object && !of_script) throw Error(failure.code, failure.message, elements);
    const std::optional<ErrorCode> code = error.is_object ? failure.code : code_in(error.text);
    if (code && (!of_script || passes_scripts(*code))) throw Error(*code, error.text, elements);
    throw StatusError(status, error.text, elements);
}

void connect_scripts(lissom_context& context) {
    const auto host = std::make_shared<ScriptHost>(context);
    context.sharing = host->sharing();
    context.scripts = host;
}

}  // namespace lissom::c

extern "C" bool lissom_has_scripts(void) {
    return true;
}
