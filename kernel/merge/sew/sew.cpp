#include "kernel/merge/sew/sew.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/merge/piece/put_back.h"
#include "kernel/merge/provenance.h"
#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/seam_skin.h"
#include "kernel/merge/sew/seam_work.h"
#include "kernel/mesh/edit/joined_content.h"
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

void require_options(const SewOptions& options, std::size_t joins) {
    if (options.smooth < 0) {
        throw Error(ErrorCode::invalid_argument, "smooth must not be negative");
    }
    if (!(options.snap >= 0.0 && options.snap <= 1.0)) {
        throw Error(ErrorCode::invalid_argument, "snap must lie between 0 and 1");
    }
    if (!options.kept.empty() && options.kept.size() != joins) {
        throw Error(ErrorCode::invalid_argument, "say of each join whether it is kept, or of none");
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

// Number of components of two meshes that are sewn to one.
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

// Rings around a seam that are worked on: the collar of one takes up to three on a side, the faces
// beside it must stay, and changes there are measured three more away.
constexpr Index kSeamRings = 8;

// The faces around the loops, from both sides.
std::vector<Index> faces_at_loops(const BothSides& both, std::span<const LoopPair> joins) {
    std::vector<Index> faces;
    for (const Index v : loop_vertices(joins, both.first_source_vertex)) {
        const std::span<const Index> around = both.mesh.topology().faces_around(v);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    return faces;
}

// How many of `ids`, ascending, come before `end`.
Index count_before(const std::vector<Index>& ids, Index end) {
    return index_of(std::lower_bound(ids.begin(), ids.end(), end) - ids.begin());
}

std::vector<LoopPair> joins_of_piece(const MeshPart& piece, const BothSides& both,
                                     Index first_source, std::span<const LoopPair> joins) {
    const auto number = [&](Index v) { return count_before(piece.vertex_map, v); };
    std::vector<LoopPair> result(joins.begin(), joins.end());
    for (LoopPair& join : result) {
        for (Index& v : join.target) v = number(v);
        for (Index& v : join.source) v = number(v + both.first_source_vertex) - first_source;
    }
    return result;
}

// With the numbers that firm vertices have in the piece.
SewOptions options_of_piece(const MeshPart& piece, const SewOptions& options) {
    SewOptions result = options;
    result.firm.clear();
    for (const Index v : options.firm) {
        const Index k = count_before(piece.vertex_map, v);
        if (k < count_of(piece.vertex_map) && piece.vertex_map[at(k)] == v) {
            result.firm.push_back(k);
        }
    }
    return result;
}

// The elements of the whole that stand in the places of `made`, numbers of the whole and, from
// `count` on, of the work on a piece; `map` has the numbers of the piece in the whole.
std::vector<Index> places_in_whole(const std::vector<Index>& made, Index count,
                                   const std::vector<Index>& in_piece,
                                   const std::vector<Index>& map) {
    std::vector<Index> places;
    for (const Index i : made) {
        const Index place = i < count ? kNoIndex : in_piece[at(i - count)];
        places.push_back(i < count ? i : place == kNoIndex ? kNoIndex : map[at(place)]);
    }
    return places;
}

// The sewn piece put back into the whole; nothing if that might differ.
std::optional<Sewn> put_back_sewn(const BothSides& both, const MeshPart& piece, Sewn sewn,
                                  const Context& context) {
    const Index first_source_face =
        index_of(std::find(sewn.side_of_face.begin(), sewn.side_of_face.end(), SeamSide::source) -
                 sewn.side_of_face.begin());
    const PieceWork work{sewn.mesh, sewn.place, sewn.first_source_vertex, first_source_face};
    if (!keeps_rim(both.mesh, piece, work)) return std::nullopt;
    PutBack made = put_back(both.mesh, {both.first_source_vertex, both.first_source_face}, piece,
                            work, context);
    const Topology& whole = both.mesh.topology();
    Sewn result;
    result.map =
        put_back_map(made, whole, nullptr, sewn.mesh, composed(sewn.map, part_map(piece, whole)));
    result.place.vertices =
        places_in_whole(made.vertices, whole.vertex_count(), sewn.place.vertices, piece.vertex_map);
    result.place.faces =
        places_in_whole(made.faces, whole.face_count(), sewn.place.faces, piece.face_map);
    for (const Index f : made.faces) {
        const Index own = f - whole.face_count();
        const bool of_target =
            own < 0 ? f < both.first_source_face : sewn.side_of_face[at(own)] == SeamSide::target;
        result.side_of_face.push_back(of_target ? SeamSide::target : SeamSide::source);
    }
    const std::vector<Index> number =
        made.numbers_of_work(whole.vertex_count(), sewn.mesh.vertex_count());
    for (std::vector<Index>& seam : sewn.seams) {
        for (Index& v : seam) v = number[at(v)];
    }
    result.mesh = std::move(made.mesh);
    result.seams = std::move(sewn.seams);
    result.report = sewn.report;
    result.first_source_vertex = made.first_source_vertex;
    result.kept = std::move(sewn.kept);
    return result;
}

bool keeps_seam(const SewOptions& options, std::size_t join) {
    return !options.kept.empty() && options.kept[join];
}

std::vector<Index> kept_vertices(const SeamWork& work, const SewOptions& options) {
    std::vector<Index> vertices;
    for (std::size_t k = 0; k < work.seams.size(); ++k) {
        if (!keeps_seam(options, k)) continue;
        vertices.insert(vertices.end(), work.seams[k].begin(), work.seams[k].end());
    }
    return vertices;
}

const ElementMap& map_of(const MeshMap& map, Domain domain) {
    switch (domain) {
        case Domain::vertex:
            return map.vertices;
        case Domain::corner:
            return map.corners;
        default:
            return map.faces;
    }
}

// Gives elements of the side that lacks an attribute its shown value: after the seam, which keeps
// the values of the side that has some.
void show_absent(Attribute& attribute, double value, const ElementMap& from, Index of_target,
                 bool target_has) {
    for (Index i = 0; i < attribute.size(); ++i) {
        const std::span<double> values = attribute.at(i);
        if (!std::isnan(values[0])) continue;
        const Index origin = from.main_source(i);
        if (origin != kNoIndex && (origin < of_target) == target_has) continue;
        std::fill(values.begin(), values.end(), value);
    }
}

void show_absent(const Mesh& target, const Mesh& source, Sewn& sewn) {
    for (Attribute& attribute : sewn.mesh.attributes().all()) {
        const double value = shown_value(attribute);
        const bool target_has = target.attributes().find(attribute.name) != nullptr;
        const bool source_has = source.attributes().find(attribute.name) != nullptr;
        if (std::isnan(value) || target_has == source_has) continue;
        show_absent(attribute, value, map_of(sewn.map, attribute.domain),
                    element_count(target.topology(), attribute.domain), target_has);
    }
}

}  // namespace

Sewn sewn_whole(const BothSides& both, std::span<const LoopPair> joins, const SewOptions& options,
                const Context& context) {
    const std::vector<Index> loops = loop_vertices(joins, both.first_source_vertex);
    SeamWork work{both.mesh,
                  both.first_source_vertex,
                  both.first_source_face,
                  SplitPatch(both.mesh, both.first_source_face, loops),
                  {},
                  {},
                  {},
                  {}};
    for (std::size_t k = 0; k < joins.size(); ++k) {
        context.checkpoint();
        const bool kept = keeps_seam(options, k);
        if (options.kind == SeamKind::band && !kept) {
            sew_band(work, joins[k], context);
        } else {
            sew_conforming(work, joins[k], kept ? 0.0 : options.snap);
        }
    }
    ClosedPatch closed = close(std::move(work.patch), work.seams);
    closed.keep_edges_near(kept_vertices(work, options));
    if (options.flip) work.report.flipped = closed.flip_edges(kAllowedDihedral, context);
    return finish(work, closed.faces(), options, context);
}

std::optional<Sewn> sewn_piece(const BothSides& both, std::span<const LoopPair> joins,
                               const SewOptions& options, const Context& context) {
    const std::optional<MeshPart> piece =
        piece_around(both.mesh, faces_at_loops(both, joins), kSeamRings, context);
    if (!piece) return std::nullopt;
    const BothSides part{piece->mesh, count_before(piece->vertex_map, both.first_source_vertex),
                         count_before(piece->face_map, both.first_source_face)};
    try {
        Sewn sewn = sewn_whole(part, joins_of_piece(*piece, both, part.first_source_vertex, joins),
                               options_of_piece(*piece, options), context);
        return put_back_sewn(both, *piece, std::move(sewn), context);
    } catch (const Error& error) {
        // The whole names its own elements.
        if (error.code() == ErrorCode::cancelled || error.code() == ErrorCode::memory_limit) throw;
        return std::nullopt;
    }
}

Sewn sew(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins,
         const SewOptions& options, const Context& context) {
    require_options(options, joins.size());
    require_joins(target.topology(), source.topology(), joins);
    require_same_joints(target, source, joins);
    Progress progress(context, "sew");
    const Mesh mesh = unconnected(target, source, context);
    const BothSides both{mesh, target.vertex_count(), target.face_count()};
    std::optional<Sewn> of_piece = sewn_piece(both, joins, options, context);
    Sewn sewn = of_piece ? std::move(*of_piece) : sewn_whole(both, joins, options, context);
    if (const auto skinned = skinned_side(target, source)) extend_skin(sewn, *skinned, context);
    show_absent(target, source, sewn);
    require_sound(sewn, target, source, joins);
    return sewn;
}

std::vector<std::vector<Index>> worked_seams(const Sewn& sewn) {
    std::vector<std::vector<Index>> seams;
    for (std::size_t k = 0; k < sewn.seams.size(); ++k) {
        if (sewn.kept.empty() || !sewn.kept[k]) seams.push_back(sewn.seams[k]);
    }
    return seams;
}

std::vector<Index> faces_on(std::span<const SeamSide> side_of_face, SeamSide side) {
    std::vector<Index> faces;
    for (Index f = 0; f < count_of(side_of_face); ++f) {
        if (side_of_face[at(f)] == side) faces.push_back(f);
    }
    return faces;
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
