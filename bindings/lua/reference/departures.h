/// What differs by choice from the thesis: the one table that names it, from which the page
/// thesis.md of the reference is made.
#pragma once

#include <string>
#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// A choice of the thesis, and what Lissom does in its place.
struct Departure {
    /// Of the thesis: "4.5".
    std::string section;
    /// What it is about: an option and its function, or a matter without an option.
    std::string subject;
    std::string usual;
    std::string thesis;
    /// What gives the thesis's choice; empty where nothing does.
    std::string by;
    /// The option that is meant, "ring"; empty for matters without one.
    std::string option = {};
};

/// What gives the thesis's choice for most.
extern const char* const kByFidelity;

/// All departures: those of options from their descriptions (Parameter::thesis), then the others;
/// by section.
std::vector<Departure> departures(const Registry& registry);

}  // namespace lissom::lua
