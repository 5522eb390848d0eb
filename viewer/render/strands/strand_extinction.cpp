#include "viewer/render/strands/strand_extinction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/hair/strands/strand_random.h"
#include "viewer/render/draw/studio_light.h"

namespace lissom {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

// Metres between grid points, and how far the grid reaches beyond the hair.
constexpr float kStep = 0.0035f;
constexpr float kShadowMargin = 0.14f;
// Light is scattered on by strands more than they take away: of the area that they cover, the part
// that counts as lost.
constexpr float kLostShare = 0.40f;
// In hair of any density light fades by no more than exp(-kMaxDepth) a step of the grid: stronger
// fading shows the grid as bands, as on tied tails.
constexpr float kMaxDepth = 0.8f;
// A mesh lets this little through: exp(-kMeshDepth), next to nothing also for light hair, which
// sees low powers of it. It counts so many steps below its surface, which so does not shade itself.
constexpr float kMeshDepth = 12.0f;
constexpr float kMeshSunk = 1.3f;
// Metres of width that roots have on a square metre from which hair hides the scalp: few wide
// strands stand for many thin ones. Then the fractions of the usual density at which the scalp is
// bare and is covered: at the outline of the roots half of it.
constexpr float kFullWidths = 55.0f;
constexpr float kBareShare = 0.05f, kCoveredShare = 1.0f;
// Width in metres of the means that smooth the density of roots, three along each axis: about a
// Gaussian of 8 millimetres. Without them the places of the scalp between grid points show as
// rings.
constexpr float kRootMean = 0.0165f;
constexpr int kRootMeans = 3;

struct Bounds {
    Vector3f low = Vector3f::Constant(std::numeric_limits<float>::infinity());
    Vector3f high = -low;

    void extend(const Vector3f& p) {
        if (!p.allFinite()) return;
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    bool empty() const { return (low.array() > high.array()).any(); }
};

float largest_scale(std::span<const ViewStrands> strands) {
    float scale = 0.0f;
    for (const ViewStrands& drawn : strands) scale = std::max(scale, drawn.scale);
    return scale > 0.0f && std::isfinite(scale) ? scale : 1.0f;
}

float random_share(std::uint64_t bits) {
    return static_cast<float>(0.5 + 0.5 * signed_random(bits));
}

// One segment, at one random place of every step of its length: strands whose points lie alike
// would else leave bands.
void splat_segment(const ViewGrid& grid, std::vector<float>& values, const Vector3f& a,
                   const Vector3f& b, float area_of_length, std::uint64_t number) {
    const float length = (b - a).norm();
    if (!(length > 0.0f) || !std::isfinite(length)) return;
    const int parts = static_cast<int>(std::min(std::ceil(length / grid.step), 256.0f));
    const float volume = grid.step * grid.step * grid.step;
    const float amount = length / parts * area_of_length / volume;
    for (int part = 0; part < parts; ++part) {
        const float jitter = random_share(mixed(number + part));
        const float t = (part + jitter) / parts;
        splat(grid, values, a + t * (b - a), amount);
    }
}

// Adds the extinction of the strands [first, last), of which every `stride`-th is looked at.
void splat_strands(const ViewGrid& grid, std::vector<float>& values, const ViewStrands& drawn,
                   Index first, Index last, Index stride) {
    const Strands& strands = *drawn.strands;
    const float lost = kLostShare * static_cast<float>(drawn.style->shadow) * drawn.stands_for *
                       drawn.scale * stride;
    for (Index s = first; s < last; s += stride) {
        Vector3f before = drawn.position(strands.first_point(s));
        for (Index p = strands.first_point(s) + 1; p < strands.offsets()[at(s) + 1]; ++p) {
            const Vector3f here = drawn.position(p);
            const float width =
                strands.widths().at(s, p) * (1.0f - strands.transparency().at(s, p));
            if (width > 0.0f) {
                splat_segment(grid, values, before, here, lost * width,
                              static_cast<std::uint64_t>(p) << 10);
            }
            before = here;
        }
    }
}

// Meshes as a layer below their surface that lets hardly any light through.
void splat_triangle(const ViewGrid& grid, std::vector<float>& values,
                    const ViewTriangle& triangle) {
    const Vector3f u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
    const Vector3f normal = u.cross(v);
    const float twice_area = normal.norm();
    if (!(twice_area > 0.0f) || !std::isfinite(twice_area)) return;
    const float longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int n =
        static_cast<int>(std::clamp(std::ceil(longest / (0.7f * grid.step)), 1.0f, 400.0f));
    const float part = 0.5f * twice_area / (n * n);
    const float amount = kMeshDepth * part / (grid.step * grid.step * grid.step);
    const Vector3f base = triangle[0] - kMeshSunk * grid.step / twice_area * normal;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * (n - i) - 1; ++j) {
            const int pair = j / 2;
            const float third = (j & 1) ? 2.0f / 3.0f : 1.0f / 3.0f;
            const float a = (i + third) / n;
            const float b = (pair + third) / n;
            splat(grid, values, base + a * u + b * v, amount);
        }
    }
}

// Widths of the roots around each grid point in metres, and their sum times the tint that their
// style asks for.
struct RootDensity {
    std::vector<float> roots, tinted;
};

RootDensity root_density(const ViewGrid& grid, std::span<const ViewStrands> strands) {
    RootDensity density{std::vector<float>(grid.size(), 0.0f),
                        std::vector<float>(grid.size(), 0.0f)};
    for (const ViewStrands& drawn : strands) {
        const float tint = drawn.style->scalp_tint;
        for (Index s = 0; s < drawn.count; ++s) {
            if (drawn.strands->point_count(s) < 2) continue;
            const Index first = drawn.strands->first_point(s);
            const Vector3f root = drawn.position(first);
            const float width = drawn.stands_for * drawn.strands->widths().at(s, first);
            splat(grid, density.roots, root, width);
            splat(grid, density.tinted, root, width * tint);
        }
    }
    return density;
}

// The density around a root, in the mean; 0 without roots.
float usual_density(const std::vector<float>& roots) {
    double sum = 0.0, squares = 0.0;
    for (const float r : roots) {
        sum += r;
        squares += static_cast<double>(r) * r;
    }
    return sum > 0.0 ? static_cast<float>(squares / sum) : 0.0f;
}

// Means over `width` values, an odd number, along a line of a grid; 0 beyond its ends.
void mean_along(float* line, Index count, std::size_t step, Index width, std::vector<float>& copy) {
    copy.assign(at(count + width), 0.0f);
    for (Index i = 0; i < count; ++i) copy[at(i)] = line[at(i) * step];
    const Index half = width / 2;
    double sum = 0.0;
    for (Index i = 0; i < half; ++i) sum += copy[at(i)];
    for (Index i = 0; i < count; ++i) {
        sum += copy[at(i + half)];
        if (i > half) sum -= copy[at(i - half - 1)];
        line[at(i) * step] = static_cast<float>(std::max(sum / width, 0.0));
    }
}

void smooth_roots(const ViewGrid& grid, std::vector<float>& values, float metres) {
    const auto half = static_cast<Index>(std::lround(0.5f * (kRootMean / metres - 1.0f)));
    if (half < 1) return;
    const std::size_t nx = at(grid.counts[0]);
    const std::array<std::size_t, 3> steps{1, nx, nx * at(grid.counts[1])};
    std::vector<float> copy;
    for (int pass = 0; pass < kRootMeans; ++pass) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
            for (Index j = 0; j < grid.counts[v]; ++j) {
                for (Index i = 0; i < grid.counts[u]; ++i) {
                    float* const line = values.data() + at(i) * steps[u] + at(j) * steps[v];
                    mean_along(line, grid.counts[axis], steps[axis], 2 * half + 1, copy);
                }
            }
        }
    }
}

}  // namespace

ViewGrid fit_grid(std::span<const ViewStrands> strands, std::span<const ViewTriangle> triangles,
                  const LightDetail& detail) {
    Bounds hair, everything;
    for (const ViewStrands& drawn : strands) {
        for (Index p = 0; p < drawn.point_count(); ++p) hair.extend(drawn.position(p));
    }
    if (hair.empty()) return {};
    everything = hair;
    for (const ViewTriangle& triangle : triangles) {
        for (const Vector3f& p : triangle) everything.extend(p);
    }
    const float scale = largest_scale(strands), room = kShadowMargin * scale;
    ViewGrid grid;
    grid.step = kStep * scale;
    const Vector3f low = (hair.low.array() - room).max(everything.low.array() - 2 * grid.step);
    const Vector3f high = (hair.high.array() + room).min(everything.high.array() + 2 * grid.step);
    const Vector3f extent = (high - low).cwiseMax(1e-30f);
    const double volume = extent.cast<double>().prod();
    grid.step = std::max(grid.step, static_cast<float>(std::cbrt(volume / detail.max_points)));
    // A long thin box has more points on its surface than its volume tells.
    grid.step = std::max(grid.step, extent.maxCoeff() / 1000.0f);
    grid.origin = low;
    for (int axis = 0; axis < 3; ++axis) {
        grid.counts[axis] = static_cast<Index>(std::ceil(extent[axis] / grid.step)) + 1;
    }
    return grid;
}

std::vector<float> hair_extinction(const ViewGrid& grid, std::span<const ViewStrands> strands,
                                   const LightDetail& detail, const Context& context) {
    std::vector<float> sum(grid.size(), 0.0f);
    for (const ViewStrands& drawn : strands) {
        const auto stride =
            static_cast<Index>(std::ceil(std::max(drawn.point_count() / detail.max_segments, 1.0)));
        const Index grain =
            (drawn.count + kExtinctionParts - 1) / kExtinctionParts / stride * stride + stride;
        std::vector<std::vector<float>> parts(kExtinctionParts);
        context.parallel_for(0, drawn.count, grain, [&](Index begin, Index end) {
            std::vector<float>& part = parts[begin / grain];
            part.assign(grid.size(), 0.0f);
            splat_strands(grid, part, drawn, begin, end, stride);
        });
        for (const std::vector<float>& part : parts) {
            for (std::size_t i = 0; i < part.size(); ++i) sum[i] += part[i];
        }
    }
    const float most = kMaxDepth / grid.step;
    for (float& extinction : sum) extinction = most * (1.0f - std::exp(-extinction / most));
    return sum;
}

void add_mesh_extinction(const ViewGrid& grid, std::vector<float>& extinction,
                         std::span<const ViewTriangle> triangles) {
    for (const ViewTriangle& triangle : triangles) splat_triangle(grid, extinction, triangle);
}

std::vector<float> scalp_tint(const ViewGrid& grid, std::span<const ViewStrands> strands) {
    RootDensity density = root_density(grid, strands);
    std::vector<float> tint(grid.size(), 0.0f);
    const float dense = usual_density(density.roots);
    if (!(dense > 0.0f)) return tint;
    const float metres = grid.step / largest_scale(strands);
    const float strength = std::min(dense / (kFullWidths * metres * metres), 1.0f);
    smooth_roots(grid, density.roots, metres);
    smooth_roots(grid, density.tinted, metres);
    const float usual = usual_density(density.roots);
    for (std::size_t i = 0; i < tint.size(); ++i) {
        const float r = density.roots[i];
        if (!(r > 0.0f)) continue;
        const float t =
            std::clamp((r / usual - kBareShare) / (kCoveredShare - kBareShare), 0.0f, 1.0f);
        tint[i] = strength * density.tinted[i] / r * t * t * (3.0f - 2.0f * t);
    }
    return tint;
}

Eigen::Array3f mean_root_color(std::span<const ViewStrands> strands) {
    Array3f sum = Array3f::Zero();
    float count = 0.0f;
    for (const ViewStrands& drawn : strands) {
        const Index stride = std::max(drawn.count / 1000, Index{1});
        for (Index s = 0; s < drawn.count; s += stride) {
            sum += strand_color(drawn, s, drawn.strands->first_point(s)) *
                   static_cast<float>(drawn.style->root_tone);
            ++count;
        }
    }
    return count > 0.0f ? Array3f(sum / count) : sum;
}

std::vector<AmbientDirection> ambient_directions() {
    const float golden = 0.5f * (1.0f + std::sqrt(5.0f));
    std::vector<AmbientDirection> result;
    float sum = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
            Vector3f d = Vector3f::Zero();
            d[axis] = corner & 1 ? 1.0f : -1.0f;
            d[(axis + 1) % 3] = corner & 2 ? golden : -golden;
            const float up = 0.5f + 0.5f * d.normalized().y();
            const float weight = kGroundLight.mean() + up * (kSkyLight - kGroundLight).mean();
            result.push_back({d, weight});
            sum += weight;
        }
    }
    for (AmbientDirection& ambient : result) ambient.weight /= sum;
    return result;
}

}  // namespace lissom
