// Prints what the kernel makes of generated shapes: a hash to the bit, and a sum of all coordinates
// for platforms that round otherwise. `.ci/check` compares the lines of two platforms.
#include <cstdint>
#include <cstdio>
#include <memory>

#include "kernel/core/error.h"
#include "kernel/deform/deformer.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/merge/merge.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

void print(const char* name, std::uint64_t hash, double sum) {
    std::printf("%-24s %016llx %.17g\n", name, static_cast<unsigned long long>(hash), sum);
}

void show(const char* name, const Mesh& mesh) {
    double sum = 0.0;
    for (const Vec3& p : mesh.positions()) sum += p.x() + 2.0 * p.y() + 3.0 * p.z();
    print(name, hash(mesh), sum);
}

Mesh bent(const Mesh& mesh, const char* held, const char* moved, int refine) {
    DeformOptions options;
    options.refine = refine;
    Deformer edit(mesh, Region::all(mesh.shared_topology()), options);
    edit.add_handle(*mesh.find_region(held));
    const HandleId handle = edit.add_handle(*mesh.find_region(moved));
    edit.set_transform(handle, rotation(Vec3::UnitZ(), 1.0, edit.handle(handle).center));
    edit.solve();
    Mesh result = mesh;
    edit.apply_to(result);
    return result;
}

Mesh half(const Mesh& mesh, double height, double up) {
    CutPlane plane;
    plane.point = Vec3(0.0, height, 0.0);
    plane.normal = Vec3(0.0, up, 0.0);
    return cut(mesh, plane).kept.mesh;
}

Mesh merged(const Mesh& head, const Mesh& cactus) {
    const Mesh source = half(head, -0.15, 1.0), target = half(cactus, 1.7, -1.0);
    const Mesh* targets[] = {&target};
    Merger merge(source, targets, {{boundaries(source)[0], boundaries(target)[0]}});
    return merge.solve().mesh;
}

Strands hair(const Mesh& head) {
    HairstyleOptions options;
    options.resolution = 8000;
    Hairstyle style(head, std::make_shared<const Scalp>(head), options);
    for (const double side : {-1.0, 1.0}) {
        StreamCurve curve;
        for (const Vec3& at : {Vec3(0.2 * side, 1.05, 0.01), Vec3(1.3 * side, 0.6, 0.02),
                               Vec3(1.57 * side, -0.35, 0.02)}) {
            curve.points.push_back(style.scalp().at({at.x(), at.y()}, at.z()).position);
        }
        style.add({curve});
    }
    HairOptions grown = style.default_hair();
    grown.roots.count = 500;
    return style.grow(grown);
}

}  // namespace

int main() try {
    const Mesh cactus = make_cactus(), bar = make_bar(), head = make_head();
    show("cactus", cactus);
    show("bar", bar);
    show("head", head);
    show("bent bar", bent(bar, "bottom", "top", 0));
    show("bent cactus", bent(cactus, "base", "tip", 0));
    show("bent, refined cactus", bent(cactus, "base", "tip", 2));
    show("merged", merged(head, cactus));
    const Strands strands = hair(head);
    double sum = 0.0;
    for (const float x : strands.points()) sum += x;
    print("hair", hash(strands), sum);
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
