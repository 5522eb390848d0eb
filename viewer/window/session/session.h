/// Session: the document of a window, a script or files, worked on by a thread of its own. The
/// window reads finished results and never waits.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/cli/script.h"
#include "bindings/lua/core/script_parameters.h"
#include "kernel/core/clock.h"
#include "kernel/io/mesh_file.h"
#include "viewer/window/session/record_files.h"
#include "viewer/window/session/session_news.h"
#include "viewer/window/session/snapshot_bounds.h"
#include "viewer/window/session/worker.h"
#include "viewer/window/tools/tool_bench.h"

namespace lissom::window {

struct SessionOptions {
    /// The tool that is in hand from the first: a file, or the name of one that ships.
    std::string tool = {};
    /// File that records the work of tools; empty for none.
    std::string record = {};
    /// File that keeps the calls of tools as a script; empty for none but that of `copy_scene`.
    std::string journal = {};
    /// How mesh files are read.
    LoadOptions load = {};
};

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
    bool is_playing() const { return plays_; }
    /// Number of events that are done.
    std::size_t events_played() const { return events_played_; }
    /// Stops the running work, drops waiting events, and releases the objects held by the
    /// recording.
    void stop_playing();

    bool busy() const { return worker_.busy(); }
    /// Returns whether another document is being opened, which may yet fail.
    bool is_opening() const;
    /// Returns whether a value of a parameter waits: the state of the tool is older.
    bool has_setting() const;
    /// Returns the name of the running operation, and the fraction done.
    std::pair<std::string, double> progress() const;
    /// Returns the results since the last call.
    SessionNews take_news();
    /// Returns the files of the shown picture: the script, its required modules, or the files.
    std::vector<std::filesystem::path> files() const;
    /// Returns the files of the tool in hand.
    std::vector<std::filesystem::path> tool_files() const;

    /// Stops the running work and waits `seconds` for it; returns false if it goes on: the process
    /// must then end without ending this object.
    bool finish(double seconds);

  private:
    // A state of Lua with the scene in it.
    struct Document {
        std::unique_ptr<cli::Script> script;
        std::unique_ptr<ToolBench> bench;
        std::size_t pictures = 0;
    };
    void run(const std::vector<std::string>& words, bool is_new);
    bool opens(const std::vector<std::string>& words, bool is_new);
    void adopt(const std::vector<std::string>& words);
    void forget_script();
    Document put_aside();
    void put_back(Document document);
    void show_last();
    void show_again(const std::optional<Shown>& shown);
    void open_script(const lua::ScriptArguments& arguments);
    bool run_script(const std::vector<std::string>& words, bool is_new);
    bool keeps_failed(const std::vector<std::string>& words, bool is_new) const;
    bool has_words() const;
    bool has_shown(const std::string& script);
    bool has_values();
    void settle_script(const std::vector<std::string>& words, bool is_same);
    void settle_failed(Document before, bool is_same);
    void take_own_tool(const std::string& path);
    void look_for_tools(const std::vector<std::string>& scripts);
    std::optional<std::string> name_of_tool(const std::string& script);
    bool show_values();
    bool load_files(const std::vector<std::string>& paths, bool is_new);
    void tell_sizes();
    bool open_recording(const std::string& path, bool is_new);
    void play(std::size_t event);
    void let_go();
    void settle_scene(const std::vector<std::string>& open, bool takes_tool = true);
    bool settle_tool(const std::string& word);
    void keep_tool(const std::string& word);
    void post_job(Worker::Job job);
    void post_only(Worker::Job job);
    void begin_work();
    void set_saving(bool saves);
    void give_up();
    void tell_whether_mended(const std::string& file, bool works);
    using Setting = std::pair<std::string, lua::ParameterValue>;
    void set_parameter(const std::shared_ptr<Setting>& setting);
    void take_inputs();
    void take_input(const ToolInput& input, bool is_late);
    bool succeeds(const cli::ScriptResult& result);
    void recover();
    void draw_marks();
    void show_scene(bool always);
    void evaluate_line(const std::string& line);
    lua_State* console_state();
    void find_completions(const std::string& text);
    void show(Picture picture, std::vector<std::string> names = {});
    void tell(LineKind kind, const std::string& text);
    void publish_parameters();
    void find_files(const std::string& script);
    void set_files(std::vector<std::filesystem::path> files);
    static int print(lua_State* L);

    cli::Program& program_;
    std::function<void()> wake_;

    // Shared, under the mutex: requests, and the state of the work.
    struct Shared {
        SessionNews news;
        // Words of the open document, and of the one to be opened.
        std::vector<std::string> words, asked;
        std::vector<std::filesystem::path> files, tool_files;
        // Each is taken by a job of its own; the last of them grows while no other job follows it.
        std::deque<std::vector<ToolInput>> inputs;
        bool takes_inputs_last = false;
        // The last waiting job, if it sets a parameter of the tool.
        std::shared_ptr<Setting> last_setting;
        std::string stage;
        double fraction = 0.0;
        Clock::time_point work_began;
        std::uint64_t number = 0;
    };
    mutable std::mutex mutex_;
    Shared shared_;

    std::atomic<bool> plays_{false};
    // Running work is stopped for something else.
    std::atomic<bool> given_up_{false};
    /// Guards `saves_`, which is true while `cancel` must not stop the job that runs.
    std::mutex cancel_mutex_;
    bool saves_ = false;
    std::atomic<std::size_t> events_played_{0};
    // Numbers of the last document asked for, and of the last that was opened or failed.
    std::atomic<std::uint64_t> asked_{0}, opened_{0};

    // The worker's own.
    SessionOptions options_;
    Recording recording_;
    bool shows_hand_ = false;
    std::function<void(const Picture&)> listener_;
    std::unique_ptr<cli::Script> script_;
    std::unique_ptr<ToolBench> bench_;
    ToolInput look_;
    RecordFiles records_;
    std::string draw_error_;
    // The script or tool that failed last, as it was called.
    std::string broken_;
    // The script of the present scene, and its state kept when it runs again.
    std::string ran_, kept_;
    std::uint64_t scene_number_ = 0;
    ToolState last_state_;
    FrozenMeshes frozen_;
    SnapshotBounds bounds_;
    std::size_t pictures_ = 0;
    std::optional<Shown> last_shown_;
    Worker worker_;
};

/// Returns whether a word of the command line names a script.
bool is_script(const std::string& word);
/// Returns whether it names a script that only repeats a recording.
bool is_recording(const std::string& word);

}  // namespace lissom::window
