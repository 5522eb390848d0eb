#include "bindings/cli/json.h"

#include "bindings/lua/failure.h"

namespace lissom::cli {
namespace {

Json elements_json(const Elements& elements) {
    Json ids = Json::array();
    if (elements.kind == ElementKind::edge) {
        for (std::size_t i = 0; i + 1 < elements.ids.size(); i += 2) {
            ids.push_back({elements.ids[i] + 1, elements.ids[i + 1] + 1});
        }
    } else {
        for (const Index id : elements.ids) ids.push_back(id + 1);
    }
    return {{"kind", std::string(kind_name(elements.kind))},
            {"count", elements.count},
            {"ids", std::move(ids)}};
}

Json vector_json(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

Json error_json(const Error& error) {
    Json json = {{"message", lua::lua_message(error)},
                 {"code", std::string(code_name(error.code()))}};
    if (error.elements().kind != ElementKind::none)
        json["elements"] = elements_json(error.elements());
    return json;
}

Json bounds_json(const Box& box) {
    if (box.empty()) return nullptr;
    return {{"min", vector_json(box.min)},
            {"max", vector_json(box.max)},
            {"center", vector_json(box.center())},
            {"diagonal", box.diagonal()}};
}

std::string json_text(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lissom::cli
