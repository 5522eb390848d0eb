/// The Lua text of grooms; made when the library is configured.
#pragma once

namespace lissom::lua {

/// Pieces of one chunk, in their order; null after the last.
extern const char* const kGroomText[];

}  // namespace lissom::lua
