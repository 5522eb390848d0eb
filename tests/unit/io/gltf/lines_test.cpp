// Hair in glTF: lines of others, and numbers of strands that were changed by hand.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/strand_file.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/gltf/support.h"

namespace lissom::test {
namespace {

Strands lines_of(const GltfFile& file) {
    return decode_strands(file.text(), "gltf");
}

Error error_of_lines(const std::string& text) {
    return error_of([&] { decode_strands(text, "gltf"); });
}

// Four points in a row, and two numbers more for each.
GltfFile four_line_points(int mode, const Json& more = Json::object()) {
    GltfFile file;
    Json primitive{
        {"mode", mode},
        {"attributes", {{"POSITION", file.floats({0, 0, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0}, "VEC3")}}}};
    primitive.update(more);
    file.add_mesh(primitive);
    return file;
}

}  // namespace

TEST_CASE("glTF hair: lines are pairs, strips are one strand, loops are opened") {
    const Strands pairs = lines_of(four_line_points(1));
    REQUIRE(pairs.size() == 2);
    CHECK(pairs.root(1) == Eigen::Vector3f(2, 0, 0));
    CHECK(pairs.widths().common == kHairWidth);
    CHECK(pairs.colors() == nullptr);
    for (const int mode : {2, 3}) {
        const Strands strip = lines_of(four_line_points(mode));
        REQUIRE(strip.size() == 1);
        CHECK(strip.point_count(0) == 4);
        CHECK(point_of(strip.strand(0), 3) == Vec3(2, 1, 0));
    }
}

TEST_CASE("glTF hair: indices in any order make strands, and points without lines are left out") {
    GltfFile file = four_line_points(1);
    file.json["meshes"][0]["primitives"][0]["indices"] = file.indices({3, 2, 2, 1});
    const Strands strands = lines_of(file);
    REQUIRE(strands.size() == 1);
    CHECK(strands.root(0) == Eigen::Vector3f(0, 1, 0));
    CHECK(point_of(strands.strand(0), 2) == Vec3(2, 1, 0));
}

TEST_CASE("glTF hair: transforms of nodes move points and scale widths; nodes are groups") {
    GltfFile file = four_line_points(1);
    file.json["meshes"][0]["primitives"][0]["attributes"]["_WIDTH"] =
        file.floats({1, 2, 3, 4}, "SCALAR");
    file.json["nodes"][0]["name"] = "left";
    file.json["nodes"][0]["scale"] = {2, 2, 2};
    file.json["nodes"].push_back({{"mesh", 0}, {"name", "right"}, {"translation", {10, 0, 0}}});
    const Strands strands = lines_of(file);
    REQUIRE(strands.size() == 4);
    CHECK(strands.root(1) == Eigen::Vector3f(4, 0, 0));
    CHECK(strands.root(3) == Eigen::Vector3f(12, 0, 0));
    CHECK(strands.widths().at(0, 1) == 4.0f);
    CHECK(strands.widths().at(2, 4) == 1.0f);
    CHECK(strands.group_names() == std::vector<std::string>{"left", "right"});
    CHECK(strands.group(1) == 0);
    CHECK(strands.group(2) == 1);
}

TEST_CASE("glTF hair: colours of bytes, their alpha, and surfaces beside lines") {
    GltfFile file = four_line_points(1);
    const std::vector<std::uint8_t> colors{255, 0, 51, 255, 255, 0, 51, 255,
                                           255, 0, 51, 51,  255, 0, 51, 51};
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        file.accessor(colors, kUnsignedByte, "VEC4", {{"normalized", true}});
    file.add_mesh(file.square_primitive());
    const Strands strands = lines_of(file);
    REQUIRE(strands.size() == 2);
    REQUIRE(strands.colors());
    CHECK(strands.colors()->domain == StrandDomain::all);
    CHECK((strands.colors()->common - Eigen::Vector3f(1.0f, 0.0f, 0.2f)).norm() < 1e-6f);
    CHECK(strands.transparency().domain == StrandDomain::strand);
    CHECK(strands.transparency().at(1, 2) == doctest::Approx(0.8));
    CHECK(strands.group_names().empty());
}

TEST_CASE("glTF hair: what is no hair, and numbers that do not fit, are refused") {
    GltfFile surface;
    surface.add_mesh(surface.square_primitive());
    CHECK(error_of_lines(surface.text()).code() == ErrorCode::unsupported);
    GltfFile branch = four_line_points(1);
    branch.json["meshes"][0]["primitives"][0]["indices"] = branch.indices({0, 1, 0, 2, 0, 3});
    CHECK(error_of_lines(branch.text()).code() == ErrorCode::file_syntax);
    GltfFile loose = four_line_points(1);
    loose.json["meshes"][0]["primitives"][0]["attributes"]["_WIDTH"] =
        loose.floats({1, 2}, "SCALAR");
    CHECK(error_of_lines(loose.text()).code() == ErrorCode::file_syntax);
    GltfFile flat = four_line_points(1);
    flat.json["meshes"][0]["primitives"][0]["attributes"]["_ROOT_UV"] =
        flat.floats({1, 2, 3, 4}, "SCALAR");
    CHECK(error_of_lines(flat.text()).code() == ErrorCode::file_syntax);
    GltfFile broken;
    broken.add_mesh({{"mode", 1},
                     {"attributes",
                      {{"POSITION", broken.floats({0, 0, 0, 0, 1, std::nanf(""), 1, 0, 0, 1, 1, 0},
                                                  "VEC3")}}}});
    CHECK(error_of_lines(broken.text()).code() == ErrorCode::not_finite);
}

TEST_CASE("glTF hair: numbers of strands are those of as many strands, or none") {
    const Strands strands = rich_hair(6);
    Json json = Json::parse(encode_strands(strands, "gltf").bytes);
    CHECK(decode_strands(json.dump(), "gltf").group_names() == strands.group_names());
    Json& tables = json["meshes"][0]["extras"]["lissom_strands"];
    const Json before = tables;
    tables["count"] = 5;
    const Strands other = decode_strands(json.dump(), "gltf");
    CHECK(other.size() == 6);
    CHECK(other.groups().empty());
    CHECK(other.roots().faces.empty());
    CHECK(other.roots().uvs == strands.roots().uvs);
    tables = before;
    tables["id"] = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    CHECK(error_of_lines(json.dump()).code() == ErrorCode::file_syntax);
    tables = before;
    tables["group"] = tables["id"];
    CHECK(error_of_lines(json.dump()).code() == ErrorCode::file_syntax);
    tables = before;
    tables["face"] = 1000;
    CHECK(error_of_lines(json.dump()).code() == ErrorCode::file_syntax);
}

}  // namespace lissom::test
