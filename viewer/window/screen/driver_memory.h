/// Memory that a software driver takes for a frame and gives back after it.
#pragma once

namespace lissom::window {

/// Lets the process keep what is given back, up to some hundred megabytes, for the next frame: to
/// get it from the system and to clear it, page by page, takes longer than to draw. For programs,
/// once; nothing where the C library is not glibc.
void keep_driver_memory();

}  // namespace lissom::window
