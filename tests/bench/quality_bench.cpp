/// Quality of deformation: what each of our methods and each of CGAL's energies does to the shape
/// of a bar and of the armadillo; parts that run through one another; blends of poses.
///
///     bench_quality [--part=shape|contacts|poses] [--case=TEXT] [--full] [--pictures=FOLDER]
///                   [--json]
///
/// --part: one of the three. --case: only cases of shape whose name contains TEXT. --full: smaller
/// regions of the armadillo, CGAL with 50 iterations on it, and the thesis's comparison methods.
/// --pictures: saves every result as FOLDER/CASE__METHOD.ply; quality/pictures.lua renders them.
/// Rotations beyond 180 degrees are dragged there in steps, by all methods; all others are asked
/// for at once, from the rest shape.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/io/mesh_file.h"
#include "kernel/thesis/comparison/methods.h"
#include "tests/bench/quality/contact_rows.h"
#include "tests/bench/quality/measure.h"
#include "tests/bench/quality/pose_rows.h"
#include "tests/bench/quality/scenes.h"
#include "tests/bench/report.h"
#ifdef LISSOM_BENCH_CGAL
#include "tests/bench/peers/cgal_deform.h"
#endif

namespace lissom::bench {
namespace {

struct Arguments {
    std::string only;
    std::filesystem::path pictures;
    bool full = false;

    Arguments(int argc, char** argv) {
        for (int i = 1; i < argc; ++i) {
            const std::string_view argument = argv[i];
            if (argument.starts_with("--case=")) only = argument.substr(7);
            if (argument.starts_with("--pictures=")) pictures = argument.substr(11);
            full = full || argument == "--full";
        }
    }
};

/// The best of ours, and the rival it is measured against.
constexpr const char* kBest = "blend, refine 2";
constexpr const char* kRival = "CGAL SPOKES_AND_RIMS, default";

/// One of our methods: options of a deformer, and whether its first system is enough.
struct Method {
    std::string name;
    DeformOptions options;
    bool preview = false;
};

std::vector<Method> our_methods() {
    std::vector<Method> methods;
    methods.push_back({"first system only", {}, true});
    const auto add = [&](const std::string& name, SecondSystem second, int refine) {
        DeformOptions options;
        options.second = second;
        options.refine = refine;
        methods.push_back({name, options, false});
    };
    add("laplacian", SecondSystem::laplacian, 0);
    add("poisson", SecondSystem::poisson, 0);
    add("blend, the default", SecondSystem::blend, 0);
    add("blend, refine 1", SecondSystem::blend, 1);
    add(kBest, SecondSystem::blend, 2);
    add("poisson, refine 2", SecondSystem::poisson, 2);
    return methods;
}

/// The thesis's comparison methods; those with frames know no positions of handles to follow.
std::vector<Method> comparison_methods() {
    std::vector<Method> methods;
    const auto add = [&](const std::string& name, DeformMethod method) {
        methods.push_back({name, compared_by(method), false});
    };
    add("method naive", DeformMethod::naive);
    add("method rotation_estimate", DeformMethod::rotation_estimate);
    add("method similarity", DeformMethod::similarity);
    add("method geodesic", DeformMethod::geodesic);
    add("method harmonic", DeformMethod::harmonic);
    add("method frames", DeformMethod::frames);
    return methods;
}

/// The cases that the target of lower energy on the bar counts.
constexpr const char* kCountedBars[] = {"bar twist 90", "bar twist 135", "bar twist 170",
                                        "bar bend 135", "bar sideways"};

/// All results, by case and method.
using Results = std::map<std::string, std::map<std::string, Quality>>;

class Harness {
  public:
    Harness(const Arguments& arguments, Report& report) : arguments_(arguments), report_(report) {
        if (!arguments.pictures.empty()) std::filesystem::create_directories(arguments.pictures);
    }

    void run(QualityScene scene) {
        scene.moves.erase(std::remove_if(scene.moves.begin(), scene.moves.end(),
                                         [&](const Move& move) {
                                             return name_of(scene, move).find(arguments_.only) ==
                                                    std::string::npos;
                                         }),
                          scene.moves.end());
        if (scene.moves.empty()) return;
        const QualityMeasure measure(scene.mesh, scene.held());
        for (const Method& method : our_methods()) run_ours(scene, measure, method);
        for (const Method& method : comparison_methods()) {
            if (arguments_.full) run_ours(scene, measure, method);
        }
        run_rivals(scene, measure);
        for (const Move& move : scene.moves) print(scene, name_of(scene, move));
    }

    const Results& results() const { return results_; }

  private:
    static std::string name_of(const QualityScene& scene, const Move& move) {
        return scene.name + " " + move.name;
    }

    void run_ours(const QualityScene& scene, const QualityMeasure& measure, const Method& method) {
        const auto topology = scene.mesh.shared_topology();
        Deformer deformer(scene.mesh, Region::all(topology), method.options);
        deformer.add_handle({topology, scene.still});
        const HandleId moved = deformer.add_handle({topology, scene.moved});
        for (const Move& move : scene.moves) {
            deformer.reset();
            for (int step = 1; step <= move.steps(); ++step) {
                deformer.set_transform(moved, move.at(static_cast<double>(step) / move.steps()));
                if (method.preview) {
                    deformer.solve(FrameQuality::preview);
                } else {
                    deformer.solve();
                }
            }
            record(scene, move, method.name, measure, deformer.positions());
        }
    }

    void run_rivals(const QualityScene& scene, const QualityMeasure& measure) {
#ifdef LISSOM_BENCH_CGAL
        const bool small = scene.name == "bar";
        const std::pair<const char*, CgalMethod> rivals[] = {
            {"CGAL ORIGINAL_ARAP", CgalMethod::original_arap},
            {"CGAL SPOKES_AND_RIMS", CgalMethod::spokes_and_rims},
            {"CGAL SRE_ARAP", CgalMethod::sre_arap}};
        for (const auto& [name, method] : rivals) {
            CgalDeformer deformer(scene.mesh, method, scene.still, scene.moved);
            deformer.preprocess();
            for (const Move& move : scene.moves) {
                deformer.reset();
                drag(deformer, move, 0);
                record(scene, move, std::string(name) + ", default", measure, deformer.positions());
                if (!small && !arguments_.full) continue;
                deformer.reset();
                drag(deformer, move, 50);
                record(scene, move, std::string(name) + ", 50", measure, deformer.positions());
            }
        }
#else
        (void)scene, (void)measure;
#endif
    }

#ifdef LISSOM_BENCH_CGAL
    // Where the drag has steps, each runs all iterations; 0 is CGAL's default.
    static void drag(CgalDeformer& deformer, const Move& move, int iterations) {
        for (int step = 1; step <= move.steps(); ++step) {
            deformer.move(move.at(static_cast<double>(step) / move.steps()));
            if (iterations > 0) {
                deformer.deform(iterations);
            } else {
                deformer.deform();
            }
        }
    }
#endif

    void record(const QualityScene& scene, const Move& move, const std::string& method,
                const QualityMeasure& measure, const std::vector<Vec3>& positions) {
        const std::string name = name_of(scene, move);
        results_[name][method] = measure.of(positions);
        order_[name].push_back(method);
        if (arguments_.pictures.empty()) return;
        std::string file = name + "__" + method + ".ply";
        std::replace(file.begin(), file.end(), ' ', '_');
        file.erase(std::remove(file.begin(), file.end(), ','), file.end());
        Mesh mesh = scene.mesh;
        mesh.set_positions(positions);
        save_mesh(mesh, arguments_.pictures / file);
    }

    void print(const QualityScene& scene, const std::string& name) {
        report_.title(name + ": " +
                      std::to_string(scene.mesh.vertex_count() - scene.held().size()) +
                      " free vertices of " + std::to_string(scene.mesh.vertex_count()));
        report_.line(
            "                                    energy      anisotropy             volume"
            "   crease, degrees");
        report_.line(
            "                                    x 1000    p50    p99      max             "
            "    p99      max");
        for (const std::string& method : order_[name]) {
            const Quality& q = results_[name][method];
            char line[200];
            std::snprintf(line, sizeof line, "  %-31s %9.3f %6.3f %6.2f %8.4g %9.4f %8.2f %8.2f",
                          method.c_str(), 1e3 * q.energy, q.anisotropy_median, q.anisotropy_p99,
                          q.anisotropy_max, q.volume, q.crease_p99, q.crease_max);
            report_.line(line);
            const std::string prefix = name + ", " + method + ": ";
            report_.add_to_json({prefix + "energy", q.energy, ""});
            report_.add_to_json({prefix + "anisotropy p50", q.anisotropy_median, ""});
            report_.add_to_json({prefix + "anisotropy p99", q.anisotropy_p99, ""});
            report_.add_to_json({prefix + "anisotropy max", q.anisotropy_max, ""});
            report_.add_to_json({prefix + "volume", q.volume, ""});
            report_.add_to_json({prefix + "crease p99", q.crease_p99, "degrees"});
            report_.add_to_json({prefix + "crease max", q.crease_max, "degrees"});
        }
    }

    const Arguments& arguments_;
    Report& report_;
    Results results_;
    std::map<std::string, std::vector<std::string>> order_;
};

// One line a case: the best of ours against CGAL's default.
void compare(const Results& results, Report& report) {
    report.title(std::string(kBest) + " against " + kRival);
    int bars = 0, lower = 0;
    for (const auto& [name, methods] : results) {
        const auto ours = methods.find(kBest), rival = methods.find(kRival);
        if (ours == methods.end() || rival == methods.end()) continue;
        const Quality &a = ours->second, &b = rival->second;
        const double energy = a.energy / b.energy;
        const bool on_bar = name.rfind("bar", 0) == 0;
        report.add({name + ": energy / CGAL's", energy, "x", on_bar ? -1.0 : 1.0});
        report.add({name + ": greatest anisotropy / CGAL's", a.anisotropy_max / b.anisotropy_max,
                    "x", 1.0});
        report.add({name + ": crease at handles, p99", a.crease_p99, "degrees", 5.0});
        if (std::find(std::begin(kCountedBars), std::end(kCountedBars), name) ==
            std::end(kCountedBars)) {
            continue;
        }
        ++bars;
        lower += energy < 1.0 ? 1 : 0;
    }
    if (bars < 5) return;
    report.add({"bar, of twist 90, 135, 170, bend 135, sideways: lower energy",
                static_cast<double>(lower), "of 5", 4.0, Better::more});
}

void add_shape_rows(const Arguments& arguments, Report& report, const Mesh* armadillo) {
    Harness harness(arguments, report);
    harness.run(bar_scene());
    if (armadillo) {
        harness.run(arm_scene(*armadillo));
        harness.run(body_scene(*armadillo));
    }
    if (armadillo && arguments.full) {
        harness.run(small_arm_scene(*armadillo));
        harness.run(waist_scene(*armadillo));
    }
    compare(harness.results(), report);
}

std::vector<QualityScene> posed_scenes(const Mesh* armadillo) {
    std::vector<QualityScene> scenes{bar_scene()};
    if (armadillo) {
        scenes.push_back(arm_scene(*armadillo));
        scenes.push_back(body_scene(*armadillo));
    }
    return scenes;
}

std::optional<Mesh> load_armadillo(const Report& report) {
    const auto path = std::filesystem::path(LISSOM_BENCH_DATA) / "models" / "armadillo_43k.obj";
    if (std::filesystem::exists(path)) return load_mesh(path);
    report.title("Armadillo: skipped, models/armadillo_43k.obj is absent");
    return std::nullopt;
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    using namespace lissom::bench;
    const Arguments arguments(argc, argv);
    Report report(argc, argv);
    const std::optional<lissom::Mesh> loaded = load_armadillo(report);
    const lissom::Mesh* const armadillo = loaded ? &*loaded : nullptr;
    if (report.wants("shape")) add_shape_rows(arguments, report, armadillo);
    if (report.wants("contacts")) add_contact_rows(report, armadillo);
    if (report.wants("poses")) add_pose_rows(report, posed_scenes(armadillo));
    return 0;
}
