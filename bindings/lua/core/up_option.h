/// The option `up` of readers and writers of files: the choices "y" and "z", in this order.
#pragma once

#include "bindings/lua/core/call.h"
#include "kernel/io/record/options.h"

namespace lissom::lua {

/// Returns the value of the option; none if it was not given.
inline UpAxis up_axis(const Call& call) {
    if (!call.has("up")) return UpAxis::none;
    return call.integer("up") == 0 ? UpAxis::y : UpAxis::z;
}

}  // namespace lissom::lua
