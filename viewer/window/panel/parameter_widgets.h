/// Controls for declared parameters: sliders, choices, texts, pickers. Drawn by Dear ImGui.
#pragma once

#include <optional>
#include <vector>

#include "bindings/lua/core/script_parameters.h"
#include "viewer/window/panel/pick_choices.h"

namespace lissom::window {

/// Choices of pickers, and the parameter that a click in the picture picks for, which a person
/// changes.
struct PickerContent {
    const PickChoices& choices;
    std::optional<Picking>& picking;
    /// The parameters are those of the tool in hand.
    bool of_tool = false;
};

/// A control for each of `parameters`, under its group. Changes values as a person asks, and
/// returns the place of a changed one.
std::optional<std::size_t> draw_parameters(std::vector<lua::ScriptParameter>& parameters,
                                           const PickerContent& pickers);

}  // namespace lissom::window
