/// Parts inside boundaries of one placement, deformed for comparison; private to kernel/merge.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/part/moving_part.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/part/target_bite.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/merge/paste/paste_state.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/free_loop.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/paste/search/paste_energy.h"

namespace lissom {

/// The part inside one boundary, deformed.
struct PartTrial {
    std::shared_ptr<MovingPart> moving;
    std::vector<RingPoint> rim;
    PasteSimilarity similarity;
    double scale = 1.0;
    /// The boundary is free of edges; it is the outline that was marked.
    bool smooth = false, outline = false;
    /// The boundary is the feature's own outline.
    bool tight = false;
    /// The part keeps its shape, and its foot is drawn to the surface.
    bool draped = false;
    MovedPart moved;
    PasteDistortion near;
    /// The same before the part was refined and its boundary slid over the target.
    PasteDistortion plain;

    const PastePart& part() const { return moving->part(); }
};

struct PartTrials {
    const PasteOptions& options;
    const PasteRegions& regions;
    const RingSurface& surface;
    const LoopSearch& ring;
    /// Its images are those of `surface`, but for the outline's.
    const PlacedFeature& placed;
    MovingParts& parts;
    /// The size that the placement asks for, in place of the boundary's.
    bool lock_scale = false;
    /// Parts are refined if that lowers their distortion near the boundary.
    bool refines = false;
    /// Boundaries slide to the relaxed position of the part, as long as that lowers it.
    bool settles = false;
    /// Sharp edges of the target's chart, whose vertices are places of that.
    std::span<const SharpEdge> sharp = {};
    /// Sharp edges that a part may bite, if they are not those of the target it is sewn to.
    std::optional<std::vector<SharpEdge>> left = std::nullopt;

    /// Deforms the part of a trial to its rim. Returns its distortion without a refinement.
    PasteDistortion move(PartTrial& trial, const Context& context) const;
    PartTrial along_loop(const Context& context) const;
    /// Returns nothing without a boundary free of edges, or if the ring is too coarse to divide.
    std::optional<PartTrial> along_line(const Context& context) const;
    /// With a similarity of its own. All of the outline must have an image.
    PartTrial along_outline(const Context& context) const;
    /// The same without the teeth of the outline. Returns nothing if that has no such line.
    std::optional<PartTrial> along_smooth_outline(const Context& context) const;
    /// The feature alone, inside its own outline, and the same without teeth.
    PartTrial along_inner(const Context& context) const;
    std::optional<PartTrial> along_smooth_inner(const Context& context) const;
    /// The same without the flat surface around its foot, but for a ring of faces. Returns nothing
    /// if the foot has no closed line around.
    std::optional<PartTrial> along_foot(const PartTrial& inner, const Context& context) const;

  private:
    PasteDistortion drape(PartTrial& trial, const Context& context) const;
    bool slide(PartTrial& trial, double part, const Context& context) const;
    void settle(PartTrial& trial, const Context& context) const;
    std::vector<RingPoint> rim_within(const PastePart& part, const PartTrial& whole) const;
    PasteLoop fitted(std::span<const Index> loop) const;
    PartTrial trial_of(std::shared_ptr<MovingPart> part, const PasteSimilarity& similarity,
                       const Context& context) const;
    std::shared_ptr<MovingPart> inside(MovingParts::Boundary kind, std::span<const Index> loop,
                                       const Context& context) const;
    std::optional<PartTrial> along(MovingParts::Boundary kind, const FreeLoop& line,
                                   const Context& context) const;
};

}  // namespace lissom
