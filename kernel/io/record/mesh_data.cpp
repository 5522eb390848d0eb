#include "kernel/io/record/mesh_data.h"

#include <limits>
#include <utility>

#include "kernel/io/stream/read_error.h"

namespace lissom {

void add_face(FaceList& faces, std::span<const Index> face) {
    constexpr std::size_t kMaximumCorners = std::numeric_limits<Index>::max();
    if (face.size() > kMaximumCorners - faces.vertices.size()) {
        refuse(ErrorCode::file_too_large, "the faces have more than the " +
                                              std::to_string(kMaximumCorners) +
                                              " corners that can be numbered; split the file");
    }
    faces.add(face);
}

void add_without_clash(AttributeSet& attributes, Attribute attribute) {
    while (attribute.domain == Domain::face && attributes.find(attribute.name)) {
        attribute.name = "face_" + attribute.name;
    }
    attributes.add(std::move(attribute));
}

std::string face_attribute_name(const AttributeSet& attributes, const Attribute& attribute) {
    constexpr std::string_view kPrefix = "face_";
    if (!attribute.name.starts_with(kPrefix)) return attribute.name;
    const std::string base = attribute.name.substr(kPrefix.size());
    const Attribute* const other = attributes.find(base);
    return other && other->domain != Domain::face ? base : attribute.name;
}

}  // namespace lissom
