/// Mapping between the properties of PLY elements and the contents of a mesh; private to kernel/io.
///
/// - Some numbers together are one attribute with a meaning, as red, green and blue are "color";
///   texture_u2 and texture_v2 are "uv2", and so on.
/// - Consecutive numbers called <name>_0, <name>_1, ... are one attribute of that width; any other
///   is an attribute of its own name.
/// - Bytes of vertices called region_<name> that are 0 or 1 are a region.
/// - Numbers of faces whose values the header gives names (PlyHeader::label_names) are labels.
/// - Lists of faces are attributes of corners: texcoord is "uv", texcoord2 is "uv2", and so on;
///   corner_<width>_<name> is any other.
///
/// Names are percent-encoded. A name that would be read as something else has one more of its
/// characters encoded than it needs: "x" is "%78".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/io/ply/header.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Begins the names of properties that are regions.
inline constexpr std::string_view kPlyRegionPrefix = "region_";

/// Destination of the values of one property while rows are read: a component of an attribute, a
/// list, or none.
struct PlySlot {
    double* out = nullptr;
    std::size_t stride = 0;
    double divisor = 1.0;
    std::vector<double>* list = nullptr;
};

/// Roles of single numbers of an element.
enum class PlyRole { position, attribute, region, labels };

/// Numbers that belong together; a region or labels are in it as an attribute of width 1.
struct PlyColumn {
    PlyRole role = PlyRole::attribute;
    Attribute attribute;
};

/// The columns of an element's single numbers, and the column of each property.
class PlyLayout {
  public:
    /// Both must outlive the layout; the element is one of the header's.
    PlyLayout(const PlyHeader& header, const PlyElement& element, Domain domain);

    /// Makes room for `rows` elements. The slots are valid until the columns are taken.
    void allocate(std::size_t rows);
    /// Returns one slot a property.
    std::vector<PlySlot>& slots() { return slots_; }
    /// Lets the list called `name` be read into `list`; false if there is no such list.
    bool attach_list(std::string_view name, std::vector<double>& list);
    /// Returns the columns, cut to the element's number of rows; the positions first.
    std::vector<PlyColumn> take_columns();
    /// Names of the properties that go nowhere.
    std::vector<std::string> unplaced() const;

  private:
    struct Target {
        Index column = kNoIndex;
        Index component = 0;
    };

    void add_groups();
    void add_texture_coordinate_sets();
    void add_named();
    void add_group(PlyRole role, std::string_view name, const std::vector<Index>& properties);
    void add(PlyRole role, std::string name, const std::vector<Index>& properties);
    bool has(PlyRole role, std::string_view name) const;
    bool is_free_number(Index property) const;
    bool have_one_type(const std::vector<Index>& properties) const;
    bool is_region(Index property) const;
    bool is_labels(Index property) const;
    std::vector<Index> numbered_from(Index first) const;

    const PlyHeader& header_;
    const PlyElement& element_;
    Domain domain_;
    std::vector<PlySlot> slots_;
    std::vector<Target> targets_;
    std::vector<PlyColumn> columns_;
};

/// The names of the properties that stand for an attribute of vertices or faces. `shielded` returns
/// other names with the same meaning, for use if the usual ones are taken.
std::vector<std::string> ply_property_names(const std::string& attribute, Index width,
                                            Domain domain, bool shielded = false);

/// Returns an attribute of corners as a list's name tells it, without values.
std::optional<Attribute> ply_corner_attribute(const PlyProperty& list);

/// Returns the name of the list that stands for an attribute of corners.
std::string ply_list_name(const Attribute& corner_attribute);

/// Largest width of an attribute of corners.
inline constexpr Index kPlyLargestCornerWidth = 16;

/// True for the attributes "color", "color2", ... with their three or four components, whose
/// integers are scaled.
bool is_ply_color(std::string_view attribute, Index width);

}  // namespace lissom
