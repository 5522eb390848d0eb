#include "viewer/window/document/scene_saver.h"

#include <optional>

namespace lissom::window {

void SceneSaver::save(const std::string& path, std::uint64_t scene, std::uint64_t change) {
    if (!scene_.has_scene() || scene_.bench().is_held()) return;
    parts_.control.begin();
    if (scene != 0 && scene != scene_.number()) {
        return parts_.news.tell(LineKind::warning,
                                "another scene is open by now: nothing was saved");
    }
    if (scene_.bench().is_empty()) {
        return parts_.news.tell(LineKind::warning, "the scene has no objects: nothing was saved");
    }
    std::string left_out;
    parts_.control.set_saving(true);
    const cli::ScriptResult result = scene_.bench().save(path, left_out);
    parts_.control.set_saving(false);
    if (!scene_.succeeds(result)) return;
    parts_.news.tell(LineKind::result, "saved " + path);
    if (!left_out.empty()) parts_.news.tell(LineKind::warning, left_out);
    parts_.news.change([&](SessionNews& news) { news.saved = change; });
}

void SceneSaver::export_object(const std::string& path) {
    if (!scene_.has_scene()) {
        return parts_.news.tell(LineKind::warning, "there is no scene: nothing was exported");
    }
    if (scene_.bench().is_held()) return;
    parts_.control.begin();
    std::string told;
    parts_.control.set_saving(true);
    const cli::ScriptResult result = scene_.bench().export_object(path, told);
    parts_.control.set_saving(false);
    if (scene_.succeeds(result)) parts_.news.tell(LineKind::result, told);
}

void SceneSaver::copy(const std::string& path, const std::string& journal) {
    if (!scene_.has_scene() || scene_.bench().is_held()) return;
    parts_.control.begin();
    std::string left_out;
    if (!scene_.succeeds(scene_.bench().save(path, left_out))) return;
    if (scene_.records().has_journal()) return;
    const std::optional<std::string> text = scene_.bench().text_of(Transcript::journal);
    if (text && !write_whole(journal, *text)) {
        parts_.news.tell(LineKind::error, "the journal cannot be written to " + journal);
    }
}

}  // namespace lissom::window
