/// The name that someone probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lissom {

/// Returns the candidate with the fewest edits (letters changed, added, left out or swapped with
/// their neighbour) from `name`, the first of ties; at most a third of the letters, and one in
/// short names. Else the first candidate that begins with `name`. Returns an empty name if neither
/// exists. Names of more than 255 letters are near to none, and among very many candidates only the
/// first are looked at, so that the time does not depend on the arguments.
std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& candidates);

/// Returns ", did you mean 'smooth'?" if a candidate is near, else "; there is: a, b, c".
std::string name_hint(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace lissom
