#include "kernel/solve/sparse/supernodal_factor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/solve/sparse/matrices.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

struct Factored {
    Supernodes nodes;
    std::vector<double> value;
    Index failed = kNoIndex;
};

Factored supernodal_factored(const SymmetricMatrix& a, Processor processor,
                             const Context& context = {}) {
    Factored f{analyze_supernodes(a), {}, kNoIndex};
    f.value.assign(f.nodes.value_count(), std::nan(""));
    const FactorPlan plan = plan_factor(f.nodes, a);
    f.failed =
        factor_supernodes({f.nodes, plan, a.value.data(), f.value.data()}, processor, context);
    return f;
}

// The greatest entry of L L^T - P A P^T.
double defect(const Factored& f, const SymmetricMatrix& a) {
    const Supernodes& nodes = f.nodes;
    const Index n = nodes.size();
    std::vector<Index> to(nodes.permutation.size());
    for (Index i = 0; i < n; ++i) to[nodes.permutation[i]] = i;
    std::vector<double> product(to.size() * to.size(), 0.0);
    const auto at = [&](Index i, Index j) -> double& {
        return product[static_cast<std::size_t>(std::max(i, j)) * to.size() +
                       static_cast<std::size_t>(std::min(i, j))];
    };
    for (Index s = 0; s < nodes.count(); ++s) {
        const Index height = nodes.height(s), *row = nodes.row.data() + nodes.first_row[s];
        for (Index c = 0; c < nodes.columns(s); ++c) {
            const double* column = f.value.data() + nodes.first_value[s] + c * height;
            for (Index i = c; i < height; ++i) {
                for (Index j = c; j <= i; ++j) at(row[i], row[j]) += column[i] * column[j];
            }
        }
    }
    for (Index j = 0; j < n; ++j) {
        for (Index k = a.begin[j]; k < a.begin[j + 1]; ++k) at(to[j], to[a.row[k]]) -= a.value[k];
    }
    double worst = 0.0;
    for (const double v : product) worst = std::max(worst, std::abs(v));
    return worst;
}

double max_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

std::vector<Processor> processors() {
    std::vector<Processor> here;
    for (const Processor p : {Processor::any, Processor::avx2, Processor::avx512}) {
        if (p <= best_processor()) here.push_back(p);
    }
    return here;
}

}  // namespace

TEST_CASE("supernodal factor: L L^T is the matrix, for every structure and processor") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        if (a.size() > 3000) continue;
        for (const Processor processor : processors()) {
            const Factored f = supernodal_factored(a, processor);
            REQUIRE(f.failed == kNoIndex);
            CHECK(defect(f, a) < 1e-12 * std::sqrt(static_cast<double>(a.size())));
        }
    }
}

TEST_CASE("supernodal factor: above the diagonal of every supernode stand zeros") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        if (a.size() > 3000) continue;
        const Factored f = supernodal_factored(a, best_processor());
        bool zero = true;
        for (Index s = 0; s < f.nodes.count(); ++s) {
            for (Index c = 0; c < f.nodes.columns(s); ++c) {
                const double* column =
                    f.value.data() + f.nodes.first_value[s] + c * f.nodes.height(s);
                zero = zero && std::all_of(column, column + c, [](double v) { return v == 0.0; });
            }
        }
        CHECK(zero);
    }
}

TEST_CASE("supernodal factor: the paths for two processors agree") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        const Factored plain = supernodal_factored(a, Processor::any),
                       best = supernodal_factored(a, best_processor());
        CHECK(max_difference(plain.value, best.value) < 1e-12);
    }
}

TEST_CASE("supernodal factor: four and eight numbers at a time give the same bits") {
    if (best_processor() < Processor::avx512) {
        MESSAGE("skipped: this processor has no AVX-512");
        return;
    }
    for (const test::NamedMatrix& named : test::matrices()) {
        CAPTURE(named.name);
        CHECK(supernodal_factored(named.matrix, Processor::avx512).value ==
              supernodal_factored(named.matrix, Processor::avx2).value);
    }
}

TEST_CASE("supernodal factor: threads do not change a bit") {
    for (const test::NamedMatrix& named : test::matrices()) {
        const SymmetricMatrix& a = named.matrix;
        CAPTURE(named.name);
        const Factored one = supernodal_factored(a, best_processor());
        for (const int threads : {2, 4}) {
            ContextOptions options;
            options.threads = threads;
            CHECK(supernodal_factored(a, best_processor(), Context(options)).value == one.value);
        }
    }
}

TEST_CASE("supernodal factor: large matrices are cut into subtrees, each supernode in one place") {
    const SymmetricMatrix a = test::grid(110, 90);
    const Supernodes nodes = analyze_supernodes(a);
    const FactorPlan plan = plan_factor(nodes, a);
    CHECK(plan.subtrees.size() > 4);
    CHECK(plan.bins.size() > 4);
    std::vector<int> uses(static_cast<std::size_t>(nodes.count()), 0);
    for (const Index s : plan.top) ++uses[s];
    for (const auto& bin : plan.bins) {
        for (const Index t : bin) {
            for (Index s = plan.subtrees[t].first; s < plan.subtrees[t].last; ++s) ++uses[s];
        }
    }
    CHECK(std::all_of(uses.begin(), uses.end(), [](int n) { return n == 1; }));
    CHECK(plan.entries.size() == a.nonzeros());
}

TEST_CASE("supernodal factor: the first bad pivot is named, for any number of threads") {
    SymmetricMatrix a = test::grid(110, 90);
    for (const Index bad : {0, 17, 4999, 9899}) {
        SymmetricMatrix b = a;
        b.value[b.begin[bad]] = -1.0;
        const Factored one = supernodal_factored(b, best_processor());
        REQUIRE(one.failed != kNoIndex);
        ContextOptions options;
        options.threads = 4;
        CHECK(supernodal_factored(b, best_processor(), Context(options)).failed == one.failed);
    }
}

TEST_CASE("supernodal factor: extreme but honest scales survive") {
    for (const double scale : {1e-150, 1e150}) {
        SymmetricMatrix a = test::grid(30, 30);
        for (double& v : a.value) v *= scale;
        const Factored f = supernodal_factored(a, best_processor());
        REQUIRE(f.failed == kNoIndex);
        CHECK(defect(f, a) < 1e-12 * scale);
    }
}
