#include "kernel/merge/paste/part/paste_part.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/paste/placement/plane_line.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

constexpr int kFrameAverages = 3;
constexpr Index kNearRings = 3;
// A vertex slides onto a line that crosses one of its edges within this part of it.
constexpr double kSlide = 0.25;
// Points of two loops meet that are this near, over the smaller distance to the next.
constexpr double kMeeting = 0.08;
constexpr double kMinStep = 1e-6;

// Singular values of the linear map between two triangles.
std::pair<double, double> stretches(const std::array<Vec3, 3>& from,
                                    const std::array<Vec3, 3>& to) {
    const auto flat = [](const std::array<Vec3, 3>& p) {
        const Vec3 u = p[1] - p[0], v = p[2] - p[0];
        const double along = u.norm();
        Eigen::Matrix2d m;
        m << along, u.dot(v) / along, 0.0, u.cross(v).norm() / along;
        return m;
    };
    const Eigen::Matrix2d j = flat(to) * flat(from).inverse();
    const Eigen::Vector2d s = j.jacobiSvd().singularValues();
    return {s[0], s[1]};
}

PasteDistortion distortion_of(const Mesh& rest, const Mesh& moved, double scale,
                              std::span<const Index> faces) {
    PasteDistortion result;
    std::vector<double> ratios;
    double area = 0.0;
    const Triangulation triangles = triangulate_faces(rest.topology(), rest.positions(), faces);
    for (const Triangle& t : triangles.triangles) {
        std::array<Vec3, 3> a, b;
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = rest.position(t[k]);
            b[k] = moved.position(t[k]);
        }
        const double size = (a[1] - a[0]).cross(a[2] - a[0]).norm();
        if (!(size > 0.0)) continue;
        const auto [greatest, least] = stretches(a, b);
        if (!std::isfinite(greatest) || !(least > 0.0)) continue;
        ratios.push_back(greatest / least);
        result.energy +=
            size * (std::pow(greatest / scale - 1.0, 2) + std::pow(least / scale - 1.0, 2));
        area += size;
    }
    result.faces = count_of(faces);
    if (ratios.empty()) return result;
    result.energy /= area;
    const std::size_t rank = ratios.size() * 95 / 100;
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(rank),
                     ratios.end());
    result.anisotropy = ratios[rank];
    return result;
}

}  // namespace

PastePart part_inside(const Mesh& source, const PasteRegions& regions, std::span<const Index> loop,
                      const Context& context) {
    const Topology& topology = source.topology();
    const FaceSet region(topology, regions.region);
    FaceSet inside(topology, regions.feature);
    std::vector<std::pair<Index, Index>> rim;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        rim.push_back(std::minmax(loop[k], loop[(k + 1) % loop.size()]));
    }
    std::sort(rim.begin(), rim.end());
    std::vector<Index> queue = regions.feature;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::span<const Index> face = topology.face(queue[i]);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            const std::pair<Index, Index> edge = std::minmax(a, b);
            if (std::binary_search(rim.begin(), rim.end(), edge)) continue;
            const Index f = face_left_of(topology, b, a);
            if (f == kNoIndex || inside.contains(f) || !region.contains(f)) continue;
            inside.add(f);
            queue.push_back(f);
        }
    }
    const std::vector<Index> faces = inside.faces();
    MeshPart taken = extract_faces(source, faces, context);
    PastePart part{{}, part_map(taken, topology), {}};
    for (const Index v : loop) {
        const auto place = std::find(taken.vertex_map.begin(), taken.vertex_map.end(), v);
        part.loop.push_back(index_of(place - taken.vertex_map.begin()));
    }
    part.mesh = std::move(taken.mesh);
    return part;
}

namespace {

[[noreturn]] void refuse_line() {
    throw Error(ErrorCode::boundary_conflict,
                "the ring is too coarse to be divided along the boundary that was found");
}

}  // namespace

PastePart part_inside(const Mesh& source, const PasteRegions& regions, const PasteChart& chart,
                      std::span<const Vec2> line, const Context& context) {
    FaceSet around(source.topology(), regions.region);
    for (const Index f : chart.map.face) around.add(f);
    const std::vector<Index> faces = around.faces();
    const MeshPart piece = extract_faces(source, faces, context);
    CutContour contour;
    // Vertices without a place in the plane are the feature.
    contour.value.assign(piece.vertex_map.size(), 1.0);
    std::vector<Index> vertices;
    std::vector<Vec2> uv;
    for (std::size_t v = 0; v < piece.vertex_map.size(); ++v) {
        const Index place = chart.place_of(piece.vertex_map[v]);
        if (place == kNoIndex) continue;
        vertices.push_back(index_of(v));
        uv.push_back(chart.map.uv[at(place)]);
    }
    set_line_values(piece.mesh.topology(), vertices, uv, line, contour.value);
    const auto [least, most] = std::minmax_element(contour.value.begin(), contour.value.end());
    if (!(*least < 0.0 && *most > 0.0)) refuse_line();
    Cut parts = cut(piece.mesh, contour, {CutLoops::all, kSlide}, context);
    if (parts.lines.size() != 1 || !parts.lines.front().kept.closed()) refuse_line();
    const MeshMap map = composed(parts.kept.map, part_map(piece, source.topology()));
    return {std::move(parts.kept.mesh), map, parts.lines.front().kept.vertices()};
}

PastePart part_above(const PastePart& part, std::vector<double> height, const Context& context) {
    const auto [least, most] = std::minmax_element(height.begin(), height.end());
    if (!(*least < 0.0 && *most > 0.0)) refuse_line();
    Cut parts = cut(part.mesh, CutContour{std::move(height)}, {CutLoops::all, kSlide}, context);
    if (parts.lines.size() != 1 || !parts.lines.front().kept.closed()) refuse_line();
    return {std::move(parts.kept.mesh), composed(parts.kept.map, part.map),
            parts.lines.front().kept.vertices()};
}

std::vector<RingPoint> rim_of(const PastePart& part, const RingSurface& surface) {
    std::vector<RingPoint> rim;
    for (const Index v : part.loop) {
        rim.push_back(surface.blend(part.map.vertices[v]));
        rim.back().position = part.mesh.position(v);
        if (rim.back().image.inside) continue;
        throw Error(ErrorCode::boundary_conflict,
                    "the boundary leaves the target's region; move the placement inward, make its "
                    "scale smaller, or mark a larger region");
    }
    return rim;
}

namespace {

// The least rotations that bring the surface of the part into that of the target.
std::vector<Eigen::Quaterniond> tilts_of(std::span<const RingPoint> rim, const Mat3& rotation) {
    std::vector<Eigen::Quaterniond> tilts;
    for (const RingPoint& point : rim) {
        const Vec3 turned = rotation * point.normal;
        const bool known = turned.norm() > 0.0 && point.image.normal.norm() > 0.0;
        tilts.push_back(known ? min_rotation(turned, point.image.normal)
                              : Eigen::Quaterniond::Identity());
    }
    return tilts;
}

// The part of the rotations that leaves `crease` of the larger ones.
double tilt_share(std::span<const Eigen::Quaterniond> tilts, double crease) {
    std::vector<double> angles;
    for (const auto& tilt : tilts) {
        angles.push_back(tilt.angularDistance(Eigen::Quaterniond::Identity()));
    }
    const std::size_t rank = angles.size() * 9 / 10;
    std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(rank),
                     angles.end());
    return crease < angles[rank] ? 1.0 - crease / angles[rank] : 0.0;
}

// Frames turned by a share of the tilts, averaged along the loop.
std::vector<Mat3> tilted_frames(std::span<const Eigen::Quaterniond> tilts, double share,
                                const Mat3& rotation) {
    const std::size_t n = tilts.size();
    std::vector<Mat3> frames;
    for (const Eigen::Quaterniond& tilt : tilts) {
        const Eigen::Quaterniond part = Eigen::Quaterniond::Identity().slerp(share, tilt);
        frames.push_back(part.toRotationMatrix() * rotation);
    }
    for (int round = 0; round < kFrameAverages; ++round) {
        std::vector<Mat3> next;
        for (std::size_t k = 0; k < n; ++k) {
            next.push_back(nearest_rotation(0.25 * frames[(k + n - 1) % n] + 0.5 * frames[k] +
                                            0.25 * frames[(k + 1) % n]));
        }
        frames = std::move(next);
    }
    return frames;
}

}  // namespace

std::vector<BoundaryValue> paste_values(std::span<const RingPoint> rim,
                                        const PasteSimilarity& similarity, double scale,
                                        double crease) {
    const std::vector<Eigen::Quaterniond> tilts = tilts_of(rim, similarity.rotation);
    const double share = tilt_share(tilts, crease);
    const std::vector<Mat3> frames = tilted_frames(tilts, share, similarity.rotation);
    const std::vector<Mat3> upright = tilted_frames(tilts, 1.0, similarity.rotation);
    std::vector<BoundaryValue> values;
    for (std::size_t k = 0; k < rim.size(); ++k) {
        values.push_back({rim[k].image.position, frames[k], scale, crease, upright[k]});
    }
    return values;
}

PasteDistortion near_distortion(const PastePart& part, const Mesh& moved, double scale) {
    const Region near = Region(part.mesh.shared_topology(), part.loop).grown(kNearRings);
    return distortion_of(part.mesh, moved, scale, near.faces());
}

PasteDistortion feature_distortion(const PastePart& part, const Mesh& moved, double scale,
                                   std::span<const Index> feature) {
    std::vector<Index> faces;
    for (Index f = 0; f < part.mesh.face_count(); ++f) {
        if (std::binary_search(feature.begin(), feature.end(), part.map.faces.main_source(f))) {
            faces.push_back(f);
        }
    }
    return distortion_of(part.mesh, moved, scale, faces);
}

namespace {

// Parameter of the hole that is nearest to the image of each point of the source's loop, ascending
// without wrap; parameters that turn back lie between those of their neighbours.
std::vector<double> ascending_parameters(const Loop& source, const Loop& hole,
                                         std::span<const RingPoint> rim) {
    const std::size_t n = rim.size();
    std::vector<double> parameters(n, 0.0);
    std::size_t last = 0;
    const auto fill = [&](std::size_t to, double from_u, double to_u, double from_p, double to_p) {
        for (std::size_t k = last + 1; k < to; ++k) {
            const double t = (source.parameters()[k] - from_u) / (to_u - from_u);
            parameters[k] = from_p + t * (to_p - from_p);
        }
    };
    for (std::size_t k = 0; k < n; ++k) {
        double distance = 0.0;
        double u = hole.parameter_of(hole.nearest(rim[n - 1 - k].image.position, distance));
        if (k == 0) {
            parameters[0] = u;
            continue;
        }
        u += std::round(parameters[last] - u);
        if (u < parameters[last] + kMinStep || u > parameters[0] + 1.0 - kMinStep) continue;
        fill(k, source.parameters()[last], source.parameters()[k], parameters[last], u);
        parameters[k] = u;
        last = k;
    }
    fill(n, source.parameters()[last], source.parameters()[0] + 1.0, parameters[last],
         parameters[0] + 1.0);
    return parameters;
}

double min_spacing(std::span<const double> u, std::size_t k) {
    const std::size_t n = u.size();
    const double before = u[k] - u[(k + n - 1) % n] + (k == 0 ? 1.0 : 0.0);
    const double after = u[(k + 1) % n] - u[k] + (k + 1 == n ? 1.0 : 0.0);
    return std::min(before, after);
}

// The point of the hole that each of the source's meets, or kNoIndex: only those that nearly do,
// since a part that is drawn along its boundary is distorted there.
std::vector<Index> met_points(std::span<const double> source, std::span<const double> hole) {
    std::vector<Index> met(source.size(), kNoIndex), taken(hole.size(), kNoIndex);
    for (std::size_t i = 0; i < source.size(); ++i) {
        const double u = source[i] - std::floor(source[i]);
        for (std::size_t j = 0; j < hole.size(); ++j) {
            const double gap = std::abs(std::remainder(hole[j] - u, 1.0));
            const double least = std::min(min_spacing(source, i), min_spacing(hole, j));
            if (gap > kMeeting * least || taken[j] != kNoIndex) continue;
            taken[j] = index_of(i);
            met[i] = index_of(j);
            break;
        }
    }
    return met;
}

LoopPair paired(const Loop& source, const Loop& hole, std::vector<double> at) {
    LoopPair pair{source.vertices(), hole.vertices(), {}, {}};
    const std::vector<Index> met = met_points(at, hole.parameters());
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double u = at[i] - std::floor(at[i]);
        pair.on_target.push_back(met[i] == kNoIndex ? hole.place_at(u) : LoopPoint{met[i], 0.0});
        const double there = hole.parameter_of(pair.on_target.back());
        at[i] = there + std::round(at[i] - there);
    }
    for (const double u : hole.parameters()) {
        const double v = u + std::ceil(at.front() - u);
        const auto after = std::upper_bound(at.begin(), at.end(), v);
        const std::size_t k = static_cast<std::size_t>(after - at.begin()) - 1;
        const double to = k + 1 < at.size() ? at[k + 1] : at.front() + 1.0;
        const double t = to > at[k] ? (v - at[k]) / (to - at[k]) : 0.0;
        pair.on_source.push_back(t < 1.0 ? LoopPoint{index_of(k), t}
                                         : LoopPoint{index_of((k + 1) % at.size()), 0.0});
    }
    for (std::size_t i = 0; i < met.size(); ++i) {
        if (met[i] != kNoIndex)
            pair.on_source[static_cast<std::size_t>(met[i])] = {index_of(i), 0.0};
    }
    return pair;
}

}  // namespace

LoopPair paste_pair(const PastePart& part, const OpenedTarget& target,
                    std::span<const RingPoint> rim) {
    const std::vector<Index> reversed(part.loop.rbegin(), part.loop.rend());
    const Loop source(part.mesh, reversed), hole(target.mesh, target.loop);
    return paired(source, hole, ascending_parameters(source, hole, rim));
}

}  // namespace lissom
