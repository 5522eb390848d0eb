/// Memory that a software driver takes for a frame and gives back after it.
#pragma once

namespace lissom::window {

/// Lets the process keep freed memory, up to some hundred megabytes, for the next frame: getting
/// and clearing it, page by page, takes longer than drawing. For programs, once; nothing if the C
/// library is not glibc.
void keep_driver_memory();

}  // namespace lissom::window
