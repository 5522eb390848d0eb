/// SheetTriangles: triangles beside a seam that change one by one; private to kernel/merge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Returns whether one of a triangle's edges runs from a to b.
inline bool is_along(const Triangle& t, Index a, Index b) {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

/// Triangles with their neighbours, their normals, and the edges that are features. Functions with
/// `moved` count that vertex as if it lay at `to`.
class SheetTriangles {
  public:
    std::vector<Vec3> x;
    /// By vertex: the one of the mesh, or kNoIndex for one that was made.
    std::vector<Index> mesh_vertex;
    /// By vertex: whether it stays. Those on the border do.
    std::vector<char> fixed;
    /// kNoIndex three times for a triangle that is gone.
    std::vector<Triangle> triangles;
    /// By vertex: its triangles.
    std::vector<std::vector<Index>> around;
    /// By triangle: twice its area along its normal; zero if it is too flat to have one.
    std::vector<Vec3> normal;
    /// By vertex: when a triangle at it last changed, as `clock` was then.
    std::vector<std::uint32_t> changed;
    std::uint32_t clock = 0;
    /// Edges on seams, and edges of the mesh between vertices of the border that are not of the
    /// sheet.
    std::unordered_set<std::uint64_t> seam, outer_edges;
    /// By border edge: the normal of the face beyond.
    std::unordered_map<std::uint64_t, Vec3> beyond;

    Index vertex_count() const { return count_of(x); }

    void add_vertex(const Vec3& position, Index of_mesh);
    /// Adds triangles that are gone.
    void add_empty(std::size_t count);
    /// Puts a triangle in place of one that is gone.
    void enter(Index f, const Triangle& triangle);
    void leave(Index f);
    void move(Index v, const Vec3& to);

    /// Returns the triangle on the left of an edge, or kNoIndex.
    Index left_of(Index a, Index b) const;
    /// Returns the neighbours of a vertex, ascending.
    std::vector<Index> ring(Index v) const;
    /// Returns whether an edge joins two vertices, in the sheet or beside it.
    bool is_joined(Index a, Index b) const;
    bool is_on_seam(Index a, Index b) const;

    void add_feature(Index a, Index b);
    void remove_feature(Index a, Index b);
    bool is_feature(Index a, Index b) const;
    /// Returns whether no feature edge ends at a vertex.
    bool is_free(Index v) const { return features_at_[v] == 0; }
    /// Returns whether exactly two feature edges, in line, meet at a vertex; `along` are their
    /// other ends.
    bool is_sliding(Index v, std::array<Index, 2>& along) const;

    Vec3 normal_of(const Triangle& t, Index moved = kNoIndex, const Vec3& to = Vec3::Zero()) const;
    double min_angle(const Triangle& t, Index moved = kNoIndex,
                     const Vec3& to = Vec3::Zero()) const;
    /// Returns the smallest angle of a triangle, which is measured once.
    double min_angle_of(Index f);
    /// Returns whether a triangle turns by more than `limit` (radians) when it becomes another.
    bool turns(std::span<const Index> before, std::span<const Triangle> after, double limit,
               Index moved = kNoIndex, const Vec3& to = Vec3::Zero()) const;

  private:
    void note_change(Index f);

    std::vector<double> angle_;
    std::unordered_set<std::uint64_t> features_;
    // By vertex: the number of feature edges that end there.
    std::vector<Index> features_at_;
};

}  // namespace lissom
