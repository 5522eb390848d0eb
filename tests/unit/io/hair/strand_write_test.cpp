// Formats that are written only.
#include <cstdint>
#include <nlohmann/json.hpp>

#include "kernel/io/strand_file.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands two_strands() {
    return strands_of({{{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}}, {{1, 0, 0}, {1, 0.25, 0}}});
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

template <typename T>
T number_at(const std::string& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
}

}  // namespace

TEST_CASE("OBJ has a vertex a point and a line a strand") {
    Strands strands = two_strands();
    CHECK(
        encode_strands(strands, "obj").bytes ==
        "# 2 strands of hair\nv 0 0 0\nv 0 0.5 0\nv 0 1 0\nv 1 0 0\nv 1 0.25 0\nl 1 2 3\nl 4 5\n");
    strands.set_groups({kNoIndex, 0}, {"fringe"});
    CHECK(holds(encode_strands(strands, "obj").bytes, "l 1 2 3\ng fringe\nl 4 5\n"));
}

TEST_CASE("progress grows from 0 to 1 while strands are saved, and they can be cancelled") {
    const TemporaryFolder folder;
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < 4000; ++s) {
        for (int k = 0; k < 25; ++k) {
            points.insert(points.end(), {0.001f * static_cast<float>(s), 0.01f * k, 0.0f});
        }
        offsets.push_back(offsets.back() + 25);
    }
    const Strands strands(std::move(points), std::move(offsets));
    for (const char* name : {"a.usda", "a.hair", "a.data", "a.rib", "a.glb", "a.obj"}) {
        CAPTURE(name);
        std::vector<double> fractions;
        ContextOptions options;
        options.progress = [&](std::string_view, double fraction) {
            fractions.push_back(fraction);
        };
        save_strands(strands, folder / name, {}, Context(options));
        CHECK(fractions.size() > 4);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
        CHECK(fractions.front() == 0.0);
        CHECK(fractions.back() == doctest::Approx(1.0));
        Context* running = nullptr;
        ContextOptions stopping;
        stopping.progress = [&](std::string_view, double fraction) {
            if (running && fraction > 0.5) running->cancel();
        };
        Context context(stopping);
        running = &context;
        CHECK(error_of([&] { save_strands(strands, folder / "b.usda", {}, context); }).code() ==
              ErrorCode::cancelled);
        CHECK_FALSE(std::filesystem::exists(folder / "b.usda"));
    }
}

TEST_CASE("RIB has linear curves with diameters") {
    Strands strands = two_strands();
    const std::string plain = encode_strands(strands, "rib").bytes;
    CHECK(holds(plain,
                "Curves \"linear\" [ 3 2 ]\n\"nonperiodic\" \"P\" [ 0 0 0 0 0.5 0 0 1 0 1 0 0 1 "
                "0.25 0 ]\n"));
    CHECK(holds(plain, "\"constantwidth\" [ 7.5e-05 ]"));
    StrandWidths widths;
    widths.common = 2.0f;
    widths.profile = {1.0f, 0.5f};
    strands.set_widths(widths);
    strands.set_groups({0, 1}, {"a \"b\"", "c"});
    const std::string grouped = encode_strands(strands, "rib").bytes;
    CHECK(holds(grouped, "\"string name\" [\"a \\\"b\\\"\"]"));
    CHECK(holds(grouped, "\"width\" [ 2 1.5 1 ]"));
    CHECK(holds(grouped, "\"width\" [ 2 1 ]"));
}

TEST_CASE("RIB has colours of strands or points") {
    Strands strands = two_strands();
    strands.set_colors({Eigen::Vector3f(1, 0, 0)});
    CHECK(holds(encode_strands(strands, "rib").bytes, "Color [ 1 0 0 ]"));
    strands.set_colors({Eigen::Vector3f::Zero(), StrandDomain::strand, {{1, 0, 0}, {0, 1, 0}}});
    CHECK(holds(encode_strands(strands, "rib").bytes, "\"uniform color Cs\" [ 1 0 0 0 1 0 ]"));
}

TEST_CASE("glTF has one LINES primitive with 32-bit indices") {
    const auto json = nlohmann::json::parse(encode_strands(two_strands(), "gltf").bytes);
    REQUIRE(json["meshes"].size() == 1);
    REQUIRE(json["meshes"][0]["primitives"].size() == 1);
    const auto& primitive = json["meshes"][0]["primitives"][0];
    CHECK(primitive["mode"] == 1);
    const auto& positions = json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    CHECK(positions["count"] == 5);
    CHECK(positions["min"] == nlohmann::json({0.0, 0.0, 0.0}));
    CHECK(positions["max"] == nlohmann::json({1.0, 1.0, 0.0}));
    const auto& indices = json["accessors"][primitive["indices"].get<int>()];
    CHECK(indices["componentType"] == 5125);
    CHECK(indices["count"] == 6);
}

TEST_CASE("GLB holds the points and the ends of all segments") {
    Strands strands = two_strands();
    strands.set_colors({Eigen::Vector3f(2.0f, 0.5f, 0.0f)});
    const std::string bytes = encode_strands(strands, "glb").bytes;
    const auto json_size = number_at<std::uint32_t>(bytes, 12);
    const auto json = nlohmann::json::parse(bytes.substr(20, json_size));
    const std::string binary = bytes.substr(20 + json_size + 8);
    const auto data_of = [&](int accessor) {
        const auto& view =
            json["bufferViews"][json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"]
                                    .get<std::size_t>()];
        return binary.substr(view["byteOffset"].get<std::size_t>(),
                             view["byteLength"].get<std::size_t>());
    };
    const auto& primitive = json["meshes"][0]["primitives"][0];
    const std::string points = data_of(primitive["attributes"]["POSITION"].get<int>());
    REQUIRE(points.size() == strands.points().size_bytes());
    CHECK(std::memcmp(points.data(), strands.points().data(), points.size()) == 0);
    const std::string lines = data_of(primitive["indices"].get<int>());
    std::vector<std::uint32_t> ends;
    for (std::size_t i = 0; i < lines.size(); i += 4)
        ends.push_back(number_at<std::uint32_t>(lines, i));
    CHECK(ends == std::vector<std::uint32_t>{0, 1, 1, 2, 3, 4});
    const std::string colors = data_of(primitive["attributes"]["COLOR_0"].get<int>());
    CHECK(number_at<float>(colors, 0) == 1.0f);
    CHECK(number_at<float>(colors, 4) == 0.5f);
}
