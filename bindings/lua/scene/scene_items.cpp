// The objects of scripts as items of a scene.
#include <cstring>
#include <type_traits>
#include <utility>

#include "bindings/lua/deform/deform_object.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/scene/polyline_object.h"
#include "bindings/lua/scene/scene_object.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"

namespace lissom::lua {
namespace {

class MeshObjectItem : public MeshItem, public ScriptItem {
  public:
    explicit MeshObjectItem(std::shared_ptr<MeshObject> object)
        : MeshItem(std::shared_ptr<Mesh>(object, &object->mesh)), object_(std::move(object)) {}

    int push(Call& call) const override { return call.push_shared(object_); }
    std::shared_ptr<MeshObject> surface() const override { return object_; }

  private:
    void restored() override {
        object_->closed = false;
        object_->changed();
    }

    std::shared_ptr<MeshObject> object_;
};

// The scene keeps an object that a script closes, and gives it back.
template <typename Item, typename Object>
class ContentItem : public Item, public ScriptItem {
  public:
    template <typename... Parts>
    explicit ContentItem(std::shared_ptr<Object> object, Parts... parts)
        : Item(object->content, std::move(parts)...),
          object_(std::move(object)),
          content_(object_->content) {}

    int push(Call& call) const override {
        object_->content = content_;
        return call.push_shared(object_);
    }
    std::shared_ptr<MeshObject> surface() const override {
        if constexpr (std::is_same_v<Object, DeformObject>) return object_->mesh;
        return nullptr;
    }

  private:
    void restored() override { object_->content = content_; }

    std::shared_ptr<Object> object_;
    decltype(Object::content) content_;
};

class StrandsObjectItem : public StrandsItem, public ScriptItem {
  public:
    explicit StrandsObjectItem(std::shared_ptr<StrandsObject> object)
        : StrandsItem(std::shared_ptr<Strands>(object, &object->strands)),
          object_(std::move(object)) {}

    int push(Call& call) const override { return call.push_shared(object_); }

  private:
    std::shared_ptr<StrandsObject> object_;
};

class PolylineObjectItem : public PolylineItem, public ScriptItem {
  public:
    explicit PolylineObjectItem(std::shared_ptr<PolylineObject> object)
        : PolylineItem(std::shared_ptr<Polyline>(object, &object->polyline)),
          object_(std::move(object)) {}

    int push(Call& call) const override { return call.push_shared(object_); }

  private:
    std::shared_ptr<PolylineObject> object_;
};

// ---- Items of objects

template <typename Item, typename Object>
std::shared_ptr<SceneItem> item_of(std::shared_ptr<void> object) {
    return std::make_shared<Item>(std::static_pointer_cast<Object>(std::move(object)));
}

std::shared_ptr<SceneItem> deformation_item(std::shared_ptr<void> object) {
    auto edit = std::static_pointer_cast<DeformObject>(std::move(object));
    (void)edit->deformer();
    auto mesh = std::make_shared<MeshObjectItem>(edit->mesh);
    return std::make_shared<ContentItem<DeformItem, DeformObject>>(
        std::move(edit), std::shared_ptr<SceneItem>(std::move(mesh)));
}

std::shared_ptr<SceneItem> hairstyle_item(std::shared_ptr<void> object) {
    auto style = std::static_pointer_cast<HairstyleObject>(std::move(object));
    (void)style->style();
    auto head = std::make_shared<MeshObjectItem>(style->head);
    return std::make_shared<ContentItem<HairstyleItem, HairstyleObject>>(
        std::move(style), std::shared_ptr<SceneItem>(std::move(head)));
}

class ScriptItemMaker : public ItemMaker {
  public:
    std::shared_ptr<SceneItem> make_mesh(Mesh mesh) override {
        return std::make_shared<MeshObjectItem>(std::make_shared<MeshObject>(std::move(mesh)));
    }
    std::shared_ptr<SceneItem> make_strands(Strands strands) override {
        return std::make_shared<StrandsObjectItem>(
            std::make_shared<StrandsObject>(std::move(strands)));
    }
    std::shared_ptr<SceneItem> make_polyline(Polyline polyline) override {
        return std::make_shared<PolylineObjectItem>(
            std::make_shared<PolylineObject>(std::move(polyline)));
    }
    std::shared_ptr<SceneItem> make_deformation(Deformer deformer,
                                                const std::shared_ptr<SceneItem>& mesh) override {
        return deformation_item(
            std::make_shared<DeformObject>(object_of(*mesh), std::move(deformer)));
    }
    std::shared_ptr<SceneItem> make_hairstyle(Hairstyle style,
                                              const std::shared_ptr<SceneItem>& head) override {
        return hairstyle_item(
            std::make_shared<HairstyleObject>(object_of(*head), std::move(style)));
    }

  private:
    static std::shared_ptr<MeshObject> object_of(const SceneItem& mesh) {
        return dynamic_cast<const MeshObjectItem&>(mesh).surface();
    }
};

struct ItemType {
    const char* name;
    const char* argument;
    const char* help;
    std::shared_ptr<SceneItem> (*make)(std::shared_ptr<void>);
};

constexpr ItemType kItemTypes[] = {
    {MeshObject::kTypeName, "mesh", "A mesh.", item_of<MeshObjectItem, MeshObject>},
    {DeformObject::kTypeName, "deformer", "A deformer, with its mesh.", deformation_item},
    {StrandsObject::kTypeName, "strands", "Hair.", item_of<StrandsObjectItem, StrandsObject>},
    {HairstyleObject::kTypeName, "style", "A hairstyle with its curves.", hairstyle_item},
    {PolylineObject::kTypeName, "line", "A free curve.",
     item_of<PolylineObjectItem, PolylineObject>},
};

const ItemType& type_of(const Holder& holder) {
    for (const ItemType& type : kItemTypes) {
        if (std::strcmp(type.name, holder.type_name) == 0) return type;
    }
    throw Error(ErrorCode::internal, std::string("a scene holds no ") + holder.type_name);
}

}  // namespace

Parameter item_argument(std::string name, std::string help) {
    std::vector<Parameter> alternatives;
    for (const ItemType& type : kItemTypes) {
        alternatives.push_back(object(type.argument, type.name, type.help));
    }
    return either(std::move(name), std::move(alternatives), std::move(help));
}

std::unique_ptr<ItemMaker> script_item_maker() {
    return std::make_unique<ScriptItemMaker>();
}

ItemArgument ItemArgument::read(const Call& call, int index) {
    return {find_holder(call.lua(), index, nullptr), index};
}

std::shared_ptr<SceneItem> ItemArgument::item() const {
    return type_of(*holder).make(holder->object.shared());
}

void ItemArgument::remember(const Call& call) const {
    call.push_argument(index);
    call.remember(holder->object.get());
    lua_pop(call.lua(), 1);
}

}  // namespace lissom::lua
