#include "kernel/io/gltf/mesh/told_morphs.h"

#include <algorithm>
#include <string>
#include <utility>

namespace lissom {
namespace {

constexpr const char* kNames = "targetNames";

const Json* list_member(const Json& object, const char* key) {
    const Json* list = member(object, key);
    return list && list->is_array() ? list : nullptr;
}

const Json* names_of(const Json& mesh) {
    const Json* extras = member(mesh, "extras");
    return extras ? list_member(*extras, kNames) : nullptr;
}

void erase_morphs(Json& mesh) {
    mesh.erase("weights");
    Json* extras = member(mesh, "extras");
    if (!extras || !extras->is_object()) return;
    extras->erase(kNames);
    if (extras->empty()) mesh.erase("extras");
}

}  // namespace

std::vector<MorphTarget> told_morphs(const Json& mesh, const Json* node) {
    const Json* names = names_of(mesh);
    const Json* weights = node ? list_member(*node, "weights") : nullptr;
    if (!weights) weights = list_member(mesh, "weights");
    const std::size_t count = std::max(names ? names->size() : 0, weights ? weights->size() : 0);
    std::vector<MorphTarget> result;
    for (std::size_t k = 0; k < count; ++k) {
        MorphTarget target{morph_call_name(index_of(k) + 1), 0.0, false};
        if (names && k < names->size() && (*names)[k].is_string()) {
            target.name = (*names)[k].get<std::string>();
            target.is_named = true;
        }
        if (weights && k < weights->size() && (*weights)[k].is_number()) {
            target.weight = (*weights)[k].get<double>();
        }
        result.push_back(std::move(target));
    }
    return result;
}

void tell_morphs(Json& mesh, const std::vector<MorphTarget>& targets, bool with_weights) {
    if (targets.empty()) return;
    const Json* extras = member(mesh, "extras");
    const bool named = std::any_of(targets.begin(), targets.end(),
                                   [](const MorphTarget& t) { return t.is_named; });
    if (named && (!extras || extras->is_object())) {
        Json names = Json::array();
        for (const MorphTarget& target : targets) names.push_back(target.name);
        object_in(mesh, "extras")[kNames] = std::move(names);
    }
    const bool shows = std::any_of(targets.begin(), targets.end(),
                                   [](const MorphTarget& t) { return t.weight != 0.0; });
    if (shows || with_weights || mesh.contains("weights")) mesh["weights"] = weights_of(targets);
}

void fit_morphs(Json& mesh, std::size_t count) {
    if (!mesh.is_object()) return;
    if (count == 0) return erase_morphs(mesh);
    std::vector<MorphTarget> targets = told_morphs(mesh, nullptr);
    if (targets.empty()) return;
    while (targets.size() < count) {
        targets.push_back({morph_call_name(count_of(targets) + 1), 0.0, false});
    }
    targets.resize(count);
    tell_morphs(mesh, targets);
}

Json weights_of(const std::vector<MorphTarget>& targets) {
    Json weights = Json::array();
    for (const MorphTarget& target : targets) weights.push_back(target.weight);
    return weights;
}

std::size_t told_morph_count(const Json& mesh) {
    return told_morphs(mesh, nullptr).size();
}

}  // namespace lissom
