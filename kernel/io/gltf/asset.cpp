#include "kernel/io/gltf/asset.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "kernel/io/gltf/file/extensions.h"
#include "kernel/io/gltf/file/extras.h"
#include "kernel/io/gltf/join.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

constexpr std::size_t kKeptPerByte = 4, kMinKept = std::size_t{1} << 20;

// Copies accessors out of a document.
class AccessorKeeper {
  public:
    AccessorKeeper(const GltfDocument& document, const AccessorReader& reader, GltfAsset& asset)
        : document_(document),
          reader_(reader),
          asset_(asset),
          left_(std::max(kMinKept, kKeptPerByte * document.bytes_read)) {}

    // Replaces the number of an accessor, if there is one, by that of its copy. Returns the copy.
    KeptAccessor* keep(Json& object, const char* key, const std::string& owner) {
        const int number = index_member(object, key, owner);
        if (number < 0) return nullptr;
        const auto [known, is_new] = copies_.emplace(number, asset_.accessors.size());
        if (is_new) asset_.accessors.push_back(copy(number));
        object[key] = known->second;
        return &asset_.accessors[known->second];
    }

  private:
    KeptAccessor copy(int number) {
        const PackedNumbers packed = reader_.packed(number);
        if (packed.bytes.size() > left_) {
            refuse(ErrorCode::file_too_large,
                   "the data of animations and skins overlap in the file");
        }
        left_ -= packed.bytes.size();
        Json json = document_.json["accessors"][number];
        for (const char* key : {"bufferView", "byteOffset", "sparse", "extensions", "min", "max"}) {
            json.erase(key);
        }
        return {std::move(json), std::make_shared<const std::string>(packed.bytes)};
    }

    const GltfDocument& document_;
    const AccessorReader& reader_;
    GltfAsset& asset_;
    std::map<int, std::size_t> copies_;
    std::size_t left_;
};

// Times of animations have bounds.
void add_bounds(KeptAccessor& times) {
    if (times.json.value("componentType", 0) != TINYGLTF_COMPONENT_TYPE_FLOAT) return;
    ByteReader reader(*times.bytes, Endianness::little);
    double least = 0.0, largest = 0.0;
    for (bool is_first = true; reader.remaining() >= sizeof(float); is_first = false) {
        const double time = reader.read<float>();
        least = is_first ? time : std::min(least, time);
        largest = is_first ? time : std::max(largest, time);
    }
    times.json["min"] = Json::array({least});
    times.json["max"] = Json::array({largest});
}

// The last row of an affine matrix is known; files have been seen with garbage in it.
void restore_last_rows(KeptAccessor& kept) {
    constexpr std::size_t kFloats = 16, kBytes = kFloats * sizeof(float);
    const bool are_floats = kept.json.value("componentType", 0) == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (text_member(kept.json, "type") != "MAT4" || !are_floats) return;
    std::string bytes = *kept.bytes;
    for (std::size_t at = 0; at + kBytes <= bytes.size(); at += kBytes) {
        for (std::size_t column = 0; column < 4; ++column) {
            const auto value = to_bytes(column == 3 ? 1.0f : 0.0f, Endianness::little);
            std::copy(value.begin(), value.end(),
                      bytes.data() + at + (4 * column + 3) * sizeof(float));
        }
    }
    if (bytes == *kept.bytes) return;
    kept.bytes = std::make_shared<const std::string>(std::move(bytes));
}

void keep_accessors(Json& json, AccessorKeeper& keeper, GltfAsset& asset) {
    if (Json* skins = member(json, "skins")) {
        for (Json& skin : *skins) keeper.keep(skin, "inverseBindMatrices", "a skin");
    }
    for (KeptAccessor& kept : asset.accessors) restore_last_rows(kept);
    Json* animations = member(json, "animations");
    if (!animations) return;
    for (Json& animation : *animations) {
        Json* samplers = member(animation, "samplers");
        if (!samplers || !samplers->is_array()) continue;
        for (Json& sampler : *samplers) {
            if (KeptAccessor* times = keeper.keep(sampler, "input", "an animation")) {
                add_bounds(*times);
            }
            keeper.keep(sampler, "output", "an animation");
        }
    }
}

// Names that are no text, and references of nodes that are none.
void repair_members(Json& json) {
    for_each_object(json, [](Json& object) {
        const Json* name = member(object, "name");
        if (name && !name->is_string()) object.erase("name");
    });
    const Json* nodes = member(json, "nodes");
    if (!nodes) return;
    for (const Json& node : *nodes) {
        for (const char* key : {"mesh", "skin", "camera"}) index_member(node, key, "a node");
    }
}

// Returns a primitive without its surface, or null.
Json reduced(const Json& primitive) {
    Json rest;
    for (const char* key : {"extras", "extensions"}) {
        if (const Json* value = member(primitive, key)) rest[key] = *value;
    }
    if (!rest.is_null() && primitive.contains("material")) rest["material"] = primitive["material"];
    return rest;
}

void reduce_meshes(Json& json) {
    Json* meshes = member(json, "meshes");
    if (!meshes) return;
    for (Json& mesh : *meshes) {
        bool fits = true;
        take_extras(mesh, 0, 0, fits);
        Json primitives = Json::array();
        if (const Json* all = member(mesh, "primitives"); all && all->is_array()) {
            for (const Json& primitive : *all) {
                Json rest = reduced(primitive);
                if (!rest.is_null()) primitives.push_back(std::move(rest));
            }
        }
        mesh.erase("primitives");
        if (!primitives.empty()) mesh["primitives"] = std::move(primitives);
    }
}

struct MediaType {
    std::string_view begin, type;
};

// Types that glTF and its extensions know, and others found for textures.
constexpr MediaType kMediaTypes[] = {
    {"\x89PNG", "image/png"},
    {"\xff\xd8\xff", "image/jpeg"},
    {"\xabKTX 20", "image/ktx2"},
    {"\xabKTX 11", "image/ktx"},
    {"DDS ", "image/vnd-ms.dds"},
    {"GIF8", "image/gif"},
    {"BM", "image/bmp"},
    {"II*", "image/tiff"},
    {"MM", "image/tiff"},
    {"#?RADIANCE", "image/vnd.radiance"},
    {"\x76\x2f\x31\x01", "image/x-exr"},
};

constexpr const char* kUnknownMediaType = "application/octet-stream";

// The type of an image by its first bytes, or "".
std::string sniffed_media_type(std::string_view bytes) {
    for (const MediaType& known : kMediaTypes) {
        if (bytes.starts_with(known.begin)) return std::string(known.type);
    }
    if (bytes.starts_with("RIFF") &&
        bytes.substr(std::min<std::size_t>(8, bytes.size())).starts_with("WEBP"))
        return "image/webp";
    const bool is_avif = bytes.size() > 8 && bytes.substr(4).starts_with("ftypavif");
    return is_avif ? "image/avif" : "";
}

void describe_images(Json& json, const std::vector<SharedBytes>& images) {
    Json* list = member(json, "images");
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        Json& image = (*list)[i];
        image.erase("bufferView");
        if (!images[i]) continue;
        const std::string uri = text_member(image, "uri");
        if (!uri.empty() && !image.contains("name")) image["name"] = uri;
        image.erase("uri");
        const std::string type = sniffed_media_type(*images[i]);
        if (!type.empty()) image["mimeType"] = type;
        // Images inside a file must have a type; readers detect the type of this one themselves.
        if (text_member(image, "mimeType").empty()) image["mimeType"] = kUnknownMediaType;
    }
}

}  // namespace

std::shared_ptr<const Asset> GltfAsset::joined(const Asset& other, LabelRenames& renames) const {
    auto result = std::make_shared<GltfAsset>(*this);
    const auto* added = dynamic_cast<const GltfAsset*>(&other);
    if (added && added->origin != origin && added->json != json) {
        join_assets(*result, *added, renames);
        result->origin = std::make_shared<const int>(0);
    }
    result->from_libraries = from_libraries && (!added || added->from_libraries);
    return result;
}

std::size_t GltfAsset::memory_bytes() const {
    // Approximate memory of the JSON per node.
    constexpr std::size_t kBytesPerNode = 256;
    std::size_t bytes = kBytesPerNode * json.size();
    if (const Json* nodes = member(json, "nodes")) bytes += kBytesPerNode * nodes->size();
    for (const KeptAccessor& accessor : accessors) bytes += accessor.bytes->size();
    for (const SharedBytes& image : images) bytes += image ? image->size() : 0;
    return bytes;
}

std::shared_ptr<const GltfAsset> keep_asset(GltfDocument& document, const AccessorReader& accessors,
                                            const std::vector<GltfInstance>& instances,
                                            const std::vector<std::string>& materials,
                                            Report& report) {
    auto asset = std::make_shared<GltfAsset>();
    drop_bound_extensions(document.json, report);
    repair_members(document.json);
    AccessorKeeper keeper(document, accessors, *asset);
    keep_accessors(document.json, keeper, *asset);
    for (const char* key : {"accessors", "bufferViews", "buffers"}) document.json.erase(key);
    reduce_meshes(document.json);
    describe_images(document.json, document.images);
    asset->images = std::move(document.images);
    for (const GltfInstance& instance : instances) {
        if (instance.node < 0) continue;
        asset->node_of_object[instance.label] = instance.node;
    }
    for (std::size_t m = 0; m < materials.size(); ++m) asset->material_of_label[materials[m]] = m;
    asset->json = std::move(document.json);
    return asset;
}

}  // namespace lissom
