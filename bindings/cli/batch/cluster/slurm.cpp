#include "bindings/cli/batch/cluster/slurm.h"

#include <algorithm>
#include <charconv>

#include "bindings/cli/batch/digest.h"
#include "bindings/cli/batch/durable_files.h"
#include "bindings/cli/process/child_process.h"
#include "bindings/cli/process/command.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// A word for sh.
std::string shell_word(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string trimmed(std::string text) {
    text.erase(text.find_last_not_of(" \t\r\n") + 1);
    return text.erase(0, text.find_first_not_of(" \t\r\n"));
}

// Calls sbatch and returns the id of the job.
std::string submitted(const std::vector<std::string>& words) {
    const std::optional<CommandEnd> end = run_command(words);
    if (!end) {
        throw Error(ErrorCode::file_not_found,
                    "sbatch is not installed here; --export FILE writes a script for it, and "
                    "without --slurm the jobs run on this machine");
    }
    // "ID" or "ID;CLUSTER".
    std::string id = trimmed(end->output);
    id = id.substr(0, id.find(';'));
    const bool is_id = !id.empty() && id.find_first_not_of("0123456789") == std::string::npos;
    if (end->status == 0 && is_id) return id;
    throw Error(ErrorCode::invalid_argument, "sbatch refused: " + trimmed(end->errors) +
                                                 "; words after -- go to it as they are");
}

std::string program_line(const std::string& words) {
    return "exec " + shell_word(program_file().string()) + " batch " + words + "\n";
}

}  // namespace

std::size_t max_tasks() {
    constexpr std::size_t kUsual = 1000;
    const std::optional<CommandEnd> end = run_command({"scontrol", "show", "config"});
    if (!end || end->status != 0) return kUsual;
    const std::size_t at = end->output.find("MaxArraySize");
    const std::size_t digits = end->output.find_first_of("0123456789", at);
    std::size_t size = 0;
    if (at == std::string::npos || digits == std::string::npos) return kUsual;
    std::from_chars(end->output.data() + digits, end->output.data() + end->output.size(), size);
    // The greatest index is one below; arrays here begin with 0.
    return std::max<std::size_t>(size, 1);
}

std::string task_script(const fs::path& file) {
    return "#!/bin/sh\n" + program_line("--task \"$SLURM_ARRAY_TASK_ID\" --submission " +
                                        shell_word(fs::absolute(file).string()));
}

std::vector<std::string> sbatch_words(const Submission& submission, const std::string& name,
                                      const fs::path& logs, const fs::path& script,
                                      const std::vector<std::string>& more) {
    const std::size_t last = submission.tasks.empty() ? 0 : submission.tasks.size() - 1;
    const int processors = submission.options.jobs * submission.options.threads;
    std::vector<std::string> words = {"sbatch",
                                      "--parsable",
                                      "--array=0-" + std::to_string(last),
                                      "--job-name=" + name,
                                      "--requeue",
                                      "--open-mode=append",
                                      "--signal=B:TERM@60",
                                      "--cpus-per-task=" + std::to_string(processors),
                                      "--chdir=" + submission.directory.string(),
                                      "--output=" + (logs / "%A_%a.log").string()};
    words.insert(words.end(), more.begin(), more.end());
    words.push_back(script.string());
    return words;
}

SlurmArray submit(const Submission& submission, const fs::path& file,
                  const std::vector<std::string>& more) {
    const fs::path logs = fs::absolute(file).parent_path();
    const fs::path script = logs / "task.sh", collector = logs / "collect.sh";
    write_file_atomically(script, task_script(file));
    write_file_atomically(collector, "#!/bin/sh\n" + program_line("--collect --submission " +
                                                                  shell_word(file.string())));
    SlurmArray array;
    array.name = "lissom-" + text_digest(process_name()).substr(0, 12);
    array.id = submitted(sbatch_words(submission, array.name, logs, script, more));
    std::vector<std::string> words = {"sbatch",
                                      "--parsable",
                                      "--dependency=afterany:" + array.id,
                                      "--job-name=" + array.name + "-summary",
                                      "--chdir=" + submission.directory.string(),
                                      "--output=" + (logs / "collect.log").string()};
    words.insert(words.end(), more.begin(), more.end());
    words.push_back(collector.string());
    submitted(words);
    return array;
}

SlurmState slurm_state(const SlurmArray& array) {
    const std::optional<CommandEnd> end = run_command(
        {"squeue", "--noheader", "--jobs=" + array.id, "--name=" + array.name, "--format=%T"});
    if (!end) return SlurmState::unknown;
    if (end->status == 0) {
        return trimmed(end->output).empty() ? SlurmState::ended : SlurmState::waits_or_runs;
    }
    const bool is_forgotten = end->errors.find("Invalid job id") != std::string::npos;
    return is_forgotten ? SlurmState::ended : SlurmState::unknown;
}

void cancel(const SlurmArray& array) {
    if (!array.id.empty()) run_command({"scancel", "--quiet", array.id});
}

}  // namespace lissom::cli
