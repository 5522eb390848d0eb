#include "kernel/merge/thesis/thesis_merge.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/merge/blend/band_map.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/merge/blend/seam_core.h"
#include "kernel/mesh/edit/extract.h"

namespace lissom {
namespace {

// Rings of the target around its regions that the energy's terms reach.
constexpr Index kRings = 3;
// Rings at a seam whose faces sewing may have changed, itself among them.
constexpr Index kCore = 3;

void require_widths(const ThesisJoin& join) {
    for (const double width : {join.target_width, join.source_width}) {
        if (width > 0.0 && std::isfinite(width)) continue;
        throw Error(ErrorCode::invalid_argument,
                    "the thesis's transition needs a region on both sides: give finite widths "
                    "above 0 for source and target");
    }
}

// Regions of two joins must not share a vertex.
void require_disjoint(std::span<const ThesisBand> bands, Index vertices, const char* side) {
    std::vector<Index> band_at(vertices, kNoIndex);
    for (std::size_t j = 0; j < bands.size(); ++j) {
        for (const Index v : bands[j].chart.vertex) {
            const Index other = std::exchange(band_at[v], index_of(j));
            if (other == kNoIndex || other == index_of(j)) continue;
            throw Error(ErrorCode::invalid_argument, "the transition regions of joins " +
                                                         std::to_string(other + 1) + " and " +
                                                         std::to_string(j + 1) + " meet on the " +
                                                         side + "; make them narrower");
        }
    }
}

// The mesh without attributes, its positions mapped.
template <typename Map>
Mesh mapped(const Mesh& mesh, const Map& map) {
    std::vector<Vec3> positions;
    positions.reserve(mesh.positions().size());
    for (const Vec3& p : mesh.positions()) positions.push_back(map(p));
    return {std::move(positions), mesh.shared_topology()};
}

std::size_t row_of(const Region& region, Index v) {
    const std::vector<Index>& ids = region.vertices();
    return std::lower_bound(ids.begin(), ids.end(), v) - ids.begin();
}

// Moves the weights of a place away from vertices of open boundaries; false where nothing is left.
bool leave_boundary(BandPlace& place, const Topology& topology) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        double& weight = place.weights[k];
        weight = topology.is_boundary(place.vertices[k]) ? 0.0 : std::max(0.0, weight);
        sum += weight;
    }
    for (double& weight : place.weights) weight = sum > 0.0 ? weight / sum : 0.0;
    return sum > 0.0;
}

// Some vertices of a mesh with what is around them, and local numbers of its vertices.
struct Surroundings {
    Surroundings(const Mesh& mesh, const std::vector<Index>& vertices, const Context& context)
        : part(extract(mapped(mesh, [](const Vec3& x) { return x; }),
                       Region(mesh.shared_topology(), vertices).grown(kRings), context)),
          local(mesh.vertex_count(), kNoIndex) {
        for (std::size_t i = part.vertex_map.size(); i-- > 0;) {
            local[part.vertex_map[i]] = index_of(i);
        }
    }

    MeshPart part;
    std::vector<Index> local;
};

// A mesh of which nothing is known yet.
TransitionMesh unknown(const Mesh& mesh) {
    const std::size_t n = mesh.vertex_count();
    return {&mesh,
            std::vector<char>(n, 0),
            std::vector<char>(n, 0),
            {mesh.positions().begin(), mesh.positions().end()},
            std::vector<Mat3>(n, Mat3::Identity()),
            {},
            {}};
}

void hold(TransitionMesh& side, Index v, const Vec3& position, const Mat3& gradient) {
    side.position_known[v] = side.gradient_known[v] = 1;
    side.position[v] = position;
    side.gradient[v] = gradient;
}

// The second system of one mesh, with the scales of Eq 2.11.
void remove_shear(const TransitionMesh& side, TransitionShape& shape, const Context& context) {
    const DeformOptions options = DeformOptions::thesis();
    const WorkingPatch work(build_patch(*side.mesh, Region::all(side.mesh->shared_topology()), 0),
                            options);
    const Patch& patch = work.patch;
    std::vector<char> known(patch.vertex_count, 0);
    for (Index i = 0; i < patch.real_count; ++i) {
        const Index v = patch.mesh_vertex[i];
        known[i] = side.position_known[v] || work.rings.count(i) == 0;
        if (side.gradient_known[v]) continue;
        Mat3& m = shape.gradients[v];
        m = uniform_scale(m) * nearest_rotation(m);
    }
    RotationSystem system(work, known, options, context);
    if (system.free_vertices().empty()) return;
    system.factor(context);
    system.finish(context);
    // For what deviates from the rest shape.
    std::vector<PaddedMat3> turns;
    std::vector<Vec4> x(patch.vertex_count, Vec4::Zero());
    for (Index i = 0; i < patch.real_count; ++i) {
        const Index v = patch.mesh_vertex[i];
        turns.push_back(padded_columns(shape.gradients[v] - Mat3::Identity()));
        x[i] = padded(shape.positions[v] - side.mesh->position(v));
    }
    system.solve(turns, x, false, context);
    for (Index i = 0; i < patch.real_count; ++i) {
        const Index v = patch.mesh_vertex[i];
        if (!known[i]) shape.positions[v] = side.mesh->position(v) + x[i].head<3>();
    }
}

// Coordinates with those of the core interpolated: their curvatures and the normals, as vectors
// that turn around the seam would come out too short.
std::vector<Vec3> filled(const BandSystem& band, const SeamCore& core, std::vector<Vec3> values,
                         const Context& context) {
    std::vector<double> curvature(values.size(), 0.0);
    for (Index i = 0; i < band.vertex_count(); ++i) {
        if (band.is_row(i)) curvature[i] = values[i].dot(band.normal(i));
    }
    const std::vector<Vec3> relaxed = core.relaxed(band, curvature, context);
    for (Index i = 0; i < band.vertex_count(); ++i) {
        if (core.contains(i)) values[i] = relaxed[i];
    }
    return values;
}

std::vector<Vec3> coordinates_of(const BandSystem& band) {
    std::vector<Vec3> result(band.vertex_count(), Vec3::Zero());
    for (Index i = 0; i < band.vertex_count(); ++i) {
        if (band.is_row(i)) result[i] = band.coordinates(i);
    }
    return result;
}

// The vertices of the sewn mesh that those of a mesh have become, or kNoIndex.
std::vector<Index> sewn_vertices(const Sewn& sewn, Index first, Index count) {
    std::vector<Index> result(count, kNoIndex);
    for (Index v = 0; v < sewn.map.vertices.size(); ++v) {
        for (const ElementMap::Source& from : sewn.map.vertices[v]) {
            const Index old = from.element - first;
            if (old >= 0 && old < count && result[old] == kNoIndex) result[old] = v;
        }
    }
    return result;
}

}  // namespace

ThesisMerge::ThesisMerge(const Mesh& target, const Mesh& source, std::vector<ThesisJoin> joins,
                         double weight, const Context& context)
    : target_(target), source_(source), joins_(std::move(joins)), weight_(weight) {
    for (const ThesisJoin& join : joins_) {
        require_widths(join);
        target_bands_.push_back(make_thesis_band(
            target, target_band_loop(target, join.pair, join.start), join.target_width, context));
        source_bands_.push_back(make_thesis_band(
            source, source_band_loop(target, join.pair, join.start), join.source_width, context));
    }
    require_disjoint(target_bands_, target.vertex_count(), "target");
    require_disjoint(source_bands_, source.vertex_count(), "source");
    for (std::size_t j = 0; j < joins_.size(); ++j) {
        of_target_.push_back(match(target_bands_[j], source_bands_[j], target, source));
        of_source_.push_back(match(source_bands_[j], target_bands_[j], source, target));
        of_source_.back().report.width *= joins_[j].scale;
    }
}

// Vertices of open boundaries have no counterpart and are none.
ThesisMerge::Matches ThesisMerge::match(const ThesisBand& own, const ThesisBand& other,
                                        const Mesh& mesh, const Mesh& across) {
    const BandMap map(other.chart, other.width);
    Matches result;
    result.report = {own.width, 0, BandMap(own.chart, own.width).flipped(), 0};
    std::vector<char> seen(mesh.vertex_count(), 0);
    for (std::size_t i = 0; i < own.chart.vertex.size(); ++i) {
        const Index v = own.chart.vertex[i];
        if (mesh.topology().is_boundary(v) || std::exchange(seen[v], 1)) continue;
        result.members.push_back(v);
        const double angle = own.chart.angle[i], away = own.chart.distance[i] / own.width;
        std::optional<BandPlace> place = map.locate(angle, away);
        result.report.unmapped += place ? 0 : 1;
        if (!place) place = map.nearest(angle, away);
        if (!place || !leave_boundary(*place, across.topology())) continue;
        result.matches.push_back({v, *place, 0.5 + 0.5 * own.path[i] / own.width});
    }
    result.report.vertices = count_of(result.members);
    return result;
}

// Both meshes at one scale and of unit size around the seams: rest positions of the source turned
// to where they go, positions of the target and of the result as they are.
struct ThesisMerge::Frames {
    Mat3 turn = Mat3::Identity();
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double scale = 1.0, unit = 1.0;

    Vec3 rest(const Vec3& x) const { return scale / unit * (turn * (x - from)); }
    Vec3 world(const Vec3& x) const { return (x - to) / unit; }
    Mat3 gradient(const Mat3& m) const { return m * turn.transpose() / scale; }
    Vec3 position_back(const Vec3& x) const { return to + unit * x; }
    Mat3 gradient_back(const Mat3& m) const { return scale * m * turn; }
};

ThesisMerge::Frames ThesisMerge::frames(const Region& region, const Region& held,
                                        const BoundaryDeformation& ordinary) const {
    Frames f;
    double logs = 0.0;
    for (const ThesisJoin& join : joins_) logs += std::log(join.scale);
    f.scale = std::exp(logs / joins_.size());
    Mat3 turns = Mat3::Zero();
    const Vec3 &first_from = source_.position(held.vertices().front()),
               &first_to = ordinary.positions[row_of(region, held.vertices().front())];
    for (const Index v : held.vertices()) {
        const std::size_t row = row_of(region, v);
        turns += nearest_rotation(ordinary.transforms[row]);
        f.from += (source_.position(v) - first_from) / held.size();
        f.to += (ordinary.positions[row] - first_to) / held.size();
    }
    f.turn = nearest_rotation(turns);
    f.from += first_from;
    f.to += first_to;
    double squares = 0.0;
    for (const Index v : region.vertices()) squares += (source_.position(v) - f.from).squaredNorm();
    f.unit = f.scale * std::sqrt(squares / region.size());
    return f;
}

std::vector<Index> ThesisMerge::members_of_target() const {
    std::vector<Index> members;
    for (const Matches& band : of_target_) {
        members.insert(members.end(), band.members.begin(), band.members.end());
    }
    return members;
}

// Of the source what is held goes where the merge without transition took it, and what is outside
// the region stays.
void ThesisMerge::hold_source(const Region& region, const BoundaryDeformation& ordinary,
                              const Frames& frame, TransitionMesh& source) const {
    for (Index v = 0; v < source_.vertex_count(); ++v) {
        if (!source_held_[v]) continue;
        if (region.contains(v)) {
            const std::size_t row = row_of(region, v);
            hold(source, v, frame.world(ordinary.positions[row]),
                 frame.gradient(ordinary.transforms[row]));
        } else {
            hold(source, v, frame.world(source_.position(v)), frame.gradient(Mat3::Identity()));
        }
    }
}

// Both regions of every join; of the target in the numbers of its part.
void ThesisMerge::add_counterparts(std::span<const Index> target_local, TransitionMesh& target,
                                   TransitionMesh& source) const {
    for (std::size_t j = 0; j < joins_.size(); ++j) {
        for (const Match& m : of_target_[j].matches) {
            target.region.push_back(target_local[m.vertex]);
            target.counterpart.push_back(m.place);
        }
        for (const Match& m : of_source_[j].matches) {
            source.region.push_back(m.vertex);
            source.counterpart.push_back(m.place);
            for (Index& v : source.counterpart.back().vertices) v = target_local[v];
        }
    }
}

BoundaryDeformation ThesisMerge::deform(const Region& region, const Region& held,
                                        const BoundaryDeformation& ordinary,
                                        const Context& context) {
    const Frames frame = frames(region, held, ordinary);
    const Region moving(target_.shared_topology(), members_of_target());
    std::vector<Index> near = moving.vertices();
    for (const ThesisJoin& join : joins_) {
        near.insert(near.end(), join.pair.target.begin(), join.pair.target.end());
    }
    const Surroundings around(target_, near, context);
    const Mesh target_rest =
        mapped(around.part.mesh, [&](const Vec3& x) { return frame.world(x); });
    const Mesh source_rest = mapped(source_, [&](const Vec3& x) { return frame.rest(x); });

    TransitionMesh target = unknown(target_rest), source = unknown(source_rest);
    for (Index i = 0; i < target_rest.vertex_count(); ++i) {
        if (moving.contains(around.part.vertex_map[i])) continue;
        hold(target, i, target_rest.position(i), Mat3::Identity());
    }
    source_held_.assign(source_.vertex_count(), 1);
    for (const Index v : region.minus(held).vertices()) source_held_[v] = 0;
    hold_source(region, ordinary, frame, source);
    add_counterparts(around.local, target, source);
    ThesisTransition solved = thesis_transition(target, source, weight_, context);
    remove_shear(target, solved.target, context);
    remove_shear(source, solved.source, context);

    target_shift_.assign(target_.vertex_count(), Vec3::Zero());
    for (const Index v : moving.vertices()) {
        const Index i = around.local[v];
        target_shift_[v] = frame.unit * (solved.target.positions[i] - target_rest.position(i));
    }
    BoundaryDeformation result = ordinary;
    for (std::size_t row = 0; row < region.vertices().size(); ++row) {
        const Index v = region.vertices()[row];
        if (source_held_[v]) continue;
        result.positions[row] = frame.position_back(solved.source.positions[v]);
        result.transforms[row] = frame.gradient_back(solved.source.gradients[v]);
    }
    return result;
}

// The bands of the sewn mesh: all vertices of the regions and seams, those of them that may move,
// and its positions with the target's regions deformed.
struct ThesisMerge::SewnBands {
    std::vector<Index> target_at, source_at;
    std::vector<Index> all, moving;
    std::vector<Vec3> shape;
};

ThesisMerge::SewnBands ThesisMerge::sewn_bands(const Sewn& sewn) const {
    SewnBands bands{sewn_vertices(sewn, 0, target_.vertex_count()),
                    sewn_vertices(sewn, target_.vertex_count(), source_.vertex_count()),
                    {},
                    {},
                    {sewn.mesh.positions().begin(), sewn.mesh.positions().end()}};
    const auto add = [&](Index v, bool moves) {
        if (v == kNoIndex) return;
        bands.all.push_back(v);
        if (moves) bands.moving.push_back(v);
    };
    for (const Index v : members_of_target()) {
        const Index at = bands.target_at[v];
        if (at != kNoIndex) bands.shape[at] += target_shift_[v];
        add(at, true);
    }
    for (const Matches& band : of_source_) {
        for (const Index v : band.members) add(bands.source_at[v], !source_held_[v]);
    }
    for (const std::vector<Index>& seam : sewn.seams) {
        for (const Index v : seam) add(v, true);
    }
    return bands;
}

// Moves the coordinates of vertices of one side, given by local number, towards those of their
// counterparts.
void ThesisMerge::interpolate(std::span<const Match> matches, std::span<const Index> local,
                              std::span<const Index> across, std::span<const Vec3> own,
                              std::vector<Vec3>& wanted) {
    for (const Match& m : matches) {
        if (local[m.vertex] == kNoIndex) continue;
        Vec3 other = Vec3::Zero();
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index i = across[m.place.vertices[k]];
            if (i == kNoIndex || !(m.place.weights[k] > 0.0)) continue;
            other += m.place.weights[k] * own[i];
            sum += m.place.weights[k];
        }
        if (!(sum > 0.0)) continue;
        const Index i = local[m.vertex];
        wanted[i] = m.fraction * own[i] + (1.0 - m.fraction) / sum * other;
    }
}

TransitionReport ThesisMerge::reconstruct(Sewn& sewn, const Context& context) const {
    SewnBands bands = sewn_bands(sewn);
    const Region read(sewn.mesh.shared_topology(), bands.all);
    const Region moving(sewn.mesh.shared_topology(), bands.moving);
    BandSystem band(read, moving, bands.shape);
    std::vector<Index> local(bands.shape.size(), kNoIndex);
    for (Index i = 0; i < band.vertex_count(); ++i) local[band.mesh_vertex(i)] = i;
    for (std::vector<Index>* side : {&bands.target_at, &bands.source_at}) {
        for (Index& v : *side) v = v == kNoIndex ? kNoIndex : local[v];
    }
    const SeamCore core(band, seam_rings(sewn.mesh.topology(), sewn.seams, kCore), kCore);
    const std::vector<Vec3> own = filled(band, core, coordinates_of(band), context);
    std::vector<Vec3> wanted = own;
    TransitionReport report;
    for (std::size_t j = 0; j < joins_.size(); ++j) {
        interpolate(of_target_[j].matches, bands.target_at, bands.source_at, own, wanted);
        interpolate(of_source_[j].matches, bands.source_at, bands.target_at, own, wanted);
        report.target.push_back(of_target_[j].report);
        report.source.push_back(of_source_[j].report);
    }
    band.bend(filled(band, core, std::move(wanted), context), context);
    band.write(sewn.mesh);
    report.moved = moving.vertices();
    return report;
}

}  // namespace lissom
