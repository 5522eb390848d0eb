// Joins that cannot be sewn.

#include "kernel/merge/sew/sew.h"

#include <algorithm>

#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

ErrorCode code_of(const SewScene& scene, const SewOptions& options = {}) {
    const Error error = error_of([&] { sew(scene.target, scene.source, scene.joins, options); });
    CHECK(!error.message().empty());
    return error.code();
}

}  // namespace

TEST_CASE("sew: loops must be whole boundaries that run side by side") {
    const SewScene sound = two_tubes(12, 9);
    SewScene scene = sound;
    scene.joins.clear();
    CHECK(code_of(scene) == ErrorCode::invalid_argument);

    scene = sound;
    scene.joins[0].target[3] = scene.target.vertex_count();
    CHECK(code_of(scene) == ErrorCode::out_of_range);

    scene = sound;
    std::reverse(scene.joins[0].target.begin(), scene.joins[0].target.end());
    CHECK(code_of(scene) == ErrorCode::not_a_boundary);

    scene = sound;
    std::reverse(scene.joins[0].source.begin(), scene.joins[0].source.end());
    CHECK(code_of(scene) == ErrorCode::not_a_boundary);

    scene = sound;
    scene.joins[0].target.pop_back();
    scene.joins[0].on_source.pop_back();
    CHECK(code_of(scene) == ErrorCode::not_a_boundary);

    scene = sound;
    std::swap(scene.joins[0].target[2], scene.joins[0].target[5]);
    CHECK(code_of(scene) == ErrorCode::not_a_boundary);
}

TEST_CASE("sew: places must follow each other and agree") {
    const SewScene sound = two_tubes(12, 9);
    SewScene scene = sound;
    scene.joins[0].on_target.pop_back();
    CHECK(code_of(scene) == ErrorCode::invalid_argument);

    scene = sound;
    scene.joins[0].on_target[4].segment = 12;
    CHECK(code_of(scene) == ErrorCode::out_of_range);

    scene = sound;
    scene.joins[0].on_target[4].t = 1.0;
    CHECK(code_of(scene) == ErrorCode::out_of_range);

    scene = sound;
    std::swap(scene.joins[0].on_target[4], scene.joins[0].on_target[5]);
    CHECK(code_of(scene) == ErrorCode::boundary_conflict);

    scene = sound;
    scene.joins[0].on_target[4] = scene.joins[0].on_target[5];
    CHECK(code_of(scene) == ErrorCode::boundary_conflict);

    scene = sound;
    std::rotate(scene.joins[0].on_source.begin(), scene.joins[0].on_source.begin() + 4,
                scene.joins[0].on_source.end());
    CHECK(code_of(scene) == ErrorCode::boundary_conflict);
}

TEST_CASE("sew: one boundary has one join") {
    SewScene scene = two_tubes(12, 9);
    scene.joins.push_back(scene.joins[0]);
    CHECK(code_of(scene) == ErrorCode::boundary_conflict);
}

TEST_CASE("sew: options out of range, and a cancel") {
    const SewScene scene = two_tubes(12, 9);
    CHECK(code_of(scene, {.smooth = -1}) == ErrorCode::invalid_argument);
    CHECK(code_of(scene, {.snap = 1.5}) == ErrorCode::invalid_argument);
    const Context context;
    context.cancel();
    CHECK(error_of([&] { sew(scene.target, scene.source, scene.joins, {}, context); }).code() ==
          ErrorCode::cancelled);
}
