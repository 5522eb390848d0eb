/// Ctrl-C: the first one asks the running work to stop, the kernel's and Lua's; the second one ends
/// the program as if nobody listened.
#pragma once

#include "bindings/lua/core/compat.h"
#include "kernel/core/context.h"

namespace lissom::cli {

/// Listens as long as it lives. One at a time in a process: a signal belongs to the process.
class Interrupt {
  public:
    explicit Interrupt(const Context& context);
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    /// Lets Ctrl-C stop scripts in `L` too, coroutines included: wraps coroutine.resume and
    /// coroutine.wrap there. May raise a Lua error.
    static void watch(lua_State* L);
    /// Stops scripts of `L`, watched before, from now on.
    static void attend(lua_State* L);
    /// Acts as if Ctrl-C were pressed, but never ends the program; from any thread.
    static void press();
    /// The Lua state is about to be closed.
    static void forget();

    /// While nothing runs a second Ctrl-C does not end the program.
    static void wait_at_prompt(bool waits);

    /// Returns whether Ctrl-C was pressed.
    bool pressed() const;
    /// Goes on as if it had not been pressed.
    void clear();

  private:
    Context context_;
};

}  // namespace lissom::cli
