// Hair for engines: 100K strands rebuilt from guides and following a head, each against writing
// their points; errors of guides, levels of detail and cards of 20K strands.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/engine/lissom_hair.h"
#include "kernel/core/error.h"
#include "kernel/core/large_pages.h"
#include "kernel/hair/dynamics/hair_dynamics.h"
#include "kernel/hair/follow/strand_follow.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/guides/guide_set.h"
#include "kernel/hair/levels/hair_levels.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/hair/guide_file.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr Index kStrands = 100000, kLevelStrands = 20000;

// Strands of 16 points, which lie over the scalp for a part of their way.
Strands hair_on_head(const Mesh& head, Index count, const Context& context) {
    constexpr Index kFollowPoints = 16;
    const std::vector<Root> roots = make_roots(head, Scalp(head), {.count = count}, context);
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

// 100K strands of 16 points rebuilt by the engine's header, on two threads, against writing them.
void run_guides(Report& report, const Strands& hair, const Context& context) {
    const std::string name = "rebuild from guides";
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

Mesh leaning(Mesh head) {
    for (Vec3& p : head.edit_positions()) {
        const double up = std::clamp((p.y() + 0.14) / 0.14, 0.0, 1.0), angle = 0.4 * up * up;
        p = Vec3(p.x() * std::cos(angle) - p.y() * std::sin(angle),
                 p.x() * std::sin(angle) + p.y() * std::cos(angle), p.z());
    }
    return head;
}

// One frame of hair that follows its head, against writing its points.
void run_follow(Report& report, const Mesh& head, const Strands& hair, const Context& context) {
    const std::string name = "follow the head";
    const Mesh bent = leaning(head);
    std::vector<float> out;
    out.reserve(hair.points().size());
    prefer_large_pages(out);
    out.resize(hair.points().size());
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

std::string level_name(const HairLevel& level) {
    if (level.kind == HairLevelKind::shell) return "shell";
    const bool cards = level.kind == HairLevelKind::cards;
    return std::to_string(cards ? count_of(level.cards.cards) : level.strands.size()) +
           (cards ? " cards" : " strands");
}

// The usual levels: their errors, and the time of all against drawing the silhouettes of the hair.
void run_levels(Report& report, const Strands& hair, const Context& context) {
    HairLevelOptions options = usual_hair_levels();
    options.width = 0.00026;
    std::vector<HairLevel> levels;
    Strands full = hair;
    StrandWidths widths;
    widths.common = static_cast<float>(options.width);
    full.set_widths(widths);
    const Quotient quotient = quotient_of(
        1, [&] { return seconds([&] { levels = make_hair_levels(hair, options, context); }); },
        [&] { return seconds([&] { HairSilhouette(full, {}, context); }); });
    report.title("20K strands of 16 points: parts of the silhouette that differ");
    for (const HairLevel& level : levels) {
        report.add({"silhouette of " + level_name(level), level.silhouette.mean, "of it"});
        if (level.kind != HairLevelKind::cards) continue;
        report.add({"points beside " + level_name(level), 1.0 - level.cards.covered, "of all"});
    }
    report.add({"seven levels, measured", quotient.above, "s"});
    report.add_ratio("seven levels, measured / drawing the silhouettes of the hair",
                     "sixteen pictures of all strands", quotient);
}

// A frame of hair in motion against rebuilding all strands behind it.
void run_dynamics(Report& report, const Mesh& head, const Strands& hair, const Context& context) {
    const Scalp scalp(head);
    const Vec3 center = scalp.unit() * scalp.frame().center;
    const BodyDistance ball = [&](const Vec3& p) { return (p - center).norm() - 0.09; };
    report.title("Dynamics of guides of 16 points, 20 steps a frame");
    for (const Index count : {200, 1000}) {
        const GuideSet set = make_guide_set(hair, {.count = count, .points = 16}, context);
        HairDynamics moving(make_hair_rig(set, {.body = ball}, context), ball, {}, context);
        const Quotient quotient = quotient_of(
            5, [&] { return seconds([&] { moving.step(1.0 / 30.0, context); }); },
            [&] {
                return seconds([&] { rebuild_strands(set, {.curves = set.curves}, context); });
            });
        const std::string row = "frame of " + std::to_string(count) + " guides";
        report.add({row, 1e3 * quotient.above, "ms"});
        report.add_ratio(row + " / rebuilding 100K strands", "the strands that follow them",
                         quotient);
    }
}

double mean_length(const Strands& hair) {
    double sum = 0.0;
    for (Index s = 0; s < hair.size(); ++s) sum += length(hair.strand(s));
    return sum / hair.size();
}

void run_guide_error(Report& report, const Strands& hair, const Context& context) {
    report.title("20K strands of 16 points, which are sums of three guides");
    for (const Index count : {100, 400}) {
        const GuideSet set = make_guide_set(hair, {.count = count, .points = 16}, context);
        report.add({"error of " + std::to_string(count) + " guides / length",
                    set.error.rms / mean_length(hair), "of it"});
    }
}

void run(Report& report) {
    ContextOptions options;
    options.threads = 2;
    const Context context(options);
    const Mesh head = make_head();
    if (report.wants("guides") || report.wants("follow") || report.wants("dynamics")) {
        const Strands hair = hair_on_head(head, kStrands, context);
        report.title("100K strands of 16 points");
        if (report.wants("guides")) run_guides(report, hair, context);
        if (report.wants("follow")) run_follow(report, head, hair, context);
        if (report.wants("dynamics")) run_dynamics(report, head, hair, context);
    }
    if (!report.wants("levels")) return;
    const Strands hair = hair_on_head(head, kLevelStrands, context);
    run_guide_error(report, hair, context);
    run_levels(report, hair, context);
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
