#include "kernel/hair/levels/hair_shell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/cards/card_light.h"
#include "kernel/hair/levels/level_surface.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/smooth.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/repair/repair.h"
#include "kernel/mesh/resample/decimate.h"

namespace lissom {
namespace {

constexpr double kMostShellNodes = 4e6;
// Cells of room around the hair.
constexpr int kShellMargin = 4;
// Passes of the weights 1 2 1 over densities.
constexpr int kBlurPasses = 2;
// Parts of less than this share of the area are locks of their own and vanish.
constexpr double kLeastPart = 0.02;
// Pieces of a segment a cell.
constexpr double kPiecesPerCell = 2.0;
constexpr Index kShellGrain = 1;
// Of the parts of a surface in the making, a triangle.
constexpr std::size_t kBytesPerShellTriangle = 300;
// Cells over the shell at which its light is measured.
constexpr double kLightLift = 2.0;
// Metres over the skin between its hair.
constexpr double kSkinLift = 0.005;

void require_shell_options(const Strands& strands, const ShellOptions& options) {
    require(options.triangles >= 20 && options.triangles <= kMaxShellTriangles,
            "a shell has 20 to " + std::to_string(kMaxShellTriangles) + " triangles");
    require(options.cell >= 0.001 && options.cell <= 0.1,
            "the cell of a shell must be 0.001 to 0.1 metres");
    require(options.level > 0.0 && options.level < 1.0,
            "the level of a shell must be above 0 and below 1");
    require(is_length(options.clearance), "the clearance must be finite and not negative");
    Elements bad{ElementKind::strand, 0, {}};
    bool has_length = false;
    for (Index s = 0; s < strands.size(); ++s) {
        const StrandView strand = strands.strand(s);
        if (!strand.allFinite()) bad.add(s);
        has_length = has_length || (strand.colwise() - strand.col(0)).cwiseAbs().maxCoeff() > 0.0f;
    }
    if (bad.count > 0) {
        const std::string names = describe(bad);
        throw Error(ErrorCode::not_finite, names + ": points are not finite", std::move(bad));
    }
    require(has_length, "no strand has a length; a shell needs hair");
}

NodeGrid grid_around(const Strands& strands, double cell) {
    const Box box = bounds(strands);
    const Vec3 size = box.max - box.min;
    NodeGrid grid;
    grid.step = cell;
    for (;;) {
        grid.counts = (size.array() / grid.step).min(1e6).ceil().cast<int>() + 1 + 2 * kShellMargin;
        if (grid.counts.cast<double>().prod() <= kMostShellNodes) break;
        grid.step *= 1.1;
    }
    grid.origin = box.min - Vec3::Constant(kShellMargin * grid.step);
    return grid;
}

// Length of hair and its colour around each node.
struct HairMatter {
    std::vector<float> length;
    std::array<std::vector<float>, 3> color;
};

void deposit(const NodeGrid& grid, const Vec3& p, float length, const Eigen::Vector3f* color,
             HairMatter& matter) {
    const Eigen::Array3d cell = (p - grid.origin).array() / grid.step;
    const Eigen::Array3i low = cell.cast<int>();
    const Eigen::Array3d u = cell - low.cast<double>();
    for (int c = 0; c < 8; ++c) {
        const Eigen::Array3i bit(c & 1, c >> 1 & 1, c >> 2);
        double weight = length;
        for (int k = 0; k < 3; ++k) weight *= bit[k] != 0 ? u[k] : 1.0 - u[k];
        const std::size_t place = grid.place(low + bit);
        matter.length[place] += static_cast<float>(weight);
        for (std::size_t k = 0; k < 3 && color; ++k) {
            matter.color[k][place] += static_cast<float>(weight) * (*color)[index_of(k)];
        }
    }
}

HairMatter matter_of(const Strands& strands, const NodeGrid& grid, const Context& context) {
    Progress progress(context, "density of hair");
    HairMatter matter;
    matter.length.assign(grid.size(), 0.0f);
    const StrandValues<Eigen::Vector3f>* const colors = strands.colors();
    for (std::vector<float>& channel : matter.color) {
        if (colors) channel.assign(grid.size(), 0.0f);
    }
    for (Index s = 0; s < strands.size(); ++s) {
        if (s % 1024 == 0) progress.update(double(s) / strands.size());
        const StrandView strand = strands.strand(s);
        for (Index k = 0; k + 1 < strand.cols(); ++k) {
            context.checkpoint();
            const Vec3 a = point_of(strand, k), b = point_of(strand, k + 1);
            const double length = (b - a).norm();
            if (!(length > 0.0)) continue;
            const int pieces =
                1 + static_cast<int>(std::min(kPiecesPerCell * length / grid.step, 1e6));
            const Eigen::Vector3f* const color =
                colors ? &colors->at(s, strands.first_point(s) + k) : nullptr;
            for (int i = 0; i < pieces; ++i) {
                deposit(grid, a + (i + 0.5) / pieces * (b - a), static_cast<float>(length / pieces),
                        color, matter);
            }
        }
    }
    return matter;
}

// Weights 1 2 1 along each axis; nodes of the border stay.
void blur(const NodeGrid& grid, std::vector<float>& values, const Context& context) {
    if (values.empty()) return;
    const std::array<std::size_t, 3> steps{1, at(grid.counts[0]),
                                           at(grid.counts[0]) * at(grid.counts[1])};
    std::vector<float> next(values.size());
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t step = steps[at(axis)];
        context.parallel_for(0, grid.counts[2], kShellGrain, [&](Index begin, Index end) {
            for (int z = begin; z < end; ++z) {
                for (int y = 0; y < grid.counts[1]; ++y) {
                    for (int x = 0; x < grid.counts[0]; ++x) {
                        const Eigen::Array3i node(x, y, z);
                        const std::size_t i = grid.place(node);
                        const bool inside = node[axis] > 0 && node[axis] + 1 < grid.counts[axis];
                        next[i] = inside ? 0.25f * values[i - step] + 0.5f * values[i] +
                                               0.25f * values[i + step]
                                         : values[i];
                    }
                }
            }
        });
        values.swap(next);
    }
}

// The density that half of all hair has at least.
double usual_density(const std::vector<float>& length) {
    std::vector<float> dense;
    double sum = 0.0;
    for (const float x : length) {
        if (x > 0.0f) dense.push_back(x);
        sum += x;
    }
    std::sort(dense.begin(), dense.end());
    double below = 0.0;
    for (const float x : dense) {
        below += x;
        if (below >= 0.5 * sum) return x;
    }
    return 0.0;
}

// Values above 0 in hair and, with a distance, in the head.
std::vector<float> shell_values(const NodeGrid& grid, const std::vector<float>& length,
                                double level, const ShellOptions& options, const Context& context) {
    std::vector<float> values(length.size());
    context.parallel_for(0, grid.counts[2], kShellGrain, [&](Index begin, Index end) {
        for (int z = begin; z < end; ++z) {
            for (int y = 0; y < grid.counts[1]; ++y) {
                for (int x = 0; x < grid.counts[0]; ++x) {
                    const std::size_t i = grid.place({x, y, z});
                    double value = length[i] / level - 1.0;
                    if (options.distance) {
                        const double deep = -options.distance(grid.position({x, y, z}));
                        value = std::max(value, std::clamp(deep / grid.step, -1.0, 1.0));
                    }
                    values[i] = static_cast<float>(std::min(value, 1.0));
                }
            }
        }
    });
    // The border is outside, so that the surface is closed.
    for (int z = 0; z < grid.counts[2]; ++z) {
        for (int y = 0; y < grid.counts[1]; ++y) {
            for (int x = 0; x < grid.counts[0]; ++x) {
                const Eigen::Array3i node(x, y, z);
                if (((node > 0) && (node + 1 < grid.counts)).all()) continue;
                values[grid.place(node)] = -1.0f;
            }
        }
    }
    return values;
}

// Without the skin that no hair lies on.
void drop_bare_skin(const NodeGrid& grid, const std::vector<float>& length, double level,
                    LevelSurface& surface) {
    std::erase_if(surface.triangles, [&](const Triangle& t) {
        double dense = 0.0;
        for (const Index v : t) dense += grid.interpolated(length, surface.positions[at(v)]) / 3.0;
        return dense < 0.6 * level;
    });
}

std::vector<Vec3> used_positions(LevelSurface& surface) {
    std::vector<Index> number(surface.positions.size(), kNoIndex);
    std::vector<Vec3> positions;
    for (Triangle& t : surface.triangles) {
        for (Index& v : t) {
            Index& n = number[at(v)];
            if (n == kNoIndex) {
                n = count_of(positions);
                positions.push_back(surface.positions[at(v)]);
            }
            v = n;
        }
    }
    return positions;
}

// The large parts of a surface, as a mesh.
Mesh mesh_of_surface(LevelSurface surface, const Context& context) {
    const MemoryCharge charge =
        context.charge(surface.triangles.size() * kBytesPerShellTriangle, "a shell of hair");
    Soup soup;
    soup.positions = used_positions(surface);
    for (const Triangle& t : surface.triangles) soup.faces.add({t[0], t[1], t[2]});
    const Mesh all = repair(std::move(soup), {.weld = Weld::none}, context);
    const std::span<const Index> part = all.topology().components();
    std::vector<double> areas(at(all.topology().component_count()), 0.0);
    for (Index f = 0; f < all.face_count(); ++f) {
        const auto face = all.topology().face(f);
        const Vec3 a = all.position(face[0]);
        areas[at(part[at(face[0])])] +=
            0.5 * (all.position(face[1]) - a).cross(all.position(face[2]) - a).norm();
    }
    double total = 0.0;
    for (const double area : areas) total += area;
    LevelSurface large;
    large.positions.assign(all.positions().begin(), all.positions().end());
    for (Index f = 0; f < all.face_count(); ++f) {
        const auto face = all.topology().face(f);
        if (areas[at(part[at(face[0])])] < kLeastPart * total) continue;
        large.triangles.push_back({face[0], face[1], face[2]});
    }
    FaceList faces;
    std::vector<Vec3> positions = used_positions(large);
    for (const Triangle& t : large.triangles) faces.add({t[0], t[1], t[2]});
    return {std::move(positions), std::move(faces), context};
}

void keep_off_head(Mesh& mesh, const ShellOptions& options) {
    if (!options.distance) return;
    for (Vec3& p : mesh.edit_positions()) {
        for (int pass = 0; pass < 3; ++pass) {
            const double lack = options.clearance - options.distance(p);
            if (!(lack > 0.0)) break;
            p += lack * away_from_head(options.distance, Vec3::Zero(), p, 0.001);
        }
    }
}

void add_shell_attributes(const Strands& strands, const NodeGrid& grid, const HairMatter& matter,
                          Mesh& mesh) {
    Attribute normal{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    const std::vector<Vec3> normals = vertex_normals(mesh);
    for (const Vec3& n : normals) {
        normal.values.insert(normal.values.end(), n.begin(), n.end());
    }
    mesh.attributes().add(std::move(normal));
    if (!strands.colors()) return;
    const HairDensity density(strands);
    Attribute color{"color", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.position(v);
        const double length = std::max(grid.interpolated(matter.length, p), 1e-30);
        // Above the hair, whose own depth would darken it.
        const double light = density.openness(p + kLightLift * grid.step * normals[at(v)]);
        for (const std::vector<float>& channel : matter.color) {
            color.values.push_back(
                std::clamp(light * grid.interpolated(channel, p) / length, 0.0, 1.0));
        }
    }
    mesh.attributes().add(std::move(color));
}

}  // namespace

Mesh make_shell(const Strands& strands, const ShellOptions& options, const Context& context) {
    require_shell_options(strands, options);
    Progress progress(context, "shell of hair");
    const NodeGrid grid = grid_around(strands, options.cell);
    const MemoryCharge charge =
        context.charge(grid.size() * sizeof(float) * (strands.colors() ? 7 : 4), "a shell of hair");
    progress.step(0.4);
    HairMatter matter = matter_of(strands, grid, context);
    for (int pass = 0; pass < kBlurPasses; ++pass) {
        blur(grid, matter.length, context);
        for (std::vector<float>& channel : matter.color) blur(grid, channel, context);
    }
    const double level = options.level * usual_density(matter.length);
    progress.step(0.3);
    LevelSurface surface =
        level_surface(grid, shell_values(grid, matter.length, level, options, context), context);
    if (options.distance) drop_bare_skin(grid, matter.length, level, surface);
    require(!surface.triangles.empty(),
            "the hair is too thin for a shell; give a larger cell, or more strands");
    progress.step(0.3);
    Mesh mesh = mesh_of_surface(std::move(surface), context);
    smooth(mesh, {.iterations = 6, .boundary = SmoothBoundary::along, .keep_volume = true},
           context);
    mesh = decimate(mesh, {.faces = options.triangles, .attributes = 0.0}, context).mesh;
    keep_off_head(mesh, options);
    add_shell_attributes(strands, grid, matter, mesh);
    return mesh;
}

void add_skin(Mesh& shell, Mesh skin, const Strands& strands, const Context& context) {
    Attribute normal{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    const std::vector<Vec3> normals = vertex_normals(skin);
    for (const Vec3& n : normals) {
        normal.values.insert(normal.values.end(), n.begin(), n.end());
    }
    skin.attributes().add(std::move(normal));
    if (const StrandValues<Eigen::Vector3f>* const colors = strands.colors()) {
        Eigen::Vector3f mean = Eigen::Vector3f::Zero();
        for (Index s = 0; s < strands.size(); ++s) {
            mean += colors->at(s, strands.first_point(s)) / static_cast<float>(strands.size());
        }
        const HairDensity density(strands);
        Attribute color{"color", Domain::vertex, 3, ScalarType::float32, {}};
        for (Index v = 0; v < skin.vertex_count(); ++v) {
            const double light = density.openness(skin.position(v) + kSkinLift * normals[at(v)]);
            for (const float x : mean) color.values.push_back(std::clamp(light * x, 0.0, 1.0));
        }
        skin.attributes().add(std::move(color));
    }
    append(shell, skin, context);
}

}  // namespace lissom
