/// How the properties of PLY elements and the attributes of a mesh stand for each other; private to
/// kernel/io. Some properties together are one attribute with a meaning, as red, green and blue are
/// "color"; consecutive ones called <name>_0, <name>_1, ... are one attribute of that width; any
/// other is an attribute of its own name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernel/io/ply_header.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Name of the attribute that the properties x, y and z make.
inline constexpr std::string_view kPlyPosition = "position";

/// Where the values of one property go while rows are read: a component of an attribute, a list, or
/// nowhere.
struct PlySlot {
    double* out = nullptr;
    std::size_t stride = 0;
    double divisor = 1.0;
    std::vector<double>* list = nullptr;
};

/// The attributes that the single numbers of an element make, and where in them each property goes.
class PlyLayout {
  public:
    PlyLayout(const PlyElement& element, Domain domain);

    /// Makes room for `rows` elements. The slots are valid until the attributes are taken.
    void allocate(std::size_t rows);
    /// One slot a property.
    std::vector<PlySlot>& slots() { return slots_; }
    /// Lets the list called `name` be read into `list`. Returns its property, or null where there
    /// is no such list.
    const PlyProperty* attach_list(std::string_view name, std::vector<double>& list);
    /// The attributes, cut to the element's number of rows.
    std::vector<Attribute> take_attributes();
    /// Names of the properties that go nowhere.
    std::vector<std::string> unplaced() const;

  private:
    struct Target {
        Index attribute = kNoIndex;
        Index component = 0;
    };

    void add_groups();
    void add_named_attributes();
    void add(std::string name, const std::vector<Index>& properties);
    bool has(std::string_view attribute) const;
    bool is_free_number(Index property) const;
    bool have_one_type(const std::vector<Index>& properties) const;
    std::vector<Index> numbered_from(Index first) const;

    const PlyElement& element_;
    Domain domain_;
    std::vector<PlySlot> slots_;
    std::vector<Target> targets_;
    std::vector<Attribute> attributes_;
};

/// The names of the properties that stand for an attribute; empty where they would be read as
/// another.
std::vector<std::string> ply_property_names(const std::string& attribute, Index width,
                                            Domain domain);

/// True for the attribute "color" with its three or four components, whose integers are scaled.
bool is_ply_color(std::string_view attribute, Index width);

}  // namespace lissom
