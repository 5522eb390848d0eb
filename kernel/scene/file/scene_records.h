/// A scene as records, and records as live objects: the common part of scenes and their histories;
/// private to kernel/scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/scene/file/describe_items.h"
#include "kernel/scene/file/item_records.h"
#include "kernel/scene/polyline.h"
#include "kernel/scene/scene_file.h"
#include "kernel/scene/scene_item.h"
#include "kernel/scene/scene_state.h"

namespace lissom {

/// The content of an item, of one of the kinds.
struct ItemRecord {
    ItemKind kind = ItemKind::mesh;
    /// The object that shows it, for names of files.
    std::string label;
    MeshRecord mesh;
    DeformRecord deformation;
    StrandsRecord strands;
    HairstyleRecord hairstyle;
    Polyline polyline;
};

inline std::string label_of(const ItemRecord& item) {
    return item.label;
}

template <typename Archive>
void describe(Archive& a, ItemRecord& item) {
    static constexpr const char* kKinds[] = {"mesh", "deformation", "strands", "hairstyle",
                                             "polyline"};
    a.choice("kind", item.kind, kKinds);
    switch (item.kind) {
        case ItemKind::mesh:
            return describe(a, item.mesh);
        case ItemKind::deformation:
            return describe(a, item.deformation);
        case ItemKind::strands:
            return describe(a, item.strands);
        case ItemKind::hairstyle:
            return describe(a, item.hairstyle);
        case ItemKind::polyline:
            return describe(a, item.polyline);
    }
}

/// The content that item `item` of the file has.
struct PlacedRecord {
    Index item = 0;
    ItemRecord record;
};

/// Items of a file: their numbers are the places of their identities.
using ItemTable = std::vector<const void*>;
/// Returns kNoIndex if the file does not have it.
Index number_of(const ItemTable& items, const void* identity);

/// Records the contents of one state.
class StateRecorder {
  public:
    /// Items that are new get a number behind those of `items`.
    StateRecorder(const SceneState& state, ItemTable& items) : state_(state), items_(items) {}

    /// Adds the record of an item, and before it that of a head that is no object, or not in the
    /// shape that its hairstyle knows. False for a deformation whose mesh has another topology by
    /// now: that has no place in a file.
    bool add(const CapturedItem& captured, std::vector<PlacedRecord>& records);

  private:
    ItemRecord& put(const void* identity, ItemKind kind, std::vector<PlacedRecord>& records);
    bool add_deformation(const CapturedItem& captured, std::vector<PlacedRecord>& records);
    void add_hairstyle(const CapturedItem& captured, std::vector<PlacedRecord>& records);

    const SceneState& state_;
    ItemTable& items_;
};

/// Runs `action`; the messages of its errors begin with a place in the scene's text, and who is
/// there.
template <typename Action>
void at_scene_place(const std::string& path, const std::string& name, const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) throw;
        throw Error(error.code(), "the scene's '" + path + "' (" + name + "): " + error.message(),
                    error.elements());
    }
}

/// Objects made from records, which take the contents of later ones.
class LiveItems {
  public:
    LiveItems(ItemMaker& maker, const Context& context) : maker_(maker), context_(context) {}

    /// Makes the next item, or puts a content into one that is there. Errors: file_syntax; those of
    /// the objects.
    void take(PlacedRecord placed);
    /// Errors: file_syntax if there is none.
    const std::shared_ptr<SceneItem>& item(Index number) const;

  private:
    std::shared_ptr<SceneItem> made(ItemRecord& record);
    void put_back(Index number, ItemRecord& record);
    const Mesh& mesh_at(Index number) const;

    ItemMaker& maker_;
    const Context& context_;
    std::vector<std::shared_ptr<SceneItem>> items_;
    // Present mesh of each item; null for other kinds.
    std::vector<std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace lissom
