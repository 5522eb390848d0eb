#include "kernel/merge/verdict.h"

#include <doctest/doctest.h>

using namespace lissom;

namespace {

MergeReport report_with(double greatest, double smallest) {
    MergeReport report;
    report.joins.resize(1);
    report.seam.after.max_dihedral = greatest * kDegree;
    report.seam.after.smallest_angle = smallest * kDegree;
    report.seam.after.low_angle = smallest * kDegree;
    report.source_rim.max_near = 12.0 * kDegree;
    report.target_rim.max_near = 8.0 * kDegree;
    report.source_rim.smallest_angle = report.target_rim.smallest_angle = 25.0 * kDegree;
    return report;
}

bool says(const Verdict& verdict, const char* text) {
    return verdict.text.find(text) != std::string::npos &&
           verdict.text.find('\n') == std::string::npos;
}

}  // namespace

TEST_CASE("the verdict says in one line that a seam is good, or all that is not") {
    const Verdict good = verdict_of(report_with(14.0, 20.0), {});
    CHECK(good.good);
    CHECK(says(good, "good: the surface turns by at most 14 degrees"));
    CHECK(says(verdict_of(report_with(14.0, 20.0), {.sought = false}), "were not looked for"));

    const Verdict steep = verdict_of(report_with(75.0, 20.0), {});
    CHECK(!steep.good);
    CHECK(says(steep, "not good: the surface turns by 75 degrees across the seam"));
    // Parts that are as steep beside their boundaries make no better seam.
    MergeReport crude = report_with(75.0, 20.0);
    crude.target_rim.max_near = 90.0 * kDegree;
    CHECK(verdict_of(crude, {}).good);

    MergeReport bad = report_with(31.0, 0.4);
    bad.intersections.resize(3);
    bad.joins.front().guessed = true;
    bad.joins.front().certainty = 0.6;
    const Verdict all = verdict_of(bad, {});
    CHECK(!all.good);
    CHECK(says(all, "31 degrees"));
    CHECK(says(all, "0.4 degrees"));
    CHECK(says(all, "3 pairs of faces"));
    CHECK(says(all, "boundaries of join 1 is a guess"));
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
    band.max_bend = band.rest_max_bend = 20.0 * kDegree;
    return band;
}

// The only reason that there is, or none.
MergeReason only_reason(const MergeReport& report) {
    const Verdict verdict = verdict_of(report, {});
    if (verdict.reasons.size() != 1) return {};
    CHECK(!verdict.good);
    CHECK(says(verdict, verdict.reasons[0].text.c_str()));
    CHECK(!verdict.reasons[0].remedy.empty());
    return verdict.reasons[0];
}

}  // namespace

TEST_CASE("the verdict weighs the whole band, and tells each fault with its figure and its limit") {
    CHECK(verdict_of(report_with(good_band()), {}).reasons.empty());
    BandQuality band = good_band();
    band.roughness = 19.0 * kDegree;
    MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::roughness);
    CHECK(reason.join == 0);
    CHECK(reason.value == doctest::Approx(19.0 * kDegree));
    CHECK(reason.limit == doctest::Approx(1.4 * 12.0 * kDegree));
    // A side by itself, though both together are no rougher than before.
    band = good_band();
    band.source_roughness = 14.0 * kDegree;
    band.rest_source_roughness = 8.0 * kDegree;
    reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::roughness);
    CHECK(reason.text.find("the source beside the seam is rough") != std::string::npos);
    CHECK(reason.limit == doctest::Approx(1.6 * 8.0 * kDegree));
    // One that was rough may gain less.
    band.rest_source_roughness = 10.5 * kDegree;
    band.source_roughness = 15.5 * kDegree;
    CHECK(only_reason(report_with(band)).limit == doctest::Approx(1.4 * 10.5 * kDegree));
    // A pasted part bends to meet its target.
    MergeReport paste = report_with(band);
    paste.crease = 35.0 * kDegree;
    CHECK(verdict_of(paste, {}).good);
    band = good_band();
    band.target_roughness = 7.0 * kDegree;
    band.rest_target_roughness = 1.5 * kDegree;
    reason = only_reason(report_with(band));
    CHECK(reason.text.find("the target beside") != std::string::npos);
    CHECK(reason.limit == doctest::Approx(5.0 * kDegree));
    band.rest_target_roughness = 6.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    // Beside creases the rest of a side may still be rough.
    band = good_band();
    band.target_roughness = band.rest_target_roughness = 13.0 * kDegree;
    band.target_grain = 9.0 * kDegree;
    reason = only_reason(report_with(band));
    CHECK(reason.text.find("the target between its creases") != std::string::npos);
    CHECK(reason.limit == doctest::Approx(5.0 * kDegree));
    band.rest_target_grain = 8.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    // Beside flat sides edges that turn by little do not show.
    band = good_band();
    band.rest_roughness = 0.1 * kDegree;
    band.roughness = 7.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);

    band = good_band();
    band.folded = 0.3;
    CHECK(only_reason(report_with(band)).fault == MergeFault::folds);
    band.rest_folded = 0.3;
    CHECK(verdict_of(report_with(band), {}).good);
    // Short ones do not show.
    band.rest_folded = 0.0;
    band.folded = 0.13;
    CHECK(verdict_of(report_with(band), {}).good);

    band = good_band();
    band.source_volume = 0.35;
    reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::volume);
    CHECK(reason.text.find("source lost 65 %") != std::string::npos);
    band.source_volume = -0.4;
    CHECK(only_reason(report_with(band)).text.find("inside out") != std::string::npos);
    band = good_band();
    band.target_volume = 0.35;
    CHECK(only_reason(report_with(band)).text.find("target lost") != std::string::npos);
    // A paste has a crease, and takes the place of surface.
    MergeReport covering = report_with(band);
    covering.crease = 30.0 * kDegree;
    CHECK(only_reason(covering).text.find("takes the place of 65 %") != std::string::npos);
    covering.joins[0].band.target_volume = 0.55;
    CHECK(verdict_of(covering, {}).good);

    band = good_band();
    band.bend = 40.0 * kDegree;
    reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::bend);
    CHECK(reason.limit == doctest::Approx(35.0 * kDegree));
    band.rest_bend = 32.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    band.max_bend = 70.0 * kDegree;
    CHECK(only_reason(report_with(band)).limit == doctest::Approx(60.0 * kDegree));
}

TEST_CASE(
    "a source with creases that gains wrinkles between them is not good, nor with few of them") {
    BandQuality band = good_band();
    band.source_roughness = band.rest_source_roughness = 20.0 * kDegree;
    band.source_grain = 12.0 * kDegree;
    band.rest_source_grain = 8.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    band.wrinkled = 4.0;
    const MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::roughness);
    CHECK(reason.limit == doctest::Approx(11.0 * kDegree));
    CHECK(reason.text.find("the source between its creases") != std::string::npos);
    // Its own grain is no wrinkle, and parts that fit keep theirs.
    band.rest_source_grain = 10.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    band.rest_source_grain = 8.0 * kDegree;
    MergeReport fits = report_with(band);
    fits.joins.front().fits = true;
    CHECK(verdict_of(fits, {}).good);
}

TEST_CASE(
    "a rim that stands out beside the seam is not good, though the surface bends nowhere else") {
    BandQuality band = good_band();
    band.flare = 55.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    band.flare = 70.0 * kDegree;
    const MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::flare);
    CHECK(reason.join == 0);
    CHECK(reason.value == doctest::Approx(70.0 * kDegree));
    CHECK(reason.text.find("turns outward by 70 degrees more than before") != std::string::npos);
    // One that crumples as well may stand out less.
    BandQuality bag = good_band();
    bag.flare = 25.0 * kDegree;
    CHECK(verdict_of(report_with(bag), {}).good);
    bag.rest_source_roughness = 10.0 * kDegree;
    bag.source_roughness = 12.0 * kDegree;
    CHECK(only_reason(report_with(bag)).text.find("crumples and stands out") != std::string::npos);
    bag.flare = 20.0 * kDegree;
    CHECK(verdict_of(report_with(bag), {}).good);
    // Parts that fit move as a whole.
    MergeReport fits = report_with(band);
    fits.joins.front().fits = true;
    CHECK(verdict_of(fits, {}).good);
}

TEST_CASE("a point beside the seam is not good, but where the parts had one as sharp") {
    BandQuality band = good_band();
    band.spike = 200.0 * kDegree;
    const MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::spike);
    CHECK(reason.value == doctest::Approx(200.0 * kDegree));
    band.rest_spike = 180.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
    // A smaller one shows beside smooth surfaces alone.
    band.spike = 60.0 * kDegree;
    band.rest_spike = 2.0 * kDegree;
    CHECK(only_reason(report_with(band)).limit == doctest::Approx(48.0 * kDegree));
    band.rest_spike = 20.0 * kDegree;
    CHECK(verdict_of(report_with(band), {}).good);
}

TEST_CASE("a few steep edges of a seam do not decide, a thirtieth of it does") {
    MergeReport report = report_with(75.0, 20.0);
    BandQuality& band = report.joins.front().band;
    band = good_band();
    band.radius = 1.0;
    band.steep = 25.0 * kDegree;
    CHECK(verdict_of(report, {}).good);
    CHECK(says(verdict_of(report, {}), "all but a thirtieth"));
    band.steep = 60.0 * kDegree;
    CHECK(!verdict_of(report, {}).good);
}

TEST_CASE("one steep edge beside the boundaries is no excuse for a steep seam, some of them are") {
    MergeReport report = report_with(50.0, 20.0);
    BandQuality& band = report.joins.front().band;
    band = good_band();
    band.radius = 1.0;
    band.steep = 45.0 * kDegree;
    band.rest_steep = 20.0 * kDegree;
    report.source_rim.max_near = 90.0 * kDegree;
    CHECK(only_reason(report).fault == MergeFault::seam);
    CHECK(only_reason(report).limit == doctest::Approx(30.0 * kDegree));
    band.rest_steep = 50.0 * kDegree;
    CHECK(verdict_of(report, {}).good);
}

TEST_CASE("edges beside the seam that became sharp are folds, unless the parts fit") {
    BandQuality band = good_band();
    band.sharpened = 1.0;
    CHECK(verdict_of(report_with(band), {}).good);
    band.sharpened = 2.0;
    const MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::folds);
    CHECK(reason.value == doctest::Approx(2.0));
    CHECK(says(verdict_of(report_with(band), {}), "creased beside the seam"));
    MergeReport fits = report_with(band);
    fits.joins.front().fits = true;
    CHECK(verdict_of(fits, {}).good);
}

TEST_CASE("thorns and pits of the source that it did not have are folds, unless the parts fit") {
    BandQuality band = good_band();
    band.pinched = 0.15;
    CHECK(verdict_of(report_with(band), {}).good);
    band.pinched = 0.3;
    const MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::folds);
    CHECK(reason.value == doctest::Approx(0.3));
    CHECK(says(verdict_of(report_with(band), {}), "thorns or pits"));
    const auto only_thorns = [](const BandQuality& measured) {
        MergeReport report = report_with(measured);
        judge(report, {});
        return has_only_thorns(report);
    };
    CHECK(only_thorns(band));
    CHECK(!only_thorns(good_band()));
    BandQuality creased = band, bent = band;
    creased.sharpened = 2.0;
    bent.max_bend = bent.bend = 90.0 * kDegree;
    CHECK(!only_thorns(creased));
    CHECK(!only_thorns(bent));
    MergeReport fits = report_with(band);
    fits.joins.front().fits = true;
    CHECK(verdict_of(fits, {}).good);
}

TEST_CASE("edges of a merge that turn more than at rest are folds, unless the parts fit") {
    BandQuality band = good_band();
    band.crumpled = 5.5;
    CHECK(verdict_of(report_with(band), {}).good);
    band.crumpled = 8.0;
    const MergeReason reason = only_reason(report_with(band));
    CHECK(reason.fault == MergeFault::folds);
    CHECK(reason.value == doctest::Approx(8.0));
    CHECK(reason.text.find("edges along 8.0 of its radius") != std::string::npos);
    MergeReport crumpled = report_with(band);
    judge(crumpled, {});
    CHECK(!has_only_thorns(crumpled));
    crumpled.joins.front().fits = true;
    CHECK(verdict_of(crumpled, {}).good);
}

TEST_CASE("surfaces that only touch are told, and are no reason against a merge") {
    MergeReport report = report_with(good_band());
    report.intersections.resize(3);
    report.crossings.resize(2);
    report.crossings[0].pairs = 1;
    report.crossings[1].pairs = 2;
    report.crossings[0].shallow = true;
    REQUIRE(verdict_of(report, {}).reasons.size() == 1);
    CHECK(verdict_of(report, {}).reasons[0].value == 2.0);
    report.crossings[1].shallow = true;
    CHECK(verdict_of(report, {}).good);
    CHECK(says(verdict_of(report, {}), "but for 3 pairs that touch"));
}

TEST_CASE("crossings that no view from outside shows are told, and are no reason against a merge") {
    MergeReport report = report_with(good_band());
    report.intersections.resize(3);
    report.crossings.resize(2);
    report.crossings[0].pairs = 1;
    report.crossings[1].pairs = 2;
    report.crossings[1].hidden = true;
    REQUIRE(verdict_of(report, {}).reasons.size() == 1);
    CHECK(verdict_of(report, {}).reasons[0].value == 1.0);
    report.crossings[0].shallow = true;
    CHECK(verdict_of(report, {}).good);
    CHECK(says(verdict_of(report, {}), "1 pair that touches and 2 pairs inside"));
}

TEST_CASE("a seam that turns all around is not good, though one edge beside it was as steep") {
    MergeReport report = report_with(good_band());
    report.target_rim.max_near = 90.0 * kDegree;
    report.seam.after.max_dihedral = 72.0 * kDegree;
    report.seam.after.rms_dihedral = 15.0 * kDegree;
    CHECK(verdict_of(report, {}).good);
    report.seam.after.rms_dihedral = 40.0 * kDegree;
    CHECK(only_reason(report).fault == MergeFault::seam);
    CHECK(only_reason(report).limit == doctest::Approx(20.0 * kDegree));
    // A paste may be asked to meet its target at a crease.
    report.crease = 90.0 * kDegree;
    CHECK(verdict_of(report, {}).good);
}

TEST_CASE("of several faults the gravest is told first, slivers last; the join is named") {
    MergeReport report = report_with(good_band());
    report.joins.push_back(report.joins.front());
    report.joins[1].band.folded = 1.0;
    report.joins[1].band.bend = 60.0 * kDegree;
    report.seam.after.smallest_angle = 0.5 * kDegree;
    report.intersections.resize(2);
    judge(report, {});
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

namespace {

// A report with every fault that there is.
MergeReport report_of_all_faults() {
    MergeReport report = report_with(75.0, 0.4);
    report.intersections.resize(4);
    for (const CrossingPlace place : {CrossingPlace::seam, CrossingPlace::source,
                                      CrossingPlace::target, CrossingPlace::between}) {
        report.crossings.push_back({place, 1, {3, 7}, Vec3(1.0, 2.0, 3.0)});
    }
    JoinReport& join = report.joins.front();
    join.same_side = join.guessed = true;
    join.certainty = 0.5;
    join.band = good_band();
    join.band.folded = 1.0;
    join.band.roughness = 80.0 * kDegree;
    join.band.source_volume = 0.2;
    join.band.target_volume = -0.2;
    join.band.bend = join.band.flare = 80.0 * kDegree;
    return report;
}

// Every choice of the options that may be open.
std::vector<OpenOptions> all_open_options() {
    std::vector<OpenOptions> all;
    for (unsigned bits = 0; bits < 512; ++bits) {
        const auto bit = [&](unsigned k) { return (bits >> k & 1U) != 0; };
        all.push_back(
            {true, bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(6), bit(7), bit(8)});
    }
    return all;
}

bool names(const MergeReason& reason, const char* text) {
    return reason.remedy.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("remedies name only options that the operation has and that are not set already") {
    const MergeReport report = report_of_all_faults();
    for (const OpenOptions& open : all_open_options()) {
        const Verdict verdict = verdict_of(report, open);
        REQUIRE(verdict.reasons.size() == 14);
        for (const MergeReason& reason : verdict.reasons) {
            REQUIRE(!reason.remedy.empty());
            REQUIRE((open.keys || !names(reason, "key")));
            REQUIRE((open.fair || !names(reason, "\"fair\"")));
            REQUIRE((open.transition || !names(reason, "use a transition")));
            REQUIRE((open.no_transition || !names(reason, "transition out")));
            REQUIRE((open.smooth || !names(reason, "smooth more")));
            REQUIRE((open.collar || !names(reason, "collar")));
            REQUIRE((open.fixed || !names(reason, "`fixed`")));
            REQUIRE((open.free || !names(reason, "free")));
            REQUIRE((open.moves || !names(reason, "shrink")));
        }
    }
}

TEST_CASE(
    "crossings say on which part and where they are, name their faces, and `fixed` helps if "
    "the source's deformation causes them") {
    MergeReport report = report_with(good_band());
    report.intersections.resize(2);
    report.crossings.push_back({CrossingPlace::source, 2, {4, 9, 11}, Vec3(0.5, -1.0, 2.0)});
    OpenOptions open;
    open.fixed = true;
    const Verdict verdict = verdict_of(report, open);
    REQUIRE(verdict.reasons.size() == 1);
    const MergeReason& reason = verdict.reasons[0];
    CHECK(says(verdict, "2 pairs of faces of the source, away from the seam (around 0.5, -1, 2)"));
    CHECK(reason.faces == std::vector<Index>{4, 9, 11});
    CHECK(reason.remedy.find("`fixed`") != std::string::npos);

    MergeReport known = report_with(good_band());
    known.known_intersections = 53;
    CHECK(says(verdict_of(known, {}), "did not before (53 pairs did)"));
}

TEST_CASE("slivers are no fault beside polygons that are as thin once they are divided") {
    MergeReport report = report_with(14.0, 1.2);
    CHECK(only_reason(report).fault == MergeFault::slivers);
    report.source_rim.polygon_angle = 1.0 * kDegree;
    CHECK(verdict_of(report, {}).good);
    report.source_rim.polygon_angle = 1.4 * kDegree;
    CHECK(!verdict_of(report, {}).good);
}

TEST_CASE("slivers are no fault of parts that fit, which keep every vertex") {
    MergeReport report = report_with(good_band());
    report.seam.after.smallest_angle = 1e-4;
    REQUIRE(!report.joins.empty());
    for (const bool fits : {false, true}) {
        for (JoinReport& join : report.joins) join.fits = fits;
        CHECK(verdict_of(report, {}).reasons.empty() == fits);
    }
}
