/// The energy of a merging boundary, and the search for the one with the least (thesis sections
/// 3.4.2 and 3.4.3); private to kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/loop_search.h"

namespace lissom {

/// Rotation and scale that take the source to its image.
struct PasteSimilarity {
    Mat3 rotation = Mat3::Identity();
    double scale = 1.0;
};

/// An edge e of the ring and its image on the target.
struct RingEdge {
    Vec3 edge = Vec3::Zero(), image = Vec3::Zero();
    /// Starts of both.
    Vec3 from = Vec3::Zero(), image_from = Vec3::Zero();
    /// Unit normals in its middle.
    Vec3 source_normal = Vec3::Zero(), target_normal = Vec3::Zero();
    /// Mean of that of both ends; see PasteMap::set_relief.
    double relief = 0.0;
    /// False if an end has no image.
    bool inside = false;
};

struct EnergyOptions {
    /// Weight of the normals, times the square root of the first scale; 0 leaves them out.
    double normals = 0.0;
    /// Eq 3.1, |s R e - e*| |e|, with its similarity, the rigid motion that brings points nearest
    /// to their images (Arun et al. 1987) and the quotient of mean lengths, in place of the
    /// symmetric energy |sqrt(s) R e - e* / sqrt(s)| + lambda |e| + mu |R n - n*| |e|, whose value
    /// does not depend on how finely the surface is divided. If features were cleared, that has the
    /// relief of edges as well. lambda and mu hold the scale of the
    /// first loop, so that they do not change while the scale does.
    bool thesis = false;
    /// The scale for lambda and mu, if a search goes on with another's; above 0.
    std::optional<double> first_scale = std::nullopt;
    Index iterations = 20;
    /// The search ends if the energy falls by less than this part of it.
    double tolerance = 1e-5;
};

/// The edges of a ring in its order, `images` being those of the places of the source's chart.
std::vector<RingEdge> ring_edges(const PasteMap& map, const LoopSearch& ring,
                                 std::span<const ImagePoint> images);

/// Edges with their images, as energies see them.
class PasteEnergy {
  public:
    PasteEnergy(std::vector<RingEdge> edges, const EnergyOptions& options)
        : edges_(std::move(edges)), options_(options) {}

    /// Returns the numbers of a loop's edges, or nothing if one has no image or is not in the ring.
    std::vector<Index> edges_of(const LoopSearch& ring, std::span<const Index> loop) const;
    /// Costs of all edges; infinite for those without an image.
    std::vector<double> costs(const PasteSimilarity& similarity) const;
    double energy(std::span<const Index> edges, const PasteSimilarity& similarity) const;
    /// Mean misfit; see PasteSearch.
    double misfit(std::span<const Index> edges, const PasteSimilarity& similarity) const;

    /// The similarity that fits best to begin with: by squares, or the thesis's. Fixes lambda and
    /// mu by its scale.
    PasteSimilarity start(std::span<const Index> edges);
    /// Fixes lambda and mu by a scale.
    void fix_weights(double scale);
    /// One that has no more energy than `before`, unless it is the thesis's: by reweighted least
    /// squares.
    PasteSimilarity improved(std::span<const Index> edges, const PasteSimilarity& before) const;

  private:
    double cost(const RingEdge& edge, const PasteSimilarity& similarity) const;
    PasteSimilarity reweighted(std::span<const Index> edges, const PasteSimilarity& before) const;
    PasteSimilarity literal(std::span<const Index> edges) const;

    std::vector<RingEdge> edges_;
    EnergyOptions options_;
    double lambda_ = 0.0, mu_ = 0.0;
};

/// A loop of the ring, counter-clockwise, and the similarity that belongs to it.
struct PasteLoop {
    std::vector<Index> vertices;
    PasteSimilarity similarity;
    PasteSearch report;
    /// The scale that lambda and mu were fixed by, and the energy and misfit of the loop.
    double first_scale = 1.0, energy = 0.0, misfit = 0.0;
};

/// Alternates similarity and loop. Begins with `start` unless it is empty, else with the outline of
/// the region, or, if that has no image, with the feature's.
/// Errors: boundary_conflict, naming vertices, if no loop around the feature has an image on the
/// target's region; cancelled.
PasteLoop search_boundary(const PasteMap& map, const PasteRegions& regions, const LoopSearch& ring,
                          std::span<const ImagePoint> images, std::span<const Index> start,
                          const EnergyOptions& options, const Context& context);

}  // namespace lissom
