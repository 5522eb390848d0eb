#include <doctest/doctest.h>

#include "kernel/hair/hairstyle.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_noise.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/strands_item.h"

using namespace lissom;

namespace {

// Upright strands with something of everything.
Strands lawn() {
    std::vector<float> points;
    std::vector<Index> offsets{0};
    for (int s = 0; s < 3000; ++s) {
        for (int k = 0; k < 8; ++k) {
            const float xyz[] = {0.01f * float(s % 50), 0.02f * float(k), 0.01f * float(s / 50)};
            points.insert(points.end(), std::begin(xyz), std::end(xyz));
        }
        offsets.push_back(8 * (s + 1));
    }
    Strands strands(std::move(points), std::move(offsets));
    strands.set_groups(std::vector<Index>(3000, 0), {"all"});
    strands.set_colors({Eigen::Vector3f(0.5f, 0.4f, 0.3f)});
    strands.set_comment("a lawn");
    return strands;
}

Hairstyle parted() {
    const Mesh head = make_head();
    HairstyleOptions options;
    options.resolution = 4000;
    return {head, std::make_shared<const Scalp>(head), options};
}

}  // namespace

TEST_CASE("strands item: edits of every list are undone, points by blocks") {
    Scene scene;
    const auto hair = std::make_shared<Strands>(lawn());
    scene.add("hair", std::make_shared<StrandsItem>(hair));
    const auto change = [&](const auto& work) {
        const std::uint64_t before = scene.hash(), content = hash(*hair);
        scene.step("change", work);
        const std::uint64_t after = scene.hash();
        CHECK(after != before);
        scene.undo();
        CHECK(scene.hash() == before);
        CHECK(hash(*hair) == content);
        scene.redo();
        CHECK(scene.hash() == after);
    };
    change([&] { hair->edit_strand(2)(1, 3) += 0.01f; });
    CHECK(scene.history().steps.back().bytes == SharedBlocks::kBlockBytes);
    change([&] { noise(*hair); });
    change([&] { hair->set_groups({}, {}); });
    change([&] { hair->set_comment(""); });
    change([&] { hair->set_colors({Eigen::Vector3f(1.0f, 0.0f, 0.0f)}); });
    change([&] { hair->set_ids(std::vector<std::uint32_t>(3000, 7)); });
    change([&] {
        StrandWidths widths;
        widths.profile = {1.0f, 0.0f};
        hair->set_widths(widths);
    });
    change([&] { hair->set_transparency({0.5f}); });
    change([&] { *hair = Strands({0, 0, 0}, {0, 1}); });
    for (std::size_t steps = scene.history().place; steps > 0; --steps) scene.undo();
    CHECK(hash(*hair) == hash(lawn()));
}

TEST_CASE("hairstyle item: curves are undone, and grow the same hair again") {
    Scene scene;
    const auto style = std::make_shared<Hairstyle>(parted());
    scene.add("style", std::make_shared<HairstyleItem>(style));
    const std::uint64_t empty = scene.hash();
    const std::vector<Vec3> points{{0.05, 0.12, 0.05}, {0.1, 0.05, 0.0}, {0.11, -0.05, -0.02}};
    CurveId id;
    scene.step("stream", [&] { id = style->add({.shape = StreamCurve{.points = points}}); });
    const HairOptions options{.roots = {.count = 50}};
    const std::uint64_t hair = hash(style->grow(options)), one = scene.hash();
    scene.step("move", [&] { style->set_points(id, {points[0], points[1]}); });
    scene.step("remove", [&] { style->remove(id); });
    CHECK(scene.hash() == empty);

    scene.undo();
    scene.undo();
    CHECK(scene.hash() == one);
    CHECK(hash(style->grow(options)) == hair);
    scene.undo();
    CHECK(style->curves().empty());
    CHECK(scene.hash() == empty);
}

TEST_CASE("hairstyle item: solving and growing are no edits") {
    Scene scene;
    const auto style = std::make_shared<Hairstyle>(parted());
    style->add({.shape = StreamCurve{.points = {{0.05, 0.12, 0.05}, {0.1, 0.05, 0.0}}}});
    scene.add("style", std::make_shared<HairstyleItem>(style));
    style->solve();
    (void)scene.hash();
    CHECK(scene.history().steps.size() == 1);
}

TEST_CASE("polyline item: points are undone") {
    Scene scene;
    const auto line = std::make_shared<Polyline>(Polyline{{Vec3::Zero(), Vec3::UnitX()}});
    scene.add("line", std::make_shared<PolylineItem>(line));
    const std::uint64_t before = scene.hash();
    scene.step("draw", [&] { line->points.push_back(Vec3::UnitY()); });
    scene.step("close", [&] { line->closed = true; });
    scene.undo();
    CHECK(!line->closed);
    scene.undo();
    CHECK(line->points.size() == 2);
    CHECK(scene.hash() == before);
}
