/// ToolBench: a scene of a script and the tool in hand, in the script's Lua state. It lives on the
/// thread of the script.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/script.h"
#include "bindings/lua/core/script_parameters.h"
#include "kernel/io/mesh_file.h"
#include "viewer/render/picture.h"
#include "viewer/window/session/tool_input.h"

namespace lissom::window {

/// Text at a point of the world.
struct ToolLabel {
    Vec3 at = Vec3::Zero();
    std::string text;
    Color color;

    bool operator==(const ToolLabel&) const = default;
};

/// A line in the picture, in pixels from its top left corner.
struct ToolOutline {
    std::vector<Vec2> pixels;
    bool closed = false;
    Color color;
    double width = 1.5;
    /// 0 for nothing to 1.
    double opacity = 1.0;

    bool operator==(const ToolOutline&) const = default;
};

/// A surface between two lines of the world, as many points each, that is seen through.
struct ToolSurface {
    std::vector<Vec3> from, to;
    Color color;
    double opacity = 0.25;

    bool operator==(const ToolSurface&) const = default;
};

/// Marks of a tool that are no part of the scene.
struct ToolMarks {
    std::vector<ToolLabel> labels;
    std::vector<ToolOutline> outlines;
    std::vector<ToolSurface> surfaces;

    bool operator==(const ToolMarks&) const = default;
};

/// An object of the scene.
struct ToolObject {
    std::string name;
    /// With the number of faces of a mesh.
    std::string label;
    bool visible = true;

    bool operator==(const ToolObject&) const = default;
};

/// The hand of a played recording: its view, and its place.
struct PlayedHand {
    Camera camera;
    gl::Extent size;
    /// In pixels of a picture of that size.
    Vec2 at = Vec2::Zero();
    bool is_down = false;
};

/// State of the scene and the tool for the panel.
struct ToolState {
    bool has_scene = false;
    /// Another number: another scene.
    std::uint64_t scene = 0;
    /// Camera of the scene, if the tool has set it since the last state.
    std::optional<Camera> camera;
    /// Likewise of a scene that was saved: the axis that points up in it.
    std::optional<ViewUp> up = std::nullopt;
    /// Objects that can be shown by themselves, in the order of the scene.
    std::vector<ToolObject> objects;
    /// Name of the tool in hand, and the word that it was taken by; empty for none.
    std::string tool, word;
    /// Question of the tool, or its help.
    std::string prompt;
    std::vector<lua::ScriptParameter> parameters;
    /// Names of the steps, oldest first; the first `place` can be undone.
    std::vector<std::string> steps;
    std::size_t place = 0;
    /// In the world, part of the picture.
    Overlay overlay;
    ToolMarks marks;
    /// While a recording is played.
    std::optional<PlayedHand> hand;

    /// Whether the same is seen; parameters are not looked at.
    bool operator==(const ToolState& other) const;
};

/// Result of an event of a recording.
struct PlayedEvent {
    /// First difference of the scene from the recording.
    std::string difference;
    /// The tool that is in hand from now on, as `ToolBench::use` takes it.
    std::optional<std::string> tool;
};

class ToolBench {
  public:
    /// `script` must outlive it, and has opened lissom.
    explicit ToolBench(cli::Script& script) : script_(script) {}

    // ---- Scenes. Each function answers how it went; after a failure all is as before.

    /// Opens files as one scene: meshes, read with `options`, or one .lissom file.
    cli::ScriptResult open(const std::vector<std::string>& paths, const LoadOptions& options);
    /// Makes a scene of the values between two stack indices: an existing scene, or objects that a
    /// scene can hold. Without any there is no scene afterwards.
    cli::ScriptResult take_values(int first, int last);
    bool has_scene() const { return has_scene_; }
    /// Returns whether the values between two stack indices are one tool.
    bool is_tool(int first, int last);
    /// Returns the name of the tool at a stack index.
    std::string tool_name(int index);
    /// Returns whether one of the values between two stack indices is a scene.
    bool has_scene_among(int first, int last) const;
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
    /// Returns whether one of the values between two stack indices is an object of the scene, or
    /// that.
    bool holds(int first, int last);
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

    /// Begins a recording ("record") or a journal ("keep_journal"); `open` are the files of the
    /// scene, if nothing else led to it, and their options.
    cli::ScriptResult record(const char* method, const std::vector<std::string>& open,
                             const LoadOptions& options);
    /// Returns their text up to now ("recording", "journal_text"); nothing if none is made.
    std::optional<std::string> text_of(const char* method);

    // ---- Playing

    /// Opens the scene of a recording; `files` are those it was made of, `times` the seconds of its
    /// events. Errors as those of lissom.replay before the first event.
    cli::ScriptResult open_recording(const std::string& path, std::vector<std::string>& files,
                                     std::vector<double>& times);
    /// Does the event at `place` of the open recording.
    cli::ScriptResult play(std::size_t place, PlayedEvent& done);
    /// Returns whether a difference was found.
    bool play_differs() const { return play_differs_; }
    /// Returns the kind of the event at `place`.
    std::string event_kind(std::size_t place);
    /// Returns the hand as the last event left it.
    PlayedHand hand() const;

    // ---- Results

    /// Asks the tool for its marks; then `picture` and `state` can be asked.
    cli::ScriptResult draw();
    /// Errors: those of drawing_of.
    Picture picture();
    /// Returns a name for each mesh of the picture.
    std::vector<std::string> names_of(const Picture& picture);
    ToolState state();
    /// The camera that the tool or a saved scene has set since the last call.
    struct Looked {
        std::optional<Camera> camera;
        /// Up axis of a saved scene.
        std::optional<ViewUp> up;
    };
    Looked looked();

  private:
    cli::ScriptResult call(const char* method, int count);
    cli::ScriptResult write_export(int first, std::string& told);
    void push_host() const;
    void push_tool() const;
    void paint_regions(Picture& picture);
    void add_meshes(Picture& picture);
    void revive_scene();

    cli::Script& script_;
    bool has_scene_ = false, play_differs_ = false;
    /// The scene, which a script may have closed and which must stay.
    std::shared_ptr<void> scene_;
};

/// Names of the tools that ship, in their order.
std::vector<std::string> shipped_tools();
/// Files of a person's own tools, in the order of their names: lissom/tools in $XDG_DATA_HOME, else
/// in ~/.local/share.
std::vector<std::string> own_tools();

}  // namespace lissom::window
