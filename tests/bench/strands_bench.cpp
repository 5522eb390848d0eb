// Operators on 100K strands of 32 points, each against reading and writing their bytes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/hair/operators/strand_bend.h"
#include "kernel/hair/operators/strand_braid.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/operators/strand_curl.h"
#include "kernel/hair/operators/strand_cut.h"
#include "kernel/hair/operators/strand_detail.h"
#include "kernel/hair/operators/strand_frizz.h"
#include "kernel/hair/operators/strand_gather.h"
#include "kernel/hair/strands/strand_clump.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_noise.h"
#include "kernel/hair/strands/strand_operators.h"
#include "kernel/hair/strands/strand_trim.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr Index kStrands = 100000, kPoints = 32;

// Bowed strands of 0.2 metres, rooted on a ball of 0.1 metres in no order of place.
Strands hair_on_ball() {
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < kStrands; ++s) {
        const double up = std::fmod(0.618034 * s, 1.0), turn = std::fmod(0.754878 * s, 1.0);
        const double side = std::sqrt(1.0 - up * up), angle = 2.0 * kPi * turn;
        const Vec3 out(side * std::cos(angle), up, side * std::sin(angle));
        for (Index k = 0; k < kPoints; ++k) {
            const double a = 0.2 * k / (kPoints - 1);
            const Vec3 p = (0.1 + 0.6 * a) * out - Vec3(0, 4.0 * a * a, 0);
            for (const double x : p) points.push_back(static_cast<float>(x));
        }
        offsets.push_back(offsets.back() + kPoints);
    }
    return {std::move(points), std::move(offsets)};
}

// A strand with a kink every six millimetres.
Strands kinked_strand() {
    std::vector<float> points;
    for (Index k = 0; k < kPoints; ++k) {
        points.insert(points.end(),
                      {0.001f * static_cast<float>(k % 2), 0.006f * static_cast<float>(k), 0.0f});
    }
    return {std::move(points), {0, kPoints}};
}

struct Operator {
    std::string name;
    double target;
    std::function<void(Strands&, const Context&)> run;
    /// Work on each point, if it takes longer than its target.
    std::string bound_by = {};
};

std::vector<Operator> operators() {
    constexpr double kTarget = 6.0;
    CurlOptions curls;
    curls.points_per_turn = 0;
    curls.wavelength = 0.1;
    RotateOptions rotates;
    rotates.angle = 0.3;
    DisplaceOptions displaces;
    displaces.offset = {0.01, 0, 0};
    LengthOptions lengths;
    lengths.scale = 1.1;
    StrandCutOptions cuts;
    cuts.inside = inside_ellipsoid(Vec3::Zero(), {0.2, 0.2, 0.2});
    StrandTrimOptions trims;
    trims.factor = 0.8;
    PushOutOptions pushes;
    pushes.distance = [](const Vec3& p) { return p.norm() - 0.1; };
    BraidOptions braids;
    braids.spine = {{0, -0.05, 0}, {0, -0.5, 0}};
    braids.across = Vec3::UnitX();
    braids.reach = 1.0;
    BunOptions buns;
    buns.tie = {.center = {0, -0.05, 0}, .direction = -Vec3::UnitY(), .reach = 1.0};
    DetailOptions kinks;
    kinks.resample = false;
    const Strands kinked = kinked_strand();
    return {
        {"gather", kTarget, [](Strands& s, const Context& c) { gather(s, {}, c); }},
        {"twist", kTarget, [](Strands& s, const Context& c) { twist(s, {}, c); },
         "a sine, a cosine and a place on a guide at each point: half of its time"},
        {"pinch", kTarget, [](Strands& s, const Context& c) { pinch(s, {}, c); }},
        {"curl", kTarget, [=](Strands& s, const Context& c) { curl(s, curls, c); },
         "places along the course, 45 %, and frames, 35 %: each point waits for the one before"},
        {"frizz", kTarget, [](Strands& s, const Context& c) { frizz(s, {}, c); }},
        {"straighten", kTarget, [](Strands& s, const Context& c) { straighten(s, {}, c); }},
        {"rotate", kTarget, [=](Strands& s, const Context& c) { rotate(s, rotates, c); }},
        {"roll", kTarget, [](Strands& s, const Context& c) { roll(s, {}, c); }},
        {"puff", kTarget, [](Strands& s, const Context& c) { puff(s, {}, c); }},
        {"displace", kTarget, [=](Strands& s, const Context& c) { displace(s, displaces, c); }},
        {"set_length", kTarget, [=](Strands& s, const Context& c) { set_length(s, lengths, c); }},
        {"smooth", kTarget, [](Strands& s, const Context& c) { smooth(s, {}, c); }},
        {"clump", kTarget, [](Strands& s, const Context& c) { clump(s, {}, c); },
         "frames of guides at each point: half of its time"},
        {"noise", kTarget, [](Strands& s, const Context& c) { noise(s, {}, c); },
         "noise at each point, 35 %, and limits of turns, 30 %"},
        {"cut", kTarget, [=](Strands& s, const Context& c) { cut(s, cuts, c); }},
        {"trim", kTarget, [=](Strands& s, const Context& c) { trim(s, trims, c); }},
        {"detail", kTarget, [=](Strands& s, const Context& c) { add_detail(s, kinked, kinks, c); },
         "frames of courses, 25 %, and systems of five diagonals, 35 %"},
        {"braid", -1.0, [=](Strands& s, const Context& c) { braid(s, braids, c); }},
        {"bun", -1.0, [=](Strands& s, const Context& c) { bun(s, buns, c); }},
        {"push_out", -1.0, [=](Strands& s, const Context& c) { push_out(s, pushes, c); }},
    };
}

// Multiply-adds on all numbers in the vectors of any processor: the time of so much arithmetic.
constexpr int kOperations = 99;
void multiply_add(const float* from, float* to, std::size_t count) {
    constexpr std::size_t kAtOnce = 48;
    for (std::size_t i = 0; i + kAtOnce <= count; i += kAtOnce) {
        float values[kAtOnce];
        std::memcpy(values, from + i, sizeof(values));
        for (int k = 0; k < kOperations / 3; ++k) {
            for (float& value : values) value = 0.999f * value + 1e-4f;
        }
        std::memcpy(to + i, values, sizeof(values));
    }
}

void run(Report& report) {
    ContextOptions options;
    options.threads = 2;
    const Context context(options);
    Strands grown = hair_on_ball();
    assign_guides(grown, {.count = 400}, context);
    std::vector<float> copy(grown.points().size());
    const auto read_and_write = [&] {
        context.parallel_for(0, kStrands, 256, [&](Index begin, Index end) {
            const std::size_t first = 3 * at(grown.first_point(begin));
            const std::size_t last = 3 * at(grown.offsets()[at(end)]);
            std::memcpy(&copy[first], &grown.points()[first], (last - first) * sizeof(float));
        });
    };
    const auto calculate = [&] {
        context.parallel_for(0, kStrands, 256, [&](Index begin, Index end) {
            const std::size_t first = 3 * at(grown.first_point(begin));
            const std::size_t last = 3 * at(grown.offsets()[at(end)]);
            multiply_add(&grown.points()[first], &copy[first], last - first);
        });
    };
    report.title("100K strands of 32 points");
    if (report.wants("arithmetic")) {
        report.add_ratio(
            std::to_string(kOperations) + " multiply-adds a point / reading and writing",
            "memory on two threads", seconds_quotient(5, calculate, read_and_write));
    }
    for (const Operator& one : operators()) {
        if (!report.wants(one.name)) continue;
        const Quotient quotient = quotient_of(
            5,
            [&] {
                Strands strands = grown;
                return seconds([&] { one.run(strands, context); });
            },
            [&] { return seconds(read_and_write); });
        report.add({one.name, 1e3 * quotient.above, "ms"});
        report.add_ratio(one.name + " / reading and writing its points", "memory on two threads",
                         quotient, one.target, Better::less, one.bound_by);
    }
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
