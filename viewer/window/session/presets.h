/// Presets: values of a script's parameters under a name, in a file beside the script:
/// bend.presets.json for bend.lua, { "name": { "angle": 70, ... }, ... }.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bindings/lua/core/script_parameters.h"

namespace lissom::window {

/// Values by the names of parameters.
using PresetValues = std::map<std::string, lua::ParameterValue>;

class Presets {
  public:
    /// Presets of a script; none if the path is empty. Reads the file anew for every call, so that
    /// it may be edited meanwhile.
    explicit Presets(const std::filesystem::path& script = {});

    const std::filesystem::path& file() const { return file_; }
    /// In their order. Errors of this and of all below: file_syntax if the file is broken; those of
    /// read_file but for a file that does not exist.
    std::vector<std::string> names() const;
    /// Errors: out_of_range if there is none of that name.
    PresetValues load(const std::string& name) const;
    /// Adds a preset, or replaces that of the same name. Errors: invalid_argument for an empty
    /// name; those of write_file_atomically.
    void save(const std::string& name, const PresetValues& values) const;
    /// Nothing happens if there is none of that name.
    void remove(const std::string& name) const;

  private:
    using All = std::map<std::string, PresetValues>;
    All read() const;
    void write(const All& all) const;

    std::filesystem::path file_;
};

/// Returns the values that parameters have.
PresetValues values_of(const std::vector<lua::ScriptParameter>& parameters);

/// Gives parameters the values of a preset; other parameters get their defaults. Values that a
/// parameter refuses, or that no parameter has, are left out and reported.
std::vector<std::string> apply_preset(const PresetValues& values,
                                      std::vector<lua::ScriptParameter>& parameters);

}  // namespace lissom::window
