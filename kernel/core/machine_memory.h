/// How much memory this machine has.
#pragma once

#include <cstddef>

namespace lissom {

/// In bytes; 0 where that is not known.
std::size_t machine_memory();

}  // namespace lissom
