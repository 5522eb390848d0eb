/// DrawnLists: parts of a window that differ from the shown ones, by the lists that Dear ImGui has
/// drawn there. Needs no context of OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include "viewer/window/screen/canvas.h"

struct ImDrawData;
struct ImDrawList;

namespace lissom::window {

class DrawnLists {
  public:
    /// Reads the lists drawn next around and over a picture on `canvas`.
    void see(const ImDrawData& data, const Canvas& canvas);
    /// Returns whether the lists beside the picture differ from the time before, or reach over its
    /// border, so that all has to be drawn.
    bool beside_differs() const { return beside_differs_; }
    /// Returns whether the lists over the picture differ.
    bool over_differs() const { return over_differs_; }
    /// Returns the lists over the picture, in their order.
    const std::vector<ImDrawList*>& over() const { return over_; }

  private:
    std::uint64_t beside_hash_ = 0, over_hash_ = 0;
    bool beside_differs_ = true, over_differs_ = true;
    std::vector<ImDrawList*> over_;
};

}  // namespace lissom::window
