#include "kernel/core/machine_memory.h"

#ifdef __unix__
#include <unistd.h>
#endif

namespace lissom {

std::size_t machine_memory() {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    if (pages > 0 && size > 0) {
        return at(pages) * size;
    }
#endif
    return 0;
}

}  // namespace lissom
