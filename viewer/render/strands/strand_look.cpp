#include "viewer/render/strands/strand_look.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

// A random number of a cell of space, and a random point in it.
std::uint64_t cell_bits(const Eigen::Array3i& cell) {
    return mixed(static_cast<std::uint32_t>(cell.x()), pair_key(cell.y(), cell.z()));
}

Array3f point_in(const Eigen::Array3i& cell, std::uint64_t bits) {
    const auto part = [&](int shift) { return (bits >> shift & 0xffff) / 65536.0f; };
    return cell.cast<float>() + Array3f(part(0), part(16), part(32));
}

// The cell whose random point is nearest to a root (Worley 1996): its clump. Does not depend on
// which other strands there are.
std::uint64_t clump_of(const Vector3f& root, float size) {
    const Array3f at = root.array() / size;
    const Eigen::Array3i middle = at.floor().cast<int>();
    std::uint64_t nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 27; ++i) {
        const Eigen::Array3i cell = middle + Eigen::Array3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        const std::uint64_t bits = cell_bits(cell);
        const float distance = (point_in(cell, bits) - at).matrix().squaredNorm();
        if (distance >= least) continue;
        least = distance;
        nearest = bits;
    }
    return nearest;
}

float tone(double amount, std::uint64_t bits) {
    return static_cast<float>(1.0 + amount * signed_random(bits));
}

// Smoothly from 0 at `low` to 1 at `high`.
float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

}  // namespace

StrandLook look_of(const ViewStrands& drawn, Index strand) {
    const StrandStyle& style = *drawn.style;
    const Vector3f root = drawn.strands->root(strand);
    const std::uint64_t bits = mixed(drawn.strands->id(strand), 0x68616972);
    StrandLook look;
    look.tone = tone(style.strand_tone, bits);
    look.shift = style.shift_jitter * signed_random(mixed(bits));
    const float size = style.clump_size;
    if (root.allFinite() && root.cwiseAbs().maxCoeff() < 1e6f * size) {
        look.tone *= tone(style.clump_tone, mixed(clump_of(root, size)));
    }
    return look;
}

float tone_along(const StrandStyle& style, float t) {
    const float root = static_cast<float>(style.root_tone), tip = style.tip_tone;
    return root + (1.0f - root) * smooth_step(0.0f, 0.25f, t) +
           (tip - 1.0f) * smooth_step(0.25f, 1.0f, t);
}

void cover_widths(const ViewStrands& drawn, Index strand, std::vector<float>& widths) {
    const StrandWidths& given = drawn.strands->widths();
    const Index first = drawn.strands->first_point(strand);
    const float factor = drawn.scale * drawn.stands_for;
    if (given.profile.empty()) {
        widths.resize(drawn.strands->point_count(strand));
        for (std::size_t i = 0; i < widths.size(); ++i) {
            widths[i] = given.at(strand, first + index_of(i));
        }
    } else {
        widths_of(*drawn.strands, strand, widths);
    }
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const float clear = drawn.strands->transparency().at(strand, first + index_of(i));
        widths[i] *= factor * std::clamp(1.0f - clear, 0.0f, 1.0f);
    }
}

}  // namespace lissom
