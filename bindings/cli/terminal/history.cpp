#include "bindings/cli/terminal/history.h"

#include <fstream>
#include <system_error>
#include <utility>

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

void keep_last(std::vector<std::string>& lines) {
    if (lines.size() <= History::kMaxLines) return;
    lines.erase(lines.begin(), lines.end() - History::kMaxLines);
}

}  // namespace

History::History(fs::path file) : file_(std::move(file)) {
    if (file_.empty()) return;
    std::error_code error;
    fs::create_directories(file_.parent_path(), error);
    lines_ = lines_of(file_);
    keep_last(lines_);
}

bool History::add(const std::string& line) {
    if (line.empty() || (!lines_.empty() && lines_.back() == line)) return false;
    lines_.push_back(line);
    keep_last(lines_);
    if (!file_.empty()) std::ofstream(file_, std::ios::app) << line << '\n';
    return true;
}

void History::shorten_file() const {
    if (file_.empty()) return;
    std::vector<std::string> lines = lines_of(file_);
    if (lines.size() <= kMaxLines) return;
    keep_last(lines);
    std::ofstream out(file_);
    for (const std::string& line : lines) out << line << '\n';
}

}  // namespace lissom::cli
