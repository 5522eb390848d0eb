// Values of strands, and their groups.
#include "kernel/hair/strands/strands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bindings/c/data.h"

namespace lissom::c {
namespace {

Strands& own_strands(lissom_context& context, lissom_strands strands) {
    return context.content<Strands>(strands.id, Kind::strands);
}

bool is_integer_value(lissom_strand_value value) {
    return value == LISSOM_STRAND_ROOT_FACE || value == LISSOM_STRAND_GROUP ||
           value == LISSOM_STRAND_ID || value == LISSOM_STRAND_GUIDE ||
           value == LISSOM_STRAND_ROOT_TRIANGLE;
}

bool is_point_value(lissom_strand_value value) {
    return value == LISSOM_STRAND_WIDTH || value == LISSOM_STRAND_COLOR ||
           value == LISSOM_STRAND_TRANSPARENCY;
}

Index width_of(lissom_strand_value value) {
    if (value == LISSOM_STRAND_COLOR || value == LISSOM_STRAND_ROOT_BARYCENTRIC ||
        value == LISSOM_STRAND_ROOT_TRIANGLE) {
        return 3;
    }
    return value == LISSOM_STRAND_ROOT_UV ? 2 : 1;
}

bool has_value(const Strands& strands, lissom_strand_value value) {
    switch (value) {
        case LISSOM_STRAND_WIDTH:
        case LISSOM_STRAND_TRANSPARENCY:
        case LISSOM_STRAND_ID:
            return true;
        case LISSOM_STRAND_COLOR:
            return strands.colors() != nullptr;
        case LISSOM_STRAND_ROOT_UV:
            return !strands.roots().uvs.empty();
        case LISSOM_STRAND_ROOT_FACE:
        case LISSOM_STRAND_ROOT_BARYCENTRIC:
            return !strands.roots().faces.empty();
        case LISSOM_STRAND_ROOT_TRIANGLE:
            return !strands.roots().triangles.empty();
        case LISSOM_STRAND_GROUP:
            return !strands.groups().empty();
        case LISSOM_STRAND_GUIDE:
        case LISSOM_STRAND_GUIDE_ARC:
            return !strands.guides().ids.empty();
    }
    throw Error(ErrorCode::invalid_argument, "there is no such value of strands");
}

void require_value(const Strands& strands, lissom_strand_value value) {
    require(has_value(strands, value),
            "the strands have no such values: lissom_strands_has tells which they have, and "
            "lissom_strands_write gives them some",
            ErrorCode::out_of_range);
}

// Number k of a value at a point of a strand.
double number_of(const Strands& strands, lissom_strand_value value, Index s, Index point,
                 std::size_t k) {
    const StrandRoots& roots = strands.roots();
    const auto component = index_of(k);
    switch (value) {
        case LISSOM_STRAND_WIDTH:
            return strands.widths().at(s, point);
        case LISSOM_STRAND_COLOR:
            return strands.colors()->at(s, point)[component];
        case LISSOM_STRAND_TRANSPARENCY:
            return strands.transparency().at(s, point);
        case LISSOM_STRAND_ROOT_UV:
            return roots.uvs[at(s)][component];
        case LISSOM_STRAND_ROOT_FACE:
            return roots.faces[at(s)];
        case LISSOM_STRAND_ROOT_BARYCENTRIC:
            return roots.barycentrics[at(s)][component];
        case LISSOM_STRAND_ROOT_TRIANGLE:
            return roots.triangles[at(s)][k];
        case LISSOM_STRAND_GROUP:
            return strands.group(s);
        case LISSOM_STRAND_ID:
            return static_cast<std::int32_t>(strands.id(s));
        case LISSOM_STRAND_GUIDE:
            return static_cast<std::int32_t>(strands.guides().ids[at(s)]);
        case LISSOM_STRAND_GUIDE_ARC:
            return strands.guides().arcs[at(s)];
    }
    return 0.0;
}

// Lengths of arc from the root to each point of a strand, over the whole: 0 to 1.
std::vector<double> arcs_of(const Strands& strands, Index s) {
    const StrandView points = strands.strand(s);
    std::vector<double> arcs(at(strands.point_count(s)), 0.0);
    for (std::size_t i = 1; i < arcs.size(); ++i) {
        const auto k = index_of(i);
        arcs[i] = arcs[i - 1] + (point_of(points, k) - point_of(points, k - 1)).norm();
    }
    const double length = arcs.back();
    for (double& arc : arcs) arc = length > 0.0 ? arc / length : 0.0;
    return arcs;
}

void write_ids(const Strands& strands, lissom_strand_value value, const lissom_output* values) {
    std::vector<Index> list;
    for (Index s = 0; s < strands.size(); ++s) {
        for (std::size_t k = 0; k < at(width_of(value)); ++k) {
            list.push_back(static_cast<Index>(number_of(strands, value, s, 0, k)));
        }
    }
    if (values && size_of(values->format) != 4) refuse_format("values", "UINT32 or INT32");
    write_integers(values, list, "values", at(width_of(value)));
}

void require_numbers(lissom_format format) {
    if (format == LISSOM_UINT32 || format == LISSOM_INT32 || format == LISSOM_UINT8 ||
        format == LISSOM_UINT16) {
        refuse_format("values", "of floats or of numbers from 0 or -1 to 1");
    }
}

void read_values(const Strands& strands, lissom_strand_value value, const lissom_output* values) {
    require_value(strands, value);
    if (is_integer_value(value)) return write_ids(strands, value, values);
    const auto width = at(width_of(value));
    require_room(values, at(strands.size()), width, "values");
    require_numbers(values->format);
    write_elements(
        *values, at(strands.size()), width,
        [&](std::size_t i, std::size_t k) {
            const Index s = index_of(i);
            return number_of(strands, value, s, strands.first_point(s), k);
        },
        [](std::size_t) { return false; });
}

void read_point_values(const Strands& strands, lissom_strand_value value,
                       const lissom_output* values) {
    require_value(strands, value);
    require(is_point_value(value), "points have widths, colours and transparency alone");
    const auto width = at(width_of(value));
    require_room(values, at(strands.point_count()), width, "values");
    require_numbers(values->format);
    std::vector<double> numbers;
    numbers.reserve(at(strands.point_count()) * width);
    const bool has_profile = value == LISSOM_STRAND_WIDTH && !strands.widths().profile.empty();
    for (Index s = 0; s < strands.size(); ++s) {
        const std::vector<double> arcs = has_profile ? arcs_of(strands, s) : std::vector<double>();
        for (Index p = 0; p < strands.point_count(s); ++p) {
            const double factor = has_profile ? strands.widths().factor(arcs[at(p)]) : 1.0;
            for (std::size_t k = 0; k < width; ++k) {
                numbers.push_back(factor *
                                  number_of(strands, value, s, strands.first_point(s) + p, k));
            }
        }
    }
    write_elements(
        *values, at(strands.point_count()), width,
        [&](std::size_t i, std::size_t k) { return numbers[i * width + k]; },
        [](std::size_t) { return false; });
}

// Strands keep 32-bit floats.
float float_of(double number, const char* name) {
    if (std::abs(number) <= std::numeric_limits<float>::max()) return static_cast<float>(number);
    throw Error(
        ErrorCode::not_finite,
        std::string(name) + ": a number is not finite as the 32-bit float that strands keep");
}

template <int Width>
std::vector<Eigen::Matrix<float, Width, 1>> vectors_of(const std::vector<double>& numbers) {
    std::vector<Eigen::Matrix<float, Width, 1>> list(numbers.size() / Width);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        list[i / Width][index_of(i % Width)] = float_of(numbers[i], "values");
    }
    return list;
}

std::vector<float> floats_of(const std::vector<double>& numbers) {
    std::vector<float> list;
    list.reserve(numbers.size());
    for (const double number : numbers) list.push_back(float_of(number, "values"));
    return list;
}

void require_not_negative(const std::vector<float>& list, const char* name) {
    const auto least = std::min_element(list.begin(), list.end());
    require(least == list.end() || *least >= 0.0f, std::string(name) + " are 0 or more");
}

void set_root_faces(Strands& strands, std::vector<Index> faces) {
    StrandRoots roots = strands.roots();
    if (roots.barycentrics.size() != faces.size()) {
        roots.barycentrics.assign(faces.size(), Eigen::Vector3f::Constant(1.0f / 3.0f));
    }
    roots.faces = std::move(faces);
    roots.triangles.clear();
    strands.set_roots(std::move(roots));
}

void set_root_triangles(Strands& strands, const std::vector<Index>& vertices) {
    StrandRoots roots = strands.roots();
    require(!roots.faces.empty(), "write the faces of the roots before their triangles");
    roots.triangles.clear();
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
        roots.triangles.push_back({vertices[i], vertices[i + 1], vertices[i + 2]});
    }
    strands.set_roots(std::move(roots));
}

void set_guide_ids(Strands& strands, const std::vector<Index>& ids) {
    StrandGuides guides = strands.guides();
    guides.ids.clear();
    for (const Index id : ids) guides.ids.push_back(static_cast<std::uint32_t>(id));
    guides.arcs.resize(ids.size(), 0.0f);
    strands.set_guides(std::move(guides));
}

void set_groups_of(Strands& strands, std::vector<Index> groups) {
    for (const Index group : groups) {
        const Index names = count_of(strands.group_names());
        if (group < names) continue;
        throw Error(ErrorCode::out_of_range,
                    "group " + std::to_string(group) + " has no name: the strands have " +
                        std::to_string(names) +
                        " groups, numbered from 0; lissom_strands_set_groups names them");
    }
    strands.set_groups(std::move(groups), strands.group_names());
}

void write_integers_to(Strands& strands, lissom_strand_value value, std::vector<Index> list) {
    require(list.size() == at(width_of(value)) * at(strands.size()),
            "values need one element a strand");
    if (value == LISSOM_STRAND_ROOT_TRIANGLE) return set_root_triangles(strands, list);
    if (value == LISSOM_STRAND_ROOT_FACE) return set_root_faces(strands, std::move(list));
    if (value == LISSOM_STRAND_GROUP) return set_groups_of(strands, std::move(list));
    if (value == LISSOM_STRAND_GUIDE) return set_guide_ids(strands, list);
    strands.set_ids({list.begin(), list.end()});
}

template <typename Values, typename List>
void fill_values(Values& values, bool at_points, List list) {
    values.domain = at_points ? StrandDomain::point : StrandDomain::strand;
    values.values = std::move(list);
}

void write_numbers_to(Strands& strands, lissom_strand_value value, bool at_points,
                      const std::vector<double>& numbers) {
    if (value == LISSOM_STRAND_WIDTH) {
        StrandWidths widths;
        fill_values(widths, at_points, floats_of(numbers));
        require_not_negative(widths.values, "widths");
        if (!at_points) widths.profile = strands.widths().profile;
        strands.set_widths(std::move(widths));
    } else if (value == LISSOM_STRAND_COLOR) {
        StrandValues<Eigen::Vector3f> colors{Eigen::Vector3f::Zero()};
        fill_values(colors, at_points, vectors_of<3>(numbers));
        strands.set_colors(std::move(colors));
    } else if (value == LISSOM_STRAND_TRANSPARENCY) {
        StrandValues<float> transparency{0.0f};
        fill_values(transparency, at_points, floats_of(numbers));
        require_not_negative(transparency.values, "transparencies");
        strands.set_transparency(std::move(transparency));
    } else if (value == LISSOM_STRAND_GUIDE_ARC) {
        StrandGuides guides = strands.guides();
        guides.arcs = floats_of(numbers);
        strands.set_guides(std::move(guides));
    } else {
        StrandRoots roots = strands.roots();
        if (value == LISSOM_STRAND_ROOT_UV) roots.uvs = vectors_of<2>(numbers);
        if (value == LISSOM_STRAND_ROOT_BARYCENTRIC) roots.barycentrics = vectors_of<3>(numbers);
        strands.set_roots(std::move(roots));
    }
}

void write_values(Strands& strands, lissom_strand_value value, bool at_points,
                  const lissom_input* values) {
    has_value(strands, value);
    if (is_integer_value(value)) {
        return write_integers_to(strands, value,
                                 read_labels(values, "values", at(width_of(value))));
    }
    const std::vector<double> numbers = read_numbers(values, width_of(value), "values");
    const Index count = at_points ? strands.point_count() : strands.size();
    require(values->count == at(count),
            at_points ? "values need one element a point" : "values need one element a strand");
    write_numbers_to(strands, value, at_points, numbers);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

int32_t lissom_strands_has(lissom_context* context, lissom_strands strands,
                           lissom_strand_value value) {
    if (!context) return -1;
    return context->count([&] { return has_value(own_strands(*context, strands), value) ? 1 : 0; });
}

lissom_status lissom_strands_read(lissom_context* context, lissom_strands strands,
                                  lissom_strand_value value, const lissom_output* values) {
    return run(context, [&] { read_values(own_strands(*context, strands), value, values); });
}

lissom_status lissom_strands_read_at_points(lissom_context* context, lissom_strands strands,
                                            lissom_strand_value value,
                                            const lissom_output* values) {
    return run(context, [&] { read_point_values(own_strands(*context, strands), value, values); });
}

lissom_status lissom_strands_write(lissom_context* context, lissom_strands strands,
                                   lissom_strand_value value, const lissom_input* values) {
    return run(context,
               [&] { write_values(own_strands(*context, strands), value, false, values); });
}

lissom_status lissom_strands_write_at_points(lissom_context* context, lissom_strands strands,
                                             lissom_strand_value value,
                                             const lissom_input* values) {
    return run(context, [&] {
        require(is_point_value(value), "points have widths, colours and transparency alone");
        write_values(own_strands(*context, strands), value, true, values);
    });
}

lissom_status lissom_strands_set_points(lissom_context* context, lissom_strands strands,
                                        const lissom_input* points) {
    return run(context, [&] {
        Strands& own = own_strands(*context, strands);
        const std::vector<Vec3> given = read_points(points, context->space, "points");
        require(count_of(given) == own.point_count(), "points need as many as there are");
        std::vector<float> floats;
        floats.reserve(3 * given.size());
        for (const Vec3& point : given) {
            for (int k = 0; k < 3; ++k) floats.push_back(float_of(point[k], "points"));
        }
        std::copy(floats.begin(), floats.end(), own.edit_points().begin());
    });
}

int32_t lissom_strands_group_count(lissom_context* context, lissom_strands strands) {
    if (!context) return -1;
    return context->count([&] { return count_of(own_strands(*context, strands).group_names()); });
}

lissom_status lissom_strands_group_name(lissom_context* context, lissom_strands strands,
                                        int32_t group, const char** name) {
    return run(context, [&] {
        require_given(name, "name");
        const auto& names = own_strands(*context, strands).group_names();
        require(group >= 0 && group < count_of(names), "there is no such group",
                ErrorCode::out_of_range);
        context->text = names[at(group)];
        *name = context->text.c_str();
    });
}

lissom_status lissom_strands_set_groups(lissom_context* context, lissom_strands strands,
                                        const char* const* names, int32_t count) {
    return run(context, [&] {
        Strands& own = own_strands(*context, strands);
        require(count >= 0, "count is negative");
        if (count > 0) require_given(names, "names");
        std::vector<std::string> list;
        for (Index i = 0; i < count; ++i) {
            list.push_back(given_name(names[i], "a name"));
            require(!list.back().empty(), "a group has an empty name");
        }
        std::vector<Index> groups = own.groups();
        for (Index& group : groups) group = group < count ? group : kNoIndex;
        own.set_groups(std::move(groups), std::move(list));
    });
}

}  // extern "C"
