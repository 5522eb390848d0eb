#include "kernel/io/gltf/file/json.h"

#include "kernel/io/stream/read_error.h"

namespace lissom {

const Json* member(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

Json* member(Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const Json* extension(const Json& object, const char* name) {
    const Json* extensions = member(object, "extensions");
    return extensions ? member(*extensions, name) : nullptr;
}

int index_member(const Json& object, const char* key, const std::string& owner) {
    const Json* value = member(object, key);
    if (!value) return -1;
    if (value->is_number_unsigned() && value->get<std::uint64_t>() <= 0x7fffffff) {
        return value->get<int>();
    }
    refuse(ErrorCode::file_syntax,
           "'" + std::string(key) + "' of " + owner + " is not the number of an element");
}

std::string text_member(const Json& object, const char* key) {
    const Json* value = member(object, key);
    return value && value->is_string() ? value->get<std::string>() : std::string();
}

std::size_t size_of_member(const Json& object, const char* key) {
    const Json* value = member(object, key);
    return value && value->is_array() ? value->size() : 0;
}

Json& object_in(Json& parent, const char* key) {
    Json& value = parent[key];
    if (!value.is_object()) value = Json::object();
    return value;
}

std::string to_text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json& list_in(Json& json, const char* key) {
    Json& list = json[key];
    if (!list.is_array()) list = Json::array();
    return list;
}

}  // namespace lissom
