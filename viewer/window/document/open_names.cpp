#include "viewer/window/document/open_names.h"

#include <optional>
#include <utility>

#include "bindings/cli/script_text.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;

}  // namespace

bool is_script(const std::string& word) {
    return fs::path(word).extension() == ".lua";
}

bool is_recording(const std::string& word) {
    if (!is_script(word)) return false;
    const std::optional<std::string> text = cli::script_text(word);
    return text && cli::is_recording(*text);
}

std::uint64_t OpenNames::ask(const std::vector<std::string>& words) {
    const std::lock_guard lock(mutex_);
    asked_words_ = words;
    return ++asked_;
}

void OpenNames::answer(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    answered_ = number;
}

bool OpenNames::is_opening() const {
    const std::lock_guard lock(mutex_);
    return answered_ != asked_ && !words_.empty() && asked_words_ != words_;
}

bool OpenNames::change_words(const std::vector<std::string>& words) {
    const std::lock_guard lock(mutex_);
    if (words_.empty()) return false;
    if (is_script(words_.front())) {
        words_.resize(1);
        words_.insert(words_.end(), words.begin(), words.end());
    }
    answered_ = asked_;
    return true;
}

void OpenNames::adopt(const std::vector<std::string>& words) {
    const std::lock_guard lock(mutex_);
    words_ = words;
}

std::vector<std::string> OpenNames::words() const {
    const std::lock_guard lock(mutex_);
    return words_;
}

bool OpenNames::keeps_failed(const std::vector<std::string>& words, bool is_new) const {
    const std::lock_guard lock(mutex_);
    const bool is_same_script = is_script(words.front()) && words_.front() == words.front();
    return !is_new || is_same_script || words_ == words;
}

void OpenNames::set_files(std::vector<fs::path> files) {
    const std::lock_guard lock(mutex_);
    files_ = std::move(files);
}

void OpenNames::set_tool_files(std::vector<fs::path> files) {
    const std::lock_guard lock(mutex_);
    tool_files_ = std::move(files);
}

std::vector<fs::path> OpenNames::files() const {
    const std::lock_guard lock(mutex_);
    return files_;
}

std::vector<fs::path> OpenNames::tool_files() const {
    const std::lock_guard lock(mutex_);
    return tool_files_;
}

}  // namespace lissom::window
