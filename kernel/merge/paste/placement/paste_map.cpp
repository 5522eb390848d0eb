#include "kernel/merge/paste/placement/paste_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/error.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/mesh/fill/minimum_area.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// An axis lies in the surface as far as this part of it does.
constexpr double kClearDirection = 0.3;

// Adds the faces around the ring's vertices and keeps them if an annulus is left.
std::vector<Index> with_rows(const Mesh& source, const PasteRegions& regions) {
    const Topology& topology = source.topology();
    FaceSet wide(topology, regions.ring);
    for (const std::vector<Index>* loop : {&regions.outer, &regions.inner}) {
        for (const Index v : *loop) {
            for (const Index f : topology.faces_around(v)) wide.add(f);
        }
    }
    wide.grow_at_bow_ties(nullptr);
    const bool annulus = wide.euler_characteristic() == 0 && wide.loops().size() == 2;
    return annulus ? wide.faces() : regions.ring;
}

// The inner boundary of the faces, in the direction of the part inside it.
std::vector<Index> inner_loop(const Mesh& source, std::span<const Index> faces,
                              const PasteRegions& regions) {
    const FaceSet set(source.topology(), faces);
    const FaceSet inside(source.topology(), regions.feature);
    std::vector<std::vector<Index>> loops = set.loops();
    const auto held = [&](const std::vector<Index>& loop) {
        return std::count_if(loop.begin(), loop.end(), [&](Index v) {
            const auto around = source.topology().faces_around(v);
            return std::any_of(around.begin(), around.end(),
                               [&](Index f) { return inside.contains(f); });
        });
    };
    std::vector<Index> loop = held(loops[0]) > held(loops[1]) ? loops[0] : loops[1];
    std::reverse(loop.begin(), loop.end());
    return loop;
}

std::vector<Triangle> lid_over(const Mesh& source, const std::vector<Index>& loop,
                               const Context& context) {
    std::vector<Vec3> points;
    for (const Index v : loop) points.push_back(source.position(v));
    const auto taken = [&](Index a, Index b) {
        // Polygons are triangulated: a diagonal of one may be an edge as well.
        const auto around = source.topology().faces_around(loop[at(a)]);
        return std::any_of(around.begin(), around.end(), [&](Index f) {
            const std::span<const Index> face = source.topology().face(f);
            return std::find(face.begin(), face.end(), loop[at(b)]) != face.end();
        });
    };
    std::vector<Triangle> lid = minimum_area_triangles(points, taken, context);
    for (Triangle& triangle : lid) {
        for (Index& v : triangle) v = loop[at(v)];
    }
    return lid;
}

// Positions as a linear function of the plane, about means, by least squares.
struct PlaneFit {
    Eigen::Matrix<double, 3, 2> linear = Eigen::Matrix<double, 3, 2>::Zero();

    PlaneFit(std::span<const Vec2> uv, std::span<const Vec3> points) {
        Vec2 middle = Vec2::Zero();
        Vec3 mean = Vec3::Zero();
        for (std::size_t i = 0; i < uv.size(); ++i) {
            middle += uv[i] / static_cast<double>(uv.size());
            mean += points[i] / static_cast<double>(uv.size());
        }
        Eigen::Matrix<double, 3, 2> products = Eigen::Matrix<double, 3, 2>::Zero();
        Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
        for (std::size_t i = 0; i < uv.size(); ++i) {
            const Vec2 d = uv[i] - middle;
            products += (points[i] - mean) * d.transpose();
            squares += d * d.transpose();
        }
        if (squares.determinant() > 0.0) linear = products * squares.inverse();
    }

    // The direction of the plane that leads along `direction`, whose length tells how much of it
    // lies in the surface: at most 1.
    Vec2 in_plane(const Vec3& direction) const {
        const Vec3 unit = direction.stableNormalized();
        const Vec2 flat = linear.colPivHouseholderQr().solve(unit);
        const double tangential = (linear * flat).norm();
        return flat.norm() > 0.0 ? Vec2(flat.normalized() * tangential) : Vec2(Vec2::Zero());
    }
};

// A map without faces that are turned over: onto a disk if the requested one has some. LSCM alone,
// which the thesis takes as it comes, is left as it is.
Parameterization laid_out(const Mesh& mesh, std::span<const Index> faces,
                          ParameterizeOptions options, const char* what, const Context& context) {
    Parameterization map = parameterize(mesh, faces, options, context);
    const bool folded = !map.flipped.empty() || map.boundary_crossings > 0;
    if (options.method == ParameterizeMethod::lscm || !folded) return map;
    options.method = ParameterizeMethod::tutte;
    map = parameterize(mesh, faces, options, context);
    if (map.flipped.empty()) return map;
    Elements elements{ElementKind::face, 0, {}};
    for (const Index f : map.flipped) elements.add(f);
    throw Error(ErrorCode::boundary_conflict,
                std::string("the map of ") + what + " into the plane turns over " +
                    describe(elements) +
                    "; mark a smoother region or a smaller one, or repair the mesh there",
                elements);
}

double angle_of(const Vec2& v) {
    return std::atan2(v.y(), v.x());
}

// The angle from the direction of the first fit to that of the second; the next axis serves if a
// direction hardly lies in either surface.
double angle_between_fits(const PlaneFit& source, const PlaneFit& target, const Vec3& up,
                          const Vec3& toward) {
    Vec2 from = source.in_plane(up), to = target.in_plane(toward);
    for (const Vec3& axis : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX())}) {
        if (from.norm() < kClearDirection) from = source.in_plane(axis);
        if (to.norm() < kClearDirection) to = target.in_plane(axis);
    }
    return angle_of(to) - angle_of(from);
}

}  // namespace

Mesh chart_mesh(const Mesh& mesh, const PasteChart& chart) {
    std::vector<Vec3> positions;
    for (const Index v : chart.map.vertex) positions.push_back(mesh.position(v));
    FaceList faces;
    for (const Triangle& t : chart.map.surface_triangles()) faces.add(t);
    return {std::move(positions), std::move(faces)};
}

Index PasteChart::place_of(Index vertex) const {
    const auto found = std::lower_bound(map.vertex.begin(), map.vertex.end(), vertex);
    if (found == map.vertex.end() || *found != vertex) return kNoIndex;
    return index_of(found - map.vertex.begin());
}

MapQuality PasteChart::quality() const {
    return {count_of(map.face), count_of(map.flipped), map.flipped_fill, map.boundary_crossings,
            map.min_scale,      map.max_scale,         map.method};
}

PasteChart source_chart(const Mesh& source, const PasteRegions& regions, ParameterizeMethod method,
                        const Context& context) {
    const std::vector<Index> faces = with_rows(source, regions);
    ParameterizeOptions options;
    options.method = method;
    options.close_holes = false;
    options.fill = lid_over(source, inner_loop(source, faces, regions), context);
    PasteChart chart;
    chart.map = laid_out(source, faces, options, "the ring around the feature", context);
    const auto uv_of = [&](Index v) { return chart.map.uv[at(chart.place_of(v))]; };
    double flat = 0.0, length = 0.0, around = 0.0;
    for (std::size_t k = 0; k < regions.inner.size(); ++k) {
        const Index a = regions.inner[k], b = regions.inner[(k + 1) % regions.inner.size()];
        const double edge = (source.position(a) - source.position(b)).norm();
        chart.center += edge * 0.5 * (uv_of(a) + uv_of(b));
        around += edge;
    }
    if (around > 0.0) chart.center /= around;
    for (const Index f : regions.ring) {
        const std::span<const Index> face = source.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            flat += (uv_of(a) - uv_of(b)).norm();
            length += (source.position(a) - source.position(b)).norm();
            chart.reach = std::max(chart.reach, (uv_of(a) - chart.center).norm());
        }
    }
    if (flat > 0.0) chart.length_ratio = length / flat;
    return chart;
}

PasteChart target_chart(const Mesh& target, std::span<const Index> faces, ParameterizeMethod method,
                        const Context& context) {
    ParameterizeOptions options;
    options.method = method;
    PasteChart chart;
    chart.map = laid_out(target, faces, options, "the target's region", context);
    return chart;
}

Vec2 PlanarMap::operator()(const Vec2& p) const {
    const Vec2 d = factor * (p - center);
    const double c = std::cos(angle), s = std::sin(angle);
    return point + Vec2(c * d.x() - s * d.y(), s * d.x() + c * d.y());
}

PasteSurfaces::PasteSurfaces(const Mesh& source_mesh, const Mesh& target_mesh)
    : source(source_mesh),
      target(target_mesh),
      source_normals(vertex_normals(source)),
      target_normals(vertex_normals(target)),
      target_tree(target) {}

PasteMap::PasteMap(const PasteSurfaces& surfaces, PasteChart source_chart, PasteChart target_chart,
                   bool nearest)
    : surfaces_(surfaces),
      source_(std::move(source_chart)),
      target_(std::move(target_chart)),
      grid_(target_.map.uv, target_.map.surface_triangles()) {
    if (nearest) chart_tree_.emplace(chart_mesh(surfaces.target, target_));
}

ImagePoint PasteMap::image_at(const Triangle& places, const Vec3& weights) const {
    ImagePoint point;
    point.inside = true;
    for (int k = 0; k < 3; ++k) {
        const Index place = places[at(k)], v = target_.map.vertex[at(place)];
        point.uv += weights[k] * target_.map.uv[at(place)];
        point.position += weights[k] * surfaces_.target.position(v);
        point.normal += weights[k] * surfaces_.target_normals[at(v)];
        if (!relief_.empty()) point.relief += weights[k] * relief_[at(place)];
    }
    point.normal.normalize();
    return point;
}

ImagePoint PasteMap::nearest(const Vec3& point) const {
    const SurfacePoint found = chart_tree_->nearest(point);
    return image_at(found.triangle, found.barycentric);
}

std::optional<ImagePoint> PasteMap::along(const Vec3& point, const Vec3& direction,
                                          const Vec3& near) const {
    if (!chart_tree_) return std::nullopt;
    const double far = (chart_tree_->bounds().max - chart_tree_->bounds().min).norm() +
                       (chart_tree_->bounds().center() - point).norm();
    std::optional<SurfacePoint> found;
    for (const SurfacePoint& hit :
         chart_tree_->pick_all(point + far * direction.stableNormalized(), -direction)) {
        if (!(hit.normal.dot(direction) > 0.0)) continue;
        const double distance = (hit.position - near).norm();
        if (!found || distance < (found->position - near).norm()) found = hit;
    }
    if (!found) return std::nullopt;
    return image_at(found->triangle, found->barycentric);
}

std::optional<ImagePoint> PasteMap::on_target(const Vec2& uv) const {
    const std::optional<UvPoint> found = grid_.locate(uv);
    if (!found) return std::nullopt;
    return image_at(target_.map.triangles[at(found->triangle)], found->barycentric);
}

Vec2 PasteMap::point_of(const PastePlacement& placement) const {
    if (!placement.at.allFinite() || !placement.offset.allFinite()) {
        throw Error(ErrorCode::not_finite, "the point of a placement is NaN or infinite");
    }
    const auto& map = target_.map;
    const SurfacePoint point = surfaces_.target_tree.nearest(placement.at);
    Vec2 uv = Vec2::Zero();
    for (int k = 0; k < 3; ++k) {
        const Index place = target_.place_of(point.triangle[at(k)]);
        if (place == kNoIndex) {
            Elements elements{ElementKind::face, 0, {}};
            elements.add(point.face);
            throw Error(ErrorCode::boundary_conflict,
                        "the placement's point lies on " + describe(elements) +
                            " of the target, outside the region that is pasted onto; choose a "
                            "point in it, or a larger region",
                        elements);
        }
        uv += point.barycentric[k] * map.uv[at(place)];
    }
    return uv + placement.offset;
}

double PasteMap::target_ratio(const Vec2& point, double radius) const {
    const auto& map = target_.map;
    for (double limit = radius;; limit *= 2.0) {
        double flat = 0.0, length = 0.0;
        for (const Triangle& t : map.surface_triangles()) {
            const Vec2 middle = (map.uv[at(t[0])] + map.uv[at(t[1])] + map.uv[at(t[2])]) / 3.0;
            if ((middle - point).norm() > limit) continue;
            for (int k = 0; k < 3; ++k) {
                const Index a = t[at(k)], b = t[at((k + 1) % 3)];
                flat += (map.uv[at(a)] - map.uv[at(b)]).norm();
                length += (surfaces_.target.position(map.vertex[at(a)]) -
                           surfaces_.target.position(map.vertex[at(b)]))
                              .norm();
            }
        }
        if (flat > 0.0) return length / flat;
        if (!std::isfinite(limit)) return 1.0;
    }
}

// Adds the angle of the base direction.
void PasteMap::turn_to_base(const PastePlacement& placement, double radius,
                            PlanarMap& plane) const {
    std::vector<Vec3> points;
    for (const Index v : source_.map.vertex) points.push_back(surfaces_.source.position(v));
    const PlaneFit source(source_.map.uv, points);
    std::vector<Vec2> uv;
    points.clear();
    for (double limit = radius; points.size() < 3; limit *= 2.0) {
        uv.clear();
        points.clear();
        for (std::size_t i = 0; i < target_.map.uv.size(); ++i) {
            if ((target_.map.uv[i] - plane.point).norm() > limit) continue;
            uv.push_back(target_.map.uv[i]);
            points.push_back(surfaces_.target.position(target_.map.vertex[i]));
        }
    }
    const PlaneFit target(uv, points);
    const Vec3 toward = placement.toward.value_or(placement.up);
    plane.angle += angle_between_fits(source, target, placement.up, toward);
    plane.clear = source.in_plane(placement.up).norm() >= kClearDirection &&
                  target.in_plane(toward).norm() >= kClearDirection;
}

PlanarMap PasteMap::planar(const PastePlacement& placement, double angle) const {
    if (!(placement.scale > 0.0) || !std::isfinite(placement.scale)) {
        throw Error(ErrorCode::invalid_argument, "the scale of a placement must be above 0");
    }
    const auto is_direction = [](const Vec3& v) { return v.allFinite() && v.stableNorm() > 0.0; };
    if (!is_direction(placement.up) || (placement.toward && !is_direction(*placement.toward)) ||
        !std::isfinite(angle)) {
        throw Error(ErrorCode::invalid_argument,
                    "directions of a placement need a length, and its angle must be finite");
    }
    PlanarMap plane;
    plane.center = source_.center;
    plane.point = point_of(placement);
    const double wanted = placement.scale * source_.length_ratio;
    const double ratio = target_ratio(plane.point, wanted * source_.reach);
    plane.factor = wanted / target_ratio(plane.point, wanted / ratio * source_.reach);
    plane.angle = angle;
    turn_to_base(placement, plane.factor * source_.reach, plane);
    return plane;
}

std::vector<ImagePoint> PasteMap::images(const PlanarMap& plane) const {
    std::vector<ImagePoint> images;
    images.reserve(source_.map.uv.size());
    for (const Vec2& uv : source_.map.uv) {
        images.push_back(on_target(plane(uv)).value_or(ImagePoint{}));
    }
    return images;
}

}  // namespace lissom
