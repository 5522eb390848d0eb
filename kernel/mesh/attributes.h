/// Attributes: named data on the vertices, corners or faces of a mesh. They travel with it through
/// every operation and through files.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/memory_hold.h"

namespace lissom {

/// The elements that an attribute has values on. A corner is a vertex as seen by one of its faces.
enum class Domain { vertex, corner, face };

/// The number type a file stored, so that it can be written back; values are kept as double.
enum class ScalarType { float32, float64, int8, uint8, int16, uint16, int32, uint32 };

/// One attribute: `width` numbers an element. A value of NaN means that the element has none.
///
/// Names with a meaning; operations treat their values accordingly:
/// - "uv", "uv2", "uv3", ... (width 2; corner or vertex): texture coordinates, v pointing up
/// - "normal" and "face_normal" (3; corner, vertex or face), "tangent" (4: direction and
/// handedness; corner or vertex)
/// - "color", "color2", ... (3 or 4, linear scale 0 to 1; corner, vertex or face)
/// - "joints" and "weights" (both of one width, a multiple of 4; vertex): the joints of a skin that
///   move a vertex, and how much
/// - "morph.N.position", "morph.N.normal", "morph.N.tangent" (3; vertex or corner): offset of the
///   N-th morph target, from 1
struct Attribute {
    std::string name;
    Domain domain = Domain::vertex;
    Index width = 1;
    ScalarType type = ScalarType::float32;
    std::vector<double> values;

    Index size() const { return count_of(values) / width; }
    std::span<double> at(Index element) {
        return {values.data() + lissom::at(element) * lissom::at(width), lissom::at(width)};
    }
    std::span<const double> at(Index element) const {
        return {values.data() + lissom::at(element) * lissom::at(width), lissom::at(width)};
    }
};

/// Meaning of an attribute's values, given by its name and width.
enum class AttributeRole {
    value,
    texture_coordinates,
    color,
    normal,
    tangent,
    joints,
    weights,
    morph_position,
    morph_normal,
    morph_tangent,
};

AttributeRole role_of(const Attribute& attribute);

/// Labels of faces, for instance the group or material that each belongs to. Kinds with a meaning:
/// "object", "group", "material", "smoothing".
struct FaceLabels {
    std::vector<std::string> names;
    /// Index into `names` for every face, or kNoIndex.
    std::vector<Index> of_face;

    /// Index of `label` in `names`; adds it if it is new.
    Index add(std::string_view label);

    bool operator==(const FaceLabels&) const = default;
};

/// All attributes and labels of one mesh, in the order they were added. Those of a mesh count on
/// its account, and stay there when another set is assigned.
class AttributeSet {
  public:
    AttributeSet() = default;
    /// Counts on the account of `other`. Errors: memory_limit.
    AttributeSet(const AttributeSet& other);
    AttributeSet(AttributeSet&& other) noexcept = default;
    /// Errors: memory_limit, and then nothing has changed.
    AttributeSet& operator=(const AttributeSet& other);
    // It counts on this set's account, which may refuse.
    // NOLINTNEXTLINE(performance-noexcept-move-constructor)
    AttributeSet& operator=(AttributeSet&& other);
    ~AttributeSet() = default;
    /// Exchanges everything, accounts too.
    void swap(AttributeSet& other) noexcept;

    /// Counts on `account` (null: nowhere) from now on. Errors: memory_limit, and then nothing has
    /// changed.
    void count_on(std::shared_ptr<MemoryAccount> account);
    /// To be called after lists were made longer or shorter through a reference. Errors:
    /// memory_limit.
    void recount() { hold_.resize(memory_bytes()); }

    /// Returns the attribute called `name`, or null.
    Attribute* find(std::string_view name);
    const Attribute* find(std::string_view name) const;
    /// Adds an attribute, replacing one of the same name. The reference is valid until the next add
    /// or remove.
    /// Errors: invalid_argument for an empty name or a width below 1; memory_limit.
    Attribute& add(Attribute attribute);
    bool remove(std::string_view name);
    const std::vector<Attribute>& all() const { return attributes_; }
    std::vector<Attribute>& all() { return attributes_; }

    /// Face labels by kind.
    const std::map<std::string, FaceLabels, std::less<>>& labels() const { return labels_; }
    std::map<std::string, FaceLabels, std::less<>>& labels() { return labels_; }

    std::size_t memory_bytes() const;

  private:
    MemoryHold hold_;
    std::vector<Attribute> attributes_;
    std::map<std::string, FaceLabels, std::less<>> labels_;
};

}  // namespace lissom
