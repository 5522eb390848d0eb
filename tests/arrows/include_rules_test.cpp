#include "tests/arrows/include_rules.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
using lissom::test::include_violations;
using lissom::test::quoted_includes;

constexpr const char* kOpening = "/// What it is.\n#pragma once\n\n";

fs::path root() {
    const char* path = std::getenv("LISSOM_SOURCE_DIR");
    REQUIRE_MESSAGE(path, "LISSOM_SOURCE_DIR must name the root of the source tree");
    return path;
}

/// Path from the root and text of every C and C++ file of the project.
std::vector<std::pair<std::string, std::string>> source_files() {
    std::vector<std::pair<std::string, std::string>> files;
    for (const char* folder : {"kernel", "bindings", "viewer", "examples", "tests"}) {
        if (!fs::exists(root() / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root() / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp" && extension != ".c") continue;
            std::ifstream stream(entry.path(), std::ios::binary);
            files.emplace_back(entry.path().lexically_relative(root()).generic_string(),
                               std::string(std::istreambuf_iterator<char>(stream), {}));
        }
    }
    return files;
}

/// The files that each folder holds itself, whatever their kind.
std::map<std::string, int> files_of_rooms() {
    std::map<std::string, int> result;
    for (const char* folder : {"kernel", "bindings", "viewer", "tests"})
        for (const auto& entry : fs::recursive_directory_iterator(root() / folder))
            if (entry.is_regular_file())
                ++result[entry.path().parent_path().lexically_relative(root()).generic_string()];
    return result;
}

/// Whether a folder has sources that CONTRIBUTING.md's table of rooms is to name.
bool is_room(const std::string& folder) {
    if (folder.starts_with("tests")) return false;
    for (const auto& entry : fs::directory_iterator(root() / folder))
        if (entry.path().extension() == ".cpp") return true;
    return false;
}

std::size_t count(const char* path, const std::string& source) {
    return include_violations(path, source).size();
}

}  // namespace

TEST_CASE("every file of the project includes only what its folder may know") {
    const auto files = source_files();
    CHECK(files.size() > 20);
    for (const auto& [path, source] : files)
        for (const std::string& message : include_violations(path, source)) FAIL_CHECK(message);
}

TEST_CASE(
    "every header included in quotes exists below the root, or beside the file that includes it") {
    for (const auto& file : source_files())
        for (const std::string& header : quoted_includes(file.second)) {
            const bool beside = header.find('/') == std::string::npos;
            const fs::path folder = beside ? fs::path(file.first).parent_path() : fs::path();
            CHECK_MESSAGE(fs::exists(root() / folder / header),
                          file.first << " includes " << header);
        }
}

TEST_CASE("no room has more than thirty files, and CONTRIBUTING.md names each") {
    std::ifstream stream(root() / "CONTRIBUTING.md", std::ios::binary);
    const std::string rules(std::istreambuf_iterator<char>(stream), {});
    const auto rooms = files_of_rooms();
    CHECK(rooms.size() > 90);
    for (const auto& counted : rooms) {
        const auto& room = counted.first;
        const auto files = counted.second;
        CHECK_MESSAGE(files <= 30, room << " has " << files << " files");
        if (is_room(room))
            CHECK_MESSAGE(rules.find("](" + room + ")") != std::string::npos,
                          room << " has no line");
    }
}

TEST_CASE("an arrow that runs back is found") {
    CHECK(count("kernel/core/a.cpp", "#include \"kernel/mesh/mesh.h\"\n") == 1);
    CHECK(count("kernel/solve/a.cpp", "#include \"kernel/mesh/mesh.h\"\n") == 1);
    CHECK(count("kernel/mesh/a.cpp", "#include \"kernel/deform/deformer.h\"\n") == 1);
    CHECK(count("kernel/deform/a.cpp", "#include \"kernel/io/load.h\"\n") == 1);
    CHECK(count("kernel/io/a.cpp", "#include \"bindings/lua/module.h\"\n") == 1);
    CHECK(count("bindings/lua/a.cpp", "#include \"viewer/render/renderer.h\"\n") == 1);
    CHECK(count("viewer/render/a.cpp", "#include \"bindings/lua/module.h\"\n") == 1);
    CHECK(count("kernel/io/a.cpp", "#include \"kernel/thesis/a.h\"\n") == 1);
    CHECK(count("bindings/c/a.cpp", "#include \"kernel/thesis/a.h\"\n") == 1);
    CHECK(count("kernel/core/a.cpp", "  #  include \"viewer/render/renderer.h\"\n") == 1);
    CHECK(count("kernel/core/a.cpp", "#include \"kernel/corex/a.h\"\n") == 1);
    CHECK(count("kernel/core/a.cpp", "#include \"context.h\"\n") == 1);
    CHECK(count("kernel/core/a.cpp", "#include \"../core/context.h\"\n") == 1);
}

TEST_CASE("an arrow between rooms that runs back is found") {
    CHECK(count("kernel/mesh/query/a.cpp", "#include \"kernel/mesh/measure/b.h\"\n") == 0);
    CHECK(count("kernel/mesh/measure/a.cpp", "#include \"kernel/mesh/query/b.h\"\n") == 1);
    CHECK(count("kernel/mesh/a.cpp", "#include \"kernel/mesh/repair/b.h\"\n") == 1);
    CHECK(count("kernel/deform/patch/a.h",
                kOpening + std::string("#include \"kernel/deform/options.h\"\n")) == 0);
    CHECK(count("kernel/deform/patch/a.h",
                kOpening + std::string("#include \"kernel/deform/deformer.h\"\n")) == 1);
    CHECK(count("kernel/io/ply/a.cpp", "#include \"kernel/io/mesh_file.h\"\n") == 1);
    CHECK(count("viewer/main.cpp", "#include \"viewer/lua/render_verb.h\"\n") == 0);
    CHECK(count("viewer/render/renderer.cpp", "#include \"viewer/lua/render_verb.h\"\n") == 1);
}

TEST_CASE("a library outside the folders that own it is found") {
    CHECK(count("kernel/deform/a.cpp", "#include <OpenMesh/Core/Mesh/Handles.hh>\n") == 1);
    CHECK(count("kernel/mesh/a.cpp", "#include <cholmod.h>\n") == 1);
    CHECK(count("kernel/mesh/a.cpp", "#include <tbb/parallel_for.h>\n") == 1);
    CHECK(count("kernel/deform/a.cpp", "#include <iostream>\n") == 1);
    CHECK(count("kernel/deform/a.cpp", "#include <lua.h>\n") == 1);
    CHECK(count("kernel/io/a.cpp", "#include <epoxy/gl.h>\n") == 1);
    CHECK(count("kernel/deform/a.cpp", "#include <unistd.h>\n") == 1);
    CHECK(count("tests/unit/mesh/a.cpp", "#include <OpenMesh/Core/Mesh/Handles.hh>\n") == 1);
}

TEST_CASE("a kernel header shows no library but Eigen") {
    CHECK(count("kernel/mesh/a.cpp", "#include <OpenMesh/Core/Mesh/Handles.hh>\n") == 0);
    CHECK(count("kernel/mesh/a.h", kOpening + std::string("#include <Eigen/Core>\n")) == 0);
    CHECK(count("kernel/io/gltf/a.h", kOpening + std::string("#include <tiny_gltf.h>\n")) == 0);
    CHECK(count("kernel/io/ply/ply.h", kOpening + std::string("#include <tiny_gltf.h>\n")) == 1);
    CHECK(count("kernel/mesh/a.cpp", "#include <tiny_gltf.h>\n") == 1);
    CHECK(count("kernel/mesh/a.h",
                kOpening + std::string("#include <OpenMesh/Core/Mesh/Handles.hh>\n")) == 1);
}

TEST_CASE("a header without its opening is found") {
    CHECK(count("kernel/mesh/a.h", kOpening) == 0);
    CHECK(count("kernel/mesh/a.h", "#pragma once\n") == 1);
    CHECK(count("kernel/mesh/a.h", "/// What it is.\n#include <vector>\n") == 1);
    CHECK(count("kernel/mesh/a.h", "/// What it is.\n#include <vector>\n#pragma once\n") == 1);
}

TEST_CASE("what is allowed is left alone") {
    CHECK(count("kernel/io/a.cpp", "#include \"kernel/mesh/mesh.h\"\n#include <vector>\n") == 0);
    CHECK(count("viewer/a.cpp", "#include \"bindings/lua/module.h\"\n#include <lua.hpp>\n") == 0);
    CHECK(count("kernel/core/a.cpp", "/// #include \"viewer/render/renderer.h\"\n") == 0);
    CHECK(count("elsewhere/a.cpp", "") == 1);
}
