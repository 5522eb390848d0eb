/// The results of a batch as files: summary.csv, summary.json, and index.html with pictures.
#pragma once

#include <string>

#include "bindings/cli/batch/driver.h"
#include "bindings/cli/batch/plan/plan.h"
#include "bindings/cli/json.h"

namespace lissom::cli {

/// Returns {"script", "folder", "jobs": [{"number", "output", "arguments", "outcome", ...}],
/// "done", "failed", "waiting"}: the last record of each job, "waiting" without one. Paths are
/// below the folder of the batch. "result" of a job holds the numbers and words that a verb has
/// answered.
Json summary_json(const BatchPlan& plan, const BatchState& state);

/// Returns the same as comma-separated values, a line for each job.
std::string summary_table(const Json& summary);

/// Returns a page that shows the same in any browser, without a server.
std::string summary_page(const Json& summary);

/// Returns the text of the page, with @DATA@ for the jobs.
const char* page_template();

/// Throws if a file of another origin has the name of one of the three. Errors: file_write_failed.
void require_own_summary(const BatchPlan& plan);

/// Writes the three into the folder of the batch. Errors: file_write_failed.
void write_summary(const BatchPlan& plan, const BatchState& state);

}  // namespace lissom::cli
