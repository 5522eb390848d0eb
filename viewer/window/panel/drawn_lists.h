/// DrawnLists: which parts of a window differ from what is in it, by what Dear ImGui has drawn
/// there. Needs no context of OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include "viewer/window/screen/canvas.h"

struct ImDrawData;
struct ImDrawList;

namespace lissom::window {

class DrawnLists {
  public:
    /// Sees what is drawn next around and over a picture on `canvas`.
    void see(const ImDrawData& data, const Canvas& canvas);
    /// Whether what is beside the picture differs from the time before, or reaches over its border,
    /// so that all has to be drawn.
    bool beside_differs() const { return beside_differs_; }
    /// Whether what lies over the picture differs.
    bool over_differs() const { return over_differs_; }
    /// What lies over the picture, in its order.
    const std::vector<ImDrawList*>& over() const { return over_; }

  private:
    std::uint64_t beside_hash_ = 0, over_hash_ = 0;
    bool beside_differs_ = true, over_differs_ = true;
    std::vector<ImDrawList*> over_;
};

}  // namespace lissom::window
