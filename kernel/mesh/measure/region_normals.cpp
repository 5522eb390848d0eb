#include "kernel/mesh/measure/region_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/angle.h"
#include "kernel/mesh/measure/flat_face.h"
#include "kernel/mesh/measure/scale.h"
#include "kernel/mesh/topology.h"

namespace lissom {
namespace {

constexpr Index kNormalGrain = 4096;

// Faces with a corner in the region, ascending.
std::vector<Index> faces_touching(const Region& region) {
    std::vector<Index> faces;
    for (const Index v : region.vertices()) {
        const auto around = region.topology()->faces_around(v);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

// Vertices of `faces` that are not in the region, ascending.
std::vector<Index> vertices_outside(const Region& region, std::span<const Index> faces) {
    std::vector<Index> outside;
    for (const Index f : faces) {
        for (const Index v : region.topology()->face(f)) {
            if (!region.contains(v)) outside.push_back(v);
        }
    }
    std::sort(outside.begin(), outside.end());
    outside.erase(std::unique(outside.begin(), outside.end()), outside.end());
    return outside;
}

Index place_in(const std::vector<Index>& ascending, Index v) {
    return index_of(std::lower_bound(ascending.begin(), ascending.end(), v) - ascending.begin());
}

Vec3 unit_or_zero(const Vec3& v) {
    const double length = v.norm();
    return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

// A corner about the normal of its face, from 0 to 2 pi: reflex corners count in full.
double angle_about(const Vec3& to_next, const Vec3& to_last, const Vec3& normal) {
    const double sine = to_next.cross(to_last).dot(normal), cosine = to_next.dot(to_last);
    const double angle = half_plane_angle(std::abs(sine), cosine);
    return sine < 0.0 ? 2.0 * kPi - angle : angle;
}

}  // namespace

RegionNormals::RegionNormals(const Region& region,
                             const std::function<Vec3(Index)>& position_outside,
                             const Context& context)
    : hold_(context.memory(), "normals of a region"), rows_(region.size()) {
    const std::vector<Index> faces = faces_touching(region);
    charge(region, faces);
    const std::vector<Index> outside = vertices_outside(region, faces);
    for (const Index f : faces) {
        for (const Index v : region.topology()->face(f)) {
            const bool inside = region.contains(v);
            corner_vertex_.push_back(inside ? place_in(region.vertices(), v)
                                            : rows_ + place_in(outside, v));
        }
        face_begin_.push_back(count_of(corner_vertex_));
    }
    points_.resize(at(rows_));
    for (const Index v : outside) points_.push_back(position_outside(v));
    face_normal_.resize(faces.size());
    row_normal_.resize(at(rows_));
    corner_angle_.resize(corner_vertex_.size());
    add_corners_of_rows();
}

void RegionNormals::charge(const Region& region, std::span<const Index> faces) {
    std::size_t corners = 0;
    for (const Index f : faces) corners += region.topology()->face(f).size();
    constexpr std::size_t kCornerBytes = 3 * sizeof(Index) + sizeof(double);
    constexpr std::size_t kFaceBytes = sizeof(Index) + sizeof(Vec3);
    // Each vertex outside is at a corner.
    hold_.resize(corners * (kCornerBytes + sizeof(Vec3)) + faces.size() * kFaceBytes +
                 at(rows_) * (2 * sizeof(Vec3) + sizeof(Index)));
}

void RegionNormals::add_corners_of_rows() {
    row_begin_.assign(at(rows_) + 1, 0);
    for (const Index row : corner_vertex_) {
        if (row < rows_) ++row_begin_[at(row) + 1];
    }
    for (Index row = 0; row < rows_; ++row) row_begin_[at(row) + 1] += row_begin_[at(row)];
    row_corner_.resize(at(row_begin_.back()));
    row_face_.resize(row_corner_.size());
    std::vector<Index> next(row_begin_.begin(), row_begin_.end() - 1);
    for (Index f = 0; f < count_of(face_normal_); ++f) {
        for (Index c = face_begin_[at(f)]; c < face_begin_[at(f) + 1]; ++c) {
            const Index row = corner_vertex_[at(c)];
            if (row >= rows_) continue;
            const Index place = next[at(row)]++;
            row_corner_[at(place)] = c;
            row_face_[at(place)] = f;
        }
    }
}

bool RegionNormals::measure_triangle(Index f, double scale) {
    const std::size_t c = at(face_begin_[at(f)]);
    const Vec3 p = scale * points_[at(corner_vertex_[c])],
               q = scale * points_[at(corner_vertex_[c + 1])],
               r = scale * points_[at(corner_vertex_[c + 2])];
    const Vec3 a = q - p, b = r - q, d = p - r, cross = a.cross(b);
    const double size = cross.norm();
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), d.squaredNorm()});
    const bool is_flat = !(0.5 * size > kFlatFace * longest);
    face_normal_[at(f)] = is_flat ? Vec3(Vec3::Zero()) : Vec3(cross / size);
    const double at_p = half_plane_angle(size, -a.dot(d)), at_q = half_plane_angle(size, -b.dot(a));
    corner_angle_[c] = at_p;
    corner_angle_[c + 1] = at_q;
    corner_angle_[c + 2] = std::max(kPi - at_p - at_q, 0.0);
    return is_measurable(longest);
}

bool RegionNormals::measure_polygon(Index f, double scale) {
    const Index first = face_begin_[at(f)], count = face_begin_[at(f) + 1] - first;
    const auto corner = [&](Index k) -> Vec3 {
        return scale * points_[at(corner_vertex_[at(first + k % count)])];
    };
    Vec3 area = Vec3::Zero();
    double longest = 0.0;
    for (Index k = 0; k < count; ++k) {
        area += 0.5 * (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
        longest = std::max(longest, (corner(k + 1) - corner(k)).squaredNorm());
    }
    const double size = area.norm();
    const Vec3 normal = size > kFlatFace * longest ? Vec3(area / size) : Vec3(Vec3::Zero());
    face_normal_[at(f)] = normal;
    for (Index k = 0; k < count; ++k) {
        corner_angle_[at(first + k)] =
            angle_about(corner(k + 1) - corner(k), corner(k + count - 1) - corner(k), normal);
    }
    return is_measurable(longest);
}

void RegionNormals::measure_face(Index f) {
    const Index first = face_begin_[at(f)], count = face_begin_[at(f) + 1] - first;
    const auto measure = [&](double scale) {
        return count == 3 ? measure_triangle(f, scale) : measure_polygon(f, scale);
    };
    if (measure(1.0)) return;
    measure(scale_to_unit(at(count), [&](std::size_t k) -> const Vec3& {
        return points_[at(corner_vertex_[at(first) + k])];
    }));
}

Vec3 RegionNormals::sum_at(Index row) const {
    Vec3 sum = Vec3::Zero();
    for (Index i = row_begin_[at(row)]; i < row_begin_[at(row) + 1]; ++i) {
        sum += corner_angle_[at(row_corner_[at(i)])] * face_normal_[at(row_face_[at(i)])];
    }
    return sum;
}

const std::vector<Vec3>& RegionNormals::evaluate(std::span<const Vec3> positions,
                                                 const Context& context) {
    if (count_of(positions) != rows_) {
        throw Error(ErrorCode::invalid_argument, "give one position for each vertex of the region");
    }
    std::copy(positions.begin(), positions.end(), points_.begin());
    context.parallel_for(0, count_of(face_normal_), kNormalGrain, [&](Index begin, Index end) {
        for (Index f = begin; f < end; ++f) measure_face(f);
    });
    context.parallel_for(0, rows_, kNormalGrain, [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) row_normal_[at(row)] = unit_or_zero(sum_at(row));
    });
    return row_normal_;
}

}  // namespace lissom
