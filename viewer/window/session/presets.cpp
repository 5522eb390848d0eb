#include "viewer/window/session/presets.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;
using PresetJson = nlohmann::json;

[[noreturn]] void refuse_file(const fs::path& file, const std::string& why) {
    throw Error(ErrorCode::file_syntax,
                display_name(file) + ": " + why + "; mend the file, or move it away");
}

lua::ParameterValue value_of(const PresetJson& json, const fs::path& file) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    refuse_file(file, "a value must be a number, a text, true or false");
}

PresetJson json_of(const lua::ParameterValue& value) {
    return std::visit([](const auto& held) { return PresetJson(held); }, value);
}

PresetJson parsed(const fs::path& file) {
    try {
        return PresetJson::parse(read_file(file).bytes);
    } catch (const PresetJson::exception& error) {
        refuse_file(file, error.what());
    }
}

void require_object(const PresetJson& json, const fs::path& file) {
    if (!json.is_object()) refuse_file(file, "presets are { \"name\": { \"parameter\": value } }");
}

}  // namespace

Presets::Presets(const fs::path& script) {
    if (!script.empty()) file_ = fs::path(script).replace_extension(".presets.json");
}

Presets::All Presets::read() const {
    std::error_code error;
    if (file_.empty() || !fs::exists(file_, error)) return {};
    const PresetJson json = parsed(file_);
    require_object(json, file_);
    All all;
    for (const auto& [name, values] : json.items()) {
        require_object(values, file_);
        PresetValues& preset = all[name];
        for (const auto& [key, value] : values.items()) preset.emplace(key, value_of(value, file_));
    }
    return all;
}

void Presets::write(const All& all) const {
    PresetJson json = PresetJson::object();
    for (const auto& [name, values] : all) {
        PresetJson& preset = json[name] = PresetJson::object();
        for (const auto& [key, value] : values) preset[key] = json_of(value);
    }
    write_file_atomically(file_,
                          json.dump(4, ' ', false, PresetJson::error_handler_t::replace) + "\n");
}

std::vector<std::string> Presets::names() const {
    std::vector<std::string> names;
    for (const auto& [name, values] : read()) names.push_back(name);
    return names;
}

PresetValues Presets::load(const std::string& name) const {
    const All all = read();
    const auto found = all.find(name);
    if (found != all.end()) return found->second;
    throw Error(ErrorCode::out_of_range, display_name(file_) + " has no preset '" + name + "'");
}

void Presets::save(const std::string& name, const PresetValues& values) const {
    if (name.empty()) throw Error(ErrorCode::invalid_argument, "a preset needs a name");
    All all = read();
    all[name] = values;
    write(all);
}

void Presets::remove(const std::string& name) const {
    All all = read();
    if (all.erase(name) > 0) write(all);
}

PresetValues values_of(const std::vector<lua::ScriptParameter>& parameters) {
    PresetValues values;
    for (const lua::ScriptParameter& p : parameters) {
        const auto& value = p.value ? p.value : p.default_value;
        if (value) values.emplace(p.name, *value);
    }
    return values;
}

std::vector<std::string> apply_preset(const PresetValues& values,
                                      std::vector<lua::ScriptParameter>& parameters) {
    std::vector<std::string> refused;
    std::set<std::string> unknown;
    for (const auto& [name, value] : values) unknown.insert(name);
    for (lua::ScriptParameter& p : parameters) {
        const auto found = values.find(p.name);
        unknown.erase(p.name);
        try {
            if (found != values.end()) p.check(found->second);
            p.value = found != values.end() ? std::optional(found->second) : p.default_value;
        } catch (const lua::ParameterError& error) {
            refused.push_back(error.message);
        }
    }
    for (const std::string& name : unknown) {
        refused.push_back("the script has no parameter '" + name + "' any more");
    }
    return refused;
}

}  // namespace lissom::window
