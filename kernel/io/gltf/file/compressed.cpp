#include "kernel/io/gltf/file/compressed.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "kernel/io/gltf/file/draco.h"
#include "kernel/io/gltf/file/meshopt.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
// Decompressed bytes of all views and primitives for each byte of the file.
constexpr std::size_t kMaxBytesPerByte = 256, kBytesAlwaysAllowed = std::size_t{1} << 24;

struct NamedType {
    int number;
    ScalarType type;
};

constexpr std::array<NamedType, 6> kComponentTypes{
    {{TINYGLTF_COMPONENT_TYPE_BYTE, ScalarType::int8},
     {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, ScalarType::uint8},
     {TINYGLTF_COMPONENT_TYPE_SHORT, ScalarType::int16},
     {TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, ScalarType::uint16},
     {TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, ScalarType::uint32},
     {TINYGLTF_COMPONENT_TYPE_FLOAT, ScalarType::float32}}};

constexpr std::array<const char*, 4> kTypeNames{"SCALAR", "VEC2", "VEC3", "VEC4"};

// The whole number `key`, or 0 if it is absent.
std::size_t whole_member(const Json& json, const char* key) {
    return static_cast<std::size_t>(
        std::max(index_member(json, key, "a compressed part of the file"), 0));
}

MeshoptMode mode_in(const Json& json) {
    const std::string name = text_member(json, "mode");
    if (name == "ATTRIBUTES") return MeshoptMode::attributes;
    if (name == "TRIANGLES") return MeshoptMode::triangles;
    if (name == "INDICES") return MeshoptMode::indices;
    refuse(ErrorCode::file_syntax,
           "EXT_meshopt_compression has the mode " + in_quotes(name) + ", which does not exist");
}

MeshoptFilter filter_in(const Json& json) {
    const std::string name = text_member(json, "filter");
    if (name.empty() || name == "NONE") return MeshoptFilter::none;
    if (name == "OCTAHEDRAL") return MeshoptFilter::octahedral;
    if (name == "QUATERNION") return MeshoptFilter::quaternion;
    if (name == "EXPONENTIAL") return MeshoptFilter::exponential;
    refuse(ErrorCode::unsupported, "EXT_meshopt_compression has the filter " + in_quotes(name) +
                                       ", which is not known here");
}

class Decompressor {
  public:
    Decompressor(GltfDocument& document, const Context& context)
        : document_(document),
          context_(context),
          left_(kMaxBytesPerByte * document.bytes_read + kBytesAlwaysAllowed) {}

    void decompress_views() {
        Json* views = member(document_.json, "bufferViews");
        for (std::size_t v = 0; views && v < views->size(); ++v) {
            for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
                context_.checkpoint();
                const Json* compressed = extension((*views)[v], name);
                if (compressed && compressed->is_object())
                    decompress_view((*views)[v], *compressed);
            }
        }
    }

    void decompress_primitives() {
        Json* meshes = member(document_.json, "meshes");
        for (std::size_t m = 0; meshes && m < meshes->size(); ++m) {
            for (Json& primitive : (*meshes)[m]["primitives"]) {
                context_.checkpoint();
                const Json* compressed = extension(primitive, kDraco);
                if (compressed && !has_plain_data(primitive)) {
                    decompress_primitive(primitive, *compressed);
                }
            }
        }
    }

  private:
    std::string_view part_of_buffer(const Json& place) const {
        const int buffer = index_member(place, "buffer", "a compressed part of the file");
        if (buffer < 0 || at(buffer) >= document_.buffers.size()) {
            refuse(ErrorCode::file_syntax, "compressed bytes are in a buffer that does not exist");
        }
        const std::string_view bytes = document_.buffers[at(buffer)];
        const std::size_t offset = whole_member(place, "byteOffset");
        const std::size_t length = whole_member(place, "byteLength");
        if (offset <= bytes.size() && length <= bytes.size() - offset) {
            return bytes.substr(offset, length);
        }
        refuse(ErrorCode::file_syntax, "compressed bytes reach beyond the end of their buffer");
    }

    // A file may hold the plain bytes too, for programs without the extension.
    bool has_plain_bytes(const Json& view) const {
        const std::size_t buffer = whole_member(view, "buffer");
        return buffer < document_.buffers.size() && !document_.buffers[buffer].empty();
    }

    void decompress_view(Json& view, const Json& compressed) {
        if (!has_meshopt() && has_plain_bytes(view)) return;
        MeshoptView description{mode_in(compressed), filter_in(compressed),
                                whole_member(compressed, "count"),
                                whole_member(compressed, "byteStride")};
        std::string bytes = decode_meshopt(part_of_buffer(compressed), description);
        const bool is_strided = view.contains("byteStride");
        Json plain = place_of(std::move(bytes));
        if (is_strided) plain["byteStride"] = view["byteStride"];
        view = std::move(plain);
    }

    // Adds a buffer and returns a view of all its bytes.
    Json place_of(std::string bytes) {
        if (bytes.size() > left_) {
            refuse(ErrorCode::file_too_large,
                   "the file would be many times larger when decompressed; it repeats itself too "
                   "often");
        }
        left_ -= bytes.size();
        charges_.emplace_back(context_.charge(bytes.size(), "decompressed parts of a glTF file"));
        Json view =
            json_object({{"buffer", document_.buffers.size()}, {"byteLength", bytes.size()}});
        document_.owned.push_back(std::make_shared<const std::string>(std::move(bytes)));
        document_.buffers.push_back(*document_.owned.back());
        return view;
    }

    std::size_t add_view(std::string bytes) {
        Json& views = list_in(document_.json, "bufferViews");
        Json view = place_of(std::move(bytes));
        views.push_back(std::move(view));
        return views.size() - 1;
    }

    Json& accessor(int number) {
        Json* list = member(document_.json, "accessors");
        if (number >= 0 && list && at(number) < list->size()) return (*list)[at(number)];
        refuse(ErrorCode::file_syntax, "a compressed primitive has no accessor for an attribute");
    }

    bool has_plain_data(const Json& primitive) {
        const Json* attributes = member(primitive, "attributes");
        const int position = attributes ? index_member(*attributes, "POSITION", "a primitive") : -1;
        if (position < 0) return false;
        const int view = index_member(accessor(position), "bufferView", "an accessor");
        return view >= 0 && !filled_.contains(position);
    }

    static DracoWanted wanted_by(const Json& accessor, std::uint32_t id) {
        DracoWanted wanted;
        wanted.id = id;
        const int number = index_member(accessor, "componentType", "an accessor");
        const auto* type = std::find_if(kComponentTypes.begin(), kComponentTypes.end(),
                                        [&](const NamedType& t) { return t.number == number; });
        const auto* name =
            std::find(kTypeNames.begin(), kTypeNames.end(), text_member(accessor, "type"));
        if (type == kComponentTypes.end() || name == kTypeNames.end()) {
            refuse(ErrorCode::file_syntax,
                   "the accessor of a compressed attribute holds neither numbers nor vectors");
        }
        wanted.type = type->type;
        wanted.width = static_cast<Index>(name - kTypeNames.begin()) + 1;
        return wanted;
    }

    void decompress_primitive(Json& primitive, const Json& compressed) {
        std::vector<int> accessors;
        std::vector<DracoWanted> wanted;
        const Json* ids = member(compressed, "attributes");
        const Json* attributes = member(primitive, "attributes");
        if (!ids || !ids->is_object() || !attributes) {
            refuse(ErrorCode::file_syntax, "a compressed primitive names no attributes");
        }
        for (const auto& item : ids->items()) {
            const int number = index_member(*attributes, item.key().c_str(), "a primitive");
            if (number < 0) continue;
            const int id = index_member(*ids, item.key().c_str(), "a compressed primitive");
            accessors.push_back(number);
            wanted.push_back(wanted_by(accessor(number), static_cast<std::uint32_t>(id)));
        }
        const int view = index_member(compressed, "bufferView", "a compressed primitive");
        const Json* views = member(document_.json, "bufferViews");
        if (view < 0 || !views || at(view) >= views->size()) {
            refuse(ErrorCode::file_syntax, "a compressed primitive has no buffer view");
        }
        DracoPrimitive decoded = decode_draco(part_of_buffer((*views)[at(view)]), wanted);
        for (std::size_t a = 0; a < accessors.size(); ++a) {
            fill(accessors[a], std::move(decoded.attributes[a]), decoded.vertex_count);
        }
        fill_indices(primitive, decoded.indices);
    }

    // Primitives may share an accessor; it is filled once.
    void fill(int number, std::string bytes, std::size_t count) {
        if (!filled_.emplace(number, count).second) return;
        const std::size_t view = add_view(std::move(bytes));
        Json& json = accessor(number);
        json["bufferView"] = view;
        json["byteOffset"] = 0;
        json["count"] = count;
    }

    void fill_indices(Json& primitive, const std::vector<std::uint32_t>& indices) {
        std::string bytes;
        bytes.reserve(indices.size() * sizeof(std::uint32_t));
        for (const std::uint32_t index : indices) append_number(bytes, index, Endianness::little);
        Json json = json_object({{"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                                 {"count", indices.size()},
                                 {"type", "SCALAR"}});
        json["bufferView"] = add_view(std::move(bytes));
        Json& list = list_in(document_.json, "accessors");
        list.push_back(std::move(json));
        primitive["indices"] = list.size() - 1;
        primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
    }

    GltfDocument& document_;
    const Context& context_;
    std::size_t left_;
    std::map<int, std::size_t> filled_;
    std::vector<MemoryCharge>& charges_ = document_.decompressed;
};

}  // namespace

void decompress(GltfDocument& document, const Context& context) {
    Decompressor decompressor(document, context);
    decompressor.decompress_views();
    decompressor.decompress_primitives();
}

}  // namespace lissom
