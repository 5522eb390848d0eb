// lissom.Strands: hair from files, its statistics and its operators.
#include <cstdio>
#include <filesystem>

#include "bindings/lua/core/library.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/buffer.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/mesh/transform_options.h"
#include "kernel/hair/strands/strand_clump.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_noise.h"
#include "kernel/hair/strands/strand_operators.h"
#include "kernel/hair/strands/strand_resample.h"
#include "kernel/hair/strands/strand_selection.h"
#include "kernel/hair/strands/strand_trim.h"
#include "kernel/io/strand_file.h"

namespace lissom::lua {
namespace {

// Depth in metres of an average head from which strands count as inside: chords between points on
// the skin lie so deep.
constexpr double kSkin = 0.0005;

const Strands& strands_of(const Call& call) {
    return call.self<StrandsObject>()->strands;
}

std::filesystem::path file_path(const char* text) {
    const std::string bytes(text);
    return std::filesystem::path(std::u8string(bytes.begin(), bytes.end()));
}

// The choices of `up`, in this order; absent: none.
UpAxis up_axis(const Call& call) {
    if (!call.has("up")) return UpAxis::none;
    return call.integer("up") == 0 ? UpAxis::y : UpAxis::z;
}

// Runs work(Strands&), which changes the strands of a method in place, and returns them.
template <typename Work>
int change_strands(Call& call, const Work& work) {
    const auto strands = call.self<StrandsObject>();
    if (!call.attempt([&] { work(strands->strands); })) return call.fail();
    call.charge(strands);
    return call.push_argument();
}

// ---- Making, loading and saving

int make_strands(Call& call) {
    const auto points = call.points("points");
    const auto counts = call.ids("counts");
    return new_strands(call, [&] {
        std::vector<float> numbers;
        for (const Vec3& p : points) {
            for (const double x : p) numbers.push_back(static_cast<float>(x));
        }
        std::vector<Index> offsets = {0};
        for (const Index count : counts) {
            if (count > static_cast<Index>(points.size()) - offsets.back()) {
                throw Error(ErrorCode::invalid_argument, "the counts add up to more than the " +
                                                             std::to_string(points.size()) +
                                                             " points");
            }
            offsets.push_back(offsets.back() + count);
        }
        return Strands(std::move(numbers), std::move(offsets));
    });
}

int load(Call& call) {
    const char* path = call.string("path");
    StrandLoadOptions options;
    options.up = up_axis(call);
    if (call.has("unit")) options.unit = call.number("unit");
    return new_strands(call,
                       [&] { return load_strands(file_path(path), options, call.context()); });
}

void push_findings(const Call& call, const StrandReport& report) {
    lua_createtable(call.lua(), static_cast<int>(report.findings.size()), 0);
    int i = 0;
    for (const StrandFinding& finding : report.findings) {
        lua_createtable(call.lua(), 0, 4);
        call.set_field("kind", call.push(strand_finding_name(finding.kind)));
        call.set_field("message", call.push(std::string_view(finding.message)));
        call.set_field("count", call.push_count(finding.elements.count));
        call.set_field("strands", call.push_ids(finding.elements.ids));
        lua_rawseti(call.lua(), -2, ++i);
    }
}

bool has_rib_scene(const Call& call) {
    return call.has("head") || call.has("camera") || call.boolean("archive");
}

// Inside Call::attempt only.
RibScene rib_scene(const Call& call) {
    RibScene scene;
    scene.archive = call.boolean("archive");
    if (call.has("head")) scene.head = &call.object<MeshObject>("head")->mesh;
    if (call.has("camera")) {
        CameraOptions camera;
        camera.eye = call.vector("camera.eye");
        camera.target = call.vector("camera.target");
        camera.up = call.vector("camera.up");
        camera.fov = call.number("camera.fov") * kDegree;
        scene.camera = camera;
    }
    return scene;
}

int save(Call& call) {
    const auto strands = call.self<StrandsObject>();
    const char* path = call.string("path");
    auto& report = call.hold<StrandReport>();
    const bool done = call.attempt([&] {
        StrandSaveOptions options;
        options.up = up_axis(call);
        options.unit = call.number("unit");
        options.mend = call.boolean("mend");
        report = has_rib_scene(call)
                     ? save_rib(strands->strands, file_path(path), rib_scene(call), options,
                                call.context())
                     : save_strands(strands->strands, file_path(path), options, call.context());
    });
    if (!done) return call.fail();
    call.push_argument();
    push_findings(call, report);
    return 2;
}

// ---- Content

int strand_count(Call& call) {
    return call.push(strands_of(call).size());
}

// A buffer of the points of the strands [first, last).
int push_points(Call& call, Index first, Index last) {
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        auto buffer = std::make_shared<BufferObject>();
        const std::span<const Index> offsets = strands_of(call).offsets();
        const auto begin = 3 * static_cast<std::size_t>(offsets[static_cast<std::size_t>(first)]);
        const auto end = 3 * static_cast<std::size_t>(offsets[static_cast<std::size_t>(last)]);
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

// What is known of a strand, but for its points.
int strand_root(Call& call) {
    const Index s = call.id("strand");
    if (!call.attempt_quick([&] { require_strand(strands_of(call), s); })) return call.fail();
    const Strands& strands = strands_of(call);
    const StrandRoots& roots = strands.roots();
    const auto i = static_cast<std::size_t>(s);
    lua_createtable(call.lua(), 0, 6);
    call.set_field("id", call.push(static_cast<double>(strands.id(s))));
    call.set_field("position", call.push_vector(strands.root(s).cast<double>()));
    if (!roots.faces.empty() && roots.faces[i] != kNoIndex) {
        call.set_field("face", call.push_id(roots.faces[i]));
    }
    if (!roots.barycentrics.empty()) {
        call.set_field("bary", call.push_vector(roots.barycentrics[i].cast<double>()));
    }
    if (!roots.uvs.empty()) {
        const double uv[2] = {roots.uvs[i].x(), roots.uvs[i].y()};
        call.set_field("uv", call.push_numbers(uv));
    }
    if (strands.group(s) != kNoIndex) {
        const auto group = static_cast<std::size_t>(strands.group(s));
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
    lua_createtable(call.lua(), static_cast<int>(names.size()), 0);
    for (std::size_t i = 0; i < names.size(); ++i) {
        call.push(std::string_view(names[i]));
        lua_rawseti(call.lua(), -2, static_cast<int>(i) + 1);
    }
    return 1;
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

// Metres of a head, as those of its strands, to the signed distance in the same.
std::function<double(const Vec3&)> distance_to_head(const Hairstyle& style) {
    const Scalp& scalp = style.scalp();
    const double metre = scalp.scale() * scalp.unit();
    return [&style, &scalp, metre](const Vec3& point) {
        return metre * style.surface_distance(scalp.to_metres(point / scalp.unit()));
    };
}

int stats(Call& call) {
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
    lua_createtable(call.lua(), 0, 13);
    const struct {
        const char* name;
        Index value;
    } counts[] = {{"strands", found.strands},
                  {"points", found.points},
                  {"least_points", found.least_points},
                  {"most_points", found.most_points},
                  {"sharp", found.sharp},
                  {"zero_length", found.zero_length},
                  {"zero_segments", found.zero_segments},
                  {"not_finite", found.not_finite}};
    for (const auto& count : counts) call.set_field(count.name, call.push(count.value));
    call.set_field("least_length", call.push(found.least_length));
    call.set_field("mean_length", call.push(found.mean_length));
    call.set_field("most_length", call.push(found.most_length));
    call.set_field("greatest_turn", call.push(found.greatest_turn / kDegree));
    if (found.greatest_turn_strand != kNoIndex) {
        call.set_field("greatest_turn_strand", call.push_id(found.greatest_turn_strand));
    }
    if (on_head) {
        call.set_field("penetrating", call.push(found.penetrating));
        call.set_field("deepest", call.push(found.deepest));
    }
    return 1;
}

// ---- Choosing

// Asks the script's function about every strand; runs before any C++ object is alive, so that an
// error in it simply passes through.
std::span<const Index> ask_function(Call& call) {
    lua_State* L = call.lua();
    const auto self = call.self<StrandsObject>();
    const Index count = self->strands.size();
    auto* selected = call.scratch<Index>(static_cast<std::size_t>(count));
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
        result.set(std::make_shared<StrandsObject>(select_group(strands_of(call), group)));
    });
    if (!done) return call.answer_failure();
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
    if (call.has("where")) list = ask_function(call);
    if (call.has("strands")) list = call.ids("strands");
    if (call.has("group")) return select_named(call);
    return new_strands(call, [&] {
        const Strands& all = strands_of(call);
        if (call.has("first")) return prefix(all, call.integer("first"));
        if (call.has("region")) {
            return select(all,
                          strands_rooted_in(all, call.object<RegionObject>("region")->current()));
        }
        if (call.has("near")) return select_near(call, all);
        return select(all, list);
    });
}

int copy_strands(Call& call) {
    return new_strands(call, [&] { return Strands(strands_of(call)); });
}

int append_strands(Call& call) {
    const auto other = call.object<StrandsObject>("other");
    return change_strands(call, [&](Strands& strands) {
        // A copy, because the others may be these.
        append(strands, Strands(other->strands));
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

// What a list has one value for: each strand, or each point.
StrandDomain domain_of(std::size_t count, const Strands& strands, const char* what) {
    if (count == static_cast<std::size_t>(strands.size())) return StrandDomain::strand;
    if (count == static_cast<std::size_t>(strands.point_count())) return StrandDomain::point;
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
        result.push_back(static_cast<float>(number));
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
            widths.common = static_cast<float>(call.number("width"));
            widths.domain = StrandDomain::all;
            widths.values.clear();
        }
        if (call.has("widths")) {
            widths.values = factors_of(call.numbers("widths"), "widths");
            widths.domain = domain_of(widths.values.size(), strands, "widths");
        }
        if (call.has("profile")) {
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

int set_colors(Call& call) {
    return change_strands(call, [&](Strands& strands) {
        StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f::Zero()};
        if (call.has("color")) {
            colors.common = linear_color(call.vector("color"));
        } else {
            for (const Vec3& color : call.points("colors")) {
                colors.values.push_back(linear_color(color));
            }
            colors.domain = domain_of(colors.values.size(), strands, "colours");
        }
        strands.set_colors(std::move(colors));
    });
}

// ---- Operators

std::uint64_t seed(const Call& call) {
    return static_cast<std::uint64_t>(call.integer("seed"));
}

int clump_strands(Call& call) {
    ClumpOptions options;
    options.clumps = call.integer("clumps");
    options.strength = call.number("strength");
    options.variation = call.number("variation");
    options.shape = call.number("shape");
    options.radius = call.number("radius");
    options.apart = call.number("apart");
    options.tip_spread = call.number("tip_spread");
    options.offset = call.number("offset");
    options.within_groups = call.boolean("within_groups");
    options.keep_length = call.boolean("keep_length");
    options.seed = seed(call);
    return change_strands(call, [&](Strands& s) { clump(s, options, call.context()); });
}

int noise_strands(Call& call) {
    NoiseOptions options;
    options.amplitude = call.number("amplitude");
    options.across = call.number("across");
    options.along = call.number("along");
    options.shape = call.number("shape");
    options.cumulative = call.boolean("cumulative");
    options.keep_length = call.boolean("keep_length");
    options.seed = seed(call);
    return change_strands(call, [&](Strands& s) { noise(s, options, call.context()); });
}

int taper_strands(Call& call) {
    const TaperOptions options{call.number("tip"), call.number("start"), call.number("shape")};
    return change_strands(call, [&](Strands& s) { taper(s, options); });
}

int trim_strands(Call& call) {
    StrandTrimOptions options;
    if (call.has("length")) options.length = call.number("length");
    options.factor = call.number("factor");
    options.variation = call.number("variation");
    if (call.has("plane")) {
        options.plane = StrandTrimPlane{call.vector("plane.point"), call.vector("plane.normal")};
    }
    options.jitter = call.number("jitter");
    options.least = call.number("least");
    options.seed = seed(call);
    return change_strands(call, [&](Strands& s) { trim(s, options, call.context()); });
}

int smooth_strands(Call& call) {
    const StrandSmoothOptions options{call.integer("iterations"), call.number("strength")};
    return change_strands(call, [&](Strands& s) { smooth(s, options, call.context()); });
}

// ---- Metamethods

int strands_text(Call& call) {
    char text[96];
    const int length = std::snprintf(text, sizeof text, "lissom.Strands: %d strands, %d points",
                                     strands_of(call).size(), strands_of(call).point_count());
    return call.push(std::string_view(text, static_cast<std::size_t>(length)));
}

// ---- Descriptions

const std::string kPair =
    "local hair = lissom.strands{\n"
    "    points = { { 0, 0, 0 }, { 0, 0.1, 0 }, { 0, 0.2, 0 }, { 0.01, 0, 0 }, { 0.02, 0.1, 0 } "
    "},\n"
    "    counts = { 3, 2 },\n}\n";

const std::vector<Result> kSelfStrands = {{"lissom.Strands", "strands", "The strands themselves."}};

Parameter meters(const std::string& name, const std::string& help) {
    return number(name, help).in("metres");
}
Parameter shape_field(double value, const std::string& help) {
    return number("shape", help).defaults(value).above(0);
}
Parameter seed_field() {
    return integer("seed", "Another seed gives another result of the same kind.").defaults(1);
}
Parameter keep_length_field() {
    return boolean("keep_length", "Segments keep their lengths.").defaults(true);
}
Parameter up_option(const std::string& help, const std::string& usual) {
    return choice("up", {"y", "z"}, help).optional(usual);
}

std::vector<Function> content_methods() {
    return {
        {.name = "strand",
         .body = one_strand,
         .summary = "The points of one strand, root first: a copy, a row of x, y, z a point.",
         .arguments = {id("strand", "Its number.")},
         .results = {{"lissom.Buffer", "points", "The points."}},
         .errors = {ErrorCode::out_of_range},
         .example = kPair + "assert(hair:strand(1):count() == 3)"},
        {.name = "root",
         .body = strand_root,
         .summary = "Where a strand is rooted, and what else is known of it.",
         .arguments = {id("strand", "Its number.")},
         .results = {{"lissom.StrandRoot", "root", "Fields that are not known are absent."}},
         .errors = {ErrorCode::out_of_range},
         .example = kPair + "assert(hair:root(2).position[1] > 0)"},
        {.name = "points",
         .body = all_points,
         .summary = "The points of all strands, one strand after the other: a copy.",
         .results = {{"lissom.Buffer", "points", "A row of x, y, z a point."}},
         .example = kPair + "assert(hair:points():count() == 5)"},
        {.name = "point_counts",
         .body = point_counts,
         .summary = "How many points each strand has.",
         .results = {{"integer[]", "counts", "One number a strand."}},
         .example = kPair + "assert(hair:point_counts()[2] == 2)"},
        {.name = "groups",
         .body = groups,
         .summary = "The names of the groups.",
         .results = {{"string[]", "names", "In their order; empty where there are none."}},
         .example = kPair + "assert(#hair:groups() == 0)"},
        {.name = "bounds",
         .body = strands_bounds,
         .summary = "The axis-aligned box around all points.",
         .results = {{"lissom.Bounds", "bounds", "The box."}},
         .errors = {ErrorCode::out_of_range},
         .example = kPair + "assert(math.abs(hair:bounds().max[2] - 0.2) < 1e-6)"},
        {.name = "hash",
         .body = strands_hash,
         .summary = "A hash of all that the strands hold, the same on every platform.",
         .results = {{"string", "hash", "16 hexadecimal digits."}},
         .example = kPair + "assert(hair:hash() == hair:copy():hash())"},
        {.name = "stats",
         .body = stats,
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
              number("depth", "How deep they must be to count.")
                  .in("metres")
                  .optional("0.0005, as the head is larger than an average one")},
         .results = {{"lissom.StrandStats", "stats", "What was measured."}},
         .errors = {ErrorCode::cancelled},
         .example = kPair + "assert(math.abs(hair:stats().most_length - 0.2) < 1e-6)"},
        {.name = "save",
         .body = save,
         .summary = "Writes the strands to a .hair, .data, .usda, .rib, .glb, .gltf or .obj file, "
                    "whole or not at all. They are checked before, and changed where they would "
                    "break in other programs; the strands themselves stay as they are.",
         .arguments = {string("path", "The file; its extension names the format.")},
         .options = {up_option("The up axis that the file shall have.", "y"),
                     number("unit",
                            "Length of the file's unit in metres: points and widths are divided "
                            "by it.")
                         .defaults(1.0)
                         .above(0)
                         .in("metres"),
                     boolean("mend",
                             "false makes what would be changed or left out an error that names "
                             "the strands.")
                         .defaults(true),
                     object("head", "lissom.Mesh", "For .rib: the head that the picture shows.")
                         .optional("none"),
                     options("camera",
                             {vector("eye", "Where it stands, in units of the head."),
                              vector("target", "The middle of the picture."),
                              axis("up", "Which way is up.").defaults("y"),
                              number("fov", "Vertical opening angle.")
                                  .above(0)
                                  .between(0, 179)
                                  .in("degrees")
                                  .defaults(30.0)},
                             "For .rib: what the picture shows.")
                         .optional("hair and head whole, from the front, a little aside"),
                     boolean(
                         "archive",
                         "For .rib: the curves alone, for other RIB files to read; else a scene "
                         "with camera, lights and shaders, of which a RenderMan renderer makes "
                         "the picture.")
                         .defaults(false)},
         .results = {kSelfStrands.front(),
                     {"lissom.StrandFinding[]", "report", "What was found, changed or left out."}},
         .errors = {ErrorCode::unknown_format, ErrorCode::file_write_failed,
                    ErrorCode::file_is_directory, ErrorCode::file_too_large, ErrorCode::not_finite,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kPair + R"(local path = os.tmpname() .. ".hair"
assert(hair:save(path))
assert(#assert(lissom.load_strands(path)) == 2)
os.remove(path))"}};
}

std::vector<Function> edit_methods() {
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
         .results = {{"lissom.Strands", "strands",
                      "The new strands; nil, message, code where no group has the name."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::handle_removed},
         .example = kPair + "assert(#hair:select{ first = 1 } == 1)"},
        {.name = "copy",
         .body = copy_strands,
         .summary = "A copy of all strands.",
         .results = {{"lissom.Strands", "strands", "The new strands."}},
         .example = kPair + "assert(#hair:copy() == #hair)"},
        {.name = "append",
         .body = append_strands,
         .summary = "Adds other strands after these. Groups of the same name become one.",
         .arguments = {object("other", "lissom.Strands", "The strands to add.")},
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument},
         .example = kPair + "assert(#hair:append(hair) == 4)"},
        {.name = "transform",
         .body = transform_strands,
         .summary = "Scales, then rotates, then translates all points. Widths scale too.",
         .options = transform_fields("the origin"),
         .results = kSelfStrands,
         .errors = {ErrorCode::singular_transform, ErrorCode::not_finite, ErrorCode::cancelled},
         .example = kPair + "hair:transform{ translate = { 0, 1.6, 0 } }"},
        {.name = "resample",
         .body = resample_strands,
         .summary = "Spreads points evenly along each strand; roots and tips stay.",
         .options = {integer("count", "Points of each strand.").at_least(2).optional(),
                     meters("step", "Distance of points.").above(0).optional()},
         .one_option = true,
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kPair + "assert(hair:resample{ count = 10 }:points():count() == 20)"},
        {.name = "set_widths",
         .body = set_widths,
         .summary = "Sets how thick strands are; what is not given stays. Pictures and files have "
                    "the widths, times the profile.",
         .options =
             {meters("width", "Diameter of all strands.").at_least(0).optional(),
              numbers("widths", "Diameters in metres, one a strand or one a point.").optional(),
              numbers("profile",
                      "Factors at equal steps from the root to the tip, linear "
                      "between; empty for none.")
                  .optional()},
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range},
         .example = kPair + "hair:set_widths{ width = 90e-6, profile = { 1, 1, 0.4 } }"},
        {.name = "set_colors",
         .body = set_colors,
         .summary = "Sets the colours of strands as linear red, green and blue, each 0 to 1; "
                    "pictures and files have them.",
         .options = {vector("color", "The colour of all strands.").optional(),
                     points("colors", "Colours, one a strand or one a point.").optional()},
         .one_option = true,
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument, ErrorCode::out_of_range},
         .example = kPair + "hair:set_colors{ color = { 0.26, 0.15, 0.075 } }"}};
}

const std::vector<ErrorCode> kOperatorErrors = {ErrorCode::invalid_argument, ErrorCode::not_finite,
                                                ErrorCode::memory_limit, ErrorCode::cancelled};

Function clump_method() {
    const ClumpOptions d;
    return {.name = "clump",
            .body = clump_strands,
            .summary = "Gathers strands around guides; roots stay.",
            .options = {integer("clumps", "Number of guides: the strands of the lowest ids.")
                            .defaults(d.clumps)
                            .at_least(1),
                        number("strength", "Part of the way to the guide that tips move.")
                            .defaults(d.strength)
                            .between(0, 1),
                        number("variation",
                               "The strength of a clump is up to this fraction higher or "
                               "lower, at random.")
                            .defaults(d.variation)
                            .between(0, 1),
                        shape_field(d.shape,
                                    "The pull grows with this power of the place along the "
                                    "strand."),
                        meters("radius", "Strands rooted further from their guide stay.")
                            .defaults(d.radius)
                            .above(0)
                            .or_infinite(),
                        number("apart",
                               "How much it counts for the choice of a guide that strands are "
                               "combed apart, as at a parting.")
                            .defaults(d.apart)
                            .at_least(0),
                        meters("tip_spread", "Random distance by which tips miss their guide.")
                            .defaults(d.tip_spread)
                            .at_least(0),
                        meters("offset", "Random distance by which the tip of a whole clump moves.")
                            .defaults(d.offset)
                            .at_least(0),
                        boolean("within_groups", "Guides are of the strand's own group.")
                            .defaults(d.within_groups),
                        keep_length_field(), seed_field()},
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kPair + "hair:clump{ clumps = 1, strength = 0.5 }"};
}

Function noise_method() {
    const NoiseOptions d;
    return {
        .name = "noise",
        .body = noise_strands,
        .summary = "Lets strands wander off their course, neighbours together; roots stay.",
        .options =
            {meters("amplitude", "Greatest distance, about, that a tip moves.")
                 .defaults(d.amplitude)
                 .at_least(0),
             meters("across", "Distance of roots that wander apart.").defaults(d.across).above(0),
             meters("along", "Length along a strand of one deviation.").defaults(d.along).above(0),
             shape_field(d.shape,
                         "The amplitude grows with this power of the place "
                         "along the strand."),
             boolean("cumulative", "Deviations add up along the strand.").defaults(d.cumulative),
             keep_length_field(), seed_field()},
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kPair + "hair:noise{ amplitude = 0.003, seed = 7 }"};
}

Function trim_method() {
    const StrandTrimOptions d;
    return {
        .name = "trim",
        .body = trim_strands,
        .summary = "Cuts strands off at the tip, where the first of the options says so.",
        .options = {meters("length", "Longest length that is left.").above(0).optional("no limit"),
                    number("factor", "Part of its length that each strand keeps.")
                        .defaults(d.factor)
                        .between(0, 1),
                    number("variation", "Each strand keeps up to this fraction less, at random.")
                        .defaults(d.variation)
                        .between(0, 1),
                    options("plane",
                            {vector("point", "A point of the plane."),
                             vector("normal", "Points to the side that is cut off.")},
                            "What lies beyond a plane is cut off.")
                        .optional(),
                    meters("jitter", "Each strand meets the plane moved by at most this.")
                        .defaults(d.jitter)
                        .at_least(0),
                    meters("least", "No strand becomes shorter.").defaults(d.least).above(0),
                    seed_field()},
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kPair + "assert(hair:trim{ length = 0.15 }:stats().most_length < 0.1501)"};
}

std::vector<Function> operator_methods() {
    const TaperOptions taper_defaults;
    const StrandSmoothOptions smooth_defaults;
    return {
        clump_method(),
        noise_method(),
        {.name = "taper",
         .body = taper_strands,
         .summary = "Makes strands thinner towards their tips.",
         .options = {number("tip", "Width of the tip as a fraction of what it was.")
                         .defaults(taper_defaults.tip)
                         .above(0),
                     number("start", "Where the taper begins: 0 is the root, 1 the tip.")
                         .defaults(taper_defaults.start)
                         .between(0, 0.999),
                     shape_field(taper_defaults.shape, "1 is a cone, 2 stays wide for longer.")},
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument},
         .example = kPair + "hair:taper{ tip = 0.3 }"},
        trim_method(),
        {.name = "smooth",
         .body = smooth_strands,
         .summary = "Evens out kinks along each strand; roots and tips stay.",
         .options = {integer("iterations", "Number of passes.")
                         .defaults(smooth_defaults.iterations)
                         .at_least(0),
                     number("strength",
                            "Fraction of the way to the middle of its neighbours that "
                            "a point moves in a pass.")
                         .defaults(smooth_defaults.strength)
                         .between(0, 1)
                         .above(0)},
         .results = kSelfStrands,
         .errors = kOperatorErrors,
         .example = kPair + "hair:smooth{ iterations = 5 }"}};
}

}  // namespace

Type strands_type() {
    Type type{
        .name = "lissom.Strands",
        .summary =
            "Hair: polylines from root to tip, in metres. Strands count from 1. "
            "Operators never move roots, and what they do to a strand does not depend "
            "on how many there are.",
        .close = [](void* object) { static_cast<StrandsObject*>(object)->strands = Strands(); }};
    type.operators = {{"__len", strand_count, "#strands", "number of strands"},
                      {"__tostring", strands_text, "tostring(strands)", "counts"}};
    type.methods = content_methods();
    for (Function& method : edit_methods()) type.methods.push_back(std::move(method));
    for (Function& method : operator_methods()) type.methods.push_back(std::move(method));
    return type;
}

std::vector<Function> strand_functions() {
    return {
        {.name = "load_strands",
         .body = load,
         .summary = "Reads hair from a .hair, .data (HairSalon) or .usda (BasisCurves) file.",
         .arguments = {string("path", "The file; its extension names the format.")},
         .options = {up_option("The file's up axis; z is turned to y, which is up here.",
                               "what the file says, else y"),
                     number("unit", "Length of the file's unit in metres.")
                         .above(0)
                         .in("metres")
                         .optional("what the file says, else 1")},
         .results = {{"lissom.Strands", "strands",
                      "The strands; nil, message, code where the file is at fault."}},
         .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory, ErrorCode::file_empty,
                    ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::file_truncated,
                    ErrorCode::file_too_large, ErrorCode::unknown_format, ErrorCode::unsupported,
                    ErrorCode::not_finite, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = R"(local hair, message, code = lissom.load_strands("missing.hair")
assert(hair == nil and code == "file_not_found"))"},
        {.name = "strands",
         .body = make_strands,
         .summary = "Strands of given points.",
         .options = {points("points", "The points of all strands, root to tip, in metres."),
                     integers("counts", "How many of them each strand has.").at_least(1)},
         .results = {{"lissom.Strands", "strands", "The new strands."}},
         .errors = {ErrorCode::invalid_argument},
         .example = kPair + "assert(#hair == 2)"}};
}

std::vector<Record> strand_records() {
    return {{"lissom.StrandStats",
             "Measures of strands.",
             {{"integer", "strands", "Number of strands."},
              {"integer", "points", "Number of points."},
              {"integer", "least_points", "Fewest points of a strand."},
              {"integer", "most_points", "Most points of a strand."},
              {"number", "least_length", "Length of the shortest, in metres."},
              {"number", "mean_length", "Mean length, in metres."},
              {"number", "most_length", "Length of the longest, in metres."},
              {"number", "greatest_turn", "Greatest angle between two segments, in degrees."},
              {"integer|nil", "greatest_turn_strand", "The strand that has it."},
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
              {"number[]|nil", "bary", "Weights of the first three corners of that face."},
              {"number[]|nil", "uv", "Texture coordinates there."},
              {"string|nil", "group", "The name of its group."}}},
            {"lissom.StrandFinding",
             "What was found in strands that were saved.",
             {{"string", "kind", "strands_too_short, points_repeated, content_dropped, ..."},
              {"string", "message", "What was found, and what was done about it."},
              {"integer", "count", "Number of strands concerned."},
              {"integer[]", "strands", "The strands, the first hundred of them."}}}};
}

}  // namespace lissom::lua
