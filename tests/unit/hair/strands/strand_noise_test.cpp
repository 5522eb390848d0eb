#include "kernel/hair/strands/strand_noise.h"

#include <string>
#include <string_view>
#include <vector>

#include "kernel/hair/strands/strand_resample.h"
#include "tests/unit/hair/strands/groomed.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands noisy(Strands strands, const NoiseOptions& options) {
    noise(strands, options);
    return strands;
}

// Parallel strands, upright, on a line with this distance, `count` of them.
Strands lawn(Index count, double distance) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        std::vector<Vec3> points;
        for (int k = 0; k <= 20; ++k) points.emplace_back(distance * s, 0.01 * k, 0.0);
        lists.push_back(points);
    }
    return strands_of(lists);
}

}  // namespace

TEST_CASE("smooth noise is bounded, varies, has no mean and no jumps") {
    Vec3 sum = Vec3::Zero();
    double most = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 place(0.37 * i, 0.11 * i, -0.23 * i);
        const Vec3 value = smooth_noise(place, 3);
        sum += value / 5000.0;
        most = std::max(most, value.cwiseAbs().maxCoeff());
        CHECK((smooth_noise(place + Vec3::Constant(1e-6), 3) - value).norm() < 1e-4);
    }
    CHECK(sum.norm() < 0.05);
    CHECK(most > 0.7);
    CHECK(most < 1.51);
    CHECK(smooth_noise(Vec3(4, 5, 6), 3) == Vec3::Zero());
    CHECK(smooth_noise(Vec3(1e300, 0.5, 0.5), 3).allFinite());
}

TEST_CASE("noise stays near its amplitude and keeps segment lengths") {
    const Strands strands = lawn(200, 0.003);
    NoiseOptions options;
    options.amplitude = 0.002;
    const Strands made = noisy(strands, options);
    double most = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        for (Index k = 0; k < 20; ++k) {
            const double step = (made.strand(s).col(k + 1) - made.strand(s).col(k)).norm();
            CHECK(step == doctest::Approx(0.01).epsilon(1e-4));
        }
        most = std::max(most, double((made.strand(s) - strands.strand(s)).cwiseAbs().maxCoeff()));
    }
    CHECK(most > 0.0005);
    CHECK(most < 0.006);
}

TEST_CASE("neighbours wander together, others do not") {
    NoiseOptions options;
    options.across = 0.02;
    const auto difference = [&](double distance) {
        const Strands strands = lawn(100, distance), made = noisy(strands, options);
        double sum = 0.0;
        for (Index s = 1; s < strands.size(); ++s) {
            const auto moved = [&](Index i) {
                return Eigen::Vector3f(made.strand(i).col(20) - strands.strand(i).col(20));
            };
            sum += (moved(s) - moved(s - 1)).norm();
        }
        return sum;
    };
    CHECK(difference(0.0005) < 0.2 * difference(0.05));
}

TEST_CASE("the shape of noise does not depend on how finely strands are sampled") {
    const Strands strands = lawn(20, 0.01);
    for (const bool cumulative : {false, true}) {
        NoiseOptions options;
        options.cumulative = cumulative;
        const Strands coarse = noisy(resample(strands, {41, 0.0}), options);
        const Strands fine = noisy(resample(strands, {161, 0.0}), options);
        for (Index s = 0; s < strands.size(); ++s) {
            const double apart = (coarse.strand(s).col(40) - fine.strand(s).col(160)).norm();
            CHECK(apart < 0.1 * options.amplitude);
        }
    }
}

TEST_CASE("noise turns no tip by more than 90 degrees") {
    GrowthOptions growth;
    growth.length = 0.25;
    const Strands grown = groomed().grown(growth);
    REQUIRE(strand_statistics(grown).sharp == 0);
    for (const double amplitude : {0.0016, 0.005, 0.02}) {
        CAPTURE(amplitude);
        NoiseOptions options;
        options.amplitude = amplitude;
        CHECK(strand_statistics(noisy(grown, options)).sharp == 0);
        options.cumulative = true;
        CHECK(strand_statistics(noisy(grown, options)).sharp == 0);
    }
}

TEST_CASE("noise of no amplitude changes nothing; another seed gives other noise") {
    const Strands strands = lawn(20, 0.01);
    NoiseOptions options;
    options.amplitude = 0.0;
    options.keep_length = false;
    CHECK(hash(noisy(strands, options)) == hash(strands));
    NoiseOptions other;
    other.seed = 2;
    CHECK(hash(noisy(strands, other)) != hash(noisy(strands, {})));
}

TEST_CASE("noise refuses options out of range") {
    Strands strands = lawn(2, 0.01);
    const auto refused = [&](const auto& change) {
        NoiseOptions options;
        change(options);
        return error_of([&] { noise(strands, options); }).code() == ErrorCode::invalid_argument;
    };
    CHECK(refused([](NoiseOptions& o) { o.amplitude = -1.0; }));
    CHECK(refused([](NoiseOptions& o) { o.across = 0.0; }));
    CHECK(refused([](NoiseOptions& o) { o.along = std::nan(""); }));
    CHECK(refused([](NoiseOptions& o) { o.shape = 0.0; }));
}

TEST_CASE("noise warns if its amplitude is beyond the turns that it allows") {
    std::vector<std::string> told;
    ContextOptions host;
    host.log = [&](LogLevel level, std::string_view message) {
        if (level == LogLevel::warning) told.emplace_back(message);
    };
    const Context context(host);
    Strands strands = random_hair(100);
    noise(strands, {}, context);
    CHECK(told.empty());
    NoiseOptions options;
    options.amplitude = 0.5;
    noise(strands, options, context);
    REQUIRE(told.size() == 1);
    CHECK(told.front().find("amplitude") != std::string::npos);
}
