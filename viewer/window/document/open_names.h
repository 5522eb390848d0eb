/// OpenNames: the words that the document of a session was opened by, and its files. Safe from any
/// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace lissom::window {

/// Returns whether a word of the command line names a script.
bool is_script(const std::string& word);
/// Returns whether it names a script that only repeats a recording.
bool is_recording(const std::string& word);

class OpenNames {
  public:
    /// Asks for another document; returns the number of the request.
    std::uint64_t ask(const std::vector<std::string>& words);
    /// The request was met, or has failed.
    void answer(std::uint64_t number);
    /// Returns whether another document is being opened, which may yet fail.
    bool is_opening() const;
    /// Gives the script of the open document other words of a command line. Returns false if there
    /// is no document.
    bool change_words(const std::vector<std::string>& words);
    /// Makes these words the open document.
    void adopt(const std::vector<std::string>& words);
    /// Returns the words of the open document.
    std::vector<std::string> words() const;
    /// Returns whether failed words are the open document, to be mended and read again.
    bool keeps_failed(const std::vector<std::string>& words, bool is_new) const;

    /// Files that the open document was read from, and those of the tool in hand.
    void set_files(std::vector<std::filesystem::path> files);
    void set_tool_files(std::vector<std::filesystem::path> files);
    std::vector<std::filesystem::path> files() const;
    std::vector<std::filesystem::path> tool_files() const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> words_, asked_words_;
    std::vector<std::filesystem::path> files_, tool_files_;
    // Numbers of the last document asked for, and of the last that was opened or failed.
    std::uint64_t asked_ = 0, answered_ = 0;
};

}  // namespace lissom::window
