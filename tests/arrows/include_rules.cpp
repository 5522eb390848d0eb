#include "tests/arrows/include_rules.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

namespace lissom::test {
namespace {

using Names = std::vector<std::string_view>;

/// What one file, or the files of one folder, may include. The longest matching rule counts.
struct Rule {
    std::string_view folder;
    Names project;
    Names libraries;
};

const std::vector<Rule>& rules() {
    static const std::vector<Rule> table = {
        {"kernel/core", {"kernel/core"}, {"Eigen", "TBB"}},
        {"kernel/core/large_pages.cpp", {"kernel/core"}, {"platform"}},
        {"kernel/core/machine_memory.cpp", {"kernel/core"}, {"platform"}},
        {"kernel/core/tbb_functions.cpp", {"kernel/core"}, {"TBB", "platform"}},
        {"kernel/solve", {"kernel/core", "kernel/solve"}, {"Eigen"}},
        {"kernel/cholmod", {"kernel/core", "kernel/solve", "kernel/cholmod"}, {"Eigen", "CHOLMOD"}},
        {"kernel/mesh", {"kernel/core", "kernel/solve", "kernel/mesh"}, {"Eigen", "OpenMesh"}},
        {"kernel/deform",
         {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/deform"},
         {"Eigen"}},
        {"kernel/merge",
         {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/deform", "kernel/merge"},
         {"Eigen"}},
        {"kernel/thesis",
         {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/deform", "kernel/merge",
          "kernel/hair", "kernel/thesis"},
         {"Eigen"}},
        {"kernel/hair", {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/hair"}, {"Eigen"}},
        {"kernel/hair/growth/growth_lanes.h", {"kernel/core"}, {"intrinsics"}},
        {"kernel/sketch",
         {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/sketch"},
         {"Eigen"}},
        {"kernel/scene",
         {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/deform", "kernel/merge",
          "kernel/hair", "kernel/sketch", "kernel/io", "kernel/scene"},
         {"Eigen", "JSON"}},
        {"kernel/io",
         {"kernel/core", "kernel/solve", "kernel/mesh", "kernel/deform", "kernel/merge",
          "kernel/hair", "kernel/sketch", "kernel/io"},
         {"Eigen", "tinygltf", "JSON", "platform"}},
        {"kernel/io/gltf/file/draco.cpp", {"kernel/core", "kernel/io"}, {"Draco"}},
        {"kernel/io/gltf/file/meshopt.cpp", {"kernel/core", "kernel/io"}, {"meshoptimizer"}},
        {"kernel/io/png16.cpp", {"kernel/core", "kernel/io"}, {"Eigen", "stb"}},
        {"bindings/c", {"kernel", "bindings/c"}, {"Eigen"}},
        {"bindings/c/lissom.h", {}, {"platform"}},
        {"bindings/c/thesis_parts.cpp", {"kernel", "kernel/thesis", "bindings/c"}, {}},
        {"bindings/c/script", {"kernel", "bindings/c", "bindings/lua"}, {"Eigen", "Lua", "JSON"}},
        {"bindings/wasm", {"bindings/c", "bindings/wasm"}, {"platform"}},
        {"bindings/engine", {}, {"platform"}},
        {"bindings/lua", {"kernel", "bindings/lua"}, {"Eigen", "Lua"}},
        {"bindings/lua/deform/thesis_parts.cpp", {"kernel", "kernel/thesis", "bindings/lua"}, {}},
        {"bindings/cli",
         {"kernel", "bindings"},
         {"Eigen", "Lua", "CLI11", "JSON", "printing", "platform"}},
        {"bindings/cli/terminal/libedit.h", {}, {"libedit"}},
        {"bindings/cli/terminal/libedit.cpp", {"bindings/cli"}, {"libedit", "platform"}},
        {"viewer",
         {"kernel", "bindings", "viewer"},
         {"Eigen", "Lua", "OpenGL", "CLI11", "JSON", "stb", "printing", "platform"}},
        {"viewer/render", {"kernel", "viewer/render"}, {"Eigen", "OpenGL", "stb", "platform"}},
        {"viewer/window",
         {"kernel", "bindings", "viewer"},
         {"Eigen", "Lua", "OpenGL", "CLI11", "JSON", "printing", "platform"}},
        {"viewer/window/screen/glfw_window.cpp", {"kernel", "viewer"}, {"OpenGL", "GLFW"}},
        {"viewer/window/screen/glfw_functions.cpp", {}, {"GLFW", "platform"}},
        {"viewer/window/panel/drawn_lists.cpp", {"viewer"}, {"ImGui"}},
        {"viewer/window/panel/panel.cpp", {"kernel", "bindings", "viewer"}, {"ImGui"}},
        {"viewer/window/panel/panel_style.cpp", {"viewer"}, {"ImGui"}},
        {"viewer/window/panel/panel_input.cpp", {"viewer"}, {"ImGui"}},
        {"viewer/window/panel/prompt.cpp", {"viewer"}, {"ImGui"}},
        {"viewer/window/panel/boundary_pick.cpp", {"kernel", "bindings", "viewer"}, {"ImGui"}},
        {"viewer/window/panel/console_view.cpp", {"viewer"}, {"ImGui"}},
        {"viewer/window/panel/side_view.cpp", {"viewer"}, {"ImGui", "printing", "platform"}},
        {"viewer/window/panel/tool_panel.cpp", {"kernel", "bindings", "viewer"}, {"ImGui"}},
        {"viewer/window/panel/parameter_widgets.cpp", {"kernel", "bindings", "viewer"}, {"ImGui"}},
        {"viewer/window/panel/text_history.cpp", {"viewer"}, {"ImGui"}},
        {"examples", {"kernel", "bindings/c"}, {"printing", "platform"}},
        {"examples/engine", {"bindings/engine"}, {"OpenGL", "GLFW", "stb", "platform"}},
        {"tests/bench",
         {"kernel", "kernel/thesis", "bindings", "viewer", "tests"},
         {"Eigen", "CGAL", "OpenMesh", "OpenGL", "tinygltf", "JSON", "CHOLMOD", "printing",
          "platform"}},
        {"tests/unit/solve/sparse/cholmod_oracle.cpp", {"kernel", "tests"}, {"Eigen", "CHOLMOD"}},
        {"tests",
         {"kernel", "kernel/thesis", "bindings", "viewer", "tests"},
         {"Eigen", "Lua", "CLI11", "JSON", "stb", "OpenGL", "doctest", "printing", "platform"}},
    };
    return table;
}

/// The rooms of each module, folders or single files without their extension: a room may include
/// those before it, and itself.
const std::vector<Names>& room_orders() {
    static const std::vector<Names> orders = {
        {"kernel/solve/sparse", "kernel/solve/grid", "kernel/solve/dual", "kernel/solve/field"},
        {"kernel/mesh", "kernel/mesh/measure", "kernel/mesh/query", "kernel/mesh/edit",
         "kernel/mesh/repair", "kernel/mesh/render", "kernel/mesh/cut",
         "kernel/mesh/edit/symmetrize", "kernel/mesh/fill", "kernel/mesh/parameterize",
         "kernel/mesh/unwrap", "kernel/mesh/shapes"},
        {"kernel/deform/mesh_point",  "kernel/deform/options",
         "kernel/deform/patch",       "kernel/deform/rotation",
         "kernel/deform/holds",       "kernel/deform/system",
         "kernel/deform/volume",      "kernel/deform/comparison_method",
         "kernel/deform/stats",       "kernel/deform/pipeline",
         "kernel/deform/rest_shape",  "kernel/deform/levels",
         "kernel/deform/preparation", "kernel/deform/deform_report",
         "kernel/deform/frame",       "kernel/deform",
         "kernel/deform/attach",      "kernel/deform/bones",
         "kernel/deform/boundary",    "kernel/deform/contact",
         "kernel/deform/pins",        "kernel/deform/poses"},
        {"kernel/merge/provenance", "kernel/merge/loop", "kernel/merge/piece", "kernel/merge/sheet",
         "kernel/merge/sew", "kernel/merge/blend", "kernel/merge",
         "kernel/merge/paste/paste_options", "kernel/merge/paste/region",
         "kernel/merge/paste/placement", "kernel/merge/paste/search", "kernel/merge/paste/part",
         "kernel/merge/paste/erase", "kernel/merge/paste"},
        {"kernel/hair/field", "kernel/hair/scalp", "kernel/hair/curve", "kernel/hair/strands",
         "kernel/hair/follow/strand_roots", "kernel/hair/strands/strand_edge",
         "kernel/hair/strands/strand_place", "kernel/hair/growth/growth_lanes",
         "kernel/hair/growth/lane_vectors", "kernel/hair/follow", "kernel/hair/guides",
         "kernel/hair/cards", "kernel/hair/levels", "kernel/hair/operators", "kernel/hair/transfer",
         "kernel/hair/dynamics", "kernel/hair/growth", "kernel/hair"},
        {"kernel/sketch", "kernel/sketch/support"},
        {"kernel/io/stream", "kernel/io/record", "kernel/io/gltf/file", "kernel/io/gltf/mesh",
         "kernel/io/gltf", "kernel/io/obj", "kernel/io/off", "kernel/io/ply", "kernel/io/stl",
         "kernel/io/usda", "kernel/io/hair", "kernel/io/poses", "kernel/io"},
        {"bindings/lua/core", "bindings/lua/host", "bindings/lua/sandbox", "bindings/lua/mesh",
         "bindings/lua/deform", "bindings/lua/merge", "bindings/lua/hair", "bindings/lua/scene",
         "bindings/lua/sketch", "bindings/lua/tools", "bindings/lua/reference"},
        {"bindings/cli/terminal", "bindings/cli/process", "bindings/cli/test/picture_check",
         "bindings/cli", "bindings/cli/test"},
        {"viewer/render/draw/image", "viewer/render/draw", "viewer/render/strands",
         "viewer/render/cards", "viewer/render/gl", "viewer/render", "viewer/lua",
         "viewer/window/screen", "viewer/window/tools", "viewer/window/session",
         "viewer/window/document", "viewer/window/session/session", "viewer/window/makers",
         "viewer/window/panel", "viewer/window/app", "viewer/window", "viewer/main"},
    };
    return orders;
}

bool inside(std::string_view path, std::string_view folder) {
    return path.size() > folder.size() && path.starts_with(folder) && path[folder.size()] == '/';
}

const Rule* rule_for(std::string_view path) {
    const Rule* best = nullptr;
    for (const Rule& rule : rules())
        if ((path == rule.folder || inside(path, rule.folder)) &&
            (!best || rule.folder.size() > best->folder.size()))
            best = &rule;
    return best;
}

/// The library that an angled include belongs to; empty for the C++ standard library. Headers that
/// nobody claims are those of the platform.
std::string_view library_of(std::string_view header) {
    struct Prefix {
        std::string_view prefix, library;
    };
    static constexpr Prefix kPrefixes[] = {
        {"Eigen/", "Eigen"},
        {"unsupported/Eigen/", "Eigen"},
        {"OpenMesh/", "OpenMesh"},
        {"cholmod", "CHOLMOD"},
        {"suitesparse/", "CHOLMOD"},
        {"SuiteSparse", "CHOLMOD"},
        {"tbb/", "TBB"},
        {"oneapi/", "TBB"},
        {"lua", "Lua"},
        {"lauxlib.h", "Lua"},
        {"epoxy/", "OpenGL"},
        {"GL/", "OpenGL"},
        {"EGL/", "OpenGL"},
        {"KHR/", "OpenGL"},
        {"GLFW/", "GLFW"},
        {"imgui", "ImGui"},
        {"backends/imgui", "ImGui"},
        {"CLI/", "CLI11"},
        {"nlohmann/", "JSON"},
        {"tiny_gltf.h", "tinygltf"},
        {"draco/", "Draco"},
        {"meshoptimizer.h", "meshoptimizer"},
        {"stb", "stb"},
        {"doctest/", "doctest"},
        {"histedit.h", "libedit"},
        {"omp.h", "OpenMP"},
        {"CGAL/", "CGAL"},
        {"immintrin.h", "intrinsics"},
        {"wasm_simd128.h", "intrinsics"},
        {"iostream", "printing"},
        {"print", "printing"},
        {"syncstream", "printing"},
    };
    for (const auto& [prefix, library] : kPrefixes)
        if (header.starts_with(prefix)) return library;
    const bool standard = header.find_first_of("/.") == std::string_view::npos;
    return standard ? std::string_view{} : "platform";
}

struct Include {
    bool quoted = false;
    std::string header;
};

/// The rest of `line` after blanks and `token`; nothing where it does not go on so.
std::optional<std::string_view> after(std::string_view line, std::string_view token) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(token)) return std::nullopt;
    return line.substr(token.size());
}

std::optional<Include> include_of(std::string_view line) {
    const auto directive = after(line, "#");
    const auto name = directive ? after(*directive, "include") : std::nullopt;
    if (!name) return std::nullopt;
    for (const bool quoted : {false, true})
        if (const auto header = after(*name, quoted ? "\"" : "<")) {
            const auto end = header->find(quoted ? '"' : '>');
            if (end == std::string_view::npos) return std::nullopt;
            return Include{quoted, std::string(header->substr(0, end))};
        }
    return std::nullopt;
}

std::vector<Include> includes_of(std::string_view source) {
    std::vector<Include> found;
    std::istringstream lines{std::string(source)};
    for (std::string line; std::getline(lines, line);)
        if (auto include = include_of(line)) found.push_back(*std::move(include));
    return found;
}

/// Headers of the kernel that are not installed, and so may show the libraries of their folder.
bool is_private(std::string_view path) {
    return path.starts_with("kernel/io/gltf/") || path.starts_with("kernel/scene/file/") ||
           path == "kernel/hair/growth/growth_lanes.h" || path == "kernel/io/stream/json_tree.h" ||
           path == "kernel/mesh/half_edges.h";
}

/// The room of `order` that the file at `path` lies in; nothing where it lies in none.
std::optional<std::ptrdiff_t> room_of(const Names& order, std::string_view path) {
    const std::string_view file = path.substr(0, path.find_last_of('.'));
    const std::string_view folder = path.substr(0, std::min(path.find_last_of('/'), path.size()));
    for (const std::string_view wanted : {file, folder}) {
        const auto found = std::find(order.begin(), order.end(), wanted);
        if (found != order.end()) return found - order.begin();
    }
    return std::nullopt;
}

bool rooms_allow(std::string_view path, std::string_view header) {
    return std::none_of(room_orders().begin(), room_orders().end(), [&](const Names& order) {
        const auto from = room_of(order, path), to = room_of(order, header);
        return from && to && *to > *from;
    });
}

// Modules that a rule names itself, or may not know: what knows them by their parent's name would
// not be built without them.
constexpr std::string_view kApart = "kernel/thesis";

bool project_allows(const Rule& rule, std::string_view header) {
    return std::any_of(rule.project.begin(), rule.project.end(), [&](std::string_view folder) {
        const bool apart = inside(header, kApart) && inside(kApart, folder);
        return inside(header, folder) && !apart;
    });
}

bool libraries_allow(const Rule& rule, std::string_view library) {
    return library.empty() ||
           std::find(rule.libraries.begin(), rule.libraries.end(), library) != rule.libraries.end();
}

void check_opening(std::string_view source, std::vector<std::string>& messages) {
    if (!source.starts_with("///")) messages.push_back("does not open with a docstring (///)");
    const auto pragma = source.find("#pragma once\n");
    if (pragma == std::string_view::npos || pragma > source.find("\n#include"))
        messages.push_back("has no #pragma once before its first #include");
}

}  // namespace

std::vector<std::string> include_violations(std::string_view path, std::string_view source) {
    std::vector<std::string> messages;
    const Rule* rule = rule_for(path);
    const bool header_file = path.ends_with(".h");
    if (!rule) return {std::string(path) + ": lies in a folder that has no rule"};
    for (const Include& include : includes_of(source)) {
        if (include.quoted) {
            // Examples are copied, so their files name those beside them without a folder.
            const bool beside =
                inside(path, "examples") && include.header.find('/') == std::string::npos;
            if (beside) continue;
            if (!project_allows(*rule, include.header) || !rooms_allow(path, include.header))
                messages.push_back("may not include \"" + include.header + "\"");
            continue;
        }
        const std::string_view library = library_of(include.header);
        const bool installed = header_file && inside(path, "kernel");
        if (!libraries_allow(*rule, library) ||
            (installed && !is_private(path) && !library.empty() && library != "Eigen"))
            messages.push_back("may not include <" + include.header + "> (" + std::string(library) +
                               ")");
    }
    if (header_file) check_opening(source, messages);
    for (std::string& message : messages) message = std::string(path) + ": " + message;
    return messages;
}

std::vector<std::string> quoted_includes(std::string_view source) {
    std::vector<std::string> headers;
    for (const Include& include : includes_of(source))
        if (include.quoted) headers.push_back(include.header);
    return headers;
}

std::vector<std::string_view> known_modules(std::string_view module) {
    const Rule* rule = rule_for(module);
    std::vector<std::string_view> known;
    if (rule)
        std::remove_copy(rule->project.begin(), rule->project.end(), std::back_inserter(known),
                         module);
    return known;
}

std::vector<std::string_view> rooms_of(std::string_view module) {
    for (const Names& order : room_orders()) {
        const std::string_view first = order.front();
        if (first == module || inside(first, module)) return order;
    }
    return {};
}

}  // namespace lissom::test
