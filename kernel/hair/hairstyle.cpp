#include "kernel/hair/hairstyle.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "kernel/core/machine_memory.h"
#include "kernel/core/memory_error.h"
#include "kernel/hair/derived_style.h"
#include "kernel/hair/field/thin_parts.h"
#include "kernel/hair/field_stage.h"
#include "kernel/hair/scalp/surface_distance.h"
#include "kernel/hair/style_roots.h"

namespace lissom {
namespace {

// Seconds for making and solving a large grid, about, on one thread of a common processor.
constexpr double kSecondsAPoint = 1.5e-6;

// The head in metres of its scalp's frame.
Mesh placed_head(const Mesh& head, const Scalp& scalp, const Context& context) {
    std::vector<Vec3> positions(head.positions().begin(), head.positions().end());
    for (Vec3& p : positions) p = scalp.to_metres(p);
    return Mesh(std::move(positions), head.shared_topology(), context);
}

// From metres of the frame to those of the head.
Affine placement_of(const Scalp& scalp) {
    return {scalp.unit() * scalp.scale() * scalp.frame().axes, scalp.unit() * scalp.frame().center};
}

GridLayout layout_of(const HairstyleOptions& options) {
    return fit_grid(options.volume.value_or(Scalp::default_volume()), options.resolution);
}

// The field, the distance with its sign and gradient, and all as they are read.
std::size_t needed_bytes(const GridLayout& layout, const GridFieldOptions& field) {
    const std::size_t points = layout.size();
    const auto [nx, ny, nz] = layout.counts;
    return GridField::predicted_bytes({nx, ny, nz}, 0, field) +
           points * (13 * sizeof(float) + sizeof(std::uint8_t));
}

// Most hair is shorter than asked for reasons that are not the style's.
void warn_of_short_hair(const GrowthReport& report, Index strands, const Context& context) {
    const auto warn = [&](StrandEnd end, const std::string& text) {
        const Index count = report.ended_by(end);
        if (2 * std::int64_t{count} <= strands) return;
        context.log(LogLevel::warning,
                    std::to_string(count) + " of " + std::to_string(strands) + " strands " + text);
    };
    warn(StrandEnd::left_grid,
         "left the volume of the hairstyle before they were as long as asked; enlarge the volume, "
         "or make hair shorter");
    warn(StrandEnd::segments,
         "have as many segments as allowed before they are as long as asked; raise max_segments");
}

// Adds the roots and the ties of strands; after an error there are no strands.
void label_strands(Strands& strands, const std::vector<Eigen::Vector2f>& uvs,
                   const std::vector<Index>& ties, std::vector<std::string> names) try {
    StrandRoots roots = strands.roots();
    roots.uvs = uvs;
    strands.set_roots(std::move(roots));
    if (!names.empty()) strands.set_groups(ties, std::move(names));
} catch (...) {
    strands = Strands();
    throw;
}

// Those of one kind: roots are made anew for strokes of the density alone.
void append_masks(std::span<const MaskStroke> masks, MaskKind kind, std::vector<MaskStroke>& list) {
    std::copy_if(masks.begin(), masks.end(), std::back_inserter(list),
                 [&](const MaskStroke& one) { return one.kind == kind; });
}

std::string quantity(double amount, const char* unit) {
    std::ostringstream text;
    text.precision(amount < 10.0 ? 1 : 0);
    text << std::fixed << amount << ' ' << unit;
    return text.str();
}

// A grid that would not fit into memory fails late, or stops the machine.
void require_affordable(const HairstyleOptions& options, const Context& context) {
    const GridLayout layout = layout_of(options);
    const std::size_t limit = context.memory()->limit(), used = context.memory()->used();
    const std::size_t room = limit > 0 ? limit - std::min(limit, used) : machine_memory();
    const std::size_t needed = needed_bytes(layout, options.field);
    if (room == 0 || needed <= room) return;
    constexpr double kGigabyte = 1e9;
    const double points = layout.size(), fraction = static_cast<double>(room) / needed;
    throw Error(ErrorCode::memory_limit,
                "a hairstyle of " + std::to_string(layout.size()) + " grid points needs about " +
                    quantity(needed / kGigabyte, "GB") + " and " +
                    quantity(kSecondsAPoint * points, "seconds") + ", but there are " +
                    quantity(room / kGigabyte, "GB") + "; a resolution of at most " +
                    std::to_string(static_cast<Index>(fraction * points)) +
                    " would fit, and 50000 do for most styles");
}

HairField hair_field(const Mesh& head, const HairstyleOptions& options, const Context& context) {
    DistanceGrid distances(head, layout_of(options), {}, context);
    const std::vector<float> collision = collision_distances(distances, head, context);
    return HairField(std::move(distances), collision, options.field, context);
}

}  // namespace

HairstyleOptions style_options_with(HairFidelity fidelity) {
    HairstyleOptions options;
    options.fidelity = fidelity;
    if (fidelity == HairFidelity::thesis) {
        options.field.boundary = GridBoundary::thesis;
        options.field.tension = 0.0;
        options.gravity = 0.0;
    }
    return options;
}

GrowthOptions growth_options_with(HairFidelity fidelity) {
    GrowthOptions options;
    if (fidelity == HairFidelity::lissom) return options;
    options.variation = options.lift = 0.0;
    options.max_turn = kPi;
    options.avoid = options.start_outward = options.cap_speed = false;
    return options;
}

struct Hairstyle::State {
    State(const Mesh& mesh, std::shared_ptr<const Scalp> made_for, const HairstyleOptions& wanted,
          const Context& context)
        : original(mesh),
          scalp(std::move(made_for)),
          options(wanted),
          head(placed_head(mesh, *scalp, context)),
          field(hair_field(head, wanted, context)),
          surface(*scalp, field.field().distances(), head) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    // Takes these inputs, or throws and changes nothing.
    void accept(StyleInputs inputs) {
        accept(std::move(inputs), {*scalp, field.field().distances(), gathers()}, {});
    }
    void accept(StyleInputs inputs, const StyleGround& ground, const Context& context) {
        style = with_memory_errors(
            [&] { return derive_style(std::move(inputs), style, ground, context); });
    }
    bool over_scalp(const Vec3& point) const;
    std::vector<GridConstraint> scalp_step(const ScalpStepOptions& options) const;
    std::vector<HairTie> ties(std::vector<std::string>& names) const;
    FieldGravity gravity() const;
    bool gathers() const { return options.gravity > 0.0; }

    // The head, and its constant properties.
    Mesh original;
    std::shared_ptr<const Scalp> scalp;
    HairstyleOptions options;
    Mesh head;

    DerivedStyle style;
    ConstraintOwner last_id = kScalpOwner;

    // Results, each with its inputs.
    FieldStage field;
    SurfaceDistance surface;
    std::optional<StyleRoots> roots;
};

Hairstyle::Hairstyle(const Mesh& head, std::shared_ptr<const Scalp> scalp,
                     const HairstyleOptions& options, const Context& context) {
    if (scalp->region().topology() != head.shared_topology()) {
        throw Error(ErrorCode::topology_mismatch,
                    "the scalp was made for another head; make one for this head");
    }
    require(options.gravity >= 0.0 && options.gravity <= 1.0, "gravity must be from 0 to 1");
    require_affordable(options, context);
    state_ = std::make_unique<State>(head, std::move(scalp), options, context);
}

Hairstyle::Hairstyle(const Mesh& head, const HairstyleOptions& options, const Context& context)
    : Hairstyle(head, std::make_shared<const Scalp>(head, ScalpOptions{}, context), options,
                context) {}

Hairstyle::~Hairstyle() = default;
Hairstyle::Hairstyle(Hairstyle&&) noexcept = default;
Hairstyle& Hairstyle::operator=(Hairstyle&&) noexcept = default;

const Scalp& Hairstyle::scalp() const {
    return *state_->scalp;
}
const std::shared_ptr<const Scalp>& Hairstyle::shared_scalp() const {
    return state_->scalp;
}
const HairstyleOptions& Hairstyle::options() const {
    return state_->options;
}
const Mesh& Hairstyle::head() const {
    return state_->head;
}
const HairField& Hairstyle::field() const {
    return state_->field.field();
}
double Hairstyle::surface_distance(const Vec3& point) const {
    return state_->surface(point);
}

// ---- Curves

CurveId Hairstyle::add(StreamCurve curve) {
    return add(StyleCurve{.shape = std::move(curve)});
}

CurveId Hairstyle::add(DividingCurve curve) {
    return add(StyleCurve{.shape = std::move(curve)});
}

CurveId Hairstyle::add(Ponytail curve) {
    return add(StyleCurve{.shape = std::move(curve)});
}

CurveId Hairstyle::add(StyleCurve curve) {
    StyleInputs wanted = inputs();
    const CurveId id{state_->last_id + 1};
    const std::int64_t edit = next_edit(wanted);
    wanted.curves.push_back({id, std::move(curve), edit});
    state_->accept(std::move(wanted));
    state_->last_id = id.value;
    return id;
}

std::vector<CurveId> Hairstyle::add_all(std::vector<StyleCurve> curves, const Context& context) {
    StyleInputs wanted = inputs();
    const std::size_t known = wanted.curves.size();
    std::vector<CurveId> ids;
    std::int64_t edit = next_edit(wanted);
    for (StyleCurve& curve : curves) {
        const CurveId id{state_->last_id + 1 + static_cast<ConstraintOwner>(ids.size())};
        ids.push_back(id);
        wanted.curves.push_back({id, std::move(curve), edit++});
    }
    state_->accept(std::move(wanted),
                   {*state_->scalp, field().distances(), state_->gathers(), true, known}, context);
    if (!ids.empty()) state_->last_id = ids.back().value;
    return ids;
}

void Hairstyle::set(CurveId id, StyleCurve curve) {
    StyleInputs wanted = inputs();
    PlacedCurve& placed = placed_curve(wanted, id);
    placed.curve = std::move(curve);
    placed.edit = next_edit(wanted);
    state_->accept(std::move(wanted));
}

void Hairstyle::set_points(CurveId id, std::vector<Vec3> points) {
    StyleCurve changed = curve(id);
    drawn_points(changed) = std::move(points);
    set(id, std::move(changed));
}

void Hairstyle::enable(CurveId id, bool on) {
    StyleCurve changed = curve(id);
    if (changed.enabled == on) return;
    changed.enabled = on;
    set(id, std::move(changed));
}

void Hairstyle::remove(CurveId id) {
    StyleInputs wanted = inputs();
    wanted.curves.erase(wanted.curves.begin() + (&placed_curve(wanted, id) - wanted.curves.data()));
    state_->accept(std::move(wanted));
}

void Hairstyle::reorder(CurveId id, Index place) {
    StyleInputs wanted = inputs();
    reorder_curve(wanted, id, place);
    state_->accept(std::move(wanted));
}

std::span<const CurveId> Hairstyle::curves() const {
    return state_->style.ids;
}

bool Hairstyle::has(CurveId id) const {
    const std::span<const CurveId> ids = curves();
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

const StyleCurve& Hairstyle::curve(CurveId id) const {
    return placed_curve(inputs(), id).curve;
}

const std::vector<Vec3>& Hairstyle::course(CurveId id) const {
    return state_->style.derived(id).course;
}

const TiltFit& Hairstyle::tilt(CurveId id) const {
    const DerivedCurve& derived = state_->style.derived(id);
    require(derived.tilt.has_value(), "only a dividing curve has tilts; this is a " +
                                          std::string(kind_name(curve(id))) + " curve");
    return *derived.tilt;
}

void Hairstyle::add_hint(CurveId id, std::vector<Vec3> hint) {
    (void)tilt(id);
    require_hint(*state_->style.derived(id).line, hint);
    StyleCurve changed = curve(id);
    std::get<DividingCurve>(changed.shape).hints.push_back(std::move(hint));
    set(id, std::move(changed));
}

const HairTie& Hairstyle::tie(CurveId id) const {
    const DerivedCurve& derived = state_->style.derived(id);
    require(derived.tie.has_value(),
            "only a ponytail has a tie; this is a " + std::string(kind_name(curve(id))) + " curve");
    return *derived.tie;
}

std::vector<StyleConstraint> Hairstyle::constraints() const {
    std::vector<ConstraintOwner> owners;
    const std::vector<GridConstraint> decisive = decisive_constraints(state_->style, owners);
    std::vector<StyleConstraint> result;
    for (std::size_t i = 0; i < decisive.size(); ++i) {
        const GridConstraint& one = decisive[i];
        StyleConstraint& listed = result.emplace_back();
        listed.point = layout().point(one.point);
        listed.vector = one.value;
        listed.kind = static_cast<ConstraintKind>(one.tag);
        if (owners[i] != kScalpOwner) listed.curve = CurveId{owners[i]};
        listed.weight = one.weight;
    }
    return result;
}

std::span<const MaskStroke> Hairstyle::masks() const {
    return inputs().masks;
}

void Hairstyle::add_mask(MaskStroke stroke) {
    require_mask(stroke);
    StyleInputs wanted = inputs();
    wanted.masks.push_back(std::move(stroke));
    state_->accept(std::move(wanted));
}

void Hairstyle::clear_masks(MaskKind kind) {
    StyleInputs wanted = inputs();
    std::erase_if(wanted.masks, [&](const MaskStroke& one) { return one.kind == kind; });
    state_->accept(std::move(wanted));
}

const StyleInputs& Hairstyle::inputs() const {
    return state_->style.inputs;
}

void Hairstyle::restore(StyleInputs inputs) {
    require_inputs(inputs, field().grid().size());
    ConstraintOwner last = state_->last_id;
    for (const PlacedCurve& one : inputs.curves) last = std::max(last, one.id.value);
    state_->accept(std::move(inputs));
    state_->last_id = last;
}

// ---- The field

void Hairstyle::solve(const Context& context) {
    with_memory_errors(
        [&] { state_->field.solve(state_->style.claims, state_->gravity(), context); });
}

bool Hairstyle::solved() const {
    return state_->field.solved(state_->style.claims);
}

bool Hairstyle::State::over_scalp(const Vec3& point) const {
    return scalp->region().contains(scalp->tree().nearest(scalp->from_metres(point)).vertex);
}

std::vector<GridConstraint> Hairstyle::State::scalp_step(const ScalpStepOptions& wanted) const {
    ScalpStepOptions all = wanted;
    all.scalp = [&](const Vec3& point) {
        return over_scalp(point) && (!wanted.scalp || wanted.scalp(point));
    };
    std::vector<GridConstraint> step = lissom::scalp_step(field.field(), all);
    for (GridConstraint& one : step) one.tag = static_cast<int>(ConstraintKind::scalp);
    return step;
}

void Hairstyle::avoid_scalp(const ScalpStepOptions& options, const Context& context) {
    DerivedStyle before = state_->style;
    std::vector<float> values(field().values().begin(), field().values().end());
    try {
        forget_scalp();
        solve(context);
        StyleInputs wanted = inputs();
        wanted.scalp_step = state_->scalp_step(options);
        wanted.scalp_edit = next_edit(wanted);
        state_->accept(std::move(wanted));
        solve(context);
    } catch (...) {
        state_->style = std::move(before);
        state_->field.put_back(std::move(values));
        throw;
    }
}

void Hairstyle::forget_scalp() {
    StyleInputs wanted = inputs();
    wanted.scalp_step.clear();
    wanted.scalp_edit = 0;
    state_->accept(std::move(wanted));
}

bool Hairstyle::avoids_scalp() const {
    return !inputs().scalp_step.empty();
}

// ---- Hair

std::vector<HairTie> Hairstyle::State::ties(std::vector<std::string>& names) const {
    std::vector<HairTie> result;
    for (std::size_t c = 0; c < style.ids.size(); ++c) {
        const StyleCurve& one = style.inputs.curves[c].curve;
        if (!one.enabled || !style.curves[c]->tie) continue;
        result.push_back(*style.curves[c]->tie);
        names.push_back(one.name.empty() ? "ponytail " + std::to_string(result.size()) : one.name);
    }
    return result;
}

FieldGravity Hairstyle::State::gravity() const {
    FieldGravity result{.amount = options.gravity};
    std::vector<std::string> names;
    for (const HairTie& tie : ties(names)) result.ties.push_back(tie.center);
    return result;
}

HairOptions Hairstyle::default_hair() const {
    if (options().fidelity == HairFidelity::lissom) return {};
    HairOptions hair;
    hair.roots.pattern = RootPattern::steps;
    hair.growth = growth_options_with(options().fidelity);
    hair.growth.length = longest_hair(layout());
    return hair;
}

GrowthReport Hairstyle::grow(const HairOptions& options, Strands& strands, const Context& context) {
    State& s = *state_;
    const std::vector<PlacedCurve>& all = inputs().curves;
    if (std::none_of(all.begin(), all.end(),
                     [](const PlacedCurve& one) { return one.curve.enabled; })) {
        throw Error(ErrorCode::invalid_argument,
                    "a hairstyle without curves says nothing of hair; add a curve, or enable one");
    }
    return with_memory_errors([&] {
        solve(context);
        RootOptions roots = options.roots;
        append_masks(inputs().masks, MaskKind::density, roots.masks);
        update_roots(s.roots, {s.original, s.head, *s.scalp}, roots, s.style, context);
        GrowthOptions growth = options.growth;
        append_masks(inputs().masks, MaskKind::length, growth.masks);
        growth.placement = placement_of(*s.scalp);
        std::vector<std::string> names;
        growth.ties = s.ties(names);
        GrowthReport report = s.roots->grower.grow(field(), growth, strands, context);
        label_strands(strands, s.roots->uvs, report.ties, std::move(names));
        warn_of_short_hair(report, strands.size(), context);
        return report;
    });
}

Strands Hairstyle::grow(const HairOptions& options, const Context& context) {
    Strands result;
    grow(options, result, context);
    return result;
}

Strands Hairstyle::grow() {
    return grow(default_hair());
}

std::size_t Hairstyle::memory_bytes() const {
    const State& s = *state_;
    std::size_t constraints = 0;
    for (const CurveClaim& claim : s.style.claims) constraints += claim.constraints.size();
    const std::size_t vertices = s.head.vertex_count();
    const std::size_t points = layout().size();
    const std::size_t roots = s.roots ? s.roots->uvs.size() : 0;
    return GridField::predicted_bytes(field().grid().size(), constraints, s.options.field) +
           13 * points * sizeof(float) + 4 * vertices * sizeof(Vec3) + roots * 64;
}

const GridLayout& Hairstyle::layout() const {
    return field().layout();
}

}  // namespace lissom
