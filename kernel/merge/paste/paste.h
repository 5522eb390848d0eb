/// Paste: a feature of one mesh becomes part of another, along the loop around it that merges with
/// the least distortion (thesis section 3.4).
///
///     Paste paste(source, target, region, feature, std::nullopt, {.at = point});
///     paste.optimize();
///     PasteResult result = paste.merge();
///     paste.move({.at = other});
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ThesisFormulas;

/// Image of a vertex of the ring: by the maps of both surfaces, or, after some rounds, the
/// nearest point of the target's region. Rounds end if one does not lower the energy, and
/// are kept if the surface near the boundary is distorted less. They belong to `optimize`
/// alone.
enum class PasteCorrespondence { map, closest };

/// smooth: a line through faces, near the best loop of edges, so that the seam has no teeth. mesh:
/// that loop, along edges of the source.
enum class PasteBoundary { smooth, mesh };

struct PasteOptions {
    PasteBoundary loop = PasteBoundary::smooth;
    PasteCorrespondence correspondence = PasteCorrespondence::closest;
    /// Part of the way from the region's outline to its middle that is ring if no feature is given;
    /// 0 to 1.
    double share = 0.5;
    /// Weight of the normals in the energy; 0.1 to 0.3 help features that overhang.
    double normals = 0.0;
    /// About the greatest angle, in radians, at which part and target may meet instead of the
    /// part's boundary turning until its surface goes on in the target's: the more it turns, the
    /// more the part is distorted beside it. 0: no crease. 0 to pi; the thesis takes 0.
    double crease = 30.0 * kDegree;
    /// The thesis to the letter: maps that keep angles (LSCM), the energy of Eq 3.1 with its
    /// similarity, a boundary along edges, its deformation. Null: ours. As MergeOptions::thesis.
    const ThesisFormulas* thesis = nullptr;
    /// Removes the target's features under the part first (erase_feature): those under its
    /// boundary, and nothing beyond that.
    bool clear = false;
    /// Region to clear instead of that, with a ring around it; counts as `clear`.
    std::optional<Region> cleared = std::nullopt;
};

struct PasteMergeOptions {
    /// Options of the seam, as MergeOptions::smooth, collar and find_intersections.
    Index smooth = 3;
    bool collar = true;
    bool find_intersections = true;
    /// The part keeps the size that its placement asks for, in place of that of its boundary.
    bool lock_scale = false;
    /// Tries variants that may distort the surface near the boundary less, and takes the best: ARAP
    /// iterations of the part; the part inside the outline that was marked; and, once `optimize`
    /// was called and by nearest points, a boundary that slides over the target towards the relaxed
    /// position of the part. If the target was cleared under the boundary, that is kept.
    bool compare = true;
    /// Fairs the places beside the seam at which edges of a side turn by 20 degrees more than at
    /// rest, as far as that leaves fewer of them and no more faults. If the verdict still finds
    /// fault with the surface there, tries a fair seam, a transition and, with `compare`, other
    /// boundaries, and keeps the result with fewest faults; a warning says so. Not of drafts and
    /// the thesis's way, nor if `collar` is off or `smooth` is 0.
    bool mend = false;
    /// A draft for dragging, many times a second: placement and boundary are those of a merge that
    /// is no draft, and the result is watertight, but the part is not refined, nor does its
    /// boundary slide, and the seam is sewn and no more, unless faces turn over at it: then it is
    /// smoothed, and the part beside it differs from that of `Paste::draft`. Otherwise nothing is
    /// smoothed, made anew or flipped there, regardless of `smooth`, `collar` and
    /// `find_intersections`; and the origin of elements is not returned.
    bool draft = false;
};

struct PasteDraftOptions {
    /// Options of PasteMergeOptions.
    bool lock_scale = false, compare = true;
};

/// Preview of a dragged part: the part as a draft of `merge` has it, but not sewn to the
/// target.
struct PasteDraft {
    /// The part inside the boundary, deformed onto the edge of its hole in the target. Vertices of
    /// the edge that are close to others are still there, which sewing drops.
    Mesh part;
    /// Its vertices on that edge, in the order of the boundary.
    std::vector<Index> rim;
    /// Same as in PasteReport.
    double scale = 1.0;
    bool smooth = false, kept_outline = false;
    PasteDistortion near, laid;
};

/// Results and measures of a paste.
struct PasteReport {
    PasteSearch search;
    MapQuality source_map, target_map;
    /// Angle from the base direction and scale of the placement, in radians; whether the angle was
    /// chosen.
    double angle = 0.0;
    bool angle_chosen = false;
    /// Neither an angle nor a way was given, and the part's `up` was turned to that of the target,
    /// as far as the surface allows.
    bool upright = false;
    /// Growth of the part, as a factor.
    double scale = 1.0;
    /// Within three rings of the boundary, by its image, and of the feature's faces.
    PasteDistortion near, feature;
    /// Near the boundary once the part lies on the target as it was opened.
    PasteDistortion laid;
    /// Distortion near the marked outline, if compared; of the part before iterations.
    std::optional<PasteDistortion> outline_near;
    /// The outline was used in place of the loop that was found.
    bool kept_outline = false;
    /// The feature's own outline was used in place of that: more of the target's sharp edges stays.
    bool tight = false;
    /// The feature stands on sharp edges of the target: it kept its shape, and its foot was drawn
    /// down to the surface along the feature's own outline.
    bool draped = false;
    /// The region had several outlines, which strips of the surface between them join.
    bool joined = false;
    /// The boundary runs through faces.
    bool smooth = false;
    /// Removed features of the target, if any.
    std::optional<PasteClearing> clearing;
    /// A draft was asked for: another merge has the better seam.
    bool draft = false;
    /// Euler characteristic of the result, and the one expected from target and part.
    Index euler_characteristic = 0, expected_characteristic = 0;
};

struct PasteResult {
    MergeResult merged;
    PasteReport report;
};

/// A paste that can be placed and optimised again.
class Paste {
  public:
    /// Checks the regions, lays both surfaces out in the plane and places the part. A region with
    /// several outlines, such as those around the feet of a handle, takes the surface between them
    /// along. Meshes may change or die afterwards. If the target's edges under the part are long,
    /// they are halved until there is room for it (finer_near). `onto` absent: a disk of the target
    /// around the placement, large enough for the ring.
    /// Errors: topology_mismatch, region_empty, boundary_conflict, not_a_disk for regions (see
    /// paste_regions and target_faces); boundary_conflict for a point outside the target's region,
    /// and if the feature's outline does not fit into it, naming vertices; invalid_argument for
    /// options out of range; not_finite; mesh_empty; not_positive_definite; memory_limit;
    /// cancelled. If the target is cleared, also as erase_feature.
    Paste(const Mesh& source, const Mesh& target, const Region& region,
          const std::optional<Region>& feature, const std::optional<Region>& onto,
          const PastePlacement& placement, const PasteOptions& options = {},
          const Context& context = {});
    ~Paste();
    Paste(Paste&&) noexcept;
    Paste& operator=(Paste&&) noexcept;

    /// Alternates similarity and loop until the energy falls no more, then frees the boundary of
    /// the edges. Returns it as by `loop`.
    /// Errors: invalid_argument for less than one iteration; cancelled.
    Path optimize(Index iterations = 20, const Context& context = {});
    /// Returns the result of the last search; before `optimize`, the loop that is used without.
    const PasteSearch& search() const;
    /// Returns the boundary that `merge` pastes, on the source and counter-clockwise around the
    /// feature: points of its surface, or vertices if it runs along edges. It is the outline of the
    /// region, or of the feature if that has no image, until `optimize` was called.
    Path loop() const;
    /// The place of the loop on the target: one point for each of `loop`.
    Path image() const;

    /// Returns the part of the target as given that `merge` removes under the part before it opens
    /// it, as vertices of the removed faces; nothing if none are.
    std::optional<Region> cleared() const;
    std::optional<PasteClearing> clearing() const;

    /// Opens the target along the loop's image and pastes the part. Watertight if the target is.
    /// Errors: boundary_conflict if the target is too coarse under the part or the boundary crosses
    /// itself; as `sew`; zero_area; skin_mismatch; memory_limit; cancelled.
    PasteResult merge(const PasteMergeOptions& options = {}, const Context& context = {});

    /// Returns the part of a draft of `merge` alone. The cost depends on the part and on the
    /// surface under it, not on the size of the target.
    /// Errors: boundary_conflict, as merge; cancelled; memory_limit.
    PasteDraft draft(const PasteDraftOptions& options = {}, const Context& context = {});

    /// Places the part anew; an optimised one, from the loop it had. After an error all is as
    /// before: the last good placement stays. Errors: as the constructor.
    void move(const PastePlacement& placement, const Context& context = {});
    /// Moves the part as `move` does with the present loop, unless the outline fits better there:
    /// for a part that is being dragged. Errors: as move.
    void slide(const PastePlacement& placement, const Context& context = {});
    const PastePlacement& placement() const;

    std::size_t memory_bytes() const;

  private:
    friend class PasteSource;
    struct State;
    explicit Paste(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// A feature for pasting onto many targets: the part that depends on the source alone is made once.
class PasteSource {
  public:
    /// Errors: as Paste's constructor for the source, its regions and the options.
    PasteSource(const Mesh& source, const Region& region, const std::optional<Region>& feature,
                const PasteOptions& options = {}, const Context& context = {});
    ~PasteSource();
    PasteSource(PasteSource&&) noexcept;
    PasteSource& operator=(PasteSource&&) noexcept;

    /// The feature on a target. Errors: as Paste's constructor for the target and the placement.
    Paste on(const Mesh& target, const std::optional<Region>& onto, const PastePlacement& placement,
             const Context& context = {}) const;
    /// Returns the reach of the feature with its ring over a surface from its middle, at a scale.
    double reach(double scale) const;

  private:
    std::unique_ptr<Paste::State> state_;
};

}  // namespace lissom
