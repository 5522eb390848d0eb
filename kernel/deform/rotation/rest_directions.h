/// Custom normals, tangents and morph targets of the rest shape, which are carried by the surface;
/// private to kernel/deform.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// The values of all attributes that are directions, at the vertices of a region and of the ring
/// around it, whose faces move too, or at their corners.
///
/// A value is carried by the surface from its rest to its present position, however it moved: a
/// rotation that takes the normal of the rest surface to the present one, and turns about it as the
/// edges do. So the angle between a custom normal and the surface's own is that of the rest shape.
/// The surface on either side of an edge has a rotation of its own if custom normals of corners
/// differ along it.
class RestDirections {
  public:
    RestDirections(const Mesh& mesh, const Region& region);

    bool empty() const { return attributes_.empty(); }
    /// Rows of the region whose vertices have no faces, so that no surface says how they turn.
    std::span<const Index> without_faces() const { return without_faces_; }
    /// Writes each value as the surface of `mesh` carries it; those of vertices without faces turn
    /// by `alone`, in the order of `without_faces`. If nothing moved, values are those of the rest
    /// to the bit. Attributes that `mesh` has no more are passed over.
    void apply_to(Mesh& mesh, std::span<const Mat3> alone) const;
    /// Takes the values so carried as those of the rest shape, which moves to `positions`, in the
    /// order of the region.
    void rebase(const Region& region, std::span<const Vec3> positions, std::span<const Mat3> alone);

  private:
    // One corner of local face `face`: local vertices there and at the corners next to it.
    struct Wedge {
        Index face, before, corner, after;
    };
    // Wedges around one vertex that turn together, and their normal at rest. Without wedges, the
    // place in `without_faces`.
    struct Sector {
        Index begin, end, alone;
        Vec3 normal;
    };
    // The sectors of one vertex of the mesh: of all its wedges, and of each of its corners.
    struct Place {
        Index vertex, whole;
        std::vector<std::pair<Index, Index>> corners;
    };
    struct Values {
        std::string name;
        Domain domain;
        Index width;
        // Element of the attribute and its sector, for each value.
        std::vector<Index> element, sector;
        std::vector<Vec3> value;
    };
    // Positions of local vertices, normals of local faces, and flags of faces that have changed.
    struct Shape {
        std::vector<Vec3> at, normal;
        std::vector<char> moved;
    };

    void collect_faces(const Mesh& mesh, const Region& around);
    Place collect_sectors(const Mesh& mesh, Index v, const Attribute* normals);
    Index add_sector(std::span<const Wedge> wedges);
    void collect_values(const Attribute& attribute, std::span<const Place> places);
    Index local_vertex(Index vertex) const;

    std::span<const Wedge> wedges(const Sector& sector) const {
        return {wedges_.data() + sector.begin, wedges_.data() + sector.end};
    }
    Shape shape_of(std::vector<Vec3> at) const;
    Vec3 normal_of(const Sector& sector, const Shape& shape) const;
    void take_rest(std::vector<Vec3> at);
    template <typename Use>
    void for_each_edge(const Sector& sector, const Shape& shape, const Use& use) const;
    Mat3 rotation_of(const Sector& sector, const Shape& shape) const;
    std::vector<Mat3> rotations(std::vector<Vec3> at, std::span<const Mat3> alone) const;

    std::vector<Values> attributes_;
    std::vector<Index> without_faces_;
    // Vertices of the mesh that the faces have, ascending, and their rest positions.
    std::vector<Index> vertices_;
    std::vector<Vec3> rest_;
    // Faces of the mesh around the vertices, ascending, and the same with local vertices.
    std::vector<Index> face_ids_;
    FaceList faces_;
    std::vector<Wedge> wedges_;
    std::vector<Sector> sectors_;
};

}  // namespace lissom
