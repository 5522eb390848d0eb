#include "kernel/deform/rotation/polar.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <random>
#include <vector>

#include "kernel/core/error.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

Mat3 reference(const Mat3& m) {
    const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
    return u * svd.matrixV().transpose();
}

Mat3 random_matrix(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    Mat3 m;
    for (int i = 0; i < 9; ++i) m.data()[i] = normal(generator);
    return m;
}

bool is_rotation(const Mat3& r) {
    return (r.transpose() * r - Mat3::Identity()).norm() < 1e-13 && r.determinant() > 0.0;
}

}  // namespace

TEST_CASE(
    "nearest rotation: as the singular value decomposition, for either sign of the determinant") {
    std::mt19937 generator(1);
    int negative = 0;
    for (int i = 0; i < 2000; ++i) {
        const Mat3 m = random_matrix(generator);
        const Eigen::JacobiSVD<Mat3> svd(m);
        const Vec3 sigma = svd.singularValues();
        const double gap = sigma[1] + (m.determinant() < 0.0 ? -sigma[2] : sigma[2]);
        if (gap < 0.05 * sigma[0]) continue;
        negative += m.determinant() < 0.0 ? 1 : 0;
        const Mat3 r = nearest_rotation(m);
        CHECK(is_rotation(r));
        CHECK((r - reference(m)).norm() < 1e-9 / gap);
    }
    CHECK(negative > 500);
}

TEST_CASE("nearest rotation: a rotation is its own, at every angle") {
    std::mt19937 generator(2);
    for (const double angle : {0.0, 1e-9, 0.1, 1.5, 3.0, kPi - 1e-6, kPi}) {
        for (int i = 0; i < 50; ++i) {
            const Vec3 axis = random_matrix(generator).col(0).normalized();
            const Mat3 r = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
            CHECK((nearest_rotation(3.7 * r) - r).norm() < 1e-14);
        }
    }
}

TEST_CASE("nearest rotation: stretch along any axes does not turn") {
    std::mt19937 generator(3);
    for (int i = 0; i < 200; ++i) {
        const Mat3 u = reference(random_matrix(generator)), r = reference(random_matrix(generator));
        const Mat3 stretch = u * Vec3(4.0, 1.0, 0.3).asDiagonal() * u.transpose();
        CHECK((nearest_rotation(r * stretch) - r).norm() < 1e-12);
    }
}

TEST_CASE("nearest rotation: as exact as it is determined, however little that is") {
    std::mt19937 generator(8);
    for (const double gap : {1.0, 0.1, 0.03, 0.01, 0.003}) {
        double worst = 0.0;
        for (int i = 0; i < 400; ++i) {
            const Mat3 u = reference(random_matrix(generator)),
                       r = reference(random_matrix(generator));
            const Vec3 sigma(1.0, 0.7 * gap, 0.3 * gap);
            const Mat3 stretch = u * sigma.asDiagonal() * u.transpose();
            worst = std::max(worst, (nearest_rotation(r * stretch) - r).norm());
        }
        CHECK(worst < 4e-15 / gap);
    }
}

TEST_CASE("nearest rotation: where it is not unique it is still one of the nearest") {
    std::mt19937 generator(4);
    const auto closeness = [](const Mat3& m) {
        return (nearest_rotation(m).transpose() * m).trace();
    };
    for (int i = 0; i < 100; ++i) {
        const Mat3 u = reference(random_matrix(generator)), v = reference(random_matrix(generator));
        for (const Vec3& sigma :
             {Vec3(1, 0, 0), Vec3(1, 1e-9, 0), Vec3(1, 1, -1), Vec3(2, 1, -1)}) {
            const Mat3 m = u * sigma.asDiagonal() * v.transpose();
            CHECK(is_rotation(nearest_rotation(m)));
            CHECK(closeness(m) == doctest::Approx(sigma.sum()).epsilon(1e-9));
        }
    }
    CHECK(nearest_rotation(Mat3::Zero()) == Mat3::Identity());
}

TEST_CASE("nearest rotation: does not depend on the scale of the matrix") {
    std::mt19937 generator(5);
    const Mat3 m = random_matrix(generator);
    for (const double scale : {1e-140, 1e-9, 1e9, 1e140}) {
        CHECK((nearest_rotation(scale * m) - nearest_rotation(m)).norm() < 1e-14);
    }
}

TEST_CASE("uniform scale is the root mean square of the singular values") {
    const Mat3 m = Vec3(1.0, 2.0, 5.0).asDiagonal();
    CHECK(uniform_scale(m) == doctest::Approx(std::sqrt(10.0)));
}

TEST_CASE("nearest rotations: as one at a time, whatever stands beside a matrix") {
    std::mt19937 generator(6);
    std::vector<Mat3> m;
    for (int i = 0; i < 203; ++i) m.push_back(random_matrix(generator));
    m[5] = Mat3::Zero();
    m[50] = Vec3(1.0, 1.0, -1.0).asDiagonal();
    m[100] = reference(m[99]);
    std::vector<Mat3> r(m.size());
    nearest_rotations(m, r);
    for (std::size_t i = 0; i < m.size(); ++i) {
        CAPTURE(i);
        CHECK((r[i] - nearest_rotation(m[i])).norm() < 1e-10);
    }
    std::vector<Mat3> shifted(m.begin() + 2, m.end()), in_place = shifted;
    nearest_rotations(shifted, in_place);
    CHECK(in_place.front() == r[2]);
    nearest_rotations(in_place, in_place);
    CHECK((in_place.back() - r.back()).norm() < 1e-13);
    CHECK_THROWS_AS(nearest_rotations(m, std::span(r).first(3)), Error);
}

TEST_CASE("nearest rotations: nothing beyond the last one is read or written") {
    std::mt19937 generator(9);
    for (std::size_t count = 0; count < 13; ++count) {
        std::vector<Mat3> m(count + 4, Mat3::Constant(7.0)), r = m;
        for (std::size_t i = 0; i < count; ++i) m[i] = random_matrix(generator);
        nearest_rotations(std::span(m).first(count), std::span(r).first(count));
        for (std::size_t i = 0; i < count; ++i) CHECK(is_rotation(r[i]));
        for (std::size_t i = count; i < r.size(); ++i) CHECK(r[i] == Mat3::Constant(7.0));
    }
}

TEST_CASE("nearest quaternions: of unit length, and those of the nearest rotations") {
    std::mt19937 generator(7);
    std::vector<Mat3> m;
    for (int i = 0; i < 203; ++i) m.push_back(random_matrix(generator));
    m[5] = Mat3::Zero();
    m[50] = Vec3(1.0, 1.0, -1.0).asDiagonal();
    std::vector<Vec4> q(m.size());
    nearest_quaternions(m, q);
    for (std::size_t i = 0; i < m.size(); ++i) {
        CAPTURE(i);
        CHECK(std::abs(q[i].norm() - 1.0) < 1e-15);
        const Eigen::Quaterniond unit(q[i][0], q[i][1], q[i][2], q[i][3]);
        CHECK((unit.toRotationMatrix() - nearest_rotation(m[i])).norm() < 1e-10);
    }
    CHECK_THROWS_AS(nearest_quaternions(m, std::span(q).first(3)), Error);
}
