#include "viewer/render/cards/card_atlas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "viewer/render/draw/image/color.h"
#include "viewer/render/strands/strand_look.h"
#include "viewer/render/strands/strand_raster.h"
#include "viewer/render/strands/view_strands.h"

namespace lissom {
namespace {

using Eigen::Array3f;

// Metres that the heights of an atlas reach to both sides.
constexpr float kMostHeight = 0.005f;

// Metres that alpha is wide at least, and strands on a card that are drawn to it at least.
constexpr double kLockWidth = 0.0012;
constexpr double kLeastLocks = 24.0;
// Part of the full width over which a lock is pointed at its end.
constexpr float kLockPoint = 0.2f;
// Locks end where their strands are thinner than between none and this part of the full width: tips
// of others that lie behind them close the gaps that thinner ones leave.
constexpr float kThinEnd = 0.5f;

// What is seen of a segment of a strand.
struct DrawnSegment {
    Array3f color = Array3f::Zero();
    Eigen::Vector2f flow = Eigen::Vector2f::Zero();
    float height = 0.0f, place = 0.0f, number = 0.0f;
};

struct Texel {
    DrawnSegment mean;
    // Parts that strands cover, and locks.
    float cover = 0.0f, locks = 0.0f;
};

void add_to(DrawnSegment& sum, const DrawnSegment& part, float weight) {
    sum.color += weight * part.color;
    sum.flow += weight * part.flow;
    sum.height += weight * part.height;
    sum.place += weight * part.place;
    // Numbers are of one strand each: the last one drawn counts.
    sum.number = part.number;
}

DrawnSegment scaled(DrawnSegment sum, float factor) {
    const float number = sum.number;
    DrawnSegment result;
    add_to(result, sum, factor);
    result.number = number;
    return result;
}

// The texels of one slot, without its margin.
class SlotPainter {
  public:
    SlotPainter(const HairCards& cards, const CardSlot& slot, const ViewStrands& drawn, int size)
        : card_(cards.cards[at(slot.card)]), slot_(slot), drawn_(drawn) {
        left_ = static_cast<int>(std::ceil(slot.low.x() * size));
        top_ = static_cast<int>(std::ceil((1.0 - slot.high.y()) * size));
        width_ = std::max(static_cast<int>(slot.high.x() * size) - left_, 1);
        height_ = std::max(static_cast<int>((1.0 - slot.low.y()) * size) - top_, 1);
    }

    int left() const { return left_; }
    int top() const { return top_; }
    int width() const { return width_; }
    int height() const { return height_; }

    std::vector<Texel> paint() {
        SampleTile tile(0, 0, width_, height_), locks(0, 0, width_, height_);
        std::vector<float> widths;
        for (const Index s : card_.strands) {
            cover_widths(drawn_, s, widths);
            draw_strand(s, widths, tile);
        }
        draw_locks(locks);
        std::vector<Texel> texels(at(width_) * at(height_));
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x) {
                Texel& texel = texels[at(y * width_ + x)] = texel_of(tile, x, y);
                texel.locks = slot_.is_solid ? 1.0f : cover_at(locks, x, y);
            }
        }
        spread(texels);
        if (slot_.is_solid) {
            for (Texel& texel : texels) texel.cover = 1.0f;
        }
        return texels;
    }

  private:
    double half_width_at(double v) const {
        const auto last = static_cast<double>(card_.sections.size() - 1);
        const double place = std::clamp(v, 0.0, 1.0) * last;
        const auto below = std::min(static_cast<std::size_t>(place), card_.sections.size() - 2);
        const double u = place - static_cast<double>(below);
        return (1.0 - u) * card_.sections[below].half_width +
               u * card_.sections[below + 1].half_width;
    }

    float widest() const {
        float most = 0.0f;
        std::vector<float> widths;
        for (const Index s : card_.strands) {
            cover_widths(drawn_, s, widths);
            most = std::max(most, *std::max_element(widths.begin(), widths.end()));
        }
        return most;
    }

    // Draws one of so many strands as wide as all of them, so that small pictures keep them. Where
    // strands are thinner, fewer of these locks go on.
    void draw_locks(SampleTile& tile) {
        const float full = widest();
        if (!(full > 0.0f)) return;
        const double most = static_cast<double>(card_.strands.size()) / kLeastLocks;
        const auto step =
            static_cast<std::size_t>(std::max(1.0, std::min(kLockWidth / double{full}, most)));
        std::vector<float> widths;
        for (std::size_t i = 0; i < card_.strands.size(); i += step) {
            const double turns = 0.6180339887498949 * (static_cast<double>(i / step) + 0.5);
            const auto ends_below = static_cast<float>(turns - std::floor(turns));
            cover_widths(drawn_, card_.strands[i], widths);
            for (float& width : widths) {
                const float part = width / full - kThinEnd * ends_below;
                const float shape = std::clamp(part / kLockPoint, 0.0f, 1.0f);
                width =
                    part > 0.0f ? static_cast<float>(step) * full * (0.4f + 0.6f * shape) : 0.0f;
            }
            draw_strand(card_.strands[i], widths, tile);
        }
    }

    void draw_strand(Index s, const std::vector<float>& widths, SampleTile& tile) {
        const StrandView strand = drawn_.strands->strand(s);
        std::vector<double> fractions;
        arc_fractions(strand, fractions);
        const StrandLook look = look_of(drawn_, s);
        CardPoint before = place_on_card(card_, point_of(strand, 0));
        for (Index k = 1; k < index_of(strand.cols()); ++k) {
            const CardPoint here = place_on_card(card_, point_of(strand, k));
            const auto t = static_cast<float>(fractions[at(k)]);
            DrawnSegment segment;
            segment.color = strand_color(drawn_, s, drawn_.strands->first_point(s) + k) *
                            look.tone * tone_along(*drawn_.style, t);
            segment.flow = flow_of(before, here);
            segment.height = static_cast<float>(here.out);
            segment.place = t;
            segment.number = number_of(s);
            const auto id = static_cast<std::uint32_t>(segments_.size());
            segments_.push_back(segment);
            tile.draw_segment(screen_point(before, widths[at(k - 1)]),
                              screen_point(here, widths[at(k)]), id);
            before = here;
        }
    }

    float number_of(Index s) const {
        const double turns = 0.6180339887498949 * (drawn_.strands->id(s) + 1.0);
        return static_cast<float>(turns - std::floor(turns));
    }

    // Towards the tip, in metres across and along, as a unit vector.
    Eigen::Vector2f flow_of(const CardPoint& a, const CardPoint& b) const {
        const double across = (b.u - a.u) * half_width_at(0.5 * (a.v + b.v));
        const double along = (b.v - a.v) * card_.length();
        const Eigen::Vector2d way(across, -along);
        const double size = way.norm();
        return size > 0.0 ? Eigen::Vector2f((way / size).cast<float>()) : Eigen::Vector2f(0, -1);
    }

    ScreenPoint screen_point(const CardPoint& p, float width) const {
        ScreenPoint point;
        point.x = static_cast<float>(0.5 * (p.u + 1.0) * width_);
        point.y = static_cast<float>(p.v * height_);
        point.depth = std::clamp(0.5f - static_cast<float>(10.0 * p.out), 0.0f, 1.0f);
        const double texels = width_ / (2.0 * half_width_at(p.v));
        point.radius = static_cast<float>(0.5 * width * texels);
        return point;
    }

    Texel texel_of(const SampleTile& tile, int x, int y) const {
        Texel texel;
        float count = 0.0f;
        for (int k = 0; k < SampleTile::kSamples; ++k) {
            const std::uint32_t id = tile.id(x, y, k);
            if (id >= SampleTile::kSurface) continue;
            add_to(texel.mean, segments_[id], 1.0f);
            count += 1.0f;
        }
        if (count > 0.0f) texel.mean = scaled(texel.mean, 1.0f / count);
        texel.cover = count / SampleTile::kSamples;
        return texel;
    }

    static float cover_at(const SampleTile& tile, int x, int y) {
        float count = 0.0f;
        for (int k = 0; k < SampleTile::kSamples; ++k) {
            if (tile.id(x, y, k) < SampleTile::kSurface) count += 1.0f;
        }
        return count / SampleTile::kSamples;
    }

    // Gives texels without strands the mean of those around them, from the nearest on.
    void spread(std::vector<Texel>& texels) const {
        std::vector<char> known;
        for (const Texel& texel : texels) known.push_back(texel.cover > 0.0f);
        for (int round = 0; round < width_ + height_; ++round) {
            std::vector<std::size_t> added;
            for (int y = 0; y < height_; ++y) {
                for (int x = 0; x < width_; ++x) {
                    const auto i = at(y * width_ + x);
                    if (!known[i] && take_neighbours(texels, known, x, y)) added.push_back(i);
                }
            }
            if (added.empty()) return;
            for (const std::size_t i : added) known[i] = 1;
        }
    }

    bool take_neighbours(std::vector<Texel>& texels, const std::vector<char>& known, int x,
                         int y) const {
        DrawnSegment sum;
        float count = 0.0f;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); ++j) {
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width_ - 1); ++i) {
                const auto n = at(j * width_ + i);
                if (!known[n]) continue;
                add_to(sum, texels[n].mean, 1.0f);
                count += 1.0f;
            }
        }
        if (count > 0.0f) texels[at(y * width_ + x)].mean = scaled(sum, 1.0f / count);
        return count > 0.0f;
    }

    const Card& card_;
    const CardSlot& slot_;
    const ViewStrands& drawn_;
    int left_ = 0, top_ = 0, width_ = 0, height_ = 0;
    std::vector<DrawnSegment> segments_;
};

// Factor of coverage with which as many texels reach the cutoff as strands cover.
float alpha_factor(const std::vector<Texel>& texels, double cutoff) {
    std::vector<float> covers;
    double sum = 0.0;
    for (const Texel& texel : texels) {
        covers.push_back(texel.locks);
        sum += texel.locks;
    }
    std::sort(covers.begin(), covers.end(), std::greater<>());
    const auto wanted = static_cast<std::size_t>(std::lround(sum));
    if (wanted == 0) return 1.0f;
    const float least = covers[std::min(wanted, covers.size()) - 1];
    return least > 0.0f ? std::clamp(static_cast<float>(cutoff) / least, 0.5f, 8.0f) : 1.0f;
}

std::uint8_t byte_of(double x) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(x, 0.0, 1.0)));
}

void put_slot(const SlotPainter& slot, const std::vector<Texel>& texels, double cutoff,
              CardAtlas& atlas) {
    const float factor = alpha_factor(texels, cutoff);
    for (int y = 0; y < slot.height(); ++y) {
        for (int x = 0; x < slot.width(); ++x) {
            const Texel& texel = texels[at(y * slot.width() + x)];
            std::uint8_t* const color = atlas.color.pixel(slot.left() + x, slot.top() + y);
            for (int i = 0; i < 3; ++i) {
                color[i] = byte_of(linear_to_srgb(std::clamp(texel.mean.color[i], 0.0f, 1.0f)));
            }
            color[3] = byte_of(factor * texel.locks);
            std::uint8_t* const flow = atlas.flow.pixel(slot.left() + x, slot.top() + y);
            flow[0] = byte_of(0.5 + 0.5 * texel.mean.flow.x());
            flow[1] = byte_of(0.5 + 0.5 * texel.mean.flow.y());
            flow[2] = byte_of(0.5 + 0.5 * texel.mean.height / kMostHeight);
            std::uint8_t* const data = atlas.data.pixel(slot.left() + x, slot.top() + y);
            data[0] = byte_of(texel.mean.place);
            data[1] = byte_of(texel.mean.number);
            data[2] = byte_of(texel.cover);
        }
    }
}

}  // namespace

CardAtlas bake_atlas(const HairCards& cards, const Strands& strands,
                     const CardAtlasOptions& options, const Context& context) {
    require(options.size >= 64 && options.size <= 8192, "an atlas has 64 to 8192 texels a side");
    require(options.cutoff > 0.0 && options.cutoff < 1.0, "the cutoff of alpha is between 0 and 1");
    const MemoryCharge charge =
        context.charge(12 * at(options.size) * at(options.size), "the atlas of cards");
    Progress progress(context, "bake cards");
    const ViewStrands drawn{&strands, &options.style, strands.size()};
    CardAtlas atlas{
        {options.size, options.size}, {options.size, options.size}, {options.size, options.size}};
    for (Image* image : {&atlas.flow, &atlas.data}) {
        for (std::size_t i = 3; i < image->rgba.size(); i += 4) image->rgba[i] = 255;
    }
    context.parallel_for(0, count_of(cards.slots), 1, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            SlotPainter painter(cards, cards.slots[at(i)], drawn, options.size);
            put_slot(painter, painter.paint(), options.cutoff, atlas);
        }
    });
    return atlas;
}

}  // namespace lissom
