/// Hair as BasisCurves of a USD layer in text form (.usda); private to kernel/io.
///
/// Widths are diameters. Root uvs are primvars:st, colours primvars:displayColor, transparency is
/// primvars:displayOpacity; groups are the indexed primvar "group", ids, root faces and their
/// weights the primvars "strandId", "guideId", "guideArc", "rootFace" and "rootBarycentrics", for
/// which USD has no names of its own. Other data of strands - the profile of the widths, the
/// comment - are in attributes of the namespace "lissom", so that they come back unchanged. Ids,
/// guides, groups and root uvs are there once more as groom_id, groom_guide, groom_group_id,
/// groom_group_name and groom_root_uv of the schema GroomAPI, which Unreal Engine reads. Hair that
/// joints of its head move stands in a SkelRoot beside a Skeleton (UsdSkel); each point of a strand
/// has the joints of its root.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/record/file_hair.h"
#include "kernel/io/record/options.h"
#include "kernel/io/usda/strand_skin.h"

namespace lissom {

/// Reads all BasisCurves of a layer that are drawn, in the order of the file; if there are several
/// without groups, each is a group by its name. Transforms are applied, indexed primvars expanded,
/// and cubic curves become polylines. Other prims are passed over. Warnings of the log name curves
/// that are inactive or invisible, and the contents of a layer without curves. Errors: file_syntax,
/// file_truncated, not_finite with the line; unsupported for periodic curves, curves or transforms
/// that change over time, and transforms that flatten; cancelled, memory_limit.
FileHair read_usda(std::string_view bytes, const Context& context);

/// Writes one BasisCurves "Hair", linear, with a width for each point if they differ. With `skin`,
/// whose coordinates are those of the file, it is bound to a Skeleton. Strands read back have the
/// same hash in the same unit.
void write_usda(const Strands& strands, double meters_per_unit, UpAxis up, const StrandSkin* skin,
                std::string& bytes, const Context& context);

}  // namespace lissom
