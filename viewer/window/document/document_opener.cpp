#include "viewer/window/document/document_opener.h"

#include <filesystem>
#include <utility>

#include "viewer/window/session/script_setup.h"
#include "viewer/window/session/unlike_sizes.h"

namespace lissom::window {

void DocumentOpener::run(const std::vector<std::string>& words, bool is_new) {
    parts_.control.begin();
    parts_.control.go_on();
    play_.end();
    // If nothing is open yet, nothing is lost.
    const bool is_first = is_new && parts_.names.words().empty();
    if (is_first) adopt(words);
    if (!opens(words, is_new && !is_first)) scene_.let_go();
    parts_.news.wake();
}

bool DocumentOpener::opens(const std::vector<std::string>& words, bool is_new) {
    if (is_recording(words.front())) return open_recording(words.front(), is_new);
    if (is_script(words.front())) return run_script(words, is_new);
    return load_files(words, is_new);
}

// Makes these words the open document.
void DocumentOpener::adopt(const std::vector<std::string>& words) {
    parts_.names.adopt(words);
    parts_.news.change([&](SessionNews& news) {
        news.opened = words;
        news.parameters = std::vector<lua::ScriptParameter>();
    });
}

// Nothing of a script stays with the open document now.
void DocumentOpener::forget_script() {
    ran_.clear();
    scene_.forget_selection();
}

// ---- Scripts

// A script that runs again finds the selection and the tool as they were; one that fails leaves the
// scene before it to the tools.
bool DocumentOpener::run_script(const std::vector<std::string>& words, bool is_new) {
    const bool is_same = ran_ == words[0];
    if (is_same) scene_.keep_selection();
    OpenScene::State before = scene_.put_aside();
    scene_.open({words[0], {words.begin() + 1, words.end()}});
    const cli::ScriptResult result = scene_.script().run_file(words[0]);
    const bool works = result.status == cli::kSuccess;
    const int top = lua_gettop(scene_.script().lua());
    const bool is_tool = works && scene_.bench().tool_among({1, top}).has_value();
    scene_.tell_whether_mended(words[0], works);
    if (!works) scene_.succeeds(result);
    const bool is_seen = works && !is_tool && has_shown(words[0]);
    if (is_tool || (!is_seen && !parts_.names.keeps_failed(words, is_new))) {
        const std::optional<Shown> seen = before.shown;
        scene_.put_back(std::move(before));
        scene_.show_again(seen);
        if (is_tool) take_own_tool(words[0]);
        return false;
    }
    if (is_new) adopt(words);
    publish_parameters();
    find_files(words[0]);
    if (works) settle_script(words, is_same);
    if (!works) settle_failed(std::move(before), is_same);
    return works;
}

// Returns whether a script that has run has anything to show; reports if it has not.
bool DocumentOpener::has_shown(const std::string& script) {
    if (scene_.has_pictures() || scene_.has_values()) return true;
    parts_.news.tell(LineKind::warning,
                     script +
                         " shows nothing: let it draw with lissom.render, or return an object "
                         "to show: a mesh, strands, a scene, or a table of them");
    return scene_.bench().has_scene_among({1, lua_gettop(scene_.script().lua())});
}

void DocumentOpener::settle_failed(OpenScene::State before, bool is_same) {
    lua_settop(scene_.script().lua(), 0);
    if (is_same && before.bench && before.bench->has_scene()) scene_.put_back(std::move(before));
}

void DocumentOpener::settle_script(const std::vector<std::string>& words, bool is_same) {
    lua_State* L = scene_.script().lua();
    if (!is_same) scene_.forget_selection();
    ran_ = words[0];
    // They were shown before it was known that they would stay.
    if (scene_.has_pictures()) scene_.show_last();
    scene_.show_values();
    scene_.succeeds(scene_.bench().take_values({1, lua_gettop(L)}));
    // The words of its command line are not in a recording.
    scene_.settle(words.size() == 1 ? words : std::vector<std::string>());
    lua_settop(L, 0);
}

void DocumentOpener::publish_parameters() {
    const auto& declared = scene_.script().state().parameters;
    if (!declared) return;
    parts_.news.change([&](SessionNews& news) { news.parameters = declared->list; });
}

void DocumentOpener::find_files(const std::string& script) {
    std::vector<std::filesystem::path> files = module_files(scene_.script().lua());
    files.emplace_back(script);
    parts_.names.set_files(std::move(files));
}

// ---- Scripts that are tools

// A tool was opened: it is taken in hand, now or with the next scene.
void DocumentOpener::take_own_tool(const std::string& path) {
    if (scene_.has_scene()) {
        scene_.use_tool(path);
        return scene_.show(true);
    }
    scene_.set_next_tool(path);
    parts_.news.tell(LineKind::message, path + " is a tool: open an object for it to work on");
}

void DocumentOpener::find_tools(const std::vector<std::string>& scripts) {
    parts_.control.begin();
    std::string names;
    std::vector<std::pair<std::string, std::string>> found;
    for (const std::string& script : scripts) {
        OpenScene::State before = scene_.put_aside();
        const std::optional<Shown> seen = before.shown;
        const std::optional<std::string> name = name_of_tool(script);
        scene_.put_back(std::move(before));
        scene_.show_again(seen);
        if (!name) continue;
        names += (names.empty() ? "" : ", ") + *name;
        found.emplace_back(script, *name);
    }
    if (!found.empty()) {
        parts_.news.tell(LineKind::result, "tools that have a button now: " + names);
    }
    parts_.news.change([&](SessionNews& news) {
        news.tools.insert(news.tools.end(), found.begin(), found.end());
    });
    parts_.news.wake();
}

// Nothing if the script fails or is no tool, which is told.
std::optional<std::string> DocumentOpener::name_of_tool(const std::string& script) {
    scene_.open({script, {}});
    const cli::ScriptResult result = scene_.script().run_file(script);
    if (result.status != cli::kSuccess) {
        parts_.news.tell(LineKind::error, result.message);
        return std::nullopt;
    }
    const int top = lua_gettop(scene_.script().lua());
    if (auto name = scene_.bench().tool_among({1, top})) return name;
    parts_.news.tell(LineKind::warning, script + " is no tool: drop it alone to run it");
    return std::nullopt;
}

// ---- Files and recordings

// Makes the files the open document, if they were read or it is theirs; returns whether it did.
bool DocumentOpener::keeps_files(const std::vector<std::string>& paths, bool is_new, bool works) {
    if (!works && !parts_.names.keeps_failed(paths, is_new)) return false;
    if (is_new) adopt(paths);
    parts_.names.set_files({paths.begin(), paths.end()});
    return true;
}

bool DocumentOpener::load_files(const std::vector<std::string>& paths, bool is_new) {
    OpenScene::State before = scene_.put_aside();
    scene_.open({});
    const bool works = scene_.succeeds(scene_.bench().open(paths, scene_.options().load));
    if (!works) scene_.put_back(std::move(before));
    if (!keeps_files(paths, is_new, works) || !works) return false;
    forget_script();
    scene_.settle(paths);
    tell_sizes();
    return true;
}

void DocumentOpener::tell_sizes() {
    const ToolPicture seen = scene_.bench().picture();
    const std::string hint = unlike_sizes(seen.picture.meshes, seen.names);
    if (!hint.empty()) parts_.news.tell(LineKind::warning, hint);
}

bool DocumentOpener::open_recording(const std::string& path, bool is_new) {
    OpenScene::State before = scene_.put_aside();
    scene_.open({});
    const bool works = play_.open(path);
    if (!works) scene_.put_back(std::move(before));
    if (!keeps_files({path}, is_new, works) || !works) return false;
    forget_script();
    scene_.settle(play_.files(), false);
    play_.begin(path);
    return true;
}

}  // namespace lissom::window
