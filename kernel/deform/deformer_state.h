/// The values that a Deformer keeps; private to kernel/deform.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/deform/constraint_edits.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/options.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/measure/region_normals.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct KeptContacts;

struct Deformer::State {
    /// Context of operations called without one.
    Context context;
    std::shared_ptr<const RestShape> rest;
    std::shared_ptr<const ConstraintSet> constraints;
    Poses poses;
    /// The last one; it serves as long as it is that of `rest` and `holds`.
    std::shared_ptr<const Preparation> preparation;
    std::shared_ptr<const DeformFrame> shown;
    /// `shown` as long as nobody else holds it: others see no change of theirs.
    DeformFrame* own = nullptr;
    FrameScratch scratch;
    /// Costs of the last preparation, and the number of preparations.
    DeformStats costs;
    /// Made at the first call; it follows from the region and its surroundings, which never change.
    std::unique_ptr<RegionNormals> normals;
    /// Made when contacts are first searched.
    std::shared_ptr<KeptContacts> contacts;

    State(const Mesh& mesh, const Region& region, const DeformOptions& options,
          const Context& given)
        : context(given),
          rest(make_rest_shape(mesh, region, options, context)),
          constraints(std::make_shared<const ConstraintSet>()) {
        show(rest_frame(*rest));
    }

    const DeformOptions& options() const { return rest->options(); }
    const Handle& handle(HandleId id) const { return handle_of(*constraints, id); }
    const HandlePose& pose(HandleId id) const {
        (void)handle(id);
        return poses.handles[at(id.value)];
    }

    /// The context that a call was given, or else that of the deformer.
    const Context& chosen(const Context& given) const {
        return &given == &own_context() ? context : given;
    }
    const std::shared_ptr<const Preparation>& prepare(const Context& given);
    void show(DeformFrame frame);
    const std::shared_ptr<const DeformFrame>& complete();

    /// Changes holds and poses by change(edit) on copies, and keeps those when it is done.
    template <typename Change>
    auto edit(const Change& change) {
        ConstraintSet next_constraints = *constraints;
        Poses next_poses = poses;
        ConstraintEdit step{*rest, next_constraints, next_poses};
        if constexpr (std::is_void_v<decltype(change(step))>) {
            change(step);
            keep(std::move(next_constraints), std::move(next_poses));
        } else {
            const auto result = change(step);
            keep(std::move(next_constraints), std::move(next_poses));
            return result;
        }
    }

  private:
    void keep(ConstraintSet next_constraints, Poses next_poses) {
        constraints = std::make_shared<const ConstraintSet>(std::move(next_constraints));
        poses = std::move(next_poses);
    }
};

/// Gives functions beside the class its values.
struct DeformerAccess {
    static Deformer::State& state(Deformer& deformer) { return *deformer.state_; }
    static const Deformer::State& state(const Deformer& deformer) { return *deformer.state_; }
};

}  // namespace lissom
