#include "viewer/render/strands/hair_light.h"

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/hair/strands/strand_random.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/render/strands/strand_support.h"
#include "viewer/render/draw/studio_light.h"
#include "viewer/render/strands/strand_shadow.h"

using namespace lissom;
using doctest::Approx;
using Eigen::Vector3f;

namespace {

// A ball of hair of a tenth of a metre, and a mesh below it.
Snapshot hairy_ball(Index count) {
    std::vector<std::vector<Vec3>> lines;
    for (Index s = 0; s < count; ++s) {
        const Vec3 d = random_vector(7, s).normalized();
        lines.push_back({0.03 * d, 0.06 * d, 0.1 * d});
    }
    Snapshot snapshot = test::drawing_of(test::strands_of(lines, 0.0004));
    DrawnMesh mesh{test::shared(make_box())};
    mesh.transform = {0.1 * Mat3::Identity(), Vec3(0, -0.2, 0)};
    snapshot.meshes = {mesh};
    return snapshot;
}

}  // namespace

TEST_CASE("hair light: for one camera it is that of a picture") {
    const Snapshot snapshot = hairy_ball(3000);
    const HairLight light(snapshot, Vec3::Zero());
    Mat4 view = Mat4::Identity();
    view.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(0.8, Vec3(0.2, 1.0, 0.1).normalized()).toRotationMatrix();
    const auto strands = view_strands(snapshot, view, Vec3::Zero());
    const StrandShadow shadow(strands, view_triangles(snapshot, view, Vec3::Zero()));
    const auto texels = light.directed(view.topLeftCorner<3, 3>());
    const Eigen::Matrix3f turn = view.topLeftCorner<3, 3>().cast<float>();
    const float nearer = kTowardsLight * light.grid().step;
    double sum = 0.0, ambient_sum = 0.0, from_moments = 0.0;
    int count = 0;
    for (Index s = 0; s < 400; ++s) {
        const Vector3f p = 0.1f * random_vector(3, s).cast<float>();
        const StrandLight wanted = shadow.light(turn * p);
        float key = 0.0f, ambient = 0.0f, rough = 0.0f;
        const Vector3f to_key = turn.transpose() * kKeyLight.direction.normalized();
        for_each_corner(light.grid(), p + nearer * to_key, [&](std::size_t i, float weight) {
            const float root = static_cast<float>(texels[4 * i]) / 255.0f;
            key += weight * root * root;
            rough += weight * light_from(light.for_strands().data() + 4 * i, to_key);
        });
        for_each_corner(light.grid(), p, [&](std::size_t i, float weight) {
            ambient +=
                weight * ambient_light(light.for_strands().data() + 4 * i, turn.transpose().col(1));
        });
        sum += std::abs(key - wanted.key);
        from_moments += rough - wanted.key;
        ambient_sum += std::abs(ambient - wanted.ambient);
        ++count;
    }
    CHECK(sum / count < 0.03);
    CHECK(ambient_sum / count < 0.03);
    // By its moments it is softer, not brighter or darker.
    CHECK(std::abs(from_moments / count) < 0.06);
}

TEST_CASE("hair light: without hair all light is left") {
    const HairLight light({}, Vec3::Zero());
    REQUIRE(light.grid().size() == 1);
    CHECK(light_from(light.for_strands().data(), Vector3f::UnitX()) == Approx(1.0).epsilon(0.01));
    CHECK(ambient_light(light.for_meshes().data(), Vector3f::UnitY()) == Approx(1.0).epsilon(0.01));
    CHECK(light.undirected() == std::vector<std::uint8_t>{0, 0, 0, 0});
}

TEST_CASE("hair light: moments of light from one side point there") {
    // Half of all directions are open: 0.5 + 0.75 cos, by least squares.
    const std::array<std::uint8_t, 4> half{128, 128, 223, 128};
    CHECK(light_from(half.data(), Vector3f::UnitY()) == Approx(1.0));
    CHECK(light_from(half.data(), Vector3f::UnitX()) == Approx(0.5).epsilon(0.02));
    CHECK(light_from(half.data(), -Vector3f::UnitY()) == Approx(0.0));
    // More light comes from the sky than from the ground.
    CHECK(ambient_light(half.data(), Vector3f::UnitY()) >
          ambient_light(half.data(), -Vector3f::UnitY()) + 0.05f);
}

TEST_CASE("hair light: far from the world's middle it is the same") {
    Snapshot snapshot = hairy_ball(500);
    const HairLight near(snapshot, Vec3::Zero());
    const Vec3 far(4e5, -3e5, 2e5);
    snapshot.strands[0].transform = translation(far);
    snapshot.meshes[0].transform = translation(far) * snapshot.meshes[0].transform;
    const HairLight moved(snapshot, far);
    CHECK(moved.grid().counts == near.grid().counts);
    double sum = 0.0;
    for (std::size_t i = 0; i < near.for_strands().size(); ++i) {
        sum += std::abs(int{moved.for_strands()[i]} - int{near.for_strands()[i]});
    }
    CHECK(sum / static_cast<double>(near.for_strands().size()) < 0.5);
}
