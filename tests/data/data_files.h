/// The real files that the tests of this folder go through.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/io/mesh_file.h"
#include "tests/unit/support.h"

namespace lissom::test {

/// The folders below the test data that hold meshes.
inline constexpr const char* kMeshFolders[] = {"models", "heads", "nasty", "gltf",
                                               "gltf_validator"};

/// Root of the test data; empty, with a message, where it is absent.
inline std::filesystem::path data_root() {
    const char* root = std::getenv("LISSOM_TEST_DATA");
    if (root && std::filesystem::exists(root)) return root;
    skip("LISSOM_REQUIRE_DATA", std::string("the folder of real files ") + (root ? root : ""));
    return {};
}

/// All mesh files, relative to the root and with forward slashes, in order.
inline std::vector<std::string> mesh_files(const std::filesystem::path& root) {
    const std::vector<std::string>& known = readable_extensions();
    std::vector<std::string> files;
    for (const char* folder : kMeshFolders) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            std::string extension = entry.path().extension().string();
            for (char& c : extension) c = static_cast<char>(std::tolower(c));
            const bool is_mesh =
                entry.is_regular_file() && !extension.empty() &&
                std::find(known.begin(), known.end(), extension.substr(1)) != known.end();
            if (is_mesh)
                files.push_back(std::filesystem::relative(entry.path(), root).generic_string());
        }
    }
    if (files.empty()) skip("LISSOM_REQUIRE_DATA", "meshes below " + root.string());
    std::sort(files.begin(), files.end());
    return files;
}

/// Calls check(mesh) for every mesh with faces that loads, its file captured; what does not load is
/// the business of the table of outcomes.
template <typename Check>
void for_each_mesh(const Check& check) {
    const std::filesystem::path root = data_root();
    if (root.empty()) return;
    for (const std::string& file : mesh_files(root)) {
        CAPTURE(file);
        Mesh mesh;
        try {
            mesh = load_mesh(root / file);
        } catch (const Error&) {
            continue;
        }
        if (mesh.face_count() > 0) check(mesh);
    }
}

}  // namespace lissom::test
