/// Stoppable: a trusted Lua state, with all of Lua's libraries, that ends by a cancel of its
/// context whatever its script does to go on: loops under pcall, patterns that backtrack for hours,
/// finalizers and closers that loop.
#pragma once

#include <memory>

#include "bindings/lua/core/compat.h"
#include "kernel/core/context.h"

namespace lissom::lua {

class Stoppable {
  public:
    Stoppable();
    ~Stoppable();
    Stoppable(const Stoppable&) = delete;
    Stoppable& operator=(const Stoppable&) = delete;

    /// Replaces functions of the state's open libraries by ones that end at a cancel, and those of
    /// debug that can crash the host unless `unsafe_debug`. May raise a Lua error. The state is
    /// closed before this object is gone.
    void open(lua_State* L, bool unsafe_debug = false);
    /// Lets finalizers run as coroutines, as Lua itself runs them where no hook stops them. To be
    /// called after coroutine.resume was replaced, if it is. May raise a Lua error.
    void open_finalizers(lua_State* L);
    /// Takes a cancel of `context` for that of the script.
    void follow(const Context& context);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Lets xpcall of the thread that runs return the message of the next error as it is. To be called
/// by a hook before it raises one: a handler would run while hooks are off.
void drop_handlers(lua_State* L);

}  // namespace lissom::lua
