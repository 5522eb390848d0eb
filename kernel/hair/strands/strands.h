/// Strands: hair as polylines, root to tip, with the data of each. Lengths are in metres, the axes
/// those of the head; points are 32-bit numbers, 12 bytes each.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/memory_hold.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Diameter of strands without a width: that of a human hair, 70 to 80 micrometres.
inline constexpr float kHairWidth = 75e-6f;

/// Domain of values.
enum class StrandDomain {
    all,     ///< all strands share one
    strand,  ///< each strand
    point,   ///< each point
};

/// Values for all strands, for each strand, or for each point.
template <typename Value>
struct StrandValues {
    /// The value of all strands; unused if there are others.
    Value common;
    StrandDomain domain = StrandDomain::all;
    /// One for each element of the domain; empty for StrandDomain::all.
    std::vector<Value> values = {};

    /// Returns the value at a point; `point` counts over all strands.
    const Value& at(Index strand, Index point) const {
        if (domain == StrandDomain::all) return common;
        return values[lissom::at(domain == StrandDomain::strand ? strand : point)];
    }
};

/// Diameters in metres, times a profile along the strand.
struct StrandWidths : StrandValues<float> {
    StrandWidths() : StrandValues{kHairWidth} {}

    /// Factors at equal steps of arc length from the root to the tip, linear between; empty for
    /// none.
    std::vector<float> profile;

    /// Returns the profile at `t`, 0 at the root and 1 at the tip; 1 if there is none.
    float factor(double t) const;
};

/// Roots of strands on the mesh of the head. Lists have one entry a strand, or none.
struct StrandRoots {
    std::vector<Index> faces = {};
    /// Weights of the vertices of `triangles`, which sum to 1.
    std::vector<Eigen::Vector3f> barycentrics = {};
    /// Texture coordinates of the roots.
    std::vector<Eigen::Vector2f> uvs = {};
    /// Vertices of the triangle of the face that contains the root; empty on heads of triangles,
    /// and if it is not known: then the first three corners of the face count.
    std::vector<Triangle> triangles = {};
};

/// Id of the guide of a strand that follows none.
inline constexpr std::uint32_t kNoGuide = 0xffffffff;

/// The guides that strands follow. Lists have one entry a strand, or none.
struct StrandGuides {
    /// Id of the strand that each follows, its own for a guide; kNoGuide for none.
    std::vector<std::uint32_t> ids;
    /// Place in metres along the guide that the tip of each strand follows: strands of one guide
    /// have equal places at equal arcs, however curled or gathered they are.
    std::vector<float> arcs;

    bool operator==(const StrandGuides& other) const = default;
};

/// The points of one strand, a column each, without a copy.
using StrandView = Eigen::Map<const Eigen::Matrix3Xf>;

/// Point `i` of a strand.
inline Vec3 point_of(const StrandView& strand, Index i) {
    return strand.col(i).cast<double>();
}
using StrandEdit = Eigen::Map<Eigen::Matrix3Xf>;

/// Hair. Every strand has at least one point, its root; a strand of one point has no hair. Strands
/// are numbered from 0 in their order; their ids stay with them when some are selected. Their
/// memory counts on the account that they were made with, and so does that of copies: copying them,
/// or adding to them, may throw memory_limit.
class Strands {
  public:
    /// No strands.
    Strands() = default;
    /// `points`: x y z of all strands one after the other; strand s has the points offsets[s] to
    /// offsets[s + 1] - 1, at most 100,000. Errors: invalid_argument if offsets do not begin with
    /// 0, grow, and end with the number of points; memory_limit. Null counts nowhere.
    Strands(std::vector<float> points, std::vector<Index> offsets,
            std::shared_ptr<MemoryAccount> account = nullptr);

    Index size() const { return count_of(offsets_) - 1; }
    bool empty() const { return size() == 0; }
    /// Points of all strands together, and of one.
    Index point_count() const { return offsets_.back(); }
    Index point_count(Index strand) const {
        return offsets_[at(strand) + 1] - offsets_[at(strand)];
    }
    /// Number of a strand's root among all points.
    Index first_point(Index strand) const { return offsets_[at(strand)]; }

    /// x y z of all points.
    std::span<const float> points() const { return points_; }
    std::span<float> edit_points() { return points_; }
    std::span<const Index> offsets() const { return offsets_; }
    StrandView strand(Index s) const { return {data(s), 3, point_count(s)}; }
    StrandEdit edit_strand(Index s) {
        return {points_.data() + 3 * at(first_point(s)), 3, point_count(s)};
    }
    Eigen::Vector3f root(Index s) const { return Eigen::Map<const Eigen::Vector3f>(data(s)); }
    /// Moves points and offsets out, so that their memory can be used again; no strands are left.
    void release(std::vector<float>& points, std::vector<Index>& offsets);

    const StrandWidths& widths() const { return widths_; }
    const StrandRoots& roots() const { return roots_; }
    /// Group of each strand, as a place in `group_names`, or kNoIndex; empty if there are none.
    const std::vector<Index>& groups() const { return groups_; }
    const std::vector<std::string>& group_names() const { return group_names_; }
    /// Returns the group of a strand, or kNoIndex.
    Index group(Index strand) const { return groups_.empty() ? kNoIndex : groups_[at(strand)]; }
    /// Returns the group called `name`, or kNoIndex.
    Index find_group(std::string_view name) const;
    /// Returns the id of each strand; empty if every id is the strand's number.
    const std::vector<std::uint32_t>& ids() const { return ids_; }
    std::uint32_t id(Index strand) const {
        return ids_.empty() ? static_cast<std::uint32_t>(strand) : ids_[at(strand)];
    }
    /// Returns the guides, whose lists are empty if strands follow none.
    const StrandGuides& guides() const { return guides_; }
    /// Linear RGB; null if no colour is known.
    const StrandValues<Eigen::Vector3f>* colors() const { return has_colors_ ? &colors_ : nullptr; }
    /// 0 is opaque.
    const StrandValues<float>& transparency() const { return transparency_; }
    /// Returns the file's own comment.
    const std::string& comment() const { return comment_; }

    /// These replace the old values. Errors: invalid_argument if lists have another length than
    /// their elements, or a group has no name.
    void set_widths(StrandWidths widths);
    void set_roots(StrandRoots roots);
    void set_groups(std::vector<Index> groups, std::vector<std::string> names);
    void set_ids(std::vector<std::uint32_t> ids);
    void set_guides(StrandGuides guides);
    void set_colors(StrandValues<Eigen::Vector3f> colors);
    void set_transparency(StrandValues<float> transparency);
    void set_comment(std::string comment) { comment_ = std::move(comment); }

    /// Bytes of all lists.
    std::size_t memory_bytes() const;
    const std::shared_ptr<MemoryAccount>& account() const { return hold_.account(); }

  private:
    const float* data(Index s) const { return points_.data() + 3 * at(first_point(s)); }

    template <typename List>
    void count(const List& now, const List& next);

    MemoryHold hold_;
    std::vector<float> points_;
    std::vector<Index> offsets_ = {0};
    StrandWidths widths_;
    StrandRoots roots_;
    std::vector<Index> groups_;
    std::vector<std::string> group_names_;
    std::vector<std::uint32_t> ids_;
    StrandGuides guides_;
    StrandValues<Eigen::Vector3f> colors_{Eigen::Vector3f::Zero()};
    bool has_colors_ = false;
    StrandValues<float> transparency_{0.0f};
    std::string comment_;
};

/// Throws out_of_range naming the strand if there is none of this number.
void require_strand(const Strands& strands, Index strand);

}  // namespace lissom
