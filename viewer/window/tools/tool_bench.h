/// ToolBench: a scene of a script and the tool in hand, in the script's Lua state. It lives on the
/// thread of the script.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bindings/cli/script.h"
#include "bindings/lua/core/script_parameters.h"
#include "bindings/lua/tools/tool_calls.h"
#include "kernel/io/mesh_file.h"
#include "viewer/window/tools/tool_state.h"

namespace lissom::window {

/// An opened recording.
struct Recording {
    /// Files that its scene was made of.
    std::vector<std::string> files;
    /// Seconds of its events, and their kinds.
    std::vector<double> times;
    std::vector<std::string> kinds;
};

/// Result of an event of a recording.
struct PlayedEvent {
    /// First difference of the scene from the recording.
    std::string difference;
    /// Whether this or an earlier event has made a difference.
    bool differs = false;
    /// The tool that is in hand from now on, as `ToolBench::use` takes it.
    std::optional<std::string> tool;
};

/// A picture of the scene with the tool's marks, and a name for each of its meshes.
struct ToolPicture {
    Picture picture;
    std::vector<std::string> names;
};

/// A text of all that was done with tools: its events, or calls of the library.
enum class Transcript { recording, journal };

/// Values on the stack of the script, from the first to the last.
struct StackRange {
    int first = 1, last = 0;
};

class ToolBench {
  public:
    /// `script` must outlive it, and has opened lissom.
    explicit ToolBench(cli::Script& script) : script_(script) {}

    // ---- Scenes. Each function answers how it went; after a failure all is as before.

    /// Opens files as one scene: meshes, read with `options`, or one .lissom file.
    cli::ScriptResult open(const std::vector<std::string>& paths, const LoadOptions& options);
    /// Makes a scene of values: an existing scene, or objects that a scene can hold. Without any
    /// there is no scene afterwards.
    cli::ScriptResult take_values(StackRange values);
    bool has_scene() const { return has_scene_; }
    /// Returns the name of the tool that the values are; nothing if they are not one tool.
    std::optional<std::string> tool_among(StackRange values);
    /// Returns whether one of the values is a scene.
    bool has_scene_among(StackRange values) const;
    /// Returns whether one of the values is an object of the scene, or that.
    bool holds(StackRange values);
    /// Returns whether there is no scene, or one without objects.
    bool is_empty();
    /// Writes the scene to a file; `left_out` lists its omissions.
    cli::ScriptResult save(const std::string& path, std::string& left_out);
    /// Writes the mesh or the hair in hand to a file whose ending names the format, or to a free
    /// name if `path` is empty; `told` says which. The scene stays as it is.
    cli::ScriptResult export_object(const std::string& path, std::string& told);
    /// Sets the global variable `scene`, for lines of a console.
    void publish_scene();

    // ---- Tools

    /// Takes a tool in hand: a file, the name of one that ships, or none if `word` is empty; a
    /// recording calls it `told`.
    cli::ScriptResult use(const std::string& word, const std::string& told);
    /// Returns the files of `word`, the tool in hand.
    std::vector<std::filesystem::path> tool_files(const std::string& word);
    /// Returns whether a button is down that the tool knows of.
    bool is_held() const;
    /// A hand has done this; `is_late` if a later place of the same drag is known already.
    cli::ScriptResult take(const ToolInput& input, bool is_late = false);
    /// Shows or hides an object of the scene.
    cli::ScriptResult show(const std::string& name, bool visible);
    cli::ScriptResult set(const std::string& name, const lua::ParameterValue& value);
    /// After a call that was stopped from outside.
    bool recover();
    /// A line of a console follows.
    void begin_outside();
    /// Reports that `line`, a statement or an expression, was done, or `failed`: the journal has it
    /// if it has changed the scene. Returns true if a recording lacks that.
    bool changed_outside(const std::string& line, bool failed);

    /// Returns the selection, and the tool's parameters and state, as a text for `restore` in
    /// another state of Lua; nothing if there is no scene.
    std::optional<std::string> kept();
    /// Restores that before a tool is taken in hand; the selection only if it `selects`.
    cli::ScriptResult restore(const std::string& kept, bool selects);

    /// Begins a recording or a journal; `open` are the files of the scene, if nothing else led to
    /// it, and their options.
    cli::ScriptResult record(Transcript transcript, const std::vector<std::string>& open,
                             const LoadOptions& options);
    /// Returns its text up to now; nothing if none is made.
    std::optional<std::string> text_of(Transcript transcript);

    // ---- Playing

    /// Opens the scene of a recording. Errors as those of lissom.replay before the first event.
    cli::ScriptResult open_recording(const std::string& path, Recording& opened);
    /// Does the event at `place` of the open recording.
    cli::ScriptResult play(std::size_t place, PlayedEvent& done);

    // ---- Results

    /// Asks the tool for its marks; then `picture` and `state` show them.
    cli::ScriptResult draw();
    /// Errors: those of drawing_of.
    ToolPicture picture();
    /// Returns the state, with the hand as the last event has left it, and the camera and the up
    /// axis that the tool or a saved scene had set by the last drawing, once.
    ToolState state();

  private:
    cli::ScriptResult call(lua::ToolCall called, int count);
    template <typename... Results, typename... Arguments>
    cli::ScriptResult ask(std::tuple<Results&...> results, lua::ToolCall called,
                          const Arguments&... arguments);
    cli::ScriptResult write_export(int first, std::string& told);
    PlayedHand hand(int host) const;
    void look_at_scene(ToolState& state) const;
    void revive_scene();

    cli::Script& script_;
    bool has_scene_ = false;
    /// Set since the last state.
    std::optional<Camera> camera_;
    std::optional<ViewUp> up_;
    /// The scene, which a script may have closed and which must stay.
    std::shared_ptr<void> scene_;
};

}  // namespace lissom::window
