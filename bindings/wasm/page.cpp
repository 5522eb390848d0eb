// What a page calls: functions of numbers and texts over lissom.h. The module has one context,
// whose scripts all run in one Lua state, and one place for lists that were read last.
//
// Functions return 1 if they succeed; page_answer is then the JSON of the result, else of the
// error:
// {"status", "code", "message"}. Objects are their numbers, as in the JSON of lissom_call.
#include <emscripten.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/c/lissom.h"
#include "bindings/wasm/drawn_mesh.h"

// clang-format off
EM_JS(void, give_log, (int level, const char* text), {
    if (Module.lissomLog) Module.lissomLog(level, UTF8ToString(text));
});
EM_JS(void, give_progress, (const char* label, double fraction), {
    if (Module.lissomProgress) Module.lissomProgress(UTF8ToString(label), fraction);
});
// clang-format on

namespace {

// The names of lists that a page reads.
enum List { positions, normals, vertices, edges, colors, points, offsets, widths, list_count };

struct Page {
    lissom_context* context = nullptr;
    lissom_script script{};
    std::string answer;
    // Meshes that a hand works on, by their numbers.
    std::map<double, lissom::wasm::KeptMesh> kept;
    std::vector<std::uint8_t> lists[list_count];
};

Page page;

std::string quoted(std::string_view text) {
    std::string json = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            json += '\\';
            json += c;
        } else if (code < 0x20) {
            constexpr const char* kHex = "0123456789abcdef";
            json += "\\u00";
            json += kHex[code >> 4];
            json += kHex[code & 15];
        } else {
            json += c;
        }
    }
    return json + '"';
}

bool fail(std::string_view code, std::string_view message, int status) {
    page.answer = "{\"status\":" + std::to_string(status) + ",\"code\":" + quoted(code) +
                  ",\"message\":" + quoted(message) + "}";
    return false;
}

bool is_done(lissom_status status) {
    if (status == LISSOM_OK) return true;
    const lissom_error* error = lissom_last_error(page.context);
    return fail(error->code, error->message, error->status);
}

void keep_json(const lissom_bytes& json) {
    page.answer.assign(static_cast<const char*>(json.data), json.size);
}

template <typename Number>
void keep_list(List list, const std::vector<Number>& values) {
    std::vector<std::uint8_t>& bytes = page.lists[list];
    bytes.resize(values.size() * sizeof(Number));
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
}

// Room for `count` elements of `size` bytes.
lissom_output room(List list, std::size_t count, std::size_t size, lissom_format format) {
    page.lists[list].resize(count * size);
    return {page.lists[list].data(), count, 0, format};
}

lissom_mesh mesh_of(double id) {
    return {static_cast<std::uint64_t>(id)};
}

lissom_strands strands_of(double id) {
    return {static_cast<std::uint64_t>(id)};
}

// The attribute "color" of vertices, if there is one: three or four floats each.
void keep_colors(lissom_mesh mesh) {
    page.lists[colors].clear();
    lissom_attribute found = lissom_default_attribute();
    if (lissom_mesh_find_attribute(page.context, mesh, "color", &found) != LISSOM_OK) return;
    if (found.domain != LISSOM_ON_VERTICES) return;
    const auto count = static_cast<std::size_t>(found.count);
    const std::size_t bytes = static_cast<std::size_t>(found.width) * sizeof(float);
    const lissom_output values = room(colors, count, bytes, LISSOM_FLOAT32);
    if (lissom_mesh_read_attribute(page.context, mesh, "color", &values) != LISSOM_OK) {
        page.lists[colors].clear();
    }
}

}  // namespace

extern "C" {

/// Begins anew: frees all objects, forgets the Lua state. `memory` bytes is the most; 0 is no
/// limit.
EMSCRIPTEN_KEEPALIVE bool page_open(double memory) {
    lissom_context_destroy(page.context);
    page.context = nullptr;
    page.script = {};
    page.kept.clear();
    lissom_context_options options = lissom_default_context_options();
    options.log = [](void*, lissom_log_level level, const char* text) { give_log(level, text); };
    options.progress = [](void*, const char* label, double fraction) {
        give_progress(label, fraction);
    };
    options.memory_limit = static_cast<std::size_t>(memory);
    const lissom_status status = lissom_context_create(&options, &page.context);
    if (status == LISSOM_OK) return true;
    return fail(lissom_status_name(status), lissom_status_explanation(status), status);
}

/// Lets scripts from now on run in a sandbox for at most so many seconds a run.
EMSCRIPTEN_KEEPALIVE bool page_sandbox(double seconds) {
    lissom_sandbox_options options = lissom_default_sandbox_options();
    options.seconds = seconds;
    return is_done(lissom_sandbox_scripts(page.context, &options));
}

EMSCRIPTEN_KEEPALIVE const char* page_answer() {
    return page.answer.c_str();
}

/// Loads a script in place of the one before; the answer is its parameters.
EMSCRIPTEN_KEEPALIVE bool page_load(const char* text, const char* name) {
    if (page.script.id != 0) lissom_script_release(page.context, page.script);
    page.script = {};
    lissom_bytes json{};
    if (!is_done(lissom_script_load(page.context, text, std::strlen(text), name, &page.script))) {
        return false;
    }
    if (!is_done(lissom_script_parameters(page.context, page.script, &json))) return false;
    keep_json(json);
    return true;
}

EMSCRIPTEN_KEEPALIVE bool page_set(const char* parameter, const char* value) {
    return is_done(lissom_script_set(page.context, page.script, parameter, value));
}

/// Runs the loaded script; the answer is the list of its results.
EMSCRIPTEN_KEEPALIVE bool page_run(const char* arguments) {
    lissom_bytes json{};
    const char* given = *arguments == '\0' ? nullptr : arguments;
    if (!is_done(lissom_script_run(page.context, page.script, given, &json))) return false;
    keep_json(json);
    return true;
}

/// lissom_call.
EMSCRIPTEN_KEEPALIVE bool page_call(const char* name, const char* arguments) {
    lissom_bytes json{};
    if (!is_done(lissom_call(page.context, name, arguments, &json))) return false;
    keep_json(json);
    return true;
}

/// Forgets the number of an object of a result, by the type that stands beside it there. The object
/// goes on if scripts have it.
EMSCRIPTEN_KEEPALIVE bool page_release(double id, const char* type) {
    const std::string_view kind(type);
    page.kept.erase(id);
    if (kind == "lissom.Mesh") return is_done(lissom_mesh_release(page.context, mesh_of(id)));
    if (kind == "lissom.Strands") {
        return is_done(lissom_strands_release(page.context, strands_of(id)));
    }
    const auto number = static_cast<std::uint64_t>(id);
    if (kind == "lissom.Region") return is_done(lissom_region_release(page.context, {number}));
    if (kind == "lissom.Hairstyle") {
        return is_done(lissom_hairstyle_release(page.context, {number}));
    }
    if (kind == "lissom.Deformer") return is_done(lissom_deformer_release(page.context, {number}));
    return is_done(lissom_object_release(page.context, {number}));
}

/// Reads a mesh into the lists positions, normals, vertices, edges and colors.
EMSCRIPTEN_KEEPALIVE bool page_read_mesh(double id, double crease) {
    lissom::wasm::DrawnMesh drawn;
    if (!is_done(lissom::wasm::draw_mesh(page.context, mesh_of(id), crease, drawn))) return false;
    keep_list(positions, drawn.positions);
    keep_list(normals, drawn.normals);
    keep_list(vertices, drawn.vertices);
    keep_list(edges, drawn.edges);
    keep_colors(mesh_of(id));
    return true;
}

/// Reads a mesh that may have changed since it was read by this function. The answer is 0 for no
/// change of places and faces, 1 for other places: the lists positions and normals are read, 2 for
/// other faces: vertices and edges, too. The list colors is read always.
EMSCRIPTEN_KEEPALIVE bool page_read_change(double id, double crease) {
    lissom::wasm::DrawnMesh drawn;
    lissom::wasm::MeshChange change{};
    const lissom_status status =
        lissom::wasm::draw_change(page.context, mesh_of(id), crease, page.kept[id], drawn, change);
    if (!is_done(status)) return false;
    keep_list(positions, drawn.positions);
    keep_list(normals, drawn.normals);
    keep_list(vertices, drawn.vertices);
    keep_list(edges, drawn.edges);
    keep_colors(mesh_of(id));
    page.answer = std::to_string(static_cast<int>(change));
    return true;
}

/// From now on a mesh is new to page_read_change.
EMSCRIPTEN_KEEPALIVE void page_forget_mesh(double id) {
    page.kept.erase(id);
}

/// Reads the vertices of a region into the list vertices.
EMSCRIPTEN_KEEPALIVE bool page_read_region(double id) {
    const lissom_region region{static_cast<std::uint64_t>(id)};
    const auto size = static_cast<std::size_t>(lissom_region_size(page.context, region));
    const lissom_output list = room(vertices, size, sizeof(std::uint32_t), LISSOM_UINT32);
    return is_done(lissom_region_read_vertices(page.context, region, &list));
}

/// The same of a region of a mesh by its name.
EMSCRIPTEN_KEEPALIVE bool page_read_named_region(double mesh, const char* name) {
    lissom_region region{};
    if (!is_done(lissom_region_named(page.context, mesh_of(mesh), name, &region))) return false;
    const bool done = page_read_region(static_cast<double>(region.id));
    lissom_region_release(page.context, region);
    return done;
}

/// Reads an open boundary, from 0, into the list vertices.
EMSCRIPTEN_KEEPALIVE bool page_read_boundary(double mesh, int number) {
    int32_t count = 0;
    if (!is_done(lissom_mesh_read_boundary(page.context, mesh_of(mesh), number, nullptr, &count))) {
        return false;
    }
    const lissom_output list =
        room(vertices, static_cast<std::size_t>(count), sizeof(std::uint32_t), LISSOM_UINT32);
    return is_done(lissom_mesh_read_boundary(page.context, mesh_of(mesh), number, &list, &count));
}

EMSCRIPTEN_KEEPALIVE int page_boundary_count(double mesh) {
    return lissom_mesh_boundary_count(page.context, mesh_of(mesh));
}

/// Reads strands into the lists points, offsets, widths and, if they have them, colors, all but
/// the offsets one a point.
EMSCRIPTEN_KEEPALIVE bool page_read_strands(double id) {
    const lissom_strands strands = strands_of(id);
    const auto count = static_cast<std::size_t>(lissom_strands_size(page.context, strands));
    const auto all = static_cast<std::size_t>(lissom_strands_point_count(page.context, strands));
    const lissom_output places = room(points, all, 3 * sizeof(float), LISSOM_FLOAT32);
    if (!is_done(lissom_strands_read_points(page.context, strands, &places))) return false;
    const lissom_output starts = room(offsets, count + 1, sizeof(std::uint32_t), LISSOM_UINT32);
    if (!is_done(lissom_strands_read_offsets(page.context, strands, &starts))) return false;
    const lissom_output across = room(widths, all, sizeof(float), LISSOM_FLOAT32);
    if (!is_done(
            lissom_strands_read_at_points(page.context, strands, LISSOM_STRAND_WIDTH, &across))) {
        return false;
    }
    page.lists[colors].clear();
    if (lissom_strands_has(page.context, strands, LISSOM_STRAND_COLOR) != 1) return true;
    const lissom_output rgb = room(colors, all, 3 * sizeof(float), LISSOM_FLOAT32);
    return is_done(lissom_strands_read_at_points(page.context, strands, LISSOM_STRAND_COLOR, &rgb));
}

/// Reads a list of one number a vertex, or an attribute of vertices by its name, into the list
/// colors.
EMSCRIPTEN_KEEPALIVE bool page_read_numbers(double id) {
    const lissom_object numbers{static_cast<std::uint64_t>(id)};
    const auto size = static_cast<std::size_t>(lissom_numbers_size(page.context, numbers));
    if (lissom_numbers_width(page.context, numbers) != 1) {
        return fail("invalid_argument", "one number a vertex is drawn", LISSOM_INVALID_ARGUMENT);
    }
    const lissom_output values = room(colors, size, sizeof(float), LISSOM_FLOAT32);
    return is_done(lissom_numbers_read(page.context, numbers, &values));
}
EMSCRIPTEN_KEEPALIVE bool page_read_attribute(double mesh, const char* name) {
    lissom_attribute found = lissom_default_attribute();
    if (!is_done(lissom_mesh_find_attribute(page.context, mesh_of(mesh), name, &found))) {
        return false;
    }
    if (found.domain != LISSOM_ON_VERTICES || found.width != 1) {
        return fail("invalid_argument", "one number a vertex is drawn", LISSOM_INVALID_ARGUMENT);
    }
    const auto count = static_cast<std::size_t>(found.count);
    const lissom_output values = room(colors, count, sizeof(float), LISSOM_FLOAT32);
    return is_done(lissom_mesh_read_attribute(page.context, mesh_of(mesh), name, &values));
}

EMSCRIPTEN_KEEPALIVE int page_vertex_count(double mesh) {
    return lissom_mesh_vertex_count(page.context, mesh_of(mesh));
}
EMSCRIPTEN_KEEPALIVE int page_face_count(double mesh) {
    return lissom_mesh_face_count(page.context, mesh_of(mesh));
}

/// The metres of a unit of a mesh that strands grow on, by the places of their roots there; 0 if
/// they tell none.
EMSCRIPTEN_KEEPALIVE double page_root_unit(double strands, double mesh) {
    return lissom::wasm::root_unit(page.context, strands_of(strands), mesh_of(mesh));
}

/// The address of a list that was read last, and its bytes.
EMSCRIPTEN_KEEPALIVE const void* page_list(int list) {
    return page.lists[list].data();
}
EMSCRIPTEN_KEEPALIVE int page_list_bytes(int list) {
    return static_cast<int>(page.lists[list].size());
}

/// Bytes of the context's objects and operations.
EMSCRIPTEN_KEEPALIVE double page_memory() {
    return static_cast<double>(lissom_memory_used(page.context));
}

EMSCRIPTEN_KEEPALIVE const char* page_version() {
    return lissom_version_text();
}

}  // extern "C"
