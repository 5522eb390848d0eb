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
#include "kernel/thesis/fidelity.h"
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

    Merger prepared(MergeOptions options, bool find_intersections, const Context& context) const {
        const Mesh* targets[] = {&target.mesh};
        options.find_intersections = find_intersections;
        return Merger(source.mesh, targets, {join}, options, context);
    }
};

struct Times {
    // The whole merge against its two factorisations, of each repeat.
    std::vector<double> quotients;
    double whole = 1e9, again = 1e9, first_factor = 1e9, second_factor = 1e9;
    BoundaryTimes solve{1e9, 1e9, 1e9};
    Index free_vertices = 0, displaced = 0;
};

Times measure(Index vertices, int threads, const MergeOptions& how = {}) {
    const Task task(vertices);
    ContextOptions options;
    options.threads = threads;
    const Context context(options);
    Times times;
    for (int repeat = 0; repeat < 5; ++repeat) {
        auto start = Clock::now();
        const MergeResult result = task.prepared(how, true, context).solve(context);
        const double whole = milliseconds(start);
        times.whole = std::min(times.whole, whole);
        // As a tool does while a key is dragged.
        Merger merge = task.prepared(how, false, context);
        merge.set_keys(0, {task.key(repeat + 1)});
        start = Clock::now();
        merge.solve(context);
        times.again = std::min(times.again, milliseconds(start));
        const DeformStats& stats = result.report.deform;
        times.quotients.push_back(1e-3 * whole /
                                  (stats.first_factor_seconds + stats.second_factor_seconds));
        times.first_factor = std::min(times.first_factor, 1e3 * stats.first_factor_seconds);
        times.second_factor = std::min(times.second_factor, 1e3 * stats.second_factor_seconds);
        const BoundaryTimes& solve = result.report.deform_seconds;
        times.solve.first = std::min(times.solve.first, 1e3 * solve.first);
        times.solve.polar = std::min(times.solve.polar, 1e3 * solve.polar);
        times.solve.second = std::min(times.solve.second, 1e3 * solve.second);
        times.free_vertices = stats.free_vertices;
        times.displaced = stats.displaced_vertices;
    }
    return times;
}

/// A column of the thesis's Table 3.1: its mesh, and milliseconds on a 3.2 GHz Pentium IV.
struct ThesisColumn {
    const char* name;
    Index free_vertices, degenerate;
    double first_factor, first_solve, second_factor, second_solve, svd;
};
constexpr ThesisColumn kThesis[] = {{"feline (c)", 7733, 186, 593, 32, 203, 15, 125},
                                    {"CAD", 9050, 1839, 563, 31, 110, 15, 156},
                                    {"feline (a)", 9434, 206, 718, 32, 125, 16, 187},
                                    {"mannequin", 16219, 534, 1437, 62, 234, 32, 328},
                                    {"skull", 16982, 77, 1390, 62, 203, 31, 329}};

/// One row of a column: the thesis, its formulas here, our default.
void add_row(Report& report, const ThesisColumn& column, const char* what, double thesis,
             double same, double ours) {
    char text[160];
    std::snprintf(text, sizeof text, "    %-22s %8.2f   %8.3f   %8.3f", what, thesis, same, ours);
    report.line(text);
    const std::string name = std::string("as ") + column.name + ": " + what;
    report.add_to_json({name + ", thesis's way", same, "us/vertex"});
    report.add_to_json({name + ", default", ours, "us/vertex"});
}

void run_column(Report& report, const ThesisColumn& column) {
    const Index vertices = column.free_vertices * 4 / 3;
    const Times same = measure(vertices, 1, thesis_merge_options()), ours = measure(vertices, 1);
    char text[160];
    std::snprintf(text, sizeof text, "  %s: free vertices %d, %d, %d; degenerate %d, %d, %d",
                  column.name, column.free_vertices, same.free_vertices, ours.free_vertices,
                  column.degenerate, same.displaced, ours.displaced);
    report.line(text);
    const auto add = [&](const char* what, double thesis, double literal, double best) {
        add_row(report, column, what, 1e3 * thesis / column.free_vertices,
                1e3 * literal / same.free_vertices, 1e3 * best / ours.free_vertices);
    };
    add("factor (2.8)", column.first_factor, same.first_factor, ours.first_factor);
    add("solve (2.8)", column.first_solve, same.solve.first, ours.solve.first);
    add("factor (2.10/2.11)", column.second_factor, same.second_factor, ours.second_factor);
    add("solve (2.10/2.11)", column.second_solve, same.solve.second, ours.solve.second);
    add("polar decompositions", column.svd, same.solve.polar, ours.solve.polar);
}

/// Ours merges two cactuses of each column's size.
void run_table(Report& report) {
    report.title(
        "Table 3.1, microseconds a free vertex, one thread: the thesis, its formulas here, our "
        "default");
    for (const ThesisColumn& column : kThesis) run_column(report, column);
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
                             main_row ? 2.0 : -1.0, Better::less,
                             "the seam 44 % (its triangles made anew 14), factorisations 20, what "
                             "else prepares them 18, the solve 9");
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
