#include "kernel/deform/contact/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

// Rows of one penetration, and of all that are added together.
constexpr std::size_t kMostOfOne = 16, kMostTogether = 48;
// A row reaches this far about its seed, in distances to the next seeds.
constexpr double kRowReach = 1.6;
// Share of the depth that is asked for: a little room, so that parts stay apart in the next
// round too.
constexpr double kSpare = 1.05;
// A row counts as movable if its answer to its own force is this part of the greatest.
constexpr double kMovable = 0.15;
constexpr int kSweeps = 400;
// Fits of the rotations to the displaced surface.
constexpr int kFits = 2;

// Numbers of points that lie evenly among all, the deepest first, and their covering radius.
std::pair<std::vector<std::size_t>, double> spread_seeds(const Penetration& points,
                                                         std::size_t deepest, std::size_t count) {
    std::vector<std::size_t> seeds;
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    std::size_t next = deepest;
    double covered = 0.0;
    while (seeds.size() < count) {
        seeds.push_back(next);
        for (std::size_t i = 0; i < points.size(); ++i) {
            distance[i] = std::min(distance[i], (points[i].place - points[next].place).norm());
        }
        next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                        distance.begin());
        covered = distance[next];
        if (!(covered > 0.0)) break;
    }
    return {std::move(seeds), covered};
}

}  // namespace

Separation::Separation(const Preparation& prepared, const DeformFrame& frame,
                       const Context& context)
    : displaced_(prepared, frame, context) {}

bool Separation::add(std::span<const Penetration> penetrations, const Context& context) {
    std::size_t points = 0;
    for (const Penetration& penetration : penetrations) points += penetration.size();
    std::vector<Row> rows;
    for (const Penetration& penetration : penetrations) {
        const std::size_t share = (kMostTogether * penetration.size() + points - 1) / points;
        add_rows(penetration, std::min(share, kMostOfOne), rows);
    }
    for (Row& row : rows) row.depth += row.way.dot(mean_of(row, displaced_.displacement()));
    const std::size_t before = rows_.size();
    rows_.insert(rows_.end(), std::make_move_iterator(rows.begin()),
                 std::make_move_iterator(rows.end()));
    find_responses({rows_.data() + before, rows_.size() - before}, context);
    find_compliance();
    return rows_.size() > before;
}

void Separation::add_rows(const Penetration& penetration, std::size_t most,
                          std::vector<Row>& rows) const {
    std::size_t deepest = 0;
    for (std::size_t i = 0; i < penetration.size(); ++i) {
        if (penetration[i].depth > penetration[deepest].depth) deepest = i;
    }
    const auto [seeds, covered] =
        spread_seeds(penetration, deepest, std::min(most, penetration.size()));
    for (const std::size_t seed : seeds) {
        Row row = row_around(penetration, seed, kRowReach * covered);
        if (!row.entries.empty()) rows.push_back(std::move(row));
    }
}

// The points within reach of the seed that go its way, less the farther they are; the deepest of
// the near ones says how far.
Separation::Row Separation::row_around(const Penetration& penetration, std::size_t seed,
                                       double reach) const {
    const PenetrationPoint& middle = penetration[seed];
    std::vector<double> shares(penetration.size(), 0.0);
    double sum = 0.0;
    Row row;
    row.way = middle.way;
    for (std::size_t i = 0; i < penetration.size(); ++i) {
        const PenetrationPoint& point = penetration[i];
        if (point.way.dot(middle.way) <= 0.0) continue;
        const double far =
            reach > 0.0 ? (point.place - middle.place).norm() / reach : (i == seed ? 0.0 : 1.0);
        if (far >= 1.0) continue;
        shares[i] = (1.0 - far * far) * (1.0 - far * far);
        sum += shares[i];
        if (shares[i] > 0.25) row.depth = std::max(row.depth, kSpare * point.depth);
    }
    for (std::size_t i = 0; i < penetration.size(); ++i) {
        if (shares[i] == 0.0) continue;
        const PenetrationPoint& point = penetration[i];
        const double share = shares[i] / sum;
        add_entry(row, point.vertex, share);
        for (int k = 0; k < 3; ++k) {
            add_entry(row, point.exit[at(k)], -share * point.weight[k]);
        }
    }
    return row;
}

void Separation::add_entry(Row& row, Index mesh_vertex, double coefficient) const {
    const Index v = displaced_.free_vertex(mesh_vertex);
    if (v != kNoIndex) row.entries.emplace_back(v, coefficient);
}

// Three rows at a time, as coordinates.
void Separation::find_responses(std::span<Row> rows, const Context& context) {
    std::vector<Vec4> x;
    for (std::size_t first = 0; first < rows.size(); first += 3) {
        context.checkpoint();
        const std::size_t columns = std::min<std::size_t>(3, rows.size() - first);
        std::vector<Vec3> force(displaced_.system().free_vertices().size(), Vec3::Zero());
        for (std::size_t k = 0; k < columns; ++k) {
            for (const auto& [v, c] : rows[first + k].entries) {
                force[at(displaced_.free_row(v))][index_of(k)] += c;
            }
        }
        x.assign(displaced_.turned().size(), Vec4::Zero());
        displaced_.answer(force, x, context);
        for (std::size_t k = 0; k < columns; ++k) {
            std::vector<float>& response = rows[first + k].response;
            response.resize(x.size());
            for (std::size_t v = 0; v < x.size(); ++v) {
                response[v] = static_cast<float>(x[v][index_of(k)]);
            }
        }
    }
}

Vec3 Separation::mean_of(const Row& row, std::span<const Vec4> u) {
    Vec4 sum = Vec4::Zero();
    for (const auto& [v, c] : row.entries) sum += c * u[at(v)];
    return sum.head<3>();
}

void Separation::find_compliance() {
    const auto count = index_of(rows_.size());
    compliance_.resize(count, count);
    for (Index r = 0; r < count; ++r) {
        for (Index s = 0; s < count; ++s) {
            const Row &row = rows_[at(r)], &by = rows_[at(s)];
            double sum = 0.0;
            for (const auto& [v, c] : row.entries) {
                sum += c * static_cast<double>(by.response[at(v)]);
            }
            compliance_(r, s) = row.way.dot(by.way) * sum;
        }
    }
    compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
}

// Projected Gauss-Seidel, from the forces before.
void Separation::find_forces(double softness) {
    const auto count = index_of(rows_.size());
    const Eigen::VectorXd own = compliance_.diagonal();
    const double least = kMovable * own.maxCoeff(), soft = softness * own.mean();
    Eigen::VectorXd force(count), asked(count);
    for (Index r = 0; r < count; ++r) {
        force[r] = rows_[at(r)].force;
        asked[r] =
            rows_[at(r)].depth - rows_[at(r)].way.dot(mean_of(rows_[at(r)], displaced_.turned()));
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (Index r = 0; r < count; ++r) {
            if (!(own[r] > least)) continue;
            const double missing = asked[r] - compliance_.row(r).dot(force) - soft * force[r];
            force[r] = std::max(0.0, force[r] + missing / (own[r] + soft));
        }
    }
    for (Index r = 0; r < count; ++r) rows_[at(r)].force = force[r];
}

void Separation::add_answers() {
    std::vector<Vec4>& u = displaced_.displacement();
    u.assign(displaced_.turned().begin(), displaced_.turned().end());
    for (const Row& row : rows_) {
        if (row.force == 0.0) continue;
        const Vec4 push = padded(Vec3(row.force * row.way));
        for (std::size_t v = 0; v < u.size(); ++v) {
            u[v] += static_cast<double>(row.response[v]) * push;
        }
    }
}

void Separation::solve(double softness, const Context& context) {
    displaced_.forget_turns();
    for (Row& row : rows_) row.force = 0.0;
    for (int fit = 0;; ++fit) {
        find_forces(softness);
        add_answers();
        if (fit == kFits) return;
        displaced_.turn(context);
    }
}

}  // namespace lissom
