/// A seam while it is made; private to kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/sew/seam_attributes.h"
#include "kernel/merge/sew/seam_faces.h"
#include "kernel/merge/sew/seam_patch.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A target and a source as one mesh, not connected, and the source's first numbers.
struct BothSides {
    const Mesh& mesh;
    Index first_source_vertex = 0, first_source_face = 0;
};

/// Sews both sides, without skins; joins are numbered in the target and the source. Errors: as sew.
Sewn sewn_whole(const BothSides& both, std::span<const LoopPair> joins, const SewOptions& options,
                const Context& context);
/// The same by the faces around the seams alone. Returns nothing if these are most of both meshes,
/// if distant parts may have made a difference, and instead of an error of sewing.
/// Errors: memory_limit; cancelled.
std::optional<Sewn> sewn_piece(const BothSides& both, std::span<const LoopPair> joins,
                               const SewOptions& options, const Context& context);

/// Two meshes that are being sewn. Elements have the numbers of the unconnected mesh `both`: those
/// of the target, then those of the source.
struct SeamWork {
    const Mesh& both;
    Index first_source_vertex = 0, first_source_face = 0;
    SplitPatch patch;
    /// The vertices of each seam, in the order of the target's loop.
    std::vector<std::vector<Index>> seams;
    /// Sources of the seams' vertices.
    std::unordered_map<Index, SeamSources> sources;
    /// Vertices that are no longer used.
    std::unordered_set<Index> gone;
    SewReport report;
};

/// Sews one join with the vertices of both loops on the seam; `snap` as in SewOptions.
void sew_conforming(SeamWork& work, const LoopPair& join, double snap);

/// Sews one join with a band of new triangles in the place of the target's faces along its loop.
/// Errors: boundary_conflict if those faces do not leave one simple loop.
void sew_band(SeamWork& work, const LoopPair& join, const Context& context);

/// Returns the sources of the vertices of a seam at the given places.
SeamSources sources_of(const SeamWork& work, const LoopPair& join, const LoopPoint& on_target,
                       const LoopPoint& on_source);

/// Smooths the seams of the closed patch and makes the mesh.
Sewn finish(const SeamWork& work, const SeamFaces& faces, const SewOptions& options,
            const Context& context);

}  // namespace lissom
