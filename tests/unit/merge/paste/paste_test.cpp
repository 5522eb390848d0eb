// Pastes from end to end on generated shapes.
#include "kernel/merge/paste/paste.h"

#include "kernel/mesh/measure/measures.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

void check_sound(const PasteResult& result) {
    CAPTURE(result.merged.report.verdict);
    CHECK(result.merged.mesh.topology().is_closed());
    CHECK(result.merged.mesh.topology().component_count() == 1);
    CHECK(result.report.euler_characteristic == result.report.expected_characteristic);
    for (const Vec3& p : result.merged.mesh.positions()) CHECK(p.allFinite());
}

}  // namespace

TEST_CASE("paste: a horn comes to stand where it is put, watertight and little distorted") {
    const Mesh horn = horned_ball(), target = egg();
    const std::uint64_t before[] = {hash(horn), hash(target)};
    for (const Vec3& at : {Vec3(0, 2, 0), Vec3(1, 1.2, 0.8), Vec3(0, 0, 1.6)}) {
        Paste paste = horn_on_egg(horn, target, {.at = at, .scale = 0.8});
        const PasteResult plain = paste.merge();
        check_sound(plain);
        paste.optimize();
        const PasteResult best = paste.merge();
        check_sound(best);
        CHECK(best.merged.report.ok);
        CHECK(best.report.near.energy <= plain.report.near.energy);
        CHECK(best.report.near.anisotropy < 1.5);
        double tallest = 0.0;
        for (const Vec3& p : best.merged.mesh.positions()) {
            tallest = std::max(tallest, (p - at).dot(at.normalized()));
        }
        CHECK(tallest > 0.4);
    }
    CHECK(hash(horn) == before[0]);
    CHECK(hash(target) == before[1]);
}

TEST_CASE("paste: a feature may have a handle") {
    // A ring on a foot that widens like a funnel.
    Mesh torus = make_torus();
    const Mesh target = egg();
    const Vec3 foot(1.35, 0, 0);
    const Region region = select_sphere(torus, foot, 0.2).inverted();
    const Region feature = select_sphere(torus, foot, 0.6).inverted();
    for (Vec3& p : torus.edit_positions()) {
        const double near = std::max(0.0, 0.6 - (p - foot).norm());
        p += Vec3(near, 6.0 * near * p.y(), 6.0 * near * p.z());
    }
    Paste paste(torus, target, region, feature, std::nullopt, {.at = {0, 2, 0}, .scale = 0.5});
    paste.optimize();
    const PasteResult result = paste.merge();
    check_sound(result);
    CHECK(genus(result.merged.mesh.topology()) == 1);
}

TEST_CASE("paste: a move that does not fit keeps the last good place") {
    const Mesh horn = horned_ball(), target = egg();
    const Region top = select_plane(target, {0, 0.2, 0}, {0, 1, 0});
    Paste paste(horn, target, around_horn(horn), std::nullopt, top,
                {.at = {0, 2, 0}, .scale = 0.6});
    paste.optimize();
    const std::vector<Index> loop = paste.loop().vertices();
    const Error outside = error_of([&] { paste.move({.at = {0, -2, 0}, .scale = 0.6}); });
    CHECK(outside.code() == ErrorCode::boundary_conflict);
    CHECK(!outside.elements().ids.empty());
    const Error large = error_of([&] { paste.move({.at = {0, 2, 0}, .scale = 9.0}); });
    CHECK(large.code() == ErrorCode::boundary_conflict);
    CHECK(paste.loop().vertices() == loop);
    CHECK(paste.placement().scale == 0.6);
    check_sound(paste.merge());
    paste.move({.at = {0.6, 1.7, 0.3}, .angle = 1.0, .scale = 0.6});
    check_sound(paste.merge());
}

TEST_CASE("paste: the size can be locked; nearest points and the thesis's way work too") {
    const Mesh horn = horned_ball(), target = egg();
    Paste paste = horn_on_egg(horn, target, {.at = {0, 2, 0}, .scale = 0.7});
    CHECK(paste.merge({.lock_scale = true}).report.scale == 0.7);
    PasteOptions closest;
    closest.correspondence = PasteCorrespondence::closest;
    Paste near = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.7}, closest);
    near.optimize();
    const std::vector<double>& misfit = near.search().misfit;
    CHECK(misfit.back() <= misfit.front());
    check_sound(near.merge());
    PasteOptions thesis;
    thesis.thesis = true;
    Paste literal = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.7}, thesis);
    literal.optimize();
    check_sound(literal.merge());
}
