#include "kernel/hair/levels/spread_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "kernel/core/geometry.h"

namespace lissom {
namespace {

constexpr int kSpreadBits = 21;

// Bits of a coordinate, each three places from the next.
std::uint64_t bits_apart(double coordinate) {
    const auto cell = static_cast<std::uint64_t>(coordinate * ((1 << kSpreadBits) - 1));
    std::uint64_t apart = 0;
    for (int b = 0; b < kSpreadBits; ++b) apart |= (cell >> b & 1) << (3 * b);
    return apart;
}

// Place of a root on a curve through the cells of a box (Morton 1966).
std::uint64_t place_on_curve(const Vec3& root, const Box& box) {
    const Vec3 size = (box.max - box.min).cwiseMax(1e-30);
    const Vec3 unit = (root - box.min).cwiseQuotient(size).cwiseMax(0.0).cwiseMin(1.0);
    return bits_apart(unit.x()) | bits_apart(unit.y()) << 1 | bits_apart(unit.z()) << 2;
}

// The lowest `count` bits in opposite order.
std::uint64_t reversed_bits(std::uint64_t value, int count) {
    std::uint64_t reversed = 0;
    for (int b = 0; b < count; ++b) reversed |= (value >> b & 1) << (count - 1 - b);
    return reversed;
}

Vec3 finite_root(const Strands& strands, Index s) {
    const Vec3 root = strands.root(s).cast<double>();
    return root.allFinite() ? root : Vec3::Zero();
}

}  // namespace

// Each bit more of a place along the sorted roots halves their steps: places with reversed bits, in
// ascending order, are the sequence of van der Corput (1935).
std::vector<Index> spread_order(const Strands& strands) {
    Box box;
    for (Index s = 0; s < strands.size(); ++s) box.extend(finite_root(strands, s));
    std::vector<std::pair<std::uint64_t, Index>> places;
    for (Index s = 0; s < strands.size(); ++s) {
        places.emplace_back(place_on_curve(finite_root(strands, s), box), s);
    }
    std::sort(places.begin(), places.end());
    const int bits = std::bit_width(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i].first = reversed_bits(i, bits);
    std::sort(places.begin(), places.end());
    std::vector<Index> order;
    for (const auto& [place, s] : places) order.push_back(s);
    return order;
}

}  // namespace lissom
