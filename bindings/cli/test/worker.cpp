#include "bindings/cli/test/worker.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>

#include "bindings/cli/process/child_process.h"
#include "bindings/cli/process/time_limit.h"
#include "bindings/cli/script.h"
#include "bindings/cli/script_text.h"
#include "bindings/cli/test/framework.h"
#include "bindings/cli/test/results.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRequireGl = "LISSOM_REQUIRE_GL";

// "03-far-from-the-origin": a name for the files of a test.
std::string folder_name(int number, const std::string& name) {
    std::string text = (number < 10 ? "0" : "") + std::to_string(number) + "-";
    for (const char c : name.substr(0, 60)) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (is_plain || text.back() != '-') text += is_plain ? c : '-';
    }
    while (text.back() == '-') text.pop_back();
    return text;
}

// The value at `index`: nil, a flag, a number, a text, or a table of them.
Json json_of(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TBOOLEAN:
            return lua_toboolean(L, index) != 0;
        case LUA_TNUMBER:
            if (lua_isinteger(L, index)) return static_cast<long long>(lua_tointeger(L, index));
            return lua_tonumber(L, index);
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* const text = lua_tolstring(L, index, &size);
            return std::string(text, size);
        }
        default:
            return nullptr;
    }
}

Json record_of(lua_State* L, int index) {
    Json record = Json::object();
    lua_pushnil(L);
    while (lua_next(L, index)) {
        if (lua_type(L, -2) == LUA_TSTRING) record[lua_tostring(L, -2)] = json_of(L, -1);
        lua_pop(L, 1);
    }
    return record;
}

void push(lua_State* L, const std::string& text) {
    lua_pushlstring(L, text.data(), text.size());
}

void set_field(lua_State* L, const char* name, const std::string& text) {
    push(L, text);
    lua_setfield(L, -2, name);
}

// Without the place that Lua puts in front of a message, which is told by itself.
void split_place(ScriptResult& result) {
    const auto starts = [&](const std::string& place) { return result.message.starts_with(place); };
    for (const ScriptLine& call : result.calls) {
        const std::string place = call.shown + ":" + std::to_string(call.line) + ": ";
        if (!starts(place)) continue;
        result.file = call.file;
        result.line = call.line;
        result.message.erase(0, place.size());
        return;
    }
    if (!result.file.empty()) {
        const std::string place = result.file + ":" + std::to_string(result.line) + ": ";
        if (starts(place)) result.message.erase(0, place.size());
    } else if (!result.calls.empty()) {
        result.file = result.calls[0].file;
        result.line = result.calls[0].line;
    }
}

Json calls_json(const std::vector<ScriptLine>& calls) {
    Json list = Json::array();
    for (const ScriptLine& call : calls) list.push_back({{"file", call.file}, {"line", call.line}});
    return list;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Worker {
  public:
    Worker(Program& program, TestJob job)
        : program_(program), job_(std::move(job)), script_(program, {job_.file.string(), {}}) {}

    int run();

  private:
    template <int (Worker::*kMember)(lua_State*)>
    static int host_function(lua_State* L);
    template <int (Worker::*kMember)(lua_State*)>
    void add_function(const char* name);

    int call(lua_State* L);
    int report(lua_State* L);
    int folder(lua_State* L);
    int no_picture(lua_State* L);
    int picture(lua_State* L);

    void push_host();
    void push_settings();
    bool load_file();
    void tell(Json event);
    void tell_failure_of_file(const std::string& message);
    void tell_mistake(const std::string& text);
    void complete_end(Json& event);
    std::uintmax_t output_size() const;
    void push_failure(const ScriptResult& result);
    std::string whole_name(const std::string& file) const;
    fs::path test_folder() const;
    std::string shown_beside(const fs::path& path) const;
    std::string compare(const PictureCheck& check);

    Program& program_;
    TestJob job_;
    ParentProcess parent_;
    Script script_;
    // Calls of the last failure: Lua only hands on the rest of it.
    std::vector<ScriptLine> calls_;
    // The test that runs.
    int number_ = 0;
    std::string name_;
    std::chrono::steady_clock::time_point began_;
};

// ---- Functions of the host

// A function of the host as Lua calls it. Its exceptions become errors of Lua when no C++ object is
// alive any more.
template <int (Worker::*kMember)(lua_State*)>
int Worker::host_function(lua_State* L) {
    auto* const worker = static_cast<Worker*>(lua_touserdata(L, lua_upvalueindex(1)));
    lua::Failure failure;
    int count = 0;
    if (failure.guard([&] { count = (worker->*kMember)(L); })) return count;
    return luaL_error(L, "%s", failure.message);
}

template <int (Worker::*kMember)(lua_State*)>
void Worker::add_function(const char* name) {
    lua_State* const L = script_.lua();
    lua_pushlightuserdata(L, this);
    lua_pushcclosure(L, host_function<kMember>, 1);
    lua_setfield(L, -2, name);
}

// Lua shortens a long name in its messages: "...ending".
std::string Worker::whole_name(const std::string& file) const {
    const bool is_short = file.starts_with("...") && job_.shown.ends_with(file.substr(3));
    return is_short ? job_.shown : file;
}

// call(action, limit)
int Worker::call(lua_State* L) {
    const double limit = lua_tonumber(L, 2);
    lua_settop(L, 1);
    tell({{"event", "limit"}, {"seconds", limit}});
    TimeLimit watch(limit);
    ScriptResult result = script_.call_function();
    const bool is_late = watch.stop();
    program_.forget_interrupt();
    lua_settop(L, 0);
    if (!is_late && result.status == kSuccess) return 0;
    split_place(result);
    if (is_late) {
        result.message = "it took longer than " + seconds_text(limit);
        result.code = "timeout";
    }
    push_failure(result);
    calls_ = std::move(result.calls);
    return 1;
}

// Pushes a table: { message =, file =, line =, code = }.
void Worker::push_failure(const ScriptResult& result) {
    lua_State* const L = script_.lua();
    lua_createtable(L, 0, 4);
    set_field(L, "message", result.message);
    if (!result.file.empty()) set_field(L, "file", whole_name(result.file));
    if (!result.code.empty()) set_field(L, "code", result.code);
    lua_pushinteger(L, result.line);
    lua_setfield(L, -2, "line");
}

// report(event)
int Worker::report(lua_State* L) {
    Json event = record_of(L, 1);
    const std::string kind = event.at("event");
    if (kind == "begin") {
        ++number_;
        name_ = event.at("name");
        began_ = std::chrono::steady_clock::now();
        event["folder"] = test_folder().string();
    } else if (kind == "end") {
        complete_end(event);
    } else if (kind == "file") {
        event["calls"] = calls_json(calls_);
    }
    tell(std::move(event));
    return 0;
}

// Fields of a finished test known only to this side.
void Worker::complete_end(Json& event) {
    event["seconds"] = seconds_since(began_);
    event["calls"] = calls_json(calls_);
    calls_.clear();
    const fs::path folder = test_folder();
    std::error_code error;
    const bool is_kept =
        event.at("status") == "failed" && fs::exists(folder, error) && !fs::is_empty(folder, error);
    if (is_kept) {
        event["folder"] = folder.string();
    } else {
        fs::remove_all(folder, error);
    }
}

// folder()
int Worker::folder(lua_State* L) {
    fs::create_directories(test_folder());
    push(L, test_folder().string());
    return 1;
}

// no_picture()
int Worker::no_picture(lua_State* L) {
    if (program_.parts().compare_pictures) return 0;
    push(L, "this program draws and compares no pictures");
    return 1;
}

// picture{ picture =, golden =, tolerance =, pixels =, connected = }
int Worker::picture(lua_State* L) {
    const Json given = record_of(L, 1);
    PictureCheck check;
    check.picture = given.at("picture").get<std::string>();
    check.golden = given.at("golden").get<std::string>();
    check.tolerance = given.at("tolerance");
    check.pixels = given.at("pixels");
    check.connected = given.at("connected");
    check.difference = check.picture;
    check.difference.replace_extension(".difference.png");
    const std::string message = compare(check);
    if (message.empty()) return 0;
    push(L, message);
    return 1;
}

std::string Worker::compare(const PictureCheck& check) {
    std::error_code error;
    if (!fs::exists(check.picture, error)) {
        return "there is no file \"" + check.picture.string() + "\"";
    }
    const bool has_golden = fs::exists(check.golden, error);
    std::string message = "there is no golden picture " + shown_beside(check.golden) +
                          " yet; lissom test --update writes it";
    if (has_golden) message = program_.parts().compare_pictures(check);
    if (message.empty() || !job_.update) return message;
    if (check.golden.has_parent_path()) fs::create_directories(check.golden.parent_path());
    fs::copy_file(check.picture, check.golden, fs::copy_options::overwrite_existing);
    fs::remove(check.difference, error);
    tell({{"event", "updated"}, {"path", shown_beside(check.golden)}});
    return "";
}

// ---- The rest

// A path that is relative to the test's folder, as the one who called the program sees it.
std::string Worker::shown_beside(const fs::path& path) const {
    return (fs::path(job_.shown).parent_path() / path).lexically_normal().string();
}

fs::path Worker::test_folder() const {
    return job_.folder / folder_name(job_.finished + number_, name_);
}

std::uintmax_t Worker::output_size() const {
    std::fflush(stdout);
    std::cout << std::flush;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(job_.output, error);
    return error ? 0 : size;
}

void Worker::tell(Json event) {
    event["output"] = output_size();
    if (parent_.tell(json_text(event, -1))) return;
    throw std::runtime_error("nobody listens to the tests that run");
}

void Worker::tell_failure_of_file(const std::string& message) {
    tell({{"event", "file"}, {"status", "failed"}, {"message", message}});
    tell({{"event", "done"}});
}

// A mistake of syntax: "file:line: message".
void Worker::tell_mistake(const std::string& text) {
    const std::size_t end = text.find(": "), start = text.rfind(':', end - 1);
    if (end == std::string::npos || start == std::string::npos) return tell_failure_of_file(text);
    tell({{"event", "file"},
          {"status", "failed"},
          {"message", text.substr(end + 2)},
          {"line", std::atoi(text.c_str() + start + 1)}});
    tell({{"event", "done"}});
}

void Worker::push_settings() {
    lua_State* const L = script_.lua();
    lua_newtable(L);
    if (!job_.filter.empty()) set_field(L, "filter", job_.filter);
    set_field(L, "shown", job_.shown);
    set_field(L, "path", job_.file.string());
    lua_pushboolean(L, job_.list);
    lua_setfield(L, -2, "list");
    lua_pushboolean(L, std::getenv(kRequireGl) != nullptr);
    lua_setfield(L, -2, "require_pictures");
    lua_pushinteger(L, job_.seed);
    lua_setfield(L, -2, "seed");
    lua_pushinteger(L, job_.finished);
    lua_setfield(L, -2, "finished");
    lua_pushnumber(L, job_.timeout);
    lua_setfield(L, -2, "timeout");
}

void Worker::push_host() {
    lua_State* const L = script_.lua();
    lua_newtable(L);
    push_settings();
    lua_setfield(L, -2, "settings");
    add_function<&Worker::call>("call");
    add_function<&Worker::report>("report");
    add_function<&Worker::folder>("folder");
    add_function<&Worker::no_picture>("no_picture");
    add_function<&Worker::picture>("picture");
}

// Leaves the chunk on the stack, or tells why there is none.
bool Worker::load_file() {
    lua_State* const L = script_.lua();
    const std::optional<std::string> text = script_text(job_.file.string());
    if (!text) {
        tell_failure_of_file("the file cannot be read");
        return false;
    }
    // A first line for the shell is no Lua; its place is kept for the numbers of the others.
    const std::size_t start = text->starts_with('#') ? std::min(text->find('\n'), text->size()) : 0;
    const std::string name = "@" + job_.shown;
    if (luaL_loadbufferx(L, text->data() + start, text->size() - start, name.c_str(), "t") ==
        LUA_OK)
        return true;
    tell_mistake(lua_tostring(L, -1));
    return false;
}

int Worker::run() {
    lua_State* const L = script_.lua();
    fs::current_path(job_.file.parent_path());
    const std::string_view text = test_framework();
    lua_settop(L, 0);
    if (luaL_loadbufferx(L, text.data(), text.size(), "=lissom test", "t") != LUA_OK) {
        throw std::runtime_error(lua_tostring(L, -1));
    }
    push_host();
    lua_call(L, 1, 1);
    for (const char* name : {"test", "expect"}) {
        lua_getfield(L, -1, name);
        lua_setglobal(L, name);
    }
    lua_getfield(L, -1, "run");
    if (!load_file()) return kFailure;
    if (lua_pcall(L, 1, 0, 0) == LUA_OK) return kSuccess;
    return program_.fail(std::string("lissom test: ") + lua_tostring(L, -1));
}

}  // namespace

Json job_json(const TestJob& job) {
    return {{"file", job.file.string()},     {"shown", job.shown},
            {"output", job.output.string()}, {"folder", job.folder.string()},
            {"filter", job.filter},          {"list", job.list},
            {"update", job.update},          {"seed", job.seed},
            {"timeout", job.timeout},        {"finished", job.finished}};
}

TestJob job_of(const Json& json) {
    TestJob job;
    job.file = json.at("file").get<std::string>();
    job.shown = json.at("shown");
    job.output = json.at("output").get<std::string>();
    job.folder = json.at("folder").get<std::string>();
    job.filter = json.at("filter");
    job.list = json.at("list");
    job.update = json.at("update");
    job.seed = json.at("seed");
    job.timeout = json.at("timeout");
    job.finished = json.at("finished");
    return job;
}

int run_test_job(Program& program, const std::string& json) {
    // The output of a test that dies shall not be lost.
    std::setvbuf(stdout, nullptr, _IONBF, 0);
    return Worker(program, job_of(Json::parse(json))).run();
}

}  // namespace lissom::cli
