/// Lists of words that formats know; private to kernel/io.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace lissom {

template <std::size_t Count>
bool is_one_of(std::string_view word, const std::array<std::string_view, Count>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace lissom
