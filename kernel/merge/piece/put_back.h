/// Pieces of meshes that are worked on instead of the whole, so that the cost of a seam depends on
/// the seam and not on distant parts; private to kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/piece/places.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Returns two meshes as one, not connected. Texture coordinates and tangents of vertices are made
/// those of corners, since two charts that meet must not be averaged.
Mesh unconnected(const Mesh& target, const Mesh& source, const Context& context);

/// Returns the given faces, those within `rings` rings of them, and all that lie nearer to one of
/// them in space than half its size. Returns nothing if that is more than half of the mesh: a piece
/// would gain nothing.
std::optional<MeshPart> piece_around(const Mesh& mesh, std::span<const Index> faces, Index rings,
                                     const Context& context);

/// Result of the work on a piece.
struct PieceWork {
    const Mesh& mesh;
    /// The elements of the piece in whose place those of `mesh` stand.
    const Places& place;
    /// Elements without a place follow those of the whole: the ones before these at the end of its
    /// target, the others at its end.
    Index first_source_vertex = 0, first_source_face = 0;
};

/// Numbers of the target's elements in a whole, which come first.
struct TargetCounts {
    Index vertices = 0, faces = 0;
};

/// Returns if the surface within three rings of the piece's cut is unchanged to the bit: then the
/// work on the piece equals work on the whole.
bool keeps_rim(const Mesh& whole, const MeshPart& piece, const PieceWork& work);

/// The whole with the result of its piece.
struct PutBack {
    Mesh mesh;
    /// For each element that of the whole, or, counted from the number of those on, that of the
    /// work which it is.
    std::vector<Index> vertices, faces;
    Index first_source_vertex = 0;

    /// For each element of the work its number here.
    std::vector<Index> numbers_of_work(Index whole_count, Index work_count) const;
};

/// In the order that the same work on the whole would have left. The piece must have kept its rim:
/// edges are not checked again. Errors: as `spliced`.
PutBack put_back(const Mesh& whole, const TargetCounts& target, const MeshPart& piece,
                 const PieceWork& work, const Context& context);

/// Returns the origin of the elements: those of the whole as `whole_map` says, or from themselves
/// if it is null, those of the work as `work_map` does.
MeshMap put_back_map(const PutBack& made, const Topology& whole, const MeshMap* whole_map,
                     const Mesh& work, const MeshMap& work_map);

}  // namespace lissom
