/// The supporting surface of a script.
#pragma once

#include <utility>

#include "kernel/sketch/support/support_surface.h"

namespace lissom::lua {

struct SupportObject {
    static constexpr const char* kTypeName = "lissom.Support";

    SupportObject(SupportSurface made, double in_metre)
        : surface(std::move(made)), metre(in_metre) {}

    SupportSurface surface;
    /// World units to a metre of the head that its curve belongs to.
    double metre = 1.0;
};

}  // namespace lissom::lua
