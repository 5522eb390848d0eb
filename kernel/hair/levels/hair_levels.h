/// Levels of detail of hair in one call: strands, then cards, then a shell, each measured.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/cards/hair_cards.h"
#include "kernel/hair/levels/hair_shell.h"
#include "kernel/hair/levels/hair_silhouette.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Number of levels of strands, and of levels of cards, at most.
inline constexpr std::size_t kMaxHairLevels = 8;

/// A level of fewer strands. One of `count` and `screen_size` must be set.
struct StrandLevelOptions {
    /// Number of strands, at most those of the hair; 0 for `screen_size`.
    Index count = 0;
    /// Part of a picture's height that the level is for, above 0, at most 1: so large a part of
    /// the strands is kept, as they cover so much of a picture. 0 for `count`.
    double screen_size = 0.0;
    /// Points of each strand, at least 2; 0: they stay.
    Index points = 0;
    /// Factor of widths, above 0; 0: all strands / kept strands, which keeps the thickness.
    double widen = 0.0;
};

struct HairLevelOptions {
    /// Levels in this order, finest first: up to kMaxHairLevels each of strands and of cards.
    std::vector<StrandLevelOptions> strands = {};
    std::vector<CardOptions> cards = {};
    std::optional<ShellOptions> shell = {};
    /// ShellOptions::level grows until the silhouette of the shell is nearest to that of the hair:
    /// the outline of short and of thin hair lies deep within the little hair around it.
    bool fit_shell = true;
    /// Each group has all levels, and so have the strands of no group; groups that cover no pixel
    /// have none, as a warning of the log says. Counts of strands, cards and
    /// triangles are those of all groups together, which get their part by numbers of strands.
    bool by_group = false;
    /// Diameter in metres that stands for full hair in silhouettes and on cards, as strands of few
    /// thousands leave holes at their own; 0 for their own.
    double width = 0.0;
    SilhouetteOptions silhouette = {};
    /// The head, for caps below cards, and for skin in shells where hair is too thin for one; null
    /// for none.
    const Mesh* head = nullptr;
    CardCapOptions cap = {};
};

/// Returns levels of 1, 1/2 and 1/4 of the strands, 200, 100 and 50 cards, and a shell of 2000
/// triangles.
HairLevelOptions usual_hair_levels();

enum class HairLevelKind { strands, cards, shell };

struct HairLevel {
    HairLevelKind kind = HairLevelKind::strands;
    /// The group whose level it is, as a place in group_names(); kNoIndex for none, or all hair.
    Index group = kNoIndex;
    /// Strands in the order of spread_order, so that the first n of them are a level too, with
    /// their widths times `widen`; of cards those that they stand for; of a shell none.
    Strands strands = {};
    double widen = 1.0;
    HairCards cards = {};
    /// Cards or shell, in metres; else empty.
    Mesh mesh = {};
    /// Part of a picture's height up to which the level suffices: the part of strands that it
    /// has; of cards and shells, if the picture has 1080 lines, that at which they are off by a
    /// pixel.
    double screen_size = 1.0;
    SilhouetteError silhouette = {};
};

/// Makes levels of detail, by groups, and measures each against all hair (of its group). Errors:
/// invalid_argument for options out of range, no levels, no strands, more than 1000 groups, if all
/// hair covers no pixel, and as make_cards, add_cap and make_shell; of a group they begin with its
/// name; not_finite naming strands; memory_limit; cancelled.
std::vector<HairLevel> make_hair_levels(const Strands& strands,
                                        const HairLevelOptions& options = usual_hair_levels(),
                                        const Context& context = {});

}  // namespace lissom
