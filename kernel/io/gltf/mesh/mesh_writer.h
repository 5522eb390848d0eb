/// Writes the objects of a surface as meshes of glTF; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/io/gltf/file/binary.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/mesh/pool.h"
#include "kernel/io/gltf/mesh/surface.h"
#include "kernel/io/gltf/mesh/transform.h"
#include "kernel/io/record/float_loss.h"
#include "kernel/io/record/saved_parts.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Place of an object in the document, for its mesh.
struct ObjectPlace {
    /// Map from the mesh to the object's node.
    NodeTransform to_node{Affine()};
    /// Joints of the node's skin, 0 if it has none.
    std::size_t joint_count = 0;
    /// Name, extras, extensions and weights; primitives with their contents beside the surface.
    Json mesh = Json::object();
};

/// A material in the document.
struct PlacedMaterial {
    /// Its number, or -1 for none.
    int number = -1;
    /// Sets of texture coordinates that it reads.
    Index uv_count = 0;
};

/// The mesh as JSON; numbers go to `binary`.
class MeshWriter {
  public:
    MeshWriter(SavedParts& parts, const WrittenAttributes& attributes, GltfBinary& binary,
               const Context& context);

    /// Returns the mesh of one object with pool `pools.pool(number)`. `materials` has an entry for
    /// each of its primitives.
    Json write(const SurfaceObject& object, const VertexPools& pools, Index number,
               const ObjectPlace& place, const std::vector<PlacedMaterial>& materials);
    /// Returns the mesh of a surface that has only vertices.
    Json write_points(const ObjectPlace& place);

    /// Compression of primitives, and the bits that numbers keep: see SaveOptions.
    bool uses_draco = false;
    int quantize = 0;
    /// Whether quantised numbers become integers (KHR_mesh_quantization), for files without
    /// compression; and whether some have.
    bool writes_integers = false;
    bool has_integers() const { return has_integers_; }
    /// Objects that were not compressed: other vertices lie where their materials meet, so that the
    /// parts of a vertex in the primitives could not be told apart.
    std::size_t uncompressed() const { return uncompressed_; }
    /// Whether the meshes state their duplicate vertices.
    bool states_copies = false;
    /// Returns the loss by rounding of the faces written so far.
    const FloatLoss& float_loss() const { return float_loss_; }
    /// Tangents that were left out for want of normals, in objects so far.
    std::size_t lost_tangents() const { return lost_tangents_; }

  private:
    class Object;

    // For each vertex of the mesh, whether another lies at its place.
    const std::vector<char>& shared_places();

    SavedParts& parts_;
    const WrittenAttributes& attributes_;
    GltfBinary& binary_;
    const Context& context_;
    std::vector<std::pair<std::string, const FaceLabels*>> labels_;
    std::vector<std::pair<std::string, std::vector<char>>> regions_;
    std::vector<char> shared_places_;
    FloatLoss float_loss_;
    std::size_t lost_tangents_ = 0, uncompressed_ = 0;
    bool has_integers_ = false;
};

}  // namespace lissom
