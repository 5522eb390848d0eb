// A hairstyle of ten streams on the generated head: from a moved curve to regrown strands, and the
// parts of that.
#include <cmath>
#include <ctime>
#include <string>
#include <vector>
#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#define LISSOM_HAS_RUSAGE
#endif

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/stream_curve.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/bench/limits.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr Index kStrands = 100000, kManyStrands = 1000000;
// The stream that is moved.
constexpr std::size_t kMoved = 3;

// Millimetres above the scalp, in a direction in degrees.
struct Above {
    double azimuth, elevation, lift;
};

struct Stream {
    std::vector<Above> on_head;
    // How it goes on, in millimetres from point to point.
    std::vector<Vec3> then;
};

// A side-swept bob.
std::vector<Stream> bob() {
    return {
        {{{-38, 44, 10}, {-12, 49, 20}, {22, 45, 22}, {52, 33, 20}, {72, 8, 20}},
         {{4, -50, -4}, {-4, -70, -4}}},
        {{{-30, 70, 12}, {30, 72, 18}, {66, 48, 20}, {84, 15, 22}}, {{6, -50, 0}, {-4, -70, 0}}},
        {{{-52, 45, 8}, {-70, 26, 14}, {-79, 2, 18}}, {{-4, -50, -4}, {4, -70, -4}}},
        {{{-80, 65, 10}, {-88, 38, 18}, {-92, 8, 22}}, {{-6, -50, 0}, {4, -70, 0}}},
        {{{120, 72, 12}, {106, 42, 20}, {108, 5, 22}}, {{6, -60, 2}, {-4, -70, 4}}},
        {{{-125, 72, 12}, {-108, 42, 20}, {-110, 5, 22}}, {{-6, -60, 2}, {4, -70, 4}}},
        {{{155, 68, 10}, {140, 35, 20}, {137, -5, 22}, {140, -35, 22}}, {{0, -70, -2}}},
        {{{-155, 68, 10}, {-140, 35, 20}, {-137, -5, 22}, {-140, -35, 22}}, {{0, -70, -2}}},
        {{{175, 62, 8}, {172, 25, 20}, {172, -15, 22}}, {{0, -60, 6}, {0, -70, 4}}},
        {{{-165, 80, 12}, {-168, 55, 18}, {-170, 15, 22}, {-170, -20, 22}}, {{0, -90, 8}}},
    };
}

struct Head {
    Mesh mesh;
    Scalp scalp;

    explicit Head(Mesh shape) : mesh(std::move(shape)), scalp(mesh) {}

    Vec3 at(const Above& place) const {
        return scalp
            .at({place.azimuth * kDegree, place.elevation * kDegree}, place.lift * kMillimetre)
            .position;
    }
};

// The generated head in metres of its scalp's frame.
Head metric_head() {
    Mesh mesh = make_head();
    const Scalp scalp(mesh);
    for (Vec3& p : mesh.edit_positions()) p = scalp.to_metres(p);
    return Head(std::move(mesh));
}

// Points of a stream, turned by `shift` degrees about the head, as an edit does.
std::vector<Vec3> points_of(const Head& head, const Stream& stream, double shift) {
    std::vector<Vec3> points;
    for (Above place : stream.on_head) {
        place.azimuth += shift;
        points.push_back(head.at(place));
    }
    for (const Vec3& by : stream.then) points.push_back(points.back() + kMillimetre * by);
    return points;
}

class Style {
  public:
    Style(const Head& head, Index resolution, const Context& context)
        : head_(head),
          context_(context),
          field(
              DistanceGrid(head.mesh, fit_grid(head.scalp.default_box(), resolution), {}, context),
              HairField::default_options(), context) {
        for (std::size_t i = 0; i < streams_.size(); ++i) set_stream(i, 0.0);
    }

    void set_stream(std::size_t i, double shift) {
        const GridLayout& layout = field.layout();
        std::vector<Vec3> curve =
            smooth_curve(points_of(head_, streams_[i], shift), 0.2 * layout.step);
        push_out(curve, field.distances(), 4.0 * kMillimetre);
        field.set_constraints(static_cast<ConstraintOwner>(i),
                              stream_constraints(layout, resampled_curve(curve, layout.step)));
    }

    // Seconds from a moved stream to strands, moved a little more every time.
    double frame(StrandGrower& grower, Strands& strands, std::size_t moved = kMoved) {
        shift_ += 1.5;
        return seconds([&] {
            set_stream(moved, shift_);
            field.solve(context_);
            grower.grow(field, options, strands, context_);
        });
    }

    std::size_t streams() const { return streams_.size(); }

  private:
    const Head& head_;
    const Context& context_;
    std::vector<Stream> streams_ = bob();
    double shift_ = 0.0;

  public:
    HairField field;
    GrowthOptions options;
};

double milliseconds(double seconds) {
    return 1e3 * seconds;
}

// Of all threads.
template <typename Action>
double processor_seconds(const Action& action) {
    const std::clock_t start = std::clock();
    action();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

template <typename Action>
double median_of(int repeats, const Action& action) {
    std::vector<double> values;
    for (int i = 0; i < repeats; ++i) values.push_back(action());
    std::nth_element(values.begin(), values.begin() + repeats / 2, values.end());
    return values[static_cast<std::size_t>(repeats / 2)];
}

struct Setup {
    std::string name;
    Index resolution;
};

// The field of the same constraints, without the distances.
void solve_from_nothing(const HairField& like, const Context& context) {
    GridField field(like.grid().size(), HairField::default_options(), context);
    for (const ConstraintOwner owner : like.grid().constraints().owners()) {
        const auto given = like.grid().constraints().of(owner);
        field.set_constraints(owner, {given.begin(), given.end()});
    }
    field.solve(context);
    std::vector<float> quads(4 * static_cast<std::size_t>(like.layout().size()));
    field.evaluate(std::span<float>(quads), context);
}

void run_setup(Report& report, const Setup& setup, const Head& head, StrandGrower& grower,
               const Context& context) {
    Style style(head, setup.resolution, context);
    const double scratch = median_seconds(5, [&] { solve_from_nothing(style.field, context); });
    style.field.solve(context);
    report.title(setup.name + ": " + std::to_string(style.field.layout().size()) + " points, " +
                 std::to_string(style.field.grid().constraint_count()) + " constraints");
    report.add(
        {setup.name + ": field from nothing (thesis: 20 s at 50K)", milliseconds(scratch), "ms"});
    Strands strands;
    grower.grow(style.field, style.options, strands, context);
    // Every other stream is dragged in turn: the first frame of each drag against the later ones.
    std::size_t moved = 0;
    const Quotient first = quotient_of(
        15, [&] { return style.frame(grower, strands, moved = (moved + 3) % style.streams()); },
        [&] {
            style.frame(grower, strands, moved);
            return style.frame(grower, strands, moved);
        });
    report.add({setup.name + ": first frame of a drag", milliseconds(first.above), "ms"});
    report.add({setup.name + ": stream moved to 100K strands (thesis: several seconds)",
                milliseconds(first.below), "ms"});
    report.add_ratio(setup.name + ": first frame of a drag / later frames", "later frames", first,
                     1.3, Better::less,
                     "the factor's rows behind those of the moved stream: products of panels 73 %, "
                     "entries of the matrix 18, rows below a panel 9; growth takes the same");
    const auto grow = [&] { grower.grow(style.field, style.options, strands, context); };
    MemoryLimit memory;
    const Quotient growth = quotient_of(
        9, [&] { return seconds(grow); },
        [&] { return memory.seconds_to_write(static_cast<double>(strands.memory_bytes())); });
    report.add({setup.name + ": growth alone, 100K strands (thesis: below 500 ms)",
                milliseconds(growth.above), "ms"});
    report.add_ratio(setup.name + ": growth / writing its points on one thread", "bandwidth",
                     growth, 3.0, Better::less,
                     "the loop over lanes 69 %, arithmetic (reading the grid a third of it); the "
                     "copy into one list the rest");
    report.add({setup.name + ": growth, all threads together",
                milliseconds(median_of(9, [&] { return processor_seconds(grow); })), "ms"});
    report.add({setup.name + ": points a strand",
                static_cast<double>(strands.point_count()) / strands.size(), ""});
    const auto per_strand =
        static_cast<double>(strands.size()) * (2 * sizeof(Index) + sizeof(Eigen::Vector3f));
    report.add({setup.name + ": memory a point, without that of strands",
                (static_cast<double>(strands.memory_bytes()) - per_strand) / strands.point_count(),
                "bytes",
                12.5,
                Better::less,
                {},
                0.0,
                0.0,
                "the list of points, 12 bytes each, doubles where hair outgrows it, and keeps its "
                "room for the next frame"});
}

void run_roots(Report& report, const Head& head, const Context& context) {
    report.title("Roots");
    report.add({"roots: 100K by Poisson disk",
                milliseconds(median_seconds(
                    3, [&] { make_roots(head.mesh, head.scalp, {.count = kStrands}, context); })),
                "ms"});
}

void run_many(Report& report, const Head& head, const Context& context) {
    report.title("A million strands");
    const std::vector<Root> roots =
        make_roots(head.mesh, head.scalp, {.count = kManyStrands}, context);
    StrandGrower grower(head.mesh, roots, context);
    Style style(head, 25000, context);
    style.field.solve(context);
    Strands strands;
    const auto grow = [&] { grower.grow(style.field, style.options, strands, context); };
    report.add({"1M strands, into fresh memory", milliseconds(seconds(grow)), "ms"});
    report.add({"1M strands, into a reused buffer", milliseconds(median_seconds(3, grow)), "ms"});
    report.add({"1M strands: points a strand",
                static_cast<double>(strands.point_count()) / strands.size(), ""});
}

// Two million grid points; run first, as the memory of the process is measured at its highest.
void run_largest(Report& report, const Head& head, StrandGrower& grower, const Context& context) {
    report.title("Two million grid points");
    Style style(head, 2000000, context);
    const double first = seconds([&] { style.field.solve(context); });
    Strands strands;
    grower.grow(style.field, style.options, strands, context);
    report.add({"2M: constraints", static_cast<double>(style.field.grid().constraint_count()), ""});
    report.add({"2M: first solve", milliseconds(first), "ms"});
    report.add(
        {"2M: stream moved to 100K strands", milliseconds(style.frame(grower, strands)), "ms"});
    report.add({"2M: memory charged at most", static_cast<double>(context.memory()->peak()) / 1e6,
                "MB", 3000.0});
#ifdef LISSOM_HAS_RUSAGE
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    report.add({"2M: memory of the process at most", static_cast<double>(usage.ru_maxrss) / 1e3,
                "MB", 3000.0});
#endif
}

void run(Report& report) {
    ContextOptions options;
    options.threads = 2;
    const Context context(options);
    const Head head = metric_head();
    const std::vector<Root> roots = make_roots(head.mesh, head.scalp, {.count = kStrands}, context);
    StrandGrower grower(head.mesh, roots, context);
    run_largest(report, head, grower, Context(options));
    const Setup setups[] = {{"25K", 25000}, {"50K", 50000}, {"250K", 250000}};
    for (const Setup& setup : setups) run_setup(report, setup, head, grower, context);
    run_roots(report, head, context);
    run_many(report, head, context);
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
