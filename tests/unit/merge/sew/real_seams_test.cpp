// Seams and self-intersections of scanned and modelled surfaces.

#include <Eigen/Geometry>
#include <utility>

#include "kernel/io/mesh_file.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/self_intersections.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("self-intersections of real meshes: those that they are known to have") {
    // The count of the first was confirmed by a search in exact arithmetic.
    const std::vector<std::pair<const char*, std::size_t>> known{{"models/cow_3k.off", 83},
                                                                 {"models/camel_isoblend.obj", 22}};
    for (const auto& model : known) {
        const auto path = data_file(model.first);
        if (!path) return;
        Mesh mesh = load_mesh(*path);
        triangulate(mesh);
        CHECK(self_intersections(mesh).size() == model.second);
    }
}

namespace {

// The part of a model below a plane and the other part of the same model four times as dense, cut
// along edges, with jagged loops.
SewScene cut_model(const Mesh& mesh, const Vec3& point, const Vec3& normal) {
    const auto below = [&](const Vec3& p) { return (p - point).dot(normal) < 0.0; };
    SewScene scene{cut_in_two(mesh, below).target, cut_in_two(subdivide(mesh), below).source, {}};
    add_join(scene, 0, 0, Vec3(0.1, 1.0, 0.2).cross(normal));
    return scene;
}

}  // namespace

TEST_CASE("sew: necks of real meshes are closed, without slivers, and smooth") {
    const struct {
        const char* name;
        Vec3 point, normal;
    } cuts[] = {{"models/camel_isoblend.obj", {0, 0.52, -0.6}, {0, 0.76, -0.65}},
                {"models/cow_3k.off", {0.27, 0.1, 0}, {1, 0.55, 0}}};
    for (const auto& cut : cuts) {
        const auto path = data_file(cut.name);
        if (!path) return;
        Mesh mesh = load_mesh(*path);
        triangulate(mesh);
        const SewScene scene = cut_model(mesh, cut.point, cut.normal);
        for (const SeamKind kind : {SeamKind::conform, SeamKind::band}) {
            const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.kind = kind});
            CHECK(sewn.mesh.topology().is_closed());
            CHECK(euler_characteristic(sewn.mesh.topology()) ==
                  euler_characteristic(mesh.topology()));
            // Vertices with a crease of the model stay.
            CHECK(sewn.report.after.max_dihedral * 180.0 / kPi < 20.0);
            CHECK(sewn.report.after.low_angle * 180.0 / kPi > 9.0);
            CHECK(volume(sewn.mesh) == doctest::Approx(volume(mesh)).epsilon(0.005));
        }
    }
}
