/// Cards: hair as strips of triangles with a picture of strands on each, as games draw it.
#pragma once

#include <functional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct CardOptions {
    /// Number of cards, 1 to kMaxCards; fewer for hair of fewer strands, and where some are stray.
    Index count = 200;
    /// Triangles of all cards, from which their sections follow; 0 for `sections`. Two to 126
    /// for each card.
    Index triangles = 0;
    /// Points along each card, 2 to 64.
    Index sections = 16;
    /// Clusters that are about as thick as wide, such as ringlets and tails, have two cards that
    /// cross, and there are fewer clusters.
    bool crossed = true;
    /// Pictures that cards share, 1 to 256; at most as many as there are cards.
    Index slots = 64;
    /// Part of the points of a card's strands that lie on it; above 0, at most 1.
    double coverage = 0.97;
    /// Normals are those of the card at 0, and those of the head's surface below it at 1.
    double bend = 0.7;
    /// Metres between cards and head, at least.
    double clearance = 0.002;
    /// Signed distance in metres to the head, negative inside; empty: cards may go through it, and
    /// normals point away from the middle of the roots. Called on several threads.
    std::function<double(const Vec3&)> distance = {};
};

inline constexpr Index kMaxCards = 100'000;

/// A place along a card.
struct CardSection {
    Vec3 center = Vec3::Zero();
    /// Unit vectors: across the card, towards u = 1, and out of its front. They are perpendicular.
    Vec3 across = Vec3::UnitX(), out = Vec3::UnitZ();
    /// Metres from the centre to each edge.
    double half_width = 0.0;
};

/// A strip for the strands of a cluster.
struct Card {
    /// Root first, at equal steps; v is 0 at the first and 1 at the last.
    std::vector<CardSection> sections;
    /// The strands that it stands for, and the one nearest to their mean.
    std::vector<Index> strands;
    Index medoid = kNoIndex;
    /// The card of the same strands that it crosses; kNoIndex for none.
    Index crosses = kNoIndex;
    /// The picture that it shows.
    Index slot = 0;

    double length() const;
};

/// A picture: the strands of one card, drawn on it, which stand for those of other cards too.
struct CardSlot {
    Index card = kNoIndex;
    /// Place in the atlas: (0, 0) is the lower left and (1, 1) the upper right corner. Roots are
    /// at the top.
    Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Ones();
    /// Nothing shows between its strands: the slot of the cap.
    bool is_solid = false;
};

/// The skin of the head below hair; it shows the colour of hair at the roots of cards.
struct CardCap {
    std::vector<Vec3> positions, normals;
    std::vector<Triangle> triangles;
    /// Density of roots as a part of the usual: 1 inside, a half at the edge of the hair, where the
    /// cap ends for the eye, and 0 at its border.
    std::vector<double> cover;
    /// Across and down its slot, 0 to 1.
    std::vector<Eigen::Vector2d> places;
};

struct HairCards {
    std::vector<Card> cards;
    /// The last is that of the cap, if there is one.
    std::vector<CardSlot> slots;
    CardCap cap;
    /// Part of the points of strands that lie on their cards, and the root of their mean square
    /// distance from their plane in metres.
    double covered = 0.0, rms = 0.0;
};

/// A point of a strand as it lies on a card.
struct CardPoint {
    /// Across from -1 to 1 and along from 0 to 1 on the card; outside for points beside it.
    double u = 0.0, v = 0.0;
    /// Metres out of its front.
    double out = 0.0;
};

/// Returns the place on a card nearest to a point.
CardPoint place_on_card(const Card& card, const Vec3& point);

/// Makes cards. Strands are clustered by cluster_strands: each guide that strands follow has cards
/// of its own if there are no more guides than clusters, and strands of a guide stay together if
/// there are up to twice as many; groups and sides of partings have their own too. Clusters of less
/// than a tenth of the mean number of strands have no card: these are stray hairs. A card runs
/// along the smoothed mean of its strands, a little out of their middle to where they end for the
/// eye, wide enough for `coverage` of their points at each section; its plane is that of most
/// spread near the surface of the head, and of the second of two that cross perpendicular to that.
/// Cards whose strands lie alike on them share a slot. Errors: invalid_argument for options out of
/// range, or if no strand has a length; not_finite naming strands; memory_limit; cancelled.
HairCards make_cards(const Strands& strands, const CardOptions& options = {},
                     const Context& context = {});

struct CardCapOptions {
    /// Metres over the skin.
    double offset = 0.0012;
    /// Metres in one unit of the head.
    double unit = 1.0;
    /// Triangles wanted; there are more if the edge of the hair or `error` needs them.
    Index triangles = 1500;
    /// Metres by which decimation may move the skin (DecimateOptions::error).
    double error = 0.0005;
};

/// Makes a cap: the faces of `head` that roots of strands cover, a little over the skin, decimated.
/// Errors: invalid_argument if the strands have no roots on the head; memory_limit; cancelled.
CardCap make_cap(const Strands& strands, const Mesh& head, const CardCapOptions& options = {},
                 const Context& context = {});

/// Returns the part of a cap whose cover is a half and more, as triangles. Errors: memory_limit;
/// cancelled.
Mesh cut_cap(const CardCap& cap, const Context& context = {});

/// Adds the cap that make_cap makes. Its slot is that of the most strands for its width. Errors:
/// as make_cap, and invalid_argument without cards.
void add_cap(HairCards& cards, const Strands& strands, const Mesh& head,
             const CardCapOptions& options = {}, const Context& context = {});

/// Returns the mesh of cards, in metres: triangles, two vertices a section, with "uv", "normal",
/// "tangent" (towards the tip), "color" (the light from all around that reaches the hair there, 0
/// to 1, in all three; alpha: 0 at the edge of the cap, else 1), "color2" (the same light; 0 at the
/// root, 1 at the tip; a number of the card, 0 to 1), and the label "material" called "hair".
/// Errors: memory_limit; cancelled.
Mesh card_mesh(const HairCards& cards, const Strands& strands, const CardOptions& options = {},
               const Context& context = {});

}  // namespace lissom
