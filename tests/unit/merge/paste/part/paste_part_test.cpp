// What holds a part at its boundary: frames by the tilt of the surfaces, averaged along it.

#include "kernel/merge/paste/part/paste_part.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

using namespace lissom;

namespace {

Vec3 random_vector(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
}

// Points whose surfaces are tilted by up to about half a radian, every one differently.
std::vector<RingPoint> random_rim(std::size_t count, const Mat3& rotation, std::mt19937& random) {
    std::vector<RingPoint> rim(count);
    for (RingPoint& point : rim) {
        point.normal = random_vector(random).normalized();
        point.image.normal = (rotation * point.normal + 0.2 * random_vector(random)).normalized();
        point.image.position = random_vector(random);
    }
    return rim;
}

Mat3 random_rotation(std::mt19937& random) {
    return Eigen::AngleAxisd(1.3, random_vector(random).normalized()).toRotationMatrix();
}

double difference(const BoundaryValue& a, const BoundaryValue& b) {
    return (a.position - b.position).norm() + (a.rotation - b.rotation).norm();
}

}  // namespace

TEST_CASE("paste values: neither where a loop begins nor its direction matters") {
    std::mt19937 random(1);
    for (const std::size_t count : {std::size_t{5}, std::size_t{12}, std::size_t{31}}) {
        const PasteSimilarity similarity{random_rotation(random), 1.7};
        std::vector<RingPoint> rim = random_rim(count, similarity.rotation, random);
        for (const double crease : {0.0, 0.2}) {
            const auto values = paste_values(rim, similarity, 1.7, crease);
            std::vector<RingPoint> other = rim;
            std::rotate(other.begin(), other.begin() + 2, other.end());
            auto moved = paste_values(other, similarity, 1.7, crease);
            std::rotate(moved.begin(), moved.end() - 2, moved.end());
            std::reverse(other.begin(), other.end());
            auto turned = paste_values(other, similarity, 1.7, crease);
            std::reverse(turned.begin(), turned.end());
            std::rotate(turned.begin(), turned.end() - 2, turned.end());
            for (std::size_t k = 0; k < count; ++k) {
                CHECK(difference(values[k], moved[k]) < 1e-12);
                CHECK(difference(values[k], turned[k]) < 1e-12);
            }
        }
    }
}

TEST_CASE("paste values: surfaces that are tilted alike along a loop meet, or keep the crease") {
    std::mt19937 random(2);
    const Mat3 rotation = random_rotation(random);
    const Vec3 axis = random_vector(random).normalized();
    const double tilt = 0.8;
    std::vector<RingPoint> rim(9);
    for (RingPoint& point : rim) {
        // Across the axis, so that the least rotation between the normals is about it.
        const Vec3 across = axis.cross(random_vector(random)).normalized();
        point.normal = rotation.transpose() * across;
        point.image.normal = Eigen::AngleAxisd(tilt, axis) * across;
    }
    for (const double crease : {0.0, 0.2, 0.79, 0.9}) {
        const double turned = std::max(0.0, tilt - crease);
        const Mat3 wanted = Eigen::AngleAxisd(turned, axis).toRotationMatrix() * rotation;
        for (const BoundaryValue& value : paste_values(rim, {rotation, 1.0}, 1.0, crease)) {
            CHECK((value.rotation - wanted).norm() < 1e-12);
        }
    }
}
