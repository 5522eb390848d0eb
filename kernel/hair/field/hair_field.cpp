#include "kernel/hair/field/hair_field.h"

#include <algorithm>
#include <array>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Against overshoot far from the constraints.
constexpr double kTension = 0.03;

GridSize size_of(const GridLayout& layout) {
    return {layout.counts[0], layout.counts[1], layout.counts[2]};
}

std::vector<float> gradients_of(std::span<const float> values, const GridLayout& layout,
                                const Context& context) {
    const auto [nx, ny, nz] = layout.counts;
    const std::array<Index, 3> counts{nx, ny, nz}, strides{1, nx, nx * ny};
    std::vector<float> gradients(4 * values.size(), 0.0f);
    context.parallel_for(0, ny * nz, 64, [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            for (Index x = 0; x < counts[0]; ++x) {
                const std::array<Index, 3> place{x, row % counts[1], row / counts[1]};
                const Index here = row * counts[0] + x;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const Index low = place[axis] > 0 ? 1 : 0,
                                high = place[axis] + 1 < counts[axis] ? 1 : 0;
                    const Index from = here - low * strides[axis], to = here + high * strides[axis];
                    gradients[4 * at(here) + axis] = (values[at(to)] - values[at(from)]) /
                                                     static_cast<float>((low + high) * layout.step);
                }
            }
        }
    });
    return gradients;
}

}  // namespace

GridFieldOptions HairField::default_options() {
    GridFieldOptions options;
    options.tension = kTension;
    return options;
}

HairField::HairField(DistanceGrid distances, const GridFieldOptions& options,
                     const Context& context)
    : HairField(std::move(distances), {}, options, context) {}

HairField::HairField(DistanceGrid distances, std::span<const float> collision,
                     const GridFieldOptions& options, const Context& context)
    : distances_(std::move(distances)), field_(size_of(layout()), options, context) {
    const std::size_t count = distances_.values().size();
    charge_ = context.charge(12 * count * sizeof(float), "the direction field of a hairstyle");
    const std::span<const float> kept_out = collision.empty() ? distances_.values() : collision;
    require(kept_out.size() == count, "the distances of a field must be one a grid point");
    gradients_ = gradients_of(kept_out, layout(), context);
    values_.assign(4 * count, 0.0f);
    for (std::size_t i = 0; i < count; ++i) values_[4 * i + 3] = kept_out[i];
    next_ = values_;
}

void HairField::set_constraints(ConstraintOwner owner, std::vector<GridConstraint> constraints) {
    field_.set_constraints(owner, std::move(constraints));
}

void HairField::clear_constraints() {
    field_.clear();
}

void HairField::solve(const Context& context, const FieldGravity& gravity) {
    if (!field_.solved()) stale_ = true;
    field_.solve(context);
    field_.evaluate(next_, context);
    add_gravity(next_, gradients_, layout(), gravity, context);
    values_.swap(next_);
    stale_ = false;
}

void HairField::put_back(std::vector<float> values) {
    values_ = std::move(values);
    stale_ = true;
}

bool HairField::contains(const Vec3& point) const {
    const Box box = layout().box();
    return (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
}

HairField::Sample HairField::sample(const Vec3& point) const {
    const GridLayout& grid = layout();
    const Vec3 at = (point - grid.origin) / grid.step;
    std::array<Index, 3> cell{};
    Vec3 t;
    for (int axis = 0; axis < 3; ++axis) {
        const double last = grid.counts[axis] - 1;
        const double place = std::clamp(at[axis], 0.0, last);
        cell[axis] = std::min(static_cast<Index>(place), grid.counts[axis] - 2);
        t[axis] = place - cell[axis];
    }
    Sample result;
    for (int corner = 0; corner < 8; ++corner) {
        std::array<double, 3> weight{}, gradient{};
        std::array<Index, 3> index{};
        for (int axis = 0; axis < 3; ++axis) {
            const int up = (corner >> axis) & 1;
            index[axis] = cell[axis] + up;
            weight[axis] = up ? t[axis] : 1.0 - t[axis];
            gradient[axis] = (up ? 1.0 : -1.0) / grid.step;
        }
        const float* v = values_.data() + 4 * grid.index(index[0], index[1], index[2]);
        const double distance = distances_.at(index[0], index[1], index[2]);
        const double w = weight[0] * weight[1] * weight[2];
        result.direction += w * Vec3(v[0], v[1], v[2]);
        result.distance += w * distance;
        result.gradient += distance * Vec3(gradient[0] * weight[1] * weight[2],
                                           weight[0] * gradient[1] * weight[2],
                                           weight[0] * weight[1] * gradient[2]);
    }
    return result;
}

}  // namespace lissom
