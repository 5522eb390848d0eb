// Hairstyles and strands.
#include <optional>

#include "bindings/c/data.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/io/strand_file.h"
#include "kernel/io/style_file.h"

namespace lissom::c {
namespace {

std::optional<Vec3> direction_if_given(const lissom_context& context, const double direction[3]) {
    const Vec3 given = context.space.to_kernel(direction);
    return given.isZero(0.0) ? std::nullopt : std::optional(given);
}

std::shared_ptr<const Scalp> scalp_of(lissom_context& context, const Mesh& head,
                                      const lissom_hairstyle_options& taken) {
    ScalpOptions options;
    if (taken.unit != 0.0) options.unit = taken.unit;
    if (taken.scalp.id != 0) options.region = region_of(context, taken.scalp);
    options.hints.up = direction_if_given(context, taken.up);
    options.hints.front = direction_if_given(context, taken.front);
    return std::make_shared<const Scalp>(head, options, context.kernel);
}

Hairstyle& style_of(lissom_context& context, lissom_hairstyle style) {
    return context.content<Hairstyle>(style.id, Kind::hairstyle);
}

void add_style(lissom_context& context, const Mesh& head, Hairstyle made, lissom_hairstyle* style) {
    auto own = std::make_shared<Hairstyle>(std::move(made));
    context.sharing.belongs(own.get(), head);
    style->id = context.add(Kind::hairstyle, std::move(own));
}

CurveId curve_id(Index curve) {
    return CurveId{static_cast<ConstraintOwner>(curve)};
}

// Points of a host in metres of the scalp's frame.
std::vector<Vec3> style_points(const lissom_context& context, const Hairstyle& style,
                               const lissom_input* points) {
    std::vector<Vec3> result = read_points(points, context.space, "points");
    for (Vec3& point : result) point = style.scalp().to_metres(point);
    return result;
}

template <typename Shape>
lissom_status add_curve(lissom_context* context, lissom_hairstyle style, int32_t* curve,
                        FunctionRef<void(const Hairstyle&, Shape&)> fill) {
    return run(context, [&] {
        require_given(curve, "curve");
        Hairstyle& own = style_of(*context, style);
        Shape shape = curve_with<Shape>(own.options().fidelity);
        fill(own, shape);
        *curve = static_cast<int32_t>(own.add(StyleCurve{std::move(shape)}).value);
    });
}

HairOptions hair_options(const Hairstyle& style, const lissom_grow_options* given) {
    const auto taken = take_options(given, lissom_default_grow_options());
    require(taken.count >= 0, "count is negative");
    HairOptions options = style.default_hair();
    options.roots.count = taken.count;
    options.roots.seed = taken.seed;
    options.growth.length = taken.length;
    options.growth.variation = taken.variation;
    options.growth.seed = taken.seed;
    return options;
}

std::uint64_t add_strands(lissom_context& context, Strands&& strands) {
    return context.add(Kind::strands, context.sharing.make_strands(std::move(strands)));
}

Strands& strands_of(lissom_context& context, lissom_strands strands) {
    return context.content<Strands>(strands.id, Kind::strands);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_hairstyle_options lissom_default_hairstyle_options(void) {
    lissom_hairstyle_options options{};
    options.struct_size = sizeof options;
    options.resolution = HairstyleOptions().resolution;
    options.gravity = HairstyleOptions().gravity;
    return options;
}

lissom_grow_options lissom_default_grow_options(void) {
    const GrowthOptions growth;
    lissom_grow_options options{};
    options.struct_size = sizeof options;
    options.count = 100000;
    options.seed = 1;
    options.length = growth.length;
    options.variation = growth.variation;
    return options;
}

lissom_status lissom_hairstyle_create(lissom_context* context, lissom_mesh head,
                                      const lissom_hairstyle_options* options,
                                      lissom_hairstyle* style) {
    return run(context, [&] {
        require_given(style, "style");
        const auto taken = take_options(options, lissom_default_hairstyle_options());
        const Mesh& own = mesh_of(*context, head);
        HairstyleOptions kernel;
        kernel.resolution = taken.resolution;
        kernel.gravity = taken.gravity;
        add_style(*context, own,
                  Hairstyle(own, scalp_of(*context, own, taken), kernel, context->kernel), style);
    });
}

lissom_status lissom_hairstyle_decode(lissom_context* context, const void* text, size_t size,
                                      lissom_mesh head, const lissom_hairstyle_options* options,
                                      lissom_hairstyle* style) {
    return run(context, [&] {
        require_given(text, "text");
        require_given(style, "style");
        const auto taken = take_options(options, lissom_default_hairstyle_options());
        const Mesh& own = mesh_of(*context, head);
        add_style(*context, own,
                  make_style(decode_style({static_cast<const char*>(text), size}), own,
                             scalp_of(*context, own, taken), context->kernel),
                  style);
    });
}

lissom_status lissom_hairstyle_encode(lissom_context* context, lissom_hairstyle style,
                                      lissom_bytes* text) {
    return run(context, [&] {
        require_given(text, "text");
        context->bytes = encode_style(content_of(style_of(*context, style)));
        *text = {context->bytes.data(), context->bytes.size()};
    });
}

lissom_status lissom_hairstyle_at(lissom_context* context, lissom_hairstyle style, double azimuth,
                                  double elevation, double lift, double point[3]) {
    return run(context, [&] {
        require_given(point, "point");
        const Vec3 own = context->space.to_host(
            style_of(*context, style).scalp().at({azimuth, elevation}, lift).position);
        for (int k = 0; k < 3; ++k) point[k] = own[k];
    });
}

lissom_status lissom_hairstyle_normal_at(lissom_context* context, lissom_hairstyle style,
                                         double azimuth, double elevation, double normal[3]) {
    return run(context, [&] {
        require_given(normal, "normal");
        const Vec3 own = context->space.to_host(
            style_of(*context, style).scalp().at({azimuth, elevation}, 0.0).normal);
        for (int k = 0; k < 3; ++k) normal[k] = own[k];
    });
}

lissom_status lissom_hairstyle_unit(lissom_context* context, lissom_hairstyle style, double* metres,
                                    double* scale) {
    return run(context, [&] {
        const Scalp& scalp = style_of(*context, style).scalp();
        if (metres) *metres = scalp.unit();
        if (scale) *scale = scalp.scale();
    });
}

lissom_status lissom_hairstyle_add_stream(lissom_context* context, lissom_hairstyle style,
                                          const lissom_input* points, int32_t* curve) {
    return add_curve<StreamCurve>(context, style, curve, [&](const Hairstyle& own, auto& shape) {
        shape.points = style_points(*context, own, points);
    });
}

lissom_status lissom_hairstyle_add_dividing(lissom_context* context, lissom_hairstyle style,
                                            const lissom_input* points, int32_t* curve) {
    return add_curve<DividingCurve>(context, style, curve, [&](const Hairstyle& own, auto& shape) {
        shape.points = style_points(*context, own, points);
    });
}

lissom_status lissom_hairstyle_add_ponytail(lissom_context* context, lissom_hairstyle style,
                                            const lissom_input* spine, double radius,
                                            int32_t* curve) {
    return add_curve<Ponytail>(context, style, curve, [&](const Hairstyle& own, auto& shape) {
        shape.spine = style_points(*context, own, spine);
        if (radius != 0.0) shape.options.radius = radius / own.scalp().scale();
    });
}

lissom_status lissom_curve_set_points(lissom_context* context, lissom_hairstyle style,
                                      int32_t curve, const lissom_input* points) {
    return run(context, [&] {
        Hairstyle& own = style_of(*context, style);
        own.set_points(curve_id(curve), style_points(*context, own, points));
    });
}

lissom_status lissom_curve_enable(lissom_context* context, lissom_hairstyle style, int32_t curve,
                                  bool on) {
    return run(context, [&] { style_of(*context, style).enable(curve_id(curve), on); });
}

lissom_status lissom_curve_remove(lissom_context* context, lissom_hairstyle style, int32_t curve) {
    return run(context, [&] { style_of(*context, style).remove(curve_id(curve)); });
}

int32_t lissom_hairstyle_curve_count(lissom_context* context, lissom_hairstyle style) {
    if (!context) return -1;
    return context->count([&] { return count_of(style_of(*context, style).curves()); });
}

lissom_status lissom_hairstyle_read_curves(lissom_context* context, lissom_hairstyle style,
                                           const lissom_output* curves) {
    return run(context, [&] {
        std::vector<Index> numbers;
        for (const CurveId id : style_of(*context, style).curves()) {
            numbers.push_back(static_cast<Index>(id.value));
        }
        write_integers(curves, numbers, "curves");
    });
}

lissom_status lissom_hairstyle_field(lissom_context* context, lissom_hairstyle style,
                                     const double point[3], double direction[3]) {
    return run(context, [&] {
        require_given(point, "point");
        require_given(direction, "direction");
        const Hairstyle& own = style_of(*context, style);
        require(own.solved(), "the style is not solved: call lissom_hairstyle_solve first");
        const Scalp& scalp = own.scalp();
        const auto here = own.field().sample(scalp.to_metres(context->space.to_kernel(point)));
        const Vec3 result = context->space.to_host(Vec3(scalp.frame().axes * here.direction));
        for (int k = 0; k < 3; ++k) direction[k] = result[k];
    });
}

lissom_status lissom_hairstyle_solve(lissom_context* context, lissom_hairstyle style) {
    return run(context, [&] { style_of(*context, style).solve(context->kernel); });
}

lissom_status lissom_hairstyle_begin_solve(lissom_context* context, lissom_hairstyle style,
                                           lissom_job* job) {
    return run(context, [&] {
        const auto own = context->share<Hairstyle>(style.id, Kind::hairstyle);
        begin_job(
            *context,
            {{{style.id, Kind::hairstyle}}, [own](const Context& inner) { own->solve(inner); }},
            job);
    });
}

lissom_status lissom_hairstyle_grow(lissom_context* context, lissom_hairstyle style,
                                    const lissom_grow_options* options, lissom_strands* strands) {
    return run(context, [&] {
        require_given(strands, "strands");
        Hairstyle& own = style_of(*context, style);
        const HairOptions wanted = hair_options(own, options);
        if (strands->id != 0) {
            own.grow(wanted, strands_of(*context, *strands), context->kernel);
        } else {
            strands->id = add_strands(*context, own.grow(wanted, context->kernel));
        }
    });
}

lissom_status lissom_hairstyle_begin_grow(lissom_context* context, lissom_hairstyle style,
                                          const lissom_grow_options* options, lissom_job* job) {
    return run(context, [&] {
        require_given(job, "job");
        const auto own = context->share<Hairstyle>(style.id, Kind::hairstyle);
        const HairOptions wanted = hair_options(*own, options);
        const auto made = std::make_shared<Strands>();
        begin_job(*context,
                  {{{style.id, Kind::hairstyle}},
                   [own, wanted, made](const Context& inner) { own->grow(wanted, *made, inner); },
                   [context, made](JobResult& result) {
                       result.objects[0] = add_strands(*context, std::move(*made));
                   }},
                  job);
    });
}

// ---- Strands

lissom_status lissom_strands_create(lissom_context* context, const lissom_input* points,
                                    const lissom_input* offsets, lissom_strands* strands) {
    return run(context, [&] {
        require_given(strands, "strands");
        std::vector<float> coordinates;
        for (const Vec3& point : read_points(points, context->space, "points")) {
            if (!point.allFinite()) {
                throw Error(ErrorCode::not_finite, "points: a coordinate of point " +
                                                       std::to_string(coordinates.size() / 3) +
                                                       " is NaN or infinite");
            }
            for (int k = 0; k < 3; ++k) coordinates.push_back(static_cast<float>(point[k]));
        }
        strands->id =
            add_strands(*context, Strands(std::move(coordinates), read_integers(offsets, "offsets"),
                                          context->kernel.memory()));
    });
}

lissom_status lissom_strands_load(lissom_context* context, const char* path,
                                  lissom_strands* strands) {
    return run(context, [&] {
        require_given(strands, "strands");
        strands->id = add_strands(
            *context, load_strands(path_of(given_text(path, "path")), {}, context->kernel));
    });
}

lissom_status lissom_strands_begin_load(lissom_context* context, const char* path,
                                        lissom_job* job) {
    return run(context, [&] {
        const auto made = std::make_shared<Strands>();
        begin_job(*context,
                  {{},
                   [made, file = path_of(given_text(path, "path"))](const Context& inner) {
                       *made = load_strands(file, {}, inner);
                   },
                   [context, made](JobResult& result) {
                       result.objects[0] = add_strands(*context, std::move(*made));
                   }},
                  job);
    });
}

lissom_status lissom_strands_begin_save(lissom_context* context, lissom_strands strands,
                                        const char* path, lissom_job* job) {
    return run(context, [&] {
        const auto own = context->share<Strands>(strands.id, Kind::strands);
        begin_job(*context,
                  {{{strands.id, Kind::strands}},
                   [own, file = path_of(given_text(path, "path"))](const Context& inner) {
                       save_strands(*own, file, {}, inner);
                   }},
                  job);
    });
}

lissom_status lissom_strands_save(lissom_context* context, lissom_strands strands,
                                  const char* path) {
    return run(context, [&] {
        save_strands(strands_of(*context, strands), path_of(given_text(path, "path")), {},
                     context->kernel);
    });
}

int32_t lissom_strands_size(lissom_context* context, lissom_strands strands) {
    return context ? context->count([&] { return strands_of(*context, strands).size(); }) : -1;
}

int32_t lissom_strands_point_count(lissom_context* context, lissom_strands strands) {
    if (!context) return -1;
    return context->count([&] { return strands_of(*context, strands).point_count(); });
}

lissom_status lissom_strands_read_points(lissom_context* context, lissom_strands strands,
                                         const lissom_output* points) {
    return run(context, [&] {
        const Strands& own = strands_of(*context, strands);
        const auto values = own.points();
        write_points(points, at(own.point_count()), "points", [&](std::size_t i) {
            return context->space.to_host(
                Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]));
        });
    });
}

lissom_status lissom_strands_read_offsets(lissom_context* context, lissom_strands strands,
                                          const lissom_output* offsets) {
    return run(context, [&] {
        write_integers(offsets, strands_of(*context, strands).offsets(), "offsets");
    });
}

}  // extern "C"
