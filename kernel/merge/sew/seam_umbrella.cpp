#include "kernel/merge/sew/seam_umbrella.h"

#include <algorithm>
#include <utility>

#include "kernel/merge/sew/seam_attributes.h"
#include "kernel/merge/sew/seam_guard.h"

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

// The vertices of seams and next to them that are not on open boundaries, ascending.
std::vector<Index> umbrella_vertices(const Topology& topology, std::span<const Index> on_seam) {
    std::vector<Index> vertices(on_seam.begin(), on_seam.end());
    for (const Index v : on_seam) {
        const std::span<const Index> ring = topology.neighbors(v);
        vertices.insert(vertices.end(), ring.begin(), ring.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::erase_if(vertices, [&](Index v) { return topology.is_boundary(v); });
    return vertices;
}

}  // namespace

Index smooth_seams(Mesh& mesh, std::span<const std::vector<Index>> seams, Index times,
                   const Context& context) {
    const Topology& topology = mesh.topology();
    const std::vector<Index> on_seam = vertices_of(seams);
    Index made = 0;
    std::vector<std::pair<Index, Vec3>> moved;
    if (times > 0) {
        SeamGuard guard(mesh, seams, umbrella_vertices(topology, on_seam), context);
        std::vector<Vec3> to(guard.moving().size());
        for (; made < times; ++made) {
            for (std::size_t k = 0; k < to.size(); ++k) {
                const Index v = guard.moving()[k];
                Vec3 mean = Vec3::Zero();
                for (const Index w : topology.neighbors(v)) mean += guard.position(w);
                mean /= topology.valence(v);
                const bool is_on = std::binary_search(on_seam.begin(), on_seam.end(), v);
                const double step = is_on ? kStep : 0.5 * kStep;
                to[k] = guard.position(v) + step * (mean - guard.position(v));
            }
            if (!(guard.move(to) > 0.0)) break;
        }
        for (const Index v : guard.moving()) {
            if (guard.position(v) != mesh.position(v)) moved.emplace_back(v, guard.position(v));
        }
    }
    std::vector<Index> vertices;
    for (const auto& [v, position] : moved) vertices.push_back(v);
    SeamNormals normals(mesh, std::move(vertices));
    for (const auto& [v, position] : moved) mesh.set_position(v, position);
    normals.follow(seams);
    return made;
}

}  // namespace lissom
