#include "kernel/merge/sew/seam_guard.h"

#include <algorithm>
#include <utility>

#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Angles (radians) that differ by less are equal: the greatest is often one that a step does not
// touch.
constexpr double kEqualAngles = 1e-6;
// Angles of triangles above this may become smaller.
constexpr double kGoodAngle = 15.0 * kPi / 180.0;
// The whole of a step carries details along: on 21 merges of real models that nobody called rough
// the roughest was 1.063 times as rough as before. Vertices that move each by themselves have no
// such excuse, and crumple smooth surfaces under a limit that one steep edge has set.
constexpr double kRougher = 1.1, kNoRougher = 1.0;

std::vector<Index> faces_at(const Topology& topology, std::span<const Index> vertices) {
    std::vector<Index> faces;
    for (const Index v : vertices) {
        const std::span<const Index> around = topology.faces_around(v);
        faces.insert(faces.end(), around.begin(), around.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

double max_sum(const SeamQuality& quality) {
    return quality.max_dihedral + quality.max_near;
}

}  // namespace

SeamGuard::SeamGuard(const Mesh& mesh, std::span<const std::vector<Index>> seams,
                     std::vector<Index> moving, const Context& context, const SeamQuality& allowed)
    : shape_(std::vector<Vec3>(mesh.positions().begin(), mesh.positions().end()),
             mesh.shared_topology()),
      seams_(seams),
      moving_(std::move(moving)),
      faces_(faces_at(mesh.topology(), moving_)),
      allowed_(allowed),
      context_(context) {
    for (const std::vector<Index>& seam : seams) {
        for (std::size_t k = 0; k < seam.size(); ++k) {
            seam_edges_.insert(edge_key(seam[k], seam[(k + 1) % seam.size()]));
        }
    }
    now_ = {places(),
            seam_quality(shape_, seams_),
            self_intersections(shape_, {faces_, std::nullopt}, context_),
            roughness(),
            {}};
}

std::vector<Vec3> SeamGuard::places() const {
    std::vector<Vec3> result;
    for (const Index v : moving_) result.push_back(shape_.position(v));
    return result;
}

void SeamGuard::place(std::span<const Vec3> places) {
    const std::span<Vec3> positions = shape_.edit_positions();
    for (std::size_t i = 0; i < moving_.size(); ++i) positions[moving_[i]] = places[i];
}

double SeamGuard::seam_limit() const {
    return std::max(now_.quality.max_dihedral, allowed_.max_dihedral);
}

double SeamGuard::near_limit() const {
    return std::max(now_.quality.max_near, allowed_.max_near);
}

double SeamGuard::roughness() const {
    return rms_dihedral(shape_, faces_);
}

// Measures the shape, and compares it with that of before.
bool SeamGuard::is_harmless(State& state, double rougher) {
    const SeamQuality& before = now_.quality;
    state.quality = seam_quality(shape_, seams_);
    const double least = std::min(before.smallest_angle, kGoodAngle);
    if (state.quality.max_dihedral > seam_limit() + kEqualAngles ||
        state.quality.max_near > near_limit() + kEqualAngles ||
        state.quality.smallest_angle < least - kEqualAngles) {
        return false;
    }
    state.roughness = roughness();
    if (state.roughness > rougher * now_.roughness + kEqualAngles) return false;
    state.crossings = self_intersections(shape_, {faces_, std::nullopt}, context_);
    return std::includes(now_.crossings.begin(), now_.crossings.end(), state.crossings.begin(),
                         state.crossings.end());
}

// Returns how much of the way does no harm.
double SeamGuard::move_all(std::span<const Vec3> to, State& state) {
    for (const double way : {1.0, 0.5, 0.25, 0.125}) {
        context_.checkpoint();
        state.places.clear();
        state.parts.assign(moving_.size(), way);
        for (std::size_t i = 0; i < moving_.size(); ++i) {
            state.places.push_back(now_.places[i] + way * (to[i] - now_.places[i]));
        }
        place(state.places);
        if (is_harmless(state, kRougher)) return way;
    }
    return 0.0;
}

SeamGuard::Star SeamGuard::star(Index v) const {
    Star result;
    GreatestAngle seam, other;
    const Topology& topology = shape_.topology();
    for (const Index f : topology.faces_around(v)) {
        const std::span<const Index> face = topology.face(f);
        result.normals.push_back(area_vector(shape_, f));
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            // An inner edge that ends here begins here in the next face.
            if (b == v) continue;
            const bool on_seam = seam_edges_.contains(edge_key(a, b));
            add_edge_dihedral(shape_, a, b, on_seam ? seam : other);
        }
        if (face.size() == 3) {
            result.angle = std::min(result.angle, smallest_face_angle(shape_, f));
        }
    }
    result.seam = seam.value();
    result.other = other.value();
    return result;
}

bool SeamGuard::spares(const Star& before, const Star& after) const {
    const double seam = std::max(before.seam, seam_limit());
    const double other = std::max(before.other, near_limit());
    if (after.seam > seam + kEqualAngles || after.other > other + kEqualAngles) return false;
    if (after.angle < std::min(before.angle, kGoodAngle) - kEqualAngles) return false;
    for (std::size_t k = 0; k < before.normals.size(); ++k) {
        if (!(after.normals[k].dot(before.normals[k]) >= 0.0)) return false;
    }
    return true;
}

bool SeamGuard::move_each(std::span<const Vec3> to, State& state) {
    place(now_.places);
    state.parts.assign(moving_.size(), 0.0);
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        if (i % 256 == 0) context_.checkpoint();
        const Index v = moving_[i];
        const Star before = star(v);
        const Vec3 way = to[i] - now_.places[i];
        for (const double part : {1.0, 0.5, 0.25, 0.0}) {
            shape_.edit_positions()[v] = now_.places[i] + part * way;
            state.parts[i] = part;
            if (part == 0.0 || spares(before, star(v))) break;
        }
    }
    state.places = places();
    return is_harmless(state, kNoRougher);
}

double SeamGuard::move(std::span<const Vec3> to) {
    const State before = now_;
    parts_.assign(moving_.size(), 0.0);
    try {
        State all = before, each = before;
        const double way = move_all(to, all);
        State* best = way > 0.0 ? &all : nullptr;
        if (way < 1.0) {
            const double limit =
                best ? max_sum(all.quality) : seam_limit() + near_limit() + kEqualAngles;
            const bool better = move_each(to, each) && each.places != before.places &&
                                max_sum(each.quality) < limit;
            if (better) best = &each;
        }
        if (best) {
            parts_ = best->parts;
            now_ = std::move(*best);
        }
    } catch (const Error&) {
        place(before.places);
        throw;
    }
    place(now_.places);
    double asked = 0.0, kept = 0.0;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        asked += (to[i] - before.places[i]).norm();
        kept += (now_.places[i] - before.places[i]).norm();
    }
    return asked > 0.0 ? kept / asked : 0.0;
}

std::vector<Index> origin_faces(const Topology& old, const Topology& made, const MeshMap& map,
                                Index f, const MapShift& shift) {
    std::vector<Index> faces{map.faces.main_source(f) - shift.faces};
    const std::vector<Index>& offsets = old.faces().offsets;
    const auto corners = count_of(made.face(f));
    for (Index k = 0; k < corners; ++k) {
        for (const ElementMap::Source& s : map.corners[made.first_corner(f) + k]) {
            const auto next =
                std::upper_bound(offsets.begin(), offsets.end(), s.element - shift.corners);
            faces.push_back(index_of(next - offsets.begin()) - 1);
        }
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

bool adds_crossings(const Mesh& before, const Mesh& after,
                    const std::function<const MeshMap&()>& map, std::span<const Index> made,
                    const Context& context) {
    const std::vector<FacePair> pairs = self_intersections(
        after, {std::vector<Index>(made.begin(), made.end()), std::nullopt}, context);
    if (pairs.empty()) return false;
    const auto origins = [&](Index f) {
        return origin_faces(before.topology(), after.topology(), map(), f);
    };
    std::vector<Index> faces;
    for (const FacePair& pair : pairs) {
        for (const Index f : origins(pair.first)) faces.push_back(f);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    const std::vector<FacePair> known =
        self_intersections(before, {std::move(faces), std::nullopt}, context);
    return std::any_of(pairs.begin(), pairs.end(), [&](const FacePair& pair) {
        for (const Index a : origins(pair.first)) {
            for (const Index b : origins(pair.second)) {
                const FacePair old{std::min(a, b), std::max(a, b)};
                if (std::binary_search(known.begin(), known.end(), old)) return false;
            }
        }
        return true;
    });
}

}  // namespace lissom
