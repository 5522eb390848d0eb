#include "kernel/scene/file/scene_records.h"

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"

namespace lissom {

Index number_of(const ItemTable& items, const void* identity) {
    const auto found = std::find(items.begin(), items.end(), identity);
    return found == items.end() ? kNoIndex : index_of(found - items.begin());
}

// ---- From a state to records

ItemRecord& StateRecorder::put(const void* identity, ItemKind kind,
                               std::vector<PlacedRecord>& records) {
    Index number = number_of(items_, identity);
    if (number == kNoIndex) {
        number = count_of(items_);
        items_.push_back(identity);
    }
    PlacedRecord& placed = records.emplace_back();
    placed.item = number;
    placed.record.kind = kind;
    return placed.record;
}

bool StateRecorder::add(const CapturedItem& captured, std::vector<PlacedRecord>& records) {
    const SceneItem& item = *captured.item;
    const ItemContent& content = *captured.content;
    switch (item.kind()) {
        case ItemKind::mesh:
            put(item.identity(), item.kind(), records).mesh =
                record_of(dynamic_cast<const MeshContent&>(content).mesh());
            return true;
        case ItemKind::strands:
            put(item.identity(), item.kind(), records).strands =
                record_of(dynamic_cast<const StrandsContent&>(content).strands());
            return true;
        case ItemKind::polyline:
            put(item.identity(), item.kind(), records).polyline =
                dynamic_cast<const PolylineContent&>(content).polyline();
            return true;
        case ItemKind::deformation:
            return add_deformation(captured, records);
        case ItemKind::hairstyle:
            add_hairstyle(captured, records);
            return true;
    }
    return false;
}

bool StateRecorder::add_deformation(const CapturedItem& captured,
                                    std::vector<PlacedRecord>& records) {
    const auto& content = dynamic_cast<const DeformContent&>(*captured.content);
    const void* mesh_identity = captured.item->parts().front()->identity();
    const auto mesh = std::dynamic_pointer_cast<const MeshContent>(state_.find(mesh_identity));
    const DeformSnapshot snapshot = content.snapshot();
    if (region_of(*snapshot.rest).topology().get() != &mesh->topology()) return false;
    DeformRecord record = record_of(snapshot, mesh->mesh());
    record.mesh = number_of(items_, mesh_identity);
    put(captured.item->identity(), ItemKind::deformation, records).deformation = std::move(record);
    return true;
}

void StateRecorder::add_hairstyle(const CapturedItem& captured,
                                  std::vector<PlacedRecord>& records) {
    const auto& item = dynamic_cast<const HairstyleItem&>(*captured.item);
    HairstyleRecord record =
        record_of(item.style(), dynamic_cast<const HairstyleContent&>(*captured.content).inputs());
    const void* identity = item.head() ? item.head()->identity() : item.identity();
    const auto mesh = std::dynamic_pointer_cast<const MeshContent>(state_.find(identity));
    const bool in_scene = mesh && item.is_head(mesh->mesh());
    const void* key = in_scene ? identity : static_cast<const void*>(&item.style().head());
    if (number_of(items_, key) == kNoIndex) {
        put(key, ItemKind::mesh, records).mesh =
            record_of(in_scene ? mesh->mesh() : item.head_as_it_was());
    }
    record.head = number_of(items_, key);
    put(item.identity(), ItemKind::hairstyle, records).hairstyle = std::move(record);
}

// ---- From records to items

void LiveItems::take(PlacedRecord placed) {
    context_.checkpoint();
    require(placed.item >= 0 && placed.item <= count_of(items_),
            "an item of the scene has a number out of order", ErrorCode::file_syntax);
    const std::string kind(kind_name(placed.record.kind));
    at_scene_place("items/" + std::to_string(placed.item), kind, [&] {
        if (placed.item < count_of(items_)) return put_back(placed.item, placed.record);
        items_.push_back(made(placed.record));
    });
}

const std::shared_ptr<SceneItem>& LiveItems::item(Index number) const {
    require(number >= 0 && number < count_of(items_), "an object of the scene shows nothing",
            ErrorCode::file_syntax);
    return items_[at(number)];
}

const Mesh& LiveItems::mesh_at(Index number) const {
    const bool known = number >= 0 && number < count_of(items_) && meshes_[at(number)];
    require(known, "an item of the scene needs a mesh that is not there", ErrorCode::file_syntax);
    return *meshes_[at(number)];
}

std::shared_ptr<SceneItem> LiveItems::made(ItemRecord& record) {
    meshes_.resize(items_.size() + 1);
    switch (record.kind) {
        case ItemKind::mesh: {
            Mesh mesh = mesh_of(std::move(record.mesh), context_);
            meshes_.back() = std::make_shared<const Mesh>(mesh);
            return maker_.make_mesh(std::move(mesh));
        }
        case ItemKind::strands:
            return maker_.make_strands(strands_of(std::move(record.strands), context_));
        case ItemKind::polyline:
            return maker_.make_polyline(std::move(record.polyline));
        case ItemKind::deformation: {
            const Index mesh = record.deformation.mesh;
            Deformer deformer = deformer_of(std::move(record.deformation), mesh_at(mesh), context_);
            return maker_.make_deformation(std::move(deformer), items_[at(mesh)]);
        }
        case ItemKind::hairstyle: {
            const Index head = record.hairstyle.head;
            Hairstyle style = hairstyle_of(record.hairstyle, mesh_at(head), context_);
            return maker_.make_hairstyle(std::move(style), items_[at(head)]);
        }
    }
    throw Error(ErrorCode::internal, "an item of no kind");
}

void LiveItems::put_back(Index number, ItemRecord& record) {
    SceneItem& item = *items_[at(number)];
    require(item.kind() == record.kind, "an item of the scene changes its kind",
            ErrorCode::file_syntax);
    ContentStore store;
    switch (record.kind) {
        case ItemKind::mesh: {
            auto& known = meshes_[at(number)];
            known = std::make_shared<const Mesh>(
                mesh_of(std::move(record.mesh), context_, known->shared_topology()));
            return item.restore(MeshContent(*known, nullptr, false, store), nullptr);
        }
        case ItemKind::strands:
            return item.restore(
                StrandsContent(strands_of(std::move(record.strands), context_), nullptr, store),
                nullptr);
        case ItemKind::polyline:
            return item.restore(PolylineContent(record.polyline, store), nullptr);
        case ItemKind::deformation: {
            const auto& deformer = dynamic_cast<const DeformItem&>(item).deformer();
            DeformSnapshot snapshot = snapshot_of(std::move(record.deformation), deformer);
            return item.restore(DeformContent(std::move(snapshot), store), nullptr);
        }
        case ItemKind::hairstyle: {
            const auto& style = dynamic_cast<const HairstyleItem&>(item).style();
            return item.restore(HairstyleContent(style, inputs_of(record.hairstyle), store),
                                nullptr);
        }
    }
}

}  // namespace lissom
