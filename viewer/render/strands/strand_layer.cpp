#include "viewer/render/strands/strand_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "viewer/render/strands/strand_look.h"
#include "viewer/render/strands/strand_raster.h"

namespace lissom {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

// Pixels along a side of a tile; of all factors of supersampling a multiple.
constexpr int kTile = 36;
// Samples of the picture that are held at one time, and points of strands.
constexpr std::size_t kMaxSamples = 24'000'000;
constexpr Index kBatchPoints = 400'000;
// Strands of a batch that one thread projects.
constexpr Index kBatchChunks = 8;

// ---- From view space to pixels

class Screen {
  public:
    // `min_radius`: of opaque strands, in pixels.
    Screen(const ViewParameters& view, int width, int height, float min_radius)
        : projection_(view.projection.cast<float>()),
          perspective_(view.perspective),
          near_(static_cast<float>(view.near)),
          width_(static_cast<float>(width)),
          height_(static_cast<float>(height)),
          // Pixels in a view unit; at depth 1 with perspective.
          scale_(static_cast<float>(0.5 * height / view.half_extent.y())),
          min_radius_(min_radius) {}

    // A point in front of the near plane.
    ScreenPoint operator()(const Vector3f& p, float width) const {
        const float x = projection_(0, 0) * p.x(), y = projection_(1, 1) * p.y();
        const float z = projection_(2, 2) * p.z() + projection_(2, 3);
        const float inverse = perspective_ ? -1.0f / p.z() : 1.0f;
        return {(0.5f + 0.5f * x * inverse) * width_, (0.5f - 0.5f * y * inverse) * height_,
                0.5f + 0.5f * z * inverse, 0.5f * width * scale_ * inverse};
    }
    // The same of a strand that is seen however thin it is.
    ScreenPoint visible(const Vector3f& p, float width) const {
        ScreenPoint point = (*this)(p, width);
        if (width > 0.0f) point.radius = std::max(point.radius, min_radius_);
        return point;
    }
    bool in_front(const Vector3f& p) const { return p.z() <= -near_; }
    // Fraction of a line, from a point in front to one that is not, at which it meets the near
    // plane.
    float to_near(const Vector3f& front, const Vector3f& behind) const {
        return (-near_ - front.z()) / (behind.z() - front.z());
    }
    Vector3f to_viewer(const Vector3f& p) const {
        return perspective_ ? Vector3f(-p.normalized()) : Vector3f(Vector3f::UnitZ());
    }

  private:
    Eigen::Matrix4f projection_;
    bool perspective_;
    float near_, width_, height_, scale_, min_radius_;
};

// ---- Strands by the numbers of their points: the ids of samples

// Points of all strands that are drawn, counted through.
class PointNumbers {
  public:
    explicit PointNumbers(std::span<const ViewStrands> strands) : strands_(strands) {
        for (const ViewStrands& drawn : strands) {
            bases_.push_back(base_);
            base_ += static_cast<std::uint32_t>(drawn.point_count());
            blocks_.push_back(first_strands(drawn));
        }
    }

    struct Place {
        std::size_t drawn;
        Index strand, point;
    };
    Place find(std::uint32_t id) const {
        std::size_t drawn = bases_.size() - 1;
        while (bases_[drawn] > id) --drawn;
        const auto point = static_cast<Index>(id - bases_[drawn]);
        const std::span<const Index> offsets = strands_[drawn].strands->offsets();
        Index strand = blocks_[drawn][point / kBlock];
        while (offsets[at(strand) + 1] <= point) ++strand;
        return {drawn, strand, point};
    }
    std::uint32_t base(std::size_t drawn) const { return bases_[drawn]; }

  private:
    static constexpr Index kBlock = 32;

    // The strand of every 32nd point.
    static std::vector<Index> first_strands(const ViewStrands& drawn) {
        std::vector<Index> result;
        const std::span<const Index> offsets = drawn.strands->offsets();
        Index strand = 0;
        for (Index point = 0; point < drawn.point_count(); point += kBlock) {
            while (offsets[at(strand) + 1] <= point) ++strand;
            result.push_back(strand);
        }
        return result;
    }

    std::span<const ViewStrands> strands_;
    std::uint32_t base_ = 0;
    std::vector<std::uint32_t> bases_;
    std::vector<std::vector<Index>> blocks_;
};

// ---- Shading

// Appearance of a strand at a sample.
class StrandShader {
  public:
    StrandShader(const StrandScene& scene, const StrandShadow& shadow, const Screen& screen,
                 const PointNumbers& numbers, const Context& context)
        : scene_(scene), shadow_(shadow), screen_(screen), numbers_(numbers) {
        for (const ViewStrands& drawn : scene.strands) {
            std::vector<StrandLook> looks(drawn.count);
            context.parallel_for(0, drawn.count, 4096, [&](Index begin, Index end) {
                for (Index s = begin; s < end; ++s) {
                    looks[s] = look_of(drawn, s);
                }
            });
            looks_.push_back(std::move(looks));
        }
    }

    // The segment that begins with the point `id`, at (x, y) of the picture.
    Array3f operator()(std::uint32_t id, const Eigen::Vector2f& at) const {
        const PointNumbers::Place place = numbers_.find(id);
        const ViewStrands& drawn = scene_.strands[place.drawn];
        const Vector3f a = drawn.position(place.point), b = drawn.position(place.point + 1);
        const float share = share_at(a, b, at);
        const Vector3f position = a + share * (b - a);
        const StrandLook& look = looks_[place.drawn][place.strand];
        StrandPoint point;
        point.tangent = tangent(drawn, place, share);
        point.to_viewer = screen_.to_viewer(position);
        point.shift = look.shift;
        point.color = color(drawn, place, share) * look.tone;
        point.light = shadow_.light(position);
        return shade_strand(*drawn.style, point);
    }

  private:
    float share_at(const Vector3f& a, const Vector3f& b, const Eigen::Vector2f& at) const {
        if (!screen_.in_front(a) || !screen_.in_front(b)) return 0.5f;
        const ScreenPoint from = screen_(a, 0.0f), to = screen_(b, 0.0f);
        const Eigen::Vector2f along(to.x - from.x, to.y - from.y);
        const float square = along.squaredNorm();
        if (!(square > 1e-12f)) return 0.5f;
        return std::clamp((at - Eigen::Vector2f(from.x, from.y)).dot(along) / square, 0.0f, 1.0f);
    }

    // Between those of the segment's ends, which are those of their neighbours' directions.
    static Vector3f tangent(const ViewStrands& drawn, const PointNumbers::Place& place,
                            float share) {
        const Index first = drawn.strands->first_point(place.strand);
        const Index last = first + drawn.strands->point_count(place.strand) - 1;
        const auto at = [&](Index point) {
            const Index before = std::max(point - 1, first), after = std::min(point + 1, last);
            const Vector3f d = drawn.position(after) - drawn.position(before);
            const float length = d.norm();
            return length > 0.0f && std::isfinite(length) ? Vector3f(d / length)
                                                          : Vector3f(Vector3f::Zero());
        };
        const Vector3f mean = (1.0f - share) * at(place.point) + share * at(place.point + 1);
        const float length = mean.norm();
        return length > 0.0f ? Vector3f(mean / length) : mean;
    }

    static Array3f color(const ViewStrands& drawn, const PointNumbers::Place& place, float share) {
        const Index first = drawn.strands->first_point(place.strand);
        const Index segments = drawn.strands->point_count(place.strand) - 1;
        const float t = ((place.point - first) + share) / segments;
        const Array3f a = strand_color(drawn, place.strand, place.point);
        const Array3f b = strand_color(drawn, place.strand, place.point + 1);
        return (a + share * (b - a)) * tone_along(*drawn.style, t);
    }

    const StrandScene& scene_;
    const StrandShadow& shadow_;
    const Screen& screen_;
    const PointNumbers& numbers_;
    std::vector<std::vector<StrandLook>> looks_;
};

// ---- Sorting into tiles

struct Segment {
    ScreenPoint begin, end;
    std::uint32_t id;
};

// Rows of tiles that are drawn at one time.
class Tiles {
  public:
    Tiles(int width, int top, int height) : top_(top) {
        columns_ = (width + kTile - 1) / kTile;
        for (int y = top; y < top + height; y += kTile) {
            for (int x = 0; x < width; x += kTile) {
                tiles_.emplace_back(x, y, std::min(kTile, width - x),
                                    std::min(kTile, top + height - y));
            }
        }
    }

    std::size_t size() const { return tiles_.size(); }
    SampleTile& operator[](std::size_t i) { return tiles_[i]; }
    const SampleTile& operator[](std::size_t i) const { return tiles_[i]; }

    // Calls visit(tile) for the tiles that the rectangle touches.
    template <typename Visit>
    void for_each_in(float left, float top, float right, float bottom, const Visit& visit) const {
        const int rows = count_of(tiles_) / columns_;
        // The tile of a place, or the nearest before or behind them all.
        const auto tile_at = [](float place, int count) {
            const float at = place * (1.0f / kTile) + 1.0f;
            return static_cast<int>(std::min(std::max(at, 0.0f), static_cast<float>(count + 1))) -
                   1;
        };
        const float first = top_;
        const int x0 = std::max(tile_at(left, columns_), 0);
        const int x1 = std::min(tile_at(right, columns_), columns_ - 1);
        const int y0 = std::max(tile_at(top - first, rows), 0);
        const int y1 = std::min(tile_at(bottom - first, rows), rows - 1);
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                visit(at(y) * columns_ + x);
            }
        }
    }

  private:
    int columns_ = 0, top_;
    std::vector<SampleTile> tiles_;
};

// Segments of some strands, and which tiles each lies in.
struct SortedSegments {
    std::vector<Segment> segments;
    std::vector<std::vector<std::uint32_t>> of_tile;
};

void add_segment(SortedSegments& sorted, const Tiles& tiles, const Segment& segment) {
    const ScreenPoint &a = segment.begin, &b = segment.end;
    const float reach = std::max(a.radius, b.radius);
    if (!std::isfinite(a.x + a.y + b.x + b.y + reach) || !(reach > 0.0f)) return;
    const auto number = static_cast<std::uint32_t>(sorted.segments.size());
    bool seen = false;
    const float left = std::min(a.x, b.x) - reach, right = std::max(a.x, b.x) + reach;
    const float top = std::min(a.y, b.y) - reach, bottom = std::max(a.y, b.y) + reach;
    const float depth = std::min(a.depth, b.depth);
    tiles.for_each_in(left, top, right, bottom, [&](std::size_t tile) {
        if (tiles[tile].occludes(left, top, right, bottom, depth)) return;
        sorted.of_tile[tile].push_back(number);
        seen = true;
    });
    if (seen) sorted.segments.push_back(segment);
}

// A segment as far as it is in front of the near plane.
bool project(const Screen& screen, const Vector3f& a, const Vector3f& b, float a_width,
             float b_width, bool opaque, Segment& segment) {
    const bool a_front = screen.in_front(a), b_front = screen.in_front(b);
    if (!a_front && !b_front) return false;
    Vector3f begin = a, end = b;
    if (!b_front) end = a + screen.to_near(a, b) * (b - a);
    if (!a_front) begin = b + screen.to_near(b, a) * (a - b);
    segment.begin = opaque ? screen.visible(begin, a_width) : screen(begin, a_width);
    segment.end = opaque ? screen.visible(end, b_width) : screen(end, b_width);
    return true;
}

void sort_strand(const ViewStrands& drawn, Index strand, std::uint32_t base, const Screen& screen,
                 const Tiles& tiles, std::vector<float>& widths, SortedSegments& sorted) {
    const Index first = drawn.strands->first_point(strand);
    cover_widths(drawn, strand, widths);
    const StrandValues<float>& clear = drawn.strands->transparency();
    const bool opaque = clear.domain == StrandDomain::all && clear.common <= 0.0f;
    Vector3f before = drawn.position(first);
    for (std::size_t i = 1; i < widths.size(); ++i) {
        const Vector3f here = drawn.position(first + index_of(i));
        Segment segment;
        segment.id = base + static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(i) - 1;
        if (project(screen, before, here, widths[i - 1], widths[i], opaque, segment)) {
            add_segment(sorted, tiles, segment);
        }
        before = here;
    }
}

// The drawn strands, the nearest middle first: the strands that hide most come early.
std::vector<Index> nearest_first(const ViewStrands& drawn) {
    std::vector<float> depths;
    for (Index s = 0; s < drawn.count; ++s) {
        const Index middle = drawn.strands->point_count(s) / 2;
        const float depth = -drawn.position(drawn.strands->first_point(s) + middle).z();
        depths.push_back(std::isfinite(depth) ? depth : std::numeric_limits<float>::max());
    }
    std::vector<Index> order(depths.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return depths[a] < depths[b]; });
    return order;
}

// Draws some strands into the tiles.
void draw_batch(const ViewStrands& drawn, std::span<const Index> batch, std::uint32_t base,
                const Screen& screen, Tiles& tiles, const Context& context) {
    std::vector<SortedSegments> chunks(kBatchChunks);
    const auto size = count_of(batch);
    const Index grain = (size + kBatchChunks - 1) / kBatchChunks;
    context.parallel_for(0, size, grain, [&](Index begin, Index end) {
        SortedSegments& sorted = chunks[begin / grain];
        sorted.of_tile.resize(tiles.size());
        std::vector<float> widths;
        for (Index i = begin; i < end; ++i) {
            sort_strand(drawn, batch[i], base, screen, tiles, widths, sorted);
        }
    });
    context.parallel_for(0, count_of(tiles), 1, [&](Index tile, Index) {
        SampleTile& samples = tiles[tile];
        for (const SortedSegments& sorted : chunks) {
            if (sorted.of_tile.empty()) continue;
            for (const std::uint32_t i : sorted.of_tile[tile]) {
                const Segment& segment = sorted.segments[i];
                samples.draw_segment(segment.begin, segment.end, segment.id);
            }
        }
        samples.update_depth_blocks();
    });
}

// Draws all strands, so many at a time that strands hidden by the first ones need not be drawn.
void draw_all(const ViewStrands& drawn, std::span<const Index> order, std::uint32_t base,
              const Screen& screen, Tiles& tiles, const Context& context) {
    Progress progress(context, "render: hair");
    std::size_t first = 0;
    while (first < order.size()) {
        progress.update(first, order.size());
        std::size_t last = first;
        Index points = 0;
        while (last < order.size() && points < kBatchPoints) {
            points += drawn.strands->point_count(order[last++]);
        }
        draw_batch(drawn, order.subspan(first, last - first), base, screen, tiles, context);
        first = last;
    }
}

// ---- Meshes

// The part of a triangle in front of the near plane: its corners, none to four.
std::vector<ScreenPoint> clipped(const ViewTriangle& triangle, const Screen& screen) {
    std::vector<ScreenPoint> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3f &a = triangle[i], &b = triangle[(i + 1) % 3];
        const bool a_front = screen.in_front(a);
        if (a_front) corners.push_back(screen(a, 0.0f));
        if (a_front == screen.in_front(b)) continue;
        const Vector3f& front = a_front ? a : b;
        const Vector3f& behind = a_front ? b : a;
        corners.push_back(screen(front + screen.to_near(front, behind) * (behind - front), 0.0f));
    }
    return corners;
}

void draw_meshes(const std::vector<ViewTriangle>& triangles, const Screen& screen, Tiles& tiles,
                 const Context& context) {
    std::vector<std::array<ScreenPoint, 3>> seen;
    std::vector<std::vector<std::uint32_t>> of_tile(tiles.size());
    for (const ViewTriangle& triangle : triangles) {
        const std::vector<ScreenPoint> corners = clipped(triangle, screen);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const ScreenPoint &a = corners[0], &b = corners[i - 1], &c = corners[i];
            const auto number = static_cast<std::uint32_t>(seen.size());
            tiles.for_each_in(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                              std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}),
                              [&](std::size_t tile) { of_tile[tile].push_back(number); });
            seen.push_back({a, b, c});
        }
    }
    context.parallel_for(0, count_of(tiles), 1, [&](Index tile, Index) {
        SampleTile& samples = tiles[tile];
        for (const std::uint32_t i : of_tile[tile]) {
            samples.draw_triangle(seen[i]);
        }
        samples.update_depth_blocks();
    });
}

// ---- From samples to pixels

// Samples of a pixel at which the same strand is seen.
struct SeenStrand {
    std::uint32_t id;
    int samples;
    Eigen::Vector2f at;
};

StrandPixel pixel_of(const SampleTile& tile, int x, int y, const StrandShader& shader) {
    std::array<SeenStrand, SampleTile::kSamples> seen;
    std::size_t count = 0;
    StrandPixel pixel;
    for (int k = 0; k < SampleTile::kSamples; ++k) {
        const std::uint32_t id = tile.id(x, y, k);
        if (id == SampleTile::kSurface) pixel.meshes += 1.0f;
        if (id >= SampleTile::kSurface) continue;
        std::size_t i = 0;
        while (i < count && seen[i].id != id) ++i;
        if (i == count) seen[count++] = {id, 0, Eigen::Vector2f::Zero()};
        ++seen[i].samples;
        seen[i].at += tile.position(x, y, k);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const float samples = seen[i].samples;
        pixel.color += samples * shader(seen[i].id, seen[i].at / samples);
        pixel.strands += samples;
    }
    return pixel;
}

int covered_by_meshes(const SampleTile& tile, int x, int y) {
    int count = 0;
    for (int k = 0; k < SampleTile::kSamples; ++k) {
        if (tile.id(x, y, k) == SampleTile::kSurface) ++count;
    }
    return count;
}

// Calls visit(x, y) for all pixels of all tiles; those of a tile on one thread.
template <typename Visit>
void for_each_pixel(Tiles& tiles, const Context& context, const Visit& visit) {
    context.parallel_for(0, count_of(tiles), 1, [&](Index i, Index) {
        const SampleTile& tile = tiles[i];
        for (int y = tile.top(); y < tile.top() + tile.height(); ++y) {
            for (int x = tile.left(); x < tile.left() + tile.width(); ++x) visit(tile, x, y);
        }
    });
}

// Rows of fine pixels that are drawn at one time: whole tiles.
int band_height(int width, int height) {
    const std::size_t row = at(width) * SampleTile::kSamples;
    const int rows = index_of(std::min(kMaxSamples / row, at(height)));
    return std::max(rows / kTile, 1) * kTile;
}

void add(StrandPixel& sum, const StrandPixel& part, float weight) {
    sum.color += weight * part.color;
    sum.strands += weight * part.strands;
    sum.meshes += weight * part.meshes;
}

Array3f linear_color(const std::uint8_t* rgb) {
    static const std::array<float, 256> linear = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = srgb_to_linear(i / 255.0);
        }
        return values;
    }();
    return {linear[rgb[0]], linear[rgb[1]], linear[rgb[2]]};
}

// Linear colour times alpha, and alpha.
struct Light {
    Array3f color = Array3f::Zero();
    float alpha = 0.0f;
};

void write_pixel(std::uint8_t* to, const Light& light) {
    for (int i = 0; i < 3; ++i) {
        const double part = light.alpha > 0.0f ? light.color[i] / light.alpha : 0.0;
        to[i] = static_cast<std::uint8_t>(
            std::lround(255.0 * linear_to_srgb(std::clamp(part, 0.0, 1.0))));
    }
    to[3] = static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(light.alpha, 0.0f, 1.0f)));
}

// A pixel of strands, the pixel under it and the background together. `under` shows meshes and, in
// the room they leave, marks beside them; strands hide both in the same proportion.
Light light_of(const StrandPixel& over, const std::uint8_t* under, const Light& background) {
    const float alpha = under[3] / 255.0f;
    float covered = alpha;
    if (over.strands > 0.0f) {
        const float room = 1.0f - over.all_meshes;
        const float marks =
            room > 1e-3f ? std::clamp((alpha - over.all_meshes) / room, 0.0f, 1.0f) : 1.0f;
        const float mesh = alpha > 0.0f ? over.meshes : 0.0f;
        covered = mesh + (1.0f - over.strands - mesh) * marks;
    }
    const float open = 1.0f - over.strands - covered;
    return {over.color + covered * linear_color(under) + open * background.color,
            over.strands + covered + open * background.alpha};
}

std::vector<Light> all_lights(const Image& meshes, const StrandLayer& layer,
                              const std::optional<Color>& background) {
    Light ground;
    if (background) ground = {linear_color(to_bytes(*background).data()), 1.0f};
    std::vector<Light> lights(layer.pixels.size());
    for (int y = 0; y < layer.height; ++y) {
        for (int x = 0; x < layer.width; ++x) {
            const std::size_t i = layer.place(x, y);
            lights[i] = light_of(layer.pixels[i], meshes.pixel(x, y), ground);
        }
    }
    return lights;
}

// Calls visit(x, y, weight) for a pixel and its neighbours, with weights 1 5 1 along both sides.
template <typename Visit>
void for_each_near(int width, int height, int x, int y, const Visit& visit) {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
            visit(i, j, (i == x ? 5.0f : 1.0f) * (j == y ? 5.0f : 1.0f));
        }
    }
}

bool near_strands(const StrandLayer& layer, int x, int y) {
    bool near = false;
    for_each_near(layer.width, layer.height, x, y, [&](int i, int j, float) {
        near = near || layer.pixels[layer.place(i, j)].strands > 0.0f;
    });
    return near;
}

// Strands are much thinner than pixels: the sample in each is a matter of chance. Seen through a
// filter a little wider than a pixel, as of a lens, they are less grainy.
Light filtered(const std::vector<Light>& lights, int width, int height, int x, int y) {
    Light sum;
    float weights = 0.0f;
    for_each_near(width, height, x, y, [&](int i, int j, float weight) {
        const Light& light = lights[at(j) * width + i];
        sum.color += weight * light.color;
        sum.alpha += weight * light.alpha;
        weights += weight;
    });
    return {sum.color / weights, sum.alpha / weights};
}

}  // namespace

double min_visible_width(Index strands) {
    constexpr double kWidth = 1.5, kFew = 50.0, kMany = 500.0;
    const double of_way = std::log(kMany / std::max<Index>(strands, 1)) / std::log(kMany / kFew);
    return kWidth * std::clamp(of_way, 0.0, 1.0);
}

StrandLayer draw_strands(const StrandScene& scene, const StrandShadow& shadow,
                         const RenderOptions& options, const Context& context) {
    const int fine = options.supersample;
    const int width = options.width * fine, height = options.height * fine;
    const Screen screen(scene.view, width, height,
                        static_cast<float>(0.5 * scene.min_width * fine));
    const PointNumbers numbers(scene.strands);
    const StrandShader shader(scene, shadow, screen, numbers, context);
    StrandLayer layer{options.width, options.height, {}};
    const std::size_t pixels = at(layer.width) * layer.height;
    const int band = band_height(width, height);
    const MemoryCharge charge =
        context.charge(pixels * sizeof(StrandPixel) +
                           at(width) * std::min(band, height) * (SampleTile::kSamples * 8 + 5),
                       "the strands of the picture");
    layer.pixels.resize(pixels);
    const float weight = 1.0f / (fine * fine * SampleTile::kSamples);
    const auto pixel_at = [&](int x, int y) -> StrandPixel& {
        return layer.pixels[at(y / fine) * layer.width + (x / fine)];
    };
    std::vector<std::vector<Index>> orders;
    for (const ViewStrands& drawn : scene.strands) orders.push_back(nearest_first(drawn));
    Progress progress(context, "render: hair");
    const double of_all = 1.0 * band / height;
    for (int top = 0; top < height; top += band) {
        progress.step(0.6 * of_all);
        Tiles tiles(width, top, std::min(band, height - top));
        draw_meshes(scene.triangles, screen, tiles, context);
        for_each_pixel(tiles, context, [&](const SampleTile& tile, int x, int y) {
            pixel_at(x, y).all_meshes += weight * covered_by_meshes(tile, x, y);
        });
        for (std::size_t i = 0; i < scene.strands.size(); ++i) {
            draw_all(scene.strands[i], orders[i], numbers.base(i), screen, tiles, context);
        }
        progress.step(0.4 * of_all);
        for_each_pixel(tiles, context, [&](const SampleTile& tile, int x, int y) {
            add(pixel_at(x, y), pixel_of(tile, x, y, shader), weight);
        });
    }
    return layer;
}

Image lay_over(const Image& meshes, const StrandLayer& layer,
               const std::optional<Color>& background) {
    Image image = meshes;
    const std::vector<Light> lights = all_lights(meshes, layer, background);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const bool unchanged = meshes.pixel(x, y)[3] == 255;
            if (near_strands(layer, x, y)) {
                write_pixel(image.pixel(x, y), filtered(lights, image.width, image.height, x, y));
            } else if (!unchanged) {
                write_pixel(image.pixel(x, y), lights[layer.place(x, y)]);
            }
        }
    }
    return image;
}

}  // namespace lissom
