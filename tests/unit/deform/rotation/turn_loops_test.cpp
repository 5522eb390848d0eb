// Turns of many vertices at a time against those of one.
#include "kernel/deform/rotation/turn_loops.h"

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Not a multiple of the lanes.
constexpr std::size_t kMany = 203;

Vec3 random_axis(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    return Vec3(normal(generator), normal(generator), normal(generator)).normalized();
}

// Turns from less than rounding to several full ones, quarters and none.
std::vector<Vec4> turns_of_all_lengths(double longest) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> exponent(-18.0, std::log10(longest));
    std::vector<Vec4> turns;
    for (std::size_t i = 0; i < kMany; ++i) {
        const double quarters = 0.25 * static_cast<double>(i) * kPi;
        const double length = i % 3 == 0 ? quarters : std::pow(10.0, exponent(generator));
        const Vec3 turn = length * random_axis(generator);
        turns.push_back({turn.x(), turn.y(), turn.z(), 7.0});
    }
    return turns;
}

Vec4 quaternion_of(const Mat3& rotation, double sign) {
    const Eigen::Quaterniond q(rotation);
    return sign * Vec4(q.w(), q.x(), q.y(), q.z());
}

// Rotations by angles from none to half a turn, as matrices and as quaternions of either sign.
struct Several {
    std::vector<Mat3> matrix;
    std::vector<Vec4> quaternion;

    explicit Several(unsigned seed, double widest) {
        std::mt19937 generator(seed);
        for (std::size_t i = 0; i < kMany; ++i) {
            const double angle = widest * static_cast<double>(i) / kMany;
            matrix.push_back(rotation_of_turn(angle * random_axis(generator)));
            quaternion.push_back(quaternion_of(matrix.back(), i % 2 == 0 ? 1.0 : -1.0));
        }
    }
};

}  // namespace

TEST_CASE("rotations of many turns: as those of one, after the base") {
    const Mat3 base = rotation_of_turn({0.3, -1.1, 0.4});
    for (const double longest : {500.0, 1e9}) {
        const std::vector<Vec4> turns = turns_of_all_lengths(longest);
        std::vector<Mat3> r(kMany);
        rotations_of_turns(turns, quaternion_of(base, -1.0), r);
        for (std::size_t i = 0; i < kMany; ++i) {
            CAPTURE(turns[i].transpose());
            const Vec3 turn = turns[i].head<3>();
            CHECK((r[i] - rotation_of_turn(turn) * base).norm() < 4e-15 * (1.0 + turn.norm()));
            CHECK((r[i].transpose() * r[i] - Mat3::Identity()).norm() < 2e-15);
        }
    }
}

TEST_CASE("many matrices turn further as one does") {
    const Several rotations(12, kPi);
    const Mat3 base = rotation_of_turn({-0.2, 0.5, 0.9});
    for (const double part : {-0.5, 0.0, 0.25, 1.0, 2.5}) {
        std::vector<Vec4> seen;
        std::vector<Mat3> expected, m;
        for (std::size_t i = 0; i < kMany; ++i) {
            const Mat3 whole = rotations.matrix[i] * base;
            seen.push_back(quaternion_of(whole, i % 2 == 0 ? 1.0 : -1.0));
            m.emplace_back(whole * Vec3(1.0, 2.0, 0.5).asDiagonal());
            expected.emplace_back(turned_further(rotations.matrix[i], part) * m.back());
        }
        turn_further(seen, quaternion_of(base, 1.0), part, m);
        for (std::size_t i = 0; i < kMany; ++i) {
            CAPTURE(part);
            CAPTURE(i);
            CHECK((m[i] - expected[i]).norm() < 1e-13);
        }
    }
}

TEST_CASE("many rotations blend as two do, from one to the other") {
    const Several from(13, 3.0 * kPi), ways(14, 0.999 * kPi);
    std::vector<Mat3> to, r(kMany);
    std::vector<Vec4> end;
    for (std::size_t i = 0; i < kMany; ++i) {
        to.emplace_back(ways.matrix[i] * from.matrix[i]);
        end.push_back(quaternion_of(to.back(), i % 3 == 0 ? 1.0 : -1.0));
    }
    for (const double share : {0.0, 0.3, 0.75, 1.0}) {
        blend_rotations(from.quaternion, end, share, r);
        for (std::size_t i = 0; i < kMany; ++i) {
            CAPTURE(share);
            CAPTURE(i);
            CHECK((r[i] - rotation_between(from.matrix[i], to[i], share)).norm() < 1e-12);
            if (share == 0.0) CHECK((r[i] - from.matrix[i]).norm() < 1e-14);
            if (share == 1.0) CHECK((r[i] - to[i]).norm() < 1e-14);
        }
    }
}
