// Every real file has an expected outcome in outcomes.tsv: what it loads as, what is mended, or why
// it is refused.
#include <fstream>
#include <map>
#include <sstream>

#include "tests/data/data_files.h"

namespace lissom::test {
namespace {

// "V F components boundaries kind=count ..." or the code of the error.
std::string outcome_of(const std::filesystem::path& path) {
    try {
        const Mesh mesh = load_mesh(path);
        const Topology& topology = mesh.topology();
        std::ostringstream text;
        text << mesh.vertex_count() << ' ' << mesh.face_count() << ' ' << topology.component_count()
             << ' ' << topology.boundary_loops().size();
        for (const Finding& finding : mesh.report().findings())
            text << ' ' << finding_name(finding.kind) << '=' << finding.count;
        return text.str();
    } catch (const Error& error) {
        return std::string(code_name(error.code()));
    }
}

// Lines "file<TAB>outcome"; those that start with # say why.
std::map<std::string, std::string> expected_outcomes() {
    const char* root = std::getenv("LISSOM_SOURCE_DIR");
    REQUIRE(root);
    std::ifstream file(std::filesystem::path(root) / "tests/data/outcomes.tsv");
    REQUIRE(file);
    std::map<std::string, std::string> table;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        const auto tab = line.find('\t');
        REQUIRE(tab != std::string::npos);
        table[line.substr(0, tab)] = line.substr(tab + 1);
    }
    return table;
}

}  // namespace

TEST_CASE("every file has the outcome that the table gives it") {
    const std::filesystem::path root = data_root();
    if (root.empty()) return;
    auto expected = expected_outcomes();
    for (const std::string& file : mesh_files(root)) {
        CAPTURE(file);
        const auto row = expected.find(file);
        CHECK_MESSAGE(row != expected.end(), file << " is not in the table");
        if (row == expected.end()) continue;
        CHECK(outcome_of(root / file) == row->second);
        expected.erase(row);
    }
    for (const auto& row : expected) skip("LISSOM_REQUIRE_DATA", row.first);
}

TEST_CASE("without repair, what would be mended is refused") {
    const std::filesystem::path root = data_root();
    if (root.empty()) return;
    for (const auto& row : expected_outcomes()) {
        const std::string &file = row.first, &outcome = row.second;
        if (!std::filesystem::exists(root / file) || file.starts_with("gltf")) continue;
        CAPTURE(file);
        const bool is_loaded = outcome.find(' ') != std::string::npos;
        const auto has = [&](std::string_view kind) {
            return outcome.find(" " + std::string(kind)) != std::string::npos;
        };
        const bool is_mended =
            has("vertices_unreferenced") || has("corners_repeated") || has("faces_collapsed") ||
            has("faces_pinched") || has("faces_duplicate") || has("faces_flipped") ||
            has("edges_nonmanifold") || has("edges_unorientable") || has("faces_zero_area");
        if (!is_loaded || !is_mended) continue;
        CHECK_THROWS_AS(load_mesh(root / file, {.weld = std::nullopt, .repair = false}), Error);
    }
}

}  // namespace lissom::test
