#include "bindings/lua/sandbox/sandbox.h"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>

#include "bindings/lua/host/counted_state.h"
#include "bindings/lua/sandbox/folder_rights.h"
#include "bindings/lua/sandbox/sandbox_state.h"
#include "kernel/core/error.h"

namespace lissom::lua {
namespace {

// Instructions between two looks at the limits. Any count takes Lua's loops off their fast path; so
// few bound the work of operators on long strings between them. Calls are looked at
// as well: each may be of a C function that takes its time, or begin a coroutine, whose own count
// begins anew.
constexpr int kInstructions = 20;
constexpr int kLooks = LUA_MASKCOUNT | LUA_MASKCALL;
// Bytes that a C function passes over in the time of an instruction, about.
constexpr std::size_t kBytesAnInstruction = 64;

// Where no thread can be started the time is looked at between instructions, and calls of the
// kernel are not ended by it.
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
constexpr bool kHasThreads = false;
#else
constexpr bool kHasThreads = true;
#endif

using Clock = std::chrono::steady_clock;

Clock::time_point end_of_time(double seconds) {
    constexpr double kAges = 1e9;
    if (kHasThreads || seconds <= 0.0 || seconds > kAges) return Clock::time_point::max();
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

// Asks for a stop when the time is over, unless it is gone before.
class Watch {
  public:
    Watch(double seconds, const std::function<void()>& over) {
        if (kHasThreads && seconds > 0.0)
            watcher_ = std::thread([this, seconds, over] { wait(seconds, over); });
    }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_all();
        if (watcher_.joinable()) watcher_.join();
    }

  private:
    void wait(double seconds, const std::function<void()>& over) {
        std::unique_lock lock(mutex_);
        const std::chrono::duration<double> time(seconds);
        if (!changed_.wait_for(lock, time, [this] { return ended_; })) over();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    std::thread watcher_;
};

}  // namespace

struct Sandbox::Parts : Work {
    Parts(Sandbox& sandbox, SandboxLimits given, HostOptions host,
          std::function<void(std::string_view)> printer, FolderRights folders)
        : owner(sandbox),
          limits(std::move(given)),
          options(std::move(host)),
          print(std::move(printer)),
          rights(std::move(folders)) {}

    void count(std::size_t more) override;
    const char* end_text() override;

    Sandbox& owner;
    SandboxLimits limits;
    HostOptions options;
    std::function<void(std::string_view)> print;
    FolderRights rights;
    std::atomic<SandboxEnd> end = SandboxEnd::none;
    std::int64_t instructions = 0;
    // Used without threads.
    Clock::time_point last_moment = Clock::time_point::max();
    unsigned looks = 0;
    // Whether a script runs, and not the host.
    std::atomic<bool> runs = false;
    // Bytes of warnings, from any thread.
    std::atomic<std::size_t> warned = 0;
    lua_State* L = nullptr;
    std::shared_ptr<MemoryAccount> account = {};

    // A look at the clock takes as long as hundreds of instructions.
    bool time_is_over() {
        constexpr unsigned kLooksAtOnce = 128;
        return last_moment != Clock::time_point::max() && ++looks % kLooksAtOnce == 0 &&
               Clock::now() >= last_moment;
    }

    void ask(SandboxEnd why) {
        SandboxEnd none = SandboxEnd::none;
        end.compare_exchange_strong(none, why);
        stop.ask();
    }
};

namespace {

// Lua skips the finalizer of an object if there is no memory for its call. A state that runs one
// answers no question about its collector.
bool is_finalizing(lua_State* L) {
    return L && lua_gc(L, LUA_GCISRUNNING) != 1;
}

// Lua works for minutes without a call or an instruction where a value is its own __call: then its
// stack grows, and that is where it is stopped. Small blocks are for messages, and the smallest for
// finalizers, beyond the limit.
void* allocate_in_time(void* sandbox, void* block, std::size_t old_size, std::size_t new_size) {
    constexpr std::size_t kSmall = std::size_t{256} << 10, kSmallest = std::size_t{16} << 10;
    auto& parts = *static_cast<Sandbox::Parts*>(sandbox);
    const bool grows = new_size > kSmall && (!block || new_size > old_size);
    if (grows && parts.runs && parts.stop.asked()) return nullptr;
    void* made = allocate_counted(parts.account.get(), block, old_size, new_size);
    if (made || new_size == 0 || new_size > kSmallest || !is_finalizing(parts.L)) return made;
    const MemoryOverdraft overdraft(parts.account);
    return allocate_counted(parts.account.get(), block, old_size, new_size);
}

void look_at_limits(lua_State* L, lua_Debug* event) {
    const Sandbox& sandbox = sandbox_of(L);
    Sandbox::Parts& parts = sandbox.parts();
    if (event->event == LUA_HOOKCOUNT) parts.instructions += lua_gethookcount(L);
    if (parts.limits.instructions != 0 && parts.instructions > parts.limits.instructions) {
        parts.ask(SandboxEnd::instructions);
    }
    if (parts.time_is_over()) parts.ask(SandboxEnd::seconds);
    if (sandbox.state().context.cancelled()) parts.ask(SandboxEnd::cancelled);
    if (!parts.stop.asked()) return;
    // A script that catches the error gets it again at once: it cannot go on.
    lua_sethook(L, look_at_limits, kLooks, 1);
    raise_stopped(L);
}

int print(lua_State* L) {
    const Sandbox& sandbox = sandbox_of(L);
    for (int i = lua_gettop(L); i >= 1; --i) {
        push_shown(L, i);
        lua_replace(L, i);
    }
    push_printed(L);
    lua_pushliteral(L, "\n");
    lua_concat(L, 2);
    Sandbox::Parts& parts = sandbox.parts();
    if (sandbox.state().only_help) return 0;
    std::size_t size = 0;
    const char* text = lua_tolstring(L, -1, &size);
    if (!parts.rights.count_output(size)) {
        parts.ask(SandboxEnd::output);
        raise_stopped(L);
    }
    if (parts.print) parts.print({text, size});
    return 0;
}

void open_libraries(lua_State* L) {
    const luaL_Reg libraries[] = {
        {LUA_GNAME, luaopen_base},        {LUA_TABLIBNAME, luaopen_table},
        {LUA_STRLIBNAME, luaopen_string}, {LUA_MATHLIBNAME, luaopen_math},
        {LUA_UTF8LIBNAME, luaopen_utf8},  {LUA_COLIBNAME, luaopen_coroutine},
        {LUA_OSLIBNAME, luaopen_os},      {LUA_DBLIBNAME, luaopen_debug}};
    for (const luaL_Reg& library : libraries) {
        luaL_requiref(L, library.name, library.func, 1);
        lua_pop(L, 1);
    }
}

// Protected: argument 1 is the sandbox.
int prepare_sandbox(lua_State* L) {
    auto* sandbox = static_cast<Sandbox*>(lua_touserdata(L, 1));
    open_libraries(L);
    make_base_safe(L);
    make_tables_safe(L);
    make_strings_safe(L);
    lua_gc(L, LUA_GCGEN, 0, 0);
    lua_pushcfunction(L, print);
    lua_setglobal(L, "print");
    open(L, sandbox->parts().options);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_insert(L, -2);
    lua_setfield(L, -2, "lissom");
    make_require_safe(L);
    return 0;
}

// If the host has a table of files and names no folders, the table decides.
void guard_files(Sandbox::Parts& parts) {
    FileTable& files = parts.options.context.files;
    const bool host_reads = files.read && parts.limits.read_folders.empty();
    const bool host_writes = files.write && parts.limits.write_folders.empty();
    parts.options.check_file = [&parts, host_reads, host_writes](const std::filesystem::path& path,
                                                                 FileUse use) {
        if (use == FileUse::read ? !host_reads : !host_writes) parts.rights.check(path, use);
    };
    if (!host_writes) return;
    files.write = [&parts, write = std::move(files.write)](std::string_view path,
                                                           std::string_view bytes) {
        if (parts.rights.count_output(bytes.size())) return write(path, bytes);
        throw Error(ErrorCode::file_write_failed,
                    std::string(path) + ": the script has written as much as it may");
    };
}

// Warnings are output: hosts show them.
void count_warnings(Sandbox::Parts& parts) {
    auto& log = parts.options.context.log;
    log = [&parts, log = std::move(log)](LogLevel level, std::string_view text) {
        const bool fits = level != LogLevel::warning || parts.owner.count_shown(text.size());
        if (fits && log) log(level, text);
    };
}

void require_limits(const SandboxLimits& limits) {
    if (limits.seconds >= 0.0 && limits.instructions >= 0) return;
    throw Error(ErrorCode::invalid_argument,
                "the limits of a sandbox are not below zero; zero is no limit");
}

}  // namespace

// New coroutines have the extra space of the first state.
void set_work(lua_State* L, Work& work) {
    *static_cast<Work**>(lua_getextraspace(L)) = &work;
}

Work& work_of(lua_State* L) {
    return **static_cast<Work**>(lua_getextraspace(L));
}

Sandbox& sandbox_of(lua_State* L) {
    return static_cast<Sandbox::Parts&>(work_of(L)).owner;
}

void charge(lua_State* L, std::size_t instructions) {
    Work& work = work_of(L);
    work.count(instructions);
    if (work.stop.asked()) raise_stopped(L);
}

void Sandbox::Parts::count(std::size_t more) {
    instructions += static_cast<std::int64_t>(more);
    if (limits.instructions != 0 && instructions > limits.instructions) {
        ask(SandboxEnd::instructions);
    }
}

void charge_bytes(lua_State* L, std::size_t bytes) {
    charge(L, bytes / kBytesAnInstruction);
}

const std::vector<std::filesystem::path>& module_folders_of(const Sandbox& sandbox) {
    return sandbox.parts().limits.module_folders;
}

void raise_stopped(lua_State* L) {
    luaL_error(L, "%s", work_of(L).end_text());
    std::abort();
}

const char* Sandbox::Parts::end_text() {
    // A cancel of the host is noticed here first, unless a limit was reached before.
    ask(SandboxEnd::cancelled);
    switch (end.load()) {
        case SandboxEnd::seconds:
            return "the time of the script is over [cancelled]";
        case SandboxEnd::instructions:
            return "the script has run as many instructions as it may [cancelled]";
        case SandboxEnd::output:
            return "the script has written as much as it may [cancelled]";
        case SandboxEnd::none:
        case SandboxEnd::cancelled:
            break;
    }
    return "cancelled [cancelled]";
}

Sandbox::Sandbox(SandboxLimits limits, HostOptions options,
                 std::function<void(std::string_view)> print) {
    require_limits(limits);
    FolderRights rights(limits.read_folders, limits.write_folders, limits.module_folders,
                        limits.output_bytes);
    parts_.reset(new Parts(*this, std::move(limits), std::move(options), std::move(print),
                           std::move(rights)));
    Parts& parts = *parts_;
    parts.account =
        std::make_shared<MemoryAccount>(parts.limits.memory_bytes, parts.options.context.memory);
    parts.options.context.memory = parts.account;
    parts.options.addresses = false;
    guard_files(parts);
    count_warnings(parts);
    try {
        open_state();
    } catch (...) {
        close_state();
        throw;
    }
}

Sandbox::~Sandbox() {
    close_state();
}

void Sandbox::open_state() {
    Parts& parts = *parts_;
    parts.L = lua_newstate(allocate_in_time, &parts);
    bool opened = false;
    if (parts.L) {
        set_work(parts.L, parts);
        lua_pushcfunction(parts.L, prepare_sandbox);
        lua_pushlightuserdata(parts.L, this);
        opened = lua_pcall(parts.L, 1, 0, 0) == LUA_OK;
    }
    if (!opened) {
        const char* text = parts.L ? lua_tostring(parts.L, -1) : nullptr;
        const std::string why = text ? text : "not enough memory";
        throw Error(ErrorCode::memory_limit, "the sandbox cannot be opened: " + why);
    }
    parts.stop.follow(state().context);
}

// Lua needs memory to call the finalizers of objects, which give back what they hold.
void Sandbox::close_state() noexcept {
    if (!parts_->L) return;
    const MemoryOverdraft overdraft(parts_->account);
    lua_close(parts_->L);
}

lua_State* Sandbox::lua() const {
    return parts_->L;
}

void Sandbox::work_in(const Context& context) {
    state().context = context.charging(parts_->account).with_files(parts_->options.context.files);
    parts_->stop.follow(context);
}

std::shared_ptr<MemoryAccount> Sandbox::memory() const {
    return parts_->account;
}

bool Sandbox::count_shown(std::size_t bytes) {
    const std::size_t most = parts_->limits.output_bytes;
    if (most == 0 || !parts_->runs || (parts_->warned += bytes) <= most) return true;
    parts_->ask(SandboxEnd::output);
    return false;
}

SandboxEnd Sandbox::end() const {
    return parts_->end;
}

namespace {

int raise_end(lua_State* L) {
    raise_stopped(L);
}

}  // namespace

int Sandbox::call(int arguments, int results, int handler) {
    Parts& parts = *parts_;
    const int below = lua_gettop(parts.L) - arguments - 1;
    const Context context = state().context;
    parts.end = SandboxEnd::none;
    parts.stop.clear();
    parts.instructions = 0;
    parts.last_moment = end_of_time(parts.limits.seconds);
    lua_sethook(parts.L, look_at_limits, kLooks, kInstructions);
    int status = LUA_OK;
    bool has_ended = false;
    {
        const Watch watch(parts.limits.seconds, [&parts, &context] {
            parts.ask(SandboxEnd::seconds);
            context.cancel();
        });
        parts.runs = true;
        status = lua_pcall(parts.L, arguments, results, handler);
        parts.runs = false;
        has_ended = parts.stop.asked();
    }
    // The host reads results and messages by calls that nothing protects.
    lua_sethook(parts.L, nullptr, 0, 0);
    // The limit asked for this, not the host.
    if (parts.end == SandboxEnd::seconds) context.clear_cancel();
    // A limit may have ended a coroutine alone, shortly before the end of the script.
    if (status == LUA_OK && has_ended) {
        lua_settop(parts.L, below);
        lua_pushcfunction(parts.L, raise_end);
        status = lua_pcall(parts.L, 0, 0, 0);
    }
    return status;
}

}  // namespace lissom::lua
