#include "bindings/cli/batch/summary.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/cli/batch/plan/axis.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPictures[] = {".png", ".jpg", ".jpeg", ".webp", ".svg", ".gif"};

bool is_picture(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(std::begin(kPictures), std::end(kPictures), extension) != std::end(kPictures);
}

// The fields of one value in the answer of a verb, but for those that the job has itself.
Json result_json(const JobRecord& record) {
    Json fields = Json::object();
    const Json answer = Json::parse(record.result, nullptr, false);
    if (!answer.is_object()) return fields;
    for (const auto& [name, value] : answer.items()) {
        const bool is_own = name == "file" || name == "out" || name == "seconds";
        if (value.is_primitive() && !is_own) fields[name] = value;
    }
    return fields;
}

std::string below(const fs::path& folder, const fs::path& file) {
    return file.lexically_relative(folder).generic_string();
}

Json job_json(const BatchPlan& plan, const BatchJob& job, const JobRecord* record) {
    Json arguments = Json::object();
    for (const auto& [name, value] : job.arguments) arguments[name] = value;
    Json json = {{"number", job.number},
                 {"output", below(plan.folder, job.output)},
                 {"outcome", record ? record->outcome : "waiting"},
                 {"arguments", arguments}};
    const JobRecord none;
    const JobRecord& known = record ? *record : none;
    json["status"] = known.status;
    json["attempts"] = record ? known.attempts : 0;
    json["seconds"] = known.seconds;
    json["cpu_seconds"] = known.cpu_seconds;
    json["memory_mib"] = static_cast<double>(known.memory) / (1 << 20);
    json["warnings"] = known.warnings;
    json["message"] = known.message;
    json["log"] = known.log;
    json["result"] = result_json(known);
    json["files"] = Json::array();
    json["pictures"] = Json::array();
    for (const FileStamp& stamp : known.outputs) {
        json["files"].push_back(below(plan.folder, stamp.path));
        if (is_picture(stamp.path)) json["pictures"].push_back(below(plan.folder, stamp.path));
    }
    return json;
}

std::string table_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string value = "\"";
    for (const char c : text) value += c == '"' ? std::string("\"\"") : std::string(1, c);
    return value + "\"";
}

std::string cell(const Json& value) {
    if (value.is_null()) return "";
    return value.is_string() ? table_text(value.get<std::string>()) : value.dump();
}

// Names of the fields of a member of all jobs, in the order in which they come.
std::vector<std::string> field_names(const Json& summary, const char* member) {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (const Json& job : summary.at("jobs")) {
        for (const auto& [name, value] : job.at(member).items()) {
            if (known.insert(name).second) names.push_back(name);
        }
    }
    return names;
}

std::string job_counts_text(const Json& summary) {
    std::string text = std::to_string(summary.at("jobs").size()) + " jobs";
    for (const char* outcome : {"done", "failed", "waiting"}) {
        const std::size_t count = summary.at(outcome);
        if (count > 0) text += ", " + std::to_string(count) + " " + outcome;
    }
    return text;
}

// A text within a script element must not end it.
std::string embedded(const Json& value) {
    std::string text = json_text(value, -1);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) {
        text.replace(at, 1, "\\u003c");
    }
    return text;
}

}  // namespace

Json summary_json(const BatchPlan& plan, const BatchState& state) {
    Json jobs = Json::array();
    std::size_t done = 0, waiting = 0;
    for (const BatchJob& job : plan.jobs) {
        const JobRecord refused = job.refused ? refused_record(job) : JobRecord();
        const JobRecord* const record = job.refused ? &refused : state.record(job);
        done += record && record->is_done();
        waiting += !record;
        jobs.push_back(job_json(plan, job, record));
    }
    return {{"script", plan.name()}, {"folder", plan.folder.generic_string()},
            {"done", done},          {"failed", plan.jobs.size() - done - waiting},
            {"waiting", waiting},    {"jobs", jobs}};
}

std::string summary_table(const Json& summary) {
    constexpr const char* kColumns[] = {"outcome",     "status",     "attempts", "seconds",
                                        "cpu_seconds", "memory_mib", "warnings", "message",
                                        "log",         "output"};
    const std::vector<std::string> parameters = field_names(summary, "arguments");
    const std::vector<std::string> results = field_names(summary, "result");
    std::string text = "number";
    for (const std::string& name : parameters) text += "," + table_text(name);
    for (const char* name : kColumns) text += std::string(",") + name;
    for (const std::string& name : results) text += ",result." + table_text(name);
    text += "\n";
    for (const Json& job : summary.at("jobs")) {
        text += cell(job.at("number"));
        for (const std::string& name : parameters) {
            text += "," + cell(job.at("arguments").value(name, Json()));
        }
        for (const char* name : kColumns) text += "," + cell(job.at(name));
        for (const std::string& name : results) {
            text += "," + cell(job.at("result").value(name, Json()));
        }
        text += "\n";
    }
    return text;
}

std::string summary_page(const Json& summary) {
    const Json data = {{"title", fs::path(summary.at("script").get<std::string>()).filename()},
                       {"counts", job_counts_text(summary)},
                       {"parameters", field_names(summary, "arguments")},
                       {"results", field_names(summary, "result")},
                       {"jobs", summary.at("jobs")}};
    std::string text = page_template();
    const std::string_view mark = "@DATA@";
    return text.replace(text.find(mark), mark.size(), embedded(data));
}

void require_own_summary(const BatchPlan& plan) {
    constexpr std::pair<const char*, std::string_view> kBegins[] = {
        {"summary.json", "{\n  \"script\": "},
        {"summary.csv", "number,"},
        {"index.html",
         "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "}};
    std::error_code error;
    if (fs::exists(plan.folder / kBatchFolder / "results", error)) return;
    for (const auto& [name, begin] : kBegins) {
        std::ifstream stream(plan.folder / name, std::ios::binary);
        std::string bytes(begin.size(), '\0');
        if (!stream || (stream.read(bytes.data(), std::ssize(bytes)) && bytes == begin)) continue;
        throw Error(ErrorCode::file_write_failed,
                    display_name(plan.folder / name) +
                        " is not from a batch and would be replaced: move it, or choose another "
                        "folder for --out");
    }
}

void write_summary(const BatchPlan& plan, const BatchState& state) {
    const Json summary = summary_json(plan, state);
    write_file_atomically(plan.folder / "summary.json", json_text(summary) + "\n");
    write_file_atomically(plan.folder / "summary.csv", summary_table(summary));
    write_file_atomically(plan.folder / "index.html", summary_page(summary));
}

}  // namespace lissom::cli
