#include "kernel/merge/loop/part_shape.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// Vertices that are mirrored to judge a plane, and the share of them that screens the first planes
// and fits the best.
constexpr Index kProbes = 400;
constexpr std::size_t kScreening = 4;
// First planes are judged by all vertices if the screening finds them this near to the best: well
// beyond kClearlyFlatter and kClearlyLess, so that the sample does not decide.
constexpr double kNearBest = 1.7, kNearlyBest = 0.04;
// Planes that are fitted, and first planes that a thread judges in one go.
constexpr std::size_t kFitted = 3;
constexpr Index kPlaneGrain = 10;
// Planes along the boundary's axis that are tried.
constexpr int kPlanes = 36;
// Times that a plane is fitted to the points that it mirrors.
constexpr int kFits = 8;
// A part is its own mirror image if mirrored points are nearer to it than this, in its sizes.
constexpr double kMirrored = 0.06;
// No other plane may be nearly as good, by a factor and by a part of the size: a round part has
// many. Planes at a smaller angle than this are one.
constexpr double kOtherPlane = 25.0 * kPi / 180.0, kClearlyFlatter = 1.4, kClearlyLess = 0.02;

// The neck of a part is its surface up to so many radii from the boundary.
constexpr double kNeck = 2.0;
// A part is round if turns by these angles leave its points this near to it, in its sizes.
constexpr double kTurns[] = {0.4, 0.9, 1.7, kPi};
constexpr double kRound = 0.02;

struct Plane {
    Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();

    Vec3 mirrored(const Vec3& p) const { return p - 2.0 * normal.dot(p - point) * normal; }
};

// The point of the part nearest to a mirrored point.
struct MirrorImage {
    Vec3 position;
    double distance;
};

Mesh component_at(const Mesh& mesh, Index vertex, const Context& context) {
    const std::vector<Index>& part = mesh.topology().components();
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (part[mesh.topology().face(f)[0]] == part[vertex]) faces.push_back(f);
    }
    const Mesh shape({mesh.positions().begin(), mesh.positions().end()}, mesh.shared_topology());
    return extract_faces(shape, faces, context).mesh;
}

// A part with the samples that planes are judged by.
class MirrorSearch {
  public:
    MirrorSearch(const Mesh& part, const Context& context)
        : tree_(part, context), center_(surface_centroid(part)), size_(surface_radius(part)) {
        const Index step = std::max(Index{1}, part.vertex_count() / kProbes);
        for (Index v = 0; v < part.vertex_count(); v += step) probes_.push_back(part.position(v));
    }

    const Vec3& center() const { return center_; }

    // The eigenvectors of the probes' covariance.
    Mat3 principal_axes() const {
        Mat3 sum = Mat3::Zero();
        for (const Vec3& p : probes_) sum += (p - center_) * (p - center_).transpose();
        return Eigen::SelfAdjointEigenSolver<Mat3>(sum).eigenvectors();
    }

    // Finds the nearest surface points of the mirror images of every `step`-th probe, faster from
    // the nearest ones of another plane.
    std::vector<MirrorImage> images(const Plane& plane, std::size_t step,
                                    std::span<const MirrorImage> before) const {
        std::vector<MirrorImage> result;
        result.reserve(probes_.size() / step + 1);
        for (std::size_t i = 0; i < probes_.size(); i += step) {
            const Vec3 p = plane.mirrored(probes_[i]);
            std::optional<SurfacePoint> found;
            if (!before.empty()) {
                const Vec3& last = before[result.size()].position;
                found = tree_.nearest_within(p, kSurely * (last - p).norm());
            }
            if (!found) found = tree_.nearest(p);
            result.push_back({found->position, found->distance});
        }
        return result;
    }

    // RMS distance from the surface of the probes turned about an axis, in sizes of the part.
    double turned_asymmetry(const Vec3& point, const Vec3& axis, double angle) const {
        const Mat3 turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
        double squares = 0.0;
        for (const Vec3& p : probes_) {
            squares += square(tree_.nearest(point + turn * (p - point)).distance);
        }
        return std::sqrt(squares / probes_.size()) / size_;
    }

    double asymmetry(std::span<const MirrorImage> images) const {
        double squares = 0.0;
        for (const MirrorImage& image : images) squares += square(image.distance);
        return std::sqrt(squares / std::ssize(images)) / size_;
    }

    // The plane between every `step`-th probe and the nearest points of their mirror images.
    Plane fitted(std::span<const MirrorImage> images, std::size_t step) const {
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < images.size(); ++k) {
            middle += 0.5 * (probes_[k * step] + images[k].position) / count_of(images);
        }
        // Products of the mirrored points about the middle, and the points: the least squares of p'
        // - mirror(p) over unit normals is an eigenvector.
        Mat3 products = Mat3::Zero();
        for (std::size_t k = 0; k < images.size(); ++k) {
            const Vec3 a = probes_[k * step] - middle, b = images[k].position - middle;
            products += a * b.transpose() + b * a.transpose();
        }
        return {middle, Eigen::SelfAdjointEigenSolver<Mat3>(products).eigenvectors().col(0)};
    }

  private:
    static double square(double x) { return x * x; }

    // Factor that exceeds the rounding of a distance.
    static constexpr double kSurely = 1.0 + 1e-6;

    SpatialTree tree_;
    Vec3 center_;
    double size_;
    std::vector<Vec3> probes_;
};

// How far a point lies beside the axis of a loop, in its radii.
Vec3 beside_axis(const Loop& loop, const Vec3& point) {
    const Vec3 axis = loop.axis(), arm = (point - loop.center()) / loop.radius();
    return arm - arm.dot(axis) * axis;
}

// A direction square to the axis of a loop that turns with the loop.
Vec3 across_axis(const Loop& loop) {
    Vec3 widest = Vec3::Zero();
    for (const Vec3& point : loop.points()) {
        const Vec3 beside = beside_axis(loop, point);
        if (beside.norm() > 0.5) return beside.normalized();
        if (beside.norm() > widest.norm()) widest = beside;
    }
    return widest.normalized();
}

std::vector<Plane> first_planes(const MirrorSearch& search, const Loop& loop) {
    const Vec3 axis = loop.axis();
    std::vector<Plane> planes;
    const Mat3 principal = search.principal_axes();
    for (int k = 0; k < 3; ++k) planes.push_back({search.center(), principal.col(k)});
    if (!(axis.norm() > 0.0)) return planes;
    const Vec3 x = across_axis(loop), y = axis.cross(x);
    for (int k = 0; k < kPlanes; ++k) {
        const double turn = kPi * k / kPlanes;
        planes.push_back({search.center(), std::cos(turn) * x + std::sin(turn) * y});
    }
    return planes;
}

double angle_between_planes(const Vec3& a, const Vec3& b) {
    return std::acos(std::clamp(std::abs(a.dot(b)), 0.0, 1.0));
}

struct JudgedPlane {
    Plane plane;
    std::vector<MirrorImage> images;
    double asymmetry = std::numeric_limits<double>::infinity();
};

JudgedPlane judged(const MirrorSearch& search, const Plane& plane, std::size_t step,
                   std::span<const MirrorImage> before) {
    std::vector<MirrorImage> images = search.images(plane, step, before);
    const double asymmetry = search.asymmetry(images);
    return {plane, std::move(images), asymmetry};
}

void sort_by_asymmetry(std::vector<JudgedPlane>& planes) {
    std::stable_sort(planes.begin(), planes.end(),
                     [](const auto& a, const auto& b) { return a.asymmetry < b.asymmetry; });
}

// The first planes judged by some of the probes, the best first.
std::vector<JudgedPlane> screened_planes(const MirrorSearch& search, const Loop& loop,
                                         const Context& context) {
    const std::vector<Plane> first = first_planes(search, loop);
    std::vector<JudgedPlane> planes(first.size());
    context.parallel_for(0, count_of(first), kPlaneGrain, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            context.checkpoint();
            std::span<const MirrorImage> before;
            if (i > begin) before = planes[at(i - 1)].images;
            planes[at(i)] = judged(search, first[at(i)], kScreening, before);
        }
    });
    sort_by_asymmetry(planes);
    return planes;
}

// Fits a plane to some of the probes, and judges it by all of them.
JudgedPlane fitted_plane(const MirrorSearch& search, JudgedPlane plane) {
    for (int round = 0; round < kFits; ++round) {
        JudgedPlane next =
            judged(search, search.fitted(plane.images, kScreening), kScreening, plane.images);
        if (!(next.asymmetry < plane.asymmetry)) break;
        plane = std::move(next);
    }
    return judged(search, plane.plane, 1, {});
}

// The first planes that may be the best, or nearly as good, with their asymmetry; the best and the
// best of other angles are also fitted. The best first.
std::vector<JudgedPlane> judged_planes(const MirrorSearch& search, const Loop& loop,
                                       const Context& context) {
    std::vector<JudgedPlane> planes = screened_planes(search, loop, context);
    const double least = planes.front().asymmetry;
    const double near = std::max(kNearBest * least, least + kNearlyBest);
    std::vector<char> is_fitted(planes.size(), 0);
    std::vector<Vec3> normals;
    for (std::size_t i = 0; i < planes.size() && normals.size() < kFitted; ++i) {
        const Vec3& normal = planes[i].plane.normal;
        is_fitted[i] = std::none_of(normals.begin(), normals.end(), [&](const Vec3& other) {
            return angle_between_planes(other, normal) < kOtherPlane;
        });
        if (is_fitted[i]) normals.push_back(normal);
    }
    std::vector<JudgedPlane> judged_ones(planes.size());
    context.parallel_for(0, count_of(planes), 1, [&](Index begin, Index) {
        context.checkpoint();
        const JudgedPlane& plane = planes[at(begin)];
        if (is_fitted[at(begin)]) {
            judged_ones[at(begin)] = fitted_plane(search, plane);
        } else if (plane.asymmetry <= near) {
            judged_ones[at(begin)] = judged(search, plane.plane, 1, {});
        }
    });
    sort_by_asymmetry(judged_ones);
    return judged_ones;
}

// Whether no turn of several moves the surface off itself.
bool is_round(const MirrorSearch& search, const Loop& loop, const Context& context) {
    const Vec3 axis = loop.axis();
    if (!(axis.norm() > 0.0)) return false;
    for (const double angle : kTurns) {
        context.checkpoint();
        if (search.turned_asymmetry(loop.center(), axis, angle) > kRound) return false;
    }
    return true;
}

// The centroid of the surface near a loop.
Vec3 neck_center(const Mesh& mesh, const Loop& loop) {
    const double reach = kNeck * loop.radius();
    const std::vector<double> distance = edge_distances(mesh, loop.vertices(), reach);
    const std::vector<double> areas = face_areas(mesh);
    Vec3 sum = Vec3::Zero();
    double total = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.topology().face(f);
        Vec3 middle = Vec3::Zero();
        bool near = true;
        for (const Index v : corners) {
            middle += mesh.position(v) / std::ssize(corners);
            near = near && distance[v] <= reach;
        }
        if (!near) continue;
        sum += areas[f] * middle;
        total += areas[f];
    }
    return total > 0.0 ? Vec3(sum / total) : loop.center();
}

}  // namespace

PartShape part_shape(const Mesh& mesh, const Loop& loop, const Context& context) {
    PartShape shape;
    const Mesh part = component_at(mesh, loop.vertices().front(), context);
    const MirrorSearch search(part, context);
    shape.mass = beside_axis(loop, search.center());
    shape.neck = beside_axis(loop, neck_center(mesh, loop));
    shape.round = is_round(search, loop, context);
    const std::vector<JudgedPlane> planes = judged_planes(search, loop, context);
    const JudgedPlane& best = planes.front();
    shape.asymmetry = best.asymmetry;
    shape.next_asymmetry = std::numeric_limits<double>::infinity();
    for (const JudgedPlane& other : planes) {
        if (angle_between_planes(other.plane.normal, best.plane.normal) < kOtherPlane) continue;
        shape.next_asymmetry = std::min(shape.next_asymmetry, other.asymmetry);
    }
    const double others = std::max(kClearlyFlatter * best.asymmetry, best.asymmetry + kClearlyLess);
    if (best.asymmetry < kMirrored && shape.next_asymmetry > others) {
        shape.mirror = best.plane.normal;
    }
    return shape;
}

}  // namespace lissom
