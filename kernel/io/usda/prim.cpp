#include "kernel/io/usda/prim.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/stream/byte_source.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_prim(const CurvesPrim& prim, const std::string& what,
                              ErrorCode code = ErrorCode::file_syntax) {
    refuse(code, "BasisCurves " + in_quotes(prim.name) + ": " + what, prim.place);
}

bool is_whole(double x, double least, double most) {
    return x >= least && x <= most && x == std::floor(x);
}

// A list of whole numbers, one a strand; empty if there are none.
template <typename T>
std::vector<T> whole_numbers(const CurvesPrim& prim, const std::vector<double>& numbers,
                             std::size_t count, double least, const char* what) {
    if (numbers.empty()) return {};
    if (numbers.size() != count) {
        refuse_prim(prim, std::to_string(numbers.size()) + " values of '" + what + "' for " +
                              std::to_string(count) + " curves");
    }
    std::vector<T> result;
    for (const double x : numbers) {
        if (!is_whole(x, least, std::numeric_limits<T>::max())) {
            refuse_prim(prim, std::string("a value of '") + what + "' is out of range");
        }
        result.push_back(static_cast<T>(x));
    }
    return result;
}

// Gives each element of indexed values its own.
void expand_indices(const CurvesPrim& prim, CurveValues& values, std::size_t width,
                    const char* what) {
    if (!values.is_indexed || !values.found) return;
    const std::size_t count = values.numbers.size() / width;
    std::vector<float> expanded;
    expanded.reserve(values.indices.size() * width);
    for (const double index : values.indices) {
        if (!is_whole(index, 0, double(count) - 1.0)) {
            refuse_prim(prim, std::string("an index of '") + what + "' has no value");
        }
        const auto from = values.numbers.begin() +
                          static_cast<std::ptrdiff_t>(index) * static_cast<std::ptrdiff_t>(width);
        expanded.insert(expanded.end(), from, from + static_cast<std::ptrdiff_t>(width));
    }
    values.numbers = std::move(expanded);
    values.found = !values.numbers.empty();
}

void expand_all_indices(CurvesPrim& prim) {
    expand_indices(prim, prim.widths, 1, "widths");
    expand_indices(prim, prim.uvs, 2, "st");
    expand_indices(prim, prim.colors, 3, "displayColor");
    expand_indices(prim, prim.opacities, 1, "displayOpacity");
    expand_indices(prim, prim.base_widths, 1, "lissom:width");
    expand_indices(prim, prim.transparencies, 1, "lissom:transparency");
}

struct CurveCounts {
    std::size_t strands, points;
};

// The domain of values, once their number fits it.
StrandDomain domain_of(const CurvesPrim& prim, const CurveValues& values, std::size_t width,
                       const CurveCounts& counts, const char* what) {
    const CurveInterpolation kind = values.interpolation;
    const StrandDomain domain = kind == CurveInterpolation::constant  ? StrandDomain::all
                                : kind == CurveInterpolation::uniform ? StrandDomain::strand
                                                                      : StrandDomain::point;
    const std::size_t expected = domain == StrandDomain::all      ? 1
                                 : domain == StrandDomain::strand ? counts.strands
                                                                  : counts.points;
    if (values.numbers.size() == width * expected) return domain;
    refuse_prim(prim, std::to_string(values.numbers.size() / width) + " values of '" + what +
                          "' but their interpolation needs " + std::to_string(expected));
}

// Numbers, one a value, in their domain.
template <typename Values>
void take_values(const CurvesPrim& prim, const CurveValues& from, const CurveCounts& counts,
                 const char* what, Values& to) {
    to.domain = domain_of(prim, from, 1, counts, what);
    if (to.domain == StrandDomain::all) {
        to.common = from.numbers.front();
    } else {
        to.values = from.numbers;
    }
}

// Returns whether the widths at all points are those of the file.
bool are_widths(const Strands& strands, const std::vector<float>& numbers) {
    if (numbers.size() != at(strands.point_count())) return false;
    std::vector<float> widths;
    auto at = numbers.begin();
    for (Index s = 0; s < strands.size(); ++s) {
        widths_of(strands, s, widths);
        if (!std::equal(widths.begin(), widths.end(), at)) return false;
        at += strands.point_count(s);
    }
    return true;
}

void set_widths(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    if (!prim.widths.found) return;
    if (prim.base_widths.found && !prim.width_profile.empty()) {
        StrandWidths widths;
        take_values(prim, prim.base_widths, counts, "lissom:width", widths);
        widths.profile = prim.width_profile;
        strands.set_widths(std::move(widths));
        if (are_widths(strands, prim.widths.numbers)) return;
    }
    StrandWidths widths;
    take_values(prim, prim.widths, counts, "widths", widths);
    strands.set_widths(std::move(widths));
}

void set_transparency(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    if (!prim.opacities.found) return;
    StrandValues<float> values{0.0f};
    CurveValues transparencies = prim.opacities;
    for (float& x : transparencies.numbers) x = 1.0f - x;
    const std::vector<float>& known = prim.transparencies.numbers;
    const bool follows = known.size() == transparencies.numbers.size() &&
                         std::equal(known.begin(), known.end(), prim.opacities.numbers.begin(),
                                    [](float transparency, float opacity) {
                                        return 1.0f - transparency == opacity;
                                    });
    if (follows) transparencies.numbers = known;
    take_values(prim, transparencies, counts, "displayOpacity", values);
    strands.set_transparency(std::move(values));
}

void set_colors(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    if (!prim.colors.found) return;
    StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f::Zero()};
    colors.domain = domain_of(prim, prim.colors, 3, counts, "displayColor");
    for (std::size_t i = 0; i < prim.colors.numbers.size(); i += 3) {
        colors.values.emplace_back(prim.colors.numbers.data() + i);
    }
    if (colors.domain == StrandDomain::all) {
        colors.common = colors.values.front();
        colors.values.clear();
    }
    strands.set_colors(std::move(colors));
}

void set_roots(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    StrandRoots roots;
    if (prim.uvs.found) {
        const StrandDomain domain = domain_of(prim, prim.uvs, 2, counts, "st");
        for (std::size_t s = 0; s < counts.strands; ++s) {
            const auto strand = index_of(s);
            const std::size_t i = domain == StrandDomain::all ? 0
                                  : domain == StrandDomain::strand
                                      ? s
                                      : at(strands.first_point(strand));
            roots.uvs.emplace_back(prim.uvs.numbers.data() + 2 * i);
        }
    }
    roots.faces = whole_numbers<Index>(prim, prim.faces, counts.strands, kNoIndex, "rootFace");
    if (prim.barycentrics.size() != 3 * roots.faces.size()) {
        refuse_prim(prim, "'rootFace' and 'rootBarycentrics' do not fit each other");
    }
    for (std::size_t i = 0; i < prim.barycentrics.size(); i += 3) {
        roots.barycentrics.emplace_back(prim.barycentrics.data() + i);
    }
    const std::vector<Index> vertices = whole_numbers<Index>(
        prim, prim.root_vertices, 3 * counts.strands, kNoIndex, "rootVertices");
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
        roots.triangles.push_back({vertices[i], vertices[i + 1], vertices[i + 2]});
    }
    strands.set_roots(std::move(roots));
}

void set_guides(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    StrandGuides guides;
    guides.ids = whole_numbers<std::uint32_t>(prim, prim.guides, counts.strands, 0, "guideId");
    const double scale = std::cbrt(std::abs(prim.transform.linear.determinant()));
    for (const float arc : prim.guide_arcs) guides.arcs.push_back(static_cast<float>(arc * scale));
    if (guides.arcs.size() != guides.ids.size()) {
        refuse_prim(prim, "'guideId' and 'guideArc' do not fit each other");
    }
    for (const float arc : guides.arcs) {
        if (!(arc >= 0.0f) || !std::isfinite(arc)) {
            refuse_prim(prim, "a value of 'guideArc' is out of range");
        }
    }
    strands.set_guides(std::move(guides));
}

// Groups whose names are written for each curve, or once for all.
void set_flat_groups(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    const std::vector<std::string>& written = prim.group_names;
    if (counts.strands == 0) return;
    if (written.size() != 1 && written.size() != counts.strands) {
        refuse_prim(prim, std::to_string(written.size()) + " values of 'group' for " +
                              std::to_string(counts.strands) + " curves");
    }
    std::map<std::string, Index> numbers;
    std::vector<std::string> names;
    std::vector<Index> groups;
    for (std::size_t s = 0; s < counts.strands; ++s) {
        const std::string& name = written[written.size() == 1 ? 0 : s];
        const auto [entry, is_new] = numbers.emplace(name, count_of(names));
        if (is_new) names.push_back(name);
        groups.push_back(entry->second);
    }
    strands.set_groups(std::move(groups), std::move(names));
}

void set_groups(const CurvesPrim& prim, const CurveCounts& counts, Strands& strands) {
    if (prim.groups.empty() && !prim.group_names.empty()) {
        return set_flat_groups(prim, counts, strands);
    }
    std::vector<Index> groups =
        whole_numbers<Index>(prim, prim.groups, counts.strands, kNoIndex, "group:indices");
    for (const Index group : groups) {
        if (group < count_of(prim.group_names)) continue;
        refuse_prim(prim, "a value of 'group:indices' has no name");
    }
    strands.set_groups(std::move(groups), prim.group_names);
}

void scale_widths(Strands& strands, double scale) {
    StrandWidths widths = strands.widths();
    widths.common *= scale;
    for (float& width : widths.values) width = static_cast<float>(width * scale);
    strands.set_widths(std::move(widths));
}

void apply_transform(const CurvesPrim& prim, Strands& strands) {
    if (prim.transform.is_identity()) return;
    for (Index s = 0; s < strands.size(); ++s) {
        StrandEdit strand = strands.edit_strand(s);
        for (Index k = 0; k < strand.cols(); ++k) {
            const Vec3 point = strand.col(k).cast<double>();
            strand.col(k) = prim.transform(point).cast<float>();
        }
    }
    require_finite(strands.points(), 3, 0, strands.offsets());
    if (!prim.widths.found) return;
    scale_widths(strands, std::cbrt(std::abs(prim.transform.linear.determinant())));
}

}  // namespace

std::vector<Index> curve_counts(const CurvesPrim& prim) {
    if (prim.points.size() % 3 != 0) refuse_prim(prim, "'points' do not come in threes");
    std::vector<Index> counts;
    const std::size_t points = prim.points.size() / 3;
    std::size_t total = 0;
    for (const double count : prim.counts) {
        if (!is_whole(count, 1, points - total)) {
            refuse_prim(prim, "'curveVertexCounts' do not add up to the " + std::to_string(points) +
                                  " points");
        }
        counts.push_back(static_cast<Index>(count));
        total += static_cast<std::size_t>(count);
    }
    if (total != points) {
        refuse_prim(prim, "'curveVertexCounts' add up to " + std::to_string(total) +
                              ", but there are " + std::to_string(points) + " points");
    }
    return counts;
}

Strands strands_of(CurvesPrim prim, const Context& context) {
    if (prim.wrap == "periodic") {
        refuse_prim(prim, "its curves are closed, which hair is not; set wrap to nonperiodic",
                    ErrorCode::unsupported);
    }
    expand_all_indices(prim);
    if (prim.type == "cubic") {
        make_linear(prim);
    } else if (prim.type != "linear") {
        refuse_prim(prim, "its type " + in_quotes(prim.type) + " is neither linear nor cubic",
                    ErrorCode::unsupported);
    }
    std::vector<Index> offsets = {0};
    for (const Index count : curve_counts(prim)) offsets.push_back(offsets.back() + count);
    const CurveCounts counts{offsets.size() - 1, prim.points.size() / 3};
    Strands strands(std::move(prim.points), std::move(offsets), context.memory());
    set_widths(prim, counts, strands);
    set_colors(prim, counts, strands);
    set_transparency(prim, counts, strands);
    set_roots(prim, counts, strands);
    set_groups(prim, counts, strands);
    apply_transform(prim, strands);
    strands.set_ids(whole_numbers<std::uint32_t>(prim, prim.ids, counts.strands, 0, "strandId"));
    set_guides(prim, counts, strands);
    strands.set_comment(std::move(prim.comment));
    return strands;
}

}  // namespace lissom
