/// The piece of a target that a part is pasted onto instead of the whole, so that the cost of a
/// paste that follows the mouse depends on the surface under it; private to kernel/merge.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/part/opened_target.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// The faces of a chart alone, which is enough to open the target.
struct PasteGround {
    /// Without attributes.
    Mesh mesh;
    /// All of its vertices, which are those of the chart in their order.
    std::vector<Index> vertices;

    PasteGround(const Mesh& target, const PasteChart& chart, const Context& context);
};

/// Meshes that the elements of a paste are followed to, and whether they are.
struct PasteOrigins {
    /// From the target to its origin, the target as given; null for the target itself.
    const MeshMap* target = nullptr;
    /// The elements of the target as given come before those of the source.
    const Topology& given;
    bool wanted = true;
    /// Also to the elements of the target and, after these, of the part: the map of PastedOn::sewn.
    bool between = true;
};

/// A target with a part on it.
struct PastedOn {
    /// This map is empty unless it was asked for, and so is the other.
    Sewn sewn;
    MeshMap provenance;
};

class TargetPiece {
  public:
    /// Takes the faces of a chart with some rings around them and the faces near to them in space;
    /// all of the target if that is most of it. The target must outlive the piece.
    TargetPiece(const Mesh& target, const PasteChart& chart, const Context& context);
    /// All of it.
    static TargetPiece whole(const Mesh& target, const PasteChart& chart);

    bool is_whole() const { return !part_; }
    const Mesh& mesh() const { return part_ ? part_->mesh : *target_; }
    const Mesh& target() const { return *target_; }
    /// The chart's vertices in the numbers of `mesh`.
    const std::vector<Index>& chart_vertices() const { return chart_vertices_; }

    /// Returns the target with the result that was sewn onto the piece after it was opened. Returns
    /// nothing if the same on the whole target might have made a difference.
    std::optional<PastedOn> put_back(const OpenedTarget& opened, const PastePart& part, Sewn sewn,
                                     const PasteOrigins& origins, const Context& context) const;

  private:
    explicit TargetPiece(const Mesh& target) : target_(&target) {}

    const Mesh* target_;
    std::optional<MeshPart> part_;
    std::vector<Index> chart_vertices_;
};

}  // namespace lissom
