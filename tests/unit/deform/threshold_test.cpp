// DeformOptions::degenerate_threshold.

#include "kernel/deform/deformed_surface.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("every degenerate threshold above 1 gives a result, and nearly the same") {
    const Scene scenes[] = {make_scene(make_bar({1.0, 5.0, 5, 25})),
                            make_scene(make_grid({.size = {4, 1}, .segments = {24, 6}})),
                            make_scene(make_cylinder({.segments = 16, .rings = 20})),
                            make_scene(make_sphere({.segments = 8}))};
    for (const Scene& scene : scenes) {
        CAPTURE(scene.mesh.vertex_count());
        Edit usual = make_edit(scene);
        const Affine move = bend(scene, usual.deformer.handle(usual.high).center);
        usual.deformer.set_transform(usual.high, move);
        const std::vector<Vec3> wanted = usual.deformer.solve();
        for (const double threshold : {1.0001, 2.0, 10.0, 30.0, 60.0, 100.0, 300.0, 2e3, 2e6}) {
            CAPTURE(threshold);
            DeformOptions options;
            options.degenerate_threshold = threshold;
            Edit edit = make_edit(scene, options);
            CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
            edit.deformer.set_transform(edit.high, move);
            CHECK(max_distance(edit.deformer.solve(), wanted) < 0.1 * scene.size);
        }
    }
}
