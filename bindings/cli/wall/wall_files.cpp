// Rights of files by Landlock (Linux 5.13 and later).
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "bindings/cli/process/child_process.h"
#include "bindings/cli/wall/wall_steps.h"

#ifdef __linux__

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// From the system's interface, whose header may be older than the system.
constexpr long kCreateRuleset = 444, kAddRule = 445, kRestrictSelf = 446;
constexpr int kVersionFlag = 1, kPathBeneath = 1;
constexpr std::uint64_t kWriteFile = 1U << 1, kReadFile = 1U << 2, kReadFolder = 1U << 3,
                        kRemoveFolder = 1U << 4, kRemoveFile = 1U << 5, kMakeFolder = 1U << 7,
                        kMakeFile = 1U << 8, kRefer = 1U << 13, kTruncate = 1U << 14,
                        kDevice = 1U << 15;
constexpr std::uint64_t kFirstRights = (1U << 13) - 1;
// Network: bind and connect. Scopes: abstract sockets and signals.
constexpr std::uint64_t kAllNetwork = 3, kAllScopes = 3;

struct RulesetAttributes {
    std::uint64_t files = 0, network = 0, scopes = 0;
};

struct __attribute__((packed)) PathRule {
    std::uint64_t allowed = 0;
    std::int32_t folder = -1;
};

// Read by libraries: of the system, of drawing, of threads and time.
const char* const kSystemPaths[] = {
    "/usr",           "/lib",       "/lib64",        "/etc/ld.so.cache",        "/etc/glvnd",
    "/etc/localtime", "/proc/self", "/proc/meminfo", "/sys/devices/system/cpu", "/dev/null"};

std::uint64_t all_rights(int version) {
    return kFirstRights | (version >= 2 ? kRefer : 0) | (version >= 3 ? kTruncate : 0) |
           (version >= 5 ? kDevice : 0);
}

[[noreturn]] void fail(const char* what) {
    throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

// Rights of files that are in force when this is applied.
class Ruleset {
  public:
    explicit Ruleset(int version) : all_(all_rights(version)) {
        RulesetAttributes attributes{all_, version >= 4 ? kAllNetwork : 0,
                                     version >= 6 ? kAllScopes : 0};
        const std::size_t size = version >= 6 ? 24 : version >= 4 ? 16 : 8;
        descriptor_ = static_cast<int>(syscall(kCreateRuleset, &attributes, size, 0));
        if (descriptor_ < 0) fail("rights of files");
    }
    Ruleset(const Ruleset&) = delete;
    Ruleset& operator=(const Ruleset&) = delete;
    ~Ruleset() { close(descriptor_); }

    // A path that does not exist has no rights.
    void allow(const fs::path& path, std::uint64_t rights) {
        const int descriptor = open(path.c_str(), O_PATH | O_CLOEXEC);
        if (descriptor < 0) return;
        struct stat status {};
        const bool is_folder = fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
        if (!is_folder) rights &= kReadFile | kWriteFile | kTruncate;
        const PathRule rule{rights & all_, descriptor};
        const long failed = syscall(kAddRule, descriptor_, kPathBeneath, &rule, 0);
        close(descriptor);
        if (failed != 0) fail(path.c_str());
    }

    void apply() const {
        if (syscall(kRestrictSelf, descriptor_, 0) != 0) fail("rights of files");
    }

  private:
    std::uint64_t all_;
    int descriptor_ = -1;
};

}  // namespace

int landlock_version() {
    return static_cast<int>(syscall(kCreateRuleset, nullptr, 0, kVersionFlag));
}

void restrict_files(const WallRights& rights) {
    constexpr std::uint64_t kReading = kReadFile | kReadFolder;
    constexpr std::uint64_t kWriting = kReading | kWriteFile | kMakeFile | kMakeFolder |
                                       kRemoveFile | kRemoveFolder | kRefer | kTruncate;
    Ruleset rules(landlock_version());
    for (const char* path : kSystemPaths) rules.allow(path, kReading);
    rules.allow("/dev/null", kReadFile | kWriteFile);
    rules.allow(program_file(), kReadFile);
    for (const fs::path& path : rights.read_folders) rules.allow(path, kReading);
    for (const fs::path& path : rights.write_folders) rules.allow(path, kWriting);
    rules.apply();
}

}  // namespace lissom::cli

#else

namespace lissom::cli {

int landlock_version() {
    return 0;
}

void restrict_files(const WallRights&) {
    throw std::runtime_error("rights of files: this system has none");
}

}  // namespace lissom::cli

#endif
