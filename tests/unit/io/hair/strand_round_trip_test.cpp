// Hair files that are read and written again.
#include <utility>

#include "kernel/hair/strands/strand_resample.h"
#include "kernel/io/strand_file.h"
#include "kernel/io/stream/file.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands back(const Strands& strands, const std::string& extension,
             const StrandSaveOptions& save = {}, const StrandLoadOptions& load = {}) {
    return decode_strands(encode_strands(strands, extension, save).bytes, extension, load);
}

void check_same_points(const Strands& a, const Strands& b) {
    REQUIRE(a.size() == b.size());
    CHECK(std::equal(a.points().begin(), a.points().end(), b.points().begin(), b.points().end()));
    CHECK(std::equal(a.offsets().begin(), a.offsets().end(), b.offsets().begin()));
}

void check_near(const Strands& a, const Strands& b, double tolerance) {
    REQUIRE(a.point_count() == b.point_count());
    double most = 0.0;
    for (std::size_t i = 0; i < a.points().size(); ++i) {
        most = std::max(most, std::abs(double(a.points()[i]) - b.points()[i]));
    }
    CHECK(most < tolerance);
}

}  // namespace

TEST_CASE("the .hair sample file round trips to the bit") {
    const auto path = data_file("hair/cyhair_straight.hair");
    if (!path) return;
    const Strands strands = load_strands(*path);
    CHECK(strands.size() == 10000);
    CHECK(strands.point_count(7) == 16);
    CHECK(strands.colors()->domain == StrandDomain::point);
    CHECK(strands.comment().find("Cem Yuksel") != std::string::npos);
    CHECK(strand_statistics(strands).not_finite == 0);
    const EncodedStrands written = encode_strands(strands, "hair");
    CHECK(written.report.empty());
    CHECK(written.bytes == read_bytes(*path));
}

TEST_CASE("the .data sample files round trip to the bit") {
    for (const char* name :
         {"hair/cstrands00001.data", "hair/cstrands00002.data", "hair/cstrands00003.data"}) {
        const auto path = data_file(name);
        if (!path) return;
        const Strands strands = load_strands(*path);
        CHECK(strands.size() == 5);
        CHECK(strands.point_count() == 500);
        const EncodedStrands written = encode_strands(strands, "data");
        CHECK(written.report.empty());
        CHECK(written.bytes == read_bytes(*path));
    }
}

TEST_CASE("the .tfx sample file is read, and written again with equal points") {
    const auto path = data_file("hair/sintel_hair.tfx");
    if (!path) return;
    const Strands strands = load_strands(*path);
    CHECK(strands.size() == 228);
    CHECK(strands.point_count() == 228 * 32);
    CHECK(strand_statistics(strands).not_finite == 0);
    const EncodedStrands written = encode_strands(strands, "tfx");
    const std::string original = read_bytes(*path);
    CHECK(std::equal(original.begin(), original.begin() + 12, written.bytes.begin()));
    // Points, and which of them do not move.
    CHECK(written.bytes.substr(160, 228 * 32 * 16) == original.substr(160, 228 * 32 * 16));
}

TEST_CASE("real hair keeps its points through the other formats") {
    const auto path = data_file("hair/cstrands00001.data");
    if (!path) return;
    const Strands strands = load_strands(*path);
    for (const char* extension : {"hair", "data", "usda", "ply", "glb", "gltf"}) {
        CAPTURE(extension);
        check_same_points(back(strands, extension), strands);
    }
}

TEST_CASE("USDA comes back with an equal hash") {
    Strands strands = rich_hair(40);
    strands.set_groups(std::vector<Index>(strands.groups()), {"a \"b\"", "c\\d\nand e\\"});
    strands.set_comment("grown \"here\",\n\\ and there");
    const EncodedStrands written = encode_strands(strands, "usda");
    CHECK(written.report.empty());
    CHECK(hash(decode_strands(written.bytes, "usda")) == hash(strands));
    StrandValues<float> each{0.0f, StrandDomain::strand, std::vector<float>(40, 0.1f)};
    strands.set_transparency(each);
    strands.set_widths({});
    CHECK(hash(back(strands, "usda")) == hash(strands));
    CHECK(hash(back(random_hair(10), "usda")) == hash(random_hair(10)));
}

TEST_CASE("USDA widths and opacities that another program changed count") {
    Strands strands = strands_of({{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}});
    StrandWidths widths;
    widths.common = 0.25f;
    widths.profile = {1.0f, 0.5f};
    strands.set_widths(widths);
    strands.set_transparency({0.25f});
    std::string text = encode_strands(strands, "usda").bytes;
    const auto replace = [&](const std::string& old, const std::string& with) {
        const std::size_t at = text.find(old);
        REQUIRE(at != text.npos);
        text.replace(at, old.size(), with);
    };
    replace("widths = [0.25, 0.1875, 0.125]", "widths = [0.5, 0.5, 0.5]");
    replace("displayOpacity = [0.75]", "displayOpacity = [0.5]");
    const Strands read = decode_strands(text, "usda");
    CHECK(read.widths().values == std::vector<float>{0.5f, 0.5f, 0.5f});
    CHECK(read.transparency().common == 0.5f);
}

TEST_CASE("widths with a profile become widths of points where the format knows no profile") {
    const Strands strands = rich_hair(20);
    const Strands read = back(strands, "hair");
    CHECK(read.widths().domain == StrandDomain::point);
    std::vector<float> a, b;
    for (Index s = 0; s < strands.size(); ++s) {
        widths_of(strands, s, a);
        widths_of(read, s, b);
        CHECK(a == b);
    }
}

TEST_CASE(".hair keeps common values in its header and uneven strands in an array") {
    Strands strands = random_hair(20);
    strands.set_transparency({0.5f});
    strands.set_colors({Eigen::Vector3f(0.25f, 0.5f, 0.75f)});
    strands.set_comment("made by hand");
    CHECK(hash(back(strands, "hair")) == hash(strands));
    const std::string bytes = encode_strands(strands, "hair").bytes;
    CHECK(bytes.size() == 128 + 2 * 20 + strands.points().size_bytes());
    CHECK(bytes[12] == 3);
}

TEST_CASE("no strands are written and read") {
    for (const std::string& extension : writable_strand_extensions()) {
        CAPTURE(extension);
        CHECK(!encode_strands({}, extension).bytes.empty());
    }
    for (const std::string& extension : readable_strand_extensions()) {
        CAPTURE(extension);
        CHECK(back({}, extension).empty());
    }
}

TEST_CASE(".data keeps strands of one point, which say that there is no hair") {
    const Strands strands = strands_of({{{1, 2, 3}}, {{0, 0, 0}, {0, 1, 0}}});
    const EncodedStrands written = encode_strands(strands, "data");
    CHECK(written.report.empty());
    check_same_points(decode_strands(written.bytes, "data"), strands);
}

TEST_CASE("unit and axes of a file come back, widths with them") {
    const Strands strands = rich_hair(20);
    for (const char* extension : {"hair", "data", "usda", "ply", "glb", "gltf"}) {
        CAPTURE(extension);
        StrandSaveOptions save;
        save.up = UpAxis::z;
        save.unit = 0.01;
        const Strands read = back(strands, extension, save, {UpAxis::z, 0.01});
        check_near(read, strands, 1e-7);
        if (std::string(extension) == "data") continue;
        std::vector<float> a, b;
        widths_of(strands, 3, a);
        widths_of(read, 3, b);
        for (std::size_t k = 0; k < a.size(); ++k) CHECK(b[k] == doctest::Approx(a[k]));
    }
}

TEST_CASE("in a file that is z-up and in centimetres, up is z and lengths are a hundredfold") {
    const Strands strands = strands_of({{{1, 2, 3}, {1, 3, 3}}});
    StrandSaveOptions save;
    save.up = UpAxis::z;
    save.unit = 0.01;
    const Strands raw = back(strands, "data", save);
    CHECK(raw.root(0).isApprox(Eigen::Vector3f(100, -300, 200)));
    CHECK(raw.widths().common == kHairWidth);
    save.unit = 1.0;
    CHECK(hash(back(strands, "data", save, {UpAxis::z, std::nullopt})) == hash(strands));
}

TEST_CASE("USDA says what its unit and axes are") {
    const Strands strands = rich_hair(20);
    StrandSaveOptions save;
    save.up = UpAxis::z;
    save.unit = 0.01;
    check_near(back(strands, "usda", save), strands, 1e-7);
}

TEST_CASE("files are saved whole and loaded by their extension") {
    const TemporaryFolder folder;
    const Strands strands = rich_hair(10);
    for (const std::string& extension : writable_strand_extensions()) {
        CAPTURE(extension);
        const auto path = folder / ("hair." + extension);
        save_strands(strands, path);
        CHECK(read_bytes(path) == encode_strands(strands, extension).bytes);
    }
    check_same_points(load_strands(folder / "hair.hair"), strands);
    CHECK(folder.names().size() == writable_strand_extensions().size());
}

TEST_CASE("what cannot be loaded or saved is told with the path") {
    const TemporaryFolder folder;
    const auto code = [](const auto& action) { return error_of(action).code(); };
    CHECK(code([&] { load_strands(folder / "absent.hair"); }) == ErrorCode::file_not_found);
    write_bytes(folder / "a.hair", "HAIRx");
    const Error error = error_of([&] { load_strands(folder / "a.hair"); });
    CHECK(error.code() == ErrorCode::file_truncated);
    CHECK(error.message().find("a.hair: ") != std::string::npos);
    write_bytes(folder / "a.obj", "v 0 0 0\n");
    CHECK(code([&] { load_strands(folder / "a.obj"); }) == ErrorCode::unknown_format);
    CHECK(code([&] { save_strands({}, folder / "a.abc"); }) == ErrorCode::unknown_format);
    CHECK(code([&] {
              encode_strands({}, "hair", {UpAxis::none, 0.0});
          }) == ErrorCode::invalid_argument);
    CHECK(code([&] {
              decode_strands("HAIR", "hair", {UpAxis::none, -1.0});
          }) == ErrorCode::invalid_argument);
    CHECK(code([&] {
              encode_strands(random_hair(2), "hair", {UpAxis::none, 1e-60});
          }) == ErrorCode::not_finite);
}

TEST_CASE("PLY and glTF come back with an equal hash, but for profiles of widths") {
    Strands strands = rich_hair(40);
    StrandWidths widths = strands.widths();
    widths.profile.clear();
    strands.set_widths(widths);
    StrandGuides guides;
    for (Index s = 0; s < strands.size(); ++s) {
        guides.ids.push_back(s % 5 == 0 ? kNoGuide : 1000);
        guides.arcs.push_back(0.01f * static_cast<float>(s));
    }
    strands.set_guides(guides);
    strands.set_groups(std::vector<Index>(strands.groups()), {"a \"b\"", "back hair"});
    strands.set_comment("grown here,\nand there");
    for (const char* format : {"ply", "glb", "gltf"}) {
        CAPTURE(format);
        const EncodedStrands written = encode_strands(strands, format);
        CHECK(written.report.empty());
        CHECK(hash(decode_strands(written.bytes, format)) == hash(strands));
        const Strands plain = random_hair(10);
        CHECK(hash(back(plain, format)) == hash(plain));
        const Strands profiled = back(rich_hair(20), format);
        std::vector<float> a, b;
        for (Index s = 0; s < 20; ++s) {
            widths_of(rich_hair(20), s, a);
            widths_of(profiled, s, b);
            CHECK(a == b);
        }
    }
}

TEST_CASE("PLY has colours as bytes if they are some, and as floats else") {
    Strands strands = random_hair(3);
    strands.set_colors({Eigen::Vector3f(1.0f, static_cast<float>(51 / 255.0), 0.0f)});
    const std::string bytes = encode_strands(strands, "ply").bytes;
    CHECK(bytes.find("property uchar red") != std::string::npos);
    CHECK(hash(decode_strands(bytes, "ply")) == hash(strands));
    strands.set_colors({Eigen::Vector3f(1.5f, 0.3f, 0.0f)});
    CHECK(encode_strands(strands, "ply").bytes.find("property float red") != std::string::npos);
    CHECK(hash(back(strands, "ply")) == hash(strands));
}

TEST_CASE("TressFX keeps colours, root uvs and widths of strands with the points it knows") {
    Strands strands = resample(rich_hair(12), {.count = 16});
    StrandWidths widths = strands.widths();
    widths.profile.clear();
    strands.set_widths(widths);
    const EncodedStrands written = encode_strands(strands, "tfx");
    const Strands read = decode_strands(written.bytes, "tfx");
    check_same_points(read, strands);
    CHECK(read.widths().values == strands.widths().values);
    CHECK(read.roots().uvs == strands.roots().uvs);
    for (Index p = 0; p < read.point_count(); ++p) {
        CHECK(read.colors()->at(p / 16, p) == strands.colors()->at(p / 16, p));
        CHECK(read.transparency().at(p / 16, p) == 0.25f);
    }
    const std::string& message = written.report.find(StrandFindingKind::content_dropped)->message;
    for (const char* part : {"groups", "root faces", "ids"}) {
        CHECK(message.find(part) != std::string::npos);
    }
    CHECK(message.find("widths") == std::string::npos);
    const EncodedStrands profiled = encode_strands(rich_hair(12), "tfx");
    CHECK(profiled.report.find(StrandFindingKind::content_dropped)
              ->message.find("widths along strands") != std::string::npos);
}

TEST_CASE("TressFX has a power of two of points in each strand, from 4 to 64") {
    for (const auto& pair : {std::pair{2, 4}, {4, 4}, {24, 32}, {64, 64}, {90, 64}}) {
        const int points = pair.first, expected = pair.second;
        CAPTURE(points);
        const Strands strands = resample(random_hair(6), {.count = points});
        const EncodedStrands written = encode_strands(strands, "tfx");
        const Strands read = decode_strands(written.bytes, "tfx");
        CHECK(read.point_count(0) == expected);
        for (Index s = 0; s < 6; ++s) {
            CHECK(read.root(s) == strands.root(s));
            CHECK(read.strand(s).col(expected - 1) == strands.strand(s).col(points - 1));
        }
        const StrandFinding* const found = written.report.find(StrandFindingKind::points_resampled);
        CHECK((found != nullptr) == (points != expected));
        if (found) CHECK(found->elements.count == 6);
    }
    const Error error = error_of([] { encode_strands(random_hair(3), "tfx", {.mend = false}); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.elements().kind == ElementKind::strand);
}
