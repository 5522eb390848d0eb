/// RecordFiles: the recording and the journal of a session as files.
#pragma once

#include <string>
#include <vector>

#include "viewer/window/tools/tool_bench.h"

namespace lissom::window {

/// Writes a file whole or not at all; returns whether it did.
bool write_whole(const std::string& path, const std::string& text);

class RecordFiles {
  public:
    /// Files of the recording and of the journal; empty for none.
    RecordFiles(std::string recording, std::string journal)
        : recording_{Transcript::recording, std::move(recording), {}},
          journal_{Transcript::journal, std::move(journal), {}} {}

    bool has_recording() const { return !recording_.path.empty(); }
    bool has_journal() const { return !journal_.path.empty(); }
    /// Returns a recording's name of a file: its place beside or below the recording, else its
    /// whole path.
    std::string told_path(const std::string& path) const;
    /// Begins both for the scene of `bench`, made of the files `open` with their options. Returns
    /// the results of the calls.
    std::vector<cli::ScriptResult> begin(ToolBench& bench, const std::vector<std::string>& open,
                                         const LoadOptions& options) const;
    /// Writes what differs from the saved files, unless a gesture goes on. Returns a message for a
    /// file that cannot be written, once until one can; empty otherwise.
    std::string save(ToolBench& bench);

  private:
    struct Record {
        Transcript transcript;
        std::string path, saved;
    };
    std::string save(ToolBench& bench, Record& record);

    Record recording_, journal_;
    bool fails_ = false;
};

}  // namespace lissom::window
