/// SceneWriter and SceneReader: one description of an object's contents serves for writing and for
/// reading. Plain values go to JSON, lists of numbers to parts of their own; private to
/// kernel/scene.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/scene/file/list_store.h"
#include "kernel/scene/scene_parameters.h"

namespace lissom {

/// Name of a record of a list for people, used for files; empty for its place in the list.
template <typename T>
std::string label_of(const T&) {
    return {};
}

/// Numbers of an element of a list: 3 for a Vec3, 1 for a number.
template <typename T>
struct ListElement {
    using Scalar = T;
};
template <typename T>
requires requires {
    typename T::Scalar;
}
struct ListElement<T> {
    using Scalar = typename T::Scalar;
};

/// Returns the form of a list whose elements have `width` numbers, or 0: those of their type.
template <typename T>
ListForm list_form(std::size_t width) {
    using Scalar = typename ListElement<T>::Scalar;
    return {number_type<Scalar>(), width ? width : sizeof(T) / sizeof(Scalar)};
}

static_assert(std::endian::native == std::endian::little,
              "lists of numbers are written as they lie in memory");

class SceneWriter {
  public:
    static constexpr bool kReads = false;

    SceneWriter(SceneJson& json, ListSink& lists, ListPlace place = {})
        : json_(json), lists_(lists), place_(std::move(place)) {}

    void flag(const char* key, bool& value) { json_[key] = value; }
    void integer(const char* key, Index& value) { json_[key] = value; }
    void number(const char* key, double& value) { json_[key] = value; }
    void number(const char* key, float& value) { json_[key] = double{value}; }
    void number(const char* key, std::optional<double>& value) {
        if (value) json_[key] = *value;
    }
    void text(const char* key, std::string& value) { json_[key] = value; }
    void texts(const char* key, std::vector<std::string>& values) { json_[key] = values; }
    template <typename Enum>
    void choice(const char* key, Enum& value, std::span<const char* const> names) {
        json_[key] = names[static_cast<std::size_t>(value)];
    }
    void numbers(const char* key, std::span<double> values) {
        json_[key] = std::vector<double>(values.begin(), values.end());
    }
    /// A list of a few numbers, in the JSON.
    template <typename T>
    void few(const char* key, std::vector<T>& values) {
        json_[key] = values;
    }
    /// A list of elements of their type, or of `width` numbers an element.
    template <typename T>
    void list(const char* key, std::vector<T>& values, std::size_t width = 0) {
        const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                     values.size() * sizeof(T));
        keep(key, lists_.put(place_of(key), bytes, list_form<T>(width)));
    }
    /// Returns false if the store has no files of models: then they are lists.
    bool surface(std::vector<Vec3>& positions, std::vector<Index>& offsets,
                 std::vector<Index>& corners) {
        return keep("model",
                    lists_.put_model(place_.label, {positions, {}, offsets, corners, false}));
    }
    bool lines(std::vector<float>& points, std::vector<Index>& offsets) {
        return keep("model", lists_.put_model(place_.label, {{}, points, offsets, {}, true}));
    }
    void parameters(const char* key, ParametersByOwner& all) {
        SceneJson& json = json_[key] = SceneJson::object();
        for (const auto& [owner, values] : all) {
            SceneJson& of_owner = json[owner] = SceneJson::object();
            for (const auto& [name, value] : values) {
                SceneJson& kept = of_owner[name];
                std::visit([&](const auto& x) { kept = x; }, value);
            }
        }
    }
    template <typename Describe>
    void object(const char* key, const Describe& describe) {
        SceneWriter inner(json_[key] = SceneJson::object(), lists_, inner_place(key, key));
        describe(inner);
    }
    template <typename T, typename Describe>
    void optional(const char* key, std::optional<T>& value, const Describe& describe) {
        if (value) object(key, [&](SceneWriter& inner) { describe(inner, *value); });
    }
    template <typename T, typename Describe>
    void objects(const char* key, std::vector<T>& values, const Describe& describe) {
        SceneJson& array = json_[key] = SceneJson::array();
        for (std::size_t i = 0; i < values.size(); ++i) {
            array.push_back(SceneJson::object());
            const std::string number = std::to_string(i), label = label_of(values[i]);
            const std::string begin = std::string(key) + "/";
            SceneWriter inner(
                array.back(), lists_,
                inner_place(begin + number, begin + (label.empty() ? number : label)));
            describe(inner, values[i]);
        }
    }

  private:
    ListPlace place_of(const char* key) const { return {place_.path + key, place_.label + key}; }
    ListPlace inner_place(const std::string& path, const std::string& label) const {
        return {place_.path + path + "/", place_.label + label + "/"};
    }
    bool keep(const char* key, SceneJson entry) {
        if (entry.is_null()) return false;
        json_[key] = std::move(entry);
        return true;
    }

    SceneJson& json_;
    ListSink& lists_;
    ListPlace place_;
};

/// Errors of all: file_syntax, naming the value; file_truncated for a list that is missing.
class SceneReader {
  public:
    static constexpr bool kReads = true;

    SceneReader(const SceneJson& json, ListSource& lists, std::string path = {})
        : json_(json), lists_(lists), path_(std::move(path)) {
        if (!json.is_object()) refuse("", "an object {...}");
    }

    void flag(const char* key, bool& value) {
        const SceneJson& found = at(key);
        if (!found.is_boolean()) refuse(key, "true or false");
        value = found.get<bool>();
    }
    void integer(const char* key, Index& value) {
        const double given = finite(key, at(key));
        if (given != std::floor(given) || std::abs(given) > 2e9) refuse(key, "a whole number");
        value = static_cast<Index>(given);
    }
    void number(const char* key, double& value) { value = finite(key, at(key)); }
    void number(const char* key, float& value) { value = static_cast<float>(finite(key, at(key))); }
    void number(const char* key, std::optional<double>& value) {
        value = json_.contains(key) ? std::optional(finite(key, at(key))) : std::nullopt;
    }
    void text(const char* key, std::string& value) {
        const SceneJson& found = at(key);
        if (!found.is_string()) refuse(key, "a text");
        value = found.get<std::string>();
    }
    void texts(const char* key, std::vector<std::string>& values) {
        for (const SceneJson& one : array(key)) {
            if (!one.is_string()) refuse(key, "a list of texts");
            values.push_back(one.get<std::string>());
        }
    }
    template <typename Enum>
    void choice(const char* key, Enum& value, std::span<const char* const> names) {
        std::string given;
        text(key, given);
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (given == names[i]) {
                value = static_cast<Enum>(i);
                return;
            }
        }
        refuse(key, "one of the names that it can have");
    }
    void numbers(const char* key, std::span<double> values) {
        const SceneJson& found = array(key);
        if (found.size() != values.size()) refuse(key, "a list of another length");
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = finite(key, found[i]);
    }
    template <typename T>
    void few(const char* key, std::vector<T>& values) {
        for (const SceneJson& one : array(key)) {
            const double number = finite(key, one);
            if (std::is_integral_v<T> && !(std::abs(number) < 2e9)) refuse(key, "smaller numbers");
            values.push_back(static_cast<T>(number));
        }
    }
    template <typename T>
    void list(const char* key, std::vector<T>& values, std::size_t width = 0) {
        const auto entry = json_.find(key);
        const std::string_view bytes =
            lists_.get(path_ + key, entry == json_.end() ? nullptr : &*entry, list_form<T>(width));
        if (bytes.size() % sizeof(T) != 0) refuse(key, "a list of whole elements");
        values.resize(bytes.size() / sizeof(T));
        if (bytes.empty()) return;
        using Scalar = typename ListElement<T>::Scalar;
        std::memcpy(reinterpret_cast<Scalar*>(values.data()), bytes.data(), bytes.size());
    }
    bool surface(std::vector<Vec3>& positions, std::vector<Index>& offsets,
                 std::vector<Index>& corners) {
        if (!json_.contains("model")) return false;
        lists_.get_surface(path_ + "model", at("model"), positions, offsets, corners);
        return true;
    }
    bool lines(std::vector<float>& points, std::vector<Index>& offsets) {
        if (!json_.contains("model")) return false;
        lists_.get_lines(path_ + "model", at("model"), points, offsets);
        return true;
    }
    /// Reads the parameters, if there are any.
    void parameters(const char* key, ParametersByOwner& all) {
        if (!json_.contains(key)) return;
        for (const auto& [owner, values] : members(at(key), key)) {
            for (const auto& [name, value] : members(values, key)) {
                all[owner][name] = parameter(key, value);
            }
        }
    }
    template <typename Describe>
    void object(const char* key, const Describe& describe) {
        SceneReader inner(at(key), lists_, path_ + key + "/");
        describe(inner);
    }
    template <typename T, typename Describe>
    void optional(const char* key, std::optional<T>& value, const Describe& describe) {
        value.reset();
        if (!json_.contains(key)) return;
        object(key, [&](SceneReader& inner) { describe(inner, value.emplace()); });
    }
    template <typename T, typename Describe>
    void objects(const char* key, std::vector<T>& values, const Describe& describe) {
        const SceneJson& found = array(key);
        for (std::size_t i = 0; i < found.size(); ++i) {
            SceneReader inner(found[i], lists_, path_ + key + "/" + std::to_string(i) + "/");
            describe(inner, values.emplace_back());
        }
    }

  private:
    [[noreturn]] void refuse(const char* key, const char* expected) const {
        throw Error(ErrorCode::file_syntax,
                    "the scene's '" + path_ + key + "' must be " + expected);
    }
    const SceneJson& at(const char* key) const {
        const auto found = json_.find(key);
        if (found == json_.end()) refuse(key, "there");
        return *found;
    }
    const SceneJson::object_t& members(const SceneJson& json, const char* key) const {
        if (!json.is_object()) refuse(key, "an object {...}");
        return json.get_ref<const SceneJson::object_t&>();
    }
    SceneParameter parameter(const char* key, const SceneJson& json) const {
        if (json.is_boolean()) return json.get<bool>();
        if (json.is_string()) return json.get<std::string>();
        return finite(key, json);
    }
    const SceneJson& array(const char* key) const {
        const SceneJson& found = at(key);
        if (!found.is_array()) refuse(key, "a list");
        return found;
    }
    double finite(const char* key, const SceneJson& json) const {
        if (!json.is_number() || !std::isfinite(json.get<double>())) refuse(key, "a number");
        return json.get<double>();
    }

    const SceneJson& json_;
    ListSource& lists_;
    std::string path_;
};

/// Vectors and maps as lists of numbers.
template <typename Archive>
void describe_vector(Archive& a, const char* key, Vec3& v) {
    a.numbers(key, std::span<double>(v.data(), 3));
}
template <typename Archive>
void describe_matrix(Archive& a, const char* key, Mat3& m) {
    a.numbers(key, std::span<double>(m.data(), 9));
}
/// Columns of the linear part, then the translation.
template <typename Archive>
void describe_map(Archive& a, const char* key, Affine& map) {
    std::array<double, 12> values{};
    Eigen::Map<Eigen::Matrix<double, 3, 4>> matrix(values.data());
    matrix.leftCols<3>() = map.linear;
    matrix.col(3) = map.translation;
    a.numbers(key, values);
    map = {matrix.leftCols<3>(), matrix.col(3)};
}

}  // namespace lissom
