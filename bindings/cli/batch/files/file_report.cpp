#include "bindings/cli/batch/files/file_report.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string_view>
#include <utility>

#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

constexpr std::size_t kMaxNameWidth = 60, kOutcomeWidth = 9;
constexpr const char* kFailed = "failed";

std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

// Names of files may hold line ends.
std::string on_one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
    return text;
}

std::string padded(const std::string& text, std::size_t width) {
    const std::size_t length = characters(text);
    return text + std::string(length < width ? width - length : 0, ' ');
}

std::string on_the_right(const std::string& text, int width) {
    const auto wanted = static_cast<std::size_t>(width);
    return std::string(wanted > text.size() ? wanted - text.size() : 0, ' ') + text;
}

Json answer_of(const JobRecord& record) {
    Json answer = Json::parse(record.result, nullptr, false);
    if (!answer.is_object()) answer = Json::object();
    if (record.is_done() || answer.contains("error")) return answer;
    return {{"error", {{"message", record.message}, {"code", record.outcome}}}};
}

// "file", "out", "outcome", and then the fields of the answer.
Json row_of(const BatchJob& job, const Json& answer, const std::string& outcome) {
    Json row = {{"file", display_name(job.inputs.at(0))},
                {"out", display_name(job.output)},
                {"outcome", outcome}};
    for (const auto& [name, value] : answer.items()) {
        if (!row.contains(name)) row[name] = value;
    }
    return row;
}

// The error without the path of the input, which stands beside it.
std::string error_text(const Json& row) {
    const Json& error = row.at("error");
    auto message = error.at("message").get<std::string>();
    const std::string path = row.at("file").get<std::string>() + ":";
    if (message.starts_with(path)) {
        message.erase(0, path.size());
        message = message.starts_with(' ') ? message.substr(1) : "line " + message;
    }
    return error.value("code", std::string("failure")) + ": " + message;
}

std::string notes_of(const Json& row, bool is_kept) {
    std::string notes = row.contains("error") ? error_text(row) : row.value("notes", std::string());
    if (is_kept) notes += notes.empty() ? "done before" : "; done before";
    return notes;
}

}  // namespace

FileColumn number_column(const std::string& name, int width, int digits) {
    return {name, width, [name, digits](const Json& answer) -> std::string {
                if (!answer.contains(name) || !answer.at(name).is_number()) return "-";
                char text[64];
                std::snprintf(text, sizeof text, "%.*f", digits, answer.at(name).get<double>());
                return text;
            }};
}

FileReport::FileReport(Program& program, const BatchPlan& plan, FileReportOptions options)
    : program_(program), plan_(plan), options_(std::move(options)), rows_(plan.jobs.size()) {
    options_.outcomes.emplace_back(kFailed);
    for (const BatchJob& job : plan.jobs) {
        width_ = std::max(width_, characters(display_name(job.inputs.at(0))));
    }
    width_ = std::min(width_, kMaxNameWidth);
}

void FileReport::ended(const BatchJob& job, const JobRecord& record) {
    know(job, record, false);
    if (!program_.json()) write_ready();
}

void FileReport::kept(const BatchJob& job, const JobRecord& record) {
    know(job, record, true);
}

void FileReport::finish(const BatchState& state, const BatchProgress& progress) {
    know_others(state);
    if (program_.json()) return write_json(progress);
    for (; next_ < rows_.size(); ++next_) {
        if (rows_[next_].is_known) write(rows_[next_]);
    }
    write_counts(progress);
}

void FileReport::know(const BatchJob& job, const JobRecord& record, bool is_kept) {
    const Json answer = answer_of(record);
    const std::string outcome =
        answer.contains("error") ? kFailed : answer.value("outcome", options_.outcomes.front());
    ++counts_[outcome];
    rows_.at(job.number - 1) = {true, is_kept, row_of(job, answer, outcome)};
}

// Jobs of a cluster are not heard of one by one.
void FileReport::know_others(const BatchState& state) {
    for (const BatchJob& job : plan_.jobs) {
        if (rows_.at(job.number - 1).is_known) continue;
        const JobRecord* const record = state.record(job);
        if (job.refused) {
            know(job, refused_record(job), false);
        } else if (record && record->is_done()) {
            know(job, *record, false);
        }
    }
}

void FileReport::write_ready() {
    for (; next_ < rows_.size() && rows_[next_].is_known; ++next_) write(rows_[next_]);
}

void FileReport::write(const Row& row) {
    program_.clear_progress();
    if (!std::exchange(has_head_, true)) write_head();
    std::string line = padded(on_one_line(row.json.at("file")), width_) + "  ";
    line += padded(row.json.at("outcome"), kOutcomeWidth);
    for (const FileColumn& column : options_.columns) {
        line += " " + on_the_right(column.text(row.json), column.width);
    }
    line += "  " + notes_of(row.json, row.is_kept);
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << std::endl;
}

void FileReport::write_head() const {
    std::string line = padded("file", width_) + "  " + padded("outcome", kOutcomeWidth);
    for (const FileColumn& column : options_.columns) {
        line += " " + on_the_right(column.name, column.width);
    }
    std::cout << line << "  notes\n";
}

void FileReport::write_counts(const BatchProgress& progress) const {
    std::string line;
    for (const std::string& outcome : options_.outcomes) {
        line += (line.empty() ? "" : ", ") + std::to_string(count(outcome)) + " " + outcome;
    }
    if (progress.kept > 0) line += "; " + std::to_string(progress.kept) + " of them before";
    if (progress.ended() < progress.all) {
        line += "; stopped after " + std::to_string(progress.ended()) + " of " +
                std::to_string(progress.all) + " (the same command goes on)";
    }
    std::cout << line << "; " << display_name(plan_.folder / "index.html") << std::endl;
}

void FileReport::write_json(const BatchProgress& progress) const {
    Json files = Json::array();
    for (const Row& row : rows_) {
        if (!row.is_known) continue;
        files.push_back(row.json);
        files.back()["kept"] = row.is_kept;
    }
    Json json = {{"files", files}};
    for (const std::string& outcome : options_.outcomes) json[outcome] = count(outcome);
    json["kept"] = progress.kept;
    json["stopped"] = progress.ended() < progress.all;
    program_.answer(json_text(json));
}

std::size_t FileReport::count(const std::string& outcome) const {
    const auto found = counts_.find(outcome);
    return found != counts_.end() ? found->second : 0;
}

}  // namespace lissom::cli
