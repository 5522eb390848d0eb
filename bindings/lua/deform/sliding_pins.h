/// The option `pins` of Deformer:solve.
#pragma once

#include <span>
#include <vector>

#include "bindings/lua/core/registry.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/deform/pins/surface_pins.h"

namespace lissom::lua {

/// Pins as scripts give them: of one vertex, or of those of a region.
struct SlidingPinSpec {
    SlidingPin pin;
    const RegionObject* region;
};

/// Describes the option.
Parameter sliding_pins_option();
/// Reads it, into memory of the call. Raises an error for a pin without vertices or a place.
std::span<const SlidingPinSpec> read_sliding_pins(Call& call);
/// Returns a pin for each vertex. Throws topology_mismatch for a region of another topology.
std::vector<SlidingPin> sliding_pins(std::span<const SlidingPinSpec> specs);

}  // namespace lissom::lua
