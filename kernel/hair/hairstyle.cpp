#include "kernel/hair/hairstyle.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "kernel/core/machine_memory.h"
#include "kernel/core/memory_error.h"
#include "kernel/hair/curve_conflicts.h"
#include "kernel/hair/curve_derivation.h"
#include "kernel/hair/scalp/root_uvs.h"
#include "kernel/hair/scalp/surface_distance.h"
#include "kernel/hair/style_roots.h"

namespace lissom {
namespace {

// Owner of the constraints of the scalp step; those of curves are above it.
constexpr ConstraintOwner kScalpOwner = 0;

// Seconds for making and solving a large grid, about, on one thread of a common processor.
constexpr double kSecondsAPoint = 1.5e-6;

// Who yields to whom at a grid point.
constexpr int kScalpRank = -1, kCurveRank = 0, kDividingRank = 1;

struct PlacedCurve {
    CurveId id;
    StyleCurve curve;
    DerivedCurve derived;
};

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

bool same(const std::vector<GridConstraint>& a, const std::vector<GridConstraint>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const GridConstraint& x, const GridConstraint& y) {
                          return x.point == y.point && x.value == y.value && x.weight == y.weight;
                      });
}

GridLayout layout_of(const HairstyleOptions& options) {
    return fit_grid(options.volume.value_or(Scalp::default_volume()), options.resolution);
}

// The field, the distance with its sign and gradient, and all as they are read.
std::size_t needed_bytes(const GridLayout& layout, const GridFieldOptions& field) {
    const auto points = static_cast<std::size_t>(layout.size());
    const auto [nx, ny, nz] = layout.counts;
    return GridField::predicted_bytes({nx, ny, nz}, 0, field) +
           points * (9 * sizeof(float) + sizeof(std::uint8_t));
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
         "have as many segments as allowed before they are as long as asked; raise most_segments");
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
    const double points = layout.size(),
                 share = static_cast<double>(room) / static_cast<double>(needed);
    throw Error(ErrorCode::memory_limit,
                "a hairstyle of " + std::to_string(layout.size()) + " grid points needs about " +
                    quantity(static_cast<double>(needed) / kGigabyte, "GB") + " and " +
                    quantity(kSecondsAPoint * points, "seconds") + ", but there are " +
                    quantity(static_cast<double>(room) / kGigabyte, "GB") +
                    "; a resolution of at most " +
                    std::to_string(static_cast<Index>(share * points)) +
                    " would fit, and 50000 do for most styles");
}

}  // namespace

struct Hairstyle::State {
    State(const Mesh& mesh, std::shared_ptr<const Scalp> made_for, const HairstyleOptions& wanted,
          const Context& context)
        : original(mesh),
          scalp_owner(std::move(made_for)),
          scalp(*scalp_owner),
          options(wanted),
          head(placed_head(mesh, scalp, context)),
          field(DistanceGrid(head, layout_of(wanted), {}, context), wanted.field, context),
          surface(scalp, field.distances(), head) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    DerivedCurve derived(const StyleCurve& curve) const {
        return derive(curve, scalp, field.distances());
    }
    PlacedCurve& at(CurveId id);
    void constraints_changed();
    void solve(const Context& context);
    bool bare(const Root& root) const;
    bool over_scalp(const Vec3& point) const;
    bool has_gaps() const;
    void prepare_roots(const RootOptions& wanted, const Context& context);
    std::vector<HairTie> ties(std::vector<std::string>& names) const;

    Mesh original;
    std::shared_ptr<const Scalp> scalp_owner;
    const Scalp& scalp;
    HairstyleOptions options;
    Mesh head;
    HairField field;
    SurfaceDistance surface;

    // In their order.
    std::vector<PlacedCurve> curves;
    std::vector<CurveId> order;
    ConstraintOwner last_id = kScalpOwner;
    std::vector<GridConstraint> scalp_step;
    // What the field was given by each owner.
    std::map<ConstraintOwner, std::vector<GridConstraint>> sent;

    // Of the last growth; none where partings have changed since.
    std::optional<RootOptions> root_options;
    std::optional<StrandGrower> grower;
    std::vector<Eigen::Vector2f> uvs;
};

PlacedCurve& Hairstyle::State::at(CurveId id) {
    const auto found = std::find(order.begin(), order.end(), id);
    if (found == order.end()) {
        throw Error(ErrorCode::handle_removed, "the curve was removed from its hairstyle");
    }
    return curves[static_cast<std::size_t>(found - order.begin())];
}

// Gives the field what the curves say now. Owners whose constraints stay the same are left alone,
// so that the next solve costs no more than what has changed.
void Hairstyle::State::constraints_changed() {
    order.clear();
    std::map<ConstraintOwner, std::vector<GridConstraint>> said;
    std::vector<ConstraintOwner> owners;
    std::vector<CurveClaim> claims;
    const auto claim = [&](ConstraintOwner owner, std::vector<GridConstraint> constraints,
                           int rank) {
        owners.push_back(owner);
        claims.push_back({std::move(constraints), rank});
    };
    claim(kScalpOwner, scalp_step, kScalpRank);
    for (const PlacedCurve& one : curves) {
        order.push_back(one.id);
        if (!one.curve.enabled) continue;
        const bool divides = std::holds_alternative<DividingCurve>(one.curve.shape);
        claim(one.id.value, one.derived.constraints, divides ? kDividingRank : kCurveRank);
    }
    settle_conflicts(claims);
    for (std::size_t c = 0; c < claims.size(); ++c) said[owners[c]] = claims[c].constraints;
    for (auto& [owner, constraints] : sent) {
        if (!said.contains(owner)) field.set_constraints(owner, {});
    }
    for (auto& [owner, constraints] : said) {
        const auto before = sent.find(owner);
        if (before != sent.end() && same(before->second, constraints)) continue;
        field.set_constraints(owner, constraints);
    }
    sent = std::move(said);
}

Hairstyle::Hairstyle(const Mesh& head, std::shared_ptr<const Scalp> scalp,
                     const HairstyleOptions& options, const Context& context) {
    if (scalp->region().topology() != head.shared_topology()) {
        throw Error(ErrorCode::topology_mismatch,
                    "the scalp was made for another head; make one for this head");
    }
    require_affordable(options, context);
    state_ = std::make_unique<State>(head, std::move(scalp), options, context);
}

Hairstyle::~Hairstyle() = default;
Hairstyle::Hairstyle(Hairstyle&&) noexcept = default;
Hairstyle& Hairstyle::operator=(Hairstyle&&) noexcept = default;

const Scalp& Hairstyle::scalp() const {
    return state_->scalp;
}
const std::shared_ptr<const Scalp>& Hairstyle::shared_scalp() const {
    return state_->scalp_owner;
}
const HairstyleOptions& Hairstyle::options() const {
    return state_->options;
}
const Mesh& Hairstyle::head() const {
    return state_->head;
}
const HairField& Hairstyle::field() const {
    return state_->field;
}
double Hairstyle::surface_distance(const Vec3& point) const {
    return state_->surface(point);
}

// ---- Curves

CurveId Hairstyle::add(StyleCurve curve) {
    DerivedCurve derived = state_->derived(curve);
    const CurveId id{++state_->last_id};
    if (derived.line) state_->root_options.reset();
    state_->curves.push_back({id, std::move(curve), std::move(derived)});
    state_->constraints_changed();
    return id;
}

void Hairstyle::set(CurveId id, StyleCurve curve) {
    PlacedCurve& placed = state_->at(id);
    DerivedCurve derived = state_->derived(curve);
    if (placed.derived.line || derived.line) state_->root_options.reset();
    placed.curve = std::move(curve);
    placed.derived = std::move(derived);
    state_->constraints_changed();
}

void Hairstyle::set_points(CurveId id, std::vector<Vec3> points) {
    StyleCurve changed = curve(id);
    drawn_points(changed) = std::move(points);
    set(id, std::move(changed));
}

void Hairstyle::enable(CurveId id, bool on) {
    PlacedCurve& placed = state_->at(id);
    if (placed.curve.enabled == on) return;
    placed.curve.enabled = on;
    if (placed.derived.line) state_->root_options.reset();
    state_->constraints_changed();
}

void Hairstyle::remove(CurveId id) {
    const PlacedCurve& placed = state_->at(id);
    if (placed.derived.line) state_->root_options.reset();
    state_->curves.erase(state_->curves.begin() + (&placed - state_->curves.data()));
    state_->constraints_changed();
}

void Hairstyle::reorder(CurveId id, Index place) {
    const auto from = state_->curves.begin() + (&state_->at(id) - state_->curves.data());
    const auto count = static_cast<Index>(state_->curves.size());
    if (place < 0 || place >= count) {
        throw Error(ErrorCode::out_of_range, "a hairstyle of " + std::to_string(count) +
                                                 " curves has no place " + std::to_string(place));
    }
    const auto to = state_->curves.begin() + place;
    if (from < to) {
        std::rotate(from, from + 1, to + 1);
    } else {
        std::rotate(to, from, from + 1);
    }
    state_->constraints_changed();
}

std::span<const CurveId> Hairstyle::curves() const {
    return state_->order;
}

bool Hairstyle::has(CurveId id) const {
    return std::find(state_->order.begin(), state_->order.end(), id) != state_->order.end();
}

const StyleCurve& Hairstyle::curve(CurveId id) const {
    return state_->at(id).curve;
}

const std::vector<Vec3>& Hairstyle::course(CurveId id) const {
    return state_->at(id).derived.course;
}

std::vector<StyleConstraint> Hairstyle::constraints() const {
    const State& s = *state_;
    std::vector<ConstraintOwner> owners = {kScalpOwner};
    for (const CurveId id : s.order) owners.push_back(id.value);
    struct Said {
        ConstraintOwner owner;
        const GridConstraint* constraint;
    };
    std::map<Index, Said> decisive;
    const auto divides = [&](ConstraintOwner owner) {
        return owner != kScalpOwner &&
               std::holds_alternative<DividingCurve>(curve(CurveId{owner}).shape);
    };
    for (const ConstraintOwner owner : owners) {
        const auto sent = s.sent.find(owner);
        if (sent == s.sent.end()) continue;
        for (const GridConstraint& one : sent->second) {
            const auto [found, is_new] = decisive.try_emplace(one.point, Said{owner, &one});
            if (is_new || (divides(found->second.owner) && !divides(owner))) continue;
            found->second = {owner, &one};
        }
    }
    std::vector<StyleConstraint> result;
    for (const auto& [point, said] : decisive) {
        const GridConstraint& one = *said.constraint;
        StyleConstraint& listed = result.emplace_back();
        listed.point = layout().point(point);
        listed.vector = one.value;
        listed.kind = static_cast<ConstraintKind>(one.tag);
        if (said.owner != kScalpOwner) listed.curve = CurveId{said.owner};
        listed.weight = one.weight;
    }
    return result;
}

// ---- The field

void Hairstyle::solve(const Context& context) try {
    if (!solved()) state_->field.solve(context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

bool Hairstyle::solved() const {
    return state_->field.grid().solved();
}

bool Hairstyle::State::over_scalp(const Vec3& point) const {
    return scalp.region().contains(scalp.tree().nearest(scalp.from_metres(point)).vertex);
}

void Hairstyle::avoid_scalp(const ScalpStepOptions& options, const Context& context) {
    std::vector<GridConstraint> before = std::exchange(state_->scalp_step, {});
    try {
        state_->constraints_changed();
        solve(context);
        ScalpStepOptions all = options;
        all.where = [&](const Vec3& point) {
            return state_->over_scalp(point) && (!options.where || options.where(point));
        };
        state_->scalp_step = scalp_step(state_->field, all);
        for (GridConstraint& one : state_->scalp_step) {
            one.tag = static_cast<int>(ConstraintKind::scalp);
        }
        state_->constraints_changed();
        solve(context);
    } catch (...) {
        state_->scalp_step = std::move(before);
        state_->constraints_changed();
        throw;
    }
}

void Hairstyle::forget_scalp() {
    state_->scalp_step.clear();
    state_->constraints_changed();
}

bool Hairstyle::avoids_scalp() const {
    return !state_->scalp_step.empty();
}

// ---- Hair

bool Hairstyle::State::has_gaps() const {
    return std::any_of(curves.begin(), curves.end(), [](const PlacedCurve& one) {
        return one.curve.enabled && one.derived.line && one.derived.gap > 0.0;
    });
}

bool Hairstyle::State::bare(const Root& root) const {
    const Vec3 p = scalp.to_metres(root.position);
    return std::any_of(curves.begin(), curves.end(), [&](const PlacedCurve& one) {
        return one.curve.enabled && one.derived.line &&
               one.derived.line->skin_distance(p) < 0.5 * one.derived.gap;
    });
}

// Prepares growth from `wanted` roots; keeps what is there where nothing has changed.
void Hairstyle::State::prepare_roots(const RootOptions& wanted, const Context& context) {
    if (root_options && *root_options == wanted) return;
    root_options.reset();
    std::function<bool(const Root&)> on_gap;
    if (has_gaps()) on_gap = [this](const Root& root) { return bare(root); };
    std::vector<Root> roots = roots_but_for(original, scalp, wanted, on_gap, context);
    uvs = root_uvs(original, scalp, roots);
    for (Root& root : roots) {
        root.position = scalp.to_metres(root.position);
        root.normal = scalp.frame().axes.transpose() * root.normal;
    }
    grower.emplace(head, roots, context);
    root_options = wanted;
}

std::vector<HairTie> Hairstyle::State::ties(std::vector<std::string>& names) const {
    std::vector<HairTie> result;
    for (const PlacedCurve& one : curves) {
        if (!one.curve.enabled || !one.derived.tie) continue;
        result.push_back(*one.derived.tie);
        names.push_back(one.curve.name.empty() ? "ponytail " + std::to_string(result.size())
                                               : one.curve.name);
    }
    return result;
}

GrowthReport Hairstyle::grow(const HairOptions& options, Strands& strands,
                             const Context& context) try {
    State& s = *state_;
    const bool any = std::any_of(s.curves.begin(), s.curves.end(),
                                 [](const PlacedCurve& one) { return one.curve.enabled; });
    if (!any) {
        throw Error(ErrorCode::invalid_argument,
                    "a hairstyle without curves says nothing of hair; add a curve, or enable one");
    }
    solve(context);
    s.prepare_roots(options.roots, context);
    GrowthOptions growth = options.growth;
    growth.placement = placement_of(s.scalp);
    std::vector<std::string> names;
    growth.ties = s.ties(names);
    GrowthReport report = s.grower->grow(s.field, growth, strands, context);
    warn_of_short_hair(report, strands.size(), context);
    StrandRoots roots = strands.roots();
    roots.uvs = s.uvs;
    strands.set_roots(std::move(roots));
    if (!names.empty()) strands.set_groups(std::move(report.ties), std::move(names));
    return report;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

Strands Hairstyle::grow(const HairOptions& options, const Context& context) {
    Strands result;
    grow(options, result, context);
    return result;
}

std::size_t Hairstyle::memory_bytes() const {
    const State& s = *state_;
    std::size_t constraints = 0;
    for (const auto& [owner, list] : s.sent) constraints += list.size();
    const auto vertices = static_cast<std::size_t>(s.head.vertex_count());
    const auto points = static_cast<std::size_t>(layout().size());
    return GridField::predicted_bytes(s.field.grid().size(), constraints, s.options.field) +
           9 * points * sizeof(float) + 4 * vertices * sizeof(Vec3) + s.uvs.size() * 64;
}

const GridLayout& Hairstyle::layout() const {
    return state_->field.layout();
}

}  // namespace lissom
