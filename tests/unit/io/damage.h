/// Damaged files, for the tests of readers.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace lissom::test {

/// Changes up to four places: other bytes, flipped bits, bytes left out or repeated, or one of
/// `letters`.
inline std::string damaged(std::string bytes, std::mt19937& random, std::string_view letters) {
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int i = 0; i < changes && !bytes.empty(); ++i) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 5) {
            case 0:
                bytes[at] = static_cast<char>(random());
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
                break;
            case 2:
                bytes.erase(at, 1 + random() % 8);
                break;
            case 3:
                bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 32));
                break;
            default:
                bytes[at] = letters[random() % letters.size()];
                break;
        }
    }
    return bytes;
}

}  // namespace lissom::test
