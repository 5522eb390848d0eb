/// RecordingPlay: the events of an open recording, done one after the other on the session's
/// thread.
#pragma once

#include <cstddef>
#include <string>

#include "viewer/window/document/open_scene.h"

namespace lissom::window {

class RecordingPlay {
  public:
    RecordingPlay(OpenScene& scene, SessionParts parts) : scene_(scene), parts_(parts) {}

    /// Opens a recording in the present state of Lua; returns whether that worked.
    bool open(const std::string& path);
    /// Returns the files that its scene was made of.
    const std::vector<std::string>& files() const { return recording_.files; }
    /// Offers the recording to the window, whose events then come by `play`.
    void begin(const std::string& path);
    /// Stops taking events, before another document is opened.
    void end();
    /// Does an event, unless it is no longer taken. An error ends the recording.
    void play(std::size_t event);

  private:
    void fail(cli::ScriptResult result, std::size_t event);

    OpenScene& scene_;
    SessionParts parts_;
    Recording recording_;
};

}  // namespace lissom::window
