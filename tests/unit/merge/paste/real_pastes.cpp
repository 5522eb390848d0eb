#include "tests/unit/merge/paste/real_pastes.h"

#include "kernel/core/geometry.h"
#include "kernel/mesh/query/region_select.h"

namespace lissom::test {
namespace {

const char* const kBunny = "models/stanford_bunny_35k.obj";
const char* const kPlanck = "heads/max_planck_fprotais.obj";
const char* const kArmadillo = "models/armadillo_43k.obj";

using Marked = std::function<Region(const Mesh&)>;

Marked beyond(const Vec3& point, const Vec3& normal) {
    return [=](const Mesh& mesh) { return select_plane(mesh, point, normal); };
}
Marked within(const Vec3& middle, double radius) {
    return [=](const Mesh& mesh) { return select_sphere(mesh, middle, radius); };
}
Marked both(const Marked& a, const Marked& b) {
    return [=](const Mesh& mesh) { return a(mesh).intersected(b(mesh)); };
}
Marked either(const Marked& a, const Marked& b) {
    return [=](const Mesh& mesh) { return a(mesh).united(b(mesh)); };
}

}  // namespace

const std::vector<RealPaste>& real_pastes() {
    static const std::vector<RealPaste> pastes = [] {
        // Features that stand on a base are marked by balls around the base and what stands on it.
        const Marked ear = both(
            both(beyond({-.049, .155, 0}, {.657, .577, -.48}), within({-.03, .17, -.012}, .05)),
            beyond({-.06, 0, 0}, {1, 0, 0}));
        const Vec3 ear_base(-.051, .147, .004);
        const Marked arm =
            both(both(beyond({-.245, .14, -.06}, {-.75, -.1, .6}), within({-.37, .25, .1}, .5)),
                 beyond({-.2, 0, 0}, {-1, 0, 0}));
        const Vec3 shoulder(-.19, .15, -.11);
        const Marked flap = both(beyond({28, 93, -18}, {1, 0, 0}), within({40, 98, -16}, 38));
        const Vec3 flap_base(21, 92, -19);
        const Vec3 up_neck(-.5, .866, 0), to_head(0, .62, -.785);
        const Marked head = within({-32, 45, 0}, 40), face = within({0, .4, -.5}, 1.0);
        const Vec3 crown(0, .5, -.05), rump(.003, .132, 0);
        return std::vector<RealPaste>{
            {"bunny's ear on Planck's crown",
             kBunny,
             kPlanck,
             either(within(ear_base, .026), ear),
             either(within(ear_base, .015), ear),
             {.at = crown, .scale = 5.0},
             .0065,
             .0009,
             "other marks: LSCM and Eq 3.1 with our deformation gave .0011 there, here .0050, and "
             "with balls of .020 to .034 and .008 to .018 around the base .0050 to .45, ours .0014 "
             "to .0150"},
            {"armadillo's arm on the bunny's rump",
             kArmadillo,
             kBunny,
             either(within(shoulder, .17), arm),
             either(within(shoulder, .11), arm),
             {.at = {.045, .1, 0}, .scale = .15},
             .0045,
             .0101},
            {"half of eight on Planck's crown",
             "models/eight.off",
             kPlanck,
             beyond({0, 0, -.02}, {0, 0, 1}),
             beyond({0, 0, .1}, {0, 0, 1}),
             {.at = crown, .scale = .8},
             .021,
             .0097},
            {"elephant's ear on Planck's side",
             "models/elephant_libigl.obj",
             kPlanck,
             either(within(flap_base, 30), flap),
             either(within(flap_base, 20), flap),
             {.at = {.29, .2, -.1}, .angle = 120 * kDegree, .scale = .006},
             .005,
             .0012,
             "other marks: LSCM and Eq 3.1 with our deformation gave .0032 there, here .0141, and "
             "with balls of 25 to 35 and 14 to 23 around the base .0136 to .0341, ours .0017 to "
             ".0191; at twelve angles ours is .0015 to .0105"},
            {"Planck's nose on the bunny",
             kPlanck,
             kBunny,
             within({0, .06, .29}, .17),
             within({0, .06, .31}, .11),
             {.at = rump, .scale = .2},
             .016,
             .0054},
            {"dinosaur's neck on the bunny",
             "models/dinosaur.obj",
             kBunny,
             both(beyond(Vec3(-20, 30, 0) - 4 * up_neck, up_neck), head),
             both(beyond(Vec3(-20, 30, 0) + 6 * up_neck, up_neck), head),
             {.at = rump, .scale = .002},
             .058},
            {"a hand on Planck's crown",
             "models/hand_plain.obj",
             kPlanck,
             beyond({0, -.52, 0}, {0, 1, 0}),
             beyond({0, -.38, 0}, {0, 1, 0}),
             {.at = crown, .scale = .6},
             .05},
            {"Spot's head on the armadillo's back",
             "models/spot.obj",
             kArmadillo,
             both(beyond(Vec3(0, .17, -.21) - .1 * to_head, to_head), face),
             both(beyond(Vec3(0, .17, -.21) + .12 * to_head, to_head), face),
             {.at = {0, .2, -.38}, .scale = .25},
             .052}};
    }();
    return pastes;
}

}  // namespace lissom::test
