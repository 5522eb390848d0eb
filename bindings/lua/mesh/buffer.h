/// Buffer: numbers of the kernel that scripts read and write in place.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/mesh/mesh_object.h"

namespace lissom::lua {

struct BufferObject {
    static constexpr const char* kTypeName = "lissom.Buffer";

    /// Source of the numbers: positions of a mesh, one of its attributes, or a list of the buffer's
    /// own.
    enum class Source { positions, attribute, own };

    Source source = Source::own;
    std::shared_ptr<MeshObject> mesh;
    std::shared_ptr<const Topology> topology;
    /// Name of the attribute.
    std::string name;
    std::vector<double> values;
    Index width = 1;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    bool writable() const { return source != Source::own; }
    std::size_t memory_bytes() const { return values.size() * sizeof(double) + name.size(); }

    /// Returns the present numbers. Throws topology_mismatch if the mesh was closed or has another
    /// topology by now, or the attribute has gone or has another width.
    std::span<double> numbers();
    /// Returns the same for writing: values derived from the old numbers are dropped.
    std::span<double> edit();
    /// Rows of three numbers as points. Throws invalid_argument for another width.
    std::vector<Vec3> as_points();

  private:
    std::span<double> find_attribute();

    // Numbers of an attribute at `changes_` of the mesh.
    std::span<double> found_;
    std::uint64_t changes_ = ~std::uint64_t{0};
};

}  // namespace lissom::lua
