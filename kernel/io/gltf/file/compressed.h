/// Decompresses the buffer views and primitives of a glTF document; private to kernel/io and not
/// installed.
#pragma once

#include "kernel/core/context.h"
#include "kernel/io/gltf/file/document.h"

namespace lissom {

/// Replaces compressed buffer views (EXT_meshopt_compression, KHR_meshopt_compression) and
/// primitives (KHR_draco_mesh_compression) by plain ones, whose bytes become buffers of the
/// document. Plain data that the file holds as well is taken as it is. Call it before the document
/// is parsed. Errors: those of `decode_meshopt` and `decode_draco`; memory_limit; cancelled.
void decompress(GltfDocument& document, const Context& context);

}  // namespace lissom
