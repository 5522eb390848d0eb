#include "kernel/mesh/corner_faces.h"

#include <numeric>
#include <utility>

namespace lissom {

CornerFaces::CornerFaces(FaceList list)
    : faces(std::move(list)),
      corner_source(faces.vertices.size()),
      face_source(faces.size()),
      face_of_corner(faces.vertices.size()) {
    std::iota(corner_source.begin(), corner_source.end(), 0);
    std::iota(face_source.begin(), face_source.end(), 0);
    for (Index f = 0; f < faces.size(); ++f) {
        std::fill(face_of_corner.begin() + faces.offsets[f],
                  face_of_corner.begin() + faces.offsets[f + 1], f);
    }
}

void CornerFaces::add(const CornerFaces& from, Index face, std::span<const Index> corners) {
    for (const Index c : corners) {
        faces.vertices.push_back(from.faces.vertices[c]);
        corner_source.push_back(from.corner_source[c]);
        face_of_corner.push_back(faces.size());
    }
    faces.offsets.push_back(count_of(faces.vertices));
    face_source.push_back(from.face_source[face]);
}

}  // namespace lissom
