// Memory that runs out at any moment is an error of the kernel, and the deformer stays usable.
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/failing_memory.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("memory: where it runs out is an error of the kernel, and the same call works later") {
    const Scene scene = make_scene(make_bar({1.0, 3.0, 4, 12}));
    Deformer edit(scene.mesh, scene.all());
    edit.add_handle(scene.region(scene.low));
    const HandleId tip = edit.add_handle(scene.region(scene.high));
    edit.set_transform(tip, bend(scene, edit.handle(tip).center));
    const std::vector<Vec3> before = edit.positions();
    int failures = 0;
    for (long allowed = 0;; allowed = allowed * 4 / 3 + 1) {
        CAPTURE(allowed);
        bool done = true;
        allocations_left = allowed;
        try {
            edit.solve();
        } catch (const Error& error) {
            allocations_left = -1;
            CHECK(error.code() == ErrorCode::memory_limit);
            CHECK(edit.positions() == before);
            done = false;
        }
        allocations_left = -1;
        if (done) break;
        ++failures;
    }
    CHECK(failures > 5);
    CHECK(edit.positions() != before);
}
