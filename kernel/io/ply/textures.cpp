#include "kernel/io/ply/textures.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "kernel/io/obj/material_collector.h"
#include "kernel/io/ply/header.h"

namespace lissom {
namespace {

FaceLabels texture_labels(const MeshData& data, std::vector<std::string> names) {
    FaceLabels labels{std::move(names), {}};
    const auto count = count_of(labels.names);
    const Attribute* numbers = data.attributes.find("texnumber");
    const bool is_of_faces = numbers && numbers->domain == Domain::face && numbers->width == 1;
    for (Index f = 0; f < data.faces.size(); ++f) {
        const double number = is_of_faces ? numbers->values[at(f)] : 0.0;
        const bool exists = number >= 0.0 && number < count && number == std::floor(number);
        labels.of_face.push_back(exists ? static_cast<Index>(number) : kNoIndex);
    }
    return labels;
}

}  // namespace

void read_ply_textures(const FileInput& file, MeshData& data, const Context& context) {
    std::vector<std::string> names = read_ply_header(file.bytes).texture_files;
    auto& labels = data.attributes.labels();
    if (names.empty() || data.faces.size() == 0 || labels.contains("material")) return;
    if (!file.folder.empty()) {
        MaterialCollector collector(file.folder, data.report, context);
        for (const std::string& name : names) {
            context.checkpoint();
            MtlMaterial material;
            material.name = material.diffuse_map = name;
            material.diffuse = {1.0, 1.0, 1.0};
            collector.add(material);
        }
        data.asset = collector.asset();
    }
    labels["material"] = texture_labels(data, std::move(names));
}

}  // namespace lissom
