#include "kernel/hair/growth/growth.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/curve/length_text.h"
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/growth/growth_roots.h"

namespace lissom {
namespace {

// Strands that are grown by one thread into one list.
constexpr Index kBatchStrands = 256;
static_assert(kGrowthWave % kBatchStrands == 0);

// Strands that are copied by one thread at a time.
constexpr Index kCopied = 256;

constexpr std::size_t kMaxPoints = std::numeric_limits<Index>::max();

// The least move, as a fraction of the usual segment, and in roundings of the greatest coordinate:
// so the ends of segments are different points.
constexpr double kMinMove = 1e-3, kMinRoundings = 8.0;

// Limit in diagonals of the grid's box: longer hair winds about itself, or has left the box.
constexpr double kLongestInDiagonals = 2.0;

// More room for points than the strands so far let expect.
constexpr double kPointRoom = 1.02;

// Hair that comes into a tail beside its tie is caught at these planes of it, as it is held from a
// little beyond its outline, in steps.
constexpr std::size_t kGates[] = {1, 3};
constexpr float kGateMargin = 0.6f;

bool is_share(double x) {
    return x >= 0.0 && x <= 1.0;
}

bool is_direction(const Vec3& v) {
    return v.allFinite() && v.norm() > 0.0;
}

void require_tie(const HairTie& tie) {
    require(tie.center.allFinite() && is_direction(tie.direction),
            "a tie needs a center and a direction of finite numbers, not of length 0");
    require(is_length(tie.radius) && is_length(tie.tail_length.value_or(0.0)),
            "the radius and the tail of a tie must be lengths of 0 or more");
    require(is_share(tie.ragged), "how ragged a tail is must be from 0 to 1");
    require(std::all_of(tie.spine.begin(), tie.spine.end(),
                        [](const Vec3& p) { return p.allFinite(); }),
            "the spine of a tail must be finite");
    require(tie.radii.empty() || tie.radii.size() == tie.spine.size(),
            "a tail needs a radius for each point of its spine, or none");
    require(std::all_of(tie.radii.begin(), tie.radii.end(), is_length),
            "the radii of a tail must be lengths of 0 or more");
}

void require_cut(const HairCut& cut) {
    require(cut.point.allFinite() && is_direction(cut.normal),
            "a cut needs a point and a normal of finite numbers, not of length 0");
    require(is_length(cut.ragged), "how ragged a cut is must be a length of 0 or more");
}

void require_lengths(const GrowthOptions& o) {
    require(is_length(o.length), "the length of hair must be 0 or more");
    require(is_share(o.variation), "variation must be from 0 to 1");
    require(o.segment >= kMinSegment && o.segment <= kMaxSegment,
            "segment must be 0.01 to 10 steps of the grid");
    require(o.min_speed >= 0.0 && o.min_speed < 1.0, "min_speed must be from 0 to below 1");
    require(o.max_turn >= 0.0 && o.max_turn <= kPi, "max_turn must be from 0 to 180 degrees");
    require(o.max_segments >= 1, "max_segments must be at least 1");
    require(is_length(o.lift), "lift must be 0 or more");
    require(is_length(o.clearance) && is_length(o.layer) && is_length(o.ramp),
            "clearance, layer and ramp must be lengths of 0 or more");
}

void require_options(const GrowthOptions& o, Index head_vertices) {
    require_lengths(o);
    require(o.placement.is_finite() && o.placement.linear.determinant() != 0.0,
            "the placement of hair must be finite and must not flatten it");
    require(o.length_map.empty() || o.length_map.size() == at(head_vertices),
            "a length map needs one factor for every vertex of the head");
    require(std::all_of(o.length_map.begin(), o.length_map.end(), is_length),
            "factors of a length map must be finite and not negative");
    for (const MaskStroke& mask : o.masks) require_mask(mask);
    for (const HairTie& tie : o.ties) require_tie(tie);
    for (const HairCut& cut : o.cuts) require_cut(cut);
}

// The greatest factor of a length that the options can give.
double max_factor(const GrowthOptions& o) {
    double painted = 1.0;
    for (const MaskStroke& mask : o.masks) {
        if (mask.kind == MaskKind::length) painted = std::max(painted, mask.value);
    }
    return painted * (o.length_map.empty()
                          ? 1.0
                          : *std::max_element(o.length_map.begin(), o.length_map.end()));
}

// Lengths that no hair in this grid can have.
void require_fitting_lengths(const GrowthOptions& o, const GridLayout& layout) {
    const double most = longest_hair(layout);
    const auto require_fitting = [&](double length, const std::string& what) {
        if (length <= most) return;
        throw Error(ErrorCode::invalid_argument,
                    what + " is " + length_text(length) + " long, but hair can be " +
                        length_text(most) +
                        " at most, twice the diagonal of the volume of the hairstyle; make it "
                        "shorter, or enlarge the volume");
    };
    const double factor = max_factor(o);
    require_fitting(o.length * factor, factor == 1.0 ? "hair" : "hair with the greatest factor");
    for (const HairTie& tie : o.ties) {
        require_fitting(tie.tail_length.value_or(0.0), "the tail of a tie");
    }
}

// The grid's cells to the coordinates of strands.
Affine placement_of_cells(const GridLayout& layout, const Affine& placement) {
    return placement * Affine{layout.step * Mat3::Identity(), layout.origin};
}

// The least length of a segment in cells.
double min_move(const GridLayout& layout, const GrowthOptions& options) {
    const Affine placed = placement_of_cells(layout, options.placement);
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 cell;
        for (int axis = 0; axis < 3; ++axis) {
            cell[axis] = (corner >> axis) & 1 ? layout.counts[axis] : 0.0;
        }
        farthest = std::max(farthest, placed(cell).cwiseAbs().maxCoeff());
    }
    // At most how many cells one unit of the strands' coordinates is.
    const double cells = placed.linear.inverse().norm();
    const double rounding = farthest * std::numeric_limits<float>::epsilon() * cells;
    return std::max(kMinMove * options.segment, kMinRoundings * rounding);
}

// Planes across a tail at the points of its spine, with frames that do not turn along it.
std::vector<TailPlane> planes_of(const HairTie& tie, const GridLayout& layout) {
    const std::vector<Vec3>& spine = tie.spine;
    std::vector<TailPlane> planes;
    Vec3 side = tie.direction.unitOrthogonal();
    double behind = 0.0;
    for (std::size_t i = 1; i < spine.size(); ++i) {
        behind += (spine[i] - spine[i - 1]).norm();
        const Vec3 along = spine[std::min(i + 1, spine.size() - 1)] - spine[i - 1];
        if (!(along.norm() > 0.0)) continue;
        const Vec3 direction = along.normalized();
        const Vec3 across = side - side.dot(direction) * direction;
        side = (across.norm() > 0.0 ? across : direction.unitOrthogonal()).normalized();
        const double radius = tie.radii.empty() ? 0.0 : tie.radii[i] / layout.step;
        planes.push_back({((spine[i] - layout.origin) / layout.step).cast<float>(),
                          direction.cast<float>(), static_cast<float>(behind / layout.step),
                          (radius * side).cast<float>(),
                          (radius * direction.cross(side)).cast<float>()});
    }
    return planes;
}

// Returns the gates behind a tail's tie, over its known radii.
std::vector<TailGate> gates_of(const HairTie& tie, const std::vector<TailPlane>& planes) {
    std::vector<TailGate> gates;
    if (tie.radii.empty()) return gates;
    for (const std::size_t i : kGates) {
        if (i >= planes.size()) break;
        const TailPlane& plane = planes[i];
        const float radius = plane.side.norm() + kGateMargin;
        gates.push_back({plane.center, plane.direction, radius * radius, plane.behind,
                         static_cast<std::int32_t>(i) + 1});
    }
    return gates;
}

TieRule tie_rule(const HairTie& tie, const GridLayout& layout) {
    const double radius = tie.radius / layout.step;
    TieRule rule{{((tie.center - layout.origin) / layout.step).cast<float>(),
                  tie.direction.normalized().cast<float>(), static_cast<float>(radius * radius)},
                 static_cast<float>(tie.tail_length.value_or(0.0) / layout.step),
                 static_cast<float>(tie.ragged),
                 tie.tail_length ? planes_of(tie, layout) : std::vector<TailPlane>(),
                 tie.tail_length.has_value()};
    rule.gates = gates_of(tie, rule.planes);
    return rule;
}

CutRule cut_rule(const HairCut& cut, const GridLayout& layout) {
    const Vec3 normal = cut.normal.normalized();
    return {normal.cast<float>(),
            static_cast<float>(normal.dot(cut.point - layout.origin) / layout.step),
            static_cast<float>(cut.ragged / layout.step)};
}

GrowthRules rules_of(const GridLayout& layout, const GrowthOptions& options) {
    GrowthRules rules{};
    rules.segment = options.segment;
    rules.min_speed = options.min_speed;
    rules.min_move = min_move(layout, options);
    // Cosines of rounded vectors may lie below -1.
    rules.min_cosine =
        options.max_turn < kPi ? static_cast<float>(std::cos(options.max_turn)) : -2.0f;
    rules.lift = options.lift;
    rules.outward = options.start_outward ? 1.0f : 0.0f;
    rules.inverse_cap = options.cap_speed ? 1.0f : 0.0f;
    rules.inverse_ramp = 1.0 / std::max(options.ramp / layout.step, 1e-6);
    rules.inverse_step = 1.0 / layout.step;
    rules.avoid = options.avoid;
    rules.spare_tied = options.spare_tied;
    rules.max_segments = options.max_segments;
    for (const HairTie& tie : options.ties) rules.ties.push_back(tie_rule(tie, layout));
    for (const HairCut& cut : options.cuts) rules.cuts.push_back(cut_rule(cut, layout));
    const Affine placed = placement_of_cells(layout, options.placement);
    rules.linear = placed.linear.cast<float>();
    rules.translation = placed.translation.cast<float>();
    return rules;
}

QuadGrid grid_of(const HairField& field) {
    const std::array<Index, 3>& counts = field.layout().counts;
    QuadGrid grid{
        field.values().data(), field.gradients().data(), counts[0], counts[0] * counts[1], {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        grid.last[axis] = counts[axis] - 1;
    }
    return grid;
}

}  // namespace

struct StrandGrower::State {
    State(const Mesh& head, std::span<const Root> all, const Context& context)
        : roots(head, all, context) {}

    StrandSeed strand_seed(Index i, const GridLayout& layout, const GrowthOptions& options) const;

    GrowthRoots roots;
    // Scratch: the strands of one wave.
    std::vector<StrandBatch> batches;
    std::vector<std::vector<StrandSeed>> seeds;
};

StrandSeed StrandGrower::State::strand_seed(Index i, const GridLayout& layout,
                                            const GrowthOptions& options) const {
    const StrandChance& chance = roots.chance(i);
    const double step = layout.step, u = chance.layer;
    const double length =
        options.length * roots.factor(i) * (1.0 + options.variation * chance.length);
    return {((roots.position(i) - layout.origin) / step).cast<float>(),
            roots.normal(i),
            static_cast<float>(length / step),
            static_cast<float>((options.clearance + options.layer * u * u) / step),
            chance.cut,
            chance.tail};
}

namespace {

// Growth into one list of points, wave after wave.
class StrandCollector {
  public:
    StrandCollector(Index strands, Strands& into, const Context& context)
        : strands_(into), context_(context), count_(strands) {
        strands_.release(points_, offsets_);
        offsets_.resize(at(strands) + 1);
        offsets_[0] = 0;
    }

    // Takes the strands of a wave that begins with root `first`.
    void take(const GrowthRoots& roots, Index first, std::span<const StrandBatch> batches);
    void finish(const StrandRoots& roots);

    GrowthReport report;

  private:
    // Lists the strands of a wave, with the count of i as offset i + 1; returns the root behind its
    // last.
    Index list_wave(const GrowthRoots& roots, Index first, std::span<const StrandBatch> batches);
    // Makes offsets of the counts.
    void number_points(Index first, Index last);
    void make_room(Index done);

    Strands& strands_;
    const Context& context_;
    Index count_;
    std::vector<float> points_;
    std::vector<Index> offsets_;
    // Points of each strand of a wave, in the order of the roots, which is the fastest for copying.
    std::vector<const float*> wave_ = std::vector<const float*>(kGrowthWave);
    MemoryCharge charge_;
};

Index StrandCollector::list_wave(const GrowthRoots& roots, Index first,
                                 std::span<const StrandBatch> batches) {
    Index next = first;
    for (const StrandBatch& batch : batches) {
        for (const StrandBatch::Strand& strand : batch.strands) {
            const std::size_t root = roots.number(next++);
            wave_[root - first] = batch.lists[strand.list].data() + strand.first;
            offsets_[root + 1] = strand.count;
            ++report.ends[static_cast<std::size_t>(strand.end)];
            if (!report.ties.empty()) report.ties[root] = strand.tie;
        }
    }
    return next;
}

void StrandCollector::number_points(Index first, Index last) {
    for (std::size_t i = first; i < at(last); ++i) {
        const std::size_t end = at(offsets_[i]) + offsets_[i + 1];
        require(end <= kMaxPoints,
                "hair has more points than can be numbered; grow fewer or shorter strands, or "
                "longer segments");
        offsets_[i + 1] = index_of(end);
    }
}

// Room for the first `done` strands, and for the others to come.
void StrandCollector::make_room(Index done) {
    const auto needed = 3 * at(offsets_[done]);
    if (needed <= points_.size()) return;
    const double all = kPointRoom * needed * count_ / done;
    const std::size_t size = done == count_ ? needed : static_cast<std::size_t>(all);
    charge_ = {};
    charge_ = context_.charge(size * sizeof(float), "strands");
    points_.resize(size);
}

void StrandCollector::take(const GrowthRoots& roots, Index first,
                           std::span<const StrandBatch> batches) {
    const Index last = list_wave(roots, first, batches);
    number_points(first, last);
    make_room(last);
    context_.parallel_for(first, last, kCopied, [&](Index begin, Index end) {
        for (std::size_t i = begin; i < at(end); ++i) {
            const std::size_t from = offsets_[i], to = offsets_[i + 1];
            std::copy_n(wave_[i - first], 3 * (to - from), points_.data() + 3 * from);
        }
    });
}

void StrandCollector::finish(const StrandRoots& roots) {
    points_.resize(3 * at(offsets_.back()));
    // The points count with the strands from now on.
    charge_ = {};
    strands_ = Strands(std::move(points_), std::move(offsets_), context_.memory());
    strands_.set_roots(roots);
}

}  // namespace

double longest_hair(const GridLayout& layout) {
    return kLongestInDiagonals * layout.box().diagonal();
}

StrandGrower::StrandGrower(const Mesh& head, std::span<const Root> roots, const Context& context)
    : state_(std::make_unique<State>(head, roots, context)) {}
StrandGrower::~StrandGrower() = default;
StrandGrower::StrandGrower(StrandGrower&&) noexcept = default;
StrandGrower& StrandGrower::operator=(StrandGrower&&) noexcept = default;

Index StrandGrower::size() const {
    return state_->roots.size();
}

GrowthReport StrandGrower::grow(const HairField& field, const GrowthOptions& options,
                                Strands& strands, const Context& context) {
    GrowthRoots& roots = state_->roots;
    require_options(options, roots.head_vertices());
    require_fitting_lengths(options, field.layout());
    StrandCollector collector(size(), strands, context);
    roots.set_seed(options.seed, context);
    roots.set_factors({options.length_map, options.masks}, context);
    if (!options.ties.empty()) collector.report.ties.resize(size());

    const GrowthRules rules = rules_of(field.layout(), options);
    const QuadGrid grid = grid_of(field);
    const GrowthLoop loop = best_growth_loop();
    state_->batches.resize(kGrowthWave / kBatchStrands);
    state_->seeds.resize(kGrowthWave / kBatchStrands);
    for (Index first = 0; first < size(); first += kGrowthWave) {
        const Index last = std::min(size(), first + kGrowthWave);
        context.parallel_for(first, last, kBatchStrands, [&](Index begin, Index end) {
            const std::size_t number = (begin - first) / kBatchStrands;
            std::vector<StrandSeed>& seeds = state_->seeds[number];
            seeds.clear();
            for (Index i = begin; i < end; ++i) {
                seeds.push_back(state_->strand_seed(i, field.layout(), options));
            }
            grow_batch(grid, rules, seeds, loop, state_->batches[number]);
        });
        const std::size_t grown = (last - first + kBatchStrands - 1) / kBatchStrands;
        collector.take(roots, first, std::span(state_->batches).first(grown));
    }
    collector.finish(roots.strand_roots());
    return std::move(collector.report);
}

GrowthReport grow(const Mesh& head, const HairField& field, std::span<const Root> roots,
                  const GrowthOptions& options, Strands& strands, const Context& context) {
    return StrandGrower(head, roots, context).grow(field, options, strands, context);
}

}  // namespace lissom
