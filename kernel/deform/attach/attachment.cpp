#include "kernel/deform/attach/attachment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/memory_hold.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/rest_directions.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"

namespace lissom {
namespace {

// Vertices of a component that are farther from the surface than its nearest, by this share of
// its extent, do not sit on it.
constexpr double kContactDepth = 0.1;

constexpr Index kVertexGrain = 256, kPieceGrain = 16;

// A vertex of the surface below a piece: its share of the piece's origin, and its weight in the fit
// of the rotation.
struct Support {
    Index vertex;
    double share, weight;
    Vec3 rest;
};

// Vertices order[begin .. end) and supports [first .. last).
struct Piece {
    Index begin, end, first, last;
};

std::vector<std::vector<Index>> vertices_of_components(const Topology& topology) {
    std::vector<std::vector<Index>> components(topology.component_count());
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        components[topology.components()[v]].push_back(v);
    }
    return components;
}

std::vector<SurfacePoint> points_below(const SpatialTree& tree, const Mesh& attached,
                                       const Context& context) {
    std::vector<SurfacePoint> points(attached.vertex_count());
    context.parallel_for(0, attached.vertex_count(), kVertexGrain, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) points[v] = tree.nearest(attached.position(v));
    });
    return points;
}

double nearest_distance(std::span<const Index> vertices, std::span<const SurfacePoint> points) {
    double nearest = points[vertices.front()].distance;
    for (const Index v : vertices) nearest = std::min(nearest, points[v].distance);
    return nearest;
}

double extent_of(std::span<const Index> vertices, const Mesh& mesh) {
    Vec3 center = Vec3::Zero();
    for (const Index v : vertices) center += mesh.position(v) / count_of(vertices);
    double extent = 0.0;
    for (const Index v : vertices) {
        extent = std::max(extent, (mesh.position(v) - center).norm());
    }
    return extent;
}

// The vertices of a component that sit on the surface.
std::vector<Index> contact_of(std::span<const Index> vertices, const Mesh& attached,
                              std::span<const SurfacePoint> points) {
    const double limit =
        nearest_distance(vertices, points) + kContactDepth * extent_of(vertices, attached);
    std::vector<Index> contact;
    for (const Index v : vertices) {
        if (points[v].distance <= limit) contact.push_back(v);
    }
    return contact;
}

double checked_distance(const Mesh& surface, const AttachmentOptions& options) {
    require(std::isfinite(options.max_distance) && options.max_distance >= 0.0,
            "max_distance must be finite and at least 0");
    return options.max_distance > 0.0 ? options.max_distance : surface_radius(surface);
}

}  // namespace

struct Attachment::State {
    AttachmentOptions options;
    std::shared_ptr<const Topology> surface, attached;
    std::vector<Vec3> rest;
    std::vector<Support> supports;
    std::vector<Index> order;
    std::vector<Piece> pieces;
    RestDirections directions;
    double distance = 0.0;
    MemoryHold hold;

    std::span<const Support> below(const Piece& piece) const {
        return std::span(supports).subspan(at(piece.first), at(piece.last - piece.first));
    }

    // Weights are continuous in the points: a corner counts with its barycentric coordinate, and
    // its ring with it.
    void add_piece(std::span<const Index> vertices, std::span<const Index> contact,
                   std::span<const SurfacePoint> points, const Mesh& mesh) {
        std::map<Index, Support> found;
        const auto support = [&](Index v) -> Support& {
            return found.try_emplace(v, Support{v, 0.0, 0.0, mesh.position(v)}).first->second;
        };
        for (const Index c : contact) {
            for (int k = 0; k < 3; ++k) {
                const double share = points[c].barycentric[k] / count_of(contact);
                const Index corner = points[c].triangle[k];
                support(corner).share += share;
                support(corner).weight += share;
                for (const Index v : surface->neighbors(corner)) support(v).weight += share;
            }
        }
        const Piece piece{count_of(order), count_of(order) + count_of(vertices), count_of(supports),
                          count_of(supports) + count_of(found)};
        order.insert(order.end(), vertices.begin(), vertices.end());
        for (const auto& [vertex, entry] : found) supports.push_back(entry);
        pieces.push_back(piece);
    }

    bool is_at_rest(const Piece& piece, std::span<const Vec3> now) const {
        const auto stays = [&](const Support& s) { return now[s.vertex] == s.rest; };
        const std::span<const Support> all = below(piece);
        return std::all_of(all.begin(), all.end(), stays);
    }

    // Moves one piece, and writes its rotation.
    void move(const Piece& piece, std::span<const Vec3> now, std::span<Vec3> out,
              std::span<Mat3> turns) const {
        Vec3 origin = Vec3::Zero(), moved_origin = Vec3::Zero();
        for (const Support& s : below(piece)) {
            origin += s.share * s.rest;
            moved_origin += s.share * now[s.vertex];
        }
        Mat3 covariance = Mat3::Zero();
        double before = 0.0, after = 0.0;
        for (const Support& s : below(piece)) {
            const Vec3 from = s.rest - origin, to = now[s.vertex] - moved_origin;
            covariance += s.weight * to * from.transpose();
            before += s.weight * from.squaredNorm();
            after += s.weight * to.squaredNorm();
        }
        const Mat3 turn = nearest_rotation(covariance);
        const double scale = options.scale && before > 0.0 ? std::sqrt(after / before) : 1.0;
        for (Index i = piece.begin; i < piece.end; ++i) {
            const Index v = order[i];
            out[v] = moved_origin + scale * (turn * (rest[v] - origin));
            turns[v] = turn;
        }
    }

    void place(const Mesh& mesh, std::vector<Vec3>& out, std::vector<Mat3>& turns,
               const Context& context) const {
        context.parallel_for(0, count_of(pieces), kPieceGrain, [&](Index begin, Index end) {
            for (Index p = begin; p < end; ++p) {
                if (!is_at_rest(pieces[p], mesh.positions())) {
                    move(pieces[p], mesh.positions(), out, turns);
                }
            }
        });
    }
};

Attachment::Attachment(const Mesh& surface, const Mesh& attached, const AttachmentOptions& options,
                       const Context& context) {
    require(attached.vertex_count() > 0, "the attached mesh has no vertices",
            ErrorCode::mesh_empty);
    const double limit = checked_distance(surface, options);
    const SpatialTree tree(surface, context);
    const std::vector<SurfacePoint> points = points_below(tree, attached, context);
    auto state = std::make_shared<State>(
        State{options,
              surface.shared_topology(),
              attached.shared_topology(),
              {attached.positions().begin(), attached.positions().end()},
              {},
              {},
              {},
              RestDirections(attached, Region::all(attached.shared_topology())),
              0.0,
              MemoryHold(context.memory(), "an attached mesh")});
    Elements astray{ElementKind::vertex, 0, {}};
    for (const std::vector<Index>& component : vertices_of_components(attached.topology())) {
        const double distance = nearest_distance(component, points);
        state->distance = std::max(state->distance, distance);
        if (distance > limit) astray.add(component.front());
        if (options.mode == AttachmentMode::components) {
            state->add_piece(component, contact_of(component, attached, points), points, surface);
        } else {
            for (const Index& v : component) {
                state->add_piece(std::span(&v, 1), std::span(&v, 1), points, surface);
            }
        }
        context.checkpoint();
    }
    if (astray.count > 0) {
        throw Error(ErrorCode::invalid_argument,
                    "components of the attached mesh, one vertex of each named, lie off the "
                    "surface; move them onto it or raise max_distance",
                    std::move(astray));
    }
    state->hold.resize(state->supports.size() * sizeof(Support) +
                       state->rest.size() * (sizeof(Vec3) + sizeof(Index)) +
                       state->pieces.size() * sizeof(Piece));
    state_ = std::move(state);
}

void Attachment::follow(const Mesh& surface, Mesh& attached, const Context& context) const {
    require_same_topology(surface, state_->surface, "the surface of the attachment");
    require_same_topology(attached, state_->attached, "the attached mesh");
    std::vector<Vec3> positions = state_->rest;
    std::vector<Mat3> turns(positions.size(), Mat3::Identity());
    state_->place(surface, positions, turns, context);
    std::vector<Mat3> alone;
    for (const Index v : state_->directions.without_faces()) alone.push_back(turns[v]);
    attached.set_positions(std::move(positions));
    state_->directions.apply_to(attached, alone);
}

double Attachment::distance() const {
    return state_->distance;
}

std::size_t Attachment::memory_bytes() const {
    return state_->hold.bytes();
}

}  // namespace lissom
