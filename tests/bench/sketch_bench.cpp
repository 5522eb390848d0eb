/// Speed of sketching: hair that follows a hand, and of picking: a search tree that is refitted
/// against one that is built again, and picks, on the armadillo and on 16 times its faces.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/sketch/picking.h"
#include "kernel/sketch/screen_select.h"
#include "tests/bench/report.h"
#include "tests/bench/sketch_hair.h"

namespace lissom::bench {
namespace {

Mesh test_mesh() {
    const std::filesystem::path path = LISSOM_BENCH_DATA "/models/armadillo_43k.obj";
    return std::filesystem::exists(path) ? load_mesh(path) : make_cactus({.vertices = 43000});
}

/// The mesh with its upper part twisted, as in a drag.
Mesh twisted(const Mesh& mesh) {
    Mesh result = mesh;
    const Box box = bounds(mesh);
    for (Vec3& p : result.edit_positions()) {
        const double part = (p.y() - box.min.y()) / (box.max.y() - box.min.y());
        p = rotation(Vec3::UnitY(), part * kPi / 2, box.center())(p);
    }
    return result;
}

struct Cursors {
    View view;
    std::vector<Vec2> places;
};

/// Pixels of a grid over the picture of a mesh as large as the picture.
Cursors cursors_over(const Mesh& mesh) {
    Cursors cursors{{frame_points(StandardView::front, mesh.positions()), {1280, 960}}, {}};
    for (int i = 0; i < 30; ++i) {
        for (int k = 0; k < 30; ++k) cursors.places.emplace_back(43.0 * i, 32.0 * k);
    }
    return cursors;
}

/// Times of the picks that hit; of three tries the fastest, so that what else the machine does is
/// left out.
void run_picks(Report& report, const std::string& what, const PickScene& scene,
               const Cursors& cursors, PickKind kind) {
    std::vector<double> times;
    for (const Vec2& cursor : cursors.places) {
        bool hit = false;
        double least = 1.0;
        for (int i = 0; i < 3; ++i) {
            least =
                std::min(least, seconds([&] {
                             hit = pick(scene, cursors.view, cursor, {.kinds = {kind}}).has_value();
                         }));
        }
        if (hit) times.push_back(least);
    }
    report.add({"pick: " + what + ", of " + std::to_string(times.size()),
                1e6 * quantile(times, 0.5), "us"});
    report.add({"pick: " + what + ", 95 in 100 within", 1e6 * quantile(times, 0.95), "us"});
    report.add({"pick: " + what + ", the slowest", 1e6 * quantile(times, 0.9999), "us", 1000.0});
}

void run_mesh(Report& report, const Mesh& mesh, int repeats) {
    report.title(std::to_string(mesh.face_count()) + " faces");
    const Mesh bent = twisted(mesh);
    SpatialTree tree(mesh);
    bool back = false;
    const Quotient refit = seconds_quotient(
        repeats, [&] { SpatialTree{bent}; },
        [&] {
            tree.refit(back ? mesh : bent);
            back = !back;
        });
    report.add({"building a tree", 1e3 * refit.above, "ms"});
    report.add({"refitting it", 1e3 * refit.below, "ms"});
    report.add_ratio("building a tree / refitting it", "building", refit, 15.0, Better::more);
    tree.refit(bent);
    report.add({"wear of the refitted tree", tree.wear(), "x"});

    const Cursors cursors = cursors_over(bent);
    PickScene scene;
    scene.add(tree);
    run_picks(report, "faces", scene, cursors, PickKind::face);
    run_picks(report, "vertices", scene, cursors, PickKind::vertex);
    run_picks(report, "edges", scene, cursors, PickKind::edge);
    const SpatialTree built(bent);
    PickScene rebuilt;
    rebuilt.add(built);
    const auto pick_all_of = [&](const PickScene& from) {
        return [&] {
            for (const Vec2& cursor : cursors.places) (void)pick(from, cursors.view, cursor);
        };
    };
    report.add_ratio("picks in the refitted tree / in a new one", "a new tree",
                     seconds_quotient(11, pick_all_of(scene), pick_all_of(rebuilt)));
    const std::vector<Vec2> stroke{{640, 480}, {650, 484}};
    report.add({"a brush of 20 pixels moved by 10",
                1e3 * median_seconds(
                          21, [&] { (void)select_brush(scene, cursors.view, {.stroke = stroke}); }),
                "ms"});
    report.add({"a rectangle over all of the picture",
                1e3 * median_seconds(3,
                                     [&] {
                                         (void)select_rectangle(scene, cursors.view, Vec2(0, 0),
                                                                Vec2(1280, 960));
                                     }),
                "ms"});
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run_sketched_hair(report);
    const lissom::Mesh mesh = lissom::bench::test_mesh();
    lissom::bench::run_mesh(report, mesh, 11);
    lissom::bench::run_mesh(
        report, subdivide(mesh, {.levels = 2, .scheme = lissom::SubdivisionScheme::loop}), 3);
    return 0;
}
