// What a merge does every time: correspondence, deformation of the source.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/rest_directions.h"
#include "kernel/merge/loop/automatic_keys.h"
#include "kernel/merge/loop/loop_values.h"
#include "kernel/merge/merge_state.h"

namespace lissom {
namespace {

// A key on the mesh that was given as a key on the loop that is worked with: where the boundary has
// been changed, the place nearest to it.
Key worked_key(const Key& key, const GivenLoop& given, const Loop& loop, std::size_t number,
               const char* side) {
    const Index* vertex = std::get_if<Index>(&key);
    if (!vertex) return key;
    const auto at = std::find(given.vertices.begin(), given.vertices.end(), *vertex);
    if (at != given.vertices.end()) {
        double distance = 0.0;
        const auto k = static_cast<std::size_t>(at - given.vertices.begin());
        return point_of(loop.points(), loop.nearest(given.points[k], distance));
    }
    Elements elements{ElementKind::vertex, 0, {}};
    elements.add(*vertex);
    throw Error(ErrorCode::key_conflict,
                "key " + std::to_string(number + 1) + " is " + describe(elements) +
                    ", which is not on the " + side +
                    "'s boundary; choose one of its vertices, or give a point",
                elements);
}

// Number of the vertex nearest to a parameter of a loop.
Index nearest_vertex(const Loop& loop, double parameter) {
    const LoopPoint at = loop.place_at(parameter);
    return (at.segment + (at.t > 0.5 ? 1 : 0)) % loop.size();
}

// The similarity that moves a feature as the surface around it would have moved it.
BoundaryValue common_value(const Mesh& mesh, const Region& feature, const Region& region,
                           const BoundaryDeformation& free, Vec3& rest_center) {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    std::vector<std::size_t> rows;
    for (const Index v : feature.vertices()) {
        const auto& ids = region.vertices();
        rows.push_back(
            static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()));
        from += mesh.position(v) / feature.size();
        to += free.positions[rows.back()] / feature.size();
    }
    Mat3 products = Mat3::Zero(), turn = Mat3::Zero();
    double logs = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vec3 a = mesh.position(feature.vertices()[i]) - from;
        products += (free.positions[rows[i]] - to) * a.transpose();
        turn += free.transforms[rows[i]];
        logs += std::log(uniform_scale(free.transforms[rows[i]]));
    }
    // Where its points do not say how it turns, the mean of its gradients does.
    const double size = products.norm();
    if (size > 0.0) products /= size;
    products += 1e-3 * turn / turn.norm();
    rest_center = from;
    return {to, nearest_rotation(products), std::exp(logs / static_cast<double>(rows.size()))};
}

}  // namespace

std::vector<ParameterPair> Merge::State::keys_of(std::size_t join,
                                                 std::span<const KeyPair> given) const {
    std::vector<KeyPair> keys;
    for (std::size_t k = 0; k < given.size(); ++k) {
        const KeyPair& key = given[k];
        keys.push_back(
            {worked_key(key.source, given_source_loops[join], source_curves[join], k, "source"),
             worked_key(key.target, given_target_loops[join], target_curves[join], k, "target")});
    }
    return key_parameters(source_curves[join], target_curves[join], keys);
}

// The shapes of the parts count only where the loops and the given directions leave a choice.
std::vector<OffsetGuess> Merge::State::guesses(const Context& context) {
    std::vector<LoopJoin> loops;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        loops.push_back({&source_curves[j], &target_curves[j]});
    }
    std::vector<OffsetGuess> guesses = guess_offsets(loops, options.directions);
    if (guesses.front().certainty >= kCertain) return guesses;
    if (!source_part) source_part = part_shape(source.mesh, source_curves.front(), context);
    if (!target_part) target_part = part_shape(target, target_curves.front(), context);
    loops.front().source_part = &*source_part;
    loops.front().target_part = &*target_part;
    return guess_offsets(loops, options.directions);
}

std::vector<LoopPair> Merge::State::correspond(MergeReport& now, const Context& context) {
    std::vector<OffsetGuess> guessed;
    const bool guess =
        std::any_of(joins.begin(), joins.end(), [](const Join& join) { return join.keys.empty(); });
    if (guess) guessed = guesses(context);
    std::vector<LoopPair> pairs;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        std::vector<ParameterPair> keys = keys_of(j);
        JoinReport& join = now.joins[j];
        if (keys.empty()) {
            keys.push_back(guessed[j].key);
            join.guessed = true;
            join.certainty = guessed[j].certainty;
            if (join.certainty < kCertain) {
                now.warnings.push_back("join " + std::to_string(j + 1) +
                                       ": where the boundaries meet is a guess; give it one key, "
                                       "or say which directions of both models belong together");
            }
        }
        pairs.push_back(corresponding(source_curves[j], target_curves[j], keys));
        join.source_size = source_curves[j].size();
        join.target_size = target_curves[j].size();
        join.scale = loop_scale(source_curves[j], target_curves[j]);
    }
    return pairs;
}

// One value a held vertex; those not on a loop stay as they are.
std::vector<BoundaryValue> Merge::State::values_of(const std::vector<LoopPair>& pairs,
                                                   const Region& held) const {
    std::vector<BoundaryValue> values;
    for (const Index v : held.vertices()) {
        values.push_back({source.mesh.position(v), Mat3::Identity(), 1.0});
    }
    LoopValueOptions how;
    how.turn =
        options.configuration == Configuration::free || (options.turn_frames && !options.thesis);
    if (options.thesis) {
        how.sigma = 0.0;
        how.tangent_scales = true;
    }
    const std::vector<Index>& ids = held.vertices();
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const std::vector<BoundaryValue> loop =
            loop_values(source_curves[j], target_curves[j], pairs[j], how);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index v = pairs[j].source[i];
            values[static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v) -
                                            ids.begin())] = loop[i];
        }
    }
    return values;
}

BoundaryDeformation Merge::State::deform(const std::vector<LoopPair>& pairs,
                                         const Context& context) {
    BoundaryDeformation deformed = deformer->solve(values_of(pairs, deformer->held()), context);
    if (!featured) return deformed;
    std::vector<BoundaryValue> values = values_of(pairs, featured->held());
    const std::vector<Index>& ids = featured->held().vertices();
    for (const Region& feature : features) {
        Vec3 center;
        const BoundaryValue move =
            common_value(source.mesh, feature, featured->region(), deformed, center);
        for (const Index v : feature.vertices()) {
            const Vec3 arm = source.mesh.position(v) - center;
            values[static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), v) -
                                            ids.begin())] = {
                move.position + move.scale * (move.rotation * arm), move.rotation, move.scale};
        }
    }
    return featured->solve(values, context);
}

// Parts of the source without a join go as a whole with what is nearest to them.
void Merge::State::follow(const BoundaryDeformation& deformed, std::vector<Vec3>& positions) const {
    const Topology& topology = source.mesh.topology();
    const Region& moved = deformer->region();
    if (options.configuration == Configuration::fixed || moved.size() == topology.vertex_count()) {
        return;
    }
    std::map<Index, std::vector<Index>> loose;
    for (const Index v : moved.inverted().vertices()) loose[topology.components()[v]].push_back(v);
    for (const auto& entry : loose) {
        Vec3 center = Vec3::Zero();
        for (const Index v : entry.second) {
            center += source.mesh.position(v) / static_cast<double>(entry.second.size());
        }
        std::size_t nearest = 0;
        const auto distance = [&](std::size_t row) {
            return (source.mesh.position(moved.vertices()[row]) - center).squaredNorm();
        };
        for (std::size_t row = 1; row < moved.vertices().size(); ++row) {
            if (distance(row) < distance(nearest)) nearest = row;
        }
        const Vec3& from = source.mesh.position(moved.vertices()[nearest]);
        const Mat3& transform = deformed.transforms[nearest];
        for (const Index v : entry.second) {
            positions[v] =
                deformed.positions[nearest] + transform * (source.mesh.position(v) - from);
        }
    }
}

std::vector<Vec3> Merge::State::all_positions(const BoundaryDeformation& deformed) const {
    std::vector<Vec3> positions(source.mesh.positions().begin(), source.mesh.positions().end());
    const std::vector<Index>& moved = deformer->region().vertices();
    for (std::size_t row = 0; row < moved.size(); ++row) {
        positions[moved[row]] = deformed.positions[row];
    }
    follow(deformed, positions);
    return positions;
}

// The thesis's transition, where it is asked for.
std::optional<ThesisMerge> Merge::State::thesis_merge(const std::vector<LoopPair>& pairs,
                                                      const MergeReport& now,
                                                      const Context& context) const {
    if (!options.thesis) return std::nullopt;
    if (!(options.source_transition > 0.0 || options.target_transition > 0.0)) return std::nullopt;
    std::vector<ThesisJoin> thesis;
    for (std::size_t j = 0; j < joins.size(); ++j) {
        const bool scales = options.configuration == Configuration::free;
        const std::vector<ParameterPair> keys = keys_of(j);
        const Index start =
            keys.empty() ? 0 : nearest_vertex(source_curves[j], keys.front().source);
        thesis.push_back({pairs[j], start, scales ? now.joins[j].scale : 1.0,
                          options.target_transition, options.source_transition});
    }
    return std::make_optional<ThesisMerge>(target, source.mesh, std::move(thesis),
                                           options.transition_weight, context);
}

// Normals and tangents turn with the surface; displacements of morph targets grow with it as well.
void Merge::State::turn_directions(const BoundaryDeformation& deformed, Mesh& moved) const {
    RestDirections(source.mesh, deformer->region()).apply_to(moved, deformed.transforms);
    std::vector<double> scale(static_cast<std::size_t>(moved.vertex_count()), 1.0);
    const std::vector<Index>& ids = deformer->region().vertices();
    for (std::size_t row = 0; row < ids.size(); ++row) {
        scale[ids[row]] = uniform_scale(deformed.transforms[row]);
    }
    for (Attribute& attribute : moved.attributes().all()) {
        if (role_of(attribute) != AttributeRole::morph_position) continue;
        for (Index i = 0; i < attribute.size(); ++i) {
            const Index v =
                attribute.domain == Domain::vertex ? i : moved.topology().faces().vertices[i];
            for (double& x : attribute.at(i)) x *= scale[v];
        }
    }
}

}  // namespace lissom
