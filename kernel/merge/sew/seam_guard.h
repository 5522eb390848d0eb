/// The guard of a seam: no change may fold it; private to kernel/merge.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_set>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Moves vertices around seams as far as that does no harm. Harm is a greater greatest dihedral
/// angle across the seams or near them (SeamQuality), a smaller smallest angle if that is below 15
/// degrees, a rougher surface (the RMS dihedral angle, weighted by length, of the edges of all
/// faces that move), or a pair of faces that run through one another and did not. The whole of a
/// move may be rougher by a tenth, since it may bring details along; a part of it may not.
class SeamGuard {
  public:
    /// Takes the present shape of `mesh`; `moving` are the vertices that may move. Dihedral angles
    /// up to those of `allowed` do no harm, even if there are none now. Seams and context must
    /// outlive the guard.
    /// Errors: as seam_quality.
    SeamGuard(const Mesh& mesh, std::span<const std::vector<Index>> seams,
              std::vector<Index> moving, const Context& context, const SeamQuality& allowed = {});

    /// Moves the vertices towards `to`, one place each: all of the way, or the first of a half, a
    /// quarter and an eighth that does no harm. If all of it does harm, each vertex is also tried
    /// by itself, and the result with the smaller angles is kept. Returns the part of the way that
    /// was kept, of all vertices together: 0 if nothing moved.
    /// Errors: cancelled; the shape is then as it was.
    double move(std::span<const Vec3> to);

    /// The part of its way that each moving vertex was moved by in the last `move`, in their order.
    const std::vector<double>& parts() const { return parts_; }

    const std::vector<Index>& moving() const { return moving_; }
    const Vec3& position(Index v) const { return shape_.position(v); }
    std::span<const Vec3> positions() const { return shape_.positions(); }
    const SeamQuality& quality() const { return now_.quality; }

  private:
    struct State {
        std::vector<Vec3> places;
        SeamQuality quality;
        std::vector<FacePair> crossings;
        double roughness = 0.0;
        std::vector<double> parts;
    };
    // Measures of the faces around one vertex.
    struct Star {
        double seam = 0.0, other = 0.0, angle = kPi;
        std::vector<Vec3> normals;
    };

    std::vector<Vec3> places() const;
    void place(std::span<const Vec3> places);
    // `rougher`: times the roughness of before that does no harm.
    bool is_harmless(State& state, double rougher);
    double roughness() const;
    double move_all(std::span<const Vec3> to, State& state);
    bool move_each(std::span<const Vec3> to, State& state);
    Star star(Index v) const;
    bool spares(const Star& before, const Star& after) const;
    // The greatest dihedral angles that do no harm: across the seams, near them.
    double seam_limit() const;
    double near_limit() const;

    Mesh shape_;
    std::span<const std::vector<Index>> seams_;
    std::vector<Index> moving_, faces_;
    SeamQuality allowed_;
    std::unordered_set<std::uint64_t> seam_edges_;
    State now_;
    std::vector<double> parts_;
    const Context& context_;
};

/// Returns true if faces of `after` run through others and come from faces of `before` that did
/// not. `map` leads from the elements of `after` to those of `before`, and is asked for if faces
/// run through others; `made` are the changed faces of `after`.
bool adds_crossings(const Mesh& before, const Mesh& after,
                    const std::function<const MeshMap&()>& map, std::span<const Index> made,
                    const Context& context);

/// Offset of the numbers of elements in a map from those of a mesh that was appended.
struct MapShift {
    Index faces = 0, corners = 0;
};

/// The faces that face `f` of a mesh comes from: its main source, and those that its corners are
/// blended from; ascending. `map` leads from `made` to `old`, with numbers ahead by `shift`.
std::vector<Index> origin_faces(const Topology& old, const Topology& made, const MeshMap& map,
                                Index f, const MapShift& shift = {});

}  // namespace lissom
