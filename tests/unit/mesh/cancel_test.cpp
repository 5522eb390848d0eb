#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/measure/distortion.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/resample/decimate.h"
#include "kernel/mesh/resample/remesh.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

namespace {

using Operation = std::function<void(Mesh&, const Context&)>;

// Runs the operation with a cancel at its `report`-th report of progress; true where it ran to its
// end.
bool completes(const Operation& operation, Mesh& mesh, int report) {
    std::optional<Context> context;
    int reports = 0;
    ContextOptions options;
    options.progress = [&](std::string_view, double) {
        if (reports++ == report) context->cancel();
    };
    context.emplace(options);
    try {
        operation(mesh, *context);
        return true;
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::cancelled);
        return false;
    }
}

// Cancels at every report in turn: the mesh stays as it was until the operation is not reached.
void check_cancel(const std::string& name, const Mesh& original, const Operation& operation) {
    CAPTURE(name);
    const std::uint64_t before = hash(original);
    int cancelled = 0;
    for (int report = 0; report < 100; ++report) {
        Mesh mesh = original;
        if (completes(operation, mesh, report)) {
            if (cancelled > 0) return;
            continue;
        }
        ++cancelled;
        CHECK(hash(mesh) == before);
        CHECK(mesh.shared_topology() == original.shared_topology());
    }
    CHECK(cancelled > 0);
}

}  // namespace

TEST_CASE("a cancel at any report of progress leaves the mesh as it was") {
    const Mesh open = test::decorated(make_cylinder({.caps = false}));
    check_cancel("append", open, [&](Mesh& m, const Context& c) { append(m, open, c); });
    check_cancel("flip", open, [](Mesh& m, const Context& c) { flip(m, c); });
    check_cancel("triangulate", open, [](Mesh& m, const Context& c) { triangulate(m, c); });
    check_cancel("smooth", open, [](Mesh& m, const Context& c) { smooth(m, {}, c); });
    check_cancel("fill", open, [](Mesh& m, const Context& c) { fill(m, boundaries(m)[0], {}, c); });
    check_cancel("subdivide", open,
                 [](Mesh& m, const Context& c) { m = subdivide(m, {.levels = 3}, c); });
    check_cancel("extract", open, [](Mesh& m, const Context& c) {
        m = extract(m, Region::all(m.shared_topology()), c).mesh;
    });
    check_cancel("cut", open, [](Mesh& m, const Context& c) {
        m = cut(m, CutPlane{{0, 0.13, 0}, {0.2, 1, 0}}, {}, c).kept.mesh;
    });
    check_cancel("cut out", open, [](Mesh& m, const Context& c) {
        const Region upper = select_plane(m, {0, 0.13, 0}, {0.2, 1, 0});
        m = cut(m, CutRegion{upper}, {}, c).kept.mesh;
    });
    check_cancel("trim", open,
                 [](Mesh& m, const Context& c) { m = trim(m, boundaries(m)[0], {}, c).mesh; });
    check_cancel("distances", open,
                 [](Mesh& m, const Context& c) { HeatDistances(m, c).from(std::array{0}, c); });
    check_cancel("tree", open, [](Mesh& m, const Context& c) { SpatialTree(m, c).bounds(); });
}

TEST_CASE("memory charged by an operation is given back") {
    const Context context;
    Mesh mesh = make_cylinder({.caps = false});
    fill(mesh, boundaries(mesh)[0], {}, context);
    (void)subdivide(mesh, {.levels = 2}, context);
    (void)heat_distances(mesh, std::array{0}, context);
    // The mesh is one that the context has filled.
    CHECK(context.memory()->used() == mesh.memory_bytes());
    CHECK(context.memory()->peak() > mesh.memory_bytes());
}

namespace {

// A cone of very many faces around its tip, with an open base.
Mesh hub(Index n) {
    std::vector<Vec3> points{{0.0, 0.0, 1.0}};
    FaceList faces;
    for (Index i = 0; i < n; ++i) {
        const double angle = 2.0 * kPi * i / n;
        points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        faces.add({0, 1 + i, 1 + (i + 1) % n});
    }
    return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("a cancel is heard among very many faces around one vertex") {
    const Mesh mesh = hub(60000);
    struct Cancelled {
        const char* name;
        std::function<void(const Context&)> run;
    };
    const std::vector<Cancelled> operations = {
        {"crossings", [&](const Context& c) { self_intersections(mesh, {}, c); }},
        {"distortion", [&](const Context& c) { distortion(mesh, mesh, c); }},
        {"decimate", [&](const Context& c) { decimate(mesh, {.faces = 1000}, c); }},
        {"remesh", [&](const Context& c) { remesh(mesh, {.edge = 0.05}, c); }},
        {"subdivide", [&](const Context& c) { subdivide(mesh, {.levels = 5}, c); }},
    };
    for (const Cancelled& operation : operations) {
        CAPTURE(operation.name);
        const Context context;
        std::jthread canceller([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            context.cancel();
        });
        try {
            operation.run(context);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
        }
    }
}

TEST_CASE("polygons of very many corners are subdivided in the memory of their corners") {
    std::vector<Vec3> points;
    std::vector<Index> face;
    for (Index i = 0; i < 60000; ++i) {
        const double angle = 2.0 * kPi * i / 60000;
        points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        face.push_back(i);
    }
    FaceList faces;
    faces.add(face);
    const Mesh mesh(std::move(points), std::move(faces));
    ContextOptions options;
    options.memory_limit = std::size_t{400} << 20;
    for (const auto scheme : {SubdivisionScheme::midpoint, SubdivisionScheme::catmull_clark}) {
        const Mesh finer = subdivide(mesh, {.levels = 1, .scheme = scheme}, Context(options));
        CHECK(finer.face_count() == 60000);
        CHECK(finer.vertex_count() == 120001);
    }
    // Their middle has all corners as sources, once for each: that is told before it is made.
    Mesh with_values = mesh;
    with_values.attributes().add(
        {"uv", Domain::corner, 2, ScalarType::float32, std::vector<double>(120000, 0.5)});
    const Error error =
        test::error_of([&] { subdivide(with_values, {.levels = 1}, Context(options)); });
    CHECK(error.code() == ErrorCode::memory_limit);
}
