/// Hair in PLY files; private to kernel/io.
///
/// The points of all strands are the vertices: x y z, and if there are such red green blue [alpha]
/// (integers scaled to 0..1; linear colours, alpha is opacity), "thickness" (the width), and
/// "transparency". Strands are told in one of three ways, of which the first counts that is there:
///
/// - an element "strand" or "polyline" with a list vertex_indices or vertex_index, root first;
/// - an element "strand" with "nsegs": the vertices follow one another, nsegs + 1 a strand
///   (hairutil);
/// - an element "edge" with vertex1 and vertex2, as Open3D, HairStep and Blender write it.
///
/// Numbers of strands are root_u root_v, root_face, root_weight_0 to _2 and root_vertex_0 to _2,
/// id, guide, guide_arc, and group, whose names are in comments of the header (PlyHeader).
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/record/file_hair.h"

namespace lissom {

/// Reads hair from text and binary of both byte orders. Edges may come in any order; the end of a
/// strand with the lower number is its root, and vertices without edges are left out, with a
/// warning of the log, which also names numbers without a place. Errors: file_syntax,
/// file_truncated, file_too_large, face_index; unsupported for points alone and for surfaces;
/// not_finite naming the strand; cancelled.
FileHair read_ply_strands(std::string_view bytes, const Context& context);

/// Writes binary data, little-endian, with the elements vertex, strand and edge. Nothing is lost
/// but profiles of widths, which become widths of the points. Colours are bytes if that loses
/// nothing, else floats.
void write_ply_strands(const Strands& strands, std::string& bytes, const Context& context);

}  // namespace lissom
