/// State of a paste between its steps; private to kernel/merge.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/erase/cleared_target.h"
#include "kernel/merge/paste/part/moving_part.h"
#include "kernel/merge/paste/part/target_bite.h"
#include "kernel/merge/paste/part/target_piece.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/free_loop.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/paste/search/paste_energy.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct LaidPart;
struct PartTrial;
struct PartTrials;

/// One placement and the boundary that belongs to it.
struct PlacedFeature {
    PastePlacement placement;
    double angle = 0.0;
    bool angle_chosen = false, upright = false;
    /// Images of the places of the source's chart, and those by the maps alone.
    std::vector<ImagePoint> images, mapped;
    PasteLoop loop;
    /// The boundary free of edges, if one was found that is no worse than `loop`.
    std::optional<FreeLoop> line;
};

/// A map of a region of the target, and the values that are made of that region on first use.
struct TargetOnMap {
    std::unique_ptr<PasteMap> map;
    std::optional<TargetPiece> piece = std::nullopt;
    std::optional<PasteGround> ground = std::nullopt;
    /// Sharp edges between places of its chart.
    std::optional<std::vector<SharpEdge>> edges = std::nullopt;
};

/// Effort of the search for a boundary.
struct PasteEffort {
    /// 0: the boundary keeps its start.
    Index iterations = 0;
    /// Adds rounds of nearest points, if the paste has them.
    bool closest = false;
    /// The boundary free of edges that belongs to the loop to start from, if it stays there.
    const FreeLoop* line = nullptr;
    /// A placement on another target, whose boundary keeps its place.
    const PlacedFeature* like = nullptr;
};

/// The target as a part stands on it.
struct AlteredTarget {
    Mesh mesh;
    /// From its elements to those of the target as given; nothing for that itself.
    std::optional<MeshMap> map;
    /// The region for parts.
    std::optional<Region> onto;
};

struct Paste::State {
    Mesh source, target;
    PasteOptions options;
    PasteRegions regions;
    PasteChart source_map;
    /// Made anew whenever `target` changes.
    std::unique_ptr<PasteSurfaces> surfaces;
    std::shared_ptr<const LoopSearch> ring;
    std::shared_ptr<const RingTriangles> triangles;
    std::unique_ptr<TargetOnMap> used;
    /// Whether the target's region was chosen here.
    bool own_disk = false;
    bool optimized = false;
    /// The region for parts and the longest edge of the target as given.
    std::optional<Region> onto;
    double longest_edge = 0.0;
    /// Its sharp edges, once they were asked for.
    mutable std::optional<std::vector<SharpEdge>> given_edges = std::nullopt;
    /// If `target` is another one, finer under the part or without its features there: the target
    /// as given, and the origin of the elements of `target`.
    Mesh given;
    std::optional<MeshMap> altered;
    /// The removed part of the target as given, if any.
    std::optional<Region> gone;
    std::optional<PasteClearing> clearing;
    PlacedFeature placed;
    MovingParts parts;

    bool clears() const { return options.clear || options.cleared.has_value(); }
    /// Prepares the part that depends on the source alone.
    void prepare(const Mesh& new_source, const Region& region, const std::optional<Region>& feature,
                 const PasteOptions& wanted, const Context& context);
    /// Lays a target out and places the part on it.
    void begin_on(const Mesh& new_target, const std::optional<Region>& region,
                  const PastePlacement& placement, const Context& context);
    void move_to(const PastePlacement& placement, const PasteEffort& effort,
                 const Context& context);
    const Mesh& as_given() const { return altered ? given : target; }
    /// Whether sharp edges of the target as given lie within the part's reach.
    bool has_edges_near(const PastePlacement& placement) const;
    double coarse_edge(const PastePlacement& placement) const;
    bool needs_another(const PastePlacement& placement) const;
    double reach_of(const PastePlacement& placement) const;
    AlteredTarget roomy(const PastePlacement& placement, const Context& context) const;
    void place_here(const std::optional<Region>& region, const PastePlacement& placement,
                    std::span<const Index> start, const PasteEffort& effort,
                    const Context& context);
    void place_on(AlteredTarget next, const PastePlacement& placement, std::span<const Index> start,
                  const PasteEffort& effort, const Context& context);
    template <typename Work>
    void all_or_nothing(const Work& work);
    /// Places the part on a target that is altered for it. After an error all is as before.
    void place_on_altered(const PastePlacement& placement, std::span<const Index> start,
                          const PasteEffort& effort, const Context& context);
    void place_clearing(const AlteredTarget& ground, const PastePlacement& placement,
                        std::span<const Index> start, const PasteEffort& effort,
                        const Context& context);
    void note_cleared(const ClearedTarget& next);
    AlteredTarget without_cleared(const AlteredTarget& ground, const Context& context);
    AlteredTarget base_of(const AlteredTarget& ground, const PastePlacement& placement,
                          const Context& context) const;
    std::vector<Vec2> boundary_in_plane() const;
    Region under_boundary(const AlteredTarget& ground, const PastePlacement& placement,
                          const Context& context) const;
    void place_on_cleared(const AlteredTarget& ground, const Region& under,
                          const PastePlacement& placement, std::span<const Index> start,
                          const PasteEffort& effort, const Context& context);
    /// Clears the target under the boundary that was found, and seeks it there again. If that fails
    /// nothing changes.
    void clear_under_boundary(const PasteEffort& effort, const Context& context);
    /// Relief of the target as given that lines on a chart of `target` cut.
    std::vector<double> relief_of(const PasteChart& chart, const PastePlacement& placement,
                                  const Context& context) const;
    std::unique_ptr<PasteMap> map_of(std::span<const Index> target_faces,
                                     const PastePlacement& placement, const Context& context) const;
    std::unique_ptr<PasteMap> map_around(const PastePlacement& placement, double room,
                                         const Context& context) const;
    [[noreturn]] void refuse_room(const PastePlacement& placement) const;
    /// A map of the target and the part on it.
    struct PlacedOn {
        std::unique_ptr<PasteMap> map;
        PlacedFeature place;
    };
    std::optional<PlacedOn> placed_within(const PastePlacement& placement, double room,
                                          std::span<const Index> start, const PasteEffort& effort,
                                          const Context& context);
    void place_on_disk(const PastePlacement& placement, std::span<const Index> start,
                       const PasteEffort& effort, const Context& context);
    void use_map(std::unique_ptr<PasteMap> on);
    const TargetPiece& target_piece(const Context& context);
    const PasteGround& ground(const Context& context);
    /// Sharp edges that a part may stand on; none if the target was cleared under its boundary.
    std::span<const SharpEdge> edges_to_stand_on(const Context& context);
    /// Sharp edges of the target as given that no cleared part meets, in the piece that the part is
    /// sewn into; nothing if none was cleared.
    std::optional<std::vector<SharpEdge>> edges_left(const Context& context);
    LaidPart laid_on_ground(const PartTrials& trials, const PartTrial& trial,
                            const Context& context);
    LaidPart drafted(const PartTrials& trials, const PasteDraftOptions& wanted,
                     const Context& context);
    double misfit_at(const PasteMap& on, const std::vector<ImagePoint>& images) const;
    void choose_angle(const PasteMap& on, PlacedFeature& place, const Context& context) const;
    PlacedFeature place(const PasteMap& on, const PastePlacement& placement,
                        std::span<const Index> start, const PasteEffort& effort,
                        const Context& context);
    std::optional<double> size_of(const PasteMap& on, const std::vector<ImagePoint>& images) const;
    std::vector<ImagePoint> images_like(const PasteMap& on, const PlacedFeature& former) const;
    std::vector<ImagePoint> images_of(const PasteMap& on, const PastePlacement& placement,
                                      double angle, const PlacedFeature* like) const;
    std::vector<ImagePoint> nearest_images(const PasteMap& on, const PlacedFeature& place) const;
    bool draw_once(const PasteMap& on, PlacedFeature& place, const Context& context) const;
    double energy_near(const PasteMap& on, const PlacedFeature& place, const Context& context);
    void draw_closer(const PasteMap& on, PlacedFeature& place, const Context& context);
    void free_boundary(const PasteMap& on, PlacedFeature& place, const Context& context) const;
    void keep_line(const PasteMap& on, PlacedFeature& place, const FreeLoop& line) const;
    void note_line(PlacedFeature& place) const;
    /// Whether the map has an image of all of the outline.
    bool covers(const PlacedFeature& place) const;
    /// Whether the target was cleared under the boundary, so that no other one may be taken.
    bool bound_to_boundary() const { return options.clear && !options.cleared && gone; }
};

/// Returns the options of the search for the least energy.
EnergyOptions energy_for(const PasteOptions& options, Index iterations);

}  // namespace lissom
