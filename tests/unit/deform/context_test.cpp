// The context that a deformer was made with serves calls that are given none.
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("context: later calls run under that of the constructor") {
    int reports = 0;
    ContextOptions options;
    options.progress = [&](std::string_view, double) { ++reports; };
    const Context context(options);
    const Scene scene = make_scene(make_bar({1.0, 3.0, 4, 12}));
    Deformer edit(scene.mesh, scene.all(), {}, context);
    edit.add_handle(scene.region(scene.low));
    const HandleId tip = edit.add_handle(scene.region(scene.high));
    edit.set_transform(tip, bend(scene, edit.handle(tip).center));
    edit.solve();
    CHECK(reports > 0);
    const std::vector<Vec3> solved = edit.positions();

    context.cancel();
    const auto cancelled = [](const auto& call) {
        try {
            call();
            return false;
        } catch (const Error& error) {
            return error.code() == ErrorCode::cancelled;
        }
    };
    edit.set_transform(tip, bend(scene, edit.handle(tip).center, 0.2));
    CHECK(cancelled([&] { edit.solve(); }));
    CHECK(cancelled([&] { edit.solve(FrameQuality::draft); }));
    CHECK(cancelled([&] { edit.solve(FrameQuality::preview); }));
    CHECK(edit.positions() == solved);
    edit.solve(FrameQuality::full, Context());
    CHECK(edit.positions() != solved);
    context.clear_cancel();
    edit.solve();
}
