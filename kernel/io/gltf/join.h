/// Joins the assets of two glTF files; private to kernel/io and not installed.
#pragma once

#include "kernel/io/gltf/asset.h"
#include "kernel/mesh/asset.h"

namespace lissom {

/// Appends the contents of `other` to those of `asset`, with all references renumbered; its scene
/// joins the default one. Labels of `other` that mean something else in `asset` are entered in
/// `renames`.
void join_assets(GltfAsset& asset, const GltfAsset& other, LabelRenames& renames);

}  // namespace lissom
