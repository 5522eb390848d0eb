/// Joins what two glTF files hold beside their surfaces; private to kernel/io and not installed.
#pragma once

#include "kernel/io/gltf/asset.h"
#include "kernel/mesh/asset.h"

namespace lissom {

/// Adds what `other` holds after what `asset` holds, with all references renumbered; its scene
/// joins the default one. Labels of `other` that mean something else in `asset` are entered in
/// `renames`.
void join_assets(GltfAsset& asset, const GltfAsset& other, LabelRenames& renames);

}  // namespace lissom
