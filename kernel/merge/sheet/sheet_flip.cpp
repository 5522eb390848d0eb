#include "kernel/merge/sheet/sheet_flip.h"

#include <algorithm>
#include <cstddef>

namespace lissom {
namespace {

constexpr int kFlipPasses = 10;
constexpr double kFlipGain = 1e-6;

Index apex_of(const Triangle& t, Index a, Index c) {
    for (const Index v : t) {
        if (v != a && v != c) return v;
    }
    return kNoIndex;
}

// Flips the edges of one sheet that are of use.
class Flipper {
  public:
    Flipper(SheetTriangles& sheet, FlipMemory& memory, const SheetLimits& limits)
        : sheet_(sheet), memory_(memory), limits_(limits), meter_(sheet) {}

    Index pass() {
        Index flips = 0;
        for (Index f = 0; f < count_of(sheet_.triangles); ++f) {
            for (std::size_t k = 0; k < 3 && sheet_.triangles[f][0] != kNoIndex; ++k) {
                if (flip(f, k)) ++flips;
            }
        }
        return flips;
    }

  private:
    // Flips edge `k` of a triangle if that is of use.
    bool flip(Index f, std::size_t k) {
        const Index a = sheet_.triangles[f][k], c = sheet_.triangles[f][(k + 1) % 3];
        const std::uint32_t at_ends = std::max(sheet_.changed[a], sheet_.changed[c]);
        std::uint32_t &useless = memory_.useless[f][k], &refused = memory_.refused[f][k];
        if (useless >= at_ends) return false;
        const std::optional<SheetQuad> quad =
            sheet_.is_feature(a, c) ? std::nullopt : quad_at(sheet_, a, c);
        if (!quad) {
            useless = sheet_.clock;
            return false;
        }
        if (refused >= std::max({at_ends, sheet_.changed[quad->b], sheet_.changed[quad->d]})) {
            return false;
        }
        const bool rounder = is_rounder(*quad);
        if (!rounder || !may_flip(*quad)) {
            (rounder ? refused : useless) = sheet_.clock;
            return false;
        }
        turn_diagonal(sheet_, *quad);
        return true;
    }

    // Whether a flip makes the smallest angle greater.
    bool is_rounder(const SheetQuad& quad) {
        const double least =
            std::min(sheet_.min_angle_of(quad.left), sheet_.min_angle_of(quad.right));
        const double wanted = least * (1.0 + kFlipGain) + kFlipGain;
        return std::all_of(quad.after.begin(), quad.after.end(),
                           [&](const Triangle& t) { return sheet_.min_angle(t) > wanted; });
    }

    // Whether a flip keeps to the limits, and turns no triangle over.
    bool may_flip(const SheetQuad& quad) {
        if (quad.b == quad.d || sheet_.is_joined(quad.b, quad.d)) return false;
        const std::array<Index, 2> faces{quad.left, quad.right};
        const SheetStar now = meter_.of(faces), then = meter_.with(quad.after, faces);
        if (!is_allowed(now, then, limits_, kPi)) return false;
        const Vec3 mean = sheet_.normal[quad.left] + sheet_.normal[quad.right];
        return std::all_of(quad.after.begin(), quad.after.end(),
                           [&](const Triangle& t) { return sheet_.normal_of(t).dot(mean) > 0.0; });
    }

    SheetTriangles& sheet_;
    FlipMemory& memory_;
    SheetLimits limits_;
    StarMeter meter_;
};

}  // namespace

std::optional<SheetQuad> quad_at(const SheetTriangles& sheet, Index a, Index c) {
    SheetQuad quad;
    quad.left = sheet.left_of(a, c);
    quad.right = sheet.left_of(c, a);
    if (quad.left == kNoIndex || quad.right == kNoIndex) return std::nullopt;
    quad.d = apex_of(sheet.triangles[quad.left], a, c);
    quad.b = apex_of(sheet.triangles[quad.right], a, c);
    quad.after = {{{a, quad.b, quad.d}, {quad.b, c, quad.d}}};
    return quad;
}

void turn_diagonal(SheetTriangles& sheet, const SheetQuad& quad) {
    sheet.leave(quad.left);
    sheet.leave(quad.right);
    sheet.enter(quad.left, quad.after[0]);
    sheet.enter(quad.right, quad.after[1]);
}

Index flip_edges(SheetTriangles& sheet, FlipMemory& memory, const SheetLimits& limits,
                 const Context& context) {
    if (!(limits == memory.limits)) {
        memory.refused.clear();
        memory.limits = limits;
    }
    memory.useless.resize(sheet.triangles.size(), {0, 0, 0});
    memory.refused.resize(sheet.triangles.size(), {0, 0, 0});
    Flipper flipper(sheet, memory, limits);
    Index flips = 0;
    for (int pass = 0; pass < kFlipPasses; ++pass) {
        context.checkpoint();
        const Index some = flipper.pass();
        flips += some;
        if (some == 0) break;
    }
    return flips;
}

}  // namespace lissom
