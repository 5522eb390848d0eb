#include "kernel/io/usda/curves.h"

#include <cmath>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/io/stream/ticker.h"
#include "kernel/io/usda/prim.h"
#include "kernel/io/usda/text.h"

namespace lissom {
namespace {

constexpr std::size_t kDeepestPrim = 256;

class LayerReader {
  public:
    LayerReader(std::string_view bytes, const Context& context) : text_(bytes), context_(context) {}

    UsdaHair read() {
        Progress progress(context_, "read strands");
        Ticker ticker(progress);
        if (text_.peek().is("(")) read_layer_metadata();
        while (text_.peek().kind != UsdaText::Kind::end) {
            ticker.tick([&] { return text_.fraction(); });
            read_statement();
        }
        if (!open_.empty()) text_.refuse_token("'}'");
        hair_.strands = joined();
        return std::move(hair_);
    }

  private:
    struct OpenPrim {
        bool is_curves = false;
        /// Whether a transform holds for what lies inside.
        bool is_moved = false;
    };

    void read_layer_metadata() {
        text_.expect("(");
        while (!text_.take(")")) {
            const UsdaText::Token key = text_.take();
            if (!text_.take("=")) continue;
            if (key.is("metersPerUnit")) {
                hair_.meters_per_unit = positive_number(key);
            } else if (key.is("upAxis")) {
                const std::vector<std::string> axis = text_.texts();
                hair_.up = axis == std::vector<std::string>{"Z"} ? UpAxis::z : UpAxis::y;
            } else {
                text_.skip_value();
            }
        }
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
        OpenPrim prim = open_.empty() ? OpenPrim{} : OpenPrim{false, open_.back().is_moved};
        if (text_.peek().kind == UsdaText::Kind::word) {
            prim.is_curves = text_.take().is("BasisCurves") && first.is("def");
        }
        if (text_.peek().kind != UsdaText::Kind::text) text_.refuse_token("the name of a prim");
        const UsdaText::Token name = text_.take();
        if (text_.peek().is("(")) text_.skip_value();
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
        }
        open_.push_back(prim);
    }

    void close_prim(const UsdaText::Token& brace) {
        if (open_.empty()) {
            refuse(ErrorCode::file_syntax, "a bracket '}' that nothing opened",
                   {ElementKind::line, brace.line});
        }
        if (open_.back().is_curves) {
            if (open_.back().is_moved) {
                refuse(ErrorCode::unsupported,
                       "the curves stand under a transform; apply it before exporting",
                       prims_[filled_.back()].place);
            }
            filled_.pop_back();
        }
        open_.pop_back();
    }

    void skip_variants() {
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
        if (name.is("xformOpOrder")) {
            open_.back().is_moved |= !text_.texts().empty();
        } else if (!open_.back().is_curves || !read_curves_value(name)) {
            refuse_samples(name);
            text_.skip_value();
        }
    }

    void refuse_samples(const UsdaText::Token& name) const {
        if (!open_.back().is_curves || !name.value.ends_with(".timeSamples")) return;
        if (!name.value.starts_with("points") && !name.value.starts_with("curveVertexCounts")) {
            return;
        }
        refuse(ErrorCode::unsupported, "the curves change over time; export a single frame",
               {ElementKind::line, name.line});
    }

    bool read_curves_value(const UsdaText::Token& name) {
        CurvesPrim& prim = prims_[filled_.back()];
        if (name.is("type")) return read_word(prim.type);
        if (name.is("basis")) return read_word(prim.basis);
        if (name.is("wrap")) return read_word(prim.wrap);
        if (name.is("curveVertexCounts")) return read_list(prim.counts);
        if (name.is("points")) return read_list(prim.points);
        if (name.is("widths")) return read_values(prim.widths, CurveInterpolation::vertex);
        if (name.is("primvars:st")) return read_values(prim.uvs, CurveInterpolation::constant);
        if (name.is("primvars:displayColor")) {
            return read_values(prim.colors, CurveInterpolation::constant);
        }
        if (name.is("primvars:displayOpacity")) {
            return read_values(prim.opacities, CurveInterpolation::constant);
        }
        if (name.is("primvars:lissom:width")) {
            return read_values(prim.base_widths, CurveInterpolation::constant);
        }
        if (name.is("primvars:lissom:transparency")) {
            return read_values(prim.transparencies, CurveInterpolation::constant);
        }
        if (name.is("lissom:widthProfile")) return read_list(prim.width_profile);
        if (name.is("lissom:comment")) return read_word(prim.comment);
        if (name.is("primvars:group")) return read_texts(prim.group_names);
        if (name.is("primvars:group:indices")) return read_list(prim.groups);
        if (name.is("primvars:strandId")) return read_list(prim.ids);
        if (name.is("primvars:rootFace")) return read_list(prim.faces);
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
        if (text_.take("(")) read_interpolation(values);
        return true;
    }

    void read_interpolation(CurveValues& values) {
        while (!text_.take(")")) {
            const UsdaText::Token key = text_.take();
            if (!text_.take("=")) continue;
            if (!key.is("interpolation")) {
                text_.skip_value();
                continue;
            }
            const UsdaText::Token kind = text_.take();
            if (kind.value == "constant") {
                values.interpolation = CurveInterpolation::constant;
            } else if (kind.value == "uniform") {
                values.interpolation = CurveInterpolation::uniform;
            } else if (kind.value == "varying") {
                values.interpolation = CurveInterpolation::varying;
            } else if (kind.value == "vertex") {
                values.interpolation = CurveInterpolation::vertex;
            } else {
                refuse(ErrorCode::unsupported,
                       "the interpolation " + in_quotes(kind.value) + " is not known for curves",
                       {ElementKind::line, kind.line});
            }
        }
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
    UsdaHair hair_;
    std::vector<OpenPrim> open_;
    std::vector<CurvesPrim> prims_;
    /// The prims of curves that are open, innermost last.
    std::vector<std::size_t> filled_;
};

}  // namespace

UsdaHair read_usda(std::string_view bytes, const Context& context) {
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
