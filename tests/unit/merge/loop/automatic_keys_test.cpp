#include "kernel/merge/loop/automatic_keys.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Loop first_ring(const Mesh& mesh, Index count) {
    std::vector<Index> ids(static_cast<std::size_t>(count));
    std::iota(ids.begin(), ids.end(), 0);
    return Loop(mesh, ids);
}

// A pear: no rotation maps it onto itself.
Vec3 pear(double angle, double height) {
    const double r = 1.0 + 0.3 * std::cos(angle) + 0.1 * std::sin(2.0 * angle);
    return {r * std::cos(angle), r * std::sin(angle), height};
}

double difference(double u, double v) {
    const double d = u - v - std::floor(u - v);
    return std::min(d, 1.0 - d);
}

}  // namespace

TEST_CASE("without keys the loops meet where a similarity brings them together") {
    const Mesh a = tube(120, 3, pear);
    for (const double start : {0.0, 0.7, 2.0, 5.0}) {
        Mesh b =
            tube(75, 3, [&](double angle, double height) { return pear(angle + start, height); });
        const Affine turn = rotation(Vec3(2, -1, 1), 2.0, Vec3::Zero());
        for (Vec3& p : b.edit_positions()) p = 40.0 * turn(p) + Vec3(100, 0, -30);
        const Loop source = first_ring(a, 120), target = first_ring(b, 75);
        const LoopJoin join{&source, &target};
        const OffsetGuess guess = guess_offsets(std::span(&join, 1)).front();
        // The source's start lies at angle -start of the target.
        const Vec3 expected = 40.0 * turn(pear(0.0, 0.0)) + Vec3(100, 0, -30);
        double distance = 0.0;
        const double u = target.parameter_of(target.nearest(expected, distance));
        CHECK(difference(guess.key.target - guess.key.source, u) < 0.01);
        CHECK(guess.contrast > kClearContrast);
    }
}

TEST_CASE("where the source stays, places decide, however round the loops are") {
    const Mesh a = round_tube(60, 3);
    for (const double turned : {0.0, 0.4, 2.5}) {
        Mesh b = round_tube(60, 3);
        const Affine turn = rotation(Vec3::UnitZ(), turned, Vec3::Zero());
        const Affine tilt = rotation(Vec3::UnitX(), 0.3, Vec3::Zero());
        for (Vec3& p : b.edit_positions()) p = 1.5 * tilt(turn(p)) + Vec3(0, 0, 0.4);
        const Loop source = first_ring(a, 60), target = first_ring(b, 60);
        const LoopJoin join{&source, &target};
        const OffsetGuess guess = nearest_offsets(std::span(&join, 1)).front();
        const Vec3 expected = 1.5 * tilt(a.position(0)) + Vec3(0, 0, 0.4);
        double distance = 0.0;
        const double u = target.parameter_of(target.nearest(expected, distance));
        CHECK(difference(guess.key.target - guess.key.source, u) < 0.01);
        CHECK(guess.contrast > kClearContrast);
    }
}

TEST_CASE("a round loop could meet anywhere, and the guess says so") {
    const Mesh a = round_tube(60, 3), b = round_tube(60, 3);
    const Loop source = first_ring(a, 60), target = first_ring(b, 60);
    const LoopJoin join{&source, &target};
    CHECK(guess_offsets(std::span(&join, 1)).front().contrast < kClearContrast);
}

TEST_CASE("round loops of several joins find each other by where the others are") {
    const auto ring_at = [](const Vec3& center) {
        return tube(60, 3, [=](double angle, double height) {
            return Vec3(center + Vec3(std::cos(angle), std::sin(angle), height));
        });
    };
    const std::vector<Vec3> centers{{0, 0, 0}, {6, 0, 0}, {0, 4, 0}};
    const Affine turn = rotation(Vec3::UnitZ(), 1.0, Vec3::Zero());
    std::vector<Mesh> meshes;
    for (const Vec3& c : centers) {
        meshes.push_back(ring_at(c));
        meshes.push_back(meshes.back());
        for (Vec3& p : meshes.back().edit_positions()) p = 2.0 * turn(p);
    }
    std::vector<Loop> loops;
    for (const Mesh& mesh : meshes) loops.push_back(first_ring(mesh, 60));
    std::vector<LoopJoin> joins;
    for (std::size_t k = 0; k < loops.size(); k += 2) joins.push_back({&loops[k], &loops[k + 1]});
    for (const OffsetGuess& guess : guess_offsets(joins)) {
        CHECK(difference(guess.key.target - guess.key.source, 0.0) < 0.01);
        CHECK(guess.contrast > kClearContrast);
    }
}

namespace {

// Where the guess puts the source's first vertex, over random places, turns and sizes of it: how
// far these are apart, in loops.
double spread_of_guesses(const Mesh& a, Index source_count, const Mesh& b, Index target_count) {
    Random random(5);
    const Loop target = first_ring(b, target_count);
    double first = 0.0, spread = 0.0;
    for (int trial = 0; trial < 20; ++trial) {
        Mesh moved = a;
        const Affine map = similarity(random, trial % 2 == 0 ? 0.01 : 30.0);
        for (Vec3& p : moved.edit_positions()) p = map(p);
        const Loop source = first_ring(moved, source_count);
        const LoopJoin join{&source, &target};
        const double offset = guess_offsets(std::span(&join, 1)).front().key.target;
        if (trial == 0) first = offset;
        spread = std::max(spread, difference(offset, first));
    }
    return spread;
}

Vec3 oval(double angle, double height) {
    return {1.4 * std::cos(angle), std::sin(angle), height};
}

Vec3 four_cornered(double angle, double height) {
    const double r = 1.0 + 0.1 * std::cos(4.0 * angle);
    return {r * std::cos(angle), r * std::sin(angle), height};
}

}  // namespace

TEST_CASE("of equally good places the source's own place does not choose") {
    const Mesh round = round_tube(60, 4), other = round_tube(88, 4);
    CHECK(spread_of_guesses(round, 60, other, 88) < 1e-9);
    CHECK(spread_of_guesses(round, 60, round, 60) < 1e-9);
    const Mesh ovals = tube(72, 4, oval), more = tube(100, 4, oval);
    CHECK(spread_of_guesses(ovals, 72, more, 100) < 1e-9);
    const Mesh corners = tube(200, 4, four_cornered);
    CHECK(spread_of_guesses(corners, 200, ovals, 72) < 1e-9);
    CHECK(spread_of_guesses(corners, 200, corners, 200) < 1e-9);
}

TEST_CASE("directions that belong together decide where loops leave a choice") {
    const Mesh a = round_tube(60, 3);
    Mesh b = round_tube(88, 3);
    const Affine turn = rotation(Vec3(1, 2, -1), 1.3, Vec3::Zero());
    for (Vec3& p : b.edit_positions()) p = 5.0 * turn(p) + Vec3(3, 9, 2);
    const Loop source = first_ring(a, 60), target = first_ring(b, 88);
    const LoopJoin join{&source, &target};
    for (const double angle : {0.3, 2.0, 4.5}) {
        // What lies at `angle` of the source comes to lie at angle 0 of the target.
        const Vec3 front(std::cos(angle), std::sin(angle), 0.4);
        const DirectionPair pair{7.0 * front, turn(Vec3(1, 0, 0.2))};
        const OffsetGuess guess = guess_offsets(std::span(&join, 1), std::span(&pair, 1)).front();
        CHECK(difference(guess.key.target, 1.0 - angle / (2.0 * kPi)) < 1e-3);
        CHECK(guess.contrast > kClearContrast);
    }
    // Along the axis they say nothing.
    const DirectionPair along{Vec3::UnitZ(), turn(Vec3::UnitZ())};
    CHECK(guess_offsets(std::span(&join, 1), std::span(&along, 1)).front().contrast <
          kClearContrast);
}
