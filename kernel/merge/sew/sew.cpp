#include "kernel/merge/sew/sew.h"

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/seam_skin.h"
#include "kernel/merge/sew/seam_work.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

Elements isolated_vertices(const Topology& topology) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (topology.is_isolated(v)) elements.add(v);
    }
    return elements;
}

// Dihedral angles up to this may arise from flips.
constexpr double kAllowedDihedral = 20.0 * kPi / 180.0;

void require_options(const SewOptions& options) {
    if (options.smooth < 0) {
        throw Error(ErrorCode::invalid_argument, "smooth must not be negative");
    }
    if (!(options.snap >= 0.0 && options.snap <= 1.0)) {
        throw Error(ErrorCode::invalid_argument, "snap must lie between 0 and 1");
    }
}

std::vector<Index> loop_vertices(std::span<const LoopPair> joins, Index first_source) {
    std::vector<Index> vertices;
    for (const LoopPair& join : joins) {
        vertices.insert(vertices.end(), join.target.begin(), join.target.end());
        for (const Index v : join.source) vertices.push_back(v + first_source);
    }
    return vertices;
}

// Of two meshes that are sewn to one.
Index joined_components(const Topology& target, const Topology& source,
                        std::span<const LoopPair> joins) {
    const Index targets = target.component_count();
    Index count = targets + source.component_count();
    std::vector<Index> root(count);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](Index part) {
        while (root[part] != part) part = root[part];
        return part;
    };
    for (const LoopPair& join : joins) {
        const Index a = find(target.components()[join.target.front()]);
        const Index b = find(targets + source.components()[join.source.front()]);
        count -= a == b ? 0 : 1;
        root[b] = a;
    }
    return count;
}

}  // namespace

Sewn sew(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins,
         const SewOptions& options, const Context& context) {
    require_options(options);
    require_joins(target.topology(), source.topology(), joins);
    require_same_joints(target, source, joins);
    Progress progress(context, "sew");
    const Mesh both = unconnected(target, source, context);
    const std::vector<Index> loops = loop_vertices(joins, target.vertex_count());
    SeamWork work{both,
                  target.vertex_count(),
                  target.face_count(),
                  SplitPatch(both, target.face_count(), loops),
                  {},
                  {},
                  {},
                  {}};
    for (const LoopPair& join : joins) {
        context.checkpoint();
        if (options.kind == SeamKind::band) {
            sew_band(work, join, context);
        } else {
            sew_conforming(work, join, options);
        }
    }
    ClosedPatch closed = close(std::move(work.patch), work.seams);
    if (options.flip) work.report.flipped = closed.flip_edges(kAllowedDihedral, context);
    Sewn sewn = finish(work, closed.faces(), options, context);
    if (const auto skinned = skinned_side(target, source)) extend_skin(sewn, *skinned, context);
    require_sound(sewn, target, source, joins);
    return sewn;
}

void require_sound(const Sewn& sewn, const Mesh& target, const Mesh& source,
                   std::span<const LoopPair> joins) {
    const auto fail = [](const std::string& what, Elements elements) {
        throw Error(ErrorCode::internal,
                    "sewing went wrong: " + what +
                        "; please report it with both meshes, and try another kind of seam",
                    std::move(elements));
    };
    const Elements isolated = isolated_vertices(sewn.mesh.topology());
    const std::size_t before =
        isolated_vertices(target.topology()).count + isolated_vertices(source.topology()).count;
    if (isolated.count > before) fail("vertices lost their faces", isolated);
    const Index whole = euler_characteristic(sewn.mesh.topology());
    if (whole !=
        euler_characteristic(target.topology()) + euler_characteristic(source.topology())) {
        fail("its Euler characteristic is " + std::to_string(whole), {ElementKind::vertex, 0, {}});
    }
    const Index parts = sewn.mesh.topology().component_count();
    if (parts != joined_components(target.topology(), source.topology(), joins)) {
        fail("it fell into " + std::to_string(parts) + " components", {ElementKind::vertex, 0, {}});
    }
    const auto loops = [](const Mesh& mesh) { return mesh.topology().boundary_loops().size(); };
    if (loops(sewn.mesh) + 2 * joins.size() != loops(target) + loops(source)) {
        fail("it left " + std::to_string(loops(sewn.mesh)) + " open boundaries",
             {ElementKind::vertex, 0, {}});
    }
    for (const std::vector<Index>& seam : sewn.seams) {
        for (const Index v : seam) {
            if (sewn.mesh.topology().is_boundary(v)) {
                fail("the seam is open", {ElementKind::vertex, 1, {v}});
            }
        }
    }
}

}  // namespace lissom
