/// Scene files: a whole scene in one file, to be gone on with. Numbers are kept to the bit, so that
/// what is loaded has the hash of what was saved; a step's history, and what files had beside a
/// mesh (materials, skeletons), are not kept.
///
/// A file is an uncompressed tar archive. Its part "scene.json" lists objects and items with their
/// plain values; lists of numbers are parts of their own, little-endian as they lie in memory,
/// named after their place in it: "items/0/positions".
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/deform/deformer.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"
#include "kernel/scene/polyline.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/scene_item.h"
#include "kernel/scene/scene_state.h"

namespace lissom {

/// Makes the items of a scene that is loaded; a host whose objects are its own overrides it.
class ItemMaker {
  public:
    virtual ~ItemMaker();
    virtual std::shared_ptr<SceneItem> make_mesh(Mesh mesh);
    virtual std::shared_ptr<SceneItem> make_strands(Strands strands);
    virtual std::shared_ptr<SceneItem> make_polyline(Polyline polyline);
    /// `mesh` and `head` are items of this maker.
    virtual std::shared_ptr<SceneItem> make_deformation(Deformer deformer,
                                                        const std::shared_ptr<SceneItem>& mesh);
    virtual std::shared_ptr<SceneItem> make_hairstyle(Hairstyle style,
                                                      const std::shared_ptr<SceneItem>& head);
};

/// A scene as the bytes of a file, and what had no place in it, a sentence each: materials of
/// meshes, and deformations whose mesh has another topology by now. Errors: memory_limit;
/// file_too_large; cancelled.
struct EncodedScene {
    std::string bytes;
    std::vector<std::string> left_out;
};
EncodedScene encode_scene(const SceneState& state, const Context& context = {});

/// Adds the objects of a file to an empty scene, whose history then begins there. Errors:
/// file_syntax, file_truncated, for what is no scene file or a damaged one; unsupported for a newer
/// version; invalid_argument for a scene with objects or an open step; memory_limit; cancelled. The
/// scene is then empty as before.
void decode_scene(std::string_view bytes, Scene& scene, ItemMaker& maker,
                  const Context& context = {});

/// Writes the scene as it is now, whole or not at all, and returns what was left out. Errors: also
/// file_write_failed; file_is_directory.
std::vector<std::string> save_scene(Scene& scene, const std::filesystem::path& path,
                                    const Context& context = {});

/// Errors: also file_not_found, file_is_directory, file_empty, file_unreadable.
void load_scene(const std::filesystem::path& path, Scene& scene, ItemMaker& maker,
                const Context& context = {});

}  // namespace lissom
