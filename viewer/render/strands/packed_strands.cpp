#include "viewer/render/strands/packed_strands.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "viewer/render/strands/strand_look.h"

namespace lissom {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

// Steps of a root's place along each axis, as bits.
constexpr int kCurveBits = 10;
// Number of ribbons that hide each other, seen from one side, in opaque hair.
constexpr double kOpaqueLayers = 6.0;
// Few strands may be so many times wider in any case.
constexpr double kFreelyWidened = 4.0;
// Part of the points that is left out at each end of an axis when the size of hair is judged.
constexpr double kStray = 0.02;

// Bits of three numbers, one of each in turn (Morton 1966).
std::uint32_t interleaved(const Eigen::Array3i& cell) {
    std::uint32_t code = 0;
    for (int bit = 0; bit < kCurveBits; ++bit) {
        for (int axis = 0; axis < 3; ++axis) {
            code |= (static_cast<std::uint32_t>(cell[axis]) >> bit & 1U) << (3 * bit + axis);
        }
    }
    return code;
}

struct RootBox {
    Vector3f low = Vector3f::Constant(std::numeric_limits<float>::infinity());
    Vector3f high = -low;
};

RootBox root_box(const Strands& strands, Index count) {
    RootBox box;
    for (Index s = 0; s < count; ++s) {
        const Vector3f root = strands.root(s);
        if (!root.allFinite()) continue;
        box.low = box.low.cwiseMin(root);
        box.high = box.high.cwiseMax(root);
    }
    return box;
}

// Returns the position of each strand's root along the curve. Roots that are not finite come last.
std::vector<std::uint32_t> root_codes(const Strands& strands, Index count) {
    const RootBox box = root_box(strands, count);
    const float extent = std::max((box.high - box.low).maxCoeff(), 1e-30f);
    const float steps = (1 << kCurveBits) - 1;
    std::vector<std::uint32_t> codes;
    codes.reserve(at(count));
    for (Index s = 0; s < count; ++s) {
        const Vector3f root = strands.root(s);
        const Array3f place = (root - box.low).array() * (steps / extent);
        codes.push_back(root.allFinite() ? interleaved(place.cast<int>()) : 0xffffffffU);
    }
    return codes;
}

std::uint32_t reversed(std::uint32_t x, int bits) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < bits; ++bit) result |= (x >> bit & 1U) << (bits - 1 - bit);
    return result;
}

std::uint8_t root_byte(float share) {
    return static_cast<std::uint8_t>(
        std::lround(255.0f * std::sqrt(std::clamp(share, 0.0f, 1.0f))));
}

class Packer {
  public:
    // `given` must outlive it.
    Packer(const ViewStrands& given, float widest) : given_(given), widest_(widest) {}

    // The next strand; of at most so many points.
    void add(PackedRibbons& ribbons, Index strand, Index max_points) {
        cover_widths(given_, strand, widths_);
        const StrandLook look = look_of(given_, strand);
        const auto jitter = static_cast<float>(given_.style->shift_jitter);
        const float lean = jitter > 0.0f ? look.shift / jitter : 0.0f;
        const auto shift = static_cast<std::uint8_t>(std::lround(127.5f * (1.0f + lean)));
        const auto last = count_of(widths_) - 1;
        const Index count = std::min(max_points, last + 1);
        bool open = false;
        for (Index i = 0; i < count && count > 1; ++i) {
            const Index place = static_cast<Index>(static_cast<long long>(i) * last / (count - 1));
            const bool finite = position(strand, place).allFinite();
            if (open && !finite) end(ribbons);
            if (finite) put(ribbons, strand, place, look.tone, !open);
            open = finite;
        }
        if (open) end(ribbons);
        ribbons.shifts.resize(ribbons.points.size(), shift);
        ribbons.offsets.push_back(count_of(ribbons.points));
    }

  private:
    Vector3f position(Index strand, Index place) const {
        return given_.strands->strand(strand).col(place);
    }

    void put(PackedRibbons& ribbons, Index strand, Index place, float tone, bool begins) {
        const Index point = given_.strands->first_point(strand) + place;
        const float t = static_cast<float>(place) / (count_of(widths_) - 1);
        const Array3f color =
            strand_color(given_, strand, point) * (tone * tone_along(*given_.style, t));
        const Vector3f p = position(strand, place);
        PackedPoint packed{{p.x(), p.y(), p.z()}, {}};
        for (std::size_t i = 0; i < 3; ++i) {
            packed.look[i] = root_byte(color[index_of(i)] / kBrightest);
        }
        if (begins) ribbons.points.push_back(packed);
        packed.look[3] = root_byte(widths_[at(place)] / widest_);
        ribbons.points.push_back(packed);
    }

    static void end(PackedRibbons& ribbons) {
        ribbons.points.push_back(ribbons.points.back());
        ribbons.points.back().look[3] = 0;
    }

    const ViewStrands& given_;
    float widest_;
    std::vector<float> widths_;
};

// The widest point, and the area of all ribbons.
void measure(const ViewStrands& given, PackedStrands& packed) {
    std::vector<float> widths;
    for (Index s = 0; s < given.count; ++s) {
        cover_widths(given, s, widths);
        const StrandView strand = given.strands->strand(s);
        for (Eigen::Index i = 0; i < strand.cols(); ++i) {
            const float width = widths[static_cast<std::size_t>(i)];
            if (std::isfinite(width)) packed.widest = std::max(packed.widest, width);
            if (i == 0) continue;
            const double area = 1.0 * width * (strand.col(i) - strand.col(i - 1)).norm();
            if (std::isfinite(area)) packed.ribbon_area += area;
        }
    }
}

// Returns the mean of a box's sides, without outliers.
double outer_area(const PackedRibbons& few) {
    Eigen::Array3d extent = Eigen::Array3d::Zero();
    std::vector<float> places;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        places.clear();
        for (const PackedPoint& point : few.points) places.push_back(point.position[axis]);
        if (places.empty()) return 0.0;
        std::sort(places.begin(), places.end());
        const auto stray = static_cast<std::size_t>(kStray * static_cast<double>(places.size()));
        extent[index_of(axis)] = places[places.size() - 1 - stray] - places[stray];
    }
    return (extent.x() * extent.y() + extent.y() * extent.z() + extent.z() * extent.x()) / 3.0;
}

}  // namespace

std::vector<Index> even_order(const Strands& strands, Index count) {
    const std::vector<std::uint32_t> codes = root_codes(strands, count);
    std::vector<Index> along(at(count));
    std::iota(along.begin(), along.end(), Index{0});
    std::stable_sort(along.begin(), along.end(),
                     [&](Index a, Index b) { return codes[at(a)] < codes[at(b)]; });
    const int bits = std::bit_width(static_cast<std::uint32_t>(std::max(count, Index{1}) - 1));
    std::vector<Index> order;
    order.reserve(at(count));
    for (std::uint32_t i = 0; i < (1U << bits); ++i) {
        const std::uint32_t place = reversed(i, bits);
        if (place < static_cast<std::uint32_t>(count)) order.push_back(along[place]);
    }
    return order;
}

PackedStrands pack_strands(const DrawnStrands& drawn, bool few_only, const Context& context) {
    Snapshot snapshot;
    snapshot.strands = {drawn};
    ViewStrands given = view_strands(snapshot, Mat4::Identity(), Vec3::Zero()).front();
    // Widths in metres.
    given.scale = 1.0f;
    PackedStrands packed;
    measure(given, packed);
    if (!(packed.widest > 0.0f)) return packed;
    const std::vector<Index> order = even_order(*drawn.strands, given.count);
    Packer packer(given, packed.widest);
    const Index few = std::min(kFewStrands, given.count);
    for (Index i = 0; i < few; ++i) packer.add(packed.few, order[at(i)], kFewPoints);
    packed.outer_area = outer_area(packed.few);
    if (few_only) return packed;
    const auto points = static_cast<std::size_t>(given.point_count() + 2 * given.count);
    packed.all.points.reserve(points);
    packed.all.shifts.reserve(points);
    for (const Index s : order) {
        if (packed.all.size() % 1024 == 0) context.checkpoint();
        packer.add(packed.all, s, drawn.strands->point_count(s));
    }
    return packed;
}

double widening(const PackedStrands& packed, Index count, Index all) {
    if (count <= 0 || count >= all) return 1.0;
    const double fewer = 1.0 * all / count;
    const double layers = packed.outer_area > 0.0 ? packed.ribbon_area / packed.outer_area : 0.0;
    const double opaque = fewer * kOpaqueLayers / std::max(layers, 1e-9);
    return std::min(fewer, std::max(opaque, kFreelyWidened));
}

}  // namespace lissom
