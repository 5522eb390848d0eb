#include "kernel/merge/paste/part/moving_part.h"

#include <algorithm>
#include <utility>

#include "kernel/merge/turned.h"

namespace lissom {
namespace {

Region whole_part(const PastePart& part) {
    return Region::all(part.mesh.shared_topology());
}

}  // namespace

MovingPart::MovingPart(PastePart part, const BoundaryDeformOptions& options, const Context& context)
    : part_(std::move(part)),
      deformer_(part_.mesh, whole_part(part_), Region(part_.mesh.shared_topology(), part_.loop),
                options, context) {
    const std::vector<Index>& ids = deformer_.held().vertices();
    for (const Index v : part_.loop) {
        held_.push_back(at(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()));
    }
}

MovedPart MovingPart::moved(std::span<const BoundaryValue> values, const Context& context) {
    std::vector<BoundaryValue> ordered(values.size());
    for (std::size_t k = 0; k < held_.size(); ++k) ordered[held_[k]] = values[k];
    return moved_by(deformer_.solve(ordered, context));
}

MovedPart MovingPart::refined(int steps, const Context& context) {
    return moved_by(deformer_.refine(steps, context));
}

MovedPart MovingPart::moved_by(const BoundaryDeformation& deformed) const {
    MovedPart result{part_.mesh, deformer_.stats(), {}};
    for (const std::size_t place : held_) result.pulls.push_back(deformed.pulls[place]);
    std::vector<Vec3> positions(part_.mesh.positions().begin(), part_.mesh.positions().end());
    const std::vector<Index>& ids = deformer_.region().vertices();
    for (std::size_t row = 0; row < ids.size(); ++row) {
        positions[at(ids[row])] = deformed.positions[row];
    }
    result.mesh.set_positions(std::move(positions));
    turn_directions(part_.mesh, deformer_.region(), deformed, result.mesh);
    return result;
}

std::shared_ptr<MovingPart> MovingParts::inside(Boundary kind, std::span<const Index> loop,
                                                const Make& make,
                                                const BoundaryDeformOptions& options,
                                                const Context& context) {
    Kept& kept = kept_[static_cast<std::size_t>(kind)];
    if (!kept.part || !std::equal(loop.begin(), loop.end(), kept.loop.begin(), kept.loop.end())) {
        auto part = std::make_shared<MovingPart>(make(), options, context);
        kept = {{loop.begin(), loop.end()}, {}, std::move(part)};
    }
    return kept.part;
}

std::shared_ptr<MovingPart> MovingParts::inside(Boundary kind, std::span<const Vec2> line,
                                                const Make& make,
                                                const BoundaryDeformOptions& options,
                                                const Context& context) {
    Kept& kept = kept_[static_cast<std::size_t>(kind)];
    if (!kept.part || !std::equal(line.begin(), line.end(), kept.line.begin(), kept.line.end())) {
        auto part = std::make_shared<MovingPart>(make(), options, context);
        kept = {{}, {line.begin(), line.end()}, std::move(part)};
    }
    return kept.part;
}

}  // namespace lissom
