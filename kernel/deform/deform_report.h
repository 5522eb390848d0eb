/// How good a deformed surface is.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// What a report shall have.
struct DeformReportOptions {
    /// Searches for faces that run through one another, which takes longer than a frame.
    bool crossings = false;
};

/// Two vertices that are held by different handles, at most two edges apart, and go different ways.
struct Tear {
    std::array<Index, 2> vertices{kNoIndex, kNoIndex};
    /// How far apart their handles take the middle between them, in lengths of the edges between.
    double slip = 0.0;
};

/// The result that a Deformer shows beside its rest shape.
struct DeformReport {
    /// The greatest factor by which an edge of the region, or next to it, is longer or shorter than
    /// at rest, at least 1, and the vertices of that edge.
    double stretch = 1.0;
    std::array<Index, 2> stretched{kNoIndex, kNoIndex};
    /// Faces that look against those around them, and did not at rest; ascending.
    std::vector<Index> flipped;
    /// Pairs of faces that run through one another, and did not at rest, where asked for.
    std::optional<std::vector<FacePair>> crossings;
    /// Volume of the mesh over that at rest, less 1; absent without a volume.
    std::optional<double> volume_change;
    /// Where handles nearly touch and tear the surface between them, the worst first.
    std::vector<Tear> tears;
    /// In words, each with what helps.
    std::vector<std::string> warnings;
};

}  // namespace lissom
