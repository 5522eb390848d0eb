#include "kernel/scene/scene_file.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/hasher.h"
#include "kernel/core/memory_error.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/stream/folder.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/file/folder_lists.h"
#include "kernel/scene/file/history_file.h"
#include "kernel/scene/file/part_archive.h"
#include "kernel/scene/file/scene_archive.h"
#include "kernel/scene/file/scene_records.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"

namespace lissom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "lissom scene";
constexpr Index kSceneVersion = 1;
constexpr const char* kManifest = "scene.json";
constexpr const char* kHistoryFile = "history.tar";

struct SceneRecord {
    std::string format = kFormat;
    Index version = kSceneVersion;
    ParametersByOwner parameters;
    /// By their numbers.
    std::vector<ItemRecord> items;
    std::vector<ObjectRecord> objects;
};

void require_version(const SceneRecord& scene) {
    require(scene.format == kFormat, "this is no scene", ErrorCode::file_syntax);
    require(scene.version <= kSceneVersion,
            "the scene is of version " + std::to_string(scene.version) +
                ", which is newer than this program",
            ErrorCode::unsupported);
}

template <typename Archive>
void describe_head(Archive& a, SceneRecord& scene) {
    a.text("format", scene.format);
    a.integer("version", scene.version);
    require_version(scene);
    a.parameters("parameters", scene.parameters);
}

template <typename Archive>
void describe_content(Archive& a, SceneRecord& scene) {
    a.objects("items", scene.items, [](Archive& b, ItemRecord& x) { describe(b, x); });
    a.objects("objects", scene.objects, [](Archive& b, ObjectRecord& x) { describe(b, x); });
}

// ---- Writing

void name_items(SceneRecord& scene) {
    for (const ObjectRecord& object : scene.objects) {
        std::string& label = scene.items[at(object.item)].label;
        if (label.empty()) label = object.name;
    }
    for (ItemRecord& item : scene.items) {
        if (item.label.empty()) item.label = kind_name(item.kind);
    }
}

SceneRecord record_scene(Scene& scene, std::vector<std::string>& left_out, const Context& context) {
    const auto state = scene.state();
    SceneRecord result;
    result.parameters = scene.parameters();
    ItemTable items;
    StateRecorder recorder(*state, items);
    for (const CapturedItem& captured : state->items) {
        context.checkpoint();
        // A hairstyle has brought its head along.
        if (number_of(items, captured.item->identity()) != kNoIndex) continue;
        std::vector<PlacedRecord> records;
        if (!recorder.add(captured, records)) {
            left_out.push_back("a deformation whose mesh has another topology by now");
        }
        for (PlacedRecord& placed : records) result.items.push_back(std::move(placed.record));
        const auto* mesh = dynamic_cast<const MeshItem*>(captured.item.get());
        if (mesh && mesh->mesh().asset()) {
            left_out.push_back("contents of a mesh's file beside it: materials, skeletons");
        }
    }
    for (const auto& object : state->objects) {
        const Index number = number_of(items, object->item->identity());
        if (number != kNoIndex) result.objects.push_back({object->name, number, object->look});
    }
    name_items(result);
    return result;
}

SceneJson write_record(SceneRecord& record, ListSink& lists) {
    SceneJson json = SceneJson::object();
    SceneWriter writer(json, lists);
    describe_head(writer, record);
    describe_content(writer, record);
    return json;
}

std::string text_of(const SceneJson& json) {
    return json.dump(1, ' ', false, SceneJson::error_handler_t::replace) + "\n";
}

// ---- Folders

// Tells the files of a folder from others of the same names.
std::string mark_of(const std::map<std::string, std::string>& files) {
    Hasher hasher;
    for (const auto& [name, bytes] : files) {
        hasher.add(name);
        hasher.add(bytes);
    }
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hasher.value()));
    return text;
}

std::vector<std::string> listed_files(const SceneJson& json) {
    std::vector<std::string> names;
    const auto files = json.find("files");
    require(files != json.end() && files->is_array(), "the scene does not list its files",
            ErrorCode::file_syntax);
    for (const SceneJson& name : *files) {
        require(name.is_string(), "the scene's 'files' must be names", ErrorCode::file_syntax);
        names.push_back(name.get<std::string>());
        require_inside(names.back());
    }
    return names;
}

// The files of the scene that a folder has already.
std::set<std::string> files_before(const fs::path& folder) {
    if (!has_in_folder(folder, kManifest)) return {};
    try {
        const SceneJson json = parse_part(read_from_folder(folder, kManifest).bytes);
        const std::vector<std::string> names = listed_files(json);
        std::set<std::string> files(names.begin(), names.end());
        files.insert({kManifest, kHistoryFile});
        return files;
    } catch (const Error&) {
        const std::string file = display_name(folder / kManifest);
        throw FileError(ErrorCode::file_write_failed, file,
                        file + ": is no scene, so the folder is not replaced; take another folder");
    }
}

std::map<std::string, std::string> encode_folder(Scene& scene, bool history,
                                                 std::vector<std::string>& left_out,
                                                 const Context& context) {
    SceneRecord record = record_scene(scene, left_out, context);
    FolderSink lists;
    lists.take(kManifest);
    lists.take(kHistoryFile);
    SceneJson json = write_record(record, lists);
    auto files = std::move(lists.files());
    SceneJson& names = json["files"] = SceneJson::array();
    for (const auto& [name, bytes] : files) names.push_back(name);
    files[kManifest] = text_of(json);
    if (!history) return files;
    PartWriter parts;
    add_history(scene, mark_of(files), parts, left_out, context);
    files[kHistoryFile] = std::move(parts).finish();
    return files;
}

void save_folder(Scene& scene, const fs::path& folder, bool history,
                 std::vector<std::string>& left_out, const Context& context) {
    FolderChange change;
    change.before = files_before(folder);
    change.files = encode_folder(scene, history, left_out, context);
    replace_in_folder(folder, change, context);
}

bool is_folder(const fs::path& path, SceneForm form, const Context& context) {
    if (context.files().write) {
        require(form != SceneForm::folder, "a host's table of files has no folders; save one file",
                ErrorCode::unsupported);
        return false;
    }
    if (form != SceneForm::automatic) return form == SceneForm::folder;
    std::error_code error;
    if (fs::is_directory(path, error) || (!path.empty() && !path.has_filename())) return true;
    return !fs::exists(path, error) && !path.empty() && !path.has_extension();
}

// ---- Reading

SceneRecord read_head(const SceneJson& json, ListSource& lists) {
    SceneRecord record;
    SceneReader reader(json, lists);
    describe_head(reader, record);
    return record;
}

void make_objects(SceneRecord record, Scene& scene, ItemMaker& maker, const Context& context) {
    LiveItems live(maker, context);
    for (std::size_t i = 0; i < record.items.size(); ++i) {
        live.take({index_of(i), std::move(record.items[i])});
        record.items[i] = {};
    }
    for (std::size_t i = 0; i < record.objects.size(); ++i) {
        ObjectRecord& object = record.objects[i];
        at_scene_place("objects/" + std::to_string(i), object.name, [&] {
            scene.add(object.name, live.item(object.item), std::move(object.look));
        });
    }
}

void read_present(const SceneJson& json, ListSource& lists, Scene& scene, ItemMaker& maker,
                  const Context& context) {
    SceneRecord record = read_head(json, lists);
    SceneReader reader(json, lists);
    describe_content(reader, record);
    scene.step("load", [&] { make_objects(std::move(record), scene, maker, context); });
    scene.clear_history();
}

void take_parameters(const SceneRecord& record, Scene& scene) {
    for (const auto& [owner, values] : record.parameters) scene.set_parameters(owner, values);
}

// Content that an object refuses is a fault of the file.
[[noreturn]] void refuse_content(const Error& error) {
    constexpr ErrorCode kOwn[] = {ErrorCode::memory_limit,    ErrorCode::cancelled,
                                  ErrorCode::unsupported,     ErrorCode::file_truncated,
                                  ErrorCode::file_not_found,  ErrorCode::file_is_directory,
                                  ErrorCode::file_unreadable, ErrorCode::file_empty,
                                  ErrorCode::face_index,      ErrorCode::unsafe_path};
    const bool own = std::find(std::begin(kOwn), std::end(kOwn), error.code()) != std::end(kOwn);
    const ErrorCode code = own ? error.code() : ErrorCode::file_syntax;
    const std::string file = FileError::of(error, "");
    throw FileError(code, file, error.message(), error.elements());
}

// Runs read(), which fills an empty scene.
template <typename Read>
void fill(Scene& scene, const Read& read) {
    require(scene.objects().empty() && scene.depth() == 0,
            "a scene is loaded into an empty one; remove its objects and end its steps before");
    with_memory_errors([&] {
        try {
            read();
        } catch (const Error& error) {
            refuse_content(error);
        }
    });
}

bool keeps_history(const Scene& scene) {
    return scene.history().limit > 0;
}

// Returns the history of a folder, if it has one and it is asked for; it belongs to these very
// files.
std::optional<FileContent> history_of_folder(const fs::path& folder, const SceneJson& json,
                                             const Scene& scene, const Context& context) {
    if (!keeps_history(scene) || !has_in_folder(folder, kHistoryFile)) return std::nullopt;
    std::map<std::string, std::string> files;
    for (const std::string& name : listed_files(json)) {
        files[name] = read_from_folder(folder, name, context).bytes;
    }
    files[kManifest] = read_from_folder(folder, kManifest, context).bytes;
    FileContent content = read_from_folder(folder, kHistoryFile, context);
    try {
        const PartReader parts(content.bytes);
        if (has_history(parts) && history_mark(parts) == mark_of(files)) return content;
    } catch (const Error& error) {
        const std::string file = display_name(folder / kHistoryFile);
        throw FileError(error.code(), file,
                        file + ": " + error.message() +
                            "; without this file the scene is loaded without its history",
                        error.elements());
    }
    return std::nullopt;
}

void load_folder(const fs::path& folder, Scene& scene, ItemMaker& maker, const Context& context) {
    if (!has_in_folder(folder, kManifest)) {
        const std::string file = display_name(folder);
        throw FileError(ErrorCode::file_is_directory, file,
                        file + ": is a folder without a scene: it lacks " + kManifest);
    }
    const FileContent manifest = read_from_folder(folder, kManifest, context);
    const SceneJson json = parse_part(manifest.bytes);
    FolderSource lists(folder, context);
    const SceneRecord head = read_head(json, lists);
    if (const auto history = history_of_folder(folder, json, scene, context)) {
        read_history(PartReader(history->bytes), scene, maker, context);
    } else {
        read_present(json, lists, scene, maker, context);
    }
    take_parameters(head, scene);
}

}  // namespace

ItemMaker::~ItemMaker() = default;

std::shared_ptr<SceneItem> ItemMaker::make_mesh(Mesh mesh) {
    return std::make_shared<MeshItem>(std::make_shared<Mesh>(std::move(mesh)));
}

std::shared_ptr<SceneItem> ItemMaker::make_strands(Strands strands) {
    return std::make_shared<StrandsItem>(std::make_shared<Strands>(std::move(strands)));
}

std::shared_ptr<SceneItem> ItemMaker::make_polyline(Polyline polyline) {
    return std::make_shared<PolylineItem>(std::make_shared<Polyline>(std::move(polyline)));
}

std::shared_ptr<SceneItem> ItemMaker::make_deformation(Deformer deformer,
                                                       const std::shared_ptr<SceneItem>& mesh) {
    return std::make_shared<DeformItem>(std::make_shared<Deformer>(std::move(deformer)), mesh);
}

std::shared_ptr<SceneItem> ItemMaker::make_hairstyle(Hairstyle style,
                                                     const std::shared_ptr<SceneItem>& head) {
    return std::make_shared<HairstyleItem>(std::make_shared<Hairstyle>(std::move(style)), head);
}

EncodedScene encode_scene(Scene& scene, const SceneSaveOptions& options, const Context& context) {
    return with_memory_errors([&] {
        EncodedScene result;
        SceneRecord record = record_scene(scene, result.left_out, context);
        PartWriter parts;
        const SceneJson json = write_record(record, parts);
        record = {};
        if (options.history) add_history(scene, "", parts, result.left_out, context);
        parts.add(kManifest, text_of(json));
        result.bytes = std::move(parts).finish();
        return result;
    });
}

void decode_scene(std::string_view bytes, Scene& scene, ItemMaker& maker, const Context& context) {
    fill(scene, [&] {
        PartReader parts(bytes);
        const SceneJson json = parse_part(parts.find(kManifest));
        const SceneRecord head = read_head(json, parts);
        if (keeps_history(scene) && has_history(parts)) {
            read_history(parts, scene, maker, context);
        } else {
            read_present(json, parts, scene, maker, context);
        }
        take_parameters(head, scene);
    });
}

std::vector<std::string> save_scene(Scene& scene, const fs::path& path,
                                    const SceneSaveOptions& options, const Context& context) {
    return with_memory_errors([&] {
        std::vector<std::string> left_out;
        if (is_folder(path, options.form, context)) {
            save_folder(scene, path, options.history, left_out, context);
            return left_out;
        }
        require_folder_of(path, context);
        EncodedScene encoded = encode_scene(scene, options, context);
        write_file_atomically(path, encoded.bytes, context);
        return std::move(encoded.left_out);
    });
}

void load_scene(const fs::path& path, Scene& scene, ItemMaker& maker, const Context& context) {
    std::error_code error;
    const bool in_folder = !context.files().read && fs::is_directory(path, error);
    const FileContent file = in_folder ? FileContent{} : read_file(path, context);
    try {
        if (in_folder) return fill(scene, [&] { load_folder(path, scene, maker, context); });
        decode_scene(file.bytes, scene, maker, context);
    } catch (const Error& refused) {
        const std::string name = display_name(in_folder ? path / kManifest : path);
        const bool named = in_folder && refused.message().starts_with(display_name(path));
        const std::string place = named ? FileError::of(refused, name) : name;
        throw FileError(refused.code(), place,
                        named ? refused.message() : name + ": " + refused.message(),
                        refused.elements());
    }
}

}  // namespace lissom
