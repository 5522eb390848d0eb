/// The results of tests as texts.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/json.h"
#include "bindings/cli/test/results.h"

namespace lissom::cli {

/// Prints a file for people: a line, and below it failed and skipped tests; `verbose` names every
/// test, with the output of each.
std::string file_text(const FileResult& result, bool verbose);
/// Returns "12 passed, 1 failed, 2 skipped (3 files, 1.24 s)"; the first two are always there.
std::string counts_text(const TestCounts& counts, double seconds);

/// Returns a report of the Test Anything Protocol, version 13.
std::string tap_text(const std::vector<FileResult>& results);
/// The XML that JUnit's readers take: a suite a file.
std::string junit_text(const std::vector<FileResult>& results, double seconds);
/// {"passed", "failed", "skipped", "seconds", "tests": [{"file", "name", "line", "status", ...}]}
Json results_json(const std::vector<FileResult>& results, double seconds);

/// Returns a line a test: "file:line: name".
std::string list_text(const std::vector<FileResult>& results);
Json list_json(const std::vector<FileResult>& results);

}  // namespace lissom::cli
