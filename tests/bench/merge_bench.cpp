/// Speed of merging: the thesis's Table 3.1 beside ours on meshes of its sizes, and the times of a
/// whole merge, of one whose key has moved, and of larger sources.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/merge/merge.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point start) {
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

/// A part with the boundary of its cut.
struct Part {
    Mesh mesh;
    Path boundary;
};

Part part_above(const Mesh& mesh, const Vec3& point, const Vec3& normal) {
    CutPlane plane;
    plane.point = point;
    plane.normal = normal;
    Cut parts = cut(mesh, plane);
    return {std::move(parts.kept.mesh), parts.lines.front().kept};
}

/// The upper part of a cactus, moved away, and the lower part of a coarser one.
struct Task {
    Part source, target;
    Join join;

    explicit Task(Index vertices)
        : source(cactus_part(vertices, Vec3::UnitY())),
          target(cactus_part(vertices / 2, -Vec3::UnitY())),
          join{source.boundary, target.boundary} {
        Affine move = rotation(Vec3(1, 2, 3), 2.0, Vec3::Zero());
        move.linear *= 7.0;
        transform(source.mesh, move);
        join.keys = {key(0)};
    }

    static Part cactus_part(Index vertices, const Vec3& normal) {
        CactusOptions options;
        options.vertices = vertices;
        const Mesh mesh = make_cactus(options);
        const Box box = bounds(mesh);
        return part_above(mesh, box.min + 0.25 * (box.max - box.min), normal);
    }

    /// The `step`-th vertex of the source's boundary on the same part of the target's.
    KeyPair key(int step) const {
        const std::vector<Index>&s = source.boundary.vertices(), &t = target.boundary.vertices();
        const double part = 0.02 * step;
        return {s[static_cast<std::size_t>(0.5 * static_cast<double>(s.size()))],
                t[static_cast<std::size_t>((0.3 + part) * static_cast<double>(t.size()))]};
    }

    Merge prepared(bool find_intersections, const Context& context) const {
        const Mesh* targets[] = {&target.mesh};
        MergeOptions options;
        options.find_intersections = find_intersections;
        return Merge(source.mesh, targets, {join}, options, context);
    }
};

struct Times {
    // The whole merge against its two factorisations, of each repeat.
    std::vector<double> quotients;
    double whole = 1e9, again = 1e9, first_factor = 1e9, second_factor = 1e9;
    Index free_vertices = 0, displaced = 0;
};

Times measure(Index vertices, int threads) {
    const Task task(vertices);
    ContextOptions options;
    options.threads = threads;
    const Context context(options);
    Times times;
    for (int repeat = 0; repeat < 5; ++repeat) {
        auto start = Clock::now();
        const MergeResult result = task.prepared(true, context).solve(context);
        const double whole = milliseconds(start);
        times.whole = std::min(times.whole, whole);
        // As a tool does while a key is dragged.
        Merge merge = task.prepared(false, context);
        merge.set_keys(0, {task.key(repeat + 1)});
        start = Clock::now();
        merge.solve(context);
        times.again = std::min(times.again, milliseconds(start));
        const DeformStats& stats = result.report.deform;
        times.quotients.push_back(1e-3 * whole /
                                  (stats.first_factor_seconds + stats.second_factor_seconds));
        times.first_factor = std::min(times.first_factor, 1e3 * stats.first_factor_seconds);
        times.second_factor = std::min(times.second_factor, 1e3 * stats.second_factor_seconds);
        times.free_vertices = stats.free_vertices;
        times.displaced = stats.displaced_vertices;
    }
    return times;
}

/// Free vertices and milliseconds that the thesis gives for its factorisations (Table 3.1).
struct ThesisRow {
    const char* name;
    Index free_vertices;
    double first_factor, second_factor;
};
constexpr ThesisRow kThesis[] = {{"feline (c)", 7733, 593, 203},
                                 {"CAD", 9050, 563, 110},
                                 {"feline (a)", 9434, 718, 125},
                                 {"mannequin", 16219, 1437, 234},
                                 {"skull", 16982, 1390, 203}};

void run_table(Report& report) {
    report.title("Table 3.1, microseconds a free vertex, thesis / ours at its size, one thread");
    for (const ThesisRow& row : kThesis) {
        const Times times = measure(row.free_vertices * 4 / 3, 1);
        const auto unit = [&](double ms, Index n) { return 1e3 * ms / n; };
        char text[160];
        std::snprintf(
            text, sizeof text,
            "  %-12s factor (2.8) %5.1f / %5.2f   factor (2.11) %5.1f / %5.2f   (%d free)",
            row.name, unit(row.first_factor, row.free_vertices),
            unit(times.first_factor, times.free_vertices),
            unit(row.second_factor, row.free_vertices),
            unit(times.second_factor, times.free_vertices), times.free_vertices);
        report.line(text);
        report.add_to_json({std::string("factor, as ") + row.name,
                            unit(times.first_factor, times.free_vertices), "us/vertex"});
    }
}

void run_merge(Report& report) {
    report.title("From loops to result");
    double smallest = 0.0;
    for (const Index vertices : {13500, 27000, 54000}) {
        for (const int threads : {1, 2}) {
            const Times times = measure(vertices, threads);
            const bool main_row = vertices == 13500 && threads == 1;
            const std::string name = std::to_string(times.free_vertices) + " free vertices, " +
                                     std::to_string(threads) +
                                     (threads == 1 ? " thread" : " threads");
            report.add({name, times.whole, "ms"});
            report.add({name + ", a key moved", times.again, "ms"});
            report.add_ratio(name + ": merge / its two factorisations", "factorisations",
                             {quantile(times.quotients, 0.5), quantile(times.quotients, 0.25),
                              quantile(times.quotients, 0.75)},
                             main_row ? 2.0 : -1.0);
            if (threads != 1) continue;
            const double each = 1e3 * times.whole / times.free_vertices;
            if (main_row) smallest = each;
            report.add({name + ", a vertex, of that at 10K", each / smallest, "x"});
        }
    }
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run_merge(report);
    lissom::bench::run_table(report);
    return 0;
}
