#include <doctest/doctest.h>

#include <functional>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/scene.h"
#include "tests/unit/failing_memory.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

// A bent bar, with a step to undo and one to do again.
struct Bent {
    std::shared_ptr<Mesh> bar = std::make_shared<Mesh>(make_bar());
    std::shared_ptr<Deformer> edit =
        std::make_shared<Deformer>(*bar, Region::all(bar->shared_topology()));
    HandleId top;
    Scene scene;

    Bent() {
        edit->add_handle(*bar->find_region("bottom"));
        top = edit->add_handle(*bar->find_region("top"));
        scene.add("bend", std::make_shared<DeformItem>(edit, std::make_shared<MeshItem>(bar)));
        for (const double angle : {0.5, 1.0}) scene.step("turn", [&] { turn(angle); });
        scene.undo();
    }
    void turn(double angle) {
        edit->set_transform(top, rotation(Vec3::UnitZ(), angle, edit->handle(top).center));
        edit->solve();
        edit->apply_to(*bar);
    }
    void shift() {
        for (Vec3& p : bar->edit_positions()) p.x() += 1.0;
    }
};

// Lets each allocation of `action` fail in turn, until none does: every time the scene must be as
// it was. Returns how many there were.
long fail_everywhere(Scene& scene, const std::function<void()>& action) {
    const std::uint64_t before = scene.hash();
    const std::size_t steps = scene.history().steps.size();
    for (long n = 0;; ++n) {
        bool failed = false;
        test::allocations_left = n;
        try {
            action();
        } catch (const Error& error) {
            failed = error.code() == ErrorCode::memory_limit;
        }
        const bool reached = test::allocations_left < 0;
        test::allocations_left = -1;
        REQUIRE(failed == reached);
        if (!failed) return n;
        REQUIRE(scene.depth() == 0);
        REQUIRE(scene.hash() == before);
        REQUIRE(scene.history().steps.size() == steps);
    }
}

}  // namespace

TEST_CASE("scene memory: where it runs out, everything is as before") {
    Bent b;
    Scene& scene = b.scene;
    CHECK(fail_everywhere(scene, [&] { scene.undo(); }) > 3);
    CHECK(fail_everywhere(scene, [&] { scene.redo(); }) > 3);
    CHECK(fail_everywhere(scene, [&] { scene.redo(); }) > 3);
    CHECK(scene.redo() == std::nullopt);
    CHECK(fail_everywhere(scene, [&] { scene.step("shift", [&] { b.shift(); }); }) > 5);
    CHECK(scene.history().steps.back().name == "shift");
    const ObjectId id = scene.objects().front()->id;
    const auto item = scene.objects().front()->item;
    CHECK(fail_everywhere(scene, [&] { scene.add("again", item); }) > 5);
    CHECK(fail_everywhere(scene, [&] { scene.rename(id, "bent bar"); }) > 5);
    CHECK(fail_everywhere(scene, [&] { scene.reorder(id, 1); }) > 5);
    CHECK(fail_everywhere(scene, [&] { scene.set_look(id, {.visible = false}); }) > 5);
    CHECK(fail_everywhere(scene, [&] { scene.remove(id); }) > 5);
    for (std::size_t steps = scene.history().place; steps > 0; --steps) scene.undo();
    CHECK(scene.objects().empty());
}
