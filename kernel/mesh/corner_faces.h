/// CornerFaces: faces while they are repaired, with the corners and faces of the file that they
/// come from; private to kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

struct CornerFaces {
    FaceList faces;
    /// The corner of the file that each corner was, and the face that each face was.
    std::vector<Index> corner_source, face_source;

    CornerFaces() = default;
    /// All faces as they are in the file.
    explicit CornerFaces(FaceList list);

    /// Adds a face of these corners of `from`.
    void add(const CornerFaces& from, Index face, std::span<const Index> corners);

    Index next(Index corner) const {
        const Index f = face_of_corner[at(corner)];
        return corner + 1 < faces.offsets[at(f + 1)] ? corner + 1 : faces.offsets[at(f)];
    }
    Index previous(Index corner) const {
        const Index f = face_of_corner[at(corner)];
        return corner > faces.offsets[at(f)] ? corner - 1 : faces.offsets[at(f + 1)] - 1;
    }
    /// The face of every corner.
    std::vector<Index> face_of_corner;
};

}  // namespace lissom
