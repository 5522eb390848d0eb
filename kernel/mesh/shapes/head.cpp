#include "kernel/mesh/shapes/head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/core/roots.h"
#include "kernel/mesh/shapes/hairline.h"
#include "kernel/mesh/shapes/head_form.h"
#include "kernel/mesh/shapes/shape_checks.h"

// The form is meshed by surface nets: a vertex in every cell of a grid that the surface runs
// through, and a quad around every edge of the grid that crosses it. The grid is finer at the face.
// Only the cells with x >= 0 are made; the others are their mirror images.
namespace lissom {
namespace {

constexpr int kHeadRelaxSteps = 4;
constexpr Index kBlock = 8;
// Lines of the grid at the face, in those of a length far from it.
constexpr double kFaceLines = 2.2;

// How the grid's lines lie along one axis: `fine` times closer in the middle of a band than far
// from it.
struct Warp {
    double low = 0.0, high = 0.0;            // of the box
    double band_low = 0.0, band_high = 0.0;  // near dense lines
    double fine = kFaceLines;

    static constexpr double kFade = 0.03;

    // Lines in a unit of length.
    double density(double x) const {
        const double out = std::max({band_low - x, x - band_high, 0.0}) / kFade;
        return 1.0 + (fine - 1.0) / (1.0 + out * out);
    }

    // Returns positions of lines, `step` apart in the far range, from `start` to past both ends.
    // The start lies in the middle between two lines.
    std::vector<double> lines(double start, double step) const {
        std::vector<double> up = walk(start, step, high), down = walk(start, -step, low);
        std::reverse(down.begin(), down.end());
        down.insert(down.end(), up.begin(), up.end());
        return down;
    }

  private:
    std::vector<double> walk(double from, double step, double to) const {
        std::vector<double> result;
        double x = from + 0.5 * step / density(from);
        for (; (to - x) * step > 0.0; x += step / density(x + 0.5 * step / density(x))) {
            result.push_back(x);
        }
        result.push_back(x);
        return result;
    }
};

struct Lines {
    std::array<std::vector<double>, 3> at;

    // `shift` moves the lines across y and z, in steps.
    Lines(double step, const Vec2& shift) {
        const Box box = head_form_box();
        const Warp x{box.min.x(), box.max.x(), -0.097, 0.097};
        const Warp y{box.min.y(), box.max.y(), -0.105, 0.0, 3.2};
        const Warp z{box.min.z(), box.max.z(), -0.03, 0.12};
        at = {x.lines(0.0, step), y.lines(-0.05 + step * shift.x(), step),
              z.lines(0.08 + step * shift.y(), step)};
    }

    Index count(int axis) const { return count_of(at[axis]); }
    Vec3 point(const std::array<Index, 3>& i) const {
        return {at[0][i[0]], at[1][i[1]], at[2][i[2]]};
    }
};

class HeadBuilder {
  public:
    HeadBuilder(double step, const HeadForm& form, const Vec2& shift, const Context& context)
        : context_(context), form_(form), lines_(step, shift), middle_(lines_.count(0) / 2 - 1) {
        for (int axis = 0; axis < 3; ++axis) counts_[axis] = lines_.count(axis);
    }

    Mesh build() {
        Progress progress(context_, "head");
        sample();
        progress.update(0.6);
        add_vertices();
        add_faces();
        Mesh mesh(std::move(positions_), std::move(faces_), context_);
        progress.update(0.8);
        relax(mesh);
        return mesh;
    }

  private:
    using Cell = std::array<Index, 3>;

    std::size_t number(const Cell& i) const {
        return i[0] + counts_[0] * (i[1] + at(counts_[1]) * i[2]);
    }

    // Values at the grid's points with x > 0 and the one column before. Blocks that the surface
    // cannot reach get the value of their middle.
    void sample() {
        charge_ = context_.charge(sizeof(float) * counts_[0] * counts_[1] * counts_[2],
                                  "the grid of the head");
        values_.resize(at(counts_[0]) * counts_[1] * counts_[2]);
        const Index blocks = (counts_[2] + kBlock - 1) / kBlock;
        context_.parallel_for(0, blocks, 1, [&](Index from, Index to) {
            for (Index block = from; block < to; ++block) {
                for (Index j = 0; j < counts_[1]; j += kBlock) {
                    for (Index i = middle_; i < counts_[0]; i += kBlock) {
                        sample_block({i, j, block * kBlock});
                    }
                }
            }
        });
    }

    void sample_block(const Cell& first) {
        Cell last{};
        for (int axis = 0; axis < 3; ++axis) {
            last[axis] = std::min(first[axis] + kBlock, counts_[axis]) - 1;
        }
        const Vec3 low = lines_.point(first), high = lines_.point(last);
        const double middle = form_(0.5 * (low + high));
        const bool far = std::abs(middle) > 1.5 * (high - low).norm();
        for (Index k = first[2]; k <= last[2]; ++k) {
            for (Index j = first[1]; j <= last[1]; ++j) {
                for (Index i = first[0]; i <= last[0]; ++i) {
                    const double value = far ? middle : form_(lines_.point({i, j, k}));
                    values_[number({i, j, k})] = static_cast<float>(value);
                }
            }
        }
    }

    float value(const Cell& i) const {
        // The columns below the middle are the mirror images of those above.
        return values_[number({std::max(i[0], 2 * middle_ + 1 - i[0]), i[1], i[2]})];
    }
    bool inside(const Cell& i) const { return value(i) < 0.0F; }

    // Cells in the middle column and beyond, each with its mirror image.
    void add_vertices() {
        for (Index k = 0; k + 1 < counts_[2]; ++k) {
            context_.checkpoint();
            for (Index j = 0; j + 1 < counts_[1]; ++j) {
                for (Index i = middle_; i + 1 < counts_[0]; ++i) {
                    const std::optional<Vec3> p = cell_point({i, j, k});
                    if (p) add_vertex({i, j, k}, *p);
                }
            }
        }
    }

    void add_vertex(const Cell& cell, Vec3 p) {
        if (cell[0] == middle_) p.x() = 0.0;
        vertex_of_[number(cell)] = count_of(positions_);
        mirror_.push_back(count_of(positions_));
        positions_.push_back(p);
        if (cell[0] == middle_) return;
        vertex_of_[number({2 * middle_ - cell[0], cell[1], cell[2]})] = count_of(positions_);
        mirror_.push_back(mirror_.back());
        ++mirror_[mirror_.size() - 2];
        positions_.emplace_back(-p.x(), p.y(), p.z());
    }

    // Returns the mean of the surface's crossings with the cell's edges.
    std::optional<Vec3> cell_point(const Cell& cell) const {
        Vec3 sum = Vec3::Zero();
        int count = 0;
        for (int axis = 0; axis < 3; ++axis) {
            for (int side = 0; side < 4; ++side) {
                Cell a = cell;
                a[(axis + 1) % 3] += side & 1;
                a[(axis + 2) % 3] += side >> 1;
                Cell b = a;
                ++b[axis];
                if (inside(a) == inside(b)) continue;
                const double va = value(a), vb = value(b);
                sum += lines_.point(a) + va / (va - vb) * (lines_.point(b) - lines_.point(a));
                ++count;
            }
        }
        if (count == 0) return std::nullopt;
        return Vec3(sum / count);
    }

    void add_faces() {
        for (Index k = 0; k + 1 < counts_[2]; ++k) {
            for (Index j = 0; j + 1 < counts_[1]; ++j) {
                for (Index i = 0; i + 1 < counts_[0]; ++i) {
                    for (int axis = 0; axis < 3; ++axis) add_face({i, j, k}, axis);
                }
            }
        }
    }

    // Adds the quad around the grid's edge from `a` along `axis`, turning with the axis if it
    // leaves the form.
    void add_face(const Cell& a, int axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        Cell b = a;
        ++b[axis];
        if (inside(a) == inside(b)) return;
        std::array<Index, 4> quad{};
        for (int corner = 0; corner < 4; ++corner) {
            Cell cell = a;
            cell[u] -= corner == 1 || corner == 2 ? 0 : 1;
            cell[v] -= corner >= 2 ? 0 : 1;
            quad[corner] = vertex_of_.at(number(cell));
        }
        if (!inside(a)) std::swap(quad[1], quad[3]);
        faces_.add(quad);
    }

    // Evens out the vertices on the surface, alike on both sides.
    void relax(Mesh& mesh) const {
        const std::span<Vec3> positions = mesh.edit_positions();
        std::vector<Vec3> next(positions.size());
        for (int step = 0; step < kHeadRelaxSteps; ++step) {
            context_.parallel_for(0, mesh.vertex_count(), 256, [&](Index from, Index to) {
                for (Index v = from; v < to; ++v) {
                    next[v] = relaxed(mesh.topology(), positions, v);
                }
            });
            for (Index v = 0; v < mesh.vertex_count(); ++v) {
                const Vec3& other = next[mirror_[v]];
                positions[v] = 0.5 * (next[v] + Vec3(-other.x(), other.y(), other.z()));
            }
        }
    }

    Vec3 relaxed(const Topology& topology, std::span<const Vec3> positions, Index v) const {
        const auto ring = topology.neighbors(v);
        Vec3 mean = Vec3::Zero();
        for (const Index n : ring) mean += positions[n] / count_of(ring);
        Vec3 p = positions[v] + 0.5 * (mean - positions[v]);
        for (int i = 0; i < 2; ++i) {
            const Vec3 gradient = form_.gradient(p);
            const double square = std::max(gradient.squaredNorm(), 0.05);
            p -= form_(p) / square * gradient;
        }
        return p;
    }

    const Context& context_;
    const HeadForm& form_;
    Lines lines_;
    std::array<Index, 3> counts_{};
    Index middle_;  // the column of cells that holds x = 0
    std::vector<float> values_;
    MemoryCharge charge_;
    std::unordered_map<std::size_t, Index> vertex_of_;
    std::vector<Vec3> positions_;
    std::vector<Index> mirror_;
    FaceList faces_;
};

void name_regions(Mesh& mesh, const HeadForm& form) {
    std::vector<Index> scalp, ears, bottom;
    const std::vector<HairlinePoint> hairline = default_hairline();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.position(v);
        const bool ear = form.ears(p) < 1e-3;
        const double elevation = std::atan2(p.y(), hypotenuse(p.x(), p.z()));
        if (ear) ears.push_back(v);
        if (p.y() < kHeadBottom + 2e-3) bottom.push_back(v);
        if (!ear && p.y() > -0.11 && p.norm() < 0.13 &&
            elevation > hairline_elevation(hairline, std::atan2(p.x(), p.z()))) {
            scalp.push_back(v);
        }
    }
    mesh.set_region("scalp", Region(mesh.shared_topology(), std::move(scalp)).smoothed(2));
    mesh.set_region("ears", Region(mesh.shared_topology(), std::move(ears)));
    mesh.set_region("bottom", Region(mesh.shared_topology(), std::move(bottom)));
}

// If a part is about as thin as a cell, two sheets of the surface share vertices of the net, and it
// is no manifold: lines that lie a little elsewhere then tell them apart.
Mesh build_manifold(double step, const HeadForm& form, const Context& context) {
    constexpr int kAttempts = 40;
    for (int attempt = 0;; ++attempt) {
        // Spread evenly by multiples of irrational numbers.
        const Vec2 shift(std::fmod(0.7548776662 * attempt, 1.0),
                         std::fmod(0.5698402910 * attempt, 1.0));
        try {
            return HeadBuilder(step, form, shift, context).build();
        } catch (const Error& error) {
            const bool shared = error.code() == ErrorCode::nonmanifold_edge ||
                                error.code() == ErrorCode::nonmanifold_vertex;
            if (!shared || attempt == kAttempts) throw;
        }
    }
}

}  // namespace

Mesh make_head(const HeadOptions& options, const Context& context) {
    require_length(options.height, "height");
    if (options.vertices < 3000 || options.vertices > 500000) {
        throw Error(ErrorCode::invalid_argument, "vertices must lie between 3000 and 500000, not " +
                                                     std::to_string(options.vertices));
    }
    // Vertices grow with the square of the lines' number.
    const double step = 0.0132 * std::sqrt(10000.0 / options.vertices);
    const HeadForm form(step / kFaceLines);
    Mesh mesh = build_manifold(step, form, context);
    name_regions(mesh, form);
    const double scale = options.height / (kHeadTop - kHeadBottom);
    for (Vec3& p : mesh.edit_positions()) p *= scale;
    return mesh;
}

}  // namespace lissom
