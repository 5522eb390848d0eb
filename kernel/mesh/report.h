/// Report: findings, repairs and omissions of loading a mesh, with the elements concerned.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/index.h"

namespace lissom {

/// Kinds of findings. The name in scripts is that of `finding_name`.
enum class FindingKind {
    // Mended: the surface of the file was not an oriented 2-manifold, or was torn.
    vertices_welded,        ///< merged with another vertex at the same place
    vertices_unreferenced,  ///< dropped: no face uses them
    corners_repeated,       ///< faces that named a vertex twice in a row; the repeats were dropped
    faces_collapsed,        ///< dropped: fewer than three different vertices
    faces_pinched,          ///< split at a vertex that they passed twice
    faces_duplicate,        ///< dropped: copies of other faces
    faces_flipped,          ///< turned over to agree with their neighbours
    edges_nonmanifold,      ///< cut open between more than two faces
    edges_unorientable,     ///< cut open because no turning of faces makes both sides agree
    vertices_nonmanifold,   ///< split: separate fans of faces touched there
    // Flagged: kept as they are.
    faces_zero_area,      ///< no area
    faces_sliver,         ///< an angle below one degree
    components_small,     ///< less than a thousandth of the largest component's area
    components_inverted,  ///< closed, but inside out
    points_only,          ///< no faces: the vertices were kept
    // Left out by the reader of the file; the message names it.
    indices_dangling,    ///< references to texture coordinates or normals that do not exist
    values_not_finite,   ///< attribute values that were NaN or infinite
    content_skipped,     ///< content of the file without a place in a mesh
    files_missing,       ///< textures and other files that were not found
    extensions_dropped,  ///< extensions of the format that are not understood
};

/// Returns the name of a kind in scripts and reports: "vertices_welded".
std::string_view finding_name(FindingKind kind);

/// Returns a sentence on the meaning of a kind: "Copies of other faces were dropped."
std::string_view finding_explanation(FindingKind kind);

/// Returns all kinds, in the order of their declaration.
const std::vector<FindingKind>& all_finding_kinds();

struct Finding {
    FindingKind kind = FindingKind::content_skipped;
    /// Kind of the elements in `ids`. Edges are pairs of vertex ids, so that `ids` holds two
    /// entries an edge.
    ElementKind element = ElementKind::none;
    /// Whether the ids are those of the file (for changes) or of the mesh (for its contents).
    bool in_file = false;
    std::size_t count = 0;
    /// 0-based; all of them, in ascending order. Empty if there is nothing to number.
    std::vector<Index> ids;
    /// One sentence, or the names of the omitted parts.
    std::string message;

    bool operator==(const Finding&) const = default;
};

/// Findings in the order in which they were made; at most one of each kind.
class Report {
  public:
    /// Adds a finding. If there is one of its kind, counts and ids are added to it and the messages
    /// joined.
    void add(Finding finding);
    /// Adds `count` elements that have no numbers.
    void add(FindingKind kind, std::size_t count, std::string message);

    const std::vector<Finding>& findings() const { return findings_; }
    const Finding* find(FindingKind kind) const;
    bool empty() const { return findings_.empty(); }
    bool operator==(const Report&) const = default;

  private:
    std::vector<Finding> findings_;
};

/// "3 vertices welded", "2 faces without area": a finding in a few words.
std::string describe(const Finding& finding);

}  // namespace lissom
