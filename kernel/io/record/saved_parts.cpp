#include "kernel/io/record/saved_parts.h"

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

Index element_count(const Mesh& mesh, Domain domain) {
    switch (domain) {
        case Domain::vertex:
            return mesh.vertex_count();
        case Domain::corner:
            return mesh.topology().corner_count();
        default:
            return mesh.face_count();
    }
}

std::string_view domain_name(Domain domain) {
    switch (domain) {
        case Domain::vertex:
            return "vertex";
        case Domain::corner:
            return "corner";
        default:
            return "face";
    }
}

void require_fit(const Mesh& mesh, const Attribute& attribute) {
    const auto expected = at(element_count(mesh, attribute.domain)) * attribute.width;
    if (attribute.values.size() == expected) return;
    throw Error(ErrorCode::invalid_argument, "attribute " + in_quotes(attribute.name) + " has " +
                                                 std::to_string(attribute.values.size()) +
                                                 " values, but the mesh needs " +
                                                 std::to_string(expected));
}

void require_fit(const Mesh& mesh, const std::string& kind, const FaceLabels& labels) {
    const auto names = count_of(labels.names);
    const bool fits = labels.of_face.size() == at(mesh.face_count()) &&
                      std::all_of(labels.of_face.begin(), labels.of_face.end(),
                                  [&](Index i) { return i >= kNoIndex && i < names; });
    if (fits) return;
    throw Error(
        ErrorCode::invalid_argument,
        "labels " + in_quotes(kind) + " do not give one of their names for each face of the mesh");
}

}  // namespace

SavedParts::SavedParts(const Mesh& mesh) : mesh_(mesh) {
    for (const Attribute& attribute : mesh.attributes().all()) require_fit(mesh, attribute);
    for (const auto& [kind, labels] : mesh.attributes().labels()) require_fit(mesh, kind, labels);
}

const Attribute* SavedParts::take(std::string_view name, std::initializer_list<Domain> domains,
                                  std::initializer_list<Index> widths) {
    const Attribute* attribute = mesh_.attributes().find(name);
    const auto has = [](const auto& list, const auto& value) {
        return std::find(list.begin(), list.end(), value) != list.end();
    };
    if (!attribute || !has(domains, attribute->domain) || !has(widths, attribute->width)) {
        return nullptr;
    }
    take(*attribute);
    return attribute;
}

const FaceLabels* SavedParts::take_labels(std::string_view kind) {
    const auto& labels = mesh_.attributes().labels();
    const auto found = labels.find(kind);
    if (found == labels.end()) return nullptr;
    taken_labels_.emplace(kind);
    return &found->second;
}

const std::vector<std::string>& SavedParts::take_material_libraries() {
    libraries_taken_ = true;
    return libraries_ ? *libraries_ : mesh_.material_libraries();
}

void SavedParts::replace_material_libraries(std::vector<std::string> names, bool have_asset) {
    libraries_ = std::move(names);
    libraries_have_asset_ = have_asset;
}

const std::map<std::string, Region, std::less<>>& SavedParts::take_regions() {
    regions_taken_ = true;
    return mesh_.regions();
}

const std::shared_ptr<const Asset>& SavedParts::take_asset() {
    asset_taken_ = true;
    return mesh_.asset();
}

void SavedParts::log_losses(std::string_view format, const Context& context) const {
    std::string lost;
    const auto lose = [&](std::string_view what, std::string_view name, std::string_view detail) {
        lost += lost.empty() ? " " : ", ";
        lost += std::string(what) + " " + in_quotes(name) + std::string(detail);
    };
    for (const Attribute& a : mesh_.attributes().all()) {
        if (taken_attributes_.contains(a.name)) continue;
        lose(
            "attribute", a.name,
            " (" + std::string(domain_name(a.domain)) + ", width " + std::to_string(a.width) + ")");
    }
    for (const auto& [kind, labels] : mesh_.attributes().labels()) {
        if (!taken_labels_.contains(kind)) lose("face labels", kind, "");
    }
    if (!regions_taken_) {
        for (const auto& entry : mesh_.regions()) lose("region", entry.first, "");
    }
    // Definitions of the libraries are saved with their names as with the definitions themselves.
    const bool defines_libraries = mesh_.asset() && mesh_.asset()->is_of_libraries();
    if (!libraries_taken_ && !(asset_taken_ && defines_libraries)) {
        for (const std::string& name : mesh_.material_libraries()) lose("material file", name, "");
    }
    if (!asset_taken_ && mesh_.asset() && !(libraries_taken_ && defines_libraries)) {
        lost += lost.empty() ? " " : ", ";
        lost += libraries_have_asset_ ? "nodes and animations"
                                      : "materials, textures, nodes and animations";
        lost += " of the file it came from";
    }
    if (lost.empty()) return;
    context.log(LogLevel::warning,
                "not saved, because " + std::string(format) + " cannot hold it:" + lost);
}

}  // namespace lissom
