/// Parameters that a scene keeps for tools and scripts: values by name, by whose they are.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>

namespace lissom {

using SceneParameter = std::variant<bool, double, std::string>;
using SceneParameters = std::map<std::string, SceneParameter, std::less<>>;
/// Parameters by the name of the tool or script.
using ParametersByOwner = std::map<std::string, SceneParameters, std::less<>>;

}  // namespace lissom
