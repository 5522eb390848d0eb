#include "viewer/render/draw/legend.h"

#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/draw/image/colormap.h"
#include "viewer/render/draw/image/overlay.h"

using namespace lissom;

namespace {

std::vector<std::string> texts(const ValueRange& range) {
    std::vector<std::string> result;
    for (const LegendTick& tick : legend_ticks(range)) result.push_back(tick.text);
    return result;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a legend names both ends and round numbers between them") {
    CHECK(texts({0.0, 1.0}) == Texts{"0.00", "0.2", "0.4", "0.6", "0.8", "1.00"});
    CHECK(texts({-3.0, 17.0}) == Texts{"-3.0", "0", "5", "10", "17.0"});
}

TEST_CASE("very small and very large numbers have an exponent") {
    CHECK(texts({0.0, 2e-7}).back() == "2e-7");
    CHECK(texts({0.0, 3e9}).back() == "3e9");
}

TEST_CASE("ticks climb the scale with room between them") {
    for (const ValueRange range : {ValueRange{0.013, 0.97}, {-1e6, 1e6}, {5.0, 5.001}, {-7, -2}}) {
        const std::vector<LegendTick> ticks = legend_ticks(range);
        CHECK(ticks.front().place == 0.0);
        CHECK(ticks.back().place == 1.0);
        CHECK(ticks.size() >= 3);
        for (std::size_t i = 1; i < ticks.size(); ++i) {
            CHECK(ticks[i].place - ticks[i - 1].place > 0.04);
            CHECK(ticks[i].text != ticks[i - 1].text);
        }
    }
}

TEST_CASE("a range of one value has one number") {
    CHECK(texts({2.0, 2.0}).size() == 1);
    CHECK(texts({0.0, 0.0}).size() == 1);
}

TEST_CASE("a legend of parts shows their colours and as many names as there is room for") {
    Legend legend;
    legend.label = "regions";
    legend.parts = {{"head", {1.0, 0.0, 0.0}}, {"tail", {0.0, 0.0, 1.0}}};
    const auto pixels_of = [&](const Image& image, const Color& color) {
        int count = 0;
        for (int i = 0; i < image.width * image.height; ++i) {
            count += image.color(i % image.width, i / image.width) == color ? 1 : 0;
        }
        return count;
    };
    const auto drawn = [&] {
        Image image(300, 400);
        fill_rectangle(image, 0, 0, 300, 400, kWhite);
        draw_legend(image, legend, {});
        return image;
    };
    const int square = pixels_of(drawn(), {1.0, 0.0, 0.0});
    CHECK(square > 50);
    CHECK(pixels_of(drawn(), {0.0, 0.0, 1.0}) == square);
    const int narrow = legend_width(legend, 400);
    legend.parts.push_back({"a name that is longer than most", {0.0, 1.0, 0.0}});
    CHECK(legend_width(legend, 400) > narrow);
    CHECK(legend_width(legend, 400) < 250);
    for (int i = 0; i < 200; ++i) legend.parts.push_back({"more", {0.0, 1.0, 0.0}});
    const Image full = drawn();
    CHECK(pixels_of(full, {1.0, 0.0, 0.0}) == square);
    const int greens = pixels_of(full, {0.0, 1.0, 0.0}) / square;
    CHECK(greens > 5);
    CHECK(greens < 30);
    for (int x = 0; x < 300; ++x) CHECK(full.color(x, 399) == kWhite);
}

TEST_CASE("a legend shows the scale with its low end at the bottom, inside its strip") {
    const Legend legend{{0.0, 1.0}, "distance"};
    Image image(300, 400);
    fill_rectangle(image, 0, 0, 300, 400, kWhite);
    draw_legend(image, legend, {});
    const int left = 300 - legend_width(legend, 400);
    int first_row = -1, last_row = -1, column = -1;
    for (int y = 0; y < 400; ++y) {
        for (int x = 0; x < 300; ++x) {
            const Color c = image.color(x, y);
            if (c == kWhite) continue;
            CHECK(x >= left);
            if (test::is_gray(c)) continue;
            if (first_row < 0) first_row = y;
            last_row = y;
            column = x;
        }
    }
    REQUIRE(column > 0);
    CHECK(last_row - first_row + 1 == 200);
    CHECK(lightness(image.color(column - 1, first_row)) >
          lightness(image.color(column - 1, last_row)) + 0.5);
}
