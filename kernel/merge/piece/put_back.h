/// Pieces of meshes that are worked on in place of the whole, so that what a seam costs depends on
/// the seam and not on what lies far from it; private to kernel/merge.
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

/// Two meshes as one, not connected. Texture coordinates and tangents of vertices are made those of
/// corners, since two charts must not be averaged where they meet.
Mesh unconnected(const Mesh& target, const Mesh& source, const Context& context);

/// The given faces, those within `rings` rings of them, and all that lie nearer to one of them in
/// space than half its size. Nothing where that is more than half of the mesh: a piece would gain
/// nothing.
std::optional<MeshPart> piece_around(const Mesh& mesh, std::span<const Index> faces, Index rings,
                                     const Context& context);

/// What became of a piece.
struct PieceWork {
    const Mesh& mesh;
    /// The elements of the piece in whose place those of `mesh` stand.
    const Places& place;
    /// Elements without a place follow those of the whole: the ones before these where its target
    /// ends, the others at its end.
    Index first_source_vertex = 0, first_source_face = 0;
};

/// How many elements of a whole are the target's, which come first.
struct TargetCounts {
    Index vertices = 0, faces = 0;
};

/// Whether all that lies within three rings of where the piece was taken out is as it was, to the
/// bit: then what was done to the piece is what would have been done to the whole.
bool keeps_rim(const Mesh& whole, const MeshPart& piece, const PieceWork& work);

/// The whole with what became of its piece.
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

/// Where the elements come from: those of the whole as `whole_map` says, or from themselves where
/// it is null, those of the work as `work_map` does.
MeshMap put_back_map(const PutBack& made, const Topology& whole, const MeshMap* whole_map,
                     const Mesh& work, const MeshMap& work_map);

}  // namespace lissom
