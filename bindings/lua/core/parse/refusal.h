/// Refusals of arguments: Lua errors that name the argument, its accepted values and the one given.
#pragma once

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/parameter.h"

namespace lissom::lua {

/// Place of a value in the call, for messages.
struct ValuePlace {
    /// From 1; 0 for an option, which has a `path`.
    int argument;
    const char* path;
    /// Place in a list, from 1; 0 for the value itself.
    int item;
};

/// Refuses a value: "bad argument #1 to 'smooth' (`expected` expected, got `got`)".
[[noreturn]] void refuse(const Call& call, const ValuePlace& place, const char* expected,
                         const char* got);
/// Refuses the value at stack index `index`, which `p` does not accept.
[[noreturn]] void refuse_value(const Call& call, const Parameter& p, int index,
                               const ValuePlace& place);
/// Refuses a call that ends before the argument `p`.
[[noreturn]] void refuse_none(const Call& call, const Parameter& p, const ValuePlace& place);
/// Refuses a call without the option `p`.
[[noreturn]] void refuse_missing(const Call& call, const Parameter& p, const ValuePlace& place);

}  // namespace lissom::lua
