/// The history of a scene as an archive: its states, each as its difference from the one before,
/// and blocks that they share; private to kernel/scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/scene/file/list_store.h"
#include "kernel/scene/file/part_archive.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/scene_file.h"

namespace lissom {

/// Adds the history to an archive. `mark` tells which present it belongs to. Parts without a place
/// in it are told in `left_out`. Errors: invalid_argument while a step is open.
void add_history(Scene& scene, const std::string& mark, PartWriter& parts,
                 std::vector<std::string>& left_out, const Context& context);

/// Returns whether an archive has a history, and the mark that it was written with. Errors:
/// file_syntax, file_truncated; unsupported.
bool has_history(const PartReader& parts);
std::string history_mark(const PartReader& parts);

/// Fills an empty scene: objects as they are at the present place of the history, and its steps.
/// Errors: also those of the objects; the scene is then empty.
void read_history(const PartReader& parts, Scene& scene, ItemMaker& maker, const Context& context);

/// Returns the JSON of a part. Errors: file_syntax, file_truncated.
SceneJson parse_part(std::string_view text);

}  // namespace lissom
