// lissom.try and lissom.error.
#include "bindings/lua/core/call.h"
#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/kernel_library.h"

namespace lissom::lua {
namespace {

// Returns the values that the protected call has left on the stack: its results, or its error.
int finish_try(lua_State* L, bool done) {
    if (done) return lua_gettop(L);
    lua_pushnil(L);
    lua_insert(L, -2);
    return 2;
}

#if LUA_VERSION_NUM >= 504

int go_on_with_try(lua_State* L, int status, lua_KContext) {
    return finish_try(L, status == LUA_OK || status == LUA_YIELD);
}

// The function may yield.
int try_function(Call& call) {
    lua_State* L = call.lua();
    const int status = lua_pcallk(L, lua_gettop(L) - 1, LUA_MULTRET, 0, 0, go_on_with_try);
    return go_on_with_try(L, status, 0);
}

#else

int try_function(Call& call) {
    lua_State* L = call.lua();
    return finish_try(L, lua_pcall(L, lua_gettop(L) - 1, LUA_MULTRET, 0) == 0);
}

#endif

int raise_error(Call& call) {
    lua_State* L = call.lua();
    Failure failure;
    failure.set(call.choice<ErrorCode>("code"), call.string("message"));
    push_error(L, failure, call.integer("level"));
    for (const char* field : {"elements", "file", "line"}) {
        if (!call.has(field)) continue;
        lua_getfield(L, 1, field);
        lua_setfield(L, -2, field);
    }
    return lua_error(L);
}

std::vector<std::string> code_names() {
    std::vector<std::string> names;
    for (const ErrorCode code : all_codes()) names.emplace_back(code_name(code));
    return names;
}

}  // namespace

std::vector<Function> error_functions() {
    return {{.name = "try",
             .body = try_function,
             .summary = "Calls a function; returns its results, or nil and its error.",
             .arguments = {function("f", "function", "The function; its arguments follow.")},
             .more_arguments = true,
             .results = {{"any", "result", "The results of the function; nil if it fails."},
                         {"lissom.Error?", "error",
                          "The error; an error that is not of lissom is handed on as it is."}},
             .example = R"(local mesh, problem = lissom.try(lissom.load, "missing.obj")
assert(mesh == nil and problem.code == "file_not_found" and problem.file == "missing.obj")
local box = assert(lissom.try(lissom.shapes.box, { size = 2 }))
assert(not lissom.try(box.save, box, "no/such/folder.obj")))"},
            {.name = "error",
             .body = raise_error,
             .summary = "Raises an error object, as every function of lissom that fails.",
             .options =
                 {string("message", "The fault and a remedy, a sentence."),
                  choice("code", code_names(), "Its code.").defaults("invalid_argument"),
                  table("elements", "A lissom.Elements: the elements concerned.").optional("none"),
                  string("file", "The input file concerned.").optional("none"),
                  integer("line", "The line of that file.").optional("none"),
                  integer("level",
                          "Level of the line that is the error's place: 1 for this call, 2 for "
                          "the call of the function that it is in.")
                      .defaults(1)
                      .between(1, 100)},
             .example = R"(local function half(path)
    lissom.error{ message = path .. ": half of it is missing", code = "file_truncated", file = path }
end
local _, problem = lissom.try(half, "scan.obj")
assert(problem.code == "file_truncated" and tostring(problem) == "scan.obj: half of it is missing"))"}};
}

std::vector<Record> error_records() {
    return {{"lissom.Error",
             "Raised by everything that fails. tostring gives the message, and so does `..`; two "
             "are equal only if they are the same.",
             {{"string", "message", "The fault and a remedy, a sentence."},
              {"string", "code", "Its [code](codes.md): \"file_not_found\", ..."},
              {"lissom.Elements?", "elements", "The elements concerned."},
              {"string?", "file", "The file that was to be read or written."},
              {"integer?", "line", "The line of that file."},
              {"string?", "place", "File and line of the script: \"bend.lua:3\"."}}}};
}

}  // namespace lissom::lua
