#include "viewer/lua/shown_values.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "bindings/lua/core/object.h"
#include "bindings/lua/core/state.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/scene/scene_object.h"
#include "kernel/hair/strands/strand_place.h"
#include "viewer/render/draw/scene_drawing.h"

namespace lissom::lua {
namespace {

// Tables within tables that are looked into.
constexpr int kDeepest = 4;

class ValueReader {
  public:
    explicit ValueReader(lua_State* L) : L_(L) {}

    void add(int index, int depth = 0) {
        if (!seen_.insert(lua_topointer(L_, index)).second) return;
        if (lua_istable(L_, index) && depth < kDeepest) return add_fields(index, depth);
        const Type* type = find_type(L_, index);
        if (!type) return;
        auto* holder = static_cast<Holder*>(lua_touserdata(L_, index));
        if (type->name == MeshObject::kTypeName) add_mesh(Ref<MeshObject>(holder));
        if (type->name == StrandsObject::kTypeName) add_strands(Ref<StrandsObject>(holder));
        if (type->name == SceneObject::kTypeName) add_scene(Ref<SceneObject>(holder));
    }

    Picture picture() && {
        for (PictureStrands& strands : picture_.strands) place(strands);
        for (DrawnStrands& strands : placed_) {
            picture_.strands.push_back({std::move(strands), std::nullopt});
        }
        return std::move(picture_);
    }

  private:
    void add_fields(int table, int depth) {
        if (!lua_checkstack(L_, 4)) return;
        const int index = lua_gettop(L_);
        lua_pushnil(L_);
        while (lua_next(L_, table)) {
            add(index + 2, depth + 1);
            lua_pop(L_, 1);
        }
    }

    void add_mesh(const Ref<MeshObject>& object) {
        if (!object.get() || object->mesh.face_count() == 0) return;
        const std::shared_ptr<MeshObject> owner = object.share();
        picture_.meshes.push_back({{owner, &owner->mesh}});
    }

    void add_strands(const Ref<StrandsObject>& object) {
        if (!object.get()) return;
        const std::shared_ptr<StrandsObject> owner = object.share();
        picture_.strands.push_back({{{owner, &owner->strands}, {}, {}}, std::nullopt});
    }

    void add_scene(const Ref<SceneObject>& object) {
        if (!object.get()) return;
        SceneDrawing drawing = drawing_of(object->scene.objects());
        for (DrawnMesh& mesh : drawing.meshes) picture_.meshes.push_back(std::move(mesh));
        for (DrawnStrands& strands : drawing.strands) placed_.push_back(std::move(strands));
        for (DrawnLine& line : drawing.lines) picture_.marks.lines.push_back(std::move(line));
        for (const DrawnPoint& point : drawing.points) picture_.marks.points.push_back(point);
        picture_.field_marks = std::move(drawing.field);
    }

    void place(PictureStrands& strands) const {
        if (picture_.meshes.empty()) return;
        strands.mesh = 0;
        const auto unit = unit_of_roots(*strands.drawn.strands, *picture_.meshes[0].mesh);
        if (unit) strands.drawn.style.unit = *unit;
    }

    lua_State* L_;
    std::set<const void*> seen_;
    Picture picture_;
    // Strands that are in their place already.
    std::vector<DrawnStrands> placed_;
};

}  // namespace

Picture picture_of_values(lua_State* L, int first, int last) {
    ValueReader reader(L);
    for (int i = first; i <= last; ++i) reader.add(i);
    return std::move(reader).picture();
}

}  // namespace lissom::lua
