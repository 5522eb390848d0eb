/// Skinning: a sequence of shapes of one mesh becomes joints, weights and an animation of the
/// joints, which a glTF file holds as an ordinary skin.
///
///     SkinBaker baker(mesh, deformer.region(), {.joints = 12});
///     for (...) {
///         deformer.solve();
///         deformer.apply_to(shape);
///         baker.add(time, shape);
///     }
///     save_mesh(baker.finish().mesh, "bend.glb");
#pragma once

#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/io/skin_fit.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// A skinned mesh and the error of its fit.
struct SkinnedMesh {
    Mesh mesh;
    Index joint_count = 0;
    /// Greatest and RMS distance of skinned vertices from those of the shapes, over all shapes.
    double max_error = 0.0, rms_error = 0.0;
};

/// Collects shapes and fits a skin to them.
class SkinBaker {
  public:
    /// `rest` is the shape of the bind pose; vertices outside `moving` follow a joint that stays.
    /// Errors: topology_mismatch; unsupported for a mesh without faces; invalid_argument for an
    /// empty region.
    SkinBaker(const Mesh& rest, const Region& moving, SkinOptions options = {},
              Context context = {});

    /// Adds a shape at `time`, in seconds. Errors: invalid_argument for times that are negative or
    /// not after the one before, as 32-bit numbers; topology_mismatch; memory_limit; cancelled.
    void add(double time, const Mesh& shape);

    /// Returns the rest shape with the attributes "joints" and "weights" (those that it had and
    /// its skin are replaced), its joints in its asset, and the animation `name` of them; without a
    /// name there is none. Errors: those of `fit_skin`.
    SkinnedMesh finish(const std::string& name = "deformation") const;

  private:
    Mesh rest_;
    Region moving_;
    SkinOptions options_;
    Context context_;
    std::vector<float> times_;
    std::vector<std::vector<Vec3>> poses_;
    std::vector<MemoryCharge> charges_;
};

}  // namespace lissom
