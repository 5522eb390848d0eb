// lissom.GuideSet: few strands that move, and all others as sums of three of them.
#include <cstdio>
#include <memory>
#include <string>

#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/hair/engine/guide_set_object.h"
#include "bindings/lua/hair/strands_methods.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/io/hair/guide_file.h"

namespace lissom::lua {
namespace {

const GuideSet& set_of(const Call& call) {
    return call.self<GuideSetObject>()->set;
}

int make_guides(Call& call) {
    const auto result = call.create<GuideSetObject>();
    GuideSetOptions options;
    options.count = call.integer("count");
    options.of = call.choice<GuideChoice>("of");
    options.points = call.integer("points");
    options.shape = call.number("shape");
    const bool done = call.attempt([&] {
        result.set(std::make_shared<GuideSetObject>(
            make_guide_set(strands_of(call), options, call.context())));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int guide_set_size(Call& call) {
    return call.push(set_of(call).guide_count());
}

int guide_set_text(Call& call) {
    char text[96];
    const int length = std::snprintf(text, sizeof text, "lissom.GuideSet: %d guides of %d strands",
                                     set_of(call).guide_count(), count_of(set_of(call).guided));
    return call.push(std::string_view(text, at(length)));
}

int guide_curves(Call& call) {
    return new_strands(call, [&] {
        const GuideSet& set = set_of(call);
        Strands made = even_strands(set.curves, set.points, call.context());
        std::vector<std::uint32_t> ids;
        for (const Index s : set.strands) ids.push_back(set.guided[at(s)].id);
        made.set_ids(std::move(ids));
        return made;
    });
}

std::vector<Eigen::Vector3f> points_of(const Strands& strands) {
    std::vector<Eigen::Vector3f> points;
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView strand = strands.strand(s);
        for (Index k = 0; k < index_of(strand.cols()); ++k) points.emplace_back(strand.col(k));
    }
    return points;
}

int rebuild_all(Call& call) {
    const bool moves = call.has("guides");
    return new_strands(call, [&] {
        std::vector<Eigen::Vector3f> moved;
        if (moves) moved = points_of(call.object<StrandsObject>("guides")->strands);
        return rebuilt_strands(set_of(call), {moved, call.boolean("details")}, call.context());
    });
}

int strand_weights(Call& call) {
    const Index s = call.id("strand");
    const GuideSet& set = set_of(call);
    const bool done = call.attempt_quick([&] {
        require(s < count_of(set.guided), "there is no such strand", ErrorCode::out_of_range);
    });
    if (!done) return call.fail();
    const GuidedStrand& strand = set.guided[at(s)];
    const Index guides[3] = {static_cast<Index>(strand.guides[0]),
                             static_cast<Index>(strand.guides[1]),
                             static_cast<Index>(strand.guides[2])};
    const double weights[3] = {strand.weights[0], strand.weights[1], strand.weights[2]};
    lua_createtable(call.lua(), 0, 4);
    call.set_field("guides", call.push_ids(guides));
    call.set_field("weights", call.push_numbers(weights));
    call.set_field("length", call.push(static_cast<double>(strand.length)));
    call.set_field("root", call.push_vector(strand.root.cast<double>()));
    return 1;
}

int guide_error(Call& call) {
    const GuideSet& set = set_of(call);
    lua_createtable(call.lua(), 0, 3);
    call.set_field("rms", call.push(set.error.rms));
    call.set_field("max", call.push(set.error.max));
    if (set.error.strand != kNoIndex) call.set_field("strand", call.push_id(set.error.strand));
    return 1;
}

int save_set(Call& call) {
    const char* path = call.string("path");
    const bool done = call.attempt([&] {
        save_guides(set_of(call), call.file(path, FileUse::write), {call.boolean("details")},
                    call.context());
    });
    return done ? call.push_argument() : call.fail();
}

const std::string kSet = kThreeStrands + "local set = hair:guide_set{ count = 3, points = 3 }\n";

std::vector<Function> set_methods() {
    return {
        {.name = "guides",
         .body = guide_curves,
         .summary = "The guides, as strands with points at equal steps and the ids of the strands "
                    "that they are.",
         .results = {{"lissom.Strands", "guides", "In the order that weights count them."}},
         .errors = {ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kSet + "assert(#set:guides() == 3)"},
        {.name = "weights",
         .body = strand_weights,
         .summary = "A strand as a sum of guides: its points are root + length * (the weighted sum "
                    "of the guides' points less their roots).",
         .arguments = {id("strand", "Its number among the strands that the set was made of.")},
         .results = {{"lissom.GuideWeights", "weights", "The guide of the greatest weight first."}},
         .errors = {ErrorCode::out_of_range},
         .example = kSet + "assert(#set:weights(2).guides == 3)"},
        {.name = "error",
         .body = guide_error,
         .summary = "Distances between the strands and their sums of guides, without details.",
         .results = {{"lissom.GuideError", "error", "Over all points."}},
         .example = kSet + "assert(set:error().max < 0.05)"},
        {.name = "rebuild",
         .body = rebuild_all,
         .summary = "All strands from the guides, as lissom_hair.h does it in an engine.",
         .options = {object("guides", "lissom.Strands",
                            "Moved guides, with as many points as those of `guides`.")
                         .optional("those at rest"),
                     boolean("details", "Adds the differences of the strands from their sums.")
                         .defaults(true)},
         .results = {{"lissom.Strands", "strands", "In the order of the strands."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kSet + "assert(#set:rebuild() == 3)"},
        {.name = "save",
         .body = save_set,
         .summary = "Writes a guide file, which bindings/engine/lissom_hair.h reads, whole or not "
                    "at all.",
         .arguments = {string("path", "The file.")},
         .options = {boolean("details", "Writes the details, six bytes a point.").defaults(true)},
         .results = {{"lissom.GuideSet", "set", "The set itself."}},
         .errors = {ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                    ErrorCode::not_finite, ErrorCode::cancelled},
         .example = kSet + "local path = os.tmpname()\nset:save(path)\nos.remove(path)"}};
}

}  // namespace

Strands even_strands(const std::vector<Eigen::Vector3f>& points, Index each,
                     const Context& context) {
    std::vector<float> numbers;
    std::vector<Index> offsets = {0};
    for (const Eigen::Vector3f& p : points) numbers.insert(numbers.end(), p.begin(), p.end());
    for (Index i = each; i <= count_of(points); i += each) offsets.push_back(i);
    return {std::move(numbers), std::move(offsets), context.memory()};
}

Strands rebuilt_strands(const GuideSet& set, const RebuildOptions& options,
                        const Context& context) {
    Strands made = even_strands(rebuild_strands(set, options, context), set.points, context);
    std::vector<std::uint32_t> ids;
    StrandWidths widths;
    widths.domain = StrandDomain::strand;
    for (const GuidedStrand& strand : set.guided) {
        ids.push_back(strand.id);
        widths.values.push_back(strand.width);
    }
    made.set_ids(std::move(ids));
    made.set_widths(std::move(widths));
    return made;
}

Function guide_set_method() {
    const GuideSetOptions d;
    return {
        .name = "guide_set",
        .body = make_guides,
        .summary =
            "Chooses guides for engines and simulations, by k-medoids over place and shape, "
            "and finds three of them with weights for each strand.",
        .options = {integer("count", "Number of guides, for of = \"count\".")
                        .defaults(d.count)
                        .at_least(3),
                    choice("of", {"count", "groups", "locks"},
                           "Guides: as many as `count`, one for each group, or one for each guide "
                           "that strands follow, as one a curl.")
                        .defaults("count"),
                    integer("points", "Points of each guide, and of strands that are rebuilt.")
                        .defaults(d.points)
                        .between(2, 256),
                    number("shape",
                           "Weight of the difference of two strands' shapes against the distance "
                           "of their roots.")
                        .defaults(d.shape)
                        .at_least(0)},
        .results = {{"lissom.GuideSet", "set", "The guides and weights."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite, ErrorCode::memory_limit,
                   ErrorCode::cancelled},
        .example = kThreeStrands + "assert(#hair:guide_set{ count = 3 } == 3)"};
}

Type guide_set_type() {
    std::vector<Function> methods = set_methods();
    methods.push_back(dynamics_method());
    return {.name = "lissom.GuideSet",
            .summary = "A few strands that move, and all others as sums of three of them.",
            .methods = std::move(methods),
            .operators = {{"__len", guide_set_size, "#set", "number of guides"},
                          {"__tostring", guide_set_text, "tostring(set)", "counts"}}};
}

std::vector<Record> guide_set_records() {
    return {{"lissom.GuideWeights",
             "A strand as a sum of guides.",
             {{"integer[]", "guides", "Three numbers of guides, as `guides` has them."},
              {"number[]", "weights", "Their weights, which sum to 1."},
              {"number", "length", "Factor of the guides' shape."},
              {"lissom.Vector", "root", "Its root, in metres."}}},
            {"lissom.GuideError",
             "Distances between strands and their sums of guides, in metres.",
             {{"number", "rms", "Root of the mean square."},
              {"number", "max", "The greatest."},
              {"integer|nil", "strand", "The strand that has it."}}}};
}

}  // namespace lissom::lua
