/// SideView: the controls beside the picture.
#pragma once

#include <string>
#include <vector>

#include "viewer/render/gl/gl_objects.h"
#include "viewer/window/panel/panel_content.h"
#include "viewer/window/screen/display.h"

namespace lissom::window {

class SideView {
  public:
    /// Draws the controls at the left of a window, `width` pixels wide. Changes `settings` and the
    /// values of `content.parameters` as a person asks.
    void draw(PanelContent& content, DisplaySettings& settings, PanelAnswers& answers,
              gl::Extent window, int width);

  private:
    void draw_presets(const std::vector<std::string>& presets, PanelAnswers& answers);
    void draw_parameters_section(PanelContent& content, PanelAnswers& answers);

    // The name of a preset that a person writes.
    std::string preset_;
};

}  // namespace lissom::window
