#include "kernel/io/skin_baker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/gltf/skin.h"

namespace lissom {
namespace {

// Sets of four, as glTF has them.
Index padded_influences(Index influences) {
    return (influences + 3) / 4 * 4;
}

std::vector<Vec3> points_of(const Mesh& mesh, const Region& region) {
    std::vector<Vec3> points;
    for (const Index v : region.vertices()) points.push_back(mesh.position(v));
    return points;
}

// Vertices that do not move follow joint 0.
void set_skin(Mesh& mesh, const Region& moving, const SkinFit& fit) {
    const Index width = padded_influences(fit.influences);
    Attribute joints{"joints", Domain::vertex, width, ScalarType::uint16, {}};
    Attribute weights{"weights", Domain::vertex, width, ScalarType::float32, {}};
    joints.values.assign(at(mesh.vertex_count()) * at(width), 0.0);
    weights.values = joints.values;
    for (Index v = 0; v < mesh.vertex_count(); ++v) weights.values[at(v) * at(width)] = 1.0;
    Index row = 0;
    for (const Index v : moving.vertices()) {
        for (Index k = 0; k < fit.influences; ++k) {
            const std::size_t from = at(row) * at(fit.influences) + at(k);
            const std::size_t to = at(v) * at(width) + at(k);
            joints.values[to] = fit.joints[from];
            weights.values[to] = fit.weights[from];
        }
        ++row;
    }
    for (const char* name : {"joints", "weights"}) {
        if (mesh.attributes().find(name)) mesh.attributes().remove(name);
    }
    mesh.attributes().add(std::move(joints));
    mesh.attributes().add(std::move(weights));
}

}  // namespace

SkinBaker::SkinBaker(const Mesh& rest, const Region& moving, SkinOptions options, Context context)
    : rest_(rest), moving_(moving), options_(options), context_(std::move(context)) {
    require_same_topology(rest, moving.topology(), "the region");
    if (rest.face_count() == 0) {
        throw Error(ErrorCode::unsupported, "a mesh without faces cannot be skinned");
    }
}

void SkinBaker::add(double time, const Mesh& shape) {
    context_.checkpoint();
    require_same_topology(shape, rest_.shared_topology(), "the skin");
    const auto narrow = static_cast<float>(time);
    const bool follows = times_.empty() || narrow > times_.back();
    if (!std::isfinite(narrow) || narrow < 0.0f || !follows) {
        throw Error(ErrorCode::invalid_argument,
                    "shape " + std::to_string(times_.size() + 1) + " is at " +
                        std::to_string(time) +
                        " s; times must be finite, not negative and ascending");
    }
    charges_.push_back(context_.charge(at(moving_.size()) * sizeof(Vec3), "a shape for a skin"));
    poses_.push_back(points_of(shape, moving_));
    times_.push_back(narrow);
}

SkinnedMesh SkinBaker::finish(const std::string& name) const {
    const bool still = moving_.size() < rest_.vertex_count();
    const SkinFit fit = fit_skin(points_of(rest_, moving_), poses_, still, options_, context_);
    SkinnedMesh result{rest_, count_of(fit.centers), fit.max_error, fit.rms_error};
    set_skin(result.mesh, moving_, fit);
    result.mesh.set_asset(
        with_skin(result.mesh,
                  {name, fit.centers, name.empty() ? std::vector<float>() : times_, fit.motions}));
    return result;
}

}  // namespace lissom
