// The grid field on a head-like ellipsoid with ten stream curves, a dividing curve and a ponytail's
// worth of constraints: from nothing, edits, and the thesis's own way on the same edit.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "kernel/solve/field/grid_field.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr int kStreams = 10;
constexpr ConstraintOwner kParting = 100, kPonytail = 101;

struct Setup {
    std::string name;
    GridSize size;
    /// Points around a stream curve that are constrained, in grid steps.
    double radius;
    int repeats;
    bool cholesky;
};

// The head is an ellipsoid in a grid of which it takes about half the width.
struct Head {
    explicit Head(const GridSize& size)
        : center(0.5 * size.nx, 0.5 * size.ny, 0.55 * size.nz),
          radii(0.24 * size.nx, 0.29 * size.ny, 0.31 * size.nz) {}

    Vec3 at(double azimuth, double elevation, double lift) const {
        const Vec3 unit(std::cos(elevation) * std::cos(azimuth),
                        std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        return center + lift * radii.cwiseProduct(unit);
    }

    Vec3 center, radii;
};

using Curve = std::vector<Vec3>;

// From the crown outwards and down; `shift` turns it a little, as an edit does.
Curve stream(const Head& head, int number, double shift) {
    Curve curve;
    const double azimuth = 2.0 * kPi * number / kStreams + shift;
    for (int i = 0; i <= 200; ++i) {
        const double t = i / 200.0;
        curve.push_back(head.at(azimuth + 0.35 * t + shift * t, 1.25 - 2.0 * t, 1.0 + 0.45 * t));
    }
    return curve;
}

Curve parting(const Head& head) {
    Curve curve;
    for (int i = 0; i <= 200; ++i) {
        curve.push_back(head.at(0.5 * kPi, 0.5 + 1.3 * i / 200.0, 1.02));
    }
    return curve;
}

Curve ponytail(const Head& head) {
    Curve curve;
    for (int i = 0; i <= 200; ++i) {
        const double t = i / 200.0;
        curve.push_back(head.at(1.5 * kPi, 0.6 - 1.6 * t * t, 1.05 + 0.5 * std::sin(kPi * t)));
    }
    return curve;
}

// Grid points within `radius` of the curve, with its direction where it is nearest.
std::vector<GridConstraint> around(const GridSize& size, const Curve& curve, double radius) {
    struct Nearest {
        double distance;
        Vec3 direction;
    };
    std::map<Index, Nearest> found;
    const auto reach = static_cast<Index>(std::ceil(radius));
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const Vec3 direction = (curve[i + 1] - curve[i]).normalized();
        const Eigen::Vector3i near = curve[i].array().round().cast<int>();
        for (Index z = near.z() - reach; z <= near.z() + reach; ++z) {
            for (Index y = near.y() - reach; y <= near.y() + reach; ++y) {
                for (Index x = near.x() - reach; x <= near.x() + reach; ++x) {
                    if (x < 0 || y < 0 || z < 0 || x >= size.nx || y >= size.ny || z >= size.nz) {
                        continue;
                    }
                    const double distance = (curve[i] - Vec3(x, y, z)).norm();
                    if (distance > radius) continue;
                    const auto at =
                        found.try_emplace(size.index({x, y, z}), Nearest{distance, direction});
                    if (distance < at.first->second.distance) {
                        at.first->second = {distance, direction};
                    }
                }
            }
        }
    }
    std::vector<GridConstraint> constraints;
    for (const auto& entry : found) constraints.push_back({entry.first, entry.second.direction});
    return constraints;
}

using Curves = std::map<ConstraintOwner, std::vector<GridConstraint>>;

Curves curves_of(const Setup& setup) {
    const Head head(setup.size);
    Curves curves;
    for (int i = 0; i < kStreams; ++i) {
        curves[i] = around(setup.size, stream(head, i, 0.0), setup.radius);
    }
    curves[kParting] = around(setup.size, parting(head), setup.radius);
    return curves;
}

void add_curves(GridField& field, const Curves& curves) {
    for (const auto& entry : curves) field.set_constraints(entry.first, entry.second);
}

class Frames {
  public:
    Frames(GridField& field, const Setup& setup, const Context& context)
        : field_(field),
          setup_(setup),
          context_(context),
          quads_(4 * static_cast<std::size_t>(setup.size.count())) {}

    void solve() {
        field_.solve(context_);
        field_.evaluate(std::span<float>(quads_), context_);
    }
    // Median seconds of a solve after each of `repeats` moves of one stream curve.
    double edits(int owner, int repeats) {
        return median(repeats, [&] {
            shift_ += 0.04;
            const Curve curve = stream(Head(setup_.size), owner, shift_);
            field_.set_constraints(owner, around(setup_.size, curve, setup_.radius));
        });
    }
    // The same with other directions at the same points.
    double turns(int owner, int repeats) {
        return median(repeats, [&] {
            const auto now = field_.constraints().of(owner);
            std::vector<GridConstraint> next(now.begin(), now.end());
            for (GridConstraint& c : next) c.value = Vec3(c.value.y(), -c.value.x(), c.value.z());
            field_.set_constraints(owner, std::move(next));
        });
    }

  private:
    template <typename Change>
    double median(int repeats, const Change& change) {
        std::vector<double> times;
        for (int i = 0; i < repeats; ++i) {
            change();
            times.push_back(seconds([&] { solve(); }));
        }
        std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
        return times[static_cast<std::size_t>(repeats / 2)];
    }

    GridField& field_;
    const Setup& setup_;
    const Context& context_;
    std::vector<float> quads_;
    double shift_ = 0.0;
};

double milliseconds(double seconds) {
    return 1e3 * seconds;
}

double time_from_nothing(const Setup& setup, const Context& context) {
    const Curves curves = curves_of(setup);
    return median_seconds(setup.repeats, [&] {
        GridField field(setup.size, {}, context);
        add_curves(field, curves);
        Frames(field, setup, context).solve();
    });
}

// The same edit by both solvers; returns how many times faster the dual one is.
void compare_with_cholesky(Report& report, const Setup& setup, const Context& context) {
    GridFieldOptions options;
    options.solver = GridSolver::cholesky;
    GridField dual(setup.size, {}, context), reference(setup.size, options, context);
    add_curves(dual, curves_of(setup));
    add_curves(reference, curves_of(setup));
    Frames ours(dual, setup, context), theirs(reference, setup, context);
    ours.solve();
    const double factor = seconds([&] { theirs.solve(); });
    report.add({setup.name + ": cholesky, from nothing (thesis: 20 s at 50K)", milliseconds(factor),
                "ms"});
    ours.edits(5, 1);
    theirs.edits(5, 1);
    const Index before = reference.cholesky_stats().updated;
    const Quotient edit = quotient_of(
        5, [&] { return theirs.edits(5, 1); }, [&] { return ours.edits(5, 1); });
    report.add(
        {setup.name + ": cholesky, edit (thesis: a few seconds)", milliseconds(edit.above), "ms"});
    report.add({setup.name + ": constraints updated an edit",
                (reference.cholesky_stats().updated - before) / 5.0, ""});
    report.add_ratio(setup.name + ": edit, CHOLMOD's update / ours", "CHOLMOD's update", edit, 60.0,
                     Better::more,
                     "products of the moved constraints with the kept ones 79 %, the solve 7, "
                     "columns of the Green's function 7");
}

void run_setup(Report& report, const Setup& setup, const Context& context) {
    GridField field(setup.size, {}, context);
    add_curves(field, curves_of(setup));
    Frames frames(field, setup, context);
    frames.solve();
    report.title(setup.name + ": " + std::to_string(setup.size.count()) + " points, " +
                 std::to_string(field.constraint_count()) + " constraints");
    report.add({setup.name + ": field from nothing (thesis: 20 s at 50K)",
                milliseconds(time_from_nothing(setup, context)), "ms"});
    report.add({setup.name + ": first edit of a curve", milliseconds(frames.edits(4, 1)), "ms"});
    report.add({setup.name + ": edit, dragging one of ten curves (thesis: a few seconds)",
                milliseconds(frames.edits(4, setup.repeats)), "ms"});
    report.add(
        {setup.name + ": directions only", milliseconds(frames.turns(4, setup.repeats)), "ms"});
    field.set_constraints(kPonytail,
                          around(setup.size, ponytail(Head(setup.size)), 1.6 * setup.radius));
    const double added = seconds([&] { frames.solve(); });
    report.add({setup.name + ": ponytail added", milliseconds(added), "ms"});

    GridFieldOptions thesis;
    thesis.boundary = GridBoundary::thesis;
    thesis.tolerance = 1e-4;
    GridField exact(setup.size, thesis, context);
    add_curves(exact, curves_of(setup));
    Frames exact_frames(exact, setup, context);
    exact_frames.solve();
    exact_frames.edits(4, 1);
    report.add({setup.name + ": edit with the thesis's boundary weights",
                milliseconds(exact_frames.edits(4, 3)), "ms"});
    if (setup.cholesky) compare_with_cholesky(report, setup, context);
}

// Two million points with more constraints than the dense factor takes.
void run_largest(Report& report, const Context& context) {
    const Setup setup{"2M", {126, 126, 126}, 2.4, 1, false};
    report.title("2M points");
    GridField field(setup.size, {}, context);
    add_curves(field, curves_of(setup));
    Frames frames(field, setup, context);
    const double first = seconds([&] { frames.solve(); });
    report.add({"2M: constraints", static_cast<double>(field.constraint_count()), ""});
    report.add({"2M: field from nothing, iterating", milliseconds(first), "ms"});
    report.add({"2M: edit, iterating", milliseconds(frames.edits(4, 1)), "ms"});
    report.add({"2M: memory charged at most", static_cast<double>(context.memory()->peak()) / 1e6,
                "MB", 3000.0});
}

void run(Report& report) {
    ContextOptions options;
    options.threads = 2;
    const Setup setups[] = {
        {"25K", {29, 29, 30}, 1.2, 9, true},
        {"50K", {36, 37, 38}, 1.23, 7, true},
        {"250K", {63, 63, 63}, 1.34, 5, false},
    };
    for (const Setup& setup : setups) run_setup(report, setup, Context(options));
    run_largest(report, Context(options));
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
