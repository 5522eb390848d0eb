#include "kernel/hair/operators/braid_spine.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/core/index.h"

namespace lissom {
namespace {

constexpr double kSpineStep = 0.002;
constexpr int kSpineSmoothing = 8;
// The nearest point is looked for among every so many points first.
constexpr std::size_t kSpineStride = 4;

std::vector<Vec3> even_spine(const std::vector<Vec3>& points) {
    std::vector<double> arcs = {0.0};
    for (std::size_t i = 1; i < points.size(); ++i) {
        arcs.push_back(arcs.back() + (points[i] - points[i - 1]).norm());
    }
    const auto count =
        static_cast<std::size_t>(std::clamp(std::ceil(arcs.back() / kSpineStep), 1.0, 100000.0));
    std::vector<Vec3> made;
    std::size_t k = 1;
    for (std::size_t i = 0; i <= count; ++i) {
        const double arc = arcs.back() * double(i) / double(count);
        while (k + 1 < arcs.size() && arcs[k] < arc) ++k;
        const double size = arcs[k] - arcs[k - 1];
        const double u = size > 0.0 ? (arc - arcs[k - 1]) / size : 0.0;
        made.push_back(points[k - 1] + u * (points[k] - points[k - 1]));
    }
    for (int pass = 0; pass < kSpineSmoothing; ++pass) {
        const std::vector<Vec3> old = made;
        for (std::size_t i = 1; i + 1 < made.size(); ++i) {
            made[i] = 0.5 * old[i] + 0.25 * (old[i - 1] + old[i + 1]);
        }
    }
    return made;
}

}  // namespace

BraidSpine::BraidSpine(const std::vector<Vec3>& points, const Vec3& across)
    : points_(even_spine(points)) {
    Vec3 normal = across, tangent = Vec3::UnitY();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Vec3 along =
            points_[std::min(i + 1, points_.size() - 1)] - points_[i == 0 ? 0 : i - 1];
        if (along.norm() > 0.0) tangent = along.normalized();
        normal -= normal.dot(tangent) * tangent;
        if (!(normal.norm() > 1e-9)) normal = tangent.unitOrthogonal();
        normal.normalize();
        tangents_.push_back(tangent);
        normals_.push_back(normal);
        arcs_.push_back(i == 0 ? 0.0 : arcs_.back() + (points_[i] - points_[i - 1]).norm());
    }
}

BraidSpine::Frame BraidSpine::frame_at(double arc) const {
    const auto above = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, arc);
    const auto i = static_cast<std::size_t>(above - arcs_.begin()) - 1;
    const double size = arcs_[i + 1] - arcs_[i];
    const double u = size > 0.0 ? std::clamp((arc - arcs_[i]) / size, 0.0, 1.0) : 0.0;
    const auto mix = [&](const std::vector<Vec3>& list) -> Vec3 {
        return list[i] + u * (list[i + 1] - list[i]);
    };
    return {mix(points_), mix(normals_), mix(tangents_)};
}

Vec3 BraidSpine::place(double arc, double x, double z, double t) const {
    const Frame frame = frame_at(arc);
    const double beyond = std::max(0.0, arc - arcs_.back());
    return frame.origin + x * frame.normal + z * frame.tangent.cross(frame.normal) +
           (t + beyond) * frame.tangent;
}

BraidSpine::Nearest BraidSpine::nearest(const Vec3& point, double most) const {
    std::size_t best = 0;
    double square = (points_[0] - point).squaredNorm();
    const auto look_at = [&](std::size_t i) {
        const double found = (points_[i] - point).squaredNorm();
        if (!(found < square)) return;
        best = i;
        square = found;
    };
    const auto beyond = std::upper_bound(arcs_.begin(), arcs_.end(), most);
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(beyond - arcs_.begin()));
    for (std::size_t i = 0; i < count; i += kSpineStride) look_at(i);
    const std::size_t middle = best;
    const std::size_t first = middle < kSpineStride ? 0 : middle - kSpineStride;
    for (std::size_t i = first; i < std::min(count, middle + kSpineStride); ++i) look_at(i);
    return {arcs_[best], std::sqrt(square)};
}

Vec3 BraidSpine::local(double arc, const Vec3& vector) const {
    const Frame frame = frame_at(arc);
    return {vector.dot(frame.normal), vector.dot(frame.tangent.cross(frame.normal)),
            vector.dot(frame.tangent)};
}

void require_spine(const std::vector<Vec3>& spine, const Vec3& across) {
    bool differ = false;
    for (const Vec3& p : spine) {
        require(p.allFinite(), "the spine of a braid must be finite");
        differ = differ || p != spine.front();
    }
    require(differ, "the spine of a braid needs two points that differ");
    require(across.allFinite() && across.norm() > 0.0,
            "the direction across a braid must be finite and not 0");
}

}  // namespace lissom
