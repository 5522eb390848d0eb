#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/ply/header.h"
#include "kernel/io/ply/strands.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/io/stream/ticker.h"

namespace lissom {
namespace {

// A property of points or strands, and its value for each.
struct StrandProperty {
    PlyProperty property;
    std::function<double(Index)> value;
};

bool is_byte_color(float value) {
    const float k = std::round(value * 255.0f);
    return k >= 0.0f && k <= 255.0f && static_cast<float>(double(k) / 255.0) == value;
}

class StrandPlyWriter {
  public:
    StrandPlyWriter(const Strands& strands, std::string& bytes) : strands_(strands), bytes_(bytes) {
        header_.binary = true;
        header_.endianness = Endianness::little;
        header_.label_names["group"] = strands.group_names();
        if (!strands.comment().empty()) header_.label_names["comment"] = {strands.comment()};
    }

    void write(const Context& context) {
        Progress progress(context, "write strands");
        add_points();
        add_colors();
        add_widths();
        add_strands();
        add_roots();
        add_guides();
        const Index segments = strands_.point_count() - strands_.size();
        header_.elements = {element("vertex", strands_.point_count(), points_),
                            element("strand", strands_.size(), each_),
                            {"edge",
                             at(segments),
                             {{"vertex1", ScalarType::int32}, {"vertex2", ScalarType::int32}}}};
        bytes_ += to_text(header_);
        write_rows(points_, strands_.point_count(), progress, 0.0);
        write_rows(each_, strands_.size(), progress, 0.6);
        write_links(progress);
    }

  private:
    static PlyElement element(const std::string& name, Index count,
                              const std::vector<StrandProperty>& list) {
        PlyElement result{name, at(count), {}};
        for (const StrandProperty& one : list) result.properties.push_back(one.property);
        return result;
    }

    void add_point(const std::string& name, ScalarType type, std::function<double(Index)> value) {
        points_.push_back({{name, type}, std::move(value)});
    }
    void add_strand(const std::string& name, ScalarType type, std::function<double(Index)> value) {
        each_.push_back({{name, type}, std::move(value)});
    }

    void add_points() {
        for (Index k = 0; k < 3; ++k) {
            add_point(std::string(1, "xyz"[k]), ScalarType::float32,
                      [this, k](Index p) { return strands_.points()[3 * at(p) + at(k)]; });
        }
    }

    // The strand of each point, for values of strands.
    const std::vector<Index>& strand_of_point() {
        if (!owner_.empty() || strands_.empty()) return owner_;
        owner_.reserve(at(strands_.point_count()));
        for (Index s = 0; s < strands_.size(); ++s) {
            owner_.insert(owner_.end(), at(strands_.point_count(s)), s);
        }
        return owner_;
    }

    void add_colors() {
        const StrandValues<Eigen::Vector3f>* const colors = strands_.colors();
        strand_of_point();
        if (colors) {
            const auto fits = [](const Eigen::Vector3f& c) {
                return is_byte_color(c.x()) && is_byte_color(c.y()) && is_byte_color(c.z());
            };
            const bool bytes =
                colors->domain == StrandDomain::all
                    ? fits(colors->common)
                    : std::all_of(colors->values.begin(), colors->values.end(), fits);
            const ScalarType type = bytes ? ScalarType::uint8 : ScalarType::float32;
            for (Index k = 0; k < 3; ++k) {
                const char* const names[] = {"red", "green", "blue"};
                add_point(names[k], type, [this, colors, k, bytes](Index p) {
                    const double c = colors->at(owner_[at(p)], p)[k];
                    return bytes ? std::round(c * 255.0) : c;
                });
            }
        }
        const StrandValues<float>& transparency = strands_.transparency();
        if (transparency.domain == StrandDomain::all && transparency.common == 0.0f) return;
        add_point("transparency", ScalarType::float32,
                  [this](Index p) { return strands_.transparency().at(owner_[at(p)], p); });
    }

    void add_widths() {
        std::vector<float> one;
        widths_.reserve(at(strands_.point_count()));
        for (Index s = 0; s < strands_.size(); ++s) {
            widths_of(strands_, s, one);
            widths_.insert(widths_.end(), one.begin(), one.end());
        }
        add_point("thickness", ScalarType::float32, [this](Index p) { return widths_[at(p)]; });
    }

    void add_strands() {
        Index most = 0;
        for (Index s = 0; s < strands_.size(); ++s) most = std::max(most, strands_.point_count(s));
        add_strand("nsegs", most <= 65536 ? ScalarType::uint16 : ScalarType::uint32,
                   [this](Index s) { return strands_.point_count(s) - 1; });
        if (!strands_.groups().empty()) {
            add_strand("group", ScalarType::int32, [this](Index s) { return strands_.group(s); });
        }
        if (!strands_.ids().empty()) {
            add_strand("id", ScalarType::uint32, [this](Index s) { return strands_.id(s); });
        }
    }

    void add_roots() {
        const StrandRoots& roots = strands_.roots();
        for (Index k = 0; k < 2 && !roots.uvs.empty(); ++k) {
            add_strand(k == 0 ? "root_u" : "root_v", ScalarType::float32,
                       [&roots, k](Index s) { return roots.uvs[at(s)][k]; });
        }
        if (roots.faces.empty()) return;
        add_strand("root_face", ScalarType::int32,
                   [&roots](Index s) { return roots.faces[at(s)]; });
        for (Index k = 0; k < 3; ++k) {
            add_strand("root_weight_" + std::to_string(k), ScalarType::float32,
                       [&roots, k](Index s) { return roots.barycentrics[at(s)][k]; });
        }
        for (Index k = 0; k < 3 && !roots.triangles.empty(); ++k) {
            add_strand("root_vertex_" + std::to_string(k), ScalarType::int32,
                       [&roots, k](Index s) { return roots.triangles[at(s)][at(k)]; });
        }
    }

    void add_guides() {
        const StrandGuides& guides = strands_.guides();
        if (guides.ids.empty()) return;
        add_strand("guide", ScalarType::uint32, [&guides](Index s) { return guides.ids[at(s)]; });
        add_strand("guide_arc", ScalarType::float32,
                   [&guides](Index s) { return guides.arcs[at(s)]; });
    }

    void write_rows(const std::vector<StrandProperty>& list, Index count, Progress& progress,
                    double begun) {
        Ticker ticker(progress);
        for (Index row = 0; row < count; ++row) {
            ticker.tick([&] { return begun + 0.3 * row / count; });
            for (const StrandProperty& one : list) {
                const double value = one.value(row);
                with_scalar(one.property.type, [&](auto zero) {
                    append_number(bytes_, static_cast<decltype(zero)>(value), Endianness::little);
                });
            }
        }
    }

    void write_links(Progress& progress) {
        Ticker ticker(progress);
        for (Index s = 0; s < strands_.size(); ++s) {
            ticker.tick([&] { return 0.9 + 0.1 * s / strands_.size(); });
            const Index first = strands_.first_point(s);
            for (Index p = first; p + 1 < first + strands_.point_count(s); ++p) {
                append_number(bytes_, p, Endianness::little);
                append_number(bytes_, p + 1, Endianness::little);
            }
        }
    }

    const Strands& strands_;
    std::string& bytes_;
    PlyHeader header_;
    std::vector<StrandProperty> points_, each_;
    std::vector<Index> owner_;
    std::vector<float> widths_;
};

}  // namespace

void write_ply_strands(const Strands& strands, std::string& bytes, const Context& context) {
    StrandPlyWriter(strands, bytes).write(context);
}

}  // namespace lissom
