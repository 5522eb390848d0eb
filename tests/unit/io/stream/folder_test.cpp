#include "kernel/io/stream/folder.h"

#include <doctest/doctest.h>

#include <fstream>

#include "kernel/core/error.h"
#include "tests/unit/support.h"

using namespace lissom;
using lissom::test::error_of;
namespace fs = std::filesystem;

namespace {

// An empty place for one test.
struct TestFolder {
    fs::path path = fs::temp_directory_path() / "lissom_folder_test";

    TestFolder() { fs::remove_all(path); }
    ~TestFolder() { fs::remove_all(path); }
    std::string text(const std::string& name) const { return read_from_folder(path, name).bytes; }
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((path / name).parent_path());
        std::ofstream(path / name) << bytes;
    }
};

}  // namespace

TEST_CASE("folder: files are replaced, made and removed, those of others stay") {
    TestFolder folder;
    replace_in_folder(folder.path, {{{"a", "1"}, {"in/b", "2"}, {"in/c", "3"}}, {}});
    CHECK(folder.text("in/b") == "2");
    folder.write("in/notes", "mine");
    folder.write(".git/config", "too");
    const auto time = fs::last_write_time(folder.path / "a");
    replace_in_folder(folder.path, {{{"a", "1"}, {"in/b", "22"}}, {"a", "in/b", "in/c"}});
    CHECK(fs::last_write_time(folder.path / "a") == time);
    CHECK(folder.text("in/b") == "22");
    CHECK_FALSE(has_in_folder(folder.path, "in/c"));
    CHECK(folder.text("in/notes") == "mine");
    CHECK(folder.text(".git/config") == "too");
    replace_in_folder(folder.path, {{{"a", "1"}}, {"a", "in/b"}});
    CHECK(fs::exists(folder.path / "in" / "notes"));
    CHECK_FALSE(fs::exists(folder.path / ".lissom-new"));
    CHECK_FALSE(fs::exists(folder.path / ".lissom-ready"));
}

TEST_CASE("folder: what stands in the way is refused, and all is as it was") {
    TestFolder folder;
    const auto code = [&](const FolderChange& change) {
        const Error error = error_of([&] { replace_in_folder(folder.path, change); });
        CHECK(folder.text("a") == "1");
        CHECK_FALSE(fs::exists(folder.path / ".lissom-new"));
        return error.code();
    };
    replace_in_folder(folder.path, {{{"a", "1"}}, {}});
    CHECK(code({{{"a", "2"}}, {}}) == ErrorCode::file_write_failed);
    CHECK(code({{{"a/b", "2"}}, {"a"}}) == ErrorCode::file_write_failed);
    folder.write("b/c", "");
    CHECK(code({{{"a", "2"}, {"b", "2"}}, {"a", "b"}}) == ErrorCode::file_write_failed);
    const Error error = error_of([&] { replace_in_folder(folder.path / "a", {{{"x", "y"}}, {}}); });
    CHECK(error.code() == ErrorCode::file_write_failed);
    CHECK(error.message().find("is a file") != std::string::npos);
}

TEST_CASE("folder: a cancelled change leaves the old files, or no folder") {
    TestFolder folder;
    Context cancelled;
    cancelled.cancel();
    const FolderChange change{{{"a", "2"}, {"b", "3"}}, {"a"}};
    CHECK(error_of([&] { replace_in_folder(folder.path, change, cancelled); }).code() ==
          ErrorCode::cancelled);
    CHECK_FALSE(fs::exists(folder.path));
    replace_in_folder(folder.path, {{{"a", "1"}}, {}});
    CHECK(error_of([&] { replace_in_folder(folder.path, change, cancelled); }).code() ==
          ErrorCode::cancelled);
    CHECK(folder.text("a") == "1");
    CHECK_FALSE(has_in_folder(folder.path, "b"));
}

TEST_CASE("folder: links lead nowhere outside of it") {
    TestFolder folder, outside;
    outside.path += "_outside";
    fs::remove_all(outside.path);
    outside.write("secret", "s");
    folder.write("inside", "i");
    fs::create_symlink(outside.path / "secret", folder.path / "link");
    fs::create_directory_symlink(outside.path, folder.path / "links");
    fs::create_symlink("inside", folder.path / "own");
    const auto code = [](const auto& call) { return error_of(call).code(); };
    for (const char* name : {"link", "links/secret", "../lissom_folder_test_outside/secret"}) {
        CHECK(code([&] { read_from_folder(folder.path, name); }) == ErrorCode::unsafe_path);
    }
    CHECK(folder.text("own") == "i");
    // A change that seems to be finished, but moves files of others, or to elsewhere.
    fs::create_directory_symlink(outside.path, folder.path / ".lissom-ready");
    CHECK(code([&] { read_from_folder(folder.path, "secret"); }) == ErrorCode::file_not_found);
    CHECK(code([&] {
              replace_in_folder(folder.path, {{{"a", "1"}}, {}});
          }) == ErrorCode::file_write_failed);
    CHECK(fs::exists(outside.path / "secret"));
    fs::remove(folder.path / ".lissom-ready");
    folder.write(".lissom-ready/links/evil", "e");
    CHECK(code([&] {
              replace_in_folder(folder.path, {{{"a", "2"}}, {"a"}});
          }) == ErrorCode::unsafe_path);
    CHECK_FALSE(fs::exists(outside.path / "evil"));
}

// What a process leaves that is killed before, or between, two renames.
TEST_CASE("folder: a change that a killed process has finished writing counts, another does not") {
    TestFolder folder;
    replace_in_folder(folder.path, {{{"a", "1"}, {"b", "1"}}, {}});
    folder.write(".lissom-new/a", "half");
    CHECK(folder.text("a") == "1");
    folder.write(".lissom-ready/a", "2");
    CHECK(folder.text("a") == "2");
    CHECK(folder.text("b") == "1");
    replace_in_folder(folder.path, {{{"a", "2"}, {"b", "3"}}, {"a", "b"}});
    CHECK(folder.text("a") == "2");
    CHECK(folder.text("b") == "3");
    CHECK_FALSE(fs::exists(folder.path / ".lissom-new"));
    CHECK_FALSE(fs::exists(folder.path / ".lissom-ready"));
}
