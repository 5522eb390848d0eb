#include "kernel/hair/strands/strand_edit.h"

#include <algorithm>
#include <set>

#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Everything about one strand must be the same.
void check_same_strand(const Strands& a, Index i, const Strands& b, Index j) {
    CHECK(same_points(a.strand(i), b.strand(j)));
    CHECK(a.id(i) == b.id(j));
    CHECK(a.group(i) == b.group(j));
    CHECK(a.roots().faces[static_cast<std::size_t>(i)] ==
          b.roots().faces[static_cast<std::size_t>(j)]);
    CHECK(a.roots().uvs[static_cast<std::size_t>(i)] == b.roots().uvs[static_cast<std::size_t>(j)]);
    CHECK(a.colors()->at(i, a.first_point(i)) == b.colors()->at(j, b.first_point(j)));
    std::vector<float> x, y;
    widths_of(a, i, x);
    widths_of(b, j, y);
    CHECK(x == y);
}

}  // namespace

TEST_CASE("selected strands keep all that is known of them") {
    const Strands strands = rich_hair(30);
    const std::vector<Index> list = {7, 3, 29, 3};
    const Strands chosen = select(strands, list);
    REQUIRE(chosen.size() == 4);
    for (Index i = 0; i < 4; ++i) {
        check_same_strand(chosen, i, strands, list[static_cast<std::size_t>(i)]);
    }
}

TEST_CASE("strands are selected by group and by predicate") {
    const Strands strands = rich_hair(30);
    const Strands fringe = select_group(strands, "fringe");
    CHECK(fringe.size() == 10);
    CHECK(fringe.group_names() == strands.group_names());
    const Strands odd = select(strands, [](Index s) { return s % 2 == 1; });
    CHECK(odd.size() == 15);
    CHECK(odd.id(0) == 1001);
    CHECK(error_of([&] { select_group(strands, "beard"); }).code() == ErrorCode::out_of_range);
    const std::vector<Index> bad = {30};
    CHECK(error_of([&] { select(strands, bad); }).code() == ErrorCode::out_of_range);
}

TEST_CASE("a prefix is the first strands") {
    const Strands strands = rich_hair(30);
    const Strands first = prefix(strands, 10);
    REQUIRE(first.size() == 10);
    for (Index s = 0; s < 10; ++s) check_same_strand(first, s, strands, s);
    CHECK(hash(prefix(strands, 100)) == hash(strands));
    CHECK(prefix(strands, 0).empty());
    CHECK(error_of([&] { prefix(strands, -1); }).code() == ErrorCode::out_of_range);
}

TEST_CASE("parts that are appended make the whole again") {
    const Strands strands = rich_hair(30);
    Strands joined = prefix(strands, 12);
    append(joined, select(strands, [](Index s) { return s >= 12; }));
    CHECK(hash(joined) == hash(strands));
}

TEST_CASE("hair of different kinds can be appended") {
    Strands plain = random_hair(5);
    const Strands rich = rich_hair(5, 2);
    append(plain, rich);
    REQUIRE(plain.size() == 10);
    CHECK(plain.group(0) == kNoIndex);
    CHECK(plain.group_names()[static_cast<std::size_t>(plain.group(6))] == "fringe");
    CHECK(plain.colors()->at(0, 0) == Eigen::Vector3f(0, 0, 0));
    std::vector<float> a, b;
    widths_of(plain, 0, a);
    CHECK(std::all_of(a.begin(), a.end(), [](float w) { return w == kHairWidth; }));
    widths_of(plain, 8, a);
    widths_of(rich, 3, b);
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(a[k] == doctest::Approx(b[k]));
}

TEST_CASE("ids stay different when strands are appended") {
    Strands strands = random_hair(5);
    append(strands, random_hair(5, 2));
    append(strands, Strands(strands));
    std::set<std::uint32_t> ids;
    for (Index s = 0; s < strands.size(); ++s) ids.insert(strands.id(s));
    CHECK(ids.size() == 20);
}

TEST_CASE("a transform moves points and scales widths") {
    Strands strands = rich_hair(10);
    const Strands before = strands;
    transform(strands, scaling(Vec3::Constant(2), Vec3::Zero()));
    CHECK(strands.points()[5] == 2 * before.points()[5]);
    CHECK(strands.widths().values[3] == doctest::Approx(2 * before.widths().values[3]));
    transform(strands, rotation(Vec3::UnitX(), 1.0, Vec3(1, 2, 3)));
    CHECK(strand_statistics(strands).mean_length ==
          doctest::Approx(2 * strand_statistics(before).mean_length));
}

TEST_CASE("a transform that cannot be is refused and changes nothing") {
    Strands strands = random_hair(10);
    const std::uint64_t before = hash(strands);
    const auto code = [&](const Affine& map) {
        return error_of([&] { transform(strands, map); }).code();
    };
    CHECK(code({Mat3::Zero(), Vec3::Zero()}) == ErrorCode::singular_transform);
    CHECK(code({Mat3::Identity(), Vec3(0, std::nan(""), 0)}) == ErrorCode::singular_transform);
    CHECK(code({1e60 * Mat3::Identity(), Vec3::Zero()}) == ErrorCode::not_finite);
    CHECK(hash(strands) == before);
}
