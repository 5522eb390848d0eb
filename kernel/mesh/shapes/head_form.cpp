#include "kernel/mesh/shapes/head_form.h"

#include <algorithm>
#include <cmath>

// Solids that are blended into each other: skull, face, neck and chest first, then what lies on
// them. Every solid that is not in the middle stands for two, since only |x| counts. Lengths are
// metres.
namespace lissom {
namespace {

// Polynomial smooth minimum: solids joined with a fillet of about `fillet`.
double join(double a, double b, double fillet) {
    const double h = std::max(fillet - std::abs(a - b), 0.0) / fillet;
    return std::min(a, b) - 0.25 * h * h * fillet;
}

// The first solid without the second.
double carve(double a, double b, double fillet) {
    return -join(-a, b, fillet);
}

double ball(const Vec3& p, const Vec3& center, double radius) {
    return (p - center).norm() - radius;
}

double ellipsoid(const Vec3& p, const Vec3& center, const Vec3& radii) {
    const Vec3 q = (p - center).cwiseQuotient(radii);
    const double length = q.norm();
    const double slope = q.cwiseQuotient(radii).norm();
    return slope > 0.0 ? length * (length - 1.0) / slope : -radii.minCoeff();
}

// A rod whose radius changes evenly from one end to the other.
double rod(const Vec3& p, const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
    const Vec3 along = b - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - a - t * along).norm() - (radius_a + t * (radius_b - radius_a));
}

// |x| without the kink in the middle: pairs of solids then meet there smoothly.
Vec3 rounded(const Vec3& p, double radius) {
    return {std::sqrt(p.x() * p.x() + radius * radius), p.y(), p.z()};
}

double skull(const Vec3& p) {
    const double back = ellipsoid(p, Vec3(0, 0.016, -0.022), Vec3(0.0732, 0.0785, 0.0755));
    const double front = ellipsoid(p, Vec3(0, 0.012, 0.024), Vec3(0.0630, 0.0765, 0.0665));
    const double occiput = ellipsoid(p, Vec3(0, -0.022, -0.045), Vec3(0.060, 0.052, 0.052));
    return join(join(back, front, 0.05), occiput, 0.03);
}

double face(const Vec3& p) {
    const Vec3 q = rounded(p, 0.006);
    const double middle = ellipsoid(p, Vec3(0, -0.040, 0.028), Vec3(0.059, 0.062, 0.062));
    const double mouth = ellipsoid(p, Vec3(0, -0.078, 0.050), Vec3(0.036, 0.036, 0.042));
    const double cheek = ellipsoid(q, Vec3(0.042, -0.034, 0.050), Vec3(0.022, 0.018, 0.025));
    const double jaw =
        rod(q, Vec3(0.048, -0.060, -0.004), 0.016, Vec3(0.014, -0.107, 0.066), 0.012);
    const double chin = ellipsoid(p, Vec3(0, -0.109, 0.074), Vec3(0.018, 0.015, 0.0185));
    double d = join(middle, mouth, 0.03);
    d = join(d, jaw, 0.035);
    d = join(d, chin, 0.024);
    return join(d, cheek, 0.03);
}

double neck(const Vec3& p) {
    const Vec3 q = rounded(p, 0.010);
    const double column = rod(p, Vec3(0, -0.05, -0.026), 0.050, Vec3(0, -0.23, -0.042), 0.049);
    const double cord =
        rod(q, Vec3(0.054, -0.050, -0.026), 0.008, Vec3(0.020, -0.222, 0.004), 0.007);
    return join(column, cord, 0.03);
}

double chest(const Vec3& p) {
    const Vec3 q = rounded(p, 0.014);
    const double trapezius =
        rod(q, Vec3(0.018, -0.165, -0.056), 0.028, Vec3(0.130, -0.236, -0.050), 0.028);
    const double shoulder = ball(p, Vec3(0.160, -0.276, -0.042), 0.052);
    const double trunk = ellipsoid(p, Vec3(0, -0.350, -0.034), Vec3(0.180, 0.130, 0.094));
    const double collar =
        rod(q, Vec3(0.024, -0.236, 0.020), 0.008, Vec3(0.130, -0.230, -0.016), 0.010);
    double d = join(trunk, trapezius, 0.07);
    d = join(d, shoulder, 0.06);
    return join(d, collar, 0.035);
}

double brow(const Vec3& p) {
    const Vec3 q = rounded(p, 0.005);
    const double inner =
        rod(q, Vec3(0.008, 0.009, 0.0785), 0.009, Vec3(0.033, 0.013, 0.0725), 0.0095);
    const double outer =
        rod(q, Vec3(0.033, 0.013, 0.0725), 0.0095, Vec3(0.053, 0.003, 0.050), 0.009);
    return join(inner, outer, 0.006);
}

double nose(const Vec3& p) {
    const Vec3 q = rounded(p, 0.003);
    const double bridge = rod(p, Vec3(0, 0.006, 0.0790), 0.0105, Vec3(0, -0.040, 0.1020), 0.0105);
    const double tip = ball(p, Vec3(0, -0.0455, 0.1045), 0.0115);
    const double wing = ellipsoid(q, Vec3(0.0130, -0.050, 0.092), Vec3(0.0085, 0.0080, 0.0115));
    return join(join(bridge, tip, 0.014), wing, 0.012);
}

// Two rolls that thin out and lie back towards the corners of the mouth.
double lips(const Vec3& p) {
    const double bend = 10.0 * p.x() * p.x();
    const Vec3 q(p.x(), p.y(), p.z() + bend);
    const double upper = ellipsoid(q, Vec3(0, -0.0745, 0.0860), Vec3(0.0270, 0.0078, 0.0150));
    const double lower = ellipsoid(q, Vec3(0, -0.0880, 0.0850), Vec3(0.0225, 0.0088, 0.0150));
    return join(upper, lower, 0.004);
}

// A shell that stands off the head, its rim to the back.
double ear(const Vec3& p) {
    const Vec3 center(0.0765, -0.028, -0.011);
    const double turn = 0.50, lean = 0.20;
    const Vec3 d = p - center;
    const Vec3 turned(std::cos(turn) * d.x() + std::sin(turn) * d.z(), d.y(),
                      -std::sin(turn) * d.x() + std::cos(turn) * d.z());
    const Vec3 q(turned.x(), std::cos(lean) * turned.y() - std::sin(lean) * turned.z(),
                 std::sin(lean) * turned.y() + std::cos(lean) * turned.z());
    const double upper = ellipsoid(q, Vec3(0, 0.008, 0), Vec3(0.0105, 0.026, 0.0200));
    const double lobe = ellipsoid(q, Vec3(0, -0.018, 0.005), Vec3(0.0090, 0.015, 0.0115));
    const double bowl = ellipsoid(q, Vec3(0.0125, 0.004, 0.003), Vec3(0.0085, 0.0165, 0.0105));
    return carve(join(upper, lobe, 0.014), bowl, 0.008);
}

double eyes(const Vec3& p) {
    return ellipsoid(p, Vec3(0.0325, -0.0125, 0.0670), Vec3(0.0175, 0.0115, 0.0185));
}

// The head for x >= 0.
double half_form(const Vec3& p) {
    double d = join(skull(p), face(p), 0.035);
    d = join(d, neck(p), 0.035);
    d = join(d, chest(p), 0.075);
    d = join(d, brow(p), 0.020);
    const double socket = ellipsoid(p, Vec3(0.0330, -0.0105, 0.0975), Vec3(0.0205, 0.0125, 0.0165));
    d = carve(d, socket, 0.015);
    d = join(d, eyes(p), 0.005);
    d = join(d, nose(p), 0.016);
    d = join(d, lips(p), 0.007);
    d = join(d, ear(p), 0.012);
    return -join(-d, p.y() - kHeadBottom, 0.02);
}

}  // namespace

Box head_form_box() {
    return {Vec3(-0.235, -0.305, -0.160), Vec3(0.235, 0.110, 0.135)};
}

double head_form(const Vec3& p) {
    return half_form(Vec3(std::abs(p.x()), p.y(), p.z()));
}

Vec3 head_form_gradient(const Vec3& p) {
    constexpr double kStep = 1e-5;
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 h = kStep * Vec3::Unit(axis);
        gradient[axis] = (head_form(p + h) - head_form(p - h)) / (2.0 * kStep);
    }
    return gradient;
}

double head_ears(const Vec3& p) {
    return ear(Vec3(std::abs(p.x()), p.y(), p.z()));
}

}  // namespace lissom
