#include "bindings/lua/sandbox/folder_rights.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "kernel/core/error.h"
#include "tests/unit/io/io_support.h"

namespace lissom::lua {
namespace {

namespace fs = std::filesystem;

bool allows(FolderRights& rights, const fs::path& path, FileUse use) {
    try {
        rights.check(path, use);
        return true;
    } catch (const Error& error) {
        CHECK((error.code() == ErrorCode::file_unreadable ||
               error.code() == ErrorCode::file_write_failed));
        return false;
    }
}

void write(const fs::path& path, std::size_t bytes) {
    std::ofstream(path, std::ios::binary) << std::string(bytes, 'x');
}

TEST_CASE("sandbox: files are allowed below the folders, and nowhere else") {
    const test::TemporaryFolder folder;
    const fs::path in = folder / "in", out = folder / "out";
    fs::create_directories(in / "deep");
    fs::create_directories(out);
    FolderRights rights({in}, {out}, {}, 0);
    CHECK(allows(rights, in / "deep/a.obj", FileUse::read));
    CHECK(allows(rights, in / "deep/../a.obj", FileUse::read));
    CHECK(allows(rights, out / "b.obj", FileUse::write));
    CHECK_FALSE(allows(rights, out / "b.obj", FileUse::read));
    CHECK_FALSE(allows(rights, in / "a.obj", FileUse::write));
    CHECK_FALSE(allows(rights, in / "../a.obj", FileUse::read));
    CHECK_FALSE(allows(rights, folder / "input/a.obj", FileUse::read));
    CHECK_FALSE(allows(rights, "/etc/passwd", FileUse::read));
    CHECK_FALSE(allows(rights, "", FileUse::read));
    FolderRights none({}, {}, {}, 0);
    CHECK_FALSE(allows(none, in / "a.obj", FileUse::read));
}

TEST_CASE("sandbox: relative paths are those of the working folder") {
    FolderRights here({"."}, {"."}, {}, 0);
    CHECK(allows(here, "new.obj", FileUse::write));
    CHECK(allows(here, "./deep/new.obj", FileUse::read));
    CHECK(allows(here, fs::current_path() / "new.obj", FileUse::write));
    CHECK_FALSE(allows(here, "../new.obj", FileUse::write));
}

TEST_CASE("sandbox: links lead nowhere that the folders do not") {
    const test::TemporaryFolder folder;
    const fs::path in = folder / "in", secret = folder / "secret";
    fs::create_directories(in);
    fs::create_directories(secret);
    write(secret / "a.obj", 10);
    fs::create_symlink(secret / "a.obj", in / "link.obj");
    fs::create_directory_symlink(secret, in / "links");
    fs::create_symlink(secret / "new.obj", in / "open.obj");
    FolderRights rights({in}, {in}, {}, 0);
    CHECK_FALSE(allows(rights, in / "link.obj", FileUse::read));
    CHECK_FALSE(allows(rights, in / "links/a.obj", FileUse::read));
    CHECK_FALSE(allows(rights, in / "link.obj", FileUse::write));
    CHECK_FALSE(allows(rights, in / "links/new.obj", FileUse::write));
    CHECK_FALSE(allows(rights, in / "open.obj", FileUse::write));
}

TEST_CASE("sandbox: the files of a folder that is written are added up, but those before it") {
    const test::TemporaryFolder folder;
    const fs::path scene = folder / "scene";
    fs::create_directories(scene / "meshes");
    write(scene / "old", 900);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    FolderRights rights({}, {folder / ""}, {}, 1000);
    CHECK(allows(rights, scene, FileUse::write));
    write(scene / "a", 600);
    CHECK(allows(rights, folder / "b", FileUse::write));
    CHECK(allows(rights, scene, FileUse::write));
    write(scene / "meshes" / "c", 600);
    CHECK_FALSE(allows(rights, folder / "d", FileUse::write));
}

TEST_CASE("sandbox: what is written is added up") {
    const test::TemporaryFolder folder;
    FolderRights rights({}, {folder / ""}, {}, 1000);
    CHECK(allows(rights, folder / "a", FileUse::write));
    write(folder / "a", 600);
    CHECK(allows(rights, folder / "b", FileUse::write));
    write(folder / "b", 600);
    CHECK_FALSE(allows(rights, folder / "c", FileUse::write));
    CHECK_FALSE(rights.count_output(1));
}

}  // namespace
}  // namespace lissom::lua
