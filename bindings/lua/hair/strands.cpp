// lissom.Strands: the type, and strands of given points.
#include <algorithm>

#include <cstdio>

#include "bindings/lua/hair/engine/cards_object.h"
#include "bindings/lua/hair/engine/guide_set_object.h"
#include "bindings/lua/hair/engine/strand_check.h"
#include "bindings/lua/hair/strands_methods.h"

namespace lissom::lua {
namespace {

template <typename Value>
bool fits(const StrandValues<Value>& values, const Strands& from, const Strands& to) {
    const std::span<const Index> a = from.offsets(), b = to.offsets();
    return values.domain != StrandDomain::point ||
           std::equal(a.begin(), a.end(), b.begin(), b.end());
}

// Gives strands all that is known of others of the same number; values of points if these are as
// many.
void take_over(Strands& to, const Strands& from) {
    if (to.size() != from.size()) {
        throw Error(ErrorCode::invalid_argument,
                    "the strands of 'like' are " + std::to_string(from.size()) + ", not " +
                        std::to_string(to.size()) + ", one for each new strand");
    }
    to.set_roots(from.roots());
    std::vector<std::uint32_t> ids;
    for (Index s = 0; s < from.size(); ++s) ids.push_back(from.id(s));
    to.set_ids(std::move(ids));
    to.set_groups(from.groups(), from.group_names());
    to.set_guides(from.guides());
    if (fits(from.widths(), from, to)) to.set_widths(from.widths());
    if (fits(from.transparency(), from, to)) to.set_transparency(from.transparency());
    if (from.colors() && fits(*from.colors(), from, to)) to.set_colors(*from.colors());
}

int make_strands(Call& call) {
    const auto points = call.points("points");
    const auto counts = call.ids("counts");
    return new_strands(call, [&] {
        std::vector<float> numbers;
        for (const Vec3& p : points) {
            for (const double x : p) numbers.push_back(x);
        }
        std::vector<Index> offsets = {0};
        for (const Index count : counts) {
            if (count > count_of(points) - offsets.back()) {
                throw Error(ErrorCode::invalid_argument, "the counts add up to more than the " +
                                                             std::to_string(points.size()) +
                                                             " points");
            }
            offsets.push_back(offsets.back() + count);
        }
        Strands made(std::move(numbers), std::move(offsets), call.context().memory());
        if (call.has("like")) take_over(made, call.object<StrandsObject>("like")->strands);
        return made;
    });
}

int strand_count(Call& call) {
    return call.push(strands_of(call).size());
}

int strands_text(Call& call) {
    char text[96];
    const int length = std::snprintf(text, sizeof text, "lissom.Strands: %d strands, %d points",
                                     strands_of(call).size(), strands_of(call).point_count());
    return call.push(std::string_view(text, length));
}

}  // namespace

Type strands_type() {
    Type type{
        .name = "lissom.Strands",
        .summary =
            "Hair: polylines from root to tip, in metres. Strands count from 1. "
            "Operators never move roots, and their effect on a strand does not depend on the "
            "number of strands.",
        .close = [](void* object) { static_cast<StrandsObject*>(object)->strands = Strands(); }};
    type.operators = {{"__len", strand_count, "#strands", "number of strands"},
                      {"__tostring", strands_text, "tostring(strands)", "counts"}};
    type.methods = strand_content_methods();
    type.methods.push_back(strands_save_method());
    for (Function& method : strand_edit_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_operator_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_lock_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_shape_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_fill_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_detail_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_braid_methods()) type.methods.push_back(std::move(method));
    type.methods.push_back(guide_set_method());
    type.methods.push_back(cards_method());
    type.methods.push_back(strand_check_method());
    for (Function& method : strand_follow_methods()) type.methods.push_back(std::move(method));
    for (Function& method : strand_level_methods()) type.methods.push_back(std::move(method));
    return type;
}

std::vector<Function> strand_functions() {
    return {load_strands_function(),
            {.name = "strands",
             .body = make_strands,
             .summary = "Strands of given points.",
             .options = {points("points", "The points of all strands, root to tip, in metres."),
                         integers("counts", "Number of points of each strand.").at_least(1),
                         object("like", "lissom.Strands",
                                "As many strands, whose roots, groups, ids, guides, widths and "
                                "colours the new ones have.")
                             .optional("none")},
             .results = {{"lissom.Strands", "strands", "The new strands."}},
             .errors = {ErrorCode::invalid_argument},
             .example = kTwoStrands + "assert(#hair == 2)"}};
}

std::vector<Record> strand_records() {
    return {{"lissom.StrandStats",
             "Measures of strands.",
             {{"integer", "strands", "Number of strands."},
              {"integer", "points", "Number of points."},
              {"integer", "min_points", "Fewest points of a strand."},
              {"integer", "max_points", "Most points of a strand."},
              {"number", "min_length", "Length of the shortest, in metres."},
              {"number", "mean_length", "Mean length, in metres."},
              {"number", "max_length", "Length of the longest, in metres."},
              {"number", "max_turn", "Greatest angle between two segments, in degrees."},
              {"integer|nil", "max_turn_strand", "The strand that has it."},
              {"integer", "sharp", "Strands with a sharp turn."},
              {"integer", "zero_length", "Strands without length."},
              {"integer", "zero_segments", "Strands with a segment without length."},
              {"integer", "not_finite", "Strands with a coordinate that is NaN or infinite."},
              {"integer|nil", "penetrating", "With `style`: strands with a point inside the head."},
              {"number|nil", "deepest", "With `style`: how deep the deepest is, in metres."}}},
            {"lissom.StrandRoot",
             "The root of a strand.",
             {{"integer", "id", "Stays with the strand when some are selected."},
              {"number[]", "position", "Its first point, in metres."},
              {"integer|nil", "face", "The face of the head that it lies on."},
              {"number[]|nil", "bary",
               "Weights of the vertices of `triangle`, else of the three corners of the face."},
              {"integer[]|nil", "triangle",
               "Vertices of the triangle of the face that contains the root, on heads with "
               "polygons."},
              {"number[]|nil", "uv", "Texture coordinates there."},
              {"string|nil", "group", "The name of its group."},
              {"integer|nil", "guide", "The id of the strand that it follows."},
              {"number|nil", "arc", "The place on that guide of its tip, in metres."}}},
            {"lissom.StrandFinding",
             "A finding in strands that were saved.",
             {{"string", "kind", "strands_too_short, points_repeated, content_dropped, ..."},
              {"string", "message", "The finding, and its treatment."},
              {"integer", "count", "Number of strands concerned."},
              {"integer[]", "strands", "The strands, the first hundred of them."}}}};
}

}  // namespace lissom::lua
