/// Merger: parts of different models become one mesh wherever they lie and whatever their size
/// (thesis section 3.3). The source is deformed so that its boundaries come to lie on those of the
/// target, which stays, and both are sewn together.
///
///     Merger merger(head, torso, {{boundary(head), boundary(torso)}});
///     MergeResult result = merger.solve();
///     merger.set_keys(0, other_keys);
///     result = merger.solve();  // no factorisation
///
/// `merge` (merge_once.h) does it in one call.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/stats.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/keys.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ThesisFormulas;

/// Whether the source comes to the target from any place, turned and scaled to fit (3.3.1), or
/// stays in place and only bends to meet the target (3.3.2).
enum class Configuration { free, fixed };

/// Rotation of a free source without keys about the axis of its boundary: the least from its
/// place beside the target, for parts laid or modelled in place; or by the shapes of the parts,
/// wherever it lies. Directions that belong together (MergeOptions::directions) come before
/// either.
enum class Place { as_placed, shape };

/// Criterion that decided which points of two boundaries meet.
enum class Placing { keys, as_placed, directions, shape };

/// Similarity of a feature that keeps its shape in the free configuration.
enum class FeatureMotion {
    /// Its Laplacian coordinates share a deformation gradient that is an unknown of the systems
    /// (section 3.5). One factorisation less; the surface around features is distorted more.
    common,
    /// The surface is deformed without it first, and the similarity that fits the feature then is
    /// kept in a second deformation, with factors of its own. On four merges of real models the
    /// surface outside the features was distorted 5 to 44 % less than with `common`, by energy, in
    /// up to twice the time.
    fitted,
};

/// Two boundaries to be joined.
struct Join {
    /// An open boundary of the source, and one of a target.
    Path source, target;
    /// Number of the target.
    Index target_mesh = 0;
    /// Points that meet. Without any, MergeOptions::directions or MergeOptions::place decide.
    std::vector<KeyPair> keys = {};
};

struct MergeOptions {
    Configuration configuration = Configuration::free;
    /// Placement of joins without keys. In the fixed configuration the source keeps its place, so
    /// that only `as_placed` applies.
    Place place = Place::as_placed;
    /// Features of the source that keep their shape. In the free configuration each moves as a
    /// whole, by a similarity of its own (the extension of thesis section 3.5); in the fixed one it
    /// stays in place.
    std::vector<Region> fixed = {};
    /// Motion of features in the free configuration.
    FeatureMotion feature_motion = FeatureMotion::fitted;
    /// In the fixed configuration: distance from its boundaries within which the source deforms,
    /// along its edges and in its unit; farther vertices stay. Absent: all of it if features are
    /// fixed, else three radii of the largest boundary.
    std::optional<double> reach = std::nullopt;
    /// In the fixed configuration: the surface at the boundary turns as the target's does there, or
    /// keeps its directions (the thesis's way, which leaves a crease).
    bool turn_frames = true;
    SeamKind seam = SeamKind::conform;
    /// Umbrella steps at the seam, at most: the first that would fold it is the last.
    int smooth = 3;
    /// Remeshes the faces beside a seam on a side that is sparser than the seam (SewOptions). It is
    /// left out if the seam shows less without, as on sides that fold. False, with `smooth` 0,
    /// leaves the targets as they are, to the bit. The thesis's way has none.
    bool collar = true;
    /// Widths of the transition region (3.3.3) on each side, in the units of source and target; 0
    /// is none. The thesis's transition needs both, and regions that are bands: its widths are
    /// lengths along edges.
    double source_transition = 0.0, target_transition = 0.0;
    /// Chooses the widths by the seams (suitable_widths) in place of given ones; flat faces of the
    /// targets stay flat then. Not for the thesis's transition.
    bool auto_transition = false;
    /// w_T of 3.3.3, of the thesis's transition.
    double transition_weight = 0.1;
    /// Trims boundaries that turn at their vertices, in the mean, by `max_turn` radians more
    /// than a regular polygon: the seam would show every tooth of them.
    bool trim = true;
    double max_turn = 20.0 * kPi / 180.0;
    /// Splits the faces at a boundary of the source once if its edges are more than 1.5 times as
    /// long as those it meets. A boundary with edges more than 3 times as long as edges inside the
    /// source is coarse (section 2.5): its faces are split until it is not, 4 times at most, and
    /// those of the target with them, until its edges are at most 1.5 times as long.
    bool subdivide = true;
    /// Looks for faces that run through others and did not before; see
    /// MergeReport::intersections.
    bool find_intersections = true;
    /// If a seam that conforms without a transition is asked for, fairs the places beside it at
    /// which edges of a side turn by 20 degrees more than at rest, as far as that leaves fewer of
    /// them and no more faults. If the verdict still finds fault with the surface around the seams,
    /// smooths thorns that the source did not have, if they are all; else sews again with the seam
    /// fair and then with a transition of suitable widths, and keeps the result with fewest faults;
    /// a warning says so. Creases and flat faces of the targets stay.
    /// Takes the time of sewing up to three times, and of judging up to 24 times. Not of the
    /// thesis's way, nor if `collar` is off or `smooth` is 0.
    bool mend = false;
    /// Directions of source and targets that are to lie the same way, for joins without keys. They
    /// count as far as they lie in the planes of the boundaries.
    std::vector<DirectionPair> directions = {};
    /// The thesis's formulas (3.3): arc length, normals and frames of the loops without smoothing,
    /// scales from tangent lengths, vertices that meet only if they coincide; its operators, |M| /
    /// sqrt 3 and (2.11); umbrella steps without a guard, no edges flipped after them, no collar;
    /// its transition. The other options are as chosen: thesis_merge_options of kernel/thesis
    /// chooses them too, and thesis_formulas makes these. Null: ours. Not owned.
    const ThesisFormulas* thesis = nullptr;
};

/// Results at one join.
struct JoinReport {
    /// Vertices of the two loops as they were joined.
    Index source_size = 0, target_size = 0;
    /// Growth of the source at it, as a factor.
    double scale = 1.0;
    /// Criterion of the source's rotation.
    Placing placed = Placing::keys;
    /// Whether the shapes decided, or directions that contradict each other; `certainty` is then
    /// the probability, 0 to 1, that this is right, and else 1. Below kCertain the result asks for
    /// one key.
    bool guessed = false;
    double certainty = 1.0;
    /// Whether the parts are round, so that no turn is better than another.
    bool any_turn = false;
    /// Rotation of the source at this join from its given place: the unit axis times an angle
    /// in radians, 0 to pi.
    Vec3 turn = Vec3::Zero();
    /// Points of the boundaries that meet: given as the only key they make the same result, but for
    /// rounding. None in the thesis's transition.
    std::optional<KeyPair> key;
    /// Mean turn of the loops, in radians, as given; and whether they were trimmed.
    double source_turn = 0.0, target_turn = 0.0;
    bool source_trimmed = false, target_trimmed = false;
    /// Whether faces of the source, and of the target, were split for it.
    bool subdivided = false, target_subdivided = false;
    /// Whether the parts fit: both boundaries are one curve, as they lie or, in the free
    /// configuration, up to a similarity, and the surface goes on across it. All vertices are kept
    /// there, the target's in place and the source's under that similarity, and nothing is
    /// smoothed, trimmed or refined.
    bool fits = false;
    /// In the fixed configuration: whether both parts lie on the same side of the boundary, so that
    /// the source turns over to meet the target.
    bool same_side = false;
    /// The surface around the seam, against both sides before. Not measured of drafts.
    BandQuality band;
};

/// Kinds of fault that a merge may have.
enum class MergeFault {
    /// Faces run through one another that did not before.
    crossings,
    /// In the fixed configuration both parts lie on the same side of their boundary.
    side,
    /// The surface folds back beside the seam and did not before.
    folds,
    /// The band around the seam is rougher than the parts were there.
    roughness,
    /// A part lost volume, or was turned inside out.
    volume,
    /// The surface turns more across the band than beside the boundaries before.
    bend,
    /// The rim of the source stands out beside the seam more than it did.
    flare,
    /// The surface comes to a point beside the seam, more sharply than it did.
    spike,
    /// The surface turns more at an edge of the seam than beside the boundaries before.
    seam,
    /// The places at which the boundaries meet are a guess that may be wrong.
    place,
    /// Triangles at the seam are so thin that they have no reliable normals.
    slivers,
    /// A paste bit into sharp edges of its target, or rounded them.
    bite,
    /// Places of a scatter have no part.
    left_out,
};

/// The name of a fault, as scripts see it: "crossings", "folds" and so on.
const char* fault_name(MergeFault fault);

/// Place of crossing faces: within one radius of a seam, farther from it on the source or on the
/// target, or there between both.
enum class CrossingPlace { seam, source, target, between };

/// The pairs of faces that run through one another at one kind of place.
struct CrossingGroup {
    CrossingPlace place = CrossingPlace::seam;
    Index pairs = 0;
    /// Faces of the result, ascending, and the mean of their corners.
    std::vector<Index> faces;
    Vec3 middle = Vec3::Zero();
    /// The surfaces only touch: they part if both draw back along their normals by a hundredth of
    /// the seam's radius. Such groups are no reason against a merge.
    bool shallow = false;
    /// The surface hides the places from outside, as within a closed mouth or a neck: at most 3 of
    /// 100 directions lead out of them. Such groups are told, and are no reason against a merge.
    bool hidden = false;
};

/// Reason why a merge is not good.
struct MergeReason {
    MergeFault fault = MergeFault::crossings;
    /// The join concerned; kNoIndex if it is all of them.
    Index join = kNoIndex;
    /// Measured value and the limit that it passes: radians for angles, radii of the seam for the
    /// length of folds, a count of pairs of faces, the part of the volume that was kept, the
    /// certainty of a guess; for bites the depth or the length in radii of the seam.
    double value = 0.0, limit = 0.0;
    /// The fault in plain words with both figures, and a remedy: only options that the operation
    /// has and that are not set already are named.
    std::string text, remedy;
    /// For crossings: the faces of the result concerned, ascending.
    std::vector<Index> faces = {};
};

/// Bites of a paste into the sharp edges of its target (edges that turn by more than 35 degrees):
/// they stand out of the result, or lie below the surface that is still the target's.
struct TargetBite {
    /// Their length, and how far they are from the result at most, in radii of the seam.
    double length = 0.0, depth = 0.0;
};

/// Results and measures of a merge.
struct MergeReport {
    /// Whether the result is good, and in one line why not; see verdict_of.
    bool ok = false;
    std::string verdict;
    /// Each fault, the gravest kind first; empty if the result is good.
    std::vector<MergeReason> reasons;
    /// The parts beside their boundaries before they were joined: the steepest angles there are
    /// the baseline of a seam.
    SeamQuality source_rim, target_rim;
    /// Angle, in radians, at which the options let the parts meet (PasteOptions::crease).
    double crease = 0.0;
    /// Bite of a paste; not measured in drafts.
    TargetBite bite;
    /// Number of parts of the source without a joined boundary: in the free configuration each
    /// moves along with the nearest joined part.
    Index loose_parts = 0;
    std::vector<JoinReport> joins;
    /// Inputs that were inside out and have been turned over: the source, and targets by number.
    bool source_flipped = false;
    std::vector<Index> targets_flipped;
    /// Things the user should look at, in plain words.
    std::vector<std::string> warnings;
    DeformStats deform;
    /// Times of the deformation in the last solve.
    BoundaryTimes deform_seconds;
    SewReport seam;
    /// Bands of the transition region, if any.
    TransitionReport transition;
    /// Pairs of faces of the result that run through one another and come from faces that did not.
    /// Pairs of the source count as before if faces next to theirs did run through one another and
    /// both belong to separate parts, or lie more than one radius from every seam.
    std::vector<FacePair> intersections;
    /// The same by place; and the number of pairs that came from crossing faces.
    std::vector<CrossingGroup> crossings;
    Index known_intersections = 0;
    /// Wall-clock seconds of preparation and of the last solve.
    double prepare_seconds = 0.0, solve_seconds = 0.0;
};

struct MergeResult {
    Mesh mesh;
    MergeReport report;
    /// Origin of each element: those of target 0, of target 1, ..., of the source, in this order,
    /// each numbered as in its own mesh behind the ones before it.
    MeshMap provenance;
    /// The side that each face comes from.
    std::vector<SeamSide> side_of_face;
    /// Vertices of each seam in order.
    std::vector<std::vector<Index>> seams;
};

/// A merge that can be solved again after its keys have moved, without factoring again. Accepts
/// polygon meshes of any genus, with any number of boundaries; those not joined stay open.
class Merger {
  public:
    /// Checks and prepares. Meshes may change or die afterwards.
    /// Errors: invalid_argument without targets or joins, or for options out of range;
    /// topology_mismatch; not_a_boundary for a path that is not an open boundary of its mesh;
    /// boundary_conflict if two joins share one, or one crosses itself, has fewer than three
    /// vertices or no length, or if a mesh is given twice; handle_overlap if a fixed feature covers
    /// vertices of a boundary or, in the free configuration, of another feature; unconstrained;
    /// zero_area; memory_limit; cancelled.
    Merger(const Mesh& source, std::span<const Mesh* const> targets, std::vector<Join> joins,
           const MergeOptions& options = {}, const Context& context = {});
    /// The same with one target.
    Merger(const Mesh& source, const Mesh& target, std::vector<Join> joins,
           const MergeOptions& options = {}, const Context& context = {});
    ~Merger();
    Merger(Merger&&) noexcept;
    Merger& operator=(Merger&&) noexcept;

    /// Replaces the keys of one join, vertices and points being those of the meshes as given.
    /// Errors: out_of_range; key_conflict as `solve`. The keys are then those of before.
    void set_keys(Index join, std::vector<KeyPair> keys);

    /// Finds the correspondence, deforms the source, and sews.
    /// Errors: key_conflict; invalid_argument if a region of the thesis's transition is no band
    /// (too narrow, too wide, with a handle, or meeting another); as `sew`; cancelled; internal
    /// instead of a mesh that is not sound.
    MergeResult solve(const Context& context = {});

    /// Returns findings of the preparation that the user should look at, in plain words; they are
    /// among the warnings of the report as well.
    const std::vector<std::string>& warnings() const;

    /// Bytes held: both inputs and the factors.
    std::size_t memory_bytes() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
