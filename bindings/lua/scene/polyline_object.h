/// The free curve of a script.
#pragma once

#include <cstddef>
#include <utility>

#include "bindings/lua/core/call.h"
#include "kernel/scene/polyline.h"

namespace lissom::lua {

struct PolylineObject {
    static constexpr const char* kTypeName = "lissom.Polyline";

    explicit PolylineObject(Polyline content) : polyline(std::move(content)) {}

    Polyline polyline;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const { return polyline.points.size() * sizeof(Vec3); }
};

}  // namespace lissom::lua
