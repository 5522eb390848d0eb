#include "kernel/core/machine_memory.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#ifdef __unix__
#include <unistd.h>
#elif defined(_WIN32)
#include <windows.h>
#endif

namespace lissom {
namespace {

// A machine can have more than a process of 32 bits can address.
[[maybe_unused]] std::size_t addressable(std::uint64_t bytes) {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(bytes, std::numeric_limits<std::size_t>::max()));
}

}  // namespace

std::size_t machine_memory() {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    if (pages > 0 && size > 0) {
        return addressable(static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size));
    }
#elif defined(_WIN32)
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof(status);
    if (GlobalMemoryStatusEx(&status)) return addressable(status.ullTotalPhys);
#endif
    return 0;
}

}  // namespace lissom
