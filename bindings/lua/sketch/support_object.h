/// The supporting surface of a script.
#pragma once

#include <cstddef>
#include <utility>

#include "kernel/core/memory_hold.h"
#include "kernel/sketch/support/support_surface.h"

namespace lissom::lua {

struct SupportObject {
    static constexpr const char* kTypeName = "lissom.Support";

    SupportObject(SupportSurface made, double in_metre)
        : surface(std::move(made)), metre(in_metre) {}

    SupportSurface surface;
    /// World units to a metre of the head that its curve belongs to.
    double metre = 1.0;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    /// Bytes of the rulings and their tangents.
    std::size_t memory_bytes() const {
        return surface.rulings().size() * (sizeof(SupportSurface::Ruling) + sizeof(Vec3));
    }
};

}  // namespace lissom::lua
