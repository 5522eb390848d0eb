/// Asset: contents of a file beside surfaces (materials, textures, nodes, skins, animations), kept
/// untouched so that it can be saved again.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "kernel/core/context.h"
#include "kernel/core/memory_hold.h"

namespace lissom {

/// New names for labels of an appended mesh that mean something else in the mesh it joins:
/// by kind of label ("object", "material") and old name.
using LabelRenames = std::map<std::string, std::map<std::string, std::string>, std::less<>>;

/// Immutable and shared by the meshes that were made from one another. Faces refer to it by the
/// names of their labels "object" and "material". Made and understood by one format of kernel/io.
class Asset {
  public:
    virtual ~Asset();
    Asset& operator=(const Asset&) = delete;
    /// Returns this asset joined with `other`; names of `other` with another meaning here are
    /// replaced and entered in `renames`.
    virtual std::shared_ptr<const Asset> joined(const Asset& other,
                                                LabelRenames& renames) const = 0;
    virtual std::size_t memory_bytes() const = 0;
    /// Charges `account` from now on, once for any number of meshes that share it; nothing if it is
    /// charged already. Meshes call it with theirs. Errors: memory_limit.
    void count_on(const std::shared_ptr<MemoryAccount>& account) const;
    /// Returns true if it holds only the definitions of the mesh's material libraries.
    virtual bool is_of_libraries() const { return false; }

  protected:
    Asset() = default;
    /// A copy is to be changed: it counts when a mesh has it.
    Asset(const Asset&) {}

  private:
    mutable MemoryHold hold_;
};

}  // namespace lissom
