#include "kernel/io/gltf/file/extensions.h"

#include <algorithm>
#include <array>
#include <set>

#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/words.h"

namespace lissom {
namespace {

constexpr std::array<std::string_view, 12> kSupported{
    "KHR_mesh_quantization",   "KHR_texture_transform",
    "KHR_lights_punctual",     "EXT_texture_webp",
    "KHR_texture_basisu",      "KHR_node_visibility",
    "KHR_xmp_json_ld",         "FB_ngon_encoding",
    "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
    "EXT_meshopt_compression", "KHR_meshopt_compression"};

// Extensions of primitives that hold beside another surface.
constexpr std::array<std::string_view, 2> kKeptOnPrimitives{"KHR_materials_variants",
                                                            "KHR_xmp_json_ld"};

bool is_supported(std::string_view name) {
    return name.starts_with("KHR_materials_") || is_one_of(name, kSupported);
}

std::string joined(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

[[noreturn]] void refuse_extension(const std::string& names) {
    const bool is_compression = names.find("_compression") != std::string::npos;
    refuse(
        ErrorCode::unsupported,
        "the file cannot be read without the extension " + names +
            ", which is not known here; export it without" +
            (is_compression ? ", or decode it first, for instance with: gltf-transform copy IN OUT"
                            : ""));
}

bool refers_to_bytes(const Json& json) {
    bool found = false;
    for_each_object(json, [&](const Json& object) {
        for (const char* key :
             {"bufferView", "bufferViews", "accessor", "accessors", "propertyTables"}) {
            found = found || member(object, key);
        }
    });
    return found;
}

// Erases the extensions of `object` for which `is_lost(name, extension)`.
template <typename IsLost>
void drop(Json& object, std::set<std::string>& dropped, const IsLost& is_lost) {
    Json* extensions = member(object, "extensions");
    if (!extensions || !extensions->is_object()) return;
    for (auto it = extensions->begin(); it != extensions->end();) {
        if (!is_lost(it.key(), it.value())) {
            ++it;
            continue;
        }
        dropped.insert(it.key());
        it = extensions->erase(it);
    }
    if (extensions->empty()) object.erase("extensions");
}

// Those whose meaning is read from them, or which only say how bytes are stored.
bool is_spent(const std::string& name) {
    return name == "FB_ngon_encoding" || name == "KHR_draco_mesh_compression" ||
           name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression";
}

}  // namespace

void require_supported_extensions(const Json& document) {
    std::set<std::string> unknown;
    if (const Json* required = member(document, "extensionsRequired")) {
        for (const Json& name : *required) {
            if (name.is_string() && !is_supported(name.get<std::string>())) {
                unknown.insert(name.get<std::string>());
            }
        }
    }
    if (!unknown.empty()) refuse_extension(joined(unknown));
}

void drop_bound_extensions(Json& document, Report& report) {
    std::set<std::string> dropped, spent;
    for (const char* kind : {"accessors", "bufferViews", "buffers"}) {
        if (Json* list = member(document, kind)) {
            for (Json& object : *list) {
                drop(object, dropped, [](const auto&, const auto&) { return true; });
            }
        }
    }
    if (Json* meshes = member(document, "meshes")) {
        for (Json& mesh : *meshes) {
            if (!mesh.contains("primitives")) continue;
            for (Json& primitive : mesh["primitives"]) {
                drop(primitive, dropped, [](const auto& name, const auto&) {
                    return !is_one_of(name, kKeptOnPrimitives);
                });
            }
        }
    }
    for_each_object(document, [&](Json& object) {
        drop(object, dropped,
             [](const auto&, const auto& content) { return refers_to_bytes(content); });
    });
    std::erase_if(dropped, is_spent);
    if (!dropped.empty()) {
        report.add(FindingKind::extensions_dropped, dropped.size(), joined(dropped));
    }
}

std::vector<std::string> extensions_inside(const Json& document) {
    std::set<std::string> names;
    for_each_object(document, [&](const Json& object) {
        const Json* extensions = member(object, "extensions");
        if (!extensions || !extensions->is_object()) return;
        for (const auto& item : extensions->items()) names.insert(item.key());
    });
    return {names.begin(), names.end()};
}

}  // namespace lissom
