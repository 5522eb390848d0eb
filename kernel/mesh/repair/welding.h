/// Welding: which faces are joined along which edges while polygons are made a manifold, and the
/// vertices that follow from it; private to kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/corner_faces.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Vertices of a manifold: one for each fan of welded corners.
struct FanVertices {
    std::vector<Index> of_corner;
    /// The lowest vertex of the soup at the fan's corners.
    std::vector<Index> source;
    /// True if the vertices are those of the soup: none joined, split or without faces.
    bool unchanged = false;
};

class Welding {
  public:
    /// `positions` and `work` must live as long.
    Welding(std::span<const Vec3> positions, const CornerFaces& work);

    /// Welds faces along edges at which exactly two meet in opposite directions. False if other
    /// edges exist.
    bool weld_regular_edges();
    /// Welds faces along their shared edges: the two of a regular edge; of more than two, the ones
    /// that bound the same piece of space. Adds the edges left open to `report`.
    void weld_edges(Report& report);
    /// Welds pairs of open edges that lie at the same place in opposite directions, but not faces
    /// that are back to back, nor those with different `label_of_face` (empty: no labels). If more
    /// than two lie there, edges that bound the same piece of space are pairs.
    void weld_seams(std::span<const Index> label_of_face);
    /// Numbers the fans: in the order of the soup's vertices, further fans of a vertex last. Opens
    /// edges if one pair of vertices would be joined by several.
    FanVertices number_fans();

    /// For each corner, the one along the same edge the other way, or kNoIndex.
    const std::vector<Index>& twin() const { return twin_; }
    bool is_closed() const;

  private:
    // An edge of a face, and whether it runs from the lower of its ends to the higher.
    struct DirectedCorner {
        Index corner;
        bool ascending;
    };
    // The same with the numbers of the places at its ends, and its face's label.
    struct OpenEdge {
        Index low, high, label, corner;
        bool ascending;

        bool same_place(const OpenEdge& other) const {
            return low == other.low && high == other.high && label == other.label;
        }
    };

    void weld(Index a, Index b);
    void open(Index corner);
    // Welds faces at one edge in pairs that bound the same piece of space; the axis runs along the
    // ascending ones.
    void weld_around_edge(std::span<const DirectedCorner> corners, const Vec3& axis);
    void weld_seam(std::span<const OpenEdge> edges);
    bool back_to_back(Index a, Index b) const;
    Index number_fan(Index corner, Index fan, std::vector<Index>& of_corner) const;
    FanVertices fans() const;
    // Corners on edges that join the same two vertices as another edge does.
    std::vector<Index> doubled_edges(const FanVertices& vertices);
    void open_seams_at(Index corner);
    void open_around(Index corner);

    std::span<const Vec3> positions_;
    const CornerFaces* work_;
    std::vector<Index> twin_;
    // Corners whose edges were welded as seams.
    std::vector<char> is_seam_;
    bool regular_ = false;
    // Number of times that an edge of each face was found doubled.
    std::vector<char> attempts_;
};

}  // namespace lissom
