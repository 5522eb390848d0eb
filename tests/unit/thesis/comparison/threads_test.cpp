// Part of the program test_deform_threads, which the thread sanitizer builds.
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/thesis/comparison/methods.h"
#include "tests/unit/deform/two_threads.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("threads: the same for the methods that the thesis compares with") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 3, 15}));
    for (const DeformMethod method :
         {DeformMethod::naive, DeformMethod::rotation_estimate, DeformMethod::similarity,
          DeformMethod::geodesic, DeformMethod::harmonic, DeformMethod::frames}) {
        CAPTURE(method_name(method));
        Edit edit = make_edit(scene, compared_by(method));
        check_threads(scene, edit);
    }
}
