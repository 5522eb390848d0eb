// lissom.Strands: contents and measures.
#include <cstdio>

#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strand_effect.h"
#include "bindings/lua/hair/strands_methods.h"
#include "bindings/lua/mesh/buffer.h"
#include "kernel/hair/strands/strand_measures.h"

namespace lissom::lua {
namespace {

// Depth in metres of an average head from which strands count as inside: chords between points on
// the skin lie so deep.
constexpr double kSkin = 0.0005;

// A buffer of the points of the strands [first, last).
int push_points(Call& call, Index first, Index last) {
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        auto buffer = std::make_shared<BufferObject>();
        const std::span<const Index> offsets = strands_of(call).offsets();
        const auto begin = 3 * at(offsets[first]);
        const auto end = 3 * at(offsets[last]);
        const auto points = strands_of(call).points().subspan(begin, end - begin);
        buffer->values.assign(points.begin(), points.end());
        buffer->width = 3;
        result.set(std::move(buffer));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int one_strand(Call& call) {
    const Index s = call.id("strand");
    if (!call.attempt_quick([&] { require_strand(strands_of(call), s); })) return call.fail();
    return push_points(call, s, s + 1);
}

// Properties of a strand, but for its points.
int strand_root(Call& call) {
    const Index s = call.id("strand");
    if (!call.attempt_quick([&] { require_strand(strands_of(call), s); })) return call.fail();
    const Strands& strands = strands_of(call);
    const StrandRoots& roots = strands.roots();
    const std::size_t i = s;
    lua_createtable(call.lua(), 0, 6);
    call.set_field("id", call.push(static_cast<double>(strands.id(s))));
    call.set_field("position", call.push_vector(strands.root(s).cast<double>()));
    if (!roots.faces.empty() && roots.faces[i] != kNoIndex) {
        call.set_field("face", call.push_id(roots.faces[i]));
    }
    if (!roots.barycentrics.empty()) {
        call.set_field("bary", call.push_vector(roots.barycentrics[i].cast<double>()));
    }
    if (!roots.triangles.empty() && roots.triangles[i][0] != kNoIndex) {
        call.set_field("triangle", call.push_ids(roots.triangles[i]));
    }
    if (!roots.uvs.empty()) {
        const double uv[2] = {roots.uvs[i].x(), roots.uvs[i].y()};
        call.set_field("uv", call.push_numbers(uv));
    }
    if (!strands.guides().ids.empty() && strands.guides().ids[i] != kNoGuide) {
        call.set_field("guide", call.push(static_cast<double>(strands.guides().ids[i])));
        call.set_field("arc", call.push(static_cast<double>(strands.guides().arcs[i])));
    }
    if (strands.group(s) != kNoIndex) {
        const std::size_t group = strands.group(s);
        call.set_field("group", call.push(std::string_view(strands.group_names()[group])));
    }
    return 1;
}

int all_points(Call& call) {
    return push_points(call, 0, strands_of(call).size());
}

int point_counts(Call& call) {
    const Strands& strands = strands_of(call);
    lua_createtable(call.lua(), strands.size(), 0);
    for (Index s = 0; s < strands.size(); ++s) {
        call.push(strands.point_count(s));
        lua_rawseti(call.lua(), -2, s + 1);
    }
    return 1;
}

int groups(Call& call) {
    const std::vector<std::string>& names = strands_of(call).group_names();
    return push_list(call, names,
                     [&](const std::string& name) { call.push(std::string_view(name)); });
}

int strands_bounds(Call& call) {
    Box box;
    const bool done = call.attempt([&] {
        box = bounds(strands_of(call));
        if (box.empty()) throw Error(ErrorCode::out_of_range, "no strands have no bounds");
    });
    return done ? push_bounds(call, box) : call.fail();
}

int strands_hash(Call& call) {
    std::uint64_t value = 0;
    if (!call.attempt([&] { value = hash(strands_of(call)); })) return call.fail();
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return call.push(std::string_view(text));
}

void push_statistics(const Call& call, const StrandStatistics& found) {
    lua_createtable(call.lua(), 0, 13);
    const struct {
        const char* name;
        Index value;
    } counts[] = {{"strands", found.strands},
                  {"points", found.points},
                  {"min_points", found.min_points},
                  {"max_points", found.max_points},
                  {"sharp", found.sharp},
                  {"zero_length", found.zero_length},
                  {"zero_segments", found.zero_segments},
                  {"not_finite", found.not_finite}};
    for (const auto& count : counts) call.set_field(count.name, call.push(count.value));
    call.set_field("min_length", call.push(found.min_length));
    call.set_field("mean_length", call.push(found.mean_length));
    call.set_field("max_length", call.push(found.max_length));
    call.set_field("max_turn", call.push(found.max_turn / kDegree));
    if (found.max_turn_strand != kNoIndex) {
        call.set_field("max_turn_strand", call.push_id(found.max_turn_strand));
    }
}

int strand_stats(Call& call) {
    const double sharp = call.number("sharp_turn") * kDegree;
    const bool on_head = call.has("style"), has_depth = call.has("depth");
    StrandStatistics found;
    const bool done = call.attempt([&] {
        StrandStatisticsOptions options;
        options.sharp_turn = sharp;
        if (on_head) {
            const Hairstyle& style = call.object<HairstyleObject>("style")->style();
            options.distance = distance_to_head(style);
            options.depth = kSkin * style.scalp().scale() * style.scalp().unit();
        }
        if (has_depth) options.depth = call.number("depth");
        found = strand_statistics(strands_of(call), options, call.context());
    });
    if (!done) return call.fail();
    push_statistics(call, found);
    if (on_head) {
        call.set_field("penetrating", call.push(found.penetrating));
        call.set_field("deepest", call.push(found.deepest));
    }
    return 1;
}

}  // namespace

std::function<double(const Vec3&)> distance_to_head(const Hairstyle& style) {
    const Scalp& scalp = style.scalp();
    const double metre = scalp.scale() * scalp.unit();
    return [&style, &scalp, metre](const Vec3& point) {
        return metre * style.surface_distance(scalp.to_metres(point / scalp.unit()));
    };
}

std::vector<Function> strand_content_methods() {
    return {
        {.name = "strand",
         .body = one_strand,
         .summary = "The points of one strand, root first: a copy, a row of x, y, z a point.",
         .arguments = {id("strand", "Its number.")},
         .results = {{"lissom.Buffer", "points", "The points."}},
         .errors = {ErrorCode::out_of_range},
         .example = kTwoStrands + "assert(hair:strand(1):count() == 3)"},
        {.name = "root",
         .body = strand_root,
         .summary = "Root of a strand, and its other properties.",
         .arguments = {id("strand", "Its number.")},
         .results = {{"lissom.StrandRoot", "root", "Fields that are not known are absent."}},
         .errors = {ErrorCode::out_of_range},
         .example = kTwoStrands + "assert(hair:root(2).position[1] > 0)"},
        {.name = "points",
         .body = all_points,
         .summary = "The points of all strands, one strand after the other: a copy.",
         .results = {{"lissom.Buffer", "points", "A row of x, y, z a point."}},
         .example = kTwoStrands + "assert(hair:points():count() == 5)"},
        {.name = "point_counts",
         .body = point_counts,
         .summary = "Numbers of points of the strands.",
         .results = {{"integer[]", "counts", "One number a strand."}},
         .example = kTwoStrands + "assert(hair:point_counts()[2] == 2)"},
        {.name = "groups",
         .body = groups,
         .summary = "The names of the groups.",
         .results = {{"string[]", "names", "In their order; empty if there are none."}},
         .example = kTwoStrands + "assert(#hair:groups() == 0)"},
        {.name = "bounds",
         .body = strands_bounds,
         .summary = "The axis-aligned box around all points.",
         .results = {{"lissom.Bounds", "bounds", "The box."}},
         .errors = {ErrorCode::out_of_range},
         .example = kTwoStrands + "assert(math.abs(hair:bounds().max[2] - 0.2) < 1e-6)"},
        {.name = "hash",
         .body = strands_hash,
         .summary = "A hash of all that the strands hold, the same on every platform.",
         .results = {{"string", "hash", "16 hexadecimal digits."}},
         .example = kTwoStrands + "assert(hair:hash() == hair:copy():hash())"},
        {.name = "stats",
         .body = strand_stats,
         .summary = "Counts, lengths and turns, and how many strands are damaged.",
         .options =
             {number("sharp_turn", "A turn between two segments above this is sharp.")
                  .defaults(90.0)
                  .between(0, 180)
                  .in("degrees"),
              object("style", "lissom.Hairstyle",
                     "Measures too how many strands are inside its head, on which they grew, by "
                     "the distance to its surface.")
                  .optional("not measured"),
              number("depth", "Depth from which on they count.")
                  .in("metres")
                  .optional("0.0005, as the head is larger than an average one")},
         .results = {{"lissom.StrandStats", "stats", "The measures."}},
         .errors = {ErrorCode::cancelled},
         .example = kTwoStrands + "assert(math.abs(hair:stats().max_length - 0.2) < 1e-6)"}};
}

}  // namespace lissom::lua
