#include "viewer/render/strands/strand_shading.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "viewer/render/draw/studio_light.h"

using namespace lissom;
using doctest::Approx;
using Eigen::Array3f;
using Eigen::Vector3f;

namespace {

// A direction in the xy plane, `angle` radians from +x towards +y.
Vector3f in_plane(double angle) {
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0f};
}

// Directions all over the sphere.
std::vector<Vector3f> directions(int count) {
    std::vector<Vector3f> result;
    for (int i = 0; i < count; ++i) {
        const double y = 1.0 - (2.0 * i + 1.0) / count, angle = 2.39996322972865332 * i;
        const double r = std::sqrt(1.0 - y * y);
        result.push_back(
            Eigen::Vector3d(r * std::cos(angle), y, r * std::sin(angle)).cast<float>());
    }
    return result;
}

StrandPoint brown(const Vector3f& tangent) {
    StrandPoint point;
    point.tangent = tangent;
    point.color = Array3f(0.26f, 0.15f, 0.075f);
    return point;
}

}  // namespace

TEST_CASE("strand shading: diffuse light is that of the light across the strand") {
    const Vector3f strand = Vector3f::UnitX();
    CHECK(strand_diffuse(strand, Vector3f::UnitY()) == Approx(1.0));
    CHECK(strand_diffuse(strand, strand) == Approx(0.0));
    CHECK(strand_diffuse(strand, in_plane(0.7)) == Approx(std::sin(0.7)));
    CHECK(strand_diffuse(-strand, in_plane(0.7)) == Approx(std::sin(0.7)));
}

TEST_CASE("strand shading: the reflection is brightest on the mirror cone, turned by the shift") {
    const Vector3f strand = Vector3f::UnitX();
    for (const double shift : {-0.2, 0.0, 0.1}) {
        for (const double light : {-0.6, 0.0, 0.4}) {
            // Angles from the plane across the strand: out at -in, plus the shift.
            const HairLobe lobe{1.0, 70.0, shift};
            const Vector3f to_light = in_plane(kPi / 2 - light);
            double best = -1.0, at = 0.0;
            for (double out = -1.3; out < 1.3; out += 0.001) {
                const double seen =
                    strand_reflection(lobe, 0.0f, strand, to_light, in_plane(kPi / 2 - out));
                if (seen > best) {
                    best = seen;
                    at = out;
                }
            }
            CAPTURE(shift);
            CAPTURE(light);
            CHECK(best == Approx(1.0).epsilon(1e-4));
            CHECK(at == Approx(shift - light).epsilon(0.01));
        }
    }
}

TEST_CASE("strand shading: the cone goes all around the strand") {
    const HairLobe lobe{1.0, 40.0, 0.0};
    const Vector3f strand = Vector3f::UnitX();
    const Vector3f to_light = in_plane(kPi / 2 - 0.5);
    const Vector3f mirrored = in_plane(kPi / 2 + 0.5);
    for (const float turn : {0.3f, 1.5f, 3.0f}) {
        const Vector3f to_viewer = Eigen::AngleAxisf(turn, strand) * mirrored;
        CHECK(strand_reflection(lobe, 0.0f, strand, to_light, to_viewer) ==
              Approx(1.0).epsilon(1e-4));
    }
}

TEST_CASE("strand shading: a higher exponent is sharper, a jitter is a shift") {
    const Vector3f strand = Vector3f::UnitX();
    const Vector3f to_light = Vector3f::UnitY(), beside = in_plane(kPi / 2 - 0.3);
    const float dull = strand_reflection({1, 10, 0}, 0.0f, strand, to_light, beside);
    const float sharp = strand_reflection({1, 80, 0}, 0.0f, strand, to_light, beside);
    CHECK(dull > 2.0f * sharp);
    CHECK(strand_reflection({1, 80, 0.1}, 0.2f, strand, to_light, beside) ==
          Approx(strand_reflection({1, 80, 0.3}, 0.0f, strand, to_light, beside)));
}

TEST_CASE("strand shading: reflections are as wide as on real hair") {
    // A cosine to the power n of both angles together is a Gaussian of variance 1 / n; roughness is
    // told of their mean (Marschner et al. 2003, table 1).
    const auto degrees = [](const HairLobe& lobe) {
        return 0.5 / std::sqrt(lobe.exponent) * 180.0 / kPi;
    };
    const StrandStyle style;
    CHECK(degrees(style.primary) >= 5.0);
    CHECK(degrees(style.primary) <= 10.0);
    CHECK(degrees(style.secondary) >= 1.5 * degrees(style.primary));
    CHECK(degrees(style.secondary) <= 2.0 * degrees(style.primary));
}

TEST_CASE("strand shading: light through hair tints skin less than strands, and is as much") {
    for (const Array3f& color : {Array3f(0.26f, 0.15f, 0.075f), Array3f(0.04f, 0.03f, 0.02f),
                                 Array3f(0.6f, 0.45f, 0.2f)}) {
        const Array3f strands = relative_loss(color), skin = loss_on_skin(color);
        CHECK(skin.mean() == Approx(strands.mean()));
        CHECK(skin.maxCoeff() - skin.minCoeff() < 0.5f * (strands.maxCoeff() - strands.minCoeff()));
        CHECK(skin.minCoeff() > 0.0f);
    }
}

TEST_CASE("strand shading: the primary reflection is white, the secondary has the hair's colour") {
    StrandStyle style;
    style.secondary.strength = 0.0;
    StrandStyle none = style;
    none.primary.strength = 0.0;
    const Vector3f to_light = kKeyLight.direction.normalized();
    // The mirror cone of the key light as the viewer on +z sees it, leaning by the shift.
    StrandPoint best;
    float most = -1.0f;
    for (const Vector3f& tangent : directions(4000)) {
        const float seen =
            strand_reflection(style.primary, 0.0f, tangent, to_light, Vector3f::UnitZ());
        if (seen > most) best = brown(tangent);
        most = std::max(most, seen);
    }
    const Array3f white = (shade_strand(style, best) - shade_strand(none, best)) / kKeyLight.color;
    CHECK(white.minCoeff() > 0.05f);
    CHECK(white.maxCoeff() < 1.3f * white.minCoeff());
    StrandStyle colored = none;
    colored.secondary = {1.0, 14.0, 0.1};
    const Array3f added = shade_strand(colored, best) - shade_strand(none, best);
    CHECK(added[0] / added[2] == Approx(0.26 / 0.075).epsilon(0.1));
}

TEST_CASE("strand shading: brightness is bounded and never negative") {
    const StrandStyle style;
    const float lights = 1.10f + 0.16f + 0.25f;
    for (const Vector3f& tangent : directions(200)) {
        for (const Vector3f& to_viewer : directions(40)) {
            StrandPoint point = brown(tangent);
            point.to_viewer = to_viewer;
            const Array3f color = shade_strand(style, point);
            CHECK(color.minCoeff() >= 0.0f);
            CHECK(color.maxCoeff() <= 0.35f * 0.26f + lights * (0.26f * 1.1f + 0.3f));
            point.light = {0.0f, 0.0f, 0.0f};
            CHECK((shade_strand(style, point) <= color + 1e-6f).all());
            point.light = {0.5f, 0.5f, 0.5f};
            CHECK((shade_strand(style, point) <= color + 1e-6f).all());
        }
    }
}

TEST_CASE("strand shading: degenerate strands are not lit and not NaN") {
    const StrandStyle style;
    CHECK((shade_strand(style, brown(Vector3f::Zero())) == 0.0f).all());
    CHECK(shade_strand(style, brown(Vector3f::UnitZ())).allFinite());
    CHECK(shade_strand(style, brown(kKeyLight.direction.normalized())).allFinite());
    CHECK((shade_strand(style, brown(Vector3f::Constant(std::nanf("")))) == 0.0f).all());
}

TEST_CASE("strand shading: light hair lets more light through") {
    const Array3f dark = Array3f::Constant(0.02f), brown = Array3f::Constant(0.16f),
                  blond = Array3f::Constant(0.6f);
    for (const float light : {0.1f, 0.5f, 0.9f}) {
        CHECK(light_through_hair(light, brown)[0] == Approx(light).epsilon(0.03));
        CHECK(light_through_hair(light, dark)[0] < light);
        CHECK(light_through_hair(light, blond)[0] > light);
        CHECK(light_through_hair(light, Array3f::Ones())[0] < 1.0f);
    }
    CHECK((light_through_hair(1.0f, brown) == 1.0f).all());
    CHECK((light_through_hair(0.0f, brown) == 0.0f).all());
    // More strands behind each other: as many factors.
    const float once = light_through_hair(0.5f, blond)[0];
    CHECK(light_through_hair(0.25f, blond)[0] == Approx(once * once));
    CHECK((forward_scattering(Array3f::Ones()) < 1.0f).all());
    CHECK((forward_scattering(Array3f::Zero()) > 0.0f).all());
}

TEST_CASE("strand shading: light goes through a strand on the side away from it") {
    const Vector3f strand = Vector3f::UnitY();
    const auto through = [&](const Vector3f& to_light, const Vector3f& to_viewer) {
        return strand_transmission(0.05f, strand, to_light, to_viewer);
    };
    CHECK(through(-Vector3f::UnitZ(), Vector3f::UnitZ()) == Approx(1.0).epsilon(1e-4));
    CHECK(through(Vector3f::UnitZ(), Vector3f::UnitZ()) < 0.002f);
    CHECK(through(Vector3f::UnitX(), Vector3f::UnitZ()) < 0.1f);
    for (const Vector3f& to_light : directions(50)) {
        for (const Vector3f& to_viewer : directions(60)) {
            const float part = through(to_light, to_viewer);
            CHECK(part >= 0.0f);
            CHECK(part <= 1.0f);
            // Its angle around the strand counts alone.
            const Eigen::AngleAxisf turn(1.1f, strand);
            CHECK(through(turn * to_light, turn * to_viewer) == Approx(part).epsilon(1e-3));
        }
    }
}

TEST_CASE("strand shading: the darker the hair, the less light it gives") {
    const StrandStyle style;
    for (const Vector3f& tangent : directions(40)) {
        for (const float left : {0.02f, 0.3f, 1.0f}) {
            Array3f before = Array3f::Zero();
            for (const float color : {0.005f, 0.02f, 0.1f, 0.3f, 0.6f, 0.9f}) {
                StrandPoint point = brown(tangent);
                point.color = Array3f::Constant(color);
                point.light = {left, left, left};
                const Array3f seen = shade_strand(style, point);
                CHECK((seen >= before).all());
                before = seen;
            }
        }
    }
}

TEST_CASE("strand shading: with the light behind, blond hair glows and brown hair does not") {
    const StrandStyle style;
    const auto behind = [&](const Array3f& color, float left) {
        double sum = 0.0;
        for (const Vector3f& tangent : directions(200)) {
            StrandPoint point = brown(tangent);
            point.color = color;
            point.light = {0.0f, left, 0.0f};
            const Array3f lit = shade_strand(style, point);
            point.light = {0.0f, 0.0f, 0.0f};
            sum += (lit - shade_strand(style, point)).mean();
        }
        return sum / 200;
    };
    const Array3f brown_color(0.26f, 0.15f, 0.075f), blond(0.69f, 0.48f, 0.19f);
    const double ratio = blond.mean() / brown_color.mean();
    CHECK(behind(blond, 1.0f) > behind(brown_color, 1.0f));
    // Through much hair, by far more than their colours are apart.
    CHECK(behind(blond, 0.1f) > 1.5 * ratio * behind(brown_color, 0.1f));
}

TEST_CASE("strand shading: hair of any colour is no brighter than the light on it") {
    const StrandStyle style;
    const Array3f lights = kKeyLight.color + kFillLight.color + kRimLight.color + kSkyLight;
    for (const float color : {0.1f, 0.5f, 1.0f}) {
        Array3f sum = Array3f::Zero();
        int count = 0;
        for (const Vector3f& tangent : directions(100)) {
            for (const Vector3f& to_viewer : directions(40)) {
                StrandPoint point = brown(tangent);
                point.color = Array3f::Constant(color);
                point.to_viewer = to_viewer;
                sum += shade_strand(style, point);
                ++count;
            }
        }
        CHECK((sum / count < lights).all());
    }
    // Nor is that through colours beyond white.
    CHECK((light_through_hair(0.3f, Array3f::Constant(4.0f)) < 1.0f).all());
}
