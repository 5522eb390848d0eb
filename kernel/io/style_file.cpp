#include "kernel/io/style_file.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/stream/json_tree.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/text_writer.h"

namespace lissom {
namespace {

// Keeps the order of keys.
using StyleJson = OrderedJson;

constexpr const char* kFormat = "lissom hairstyle";
constexpr int kStyleVersion = 1;
constexpr const char *kDefaultName = "default", *kThesisName = "thesis";

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw Error(ErrorCode::file_syntax, where + ": " + what);
}

// Without lists of initialisers, which nlohmann does not free if there is no memory for all.
StyleJson json_of(std::initializer_list<double> numbers) {
    StyleJson list = StyleJson::array();
    for (const double number : numbers) list.push_back(number);
    return list;
}

StyleJson json_of(const Vec3& p) {
    return json_of({p.x(), p.y(), p.z()});
}

// ---- One description of each object serves for writing and reading.

// Appends the values shown to it to an object.
class Writer {
  public:
    explicit Writer(StyleJson& object) : object_(object) {}

    void text(const char* key, std::string& value) {
        if (!value.empty()) object_[key] = value;
    }
    void flag(const char* key, bool& value, bool usual) {
        if (value != usual) object_[key] = value;
    }
    void number(const char* key, double& value) { object_[key] = value; }
    void number(const char* key, std::optional<double>& value) {
        if (value) object_[key] = *value;
    }
    void integer(const char* key, Index& value) { object_[key] = value; }
    void fidelity(HairstyleOptions& options) {
        if (options.fidelity == HairFidelity::thesis) object_["fidelity"] = kThesisName;
    }
    template <typename Enum>
    void choice(const char* key, Enum& value, std::initializer_list<const char*> names) {
        object_[key] = *(names.begin() + static_cast<int>(value));
    }
    void angles(const char* key, DividingOptions::Tilt& tilt) {
        object_[key] = json_of({tilt.start / kDegree, tilt.end / kDegree});
    }
    void point(const char* key, Vec3& value) { object_[key] = json_of(value); }
    void points(const char* key, std::vector<Vec3>& list) {
        if (list.empty()) return;
        StyleJson& array = object_[key] = StyleJson::array();
        for (const Vec3& p : list) array.push_back(json_of(p));
    }

    void lists(const char* key, std::vector<std::vector<Vec3>>& lists) {
        if (lists.empty()) return;
        StyleJson& array = object_[key] = StyleJson::array();
        for (const auto& list : lists) {
            StyleJson& one = array.emplace_back(StyleJson::array());
            for (const Vec3& p : list) one.push_back(json_of(p));
        }
    }

  private:
    StyleJson& object_;
};

// Takes the requested values from an object, and leaves absent ones unchanged.
class Reader {
  public:
    Reader(const StyleJson& object, std::string where) : object_(object), where_(std::move(where)) {
        if (!object.is_object()) refuse(where_, "an object {...} is expected");
    }

    void text(const char* key, std::string& value) {
        if (const StyleJson* found = find(key)) {
            if (!found->is_string()) wrong(key, "a text");
            value = found->get<std::string>();
        }
    }
    void flag(const char* key, bool& value, bool) {
        if (const StyleJson* found = find(key)) {
            if (!found->is_boolean()) wrong(key, "true or false");
            value = found->get<bool>();
        }
    }
    void number(const char* key, double& value) {
        if (const StyleJson* found = find(key)) value = finite(*found, key);
    }
    void number(const char* key, std::optional<double>& value) {
        if (const StyleJson* found = find(key)) value = finite(*found, key);
    }
    void integer(const char* key, Index& value) {
        const StyleJson* found = find(key);
        if (!found) return;
        const double given = finite(*found, key);
        if (given != std::floor(given) || std::abs(given) > 2e9) wrong(key, "a whole number");
        value = static_cast<Index>(given);
    }
    // Before the options that have other defaults with it.
    void fidelity(HairstyleOptions& options) {
        HairFidelity fidelity = HairFidelity::lissom;
        choice("fidelity", fidelity, {kDefaultName, kThesisName});
        options = style_options_with(fidelity);
        // Files that do not name it have none: they may be older than it.
        options.gravity = 0.0;
    }
    template <typename Enum>
    void choice(const char* key, Enum& value, std::initializer_list<const char*> names) {
        const StyleJson* found = find(key);
        if (!found) return;
        std::string expected;
        int place = 0;
        for (const char* name : names) {
            if (found->is_string() && found->get<std::string>() == name) {
                value = static_cast<Enum>(place);
                return;
            }
            expected += std::string(place > 0 ? " or \"" : "\"") + name + "\"";
            ++place;
        }
        wrong(key, expected.c_str());
    }
    void angles(const char* key, DividingOptions::Tilt& tilt) {
        const StyleJson* found = find(key);
        if (!found) return;
        if (!found->is_array() || found->size() != 2) wrong(key, "two angles [start, end]");
        tilt = {finite((*found)[0], key) * kDegree, finite((*found)[1], key) * kDegree};
    }
    void point(const char* key, Vec3& value) {
        if (const StyleJson* found = find(key)) value = coordinates(*found, key);
    }
    void points(const char* key, std::vector<Vec3>& list) {
        const StyleJson* found = find(key);
        if (!found) return;
        if (!found->is_array()) wrong(key, "a list of points [[x, y, z], ...]");
        list.clear();
        for (const StyleJson& one : *found) list.push_back(coordinates(one, key));
    }
    void lists(const char* key, std::vector<std::vector<Vec3>>& lists) {
        const StyleJson* found = find(key);
        if (!found) return;
        if (!found->is_array()) wrong(key, "a list of lists of points [[[x, y, z], ...], ...]");
        lists.clear();
        for (const StyleJson& list : *found) {
            if (!list.is_array()) wrong(key, "a list of lists of points [[[x, y, z], ...], ...]");
            std::vector<Vec3>& points = lists.emplace_back();
            for (const StyleJson& one : list) points.push_back(coordinates(one, key));
        }
    }

    // To be called when all is read: other keys are mistakes.
    void finish() const {
        std::string all;
        for (const std::string& key : known_) all += (all.empty() ? "" : ", ") + key;
        for (const auto& item : object_.items()) {
            if (known_.contains(item.key())) continue;
            refuse(where_, "unknown key \"" + item.key() + "\"; there are: " + all);
        }
    }

  private:
    const StyleJson* find(const char* key) {
        known_.insert(key);
        const auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }
    [[noreturn]] void wrong(const char* key, const char* expected) const {
        refuse(where_, "\"" + std::string(key) + "\" must be " + expected);
    }
    double finite(const StyleJson& json, const char* key) const {
        if (!json.is_number() || !std::isfinite(json.get<double>())) wrong(key, "a number");
        return json.get<double>();
    }
    Vec3 coordinates(const StyleJson& json, const char* key) const {
        if (!json.is_array() || json.size() != 3) wrong(key, "made of points [x, y, z]");
        return {finite(json[0], key), finite(json[1], key), finite(json[2], key)};
    }

    const StyleJson& object_;
    std::string where_;
    std::set<std::string> known_{"kind",  "format", "version", "curves",
                                 "masks", "volume", "fidelity"};
};

template <typename Archive>
void describe(Archive& a, StreamCurve& c) {
    a.points("points", c.points);
    a.number("stop", c.options.stop_length);
    a.number("clearance", c.clearance);
    a.number("weight", c.options.weight);
}

template <typename Archive>
void describe(Archive& a, DividingCurve& c) {
    a.points("points", c.points);
    a.angles("left", c.options.left);
    a.angles("right", c.options.right);
    a.number("sigma", c.options.sigma);
    a.number("height", c.options.height);
    a.number("reach", c.options.reach);
    a.number("thickness", c.options.thickness);
    a.number("separation", c.options.separation);
    a.number("wall_width", c.options.wall_width);
    a.number("wall_height", c.options.wall_height);
    a.number("ramp", c.options.ramp);
    a.number("gap", c.gap);
    a.lists("hints", c.hints);
    a.number("weight", c.options.weight);
}

template <typename Archive>
void describe(Archive& a, Ponytail& c) {
    a.points("spine", c.spine);
    a.number("radius", c.options.radius);
    a.points("section", c.options.section);
    a.points("profile_a", c.options.profiles[0]);
    a.points("profile_b", c.options.profiles[1]);
    a.number("share", c.options.share);
    a.number("fullness", c.options.fullness);
    a.number("inner", c.options.inner);
    a.number("outer", c.options.outer);
    a.number("ring", c.options.ring);
    a.number("lead", c.options.lead);
    a.number("grip", c.options.grip);
    a.number("spread", c.options.spread);
    a.number("tightness", c.options.tightness);
    a.number("clearance", c.options.clearance);
    a.number("stop", c.options.stop_length);
    a.number("tail_length", c.tail_length);
    a.number("ragged", c.ragged);
    a.number("weight", c.options.weight);
}

template <typename Archive>
void describe(Archive& a, StyleCurve& curve) {
    a.text("name", curve.name);
    a.flag("enabled", curve.enabled, true);
    std::visit([&](auto& shape) { describe(a, shape); }, curve.shape);
}

template <typename Archive>
void describe(Archive& a, MaskStroke& mask) {
    a.choice("kind", mask.kind, {"length", "density"});
    a.number("value", mask.value);
    a.number("radius", mask.radius);
    a.number("softness", mask.softness);
    a.points("points", mask.points);
}

template <typename Archive>
void describe(Archive& a, StyleContent& content) {
    a.text("head", content.head);
    a.fidelity(content.options);
    a.integer("resolution", content.options.resolution);
    a.choice("solver", content.options.field.solver, {"dual", "cholesky"});
    a.choice("boundary", content.options.field.boundary, {"zero_flux", "thesis"});
    a.number("tension", content.options.field.tension);
    std::optional<double> gravity;
    if (content.options.gravity != 0.0) gravity = content.options.gravity;
    a.number("gravity", gravity);
    content.options.gravity = gravity.value_or(0.0);
    a.flag("avoid_scalp", content.avoids_scalp, false);
}

template <typename Archive>
void describe(Archive& a, Box& volume) {
    a.point("min", volume.min);
    a.point("max", volume.max);
}

// ---- Text

bool is_flat(const StyleJson& array) {
    for (const StyleJson& one : array) {
        if (one.is_structured()) return false;
    }
    return true;
}

// Lists of plain values stand in one line.
void append_json(std::string& text, const StyleJson& json, const std::string& indent) {
    if (!json.is_structured()) {
        text += json.dump(-1, ' ', false, StyleJson::error_handler_t::replace);
        return;
    }
    const bool array = json.is_array(), flat = array && is_flat(json);
    const std::string inner = indent + "  ";
    text += array ? '[' : '{';
    bool first = true;
    for (const auto& item : json.items()) {
        text += first ? "" : flat ? ", " : ",";
        if (!flat) text += "\n" + inner;
        if (!array)
            text +=
                StyleJson(item.key()).dump(-1, ' ', false, StyleJson::error_handler_t::replace) +
                ": ";
        append_json(text, item.value(), inner);
        first = false;
    }
    if (!flat && !first) text += "\n" + indent;
    text += array ? ']' : '}';
}

// ---- From JSON

// A curve has the fidelity of its style if it does not say which.
HairFidelity fidelity_from(const StyleJson& json, HairFidelity usual, const std::string& where) {
    const auto found = json.find("fidelity");
    if (found == json.end()) return usual;
    if (*found == kDefaultName) return HairFidelity::lissom;
    if (*found == kThesisName) return HairFidelity::thesis;
    refuse(where, "\"fidelity\" must be \"default\" or \"thesis\"");
}

StyleCurve curve_from(const StyleJson& json, HairFidelity usual, const std::string& where) {
    if (!json.is_object()) refuse(where, "an object {...} is expected");
    const std::string kind = json.value("kind", StyleJson()).is_string()
                                 ? json["kind"].get<std::string>()
                                 : std::string();
    const HairFidelity fidelity = fidelity_from(json, usual, where);
    StyleCurve curve;
    if (kind == "stream") {
        curve.shape = curve_with<StreamCurve>(fidelity);
    } else if (kind == "dividing") {
        curve.shape = curve_with<DividingCurve>(fidelity);
    } else if (kind == "ponytail") {
        curve.shape = curve_with<Ponytail>(fidelity);
    } else {
        refuse(where, "\"kind\" must be \"stream\", \"dividing\" or \"ponytail\"");
    }
    Reader reader(json, where);
    describe(reader, curve);
    reader.finish();
    return curve;
}

void require_version(const StyleJson& json) {
    if (json.value("format", StyleJson()) != kFormat) {
        refuse("style", "\"format\" must be \"" + std::string(kFormat) + "\"");
    }
    const StyleJson version = json.value("version", StyleJson());
    if (!version.is_number_integer() || version.get<double>() < 1) {
        refuse("style", "\"version\" must be a whole number of 1 or more");
    }
    if (version.get<double>() > kStyleVersion) {
        throw Error(ErrorCode::unsupported,
                    "the style is of version " + version.dump() +
                        ", which is newer than this program; save it as version " +
                        std::to_string(kStyleVersion));
    }
}

std::vector<MaskStroke> masks_from(const StyleJson& json) {
    const StyleJson list = json.value("masks", StyleJson::array());
    if (!list.is_array()) refuse("style", "\"masks\" must be a list");
    std::vector<MaskStroke> masks;
    for (std::size_t i = 0; i < list.size(); ++i) {
        Reader reader(list[i], "mask " + std::to_string(i + 1));
        describe(reader, masks.emplace_back());
        reader.finish();
    }
    return masks;
}

StyleContent content_from(const StyleJson& json) {
    if (!json.is_object()) refuse("style", "an object {...} is expected");
    require_version(json);
    StyleContent content;
    Reader reader(json, "style");
    describe(reader, content);
    reader.finish();
    if (const auto volume = json.find("volume"); volume != json.end()) {
        Reader box(*volume, "volume");
        describe(box, content.options.volume.emplace());
        box.finish();
    }
    const StyleJson curves = json.value("curves", StyleJson::array());
    if (!curves.is_array()) refuse("style", "\"curves\" must be a list");
    for (std::size_t i = 0; i < curves.size(); ++i) {
        content.curves.push_back(
            curve_from(curves[i], content.options.fidelity, "curve " + std::to_string(i + 1)));
    }
    content.masks = masks_from(json);
    return content;
}

std::string text_of(const StyleContent& content) {
    // Described as mutable values.
    StyleContent copy = content;
    StyleJson json = StyleJson::object();
    json["format"] = kFormat;
    json["version"] = kStyleVersion;
    Writer writer(json);
    describe(writer, copy);
    if (copy.options.volume) {
        Writer volume(json["volume"] = StyleJson::object());
        describe(volume, *copy.options.volume);
    }
    StyleJson& curves = json["curves"] = StyleJson::array();
    for (StyleCurve& curve : copy.curves) {
        StyleJson one = StyleJson::object();
        one["kind"] = kind_name(curve);
        const HairFidelity fidelity = fidelity_of(curve);
        if (fidelity != copy.options.fidelity) {
            one["fidelity"] = fidelity == HairFidelity::thesis ? kThesisName : kDefaultName;
        }
        Writer described(one);
        describe(described, curve);
        curves.push_back(std::move(one));
    }
    for (MaskStroke& mask : copy.masks) {
        StyleJson& masks = *json.emplace("masks", StyleJson::array()).first;
        Writer writer_of_mask(masks.emplace_back(StyleJson::object()));
        describe(writer_of_mask, mask);
    }
    std::string text;
    append_json(text, json, "");
    return text + "\n";
}

}  // namespace

StyleContent content_of(const Hairstyle& style, std::string head) {
    return with_memory_errors([&] {
        StyleContent content = content_of(style.inputs(), style.options());
        content.head = std::move(head);
        return content;
    });
}

StyleContent content_of(const StyleInputs& inputs, const HairstyleOptions& options) {
    StyleContent content{{}, options, {}, !inputs.scalp_step.empty(), inputs.masks};
    for (const PlacedCurve& placed : inputs.curves) content.curves.push_back(placed.curve);
    return content;
}

Hairstyle make_style(const StyleContent& content, const Mesh& head,
                     std::shared_ptr<const Scalp> scalp, const Context& context) {
    Hairstyle style(head, std::move(scalp), content.options, context);
    style.add_all(content.curves, context);
    for (const MaskStroke& mask : content.masks) style.add_mask(mask);
    if (content.avoids_scalp) style.avoid_scalp({}, context);
    return style;
}

std::string encode_style(const StyleContent& content) {
    return with_memory_errors([&] { return text_of(content); });
}

StyleContent decode_style(std::string_view bytes) {
    // Deep nesting would exhaust the stack of the parser.
    constexpr int kDeepest = 16;
    const auto callback = [](int depth, StyleJson::parse_event_t, StyleJson&) {
        if (depth > kDeepest) refuse("style", "nested too deeply");
        return true;
    };
    try {
        return content_from(StyleJson::parse(bytes.begin(), bytes.end(), callback));
    } catch (const StyleJson::exception& error) {
        refuse("style", without_tag(error.what()));
    }
}

void save_style(const StyleContent& content, const std::filesystem::path& path,
                const Context& context) {
    with_memory_errors([&] { write_file_atomically(path, encode_style(content), context); });
}

StyleContent load_style(const std::filesystem::path& path, const Context& context) {
    const FileContent file = read_file(path, context);
    try {
        return decode_style(file.bytes);
    } catch (const Error& error) {
        const std::string name = display_name(path);
        throw FileError(error.code(), name, name + ": " + error.what());
    }
}

}  // namespace lissom
