#include "viewer/render/draw/image/overlay.h"

#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

// The pen's width as a share of the height of capitals, and its least width in pixels.
constexpr double kPenShare = 0.125;
constexpr double kMinimumPen = 1.0;

// Lays `color` over a pixel, covering `share` of it.
void blend(std::uint8_t* pixel, const Color& color, double share) {
    const std::array<std::uint8_t, 4> over = to_bytes(color);
    const double below = (1.0 - share) * pixel[3] / 255.0;
    const double alpha = share + below;
    if (alpha <= 0.0) return;
    for (int i = 0; i < 3; ++i) {
        const double mixed = (share * over[i] + below * pixel[i]) / alpha;
        pixel[i] = static_cast<std::uint8_t>(std::lround(mixed));
    }
    pixel[3] = static_cast<std::uint8_t>(std::lround(255.0 * alpha));
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double square = along.squaredNorm();
    const double share = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
    return (p - a - share * along).norm();
}

// How much of each pixel a pen covers, within the rectangle of pixels it can touch.
class Coverage {
  public:
    Coverage(const Image& image, const std::vector<Stroke>& strokes, double pen_width)
        : radius_(0.5 * pen_width) {
        Vec2 low = Vec2::Constant(1e9), high = -low;
        for (const Stroke& stroke : strokes) {
            for (const Vec2& p : stroke) {
                low = low.cwiseMin(p);
                high = high.cwiseMax(p);
            }
        }
        x0_ = to_pixel(low.x() - radius_ - 1.0, image.width);
        y0_ = to_pixel(low.y() - radius_ - 1.0, image.height);
        x1_ = to_pixel(high.x() + radius_ + 2.0, image.width);
        y1_ = to_pixel(high.y() + radius_ + 2.0, image.height);
        if (x0_ >= x1_ || y0_ >= y1_) return;
        shares_.assign(at(x1_ - x0_) * (y1_ - y0_), 0.0);
        for (const Stroke& stroke : strokes) add(stroke);
    }

    void paint(Image& image, const Color& color) const {
        for (std::size_t i = 0; i < shares_.size(); ++i) {
            if (shares_[i] == 0.0) continue;
            const int row = index_of(i) / (x1_ - x0_);
            const int column = index_of(i) % (x1_ - x0_);
            blend(image.pixel(x0_ + column, y0_ + row), color, shares_[i]);
        }
    }

  private:
    static int to_pixel(double at, int limit) {
        return static_cast<int>(std::floor(std::clamp(at, 0.0, static_cast<double>(limit))));
    }

    void add(const Stroke& stroke) {
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) add(stroke[i], stroke[i + 1]);
    }

    void add(const Vec2& a, const Vec2& b) {
        const Vec2 low = a.cwiseMin(b).array() - radius_ - 1.0;
        const Vec2 high = a.cwiseMax(b).array() + radius_ + 2.0;
        for (int y = std::max(y0_, to_pixel(low.y(), y1_)); y < to_pixel(high.y(), y1_); ++y) {
            for (int x = std::max(x0_, to_pixel(low.x(), x1_)); x < to_pixel(high.x(), x1_); ++x) {
                const double distance = distance_to_segment(Vec2(x + 0.5, y + 0.5), a, b);
                double& share = shares_[at(y - y0_) * (x1_ - x0_) + x - x0_];
                share = std::max(share, std::clamp(radius_ + 0.5 - distance, 0.0, 1.0));
            }
        }
    }

    double radius_;
    int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
    std::vector<double> shares_;
};

}  // namespace

void fill_rectangle(Image& image, int x, int y, int width, int height, const Color& color) {
    const std::array<std::uint8_t, 4> bytes = to_bytes(color);
    for (int row = std::max(y, 0); row < std::min(y + height, image.height); ++row) {
        for (int column = std::max(x, 0); column < std::min(x + width, image.width); ++column) {
            std::copy(bytes.begin(), bytes.end(), image.pixel(column, row));
        }
    }
}

void draw_strokes(Image& image, const std::vector<Stroke>& strokes, double width,
                  const Color& color) {
    if (!strokes.empty()) Coverage(image, strokes, width).paint(image, color);
}

void draw_text(Image& image, std::string_view text, double x, double y, double height,
               const Color& color) {
    TextStrokes laid_out = lay_out_text(text, height);
    for (Stroke& stroke : laid_out.strokes) {
        for (Vec2& point : stroke) point = Vec2(x + point.x(), y - point.y());
    }
    draw_strokes(image, laid_out.strokes, std::max(kPenShare * height, kMinimumPen), color);
}

}  // namespace lissom
