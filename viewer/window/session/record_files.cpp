#include "viewer/window/session/record_files.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

namespace lissom::window {

namespace fs = std::filesystem;

bool write_whole(const std::string& path, const std::string& text) {
    const std::string beside = path + ".part";
    std::error_code error;
    {
        std::ofstream file(beside, std::ios::binary);
        if (!(file << text && file.flush())) {
            file.close();
            fs::remove(beside, error);
            return false;
        }
    }
    fs::rename(beside, path, error);
    return !error;
}

std::string RecordFiles::told_path(const std::string& path) const {
    if (!has_recording()) return path;
    std::error_code error;
    const auto folder_of = [&](const fs::path& file) {
        return fs::weakly_canonical(fs::absolute(file, error).parent_path(), error);
    };
    const fs::path from = folder_of(recording_.path);
    const fs::path whole = folder_of(path) / fs::path(path).filename();
    const fs::path below = whole.lexically_relative(from);
    const bool is_below = !below.empty() && *below.begin() != "..";
    return (is_below ? below : whole).generic_string();
}

// A journal that was not asked for lies elsewhere: it calls files by their whole paths.
std::vector<cli::ScriptResult> RecordFiles::begin(ToolBench& bench,
                                                  const std::vector<std::string>& open,
                                                  const LoadOptions& options) const {
    std::vector<std::string> told, whole;
    std::error_code error;
    for (const std::string& path : open) {
        told.push_back(told_path(path));
        whole.push_back(fs::absolute(path, error).generic_string());
    }
    std::vector<cli::ScriptResult> results;
    if (has_recording()) results.push_back(bench.record(Transcript::recording, told, options));
    results.push_back(bench.record(Transcript::journal, has_journal() ? open : whole, options));
    return results;
}

std::string RecordFiles::save(ToolBench& bench) {
    const std::string first = save(bench, recording_), second = save(bench, journal_);
    return first.empty() ? second : first;
}

std::string RecordFiles::save(ToolBench& bench, Record& record) {
    if (record.path.empty() || bench.is_held()) return "";
    const std::optional<std::string> text = bench.text_of(record.transcript);
    if (!text || *text == record.saved) return "";
    if (write_whole(record.path, *text)) {
        record.saved = *text;
        fails_ = false;
        return "";
    }
    // It is tried again at the next change.
    if (std::exchange(fails_, true)) return "";
    return "the recording cannot be written to " + record.path;
}

}  // namespace lissom::window
