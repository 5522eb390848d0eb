/// ConsoleView: the console below the picture.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "viewer/render/gl/gl_objects.h"
#include "viewer/window/panel/panel_content.h"
#include "viewer/window/panel/panel_input.h"
#include "viewer/window/panel/prompt.h"
#include "viewer/window/screen/canvas.h"

namespace lissom::window {

class ConsoleView {
  public:
    /// `scale`: pixels in a unit of length.
    explicit ConsoleView(double scale);

    /// Returns the height of the console in a window, in pixels.
    int height(gl::Extent window) const;
    /// Draws it below the picture; `input` owes a frame if it scrolls.
    void draw(PanelContent& content, PanelAnswers& answers, gl::Extent window, const Canvas& above,
              bool is_dark, PanelInput& input);
    /// Returns whether a list of the console lies over the picture.
    bool is_over_picture() const { return prompt_.has_candidates(); }

  private:
    void draw_lines(const std::vector<ConsoleLine>& lines, PanelAnswers& answers, bool is_dark,
                    PanelInput& input);
    void find_places(const std::vector<ConsoleLine>& lines);
    void drag_edge(const Canvas& above, gl::Extent window);
    void clear(PanelContent& content);

    double scale_;
    // In units of length: a person drags its upper edge.
    double height_;
    Prompt prompt_;
    // The place named by each line.
    std::vector<std::optional<SourcePlace>> places_;
    std::size_t lines_drawn_ = 0;
};

}  // namespace lissom::window
