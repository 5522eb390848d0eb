#include "kernel/deform/poses/transfer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/poses/correspondence_space.h"
#include "kernel/deform/poses/edge_surface.h"
#include "kernel/deform/poses/pose_triangles.h"
#include "kernel/deform/poses/turn_field.h"
#include "kernel/deform/rotation/rest_directions.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/same_faces.h"

namespace lissom {
namespace {

// So many triangles give the gradient of one together.
constexpr std::size_t kNearest = 4;
// Triangles as near as this, in the space of correspondence, count alike.
constexpr double kAlike = 0.01;

// A part that moves by this fraction of the pose's motion counts half as one that stays.
constexpr double kCalmPart = 0.01;

constexpr Index kTransferGrain = 256;

void require_pairs(const Mesh& from, const Mesh& to, const std::vector<TransferPair>& pairs) {
    require(from.face_count() > 0 && to.face_count() > 0,
            "a mesh without faces has no pose to transfer", ErrorCode::mesh_empty);
    require(!pairs.empty() || have_same_faces(from, to),
            "the meshes have different faces; give pairs of parts that correspond",
            ErrorCode::topology_mismatch);
    std::vector<char> is_taken_from(at(from.vertex_count()), 0),
        is_taken_to(at(to.vertex_count()), 0);
    const auto take = [](const Region& part, std::vector<char>& taken) {
        require(!part.empty(), "a part of a pair has no vertices", ErrorCode::region_empty);
        for (const Index v : part.vertices()) {
            if (!taken[at(v)]++) continue;
            throw Error(ErrorCode::invalid_argument, "parts of pairs overlap",
                        {ElementKind::vertex, 1, {v}});
        }
    };
    for (const TransferPair& pair : pairs) {
        require_same_topology(from, pair.from.topology(), "a part of the posed mesh");
        require_same_topology(to, pair.to.topology(), "a part of the other mesh");
        take(pair.from, is_taken_from);
        take(pair.to, is_taken_to);
    }
}

// The deformation gradients of triangles and links; flat ones turn as their neighbours or hosts.
std::vector<Mat3> gradients_of(const PoseTriangles& triangles, std::span<const Vec3> rest,
                               std::span<const Vec3> posed, const Context& context) {
    const std::vector<SurfaceTurn> turns = surface_turns(triangles, rest, posed, {}, context);
    std::vector<Mat3> gradients;
    for (Index t = 0; t < count_of(triangles.triangles); ++t) {
        const TriangleEdges before = edges_of(triangles.triangles[at(t)], rest);
        const TriangleEdges after = edges_of(triangles.triangles[at(t)], posed);
        const bool flat = is_flat(before) || is_flat(after);
        gradients.push_back(flat ? turns[at(t)].rotation()
                                 : Mat3(edge_frame(after) * edge_frame(before).inverse()));
    }
    return gradients;
}

// For each triangle of the other mesh, the gradients of those that correspond, by nearness.
std::vector<Mat3> corresponding_gradients(const PartCoordinates& from, const PartCoordinates& to,
                                          const std::vector<Mat3>& gradients,
                                          const Context& context) {
    const NearestParts tree(from);
    std::vector<Mat3> result(at(to.count()));
    context.parallel_for(0, to.count(), kTransferGrain, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            Mat3 sum = Mat3::Zero();
            double weights = 0.0;
            for (const NearestParts::Hit& hit : tree.nearest(to.at(t), kNearest)) {
                const double weight = 1.0 / (hit.squared_distance + kAlike * kAlike);
                sum += weight * gradients[at(hit.point)];
                weights += weight;
            }
            result[at(t)] = sum / weights;
        }
    });
    return result;
}

bool is_unmoved(const Region& part, const Mesh& rest, const Mesh& posed) {
    return std::all_of(part.vertices().begin(), part.vertices().end(),
                       [&](Index v) { return rest.position(v) == posed.position(v); });
}

Vec3 mean_place(const Region& part, std::span<const Vec3> positions) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : part.vertices()) sum += positions[at(v)] / part.size();
    return sum;
}

// Each vertex alone, if the faces are the same.
std::vector<TransferPair> vertex_pairs(const Mesh& from, const Mesh& to) {
    std::vector<TransferPair> pairs;
    for (Index v = 0; v < from.vertex_count(); ++v) {
        pairs.push_back({{from.shared_topology(), {v}}, {to.shared_topology(), {v}}});
    }
    return pairs;
}

class Transfer {
  public:
    Transfer(const Mesh& from, const Mesh& posed, const Mesh& to,
             const std::vector<TransferPair>& pairs, const Context& context)
        : from_(from),
          posed_(posed),
          to_(to),
          pairs_(pairs),
          triangles_(pose_triangles(to, context)),
          scale_(surface_radius(from) > 0.0 ? surface_radius(to) / surface_radius(from) : 1.0) {}

    std::vector<Vec3> run(bool by_parts, const Context& context) const {
        const std::vector<Mat3> gradients = gradients_for(by_parts, context);
        std::vector<char> holds(at(to_.vertex_count()), 0);
        for (const TransferPair& pair : pairs_) {
            if (!is_unmoved(pair.from, from_, posed_)) continue;
            for (const Index v : pair.to.vertices()) holds[at(v)] = 1;
        }
        const EdgeSurface surface(to_, triangles_, std::move(holds), context);
        std::vector<TriangleEdges> edges;
        for (std::size_t t = 0; t < triangles_.triangles.size(); ++t) {
            const TriangleEdges rest = edges_of(triangles_.triangles[t], to_.positions());
            edges.push_back({gradients[t] * rest.first, gradients[t] * rest.second});
        }
        std::vector<double> values;
        std::vector<Vec3> positions;
        surface.solve(triangles_, edges, values, positions);
        place(surface.floats(), positions);
        move_isolated(positions);
        return positions;
    }

  private:
    std::vector<Mat3> gradients_for(bool by_parts, const Context& context) const {
        // The polygons of both meshes are divided as those of the other one.
        if (!by_parts) {
            return gradients_of(triangles_, from_.positions(), posed_.positions(), context);
        }
        const PoseTriangles source = pose_triangles(from_, context);
        std::vector<const Region*> parts_from, parts_to;
        for (const TransferPair& pair : pairs_) {
            parts_from.push_back(&pair.from);
            parts_to.push_back(&pair.to);
        }
        std::vector<Mat3> gradients = corresponding_gradients(
            part_coordinates(from_, source, parts_from, context),
            part_coordinates(to_, triangles_, parts_to, context),
            gradients_of(source, from_.positions(), posed_.positions(), context), context);
        for (const Index host : triangles_.hosts) gradients.push_back(gradients[at(host)]);
        return gradients;
    }

    // Moves each floating component as its calmest parts move.
    void place(const std::vector<char>& floats, std::span<Vec3> positions) const {
        const std::vector<Index>& components = to_.topology().components();
        std::vector<Vec3> shift(floats.size(), Vec3::Zero());
        std::vector<double> weights(floats.size(), 0.0);
        double greatest = 0.0;
        for (const TransferPair& pair : pairs_) greatest = std::max(greatest, motion(pair).norm());
        const double calm = std::max(kCalmPart * greatest, 1e-150);
        for (const TransferPair& pair : pairs_) {
            const std::size_t component =
                at(triangles_.base[at(components[at(pair.to.vertices().front())])]);
            const Vec3 goal = mean_place(pair.to, to_.positions()) + scale_ * motion(pair);
            const double weight = calm * calm / (motion(pair).squaredNorm() + calm * calm);
            shift[component] += weight * (goal - mean_place(pair.to, positions));
            weights[component] += weight;
        }
        for (std::size_t v = 0; v < positions.size(); ++v) {
            const std::size_t component = at(triangles_.base[at(components[v])]);
            if (floats[component]) positions[v] += shift[component] / weights[component];
        }
    }

    // Vertices without faces go as their parts do.
    void move_isolated(std::span<Vec3> positions) const {
        for (const TransferPair& pair : pairs_) {
            for (const Index v : pair.to.vertices()) {
                if (to_.topology().is_isolated(v)) positions[at(v)] += scale_ * motion(pair);
            }
        }
    }

    Vec3 motion(const TransferPair& pair) const {
        return mean_place(pair.from, posed_.positions()) - mean_place(pair.from, from_.positions());
    }

    const Mesh &from_, &posed_, &to_;
    const std::vector<TransferPair>& pairs_;
    PoseTriangles triangles_;
    double scale_;
};

}  // namespace

Mesh transferred(const Mesh& from, const Mesh& from_posed, const Mesh& to,
                 const std::vector<TransferPair>& pairs, const Context& context) {
    require(have_same_faces(from, from_posed),
            "the posed mesh has other vertices or faces than the mesh at rest; pose a copy of it",
            ErrorCode::topology_mismatch);
    require_pairs(from, to, pairs);
    const std::vector<TransferPair> all = pairs.empty() ? vertex_pairs(from, to) : pairs;
    Mesh result = to;
    result.set_positions(Transfer(from, from_posed, to, all, context).run(!pairs.empty(), context));
    const RestDirections directions(to, Region::all(to.shared_topology()));
    const std::vector<Mat3> alone(directions.without_faces().size(), Mat3::Identity());
    directions.apply_to(result, alone);
    return result;
}

}  // namespace lissom
