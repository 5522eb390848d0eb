/// Session: the document of a window, a script or files, worked on by a thread of its own. The
/// window reads finished results and never waits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/window/document/console.h"
#include "viewer/window/document/document_opener.h"
#include "viewer/window/document/open_scene.h"
#include "viewer/window/document/recording_play.h"
#include "viewer/window/document/request_queue.h"
#include "viewer/window/document/scene_saver.h"

namespace lissom::window {

class Session {
  public:
    /// `wake` is called on the session's thread when there is something new.
    Session(cli::Program& program, std::function<void()> wake, SessionOptions options = {});
    /// Stops the running work; waits a second for it at most.
    ~Session();

    // ---- For the window's thread. All of it returns at once.

    /// Opens mesh files, runs a script with the words that follow it on its command line, or opens
    /// the scene of a recording, whose events are then to be posted. A script that returns a tool
    /// puts that in hand instead. If it fails, all that was open before stays as it was.
    void open(const std::vector<std::string>& words);
    /// Finds out which of these scripts are tools, for `take_tools`, and tells it; none is taken in
    /// hand, and the open document stays.
    void find_tools(const std::vector<std::string>& scripts);
    /// Runs the script again, or reads the files again, with `words` as the command line of the
    /// script. Running work is given up; while something else is being opened nothing is done.
    void run_again(const std::vector<std::string>& words);
    /// Evaluates a line of Lua in the state of the script; values that can be seen are shown.
    void evaluate(const std::string& line);
    /// Finds out how `text`, a line of the console up to the cursor, may go on.
    void complete(const std::string& text);
    /// Stops the running work.
    void cancel();
    /// Takes a tool in hand: a file, the name of one that ships, or none if `word` is empty.
    void use_tool(const std::string& word);
    /// Reads the tool in hand again, with its parameters and state; the old one stays if the new
    /// one fails.
    void read_tool_again();
    /// A hand has done this.
    void post(ToolInput input);
    /// Shows or hides an object of the scene.
    void show_object(const std::string& name, bool visible);
    /// Writes the scene to a file, and tells that it did, if it is still the scene with the number
    /// `scene`; `take_saved` then returns `change`.
    void save_scene(const std::string& path, std::uint64_t scene = 0, std::uint64_t change = 0);
    /// Writes the mesh or the hair in hand to a file whose ending names the format, a free name if
    /// `path` is empty, and tells it. After an error all is as before.
    void export_object(const std::string& path);
    /// Writes the scene and, if no other was asked for, its journal to files, silently.
    void copy_scene(const std::string& path, const std::string& journal);
    /// A parameter of the tool has this value.
    void set_tool_parameter(const std::string& name, const lua::ParameterValue& value);

    // ---- Playing

    /// Returns whether events of it are taken: until the last, a failure or `stop_playing`.
    bool is_playing() const { return playing_.goes_on; }
    /// Number of events that are done.
    std::size_t events_played() const { return playing_.events; }
    /// Stops the running work, drops waiting events, and releases the objects held by the
    /// recording.
    void stop_playing();

    bool busy() const { return queue_.busy(); }
    /// Returns whether another document is being opened, which may yet fail.
    bool is_opening() const { return names_.is_opening(); }
    /// Returns whether a value of a parameter waits: the state of the tool is older.
    bool has_setting() const { return queue_.has_setting(); }
    /// Returns the name of the running operation, and the fraction done.
    std::pair<std::string, double> progress() const { return control_.progress(); }
    /// Returns the results since the last call.
    SessionNews take_news() { return news_.take(); }
    /// Returns the files of the shown picture: the script, its required modules, or the files.
    std::vector<std::filesystem::path> files() const { return names_.files(); }
    /// Returns the files of the tool in hand.
    std::vector<std::filesystem::path> tool_files() const { return names_.tool_files(); }

    /// Stops the running work and waits `seconds` for it; returns false if it goes on: the process
    /// must then end without ending this object.
    bool finish(double seconds);

  private:
    void post_only(Worker::Job job);
    void take_inputs();
    void take_input(const ToolInput& input, bool is_late);

    // Of both threads.
    NewsBoard news_;
    WorkControl control_;
    OpenNames names_;
    Playing playing_;
    // Of the session's thread.
    OpenScene scene_;
    RecordingPlay play_;
    DocumentOpener opener_;
    Console console_;
    SceneSaver saver_;
    // The last member: its thread ends before the others do.
    RequestQueue queue_;
};

}  // namespace lissom::window
