/// Parameters of a script (lissom.params): one declaration gives the command-line flag, the help
/// text, the conversion and check of values, and the range of a slider.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bindings/lua/core/compat.h"
#include "kernel/core/memory_hold.h"

namespace lissom::lua {

/// The order of the choices of `type` in the registration. Values of the last five are texts, which
/// a host makes by a picker: the file or the name of a mesh or a head, the name of a region, the
/// name or number of an open boundary or a curve.
enum class ParameterType {
    number,
    integer,
    boolean,
    string,
    choice,
    file,
    folder,
    mesh,
    region,
    boundary,
    curve,
    head
};

/// Returns whether values lie on a mesh, which another parameter may name.
bool lies_on_mesh(ParameterType type);

struct State;

using ParameterValue = std::variant<bool, double, std::string>;

/// Name of a type: "number", ...
std::string_view type_name(ParameterType type);

struct ScriptParameter {
    std::string name;
    ParameterType type = ParameterType::number;
    /// Absent: the value must be given.
    std::optional<ParameterValue> default_value;
    std::optional<ParameterValue> value;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    std::optional<double> step;
    std::vector<std::string> choices;
    std::string unit, group, help;
    /// The parameter of the mesh or head that a region, boundary or curve lies on; "" for none.
    std::string of = {};

    /// Converts the text of a flag. Throws ParameterError.
    ParameterValue from_text(const std::string& text) const;
    /// Checks a value. Throws ParameterError.
    void check(const ParameterValue& value) const;
    /// Makes the folder that the value names, if this is a folder to write to and the host of the
    /// state allows it. Throws ParameterError.
    void make_folder(const State& state) const;
    /// Returns the accepted values: "number from 0 to 1", "small, medium or large".
    std::string accepted() const;
};

/// A value that a parameter does not accept, or a flag that does not exist.
struct ParameterError : std::exception {
    explicit ParameterError(std::string text) : message(std::move(text)) {}
    const char* what() const noexcept override { return message.c_str(); }
    std::string message;
};

/// Whether a word of a command line is meant as a flag: "--name" or "-n", but not "-", "-1" or
/// "--".
bool is_flag(const std::string& word);

/// The first flag among the words before "--", or "".
std::string first_flag(const std::vector<std::string>& words);

/// "'in.obj' is no flag, and ..." for a word that the script never looks at.
std::string stray_word_text(const std::string& word);

/// Tells the state whether its script looks at the words of its command line by itself, as by
/// `arg`.
void set_reads_words(lua_State* L, bool reads);
/// Result of reading the words; true if there were none.
bool reads_words(lua_State* L);

/// Whether these words ask for help: --help or -h before "--".
bool asks_for_help(const std::vector<std::string>& words);

/// "no parameter '--tun', did you mean '--turn'?" for a flag that none of `names` has.
std::string unknown_flag_text(const std::string& flag, const std::vector<std::string_view>& names);

/// All parameters of one script, ordered by group and name.
struct ParameterSet {
    static constexpr const char* kTypeName = "lissom.Params";

    std::vector<ScriptParameter> list;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    /// Bytes of the declarations, with their texts and values.
    std::size_t memory_bytes() const;

    ScriptParameter* find(std::string_view name);
    std::vector<std::string_view> names() const;
    void sort();

    /// Takes values from the words of a command line and returns the words that are no flags. A
    /// flag is --name VALUE or --name=VALUE, for a boolean also --name and --no-name, and then the
    /// next word is its value if it is true, false, yes, no, on, off, 1 or 0; "-" and "_" are the
    /// same in names; "--" ends the flags. Throws ParameterError for flags that no parameter has,
    /// naming the nearest.
    std::vector<std::string> take(const std::vector<std::string>& words);
    /// Throws ParameterError if a parameter has neither value nor default.
    void require_values() const;

    /// The help text of `lissom run SCRIPT --help`.
    std::string help_text(const std::string& script) const;
};

}  // namespace lissom::lua
