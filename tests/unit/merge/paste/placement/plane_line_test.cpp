#include "kernel/merge/paste/placement/plane_line.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/geometry.h"

using namespace lissom;

namespace {

// Every `step`-th corner of a regular polygon, all of them once.
std::vector<Vec2> star(int corners, int step) {
    std::vector<Vec2> line;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * kPi * step * k / corners + 0.1;
        line.emplace_back(std::cos(angle), std::sin(angle));
    }
    return line;
}

// The answer, which does not depend on where a line begins nor on its direction.
bool crosses(std::vector<Vec2> line) {
    const bool first = crosses_itself(line);
    for (std::size_t k = 0; k < line.size(); ++k) {
        std::rotate(line.begin(), line.begin() + 1, line.end());
        CHECK(crosses_itself(line) == first);
        std::reverse(line.begin(), line.end());
        CHECK(crosses_itself(line) == first);
    }
    return first;
}

}  // namespace

TEST_CASE("plane line: polygons do not cross themselves, stars and bow ties do") {
    for (const int corners : {3, 4, 5, 12}) CHECK(!crosses(star(corners, 1)));
    for (const int corners : {5, 7, 11}) CHECK(crosses(star(corners, 2)));
    CHECK(crosses({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
    CHECK(!crosses({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    // Concave, and the same with its notch pushed through the other side.
    CHECK(!crosses({{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}));
    CHECK(crosses({{0, 0}, {4, 0}, {4, 3}, {2, -1}, {0, 3}}));
}
