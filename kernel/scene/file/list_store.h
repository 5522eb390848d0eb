/// Storage of the lists of numbers of a scene file, outside its JSON: one interface for archives,
/// folders and histories; private to kernel/scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/io/stream/json_tree.h"

namespace lissom {

using SceneJson = OrderedJson;

enum class NumberType { float32, float64, int32, uint32, int64 };

/// Form of one list: numbers of one type, `width` for each element.
struct ListForm {
    NumberType type = NumberType::float64;
    std::size_t width = 1;
};

template <typename Number>
constexpr NumberType number_type() {
    if (std::is_same_v<Number, float>) return NumberType::float32;
    if (std::is_same_v<Number, double>) return NumberType::float64;
    if (std::is_same_v<Number, std::uint32_t>) return NumberType::uint32;
    return sizeof(Number) == 8 ? NumberType::int64 : NumberType::int32;
}

std::size_t bytes_of(NumberType type);

/// Place of a list: in the file ("items/0/positions"), and for people ("items/head/positions").
struct ListPlace {
    std::string path, label;
};

/// A surface or a set of lines: `offsets` are the first corners of the elements.
struct ModelView {
    std::span<const Vec3> positions;
    std::span<const float> points;
    std::span<const Index> offsets;
    /// Empty for lines, which run through `points` one after the other.
    std::span<const Index> corners;
    bool lines = false;
};

class ListSink {
  public:
    virtual ~ListSink();
    /// Keeps a list. Returns its entry for the JSON; null for nothing.
    virtual SceneJson put(const ListPlace& place, std::string_view bytes, ListForm form) = 0;
    /// Keeps a model as a file of its own, and returns its entry for the JSON; null if the store
    /// has no such files, so that it is lists as all else.
    virtual SceneJson put_model(const std::string& label, const ModelView& model);
};

/// Errors: file_syntax, file_truncated.
class ListSource {
  public:
    virtual ~ListSource();
    /// Returns the bytes of a list; `entry` is its entry in the JSON, or null. They are valid until
    /// the next call.
    virtual std::string_view get(const std::string& path, const SceneJson* entry,
                                 ListForm form) = 0;
    /// The surface or the lines of a model.
    virtual void get_surface(const std::string& path, const SceneJson& entry,
                             std::vector<Vec3>& positions, std::vector<Index>& offsets,
                             std::vector<Index>& corners);
    virtual void get_lines(const std::string& path, const SceneJson& entry,
                           std::vector<float>& points, std::vector<Index>& offsets);
};

}  // namespace lissom
