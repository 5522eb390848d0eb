/// A panel and a hand that works with it.
#pragma once

#include <string>
#include <vector>

#include "viewer/window/panel/panel.h"

namespace lissom::test {

using window::Input;
using window::Key;

inline constexpr gl::Extent kWindow{700, 480};

// A panel with a hand, and what was answered so far.
struct PanelFrames {
    PanelFrames() {
        content.lines = {{window::LineKind::message, "a line"}};
        content.objects = {"ball"};
        for (int i = 0; i < 4; ++i) make();
    }
    void make() {
        const window::PanelAnswers answers = panel.make(content, settings, kWindow, 0.02);
        changes += answers.parameters_changed;
        pressed += answers.run_again;
        saved += answers.save;
        exports += answers.exports ? 1 : 0;
        if (answers.save_preset) saved_presets.push_back(*answers.save_preset);
        if (answers.line) entered.push_back(*answers.line);
    }
    void feed(Input::Kind kind, const Vec2& at) {
        Input input;
        input.kind = kind;
        input.at = at;
        panel.feed(input);
    }
    // Until nothing differs, which takes a few frames.
    void settle() {
        for (int i = 0; i < 10 && differs(); ++i) continue;
    }
    // Of the next frame.
    bool differs() {
        make();
        return panel.lists().beside_differs() || panel.lists().over_differs();
    }
    void click(const Vec2& at, bool with_control = false) {
        for (const auto kind : {Input::Kind::move, Input::Kind::press, Input::Kind::release}) {
            Input input;
            input.kind = kind;
            input.at = at;
            input.modifiers.ctrl = with_control;
            panel.feed(input);
            make();
        }
        make();
    }
    // Clicks at this distance from the left, from below upwards as what is closed moves what is
    // below it, until a field has the keys; how low. Begins at `y`.
    double click_a_field(double x, bool with_control = false, double y = kWindow.height) {
        while (y > 60.0 && !panel.wants_keys()) click({x, y -= 6.0}, with_control);
        return y;
    }
    void type(const std::string& text) {
        for (const char letter : text) {
            Input input;
            input.kind = Input::Kind::text;
            input.character = static_cast<char32_t>(letter);
            panel.feed(input);
            make();
        }
    }
    void press(Key key, char32_t character = 0, bool with_control = false) {
        Input input;
        input.key = key;
        input.character = character;
        input.modifiers.ctrl = with_control;
        for (const auto kind : {Input::Kind::key_down, Input::Kind::key_up}) {
            input.kind = kind;
            panel.feed(input);
            make();
        }
        make();
    }
    void take_back() { press(Key::character, U'Z', true); }

    window::Panel panel{window::PanelHost{}};
    window::PanelContent content;
    window::DisplaySettings settings;
    int changes = 0, pressed = 0, saved = 0;
    std::vector<std::string> saved_presets, entered;
    int exports = 0;
};

}  // namespace lissom::test
