#include "bindings/cli/batch/job_process.h"

#include <iostream>
#include <lua.hpp>
#include <set>
#include <thread>

#include "bindings/cli/json.h"
#include "bindings/cli/process/child_process.h"
#include "bindings/cli/script.h"
#include "bindings/cli/terminal/script_place.h"

namespace lissom::cli {
namespace {

JobTask read_task(const Json& json) {
    JobTask task;
    task.script = json.at("script");
    for (const Json& word : json.at("words")) task.words.push_back(word);
    task.log = json.at("log");
    return task;
}

// "file:line: " of the line of the script that runs.
std::string place_in(const Script& script) {
    push_script_place(script.lua(), 0);
    std::string place = lua_tostring(script.lua(), -1);
    lua_pop(script.lua(), 1);
    return place;
}

void run_script_task(Program& program, const JobTask& task, JobNews& news) {
    std::set<std::string> reads = {task.script};
    program.file_used = [&reads](const std::filesystem::path& file, lua::FileUse use) {
        if (use == lua::FileUse::read) reads.insert(file.string());
    };
    Script script(program, {task.script, task.words});
    const auto counts = program.log_filter;
    const auto thread = std::this_thread::get_id();
    program.log_filter = [&](LogLevel level, std::string_view message) {
        counts(level, message);
        if (level != LogLevel::warning || std::this_thread::get_id() != thread) return true;
        std::cerr << "warning: " << place_in(script) << message << std::endl;
        return false;
    };
    const ScriptResult result = script.run_file(task.script);
    program.log_filter = counts;
    for (std::string& file : script.module_files()) reads.insert(std::move(file));
    news.reads.assign(reads.begin(), reads.end());
    news.status = result.status;
    news.message = result.message;
}

// The message of an answer that is an error.
std::string error_message(const Json& answer) {
    if (!answer.is_object() || !answer.contains("error")) return {};
    return answer.at("error").value("message", std::string());
}

void run_verb_task(Program& program, const JobTask& task, JobNews& news) {
    program.answer_listener = [&news](const std::string& json) {
        const Json answer = Json::parse(json);
        news.result = json_text(answer, -1);
        news.message = error_message(answer);
    };
    news.status = run_verb(program, task.words);
    program.answer_listener = nullptr;
}

JobNews run_task_alone(Program& program, const JobTask& task) {
    JobNews news;
    program.log_filter = [&news](LogLevel level, std::string_view) {
        news.warnings += level == LogLevel::warning;
        return true;
    };
    (task.script.empty() ? run_verb_task : run_script_task)(program, task, news);
    if (!news.message.empty()) std::cerr << news.message << std::endl;
    return news;
}

}  // namespace

std::string tasks_line(const std::vector<JobTask>& tasks) {
    Json list = Json::array();
    for (const JobTask& task : tasks) {
        list.push_back({{"script", task.script}, {"words", task.words}, {"log", task.log}});
    }
    return json_text(list, -1);
}

std::string news_line(const JobNews& news) {
    return json_text({{"status", news.status},
                      {"cpu_seconds", news.cpu_seconds},
                      {"memory", news.memory},
                      {"reads", news.reads},
                      {"warnings", news.warnings},
                      {"message", news.message},
                      {"result", news.result}},
                     -1);
}

JobNews read_news(const std::string& line) {
    const Json json = Json::parse(line);
    JobNews news;
    news.status = json.at("status");
    news.cpu_seconds = json.at("cpu_seconds");
    news.memory = json.at("memory");
    for (const Json& file : json.at("reads")) news.reads.push_back(file);
    news.warnings = json.at("warnings");
    news.message = json.at("message");
    news.result = json.at("result");
    return news;
}

int run_jobs(Program& program, const std::string& line) {
    const ParentProcess parent;
    int status = kSuccess;
    ProcessUse before;
    for (const Json& json : Json::parse(line)) {
        const JobTask task = read_task(json);
        redirect_outputs(task.log);
        JobNews news = run_task_alone(program, task);
        status = news.status;
        const ProcessUse now = process_use();
        news.cpu_seconds = now.cpu_seconds - before.cpu_seconds;
        news.memory = now.memory;
        before = now;
        parent.tell(news_line(news));
        if (program.interrupted()) break;
    }
    return status;
}

}  // namespace lissom::cli
