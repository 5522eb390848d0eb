// Frames of one preparation are solved on several threads at the same time: a program of its own,
// to be built quickly with the thread sanitizer (preset tsan).
#include "kernel/deform/deformed_surface.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/two_threads.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("threads: two frames of one preparation at once are those solved in turn") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    const Index middle = scene.between(0);
    DeformOptions refined;
    refined.refine = 2;
    refined.local_size = LocalSize::scale;
    for (const DeformOptions& options : {DeformOptions(), refined}) {
        Edit edit = make_edit(scene, options);
        const std::vector<Vec3>& rest = rest_positions_of(edit.deformer);
        edit.deformer.constrain(VertexConstraint{middle, rest[middle], {}, {}});
        edit.deformer.constrain(
            VertexConstraint{scene.between(3), rest[scene.between(3)], {}, 5.0});
        check_threads(scene, edit);
    }
}
