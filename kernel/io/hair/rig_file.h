/// Rig files: the rig of hair for simulations in engines, as JSON.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/core/context.h"
#include "kernel/hair/dynamics/hair_rig.h"

namespace lissom {

/// Returns the text of a rig file: "format" is "lissom hair rig", "version" 1; lengths are in
/// metres, points in the space of the head, and points of guides are numbered from 0 over all of
/// them. "guides" has points, ids, lengths of segments, curves (x y z of all points) and
/// root_frames (x y z w of quaternions, which take z to the first segment); then "ties" (name,
/// center, radius, points), "links" (a, b, length, bound), "capsules" (a, b, radius),
/// "capsule_cover" and "strand_lengths". Errors: not_finite if a number is not.
std::string encode_rig(const HairRig& rig);

/// Writes a rig file, whole or not at all. Errors: as encode_rig; file_write_failed,
/// file_is_directory; cancelled.
void save_rig(const HairRig& rig, const std::filesystem::path& path, const Context& context = {});

}  // namespace lissom
