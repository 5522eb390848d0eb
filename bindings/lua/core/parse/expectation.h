/// The accepted values of parameters, in words.
#pragma once

#include <string>

#include "bindings/lua/core/parameter.h"

namespace lissom::lua {

/// Returns the accepted values of a parameter, for messages: "integer from 1 to 10", "\"x\", \"y\",
/// \"z\" or {x, y, z}".
std::string expectation(const Parameter& parameter);

/// Returns a number as people write it: without trailing zeros.
std::string plain_number(double value);

}  // namespace lissom::lua
