#include "bindings/cli/test/results.h"

#include <cstdio>

namespace lissom::cli {

std::string seconds_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%g s", seconds);
    return text;
}

void TestCounts::add(const FileResult& result) {
    files += result.tests.empty() ? 0 : 1;
    for (const TestResult& test : result.tests) {
        passed += test.status == TestStatus::passed ? 1 : 0;
        failed += test.status == TestStatus::failed ? 1 : 0;
        skipped += test.status == TestStatus::skipped ? 1 : 0;
        left_out += static_cast<int>(test.left_out.size());
        updated += static_cast<int>(test.updated.size());
    }
}

}  // namespace lissom::cli
