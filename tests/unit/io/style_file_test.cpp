// Style files: what goes out comes back, and what is wrong is said.
#include "kernel/io/style_file.h"

#include <doctest/doctest.h>

#include <fstream>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/unit/failing_memory.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

StyleContent everything() {
    StyleContent content;
    content.head = "models/head \"1\".obj";
    content.options.resolution = 6000;
    content.options.volume = Box{Vec3(-0.2, -0.4, -0.2), Vec3(0.2, 0.2, 0.2)};
    content.options.field.boundary = GridBoundary::thesis;
    content.options.field.tension = 0.07;
    content.avoids_scalp = true;
    StreamCurve stream{{Vec3(0.1, 0.2, 1.0 / 3.0), Vec3(0, 1e-7, -0.1)}};
    stream.options.stop_length = 0.0;
    stream.clearance = 0.006;
    content.curves.push_back({stream, "fr\xC3\xA4nge", false});
    DividingCurve dividing{{Vec3(0, 0.1, 0.05), Vec3(0, 0.12, 0)}};
    dividing.options.left = {0.3, -0.2};
    dividing.options.sigma = 0.011;
    dividing.gap = 0.004;
    dividing.hints = {{Vec3(0.01, 0.1, 1.0 / 7.0), Vec3(0.02, 0.1, 0.02)},
                      {Vec3(-0.01, 0.1, 0.02), Vec3(-0.02, 0.1, 0), Vec3(-0.03, 0.1, 0)}};
    content.curves.push_back({dividing});
    Ponytail ponytail{{Vec3(0, 0, -0.12), Vec3(0, -0.1, -0.15)}};
    ponytail.options.radius = 0.017;
    ponytail.options.section = {Vec3(0.01, 0, -0.12), Vec3(0, 0.01, -0.12), Vec3(-0.01, 0, -0.12)};
    ponytail.options.profiles[0] = {Vec3(0.02, 0, -0.12), Vec3(0.03, -0.1, -0.15)};
    ponytail.options.profiles[1] = {Vec3(-0.02, 0, -0.12), Vec3(-0.03, -0.1, -0.15)};
    ponytail.options.tightness = 0.9;
    ponytail.tail_length = 0.31;
    content.curves.push_back({ponytail, "pony"});
    return content;
}

ErrorCode refusal(const std::string& text) {
    return error_of([&] { decode_style(text); }).code();
}

std::string refusal_text(const std::string& text) {
    return error_of([&] { decode_style(text); }).message();
}

std::string style_with(const std::string& content) {
    return R"({"format": "lissom hairstyle", "version": 1)" + content + "}";
}

}  // namespace

TEST_CASE("a style that is written and read again is the same to the bit") {
    const StyleContent before = everything(), after = decode_style(encode_style(before));
    CHECK(after.head == before.head);
    CHECK(after.options.resolution == 6000);
    REQUIRE(after.options.volume);
    CHECK(after.options.volume->min == before.options.volume->min);
    CHECK(after.options.field.boundary == GridBoundary::thesis);
    CHECK(after.options.field.tension == 0.07);
    CHECK(after.avoids_scalp);
    REQUIRE(after.curves.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(kind_name(after.curves[i]) == kind_name(before.curves[i]));
        CHECK(after.curves[i].name == before.curves[i].name);
        CHECK(after.curves[i].enabled == before.curves[i].enabled);
        CHECK(drawn_points(after.curves[i]) == drawn_points(before.curves[i]));
    }
    const auto& dividing = std::get<DividingCurve>(after.curves[1].shape);
    CHECK(dividing.options.left.start == doctest::Approx(0.3).epsilon(1e-15));
    CHECK(dividing.options.left.end == doctest::Approx(-0.2).epsilon(1e-15));
    CHECK(dividing.options.sigma == 0.011);
    CHECK_FALSE(dividing.options.height);
    CHECK(dividing.gap == 0.004);
    CHECK(dividing.hints == std::get<DividingCurve>(before.curves[1].shape).hints);
    const auto& ponytail = std::get<Ponytail>(after.curves[2].shape);
    CHECK(ponytail.options.section.size() == 3);
    CHECK(ponytail.options.profiles[1] ==
          std::get<Ponytail>(before.curves[2].shape).options.profiles[1]);
    CHECK(ponytail.options.tightness == 0.9);
    CHECK(ponytail.tail_length == 0.31);
    // And writing that again gives the same text.
    CHECK(encode_style(after) == encode_style(before));
}

TEST_CASE("points of a style stand in a line each") {
    const std::string text = encode_style(everything());
    CHECK(text.find("[0.0, 0.1, 0.05],\n") != std::string::npos);
    CHECK(text.find("\"left\": [") != std::string::npos);
}

TEST_CASE("a style by hand needs no more than its curves") {
    const StyleContent content = decode_style(
        style_with(R"(, "curves": [{"kind": "stream", "points": [[0, 0.1, 0.1], [0, 0.15, 0]]}])"));
    REQUIRE(content.curves.size() == 1);
    CHECK(content.options.resolution == HairstyleOptions{}.resolution);
    CHECK(std::get<StreamCurve>(content.curves[0].shape).options.stop_length ==
          StreamOptions{}.stop_length);
    CHECK(decode_style(style_with("")).curves.empty());
}

TEST_CASE("mistakes in a style are named") {
    CHECK(refusal("") == ErrorCode::file_syntax);
    CHECK(refusal("{") == ErrorCode::file_syntax);
    CHECK(refusal("[]") == ErrorCode::file_syntax);
    CHECK(refusal("{}") == ErrorCode::file_syntax);
    CHECK(refusal(std::string(100000, '[')) == ErrorCode::file_syntax);
    CHECK(refusal(R"({"format": "lissom hairstyle", "version": 2})") == ErrorCode::unsupported);
    CHECK(refusal(R"({"format": "lissom hairstyle", "version": 0})") == ErrorCode::file_syntax);
    CHECK(refusal_text("{\n\"format\": oops}").find("line 2") != std::string::npos);
    CHECK(refusal_text(style_with(R"(, "resolutoin": 5000)")).find("resolutoin") !=
          std::string::npos);
    CHECK(refusal(style_with(R"(, "resolution": 5000.5)")) == ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "curves": {})")) == ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "curves": [3])")) == ErrorCode::file_syntax);
    CHECK(refusal_text(style_with(R"(, "curves": [{"kind": "braid"}])")).find("curve 1") !=
          std::string::npos);
    CHECK(refusal(style_with(R"(, "curves": [{"kind": "stream", "points": [[1, 2]]}])")) ==
          ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "curves": [{"kind": "stream", "points": [[1, 2, "x"]]}])")) ==
          ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "curves": [{"kind": "stream", "tightness": 1}])")) ==
          ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "curves": [{"kind": "dividing", "left": [1]}])")) ==
          ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "volume": {"min": [0, 0, 0], "max": 1})")) ==
          ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "boundary": "mirror")")) == ErrorCode::file_syntax);
}

TEST_CASE("the fidelity of a style is kept, and says what its curves have by default") {
    StyleContent content;
    content.options = style_options_with(HairFidelity::thesis);
    Ponytail tail = curve_with<Ponytail>(HairFidelity::thesis);
    tail.spine = {Vec3(0, 0, -0.12), Vec3(0, -0.1, -0.15)};
    tail.options.grip = 2.0;
    content.curves.push_back({tail});
    content.curves.push_back({StreamCurve{{Vec3(0.1, 0, 0), Vec3(0.1, -0.1, 0)}}});
    const std::string text = encode_style(content);
    const StyleContent again = decode_style(text);
    CHECK(encode_style(again) == text);
    CHECK(again.options.fidelity == HairFidelity::thesis);
    CHECK(again.options.field.tension == 0.0);
    CHECK(again.options.field.boundary == GridBoundary::thesis);
    CHECK(again.curves == content.curves);

    const StyleContent brief = decode_style(style_with(
        R"(, "fidelity": "thesis", "tension": 0.01, "curves": [{"kind": "ponytail", "spread": 1},)"
        R"( {"kind": "dividing"}, {"kind": "stream", "fidelity": "default"}])"));
    CHECK(brief.options.field.tension == 0.01);
    CHECK(brief.options.field.boundary == GridBoundary::thesis);
    Ponytail expected = curve_with<Ponytail>(HairFidelity::thesis);
    expected.options.spread = 1.0;
    CHECK(std::get<Ponytail>(brief.curves[0].shape) == expected);
    CHECK(std::get<DividingCurve>(brief.curves[1].shape) ==
          curve_with<DividingCurve>(HairFidelity::thesis));
    CHECK(std::get<StreamCurve>(brief.curves[2].shape) == StreamCurve{});

    CHECK(encode_style(everything()).find("fidelity") == std::string::npos);
    CHECK(refusal(style_with(R"(, "fidelity": "literal")")) == ErrorCode::file_syntax);
    CHECK(refusal(style_with(R"(, "curves": [{"kind": "stream", "fidelity": 1}])")) ==
          ErrorCode::file_syntax);
}

TEST_CASE("a saved style grows the same hair again") {
    const Mesh head = make_head({.vertices = 3000});
    const auto scalp = std::make_shared<const Scalp>(head);
    HairstyleOptions options;
    options.resolution = 5000;
    Hairstyle style(head, scalp, options);
    const auto over = [&](double azimuth, double elevation, double lift) {
        return scalp->to_metres(scalp->at({azimuth, elevation}, lift).position);
    };
    style.add({StreamCurve{{over(0.4, 0.8, 0.01), over(1.2, 0.2, 0.02)}}, "side"});
    style.add({DividingCurve{{over(0, 0.8, 0), over(0, 1.2, 0)}}});
    const std::filesystem::path path = std::filesystem::temp_directory_path() / "lissom_style.json";
    save_style(content_of(style, "head.obj"), path);
    Hairstyle again = make_style(load_style(path), head, scalp);
    std::filesystem::remove(path);
    HairOptions hair;
    hair.roots.count = 200;
    CHECK(hash(style.grow(hair)) == hash(again.grow(hair)));
    CHECK(again.curve(again.curves()[0]).name == "side");
}

TEST_CASE("a curve of a style that does not fit the head is named") {
    const Mesh head = make_head({.vertices = 3000});
    StyleContent content = decode_style(
        style_with(R"(, "curves": [{"kind": "stream", "points": [[0, 0.1, 0.1], [0, 0.15, 0]]},)"
                   R"( {"kind": "stream", "points": [[9, 9, 9], [9, 9, 8]]}])"));
    content.options.resolution = 3000;
    const Error error =
        error_of([&] { make_style(content, head, std::make_shared<const Scalp>(head)); });
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(error.message().find("curve 2") != std::string::npos);
    CHECK(error_of([] { load_style("no/such/style.json"); }).code() == ErrorCode::file_not_found);
}

// Beyond the copy of the content memory is that of the JSON library, whose destructors allocate.
TEST_CASE("style files: memory that runs out in saving is an error of the kernel") {
    const StyleContent content = everything();
    constexpr long kMany = 1000;
    allocations_left = kMany;
    { const StyleContent copy = content; }
    const long copied = kMany - allocations_left;
    CHECK(copied > 5);
    for (long n = 0; n < copied; ++n) {
        allocations_left = n;
        const ErrorCode code = error_of([&] { encode_style(content); }).code();
        allocations_left = -1;
        CHECK(code == ErrorCode::memory_limit);
    }
}
