/// Console: lines of Lua that a person types, run in the state of the open script on the session's
/// thread.
#pragma once

#include <string>

#include "viewer/window/document/open_scene.h"

namespace lissom::window {

class Console {
  public:
    Console(OpenScene& scene, SessionParts parts) : scene_(scene), parts_(parts) {}

    /// Runs a line; shows values that can be seen, and tells the others.
    void evaluate(const std::string& line);
    /// Finds out how `text`, a line up to the cursor, may go on.
    void complete(const std::string& text);

  private:
    lua_State* state();
    bool load(lua_State* L, const std::string& line, const std::string& statement);
    void run(lua_State* L, const std::string& statement);
    void show_results(lua_State* L);

    OpenScene& scene_;
    SessionParts parts_;
};

}  // namespace lissom::window
