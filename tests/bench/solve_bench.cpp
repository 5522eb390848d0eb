/// Our sparse Cholesky factor beside CHOLMOD's supernodal one with the same ordering, on the
/// squared Laplacian of a mesh, and beside the rate at which this machine multiplies matrices.

#include <cholmod.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/cholmod/cholmod_view.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/solve/sparse/adjacency.h"
#include "kernel/solve/sparse/elimination_tree.h"
#include "kernel/solve/sparse/minimum_degree.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "tests/bench/limits.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr int kRounds = 7;
constexpr Index kColumns = 3;

// Armadillo of 43K vertices where it is there, else a generated mesh of that size.
Mesh test_mesh() {
    const auto path = std::filesystem::path(LISSOM_BENCH_DATA) / "models/armadillo_43k.obj";
    if (std::filesystem::exists(path)) return load_mesh(path);
    CactusOptions options;
    options.vertices = 43000;
    return make_cactus(options);
}

// L L + a little of the identity, with L the Laplacian of the mesh's edges.
SymmetricMatrix squared_laplacian(const Mesh& mesh) {
    std::vector<std::map<Index, double>> rows(at(mesh.vertex_count()));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.topology().face(f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Index a = corners[i], b = corners[(i + 1) % corners.size()];
            rows[at(a)][b] = rows[at(b)][a] = -1.0;
        }
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v)
        rows[at(v)][v] = static_cast<double>(rows[at(v)].size());
    std::vector<Triplet> entries;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        entries.push_back({v, v, 1e-3});
        for (const auto& [i, a] : rows[at(v)]) {
            for (const auto& [j, b] : rows[at(v)]) entries.push_back({i, j, a * b});
        }
    }
    return symmetric_from_triplets(mesh.vertex_count(), entries);
}

// CHOLMOD's supernodal factor by approximate minimum degree, as ours is ordered.
class Cholmod {
  public:
    explicit Cholmod(const SymmetricMatrix& matrix) : view_(cholmod_view(matrix)) {
        cholmod_start(&common_);
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_AMD;
        common_.postorder = 1;
        factor_ = cholmod_analyze(&view_, &common_);
        flops_ = common_.fl;
    }
    ~Cholmod() {
        cholmod_free_factor(&factor_, &common_);
        cholmod_finish(&common_);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;

    /// Operations of the factorisation, by the pattern of its columns.
    double flops() const { return flops_; }
    void analyze() {
        cholmod_free_factor(&factor_, &common_);
        factor_ = cholmod_analyze(&view_, &common_);
    }
    void factor() { cholmod_factorize(&view_, factor_, &common_); }
    void solve(std::vector<double>& b) {
        cholmod_dense right{};
        right.nrow = right.d = view_.nrow;
        right.ncol = kColumns;
        right.nzmax = b.size();
        right.x = b.data();
        right.xtype = CHOLMOD_REAL;
        right.dtype = CHOLMOD_DOUBLE;
        cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, &right, &common_);
        cholmod_free_dense(&x, &common_);
    }

  private:
    cholmod_common common_{};
    cholmod_sparse view_;
    cholmod_factor* factor_ = nullptr;
    double flops_ = 0.0;
};

// Of what a profile of each is made.
constexpr const char* kSolveBound =
    "reading the factor, twice in double precision; drags read one in single precision, by three "
    "right-hand sides at once";
constexpr const char* kFactorBound =
    "products of blocks 37 %, adding their results to other blocks 21, zeros in fresh memory 18, "
    "rows below the diagonal 10, entries of the matrix 8; above the subtrees block follows block, "
    "each shared by rows";
constexpr const char* kAnalysisBound =
    "the order by minimum degree 58 %, the elimination tree 21, supernodes 12, the plan of the "
    "factor 8; CHOLMOD's makes no plan";

Context context_with(int threads) {
    ContextOptions options;
    options.threads = threads;
    return Context(options);
}

void run_peer(Report& report, const SymmetricMatrix& matrix, SparseSystem& ours, Cholmod& theirs,
              int threads) {
    const Context context = context_with(threads);
    const std::string blas = std::string("CHOLMOD with ") + set_blas_threads(threads);
    const std::string on = threads == 1 ? ", 1 thread" : ", 2 threads";
    const Quotient factor = seconds_quotient(
        kRounds, [&] { theirs.factor(); }, [&] { ours.factor(matrix, context); });
    report.add({"ours: factor" + on, 1e3 * factor.below, "ms"});
    report.add_ratio(blas + " / ours: factor" + on, blas, factor, threads == 1 ? 4.0 : 7.0,
                     Better::more);
    std::vector<double> b(at(kColumns * matrix.size()), 1.0), x(b.size());
    const Quotient solve = seconds_quotient(
        3 * kRounds, [&] { theirs.solve(b); }, [&] { ours.solve(b, x, kColumns); });
    report.add({"ours: solve, three right-hand sides" + on, 1e3 * solve.below, "ms"});
    report.add_ratio(blas + " / ours: solve" + on, blas, solve, threads == 1 ? 2.0 : 3.0,
                     Better::more, kSolveBound);
}

// The pattern of the whole matrix for Eigen, which has its upper half beside ours.
Eigen::SparseMatrix<double> whole_matrix(const SymmetricMatrix& matrix) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index c = 0; c < matrix.size(); ++c) {
        for (Index k = matrix.begin[at(c)]; k < matrix.begin[at(c + 1)]; ++k) {
            entries.emplace_back(matrix.row[at(k)], c, 1.0);
            if (matrix.row[at(k)] != c) entries.emplace_back(c, matrix.row[at(k)], 1.0);
        }
    }
    Eigen::SparseMatrix<double> whole(matrix.size(), matrix.size());
    whole.setFromTriplets(entries.begin(), entries.end());
    return whole;
}

double fill_of(const Adjacency& graph, std::vector<Index> order) {
    double entries = 0.0;
    for (const Index count : elimination_tree(graph, std::move(order)).count) entries += count;
    return entries;
}

// Our order of elimination beside that of Eigen's approximate minimum degree.
void run_orders(Report& report, const SymmetricMatrix& matrix) {
    const Adjacency graph(matrix);
    const Eigen::SparseMatrix<double> whole = whole_matrix(matrix);
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> found;
    const Quotient time = seconds_quotient(
        kRounds, [&] { Eigen::AMDOrdering<Index>()(whole, found); },
        [&] { minimum_degree_order(graph); });
    report.add_ratio("Eigen's AMD / ours: order of elimination", "Eigen", time, 1.0, Better::more);
    const auto& indices = found.indices();
    const double theirs = fill_of(graph, {indices.data(), indices.data() + indices.size()});
    report.add({"Eigen's AMD / ours: entries of the factor",
                theirs / fill_of(graph, minimum_degree_order(graph)), ""});
}

void run(Report& report) {
    const SymmetricMatrix matrix = squared_laplacian(test_mesh());
    SparseSystem ours;
    ours.analyze(matrix);
    Cholmod theirs(matrix);
    report.title("Squared Laplacian of " + std::to_string(matrix.size()) + " vertices");
    for (const int threads : {1, 2}) run_peer(report, matrix, ours, theirs, threads);

    const Context one = context_with(1), two = context_with(2);
    report.add_ratio(
        "factor on 1 thread / on 2", "1 thread",
        seconds_quotient(
            kRounds, [&] { ours.factor(matrix, one); }, [&] { ours.factor(matrix, two); }),
        1.8, Better::more, kFactorBound);
    ProductLimit product;
    report.add_ratio(
        "factor: share of the matrix product's rate, 1 thread", "matrix product",
        quotient_of(
            kRounds, [&] { return theirs.flops() / seconds([&] { ours.factor(matrix, one); }); },
            [&] { return product.rate(); }),
        0.5, Better::more, kFactorBound);
    report.add_ratio("CHOLMOD / ours: analysis", "CHOLMOD",
                     seconds_quotient(
                         kRounds, [&] { theirs.analyze(); }, [&] { ours.analyze(matrix); }),
                     0.95, Better::more, kAnalysisBound);
    run_orders(report, matrix);
    report.add_ratio("analysis / factor, 1 thread", "factor",
                     seconds_quotient(
                         3, [&] { ours.analyze(matrix); }, [&] { ours.factor(matrix, one); }));
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run(report);
    return 0;
}
