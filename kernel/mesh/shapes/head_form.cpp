#include "kernel/mesh/shapes/head_form.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/core/roots.h"

// Solids that are blended into each other: skull, face, neck and chest first, then the parts on
// them. Every solid that is not in the middle stands for two, since only |x| counts. Lengths are
// metres.
namespace lissom {
namespace {

// Polynomial smooth minimum: solids joined with a fillet of about `fillet`.
double join(double a, double b, double fillet) {
    const double h = std::max(fillet - std::abs(a - b), 0.0) / fillet;
    return std::min(a, b) - 0.25 * h * h * fillet;
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
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
    const Vec3 q = rounded(p, 0.006);
    const double inner =
        rod(q, Vec3(0.010, 0.0085, 0.0770), 0.0080, Vec3(0.033, 0.0125, 0.0730), 0.0078);
    const double outer =
        rod(q, Vec3(0.033, 0.0125, 0.0730), 0.0078, Vec3(0.052, 0.0040, 0.0530), 0.0080);
    return join(inner, outer, 0.006);
}

// ---- Eyes: a ball, and over it two lids, whose opening is an almond as seen from the front.

const Vec3 kEye(0.0320, -0.0098, 0.0655);
constexpr double kEyeRadius = 0.0126;
// The opening goes down to an ellipsoid, which fills the corners.
const Vec3 kWhite(0.0210, 0.0130, 0.0124);

// About the distance to the edge of the opening, in the plane of the face, negative in the opening.
double almond(const Vec3& d) {
    const double x = d.x() + 0.08 * d.y(), y = d.y() - 0.08 * d.x();
    // Two arcs that meet in the corners.
    constexpr double kHalf = 0.0128, kUpper = 0.0050, kLower = 0.0040;
    const auto arc = [&](double height, double sign) {
        const double radius = (kHalf * kHalf + height * height) / (2.0 * height);
        return hypotenuse(x, sign * y + radius - height) - radius;
    };
    return std::max(arc(kUpper, 1.0), arc(kLower, -1.0));
}

double lids(const Vec3& p) {
    const Vec3 d = p - kEye;
    const double upper = ellipsoid(d, Vec3(0.0005, 0.0012, -0.0004), Vec3(0.0165, 0.0145, 0.0150));
    const double lower = ellipsoid(d, Vec3(0, -0.0020, -0.0020), Vec3(0.0160, 0.0130, 0.0150));
    return join(upper, lower, 0.003);
}

// ---- Ears, in a frame of their own: x out of the plane of the shell, y up, z to the face.

Vec3 in_ear(const Vec3& p) {
    constexpr double kTurn = 0.50, kLean = 0.18;
    const Vec3 d = p - Vec3(0.0755, -0.0295, -0.0135);
    const Vec3 turned(std::cos(kTurn) * d.x() + std::sin(kTurn) * d.z(), d.y(),
                      -std::sin(kTurn) * d.x() + std::cos(kTurn) * d.z());
    return {turned.x(), std::cos(kLean) * turned.y() - std::sin(kLean) * turned.z(),
            std::sin(kLean) * turned.y() + std::cos(kLean) * turned.z()};
}

// About the distance to the outline in the plane of the shell, negative inside.
double ear_outline(const Vec3& q) {
    const Vec3 flat(0.0, q.y(), q.z());
    constexpr double kAny = 1.0;
    const double upper = ellipsoid(flat, Vec3(0, 0.0050, -0.0020), Vec3(kAny, 0.0235, 0.0165));
    const double lobe = ellipsoid(flat, Vec3(0, -0.0165, 0.0045), Vec3(kAny, 0.0120, 0.0085));
    return join(upper, lobe, 0.014);
}

// A ridge of a radius along a line that runs `inward` of the outline, `out` of the plane.
double ear_ridge(const Vec3& q, double outline, double inward, double out, double radius) {
    return hypotenuse(outline + inward, q.x() - out) - radius;
}

}  // namespace

HeadForm::HeadForm(double cell) : cell_(cell), shell_(std::max(0.0034, 0.9 * cell)) {}

double HeadForm::ear(const Vec3& p) const {
    const Vec3 q = in_ear(p);
    // Farther than that it is not near enough to be joined to the head.
    constexpr double kReach = 0.07, kSize = 0.04;
    if (q.norm() > kReach) return q.norm() - kSize;
    const double outline = ear_outline(q);
    // A little hollow from in front.
    const double inward = std::max(outline, -0.0080);
    const double middle = 0.0010 - 60.0 * inward * inward;
    double d = -join(shell_ - std::abs(q.x() - middle), -outline, 0.004);
    const double root = ellipsoid(q, Vec3(-0.0090, 0.0010, 0.0050), Vec3(0.0110, 0.0200, 0.0080));
    d = join(d, root, 0.006);
    // The rim is thick but for the lobe, and sinks into the head in front.
    const double lower = smooth_step(-0.0020, -0.0150, q.y());
    const double rim = ear_ridge(q, outline, 0.0008, 0.0028, 0.0029 - 0.0026 * lower);
    d = join(d, rim, 0.0025);
    const double faded = smooth_step(0.0030, -0.0040, q.z()) * smooth_step(-0.0170, -0.0090, q.y());
    const double ridge = ear_ridge(q, outline, 0.0085, 0.0022, 0.0030 * faded - 0.0005);
    d = join(d, ridge, 0.004);
    const double bowl = ellipsoid(q, Vec3(0.0055, -0.0030, 0.0025), Vec3(0.0085, 0.0115, 0.0080));
    d = carve(d, bowl, 0.0035);
    const double crus =
        rod(q, Vec3(0.0000, 0.0000, 0.0010), 0.0012, Vec3(0.0030, 0.0040, 0.0120), 0.0022);
    d = join(d, crus, 0.002);
    const double tragus = ellipsoid(q, Vec3(0.0020, -0.0055, 0.0125), Vec3(0.0040, 0.0055, 0.0036));
    return join(d, tragus, 0.003);
}

double HeadForm::ears(const Vec3& p) const {
    return ear(Vec3(std::abs(p.x()), p.y(), p.z()));
}

double HeadForm::eye(const Vec3& p, double rest) const {
    const Vec3 d = p - kEye;
    if (d.norm() > 0.05) return rest;
    const double socket = ellipsoid(p, Vec3(0.0325, -0.0085, 0.0972), Vec3(0.0205, 0.0130, 0.0155));
    rest = join(carve(rest, socket, 0.018), lids(p), 0.0050);
    // Coarse cells show closed lids over larger balls.
    const double closed = 0.0045 * smooth_step(0.0030, 0.0060, cell_);
    const double white = ellipsoid(p, kEye, kWhite) - 0.3 * cell_;
    const double opening = std::max({almond(d), -white, -d.z()}) + closed;
    rest = carve(rest, opening, std::max(0.0012, 0.4 * cell_));
    const Vec3 radii(kEyeRadius + 0.6 * closed, kEyeRadius, kEyeRadius + 1.2 * closed);
    return join(rest, ellipsoid(p, kEye, radii), std::max(0.0006, 0.5 * cell_));
}

double HeadForm::nose(const Vec3& p, double rest) const {
    const Vec3 q = rounded(p, 0.002);
    const double bridge = rod(p, Vec3(0, 0.0060, 0.0770), 0.0088, Vec3(0, -0.0350, 0.0975), 0.0088);
    const double tip = ball(p, Vec3(0, -0.0405, 0.1030), 0.0098);
    const double side = ball(q, Vec3(0.0045, -0.0425, 0.1000), 0.0075);
    const double wing = ellipsoid(q, Vec3(0.0120, -0.0455, 0.0910), Vec3(0.0060, 0.0068, 0.0100));
    const double septum =
        rod(p, Vec3(0, -0.0475, 0.1010), 0.0042, Vec3(0, -0.0500, 0.0880), 0.0050);
    double d = join(join(bridge, tip, 0.012), side, 0.006);
    d = join(join(d, wing, 0.006), septum, 0.004);
    d = join(rest, d, 0.010);
    const double hole = ellipsoid(q, Vec3(0.0066, -0.0500, 0.0968), Vec3(0.0024, 0.0042, 0.0048));
    return carve(d, hole + 0.006 * smooth_step(0.0015, 0.0030, cell_), 0.0015);
}

// Both lips, the bow of the upper one, and the line between them, which lies back towards the
// corners.
double HeadForm::mouth(const Vec3& p, double rest) const {
    const double bend = 9.0 * p.x() * p.x();
    const Vec3 q(p.x(), p.y(), p.z() + bend);
    const Vec3 r = rounded(q, 0.0015);
    const double bow = ellipsoid(r, Vec3(0.0070, -0.0722, 0.0868), Vec3(0.0165, 0.0054, 0.0120));
    const double middle = ellipsoid(q, Vec3(0, -0.0742, 0.0888), Vec3(0.0080, 0.0050, 0.0115));
    const double lower = ellipsoid(r, Vec3(0.0055, -0.0834, 0.0870), Vec3(0.0150, 0.0070, 0.0120));
    double d = join(rest, join(join(bow, middle, 0.003), lower, 0.002), 0.005);
    const Vec3 s(p.x(), p.y() + 0.0772 + 1.5 * p.x() * p.x(), q.z());
    const double line =
        ellipsoid(s, Vec3(0, 0, 0.0960), Vec3(0.0175, 0.0007 + 0.2 * cell_, 0.0080));
    const double coarse = 0.003 * smooth_step(0.0040, 0.0070, cell_);
    d = carve(d, line + coarse, std::max(0.0020, 0.6 * cell_));
    const double corner = ball(q, Vec3(0.0228, -0.0785, 0.0985), 0.0030);
    d = carve(d, corner + coarse, 0.006);
    const double groove =
        rod(p, Vec3(0, -0.0560, 0.0985), 0.0018, Vec3(0, -0.0660, 0.1000), 0.0026);
    return carve(d, groove + coarse, 0.006);
}

// The head for x >= 0.
double HeadForm::half(const Vec3& p) const {
    double d = join(skull(p), face(p), 0.035);
    d = join(d, neck(p), 0.035);
    d = join(d, chest(p), 0.075);
    d = join(d, brow(p), 0.020);
    d = eye(p, d);
    d = nose(p, d);
    d = mouth(p, d);
    d = join(d, ear(p), std::max(0.011, 2.0 * cell_));
    return -join(-d, p.y() - kHeadBottom, 0.02);
}

double HeadForm::operator()(const Vec3& p) const {
    return half(Vec3(std::abs(p.x()), p.y(), p.z()));
}

Vec3 HeadForm::gradient(const Vec3& p) const {
    constexpr double kStep = 1e-5;
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 h = kStep * Vec3::Unit(axis);
        gradient[axis] = ((*this)(p + h) - (*this)(p - h)) / (2.0 * kStep);
    }
    return gradient;
}

Box head_form_box() {
    return {Vec3(-0.235, -0.305, -0.160), Vec3(0.235, 0.110, 0.135)};
}

}  // namespace lissom
