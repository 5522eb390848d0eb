/// GltfAsset: contents of a glTF file beside its surface; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/io/gltf/file/accessor.h"
#include "kernel/io/gltf/file/document.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/uri.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/mesh/asset.h"
#include "kernel/mesh/morph_asset.h"
#include "kernel/mesh/report.h"
#include "kernel/mesh/skinned_asset.h"

namespace lissom {

/// Numbers that skins and animations refer to: the description without place, and the bytes.
struct KeptAccessor {
    Json json;
    SharedBytes bytes;
};

/// The document without buffers, buffer views and accessors. Primitives keep only their material,
/// extras and extensions. Accessors that skins and animations name by number are those of
/// `accessors`.
class GltfAsset : public Asset, public SkinnedAsset, public MorphAsset {
  public:
    Json json = Json::object();
    std::vector<KeptAccessor> accessors;
    /// Content of each image; null for missing ones, which keep their URI.
    std::vector<SharedBytes> images;
    /// The node that each label "object" stands for, and the material of each label "material".
    std::map<std::string, std::size_t> node_of_object, material_of_label;
    bool from_libraries = false;
    /// Morph targets of objects without a node.
    std::vector<MorphTarget> new_morphs;
    /// The same in assets that differ by morph targets only.
    std::shared_ptr<const int> origin = std::make_shared<const int>(0);

    std::shared_ptr<const Asset> joined(const Asset& other, LabelRenames& renames) const override;
    std::size_t memory_bytes() const override;
    bool is_of_libraries() const override { return from_libraries; }
    std::vector<std::string> joints_of(std::string_view object) const override;
    Skeleton skeleton_of(std::string_view object) const override;
    std::vector<MorphTarget> morphs_of(std::string_view object) const override;
    std::shared_ptr<const Asset> with_morphs(const std::vector<MorphTarget>& all) const override;
};

/// Keeps the rest of a document after its surface was read; `document` is used up. Errors:
/// file_syntax and file_too_large for accessors that cannot be kept.
std::shared_ptr<const GltfAsset> keep_asset(GltfDocument& document, const AccessorReader& accessors,
                                            const std::vector<GltfInstance>& instances,
                                            const std::vector<std::string>& materials,
                                            Report& report);

}  // namespace lissom
