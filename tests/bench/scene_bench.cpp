// What undo costs beside the work that is undone: drags of a cactus in a scene.
#include <string>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/scene.h"
#include "tests/bench/limits.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr Index kVertices = 43000, kManyVertices = 690000;
constexpr int kRepeats = 21;

struct Dragged {
    std::shared_ptr<Mesh> mesh;
    Scene scene;

    explicit Dragged(Index vertices)
        : mesh(std::make_shared<Mesh>(make_cactus({.vertices = vertices}))) {
        scene.add("cactus", std::make_shared<MeshItem>(mesh));
    }
    std::string name() const { return std::to_string(mesh->vertex_count() / 1000) + "K"; }
    double bytes() const { return static_cast<double>(mesh->positions().size_bytes()); }
    // Moves the first part of the vertices.
    void drag(double part) {
        const std::span<Vec3> positions = mesh->edit_positions();
        const auto count = static_cast<std::size_t>(part * static_cast<double>(positions.size()));
        for (Vec3& p : positions.first(count)) p.x() += 0.01;
    }
};

// A step is captured, and undo writes back what has changed: both read and write positions only.
void run_mesh(Report& report, Index vertices) {
    Dragged dragged(vertices);
    Scene& scene = dragged.scene;
    MemoryLimit memory;
    report.title("Drags of a mesh of " + dragged.name() + " vertices");
    for (const double part : {1.0, 0.125}) {
        const std::string of = part < 1.0 ? "an eighth of it" : "all of it";
        std::vector<double> commits;
        const auto undo = [&] {
            scene.begin("drag");
            dragged.drag(part);
            commits.push_back(seconds([&] { scene.commit(); }));
            return seconds([&] { scene.undo(); });
        };
        const auto limit = [&] { return memory.seconds_to_write(dragged.bytes()); };
        const Quotient quotient = quotient_of(kRepeats, undo, limit);
        report.add({"commit of a drag of " + of, 1e3 * quantile(commits, 0.5), "ms"});
        report.add({"undo of a drag of " + of, 1e3 * quotient.above, "ms"});
        // Undo looks for changes first: it reads what is there and what was captured.
        report.add_ratio("undo of a drag of " + of + " / writing the positions", "memory", quotient,
                         vertices == kVertices ? 3.0 : -1.0);
        scene.begin("drag");
        dragged.drag(part);
        scene.commit();
        report.add({"memory of the step / positions",
                    static_cast<double>(scene.history().steps.back().bytes) / dragged.bytes(),
                    "x"});
        scene.undo();
    }
    const auto nothing = [&] {
        scene.begin("nothing");
        scene.commit();
    };
    report.add({"a step in which nothing changes", 1e3 * median_seconds(kRepeats, nothing), "ms"});
}

// With the deformation: its handles, its result and the mesh.
void run_deformation(Report& report) {
    Dragged dragged(kVertices);
    Mesh& mesh = *dragged.mesh;
    Scene& scene = dragged.scene;
    const auto edit = std::make_shared<Deformer>(mesh, Region::all(mesh.shared_topology()));
    edit->add_handle(*mesh.find_region("base"));
    const HandleId tip = edit->add_handle(*mesh.find_region("tip"));
    const auto item = scene.objects().front()->item;
    scene.add("bend", std::make_shared<DeformItem>(edit, item));
    double angle = 0.0;
    std::vector<double> commits, undos;
    const auto frame = [&] {
        angle += 0.01;
        edit->set_transform(tip, rotation(Vec3::UnitZ(), angle, edit->handle(tip).center));
        edit->solve(FrameQuality::draft);
        edit->apply_to(mesh);
    };
    frame();
    const auto undo = [&] {
        scene.begin("drag");
        frame();
        edit->solve();
        edit->apply_to(mesh);
        commits.push_back(seconds([&] { scene.commit(); }));
        return seconds([&] { scene.undo(); });
    };
    report.title("Drags of a deformation of " + dragged.name() + " vertices");
    const Quotient quotient = quotient_of(kRepeats, undo, [&] { return seconds(frame); });
    report.add({"commit of a drag", 1e3 * quantile(commits, 0.5), "ms"});
    report.add({"undo of a drag", 1e3 * quotient.above, "ms"});
    report.add_ratio("undo of a drag / a frame of it", "a frame", quotient, 0.1);
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    for (const lissom::Index vertices : {lissom::bench::kVertices, lissom::bench::kManyVertices}) {
        lissom::bench::run_mesh(report, vertices);
    }
    lissom::bench::run_deformation(report);
    return 0;
}
