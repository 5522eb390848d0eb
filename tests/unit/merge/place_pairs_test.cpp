// How far the guess of places by shape, and its certainty, can be trusted on real models.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/merge/merge_stages.h"
#include "tests/unit/merge/place_pairs.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Models with limbs, heads or horns that the certainty was not fitted to.
constexpr const char* kOtherModels[] = {
    "models/alligator.obj",       "models/chinese_lion.obj", "models/dragon_directional.off",
    "models/hand_wass.obj",       "models/kitten_wass.obj",  "models/chimera_armabunny.obj",
    "models/poly_moomoo.off",     "models/cow_oded_low.obj", "models/horse_walk.obj",
    "models/venus_torso_ldr.obj", "models/lilium.obj",       "models/arap_armadillo_1k.off",
    "models/spider_vtk.ply",      "models/pelvis.obj",       "models/mannequin_nyugp.off"};

struct Guess {
    double certainty = 0.0;
    bool right = false;
};

Guess guess_of(const PlacePair& pair) {
    const Mesh* targets[] = {&pair.target};
    MergeOptions options;
    options.place = Place::shape;
    options.find_intersections = false;
    const std::vector<Join> joins{Join{pair.source_boundary, pair.target_boundary}};
    const MergePreparation made = prepare_merge(pair.source, targets, joins, options, {});
    const std::vector<std::vector<KeyPair>> no_keys(1);
    const auto find = [&] {
        return find_places(made.boundaries, *made.parts, made.system, options, {});
    };
    const JoinReport join = match_boundaries(made.given, made.boundaries, options,
                                             made.report.sides.joins, no_keys, find)
                                .joins.front();
    const Vec3 axis = join.turn.norm() > 0.0 ? Vec3(join.turn.normalized()) : Vec3::UnitX();
    const Mat3 turn = Eigen::AngleAxisd(join.turn.norm(), axis).toRotationMatrix();
    const bool right = join.any_turn || is_right(pair, turn);
    const std::string told = std::string(right ? "" : ", wrong") + (join.any_turn ? ", any" : "");
    MESSAGE(pair.name << ": " << join.certainty << told);
    return {join.certainty, right};
}

std::vector<PlacePair> all_pairs() {
    std::vector<PlacePair> pairs = keyed_pairs();
    for (PlacePair& pair : head_pairs()) pairs.push_back(std::move(pair));
    for (const char* file : kOtherModels) {
        for (PlacePair& pair : cut_pairs(file, 2)) pairs.push_back(std::move(pair));
    }
    return pairs;
}

}  // namespace

TEST_CASE("placed by shape nine of ten real parts are right at a certainty of .9") {
    const std::vector<PlacePair> pairs = all_pairs();
    if (pairs.empty()) return;
    int right = 0, certain = 0, right_and_certain = 0, clear = 0, right_and_clear = 0;
    for (const PlacePair& pair : pairs) {
        const Guess guess = guess_of(pair);
        right += guess.right;
        certain += guess.certainty >= 0.9;
        right_and_certain += guess.certainty >= 0.9 && guess.right;
        clear += guess.certainty >= kCertain;
        right_and_clear += guess.certainty >= kCertain && guess.right;
    }
    MESSAGE(right << " of " << pairs.size() << " right; " << right_and_certain << " of " << certain
                  << " at .9, " << right_and_clear << " of " << clear << " at " << kCertain);
    CHECK(certain >= 10);
    CHECK(10 * right_and_certain >= 9 * certain);
    CHECK(4 * right_and_clear >= 3 * clear);
    CHECK(3 * right >= 2 * static_cast<int>(pairs.size()));
}
