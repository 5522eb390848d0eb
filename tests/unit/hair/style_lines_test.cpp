#include <filesystem>

#include "kernel/hair/hairstyle.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/unit/support.h"

namespace lissom::test {

TEST_CASE("a hairstyle takes a head alone and a curve alone, and its hair is saved in one line") {
    const Mesh head = make_head({.vertices = 3000});
    Hairstyle style(head);
    StreamCurve stream;
    for (const double elevation : {0.9, 0.2}) {
        stream.points.push_back(style.scalp().to_metres(
            style.scalp().at({.azimuth = 1.4, .elevation = elevation}, 0.02).position));
    }
    const CurveId id = style.add(stream);
    CHECK(style.curve(id) == StyleCurve{.shape = stream});
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "style_lines.usda";
    HairOptions few = style.default_hair();
    few.roots.count = 50;
    save_strands(style.grow(few), file);
    CHECK(load_strands(file).size() == 50);
    std::filesystem::remove(file);

    style.add(DividingCurve{
        .points = {
            style.scalp().to_metres(style.scalp().at({.azimuth = 0.0, .elevation = 0.8}).position),
            style.scalp().to_metres(
                style.scalp().at({.azimuth = 0.0, .elevation = 1.4}).position)}});
    CHECK(style.curves().size() == 2);
}

}  // namespace lissom::test
