#include "bindings/lua/deform/sliding_pins.h"

namespace lissom::lua {
namespace {

// The place of the pin that is selected.
SlidingPin read_place(const Call& call) {
    SlidingPin pin;
    const bool plane = call.has("pins.plane"), line = call.has("pins.line");
    const bool sphere = call.has("pins.sphere");
    if (plane + line + sphere != 1) {
        call.reject("pins", "each has one place: a plane, a line or a sphere");
    }
    if (plane) {
        pin.point = call.vector("pins.plane.point");
        pin.direction = call.vector("pins.plane.normal");
    } else if (line) {
        pin.on = PinPlace::line;
        pin.point = call.vector("pins.line.point");
        pin.direction = call.vector("pins.line.direction");
    } else {
        pin.on = PinPlace::sphere;
        pin.point = call.vector("pins.sphere.center");
        pin.radius = call.number("pins.sphere.radius");
    }
    return pin;
}

}  // namespace

Parameter sliding_pins_option() {
    return option_list(
               "pins",
               {id("vertex", "The pinned vertex.").optional("those of the region"),
                object("region", "lissom.Region", "Pinned vertices, each for itself.")
                    .optional("the vertex"),
                options("plane", {vector("point", "A point of it."), axis("normal", "Its normal.")},
                        "The plane that it slides on.")
                    .optional("another place"),
                options("line",
                        {vector("point", "A point of it."), axis("direction", "Its direction.")},
                        "The line that it slides on.")
                    .optional("another place"),
                options("sphere",
                        {vector("center", "The point that it keeps its distance from."),
                         number("radius", "That distance.").in("mesh units").above(0)},
                        "The sphere that it slides on.")
                    .optional("another place")},
               "Vertices that slide on a place and are held there by forces square to it, in this "
               "solve: at most 512, each with one place. Handles hold exactly; places that "
               "contradict each other are kept as nearly as they can be. Not with `draft`, `stop` "
               "or `avoid`.")
        .optional("none");
}

std::span<const SlidingPinSpec> read_sliding_pins(Call& call) {
    const auto count = raw_length(call.lua(), call.stack_index("pins"));
    auto* specs = call.scratch<SlidingPinSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("pins", index_of(i) + 1);
        const bool has_vertex = call.has("pins.vertex");
        if (has_vertex == call.has("pins.region")) {
            call.reject("pins", "each has a vertex or a region");
        }
        specs[i] = {read_place(call), nullptr};
        if (has_vertex) {
            specs[i].pin.vertex = call.id("pins.vertex");
        } else {
            specs[i].region = call.object<RegionObject>("pins.region").get();
        }
    }
    return {specs, count};
}

std::vector<SlidingPin> sliding_pins(std::span<const SlidingPinSpec> specs) {
    std::vector<SlidingPin> pins;
    for (const SlidingPinSpec& spec : specs) {
        SlidingPin pin = spec.pin;
        if (!spec.region) {
            pins.push_back(pin);
            continue;
        }
        for (const Index v : spec.region->current().vertices()) {
            pin.vertex = v;
            pins.push_back(pin);
        }
    }
    return pins;
}

}  // namespace lissom::lua
