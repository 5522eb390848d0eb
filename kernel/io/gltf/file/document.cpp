#include "kernel/io/gltf/file/document.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

#include "kernel/io/gltf/file/compressed.h"
#include "kernel/io/gltf/file/container.h"
#include "kernel/io/gltf/file/extensions.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

constexpr std::size_t kMinBudget = std::size_t{1} << 20;
constexpr std::size_t kElementsPerByte = 16;

// Some programs write whole numbers as 4.0, which JSON does not tell from 4.
void restore_integers(Json& json) {
    constexpr double kLargest = 9007199254740992.0;
    if (json.is_structured()) {
        for (Json& item : json) restore_integers(item);
    } else if (json.is_number_float()) {
        const double value = json.get<double>();
        const bool is_whole =
            !std::signbit(value) && value <= kLargest && value == std::floor(value);
        if (is_whole) json = static_cast<std::uint64_t>(value);
    }
}

// Bytes that the values of a text take while it is read: as values, as their copy for the parser
// and that of the parser, and as elements of its model.
std::size_t bytes_of_values(std::string_view text) {
    constexpr std::size_t kValue = 48, kMember = 128, kBracket = 64, kElement = 768, kCopies = 3;
    std::size_t bytes = text.size(), objects = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\') {
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted) {
            if (c == ',') bytes += kValue;
            if (c == ':') bytes += kMember;
            if (c == '{' || c == '[') bytes += kBracket;
            if (c == '{') ++objects;
        }
    }
    return kCopies * bytes + kElement * objects;
}

Json parse_json(std::string_view text) {
    require_shallow(text);
    // A GLB chunk may be padded with zeros by careless writers.
    while (text.ends_with('\0')) text.remove_suffix(1);
    try {
        Json json = Json::parse(text);
        restore_integers(json);
        if (json.is_object()) return json;
    } catch (const Json::exception& error) {
        refuse(ErrorCode::file_syntax, "the JSON cannot be read: " + without_tag(error.what()));
    }
    refuse(ErrorCode::file_syntax, "the JSON is not an object, as that of a glTF file is");
}

void require_gltf_2(const Json& json) {
    const Json* asset = member(json, "asset");
    const std::string version = asset ? text_member(*asset, "version") : "";
    const std::string needed = asset ? text_member(*asset, "minVersion") : "";
    // The first version had objects in place of the second's lists, and need not name itself.
    const Json* meshes = member(json, "meshes");
    const bool is_first =
        version.starts_with("1.") || (version.empty() && meshes && meshes->is_object());
    if (is_first) {
        refuse(ErrorCode::unsupported,
               "the file is glTF 1.0, but only glTF 2.0 is read; convert it first");
    }
    if (version.empty()) refuse(ErrorCode::file_syntax, "the version of glTF is not given");
    const std::string& binding = needed.empty() ? version : needed;
    const bool is_read = needed.empty() ? binding.starts_with("2.") : binding == "2.0";
    if (!is_read) {
        refuse(ErrorCode::unsupported,
               "the file needs glTF " + binding + ", but only glTF 2.0 is read");
    }
}

void require_lists(const Json& json) {
    for (const char* key :
         {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
          "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
        const Json* list = member(json, key);
        if (!list) continue;
        const bool is_list =
            list->is_array() && std::all_of(list->begin(), list->end(),
                                            [](const Json& item) { return item.is_object(); });
        if (!is_list) {
            refuse(ErrorCode::file_syntax, "'" + std::string(key) + "' is not a list of objects");
        }
    }
    if (const Json* meshes = member(json, "meshes")) {
        for (const Json& mesh : *meshes) {
            const Json* primitives = member(mesh, "primitives");
            if (primitives && primitives->is_array()) continue;
            refuse(ErrorCode::file_syntax, "a mesh has no list of primitives");
        }
    }
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const Json* list = member(json, key);
        if (list && !list->is_array()) {
            refuse(ErrorCode::file_syntax, "'" + std::string(key) + "' is not a list");
        }
    }
}

// Opens the buffers and images of one document.
class Loader {
  public:
    Loader(const FileInput& file, GltfDocument& document, Report& report, const Context& context)
        : document_(document), folder_(file.folder, context), report_(report) {}

    void load_buffers(std::optional<std::string_view> binary) {
        Json* buffers = member(document_.json, "buffers");
        for (std::size_t i = 0; buffers && i < buffers->size(); ++i) {
            const bool is_chunk = i == 0 && binary && !(*buffers)[i].contains("uri");
            document_.buffers.push_back(is_chunk ? part(*binary, length_of((*buffers)[i], i), i)
                                                 : buffer((*buffers)[i], i));
        }
        document_.bytes_read += folder_.bytes_read();
    }

    void load_images() {
        Json* images = member(document_.json, "images");
        for (std::size_t i = 0; images && i < images->size(); ++i) {
            document_.images.push_back(image((*images)[i], i));
        }
        if (!missing_.empty()) {
            report_.add(FindingKind::files_missing, missing_count_, "images " + missing_);
        }
    }

  private:
    static std::uint64_t length_of(const Json& buffer, std::size_t number) {
        const Json* length = member(buffer, "byteLength");
        if (length && length->is_number_unsigned()) return length->get<std::uint64_t>();
        refuse(ErrorCode::file_syntax, "buffer " + std::to_string(number) + " has no length");
    }

    static std::string_view part(std::string_view bytes, std::uint64_t length, std::size_t number) {
        if (bytes.size() >= length) return bytes.substr(0, static_cast<std::size_t>(length));
        refuse(ErrorCode::file_truncated, "buffer " + std::to_string(number) + " has " +
                                              std::to_string(bytes.size()) + " of its " +
                                              std::to_string(length) + " bytes");
    }

    std::string_view buffer(Json& json, std::size_t number) {
        const std::uint64_t length = length_of(json, number);
        const Json* uri = member(json, "uri");
        if (!uri) return {};
        if (!uri->is_string()) refuse(ErrorCode::file_syntax, "the URI of a buffer is not a text");
        const std::string& text = uri->get_ref<const std::string&>();
        SharedBytes content;
        if (std::optional<UriData> data = decode_data_uri(text)) {
            content = std::make_shared<const std::string>(std::move(data->bytes));
        } else {
            content = folder_.read(text, length);
        }
        json.erase("uri");
        document_.owned.push_back(content);
        return part(*content, length, number);
    }

    SharedBytes image(Json& json, std::size_t number) {
        const int view = index_member(json, "bufferView", "image " + std::to_string(number));
        if (view >= 0) return image_of_view(view);
        const std::string uri = text_member(json, "uri");
        if (uri.empty()) return nullptr;
        if (std::optional<UriData> data = decode_data_uri(uri)) {
            if (!json.contains("mimeType")) json["mimeType"] = data->media_type;
            json.erase("uri");
            return std::make_shared<const std::string>(std::move(data->bytes));
        }
        std::string why;
        SharedBytes content = file_of_image(uri, why);
        if (!content) {
            constexpr std::size_t kShown = 10;
            if (++missing_count_ <= kShown) {
                missing_ += (missing_.empty() ? "" : ", ") + in_quotes(uri) + why;
            }
        }
        return content;
    }

    // Null, with the reason, for a picture that cannot be read: the surface is still read.
    SharedBytes file_of_image(std::string uri, std::string& why) {
        // Programs for Windows write its separators.
        std::replace(uri.begin(), uri.end(), '\\', '/');
        try {
            return folder_.read_if_there(uri);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::unsafe_path) {
                why = " (outside the folder of the file, which is not read)";
            } else if (error.code() == ErrorCode::file_unreadable) {
                why = " (cannot be read)";
            } else {
                throw;
            }
        }
        return nullptr;
    }

    SharedBytes image_of_view(std::size_t view) {
        SharedBytes& content = image_of_view_[view];
        if (!content) {
            const std::string_view bytes = bytes_of_view(document_, view);
            image_bytes_ += bytes.size();
            if (image_bytes_ > 4 * document_.bytes_read) {
                refuse(ErrorCode::file_too_large, "the images overlap in the file");
            }
            content = std::make_shared<const std::string>(bytes);
        }
        return content;
    }

    GltfDocument& document_;
    GltfFolder folder_;
    Report& report_;
    std::map<std::size_t, SharedBytes> image_of_view_;
    std::size_t image_bytes_ = 0, missing_count_ = 0;
    std::string missing_;
};

// Returns the input of tinygltf: everything without references to bytes outside the text. Skins and
// animations are not given to it either, because it refuses some that glTF allows.
Json part_for_parser(Json json) {
    for (const char* key : {"buffers", "images", "skins", "animations"}) json.erase(key);
    return json;
}

// tinygltf refuses indices without a buffer view, which are zeros. Gives all accessors without one
// a view that is added at the end, and returns which these are.
std::vector<std::size_t> add_stand_in_view(Json& json) {
    std::vector<std::size_t> without_view;
    Json& views = json["bufferViews"];
    if (views.is_null()) views = Json::array();
    Json* accessors = member(json, "accessors");
    for (std::size_t a = 0; accessors && a < accessors->size(); ++a) {
        if ((*accessors)[a].contains("bufferView")) continue;
        (*accessors)[a]["bufferView"] = views.size();
        without_view.push_back(a);
    }
    views.push_back(json_object({{"buffer", 0}, {"byteLength", 1}}));
    return without_view;
}

void remove_stand_in_view(tinygltf::Model& model, const std::vector<std::size_t>& without_view) {
    for (const std::size_t a : without_view) model.accessors[a].bufferView = -1;
    model.bufferViews.pop_back();
}

std::string one_line_of(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

tinygltf::Model parse_model(const Json& json) {
    Json part = part_for_parser(json);
    const std::vector<std::size_t> without_view = add_stand_in_view(part);
    const std::string text = to_text(part);
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    bool good = false;
    try {
        good = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                          static_cast<unsigned int>(text.size()), "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    // The parser catches exceptions of JSON's reader and keeps their text alone.
    if (error.find(std::bad_alloc().what()) != std::string::npos) throw std::bad_alloc();
    if (!good || !error.empty()) refuse(ErrorCode::file_syntax, one_line_of(error));
    remove_stand_in_view(model, without_view);
    return model;
}

}  // namespace

GltfBudget::GltfBudget(std::size_t bytes_read)
    : left_(std::max(kMinBudget, kElementsPerByte * bytes_read)) {}

void GltfBudget::require(std::size_t elements) const {
    if (allows(elements)) return;
    refuse(ErrorCode::file_too_large,
           "the surface would be many times larger than the file; it repeats itself too often");
}

void GltfBudget::charge(std::size_t elements) {
    require(elements);
    left_ -= elements;
}

std::string_view bytes_of_view(const GltfDocument& document, std::size_t number) {
    const std::string name = "buffer view " + std::to_string(number);
    if (number >= document.model.bufferViews.size()) {
        refuse(ErrorCode::file_syntax, name + " does not exist");
    }
    const tinygltf::BufferView& view = document.model.bufferViews[number];
    if (view.buffer < 0 || at(view.buffer) >= document.buffers.size()) {
        refuse(ErrorCode::file_syntax, name + " is in a buffer that does not exist");
    }
    const std::string_view buffer = document.buffers[view.buffer];
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
        refuse(ErrorCode::file_syntax, name + " reaches beyond the end of its buffer");
    }
    return buffer.substr(view.byteOffset, view.byteLength);
}

GltfDocument open_gltf(const FileInput& file, Report& report, const Context& context) {
    const GltfContainer container = open_gltf_container(file.bytes);
    GltfDocument document;
    document.values =
        context.charge(bytes_of_values(container.json), "the elements of a glTF file");
    document.json = parse_json(container.json);
    document.bytes_read = file.bytes.size();
    require_gltf_2(document.json);
    require_lists(document.json);
    require_supported_extensions(document.json);
    Loader loader(file, document, report, context);
    loader.load_buffers(container.binary);
    document.charge = context.charge(2 * document.bytes_read, "the content of a glTF file");
    decompress(document, context);
    document.model = parse_model(document.json);
    loader.load_images();
    return document;
}

}  // namespace lissom
