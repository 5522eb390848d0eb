#include "viewer/window/panel/pick_choices.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "kernel/mesh/query/path.h"

namespace lissom::window {
namespace {

using lua::ParameterType;

PickMesh pick_mesh(const DrawnMesh& drawn) {
    PickMesh mesh;
    for (const auto& [name, region] : regions_of(drawn)) mesh.regions.push_back(name);
    mesh.is_head = regions_of(drawn).contains("scalp");
    for (const Path& loop : boundaries(*drawn.mesh)) {
        PickLoop pick{std::to_string(mesh.boundaries.size() + 1), {}};
        for (const Index v : loop.vertices()) {
            pick.points.push_back(drawn.transform(drawn.mesh->position(v)));
        }
        mesh.boundaries.push_back(std::move(pick));
    }
    return mesh;
}

bool names_object(const ToolState& scene, const std::string& name) {
    return std::any_of(scene.objects.begin(), scene.objects.end(),
                       [&](const ToolObject& object) { return object.name == name; });
}

void add_once(std::vector<std::string>& list, const std::string& value) {
    if (value.empty() || std::find(list.begin(), list.end(), value) != list.end()) return;
    list.push_back(value);
}

void add_values(ParameterType type, const PickMesh& mesh, std::vector<std::string>& values) {
    if (type == ParameterType::region) {
        for (const std::string& name : mesh.regions) add_once(values, name);
    }
    if (type == ParameterType::boundary) {
        for (const PickLoop& loop : mesh.boundaries) add_once(values, loop.value);
    }
}

}  // namespace

bool is_picked(ParameterType type) {
    return type == ParameterType::mesh || type == ParameterType::head || lua::lies_on_mesh(type);
}

PickChoices pick_choices_of(const Shown& shown, const ToolState& scene) {
    PickChoices choices;
    const Picture& picture = *shown.picture;
    for (std::size_t i = 0; i < picture.meshes.size(); ++i) {
        PickMesh& mesh = choices.meshes.emplace_back(pick_mesh(picture.meshes[i]));
        if (i < shown.names.size() && names_object(scene, shown.names[i])) {
            mesh.name = shown.names[i];
        }
    }
    for (const PictureStrands& strands : picture.strands) {
        if (strands.mesh) choices.meshes[*strands.mesh].is_head = true;
    }
    for (const ToolObject& object : scene.objects) {
        if (object.is_curve) choices.curves.push_back(object.name);
    }
    return choices;
}

std::vector<const PickMesh*> meshes_of(const lua::ScriptParameter& parameter,
                                       const std::vector<lua::ScriptParameter>& all,
                                       const PickChoices& choices) {
    const auto on = std::find_if(all.begin(), all.end(), [&](const lua::ScriptParameter& other) {
        return !parameter.of.empty() && other.name == parameter.of;
    });
    const auto* name =
        on != all.end() && on->value ? std::get_if<std::string>(&*on->value) : nullptr;
    std::vector<const PickMesh*> meshes;
    for (const PickMesh& mesh : choices.meshes) {
        if (name && mesh.name == *name) return {&mesh};
        meshes.push_back(&mesh);
    }
    return meshes;
}

std::vector<std::string> picks_for(const lua::ScriptParameter& parameter,
                                   const std::vector<lua::ScriptParameter>& all,
                                   const PickChoices& choices) {
    if (parameter.type == ParameterType::curve) return choices.curves;
    std::vector<std::string> values;
    for (const PickMesh* mesh : meshes_of(parameter, all, choices)) {
        const bool is_one = parameter.type == ParameterType::mesh ||
                            (parameter.type == ParameterType::head && mesh->is_head);
        if (is_one) add_once(values, mesh->name);
        add_values(parameter.type, *mesh, values);
    }
    return values;
}

}  // namespace lissom::window
