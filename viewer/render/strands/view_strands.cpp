#include "viewer/render/strands/view_strands.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

void require_range(bool condition, const char* message, ErrorCode code = ErrorCode::out_of_range) {
    if (!condition) throw Error(code, message);
}

bool is_share(double value) {
    return value >= 0.0 && value <= 1.0;
}

void require_lobe(const HairLobe& lobe) {
    require_range(lobe.strength >= 0.0 && lobe.strength <= 10.0,
                  "the strength of a reflection of hair must be 0 to 10");
    require_range(lobe.exponent >= 0.0 && lobe.exponent <= 1e4,
                  "the exponent of a reflection of hair must be 0 to 10000");
    require_range(std::abs(lobe.shift) <= kPi,
                  "the shift of a reflection of hair is at most half a turn");
}

void require_style(const StrandStyle& style) {
    require_range(style.level > 0.0 && style.level <= 1.0, "level must be above 0 and at most 1");
    require_range(!style.count || *style.count >= 1,
                  "the number of strands to draw must be at least 1");
    require_range(std::isfinite(style.unit) && style.unit > 0.0,
                  "the unit of the strands must be a positive number of metres",
                  ErrorCode::invalid_argument);
    require_lobe(style.primary);
    require_lobe(style.secondary);
    require_range(style.shift_jitter >= 0.0 && style.shift_jitter <= kPi,
                  "the jitter of reflections is at most half a turn");
    require_range(is_share(style.strand_tone) && is_share(style.clump_tone),
                  "tones of strands and clumps must be 0 to 1");
    require_range(std::isfinite(style.clump_size) && style.clump_size > 0.0,
                  "the size of clumps must be above 0");
    require_range(style.root_tone >= 0.0 && style.root_tone <= 10.0 && style.tip_tone >= 0.0 &&
                      style.tip_tone <= 10.0,
                  "tones of roots and tips must be 0 to 10");
    require_range(style.shadow >= 0.0 && style.shadow <= 100.0,
                  "the shadow of hair must be 0 to 100");
    require_range(is_share(style.scalp_tint), "the tint of the scalp must be 0 to 1");
}

Affine affine(const Mat4& view, const Vec3& origin) {
    Affine map;
    map.linear = view.topLeftCorner<3, 3>();
    map.translation = view.topRightCorner<3, 1>() - map.linear * origin;
    return map;
}

ViewStrands in_view(const DrawnStrands& drawn, const Affine& to_view) {
    require_style(drawn.style);
    const Affine map = to_view * drawn.transform;
    ViewStrands result;
    result.strands = drawn.strands.get();
    result.style = &drawn.style;
    result.count = drawn_count(drawn.style, drawn.strands->size());
    result.linear = (map.linear / drawn.style.unit).cast<float>();
    result.offset = map.translation.cast<float>();
    result.scale = std::cbrt(std::abs(result.linear.determinant()));
    if (result.count > 0) {
        result.stands_for = static_cast<float>(drawn.strands->size()) / result.count;
    }
    return result;
}

}  // namespace

Index drawn_count(const StrandStyle& style, Index size) {
    if (size == 0) return 0;
    if (style.count) return std::min(*style.count, size);
    const auto count = index_of(std::lround(style.level * size));
    return std::clamp(count, Index{1}, size);
}

std::vector<ViewStrands> view_strands(const Snapshot& snapshot, const Mat4& view,
                                      const Vec3& origin) {
    const Affine to_view = affine(view, origin);
    std::vector<ViewStrands> result;
    for (const DrawnStrands& drawn : snapshot.strands) result.push_back(in_view(drawn, to_view));
    return result;
}

std::vector<ViewTriangle> view_triangles(const Snapshot& snapshot, const Mat4& view,
                                         const Vec3& origin) {
    std::vector<ViewTriangle> result;
    for (const DrawnMesh& drawn : snapshot.meshes) {
        const Affine map = affine(view, origin) * drawn.transform;
        std::vector<Eigen::Vector3f> points;
        for (const Vec3& p : drawn.mesh->positions()) points.push_back(map(p).cast<float>());
        const auto faces = triangulate_faces(drawn.mesh->topology(), drawn.mesh->positions());
        for (const Triangle& t : faces.triangles) {
            const auto corner = [&](std::size_t i) { return points[t[i]]; };
            result.push_back({corner(0), corner(1), corner(2)});
        }
    }
    return result;
}

Eigen::Array3f strand_color(const ViewStrands& drawn, Index strand, Index point) {
    if (drawn.style->color) return linear(*drawn.style->color).cast<float>().array();
    if (const auto* colors = drawn.strands->colors()) return colors->at(strand, point).array();
    static const Eigen::Array3f usual = linear(kHairColor).cast<float>().array();
    return usual;
}

}  // namespace lissom
