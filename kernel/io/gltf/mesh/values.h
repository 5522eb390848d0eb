/// Values of a pool of vertices as glTF demands them: complete, finite and in range; private to
/// kernel/io and not installed.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/io/gltf/file/binary.h"
#include "kernel/io/gltf/mesh/pool.h"
#include "kernel/io/gltf/mesh/surface.h"
#include "kernel/io/gltf/mesh/transform.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Makes the values of one object's vertices. `to_node` leads from the mesh to the object's node.
class PoolValues {
  public:
    PoolValues(const Mesh& mesh, const VertexPool& pool, const NodeTransform& to_node)
        : mesh_(mesh), pool_(pool), to_node_(to_node) {}

    /// Errors: not_finite naming the vertices beyond the range of 32-bit numbers.
    WrittenNumbers positions() const;
    /// Missing values become a normal of the surface, a tangent across it, opaque white, zeros.
    WrittenNumbers attribute(const WrittenAttribute& written) const;
    WrittenNumbers morph(const WrittenMorph& morph) const;
    /// Zeros for attributes that others need.
    WrittenNumbers zeros(Index width) const;

    struct JointSet {
        WrittenNumbers joints, weights;
    };
    /// Sets of four joints and weights, those of each vertex summing to 1 and naming no joint
    /// twice. `joint_count` is that of the skin, or 0 if there is none.
    std::vector<JointSet> joint_sets(const WrittenAttributes& attributes,
                                     std::size_t joint_count) const;

    bool has_value(const Attribute& attribute, std::size_t i) const {
        const double first = pool_.value(attribute, i)[0];
        return first == first;
    }

  private:
    Vec3 normal_at(std::size_t i) const;
    Vec3 any_normal(std::size_t i) const;

    const Mesh& mesh_;
    const VertexPool& pool_;
    const NodeTransform& to_node_;
};

}  // namespace lissom
