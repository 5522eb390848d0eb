/// Interface of an asset to the morph targets of objects.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/asset.h"

namespace lissom {

/// A morph target. If a file gives it no name it is called "target N" by its number, from 1.
struct MorphTarget {
    std::string name;
    /// Weight of the target at rest.
    double weight = 0.0;
    bool is_named = false;
};

/// An Asset that knows morph targets is a MorphAsset as well; found by dynamic_cast.
class MorphAsset {
  public:
    /// Returns the targets, in the order of their numbers, that the faces with the label `object`
    /// have by the names and weights in the asset; there may be more, which it does not describe.
    virtual std::vector<MorphTarget> morphs_of(std::string_view object) const = 0;
    /// Returns the asset in which every object has these targets, paired with its own by name;
    /// their weights are its own, or else those given, and animations of weights follow. Null if
    /// nothing differs.
    virtual std::shared_ptr<const Asset> with_morphs(const std::vector<MorphTarget>& all) const = 0;

  protected:
    ~MorphAsset() = default;
};

/// Returns the name of a target that has none in the file.
std::string morph_call_name(Index number);

/// For each of an object's own targets, the place in `all` of the one with its name: of the second
/// with that name the second, and so on. kNoIndex if there is none.
std::vector<Index> morph_places(const std::vector<MorphTarget>& own,
                                const std::vector<MorphTarget>& all);

}  // namespace lissom
