#include "kernel/core/nearest.h"

#include <algorithm>
#include <numeric>

namespace lissom {
namespace {

// Longer texts are no names that a person mistypes, and no more pairs of letters than this are
// compared: a script may ask for a text of megabytes among a million names.
constexpr std::size_t kMaxNameLetters = 255;
constexpr std::size_t kMaxLetterPairs = 20'000'000;

// Optimal string alignment distance.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, above[j] + 1, row[j - 1] + 1});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, above);
        std::swap(above, row);
    }
    return above[b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view name,
                              const std::vector<std::string_view>& candidates) {
    std::string_view nearest;
    std::size_t fewest = std::max<std::size_t>(1, (name.size() + 1) / 3) + 1;
    std::size_t pairs = 0;
    for (const std::string_view candidate : candidates) {
        if (std::max(name.size(), candidate.size()) > kMaxNameLetters) continue;
        pairs += (name.size() + 1) * (candidate.size() + 1);
        if (pairs > kMaxLetterPairs) break;
        const std::size_t count = edits(name, candidate);
        if (count >= fewest || count >= std::max(name.size(), candidate.size())) continue;
        fewest = count;
        nearest = candidate;
    }
    if (!nearest.empty()) return nearest;
    for (const std::string_view candidate : candidates) {
        if (name.size() >= 3 && candidate.substr(0, name.size()) == name) return candidate;
    }
    return {};
}

std::string name_hint(std::string_view name, const std::vector<std::string_view>& candidates) {
    const std::string_view nearest = nearest_name(name, candidates);
    if (!nearest.empty()) return ", did you mean '" + std::string(nearest) + "'?";
    if (candidates.empty()) return "; there are none";
    std::string text = "; there is: ";
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        text += (i == 0 ? "" : ", ") + std::string(candidates[i]);
    }
    return text;
}

}  // namespace lissom
