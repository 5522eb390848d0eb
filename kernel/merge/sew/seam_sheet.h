/// A part of one side of a seam while its triangles are changed; private to kernel/merge.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// Dihedral angles (radians) that a change may make even if there was none as great: across seams,
/// and elsewhere.
struct SheetLimits {
    double seam = 0.0, other = 0.0;
};

/// Some faces of a mesh on one side of its seams, as triangles that can be split, collapsed,
/// flipped and moved. The edges around them stay, and features do: edges that are sharp, and
/// borders of charts and labels. A vertex between two feature edges in line slides along them.
/// No change makes a dihedral angle greater than the limits and the greatest of the edges around
/// it, or turns a triangle over.
class SeamSheet {
  public:
    /// The edge length wanted at a point.
    using Size = std::function<double(const Vec3&)>;

    /// The faces `faces` of `mesh`. Edges with a dihedral angle above `sharp` are features. The
    /// mesh must outlive the sheet.
    SeamSheet(const Mesh& mesh, std::vector<Index> faces, std::span<const std::vector<Index>> seams,
              double sharp, const Context& context);

    /// Flips edges between triangles if that makes the smallest angle greater. Returns how many
    /// flips there were.
    Index flip_edges(const SheetLimits& limits, const Context& context);
    /// Makes edges as long as `size` wants, in rounds of splits, collapses, flips and moves on the
    /// surface (Botsch and Kobbelt 2004, with the sizes of Dunyach et al. 2013). Flips obey
    /// `flips`, all else `limits`.
    void remesh(const Size& size, const SheetLimits& limits, const SheetLimits& flips,
                const Context& context);

    const Mesh& mesh() const { return mesh_; }
    /// The faces of the mesh that the sheet stands for.
    const std::vector<Index>& faces() const { return faces_; }
    Index vertex_count() const { return count_of(x_); }
    /// The vertex of the mesh, or kNoIndex for one that was made.
    Index mesh_vertex(Index v) const { return mesh_vertex_[at(v)]; }
    const Vec3& position(Index v) const { return x_[at(v)]; }
    /// False for a vertex that was collapsed.
    bool is_used(Index v) const { return !around_[at(v)].empty(); }
    bool has_moved(Index v) const;
    /// Triangles that are there now.
    std::vector<Triangle> triangles() const;

    /// Returns the sources of a vertex that was made or has moved: vertices of the mesh.
    std::vector<ElementMap::Source> vertex_sources(Index v) const;
    /// The face of the mesh that a triangle comes from.
    Index face_source(const Triangle& triangle) const;
    /// Returns the sources of the corner `k` of a triangle: corners of one face of the mesh.
    std::vector<ElementMap::Source> corner_sources(const Triangle& triangle, std::size_t k) const;

  private:
    // The greatest dihedral angles and the smallest angle of some triangles.
    struct Star {
        double seam = 0.0, other = 0.0, angle = kPi;
    };
    // A triangle that is there or would be.
    struct Facet {
        Triangle corners;
        Vec3 normal;
        double angle;
    };

    static std::uint64_t key(Index a, Index b) { return pair_key(std::min(a, b), std::max(a, b)); }

    void take_faces();
    void find_outer_edges();
    void mark_borders(std::span<const std::vector<Index>> seams);
    void mark_features(double sharp);
    bool same_values(Index p, Index q) const;
    bool is_chart_border(Index left, Index right, Index a, Index c) const;
    void make_rest(const Context& context);
    SurfacePoint nearest_at_first(const Vec3& p) const;

    Index left_of(Index a, Index b) const;
    void add_vertex_lists();
    void add_empty(std::size_t count);
    void note_change(Index f);
    void enter(Index f, const Triangle& triangle);
    void leave(Index f);
    std::vector<Index> ring(Index v) const;
    bool is_joined(Index a, Index b) const;
    bool is_on_seam(Index a, Index b) const;
    void add_feature(Index a, Index b);
    void remove_feature(Index a, Index b);
    bool is_feature(Index a, Index b) const;
    // Whether no feature edge ends at a vertex.
    bool is_free(Index v) const { return features_at_[at(v)] == 0; }
    bool is_sliding(Index v, std::array<Index, 2>& along) const;

    Vec3 normal(const Triangle& t, Index moved, const Vec3& to) const;
    Star star_of(std::span<const Index> faces);
    Star star_with(std::span<const Triangle> triangles, std::span<const Index> instead_of,
                   Index moved, const Vec3& to);
    Star measured(std::span<const Index> instead_of) const;
    static bool is_allowed(const Star& before, const Star& after, const SheetLimits& limits,
                           double good_angle);
    bool turns(std::span<const Index> before, std::span<const Triangle> after, Index moved,
               const Vec3& to, double greatest) const;

    struct Quad {
        Index left = kNoIndex, right = kNoIndex, b = kNoIndex, d = kNoIndex;
        std::array<Triangle, 2> before{}, after{};
    };
    bool find_quad(Index a, Index c, Quad& quad) const;
    void separate_diagonals();
    void keep_at_first(const Quad& quad);
    double min_angle(const Triangle& t, Index moved, const Vec3& to) const;
    double min_angle_of(Index f);
    bool is_rounder(const Quad& quad);
    void turn_diagonal(const Quad& quad);
    bool may_flip(const Quad& quad, const SheetLimits& limits);
    bool flip(Index f, std::size_t k, const SheetLimits& limits);
    bool split(Index a, Index c, const SheetLimits& limits);
    bool collapse(Index gone, Index kept, const SheetLimits& limits);
    void relax(Index v, const SheetLimits& limits);
    // Inner edges whose length, over that wanted, is one to be changed.
    std::vector<std::array<Index, 2>> edges_by_length(const std::function<bool(double)>& is_wanted,
                                                      bool longest_first) const;
    Index split_long(const SheetLimits& limits);
    void collapse_short(const SheetLimits& limits);
    double wanted(Index a, Index b) const { return 0.5 * (size_[at(a)] + size_[at(b)]); }

    const Mesh& mesh_;
    std::vector<Index> faces_;
    std::vector<Vec3> x_;
    std::vector<Index> mesh_vertex_;
    // Vertices on the border stay.
    std::vector<char> fixed_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<Index>> around_;
    // Normal of each triangle, and its smallest angle if that has been asked for.
    std::vector<Vec3> normal_;
    std::vector<double> angle_;
    // When a triangle at a vertex last changed, and when each edge of a triangle was last found to
    // be no better flipped: on account of its two ends, or of all four vertices.
    std::vector<std::uint32_t> changed_;
    std::vector<std::array<std::uint32_t, 3>> useless_, refused_;
    std::uint32_t clock_ = 0;
    SheetLimits flip_limits_;
    std::unordered_set<std::uint64_t> features_, seam_;
    // How many feature edges end at a vertex.
    std::vector<Index> features_at_;
    // Facets of the star that is being measured.
    std::vector<Facet> facets_;
    // Edges of the mesh between vertices of the border that are not of the sheet.
    std::unordered_set<std::uint64_t> outer_edges_;
    // Normals of border edges, along that of the face beyond.
    std::unordered_map<std::uint64_t, Vec3> beyond_;
    // The triangles at first: their faces, corners and vertices of the mesh.
    struct First {
        std::vector<Index> face;
        std::vector<Triangle> corners, vertices;
        std::vector<Vec3> points;
        std::optional<SpatialTree> tree;
        // Added to points whose nearest triangle is asked for: it turns with the mesh and lies in
        // no plane of symmetry, so that of two equally near triangles rounding does not choose.
        Vec3 aside = Vec3::Zero();
    };
    First first_;
    Size size_at_;
    std::vector<double> size_;
};

}  // namespace lissom
