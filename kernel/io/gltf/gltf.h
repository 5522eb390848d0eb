/// glTF 2.0, as text (.gltf) and binary (.glb); private to kernel/io.
///
/// gltf_document opens a file and checks it, gltf_nodes finds the objects of its scene,
/// gltf_accessor reads numbers, gltf_reader makes polygons of primitives and gltf_asset keeps the
/// rest; gltf_pool and gltf_surface lay out a surface for gltf_writer.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/saved_parts.h"

namespace lissom {

/// Reads the triangles of the default scene with node transforms applied, in the order of its
/// nodes. A node with a mesh is an object: face label "object" is its name, "material" that of the
/// primitive's material, both made unique. Vertex attributes: TEXCOORD_n as "uv", "uv2", ... with v
/// turned up, NORMAL, TANGENT, COLOR_n as "color", "color2", ..., all JOINTS_n and WEIGHTS_n as
/// "joints" and "weights", "_NAME" as "NAME", and morph targets as "morph.N.position" and so on. A
/// vertex without a value has NaN. Polygons of FB_ngon_encoding are read as such. Points and lines
/// are skipped, unless there are only points. All else is kept in the asset. Files that it refers
/// to are read from the folder of the file and nowhere else; pictures that are not there keep their
/// URI, and the report names them.
/// Errors: file_syntax, file_truncated, file_too_large, face_index; unsupported for other versions
/// of glTF, required extensions that are not known and buffers on the web; unsafe_path for buffers
/// outside the folder; file_not_found for missing buffers; cancelled.
MeshData read_gltf(const FileInput& file, const Context& context);

/// Writes a text with all data inside. One mesh for each face label "object", at the node that it
/// was read from; one primitive for each material. Vertices are split if corners differ. Polygons
/// are triangulated as FB_ngon_encoding has it, if a fan can make them. Other labels and the
/// regions stand in the extras of the meshes. Errors: not_finite naming vertices beyond the range
/// of 32-bit numbers; unsupported if these would flatten faces; file_too_large; cancelled.
void write_gltf(SavedParts& parts, const SaveOptions& options, std::string& bytes,
                const Context& context);

/// Writes as `write_gltf` does, as one binary file.
void write_glb(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context);

}  // namespace lissom
