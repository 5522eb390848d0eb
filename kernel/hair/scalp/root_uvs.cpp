#include "kernel/hair/scalp/root_uvs.h"

#include <algorithm>

namespace lissom {
namespace {

Eigen::Vector2f direction_uv(const Scalp& scalp, const Root& root) {
    const ScalpDirection at = scalp.direction_of(root.position);
    return Vec2(0.5 + at.azimuth / (2.0 * kPi), 0.5 + at.elevation / kPi).cast<float>();
}

// The value at a corner of `face`, which lies at `vertex`.
Vec2 uv_at(const Mesh& head, const Attribute& uv, Index face, Index vertex) {
    Index element = vertex;
    if (uv.domain == Domain::corner) {
        const auto corners = head.topology().face(face);
        const auto found = std::find(corners.begin(), corners.end(), vertex);
        element = head.topology().first_corner(face) + index_of(found - corners.begin());
    }
    return {uv.at(element)[0], uv.at(element)[1]};
}

Eigen::Vector2f textured_uv(const Mesh& head, const Attribute& uv, const Root& root) {
    Vec2 sum = Vec2::Zero();
    for (int k = 0; k < 3; ++k) {
        sum += root.barycentric[k] * uv_at(head, uv, root.face, root.triangle[k]);
    }
    return sum.cast<float>();
}

}  // namespace

std::vector<Eigen::Vector2f> root_uvs(const Mesh& head, const Scalp& scalp,
                                      std::span<const Root> roots) {
    const Attribute* uv = head.attributes().find("uv");
    const bool textured = uv && uv->domain != Domain::face && uv->width == 2;
    std::vector<Eigen::Vector2f> result;
    for (const Root& root : roots) {
        result.push_back(textured ? textured_uv(head, *uv, root) : direction_uv(scalp, root));
    }
    return result;
}

}  // namespace lissom
