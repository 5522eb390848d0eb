#include "kernel/merge/sew/seam_umbrella.h"

#include <algorithm>
#include <utility>

#include "kernel/merge/sew/seam_attributes.h"
#include "kernel/merge/sew/seam_guard.h"
#include "kernel/mesh/measure/morph_maps.h"

namespace lissom {
namespace {

constexpr double kStep = 0.5;

std::vector<Index> vertices_of(std::span<const std::vector<Index>> seams) {
    std::vector<Index> vertices;
    for (const std::vector<Index>& seam : seams) {
        vertices.insert(vertices.end(), seam.begin(), seam.end());
    }
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

// The vertices of seams and next to them that are not on open boundaries or firm, ascending.
std::vector<Index> umbrella_vertices(const Topology& topology, std::span<const Index> on_seam,
                                     std::span<const Index> firm) {
    std::vector<Index> vertices(on_seam.begin(), on_seam.end());
    for (const Index v : on_seam) {
        const std::span<const Index> ring = topology.neighbors(v);
        vertices.insert(vertices.end(), ring.begin(), ring.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::erase_if(vertices, [&](Index v) {
        return topology.is_boundary(v) || std::binary_search(firm.begin(), firm.end(), v);
    });
    return vertices;
}

// Destination of the given vertices in one step.
template <typename Position>
std::vector<Vec3> umbrella_places(const Topology& topology, std::span<const Index> on_seam,
                                  std::span<const Index> moving, const Position& position) {
    std::vector<Vec3> to;
    for (const Index v : moving) {
        Vec3 mean = Vec3::Zero();
        for (const Index w : topology.neighbors(v)) mean += position(w);
        mean /= topology.valence(v);
        const bool is_on = std::binary_search(on_seam.begin(), on_seam.end(), v);
        to.push_back(position(v) + (is_on ? kStep : 0.5 * kStep) * (mean - position(v)));
    }
    return to;
}

// History of the seams' vertices: the steps that were made, and the part of each that every moving
// vertex was moved by.
struct Umbrella {
    std::span<const Index> on_seam, moving;
    std::vector<std::vector<double>> parts;
};

// Up to `times` steps, none of which does harm.
std::vector<Vec3> guarded_steps(const Mesh& mesh, std::span<const std::vector<Index>> seams,
                                Index times, Umbrella& made, const Context& context) {
    SeamGuard guard(mesh, seams, {made.moving.begin(), made.moving.end()}, context);
    const auto position = [&](Index v) -> const Vec3& { return guard.position(v); };
    for (Index step = 0; step < times; ++step) {
        const auto to = umbrella_places(mesh.topology(), made.on_seam, guard.moving(), position);
        if (!(guard.move(to) > 0.0)) break;
        made.parts.push_back(guard.parts());
    }
    return {guard.positions().begin(), guard.positions().end()};
}

// The steps that were made, of positions or displacements.
std::vector<Vec3> stepped(const Topology& topology, const Umbrella& made, std::vector<Vec3> x,
                          const Context& context) {
    const auto position = [&](Index v) -> const Vec3& { return x[at(v)]; };
    for (const std::vector<double>& parts : made.parts) {
        context.checkpoint();
        const auto to = umbrella_places(topology, made.on_seam, made.moving, position);
        for (std::size_t k = 0; k < to.size(); ++k) {
            Vec3& here = x[at(made.moving[k])];
            here = parts[k] == 1.0 ? to[k] : Vec3(here + parts[k] * (to[k] - here));
        }
    }
    return x;
}

}  // namespace

Index smooth_seams(Mesh& mesh, std::span<const std::vector<Index>> seams,
                   std::span<const Index> firm, const SeamSmoothing& how, const Context& context) {
    const auto& [times, guarded] = how;
    const std::vector<Index> on_seam = vertices_of(seams);
    const std::vector<Index> moving = umbrella_vertices(mesh.topology(), on_seam, firm);
    Umbrella made{on_seam, moving, {}};
    std::vector<std::pair<Index, Vec3>> moved;
    const auto follow = [&](std::vector<Vec3> x) {
        return stepped(mesh.topology(), made, std::move(x), context);
    };
    if (!guarded) made.parts.assign(at(times), std::vector<double>(moving.size(), 1.0));
    if (times > 0 && !moving.empty()) {
        const std::vector<Vec3> positions =
            guarded ? guarded_steps(mesh, seams, times, made, context)
                    : follow({mesh.positions().begin(), mesh.positions().end()});
        for (const Index v : moving) {
            if (positions[v] != mesh.position(v)) moved.emplace_back(v, positions[v]);
        }
    }
    std::vector<Index> vertices;
    for (const auto& [v, position] : moved) vertices.push_back(v);
    const MorphColumns morphs = mapped_morphs(mesh, follow);
    SeamNormals normals(mesh, std::move(vertices));
    for (const auto& [v, position] : moved) mesh.set_position(v, position);
    set_morphs(mesh, morphs);
    normals.follow(seams);
    return count_of(made.parts);
}

}  // namespace lissom
