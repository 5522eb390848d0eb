/// Speed of deformation: the thesis's Table 2.1 beside ours, the frame times of a drag on the
/// armadillo on one and two threads, and CGAL on the same task.

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>

#include "kernel/deform/deformer.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/report.h"
#ifdef LISSOM_BENCH_CGAL
#include "tests/bench/cgal_deform.h"
#endif

namespace lissom::bench {
namespace {

/// A mesh with a handle at either end of its longest side.
struct Task {
    Mesh mesh;
    std::vector<Index> low, high;
    Vec3 axis = Vec3::UnitX(), center = Vec3::Zero();

    explicit Task(Mesh given, double share = 0.08) : mesh(std::move(given)) {
        const Box box = bounds(mesh);
        Index along = 0;
        const Vec3 extent = box.max - box.min;
        extent.maxCoeff(&along);
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const double t = (mesh.position(v)[along] - box.min[along]) / extent[along];
            if (t < share) low.push_back(v);
            if (t > 1.0 - share) high.push_back(v);
        }
        axis = Vec3::Unit((along + 1) % 3);
        for (const Index v : high) center += mesh.position(v) / static_cast<double>(high.size());
    }
    /// There and back between 29 and 86 degrees.
    Affine move(int frame) const {
        const int step = frame % 100;
        return turned(0.5 + 0.02 * (step < 50 ? step : 100 - step));
    }
    /// Beyond half a turn, where the field of turns has taken over.
    Affine far_move(int frame) const { return turned(3.3 + 0.02 * (frame % 50)); }
    Affine turned(double angle) const { return rotation(axis, angle, center); }
};

struct Times {
    double preprocess = 0, first_factor = 0, second_factor = 0, preview = 0, frame = 0, polar = 0;
    double solve = 0, far_frame = 0, basis_error = 0;
    Index free = 0, displaced = 0;
};

Context context_with(int threads) {
    ContextOptions options;
    options.threads = threads;
    return Context(options);
}

/// A frame is one of a drag; `solve` is what ends the drag.
Times time_deformer(const Task& task, const DeformOptions& options, int frames,
                    const Context& context = {}) {
    Times times;
    std::optional<Deformer> deformer;
    HandleId high;
    times.preprocess = seconds([&] {
        deformer.emplace(task.mesh, Region::all(task.mesh.shared_topology()), options, context);
        deformer->add_handle({task.mesh.shared_topology(), task.low});
        high = deformer->add_handle({task.mesh.shared_topology(), task.high});
        deformer->prepare(context);
    });
    int frame = 0;
    times.preview = median_seconds(4 * frames, [&] {
        deformer->set_transform(high, task.move(frame++));
        deformer->preview(context);
    });
    times.frame = median_seconds(frames, [&] {
        deformer->set_transform(high, task.move(frame++));
        deformer->solve_draft(context);
    });
    times.solve = median_seconds(std::min(frames, 9), [&] {
        deformer->set_transform(high, task.move(frame++));
        deformer->solve(context);
    });
    times.far_frame = median_seconds(std::min(frames, 9), [&] {
        deformer->set_transform(high, task.far_move(frame++));
        deformer->solve_draft(context);
    });
    const std::vector<Mat3> gradients = deformer->gradients();
    double sink = 0.0;
    times.polar = median_seconds(5, [&] {
        for (const Mat3& m : gradients) sink += nearest_rotation(m)(0, 0);
    });
    const DeformStats& stats = deformer->stats();
    times.first_factor = stats.first_factor_seconds;
    times.second_factor = stats.second_factor_seconds;
    times.free = sink != 0.0 ? stats.free_vertices : 0;
    times.displaced = stats.displaced_vertices;
    return times;
}

/// One column of the thesis's Table 2.1; seconds on a 3.2 GHz Pentium IV.
struct ThesisColumn {
    std::string name;
    std::string file;
    double free, factor_first, solve_first, factor_second, solve_second, svd;
};

const std::vector<ThesisColumn>& thesis_table() {
    static const std::vector<ThesisColumn> table{
        {"lion", "models/lion.off", 7903, .313, .015, .063, .016, .156},
        {"cactus", "models/cactus_cinolib.off", 8978, .359, .031, .078, .015, .172},
        {"dinosaur", "models/dinosaur.obj", 13252, .625, .031, .110, .015, .266},
        {"bar", "", 24480, 2.516, .109, .453, .032, .469},
        {"armadillo", "models/armadillo_43k.obj", 48027, 4.813, .188, .875, .078, .985},
        {"pegasus", "models/pegasus.obj", 54517, 6.594, .297, 1.016, .125, 1.156}};
    return table;
}

std::optional<Mesh> mesh_of(const ThesisColumn& column) {
    if (column.file.empty()) {
        BarOptions options;
        options.across = 36;
        options.along = 171;
        return make_bar(options);
    }
    const std::filesystem::path path = std::filesystem::path(LISSOM_BENCH_DATA) / column.file;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return load_mesh(path);
}

void run_table(Report& report) {
    report.title(
        "Table 2.1, microseconds per free vertex: the thesis, its formulation here, our default");
    for (const ThesisColumn& column : thesis_table()) {
        const std::optional<Mesh> mesh = mesh_of(column);
        if (!mesh) {
            report.title("  " + column.name + ": skipped, " + column.file + " is absent");
            continue;
        }
        const double share = column.file.empty() ? 1e-6 : 0.08;
        const Task task(*mesh, share);
        const Times literal = time_deformer(task, DeformOptions::thesis(), 9);
        const Times ours = time_deformer(task, {}, 9);
        const auto add = [&](const std::string& what, double thesis, double same, double best) {
            report.add({column.name + ": " + what + ", thesis", 1e6 * thesis / column.free, "us"});
            report.add(
                {column.name + ": " + what + ", thesis's way", 1e6 * same / literal.free, "us"});
            report.add({column.name + ": " + what + ", default", 1e6 * best / ours.free, "us"});
        };
        report.title("  " + column.name + ": " + std::to_string(ours.free) + " free vertices, " +
                     std::to_string(ours.displaced) + " degenerate (thesis's way " +
                     std::to_string(literal.displaced) + ")");
        add("factor Eq 2.8", column.factor_first, literal.first_factor, ours.first_factor);
        add("factor Eq 2.10", column.factor_second, literal.second_factor, ours.second_factor);
        add("drag, Eq 2.8", column.solve_first, literal.preview, ours.preview);
        add("polar decomposition", column.svd, literal.polar, ours.polar);
        add("full frame", column.solve_first + column.svd + column.solve_second, literal.frame,
            ours.frame);
    }
}

/// Greatest distance of the basis from a direct solve of the first system, in diagonals.
double basis_error(const Task& task) {
    Deformer deformer(task.mesh, Region::all(task.mesh.shared_topology()));
    deformer.add_handle({task.mesh.shared_topology(), task.low});
    const HandleId high = deformer.add_handle({task.mesh.shared_topology(), task.high});
    deformer.set_transform(high, task.move(0));
    const std::vector<Vec3> by_basis = deformer.preview();
    const std::vector<Vec3> directly = deformer.solve_first_directly();
    double worst = 0.0;
    for (std::size_t i = 0; i < by_basis.size(); ++i) {
        worst = std::max(worst, (by_basis[i] - directly[i]).norm());
    }
    return worst / bounds(task.mesh).diagonal();
}

/// The most memory this process had, or 0 where the system does not tell.
double peak_gigabytes() {
#if __has_include(<sys/resource.h>)
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / (1024.0 * 1024.0);
#else
    return 0.0;
#endif
}

/// What is to be reached, one and two threads: seconds, then milliseconds.
struct Targets {
    double preprocess[2], preview, frame[2], error;
};

Times run_size(Report& report, const Task& task, const Targets& targets, int frames) {
    const std::string name = "armadillo " + std::to_string(task.mesh.vertex_count() / 1000) + "K: ";
    Times first;
    for (const int threads : {1, 2}) {
        const std::string on = threads == 1 ? ", 1 thread" : ", 2 threads";
        const Times t = time_deformer(task, {}, frames, context_with(threads));
        if (threads == 1) first = t;
        report.add({name + "preprocess" + on, t.preprocess, "s", targets.preprocess[threads - 1]});
        report.add({name + "preview frame" + on, 1e3 * t.preview, "ms", targets.preview});
        report.add({name + "full frame" + on, 1e3 * t.frame, "ms", targets.frame[threads - 1]});
        report.add({name + "solve at the end of a drag" + on, 1e3 * t.solve, "ms"});
        report.add({name + "full frame beyond half a turn" + on, 1e3 * t.far_frame, "ms"});
    }
    report.add({name + "peak memory of the process", peak_gigabytes(), "GB", 4.5});
    if (targets.error > 0.0) {
        report.add(
            {name + "basis against direct solve", basis_error(task), "diagonals", targets.error});
    }
    return first;
}

#ifdef LISSOM_BENCH_CGAL
void run_cgal(Report& report, const Task& task, double ours) {
    const auto move = [&](int frame) { return task.move(frame); };
    const CgalTimes sre = time_cgal(task.mesh, CgalMethod::sre_arap, task.low, task.high, 5, move);
    const CgalTimes original =
        time_cgal(task.mesh, CgalMethod::original_arap, task.low, task.high, 5, move);
    const double frame = std::min(ours, time_deformer(task, {}, 21).frame);
    report.add({"armadillo: CGAL SRE_ARAP preprocess", sre.preprocess, "s"});
    report.add({"armadillo: CGAL SRE_ARAP frame", 1e3 * sre.frame, "ms"});
    report.add({"armadillo: CGAL ORIGINAL_ARAP preprocess", original.preprocess, "s"});
    report.add({"armadillo: CGAL ORIGINAL_ARAP frame", 1e3 * original.frame, "ms"});
    report.add(
        {"armadillo: CGAL SRE_ARAP frame / ours", sre.frame / frame, "x", 25.0, Better::more});
    report.add({"armadillo: CGAL ORIGINAL_ARAP frame / ours", original.frame / frame, "x"});
}
#endif

Mesh smoother(const Mesh& mesh) {
    SubdivideOptions options;
    options.scheme = SubdivisionScheme::loop;
    return subdivide(mesh, options);
}

/// About 5000 vertices around the tip of a mesh, with a handle in their middle.
double time_small_region(const Mesh& mesh, const Context& context, double* frame) {
    const Vec3 tip = bounds(mesh).max;
    std::vector<Index> nearest(static_cast<std::size_t>(mesh.vertex_count()));
    std::iota(nearest.begin(), nearest.end(), 0);
    const auto closer = [&](Index a, Index b) {
        return (mesh.position(a) - tip).squaredNorm() < (mesh.position(b) - tip).squaredNorm();
    };
    const std::size_t count = std::min<std::size_t>(5000, nearest.size());
    std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count) - 1,
                     nearest.end(), closer);
    nearest.resize(count);
    std::vector<Index> held = nearest;
    std::nth_element(held.begin(), held.begin() + 200, held.end(), closer);
    held.resize(200);
    const Region region(mesh.shared_topology(), nearest), handle(mesh.shared_topology(), held);
    std::optional<Deformer> deformer;
    HandleId id;
    const double preprocess = median_seconds(5, [&] {
        deformer.emplace(mesh, region, DeformOptions{}, context);
        id = deformer->add_handle(handle);
        deformer->prepare(context);
    });
    int step = 0;
    *frame = median_seconds(21, [&] {
        deformer->set_transform(id, rotation(Vec3::UnitZ(), 0.3 + 0.01 * step++, tip));
        deformer->solve_draft(context);
    });
    return preprocess;
}

/// The same region alone, and as part of a mesh of `whole`.
void run_small_region(Report& report, const Mesh& whole) {
    const Context context;
    double frame_in_large = 0.0, frame_alone = 0.0;
    const double in_large = time_small_region(whole, context, &frame_in_large);
    const Vec3 tip = bounds(whole).max;
    std::vector<Index> near(static_cast<std::size_t>(whole.vertex_count()));
    std::iota(near.begin(), near.end(), 0);
    std::nth_element(near.begin(), near.begin() + 5600, near.end(), [&](Index a, Index b) {
        return (whole.position(a) - tip).squaredNorm() < (whole.position(b) - tip).squaredNorm();
    });
    near.resize(5600);
    const Mesh part = extract(whole, Region(whole.shared_topology(), near)).mesh;
    const double alone = time_small_region(part, context, &frame_alone);
    const std::string name =
        "5K vertices of " + std::to_string(whole.vertex_count() / 1000) + "K: ";
    report.add({name + "preprocess", 1e3 * in_large, "ms"});
    report.add({name + "preprocess / that of a mesh of 5K", in_large / alone, "x", 1.5});
    report.add(
        {name + "full frame / that of a mesh of 5K", frame_in_large / frame_alone, "x", 1.5});
}

void run_armadillo(Report& report) {
    std::optional<Mesh> mesh = mesh_of(thesis_table()[4]);
    if (!mesh) {
        report.title("Armadillo: skipped, models/armadillo_43k.obj is absent");
        return;
    }
    report.title("Armadillo, both ends as handles; larger ones by Loop subdivision");
    const Task small(*mesh);
    const Times ours = run_size(report, small, {{1.0, 0.7}, 0.15, {10.0, 5.0}, 1e-11}, 41);
#ifdef LISSOM_BENCH_CGAL
    run_cgal(report, small, ours.frame);
#else
    report.title("  CGAL: skipped, it is not installed");
#endif
    *mesh = smoother(*mesh);
    run_size(report, Task(*mesh), {{4.0, 4.0}, 0.5, {45.0, 23.0}, 1e-11}, 15);
    *mesh = smoother(*mesh);
    run_size(report, Task(*mesh), {{25.0, 25.0}, 2.0, {190.0, 100.0}, 0.0}, 7);
    run_small_region(report, *mesh);
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run_armadillo(report);
    lissom::bench::run_table(report);
    return 0;
}
