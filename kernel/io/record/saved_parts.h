/// SavedParts: keeps account of the parts of a mesh that a writer takes, so that the rest can be
/// named; private to kernel/io.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/asset.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// A mesh as a writer sees it: taken parts count as saved, and the rest is lost.
class SavedParts {
  public:
    /// Errors: invalid_argument if an attribute or label does not fit the mesh.
    explicit SavedParts(const Mesh& mesh);

    const Mesh& mesh() const { return mesh_; }

    /// Returns the attribute called `name` if it is in one of `domains` and has one of `widths`,
    /// else null.
    const Attribute* take(std::string_view name, std::initializer_list<Domain> domains,
                          std::initializer_list<Index> widths);
    void take(const Attribute& attribute) { taken_attributes_.insert(attribute.name); }
    /// Returns the labels of a kind, or null.
    const FaceLabels* take_labels(std::string_view kind);
    const std::vector<std::string>& take_material_libraries();
    /// Makes these the material libraries that a writer takes, in place of those of the mesh.
    /// `have_asset`: the materials of the asset are in them.
    void replace_material_libraries(std::vector<std::string> names, bool have_asset);
    const std::map<std::string, Region, std::less<>>& take_regions();
    /// Returns the contents of the mesh beside its surface, or null.
    const std::shared_ptr<const Asset>& take_asset();

    /// Logs a warning that names the parts that were not taken, if there are any.
    void log_losses(std::string_view format, const Context& context) const;

  private:
    const Mesh& mesh_;
    std::set<std::string, std::less<>> taken_attributes_, taken_labels_;
    std::optional<std::vector<std::string>> libraries_;
    bool libraries_have_asset_ = false;
    bool libraries_taken_ = false, regions_taken_ = false, asset_taken_ = false;
};

}  // namespace lissom
