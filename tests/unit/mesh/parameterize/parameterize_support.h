/// Surfaces to be laid out, and what their maps are held against.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/parameterize/parameterize.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

namespace lissom::test {

inline Parameterization laid_out(const Mesh& mesh, ParameterizeMethod method,
                                 bool close_holes = true) {
    ParameterizeOptions options;
    options.method = method;
    options.close_holes = close_holes;
    return parameterize(mesh, Region::all(mesh.shared_topology()), options);
}

/// A flat grid whose spacing grows 30 times along x, vertices shifted at random.
inline Mesh uneven_grid(Index segments = 24) {
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {segments, segments}});
    Random random(5);
    for (Vec3& p : mesh.edit_positions()) {
        const double shift = 0.3 * 2.0 / segments;
        p.x() += random.uniform(-shift, shift);
        p.z() += random.uniform(-shift, shift);
        p.x() = std::exp(1.7 * p.x());
    }
    return mesh;
}

/// A grid with two holes.
inline Mesh grid_with_holes(Index segments = 20) {
    const Mesh mesh = make_grid({.size = {2, 2}, .segments = {segments, segments}});
    const Region holes = select_box(mesh, {Vec3(-0.6, -1, -0.5), Vec3(-0.1, 1, 0.1)})
                             .united(select_box(mesh, {Vec3(0.3, -1, 0.2), Vec3(0.6, 1, 0.6)}));
    return remove(mesh, holes).mesh;
}

/// The upper part of a bumpy sphere.
inline Mesh bumpy_cap(double height = 0.1, Index segments = 16) {
    Mesh mesh = make_sphere({.segments = segments, .kind = SphereKind::triangles});
    mesh = extract(mesh, select_plane(mesh, Vec3(0, height, 0), Vec3(0, 1, 0))).mesh;
    for (Vec3& p : mesh.edit_positions()) {
        p *= 1.0 + 0.08 * std::sin(7.0 * p.x()) * std::cos(5.0 * p.z());
    }
    return mesh;
}

/// Greatest deviation of the map from the best similarity of the given points of the plane, or from
/// the best rigid motion, as a part of their extent.
inline double deviation(const std::vector<Vec2>& uv, const std::vector<Vec2>& from, bool rigid) {
    using Complex = std::complex<double>;
    const auto n = static_cast<double>(uv.size());
    Complex uv_mean = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        uv_mean += Complex(uv[i].x(), uv[i].y()) / n;
        mean += Complex(from[i].x(), from[i].y()) / n;
    }
    Complex above = 0.0;
    double below = 0.0, worst = 0.0, extent = 0.0;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        const Complex p = Complex(from[i].x(), from[i].y()) - mean;
        above += (Complex(uv[i].x(), uv[i].y()) - uv_mean) * std::conj(p);
        below += std::norm(p);
    }
    const Complex factor = rigid ? above / std::abs(above) : above / below;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        const Complex p = Complex(from[i].x(), from[i].y()) - mean;
        worst = std::max(worst, std::abs(Complex(uv[i].x(), uv[i].y()) - uv_mean - factor * p));
        extent = std::max(extent, std::abs(factor * p));
    }
    return worst / extent;
}

}  // namespace lissom::test
