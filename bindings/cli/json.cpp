#include "bindings/cli/json.h"

#include <algorithm>

#include "bindings/lua/core/failure.h"

namespace lissom::cli {
namespace {

// The first ids, from 1; pairs of vertices for edges.
Json ids_json(ElementKind kind, const std::vector<Index>& ids) {
    const std::size_t per_element = kind == ElementKind::edge ? 2 : 1;
    const std::size_t count = std::min(ids.size() / per_element, Elements::kMaximumIds);
    Json list = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
        if (per_element == 2) {
            list.push_back({ids[2 * i] + 1, ids[2 * i + 1] + 1});
        } else {
            list.push_back(ids[i] + 1);
        }
    }
    return list;
}

Json elements_json(const Elements& elements) {
    return {{"kind", std::string(kind_name(elements.kind))},
            {"count", elements.count},
            {"ids", ids_json(elements.kind, elements.ids)}};
}

Json finding_json(const Finding& finding) {
    Json json = {{"kind", std::string(finding_name(finding.kind))}, {"count", finding.count}};
    json["element"] = nullptr;
    if (finding.element != ElementKind::none) {
        json["element"] = std::string(kind_name(finding.element));
    }
    json["of"] = finding.in_file ? "file" : "mesh";
    json["ids"] = ids_json(finding.element, finding.ids);
    json["message"] = finding.message;
    return json;
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

Json report_json(const Report& report) {
    Json list = Json::array();
    for (const Finding& finding : report.findings()) list.push_back(finding_json(finding));
    return list;
}

Json bounds_json(const Box& box) {
    if (box.empty()) return nullptr;
    return {{"min", vector_json(box.min)},
            {"max", vector_json(box.max)},
            {"center", vector_json(box.center())},
            {"diagonal", box.diagonal()}};
}

bool is_utf8(const std::string& text) {
    try {
        return !Json(text).dump().empty();
    } catch (const Json::type_error&) {
        return false;
    }
}

std::string json_text(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lissom::cli
