/// Results of tests, as plain values for reports.
#pragma once

#include <string>
#include <vector>

namespace lissom::cli {

enum class TestStatus { passed, failed, skipped };

/// A line of a script.
struct TestLine {
    std::string file;
    int line = 0;
};

struct TestResult {
    /// Name with those of its groups: "bending / far from the origin". Empty for events of the file
    /// before or after its tests.
    std::string name;
    /// Place of its declaration.
    int line = 0;
    TestStatus status = TestStatus::passed;
    double seconds = 0.0;
    /// Reason and place of a failure or skip.
    std::string message;
    TestLine place;
    /// Whether an expectation did not hold; otherwise something else went wrong.
    bool is_expectation = false;
    /// The lines that called that place, the nearest first.
    std::vector<TestLine> callers;
    /// Output of the test.
    std::string output;
    /// The folder that keeps its files, or "".
    std::string folder;
    /// Reasons that pictures were not compared, one for each.
    std::vector<std::string> left_out;
    /// Golden pictures that were written.
    std::vector<std::string> updated;
};

struct FileResult {
    std::string file;
    std::vector<TestResult> tests;
    double seconds = 0.0;
};

/// Returns "0.5 s", "60 s".
std::string seconds_text(double seconds);

struct TestCounts {
    int files = 0, passed = 0, failed = 0, skipped = 0, left_out = 0, updated = 0;

    int tests() const { return passed + failed + skipped; }
    void add(const FileResult& result);
};

}  // namespace lissom::cli
