/// Scene files: a whole scene in one file or in a folder, to be gone on with. Numbers are kept to
/// the bit, so that a loaded scene has the hash of the saved one; its history is kept on request.
/// Contents of files beside a mesh (materials, skeletons) are not kept.
///
/// A file is an uncompressed tar archive. Its part "scene.json" lists objects and items with their
/// plain values; lists of numbers are parts of their own, little-endian as they lie in memory,
/// named after their place in it: "items/0/positions". Its part "history.json" has the steps, whose
/// numbers are in parts "blocks/0", ...
///
/// A folder is for looking at, and for version control: all but the history is text. Its
/// "scene.json" is that of a file and names the other files after the objects: surfaces and strands
/// are OBJ files ("head.obj"), other lists have an element a line
/// ("head/regions/tip/vertices.txt"), and "history.tar" has the history. A value that is edited by
/// hand is loaded as it is then, without the history.
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

enum class SceneForm {
    /// A folder if the path is one, ends with '/', or names nothing that exists and has no
    /// extension; else a file.
    automatic,
    file,
    folder,
};

struct SceneSaveOptions {
    SceneForm form = SceneForm::automatic;
    /// Keep the steps that can be undone and done again.
    bool history = false;
};

/// A scene as the bytes of a file, and its omissions, a sentence each: materials of meshes,
/// deformations whose mesh has another topology by now, and steps of the history with such a
/// deformation. Errors: memory_limit; file_too_large; cancelled; invalid_argument for a history
/// while a step is open.
struct EncodedScene {
    std::string bytes;
    std::vector<std::string> left_out;
};
EncodedScene encode_scene(Scene& scene, const SceneSaveOptions& options = {},
                          const Context& context = {});

/// Adds the objects of a file to an empty scene, with its parameters, and with its history if the
/// file has one and the scene keeps any; else its history then begins there. Errors: file_syntax,
/// file_truncated, for other files or a damaged one; unsupported for a newer version;
/// invalid_argument for a scene with objects or an open step; memory_limit; cancelled. The scene is
/// then empty as before.
void decode_scene(std::string_view bytes, Scene& scene, ItemMaker& maker,
                  const Context& context = {});

/// Writes the scene as it is now, whole or not at all, and returns its omissions. In a folder,
/// files that are no part of the scene stay, and parts that have not changed are not written.
/// Errors: also file_write_failed; file_is_directory.
std::vector<std::string> save_scene(Scene& scene, const std::filesystem::path& path,
                                    const SceneSaveOptions& options = {},
                                    const Context& context = {});

/// Reads a file or a folder. Errors: also file_not_found, file_is_directory for a folder without a
/// scene, file_empty, file_unreadable, face_index, unsafe_path; they name the file.
void load_scene(const std::filesystem::path& path, Scene& scene, ItemMaker& maker,
                const Context& context = {});

}  // namespace lissom
