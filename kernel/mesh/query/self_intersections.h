/// Faces of a mesh that run through one another.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Two faces, the lower number first.
struct FacePair {
    Index first = kNoIndex, second = kNoIndex;
    bool operator==(const FacePair&) const = default;
    bool operator<(const FacePair& other) const {
        return first != other.first ? first < other.first : second < other.second;
    }
};

struct SelfIntersectionOptions {
    /// Only pairs with one face among `faces` and the other among `against`; all faces if absent.
    /// The time depends on the size of the smaller set, apart from one pass over the other.
    std::optional<std::vector<Index>> faces = std::nullopt, against = std::nullopt;
    /// Triangles closer than this part of their longest edge touch.
    double tolerance = 1e-9;
};

/// Returns the pairs of faces that meet other than at a vertex or an edge that both have, in
/// ascending order. Faces that touch or lie on one another count, and so do neighbours that are
/// folded flat upon each other. Vertices at one place count as one, so that open seams are no
/// intersections. Polygons are those of their triangulation (triangulation.h). The boxes of the
/// triangles are searched by a hierarchy. Errors: out_of_range naming faces that do not exist;
/// invalid_argument for a tolerance outside 0 to 1; cancelled.
std::vector<FacePair> self_intersections(const Mesh& mesh,
                                         const SelfIntersectionOptions& options = {},
                                         const Context& context = {});

}  // namespace lissom
