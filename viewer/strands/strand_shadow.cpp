#include "viewer/strands/strand_shadow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/hair/strands/strand_random.h"
#include "viewer/draw/studio_light.h"

namespace lissom {
namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

// Metres between grid points, and how far the grid reaches beyond the hair.
constexpr float kStep = 0.0035f;
constexpr float kShadowMargin = 0.14f;
constexpr double kMostPoints = 2.5e6;
// Segments that are splatted; of more, every so many strands stand for all.
constexpr double kMostSegments = 3e6;
constexpr Index kChunks = 4;
// Light is scattered on by strands more than they take away: of the area that they cover, the part
// that counts as lost.
constexpr float kLostShare = 0.40f;
// However dense hair is, light fades over steps of the grid by no more than exp(-kMostDepth) each:
// what fades within one step shows the grid as bands, as on tied tails.
constexpr float kMostDepth = 0.8f;
// A mesh lets this little through: exp(-kMeshDepth). It counts so many steps below its surface,
// which so does not shade itself.
constexpr float kMeshDepth = 5.0f;
constexpr float kMeshSunk = 1.3f;
// Light is looked up this many steps nearer to the light: the grid blurs strands into the air.
constexpr float kTowardsLight = 0.9f;
// Roots per square metre from which hair hides the scalp; where it does, the shares of the usual
// density at which the scalp is bare and is covered.
constexpr float kFullRoots = 20e4f;
constexpr float kBareShare = 0.06f, kCoveredShare = 0.40f;

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

// Around the strands, and so much of the meshes as they may shade.
ViewGrid fit(std::span<const ViewStrands> strands, std::span<const ViewTriangle> triangles) {
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
    grid.step = std::max(grid.step, static_cast<float>(std::cbrt(volume / kMostPoints)));
    // A long thin box has more points on its surface than its volume tells.
    grid.step = std::max(grid.step, extent.maxCoeff() / 1000.0f);
    grid.origin = low;
    for (int axis = 0; axis < 3; ++axis) {
        grid.counts[axis] = static_cast<Index>(std::ceil(extent[axis] / grid.step)) + 1;
    }
    return grid;
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

std::vector<float> extinction_of(const ViewGrid& grid, std::span<const ViewStrands> strands,
                                 const Context& context) {
    std::vector<float> sum(grid.size(), 0.0f);
    for (const ViewStrands& drawn : strands) {
        const auto stride =
            static_cast<Index>(std::ceil(std::max(drawn.point_count() / kMostSegments, 1.0)));
        const Index grain = (drawn.count + kChunks - 1) / kChunks / stride * stride + stride;
        std::vector<std::vector<float>> parts(kChunks);
        context.parallel_for(0, drawn.count, grain, [&](Index begin, Index end) {
            std::vector<float>& part = parts[begin / grain];
            part.assign(grid.size(), 0.0f);
            splat_strands(grid, part, drawn, begin, end, stride);
        });
        for (const std::vector<float>& part : parts) {
            for (std::size_t i = 0; i < part.size(); ++i) sum[i] += part[i];
        }
    }
    const float most = kMostDepth / grid.step;
    for (float& extinction : sum) extinction = most * (1.0f - std::exp(-extinction / most));
    return sum;
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

// Roots around each grid point, and their sum times the tint that their style asks for.
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
            const Vector3f root = drawn.position(drawn.strands->first_point(s));
            splat(grid, density.roots, root, drawn.stands_for);
            splat(grid, density.tinted, root, drawn.stands_for * tint);
        }
    }
    return density;
}

// How far the scalp takes the colour of hair at each grid point, 0 to 1: where roots are nearly as
// dense as they are at most places, and not just few.
std::vector<float> scalp_tint(const ViewGrid& grid, std::span<const ViewStrands> strands) {
    const RootDensity density = root_density(grid, strands);
    std::vector<float> tint(grid.size(), 0.0f);
    double sum = 0.0, squares = 0.0;
    for (const float r : density.roots) {
        sum += r;
        squares += static_cast<double>(r) * r;
    }
    if (!(sum > 0.0)) return tint;
    const float usual = squares / sum;
    const float metres = grid.step / largest_scale(strands);
    const float strength = std::min(usual / (kFullRoots * metres * metres), 1.0f);
    for (std::size_t i = 0; i < tint.size(); ++i) {
        const float r = density.roots[i];
        if (!(r > 0.0f)) continue;
        const float t =
            std::clamp((r / usual - kBareShare) / (kCoveredShare - kBareShare), 0.0f, 1.0f);
        tint[i] = strength * density.tinted[i] / r * t * t * (3.0f - 2.0f * t);
    }
    return tint;
}

Array3f mean_color(std::span<const ViewStrands> strands) {
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

struct AmbientDirection {
    Vector3f direction;
    float weight;
};

// The corners of an icosahedron, turned a little out of the axes, with the light from each.
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

std::uint8_t to_byte(float share) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

// The cell of a position, its place in it, clamped to the grid.
struct Cell {
    std::array<Index, 3> corner;
    Vector3f share;
};

Cell cell_at(const ViewGrid& grid, const Vector3f& position) {
    Cell cell{};
    const Vector3f at = (position - grid.origin) / grid.step;
    for (int axis = 0; axis < 3; ++axis) {
        const Index last = grid.counts[axis] - 1;
        const float x = std::clamp(at[axis], 0.0f, static_cast<float>(last));
        const Index corner = std::min(static_cast<Index>(x), std::max(last - 1, Index{0}));
        cell.corner[axis] = corner;
        cell.share[axis] = x - corner;
    }
    return cell;
}

// Calls visit(grid point, weight) for the corners of the cell at `position` with a weight.
template <typename Visit>
void for_each_corner(const ViewGrid& grid, const Vector3f& position, const Visit& visit) {
    const Cell cell = cell_at(grid, position);
    for (int corner = 0; corner < 8; ++corner) {
        float weight = 1.0f;
        std::array<Index, 3> at = cell.corner;
        for (int axis = 0; axis < 3; ++axis) {
            const bool far = (corner >> axis & 1) != 0;
            weight *= far ? cell.share[axis] : 1.0f - cell.share[axis];
            if (far) ++at[axis];
        }
        if (weight > 0.0f) visit(grid.index(at[0], at[1], at[2]), weight);
    }
}

}  // namespace

void splat(const ViewGrid& grid, std::vector<float>& values, const Vector3f& position,
           float amount) {
    const Vector3f at = (position - grid.origin) / grid.step;
    for (int axis = 0; axis < 3; ++axis) {
        const float last = grid.counts[axis] - 1;
        if (!(at[axis] >= 0.0f && at[axis] <= last)) return;
    }
    for_each_corner(grid, position,
                    [&](std::size_t i, float weight) { values[i] += weight * amount; });
}

std::vector<float> light_through(const ViewGrid& grid, const std::vector<float>& extinction,
                                 const Vector3f& to_light) {
    const Vector3f d = to_light.normalized();
    int major = 0;
    d.cwiseAbs().maxCoeff(&major);
    const std::array<std::size_t, 3> axis{at(major), at((major + 1) % 3), at((major + 2) % 3)};
    const std::array<std::ptrdiff_t, 3> strides{
        1, grid.counts[0], static_cast<std::ptrdiff_t>(grid.counts[0]) * grid.counts[1]};
    const auto stride = [&](std::size_t i) { return strides[axis[i]]; };
    const auto count = [&](std::size_t i) { return grid.counts[axis[i]]; };
    const Index towards = d[major] > 0.0f ? 1 : -1;
    // One plane nearer to the light, the ray to it is so many cells aside.
    const float aside_u = d[index_of(axis[1])] / std::abs(d[major]);
    const float aside_v = d[index_of(axis[2])] / std::abs(d[major]);
    const auto cell_u = static_cast<Index>(std::floor(aside_u));
    const auto cell_v = static_cast<Index>(std::floor(aside_v));
    const float share_u = aside_u - cell_u;
    const float share_v = aside_v - cell_v;
    const std::array<float, 4> weights{(1 - share_u) * (1 - share_v), share_u * (1 - share_v),
                                       (1 - share_u) * share_v, share_u * share_v};
    const float half_way = 0.5f * grid.step / std::abs(d[major]);

    std::vector<float> light(grid.size(), 1.0f);
    const Index planes = count(0);
    for (Index n = 0; n < planes; ++n) {
        const Index plane = towards > 0 ? planes - 1 - n : n;
        for (Index v = 0; v < count(2); ++v) {
            for (Index u = 0; u < count(1); ++u) {
                const std::ptrdiff_t here = plane * stride(0) + u * stride(1) + v * stride(2);
                float arriving = n == 0 ? 1.0f : 0.0f;
                float passed = extinction[here];
                for (int corner = 0; n > 0 && corner < 4; ++corner) {
                    const Index cu = u + cell_u + (corner & 1), cv = v + cell_v + (corner >> 1);
                    const float weight = weights[corner];
                    if (cu < 0 || cv < 0 || cu >= count(1) || cv >= count(2)) {
                        arriving += weight;
                        continue;
                    }
                    const std::size_t there =
                        (plane + towards) * stride(0) + cu * stride(1) + cv * stride(2);
                    arriving += weight * light[there];
                    passed += weight * extinction[there];
                }
                if (passed > 0.0f) arriving *= std::exp(-half_way * passed);
                light[here] = arriving;
            }
        }
    }
    return light;
}

StrandShadow::StrandShadow(std::span<const ViewStrands> strands,
                           std::span<const ViewTriangle> triangles, const Context& context)
    : grid_(fit(strands, triangles)) {
    const std::size_t bytes_a_point = (6 + kChunks * 3) * sizeof(float);
    const MemoryCharge working = context.charge(grid_.size() * bytes_a_point, "shadows of strands");
    charge_ = context.charge(grid_.size() * (sizeof(Corner) + 4), "shadows of strands");
    Progress progress(context, "render: shadows of hair");
    progress.step(0.2);
    const std::vector<float> hair = extinction_of(grid_, strands, context);
    std::vector<float> everything = hair;
    for (const ViewTriangle& triangle : triangles) splat_triangle(grid_, everything, triangle);
    scalp_color_ = mean_color(strands);
    progress.step(0.8);
    compute(hair, everything, scalp_tint(grid_, strands), context);
}

void StrandShadow::compute(const std::vector<float>& hair, const std::vector<float>& everything,
                           const std::vector<float>& tint, const Context& context) {
    const std::vector<AmbientDirection> around = ambient_directions();
    const auto directions = count_of(around);
    const Index grain = directions / kChunks;
    std::vector<std::array<std::vector<float>, 2>> ambient(kChunks);
    std::array<std::vector<float>, 3> lights;
    Progress progress(context, "render: shadows of hair");
    context.parallel_for(0, 3, 1, [&](Index which, Index) {
        lights[which] = light_through(grid_, which == 2 ? hair : everything,
                                      which == 1 ? kRimLight.direction : kKeyLight.direction);
    });
    // Each chunk adds one direction at a time, so that progress can be told in between.
    for (Index round = 0; round < grain; ++round) {
        progress.update(round + 1, grain + 1);
        context.parallel_for(0, kChunks, 1, [&](Index chunk, Index) {
            const AmbientDirection& from = around[chunk * grain + round];
            for (std::size_t which = 0; which < 2; ++which) {
                std::vector<float>& sum = ambient[chunk][which];
                sum.resize(grid_.size(), 0.0f);
                const auto light =
                    light_through(grid_, which == 0 ? everything : hair, from.direction);
                for (std::size_t p = 0; p < light.size(); ++p) sum[p] += from.weight * light[p];
            }
        });
    }
    light_.resize(grid_.size());
    on_meshes_.resize(4 * grid_.size());
    for (std::size_t i = 0; i < grid_.size(); ++i) {
        std::array<float, 2> open{0.0f, 0.0f};
        for (const auto& part : ambient) {
            open[0] += part[0][i];
            open[1] += part[1][i];
        }
        light_[i] = {lights[0][i], lights[1][i], open[0], 0.0f};
        on_meshes_[4 * i] = to_byte(lights[2][i]);
        on_meshes_[4 * i + 1] = to_byte(open[1]);
        on_meshes_[4 * i + 2] = to_byte(tint[i]);
        on_meshes_[4 * i + 3] = 255;
    }
}

StrandLight StrandShadow::light(const Vector3f& position) const {
    static const Vector3f to_key = kKeyLight.direction.normalized();
    static const Vector3f to_rim = kRimLight.direction.normalized();
    StrandLight result{0.0f, 0.0f, 0.0f};
    const float nearer = kTowardsLight * grid_.step;
    for_each_corner(grid_, position + nearer * to_key,
                    [&](std::size_t i, float weight) { result.key += weight * light_[i][0]; });
    for_each_corner(grid_, position + nearer * to_rim,
                    [&](std::size_t i, float weight) { result.rim += weight * light_[i][1]; });
    for_each_corner(grid_, position,
                    [&](std::size_t i, float weight) { result.ambient += weight * light_[i][2]; });
    return result;
}

}  // namespace lissom
