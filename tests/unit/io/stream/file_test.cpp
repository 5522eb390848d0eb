#include "kernel/io/stream/file.h"

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/io/io_support.h"

#ifndef _WIN32
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#endif

using namespace lissom;
using namespace lissom::test;
namespace fs = std::filesystem;

TEST_CASE("a file is read whole and its memory is charged while it is held") {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\r\n", 5);
    write_bytes(folder / "file", bytes);
    const Context context;
    {
        const FileContent content = read_file(folder / "file", context);
        CHECK(content.bytes == bytes);
        CHECK(context.memory()->used() == bytes.size());
    }
    CHECK(context.memory()->used() == 0);
}

TEST_CASE("a file that cannot be read is named, with the reason as a code") {
    const TemporaryFolder folder;
    write_bytes(folder / "empty", "");
    const auto code_of = [&](const fs::path& path) {
        const Error error = error_of([&] { read_file(path); });
        CHECK(error.message().starts_with(display_name(path)));
        return error.code();
    };
    CHECK(code_of(folder / "none") == ErrorCode::file_not_found);
    CHECK(code_of(folder / "none/none") == ErrorCode::file_not_found);
    CHECK(code_of(folder / "") == ErrorCode::file_is_directory);
    CHECK(code_of(folder / "empty") == ErrorCode::file_empty);
    CHECK(code_of(folder / "empty/below") == ErrorCode::file_not_found);
#ifndef _WIN32
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(code_of(folder / "pipe") == ErrorCode::file_unreadable);
#endif
}

TEST_CASE("a file above the memory limit is refused before it is read") {
    const TemporaryFolder folder;
    write_bytes(folder / "file", std::string(1000, 'x'));
    ContextOptions options;
    options.memory_limit = 999;
    const Context context(options);
    CHECK(error_of([&] { read_file(folder / "file", context); }).code() == ErrorCode::memory_limit);
    CHECK(context.memory()->used() == 0);
}

TEST_CASE("a host's table of files is asked in place of the system") {
    std::map<std::string, std::string> files{{"pack/a", "abc"}, {"empty", ""}};
    ContextOptions options;
    options.files.read = [&](std::string_view path,
                             const std::function<void(std::string_view)>& sink) {
        const auto found = files.find(std::string(path));
        if (found == files.end()) return false;
        for (const char& c : found->second) sink({&c, 1});
        return true;
    };
    options.files.write = [&](std::string_view path, std::string_view bytes) {
        if (path.starts_with("no/")) return false;
        files[std::string(path)] = bytes;
        return true;
    };
    options.memory_limit = 1000;
    const Context context(options);
    CHECK(read_file("pack/a", context).bytes == "abc");
    CHECK(error_of([&] { read_file("pack/b", context); }).code() == ErrorCode::file_not_found);
    CHECK(error_of([&] { read_file("empty", context); }).code() == ErrorCode::file_empty);
    CHECK_NOTHROW(require_folder_of("nowhere/at/all", context));
    write_file_atomically("nowhere/b", "bcd", context);
    CHECK(files["nowhere/b"] == "bcd");
    CHECK(error_of([&] { write_file_atomically("no/c", "c", context); }).code() ==
          ErrorCode::file_write_failed);
    files["large"] = std::string(3000, 'x');
    CHECK(error_of([&] { read_file("large", context); }).code() == ErrorCode::memory_limit);
    CHECK(context.memory()->used() == 0);
}

TEST_CASE("writing creates a file or replaces one") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "first, and longer");
    write_file_atomically(folder / "file", "second");
    CHECK(read_bytes(folder / "file") == "second");
    CHECK(folder.names() == std::vector<std::string>{"file"});
}

TEST_CASE("a relative path without a folder is in the current one") {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder / "");
    write_file_atomically("file", "bytes");
    CHECK(read_file("file").bytes == "bytes");
    fs::current_path(before);
    CHECK(folder.names() == std::vector<std::string>{"file"});
}

TEST_CASE("a cancelled write leaves the old file and nothing else") {
    const TemporaryFolder folder;
    write_bytes(folder / "file", "old");
    const Context context;
    context.cancel();
    CHECK(error_of([&] { write_file_atomically(folder / "file", "new", context); }).code() ==
          ErrorCode::cancelled);
    CHECK(read_bytes(folder / "file") == "old");
    CHECK(folder.names() == std::vector<std::string>{"file"});
}

TEST_CASE("a folder is not replaced, and neither is a file inside none") {
    const TemporaryFolder folder;
    CHECK(error_of([&] { write_file_atomically(folder / "", "x"); }).code() ==
          ErrorCode::file_is_directory);
    fs::create_directory(folder / "sub");
    CHECK(error_of([&] { write_file_atomically(folder / "sub", "x"); }).code() ==
          ErrorCode::file_is_directory);
    CHECK(error_of([&] { write_file_atomically(folder / "none/file", "x"); }).code() ==
          ErrorCode::file_write_failed);
}

TEST_CASE("a file that exists keeps its permissions") {
    const TemporaryFolder folder;
    const fs::perms permissions =
        fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read;
    write_bytes(folder / "file", "old");
    fs::permissions(folder / "file", permissions);
    // Windows has but one of them.
    const fs::perms before = fs::status(folder / "file").permissions();
    write_file_atomically(folder / "file", "new");
    CHECK(fs::status(folder / "file").permissions() == before);
}

TEST_CASE("a read-only file is not replaced") {
    const TemporaryFolder folder;
    write_bytes(folder / "file", "old");
    fs::permissions(folder / "file", fs::perms::owner_read);
    CHECK(error_of([&] { write_file_atomically(folder / "file", "new"); }).code() ==
          ErrorCode::file_write_failed);
    CHECK(read_bytes(folder / "file") == "old");
    // Windows removes no such file.
    fs::permissions(folder / "file", fs::perms::owner_write, fs::perm_options::add);
}

TEST_CASE("a path with a zero byte is refused and names no other file") {
    const TemporaryFolder folder;
    write_bytes(folder / "file", "old");
    const fs::path path = folder / std::string("file\0.obj", 9);
    CHECK(error_of([&] { read_file(path); }).code() == ErrorCode::file_not_found);
    CHECK(error_of([&] { write_file_atomically(path, "new"); }).code() ==
          ErrorCode::file_write_failed);
    CHECK(read_bytes(folder / "file") == "old");
}

TEST_CASE("a missing folder is named before the work, and made where that is asked for") {
    const TemporaryFolder folder;
    const Error error = error_of([&] { require_folder_of(folder / "a/b/file"); });
    CHECK(error.code() == ErrorCode::file_write_failed);
    CHECK(error.message().find("there is no folder '") != std::string::npos);
    make_folder(folder / "a/b");
    make_folder(folder / "a/b");
    require_folder_of(folder / "a/b/file");
    write_bytes(folder / "a/file", "x");
    CHECK(error_of([&] { make_folder(folder / "a/file"); }).code() == ErrorCode::file_write_failed);
    CHECK(error_of([&] { make_folder(folder / "a/file/b"); }).code() ==
          ErrorCode::file_write_failed);
}

#ifndef _WIN32
TEST_CASE("what a killed process left is removed by the next write, and nothing else") {
    const TemporaryFolder folder;
    for (const char* name : {".lissom-7.tmp", ".lissom-12345.tmp", ".lissom-.tmp", ".lissom-7x.tmp",
                             ".lissom-7.tmp.keep", "lissom-7.tmp"}) {
        write_bytes(folder / name, "left");
    }
    fs::create_directory(folder / ".lissom-8.tmp");
    fs::create_symlink("lissom-7.tmp", folder / ".lissom-9.tmp");
    // One that somebody writes is locked.
    write_bytes(folder / ".lissom-10.tmp", "at work");
    const int descriptor = open((folder / ".lissom-10.tmp").c_str(), O_RDONLY);
    REQUIRE(flock(descriptor, LOCK_EX | LOCK_NB) == 0);
    write_file_atomically(folder / "file", "new");
    CHECK(folder.names() == std::vector<std::string>{".lissom-.tmp", ".lissom-10.tmp",
                                                     ".lissom-7.tmp.keep", ".lissom-7x.tmp",
                                                     ".lissom-8.tmp", ".lissom-9.tmp", "file",
                                                     "lissom-7.tmp"});
    close(descriptor);
    write_file_atomically(folder / "file", "new");
    CHECK(!fs::exists(folder / ".lissom-10.tmp"));
}

TEST_CASE("files written into one folder at once do not take each other for left over") {
    const TemporaryFolder folder;
    std::atomic<int> failures{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 50; ++i) {
                try {
                    write_file_atomically(folder / std::to_string(t), "bytes");
                } catch (const Error&) {
                    ++failures;
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(failures == 0);
    CHECK(folder.names() == std::vector<std::string>{"0", "1", "2", "3"});
}

TEST_CASE("a symbolic link stays and the file it points to is replaced") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    write_bytes(folder / "sub/file", "old");
    fs::create_symlink("sub/file", folder / "link");
    fs::create_symlink("link", folder / "link_to_link");
    write_file_atomically(folder / "link_to_link", "new");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::is_symlink(folder / "link_to_link"));
    CHECK(read_bytes(folder / "sub/file") == "new");
}

TEST_CASE("a symbolic link to nothing creates the file, and a circle of links is an error") {
    const TemporaryFolder folder;
    fs::create_symlink("file", folder / "link");
    write_file_atomically(folder / "link", "new");
    CHECK(read_bytes(folder / "file") == "new");
    fs::create_symlink("circle", folder / "circle");
    CHECK(error_of([&] { write_file_atomically(folder / "circle", "x"); }).code() ==
          ErrorCode::file_write_failed);
}

TEST_CASE("what is not a regular file is not replaced") {
    const TemporaryFolder folder;
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(error_of([&] { write_file_atomically(folder / "pipe", "x"); }).code() ==
          ErrorCode::file_write_failed);
    CHECK(fs::is_fifo(folder / "pipe"));
}

TEST_CASE("a full disk leaves the old file and nothing else") {
    const TemporaryFolder folder;
    write_bytes(folder / "file", "old");
    // A limit on the size of files stands for the full disk.
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 1000;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const Error error =
        error_of([&] { write_file_atomically(folder / "file", std::string(100000, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    CHECK(error.code() == ErrorCode::file_write_failed);
    CHECK(read_bytes(folder / "file") == "old");
    CHECK(folder.names() == std::vector<std::string>{"file"});
}
#endif
