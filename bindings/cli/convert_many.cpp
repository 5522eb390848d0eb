#include "bindings/cli/convert_many.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <new>
#include <set>
#include <utility>

#include "bindings/cli/file_patterns.h"
#include "bindings/cli/scene_input.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace fs = std::filesystem;
namespace {

// A file to convert, or why a pattern has none.
struct Job {
    fs::path in, out;
    std::optional<Error> error;
};

fs::path identity_of(const fs::path& path) {
    std::error_code error;
    const fs::path result = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? path.lexically_normal() : result;
}

bool is_below(const fs::path& path, const fs::path& folder) {
    const auto ends = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return ends.first == folder.end() && ends.second != path.end();
}

std::string lower_case(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

bool is_among(const std::vector<std::string>& extensions, const std::string& extension) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

// Kinds of files that can become files with the extension `to`; all without one.
FileKinds kinds_for(const std::string& to) {
    if (to.empty()) return {};
    return {is_among(writable_extensions(), to), is_among(writable_strand_extensions(), to)};
}

// Why a pattern finds nothing.
std::string reason_of(const PatternMatches& matches, const std::string& to) {
    if (matches.passed_over == 0) return "no file has such a name";
    const std::string kinds = to.empty() ? "" : " that can become ." + to;
    return "none of its " + std::to_string(matches.passed_over) + " files is a mesh or hair file" +
           kinds + ", by its extension";
}

// The conversions to be done, in order.
class JobList {
  public:
    JobList(const ManyFiles& files, bool force) : files_(files), force_(force) {
        out_folder_ = identity_of(without_trailing_slash(files.out_folder));
        for (const std::string& pattern : files.in) add_pattern(pattern);
        check_outputs();
    }

    const std::vector<Job>& jobs() const { return jobs_; }

  private:
    static fs::path without_trailing_slash(const std::string& folder) {
        const fs::path path(folder);
        return path.has_filename() ? path : path.parent_path();
    }

    void add_pattern(const std::string& pattern) {
        const PatternMatches matches = expand_pattern(pattern, kinds_for(files_.to));
        const bool skips_outputs = is_below(out_folder_, identity_of(matches.base));
        const std::size_t before = jobs_.size();
        for (const MatchedFile& file : matches.files) {
            const fs::path path = identity_of(file.path);
            if (skips_outputs && is_below(path, out_folder_)) continue;
            if (inputs_.insert(path).second) jobs_.push_back({file.path, out_of(file), {}});
        }
        for (const fs::path& folder : matches.unreadable_folders) {
            add_failure(folder, ErrorCode::file_unreadable, "the folder cannot be listed");
        }
        if (matches.files.empty() && jobs_.size() == before) {
            add_failure(pattern, ErrorCode::file_not_found, reason_of(matches, files_.to));
        }
    }

    void add_failure(const fs::path& in, ErrorCode code, const std::string& message) {
        jobs_.push_back({in, {}, Error(code, display_name(in) + ": " + message)});
    }

    fs::path out_of(const MatchedFile& file) const {
        fs::path out = fs::path(files_.out_folder) / file.relative;
        if (!files_.to.empty()) out.replace_extension(files_.to);
        return out;
    }

    // An output that is an input, or that of another input, is an error of its file.
    void check_outputs() {
        std::map<fs::path, fs::path> input_of;
        for (Job& job : jobs_) {
            if (job.error) continue;
            const fs::path out = identity_of(job.out);
            const auto [entry, is_new] = input_of.emplace(out, job.in);
            if (!is_new) {
                job.error = Error(ErrorCode::file_write_failed,
                                  display_name(job.out) + ": it is already the output of " +
                                      display_name(entry->second));
            } else if (!force_ && inputs_.contains(out)) {
                job.error = Error(ErrorCode::file_write_failed,
                                  display_name(job.out) +
                                      ": it is one of the files to read; --force replaces it");
            }
        }
    }

    const ManyFiles& files_;
    bool force_;
    fs::path out_folder_;
    std::set<fs::path> inputs_;
    std::vector<Job> jobs_;
};

// Outputs whose names differ in the case of letters only are one file on some machines.
class WrittenFiles {
  public:
    // Throws if writing `out` would replace another output.
    void require_new(const fs::path& out) const {
        const auto found = by_lower_case_.find(lower_case(out.string()));
        if (found == by_lower_case_.end() || !is_same_file(found->second, out)) return;
        throw Error(ErrorCode::file_write_failed,
                    display_name(out) + ": it is already the output of another file");
    }
    void add(const fs::path& out) { by_lower_case_.emplace(lower_case(out.string()), out); }

  private:
    std::map<std::string, fs::path> by_lower_case_;
};

// Columns as wide as their widest entry, but the last one.
class Table {
  public:
    explicit Table(const std::vector<Job>& jobs) {
        for (const Job& job : jobs) width_ = std::max(width_, characters(display_name(job.in)));
        width_ = std::min<std::size_t>(width_, 60);
        std::cout << padded("file") << "  outcome    vertices     faces  seconds  notes\n";
    }

    void add(const Conversion& conversion) const {
        char numbers[64] = "        -         -        -";
        if (conversion.is_hair) {
            std::snprintf(numbers, sizeof numbers, "%9d         - %8.2f", conversion.points,
                          conversion.seconds);
        } else if (!conversion.error) {
            std::snprintf(numbers, sizeof numbers, "%9d %9d %8.2f", conversion.vertices,
                          conversion.faces, conversion.seconds);
        }
        char outcome[16];
        std::snprintf(outcome, sizeof outcome, "%-9s", conversion.outcome());
        std::string row = padded(display_name(conversion.in)) + "  " + outcome + " " + numbers +
                          "  " + conversion_notes(conversion);
        row.erase(row.find_last_not_of(' ') + 1);
        std::cout << row << std::endl;
    }

  private:
    static std::size_t characters(std::string_view text) {
        return std::count_if(text.begin(), text.end(),
                             [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
    }

    std::string padded(const std::string& text) const {
        const std::size_t length = characters(text);
        return text + std::string(length < width_ ? width_ - length : 0, ' ');
    }

    std::size_t width_ = 4;
};

Conversion run(Program& program, const Job& job, const ConversionOptions& options,
               WrittenFiles& written) {
    Conversion failed;
    failed.in = job.in;
    failed.out = job.out;
    try {
        if (job.error) throw Error(*job.error);
        written.require_new(job.out);
        Conversion done = convert_file(program, job.in, job.out, options);
        written.add(job.out);
        return done;
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) throw;
        failed.error = error;
    } catch (const std::bad_alloc&) {
        failed.error = Error(ErrorCode::memory_limit, "there is not enough memory");
    }
    return failed;
}

// How many files came to each outcome.
struct Counts {
    std::map<std::string, int> of_outcome{{"converted", 0}, {"repaired", 0}, {"failed", 0}};
    std::size_t done = 0, all = 0;

    void add(const Conversion& conversion) {
        ++of_outcome[conversion.outcome()];
        ++done;
    }
    int operator[](const char* outcome) const { return of_outcome.at(outcome); }
    bool stopped() const { return done < all; }
};

void print_json(const Json& rows, const Counts& counts) {
    std::cout << json_text({{"files", rows},
                            {"converted", counts["converted"]},
                            {"repaired", counts["repaired"]},
                            {"failed", counts["failed"]},
                            {"stopped", counts.stopped()}})
              << std::endl;
}

void print_summary(const Counts& counts) {
    std::cout << counts["converted"] << " converted, " << counts["repaired"] << " repaired, "
              << counts["failed"] << " failed";
    if (counts.stopped()) std::cout << "; stopped after " << counts.done << " of " << counts.all;
    std::cout << std::endl;
}

}  // namespace

int convert_many(Program& program, const ManyFiles& files, const ConversionOptions& options) {
    const JobList list(files, options.force);
    Counts counts;
    counts.all = list.jobs().size();
    Json rows = Json::array();
    std::optional<Table> table;
    if (!program.json()) table.emplace(list.jobs());
    WrittenFiles written;
    try {
        for (const Job& job : list.jobs()) {
            program.context().checkpoint();
            const Conversion conversion = run(program, job, options, written);
            program.clear_progress();
            counts.add(conversion);
            if (table) {
                table->add(conversion);
            } else {
                rows.push_back(conversion_json(conversion));
            }
        }
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled) throw;
        program.clear_progress();
    }
    if (table) {
        print_summary(counts);
    } else {
        print_json(rows, counts);
    }
    return counts["failed"] > 0 || counts.stopped() ? kFailure : kSuccess;
}

}  // namespace lissom::cli
