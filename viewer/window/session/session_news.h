/// Results of a session, for the window to take.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/repl/completion.h"
#include "bindings/lua/core/script_parameters.h"
#include "viewer/render/picture.h"
#include "viewer/window/session/snapshot_bounds.h"
#include "viewer/window/tools/tool_state.h"

namespace lissom::window {

enum class LineKind { message, result, input, warning, error };

/// A line of the console.
struct ConsoleLine {
    LineKind kind = LineKind::message;
    std::string text;
    /// Number of times that it came in a row.
    int times = 1;
};

/// Adds a line behind the others. A warning that differs from the last line in its numbers alone
/// takes its place and counts it, as a hand that goes on makes many of them.
void add_line(std::vector<ConsoleLine>& lines, ConsoleLine line);

/// Something finished to look at.
struct Shown {
    std::shared_ptr<const Picture> picture;
    /// Names of the meshes, if they have any.
    std::vector<std::string> names;
    Snapshot snapshot;
    Box bounds;
    /// Grows with every one.
    std::uint64_t number = 0;
};

/// Completion of a line of the console.
struct Completion {
    /// The line up to the cursor, as it was asked for.
    std::string text;
    cli::Completions found;
};

/// A recording that is ready to be played.
struct Playback {
    std::string path;
    /// Seconds of its events, in their order.
    std::vector<double> times;
};

/// All that is new; each result takes the place of an older one that was not taken.
struct SessionNews {
    /// Words that were opened.
    std::optional<std::vector<std::string>> opened;
    /// The number that the last saved scene was saved with.
    std::optional<std::uint64_t> saved;
    /// Tools that were found: file and name of each.
    std::vector<std::pair<std::string, std::string>> tools;
    /// The picture finished last.
    std::optional<Shown> shown;
    /// Lines of the console, of all that were told.
    std::vector<ConsoleLine> lines;
    /// Parameters that the script has declared.
    std::optional<std::vector<lua::ScriptParameter>> parameters;
    /// State of the scene and the tool, for the panel.
    std::optional<ToolState> tool_state;
    /// The completion asked for last.
    std::optional<Completion> completion;
    /// The recording that was opened.
    std::optional<Playback> playback;
};

}  // namespace lissom::window
