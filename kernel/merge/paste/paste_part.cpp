#include "kernel/merge/paste/paste_part.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/rotation.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/paste/face_set.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/turned.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

constexpr int kFrameAverages = 3;
constexpr Index kNearRings = 3;

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

std::vector<BoundaryValue> paste_values(std::span<const Vec3> normals, const LoopImage& image,
                                        const PasteSimilarity& similarity, double scale) {
    const std::size_t n = normals.size();
    std::vector<Mat3> frames;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 turned = similarity.rotation * normals[k];
        const bool known = turned.norm() > 0.0 && image.normals[k].norm() > 0.0;
        const Mat3 tilt = known ? least_rotation(turned, image.normals[k]).toRotationMatrix()
                                : Mat3(Mat3::Identity());
        frames.push_back(tilt * similarity.rotation);
    }
    for (int round = 0; round < kFrameAverages; ++round) {
        std::vector<Mat3> next;
        for (std::size_t k = 0; k < n; ++k) {
            next.push_back(nearest_rotation(0.25 * frames[(k + n - 1) % n] + 0.5 * frames[k] +
                                            0.25 * frames[(k + 1) % n]));
        }
        frames = std::move(next);
    }
    std::vector<BoundaryValue> values;
    for (std::size_t k = 0; k < n; ++k) values.push_back({image.positions[k], frames[k], scale});
    return values;
}

MovedPart moved_part(const PastePart& part, std::span<const BoundaryValue> values,
                     const BoundaryDeformOptions& options, const Context& context) {
    const Region all = Region::all(part.mesh.shared_topology());
    const Region held(part.mesh.shared_topology(), part.loop);
    BoundaryDeformer deformer(part.mesh, all, held, options, context);
    std::vector<BoundaryValue> ordered(values.size());
    for (std::size_t k = 0; k < part.loop.size(); ++k) {
        const auto& ids = deformer.held().vertices();
        const auto row = std::lower_bound(ids.begin(), ids.end(), part.loop[k]) - ids.begin();
        ordered[at(row)] = values[k];
    }
    const BoundaryDeformation deformed = deformer.solve(ordered, context);
    MovedPart result{part.mesh, deformer.stats()};
    std::vector<Vec3> positions(part.mesh.positions().begin(), part.mesh.positions().end());
    const std::vector<Index>& ids = deformer.region().vertices();
    for (std::size_t row = 0; row < ids.size(); ++row) {
        positions[at(ids[row])] = deformed.positions[row];
    }
    result.mesh.set_positions(std::move(positions));
    turn_directions(part.mesh, deformer.region(), deformed, result.mesh);
    return result;
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

LoopPair paste_pair(const PastePart& part, const OpenedTarget& target,
                    std::span<const Vec3> images) {
    const std::vector<Index> reversed(part.loop.rbegin(), part.loop.rend());
    const Loop source(part.mesh, reversed), hole(target.mesh, target.loop);
    const std::size_t n = reversed.size();
    std::vector<ParameterPair> keys;
    double last = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        double distance = 0.0;
        double parameter = hole.parameter_of(hole.nearest(images[n - 1 - k], distance));
        if (!keys.empty()) parameter += std::round(last - parameter);
        const double first = keys.empty() ? parameter : keys.front().target;
        const double least = 1e-6;
        if (!keys.empty() && (parameter < last + least || parameter > first + 1.0 - least)) {
            continue;
        }
        keys.push_back({source.parameters()[k], parameter});
        last = parameter;
    }
    for (ParameterPair& key : keys) key.target -= std::floor(key.target);
    std::sort(keys.begin(), keys.end(),
              [](const ParameterPair& a, const ParameterPair& b) { return a.target < b.target; });
    return corresponding(source, hole, keys);
}

}  // namespace lissom
