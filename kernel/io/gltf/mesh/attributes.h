/// Reads the positions and attributes of blocks of vertices; private to kernel/io and not
/// installed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/io/gltf/file/accessor.h"
#include "kernel/io/gltf/file/document.h"
#include "kernel/io/gltf/mesh/blocks.h"
#include "kernel/io/gltf/mesh/columns.h"
#include "kernel/io/gltf/mesh/names.h"
#include "kernel/io/gltf/mesh/transform.h"
#include "kernel/io/record/skipped_content.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Collects the vertices of all blocks, in the frame of the world. Errors: file_syntax naming
/// accessors, file_too_large.
class VertexReader {
  public:
    VertexReader(const AccessorReader& accessors, GltfBudget& budget, SkippedContent& skipped)
        : accessors_(accessors), budget_(budget), skipped_(skipped) {}

    /// Adds the positions of a block and sets its number of vertices.
    void add_positions(VertexBlock& block, const NodeTransform& transform);
    /// Adds the other values of the block that was added last; its corners are known by now.
    void add_attributes(const VertexBlock& block, const NodeTransform& transform);

    std::vector<Vec3>& positions() { return positions_; }
    /// Moves the attributes out, and reports values that were not finite.
    void finish(AttributeSet& attributes, Report& report);

  private:
    AccessorValues read_values(const std::string& name, int accessor, Index width) const;
    void clean(const GltfAttributeName& name, AccessorValues& read, const NodeTransform& transform);
    void drop_not_finite(const std::string& name, AccessorValues& read);
    void add_column(const std::string& name, ScalarType type, const AccessorValues& read);
    void add_joints(std::map<std::string, AccessorValues>& sets);
    void add_target(const VertexBlock& block, Index target, const NodeTransform& transform);

    const AccessorReader& accessors_;
    GltfBudget& budget_;
    SkippedContent& skipped_;
    std::vector<Vec3> positions_;
    AttributeColumns columns_;
    std::map<std::string, std::size_t> not_finite_;
    // The first vertex of the present block.
    std::size_t first_ = 0;
};

}  // namespace lissom
