#include "kernel/hair/follow/strand_follow.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/follow/motion_field.h"
#include "kernel/hair/follow/skin_binding.h"
#include "kernel/hair/follow/skin_contact.h"
#include "kernel/hair/follow/strand_lift.h"
#include "kernel/hair/follow/strand_paths.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_place.h"

namespace lissom {
namespace {

constexpr Index kFollowGrain = 32;
// Vertices whose motions the space around the head follows.
constexpr Index kSamples = 300;
// Metres around the hair in which vertices count.
constexpr double kAround = 0.03;
// Metres over the skin within which points are bound to it.
constexpr double kBindReach = 0.006;
void require_options(const FollowOptions& options) {
    const auto is_factor = [](const std::optional<double>& x) {
        return !x || (*x > 0.0 && std::isfinite(*x));
    };
    require(is_factor(options.unit), "the unit of the head must be finite and above 0");
    require(is_factor(options.scale), "the scale of following hair must be finite and above 0");
    require(is_length(options.ramp) && is_length(options.smoothing) && is_length(options.clearance),
            "ramp, smoothing and clearance must be finite and not negative");
}

double unit_under(const Strands& strands, const Mesh& rest, const FollowOptions& options) {
    const std::vector<Index>& faces = strands.roots().faces;
    require(std::any_of(faces.begin(), faces.end(), [](Index f) { return f != kNoIndex; }) ||
                strands.empty(),
            "the strands have no roots on a head; give them some with hair:attach{ head = style }");
    if (strands.size() < 2) return options.unit.value_or(1.0);
    const std::optional<double> unit = unit_of_roots(strands, rest);
    require(unit.has_value(),
            "the strands are not rooted on the head at rest; give the head as it was under them, "
            "or root them with hair:attach{ head = style }");
    return options.unit.value_or(*unit);
}

// Vertices that carry roots, and those near the hair.
std::vector<Index> active_vertices(const Strands& strands, const Mesh& rest, double unit) {
    std::vector<char> active(at(rest.vertex_count()), 0);
    for (Index s = 0; s < strands.size(); ++s) {
        const auto triangle = root_triangle(strands.roots(), s, rest);
        if (!triangle) continue;
        for (const Index v : *triangle) active[at(v)] = 1;
    }
    Box box = bounds(strands);
    if (!box.empty()) {
        box.min -= Vec3::Constant(kAround);
        box.max += Vec3::Constant(kAround);
    }
    std::vector<Index> list;
    for (Index v = 0; v < rest.vertex_count(); ++v) {
        if (active[at(v)] || box.contains(unit * rest.position(v))) list.push_back(v);
    }
    return list;
}

// Vertices that the space around the head moves with: of the parts that carry roots, since eyes and
// teeth may turn by themselves.
std::vector<Index> sample_vertices(const Strands& strands, const Mesh& rest,
                                   const HeadMotion& head) {
    const Topology& topology = rest.topology();
    std::vector<char> parts(at(topology.component_count()), 0);
    for (Index s = 0; s < strands.size(); ++s) {
        const auto triangle = root_triangle(strands.roots(), s, rest);
        if (triangle) parts[at(topology.components()[at((*triangle)[0])])] = 1;
    }
    std::vector<Index> among;
    for (const Index v : head.active()) {
        if (parts[at(topology.components()[at(v)])]) among.push_back(v);
    }
    return spread_vertices(head.rest(), among, kSamples);
}

std::vector<Triangle> root_triangles(const Strands& strands, const Mesh& rest) {
    std::vector<Triangle> list;
    for (Index s = 0; s < strands.size(); ++s) {
        list.push_back(root_triangle(strands.roots(), s, rest)
                           .value_or(Triangle{kNoIndex, kNoIndex, kNoIndex}));
    }
    return list;
}

std::vector<Vec3> scaled_places(const Mesh& mesh, double unit) {
    std::vector<Vec3> places(mesh.positions().begin(), mesh.positions().end());
    for (Vec3& place : places) place *= unit;
    return places;
}

// Scales all lengths that strands hold, as `transform` does, except their points.
void scale_but_points(Strands& strands, double scale) {
    const std::vector<float> points(strands.points().begin(), strands.points().end());
    transform(strands, {scale * Mat3::Identity(), Vec3::Zero()});
    std::copy(points.begin(), points.end(), strands.edit_points().begin());
}

}  // namespace

class StrandFollower::Prepared {
  public:
    Prepared(Strands hair, const Mesh& rest, const FollowOptions& given, const Context& context)
        : options(given),
          strands(std::move(hair)),
          unit(unit_under(strands, rest, options)),
          head(scaled_places(rest, unit), rest.shared_topology(),
               active_vertices(strands, rest, unit), options.smoothing),
          paths(strands, root_triangles(strands, rest), options.ramp, head, context),
          field(paths.knots(), head, sample_vertices(strands, rest, head), context),
          triangles(triangulate_faces(rest.topology(), rest.positions())) {
        rest_positions.assign(rest.positions().begin(), rest.positions().end());
        charge_ = context.charge(strands.memory_bytes() + head.rest().size() * 4 * sizeof(Vec3),
                                 "hair that follows");
        if (options.collision == FollowCollision::none || strands.empty()) return;
        skin_.emplace(head.rest(), triangles, head.topology(), head.outward(), context);
        if (options.collision == FollowCollision::near) {
            const SkinBinding::Options bind{kBindReach, options.clearance};
            binding_ = SkinBinding(strands, paths, *skin_, head, bind, context);
        }
    }

    void move(std::span<const Vec3> positions, std::span<float> points, const Context& context) {
        head.move(positions, unit, options.scale, context);
        field.move(head, context);
        std::optional<SkinSurface> moved;
        if (options.collision == FollowCollision::all && skin_) {
            moved.emplace(head.places(), triangles, head.topology(), head.outward(), context);
        }
        context.parallel_for(0, paths.group_count(), kFollowGrain, [&](Index begin, Index end) {
            StrandPaths::Room room;
            for (Index g = begin; g < end; ++g) {
                paths.move(g, head, field, binding_, points, room);
                if (!moved) continue;
                const auto [first, last] = paths.group(g);
                for (std::size_t i = first; i < last; ++i) lift(i, points, *moved);
            }
        });
    }

    std::size_t memory_bytes() const {
        return strands.memory_bytes() + field.memory_bytes() + binding_.memory_bytes() +
               paths.memory_bytes() + head.rest().size() * 8 * sizeof(Vec3);
    }

    FollowOptions options;
    Strands strands;
    double unit;
    HeadMotion head;
    StrandPaths paths;
    MotionField field;
    Triangulation triangles;
    std::vector<Vec3> rest_positions;

  private:
    // Out of all skin.
    void lift(std::size_t place, std::span<float> points, const SkinSurface& moved) const {
        const auto arcs = paths.arcs(place);
        if (!(arcs.back() > 0.0f)) return;
        const StrandView rest = strands.strand(paths.strand(place));
        const LiftedStrand strand{rest, arcs, {points.data() + paths.made(place), 3, rest.cols()}};
        StrandLift(head, options.clearance).out_of(moved, *skin_, strand);
    }

    /// The skin at rest.
    std::optional<SkinSurface> skin_;
    SkinBinding binding_;
    MemoryCharge charge_;
};

StrandFollower::StrandFollower(Strands strands, const Mesh& rest, const FollowOptions& options,
                               const Context& context) {
    require_options(options);
    prepared_ = std::make_unique<Prepared>(std::move(strands), rest, options, context);
}

StrandFollower::StrandFollower(StrandFollower&&) noexcept = default;
StrandFollower& StrandFollower::operator=(StrandFollower&&) noexcept = default;
StrandFollower::~StrandFollower() = default;

const Strands& StrandFollower::strands() const {
    return prepared_->strands;
}

std::size_t StrandFollower::memory_bytes() const {
    return prepared_->memory_bytes();
}

Strands StrandFollower::follow(const Mesh& head, const Context& context) {
    const Topology &own = prepared_->head.topology(), &other = head.topology();
    const bool same = &own == &other || (own.vertex_count() == other.vertex_count() &&
                                         own.faces().offsets == other.faces().offsets &&
                                         own.faces().vertices == other.faces().vertices);
    if (!same) {
        const bool other_size = own.vertex_count() != other.vertex_count();
        throw Error(
            ErrorCode::topology_mismatch,
            "the head has other faces than the one that the strands grew on" +
                (other_size ? " (" + std::to_string(other.vertex_count()) + " vertices, not " +
                                  std::to_string(own.vertex_count()) + ")"
                            : std::string(", or they turn the other way")) +
                "; deform a copy of that head, or root the strands on the new one with "
                "hair:attach{ head = style }");
    }
    Strands result = prepared_->strands;
    move(head.positions(), result.edit_points(), context);
    if (prepared_->head.scale() != 1.0) scale_but_points(result, prepared_->head.scale());
    return result;
}

void StrandFollower::move(std::span<const Vec3> positions, std::span<float> points,
                          const Context& context) {
    Prepared& p = *prepared_;
    require(positions.size() == p.rest_positions.size(),
            "the head has " + std::to_string(p.rest_positions.size()) + " vertices; " +
                std::to_string(positions.size()) + " positions are given");
    require(points.size() == p.strands.points().size(),
            "the strands have " + std::to_string(p.strands.point_count()) +
                " points; give room for three numbers each");
    Elements bad{ElementKind::vertex, 0, {}};
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (!positions[v].allFinite()) bad.add(index_of(v));
    }
    if (bad.count > 0) {
        const std::string names = describe(bad);
        throw Error(ErrorCode::not_finite, "positions of " + names + " are not finite",
                    std::move(bad));
    }
    if (std::equal(positions.begin(), positions.end(), p.rest_positions.begin())) {
        p.head.rest_again();
        std::copy(p.strands.points().begin(), p.strands.points().end(), points.begin());
        return;
    }
    Progress progress(context, "follow the head");
    p.move(positions, points, context);
}

}  // namespace lissom
