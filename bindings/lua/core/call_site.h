/// What a script does with the results of a call: whether it takes any.
///
/// A function cannot ask Lua how many of its results its caller wants. The instruction that calls
/// it says so, and is found by what Lua's public interface tells of the calling function: its code
/// (lua_dump, or jit.util under LuaJIT), its present line, and the register that the called
/// function stands in, which is the number of its locals and temporaries. A line may hold several
/// calls in one register: then all of them must drop their results.
#pragma once

#include <cstdint>

#include "bindings/lua/core/compat.h"

namespace lissom::lua {

/// The instructions that call, as this Lua writes them; found once a state.
struct CallCodes {
    bool known = false;
    /// A call that gives results to its function, one that gives them to the caller of its
    /// function; the same with any number of arguments, where those have codes of their own.
    std::uint32_t call = 0, tail = 0, open_call = 0, open_tail = 0;
};

/// Finds the codes by compiling calls; `known` stays false in a Lua that is not understood.
CallCodes find_call_codes(lua_State* L);

/// Whether the script drops all results of the C function that runs now: it is called as a
/// statement, or as `return f()` of a function that is. False where that cannot be told, and where
/// the caller is a C function, for instance pcall. To be called with no C++ object alive.
bool drops_results(lua_State* L, const CallCodes& codes);

}  // namespace lissom::lua
