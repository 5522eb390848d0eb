// Whole paths of handle turns, from none to two full ones: nothing may jump, breathe or fold on the
// way.
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/models.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kDegrees = kPi / 180.0;

/// Where the high handle stands at an angle.
struct Stand {
    Affine transform;
    Vec3 about, turn;
};

/// A way of turning: the stand at `angle` for the centre of the handle, its distance from that of
/// the other, and the direction from there.
using Way = std::function<Stand(double angle, const Vec3& center, const Vec3& along)>;

// About the line through both handles, pulled by a share of their distance.
Way twisted_path(double pulled) {
    return [pulled](double angle, const Vec3& center, const Vec3& along) -> Stand {
        const Vec3 axis = along.normalized();
        const Affine turn{rotation_of_turn(angle * axis), pulled * along};
        return {turn, center, angle * axis};
    };
}

// Along an arc of unchanged length.
Stand arc(double angle, const Vec3& center, const Vec3& along) {
    const Vec3 axis = along.unitOrthogonal();
    const double length = along.norm();
    const Vec3 side = axis.cross(along) / length;
    const double part = angle > 0.0 ? std::sin(angle) / angle : 1.0;
    const double rise = angle > 0.0 ? (1.0 - std::cos(angle)) / angle : 0.0;
    return {{rotation_of_turn(angle * axis), (part - 1.0) * along + rise * length * side},
            center,
            angle * axis};
}

// About an axis askew beside the handles.
Stand skew(double angle, const Vec3& center, const Vec3& along) {
    const Vec3 across = along.unitOrthogonal();
    const Vec3 axis = (along.normalized() + 0.4 * across).normalized();
    const Vec3 about = center - 0.3 * along + 0.1 * along.norm() * across;
    return {{rotation_of_turn(angle * axis), 0.05 * along}, about, angle * axis};
}

/// Sides of a cube of side 2 with round bumps.
Mesh bumpy_cube(Index segments) {
    Mesh cube = make_box({Vec3::Constant(2.0), {segments, segments, segments}});
    for (Vec3& p : cube.edit_positions()) {
        const Vec3 wave = (5.0 * p.array()).cos();
        p *= 1.0 + 0.07 * (wave.x() * wave.y() + wave.y() * wave.z() + wave.z() * wave.x());
    }
    return cube;
}

/// Rigidity of a surface: the energy of edges against the best rotation at each vertex (Sorkine and
/// Alexa 2007), as a share of what the edges at rest have.
class Rigidity {
  public:
    explicit Rigidity(Mesh mesh) : rest_(mesh.positions().begin(), mesh.positions().end()) {
        triangulate(mesh);
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto t = mesh.topology().face(f);
            for (int k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
        }
    }

    double operator()(const std::vector<Vec3>& x) const {
        std::vector<Mat3> products(x.size(), Mat3::Zero());
        double sum = 0.0, whole = 0.0;
        for (const auto& [edge, weight] : weights_) {
            const auto [i, j] = edge;
            const Vec3 now = x[i] - x[j], before = rest_[i] - rest_[j];
            products[i] += weight * now * before.transpose();
            products[j] += weight * now * before.transpose();
            sum += 2.0 * weight * (now.squaredNorm() + before.squaredNorm());
            whole += 2.0 * weight * before.squaredNorm();
        }
        for (const Mat3& product : products) {
            sum -= 2.0 * nearest_rotation(product).cwiseProduct(product).sum();
        }
        return sum / whole;
    }

  private:
    void add(Index i, Index j, Index opposite) {
        const Vec3 a = rest_[i] - rest_[opposite], b = rest_[j] - rest_[opposite];
        const double cotangent = a.dot(b) / std::max(a.cross(b).norm(), 1e-12);
        weights_[{std::min(i, j), std::max(i, j)}] += std::max(cotangent, 0.05);
    }

    std::vector<Vec3> rest_;
    std::map<std::pair<Index, Index>, double> weights_;
};

/// The narrowest place between the handles: vertices in slices across the line between them, and
/// the least ratio of a slice's radius about the line through the slices to that at rest.
class Width {
  public:
    Width(const Scene& scene, const Vec3& from, const Vec3& along) {
        constexpr int kSlices = 13;
        slices_.resize(kSlices);
        std::vector<char> held(static_cast<std::size_t>(scene.mesh.vertex_count()), 0);
        for (const Index v : scene.low) held[v] = 1;
        for (const Index v : scene.high) held[v] = 1;
        double first = 1.0, last = 0.0;
        const auto place = [&](Index v) {
            return (scene.mesh.position(v) - from).dot(along) / along.squaredNorm();
        };
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            if (held[v]) continue;
            first = std::min(first, place(v));
            last = std::max(last, place(v));
        }
        for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
            if (held[v]) continue;
            const double t = (place(v) - first) / (last - first);
            slices_[static_cast<std::size_t>(std::min(t, 0.999) * kSlices)].push_back(v);
        }
        std::erase_if(slices_, [](const auto& slice) { return slice.size() < 6; });
        rest_ = radii({scene.mesh.positions().begin(), scene.mesh.positions().end()});
    }

    double operator()(const std::vector<Vec3>& x) const {
        const std::vector<double> now = radii(x);
        double least = 1e300;
        for (std::size_t k = 0; k < now.size(); ++k) least = std::min(least, now[k] / rest_[k]);
        return least;
    }

  private:
    std::vector<double> radii(const std::vector<Vec3>& x) const {
        std::vector<Vec3> center;
        for (const auto& slice : slices_) {
            Vec3 sum = Vec3::Zero();
            for (const Index v : slice) sum += x[v];
            center.push_back(sum / static_cast<double>(slice.size()));
        }
        std::vector<double> result;
        for (std::size_t k = 0; k < slices_.size(); ++k) {
            const std::size_t before = k > 0 ? k - 1 : 0,
                              after = std::min(k + 1, center.size() - 1);
            const Vec3 line = (center[after] - center[before]).normalized();
            double sum = 0.0;
            for (const Index v : slices_[k]) sum += line.cross(x[v] - center[k]).squaredNorm();
            result.push_back(std::sqrt(sum / static_cast<double>(slices_[k].size())));
        }
        return result;
    }

    std::vector<std::vector<Index>> slices_;
    std::vector<double> rest_;
};

/// The worst of a path, and where it was.
struct Worst {
    double value = 0.0, degrees = 0.0;
    void take(double next, double at) {
        if (next > value) *this = {next, at};
    }
};

struct TurnReport {
    /// Of a free vertex relative to the handles' fastest point.
    Worst speed;
    /// How much wider the narrowest place got than it had been, as a share of its radius at rest;
    /// how much of its energy the surface lost.
    Worst widening, relief;
};

double max_motion(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                  const std::vector<Index>& vertices) {
    double greatest = 0.0;
    for (const Index v : vertices) greatest = std::max(greatest, (to[v] - from[v]).norm());
    return greatest;
}

std::vector<Index> free_of(const Scene& scene) {
    std::vector<Index> free;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        if (!std::binary_search(scene.low.begin(), scene.low.end(), v) &&
            !std::binary_search(scene.high.begin(), scene.high.end(), v)) {
            free.push_back(v);
        }
    }
    return free;
}

TurnReport follow_turns(const Scene& scene, const Way& way, const DeformOptions& options,
                        double step, double monotonic) {
    Edit edit = make_edit(scene, options);
    const Vec3 from = edit.deformer.handle(edit.low).center;
    const Vec3 center = edit.deformer.handle(edit.high).center;
    const Rigidity rigidity(scene.mesh);
    const Width width(scene, from, center - from);
    const std::vector<Index> free = free_of(scene);
    TurnReport report;
    std::vector<Vec3> before;
    double narrowest = 1e300, highest = 0.0;
    for (double degrees = 0.0; degrees <= 720.0 + 1e-9; degrees += step) {
        const Stand stand = way(degrees * kDegrees, center, center - from);
        edit.deformer.set_transform(edit.high, stand.transform, stand.about, stand.turn);
        // Refined results that run through themselves are taken back, but drafts are not.
        const std::vector<Vec3> now =
            options.refine > 0 ? edit.deformer.solve(FrameQuality::draft) : edit.deformer.solve();
        if (!before.empty()) {
            report.speed.take(max_motion(before, now, free) / max_motion(before, now, scene.high),
                              degrees);
        }
        if (degrees <= monotonic) {
            const double radius = width(now), energy = rigidity(now);
            report.widening.take(radius - narrowest, degrees);
            if (highest > 1e-9) report.relief.take(1.0 - energy / highest, degrees);
            narrowest = std::min(narrowest, radius);
            highest = std::max(highest, energy);
        }
        before = now;
    }
    return report;
}

struct TurnPath {
    std::string name;
    Scene scene;
    Way way;
    /// Up to this angle the narrowest place may only get narrower and the energy only rise. A part
    /// that is no longer than wide opens again beyond half a turn, as its ends are then nearer to
    /// each other than to the axis; so do arms that lie off the axis.
    double monotonic = 720.0;
};

std::vector<TurnPath> turn_paths(bool fine) {
    BarOptions bar;
    bar.across = fine ? 8 : 5;
    bar.along = fine ? 48 : 30;
    bar.length = 6.0;
    CactusOptions cactus;
    cactus.vertices = fine ? 9000 : 2000;
    TorusOptions torus;
    if (!fine) torus.segments = 30, torus.tube_segments = 12;
    Mesh egg = make_sphere({1.0, fine ? 16 : 8, SphereKind::triangles});
    for (Vec3& p : egg.edit_positions()) p.y() *= 2.5;
    const Scene long_bar = make_scene(make_bar(bar), 0.1);
    return {{"bar, twist", long_bar, twisted_path(0.0)},
            {"bar, arc", long_bar, arc},
            {"bar, skew", long_bar, skew},
            {"cactus, twist", make_scene(make_cactus(cactus), 0.12), twisted_path(0.0)},
            {"bumpy cube, twist", make_scene(bumpy_cube(fine ? 24 : 12), 0.2), twisted_path(1.5),
             180.0},
            {"egg, twist", make_scene(egg, 0.15), twisted_path(0.2), 180.0},
            {"torus, twist", make_scene(make_torus(torus), 0.15), twisted_path(0.0), 180.0}};
}

}  // namespace

TEST_CASE("turn path: nothing jumps, widens or relaxes from none to two full turns") {
    const bool fine = std::getenv("LISSOM_TRIALS") != nullptr;
    for (const TurnPath& path : turn_paths(fine)) {
        for (int refine = 0; refine <= 2; ++refine) {
            DeformOptions options;
            options.refine = refine;
            options.subdivide_borders = false;
            const TurnReport report =
                follow_turns(path.scene, path.way, options, fine ? 1.0 : 5.0, path.monotonic);
            CAPTURE(path.name);
            CAPTURE(refine);
            CAPTURE(report.speed.degrees);
            CAPTURE(report.widening.degrees);
            CAPTURE(report.relief.degrees);
            CHECK(report.speed.value <= 2.0);
            CHECK(report.widening.value <= 0.02);
            CHECK(report.relief.value <= 0.02);
        }
    }
}
