#include "kernel/io/usda/curves.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/io/record/skipped_content.h"
#include "kernel/io/stream/ticker.h"
#include "kernel/io/usda/prim.h"
#include "kernel/io/usda/text.h"
#include "kernel/io/usda/transform.h"

namespace lissom {
namespace {

constexpr std::size_t kDeepestPrim = 256;

class LayerReader {
  public:
    LayerReader(std::string_view bytes, const Context& context) : text_(bytes), context_(context) {}

    FileHair read() {
        Progress progress(context_, "read strands");
        Ticker ticker(progress);
        if (text_.peek().is("(")) read_layer_metadata();
        while (text_.peek().kind != UsdaText::Kind::end) {
            ticker.tick([&] { return text_.fraction(); });
            read_statement();
        }
        if (!open_.empty()) text_.refuse_token("'}'");
        if (prims_.empty()) log_content();
        drop_hidden();
        hair_.strands = joined();
        return std::move(hair_);
    }

  private:
    struct OpenPrim {
        bool is_curves = false;
        bool is_active = true, is_visible = true;
        UsdaTransform transform;
        /// Number of the first curves that lie inside.
        std::size_t first_curves = 0;
    };

    // Calls visit(key) for the entries of metadata in round brackets, which returns whether it read
    // the value.
    template <typename Visit>
    void read_metadata(const Visit& visit) {
        text_.expect("(");
        while (!text_.take(")")) {
            if (text_.peek().kind == UsdaText::Kind::punctuation) {
                text_.skip_value();
                continue;
            }
            const UsdaText::Token key = text_.take();
            if (text_.take("=") && !visit(key)) text_.skip_value();
        }
    }

    void read_layer_metadata() {
        read_metadata([&](const UsdaText::Token& key) {
            if (key.is("metersPerUnit")) {
                hair_.meters_per_unit = positive_number(key);
            } else if (key.is("upAxis")) {
                const std::vector<std::string> axis = text_.texts();
                hair_.up = axis == std::vector<std::string>{"Z"} ? UpAxis::z : UpAxis::y;
            } else {
                return read_reference(key);
            }
            return true;
        });
    }

    void read_prim_metadata(OpenPrim& prim) {
        read_metadata([&](const UsdaText::Token& key) {
            if (!key.is("active")) return read_reference(key);
            std::string value = "true";
            read_word(value);
            prim.is_active = value != "false" && value != "0";
            return true;
        });
    }

    // Remembers a file that the layer takes prims from.
    bool read_reference(const UsdaText::Token& key) {
        if (!key.is("references") && !key.is("payload") && !key.is("subLayers")) return false;
        for (const std::string& target : text_.texts()) {
            if (reference_.empty() && target.starts_with('@')) reference_ = target;
        }
        return true;
    }

    double positive_number(const UsdaText::Token& key) {
        const std::vector<double> value = text_.numbers();
        if (value.size() == 1 && value[0] > 0.0 && std::isfinite(value[0])) return value[0];
        refuse(ErrorCode::file_syntax, std::string(key.value) + " must be a positive number",
               {ElementKind::line, key.line});
    }

    // A prim, its end, or a property.
    void read_statement() {
        const UsdaText::Token first = text_.take();
        if (first.is("def") || first.is("over") || first.is("class")) {
            open_prim(first);
        } else if (first.is("}")) {
            close_prim(first);
        } else if (first.is("variantSet")) {
            skip_variants();
        } else if (!first.is(";")) {
            read_property(first);
        }
    }

    void open_prim(const UsdaText::Token& first) {
        OpenPrim prim;
        prim.first_curves = prims_.size();
        std::string type;
        if (text_.peek().kind == UsdaText::Kind::word) type = text_.take().value;
        prim.is_curves = type == "BasisCurves" && first.is("def");
        if (text_.peek().kind != UsdaText::Kind::text) text_.refuse_token("the name of a prim");
        const UsdaText::Token name = text_.take();
        if (text_.peek().is("(")) read_prim_metadata(prim);
        text_.expect("{");
        if (open_.size() >= kDeepestPrim) {
            refuse(ErrorCode::file_syntax, "prims are nested too deep",
                   {ElementKind::line, name.line});
        }
        if (prim.is_curves) {
            prims_.emplace_back();
            prims_.back().name = name.value;
            prims_.back().place = {ElementKind::line, name.line};
            filled_.push_back(prims_.size() - 1);
        } else {
            count_other(type);
        }
        open_.push_back(std::move(prim));
    }

    void count_other(const std::string& type) {
        const std::string name = in_quotes(type);
        others_.add(type.empty() ? "prims without a type" : name.substr(1, name.size() - 2));
    }

    void close_prim(const UsdaText::Token& brace) {
        if (open_.empty()) {
            refuse(ErrorCode::file_syntax, "a bracket '}' that nothing opened",
                   {ElementKind::line, brace.line});
        }
        const OpenPrim& prim = open_.back();
        if (prim.is_curves) filled_.pop_back();
        if (!prim.is_active || !prim.is_visible) {
            hide_curves(prim);
        } else if (prim.transform.is_set()) {
            move_curves(prim);
        }
        open_.pop_back();
    }

    void hide_curves(const OpenPrim& prim) {
        for (std::size_t i = prim.first_curves; i < prims_.size(); ++i) prims_[i].is_drawn = false;
    }

    // Applies the transform of a prim to the curves inside.
    void move_curves(const OpenPrim& prim) {
        std::optional<Affine> matrix;
        for (std::size_t i = prim.first_curves; i < prims_.size(); ++i) {
            CurvesPrim& curves = prims_[i];
            if (curves.is_placed || !curves.is_drawn) continue;
            if (!matrix) matrix = prim.transform.matrix();
            curves.transform = *matrix * curves.transform;
            curves.is_placed = prim.transform.resets();
        }
    }

    void skip_variants() {
        others_.add("variant sets");
        text_.skip_value();
        text_.expect("=");
        text_.skip_value();
    }

    // [custom] [uniform] type name = value ( metadata ); the value may be missing.
    void read_property(const UsdaText::Token& first) {
        UsdaText::Token name = first;
        while (!text_.peek().is("=") && text_.peek().line == first.line &&
               text_.peek().kind != UsdaText::Kind::end && !text_.peek().is("(") &&
               !text_.peek().is("}")) {
            const UsdaText::Token token = text_.take();
            // The brackets of an array type belong to the type.
            if (!token.is("[") && !token.is("]")) name = token;
        }
        if (text_.take("=")) read_value(name);
        if (text_.peek().is("(")) text_.skip_value();
    }

    void read_value(const UsdaText::Token& name) {
        if (open_.empty()) return text_.skip_value();
        OpenPrim& prim = open_.back();
        if (name.is("xformOpOrder")) {
            prim.transform.set_order(text_.texts(), {ElementKind::line, name.line});
        } else if (name.is("visibility")) {
            std::string value;
            read_word(value);
            prim.is_visible = value != "invisible";
        } else if (name.value.starts_with("xformOp:")) {
            read_operation(name.value, prim.transform);
        } else if (!open_.back().is_curves || !read_curves_value(name)) {
            refuse_samples(name);
            text_.skip_value();
        }
    }

    void read_operation(std::string_view name, UsdaTransform& transform) {
        constexpr std::string_view kTimeSamples = ".timeSamples";
        if (!name.ends_with(kTimeSamples)) return transform.set_operation(name, text_.numbers());
        transform.set_changing(name.substr(0, name.size() - kTimeSamples.size()));
        text_.skip_value();
    }

    void refuse_samples(const UsdaText::Token& name) const {
        if (!open_.back().is_curves || !name.value.ends_with(".timeSamples")) return;
        if (!name.value.starts_with("points") && !name.value.starts_with("curveVertexCounts")) {
            return;
        }
        refuse(ErrorCode::unsupported, "the curves change over time; export a single frame",
               {ElementKind::line, name.line});
    }

    // The values that have an interpolation, and may be indexed, or null for other names.
    static CurveValues* values_called(std::string_view name, CurvesPrim& prim) {
        if (name == "widths" || name == "primvars:widths") return &prim.widths;
        if (name == "primvars:st") return &prim.uvs;
        if (name == "primvars:displayColor") return &prim.colors;
        if (name == "primvars:displayOpacity") return &prim.opacities;
        if (name == "primvars:lissom:width") return &prim.base_widths;
        if (name == "primvars:lissom:transparency") return &prim.transparencies;
        return nullptr;
    }

    bool read_curves_value(const UsdaText::Token& name) {
        constexpr std::string_view kIndices = ":indices";
        CurvesPrim& prim = prims_[filled_.back()];
        if (CurveValues* values = values_called(name.value, prim)) {
            const bool is_width = values == &prim.widths;
            return read_values(
                *values, is_width ? CurveInterpolation::vertex : CurveInterpolation::constant);
        }
        if (name.value.ends_with(kIndices)) {
            const auto stem = name.value.substr(0, name.value.size() - kIndices.size());
            if (CurveValues* values = values_called(stem, prim)) {
                values->is_indexed = true;
                return read_list(values->indices);
            }
        }
        if (name.is("type")) return read_word(prim.type);
        if (name.is("basis")) return read_word(prim.basis);
        if (name.is("wrap")) return read_word(prim.wrap);
        if (name.is("curveVertexCounts")) return read_list(prim.counts);
        if (name.is("points")) return read_list(prim.points);
        if (name.is("lissom:widthProfile")) return read_list(prim.width_profile);
        if (name.is("lissom:comment")) return read_word(prim.comment);
        if (name.is("primvars:group")) return read_texts(prim.group_names);
        if (name.is("primvars:group:indices")) return read_list(prim.groups);
        if (name.is("primvars:strandId")) return read_list(prim.ids);
        if (name.is("primvars:guideId")) return read_list(prim.guides);
        if (name.is("primvars:guideArc")) return read_list(prim.guide_arcs);
        if (name.is("primvars:rootFace")) return read_list(prim.faces);
        if (name.is("primvars:rootVertices")) return read_list(prim.root_vertices);
        if (name.is("primvars:rootBarycentrics")) return read_list(prim.barycentrics);
        return false;
    }

    bool read_word(std::string& word) {
        const std::vector<std::string> values = text_.texts();
        if (!values.empty()) word = values.front();
        return true;
    }
    bool read_texts(std::vector<std::string>& texts) {
        texts = text_.texts();
        return true;
    }
    bool read_list(std::vector<double>& list) {
        list = text_.numbers();
        return true;
    }
    bool read_list(std::vector<float>& list) {
        list = text_.floats();
        return true;
    }

    bool read_values(CurveValues& values, CurveInterpolation usual) {
        values.numbers = text_.floats();
        values.found = !values.numbers.empty();
        values.interpolation = usual;
        if (text_.peek().is("(")) read_interpolation(values);
        return true;
    }

    void read_interpolation(CurveValues& values) {
        read_metadata([&](const UsdaText::Token& key) {
            if (!key.is("interpolation")) return false;
            const UsdaText::Token kind = text_.take();
            values.interpolation = interpolation_called(kind);
            return true;
        });
    }

    static CurveInterpolation interpolation_called(const UsdaText::Token& kind) {
        if (kind.value == "constant") return CurveInterpolation::constant;
        if (kind.value == "uniform") return CurveInterpolation::uniform;
        if (kind.value == "varying") return CurveInterpolation::varying;
        if (kind.value == "vertex") return CurveInterpolation::vertex;
        refuse(ErrorCode::unsupported,
               "the interpolation " + in_quotes(kind.value) + " is not known for curves",
               {ElementKind::line, kind.line});
    }

    // Curves that are not drawn are named, not read.
    void drop_hidden() {
        constexpr std::size_t kShown = 5;
        std::string names;
        std::size_t count = 0;
        for (const CurvesPrim& prim : prims_) {
            if (prim.is_drawn) continue;
            if (++count <= kShown) names += (count == 1 ? "" : ", ") + in_quotes(prim.name);
        }
        if (count == 0) return;
        std::erase_if(prims_, [](const CurvesPrim& prim) { return !prim.is_drawn; });
        context_.log(LogLevel::warning, std::to_string(count) +
                                            " BasisCurves that are inactive or invisible were "
                                            "left out: " +
                                            names + (count > kShown ? ", ..." : ""));
    }

    // Describes the contents of a layer without any curves.
    void log_content() const {
        Report report;
        others_.finish(report);
        std::string text = "the file holds no BasisCurves";
        if (!report.findings().empty()) text += "; it holds " + report.findings()[0].message;
        if (!reference_.empty()) {
            text += "; it refers to " + in_quotes(reference_) +
                    ", which is not read: flatten it first, for instance with usdcat --flatten";
        }
        context_.log(LogLevel::warning, text);
    }

    // Neighbours are joined pair by pair, so that many prims cost no more than few.
    Strands joined() {
        std::vector<Strands> parts;
        for (CurvesPrim& prim : prims_) {
            std::string name = prim.name;
            hair_.has_widths |= prim.widths.found;
            Strands part = strands_of(std::move(prim), context_);
            if (prims_.size() > 1 && part.groups().empty()) {
                part.set_groups(std::vector<Index>(part.size(), 0), {std::move(name)});
            }
            parts.push_back(std::move(part));
        }
        for (std::size_t step = 1; step < parts.size(); step *= 2) {
            for (std::size_t i = 0; i + step < parts.size(); i += 2 * step) {
                context_.checkpoint();
                append(parts[i], parts[i + step]);
                parts[i + step] = {};
            }
        }
        return parts.empty() ? Strands() : std::move(parts.front());
    }

    UsdaText text_;
    const Context& context_;
    FileHair hair_;
    std::vector<OpenPrim> open_;
    std::vector<CurvesPrim> prims_;
    /// The prims of curves that are open, innermost last.
    std::vector<std::size_t> filled_;
    /// Prims of other types, by type.
    SkippedContent others_;
    /// A file that the layer refers to.
    std::string reference_;
};

}  // namespace

FileHair read_usda(std::string_view bytes, const Context& context) {
    if (!bytes.starts_with("#usda ")) {
        refuse(ErrorCode::file_syntax,
               bytes.starts_with("PXR-USDC")
                   ? "this is binary USD; save it as text (.usda), for instance with usdcat"
                   : "this is not a USD layer in text form: it does not begin with #usda",
               {ElementKind::line, 0});
    }
    return LayerReader(bytes, context).read();
}

}  // namespace lissom
