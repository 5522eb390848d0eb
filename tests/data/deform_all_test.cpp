// Every real surface deforms.
#include <cmath>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/data/data_files.h"

namespace lissom::test {
namespace {

// Beyond this, the region is a part of the mesh.
constexpr Index kLargestRegion = 4000;

// The part of a mesh that takes part: the component of a face in the middle, or some rings of it.
Region region_around(const Mesh& mesh, Index seed) {
    const auto topology = mesh.shared_topology();
    Region region(topology, {seed});
    for (;;) {
        const Region grown = region.grown(1);
        if (grown.size() == region.size() || grown.size() > kLargestRegion) return region;
        region = grown;
    }
}

// A surface without area does not bend.
bool is_mostly_flat(const Mesh& mesh, const Region& region) {
    const std::vector<Index> faces = region.faces(), flat = zero_area_faces(mesh);
    const auto count = std::count_if(faces.begin(), faces.end(), [&](Index f) {
        return std::binary_search(flat.begin(), flat.end(), f);
    });
    return 2 * static_cast<std::size_t>(count) >= faces.size();
}

// Holds one end of the region and moves the other; both are a few of its vertices along x, y or z.
bool deforms(Mesh& mesh, const Region& region) {
    const double size = bounds(mesh, region).diagonal();
    Index axis = 0;
    (bounds(mesh, region).max - bounds(mesh, region).min).maxCoeff(&axis);
    std::vector<Index> order = region.vertices();
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return mesh.position(a)[axis] < mesh.position(b)[axis]; });
    const std::size_t share = std::max<std::size_t>(1, order.size() / 8);
    const Region fixed(mesh.shared_topology(), {order.begin(), order.begin() + share});
    const Region moved(mesh.shared_topology(), {order.end() - share, order.end()});
    Deformer deformer(mesh, region);
    deformer.add_handle(fixed);
    const auto handle = deformer.add_handle(moved);
    deformer.set_transform(handle, {Mat3::Identity(), Vec3::Constant(0.1 * size)});
    deformer.solve();
    deformer.apply_to(mesh);
    return std::all_of(mesh.positions().begin(), mesh.positions().end(),
                       [](const Vec3& p) { return p.allFinite(); });
}

}  // namespace

TEST_CASE("every surface that loads deforms") {
    for_each_mesh([](Mesh& mesh) {
        const Region region = region_around(mesh, mesh.topology().face(mesh.face_count() / 2)[0]);
        if (region.size() < 4 || is_mostly_flat(mesh, region)) return;
        CHECK(deforms(mesh, region));
    });
}

}  // namespace lissom::test
