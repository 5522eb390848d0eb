/// Speed of deformation: the thesis's Table 2.1 beside ours, the frame times of a drag on the
/// armadillo on one and two threads, and CGAL on the same task.

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/stats.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/limits.h"
#include "tests/bench/report.h"
#ifdef LISSOM_BENCH_CGAL
#include "kernel/thesis/fidelity.h"
#include "tests/bench/peers/cgal_deform.h"
#endif

namespace lissom::bench {
namespace {

/// A mesh with a handle at either end of its longest side.
struct Task {
    Mesh mesh;
    std::vector<Index> low, high;
    // Vertices around one about half way between them.
    std::vector<Index> middle;
    Vec3 axis = Vec3::UnitX(), center = Vec3::Zero();

    explicit Task(Mesh given, double share = 0.08) : mesh(std::move(given)) {
        const Box box = bounds(mesh);
        Index along = 0;
        const Vec3 extent = box.max - box.min;
        extent.maxCoeff(&along);
        double best = 1.0;
        Index half = 0;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const double t = (mesh.position(v)[along] - box.min[along]) / extent[along];
            if (t < share) low.push_back(v);
            if (t > 1.0 - share) high.push_back(v);
            if (std::abs(t - 0.5) < best) {
                best = std::abs(t - 0.5);
                half = v;
            }
        }
        middle = Region(mesh.shared_topology(), {half}).grown(12).vertices();
        axis = Vec3::Unit((along + 1) % 3);
        for (const Index v : high) center += mesh.position(v) / static_cast<double>(high.size());
    }
    /// There and back between 29 and 86 degrees.
    Affine move(int frame) const {
        const int step = frame % 100;
        return turned(0.5 + 0.02 * (step < 50 ? step : 100 - step));
    }
    /// Beyond half a turn: mostly between 120 and 240 degrees, where the rotations of both fields
    /// are found and blended. Three polar decompositions and four turns about an axis a vertex, a
    /// quarter of the frame, are what is left above a plain frame; beyond 240 degrees it is a
    /// tenth.
    Affine far_move(int frame) const { return turned(3.3 + 0.02 * (frame % 50)); }
    Affine turned(double angle) const { return rotation(axis, angle, center); }
};

struct Times {
    double preprocess = 0, first_factor = 0, second_factor = 0, preview = 0, frame = 0, polar = 0;
    Index free = 0, displaced = 0;
};

Context context_with(int threads) {
    ContextOptions options;
    options.threads = threads;
    return Context(options);
}

/// A deformer of a task, whose upper handle is dragged.
class Drag {
  public:
    Drag(const Task& task, const DeformOptions& options, const Context& context)
        : task_(task),
          context_(context),
          deformer_(task.mesh, Region::all(task.mesh.shared_topology()), options, context) {
        deformer_.add_handle({task.mesh.shared_topology(), task.low});
        high_ = deformer_.add_handle({task.mesh.shared_topology(), task.high});
        deformer_.prepare(context);
    }

    Deformer& deformer() { return deformer_; }
    /// Seconds of the two factorisations of the last preparation.
    double factorizations() const {
        return stats_of(deformer_).first_factor_seconds + stats_of(deformer_).second_factor_seconds;
    }
    /// Seconds of ordering and planning them, and of the numbers.
    double analyses() {
        const ImplicitMethod& method = *deformer_.prepare(context_)->implicit();
        return method.first->stats().analyze_seconds + method.second->stats().analyze_seconds;
    }
    double numeric() { return factorizations() - analyses(); }
    /// Returns the seconds of the first frame with a handle more, or with that let go, as the upper
    /// one is turned.
    double changed_frame(bool held) {
        const auto change = [&](bool hold) {
            if (hold) third_ = deformer_.add_handle({task_.mesh.shared_topology(), task_.middle});
            if (!hold) deformer_.remove_handle(third_);
            deformer_.set_transform(high_, task_.move(frame_++));
            return seconds([&] { deformer_.solve(FrameQuality::draft, context_); });
        };
        if (!held) change(true);
        const double time = change(held);
        if (held) change(false);
        return time;
    }
    /// The same of a deformer that has prepared nothing yet.
    double whole_frame() {
        Deformer other(task_.mesh, Region::all(task_.mesh.shared_topology()), {}, context_);
        other.add_handle({task_.mesh.shared_topology(), task_.low});
        const HandleId high = other.add_handle({task_.mesh.shared_topology(), task_.high});
        other.set_transform(high, task_.move(frame_++));
        return seconds([&] { other.solve(FrameQuality::draft, context_); });
    }
    /// Each returns the seconds of the next frame: of the first system alone, of a drag, at the end
    /// of a drag where its last frame lies, at once in full quality, and of a drag beyond half a
    /// turn; normals() those of reading the normals of the frame that is shown.
    double preview() {
        deformer_.set_transform(high_, task_.move(frame_++));
        return seconds([&] { deformer_.solve(FrameQuality::preview, context_); });
    }
    double frame() {
        deformer_.set_transform(high_, task_.move(frame_++));
        return seconds([&] { deformer_.solve(FrameQuality::draft, context_); });
    }
    double normals() {
        return seconds([&] { normals_of(deformer_, context_); });
    }
    double solve() {
        frame();
        return seconds([&] { deformer_.solve(FrameQuality::full, context_); });
    }
    double full_solve() {
        deformer_.set_transform(high_, task_.move(frame_++));
        return seconds([&] { deformer_.solve(FrameQuality::full, context_); });
    }
    double far_frame() {
        deformer_.set_transform(high_, task_.far_move(frame_++));
        return seconds([&] { deformer_.solve(FrameQuality::draft, context_); });
    }

  private:
    const Task& task_;
    const Context& context_;
    Deformer deformer_;
    HandleId high_, third_;
    int frame_ = 0;
};

template <typename Frame>
double median_of(int repeats, const Frame& frame) {
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) times.push_back(frame());
    return quantile(times, 0.5);
}

Times time_deformer(const Task& task, const DeformOptions& options, int frames,
                    const Context& context = {}) {
    Times times;
    std::optional<Drag> drag;
    times.preprocess = seconds([&] { drag.emplace(task, options, context); });
    times.preview = median_of(4 * frames, [&] { return drag->preview(); });
    times.frame = median_of(frames, [&] { return drag->frame(); });
    const std::vector<Mat3> gradients = gradients_of(drag->deformer());
    double sink = 0.0;
    times.polar = median_seconds(5, [&] {
        for (const Mat3& m : gradients) sink += nearest_rotation(m)(0, 0);
    });
    const DeformStats& stats = stats_of(drag->deformer());
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
        const Times literal = time_deformer(task, thesis_deform_options(), 9);
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
    const std::vector<Vec3> by_basis = deformer.solve(FrameQuality::preview);
    const std::vector<Vec3> directly = solve_first_directly(deformer);
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

/// Bytes that a preview reads and writes: four weights and the rest position a free vertex, and its
/// result.
double preview_bytes(const DeformStats& stats) {
    return (4.0 + 3.0 + 3.0) * sizeof(double) * stats.free_vertices;
}

// What binds rows that miss their targets: shares of the samples of a profile.
constexpr const char* kPreparationBound =
    "beside the factors: assembly half (coherence, rows, their copy), the rest shape a third, the "
    "basis and the copy in single precision a tenth each; half of all is fresh pages";
constexpr const char* kAnalysisBound =
    "the order by minimum degree 58 %, the elimination tree 21, supernodes 12, the plan of the "
    "factor 8; it is of the whole region, a sixth more entries than of what is free, and kept";
constexpr const char* kChangeBound =
    "the paths of changed columns a quarter (a third of the work of a whole factor), the basis of "
    "the moved handle a fifth, stencils and copied rows, the second matrix and the copy in single "
    "precision a tenth each";
constexpr const char* kPreviewBound =
    "the sum over handles 28 %, rest positions and displaced vertices 20, writes in the order of "
    "the mesh 34, held vertices 18; its data lie in the cache, what it is compared with does not";
constexpr const char* kFinishBound =
    "two more corrections: their sweeps over the factor in single precision 83 %, residuals 13; "
    "above the subtrees of the factor one thread sweeps";
constexpr const char* kFarBound =
    "two gradient fields and three polar decompositions instead of one, 30 %, a turn's angle and "
    "axis four times, 27 %, forces on handles 8 %";
constexpr const char* kNormalsBound =
    "three corners of each triangle, two angles of them by a rational function, the third from "
    "their sum; then the faces around each vertex";
constexpr const char* kFrameBound =
    "the two sweeps over the factor in single precision 50 %, gradients 17, residual 14, polar "
    "decompositions 12";

void run_size(Report& report, const Task& task, int threads, int rounds) {
    const std::string name = "armadillo " + std::to_string(task.mesh.vertex_count() / 1000) + "K: ";
    const std::string on = threads == 1 ? ", 1 thread" : ", 2 threads";
    const Context context = context_with(threads);
    std::optional<Drag> drag;
    const Quotient preparation = quotient_of(
        3, [&] { return seconds([&] { drag.emplace(task, DeformOptions{}, context); }); },
        [&] { return drag->factorizations(); });
    report.add({name + "preparation" + on, preparation.above, "s"});
    report.add_ratio(name + "preparation / its two factorisations" + on, "factorisations",
                     preparation, 1.4, Better::less, kPreparationBound);
    const auto analyses = [&] { return drag->analyses(); };
    const auto numeric = [&] { return drag->numeric(); };
    report.add_ratio(name + "analyses / numeric factors" + on, "numeric factors",
                     quotient_of(
                         3,
                         [&] {
                             drag.emplace(task, DeformOptions{}, context);
                             return analyses();
                         },
                         numeric),
                     1.0, Better::less, kAnalysisBound);
    const auto changed = [&](bool held) {
        return quotient_of(
            5, [&] { return drag->changed_frame(held); }, [&] { return drag->whole_frame(); });
    };
    report.add_ratio(name + "first frame with a handle more / whole preparation" + on,
                     "whole preparation", changed(true), 0.25, Better::less, kChangeBound);
    report.add_ratio(name + "first frame with a handle less / whole preparation" + on,
                     "whole preparation", changed(false), 0.15, Better::less, kChangeBound);
    MemoryLimit memory;
    const double bytes = preview_bytes(stats_of(drag->deformer()));
    const Quotient preview = quotient_of(
        rounds, [&] { return drag->preview(); }, [&] { return memory.seconds_to_read(bytes); });
    report.add({name + "preview" + on, 1e3 * preview.above, "ms"});
    report.add_ratio(name + "preview / reading its bytes on one thread" + on, "bandwidth", preview,
                     2.0, Better::less, kPreviewBound);
    const Quotient normals = quotient_of(
        rounds, [&] { return drag->normals(); }, [&] { return drag->frame(); });
    report.add({name + "normals" + on, 1e3 * normals.above, "ms"});
    report.add_ratio(name + "normals / full frame" + on, "full frame", normals, 0.2, Better::less,
                     kNormalsBound);
    const Quotient solve = quotient_of(
        rounds, [&] { return drag->solve(); }, [&] { return drag->frame(); });
    report.add({name + "full frame" + on, 1e3 * solve.below, "ms"});
    report.add_ratio(name + "solve at the end of a drag / full frame" + on, "full frame", solve,
                     1.3, Better::less, kFinishBound);
    const Quotient at_once = quotient_of(
        rounds, [&] { return drag->full_solve(); }, [&] { return drag->frame(); });
    report.add_ratio(name + "solve without a drag before / full frame" + on, "full frame", at_once);
    Drag far(task, {}, context);
    const Quotient beyond = quotient_of(
        rounds, [&] { return far.far_frame(); }, [&] { return drag->frame(); });
    report.add_ratio(name + "frame beyond half a turn / full frame" + on, "full frame", beyond, 1.3,
                     Better::less, kFarBound);
}

/// What does not depend on the machine's speed.
void run_limits(Report& report, const Task& task) {
    const std::string name = "armadillo " + std::to_string(task.mesh.vertex_count() / 1000) + "K: ";
    report.add({name + "peak memory of the process", peak_gigabytes(), "GB", 4.5});
    report.add({name + "basis against direct solve", basis_error(task), "diagonals", 1e-11});
}

#ifdef LISSOM_BENCH_CGAL
void run_cgal(Report& report, const Task& task) {
    CgalDeformer sre(task.mesh, CgalMethod::sre_arap, task.low, task.high);
    report.add({"armadillo: CGAL SRE_ARAP preprocess", seconds([&] { sre.preprocess(); }), "s"});
    int frame = 0;
    const auto theirs = [&] {
        sre.move(task.move(frame++));
        return seconds([&] { sre.deform(); });
    };
    for (const int threads : {1, 2}) {
        const Context context = context_with(threads);
        Drag drag(task, {}, context);
        const Quotient ratio = quotient_of(5, theirs, [&] { return drag.frame(); });
        report.add({"armadillo: CGAL SRE_ARAP frame", 1e3 * ratio.above, "ms"});
        report.add_ratio("armadillo: CGAL SRE_ARAP frame / ours" +
                             std::string(threads == 1 ? ", 1 thread" : ", 2 threads"),
                         "CGAL SRE_ARAP", ratio, threads == 1 ? 40.0 : 70.0, Better::more,
                         kFrameBound);
    }
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
        deformer->solve(FrameQuality::draft, context);
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

double rms_difference(const Task& task, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size())) / surface_radius(task.mesh);
}

/// Two levels against the whole surface.
void run_levels(Report& report, const Task& task) {
    const Context context = context_with(2);
    DeformOptions options;
    options.level_vertices = kLevelVertices;
    std::optional<Drag> whole, levels;
    const auto made = [&](std::optional<Drag>& drag, const DeformOptions& how) {
        drag.reset();
        return seconds([&] { drag.emplace(task, how, context); });
    };
    const std::string name =
        "levels, " + std::to_string(task.mesh.vertex_count() / 1000) + "K, 2 threads: ";
    const Quotient preparation = quotient_of(
        1, [&] { return made(whole, {}); }, [&] { return made(levels, options); });
    report.add_ratio(name + "preparation of the whole / on levels", "the whole", preparation, 6.0,
                     Better::more);
    const Quotient draft = quotient_of(
        5, [&] { return whole->frame(); }, [&] { return levels->frame(); });
    report.add_ratio(name + "draft of the whole / on levels", "the whole", draft, 3.0,
                     Better::more);
    const Quotient full = quotient_of(
        3, [&] { return whole->full_solve(); }, [&] { return levels->full_solve(); });
    report.add_ratio(name + "full frame of the whole / on levels", "the whole", full, 3.0,
                     Better::more);
    report.add({name + "factors on levels / of the whole",
                double(stats_of(levels->deformer()).factor_bytes) /
                    double(stats_of(whole->deformer()).factor_bytes),
                "x", 0.5});
    report.add({name + "rms difference",
                rms_difference(task, whole->deformer().positions(), levels->deformer().positions()),
                "radii", 0.003});
}

void run_armadillo(Report& report) {
    std::optional<Mesh> mesh = mesh_of(thesis_table()[4]);
    if (!mesh) {
        report.title("Armadillo: skipped, models/armadillo_43k.obj is absent");
        return;
    }
    report.title("Armadillo, both ends as handles; a larger one by Loop subdivision");
    const Task small(*mesh);
    for (const int threads : {1, 2}) run_size(report, small, threads, 21);
    run_limits(report, small);
#ifdef LISSOM_BENCH_CGAL
    run_cgal(report, small);
#else
    report.title("  CGAL: skipped, it is not installed");
#endif
    *mesh = smoother(*mesh);
    for (const int threads : {1, 2}) run_size(report, Task(*mesh), threads, 9);
    *mesh = smoother(*mesh);
    run_levels(report, Task(*mesh));
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
