/// Deformation by a boundary condition: every held vertex is given a position, a rotation and a
/// scale of its own, and the rest of the surface follows (thesis sections 2.4 and 3.3.1). The core
/// of merging, in which one loop of vertices moves a whole mesh.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/options.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Position of a held vertex, and rotation and scale of the surface at it: its deformation gradient
/// is `scale` times `rotation`.
struct BoundaryValue {
    Vec3 position = Vec3::Zero();
    Mat3 rotation = Mat3::Identity();
    double scale = 1.0;
    /// `refine` turns the surface at it towards its best fit, within this angle, in radians, of
    /// `upright`; 0 keeps `rotation`.
    double slack = 0.0;
    Mat3 upright = Mat3::Identity();
};

/// Growth of details away from the held vertices: exp of the harmonic interpolation of log
/// scale, or |M| / sqrt 3 of the deformation gradients of the first system (Eq 2.11), which
/// averaged rotations make too small.
enum class SizeField { harmonic, gradient };

struct BoundaryDeformOptions {
    SizeField size = SizeField::harmonic;
    SecondSystem second = SecondSystem::blend;
    LaplacianWeights weights = LaplacianWeights::cotangent;
    /// Same as in DeformOptions.
    int coherence = 1;
    double coherence_weight = 1.0;
    double degenerate_threshold = 2e4;
    double displacement = 0.2;
    bool scale_free = true;
    /// Parts of the region that keep their shape: all vertices of one share a deformation gradient.
    /// It is an unknown of the first system; its rotation and size enter the second, which moves
    /// the part as a whole (the extension of thesis section 3.5). None may hold a vertex of
    /// another, or one that is held.
    std::vector<Region> features = {};
};

/// Seconds that the steps of a solve took: the first system (Eq 2.8), the rotations and sizes of
/// all deformation gradients, the second system (Eq 2.10 and 2.11).
struct BoundaryTimes {
    double first = 0.0, polar = 0.0, second = 0.0;
};

/// A deformed region.
struct BoundaryDeformation {
    /// Positions of the region's vertices, in its order; those of held ones as given, to the bit.
    std::vector<Vec3> positions;
    /// Turn and growth of the surface at them: scale times rotation.
    std::vector<Mat3> transforms;
    /// For each held vertex, in the order of `held().vertices()`, how far the edges at it would
    /// draw it to be as long and turned as those around them are.
    std::vector<Vec3> pulls;
    /// Energy of the second system at the rotations that fit the positions best, and after each
    /// step of a refinement. In no unit: of the surface as it was brought to unit size.
    std::vector<double> energy;
    BoundaryTimes seconds = {};
};

/// Deforms one region of one mesh. Vertices outside it stay. Factors are kept: new values cost no
/// factorisation. The surface is centred on the held vertices and brought to unit size, so that the
/// result follows any similarity of the mesh or of the values. Accepts polygon meshes of any genus.
class BoundaryDeformer {
  public:
    /// Takes the present shape of `mesh` as rest shape; it may change or die afterwards.
    /// Errors: region_empty without held vertices; topology_mismatch; handle_outside_region for
    /// vertices held, or of a feature, outside the region; handle_overlap for a feature that
    /// overlaps another, or held vertices; unconstrained naming a connected part that nothing
    /// holds; zero_area; not_positive_definite; memory_limit; cancelled.
    BoundaryDeformer(const Mesh& mesh, const Region& region, const Region& held,
                     const BoundaryDeformOptions& options = {}, const Context& context = {});
    ~BoundaryDeformer();
    BoundaryDeformer(BoundaryDeformer&&) noexcept;
    BoundaryDeformer& operator=(BoundaryDeformer&&) noexcept;

    const Region& region() const;
    const Region& held() const;
    /// Vertices that move freely, and sizes and times of the preparation.
    const DeformStats& stats() const;

    /// Solves both systems for one value a held vertex, in the order of `held().vertices()`.
    /// Errors: invalid_argument if their number differs, or for a scale that is not above 0, or a
    /// slack below it; not_finite; cancelled.
    BoundaryDeformation solve(std::span<const BoundaryValue> values, const Context& context = {});

    /// Goes on from the last solution with at most `steps` ARAP iterations, at fixed sizes: the
    /// rotations are fitted to the positions, and those are solved for again. The length of a step
    /// beyond the best-fitting rotations is the one that lowers the energy most; iterations end if
    /// none lowers it. Held vertices stay, but turn within their slack.
    /// Errors: invalid_argument before the first `solve`, or for less than one step; cancelled, and
    /// then `solve` must be called again.
    BoundaryDeformation refine(int steps, const Context& context = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
