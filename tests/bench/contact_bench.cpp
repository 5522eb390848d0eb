/// Speed of the search for contacts of a deformed surface, beside a fit of its boxes on one thread
/// and beside a search that knows no earlier shape.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/contact/contact_search.h"
#include "kernel/deform/contact/contacts.h"
#include "kernel/deform/deformer.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/report.h"

namespace lissom::bench {
namespace {

constexpr int kRounds = 25, kFits = 8;

Context context_with(int threads) {
    ContextOptions options;
    options.threads = threads;
    return Context(options);
}

/// A mesh that is bent about its middle, each end held over a share of the longest side.
class Bent {
  public:
    Bent(Mesh mesh, double held) : mesh_(std::move(mesh)), deformer_(mesh_) {
        const Box box = bounds(mesh_);
        Index along = 0;
        const Vec3 extent = box.max - box.min;
        extent.maxCoeff(&along);
        std::vector<Index> low, high;
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            const double t = (mesh_.position(v)[along] - box.min[along]) / extent[along];
            if (t < held) low.push_back(v);
            if (t > 1.0 - held) high.push_back(v);
        }
        deformer_.pin({mesh_.shared_topology(), low});
        const HandleId end = deformer_.add_handle({mesh_.shared_topology(), high});
        deformer_.set_transform(end, rotation(Vec3::Unit((along + 1) % 3), 2.5, box.center()));
        deformer_.solve();
    }

    const Mesh& mesh() const { return mesh_; }
    std::size_t pairs(const Context& context) {
        return contacts_of(deformer_, mesh_, context).size();
    }
    std::vector<Vec3> shape() {
        Mesh moved = mesh_;
        deformer_.apply_to(moved);
        return {moved.positions().begin(), moved.positions().end()};
    }

  private:
    Mesh mesh_;
    Deformer deformer_;
};

/// Fits of all boxes to a shape on one thread, as many in a row as take about as long as a search.
class Fit {
  public:
    explicit Fit(Bent& bent)
        : shape_(bent.shape()), tree_(bent.mesh().topology(), shape_, Context()) {}
    double seconds_of_one() {
        return seconds([&] {
                   for (int i = 0; i < kFits; ++i) {
                       local_.set(shape_, context_);
                       tree_.fit(local_, context_);
                   }
               }) /
               kFits;
    }

  private:
    Context context_;
    std::vector<Vec3> shape_;
    FaceTree tree_;
    LocalShape local_;
};

void run(Report& report, const std::string& name, const Mesh& mesh, double held, double target) {
    Bent bent(mesh, held);
    Fit fit(bent);
    Mesh moved = mesh;
    moved.set_positions(bent.shape());
    for (const int threads : {1, 2}) {
        const Context context = context_with(threads);
        const std::string on = threads == 1 ? ", 1 thread" : ", 2 threads";
        const std::size_t pairs = bent.pairs(context);
        if (threads == 1) report.add({name + "pairs", static_cast<double>(pairs), ""});
        const Quotient search = quotient_of(
            kRounds, [&] { return seconds([&] { bent.pairs(context); }); },
            [&] { return fit.seconds_of_one(); });
        report.add({name + "contacts" + on, 1e3 * search.above, "ms"});
        if (threads == 1) report.add({name + "fit of the boxes" + on, 1e3 * search.below, "ms"});
        report.add_ratio(name + "contacts" + on + " / fit on 1 thread", "fit of the boxes", search,
                         threads == 1 ? -1.0 : target);
        const Quotient anew = seconds_quotient(
            3, [&] { self_intersections(moved, {}, context); }, [&] { bent.pairs(context); });
        report.add_ratio(name + "search without a hierarchy / contacts" + on, "contacts", anew);
    }
}

void run_mesh(Report& report, const std::string& name, const Mesh& mesh) {
    report.title("  " + name + ", " + std::to_string(mesh.vertex_count()) + " vertices");
    run(report, name + ", ends held: ", mesh, 0.35, 5.0);
    run(report, name + ", nearly all free: ", mesh, 0.02, 8.0);
}

void run_all(Report& report) {
    Mesh cactus = make_cactus({.vertices = 43000});
    triangulate(cactus);
    run_mesh(report, "cactus", cactus);
    const auto path = std::filesystem::path(LISSOM_BENCH_DATA) / "models/armadillo_43k.obj";
    if (std::filesystem::exists(path)) {
        run_mesh(report, "armadillo", load_mesh(path));
    } else {
        report.title("Armadillo: skipped, models/armadillo_43k.obj is absent");
    }
}

}  // namespace
}  // namespace lissom::bench

int main(int argc, char** argv) {
    lissom::bench::Report report(argc, argv);
    lissom::bench::run_all(report);
    return 0;
}
