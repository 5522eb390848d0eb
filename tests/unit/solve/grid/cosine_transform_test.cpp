#include "kernel/solve/grid/cosine_transform.h"

#include <cmath>
#include <random>
#include <vector>

#include "kernel/solve/grid/grid_green.h"
#include "kernel/solve/grid/grid_laplacian.h"
#include "tests/unit/solve/grid/grids.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

std::vector<double> random_fields(const GridSize& size) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<double> fields(kComponents * static_cast<std::size_t>(size.count()));
    for (double& v : fields) v = number(random);
    return fields;
}

double max_gap(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

const GridSize kSizes[] = {{1, 1, 1},   {5, 1, 1},   {1, 1, 8},  {2, 3, 4},  {7, 7, 7},
                           {16, 9, 13}, {3, 130, 5}, {65, 4, 2}, {30, 31, 1}};

}  // namespace

TEST_CASE("cosine transform: there and back is the same field, for even and odd sizes") {
    for (const GridSize& size : kSizes) {
        const std::vector<double> fields = random_fields(size);
        std::vector<double> a = fields, b(a.size()), c(a.size());
        const CosineTransform transform(size);
        transform.forward(a.data(), b.data(), {});
        FieldSink sink;
        sink.components = c.data();
        transform.inverse(b.data(), a.data(), sink, {});
        CHECK(max_gap(c, fields) < 1e-13);
    }
}

TEST_CASE("cosine transform: coefficients are those of the definition") {
    const GridSize size{4, 3, 5};
    const std::vector<double> fields = random_fields(size);
    std::vector<double> a = fields, b(a.size());
    CosineTransform(size).forward(a.data(), b.data(), {});
    const auto basis = [](Index k, Index j, Index n) {
        return std::sqrt((k == 0 ? 1.0 : 2.0) / n) * std::cos(kPi * k * (j + 0.5) / n);
    };
    for (Index q = 0; q < size.count(); ++q) {
        const GridPoint at = size.point(q);
        double sum = 0.0;
        for (Index i = 0; i < size.count(); ++i) {
            const GridPoint p = size.point(i);
            sum += fields[i] * basis(CosineTransform::frequency(at.x, 4), p.x, 4) *
                   basis(CosineTransform::frequency(at.y, 3), p.y, 3) *
                   basis(CosineTransform::frequency(at.z, 5), p.z, 5);
        }
        CHECK(b[q] == doctest::Approx(sum).epsilon(1e-12));
    }
}

TEST_CASE("cosine transform: a few points give what a whole field gives") {
    const GridSize size{9, 6, 11};
    std::mt19937 random(5);
    std::vector<GridPoint> points;
    std::vector<Vec3> values;
    std::vector<double> a(kComponents * static_cast<std::size_t>(size.count()), 0.0);
    for (const GridConstraint& c : test::random_constraints(size, 40, random)) {
        points.push_back(size.point(c.point));
        values.push_back(c.value);
        for (int k = 0; k < 3; ++k) a[k * size.count() + c.point] = c.value[k];
    }
    std::vector<double> b(a.size()), scratch(a.size()), few(a.size());
    const CosineTransform transform(size);
    transform.forward(a.data(), b.data(), {});
    transform.forward_at(points, values, scratch.data(), few.data(), {});
    CHECK(max_gap(b, few) < 1e-13);
}

TEST_CASE("cosine transform: quads keep their fourth number") {
    const GridSize size{5, 4, 3};
    const std::vector<double> fields = random_fields(size);
    std::vector<double> a = fields, b(a.size());
    const CosineTransform transform(size);
    transform.forward(a.data(), b.data(), {});
    std::vector<float> quads(4 * static_cast<std::size_t>(size.count()), 7.0F);
    FieldSink sink;
    sink.quads = quads.data();
    sink.constant = Vec3(1.0, 2.0, 3.0);
    transform.inverse(b.data(), a.data(), sink, {});
    for (Index i = 0; i < size.count(); ++i) {
        for (int c = 0; c < 3; ++c) {
            CHECK(quads[4 * i + c] ==
                  doctest::Approx(fields[c * size.count() + i] + c + 1).epsilon(1e-6));
        }
        CHECK(quads[4 * i + 3] == 7.0F);
    }
}

TEST_CASE("grid green: it inverts the operator on fields without a mean") {
    for (const double tension : {0.0, 0.3}) {
        for (const GridSize& size : kSizes) {
            const std::vector<double> fields = random_fields(size);
            std::vector<double> a = fields, b(a.size()), scratch(a.size());
            const GridLaplacian laplacian(size, GridBoundary::zero_flux, tension);
            laplacian.apply(fields.data(), a.data(), scratch.data(), {});
            GridGreen(size, tension, {}).apply(a.data(), scratch.data(), {});
            const auto n = static_cast<std::size_t>(size.count());
            for (int c = 0; c < kComponents; ++c) {
                double mean = 0.0;
                for (std::size_t i = 0; i < n; ++i)
                    mean += fields[c * n + i] / static_cast<double>(n);
                for (std::size_t i = 0; i < n; ++i) b[c * n + i] = fields[c * n + i] - mean;
            }
            // The longest axis has the least eigenvalue, which says how much rounding grows.
            const double longest = std::max({size.nx, size.ny, size.nz});
            CHECK(max_gap(a, b) < 1e-15 * std::pow(longest, 4.0) + 1e-13);
        }
    }
}

TEST_CASE("grid green: entries of the table are columns of the pseudo-inverse") {
    for (const GridSize& size : {GridSize{6, 5, 7}, GridSize{1, 4, 3}, GridSize{8, 1, 1}}) {
        const GridGreen green(size, 0.1, {});
        const auto n = static_cast<std::size_t>(size.count());
        std::vector<GridPoint> points;
        for (Index i = 0; i < size.count(); ++i) points.push_back(size.point(i));
        std::vector<double> column(n), field(3 * n), scratch(3 * n);
        for (Index j = 0; j < size.count(); ++j) {
            std::fill(field.begin(), field.end(), 0.0);
            field[j] = 1.0;
            green.apply(field.data(), scratch.data(), {});
            green.column(points[j], points, column.data());
            double worst = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                worst = std::max(worst, std::abs(column[i] - field[i]));
                worst = std::max(worst, std::abs(column[i] - green.entry(points[j], points[i])));
            }
            CHECK(worst < 1e-11);
        }
    }
}
