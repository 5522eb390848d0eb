// lissom.groom and its files; the grooms themselves are written in Lua.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/lua/hair/groom_text.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/io/stream/file.h"

namespace lissom::lua {
namespace {

// As those of tools, so that scripts are not told places in it.
constexpr const char* kGroomChunk = "=lissom tools";

// Key of Lua's registry: its address. The functions of the text.
const char kGroomFunctions = 0;

struct GroomPiece {
    int next = 0;
};

const char* read_groom_piece(lua_State*, void* state, std::size_t* size) {
    auto* piece = static_cast<GroomPiece*>(state);
    const char* text = kGroomText[piece->next];
    if (!text) return nullptr;
    ++piece->next;
    *size = std::strlen(text);
    return text;
}

// The type of a value that a switch, a slider or a list of choices sets; null for others.
const char* control_of(const Parameter& p) {
    switch (p.kind) {
        case Kind::boolean:
            return "boolean";
        case Kind::integer:
            return "integer";
        case Kind::number:
            return "number";
        case Kind::choice:
            return "choice";
        default:
            return nullptr;
    }
}

void push_default(const Call& call, const Parameter& p) {
    if (const auto* flag = std::get_if<bool>(&p.default_value)) {
        call.push(*flag);
    } else if (const auto* number = std::get_if<double>(&p.default_value);
               number != nullptr && std::isfinite(*number)) {
        call.push(*number);
    } else if (const auto* word = std::get_if<std::string>(&p.default_value)) {
        call.push(std::string_view(*word));
    } else {
        lua_pushnil(call.lua());
    }
    lua_setfield(call.lua(), -2, "default");
}

void push_choices(const Call& call, const Parameter& p) {
    lua_createtable(call.lua(), count_of(p.choices), 0);
    for (std::size_t i = 0; i < p.choices.size(); ++i) {
        call.push(std::string_view(p.choices[i]));
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    lua_setfield(call.lua(), -2, "choices");
}

// An option as a declaration of lissom.params, with its name.
void push_option(const Call& call, const Parameter& whole, const Parameter& p) {
    lua_createtable(call.lua(), 0, 8);
    call.set_field("name", call.push(std::string_view(whole.name)));
    call.set_field("type", call.push(std::string_view(control_of(p))));
    call.set_field("unit", call.push(std::string_view(p.unit)));
    call.set_field("help", call.push(std::string_view(whole.help)));
    if (std::isfinite(p.min)) call.set_field("min", call.push(p.min));
    if (std::isfinite(p.max)) call.set_field("max", call.push(p.max));
    if (p.above_min) call.set_field("above", call.push(true));
    push_default(call, p);
    if (p.kind == Kind::choice) push_choices(call, p);
}

// Options that a control can set, in their order; of several kinds of values the first such.
void add_options(const Call& call, const std::vector<Parameter>& options, int& count) {
    for (const Parameter& p : options) {
        const Parameter* one = &p;
        for (const Parameter& other : p.alternatives) {
            if (control_of(*one) == nullptr) one = &other;
        }
        if (control_of(*one) == nullptr) continue;
        push_option(call, p, *one);
        lua_rawseti(call.lua(), -2, ++count);
    }
}

void push_options(const Call& call, const Function& method) {
    lua_newtable(call.lua());
    int count = 0;
    if (method.named_arguments) add_options(call, method.arguments, count);
    add_options(call, method.options, count);
}

// By name, the options of the methods of strands and of style:grow.
void push_described(const Call& call, const std::vector<Function>& methods) {
    lua_newtable(call.lua());
    for (const Function& method : methods) {
        luaL_checkstack(call.lua(), LUA_MINSTACK, "no room for a groom");
        push_options(call, method);
        lua_setfield(call.lua(), -2, method.name.c_str());
    }
}

void find_methods(std::vector<Function>& methods) {
    methods = strands_type().methods;
    for (Function& method : hairstyle_type().methods) {
        if (method.name == "grow") methods.push_back(std::move(method));
    }
}

// Runs the text and keeps its results.
void load_groom_functions(Call& call) {
    lua_State* L = call.lua();
    auto& methods = call.hold<std::vector<Function>>();
    if (!call.attempt_quick([&] { find_methods(methods); })) call.fail();
    GroomPiece piece;
#if LUA_VERSION_NUM >= 502
    const int status = lua_load(L, read_groom_piece, &piece, kGroomChunk, "t");
#else
    const int status = lua_load(L, read_groom_piece, &piece, kGroomChunk);
#endif
    if (status != 0) lua_error(L);
    open(L, call.state().host);
    push_described(call, methods);
    lua_call(L, 2, 1);
    lua_pushvalue(L, -1);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kGroomFunctions);
}

// Pushes a function of the text.
void push_groom_function(Call& call, const char* name) {
    lua_State* L = call.lua();
    luaL_checkstack(L, LUA_MINSTACK, "no room for a groom");
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kGroomFunctions);
    if (!lua_istable(L, -1)) {
        lua_pop(L, 1);
        load_groom_functions(call);
    }
    lua_getfield(L, -1, name);
    lua_remove(L, -2);
}

int make_groom(Call& call) {
    push_groom_function(call, "new");
    lua_pushvalue(call.lua(), 1);
    lua_call(call.lua(), 1, 1);
    return 1;
}

int load_groom(Call& call) {
    const std::string_view path = call.string("path");
    auto& file = call.hold<std::string>();
    const bool done = call.attempt([&] {
        file = std::string(read_file(call.file(path, FileUse::read), call.context()).bytes);
    });
    if (!done) return call.fail();
    push_groom_function(call, "read");
    call.push(std::string_view(file));
    lua_pushvalue(call.lua(), 2);
    if (call.has("scalp")) {
        lua_getfield(call.lua(), 3, "scalp");
    } else {
        lua_pushnil(call.lua());
    }
    lua_call(call.lua(), 3, 1);
    return 1;
}

int save_groom(Call& call) {
    const std::string_view path = call.string("path");
    push_groom_function(call, "text");
    lua_pushvalue(call.lua(), 1);
    lua_call(call.lua(), 1, 1);
    std::size_t size = 0;
    const char* bytes = lua_tolstring(call.lua(), -1, &size);
    const std::string_view text(bytes, size);
    const bool done = call.attempt(
        [&] { write_file_atomically(call.file(path, FileUse::write), text, call.context()); });
    return done ? call.push_argument() : call.fail();
}

const std::string kGroomExample = kStyle + R"(local groom = lissom.groom{ head = head, layers = {
    { name = "all", style = style, grow = { count = 100, length = 0.1 }, operators = {
        { "guides", count = 10 }, { "gather", spread = 0.001 } } },
} }
)";

std::vector<Result> groom_fields() {
    const std::string which = "The layer by its name or number, the operator by its place.";
    return {
        {"integer", "evaluated", "Number of growths and operators that ran so far."},
        {"fun(self: any): lissom.Strands", "hair",
         "The hair of all layers that are on, new strands. Only what follows a change is "
         "evaluated again: a curve, an option, the order, a layer below."},
        {"fun(self: any, layer: any, operator: integer, options: table): lissom.Groom", "set",
         "Changes options of an operator. " + which},
        {"fun(self: any, layer: any, operator: integer?, on: boolean): lissom.Groom", "switch",
         "Switches an operator off or on, or, without one, the layer."},
        {"fun(self: any, layer: any, operator: table, place: integer?): lissom.Groom", "insert",
         "Puts an operator before a place, or behind all."},
        {"fun(self: any, layer: any, operator: integer): lissom.Groom", "remove",
         "Takes an operator out."},
        {"fun(self: any, layer: any, options: table): lissom.Groom", "grow",
         "Changes options of the growth of a layer."},
        {"fun(self: any): string[]", "operators", "The names of all operators, in their order."},
        {"fun(self: any, layer: any, operator: integer?): table[]", "options",
         "Options of an operator, or without one of the growth of a layer, that a switch, a slider "
         "or a list sets: declarations as those of lissom.params, with `name` and the `value` "
         "that is set, if any; `above` if `min` itself is excluded. " +
             which},
        {"fun(self: any, layer: any): table", "layer",
         "A layer: its name, style, operators and so on."},
        {"fun(self: any, scene: lissom.Scene, name: string): lissom.Groom", "show",
         "Adds the hair to a scene, unless it is the hair that the groom was made of. From then "
         "on the groom follows undo and redo there: its "
         "text is the comment of that hair. Styles that are objects of the scene too are undone "
         "in place, others are read from the text."},
        {"fun(self: any, step: string?): lissom.Groom", "update",
         "Evaluates the hair in the scene, as a step with this name, \"groom\" by default."},
        {"fun(self: any): string", "text", "The groom with its styles as JSON."},
        {"fun(self: any, path: string): lissom.Groom", "save",
         "Writes that text: lissom.save_groom."}};
}

}  // namespace

std::vector<Function> groom_functions() {
    return {
        {.name = "groom",
         .body = make_groom,
         .summary =
             "Makes a groom: layers of hair, the first below the others, each of a style and an "
             "ordered stack of operators.",
         .options =
             {object("head", "lissom.Mesh", "The head of all styles."),
              table(
                  "layers",
                  "A list of layers, tables with `style`, a lissom.Hairstyle; `grow`, options "
                  "of style:grow; `mask`, the part of the scalp that it grows on: numbers for "
                  "the vertices of the head, function(vertex, x, y, z) or a lissom.Region; "
                  "`operators`, a list of tables that begin with the name of a method of "
                  "lissom.Strands, with its options (push_out, shrinkwrap, cut, braid, bun and "
                  "feed_braid get the layer's head or scalp), and are skipped with `off = "
                  "true`; a braid or a bun without a spine or a center follows the curve of the "
                  "style whose name is `along`, else its first ponytail, as it was drawn; `name`; "
                  "`on`, true by default; `over`, whether it is lifted over the "
                  "layers below, true by default, by `gap` more than they are thick, 0.001 "
                  "metres by default; `collide`, whether hair that operators moved is pushed out "
                  "of the head at the end, true by default. Functions of vertices are asked once.")
                  .optional("those of `hair`"),
              object("hair", "lissom.Strands", "Hair of a groom in a scene, to go on with it.")
                  .optional("none"),
              object("scalp", "lissom.Scalp", "With `hair`: the scalp of its styles.")
                  .optional("guessed")},
         .results = {{"lissom.Groom", "groom", "The groom."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::file_syntax, ErrorCode::unsupported,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kGroomExample + R"(assert(#groom:hair() == 100 and groom.evaluated == 4)
groom:set("all", 2, { spread = 0.002 }):hair()
assert(groom.evaluated == 6))"},
        {.name = "load_groom",
         .body = load_groom,
         .summary = "Reads a groom for a head, which may be another than it was made on.",
         .arguments = {string("path", "The JSON file."),
                       object("head", "lissom.Mesh", "The head that it goes on.")},
         .options =
             {object("scalp", "lissom.Scalp", "The scalp of its styles.").optional("guessed")},
         .results = {{"lissom.Groom", "groom", "The groom."}},
         .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory,
                    ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::unsupported,
                    ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kGroomExample + R"(local path = os.tmpname()
groom:save(path)
assert(lissom.load_groom(path, head):hair():hash() == groom:hair():hash())
os.remove(path))"},
        {.name = "save_groom",
         .body = save_groom,
         .summary = "Writes a groom with its styles as JSON that people can read and edit.",
         .arguments = {table("groom", "A groom."), string("path", "The file.")},
         .results = {{"lissom.Groom", "groom", "The groom."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::file_write_failed,
                    ErrorCode::file_is_directory, ErrorCode::cancelled},
         .example = kGroomExample + R"(local path = os.tmpname()
lissom.save_groom(groom, path)
os.remove(path))"}};
}

std::vector<Record> groom_records() {
    return {{"lissom.Groom", "Layers of hair and their operators.", groom_fields()}};
}

}  // namespace lissom::lua
