#include "bindings/cli/batch/run/stray_words.h"

#include <algorithm>
#include <filesystem>

#include "kernel/core/nearest.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

bool is_option(const std::string& word) {
    return word.starts_with('-') && word.size() > 1;
}

// The pattern that the shell probably had: 'props/*.obj' for props/chair.obj.
std::string pattern_of(const std::string& word) {
    if (word.find_first_of("*?") != std::string::npos) return word;
    const fs::path file(word);
    return (file.parent_path() / ("*" + file.extension().string())).string();
}

// "there is no option --out2, did you mean '--out'?", without the question if none is near.
std::string option_error(const std::string& flag, const std::vector<std::string_view>& options) {
    const std::string_view nearest = nearest_name(flag, options);
    return "there is no option " + flag +
           (nearest.empty() ? "" : ", did you mean '" + std::string(nearest) + "'?");
}

std::string batch_option_error(const std::string& flag,
                               const std::vector<std::string_view>& options) {
    const std::string error = option_error(flag, options);
    if (error.ends_with('?')) return error;
    const std::string name = flag.substr(flag.find_first_not_of('-'));
    for (const char* files : {"in", "i", "input", "files"}) {
        if (name == files) return error + ": files are given by --over";
    }
    return error + ": a parameter of the script is given by --set " + name +
           "=VALUE, or by --sweep " + name + "=VALUES";
}

std::string batch_file_error(const std::string& word, bool gives_files) {
    const std::string pattern = "--over '" + pattern_of(word) + "'";
    if (!gives_files) return "'" + word + "' belongs to no option: files are given by " + pattern;
    return "'" + word +
           "' belongs to no option: quotes keep the shell from replacing a pattern by files, as " +
           pattern;
}

// The name of the first option among the words, or "".
std::string flag_among(const std::vector<std::string>& words) {
    const auto option = std::find_if(words.begin(), words.end(), is_option);
    return option == words.end() ? std::string() : option->substr(0, option->find('='));
}

}  // namespace

std::string stray_words_error(const std::vector<std::string>& words,
                              const std::vector<std::string_view>& options, bool gives_files) {
    const std::string flag = flag_among(words);
    return flag.empty() ? batch_file_error(words.front(), gives_files)
                        : batch_option_error(flag, options);
}

std::string stray_files_error(const std::vector<std::string>& words,
                              const std::vector<std::string_view>& options) {
    const std::string flag = flag_among(words);
    if (!flag.empty()) return option_error(flag, options);
    return "'" + words.front() + "' is one file too many: several are given by --in, as --in '" +
           pattern_of(words.front()) + "' --out FOLDER";
}

}  // namespace lissom::cli
