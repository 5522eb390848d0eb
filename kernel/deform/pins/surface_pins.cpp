#include "kernel/deform/pins/surface_pins.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/frame/displaced_frame.h"
#include "kernel/mesh/topology.h"

namespace lissom {
namespace {

constexpr std::size_t kMostPins = 512;
// Fits of the rotations to the displaced surface.
constexpr int kPinFits = 4;
// Newton steps of the forces, in which the normals of spheres turn.
constexpr int kPinSteps = 30;
// Places as near as this, in parts of the surface's size, are reached.
constexpr double kReached = 1e-9;
// Coordinates beyond this have no squares.
constexpr double kFarthestPlace = 1e100;
// Added to the compliance, as a part of its mean: pins of vertices that move alike contradict each
// other otherwise.
constexpr double kPinSoftness = 1e-12;
// Pins as near to their place as this, in radii of the surface, hold by themselves.
constexpr double kOnPlace = 1e-12;

[[noreturn]] void refuse_pin(ErrorCode code, const char* message, Index vertex) {
    Elements pinned{ElementKind::vertex, 1, {vertex}};
    const std::string text = "the pin of " + describe(pinned) + " " + message;
    throw Error(code, text, std::move(pinned));
}

bool is_near_enough(const SlidingPin& pin) {
    return pin.point.cwiseAbs().maxCoeff() <= kFarthestPlace && pin.radius <= kFarthestPlace;
}

void require_pins(const Deformer& deformer, std::span<const SlidingPin> pins) {
    require(pins.size() <= kMostPins, "there are more than 512 pins: hold regions by handles");
    std::set<Index> seen;
    for (const SlidingPin& pin : pins) {
        require_vertices(*deformer.region().topology(), std::vector<Index>{pin.vertex});
        require(pin.point.allFinite() && pin.direction.allFinite() && std::isfinite(pin.radius),
                "the place of a pin is not finite", ErrorCode::not_finite);
        require(is_near_enough(pin), "the place of a pin lies beyond 1e100", ErrorCode::not_finite);
        require(pin.on == PinPlace::sphere || pin.direction.norm() > 0.0,
                "the plane or line of a pin has a direction without length");
        require(pin.on != PinPlace::sphere || pin.radius > 0.0,
                "the distance of a pin from its point is above 0");
        if (!deformer.region().contains(pin.vertex)) {
            refuse_pin(ErrorCode::handle_outside_region,
                       "lies outside the region; pin one of the region's vertices", pin.vertex);
        }
        if (!seen.insert(pin.vertex).second) {
            refuse_pin(ErrorCode::handle_overlap, "is given twice; a vertex has one place",
                       pin.vertex);
        }
    }
}

// The place of a pin near a point: unit directions in which it holds, and their distances to go.
struct PinRows {
    int count = 0;
    Vec3 way[2] = {Vec3::Zero(), Vec3::Zero()};
    double asked[2] = {0.0, 0.0};
};

// `from` shows the side of a sphere.
PinRows rows_at(const SlidingPin& pin, const Vec3& place, const Vec3& from) {
    const Vec3 off = place - pin.point;
    PinRows rows;
    if (pin.on == PinPlace::line) {
        const Vec3 along = pin.direction.normalized();
        rows.count = 2;
        rows.way[0] = along.unitOrthogonal();
        rows.way[1] = along.cross(rows.way[0]);
        for (int k = 0; k < 2; ++k) rows.asked[k] = -off.dot(rows.way[k]);
        return rows;
    }
    rows.count = 1;
    if (pin.on == PinPlace::plane) {
        rows.way[0] = pin.direction.normalized();
        rows.asked[0] = -off.dot(rows.way[0]);
    } else {
        const Vec3 out = from - pin.point;
        // From the centre itself any way out is as good.
        rows.way[0] = out.norm() > 0.0 ? out.normalized() : Vec3(Vec3::UnitY());
        rows.asked[0] = pin.radius - off.dot(rows.way[0]);
    }
    return rows;
}

double distance_to(const SlidingPin& pin, const Vec3& place) {
    const PinRows rows = rows_at(pin, place, place);
    return std::hypot(rows.asked[0], rows.count > 1 ? rows.asked[1] : 0.0);
}

// The forces of the pins of one frame.
class PinForces {
  public:
    PinForces(const Preparation& prepared, const DeformFrame& frame,
              std::span<const SlidingPin> pins, const Context& context)
        : displaced_(prepared, frame, context), pins_(pins), origin_(prepared.patch().origin) {
        for (const SlidingPin& pin : pins) {
            const Index v = displaced_.free_vertex(pin.vertex);
            if (v == kNoIndex) {
                refuse_pin(ErrorCode::handle_overlap,
                           "is held by a handle or a constraint; release it, or leave the pin out",
                           pin.vertex);
            }
            vertices_.push_back(v);
        }
        charge_ = context.charge(vertices_.size() * displaced_.turned().size() * sizeof(double),
                                 "pins that slide");
        find_answers(context);
    }

    // Moves the frame so that pins lie on their places; returns the greatest distance left.
    double hold(DeformFrame& frame, const Context& context) {
        for (int fits = 0;; ++fits) {
            find_forces();
            add_answers();
            if (fits == kPinFits) break;
            displaced_.turn(context);
        }
        displaced_.displace(frame);
        double off = 0.0;
        for (std::size_t i = 0; i < pins_.size(); ++i) {
            off = std::max(off, distance_to(pins_[i], place(i, displaced_.displacement())));
        }
        return off;
    }

  private:
    Vec3 place(std::size_t pin, std::span<const Vec4> moved) const {
        const std::size_t v = at(vertices_[pin]);
        return origin_ + (displaced_.shape()[v] + moved[v]).head<3>();
    }

    // Coordinates answer alike and apart from each other: three pins at a time, as coordinates.
    void find_answers(const Context& context) {
        const std::size_t free = displaced_.system().free_vertices().size();
        std::vector<Vec4> x;
        for (std::size_t first = 0; first < vertices_.size(); first += 3) {
            context.checkpoint();
            const std::size_t columns = std::min<std::size_t>(3, vertices_.size() - first);
            std::vector<Vec3> force(free, Vec3::Zero());
            for (std::size_t k = 0; k < columns; ++k) {
                force[at(displaced_.free_row(vertices_[first + k]))][index_of(k)] = 1.0;
            }
            x.assign(displaced_.displacement().size(), Vec4::Zero());
            displaced_.answer(force, x, context);
            for (std::size_t k = 0; k < columns; ++k) {
                std::vector<double>& answer = answers_.emplace_back();
                for (const Vec4& row : x) answer.push_back(row[index_of(k)]);
            }
        }
        forces_.assign(vertices_.size(), Vec3::Zero());
    }

    // Forces with normals of spheres towards the place of a pin without its own force, which is
    // stable for small spheres; or, if many pins lie close together, with those at its place.
    void find_forces() {
        double least = find_forces(true);
        if (least <= kReached * size()) return;
        const std::vector<Vec3> found = forces_;
        if (find_forces(false) > least) forces_ = found;
    }

    // Newton's method: in each step the forces along the present normals that bring all pins to
    // their places, as far as these are planes there. Returns the greatest distance left.
    double find_forces(bool without_own) {
        std::vector<Vec3> moved(vertices_.size());
        forces_.assign(vertices_.size(), Vec3::Zero());
        for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = place(i, displaced_.turned());
        const std::vector<Vec3> start = moved;
        for (int step = 0; step < kPinSteps; ++step) {
            find_forces_along(rows_of(moved, without_own), start);
            double change = 0.0;
            for (std::size_t i = 0; i < moved.size(); ++i) {
                const Vec3 next = start[i] + pushed(i);
                change = std::max(change, (next - moved[i]).norm());
                moved[i] = next;
            }
            if (change <= 1e-15 * size()) break;
        }
        double off = 0.0;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            off = std::max(off, distance_to(pins_[i], moved[i]));
        }
        return off;
    }

    // Greatest distance of a pin from the origin of the patch.
    double size() const {
        double size = 0.0;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            size = std::max(size, (place(i, displaced_.turned()) - origin_).norm());
        }
        return size;
    }

    std::vector<PinRows> rows_of(const std::vector<Vec3>& places, bool without_own) const {
        std::vector<PinRows> rows;
        for (std::size_t i = 0; i < places.size(); ++i) {
            Vec3 from = places[i];
            if (without_own) from -= answers_[i][at(vertices_[i])] * forces_[i];
            rows.push_back(rows_at(pins_[i], places[i], from));
            // From `start`: what is asked is counted from the present place.
            for (int k = 0; k < rows[i].count; ++k) {
                rows[i].asked[k] += rows[i].way[k].dot(places[i]);
            }
        }
        return rows;
    }

    void find_forces_along(const std::vector<PinRows>& rows, const std::vector<Vec3>& start) {
        std::vector<std::pair<std::size_t, int>> unknowns;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (int k = 0; k < rows[i].count; ++k) unknowns.emplace_back(i, k);
        }
        const auto count = index_of(unknowns.size());
        Eigen::MatrixXd compliance(count, count);
        Eigen::VectorXd asked(count);
        for (Index r = 0; r < count; ++r) {
            const auto& [i, k] = unknowns[at(r)];
            const Vec3& way = rows[i].way[k];
            asked[r] = rows[i].asked[k] - way.dot(start[i]);
            for (Index s = 0; s < count; ++s) {
                const auto& [j, l] = unknowns[at(s)];
                compliance(r, s) = way.dot(rows[j].way[l]) * answers_[j][at(vertices_[i])];
            }
        }
        compliance = (0.5 * (compliance + compliance.transpose())).eval();
        compliance.diagonal().array() += kPinSoftness * compliance.diagonal().mean();
        const Eigen::VectorXd force = compliance.ldlt().solve(asked);
        forces_.assign(rows.size(), Vec3::Zero());
        for (Index r = 0; r < count; ++r) {
            const auto& [i, k] = unknowns[at(r)];
            forces_[i] += force[r] * rows[i].way[k];
        }
    }

    // The displacement of a pin by all forces.
    Vec3 pushed(std::size_t pin) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t j = 0; j < forces_.size(); ++j) {
            sum += answers_[j][at(vertices_[pin])] * forces_[j];
        }
        return sum;
    }

    void add_answers() {
        std::vector<Vec4>& u = displaced_.displacement();
        u.assign(displaced_.turned().begin(), displaced_.turned().end());
        for (std::size_t j = 0; j < forces_.size(); ++j) {
            const Vec4 push = padded(forces_[j]);
            for (std::size_t v = 0; v < u.size(); ++v) u[v] += answers_[j][v] * push;
        }
    }

    DisplacedFrame displaced_;
    std::span<const SlidingPin> pins_;
    Vec3 origin_;
    std::vector<Index> vertices_;
    MemoryCharge charge_;
    // Displacement of all local vertices by a unit force on each pin, along the force.
    std::vector<std::vector<double>> answers_;
    std::vector<Vec3> forces_;
};

// A frame at rest has neither a preparation nor the vertices that it inserts.
DeformFrame prepared_rest(const std::shared_ptr<const Preparation>& prepared, DeformFrame frame) {
    const Patch& patch = prepared->patch();
    const Index own = prepared->rest->region().size();
    frame.preparation = prepared;
    frame.patch = prepared->work;
    frame.inserted.clear();
    for (Index v = 0; v < patch.real_count; ++v) {
        const Index row = prepared->rest->frame_row(patch, v);
        if (row < own) continue;
        frame.inserted.resize(std::max(frame.inserted.size(), at(row - own + 1)));
        frame.inserted[at(row - own)] = patch.rest[at(v)] + patch.origin;
    }
    return frame;
}

}  // namespace

double solve_with_pins(Deformer& deformer, std::span<const SlidingPin> pins, const Context& given) {
    require_pins(deformer, pins);
    auto& state = DeformerAccess::state(deformer);
    const Context& context = state.chosen(given);
    return with_memory_errors([&] {
        require_whole_surface(state.options(), "a sliding pin");
        const auto prepared = state.prepare(context);
        DeformFrame frame =
            solve_frame(prepared, state.poses, state.scratch, FrameQuality::full, context);
        const std::vector<Index>& region = deformer.region().vertices();
        double off = 0.0;
        for (const SlidingPin& pin : pins) {
            const auto row = std::lower_bound(region.begin(), region.end(), pin.vertex);
            off = std::max(off,
                           distance_to(pin, frame.positions[at(index_of(row - region.begin()))]));
        }
        const double size = prepared->rest->work->radius;
        if (off > kOnPlace * size) {
            if (!frame.preparation) frame = prepared_rest(prepared, std::move(frame));
            off = PinForces(*prepared, frame, pins, context).hold(frame, context);
            frame.gradients.reset();
        }
        state.show(std::move(frame));
        return off;
    });
}

}  // namespace lissom
