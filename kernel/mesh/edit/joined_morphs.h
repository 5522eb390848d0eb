/// The morph targets of two meshes that become one: paired by name. Private to the kernel.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/mesh/asset.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/morph_asset.h"

namespace lissom {

/// Returns the targets of `mesh`, then those of `other` whose names it does not have. Targets
/// without names are paired by their numbers.
std::vector<MorphTarget> joined_morphs(const Mesh& mesh, const Mesh& other);

/// Returns the mesh with its "morph.N" attributes numbered by the places of their targets in `all`;
/// nothing if they have these numbers.
std::optional<Mesh> with_morph_numbers(const Mesh& mesh, const std::vector<MorphTarget>& all);

/// Returns the asset with these targets: `asset` itself if nothing differs, or if it is null.
std::shared_ptr<const Asset> with_morphs(const std::shared_ptr<const Asset>& asset,
                                         const std::vector<MorphTarget>& all);

/// Names the targets whose weights at rest differ in two meshes that become one surface, on which
/// the weight of the first counts; one text each.
std::vector<std::string> morph_conflicts(const Mesh& mesh, const Mesh& other);

}  // namespace lissom
