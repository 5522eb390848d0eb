#include "bindings/cli/file_patterns.h"

#include "tests/unit/bindings/cli/program_run.h"
#include "tests/unit/support.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// What a pattern below `folder` names, relative to its own base.
std::vector<std::string> names(const test::ProgramFolder& folder, const std::string& pattern) {
    std::vector<std::string> list;
    for (const MatchedFile& file : expand_pattern(folder.path(pattern)).files) {
        list.push_back(file.relative.generic_string());
        CHECK(fs::exists(file.path));
    }
    return list;
}

using Names = std::vector<std::string>;

TEST_CASE("wildcards stand for characters") {
    CHECK(matches_wildcards("a.obj", "*.obj"));
    CHECK(matches_wildcards("a.obj", "?.obj"));
    CHECK(matches_wildcards("a.obj", "**"));
    CHECK(matches_wildcards("abcab", "*ab"));
    CHECK(matches_wildcards("", "*"));
    CHECK(matches_wildcards("\xc3\xa4.obj", "?.obj"));
    CHECK_FALSE(matches_wildcards("", "?"));
    CHECK_FALSE(matches_wildcards("ab.obj", "?.obj"));
    CHECK_FALSE(matches_wildcards("a.obj", "*.ply"));
    CHECK_FALSE(matches_wildcards("a.obj", "a"));
    CHECK_FALSE(matches_wildcards(std::string(2000, 'a'), "*a*a*a*a*a*a*a*a*b"));
}

TEST_CASE("patterns name mesh files in names, folders and any folders") {
    const test::ProgramFolder folder;
    for (const char* name : {"a/one.obj", "a/two.PLY", "a/note.txt", "a/.hidden.obj", "a/b/one.obj",
                             "a/b/c/three.stl", "a/.git/four.obj", "d/one.obj"}) {
        folder.write(name, "x");
    }
    CHECK(names(folder, "a/*") == Names{"one.obj", "two.PLY"});
    CHECK(names(folder, "a/*.obj") == Names{"one.obj"});
    CHECK(names(folder, "a/.*") == Names{".hidden.obj"});
    CHECK(names(folder, "a") == Names{"one.obj", "two.PLY"});
    CHECK(names(folder, "a/") == Names{"one.obj", "two.PLY"});
    CHECK(names(folder, "a/**/*.obj") == Names{"b/one.obj", "one.obj"});
    CHECK(names(folder, "a/**") == Names{"b/c/three.stl", "b/one.obj", "one.obj", "two.PLY"});
    CHECK(names(folder, "a/**/**/one.obj") == Names{"b/one.obj", "one.obj"});
    CHECK(names(folder, "?/one.obj") == Names{"a/one.obj", "d/one.obj"});
    CHECK(names(folder, "*/b/*") == Names{"a/b/one.obj"});
    CHECK(names(folder, "a/note.txt") == Names{"note.txt"});
    CHECK(names(folder, "none/*.obj").empty());
    CHECK(expand_pattern(folder.path("missing.obj")).files.size() == 1);
}

TEST_CASE("patterns find hair, as far as kinds or their own extensions ask for it") {
    const test::ProgramFolder folder;
    for (const char* name : {"a/head.obj", "a/curls.usda", "a/curls.HAIR", "a/straight.data",
                             "a/all.lissom", "a/n.txt"}) {
        folder.write(name, "x");
    }
    CHECK(names(folder, "a/*.usda") == Names{"curls.usda"});
    CHECK(names(folder, "a/*.hair") == Names{});
    CHECK(names(folder, "a/*.HAIR") == Names{"curls.HAIR"});
    CHECK(names(folder, "a/*.lissom") == Names{"all.lissom"});
    CHECK(names(folder, "a") == Names{"curls.HAIR", "curls.usda", "head.obj", "straight.data"});
    const auto found = [&](const char* pattern, FileKinds kinds) {
        return expand_pattern(folder.path(pattern), kinds).files.size();
    };
    CHECK(found("a", {.meshes = true, .hair = false}) == 1);
    CHECK(found("a/*", {.meshes = false, .hair = true}) == 3);
    CHECK(found("a/*.usda", {.meshes = true, .hair = false}) == 1);
    CHECK(found("a/*.obj", {.meshes = false, .hair = true}) == 1);
    CHECK(expand_pattern(folder.path("a/*.txt")).passed_over == 1);
}

}  // namespace
}  // namespace lissom::cli
