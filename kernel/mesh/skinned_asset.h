/// Interface of an asset to its skins.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lissom {

/// An Asset that knows joints is a SkinnedAsset as well; found by dynamic_cast.
class SkinnedAsset {
  public:
    /// Names of the joints that the numbers in "joints" stand for on the faces with the label
    /// `object`, in their order; empty if that object has no skin. A joint without a name is called
    /// by its place in the file.
    virtual std::vector<std::string> joints_of(std::string_view object) const = 0;

  protected:
    ~SkinnedAsset() = default;
};

}  // namespace lissom
