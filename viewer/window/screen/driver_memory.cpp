#include "viewer/window/screen/driver_memory.h"

#if defined(__GLIBC__) || __has_include(<gnu/libc-version.h>)
#include <malloc.h>
#endif

namespace lissom::window {

// A frame of 86K triangles takes tens of megabytes, in pieces of up to ten.
void keep_driver_memory() {
#ifdef M_TRIM_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 128 << 20);
#endif
}

}  // namespace lissom::window
