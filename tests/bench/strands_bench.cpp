// Operators on 100K strands of 32 points, each against reading and writing their bytes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/engine/lissom_hair.h"
#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_follow.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/guides/guide_set.h"
#include "kernel/hair/operators/strand_bend.h"
#include "kernel/hair/operators/strand_braid.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/operators/strand_curl.h"
#include "kernel/hair/operators/strand_cut.h"
#include "kernel/hair/operators/strand_detail.h"
#include "kernel/hair/operators/strand_frizz.h"
#include "kernel/hair/operators/strand_gather.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strand_clump.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_noise.h"
#include "kernel/hair/strands/strand_operators.h"
#include "kernel/hair/strands/strand_trim.h"
#include "kernel/io/hair/guide_file.h"
#include "kernel/mesh/shapes/head.h"
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
    kinks.refine = false;
    const Strands kinked = kinked_strand();
    return {
        {"gather", kTarget, [](Strands& s, const Context& c) { gather(s, {}, c); }},
        {"twist", kTarget, [](Strands& s, const Context& c) { twist(s, {}, c); }},
        {"pinch", kTarget, [](Strands& s, const Context& c) { pinch(s, {}, c); }},
        {"curl", kTarget, [=](Strands& s, const Context& c) { curl(s, curls, c); }},
        {"frizz", kTarget, [](Strands& s, const Context& c) { frizz(s, {}, c); }},
        {"straighten", kTarget, [](Strands& s, const Context& c) { straighten(s, {}, c); }},
        {"rotate", kTarget, [=](Strands& s, const Context& c) { rotate(s, rotates, c); }},
        {"roll", kTarget, [](Strands& s, const Context& c) { roll(s, {}, c); }},
        {"puff", kTarget, [](Strands& s, const Context& c) { puff(s, {}, c); }},
        {"displace", kTarget, [=](Strands& s, const Context& c) { displace(s, displaces, c); }},
        {"set_length", kTarget, [=](Strands& s, const Context& c) { set_length(s, lengths, c); }},
        {"smooth", kTarget, [](Strands& s, const Context& c) { smooth(s, {}, c); }},
        {"clump", kTarget, [](Strands& s, const Context& c) { clump(s, {}, c); }},
        {"noise", kTarget, [](Strands& s, const Context& c) { noise(s, {}, c); }},
        {"cut", kTarget, [=](Strands& s, const Context& c) { cut(s, cuts, c); }},
        {"trim", kTarget, [=](Strands& s, const Context& c) { trim(s, trims, c); }},
        {"detail", kTarget, [=](Strands& s, const Context& c) { add_detail(s, kinked, kinks, c); }},
        {"braid", -1.0, [=](Strands& s, const Context& c) { braid(s, braids, c); }},
        {"bun", -1.0, [=](Strands& s, const Context& c) { bun(s, buns, c); }},
        {"push_out", -1.0, [=](Strands& s, const Context& c) { push_out(s, pushes, c); }},
    };
}

// 100K strands of 16 points rebuilt by the engine's header, on two threads, against writing them.
void run_guides(Report& report, const Strands& hair, const Context& context) {
    const std::string name = "rebuild from guides";
    if (!report.wants(name)) return;
    const GuideSet set = make_guide_set(hair, {.count = 400, .points = 16}, context);
    const std::string bytes = encode_guides(set);
    std::vector<std::uint32_t> memory((bytes.size() + 3) / 4);
    std::memcpy(memory.data(), bytes.data(), bytes.size());
    lissom_hair open;
    require(lissom_hair_open(&open, memory.data(), bytes.size()) == LISSOM_HAIR_OK,
            "the guide file does not open");
    const std::size_t numbers = 3 * std::size_t{open.point_count};
    std::vector<float> guides(open.guides, open.guides + numbers * open.guide_count);
    std::vector<float> turns(3 * guides.size()), out(numbers * open.strand_count);
    for (std::size_t i = 0; i < guides.size(); ++i) guides[i] += 1e-3f * static_cast<float>(i % 7);
    lissom_hair_turns(&open, guides.data(), turns.data());
    const auto over_strands = [&](const auto& work) {
        return seconds([&] { context.parallel_for(0, kStrands, 512, work); });
    };
    const auto rebuild = [&](const float* turned) {
        return over_strands([&](Index begin, Index end) {
            lissom_hair_rebuild(&open, guides.data(), turned, static_cast<std::uint32_t>(begin),
                                static_cast<std::uint32_t>(end - begin),
                                out.data() + numbers * at(begin));
        });
    };
    const auto write = [&] {
        return over_strands([&](Index begin, Index end) {
            std::memset(out.data() + numbers * at(begin), 1,
                        numbers * at(end - begin) * sizeof(float));
        });
    };
    const auto add = [&](const std::string& row, const float* turned, double target) {
        const Quotient quotient = quotient_of(
            9, [&] { return rebuild(turned); }, write);
        report.add({row, 1e3 * quotient.above, "ms"});
        report.add_ratio(row + " / writing its points", "memory on two threads", quotient, target);
    };
    const int16_t* const details = open.details;
    open.details = nullptr;
    add(name, nullptr, 3.0);
    open.details = details;
    add(name + ", with details", nullptr, -1.0);
    add(name + ", with turned details", turns.data(), -1.0);
}

// 100K strands of 16 points, which lie over the scalp for a part of their way.
Strands hair_on_head(const Mesh& head, const Scalp& scalp, const Context& context) {
    constexpr Index kFollowPoints = 16;
    const std::vector<Root> roots = make_roots(head, scalp, {.count = kStrands}, context);
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (const Root& root : roots) {
        for (Index k = 0; k < kFollowPoints; ++k) {
            const double a = 0.25 * k / (kFollowPoints - 1);
            const Vec3 p =
                root.position + std::min(a, 0.03) * root.normal - Vec3(0, 2.0 * a * a, 0);
            for (const double x : p) points.push_back(static_cast<float>(x));
        }
        offsets.push_back(offsets.back() + kFollowPoints);
    }
    Strands hair(std::move(points), std::move(offsets));
    hair.set_roots(roots_on(head, roots));
    return hair;
}

Mesh leaning(Mesh head) {
    for (Vec3& p : head.edit_positions()) {
        const double up = std::clamp((p.y() + 0.14) / 0.14, 0.0, 1.0), angle = 0.4 * up * up;
        p = Vec3(p.x() * std::cos(angle) - p.y() * std::sin(angle),
                 p.x() * std::sin(angle) + p.y() * std::cos(angle), p.z());
    }
    return head;
}

// One frame of hair that follows its head, against writing its points.
void run_follow(Report& report, const Context& context) {
    const std::string name = "follow the head";
    if (!report.wants(name)) return;
    const Mesh head = make_head(), bent = leaning(head);
    const Strands hair = hair_on_head(head, Scalp(head), context);
    std::vector<float> out(hair.points().size());
    const auto write = [&] {
        return seconds([&] {
            context.parallel_for(0, kStrands, 512, [&](Index begin, Index end) {
                const std::size_t first = 3 * at(hair.first_point(begin));
                const std::size_t last = 3 * at(hair.offsets()[at(end)]);
                std::memset(&out[first], 1, (last - first) * sizeof(float));
            });
        });
    };
    const auto add = [&](const std::string& row, FollowCollision collision, double target) {
        FollowOptions options;
        options.collision = collision;
        std::optional<StrandFollower> follower;
        report.add({row + ", prepared",
                    1e3 * seconds([&] { follower.emplace(hair, head, options, context); }), "ms"});
        const Quotient quotient = quotient_of(
            5, [&] { return seconds([&] { follower->move(bent.positions(), out, context); }); },
            write);
        report.add({row, 1e3 * quotient.above, "ms"});
        report.add_ratio(row + " / writing its points", "memory on two threads", quotient, target);
    };
    report.title("100K strands of 16 points on a head of 10K vertices");
    add(name, FollowCollision::near, 8.0);
    add(name + ", free", FollowCollision::none, -1.0);
    add(name + ", exact", FollowCollision::all, -1.0);
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
    report.title("100K strands of 32 points");
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
                         quotient, one.target);
    }
    run_guides(report, grown, context);
    run_follow(report, context);
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
