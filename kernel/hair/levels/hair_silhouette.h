/// Silhouettes of hair from all sides, by which its levels of detail are measured.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct SilhouetteOptions {
    /// Directions around the vertical, and as many again from 30 degrees above; 1 to 64.
    Index views = 8;
    /// Metres a pixel; the usual is that of a picture of 1080 lines, 3 m away, seen at 40 degrees.
    /// 0.0005 to 0.1; larger for hair of more than 2000 pixels.
    double pixel = 0.002;
};

/// Parts of the silhouette of all hair that only one of the two has, 0 if they are equal.
struct SilhouetteError {
    double mean = 0.0, worst = 0.0;
};

/// Silhouettes of hair, in parallel views: pixels that strands of their widths cover by half.
class HairSilhouette {
  public:
    /// Errors: invalid_argument for options out of range, or hair that covers nothing; not_finite
    /// naming strands; memory_limit; cancelled.
    HairSilhouette(const Strands& hair, const SilhouetteOptions& options = {},
                   const Context& context = {});

    /// Compares with strands, which are drawn `widen` times as wide.
    SilhouetteError compare(const Strands& level, double widen = 1.0,
                            const Context& context = {}) const;
    /// Compares with a surface in metres.
    SilhouetteError compare(const Mesh& level, const Context& context = {}) const;
    /// Compares with cards, on which the strands of their slots are drawn; `strands` are those that
    /// the cards were made of.
    SilhouetteError compare(const HairCards& cards, const Strands& strands,
                            const Context& context = {}) const;

  private:
    /// A direction with a picture as large as the hair.
    struct View {
        Vec3 right, up;
        Eigen::Vector2d origin;
        Eigen::Array2i size;
        std::vector<char> covered;
        std::size_t count = 0;
    };

    Eigen::Vector2d pixel_of(const View& view, const Vec3& point) const;
    std::vector<char> covered_by(const View& view, const Strands& strands, double widen) const;
    std::vector<char> covered_by(const View& view, const Mesh& mesh) const;
    template <typename Cover>
    SilhouetteError compare_views(const Cover& cover, const Context& context) const;

    double pixel_;
    std::vector<View> views_;
};

/// Returns the strands that cards show: on each card those of its slot, flat, as wide as the card
/// makes them. Errors: memory_limit.
Strands shown_by(const HairCards& cards, const Strands& strands, const Context& context = {});

}  // namespace lissom
