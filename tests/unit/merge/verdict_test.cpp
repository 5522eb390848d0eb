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

namespace {

// A report of a good merge, but for the band.
MergeReport report_with(const BandQuality& band) {
    MergeReport report = report_with(14.0, 20.0);
    report.joins.front().band = band;
    return report;
}

BandQuality good_band() {
    BandQuality band;
    band.roughness = band.rest_roughness = 12.0 * kDegree;
    band.bend = band.rest_bend = 10.0 * kDegree;
    band.greatest_bend = band.rest_greatest_bend = 20.0 * kDegree;
    return band;
}

// The only reason that there is, or none.
MergeReason only_reason(const MergeReport& report) {
    const Verdict verdict = verdict_of(report, true);
    if (verdict.reasons.size() != 1) return {};
    CHECK(!verdict.good);
    CHECK(says(verdict, verdict.reasons[0].text.c_str()));
    CHECK(!verdict.reasons[0].remedy.empty());
    return verdict.reasons[0];
}

}  // namespace

TEST_CASE("the verdict weighs the whole band, and tells each fault with its figure and its limit") {
    CHECK(verdict_of(report_with(good_band()), true).reasons.empty());
    BandQuality band = good_band();
    band.roughness = 19.0 * kDegree;
    MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::roughness);
    CHECK(reason.join == 0);
    CHECK(reason.value == doctest::Approx(19.0 * kDegree));
    CHECK(reason.limit == doctest::Approx(1.4 * 12.0 * kDegree));
    // Beside flat sides edges that turn by little do not show.
    band.rest_roughness = 0.1 * kDegree;
    band.roughness = 7.0 * kDegree;
    CHECK(verdict_of(report_with(band), true).good);

    band = good_band();
    band.folded = 0.3;
    CHECK(only_reason(report_with(band)).fault == MergeFault::folds);
    band.rest_folded = 0.3;
    CHECK(verdict_of(report_with(band), true).good);

    band = good_band();
    band.source_volume = 0.6;
    reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::volume);
    CHECK(reason.text.find("source lost 40 %") != std::string::npos);
    band.source_volume = -0.4;
    CHECK(only_reason(report_with(band)).text.find("inside out") != std::string::npos);
    band = good_band();
    band.target_volume = 0.7;
    CHECK(only_reason(report_with(band)).text.find("target lost") != std::string::npos);

    band = good_band();
    band.bend = 30.0 * kDegree;
    reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::bend);
    CHECK(reason.limit == doctest::Approx(25.0 * kDegree));
    band.rest_bend = 24.0 * kDegree;
    CHECK(verdict_of(report_with(band), true).good);
    band.greatest_bend = 60.0 * kDegree;
    CHECK(only_reason(report_with(band)).limit == doctest::Approx(50.0 * kDegree));
}

TEST_CASE("a seam that turns all around is not good, though one edge beside it was as steep") {
    MergeReport report = report_with(good_band());
    report.target_rim.greatest_near = 90.0 * kDegree;
    report.seam.after.greatest_dihedral = 72.0 * kDegree;
    report.seam.after.rms_dihedral = 15.0 * kDegree;
    CHECK(verdict_of(report, true).good);
    report.seam.after.rms_dihedral = 40.0 * kDegree;
    CHECK(only_reason(report).fault == MergeFault::seam);
    CHECK(only_reason(report).limit == doctest::Approx(20.0 * kDegree));
    // A paste may be asked to meet its target at a crease.
    report.crease = 90.0 * kDegree;
    CHECK(verdict_of(report, true).good);
}

TEST_CASE("of several faults the gravest is told first, slivers last; the join is named") {
    MergeReport report = report_with(good_band());
    report.joins.push_back(report.joins.front());
    report.joins[1].band.folded = 1.0;
    report.joins[1].band.bend = 60.0 * kDegree;
    report.seam.after.smallest_angle = 0.5 * kDegree;
    report.intersections.resize(2);
    judge(report, true);
    CHECK(!report.ok);
    REQUIRE(report.reasons.size() == 4);
    const MergeFault order[] = {MergeFault::crossings, MergeFault::folds, MergeFault::bend,
                                MergeFault::slivers};
    for (std::size_t k = 0; k < 4; ++k) CHECK(report.reasons[k].fault == order[k]);
    CHECK(report.reasons[0].join == kNoIndex);
    CHECK(report.reasons[1].join == 1);
    CHECK(report.reasons[1].text.find("at join 2") != std::string::npos);
    CHECK(std::string(fault_name(report.reasons[3].fault)) == "slivers");
}
