#include <vector>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/io/stream/ticker.h"
#include "kernel/io/usda/curves.h"

namespace lissom {
namespace {

// Lists are broken into lines, since editors choke on long ones.
constexpr std::size_t kLineLength = 120;

class LayerWriter {
  public:
    LayerWriter(const Strands& strands, const StrandSkin* skin, std::string& text,
                const Context& context)
        : strands_(strands), skin_(skin), text_(text), context_(context) {}

    void write(double meters_per_unit, UpAxis up) {
        Progress progress(context_, "write strands");
        text_ += std::string("#usda 1.0\n(\n    defaultPrim = \"") + (skin_ ? "Groom" : "Hair") +
                 "\"\n    metersPerUnit = ";
        append_number(text_, meters_per_unit);
        text_ += std::string("\n    upAxis = \"") + (up == UpAxis::z ? "Z" : "Y") + "\"\n)\n\n";
        if (skin_) open_skeleton();
        write_curves(progress);
        if (skin_) text_ += "}\n";
    }

  private:
    void write_curves(Progress& progress) {
        line("def BasisCurves \"Hair\" (");
        line(std::string("    prepend apiSchemas = [") + (skin_ ? "\"SkelBindingAPI\", " : "") +
             "\"GroomAPI\"]");
        line(")");
        line("{");
        line("    uniform token type = \"linear\"");
        progress.update(0.05);
        list("int[] curveVertexCounts", strands_.size(),
             [&](Index s) { append_number(text_, strands_.point_count(s)); });
        write_points(progress);
        write_extent();
        write_widths();
        progress.update(0.8);
        write_colors();
        write_transparency();
        write_roots();
        write_guides();
        write_groups();
        write_groom();
        write_comment();
        if (skin_) write_binding();
        line("}");
    }

    void line(std::string_view text) {
        text_ += indent_;
        text_ += text;
        text_ += '\n';
    }

    // name = [item, item, ...], without the end of the line.
    template <typename Item>
    void open_list(const std::string& name, Index count, const Item& item) {
        text_ += indent_ + "    " + name + " = [";
        std::size_t begin = text_.size();
        for (Index i = 0; i < count; ++i) {
            const bool is_full = text_.size() - begin > kLineLength;
            if (i > 0) text_ += is_full ? ",\n        " : ", ";
            if (is_full) begin = text_.size();
            item(i);
        }
        text_ += ']';
    }
    template <typename Item>
    void list(const std::string& name, Index count, const Item& item,
              const char* interpolation = nullptr) {
        open_list(name, count, item);
        if (interpolation) {
            text_ += " (\n" + indent_ + "        interpolation = \"" + interpolation + "\"\n" +
                     indent_ + "    )";
        }
        text_ += '\n';
    }

    void tuple(const float* values, int count) {
        text_ += '(';
        for (int c = 0; c < count; ++c) {
            if (c > 0) text_ += ", ";
            append_number(text_, values[c]);
        }
        text_ += ')';
    }

    void vertices(const Triangle& triangle) {
        for (std::size_t c = 0; c < 3; ++c) {
            text_ += c == 0 ? "(" : ", ";
            append_number(text_, triangle[c]);
        }
        text_ += ')';
    }

    void write_points(Progress& progress) {
        Ticker ticker(progress);
        const Index count = strands_.point_count();
        list("point3f[] points", count, [&](Index p) {
            ticker.tick([&] { return 0.1 + 0.6 * double(p) / double(count); });
            tuple(strands_.points().data() + 3 * at(p), 3);
        });
    }

    void write_extent() {
        const Box box = bounds(strands_);
        if (box.empty()) return;
        const Eigen::Vector3f corners[] = {box.min.cast<float>(), box.max.cast<float>()};
        list("float3[] extent", 2, [&](Index i) { tuple(corners[i].data(), 3); });
    }

    // One number for all, for each strand or for each point.
    template <typename Change>
    void write_values(const std::string& name, const StrandValues<float>& values,
                      const Change& change) {
        const bool one = values.domain == StrandDomain::all;
        list(
            name, one ? 1 : count_of(values.values),
            [&](Index i) { append_number(text_, change(one ? values.common : values.values[i])); },
            one ? "constant" : interpolation(values.domain));
    }

    void write_widths() {
        const auto same = [](float width) { return width; };
        const StrandWidths& widths = strands_.widths();
        if (widths.profile.empty()) return write_values("float[] widths", widths, same);
        write_point_widths();
        write_values("float[] primvars:lissom:width", widths, same);
        list("custom float[] lissom:widthProfile", count_of(widths.profile),
             [&](Index i) { append_number(text_, widths.profile[i]); });
    }

    void write_transparency() {
        const StrandValues<float>& values = strands_.transparency();
        if (values.domain == StrandDomain::all && values.common == 0.0f) return;
        write_values("float[] primvars:displayOpacity", values,
                     [](float transparency) { return 1.0f - transparency; });
        write_values("float[] primvars:lissom:transparency", values,
                     [](float transparency) { return transparency; });
    }

    void write_point_widths() {
        std::vector<float> all, one;
        all.reserve(strands_.point_count());
        for (Index s = 0; s < strands_.size(); ++s) {
            widths_of(strands_, s, one);
            all.insert(all.end(), one.begin(), one.end());
        }
        list(
            "float[] widths", strands_.point_count(),
            [&](Index p) { append_number(text_, all[p]); }, "vertex");
    }

    void write_colors() {
        const StrandValues<Eigen::Vector3f>* const colors = strands_.colors();
        if (!colors) return;
        if (colors->domain == StrandDomain::all) {
            list(
                "color3f[] primvars:displayColor", 1,
                [&](Index) { tuple(colors->common.data(), 3); }, "constant");
            return;
        }
        list(
            "color3f[] primvars:displayColor", count_of(colors->values),
            [&](Index i) { tuple(colors->values[i].data(), 3); }, interpolation(colors->domain));
    }

    void write_roots() {
        const StrandRoots& roots = strands_.roots();
        if (!roots.uvs.empty()) {
            list(
                "texCoord2f[] primvars:st", strands_.size(),
                [&](Index s) { tuple(roots.uvs[at(s)].data(), 2); }, "uniform");
        }
        if (!roots.faces.empty()) {
            list(
                "int[] primvars:rootFace", strands_.size(),
                [&](Index s) { append_number(text_, roots.faces[at(s)]); }, "uniform");
            list(
                "float3[] primvars:rootBarycentrics", strands_.size(),
                [&](Index s) { tuple(roots.barycentrics[at(s)].data(), 3); }, "uniform");
        }
        if (!roots.triangles.empty()) {
            list(
                "int3[] primvars:rootVertices", strands_.size(),
                [&](Index s) { vertices(roots.triangles[at(s)]); }, "uniform");
        }
        if (strands_.ids().empty()) return;
        list(
            "uint[] primvars:strandId", strands_.size(),
            [&](Index s) { append_number(text_, strands_.ids()[at(s)]); }, "uniform");
    }

    void write_guides() {
        const StrandGuides& guides = strands_.guides();
        if (guides.ids.empty()) return;
        list(
            "uint[] primvars:guideId", strands_.size(),
            [&](Index s) { append_number(text_, guides.ids[at(s)]); }, "uniform");
        list(
            "float[] primvars:guideArc", strands_.size(),
            [&](Index s) { append_number(text_, guides.arcs[at(s)]); }, "uniform");
    }

    void write_groups() {
        if (strands_.groups().empty()) return;
        const std::vector<std::string>& names = strands_.group_names();
        list(
            "string[] primvars:group", count_of(names), [&](Index i) { append_text(names[i]); },
            "uniform");
        list("int[] primvars:group:indices", strands_.size(),
             [&](Index s) { append_number(text_, strands_.group(s)); });
    }

    // The same once more by the names that Unreal Engine's import of grooms reads.
    void write_groom() {
        line("    int primvars:groom_version_major = 1");
        line("    int primvars:groom_version_minor = 5");
        list(
            "int[] primvars:groom_id", strands_.size(), [&](Index s) { append_number(text_, s); },
            "uniform");
        write_groom_guides();
        const StrandRoots& roots = strands_.roots();
        if (!roots.uvs.empty()) {
            list(
                "float2[] primvars:groom_root_uv", strands_.size(),
                [&](Index s) { tuple(roots.uvs[at(s)].data(), 2); }, "uniform");
        }
        if (strands_.groups().empty()) return;
        // The strands of no group are one of their own.
        const std::vector<std::string>& names = strands_.group_names();
        const auto number = [&](Index s) {
            return strands_.group(s) == kNoIndex ? count_of(names) : strands_.group(s);
        };
        list(
            "int[] primvars:groom_group_id", strands_.size(),
            [&](Index s) { append_number(text_, number(s)); }, "uniform");
        list(
            "string[] primvars:groom_group_name", strands_.size(),
            [&](Index s) {
                append_text(strands_.group(s) == kNoIndex ? "" : names[at(number(s))]);
            },
            "uniform");
    }

    void write_groom_guides() {
        const StrandGuides& guides = strands_.guides();
        if (guides.ids.empty()) return;
        list(
            "int[] primvars:groom_guide", strands_.size(),
            [&](Index s) { append_number(text_, guides.ids[at(s)] == strands_.id(s) ? 1 : 0); },
            "uniform");
    }

    void write_comment() {
        if (strands_.comment().empty()) return;
        text_ += indent_ + "    custom string lissom:comment = ";
        append_text(strands_.comment());
        text_ += '\n';
    }

    // Begins the SkelRoot, which holds the skeleton and the hair.
    void open_skeleton() {
        line("def SkelRoot \"Groom\"");
        line("{");
        indent_ = "    ";
        line("def Skeleton \"Skeleton\"");
        line("{");
        const std::vector<std::string> paths = joint_paths(skin_->skeleton);
        list("uniform token[] joints", count_of(paths),
             [&](Index j) { append_text(paths[at(j)]); });
        write_transforms("uniform matrix4d[] bindTransforms", skin_->skeleton.bind);
        write_transforms("uniform matrix4d[] restTransforms", skin_->skeleton.rest);
        line("}");
        text_ += '\n';
    }

    // USD multiplies rows by matrices: the translation is the last row.
    void write_transforms(const std::string& name, const std::vector<Affine>& transforms) {
        list(name, count_of(transforms), [&](Index j) {
            const Affine& map = transforms[at(j)];
            text_ += '(';
            for (Index column = 0; column < 3; ++column) {
                write_row(map.linear.col(column), 0);
                text_ += ", ";
            }
            write_row(map.translation, 1);
            text_ += ')';
        });
    }
    void write_row(const Vec3& values, int last) {
        text_ += '(';
        for (const double value : values) {
            append_number(text_, value);
            text_ += ", ";
        }
        append_number(text_, last);
        text_ += ')';
    }

    // All points of a strand have the joints of its root.
    void write_binding() {
        line("    rel skel:skeleton = </Groom/Skeleton>");
        line(
            "    matrix4d primvars:skel:geomBindTransform = "
            "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))");
        write_influences("int[] primvars:skel:jointIndices",
                         [&](const StrandSkin::Joint& one) { append_number(text_, one.joint); });
        write_influences("float[] primvars:skel:jointWeights",
                         [&](const StrandSkin::Joint& one) { append_number(text_, one.weight); });
    }
    template <typename Write>
    void write_influences(const std::string& name, const Write& write) {
        Index strand = 0;
        open_list(name, strands_.point_count(), [&](Index p) {
            while (p >= strands_.offsets()[at(strand) + 1]) ++strand;
            const auto& joints = skin_->of_strand[at(strand)];
            for (std::size_t i = 0; i < joints.size(); ++i) {
                if (i > 0) text_ += ", ";
                write(joints[i]);
            }
        });
        text_ += " (\n" + indent_ +
                 "        elementSize = " + std::to_string(StrandSkin::kInfluences) + "\n" +
                 indent_ + "        interpolation = \"vertex\"\n" + indent_ + "    )\n";
    }

    void append_text(const std::string& name) {
        constexpr const char* kHex = "0123456789abcdef";
        text_ += '"';
        for (const char c : name) {
            const auto code = static_cast<unsigned char>(c);
            if (code < 0x20) {
                text_ += {'\\', 'x', kHex[code >> 4], kHex[code & 15]};
                continue;
            }
            if (c == '"' || c == '\\') text_ += '\\';
            text_ += c;
        }
        text_ += '"';
    }

    static const char* interpolation(StrandDomain domain) {
        return domain == StrandDomain::strand ? "uniform" : "vertex";
    }

    const Strands& strands_;
    const StrandSkin* skin_;
    std::string& text_;
    std::string indent_;
    const Context& context_;
};

}  // namespace

void write_usda(const Strands& strands, double meters_per_unit, UpAxis up, const StrandSkin* skin,
                std::string& bytes, const Context& context) {
    bytes.reserve((skin ? 120 : 40) * at(strands.point_count()) + 1000);
    LayerWriter(strands, skin, bytes, context).write(meters_per_unit, up);
}

}  // namespace lissom
