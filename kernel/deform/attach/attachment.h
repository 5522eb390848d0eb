/// Attachment: a mesh that follows the surface it sits on, such as the buttons of a coat.
#pragma once

#include <cstddef>
#include <memory>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The pieces of an attached mesh that keep their shape.
enum class AttachmentMode {
    components,  ///< each connected component: buttons, eyes, horns
    vertices,    ///< none: each vertex follows the surface nearest to it, as clothes do
};

/// Options of an attachment.
struct AttachmentOptions {
    AttachmentMode mode = AttachmentMode::components;
    /// Whether components, or distances of vertices, grow and shrink with the surface below.
    bool scale = false;
    /// Greatest distance of a component from the surface, in mesh units. 0 takes the size of the
    /// surface, the root mean square distance to its centroid.
    double max_distance = 0.0;
};

/// Binds a mesh to a surface in its rest shape. Each component, or each vertex, moves with the
/// rotation that fits the surface below it best, so a rigid motion of the surface moves all
/// rigidly. Accepts polygon meshes, closed or open, of any number of components. A copy is cheap.
class Attachment {
  public:
    /// Takes the present shapes of both as their rest shapes; both may change or die afterwards.
    /// Errors: mesh_empty if `surface` has no faces or `attached` no vertices; invalid_argument for
    /// a distance that is negative or not finite, and, naming a vertex of each, for components of
    /// `attached` that are farther from the surface than it; memory_limit; cancelled.
    Attachment(const Mesh& surface, const Mesh& attached, const AttachmentOptions& options = {},
               const Context& context = {});

    /// Moves `attached` to its place on the present shape of `surface`. Custom normals, tangents
    /// and morph targets turn along. The rest shape of the surface gives the rest shape of
    /// `attached`, to the bit. Errors: topology_mismatch if either mesh has another topology;
    /// cancelled. The mesh is then unchanged.
    void follow(const Mesh& surface, Mesh& attached, const Context& context = {}) const;

    /// Returns the greatest distance of a component from the surface at rest, in mesh units.
    double distance() const;
    std::size_t memory_bytes() const;

  private:
    struct State;
    std::shared_ptr<const State> state_;
};

}  // namespace lissom
