// lissom.Strands: parts and copies, transforms, widths, colours.
#include "kernel/hair/strands/strand_edit.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_methods.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/transform_options.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"
#include "kernel/hair/strands/strand_selection.h"

namespace lissom::lua {
namespace {

// ---- Choosing

// Asks the script's function about every strand; runs before any C++ object is alive, so that an
// error in it simply passes through.
std::span<const Index> ask_about_strands(Call& call) {
    lua_State* L = call.lua();
    const auto self = call.self<StrandsObject>();
    const Index count = self->strands.size();
    auto* selected = call.scratch<Index>(at(count));
    std::size_t size = 0;
    for (Index s = 0; s < count; ++s) {
        if (!self.get() || self->strands.size() != count) {
            call.raise("the function of 'where' must not change or close the strands");
        }
        lua_pushvalue(L, call.stack_index("where"));
        call.push_id(s);
        call.push_coordinates(self->strands.root(s).cast<double>());
        lua_call(L, 4, 1);
        if (lua_toboolean(L, -1)) selected[size++] = s;
        lua_pop(L, 1);
    }
    if (!self.get()) call.raise("the function of 'where' must not close the strands");
    return {selected, size};
}

// A script may well ask for a group that is absent.
int select_named(Call& call) {
    const char* group = call.string("group");
    const auto result = call.create<StrandsObject>();
    const bool done = call.attempt([&] {
        auto made = std::make_shared<StrandsObject>(select_group(strands_of(call), group));
        made->grown_on = call.self<StrandsObject>()->grown_on;
        result.set(std::move(made));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// Strands near a style curve, whose course becomes metres of the head as those of strands.
Strands select_near(const Call& call, const Strands& strands) {
    const auto curve = call.object<CurveObject>("near.curve");
    const Hairstyle& style = curve->owner->style();
    const Scalp& scalp = style.scalp();
    std::vector<Vec3> course = style.course(curve->id);
    for (Vec3& p : course) p = scalp.unit() * scalp.from_metres(p);
    const double radius = call.number("near.radius") * scalp.unit() * scalp.scale();
    return select(strands, strands_near_curve(strands, course, radius, call.context()));
}

int select_strands(Call& call) {
    std::span<const Index> list;
    if (call.has("where")) list = ask_about_strands(call);
    if (call.has("strands")) list = call.ids("strands");
    if (call.has("group")) return select_named(call);
    const auto selected = [&] {
        const Strands& all = strands_of(call);
        if (call.has("first")) return prefix(all, call.integer("first"));
        if (call.has("region")) {
            return select(all, strands_in_region(call, "region"));
        }
        if (call.has("near")) return select_near(call, all);
        return select(all, list);
    };
    return new_strands(call, selected, call.self<StrandsObject>()->grown_on);
}

int copy_strands(Call& call) {
    return new_strands(
        call, [&] { return Strands(strands_of(call)); }, call.self<StrandsObject>()->grown_on);
}

int append_strands(Call& call) {
    const auto other = call.object<StrandsObject>("other");
    return change_strands(call, [&](Strands& strands) {
        // A copy, because the others may be these.
        append(strands, Strands(other->strands));
    });
}

int assign_strands(Call& call) {
    const auto other = call.object<StrandsObject>("other");
    return change_strands(call, [&](Strands& strands) { strands = Strands(other->strands); });
}

int push_comment(Call& call) {
    return call.push(std::string_view(strands_of(call).comment()));
}

int set_comment(Call& call) {
    const std::string_view text = call.string("text");
    const auto self = call.self<StrandsObject>();
    return change_strands(call, [&](Strands& s) {
        call.reserve(self, text.size());
        s.set_comment(std::string(text));
    });
}

int transform_strands(Call& call) {
    const TransformOptions options = TransformOptions::read(call);
    return change_strands(call, [&](Strands& strands) {
        transform(strands, options.map(Vec3::Zero()), call.context());
    });
}

int resample_strands(Call& call) {
    ResampleOptions options;
    if (call.has("count")) options.count = call.integer("count");
    if (call.has("step")) options.step = call.number("step");
    return change_strands(
        call, [&](Strands& strands) { strands = resample(strands, options, call.context()); });
}

// ---- Widths and colours

// Domain of a list: one value for each strand, or for each point.
StrandDomain domain_of(std::size_t count, const Strands& strands, const char* what) {
    if (count == at(strands.size())) return StrandDomain::strand;
    if (count == at(strands.point_count())) return StrandDomain::point;
    throw Error(ErrorCode::invalid_argument,
                std::to_string(count) + " " + what + " were given for " +
                    std::to_string(strands.size()) + " strands of " +
                    std::to_string(strands.point_count()) +
                    " points; give one for each strand or one for each point");
}

std::vector<float> factors_of(std::span<const double> numbers, const char* what) {
    std::vector<float> result;
    for (const double number : numbers) {
        if (number < 0.0) {
            throw Error(ErrorCode::out_of_range, std::string(what) + " must not be negative");
        }
        result.push_back(number);
    }
    return result;
}

int set_widths(Call& call) {
    if (call.has("width") && call.has("widths")) {
        call.reject("widths", "give either 'width', one, or 'widths', a list");
    }
    if (!call.has("width") && !call.has("widths") && !call.has("profile")) {
        call.reject("width", "give 'width', 'widths' or 'profile'");
    }
    return change_strands(call, [&](Strands& strands) {
        StrandWidths widths = strands.widths();
        if (call.has("width")) {
            widths.common = call.number("width");
            widths.domain = StrandDomain::all;
            widths.values.clear();
        }
        if (call.has("widths")) {
            widths.values = factors_of(call.numbers("widths"), "widths");
            widths.domain = domain_of(widths.values.size(), strands, "widths");
        }
        if (call.has("profile")) {
            call.reserve(call.self<StrandsObject>(), 4 * call.numbers("profile").size());
            widths.profile = factors_of(call.numbers("profile"), "factors of a profile");
        }
        strands.set_widths(std::move(widths));
    });
}

Eigen::Vector3f linear_color(const Vec3& color) {
    if ((color.array() < 0.0).any()) {
        throw Error(ErrorCode::out_of_range, "parts of a colour must not be negative");
    }
    return color.cast<float>();
}

// Colours along each strand, for each of its points.
std::vector<Eigen::Vector3f> colors_along(const Strands& strands, std::span<const Vec3> profile) {
    if (profile.size() < 2) {
        throw Error(ErrorCode::invalid_argument,
                    "a profile of colours needs two or more, from the root to the tip");
    }
    std::vector<Eigen::Vector3f> steps, colors;
    for (const Vec3& color : profile) steps.push_back(linear_color(color));
    std::vector<double> t;
    for (Index s = 0; s < strands.size(); ++s) {
        arc_fractions(strands.strand(s), t);
        for (const double part : t) {
            const double place = part * static_cast<double>(steps.size() - 1);
            const auto below = std::min(static_cast<std::size_t>(place), steps.size() - 2);
            const auto share = static_cast<float>(place - static_cast<double>(below));
            colors.push_back(steps[below] + share * (steps[below + 1] - steps[below]));
        }
    }
    return colors;
}

int set_colors(Call& call) {
    return change_strands(call, [&](Strands& strands) {
        StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f::Zero()};
        if (call.has("color")) {
            colors.common = linear_color(call.vector("color"));
        } else if (call.has("profile")) {
            colors.values = colors_along(strands, call.points("profile"));
            colors.domain = StrandDomain::point;
        } else {
            for (const Vec3& color : call.points("colors")) {
                colors.values.push_back(linear_color(color));
            }
            colors.domain = domain_of(colors.values.size(), strands, "colours");
        }
        strands.set_colors(std::move(colors));
    });
}

}  // namespace

std::vector<Function> strand_edit_methods() {
    return {
        {.name = "select",
         .body = select_strands,
         .summary = "Some of the strands as new ones, with all that is known of them.",
         .options =
             {ids("strands", "Their numbers, in the order wanted.").optional(),
              string("group", "Those of a group.").optional(),
              object("region", "lissom.Region",
                     "Those rooted on a face of a region of the head that they grew on.")
                  .optional(),
              options(
                  "near",
                  {object("curve", "lissom.Curve", "A curve of a hairstyle."),
                   number("radius", "In metres of an average head.").at_least(0).defaults(0.02)},
                  "Those that come near a style curve.")
                  .optional(),
              integer("first", "So many from the beginning: a level of detail.")
                  .at_least(0)
                  .optional(),
              function("where", "fun(strand: integer, x: number, y: number, z: number): boolean",
                       "Those for which the function, asked with the root, returns true.")
                  .optional()},
         .one_option = true,
         .results = {{"lissom.Strands", "strands", "The new strands."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::handle_removed},
         .example = kTwoStrands + "assert(#hair:select{ first = 1 } == 1)"},
        {.name = "copy",
         .body = copy_strands,
         .summary = "A copy of all strands.",
         .results = {{"lissom.Strands", "strands", "The new strands."}},
         .example = kTwoStrands + "assert(#hair:copy() == #hair)"},
        {.name = "append",
         .body = append_strands,
         .summary = "Adds other strands after these. Groups of the same name become one.",
         .arguments = {object("other", "lissom.Strands", "The strands to add.")},
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument},
         .example = kTwoStrands + "assert(#hair:append(hair) == 4)"},
        {.name = "assign",
         .body = assign_strands,
         .summary = "Takes the content of other strands, with all that they know.",
         .arguments = {object("other", "lissom.Strands", "They stay as they are.")},
         .results = kSelfStrands,
         .errors = {ErrorCode::memory_limit},
         .example = kTwoStrands + "local other = hair:select{ first = 1 }\n"
                                  "assert(#other:assign(hair) == 2)"},
        {.name = "comment",
         .body = push_comment,
         .summary = "The comment of the strands, as of their file; that of hair which a groom "
                    "keeps in a scene is the text of the groom.",
         .results = {{"string", "text", "The comment, \"\" without one."}},
         .example = kTwoStrands + "assert(hair:comment() == \"\")"},
        {.name = "set_comment",
         .body = set_comment,
         .summary = "Replaces the comment, which scenes and files of hair keep (.hair the first "
                    "88 bytes).",
         .arguments = {string("text", "The comment.")},
         .results = kSelfStrands,
         .example = kTwoStrands + "assert(hair:set_comment(\"red\"):comment() == \"red\")"},
        {.name = "transform",
         .body = transform_strands,
         .summary = "Scales, then rotates, then translates all points. Widths scale too.",
         .options = transform_fields("the origin"),
         .results = kSelfStrands,
         .errors = {ErrorCode::singular_transform, ErrorCode::not_finite, ErrorCode::cancelled},
         .example = kTwoStrands + "hair:transform{ translate = { 0, 1.6, 0 } }"},
        {.name = "resample",
         .body = resample_strands,
         .summary = "Spreads points evenly along each strand; roots and tips stay.",
         .options = {integer("count", "Points of each strand.").at_least(2).optional(),
                     meters("step", "Distance of points.").above(0).optional()},
         .one_option = true,
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kTwoStrands + "assert(hair:resample{ count = 10 }:points():count() == 20)"},
        {.name = "set_widths",
         .body = set_widths,
         .summary = "Sets the thickness of strands; options that are not given stay. Pictures "
                    "and files have the widths, times the profile.",
         .options =
             {meters("width", "Diameter of all strands.").at_least(0).optional(),
              numbers("widths", "Diameters in metres, one a strand or one a point.").optional(),
              numbers("profile",
                      "Factors at equal steps from the root to the tip, linear "
                      "between; empty for none.")
                  .optional()},
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range},
         .example = kTwoStrands + "hair:set_widths{ width = 90e-6, profile = { 1, 1, 0.4 } }"},
        {.name = "set_colors",
         .body = set_colors,
         .summary = "Sets the colours of strands as linear red, green and blue, each 0 to 1; "
                    "pictures and files have them.",
         .options = {vector("color", "The colour of all strands.").optional(),
                     points("colors", "Colours, one a strand or one a point.").optional(),
                     points("profile",
                            "Colours at equal steps from the root to the tip, linear between: two "
                            "or more.")
                         .optional()},
         .one_option = true,
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range},
         .example = kTwoStrands + "hair:set_colors{ color = { 0.26, 0.15, 0.075 } }"}};
}

}  // namespace lissom::lua
