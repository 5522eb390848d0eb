// A word about models in different units.
#include "viewer/window/session/unlike_sizes.h"

#include <doctest/doctest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;
using namespace lissom::window;

namespace {

DrawnMesh box_times(double scale) {
    DrawnMesh drawn{std::make_shared<const Mesh>(make_box())};
    drawn.transform = {scale * Mat3::Identity(), Vec3(7.0, 0.0, 0.0)};
    return drawn;
}

std::string told(const std::vector<DrawnMesh>& meshes) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < meshes.size(); ++i) names.push_back(std::string(1, 'a' + i));
    return unlike_sizes(meshes, names);
}

}  // namespace

TEST_CASE("unlike sizes: told from a hundred times on, in whatever order") {
    CHECK(told({}).empty());
    CHECK(told({box_times(5.0)}).empty());
    CHECK(told({box_times(1.0), box_times(99.0)}).empty());
    CHECK(told({box_times(1000.0), box_times(3.0), box_times(1.0)})
              .starts_with("a is 1000 times as large as c, "));
    CHECK(told({box_times(1.0), box_times(3.0), box_times(123456.0)})
              .starts_with("c is 120000 times as large as a, "));
}

TEST_CASE("unlike sizes: what has no size is no small model") {
    const auto nothing = std::make_shared<const Mesh>();
    Mesh broken = make_box();
    broken.edit_positions()[0].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(told({{nothing}, box_times(1.0), {std::make_shared<const Mesh>(broken)}}).empty());
    Mesh point = make_box();
    for (Vec3& p : point.edit_positions()) p = Vec3(1.0, 2.0, 3.0);
    CHECK(told({{std::make_shared<const Mesh>(point)}, box_times(1.0)}).empty());
}
