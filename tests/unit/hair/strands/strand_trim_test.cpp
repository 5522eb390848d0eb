#include "kernel/hair/strands/strand_trim.h"

#include "kernel/hair/strands/strand_edit.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands trimmed(Strands strands, const StrandTrimOptions& options, const Context& context = {}) {
    trim(strands, options, context);
    return strands;
}

}  // namespace

TEST_CASE("a trimmed strand is the first part of the old one") {
    const Strands strands = rich_hair(50);
    StrandTrimOptions options;
    options.factor = 0.6;
    const Strands made = trimmed(strands, options);
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView old = strands.strand(s), now = made.strand(s);
        CHECK(length(now) == doctest::Approx(0.6 * length(old)));
        const Index kept = static_cast<Index>(now.cols()) - 1;
        CHECK(now.leftCols(kept) == old.leftCols(kept));
    }
}

TEST_CASE("no strand is longer than asked, and short ones stay to the bit") {
    const Strands strands = random_hair(50);
    StrandTrimOptions options;
    options.length = 0.08;
    const Strands made = trimmed(strands, options);
    for (Index s = 0; s < strands.size(); ++s) {
        CHECK(length(made.strand(s)) <= 0.08 * (1 + 1e-6));
        const bool is_short = length(strands.strand(s)) < 0.08;
        if (is_short) CHECK(same_points(made.strand(s), strands.strand(s)));
    }
}

TEST_CASE("nothing is left beyond a plane, within its jitter") {
    const Strands strands = random_hair(100);
    StrandTrimOptions options;
    options.plane = StrandTrimPlane{{0, 0.06, 0}, {0, 3, 0}};
    CHECK(bounds(trimmed(strands, options)).max.y() == doctest::Approx(0.06).epsilon(1e-5));
    options.jitter = 0.01;
    const double highest = bounds(trimmed(strands, options)).max.y();
    CHECK(highest > 0.061);
    CHECK(highest < 0.0701);
}

TEST_CASE("a strand rooted beyond the plane keeps its least length") {
    StrandTrimOptions options;
    options.plane = StrandTrimPlane{{0, -1, 0}, {0, 1, 0}};
    options.least = 0.005;
    const Strands made = trimmed(random_hair(20), options);
    CHECK(strand_statistics(made).min_length == doctest::Approx(0.005));
    CHECK(strand_statistics(made).max_length == doctest::Approx(0.005));
}

TEST_CASE("trimming at random belongs to the id of a strand") {
    const Strands strands = rich_hair(600);
    StrandTrimOptions options;
    options.variation = 0.5;
    const Strands whole = trimmed(strands, options, threads(4));
    CHECK(hash(trimmed(strands, options, threads(1))) == hash(whole));
    CHECK(hash(trimmed(prefix(strands, 200), options)) == hash(prefix(whole, 200)));
    options.seed = 2;
    CHECK(hash(trimmed(strands, options)) != hash(whole));
}

TEST_CASE("at random strands keep from all of it to the variation less, evenly") {
    const Strands strands = random_hair(500);
    StrandTrimOptions options;
    options.factor = 0.8;
    for (const double variation : {0.25, 0.5, 1.0}) {
        options.variation = variation;
        const Strands made = trimmed(strands, options);
        double least = 1.0, most = 0.0, sum = 0.0;
        for (Index s = 0; s < strands.size(); ++s) {
            const double part = length(made.strand(s)) / length(strands.strand(s)) / 0.8;
            least = std::min(least, part);
            most = std::max(most, part);
            sum += part / 500.0;
        }
        CHECK(std::abs(least - std::max(1.0 - variation, 0.0)) < 0.05);
        CHECK(std::abs(most - 1.0) < 0.02);
        CHECK(std::abs(sum - (1.0 - 0.5 * variation)) < 0.04);
    }
}

TEST_CASE("a plane with jitter cuts each strand somewhere else, as often above as below") {
    std::vector<std::vector<Vec3>> lists(500, {Vec3(0, 0, 0), Vec3(0, 1, 0)});
    StrandTrimOptions options;
    options.plane = StrandTrimPlane{{5, 0.5, 7}, {0, 2, 0}};
    options.jitter = 0.25;
    const Strands made = trimmed(strands_of(lists), options);
    double least = 1.0, most = 0.0, sum = 0.0;
    for (Index s = 0; s < made.size(); ++s) {
        const double height = made.strand(s)(1, 1);
        least = std::min(least, height);
        most = std::max(most, height);
        sum += height / 500.0;
    }
    CHECK(std::abs(least - 0.25) < 0.01);
    CHECK(std::abs(most - 0.75) < 0.01);
    CHECK(std::abs(sum - 0.5) < 0.03);
}

TEST_CASE("of several limits the one that leaves least counts, and the first passage of a plane") {
    // Up, down and up again through a plane at 0.5.
    const Strands strands =
        strands_of({{{0, 0, 0}, {0, 1, 0}, {0.1, 0, 0}, {0.2, 1, 0}}, {{0, 0, 0}, {0, 0.3, 0}}});
    StrandTrimOptions options;
    options.plane = StrandTrimPlane{{0, 0.5, 0}, {0, 1, 0}};
    CHECK(length(trimmed(strands, options).strand(0)) == doctest::Approx(0.5));
    CHECK(length(trimmed(strands, options).strand(1)) == doctest::Approx(0.3));
    options.length = 0.4;
    CHECK(length(trimmed(strands, options).strand(0)) == doctest::Approx(0.4));
    options.factor = 0.1;
    CHECK(length(trimmed(strands, options).strand(0)) < 0.31);
    options.least = 0.45;
    CHECK(length(trimmed(strands, options).strand(0)) == doctest::Approx(0.45));
    CHECK(same_points(trimmed(strands, options).strand(1), strands.strand(1)));
}

TEST_CASE("trimming nothing changes nothing") {
    const Strands strands = rich_hair(30);
    CHECK(hash(trimmed(strands, {})) == hash(strands));
    const Strands odd = strands_of({{{1, 1, 1}}, {{1, 1, 1}, {1, 1, 1}}});
    StrandTrimOptions options;
    options.factor = 0.5;
    CHECK(hash(trimmed(odd, options)) == hash(odd));
}

TEST_CASE("trimming refuses options out of range and changes nothing") {
    Strands strands = random_hair(3);
    const std::uint64_t before = hash(strands);
    const auto refused = [&](const auto& change) {
        StrandTrimOptions options;
        change(options);
        return error_of([&] { trim(strands, options); }).code() == ErrorCode::invalid_argument;
    };
    CHECK(refused([](StrandTrimOptions& o) { o.length = 0.0; }));
    CHECK(refused([](StrandTrimOptions& o) { o.factor = 1.5; }));
    CHECK(refused([](StrandTrimOptions& o) { o.variation = std::nan(""); }));
    CHECK(refused([](StrandTrimOptions& o) { o.jitter = -1.0; }));
    CHECK(refused([](StrandTrimOptions& o) { o.least = 0.0; }));
    CHECK(refused([](StrandTrimOptions& o) { o.plane = StrandTrimPlane{{0, 0, 0}, {0, 0, 0}}; }));
    CHECK(hash(strands) == before);
}
