#include "kernel/merge/verdict.h"

#include <doctest/doctest.h>

using namespace lissom;

namespace {

MergeReport report_with(double greatest, double smallest) {
    MergeReport report;
    report.joins.resize(1);
    report.seam.after.greatest_dihedral = greatest * kDegree;
    report.seam.after.smallest_angle = smallest * kDegree;
    report.seam.after.low_angle = smallest * kDegree;
    report.source_rim.greatest_near = 12.0 * kDegree;
    report.target_rim.greatest_near = 8.0 * kDegree;
    report.source_rim.smallest_angle = report.target_rim.smallest_angle = 25.0 * kDegree;
    return report;
}

bool says(const Verdict& verdict, const char* text) {
    return verdict.text.find(text) != std::string::npos &&
           verdict.text.find('\n') == std::string::npos;
}

}  // namespace

TEST_CASE("the verdict says in one line that a seam is good, or all that is not") {
    const Verdict good = verdict_of(report_with(14.0, 20.0), true);
    CHECK(good.good);
    CHECK(says(good, "good: the surface turns by at most 14 degrees"));
    CHECK(says(verdict_of(report_with(14.0, 20.0), false), "were not looked for"));

    const Verdict steep = verdict_of(report_with(75.0, 20.0), true);
    CHECK(!steep.good);
    CHECK(says(steep, "not good: the surface turns by 75 degrees across the seam"));
    // Parts that are as steep beside their boundaries make no better seam.
    MergeReport crude = report_with(75.0, 20.0);
    crude.target_rim.greatest_near = 90.0 * kDegree;
    CHECK(verdict_of(crude, true).good);

    MergeReport bad = report_with(31.0, 0.4);
    bad.intersections.resize(3);
    bad.joins.front().guessed = true;
    bad.joins.front().certainty = 0.6;
    const Verdict all = verdict_of(bad, true);
    CHECK(!all.good);
    CHECK(says(all, "31 degrees"));
    CHECK(says(all, "0.4 degrees"));
    CHECK(says(all, "3 pairs of faces"));
    CHECK(says(all, "join 1 meet is a guess"));
}
