/// Deliberate differences from the thesis: the one table that names them, from which the page
/// thesis.md of the reference is made.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// A choice of the thesis, and Lissom's own.
struct Departure {
    /// Section of the thesis: "4.5".
    std::string section;
    /// Its subject: an option and its function, or a matter without an option.
    std::string subject;
    std::string usual;
    std::string thesis;
    /// Option that selects the thesis's choice; empty if there is none.
    std::string by;
    /// The option that is meant, "ring"; empty for matters without one.
    std::string option = {};
};

/// Option that selects the thesis's choice for most.
extern const char* const kByFidelity;

/// All departures: those of options from their descriptions (Parameter::thesis), then the others;
/// by section.
std::vector<Departure> departures(const Registry& registry);

}  // namespace lissom::lua
