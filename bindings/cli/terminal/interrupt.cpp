#include "bindings/cli/terminal/interrupt.h"

#include <atomic>
#include <csignal>
#include <mutex>

#include "bindings/cli/terminal/script_place.h"
#include "bindings/lua/core/compat.h"
#include "bindings/lua/sandbox/stoppable.h"

namespace lissom::cli {
namespace {

// A signal handler takes no argument, so its data belongs to the process.
std::atomic<const Context*> listening_context{nullptr};
std::atomic<lua_State*> running_thread{nullptr};
volatile std::sig_atomic_t pressed_flag = 0, prompt_flag = 0;
// Keeps the target of `press` alive until it returns: a signal handler needs no lock if the work
// runs on the thread that it interrupts.
std::mutex pressing;

// Returns the one before.
lua_State* set_running(lua_State* L) {
    const std::lock_guard lock(pressing);
    return running_thread.exchange(L);
}

// Key of Lua's registry: the message of the first error of an interrupt.
const char kStopped = 0;

// Stays armed until the host's call returns: pcall cannot swallow it for good. All its errors name
// the place of the first.
void stop_script(lua_State* L, lua_Debug*) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kStopped) != LUA_TSTRING) {
        lua_pop(L, 1);
        push_script_place(L, 0);
        lua_pushliteral(L, "cancelled");
        lua_concat(L, 2);
        lua_pushvalue(L, -1);
        lua_rawsetp(L, LUA_REGISTRYINDEX, &kStopped);
    }
    lua::drop_handlers(L);
    lua_error(L);
}

void arm(lua_State* L) {
    lua_sethook(L, stop_script, LUA_MASKCALL | LUA_MASKRET | LUA_MASKLINE | LUA_MASKCOUNT, 1);
}

// Only lock-free stores, and lua_sethook, which Lua's own interpreter calls in a handler too.
void stop_work() {
    pressed_flag = 1;
    if (const Context* context = listening_context.load()) context->cancel();
    if (lua_State* L = running_thread.load()) arm(L);
}

extern "C" void on_interrupt(int signal) {
    if (pressed_flag && !prompt_flag) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
        return;
    }
    std::signal(signal, on_interrupt);
    stop_work();
}

// Calls the function at upvalue 1 with the arguments on the stack while `thread` runs.
int call_in_thread(lua_State* L, lua_State* thread) {
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_State* const before = set_running(thread);
    if (pressed_flag) arm(thread);
    const int status = lua_pcall(L, lua_gettop(L) - 1, LUA_MULTRET, 0);
    set_running(before);
    if (pressed_flag) arm(L);
    return status == LUA_OK ? lua_gettop(L) : lua_error(L);
}

// coroutine.resume; upvalue 1 is Lua's own.
int watched_resume(lua_State* L) {
    lua_State* thread = lua_tothread(L, 1);
    return call_in_thread(L, thread ? thread : L);
}

// A function made by coroutine.wrap (upvalue 1), and its thread (upvalue 2).
int watched_wrapped(lua_State* L) {
    return call_in_thread(L, lua_tothread(L, lua_upvalueindex(2)));
}

// coroutine.wrap; upvalue 1 is Lua's own, whose results keep their thread as upvalue 1.
int watched_wrap(lua_State* L) {
    lua_settop(L, 1);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, 1, 1);
    if (!lua_getupvalue(L, 1, 1)) return 1;
    lua_pushcclosure(L, watched_wrapped, 2);
    return 1;
}

// Replaces a function of the table on top of the stack by one that has it as upvalue.
void replace(lua_State* L, const char* name, lua_CFunction watched) {
    lua_getfield(L, -1, name);
    lua_pushcclosure(L, watched, 1);
    lua_setfield(L, -2, name);
}

}  // namespace

Interrupt::Interrupt(const Context& context) : context_(context) {
    const std::lock_guard lock(pressing);
    pressed_flag = 0;
    listening_context.store(&context_);
    std::signal(SIGINT, on_interrupt);
}

Interrupt::~Interrupt() {
    std::signal(SIGINT, SIG_DFL);
    const std::lock_guard lock(pressing);
    listening_context.store(nullptr);
}

void Interrupt::watch(lua_State* L) {
    lua_getglobal(L, "coroutine");
    replace(L, "resume", watched_resume);
    replace(L, "wrap", watched_wrap);
    lua_pop(L, 1);
    set_running(L);
}

void Interrupt::attend(lua_State* L) {
    set_running(L);
}

void Interrupt::press() {
    const std::lock_guard lock(pressing);
    stop_work();
}

void Interrupt::forget() {
    set_running(nullptr);
}

void Interrupt::wait_at_prompt(bool waits) {
    prompt_flag = waits ? 1 : 0;
}

bool Interrupt::pressed() const {
    return pressed_flag != 0;
}

void Interrupt::clear() {
    const std::lock_guard lock(pressing);
    pressed_flag = 0;
    context_.clear_cancel();
    lua_State* const L = running_thread.load();
    if (!L) return;
    lua_sethook(L, nullptr, 0, 0);
    lua_pushnil(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kStopped);
}

}  // namespace lissom::cli
