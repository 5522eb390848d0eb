// The objects of scripts as items of a scene.
#include <cstring>
#include <utility>

#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/scene/scene_object.h"
#include "kernel/scene/mesh_item.h"

namespace lissom::lua {
namespace {

class MeshObjectItem : public MeshItem, public ScriptItem {
  public:
    explicit MeshObjectItem(std::shared_ptr<MeshObject> object)
        : MeshItem(std::shared_ptr<Mesh>(object, &object->mesh)), object_(std::move(object)) {}

    int push(Call& call) const override { return call.push_shared(object_); }

  private:
    void restored() override {
        object_->closed = false;
        object_->changed();
    }

    std::shared_ptr<MeshObject> object_;
};

std::shared_ptr<SceneItem> mesh_item(std::shared_ptr<void> object) {
    return std::make_shared<MeshObjectItem>(
        std::static_pointer_cast<MeshObject>(std::move(object)));
}

struct ItemType {
    const char* name;
    const char* argument;
    const char* help;
    std::shared_ptr<SceneItem> (*make)(std::shared_ptr<void>);
};

constexpr ItemType kItemTypes[] = {
    {MeshObject::kTypeName, "mesh", "A mesh.", mesh_item},
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
    if (alternatives.size() == 1) return object(std::move(name), alternatives[0].type_name, help);
    return either(std::move(name), std::move(alternatives), std::move(help));
}

ItemArgument ItemArgument::read(const Call& call, int index) {
    return {find_holder(call.lua(), index, nullptr), index};
}

std::shared_ptr<SceneItem> ItemArgument::item() const {
    return type_of(*holder).make(holder->object);
}

void ItemArgument::remember(const Call& call) const {
    call.push_argument(index);
    call.remember(holder->object.get());
    lua_pop(call.lua(), 1);
}

}  // namespace lissom::lua
