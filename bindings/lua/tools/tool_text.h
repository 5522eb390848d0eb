/// The Lua text of the host of tools; made when the library is configured.
#pragma once

namespace lissom::lua {

/// Pieces of one chunk, in their order; null after the last.
extern const char* const kToolText[];

}  // namespace lissom::lua
