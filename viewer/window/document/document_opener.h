/// DocumentOpener: opens scripts, files and recordings on the session's thread. A document that
/// cannot be opened leaves the one before it in place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/window/document/open_scene.h"
#include "viewer/window/document/recording_play.h"

namespace lissom::window {

class DocumentOpener {
  public:
    DocumentOpener(OpenScene& scene, RecordingPlay& play, SessionParts parts)
        : scene_(scene), play_(play), parts_(parts) {}

    /// Opens the document that `words` name, again unless it `is_new`.
    void run(const std::vector<std::string>& words, bool is_new);
    /// Finds out which of these scripts are tools, each in a state of its own, and tells it.
    void find_tools(const std::vector<std::string>& scripts);

  private:
    bool opens(const std::vector<std::string>& words, bool is_new);
    void adopt(const std::vector<std::string>& words);
    bool run_script(const std::vector<std::string>& words, bool is_new);
    bool has_shown(const std::string& script);
    void settle_script(const std::vector<std::string>& words, bool is_same);
    void settle_failed(OpenScene::State before, bool is_same);
    void publish_parameters();
    void find_files(const std::string& script);
    void take_own_tool(const std::string& path);
    std::optional<std::string> name_of_tool(const std::string& script);
    bool load_files(const std::vector<std::string>& paths, bool is_new);
    bool keeps_files(const std::vector<std::string>& paths, bool is_new, bool works);
    void tell_sizes();
    bool open_recording(const std::string& path, bool is_new);
    void forget_script();

    OpenScene& scene_;
    RecordingPlay& play_;
    SessionParts parts_;
    // The script of the present scene.
    std::string ran_;
};

}  // namespace lissom::window
