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

TEST_CASE("whatever values are given for, strands keep theirs when they are appended") {
    using enum StrandDomain;
    const auto hair = [](StrandDomain domain, unsigned seed) {
        Strands strands = random_hair(4, seed);
        StrandValues<float> values{0.1f * static_cast<float>(seed), domain};
        const Index count = domain == all ? 0 : domain == strand ? 4 : strands.point_count();
        for (Index i = 0; i < count; ++i) {
            values.values.push_back(0.01f * static_cast<float>(i) +
                                    0.001f * static_cast<float>(seed));
        }
        StrandWidths widths;
        static_cast<StrandValues<float>&>(widths) = values;
        strands.set_widths(widths);
        strands.set_transparency(values);
        return strands;
    };
    const auto check = [](const Strands& part, const Strands& joined, Index from) {
        std::vector<float> x, y;
        for (Index s = 0; s < part.size(); ++s) {
            CHECK(same_points(part.strand(s), joined.strand(from + s)));
            widths_of(part, s, x);
            widths_of(joined, from + s, y);
            CHECK(x == y);
            for (Index k = 0; k < part.point_count(s); ++k) {
                CHECK(part.transparency().at(s, part.first_point(s) + k) ==
                      joined.transparency().at(from + s, joined.first_point(from + s) + k));
            }
        }
    };
    for (const StrandDomain first : {all, strand, point}) {
        for (const StrandDomain second : {all, strand, point}) {
            const Strands a = hair(first, 1), b = hair(second, 2);
            Strands joined = a;
            append(joined, b);
            REQUIRE(joined.size() == 8);
            check(a, joined, 0);
            check(b, joined, 4);
            // To nothing and of nothing.
            Strands none;
            append(none, b);
            check(b, none, 0);
            joined = a;
            append(joined, Strands{});
            check(a, joined, 0);
            CHECK(joined.size() == 4);
        }
    }
}

TEST_CASE("groups of the same name become one, in whatever order they are") {
    Strands a = random_hair(3), b = random_hair(4, 2);
    a.set_groups({0, 1, kNoIndex}, {"left", "right"});
    b.set_groups({2, 0, 1, kNoIndex}, {"tail", "right", "left"});
    append(a, b);
    CHECK(a.group_names() == std::vector<std::string>{"left", "right", "tail"});
    CHECK(a.groups() == std::vector<Index>{0, 1, kNoIndex, 0, 2, 1, kNoIndex});
}

TEST_CASE("only ids that exist already change when strands are appended") {
    Strands a = random_hair(3), b = random_hair(4, 2);
    a.set_ids({5, 9, 2});
    b.set_ids({4, 9, 30, 2});
    append(a, b);
    CHECK(a.ids() == std::vector<std::uint32_t>{5, 9, 2, 4, 31, 30, 32});
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

TEST_CASE("every point goes where the map takes it, and widths keep volumes, mirrored or not") {
    for (const double side : {1.0, -1.0}) {
        Affine map{Mat3::Zero(), Vec3(10, -20, 30)};
        map.linear << 2.0 * side, 0.5, 0.0, 0.0, 4.0, -1.0, 0.0, 0.0, 8.0;
        Strands strands = random_hair(600);
        StrandWidths widths;
        widths.common = 1e-4f;
        strands.set_widths(widths);
        const Strands before = strands;
        transform(strands, map);
        for (Index s = 0; s < strands.size(); ++s) {
            for (Index k = 0; k < strands.point_count(s); ++k) {
                const Vec3 wanted = map(before.strand(s).col(k).cast<double>());
                CHECK((strands.strand(s).col(k).cast<double>() - wanted).norm() < 1e-5);
            }
        }
        CHECK(strands.widths().common == doctest::Approx(4e-4));
    }
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

TEST_CASE("a transform names the strand that would not fit 32-bit numbers, whichever it is") {
    for (const Index far : {0, 4, 9}) {
        CAPTURE(far);
        Strands strands = random_hair(10);
        strands.edit_points()[3 * static_cast<std::size_t>(strands.first_point(far)) + 1] = 1e30f;
        const Error error = error_of([&] {
            transform(strands, {1e20 * Mat3::Identity(), Vec3::Zero()});
        });
        CHECK(error.code() == ErrorCode::not_finite);
        CHECK(error.elements().count == 1);
        CHECK(error.elements().ids == std::vector<Index>{far});
    }
}
