/// Scenes of a script, and its objects as the items of one.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bindings/lua/core/call.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/scene_file.h"

namespace lissom::lua {

struct SceneObject {
    static constexpr const char* kTypeName = "lissom.Scene";
    /// The first state, the accounts and the first block of the list of steps.
    static constexpr std::size_t kBytesBeside = 1024;

    explicit SceneObject(const SceneOptions& options) : scene(options) {}

    Scene scene;
    /// Depth of the innermost scene:step whose function runs now: it ends the steps that it opened.
    std::size_t step_depth = 0;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return scene.history_bytes(); }
};

/// An item whose object scripts hold.
class ScriptItem {
  public:
    virtual ~ScriptItem() = default;
    /// Pushes the object, the same userdata as long as a script holds it.
    virtual int push(Call& call) const = 0;
    /// The mesh that it is, or that it deforms; null for others.
    virtual std::shared_ptr<MeshObject> surface() const { return nullptr; }
};

/// The argument that an object of a scene is given by.
Parameter item_argument(std::string name, std::string help);

/// The object given by the argument `path` at stack index `index`; read in step 1.
struct ItemArgument {
    Holder* holder;
    int index;

    static ItemArgument read(const Call& call, int index);
    /// Inside Call::attempt only.
    std::shared_ptr<SceneItem> item() const;
    /// Lets scene:get find the userdata of the argument again.
    void remember(const Call& call) const;
};

/// Makes objects of scripts for a scene that is loaded.
std::unique_ptr<ItemMaker> script_item_maker();

/// Returns the option history= of functions that make a scene.
Parameter history_option();
/// scene:save, scene:parameters, scene:set_parameters and lissom.load_scene.
std::vector<Function> scene_file_methods();
Function load_scene_function();

/// Options transform=, visible=, style={...} of an object in a scene.
std::vector<Parameter> look_fields();
/// Returns `look` with the options of the call. Inside Call::attempt only.
ObjectLook changed_look(const Call& call, ObjectLook look);
/// Pushes a lissom.SceneEntry.
int push_entry(const Call& call, const NamedObject& object);

}  // namespace lissom::lua
