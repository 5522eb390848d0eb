/// Options of deformation, and values prescribed at handles, vertices and points.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/core/geometry.h"
#include "kernel/deform/mesh_point.h"

namespace lissom {

class ComparisonMethod;
struct ComparisonProblem;
class Context;

/// Builds and factors a method that deforms in place of the implicit one: comparison_method.h.
using ComparisonMaker = std::unique_ptr<ComparisonMethod> (*)(const ComparisonProblem& problem,
                                                              const Context& context);

/// Weights of the Laplacian coordinates: cotangents, or 1 / valence.
enum class LaplacianWeights { cotangent, uniform };

/// The system that reconstructs positions from rotations: a blend of the two others that is smooth
/// at the border of handles and has little distortion; Laplacian coordinates (Eq 2.10); edge
/// vectors.
enum class SecondSystem { blend, laplacian, poisson };

/// Whether details keep their size (Eq 2.10) or scale with the surface around them (Eq 2.11).
enum class LocalSize { keep, scale };

/// Source of the deformation gradient of a vertex with a flat ring: a point beside it on its
/// normal, with an unknown of its own, so that a plane stays flat in motions within it; or its own
/// displacement (section 2.4.3, Eq 2.9).
enum class FlatVertices { extended, displaced };

/// Treatment of connected parts without any handle or constraint: an error; they stay; or each
/// follows the nearest held part as a rigid piece.
enum class UnheldParts { error, stay, follow };

/// A good DeformOptions::level_vertices for large meshes.
inline constexpr Index kLevelVertices = 40'000;

/// Method by which the region follows its handles. All but `implicit` are those that the thesis
/// compares (sections 2.3 to 2.5), and need DeformOptions::comparison. They use the same operators
/// and keep the same promises: hard positions, the rest shape to the bit, nothing moves
/// outside the region, no factorisation for a new transform. They have one quality only, so
/// `preview` and `solve_draft` give the result of `solve`, and no handle basis; weights of handles,
/// and points that are not vertices, are refused as `unsupported`.
enum class DeformMethod {
    /// Fu 2007: gradients implicit in the positions, then shear taken out.
    implicit,
    /// Eq 2.1: Laplacian coordinates keep their direction in space.
    naive,
    /// Lipman et al. 2004: rotations estimated from the naive solution, then a second solve.
    rotation_estimate,
    /// Sorkine et al. 2004: linearised similarities implicit in the positions.
    similarity,
    /// Yu et al. 2004: handle gradients propagated by geodesic distance, then a Poisson system.
    geodesic,
    /// Zayer et al. 2005: the same by harmonic fields.
    harmonic,
    /// Lipman et al. 2005: rotation-invariant coordinates; frames first, then positions.
    frames,
};

/// "implicit", "naive", ...: the name in scripts.
std::string_view method_name(DeformMethod method);

/// A comparison method refuses values other than the defaults of the options that it has no use
/// for: `weights` serves all but geodesic, `scale_free` the first three, and the others none.
struct DeformOptions {
    DeformMethod method = DeformMethod::implicit;
    SecondSystem second = SecondSystem::blend;
    LocalSize local_size = LocalSize::keep;
    /// Share of the thickness at rest that is kept, 0 to 1, by springs across the inside: twisted
    /// and bent solids get no waist. It acts between the two sides of the region, and fades beside
    /// handles that change the size; sheets have no inside. keep_volume changes it at the cost of a
    /// frame.
    double volume = 0.0;
    LaplacianWeights weights = LaplacianWeights::cotangent;
    /// Rounds, 0 to 2, of fitting the rotations to the result and solving for it again: less
    /// distortion, for half a frame each. ARAP iterations, over-relaxed: two do the work of four or
    /// five; more thin twisted parts. Left alone are places that no rotation fits, as the surface
    /// has caved in, and places that handles scale. Refined parts get thinner. A full frame
    /// is taken back gradually as parts come near to one another; it runs through itself only if it
    /// would without refinement. Drafts are not checked.
    int refine = 0;
    /// Rings of neighbours whose gradients are kept similar (the pairs SF of Eq 2.7): 1 or 2.
    int coherence = 1;
    /// Weight of the coherence term beside the Laplacian term; the result hardly depends on it.
    double coherence_weight = 1.0;
    /// A vertex is degenerate, and displaced once, if the condition number of V_i V_i^T exceeds
    /// this (section 2.4.3); above 1. Whatever it is below 2e4, gradients are used up to 2e4: no
    /// displacement brings a ring much below 100.
    double degenerate_threshold = 2e4;
    FlatVertices flat = FlatVertices::extended;
    UnheldParts loose = UnheldParts::error;
    /// Rings of vertices that hard handles release at borders less than three edges from another
    /// handle: the surface between would tear without that room. From 0 to 10.
    int free_rings = 0;
    /// Works on a surface that is refined along the borders of handles, if they are coarse
    /// beside the region (section 2.5): without it a few held vertices would steer a detailed
    /// region. The result is that of the mesh's own vertices; see Deformer::subdivided_mesh.
    bool subdivide_borders = true;
    /// s_disp of Eq 2.9: how far degenerate vertices are displaced, or points beside flat ones
    /// lie, in mean lengths of their edges; above 0.
    double displacement = 0.2;
    /// Weights each vertex by its area and each coherence pair by its cotangent, so that the result
    /// does not depend on scale or resolution. Off: both terms literally as Eq 2.6 and 2.7.
    bool scale_free = true;
    /// Width of the zone along the region's outline over which the deformation fades into the fixed
    /// part, in geodesic distance; in units of length.
    double transition = 0.0;
    /// Above 0, a region of at least four times as many vertices is deformed on two levels: the
    /// method works on a thinned surface of about so many vertices, and all others follow it with
    /// their details. That takes less time and memory, for a small difference. Handles hold their
    /// vertices exactly. Constraints of points, soft handles, falloffs, stiffness, a transition,
    /// loose parts that follow, and handles without position or gradient need the whole surface,
    /// which then serves with a warning. 0, or at least 100.
    Index level_vertices = 0;
    /// Makes `method` unless it is `implicit`; null refuses the others as `unsupported`.
    /// make_comparison of kernel/thesis makes all of them.
    ComparisonMaker comparison = nullptr;
};

/// Values that a handle prescribes at its vertices: positions, deformation gradients, or both.
struct HandleOptions {
    bool position = true;
    bool gradient = true;
    /// Absent: the handle is hard, and its vertices lie exactly at its transform. Otherwise they
    /// are drawn there: at 1 a compromise with the shape of the surface, at 1e6 nearly hard. Its
    /// effect depends on neither scale nor resolution.
    std::optional<double> weight = std::nullopt;
    /// Within this geodesic distance of the handle the surface follows it softly, less and less; in
    /// units of length.
    double falloff = 0.0;
};

/// A plane in which a handle is mirrored.
struct MirrorPlane {
    Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
    /// Distance of the mirror image from the surface beyond which a warning is given; 0 is a
    /// fiftieth of the surface's radius.
    double tolerance = 0.0;
};

/// Distance of a handle's mirror image from the surface, in parts of the surface's radius.
struct MirrorResidual {
    double max = 0.0, mean = 0.0;
    /// A sentence with a remedy if it is more than the tolerance of the plane; else empty.
    std::string warning = {};
};

/// Names a handle of one Deformer. Ids are not used again after a removal.
struct HandleId {
    Index value = kNoIndex;
    bool operator==(const HandleId&) const = default;
};

/// Prescribes the position, the deformation gradient, or both, of a vertex or of a point of a face
/// or an edge. A hard position holds exactly for the mean of the deformed vertices. The gradient is
/// that of the vertices around the point which nothing else holds.
struct PointConstraint {
    MeshPoint point;
    std::optional<Vec3> position = std::nullopt;
    std::optional<Mat3> gradient = std::nullopt;
    /// Same as HandleOptions::weight.
    std::optional<double> weight = std::nullopt;
};

/// The same for one vertex.
struct VertexConstraint {
    Index vertex = kNoIndex;
    std::optional<Vec3> position = std::nullopt;
    std::optional<Mat3> gradient = std::nullopt;
    std::optional<double> weight = std::nullopt;

    operator PointConstraint() const;
};

/// The exactness of a solve: the first system only (Eq 2.8), about five digits of the size, or all.
enum class FrameQuality { preview, draft, full };

}  // namespace lissom
