/// Targets of picking: the objects of a scene, meshes, points.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/sketch/line_search.h"
#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/picking.h"
#include "kernel/sketch/view.h"

namespace lissom::lua {

/// Made of the options that target_options describes; held by the call.
class PickTargets {
  public:
    /// Adds the options scene=, mesh=, meshes=; meshes without faces are left out. Inside
    /// Call::attempt only.
    void read(const Call& call);
    /// Adds points of the world.
    void add_points(std::span<const Vec3> points, bool on_top);
    /// Adds the strands of scene= that may be seen within `radius` pixels of the cursor.
    void add_hair(const Call& call, const View& view, const Vec2& cursor, double radius);
    /// A hit with the numbers of the thing that scripts know.
    PickHit known(PickHit hit) const;
    /// Tells the collector about trees that were built.
    void charge(const Call& call) const;
    /// Sets the fields `object`, the name in the scene, and `mesh` of the table on top of the
    /// stack.
    void push_fields(const Call& call, Index object) const;

    const PickScene& scene() const { return scene_; }
    const std::shared_ptr<MeshObject>& mesh(Index object) const {
        return targets_[at(object)].mesh;
    }

  private:
    struct Target {
        std::string name;
        std::shared_ptr<MeshObject> mesh;
        /// For strands: the source of each line; empty for all else.
        std::vector<LineRun> runs = {};
    };

    void add_scene(const Call& call);
    void add_mesh(const Call& call, std::shared_ptr<MeshObject> mesh, std::string name = {},
                  const Affine& place = {});
    void add_lines(PolylineSet lines, std::string name, const Affine& place);
    double unit_of(const Strands& strands) const;

    PickScene scene_;
    std::vector<Target> targets_;
    std::vector<std::unique_ptr<PolylineSet>> lines_;
    std::vector<std::unique_ptr<PointSet>> points_;
};

std::vector<Parameter> target_options();

}  // namespace lissom::lua
