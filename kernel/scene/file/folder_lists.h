/// The lists of a scene in a folder: models as OBJ files, other lists as text with an element a
/// line, a few numbers in the JSON itself; private to kernel/scene.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/scene/file/list_store.h"

namespace lissom {

/// Files by their names in the folder. Numbers are written so that they read back to the bit.
class FolderSink : public ListSink {
  public:
    SceneJson put(const ListPlace& place, std::string_view bytes, ListForm form) override;
    SceneJson put_model(const std::string& label, const ModelView& model) override;
    /// Keeps a name free.
    void take(const std::string& name) { taken_.insert(name); }
    std::map<std::string, std::string>& files() { return files_; }

  private:
    std::string free_name(std::string_view label, std::string_view end);

    std::map<std::string, std::string> files_;
    // Names in small letters: not every file system tells "Head" from "head".
    std::set<std::string> taken_;
};

/// Errors of all: also those of reading a file; unsafe_path for a name that leads out of the
/// folder. They name the file.
class FolderSource : public ListSource {
  public:
    FolderSource(std::filesystem::path folder, const Context& context)
        : folder_(std::move(folder)), context_(context) {}

    std::string_view get(const std::string& path, const SceneJson* entry, ListForm form) override;
    void get_surface(const std::string& path, const SceneJson& entry, std::vector<Vec3>& positions,
                     std::vector<Index>& offsets, std::vector<Index>& corners) override;
    void get_lines(const std::string& path, const SceneJson& entry, std::vector<float>& points,
                   std::vector<Index>& offsets) override;

  private:
    std::string read(const std::string& path, const SceneJson& entry, std::string& name);

    std::filesystem::path folder_;
    const Context& context_;
    std::string bytes_;
};

/// Errors: unsafe_path if `name` is not that of a file inside a folder.
void require_inside(const std::string& name);

}  // namespace lissom
