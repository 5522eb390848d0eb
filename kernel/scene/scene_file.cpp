#include "kernel/scene/scene_file.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"
#include "kernel/io/stream/file.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/file/describe_items.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"

namespace lissom {
namespace {

constexpr const char* kFormat = "lissom scene";
constexpr Index kSceneVersion = 1;
constexpr const char* kManifest = "scene.json";
constexpr const char* kKinds[] = {"mesh", "deformation", "strands", "hairstyle", "polyline"};

// An item of a file, of one of the kinds.
struct ItemRecord {
    ItemKind kind = ItemKind::mesh;
    MeshRecord mesh;
    DeformRecord deformation;
    StrandsRecord strands;
    HairstyleRecord hairstyle;
    Polyline polyline;
};

template <typename Archive>
void describe(Archive& a, ItemRecord& item) {
    a.choice("kind", item.kind, kKinds);
    switch (item.kind) {
        case ItemKind::mesh:
            return describe(a, item.mesh);
        case ItemKind::deformation:
            return describe(a, item.deformation);
        case ItemKind::strands:
            return describe(a, item.strands);
        case ItemKind::hairstyle:
            return describe(a, item.hairstyle);
        case ItemKind::polyline:
            return describe(a, item.polyline);
    }
}

struct SceneRecord {
    std::string format = kFormat;
    Index version = kSceneVersion;
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
void describe(Archive& a, SceneRecord& scene) {
    a.text("format", scene.format);
    a.integer("version", scene.version);
    require_version(scene);
    a.objects("items", scene.items, [](Archive& b, ItemRecord& x) { describe(b, x); });
    a.objects("objects", scene.objects, [](Archive& b, ObjectRecord& x) { describe(b, x); });
}

// ---- From a state to records

class SceneRecorder {
  public:
    SceneRecorder(const SceneState& state, const Context& context)
        : state_(state), context_(context) {}

    SceneRecord record() {
        for (const CapturedItem& captured : state_.items) {
            context_.checkpoint();
            add(captured);
        }
        for (const auto& object : state_.objects) add(*object);
        return std::move(scene_);
    }
    std::vector<std::string> left_out() { return std::move(left_out_); }

  private:
    // Of the item of this identity in the file, or kNoIndex.
    Index place_of(const void* identity) const {
        const auto found = std::find(identities_.begin(), identities_.end(), identity);
        return found == identities_.end() ? kNoIndex : index_of(found - identities_.begin());
    }

    ItemRecord& put(const void* identity, ItemKind kind) {
        identities_.push_back(identity);
        ItemRecord& record = scene_.items.emplace_back();
        record.kind = kind;
        return record;
    }

    void add(const CapturedItem& captured) {
        const SceneItem& item = *captured.item;
        const ItemContent& content = *captured.content;
        switch (item.kind()) {
            case ItemKind::mesh:
                return add_mesh(item.identity(), dynamic_cast<const MeshContent&>(content).mesh());
            case ItemKind::strands:
                put(item.identity(), item.kind()).strands =
                    record_of(dynamic_cast<const StrandsContent&>(content).strands());
                return;
            case ItemKind::polyline:
                put(item.identity(), item.kind()).polyline =
                    dynamic_cast<const PolylineContent&>(content).polyline();
                return;
            case ItemKind::deformation:
                return add_deformation(captured);
            case ItemKind::hairstyle:
                return add_hairstyle(captured);
        }
    }

    void add_mesh(const void* identity, const Mesh& mesh) {
        if (place_of(identity) != kNoIndex) return;
        if (mesh.asset()) {
            left_out_.push_back("what the file of a mesh had beside it: materials, skeletons");
        }
        put(identity, ItemKind::mesh).mesh = record_of(mesh);
    }

    void add_deformation(const CapturedItem& captured) {
        const auto& content = dynamic_cast<const DeformContent&>(*captured.content);
        const void* mesh_identity = captured.item->parts().front()->identity();
        const auto mesh = std::dynamic_pointer_cast<const MeshContent>(state_.find(mesh_identity));
        const DeformSetup setup = content.setup();
        if (setup.rest->region().topology().get() != &mesh->topology()) {
            left_out_.push_back("a deformation whose mesh has another topology by now");
            return;
        }
        DeformRecord record = record_of(setup, *content.shown(), mesh->mesh());
        record.mesh = place_of(mesh_identity);
        put(captured.item->identity(), ItemKind::deformation).deformation = std::move(record);
    }

    // A head that is not an object is an item that no object shows.
    void add_hairstyle(const CapturedItem& captured) {
        const auto& item = dynamic_cast<const HairstyleItem&>(*captured.item);
        const auto& content = dynamic_cast<const HairstyleContent&>(*captured.content);
        HairstyleRecord record = record_of(item.style(), content.inputs());
        const void* identity = item.head() ? item.head()->identity() : item.identity();
        const Mesh head = item.head_as_it_was();
        const bool in_scene = state_.find(identity) && item.is_head_unchanged();
        const void* key = in_scene ? identity : static_cast<const void*>(&item.style().head());
        add_mesh(key, head);
        record.head = place_of(key);
        put(item.identity(), ItemKind::hairstyle).hairstyle = std::move(record);
    }

    void add(const NamedObject& object) {
        const Index place = place_of(object.item->identity());
        if (place != kNoIndex) scene_.objects.push_back({object.name, place, object.look});
    }

    const SceneState& state_;
    const Context& context_;
    SceneRecord scene_;
    std::vector<const void*> identities_;
    std::vector<std::string> left_out_;
};

// ---- From records to items

class SceneMaker {
  public:
    SceneMaker(ItemMaker& maker, const Context& context) : maker_(maker), context_(context) {}

    void make(SceneRecord record, Scene& scene) {
        for (ItemRecord& item : record.items) {
            context_.checkpoint();
            items_.push_back(made(item));
            item = {};
        }
        for (ObjectRecord& object : record.objects) {
            const bool known = object.item >= 0 && object.item < count_of(items_);
            require(known, "an object of the scene shows nothing", ErrorCode::file_syntax);
            scene.add(object.name, items_[at(object.item)], std::move(object.look));
        }
    }

  private:
    std::shared_ptr<SceneItem> made(ItemRecord& record) {
        meshes_.emplace_back();
        switch (record.kind) {
            case ItemKind::mesh: {
                Mesh mesh = mesh_of(std::move(record.mesh), context_);
                meshes_.back() = std::make_shared<const Mesh>(mesh);
                return maker_.make_mesh(std::move(mesh));
            }
            case ItemKind::strands:
                return maker_.make_strands(strands_of(std::move(record.strands)));
            case ItemKind::polyline:
                return maker_.make_polyline(std::move(record.polyline));
            case ItemKind::deformation: {
                const Index mesh = record.deformation.mesh;
                Deformer deformer =
                    deformer_of(std::move(record.deformation), mesh_at(mesh), context_);
                return maker_.make_deformation(std::move(deformer), items_[at(mesh)]);
            }
            case ItemKind::hairstyle: {
                const Index head = record.hairstyle.head;
                Hairstyle style =
                    hairstyle_of(std::move(record.hairstyle), mesh_at(head), context_);
                return maker_.make_hairstyle(std::move(style), items_[at(head)]);
            }
        }
        throw Error(ErrorCode::internal, "an item of no kind");
    }

    const Mesh& mesh_at(Index place) const {
        const bool known = place >= 0 && place < count_of(items_) && meshes_[at(place)];
        require(known, "an item of the scene needs a mesh that is not there",
                ErrorCode::file_syntax);
        return *meshes_[at(place)];
    }

    ItemMaker& maker_;
    const Context& context_;
    std::vector<std::shared_ptr<SceneItem>> items_;
    // By item; null for those of other kinds.
    std::vector<std::shared_ptr<const Mesh>> meshes_;
};

SceneRecord read_record(std::string_view bytes) {
    const PartReader parts(bytes);
    const std::string_view manifest = parts.find(kManifest);
    // Deep nesting would exhaust the stack of the parser.
    constexpr int kDeepest = 32;
    const auto callback = [](int depth, SceneJson::parse_event_t, SceneJson&) {
        require(depth <= kDeepest, "the scene is nested too deeply", ErrorCode::file_syntax);
        return true;
    };
    try {
        const SceneJson json = SceneJson::parse(manifest.begin(), manifest.end(), callback);
        SceneRecord record;
        SceneReader reader(json, parts, "");
        describe(reader, record);
        return record;
    } catch (const SceneJson::exception& error) {
        throw Error(ErrorCode::file_syntax, std::string("the scene's text: ") + error.what());
    }
}

// What an object refuses is a fault of the file.
[[noreturn]] void refuse_content(const Error& error) {
    constexpr ErrorCode kOwn[] = {ErrorCode::memory_limit, ErrorCode::cancelled,
                                  ErrorCode::unsupported, ErrorCode::file_truncated};
    const bool own = std::find(std::begin(kOwn), std::end(kOwn), error.code()) != std::end(kOwn);
    throw Error(own ? error.code() : ErrorCode::file_syntax, error.message(), error.elements());
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

EncodedScene encode_scene(const SceneState& state, const Context& context) {
    return with_memory_errors([&] {
        SceneRecorder recorder(state, context);
        SceneRecord record = recorder.record();
        SceneJson json = SceneJson::object();
        PartWriter parts;
        SceneWriter writer(json, parts, "");
        describe(writer, record);
        parts.add(kManifest, json.dump(1, ' ', false, SceneJson::error_handler_t::replace));
        return EncodedScene{std::move(parts).finish(), recorder.left_out()};
    });
}

void decode_scene(std::string_view bytes, Scene& scene, ItemMaker& maker, const Context& context) {
    require(scene.objects().empty() && scene.depth() == 0,
            "a scene is loaded into an empty one; remove its objects and end its steps before");
    with_memory_errors([&] {
        try {
            SceneRecord record = read_record(bytes);
            scene.step("load", [&] { SceneMaker(maker, context).make(std::move(record), scene); });
        } catch (const Error& error) {
            refuse_content(error);
        }
        scene.clear_history();
    });
}

std::vector<std::string> save_scene(Scene& scene, const std::filesystem::path& path,
                                    const Context& context) {
    return with_memory_errors([&] {
        require_folder_of(path);
        EncodedScene encoded = encode_scene(*scene.state(), context);
        write_file_atomically(path, encoded.bytes, context);
        return std::move(encoded.left_out);
    });
}

void load_scene(const std::filesystem::path& path, Scene& scene, ItemMaker& maker,
                const Context& context) {
    const FileContent file = read_file(path, context);
    try {
        decode_scene(file.bytes, scene, maker, context);
    } catch (const Error& error) {
        throw Error(error.code(), display_name(path) + ": " + error.message(), error.elements());
    }
}

}  // namespace lissom
