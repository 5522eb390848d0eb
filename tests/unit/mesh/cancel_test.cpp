#include <array>
#include <functional>
#include <optional>
#include <string>

#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/trim.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/fill/fill.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/query/spatial_tree.h"
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
