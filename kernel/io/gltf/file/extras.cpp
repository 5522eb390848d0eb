#include "kernel/io/gltf/file/extras.h"
#include "kernel/io/stream/json_object.h"

#include <algorithm>

namespace lissom {
namespace {

constexpr const char* kKey = "lissom";

struct Run {
    std::int64_t first, count;
};

// The pairs of `list`; none if it is something else.
std::vector<Run> runs_of(const Json& list) {
    std::vector<Run> runs;
    if (!list.is_array()) return runs;
    for (std::size_t i = 0; i + 1 < list.size(); i += 2) {
        if (!list[i].is_number_integer() || !list[i + 1].is_number_integer()) return {};
        runs.push_back({list[i].get<std::int64_t>(), list[i + 1].get<std::int64_t>()});
    }
    return runs;
}

bool read_labels(const Json& json, std::int64_t face_count, FaceLabels& labels) {
    const Json *names = member(json, "names"), *runs = member(json, "runs");
    if (!names || !runs || !names->is_array()) return false;
    for (const Json& name : *names) {
        labels.names.push_back(name.is_string() ? name.get<std::string>() : std::string());
    }
    const auto name_count = std::ssize(*names);
    for (const Run& run : runs_of(*runs)) {
        const std::int64_t left = face_count - std::ssize(labels.of_face);
        if (run.first < kNoIndex || run.first >= name_count || run.count < 0 || run.count > left) {
            return false;
        }
        labels.of_face.insert(labels.of_face.end(), run.count, index_of(run.first));
    }
    return std::ssize(labels.of_face) == face_count;
}

bool read_turns(const Json& runs, std::size_t face_count, std::vector<Index>& turns) {
    for (const Run& run : runs_of(runs)) {
        const auto left = static_cast<std::int64_t>(face_count - turns.size());
        if (run.first < 0 || run.first > 0x7fffffff || run.count < 0 || run.count > left) {
            return false;
        }
        turns.insert(turns.end(), run.count, index_of(run.first));
    }
    return turns.size() == face_count;
}

// Numbers of at least 1 that sum up to `sum`.
bool read_shares(const Json& runs, std::size_t sum, std::vector<Index>& shares) {
    auto left = static_cast<std::int64_t>(sum);
    for (const Run& run : runs_of(runs)) {
        if (run.first < 1 || run.count < 0 || run.first > left || run.count > left / run.first) {
            return false;
        }
        left -= run.first * run.count;
        shares.insert(shares.end(), run.count, index_of(run.first));
    }
    return left == 0;
}

bool read_region(const Json& json, std::int64_t vertex_count, std::vector<Index>& vertices) {
    std::int64_t next = 0;
    for (const Run& run : runs_of(json)) {
        if (run.first < next || run.count < 0 || run.first > vertex_count ||
            run.count > vertex_count - run.first) {
            return false;
        }
        next = run.first + run.count;
        for (std::int64_t v = run.first; v < next; ++v) vertices.push_back(index_of(v));
    }
    return true;
}

bool is_count(const Json& json, const char* key, std::size_t count) {
    const Json* value = member(json, key);
    return value && value->is_number_unsigned() && value->get<std::uint64_t>() == count;
}

bool read(const Json& json, std::size_t vertex_count, std::size_t face_count, MeshExtras& extras) {
    if (const Json* parts = member(json, "parts")) {
        if (!read_shares(*parts, face_count, extras.parts)) return false;
        face_count = extras.parts.size();
    }
    if (const Json* copies = member(json, "copies")) {
        if (!read_shares(*copies, vertex_count, extras.copies)) return false;
    }
    if (!is_count(json, "vertices", vertex_count) || !is_count(json, "faces", face_count)) {
        return false;
    }
    bool good = true;
    if (const Json* labels = member(json, "labels"); labels && labels->is_object()) {
        for (const auto& item : labels->items()) {
            good = good && read_labels(item.value(), static_cast<std::int64_t>(face_count),
                                       extras.labels[item.key()]);
        }
    }
    if (const Json* regions = member(json, "regions"); regions && regions->is_object()) {
        for (const auto& item : regions->items()) {
            good = good && read_region(item.value(), static_cast<std::int64_t>(vertex_count),
                                       extras.regions[item.key()]);
        }
    }
    if (const Json* turns = member(json, "turns")) {
        good = good && read_turns(*turns, face_count, extras.turns);
    }
    if (const Json* corners = member(json, "corners"); corners && corners->is_array()) {
        for (const Json& name : *corners) {
            if (name.is_string()) extras.corners.push_back(name.get<std::string>());
        }
    }
    return good;
}

Json label_runs(const std::vector<Index>& of_face) {
    Json runs = Json::array();
    for (std::size_t begin = 0; begin < of_face.size();) {
        std::size_t end = begin;
        while (end < of_face.size() && of_face[end] == of_face[begin]) ++end;
        runs.push_back(of_face[begin]);
        runs.push_back(end - begin);
        begin = end;
    }
    return runs;
}

Json vertex_runs(const std::vector<Index>& vertices) {
    Json runs = Json::array();
    for (std::size_t begin = 0; begin < vertices.size();) {
        std::size_t end = begin + 1;
        while (end < vertices.size() && vertices[end] == vertices[end - 1] + 1) ++end;
        runs.push_back(vertices[begin]);
        runs.push_back(end - begin);
        begin = end;
    }
    return runs;
}

}  // namespace

MeshExtras take_extras(Json& mesh, std::size_t vertex_count, std::size_t face_count, bool& fits) {
    MeshExtras extras;
    fits = true;
    Json* all = member(mesh, "extras");
    const Json* ours = all ? member(*all, kKey) : nullptr;
    if (!ours) return extras;
    fits = read(*ours, vertex_count, face_count, extras);
    all->erase(kKey);
    if (all->empty()) mesh.erase("extras");
    return fits ? extras : MeshExtras();
}

void put_extras(Json& mesh, const MeshExtras& extras, std::size_t vertex_count,
                std::size_t face_count) {
    const bool is_empty = extras.labels.empty() && extras.regions.empty() && extras.turns.empty() &&
                          extras.corners.empty() && extras.parts.empty() && extras.copies.empty();
    if (is_empty) return;
    Json ours = json_object({{"vertices", vertex_count}, {"faces", face_count}});
    for (const auto& [kind, labels] : extras.labels) {
        (*ours.emplace("labels", Json::object()).first)[kind] =
            json_object({{"names", labels.names}, {"runs", label_runs(labels.of_face)}});
    }
    for (const auto& [name, vertices] : extras.regions) {
        (*ours.emplace("regions", Json::object()).first)[name] = vertex_runs(vertices);
    }
    if (!extras.turns.empty()) ours["turns"] = label_runs(extras.turns);
    if (!extras.corners.empty()) ours["corners"] = extras.corners;
    if (!extras.parts.empty()) ours["parts"] = label_runs(extras.parts);
    if (!extras.copies.empty()) ours["copies"] = label_runs(extras.copies);
    object_in(mesh, "extras")[kKey] = std::move(ours);
}

}  // namespace lissom
