/// Speed of pasting and of what it stands on: the search for a boundary beside the thesis's minute,
/// a part that follows the mouse, maps of disks and rings into the plane beside CGAL's, points
/// found there, and holes closed with the least area.
///
///     bench_paste [--part=search|move|maps|holes] [--json]

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/free_loop.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/paste/search/paste_energy.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/fill/minimum_area.h"
#include "kernel/mesh/parameterize/parameterize.h"
#include "kernel/mesh/parameterize/uv_grid.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/report.h"
#include "tests/unit/merge/paste/paste_shapes.h"

#ifdef LISSOM_BENCH_CGAL
#include "tests/bench/peers/cgal_parameterize.h"
#endif

namespace lissom::bench {
namespace {

/// Triangles over a square with hills, about `vertices` of them.
Mesh hills(double vertices) {
    const auto segments = static_cast<Index>(std::sqrt(vertices)) - 1;
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {segments, segments}});
    for (Vec3& p : mesh.edit_positions()) {
        p.y() =
            0.25 * std::sin(4.0 * p.x()) * std::cos(3.0 * p.z()) + 0.05 * std::sin(17.0 * p.x());
    }
    triangulate(mesh);
    return mesh;
}

/// The hills without their middle.
Mesh ring(double vertices) {
    const Mesh mesh = hills(vertices / (1.0 - kPi * 0.04));
    std::vector<Index> middle;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.position(v);
        if (std::hypot(p.x(), p.z()) < 0.4) middle.push_back(v);
    }
    return remove(mesh, Region(mesh.shared_topology(), middle)).mesh;
}

Parameterization lay_out(const Mesh& mesh, ParameterizeMethod method) {
    return parameterize(mesh, Region::all(mesh.shared_topology()), {.method = method});
}

double milliseconds_of(const Mesh& mesh, ParameterizeMethod method, int repeats) {
    return 1e3 * median_seconds(repeats, [&] { (void)lay_out(mesh, method); });
}

void run_maps(Report& report, const std::string& what, const Mesh& mesh, int repeats) {
    const std::string name = what + " of " + std::to_string(mesh.vertex_count()) + " vertices";
    report.title(name);
    report.add({"lscm: " + name, milliseconds_of(mesh, ParameterizeMethod::lscm, repeats), "ms"});
    report.add(
        {"lscm and arap: " + name, milliseconds_of(mesh, ParameterizeMethod::arap, repeats), "ms"});
    report.add(
        {"onto a disk: " + name, milliseconds_of(mesh, ParameterizeMethod::tutte, repeats), "ms"});
}

void run_rival([[maybe_unused]] Report& report, [[maybe_unused]] const Mesh& mesh,
               [[maybe_unused]] int repeats) {
#ifdef LISSOM_BENCH_CGAL
    CgalParameterizer rival(mesh);
    const Quotient quotient = seconds_quotient(
        repeats, [&] { (void)lay_out(mesh, ParameterizeMethod::lscm); },
        [&] { (void)rival.lay_out(); });
    const std::string size = std::to_string(mesh.vertex_count()) + " vertices";
    report.add({"CGAL's lscm, two vertices pinned: " + size, 1e3 * quotient.below, "ms"});
    report.add_ratio("spectral lscm / CGAL's lscm: " + size, "CGAL", quotient, 1.0);
#endif
}

void run_grid(Report& report, const Mesh& mesh) {
    const Parameterization map = lay_out(mesh, ParameterizeMethod::arap);
    report.title("points in a ring of " + std::to_string(mesh.vertex_count()) + " vertices");
    report.add({"building the grid",
                1e3 * median_seconds(21,
                                     [&] {
                                         UvGrid{map.uv, map.surface_triangles()};
                                     }),
                "ms"});
    const UvGrid grid(map.uv, map.surface_triangles());
    report.add({"finding the points of all vertices",
                1e3 * median_seconds(21,
                                     [&] {
                                         for (const Vec2& p : map.uv) {
                                             (void)grid.locate(p);
                                         }
                                     }),
                "ms"});
}

void run_fill(Report& report, Index points) {
    std::vector<Vec3> loop;
    for (Index i = 0; i < points; ++i) {
        const double angle = 2.0 * kPi * i / points, r = 1.0 + 0.3 * std::sin(5.0 * angle);
        loop.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.4 * std::sin(3.0 * angle));
    }
    report.add({"a loop of " + std::to_string(points) + " points closed with the least area",
                1e3 * median_seconds(7, [&] { (void)minimum_area_triangles(loop); }), "ms"});
}

/// What a search for a boundary needs: a horn on a ball, placed on an egg.
struct SearchScene {
    Mesh source, target = test::egg(40);
    PasteRegions regions;

    explicit SearchScene(Index segments)
        : source(test::horned_ball(segments)),
          regions(paste_regions(source, {test::around_horn(source)}, {})) {}

    Index ring_vertices() const {
        std::vector<Index> vertices;
        for (const Index f : regions.ring) {
            for (const Index v : source.topology().face(f)) vertices.push_back(v);
        }
        std::sort(vertices.begin(), vertices.end());
        return index_of(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    }
};

const PastePlacement kPlace{.at = {1, 1.2, 0.8}, .angle = 0.3, .scale = 0.8};

/// A scene whose ring has about so many vertices.
SearchScene scene_of(double ring_vertices) {
    const Index segments = 24;
    const double per_square = SearchScene(segments).ring_vertices() / (segments * segments);
    return SearchScene(static_cast<Index>(std::round(std::sqrt(ring_vertices / per_square))));
}

/// The same on a target that has a large ball beside it.
SearchScene beside_a_ball(SearchScene scene) {
    Mesh ball = make_sphere({1.0, 240, SphereKind::triangles});
    for (Vec3& p : ball.edit_positions()) p.x() += 10.0;
    append(scene.target, ball);
    return scene;
}

void run_search(Report& report, double ring_vertices) {
    const SearchScene scene = scene_of(ring_vertices);
    const std::string name = "a ring of " + std::to_string(scene.ring_vertices()) + " vertices";
    report.title("the boundary in " + name + ", one thread");
    const PasteSurfaces surfaces(scene.source, scene.target);
    const PasteChart chart =
        source_chart(scene.source, scene.regions, ParameterizeMethod::arap, {});
    const PasteMap map(
        surfaces, chart,
        target_chart(scene.target, select_sphere(scene.target, kPlace.at, 1.2).faces(),
                     ParameterizeMethod::arap, {}),
        false);
    const std::vector<ImagePoint> images = map.images(map.planar(kPlace, *kPlace.angle));
    const LoopSearch ring(scene.source, scene.regions, {});
    const EnergyOptions options;
    const auto search = [&] {
        return search_boundary(map, scene.regions, ring, images, {}, options, {});
    };
    const PasteLoop loop = search();
    PasteEnergy energy(ring_edges(map, ring, images), options);
    energy.fix_weights(loop.first_scale);
    const std::vector<double> cost = energy.costs(loop.similarity);
    report.add({"one search: " + name,
                1e3 * median_seconds(11, [&] { (void)ring.cheapest(cost, {}); }), "ms"});
    const double all = median_seconds(7, [&] { (void)search(); });
    report.add({"all iterations, " + std::to_string(loop.report.energy.size() - 1) + ": " + name,
                1e3 * all, "ms"});
    report.add({"the thesis's minute for 10K vertices / ours: " + name, 60.0 / all, "x"});
    const RingTriangles triangles(chart, scene.regions);
    const RingSurface surface(map, triangles, images);
    report.add({"freed of the edges: " + name,
                1e3 * median_seconds(7, [&] { (void)free_loop(surface, loop, options, {}); }),
                "ms"});
}

/// A paste whose part is moved to and fro.
struct Drag {
    const SearchScene& scene;
    Paste paste;
    int step = 0;

    explicit Drag(const SearchScene& of)
        : scene(of),
          paste(of.source, of.target, test::around_horn(of.source), std::nullopt, std::nullopt,
                kPlace) {
        paste.optimize();
    }
    PastePlacement next() {
        PastePlacement place = kPlace;
        ++step;
        place.at += 0.02 * Vec3(std::cos(step), std::sin(step), 0.0);
        return place;
    }
    std::string name() const {
        return "a ring of " + std::to_string(scene.ring_vertices()) + " vertices on " +
               std::to_string(scene.target.face_count()) + " faces";
    }
};

/// What is shown while a part is dragged: the part alone.
void run_drag(Report& report, const SearchScene& scene, double target) {
    Drag drag(scene);
    const auto row = [&](const std::string& what, double aim, const auto& run) {
        report.add({what + ": " + drag.name(), 1e3 * median_seconds(21, run), "ms", aim});
    };
    row("the part alone", -1.0, [&] { (void)drag.paste.draft(); });
    row("placed, optimised and the part alone", target, [&] {
        drag.paste.move(drag.next());
        (void)drag.paste.draft();
    });
    row("placed, with the loop it had, and the part alone", -1.0, [&] {
        drag.paste.slide(drag.next());
        (void)drag.paste.draft();
    });
}

void run_move(Report& report, double ring_vertices) {
    const SearchScene scene = scene_of(ring_vertices);
    Drag drag(scene);
    Paste& paste = drag.paste;
    const std::string name = drag.name();
    report.title("a part that follows the mouse, " + name);
    const auto next = [&] { return drag.next(); };
    run_drag(report, scene, 30.0);
    run_drag(report, beside_a_ball(scene), 30.0);
    PasteMergeOptions quick, draft;
    quick.find_intersections = quick.compare = false;
    draft.draft = true;
    const auto row = [&](const std::string& what, const auto& run) {
        report.add({what + ": " + name, 1e3 * median_seconds(11, run), "ms"});
    };
    const auto paste_it = [&] { (void)paste.merge(quick); };
    const auto sketch_it = [&] { (void)paste.merge(draft); };
    row("placed and optimised", [&] { paste.move(next()); });
    row("pasted", paste_it);
    row("both", [&] {
        paste.move(next());
        paste_it();
    });
    row("a draft", sketch_it);
    row("placed, optimised and a draft", [&] {
        paste.move(next());
        sketch_it();
    });
    row("placed, with the loop it had", [&] { paste.slide(next()); });
    row("that and pasted", [&] {
        paste.slide(next());
        paste_it();
    });
    row("that and a draft", [&] {
        paste.slide(next());
        sketch_it();
    });
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    using namespace lissom::bench;
    Report report(argc, argv);
    if (report.wants("search")) {
        for (const double vertices : {1e3, 1e4, 4.1e4}) run_search(report, vertices);
    }
    if (report.wants("move")) run_move(report, 1e3);
    if (report.wants("maps")) {
        for (const double vertices : {1e3, 1e4, 5e4}) {
            const lissom::Mesh disk = hills(vertices);
            run_maps(report, "a disk", disk, vertices > 1e4 ? 5 : 15);
            run_rival(report, disk, vertices > 1e4 ? 5 : 15);
            run_maps(report, "a ring", ring(vertices), vertices > 1e4 ? 5 : 15);
        }
        run_grid(report, ring(1e4));
    }
    if (report.wants("holes")) {
        report.title("holes");
        for (const lissom::Index points : {100, 300, 500, 2000}) run_fill(report, points);
    }
    return 0;
}
