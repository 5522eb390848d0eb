// What is checked before strands are written.
#include "kernel/io/strand_file.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

const double kNotANumber = std::nan("");

Strands damaged() {
    return strands_of({{{0, 0, 0}, {0, 1, 0}},
                       {{0, 0, 0}, {0, kNotANumber, 0}},
                       {{1, 0, 0}},
                       {{2, 0, 0}, {2, 0, 0}},
                       {{3, 0, 0}, {3, 1, 0}, {3, 1, 0}, {3, 2, 0}}});
}

const StrandFinding& finding(const StrandReport& report, StrandFindingKind kind) {
    const StrandFinding* const found = report.find(kind);
    REQUIRE(found);
    return *found;
}

}  // namespace

TEST_CASE("damaged strands are left out, and named by their numbers") {
    const EncodedStrands written = encode_strands(damaged(), "hair");
    const StrandReport& report = written.report;
    CHECK(finding(report, StrandFindingKind::strands_not_finite).elements.ids ==
          std::vector<Index>{1});
    CHECK(finding(report, StrandFindingKind::strands_too_short).elements.ids ==
          std::vector<Index>{2, 3});
    CHECK(finding(report, StrandFindingKind::points_repeated).elements.ids ==
          std::vector<Index>{4});
    const Strands read = decode_strands(written.bytes, "hair");
    CHECK(read.size() == 2);
    CHECK(read.point_count(1) == 3);
    CHECK(strand_statistics(read).zero_segments == 0);
}

TEST_CASE("without mending, what would be changed is an error that names the strands") {
    const Error error = error_of([] { encode_strands(damaged(), "hair", {.mend = false}); });
    CHECK(error.code() == ErrorCode::not_finite);
    CHECK(error.elements().kind == ElementKind::strand);
    CHECK(error.elements().ids == std::vector<Index>{1});
    const Strands brief = strands_of({{{0, 0, 0}, {0, 1, 0}}, {{1, 0, 0}}});
    CHECK(error_of([&] { encode_strands(brief, "usda", {.mend = false}); }).elements().ids ==
          std::vector<Index>{1});
    CHECK(encode_strands(brief, "data", {.mend = false}).report.empty());
}

TEST_CASE("widths that are not positive are replaced where the format has widths") {
    Strands strands = random_hair(4);
    StrandWidths widths;
    widths.domain = StrandDomain::strand;
    widths.values = {1e-4f, 0.0f, std::nanf(""), 5e-5f};
    strands.set_widths(widths);
    const EncodedStrands written = encode_strands(strands, "usda");
    CHECK(finding(written.report, StrandFindingKind::widths_not_positive).elements.ids ==
          std::vector<Index>{1, 2});
    CHECK(decode_strands(written.bytes, "usda").widths().values ==
          std::vector<float>{1e-4f, 5e-5f, 5e-5f, 5e-5f});
    CHECK(!encode_strands(strands, "data").report.find(StrandFindingKind::widths_not_positive));
}

TEST_CASE("groups get names of their own") {
    Strands strands = random_hair(4);
    strands.set_groups({0, 1, 2, 3}, {"", "a", "a", "group 1"});
    const EncodedStrands written = encode_strands(strands, "usda");
    CHECK(written.report.find(StrandFindingKind::groups_unnamed));
    const std::vector<std::string> names = decode_strands(written.bytes, "usda").group_names();
    CHECK(names == std::vector<std::string>{"group 1'", "a", "group 3", "group 1"});
}

TEST_CASE("a root uv that is the same for all is told") {
    Strands strands = random_hair(3);
    strands.set_roots({{}, {}, std::vector<Eigen::Vector2f>(3, Eigen::Vector2f::Zero())});
    CHECK(encode_strands(strands, "usda").report.find(StrandFindingKind::root_uv_constant));
    CHECK(encode_strands(rich_hair(3), "usda").report.find(StrandFindingKind::root_uv_constant) ==
          nullptr);
}

TEST_CASE("strands with the root last are told where the head is known") {
    const Strands strands = strands_of({{{0, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, 0}}});
    StrandSaveOptions options;
    options.distance = [](const Vec3& p) { return p.y(); };
    const StrandReport report = encode_strands(strands, "hair", options).report;
    CHECK(finding(report, StrandFindingKind::roots_last).elements.ids == std::vector<Index>{1});
    CHECK(encode_strands(strands, "hair").report.empty());
}

TEST_CASE("what a format cannot hold is named in the report and the log") {
    const LoggedContext logged;
    const Strands strands = rich_hair(5);
    const StrandReport report = encode_strands(strands, "obj", {}, logged.context).report;
    const std::string& message = finding(report, StrandFindingKind::content_dropped).message;
    for (const char* part :
         {"widths", "colours", "transparency", "root uvs", "root faces", "ids"}) {
        CAPTURE(part);
        CHECK(message.find(part) != std::string::npos);
    }
    CHECK(message.find("groups") == std::string::npos);
    CHECK(logged.mentions("root uvs"));
    CHECK(encode_strands(random_hair(5), "obj").report.empty());
}

TEST_CASE("saving leaves the strands as they are") {
    const Strands strands = damaged();
    const std::uint64_t before = hash(strands);
    for (const std::string& extension : writable_strand_extensions()) {
        encode_strands(strands, extension, {.up = UpAxis::z, .unit = 0.5});
    }
    CHECK(hash(strands) == before);
}

TEST_CASE("strands of more segments than .hair can count are refused by name") {
    std::vector<Vec3> points;
    for (int k = 0; k < 65537; ++k) points.emplace_back(0, k, 0);
    const Strands strands = strands_of({{{0, 0, 0}, {0, 1, 0}}, points});
    const Error error = error_of([&] { encode_strands(strands, "hair"); });
    CHECK(error.code() == ErrorCode::file_too_large);
    CHECK(error.elements().ids == std::vector<Index>{1});
    points.pop_back();
    CHECK(
        decode_strands(encode_strands(strands_of({points}), "hair").bytes, "hair").point_count() ==
        65536);
}
