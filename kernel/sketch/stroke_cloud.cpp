#include "kernel/sketch/stroke_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "kernel/core/error.h"
#include "kernel/sketch/stroke_depth.h"

namespace lissom {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::infinity();
constexpr std::size_t kCloudBetweenChecks = 3 * 65536;

// The points of a stroke by cells of the picture as wide as the radius around them.
class StrokeCells {
  public:
    StrokeCells(std::span<const Vec2> stroke, double radius) : stroke_(stroke), radius_(radius) {
        for (std::size_t i = 0; i < stroke.size(); ++i) {
            cells_[cell(stroke[i], 0, 0)].push_back(i);
            low_ = low_.cwiseMin(stroke[i]), high_ = high_.cwiseMax(stroke[i]);
        }
        low_.array() -= radius, high_.array() += radius;
    }

    // Calls visit(place) for the points of the stroke within the radius of a pixel.
    template <typename Visit>
    void around(const Vec2& pixel, const Visit& visit) const {
        if ((pixel.array() < low_.array()).any() || (pixel.array() > high_.array()).any()) return;
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) visit_cell(pixel, cell(pixel, x, y), visit);
        }
    }

  private:
    std::int64_t cell(const Vec2& pixel, int x, int y) const {
        const auto column = static_cast<std::int64_t>(std::floor(pixel.x() / radius_)) + x;
        const auto row = static_cast<std::int64_t>(std::floor(pixel.y() / radius_)) + y;
        return column * 0x100000000LL + row;
    }
    template <typename Visit>
    void visit_cell(const Vec2& pixel, std::int64_t which, const Visit& visit) const {
        const auto found = cells_.find(which);
        if (found == cells_.end()) return;
        for (const std::size_t i : found->second) {
            if ((stroke_[i] - pixel).squaredNorm() <= radius_ * radius_) visit(i);
        }
    }

    std::span<const Vec2> stroke_;
    double radius_;
    Vec2 low_ = Vec2::Constant(kUnseen), high_ = Vec2::Constant(-kUnseen);
    std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

// Returns the depths of the points seen around each point of the stroke.
std::vector<std::vector<float>> depths_around(std::span<const Vec2> stroke, const View& view,
                                              std::span<const float> cloud, double radius,
                                              const Context& context) {
    const StrokeCells cells(stroke, radius);
    std::vector<std::vector<float>> depths(stroke.size());
    for (std::size_t p = 0; p + 2 < cloud.size(); p += 3) {
        if (p % kCloudBetweenChecks == 0) context.checkpoint();
        const Vec3 seen = view.project({cloud[p], cloud[p + 1], cloud[p + 2]});
        if (!seen.allFinite() || !(seen.z() > 0.0)) continue;
        cells.around(seen.head<2>(),
                     [&](std::size_t i) { depths[i].push_back(static_cast<float>(seen.z())); });
    }
    return depths;
}

double front_of(std::vector<float>& depths, double before) {
    if (depths.empty()) return kUnseen;
    const auto place = static_cast<std::ptrdiff_t>(before * static_cast<double>(depths.size() - 1));
    std::nth_element(depths.begin(), depths.begin() + place, depths.end());
    return depths[static_cast<std::size_t>(place)];
}

// Fills in unseen depths, evenly between seen ones.
void bridge(std::vector<double>& depths) {
    const auto seen = [](double depth) { return depth != kUnseen; };
    const auto first = std::find_if(depths.begin(), depths.end(), seen);
    if (first == depths.end()) {
        throw Error(ErrorCode::invalid_argument,
                    "no hair is seen under the stroke; draw it over hair");
    }
    std::fill(depths.begin(), first, *first);
    for (auto last = first;;) {
        const auto next = std::find_if(last + 1, depths.end(), seen);
        if (next == depths.end()) {
            std::fill(last + 1, depths.end(), *last);
            return;
        }
        const double step = (*next - *last) / static_cast<double>(next - last);
        for (auto at = last + 1; at < next; ++at) *at = *(at - 1) + step;
        last = next;
    }
}

}  // namespace

std::vector<Vec3> stroke_before_cloud(std::span<const Vec2> stroke, const View& view,
                                      std::span<const float> cloud,
                                      const CloudStrokeOptions& options, const Context& context) {
    require(options.radius > 0.0 && std::isfinite(options.radius),
            "the radius in which hair is seen must be pixels above 0");
    require(options.before >= 0.0 && options.before <= 1.0,
            "the share that may stand out in front must be from 0 to 1");
    for (const Vec2& p : stroke) {
        if (!p.allFinite())
            throw Error(ErrorCode::not_finite, "a point of the stroke is not finite");
    }
    std::vector<double> depths;
    for (auto& around : depths_around(stroke, view, cloud, options.radius, context)) {
        depths.push_back(front_of(around, options.before));
    }
    bridge(depths);
    return at_depths(stroke, depths, view);
}

}  // namespace lissom
