/// Speed of deformation: the thesis's Table 2.1 beside ours, the frame times of a drag on the
/// armadillo, and CGAL on the same task. One thread.

#include <filesystem>
#include <optional>
#include <string>

#include "kernel/deform/deformer.h"
#include "kernel/deform/polar.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/measures.h"
#include "kernel/mesh/shapes.h"
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
    Affine move(int frame) const { return rotation(axis, 0.5 + 0.02 * frame, center); }
};

struct Times {
    double preprocess = 0, first_factor = 0, second_factor = 0, preview = 0, frame = 0, polar = 0;
    Index free = 0, displaced = 0;
};

Times time_deformer(const Task& task, const DeformOptions& options, int frames) {
    Times times;
    std::optional<Deformer> deformer;
    HandleId high;
    times.preprocess = seconds([&] {
        deformer.emplace(task.mesh, Region::all(task.mesh.shared_topology()), options);
        deformer->add_handle({task.mesh.shared_topology(), task.low});
        high = deformer->add_handle({task.mesh.shared_topology(), task.high});
        deformer->prepare();
    });
    int frame = 0;
    times.preview = median_seconds(4 * frames, [&] {
        deformer->set_transform(high, task.move(frame++));
        deformer->preview();
    });
    times.frame = median_seconds(frames, [&] {
        deformer->set_transform(high, task.move(frame++));
        deformer->solve();
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

void run_armadillo(Report& report) {
    const std::optional<Mesh> mesh = mesh_of(thesis_table()[4]);
    if (!mesh) {
        report.title("Armadillo: skipped, models/armadillo_43k.obj is absent");
        return;
    }
    const Task task(*mesh);
    report.title("Armadillo, both ends as handles, one thread");
    const Times ours = time_deformer(task, {}, 41);
    report.add({"armadillo: free vertices", static_cast<double>(ours.free), ""});
    report.add({"armadillo: preprocess", ours.preprocess, "s", 1.5});
    report.add({"armadillo: preview frame", 1e3 * ours.preview, "ms", 0.3});
    report.add({"armadillo: full frame", 1e3 * ours.frame, "ms", 25.0});
#ifdef LISSOM_BENCH_CGAL
    const auto move = [&](int frame) { return task.move(frame); };
    const CgalTimes sre = time_cgal(*mesh, CgalMethod::sre_arap, task.low, task.high, 5, move);
    const CgalTimes original =
        time_cgal(*mesh, CgalMethod::original_arap, task.low, task.high, 5, move);
    const Times again = time_deformer(task, {}, 21);
    const double frame = std::min(ours.frame, again.frame);
    report.add({"armadillo: CGAL SRE_ARAP preprocess", sre.preprocess, "s"});
    report.add({"armadillo: CGAL SRE_ARAP frame", 1e3 * sre.frame, "ms"});
    report.add({"armadillo: CGAL ORIGINAL_ARAP preprocess", original.preprocess, "s"});
    report.add({"armadillo: CGAL ORIGINAL_ARAP frame", 1e3 * original.frame, "ms"});
    report.add(
        {"armadillo: CGAL SRE_ARAP frame / ours", sre.frame / frame, "x", 10.0, Better::more});
    report.add({"armadillo: CGAL ORIGINAL_ARAP frame / ours", original.frame / frame, "x"});
#else
    report.title("  CGAL: skipped, it is not installed");
#endif
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run_armadillo(report);
    lissom::bench::run_table(report);
    return 0;
}
