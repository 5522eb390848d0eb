#include "viewer/window/session/unlike_sizes.h"

#include <cmath>
#include <cstdio>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom::window {
namespace {

// An object smaller by more than this is a few pixels wide while the other fills the window.
constexpr double kHardlySeen = 100.0;

double size_of(const DrawnMesh& drawn) {
    Box box;
    for (const Vec3& p : drawn.mesh->positions()) {
        if (p.allFinite()) box.extend(drawn.transform(p));
    }
    return box.empty() ? 0.0 : box.diagonal();
}

// Two digits are enough to say how many times.
double rounded(double times) {
    const double step = std::pow(10.0, std::floor(std::log10(times)) - 1.0);
    return step * std::round(times / step);
}

std::string text_of(double times) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", rounded(times));
    return text;
}

}  // namespace

std::string unlike_sizes(std::span<const DrawnMesh> meshes, std::span<const std::string> names) {
    std::size_t small = 0, large = 0;
    std::vector<double> sizes;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        sizes.push_back(size_of(meshes[i]));
        if (!(sizes[i] > 0.0)) continue;
        if (!(sizes[small] > 0.0) || sizes[i] < sizes[small]) small = i;
        if (sizes[i] > sizes[large]) large = i;
    }
    if (sizes.empty() || !(sizes[large] > kHardlySeen * sizes[small])) return "";
    if (!(sizes[small] > 0.0)) return "";
    const std::string times = text_of(sizes[large] / sizes[small]);
    return names[large] + " is " + times + " times as large as " + names[small] +
           ", which is hardly seen beside it: they may be in different units; the tool transform "
           "scales, and so does lissom.load(path, { unit = ... })";
}

}  // namespace lissom::window
