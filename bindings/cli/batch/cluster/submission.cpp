#include "bindings/cli/batch/cluster/submission.h"

#include <algorithm>
#include <cmath>

#include "bindings/cli/json.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kUnknownSeconds = 5.0;

Json job_json(const BatchJob& job) {
    Json arguments = Json::array(), inputs = Json::array();
    for (const auto& [name, value] : job.arguments) arguments.push_back({name, value});
    for (const fs::path& input : job.inputs) inputs.push_back(input.string());
    return {{"number", job.number},
            {"arguments", arguments},
            {"inputs", inputs},
            {"output", job.output.string()}};
}

BatchJob read_job(const Json& json) {
    BatchJob job;
    job.number = json.at("number");
    for (const Json& argument : json.at("arguments")) {
        job.arguments.emplace_back(argument.at(0), argument.at(1));
    }
    for (const Json& input : json.at("inputs")) job.inputs.emplace_back(input.get<std::string>());
    job.output = json.at("output").get<std::string>();
    return job;
}

Submission read_json(const Json& json) {
    Submission submission;
    submission.plan.script = json.at("script");
    submission.plan.verb = json.at("verb").get<std::vector<std::string>>();
    submission.plan.out_parameter = json.at("out_parameter");
    submission.plan.makes_folders = json.at("makes_folders");
    submission.plan.folder = json.at("folder").get<std::string>();
    for (const Json& job : json.at("jobs")) submission.plan.jobs.push_back(read_job(job));
    submission.options.jobs = json.at("at_a_time");
    submission.options.threads = json.at("threads");
    submission.options.retries = json.at("retries");
    submission.options.timeout = json.at("timeout");
    submission.options.packs = json.at("packs");
    submission.directory = json.at("directory").get<std::string>();
    submission.time = json.at("time");
    submission.tasks = json.at("tasks").get<std::vector<std::vector<std::size_t>>>();
    return submission;
}

}  // namespace

std::vector<std::vector<std::size_t>> divide(const std::vector<std::size_t>& jobs, double seconds,
                                             int at_a_time, std::size_t most) {
    const double each = seconds > 0.0 ? seconds : kUnknownSeconds;
    const double wanted = std::ceil(at_a_time * kTaskSeconds / each);
    const std::size_t least = (jobs.size() + most - 1) / std::max<std::size_t>(most, 1);
    const auto size = std::max<std::size_t>(
        {1, least, static_cast<std::size_t>(std::min(wanted, static_cast<double>(jobs.size())))});
    std::vector<std::vector<std::size_t>> tasks;
    for (std::size_t i = 0; i < jobs.size(); i += size) {
        const std::size_t end = std::min(i + size, jobs.size());
        tasks.emplace_back(jobs.begin() + static_cast<std::ptrdiff_t>(i),
                           jobs.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return tasks;
}

void write_submission(const Submission& submission, const fs::path& file) {
    Json jobs = Json::array();
    for (const BatchJob& job : submission.plan.jobs) jobs.push_back(job_json(job));
    const Json json = {{"script", submission.plan.script},
                       {"verb", submission.plan.verb},
                       {"out_parameter", submission.plan.out_parameter},
                       {"makes_folders", submission.plan.makes_folders},
                       {"folder", submission.plan.folder.string()},
                       {"directory", submission.directory.string()},
                       {"at_a_time", submission.options.jobs},
                       {"threads", submission.options.threads},
                       {"retries", submission.options.retries},
                       {"timeout", submission.options.timeout},
                       {"packs", submission.options.packs},
                       {"time", submission.time},
                       {"tasks", submission.tasks},
                       {"jobs", jobs}};
    write_file_atomically(file, json_text(json, -1) + "\n");
}

Submission read_submission(const fs::path& file) {
    const FileContent content = read_file(file);
    try {
        return read_json(Json::parse(content.bytes));
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorCode::file_syntax, display_name(file) + ": " + error.what());
    }
}

}  // namespace lissom::cli
