/// Byte order of binary files.
#pragma once

namespace lissom {

enum class Endianness { little, big };

}  // namespace lissom
