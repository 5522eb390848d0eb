/// ShownPictures: pictures on their way to the window, of the thread of a session.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/render/picture.h"
#include "viewer/window/document/news_board.h"
#include "viewer/window/session/snapshot_bounds.h"

namespace lissom::window {

class ShownPictures {
  public:
    explicit ShownPictures(NewsBoard& news) : news_(news) {}

    /// Shows a picture, with copies of its meshes and strands; `names` are those of its meshes.
    /// Tells an error.
    void show(Picture picture, std::vector<std::string> names = {});
    /// Returns the picture shown last.
    const std::optional<Shown>& last() const { return last_; }
    /// Shows it anew.
    void show_last();
    /// Shows `shown` again if something else was shown meanwhile.
    void show_again(const std::optional<Shown>& shown);

  private:
    NewsBoard& news_;
    FrozenMeshes frozen_;
    SnapshotBounds bounds_;
    std::optional<Shown> last_;
};

}  // namespace lissom::window
