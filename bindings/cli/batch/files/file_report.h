/// Report of a verb over many files: a table, or JSON.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bindings/cli/batch/run/batch_run.h"
#include "bindings/cli/json.h"

namespace lissom::cli {

/// A column of the table.
struct FileColumn {
    std::string name;
    /// Width in characters; numbers stand on its right.
    int width = 0;
    /// Returns the text of a file, by the answer of the verb.
    std::function<std::string(const Json& answer)> text;
};

/// Returns the column of a number in the answer, "-" if there is none.
FileColumn number_column(const std::string& name, int width, int digits = 0);

/// Parts of a report that differ by verb.
struct FileReportOptions {
    /// Values of "outcome" in answers, in the order in which the summary counts them; answers
    /// without it have the first. "failed" is added.
    std::vector<std::string> outcomes;
    /// Columns between the outcome and the notes.
    std::vector<FileColumn> columns;
};

/// Writes rows in the order of the plan, each as soon as those before it are known.
class FileReport : public BatchReport {
  public:
    FileReport(Program& program, const BatchPlan& plan, FileReportOptions options);

    void ended(const BatchJob& job, const JobRecord& record) override;
    void kept(const BatchJob& job, const JobRecord& record) override;
    /// Writes the rows that are left and the summary, or
    /// {"files": [...], OUTCOME: count, ..., "failed", "kept", "stopped"}.
    void finish(const BatchState& state, const BatchProgress& progress) override;

  private:
    struct Row {
        bool is_known = false, is_kept = false;
        Json json;
    };

    void know(const BatchJob& job, const JobRecord& record, bool is_kept);
    void know_others(const BatchState& state);
    void write_ready();
    void write(const Row& row);
    void write_head() const;
    void write_counts(const BatchProgress& progress) const;
    void write_json(const BatchProgress& progress) const;
    std::size_t count(const std::string& outcome) const;

    Program& program_;
    const BatchPlan& plan_;
    FileReportOptions options_;
    std::vector<Row> rows_;
    std::map<std::string, std::size_t> counts_;
    std::size_t next_ = 0, width_ = 4;
    bool has_head_ = false;
};

}  // namespace lissom::cli
