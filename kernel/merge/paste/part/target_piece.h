/// The piece of a target that a part is pasted onto in place of the whole, so that a paste that
/// follows the mouse costs what is under it; private to kernel/merge.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/part/opened_target.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

class TargetPiece {
  public:
    /// The faces of a chart with some rings around them and what is near to them in space; all of
    /// the target where that is most of it. The target must outlive the piece.
    TargetPiece(const Mesh& target, const PasteChart& chart, const Context& context);
    /// All of it.
    static TargetPiece whole(const Mesh& target, const PasteChart& chart);

    bool is_whole() const { return !part_; }
    const Mesh& mesh() const { return part_ ? part_->mesh : *target_; }
    const Mesh& target() const { return *target_; }
    /// The chart's vertices in the numbers of `mesh`.
    const std::vector<Index>& chart_vertices() const { return chart_vertices_; }

    /// The target with what was sewn onto the piece after it was opened. Its map leads to the
    /// elements of the target and, after these, of the part. Nothing where the same on the whole
    /// target might have made a difference.
    std::optional<Sewn> put_back(const OpenedTarget& opened, const PastePart& part, Sewn sewn,
                                 const Context& context) const;

  private:
    explicit TargetPiece(const Mesh& target) : target_(&target) {}

    const Mesh* target_;
    std::optional<MeshPart> part_;
    std::vector<Index> chart_vertices_;
};

}  // namespace lissom
