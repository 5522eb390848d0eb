#include "kernel/io/hair/rig_file.h"

#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "kernel/core/error.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

// Two guides of three points, with all that a rig can have.
HairRig small_rig() {
    HairRig rig;
    rig.points = 3;
    rig.curves = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f}, {0.0f, 0.2f, 0.0f},
                  {0.1f, 0.0f, 0.0f}, {0.1f, 0.1f, 0.0f}, {0.1f, 0.2f, 0.05f}};
    rig.ids = {7, 90};
    rig.lengths = {0.1f, 0.1f, 0.1f, 0.111803f};
    rig.root_frames = {Eigen::Quaternionf::Identity(), Eigen::Quaternionf(0.5f, 0.5f, 0.5f, 0.5f)};
    rig.ties = {{{"tie \"a\"", {0.1, 0.2, 0.3}, 0.02}, {1, 4}}};
    rig.links = {{2, 5, 0.1118f, true}};
    rig.capsules = {{{0.0, -0.1, 0.0}, {0.0, 0.0, 0.01}, 0.05}};
    rig.capsule_cover = 0.75;
    rig.strand_lengths = {0.2f, 0.21f, 0.0f};
    return rig;
}

TEST_CASE("rig files: all of a rig can be read back") {
    const HairRig rig = small_rig();
    const auto json = nlohmann::json::parse(encode_rig(rig));
    CHECK(json["format"] == "lissom hair rig");
    CHECK(json["version"] == 1);
    CHECK(json["units"] == "metres");
    const auto& guides = json["guides"];
    CHECK(guides["count"] == 2);
    CHECK(guides["points"] == 3);
    CHECK(guides["ids"] == std::vector<int>{7, 90});
    REQUIRE(guides["curves"].size() == 18);
    for (std::size_t i = 0; i < 18; ++i) {
        CHECK(guides["curves"][i].get<double>() ==
              doctest::Approx(rig.curves[i / 3][index_of(i % 3)]));
    }
    REQUIRE(guides["lengths"].size() == 4);
    REQUIRE(guides["root_frames"].size() == 8);
    CHECK(guides["root_frames"][3].get<double>() == 1.0);
    const auto& tie = json["ties"].at(0);
    CHECK(tie["name"] == "tie \"a\"");
    CHECK(tie["points"] == std::vector<int>{1, 4});
    CHECK(tie["center"][2].get<double>() == doctest::Approx(0.3));
    const auto& link = json["links"].at(0);
    CHECK(link["a"] == 2);
    CHECK(link["b"] == 5);
    CHECK(link["bound"] == true);
    CHECK(json["capsules"].at(0)["radius"].get<double>() == doctest::Approx(0.05));
    CHECK(json["capsule_cover"].get<double>() == 0.75);
    CHECK(json["strand_lengths"].size() == 3);
}

TEST_CASE("rig files: numbers that are not finite are refused, texts of any bytes are not") {
    HairRig rig = small_rig();
    rig.ties[0].tie.name = "\xff\x01";
    CHECK(nlohmann::json::accept(encode_rig(rig)));
    rig.curves[2].y() = std::numeric_limits<float>::infinity();
    CHECK(error_of([&] { (void)encode_rig(rig); }).code() == ErrorCode::not_finite);
}

}  // namespace
}  // namespace lissom::test
