/// Interface of an asset to its skins.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

/// The joints of a skin, an entry of each list for each.
struct Skeleton {
    std::vector<std::string> names;
    /// The nearest joint above each, or kNoIndex.
    std::vector<Index> parents;
    /// From the coordinates of a joint to those of the mesh, as the skin was bound.
    std::vector<Affine> bind;
    /// From the coordinates of a joint to those of its parent, or to the mesh's, as the file poses
    /// it.
    std::vector<Affine> rest;
};

/// An Asset that knows joints is a SkinnedAsset as well; found by dynamic_cast.
class SkinnedAsset {
  public:
    /// Names of the joints that the numbers in "joints" stand for on the faces with the label
    /// `object`, in their order; empty if that object has no skin. A joint without a name is called
    /// by its place in the file.
    virtual std::vector<std::string> joints_of(std::string_view object) const = 0;
    /// The skeleton of these joints; empty if the object has no skin.
    virtual Skeleton skeleton_of(std::string_view object) const = 0;

  protected:
    ~SkinnedAsset() = default;
};

}  // namespace lissom
