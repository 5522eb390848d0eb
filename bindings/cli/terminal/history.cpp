#include "bindings/cli/terminal/history.h"

#include <fstream>
#include <system_error>
#include <utility>

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLines = 1000;

std::vector<std::string> lines_of(const fs::path& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

void keep_last(std::vector<std::string>& lines) {
    if (lines.size() <= kMostLines) return;
    lines.erase(lines.begin(), lines.end() - kMostLines);
}

}  // namespace

History::History(fs::path file) : file_(std::move(file)) {
    if (file_.empty()) return;
    std::error_code error;
    fs::create_directories(file_.parent_path(), error);
    lines_ = lines_of(file_);
    keep_last(lines_);
}

void History::add(const std::string& line) {
    if (line.empty() || (!lines_.empty() && lines_.back() == line)) return;
    lines_.push_back(line);
    keep_last(lines_);
    if (!file_.empty()) std::ofstream(file_, std::ios::app) << line << '\n';
}

std::optional<std::size_t> History::find(const std::string& text, std::size_t end) const {
    for (std::size_t i = end; i-- > 0;) {
        if (lines_[i].find(text) != std::string::npos) return i;
    }
    return std::nullopt;
}

void History::shorten_file() const {
    if (file_.empty()) return;
    std::vector<std::string> lines = lines_of(file_);
    if (lines.size() <= kMostLines) return;
    keep_last(lines);
    std::ofstream out(file_);
    for (const std::string& line : lines) out << line << '\n';
}

}  // namespace lissom::cli
