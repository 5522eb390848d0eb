#include "viewer/window/panel/parameter_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

#include "viewer/window/panel/text_history.h"

namespace lissom::window {
namespace {

constexpr std::size_t kLongestValue = 1024;

// A value of a number with all digits that a person may want to see.
const char* number_format(const lua::ScriptParameter& p) {
    return p.type == lua::ParameterType::integer ? "%.0f" : "%.4g";
}

// Text typed in a field and not entered yet, in ImGui's own storage, with all its bits.
class TypedNumber {
  public:
    explicit TypedNumber(ImGuiID field) : storage_(*ImGui::GetStateStorage()), field_(field) {}

    void set(double value) {
        const auto halves = std::bit_cast<std::array<int, 2>>(value);
        storage_.SetInt(field_ + 1, halves[0]);
        storage_.SetInt(field_ + 2, halves[1]);
        storage_.SetBool(field_, true);
    }
    // Forgets it.
    std::optional<double> take() {
        if (!storage_.GetBool(field_)) return std::nullopt;
        storage_.SetBool(field_, false);
        return std::bit_cast<double>(
            std::array<int, 2>{storage_.GetInt(field_ + 1), storage_.GetInt(field_ + 2)});
    }

  private:
    ImGuiStorage& storage_;
    ImGuiID field_;
};

// Returns the new value of the last field, which was `before`: that of a slider counts while it is
// dragged; typed text, when it is entered or the field is left.
double entered(double value, double before) {
    TypedNumber typed(ImGui::GetID("##value"));
    if (ImGui::IsItemActive() && ImGui::GetIO().WantTextInput) {
        if (value != before) typed.set(value);
        return before;
    }
    const std::optional<double> last = typed.take();
    const bool is_left = last && value == before && ImGui::IsItemDeactivatedAfterEdit() &&
                         !ImGui::IsKeyPressed(ImGuiKey_Escape);
    return is_left ? *last : value;
}

bool edit_number(lua::ScriptParameter& p, double& value) {
    const double before = value;
    const bool limited = std::isfinite(p.min) && std::isfinite(p.max);
    if (limited) {
        ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &p.min, &p.max,
                            number_format(p), ImGuiSliderFlags_AlwaysClamp);
    } else {
        const double step = p.step.value_or(
            p.type == lua::ParameterType::integer ? 1.0 : std::max(std::abs(value), 1e-3) * 0.01);
        ImGui::DragScalar("##value", ImGuiDataType_Double, &value, static_cast<float>(step), &p.min,
                          &p.max, number_format(p), ImGuiSliderFlags_AlwaysClamp);
    }
    value = entered(value, before);
    if (p.type == lua::ParameterType::integer) value = std::round(value);
    return value != before;
}

bool edit_choice(const lua::ScriptParameter& p, std::string& value) {
    bool changed = false;
    if (!ImGui::BeginCombo("##value", value.c_str())) return false;
    for (const std::string& choice : p.choices) {
        if (!ImGui::Selectable(choice.c_str(), choice == value)) continue;
        changed = choice != value;
        value = choice;
    }
    ImGui::EndCombo();
    return changed;
}

bool edit_text(std::string& value) {
    std::array<char, kLongestValue> text{};
    value.copy(text.data(), text.size() - 1);
    forget_unfit_history("##value", text.data());
    ImGui::InputText("##value", text.data(), text.size());
    if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
    value = text.data();
    return true;
}

void help_marker(const lua::ScriptParameter& p) {
    if (!ImGui::IsItemHovered()) return;
    const std::string text = p.help + (p.help.empty() ? "" : "\n") + p.accepted();
    ImGui::SetTooltip("%s", text.c_str());
}

// The list of a picker, opened by an arrow beside its field.
bool edit_pick(const std::vector<std::string>& values, std::string& value) {
    if (!ImGui::BeginCombo("##picks", "",
                           ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft))
        return false;
    bool changed = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(values[i].c_str(), values[i] == value)) {
            changed = values[i] != value;
            value = values[i];
        }
        ImGui::PopID();
    }
    if (values.empty()) ImGui::TextDisabled("nothing of this kind is shown");
    ImGui::EndCombo();
    return changed;
}

// A button that lets the next click in the picture pick, or takes that back.
void draw_pick_button(const lua::ScriptParameter& p, const PickerContent& pickers) {
    const Picking own{pickers.of_tool, p.name};
    const bool picks = pickers.picking == own;
    if (picks) {
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    }
    const bool pressed = ImGui::Button("pick");
    if (picks) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Click an open boundary in the picture; Esc takes it back");
    }
    if (!pressed) return;
    pickers.picking = picks ? std::nullopt : std::optional(own);
}

// A text that is typed, taken from a list or, for a boundary, clicked in the picture.
bool edit_picked(lua::ScriptParameter& p, std::string& value,
                 const std::vector<lua::ScriptParameter>& all, const PickerContent& pickers) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const bool is_clicked = p.type == lua::ParameterType::boundary;
    float beside = ImGui::GetFrameHeight() + style.ItemSpacing.x;
    if (is_clicked) {
        beside += ImGui::CalcTextSize("pick").x + 2.0f * style.FramePadding.x + style.ItemSpacing.x;
    }
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - beside);
    const bool typed = edit_text(value);
    help_marker(p);
    ImGui::SameLine();
    const bool picked = edit_pick(picks_for(p, all, pickers.choices), value);
    if (is_clicked) {
        ImGui::SameLine();
        draw_pick_button(p, pickers);
    }
    return typed || picked;
}

bool edit(lua::ScriptParameter& p, const std::vector<lua::ScriptParameter>& all,
          const PickerContent& pickers) {
    if (!p.value) p.value = p.default_value;
    if (!p.value) {
        switch (p.type) {
            case lua::ParameterType::boolean:
                p.value = false;
                break;
            case lua::ParameterType::number:
            case lua::ParameterType::integer:
                p.value = std::isfinite(p.min) ? p.min : 0.0;
                break;
            default:
                p.value = std::string();
        }
    }
    if (auto* flag = std::get_if<bool>(&*p.value)) return ImGui::Checkbox("##value", flag);
    if (auto* number = std::get_if<double>(&*p.value)) return edit_number(p, *number);
    auto& text = std::get<std::string>(*p.value);
    if (is_picked(p.type)) return edit_picked(p, text, all, pickers);
    return p.type == lua::ParameterType::choice ? edit_choice(p, text) : edit_text(text);
}

}  // namespace

std::optional<std::size_t> draw_parameters(std::vector<lua::ScriptParameter>& parameters,
                                           const PickerContent& pickers) {
    std::optional<std::size_t> changed;
    std::string group;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        lua::ScriptParameter& p = parameters[i];
        if (p.group != group) ImGui::TextDisabled("%s", p.group.c_str());
        group = p.group;
        ImGui::PushID(p.name.c_str());
        const std::string label = p.name + (p.unit.empty() ? "" : " (" + p.unit + ")");
        // A box has its name behind it, all else above.
        const bool is_box = p.type == lua::ParameterType::boolean;
        if (!is_box) {
            ImGui::TextUnformatted(label.c_str());
            help_marker(p);
        }
        ImGui::SetNextItemWidth(-1.0f);
        if (edit(p, parameters, pickers)) changed = i;
        if (!is_picked(p.type)) help_marker(p);
        if (is_box) {
            ImGui::SameLine();
            ImGui::TextUnformatted(label.c_str());
            help_marker(p);
        }
        ImGui::PopID();
    }
    return changed;
}

}  // namespace lissom::window
