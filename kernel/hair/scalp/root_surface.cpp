#include "kernel/hair/scalp/root_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace lissom {
namespace {

std::vector<double> relative_density(const Mesh& head, const Scalp& scalp,
                                     const std::vector<double>& density) {
    const std::size_t count = head.vertex_count();
    if (density.empty()) return std::vector<double>(count, 1.0);
    if (density.size() != count) {
        throw Error(ErrorCode::invalid_argument,
                    "the density has " + std::to_string(density.size()) + " values; the head has " +
                        std::to_string(count) + " vertices");
    }
    Elements bad{ElementKind::vertex, 0, {}};
    for (std::size_t v = 0; v < count; ++v) {
        if (!(density[v] >= 0.0 && std::isfinite(density[v]))) bad.add(index_of(v));
    }
    if (bad.count > 0) {
        throw Error(ErrorCode::not_finite,
                    "a density is negative, NaN or infinite at " + describe(bad), bad);
    }
    double largest = 0.0;
    for (const Index f : scalp.root_faces()) {
        for (const Index v : head.topology().face(f)) largest = std::max(largest, density[v]);
    }
    std::vector<double> result = density;
    for (double& d : result) d = largest > 0.0 ? d / largest : 0.0;
    return result;
}

double triangle_area(const Mesh& mesh, const Triangle& t) {
    const Vec3 a = mesh.position(t[1]) - mesh.position(t[0]);
    return 0.5 * a.cross(mesh.position(t[2]) - mesh.position(t[0])).norm();
}

}  // namespace

RootSurface::RootSurface(const Mesh& head, const Scalp& scalp, const RootOptions& options)
    : head_(head),
      scalp_(scalp),
      density_(relative_density(head, scalp, options.density)),
      mask_(options.masks, MaskKind::density),
      triangles_(triangulate_faces(head.topology(), head.positions(), scalp.root_faces())),
      on_scalp_(head.face_count(), 0) {
    for (const Index f : scalp.root_faces()) on_scalp_[f] = 1;
    std::vector<double> areas;
    for (const Triangle& t : triangles_.triangles) areas.push_back(triangle_area(head, t));
    build_alias_table(areas);
    // Four points a triangle are enough for the mean density.
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const Triangle& t = triangles_.triangles[i];
        const Index face = triangles_.face[i];
        double sum = density_at(face, t, Vec3::Constant(1.0 / 3.0));
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 barycentric = Vec3::Constant(1.0 / 6.0) + 0.5 * Vec3::Unit(corner);
            sum += density_at(face, t, barycentric);
        }
        mass_ += 0.25 * sum * areas[i];
    }
    if (mass_ > 0.0) return;
    throw Error(ErrorCode::region_empty, "the density of roots is 0 on the whole scalp");
}

void RootSurface::build_alias_table(const std::vector<double>& areas) {
    const auto count = count_of(areas);
    double total = 0.0;
    for (const double area : areas) total += area;
    if (!(total > 0.0)) throw Error(ErrorCode::region_empty, "the scalp has no area");
    keep_.resize(areas.size());
    alias_.resize(areas.size());
    std::vector<Index> small, large;
    for (Index t = 0; t < count; ++t) {
        keep_[t] = areas[t] / total * count;
        alias_[t] = t;
        (keep_[t] < 1.0 ? small : large).push_back(t);
    }
    while (!small.empty() && !large.empty()) {
        const Index low = small.back(), high = large.back();
        small.pop_back();
        alias_[low] = high;
        keep_[high] -= 1.0 - keep_[low];
        if (keep_[high] >= 1.0) continue;
        large.pop_back();
        small.push_back(high);
    }
    for (const Index t : small) keep_[t] = 1.0;
}

Index RootSurface::random_triangle(CountedRandom& random) const {
    const double at = random.uniform() * keep_.size();
    const auto slot = std::min(static_cast<std::size_t>(at), keep_.size() - 1);
    return at - slot < keep_[slot] ? index_of(slot) : alias_[slot];
}

RootSurface::Dart RootSurface::random_dart(CountedRandom& random) const {
    const Index triangle = random_triangle(random);
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {triangle, Vec3(1.0 - u - v, u, v)};
}

Vec3 RootSurface::position(const Dart& dart) const {
    const Triangle& t = triangles_.triangles[dart.triangle];
    return dart.barycentric[0] * head_.position(t[0]) + dart.barycentric[1] * head_.position(t[1]) +
           dart.barycentric[2] * head_.position(t[2]);
}

double RootSurface::density(const Dart& dart) const {
    return density_at(triangles_.face[dart.triangle], triangles_.triangles[dart.triangle],
                      dart.barycentric);
}

Root RootSurface::root(const Dart& dart) const {
    return {triangles_.face[dart.triangle], triangles_.triangles[dart.triangle], dart.barycentric,
            position(dart), Vec3::Zero()};
}

double RootSurface::density_at(Index face, const Triangle& triangle,
                               const Vec3& barycentric) const {
    if (!on_scalp_[face]) return 0.0;
    double density = 0.0;
    Vec3 position = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
        density += barycentric[corner] * density_[triangle[corner]];
        position += barycentric[corner] * head_.position(triangle[corner]);
    }
    if (!mask_.is_empty()) density *= mask_.at(scalp_.to_metres(position));
    return density * hairline_thinning(scalp_.margin_at(triangle, barycentric, position));
}

}  // namespace lissom
