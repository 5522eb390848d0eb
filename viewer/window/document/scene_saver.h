/// SceneSaver: writes the scene of a session and its objects to files, on the session's thread.
#pragma once

#include <cstdint>
#include <string>

#include "viewer/window/document/open_scene.h"

namespace lissom::window {

class SceneSaver {
  public:
    SceneSaver(OpenScene& scene, SessionParts parts) : scene_(scene), parts_(parts) {}

    /// Writes the scene, if it is still the one with the number `scene` (0: any), and tells it;
    /// the news then have `change`.
    void save(const std::string& path, std::uint64_t scene, std::uint64_t change);
    /// Writes the mesh or the hair in hand, and tells the file.
    void export_object(const std::string& path);
    /// Writes the scene and, if no other was asked for, its journal, silently.
    void copy(const std::string& path, const std::string& journal);

  private:
    OpenScene& scene_;
    SessionParts parts_;
};

}  // namespace lissom::window
