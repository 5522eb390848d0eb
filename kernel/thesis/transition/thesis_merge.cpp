#include "kernel/thesis/transition/thesis_merge.h"

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
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/thesis/fidelity.h"

namespace lissom {
namespace {

// Rings of the target around its regions that the energy's terms reach.
constexpr Index kRings = 3;

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

// Moves the weights of a place away from vertices of open boundaries; false if no weight is left.
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

// Some vertices of a mesh with their rings, and local numbers of its vertices.
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
    const DeformOptions options = thesis_deform_options();
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
    // Rotations for deviations from the rest shape.
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

std::vector<Vec3> coordinates_of(const BandSystem& band, Index shape) {
    std::vector<Vec3> result(band.vertex_count(), Vec3::Zero());
    for (Index i = 0; i < band.vertex_count(); ++i) {
        if (band.is_row(i)) result[i] = band.coordinates(i, shape);
    }
    return result;
}

// In the order of the shapes that a BandSystem takes from the mesh.
std::vector<std::string> morph_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (is_morph_position(attribute)) names.push_back(attribute.name);
    }
    return names;
}

// A part of a mesh with the offsets of the mesh's morph targets there, turned with the surface.
Mesh with_turned_morphs(const Mesh& part, std::span<const Index> vertices, const Mesh& mesh,
                        const std::vector<Mat3>& gradients) {
    Mesh result = part;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (!is_morph_position(attribute)) continue;
        const std::vector<Vec3> adds = morph_displacements(mesh, attribute);
        Attribute turned{attribute.name, Domain::vertex, 3, ScalarType::float64, {}};
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Vec3 d = gradients[i] * adds[at(vertices[i])];
            turned.values.insert(turned.values.end(), {d.x(), d.y(), d.z()});
        }
        result.attributes().add(std::move(turned));
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

ThesisMerge::ThesisMerge(const OverlapTarget& whole, const Mesh& opened, const Mesh& source,
                         std::vector<OverlapJoin> joins, double weight, const Context& context)
    : whole_(whole),
      target_(whole.mesh),
      opened_(opened),
      source_(source),
      joins_(std::move(joins)),
      weight_(weight) {
    for (std::size_t j = 0; j < joins_.size(); ++j) {
        const OverlapJoin& join = joins_[j];
        target_bands_.push_back(
            make_thesis_band(target_, target_band_loop(target_, whole.loops[j], join.target_start),
                             whole.width, context));
        turn_to_end(j);
        source_bands_.push_back(make_thesis_band(
            source, source_band_loop(opened, join.pair, join.start), join.source_width, context));
    }
    require_disjoint(target_bands_, target_.vertex_count(), "target");
    require_disjoint(source_bands_, source.vertex_count(), "source");
    for (std::size_t j = 0; j < joins_.size(); ++j) {
        of_target_.push_back(match(target_bands_[j], source_bands_[j], target_, source));
        of_source_.push_back(match(source_bands_[j], target_bands_[j], source, target_));
        of_source_.back().report.width *= joins_[j].scale;
    }
}

// Angles along the far end count from the start of its loop, as the source's do.
void ThesisMerge::turn_to_end(std::size_t join) {
    BandChart& chart = target_bands_[join].chart;
    const std::vector<Index>& loop = joins_[join].pair.target;
    std::vector<Vec3> points;
    for (const Index v : loop) points.push_back(opened_.position(v));
    const std::vector<double> fraction = loop_fractions(points);
    const Index end = target_bands_[join].cut.back();
    double turn = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        if (whole_.vertex_of[loop[k]] == end) turn = fraction[k];
    }
    for (std::size_t i = 0; i < chart.vertex.size(); ++i) {
        if (chart.vertex[i] != end) continue;
        turn -= chart.angle[i];
        break;
    }
    for (double& angle : chart.angle) angle = angle + turn - std::floor(angle + turn);
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
        const double height = own.chart.distance[i] / own.width;
        if (height <= 0.0 || std::exchange(seen[v], 1)) continue;
        result.members.push_back(v);
        if (mesh.topology().is_boundary(v)) continue;
        const double angle = own.chart.angle[i], away = 1.0 - height;
        std::optional<BandPlace> place = map.locate(angle, away);
        result.report.unmapped += place ? 0 : 1;
        if (!place) place = map.nearest(angle, away);
        if (!place || !leave_boundary(*place, across.topology())) continue;
        result.matches.push_back({v, *place, height});
    }
    result.report.vertices = count_of(result.members);
    return result;
}

// Both meshes at one scale and of unit size around the seams: rest positions of the source turned
// to their destination, positions of the target and of the result unchanged.
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
    for (const OverlapJoin& join : joins_) logs += std::log(join.scale);
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

// Those of the regions, their boundaries among them, but for the far ends.
std::vector<Index> ThesisMerge::moving_of_target() const {
    std::vector<char> stays(target_.vertex_count(), 0);
    for (const std::vector<Index>& end : whole_.ends) {
        for (const Index v : end) stays[v] = 1;
    }
    std::vector<Index> moving;
    for (const ThesisBand& band : target_bands_) {
        for (const Index v : band.chart.vertex) {
            if (!std::exchange(stays[v], 1)) moving.push_back(v);
        }
    }
    return moving;
}

// Held vertices of the source go to their places in the merge without transition, vertices outside
// the region stay.
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
    const Region moving(target_.shared_topology(), moving_of_target());
    std::vector<Index> near = moving.vertices();
    for (const std::vector<Index>& end : whole_.ends) {
        near.insert(near.end(), end.begin(), end.end());
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

    for (Vec3& p : solved.target.positions) p = frame.position_back(p);
    keep_coordinates(around.part.mesh, around.part.vertex_map, solved.target, moving);
    BoundaryDeformation result = ordinary;
    for (std::size_t row = 0; row < region.vertices().size(); ++row) {
        const Index v = region.vertices()[row];
        if (source_held_[v]) continue;
        result.positions[row] = frame.position_back(solved.source.positions[v]);
        result.transforms[row] = frame.gradient_back(solved.source.gradients[v]);
    }
    return result;
}

// Keeps the coordinates of moving vertices and of the far ends.
void ThesisMerge::keep_coordinates(const Mesh& part, std::span<const Index> vertices,
                                   const TransitionShape& solved, const Region& moving) {
    std::vector<Index> moves;
    for (Index i = 0; i < part.vertex_count(); ++i) {
        if (moving.contains(vertices[i])) moves.push_back(i);
    }
    const Region region(part.shared_topology(), std::move(moves));
    BandSystem band(region, region, solved.positions);
    band.take_morphs(with_turned_morphs(part, vertices, target_, solved.gradients));
    const std::vector<Vec3> none(at(target_.vertex_count()), Vec3::Zero());
    const std::vector<std::string> names = morph_names(target_);
    std::vector<std::vector<Vec3>*> shapes = {&coordinates_};
    coordinates_ = none;
    morph_coordinates_.clear();
    for (const std::string& name : names) shapes.push_back(&(morph_coordinates_[name] = none));
    has_coordinates_.assign(target_.vertex_count(), 0);
    for (Index i = 0; i < band.vertex_count(); ++i) {
        const Index v = vertices[band.mesh_vertex(i)];
        if (!band.is_row(i) || target_.topology().is_boundary(v)) continue;
        for (Index s = 0; s < band.shape_count(); ++s) {
            (*shapes[at(s)])[at(v)] = band.coordinates(i, s);
        }
        has_coordinates_[v] = 1;
    }
}

// The target's coordinates at one of its places.
Vec3 ThesisMerge::seen_in_target(const BandPlace& place, const std::vector<Vec3>& coordinates,
                                 const Vec3& otherwise) const {
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!has_coordinates_[place.vertices[k]]) continue;
        sum += place.weights[k] * coordinates[at(place.vertices[k])];
        weights += place.weights[k];
    }
    return weights > 0.0 ? Vec3(sum / weights) : otherwise;
}

// The vertices of the source's boundaries lie on far ends.
void ThesisMerge::want_at_seams(const BandSystem& band, std::span<const Index> local,
                                const std::vector<Vec3>& coordinates,
                                std::vector<Vec3>& wanted) const {
    for (const OverlapJoin& join : joins_) {
        const std::vector<Index>& loop = join.pair.target;
        for (std::size_t k = 0; k < join.pair.source.size(); ++k) {
            const Index i = local[join.pair.source[k]];
            if (i == kNoIndex || !band.is_row(i)) continue;
            const LoopPoint& at = join.pair.on_target[k];
            const Index first = whole_.vertex_of[loop[at.segment]];
            const Index next = whole_.vertex_of[loop[(at.segment + 1) % count_of(loop)]];
            wanted[i] = seen_in_target({{first, next, next}, {1.0 - at.t, at.t, 0.0}}, coordinates,
                                       wanted[i]);
        }
    }
}

void ThesisMerge::want_in_regions(std::span<const Index> local,
                                  const std::vector<Vec3>& coordinates,
                                  std::vector<Vec3>& wanted) const {
    for (const Matches& region : of_source_) {
        for (const Match& m : region.matches) {
            const Index i = local[m.vertex];
            if (i == kNoIndex) continue;
            const Vec3 other = seen_in_target(m.place, coordinates, wanted[i]);
            wanted[i] = m.fraction * wanted[i] + (1.0 - m.fraction) * other;
        }
    }
}

Region ThesisMerge::moving_in(const Sewn& sewn, std::span<const Index> source_at) const {
    std::vector<Index> moving;
    for (const Matches& region : of_source_) {
        for (const Index v : region.members) {
            const Index at = source_at[v];
            if (source_held_[v] || at == kNoIndex || sewn.mesh.topology().is_boundary(at)) continue;
            moving.push_back(at);
        }
    }
    return {sewn.mesh.shared_topology(), std::move(moving)};
}

TransitionReport ThesisMerge::reconstruct(Sewn& sewn, const Context& context) const {
    const std::vector<Index> source_at =
        sewn_vertices(sewn, opened_.vertex_count(), source_.vertex_count());
    const Region moving = moving_in(sewn, source_at);
    BandSystem band(moving, moving, sewn.mesh.positions());
    std::vector<Index> local_of(sewn.mesh.vertex_count(), kNoIndex), local(source_at.size());
    for (Index i = 0; i < band.vertex_count(); ++i) local_of[band.mesh_vertex(i)] = i;
    for (std::size_t v = 0; v < local.size(); ++v) {
        local[v] = source_at[v] == kNoIndex ? kNoIndex : local_of[source_at[v]];
    }
    band.take_morphs(sewn.mesh);
    const std::vector<std::string> names = morph_names(sewn.mesh);
    const std::vector<Vec3> none(at(target_.vertex_count()), Vec3::Zero());
    std::vector<std::vector<Vec3>> wanted;
    for (Index s = 0; s < band.shape_count(); ++s) {
        const auto of_morph =
            s == 0 ? morph_coordinates_.end() : morph_coordinates_.find(names[at(s - 1)]);
        const bool known = of_morph != morph_coordinates_.end();
        const std::vector<Vec3>& other = s == 0 ? coordinates_ : known ? of_morph->second : none;
        wanted.push_back(coordinates_of(band, s));
        want_at_seams(band, local, other, wanted.back());
        want_in_regions(local, other, wanted.back());
    }
    band.bend(wanted, context);
    band.write(sewn.mesh);
    TransitionReport report;
    for (const Matches& region : of_target_) report.target.push_back(region.report);
    for (const Matches& region : of_source_) report.source.push_back(region.report);
    report.moved = moving.vertices();
    return report;
}

}  // namespace lissom
