// The header that rebuilds hair from guides does as the kernel does.
#include <doctest/doctest.h>

#include <Eigen/LU>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "bindings/engine/lissom_hair.h"
#include "kernel/hair/guides/guide_set.h"
#include "kernel/io/hair/guide_file.h"
#include "tests/unit/engine/header_in_c.h"

using namespace lissom;

namespace {

Strands bowed_hair(Index count) {
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < count; ++s) {
        const double x = std::fmod(0.618034 * s, 1.0), z = std::fmod(0.754878 * s, 1.0);
        const int n = 5 + s % 7;
        for (int k = 0; k < n; ++k) {
            const double a = 0.1 * k / (n - 1);
            const Vec3 p(0.1 * x + a * std::sin(9.0 * z), 1.6 - 3.0 * a * a, 0.1 * z + a * x);
            for (const double c : p) points.push_back(static_cast<float>(c));
        }
        offsets.push_back(offsets.back() + n);
    }
    return {std::move(points), std::move(offsets)};
}

// A file in memory at a multiple of 4 bytes.
std::vector<std::uint32_t> words_of(const std::string& bytes) {
    std::vector<std::uint32_t> words((bytes.size() + 3) / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

struct Opened {
    std::vector<std::uint32_t> memory;
    lissom_hair hair{};
};

Opened opened(const GuideSet& set, bool details) {
    const std::string bytes = encode_guides(set, {.details = details});
    Opened result{words_of(bytes), {}};
    REQUIRE(lissom_hair_open(&result.hair, result.memory.data(), bytes.size()) == LISSOM_HAIR_OK);
    return result;
}

std::vector<Eigen::Vector3f> bent_guides(const GuideSet& set) {
    std::vector<Eigen::Vector3f> moved = set.curves;
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const auto k = static_cast<float>(i % at(set.points));
        moved[i] += Eigen::Vector3f(0.01f * k, 0.02f, -0.002f * k * k);
    }
    return moved;
}

std::vector<float> numbers_of(const std::vector<Eigen::Vector3f>& points) {
    std::vector<float> numbers;
    for (const Eigen::Vector3f& p : points) numbers.insert(numbers.end(), p.begin(), p.end());
    return numbers;
}

std::vector<float> rebuilt(const lissom_hair& hair, const float* guides, const float* turns) {
    std::vector<float> out(3 * std::size_t{hair.strand_count} * hair.point_count);
    // In two ranges, the second beyond the end.
    const std::uint32_t half = hair.strand_count / 2;
    lissom_hair_rebuild(&hair, guides, turns, 0, half, out.data());
    lissom_hair_rebuild(&hair, guides, turns, half, hair.strand_count,
                        out.data() + 3 * std::size_t{half} * hair.point_count);
    return out;
}

double furthest(const std::vector<float>& a, const std::vector<float>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(double{a[i]} - b[i]));
    return most;
}

}  // namespace

TEST_CASE("hair header: rebuilds what the kernel rebuilds, at rest and moved") {
    const GuideSet set = make_guide_set(bowed_hair(203), {.count = 9});
    for (const bool details : {false, true}) {
        const Opened file = opened(set, details);
        CHECK(file.hair.strand_count == 203);
        CHECK(file.hair.guide_count == 9);
        const auto rest = numbers_of(rebuild_strands(set, {.details = details}));
        CHECK(furthest(rebuilt(file.hair, nullptr, nullptr), rest) < 2e-6);
        const std::vector<Eigen::Vector3f> moved = bent_guides(set);
        const std::vector<float> guides = numbers_of(moved);
        const auto expected =
            numbers_of(rebuild_strands(set, {.curves = moved, .details = details}));
        std::vector<float> turns(9 * set.curves.size());
        lissom_hair_turns(&file.hair, guides.data(), turns.data());
        CHECK(furthest(rebuilt(file.hair, guides.data(), turns.data()), expected) < 2e-6);
    }
}

TEST_CASE("hair header: details turn with guides that turn about a line across them") {
    const GuideSet set = make_guide_set(bowed_hair(120), {.count = 5});
    const Opened file = opened(set, true);
    std::vector<float> turns(9 * set.curves.size());
    lissom_hair_turns(&file.hair, file.hair.guides, turns.data());
    for (std::size_t i = 0; i < turns.size(); ++i) {
        CHECK(turns[i] == doctest::Approx(i % 9 % 4 == 0 ? 1.0f : 0.0f).epsilon(1e-5));
    }
    // A quarter turn of everything about x: rotations of tangents are orthogonal and map them.
    std::vector<float> guides = numbers_of(set.curves);
    for (std::size_t i = 0; i < guides.size(); i += 3) {
        const float y = guides[i + 1];
        guides[i + 1] = -guides[i + 2];
        guides[i + 2] = y;
    }
    lissom_hair_turns(&file.hair, guides.data(), turns.data());
    for (std::size_t i = 0; i < turns.size(); i += 9) {
        const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> turn(turns.data() + i);
        CHECK((turn * turn.transpose() - Eigen::Matrix3f::Identity()).norm() < 1e-4f);
        CHECK(turn.determinant() == doctest::Approx(1.0f).epsilon(1e-4));
    }
}

TEST_CASE("hair header: C99 builds the same") {
    const GuideSet set = make_guide_set(bowed_hair(60), {.count = 4});
    const std::string bytes = encode_guides(set);
    const auto memory = words_of(bytes);
    std::vector<float> out(3 * 60 * at(set.points));
    CHECK(rebuild_in_c(memory.data(), bytes.size(), 60, out.data()) == 0);
    CHECK(furthest(out, numbers_of(rebuild_strands(set))) < 2e-6);
}

TEST_CASE("hair header: files cut off anywhere, and damaged ones, do not open or stay in bounds") {
    const GuideSet set = make_guide_set(bowed_hair(20), {.count = 3, .points = 4});
    const std::string bytes = encode_guides(set);
    const auto memory = words_of(bytes);
    lissom_hair hair;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        CHECK(lissom_hair_open(&hair, memory.data(), size) == LISSOM_HAIR_TRUNCATED);
    }
    std::vector<float> out(3 * 20 * 256), turns(9 * 3 * 256);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (const int flip : {0x01, 0x80, 0xff}) {
            std::string changed = bytes;
            changed[i] = static_cast<char>(changed[i] ^ flip);
            const auto words = words_of(changed);
            if (lissom_hair_open(&hair, words.data(), changed.size()) != LISSOM_HAIR_OK) continue;
            REQUIRE(hair.strand_count == 20);
            REQUIRE(hair.point_count == 4);
            lissom_hair_turns(&hair, hair.guides, turns.data());
            lissom_hair_rebuild(&hair, nullptr, turns.data(), 0, 20, out.data());
        }
    }
    std::string other = bytes;
    other[0] = 'X';
    CHECK(lissom_hair_open(&hair, words_of(other).data(), bytes.size()) == LISSOM_HAIR_NOT_HAIR);
    other = bytes;
    other[8] = 9;
    CHECK(lissom_hair_open(&hair, words_of(other).data(), bytes.size()) ==
          LISSOM_HAIR_UNKNOWN_VERSION);
    const char* const odd = reinterpret_cast<const char*>(memory.data()) + 1;
    CHECK(lissom_hair_open(&hair, odd, bytes.size() - 1) == LISSOM_HAIR_NOT_ALIGNED);
}
