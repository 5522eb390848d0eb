#include "kernel/hair/strands/strand_resample.h"

#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("resampling by count gives as many points, evenly spaced on the old strand") {
    const Strands line = strands_of({{{0, 0, 0}, {0, 1, 0}, {0, 4, 0}}});
    const Strands made = resample(line, {5, 0.0});
    REQUIRE(made.point_count(0) == 5);
    for (Index k = 0; k < 5; ++k) CHECK(made.strand(0)(1, k) == doctest::Approx(k));
}

TEST_CASE("resampling by two points leaves roots and tips") {
    const Strands strands = random_hair(10);
    const Strands made = resample(strands, {2, 0.0});
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView old = strands.strand(s);
        REQUIRE(made.point_count(s) == 2);
        CHECK(made.strand(s).col(0) == old.col(0));
        CHECK(made.strand(s).col(1) == old.col(old.cols() - 1));
    }
}

TEST_CASE("resampling by step keeps roots and tips to the bit") {
    const Strands strands = rich_hair(50);
    const Strands made = resample(strands, {0, 0.004});
    CHECK(made.ids() == strands.ids());
    CHECK(made.colors()->values.size() == static_cast<std::size_t>(made.point_count()));
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView old = strands.strand(s), now = made.strand(s);
        CHECK(old.col(0) == now.col(0));
        CHECK(old.col(old.cols() - 1) == now.col(now.cols() - 1));
        const double step = length(now) / double(now.cols() - 1);
        CHECK(step < 0.008);
        CHECK(length(now) <= length(old) * (1 + 1e-6));
    }
}

TEST_CASE("resampling a finely sampled strand back is nearly the same strand") {
    const Strands strands = random_hair(20);
    const Strands fine = resample(strands, {1000, 0.0});
    for (Index s = 0; s < strands.size(); ++s) {
        CHECK(length(fine.strand(s)) == doctest::Approx(length(strands.strand(s))).epsilon(1e-4));
    }
}

TEST_CASE("strands without length are resampled without harm") {
    const Strands strands = strands_of({{{1, 2, 3}}, {{1, 2, 3}, {1, 2, 3}}});
    const Strands made = resample(strands, {4, 0.0});
    CHECK(made.point_count(0) == 1);
    CHECK(made.point_count(1) == 4);
    CHECK(made.strand(1).allFinite());
    CHECK(resample(strands, {0, 0.1}).point_count(1) == 2);
    CHECK(resample({}, {4, 0.0}).empty());
}

TEST_CASE("resampling refuses what it cannot do") {
    const Strands strands = random_hair(3);
    for (const ResampleOptions& options : std::vector<ResampleOptions>{
             {0, 0.0}, {1, 0.0}, {-3, 0.0}, {3, 0.1}, {0, -1.0}, {0, 1e-30}, {2000000000, 0.0}}) {
        CAPTURE(options.count);
        CAPTURE(options.step);
        CHECK(error_of([&] { resample(strands, options); }).code() == ErrorCode::invalid_argument);
    }
    ContextOptions limits;
    limits.memory_limit = 1 << 20;
    CHECK(error_of([&] {
              resample(strands, {600000000, 0.0}, Context(limits));
          }).code() == ErrorCode::memory_limit);
}
