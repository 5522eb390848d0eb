/// Mesh: an oriented 2-manifold polygon mesh with or without boundary; positions in double
/// precision, attributes and named regions. Copies share the topology and own everything else. Its
/// memory counts on the account of the context that its topology was made with, and so does that of
/// its copies: making or copying a mesh, or adding to it, may throw memory_limit.
///
/// Operators that need triangles see a triangulation of the polygons (triangulation.h); the
/// polygons stay. Measures are in measures.h, constructors of regions in region_select.h, files in
/// kernel/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/core/memory_hold.h"
#include "kernel/mesh/asset.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/report.h"
#include "kernel/mesh/topology.h"

namespace lissom {

class Mesh {
  public:
    /// The mesh without vertices.
    Mesh();
    /// Errors: as Topology::create; not_finite naming the vertices; cancelled; memory_limit.
    Mesh(std::vector<Vec3> positions, FaceList faces, const Context& context = {});
    /// On an existing topology, whose vertex count must equal the number of positions.
    Mesh(std::vector<Vec3> positions, std::shared_ptr<const Topology> topology,
         const Context& context = {});
    Mesh(const Mesh&) = default;
    Mesh(Mesh&&) noexcept = default;
    /// Errors: memory_limit, and then nothing has changed.
    Mesh& operator=(const Mesh& other);
    Mesh& operator=(Mesh&& other) noexcept;
    ~Mesh() = default;

    const Topology& topology() const { return *topology_; }
    const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }
    Index vertex_count() const { return topology_->vertex_count(); }
    Index face_count() const { return topology_->face_count(); }

    std::span<const Vec3> positions() const { return positions_; }
    const Vec3& position(Index v) const { return positions_[at(v)]; }
    /// Errors: out_of_range; not_finite.
    void set_position(Index v, const Vec3& position);
    /// Replaces all positions. Errors: invalid_argument if the count differs; not_finite.
    void set_positions(std::vector<Vec3> positions);
    /// Positions for in-place change; values must stay finite. Invalidates values derived from the
    /// old ones.
    std::span<Vec3> edit_positions();

    const AttributeSet& attributes() const { return attributes_; }
    AttributeSet& attributes() { return attributes_; }

    /// Named regions. Errors: topology_mismatch if `region` is not of this mesh's topology.
    void set_region(std::string_view name, const Region& region);
    /// Returns the region called `name`, or null.
    const Region* find_region(std::string_view name) const;
    /// Returns the region called `name`. Errors: out_of_range, with the names that come near.
    const Region& region(std::string_view name) const;
    bool remove_region(std::string_view name);
    const std::map<std::string, Region, std::less<>>& regions() const { return regions_; }

    /// Files of material definitions that the mesh refers to (OBJ mtllib), in order.
    std::vector<std::string>& material_libraries() { return material_libraries_; }
    const std::vector<std::string>& material_libraries() const { return material_libraries_; }

    /// Contents of the file beside the surface, or null. Travels through every operation.
    const std::shared_ptr<const Asset>& asset() const { return asset_; }
    /// Errors: memory_limit.
    void set_asset(std::shared_ptr<const Asset> asset);

    /// Returns the findings of loading; empty for a mesh made otherwise.
    const Report& report() const { return report_; }
    void set_report(Report report) { report_ = std::move(report); }

    /// Becomes `other` with all it holds, as an in-place change of topology does; the revision
    /// grows.
    void replace_by(Mesh other);

    /// Grows with every change of positions: results computed at one revision are valid while it
    /// stays.
    std::uint64_t revision() const { return revision_; }
    std::size_t memory_bytes() const;

  private:
    void count();

    std::shared_ptr<const Topology> topology_;
    MemoryHold hold_;
    std::vector<Vec3> positions_;
    AttributeSet attributes_;
    std::map<std::string, Region, std::less<>> regions_;
    std::vector<std::string> material_libraries_;
    std::shared_ptr<const Asset> asset_;
    Report report_;
    std::uint64_t revision_ = 0;
};

/// Number of elements that an attribute of `domain` has values on.
Index element_count(const Topology& topology, Domain domain);

/// Throws invalid_argument, naming it, if an attribute or a list of labels does not have one entry
/// for each element of its domain.
void require_complete_attributes(const Mesh& mesh);

/// Throws topology_mismatch, naming `what`, if `topology` is not the mesh's present one.
void require_same_topology(const Mesh& mesh, const std::shared_ptr<const Topology>& topology,
                           std::string_view what);

}  // namespace lissom
