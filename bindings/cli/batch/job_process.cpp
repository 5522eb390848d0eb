#include "bindings/cli/batch/job_process.h"

#include <iostream>
#include <set>

#include "bindings/cli/json.h"
#include "bindings/cli/process/child_process.h"
#include "bindings/cli/script.h"

namespace lissom::cli {
namespace {

JobTask read_task(const std::string& line) {
    const Json json = Json::parse(line);
    JobTask task;
    task.script = json.at("script");
    for (const Json& word : json.at("words")) task.words.push_back(word);
    return task;
}

}  // namespace

std::string task_line(const JobTask& task) {
    return json_text({{"script", task.script}, {"words", task.words}}, -1);
}

std::string news_line(const JobNews& news) {
    return json_text(
        {{"reads", news.reads}, {"warnings", news.warnings}, {"message", news.message}}, -1);
}

JobNews read_news(const std::string& line) {
    const Json json = Json::parse(line);
    JobNews news;
    for (const Json& file : json.at("reads")) news.reads.push_back(file);
    news.warnings = json.at("warnings");
    news.message = json.at("message");
    return news;
}

int run_job(Program& program, const std::string& line) {
    const ParentProcess parent;
    const JobTask task = read_task(line);
    std::set<std::string> reads = {task.script};
    JobNews news;
    program.file_used = [&reads](const std::filesystem::path& file, lua::FileUse use) {
        if (use == lua::FileUse::read) reads.insert(file.string());
    };
    program.log_filter = [&news](LogLevel level, std::string_view) {
        news.warnings += level == LogLevel::warning;
        return true;
    };
    Script script(program, {task.script, task.words});
    const ScriptResult result = script.run_file(task.script);
    for (std::string& file : script.module_files()) reads.insert(std::move(file));
    news.reads.assign(reads.begin(), reads.end());
    news.message = result.message;
    if (!result.message.empty()) std::cerr << result.message << std::endl;
    parent.tell(news_line(news));
    return result.status;
}

}  // namespace lissom::cli
