/// Controls for declared parameters: sliders, choices, texts. Drawn by Dear ImGui.
#pragma once

#include <optional>
#include <vector>

#include "bindings/lua/core/script_parameters.h"

namespace lissom::window {

/// A control for each of `parameters`, under its group. Changes values as a person asks, and
/// returns the place of a changed one.
std::optional<std::size_t> draw_parameters(std::vector<lua::ScriptParameter>& parameters);

}  // namespace lissom::window
