#include "bindings/cli/batch/files/file_plan.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace fs = std::filesystem;
namespace {

fs::path identity_of(const fs::path& path) {
    std::error_code error;
    const fs::path result = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? path.lexically_normal() : result;
}

bool is_below(const fs::path& path, const fs::path& folder) {
    const auto ends = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return ends.first == folder.end() && ends.second != path.end();
}

fs::path without_trailing_slash(const std::string& folder) {
    const fs::path path(folder);
    return path.has_filename() ? path : path.parent_path();
}

// The reason why a pattern finds nothing.
std::string reason_of(const PatternMatches& matches, const ManyFiles& files) {
    if (matches.passed_over == 0) return "no file has such a name";
    return "none of its " + std::to_string(matches.passed_over) + " files is a mesh or hair file" +
           files.kinds_text + ", by its extension";
}

std::string options_text(const std::vector<std::string>& verb) {
    std::string text;
    for (std::size_t i = 1; i < verb.size(); ++i) text += (i > 1 ? " " : "") + verb[i];
    return text;
}

class FilePlanMaker {
  public:
    FilePlanMaker(const ManyFiles& files, BatchPlan& plan)
        : files_(files),
          plan_(plan),
          options_(options_text(plan.verb)),
          out_folder_(identity_of(plan.folder)) {}

    void make() {
        for (const std::string& pattern : files_.in) add_pattern(pattern);
        check_outputs();
    }

  private:
    void add_pattern(const std::string& pattern) {
        const PatternMatches matches = expand_pattern(pattern, files_.kinds);
        const bool skips_outputs = is_below(out_folder_, identity_of(matches.base));
        const std::size_t before = plan_.jobs.size();
        for (const MatchedFile& file : matches.files) {
            const fs::path path = identity_of(file.path);
            if (skips_outputs && is_below(path, out_folder_)) continue;
            if (inputs_.insert(path).second) add(file.path).output = output_of(file);
        }
        for (const fs::path& folder : matches.unreadable_folders) {
            refuse(add(folder), ErrorCode::file_unreadable, "the folder cannot be listed");
        }
        if (matches.files.empty() && plan_.jobs.size() == before) {
            refuse(add(pattern), ErrorCode::file_not_found, reason_of(matches, files_));
        }
    }

    BatchJob& add(const fs::path& input) {
        BatchJob& job = plan_.jobs.emplace_back();
        job.number = plan_.jobs.size();
        job.arguments.emplace_back("file", display_name(input));
        if (!options_.empty()) job.arguments.emplace_back("options", options_);
        job.inputs = {input};
        return job;
    }

    static void refuse(BatchJob& job, ErrorCode code, const std::string& message) {
        job.refused = Error(code, display_name(job.inputs[0]) + ": " + message);
    }

    fs::path output_of(const MatchedFile& file) const {
        fs::path out = plan_.folder / file.relative;
        if (files_.adds_extension) {
            out += "." + files_.extension;
        } else if (!files_.extension.empty()) {
            out.replace_extension(files_.extension);
        }
        return out.lexically_normal();
    }

    // An output that is an input, or that of another input, is an error of its file.
    void check_outputs() {
        std::map<std::string, fs::path> input_of;
        const bool any_case = ignores_case(plan_.folder);
        for (BatchJob& job : plan_.jobs) {
            if (job.refused) continue;
            const fs::path out = identity_of(job.output);
            const std::string name = any_case ? lower_case(out.string()) : out.string();
            const auto [entry, is_new] = input_of.emplace(name, job.inputs[0]);
            if (!is_new) {
                refuse_output(job, "it is already the output of " + display_name(entry->second));
            } else if (!files_.force && inputs_.contains(out)) {
                refuse_output(job, "it is one of the files to read; --force replaces it");
            }
        }
    }

    static void refuse_output(BatchJob& job, const std::string& message) {
        job.refused =
            Error(ErrorCode::file_write_failed, display_name(job.output) + ": " + message);
    }

    const ManyFiles& files_;
    BatchPlan& plan_;
    std::string options_;
    fs::path out_folder_;
    std::set<fs::path> inputs_;
};

char other_case(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return static_cast<char>(std::islower(byte) ? std::toupper(byte) : std::tolower(byte));
}

}  // namespace

BatchPlan plan_files(const ManyFiles& files, std::vector<std::string> verb,
                     const std::string& out_option) {
    BatchPlan plan;
    plan.verb = std::move(verb);
    plan.out_parameter = out_option;
    plan.folder = without_trailing_slash(files.out_folder).lexically_normal();
    FilePlanMaker(files, plan).make();
    refuse_strange_names(plan);
    return plan;
}

std::string lower_case(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

// The nearest folder that exists and has letters in its name tells.
bool ignores_case(const fs::path& folder) {
    std::error_code error;
    for (fs::path path = identity_of(folder); path.has_relative_path(); path = path.parent_path()) {
        std::string name = path.filename().string();
        std::transform(name.begin(), name.end(), name.begin(), other_case);
        if (name == path.filename().string() || !fs::exists(path, error)) continue;
        return fs::equivalent(path, path.parent_path() / name, error) && !error;
    }
    return false;
}

}  // namespace lissom::cli
