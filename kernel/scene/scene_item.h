/// SceneItem: an object as a scene knows it: a live thing that others hold and change, whose
/// content can be captured, and put back into the same thing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/scene/content_store.h"

namespace lissom {

/// Kinds of objects of a scene.
enum class ItemKind { mesh, deformation, strands, hairstyle, polyline };

/// Returns the name of a kind in scripts and files: "mesh".
std::string_view kind_name(ItemKind kind);

/// The content of an item at one time: immutable, and shared by all states of the scene between two
/// changes.
class ItemContent {
  public:
    ItemContent(const ItemContent&) = delete;
    ItemContent& operator=(const ItemContent&) = delete;
    virtual ~ItemContent();
    /// Returns a hash, the same on every run and platform; equal contents have equal hashes.
    /// Computed when first asked for.
    std::uint64_t hash() const;
    /// Adds all that counts bytes.
    virtual void list_kept(std::vector<const KeptBytes*>& list) const = 0;

  protected:
    ItemContent() = default;
    virtual std::uint64_t compute_hash() const = 0;
    /// Charges the account for the content's own struct, texts and lists of blocks, which
    /// `list_kept` does not have.
    void count_own(const ContentStore& store, std::size_t bytes);

  private:
    MemoryCharge own_;
    mutable std::once_flag hashed_;
    mutable std::uint64_t hash_ = 0;
};

class SceneItem {
  public:
    SceneItem(const SceneItem&) = delete;
    SceneItem& operator=(const SceneItem&) = delete;
    virtual ~SceneItem();
    virtual ItemKind kind() const = 0;
    /// Returns the live thing: two items of one thing are captured once.
    virtual const void* identity() const = 0;
    /// Items that change along with it, and are captured and put back before it: the mesh of a
    /// deformation.
    virtual std::vector<std::shared_ptr<SceneItem>> parts() const { return {}; }
    /// Returns the content now: `last` itself if nothing has changed since its capture, else a
    /// content that shares with it all equal parts. `last` may be null.
    virtual std::shared_ptr<const ItemContent> capture(
        const std::shared_ptr<const ItemContent>& last, ContentStore& store) const = 0;
    /// Puts a content of this item back into the live thing, to the bit. `present` is the content
    /// of the thing now, or null if that is not known. After an error nothing has changed.
    virtual void restore(const ItemContent& content, const ItemContent* present) = 0;
    /// Returns the bytes of the live thing, about, beside those shared with its contents.
    virtual std::size_t memory_bytes() const = 0;

  protected:
    SceneItem() = default;
};

}  // namespace lissom
