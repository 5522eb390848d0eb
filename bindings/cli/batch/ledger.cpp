#include "bindings/cli/batch/ledger.h"

#include <algorithm>
#include <fstream>

#include "bindings/cli/json.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

Json stamps_json(const std::vector<FileStamp>& stamps) {
    Json list = Json::array();
    for (const FileStamp& stamp : stamps) {
        list.push_back({stamp.path, stamp.size, stamp.time, stamp.inode, stamp.digest});
    }
    return list;
}

std::vector<FileStamp> stamps_of(const Json& list) {
    std::vector<FileStamp> stamps;
    for (const Json& entry : list) {
        stamps.push_back({entry.at(0), entry.at(1), entry.at(2), entry.at(3), entry.at(4)});
    }
    return stamps;
}

}  // namespace

std::string record_line(const JobRecord& record) {
    Json arguments = Json::array();
    for (const auto& [name, value] : record.arguments) arguments.push_back({name, value});
    return json_text({{"output", record.output},
                      {"arguments", arguments},
                      {"outcome", record.outcome},
                      {"status", record.status},
                      {"message", record.message},
                      {"result", record.result},
                      {"log", record.log},
                      {"attempts", record.attempts},
                      {"warnings", record.warnings},
                      {"seconds", record.seconds},
                      {"cpu_seconds", record.cpu_seconds},
                      {"memory", record.memory},
                      {"time", record.time},
                      {"program", record.program},
                      {"reads", stamps_json(record.reads)},
                      {"outputs", stamps_json(record.outputs)}},
                     -1);
}

JobRecord read_record(const std::string& line) {
    const Json json = Json::parse(line);
    JobRecord record;
    record.output = json.at("output");
    for (const Json& argument : json.at("arguments")) {
        record.arguments.emplace_back(argument.at(0), argument.at(1));
    }
    record.outcome = json.at("outcome");
    record.status = json.at("status");
    record.message = json.at("message");
    record.result = json.value("result", std::string());
    record.log = json.at("log");
    record.attempts = json.at("attempts");
    record.warnings = json.at("warnings");
    record.seconds = json.at("seconds");
    record.cpu_seconds = json.at("cpu_seconds");
    record.memory = json.at("memory");
    record.time = json.at("time");
    record.program = json.at("program");
    record.reads = stamps_of(json.at("reads"));
    record.outputs = stamps_of(json.at("outputs"));
    return record;
}

Ledger::Ledger(const fs::path& folder)
    : folder_(folder), file_(folder / (process_name() + ".jsonl")) {
    refresh();
}

void Ledger::refresh() {
    std::vector<fs::path> files;
    std::error_code missing;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, missing)) {
        if (entry.path().extension() == ".jsonl") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) read(file);
}

void Ledger::read(const fs::path& file) {
    std::streamoff& begin = read_[file];
    if (static_cast<std::streamoff>(file_identity(file).size) == begin) return;
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(begin);
    // A last line without an end is being written, or was when its process was killed.
    for (std::string line; std::getline(stream, line) && !stream.eof();) {
        begin += static_cast<std::streamoff>(line.size()) + 1;
        try {
            JobRecord record = read_record(line);
            JobRecord& known = records_[record.output];
            if (record.time >= known.time) known = std::move(record);
        } catch (const nlohmann::json::exception&) {
            // A process was killed while it wrote this line: its job runs again.
        }
    }
}

const JobRecord* Ledger::find(const std::string& output) const {
    const auto found = records_.find(output);
    return found != records_.end() ? &found->second : nullptr;
}

void Ledger::add(const std::vector<JobRecord>& records) {
    std::string lines;
    for (const JobRecord& record : records) lines += record_line(record) + "\n";
    file_.append(lines);
    for (const JobRecord& record : records) records_[record.output] = record;
}

}  // namespace lissom::cli
