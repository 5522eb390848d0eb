// Caps over holes: as steep at the rim as the surface around.
#include "kernel/merge/paste/erase/domed_patch.h"

#include <algorithm>
#include <cmath>

#include "kernel/mesh/edit/extract.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// What is left of a mesh whose vertices from the height `top` on go.
Mesh without_top(const Mesh& mesh, double top) {
    std::vector<Index> low;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).y() < top) low.push_back(v);
    }
    return extract(mesh, Region(mesh.shared_topology(), low)).mesh;
}

Mesh ball() {
    return make_sphere({1.0, 20, SphereKind::triangles});
}

// The vertices of a cap over the only hole, whose rim is told from its vertex `first` on.
std::vector<Vec3> cap(const Mesh& open, std::size_t first = 0) {
    Mesh mesh = open;
    const Path hole = boundaries(open).front();
    FillOptions options;
    options.fair = false;
    const FillReport patch = fill(mesh, hole, options);
    std::vector<Index> rim = hole.vertices();
    std::rotate(rim.begin(), rim.begin() + static_cast<std::ptrdiff_t>(first), rim.end());
    dome(mesh, patch, Path(open.shared_topology(), rim, true));
    REQUIRE(patch.vertex_count > 10);
    return {mesh.positions().begin() + patch.first_vertex, mesh.positions().end()};
}

}  // namespace

TEST_CASE("dome: a ball without its top is round again") {
    for (const double top : {0.3, 0.6, 0.8}) {
        CAPTURE(top);
        for (const Vec3& p : cap(without_top(ball(), top))) CHECK(std::abs(p.norm() - 1.0) < 0.08);
    }
}

TEST_CASE("dome: the rim counts all around, whichever of its vertices is the first") {
    Mesh leaning = ball();
    for (Vec3& p : leaning.edit_positions()) p.x() += 0.6 * p.y() * p.y();
    const Mesh open = without_top(leaning, 0.6);
    const std::vector<Vec3> expected = cap(open);
    const std::size_t size = boundaries(open).front().vertices().size();
    for (std::size_t first = 1; first < size; ++first) {
        const std::vector<Vec3> other = cap(open, first);
        REQUIRE(other.size() == expected.size());
        double most = 0.0;
        for (std::size_t k = 0; k < other.size(); ++k) {
            most = std::max(most, (other[k] - expected[k]).norm());
        }
        CHECK(most < 1e-12);
    }
}
