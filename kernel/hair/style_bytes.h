/// Memory of the inputs of a hairstyle.
#pragma once

#include <cstddef>

namespace lissom {

struct StyleInputs;

/// Returns the bytes of all lists and names.
std::size_t memory_bytes(const StyleInputs& inputs);

}  // namespace lissom
