/// Memory of this machine.
#pragma once

#include <cstddef>

namespace lissom {

/// Returns the memory in bytes; 0 if unknown.
std::size_t machine_memory();

}  // namespace lissom
