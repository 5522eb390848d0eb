#include "kernel/deform/poses/pose_space.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/memory_hold.h"
#include "kernel/core/nearest.h"
#include "kernel/deform/poses/edge_surface.h"
#include "kernel/deform/poses/posed_shape.h"
#include "kernel/deform/rotation/rest_directions.h"
#include "kernel/mesh/measure/same_faces.h"
#include "kernel/mesh/region.h"

namespace lissom {
namespace {

void require_poses(const Mesh& rest, const std::vector<NamedPose>& poses) {
    require(rest.vertex_count() > 0, "the rest shape has no vertices", ErrorCode::mesh_empty);
    require(!poses.empty(), "a pose space needs a pose; give at least one");
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const std::string& name = poses[i].name;
        require(!name.empty(), "a pose needs a name");
        require(!poses[i].shapes.empty(), "the pose '" + name + "' has no shapes");
        for (std::size_t k = 0; k < i; ++k) {
            require(poses[k].name != name, "there are two poses called '" + name + "'");
        }
        for (const Mesh& shape : poses[i].shapes) {
            require(have_same_faces(rest, shape),
                    "the pose '" + name +
                        "' has other vertices or faces than the rest shape; pose a copy of the "
                        "rest shape, and load files with the same options",
                    ErrorCode::topology_mismatch);
        }
    }
}

// Vertices that no shape moves.
std::vector<char> unmoved_vertices(const Mesh& rest, const std::vector<NamedPose>& poses) {
    std::vector<char> unmoved(at(rest.vertex_count()), 1);
    for (const NamedPose& pose : poses) {
        for (const Mesh& shape : pose.shapes) {
            for (Index v = 0; v < rest.vertex_count(); ++v) {
                if (shape.position(v) != rest.position(v)) unmoved[at(v)] = 0;
            }
        }
    }
    return unmoved;
}

// The shapes of a path, rest first, on either side of a weight; beyond its ends the last two.
struct PathPlace {
    std::size_t before;
    double fraction;
};

PathPlace place_on_path(double weight, std::size_t count) {
    const double along = weight * static_cast<double>(count);
    const double before = std::clamp(std::floor(along), 0.0, static_cast<double>(count - 1));
    return {static_cast<std::size_t>(before), along - before};
}

// Memory of a blend.
struct BlendRoom {
    std::vector<double> values;
    std::vector<TriangleEdges> edges;
    std::vector<FloatingSum> sums;
    std::vector<Vec3> positions;
};

}  // namespace

struct PoseFrames::Room {
    std::vector<ShapeShare> shares;
    BlendRoom blend;
};

struct PoseSpace::State {
    Mesh rest;
    PoseTriangles triangles;
    std::optional<EdgeSurface> surface;
    RestDirections directions;
    std::vector<std::string> names;
    std::vector<std::vector<PosedShape>> poses;
    MemoryHold hold;

    State(const Mesh& mesh, const std::vector<NamedPose>& given, const Context& context)
        : rest(mesh),
          triangles(pose_triangles(mesh, context)),
          directions(mesh, Region::all(mesh.shared_topology())),
          hold(context.memory(), "a pose space") {
        hold.resize(shape_count(given) * bytes_of_shape());
        surface.emplace(mesh, triangles, unmoved_vertices(mesh, given), context);
        for (const NamedPose& pose : given) add(pose, context);
    }

    static std::size_t shape_count(const std::vector<NamedPose>& given) {
        std::size_t count = 0;
        for (const NamedPose& pose : given) count += pose.shapes.size();
        return count;
    }

    std::size_t bytes_of_shape() const {
        return at(rest.vertex_count()) * sizeof(Vec3) +
               triangles.triangles.size() * (sizeof(SurfaceTurn) + sizeof(TriangleEdges));
    }

    void add(const NamedPose& pose, const Context& context) {
        names.push_back(pose.name);
        std::vector<PosedShape>& shapes = poses.emplace_back();
        for (const Mesh& shape : pose.shapes) {
            const std::span<const SurfaceTurn> before =
                shapes.empty() ? std::span<const SurfaceTurn>() : shapes.back().turns;
            shapes.push_back(posed_shape(triangles, rest.positions(),
                                         {shape.positions().begin(), shape.positions().end()},
                                         before, context));
        }
    }

    std::size_t pose_number(const std::string& name) const {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) return at(found - names.begin());
        throw Error(ErrorCode::out_of_range, "there is no pose '" + name + "'" +
                                                 name_hint(name, {names.begin(), names.end()}));
    }

    std::vector<double> in_order(const std::vector<PoseWeight>& weights) const {
        std::vector<double> sums(names.size(), 0.0);
        for (const PoseWeight& given : weights) sums[pose_number(given.name)] += given.weight;
        return sums;
    }

    // Of a weight for each pose.
    void find_shares(std::span<const double> weights, std::vector<ShapeShare>& shares) const {
        shares.clear();
        shares.reserve(2 * poses.size());
        for (std::size_t p = 0; p < poses.size(); ++p) {
            if (!std::isfinite(weights[p])) {
                throw Error(ErrorCode::not_finite,
                            "the weight of the pose '" + names[p] + "' is not finite");
            }
            const auto [before, fraction] = place_on_path(weights[p], poses[p].size());
            if (before > 0 && fraction != 1.0) {
                shares.push_back({&poses[p][before - 1], 1.0 - fraction});
            }
            if (fraction != 0.0) shares.push_back({&poses[p][before], fraction});
        }
    }

    // Leaves the positions in `room`.
    void blend(std::span<const ShapeShare> shares, BlendRoom& room, const Context& context) const {
        std::vector<Vec3>& result = room.positions;
        const bool is_pose = shares.size() == 1 && shares[0].share == 1.0;
        if (shares.empty() || is_pose) {
            const std::span<const Vec3> known =
                is_pose ? std::span<const Vec3>(shares[0].shape->positions) : rest.positions();
            result.assign(known.begin(), known.end());
            return;
        }
        blend_edges(triangles, rest.positions(), shares, room.edges, context);
        context.checkpoint();
        surface->solve(triangles, room.edges, room.values, result);
        place_floating(triangles, rest.topology().components(), surface->floats(), rest.positions(),
                       shares, room.sums, result);
        move_isolated(shares, result);
        const bool is_finite =
            std::all_of(result.begin(), result.end(), [](const Vec3& p) { return p.allFinite(); });
        require(is_finite, "the weights are so large that the surface is not finite",
                ErrorCode::not_finite);
    }

    // Vertices without faces go along straight lines.
    void move_isolated(std::span<const ShapeShare> shares, std::span<Vec3> result) const {
        for (Index v = 0; v < rest.vertex_count(); ++v) {
            if (!rest.topology().is_isolated(v)) continue;
            for (const auto& [shape, share] : shares) {
                result[at(v)] += share * (shape->positions[at(v)] - rest.position(v));
            }
        }
    }
};

PoseSpace::PoseSpace(const Mesh& rest, const std::vector<NamedPose>& poses,
                     const Context& context) {
    require_poses(rest, poses);
    state_ = std::make_shared<const State>(rest, poses, context);
}

std::vector<Vec3> PoseSpace::positions(const std::vector<PoseWeight>& weights,
                                       const Context& context) const {
    std::vector<ShapeShare> shares;
    state_->find_shares(state_->in_order(weights), shares);
    BlendRoom room;
    state_->blend(shares, room, context);
    return std::move(room.positions);
}

Mesh PoseSpace::blend(const std::vector<PoseWeight>& weights, const Context& context) const {
    Mesh mesh = state_->rest;
    mesh.set_positions(positions(weights, context));
    const RestDirections& directions = state_->directions;
    const std::vector<Mat3> alone(directions.without_faces().size(), Mat3::Identity());
    directions.apply_to(mesh, alone);
    return mesh;
}

const Mesh& PoseSpace::rest() const {
    return state_->rest;
}

std::vector<std::string> PoseSpace::names() const {
    return state_->names;
}

Index PoseSpace::shape_count(const std::string& name) const {
    return count_of(state_->poses[state_->pose_number(name)]);
}

std::size_t PoseSpace::memory_bytes() const {
    return state_->hold.bytes() + state_->surface->memory_bytes();
}

PoseFrames::PoseFrames(PoseSpace space)
    : space_(std::move(space)), room_(std::make_unique<Room>()) {}

PoseFrames::~PoseFrames() = default;
PoseFrames::PoseFrames(PoseFrames&&) noexcept = default;
PoseFrames& PoseFrames::operator=(PoseFrames&&) noexcept = default;

std::span<const Vec3> PoseFrames::positions(std::span<const double> weights,
                                            const Context& context) {
    const PoseSpace::State& state = *space_.state_;
    if (weights.size() != state.names.size()) {
        throw Error(ErrorCode::invalid_argument, "there must be a weight for each of the " +
                                                     std::to_string(state.names.size()) + " poses");
    }
    state.find_shares(weights, room_->shares);
    state.blend(room_->shares, room_->blend, context);
    return room_->blend.positions;
}

Index PoseFrames::pose_count() const {
    return count_of(space_.state_->names);
}

}  // namespace lissom
