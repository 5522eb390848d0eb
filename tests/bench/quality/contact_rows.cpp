#include "tests/bench/quality/contact_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/contact/contact_avoid.h"
#include "kernel/deform/contact/contact_search.h"
#include "kernel/deform/contact/contacts.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/bench/quality/measure.h"

namespace lissom::bench {
namespace {

constexpr int kSearches = 9, kFits = 8;

/// A handle that moves a part of a mesh into another part while the rest is held.
struct Collision {
    std::string name;
    Mesh mesh;
    std::vector<Index> still, moved;
    Affine way;
};

std::vector<Index> where(const Mesh& mesh, const std::function<bool(const Vec3&)>& inside) {
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (inside(mesh.position(v))) vertices.push_back(v);
    }
    return vertices;
}

// A bar whose upper end comes to lie beside the lower one, with `gap` between their middles.
Collision folded_bar(double gap) {
    Collision made{"bar, folded, gap " + std::to_string(gap).substr(0, 3),
                   make_bar({.width = 1.0, .length = 8.0, .across = 12, .along = 96}),
                   {},
                   {},
                   translation({-gap, -4.8, 0.0}) * rotation(Vec3::UnitZ(), 3.1, {0, 4, 0})};
    made.still = where(made.mesh, [](const Vec3& p) { return p.y() < -3.7; });
    made.moved = where(made.mesh, [](const Vec3& p) { return p.y() > 3.7; });
    return made;
}

// An arm of a cactus turns towards the trunk or towards the other arm.
Collision cactus_arm(const std::string& name, const char* arm, const Vec3& axis, double degrees) {
    Collision made{"cactus, " + name, make_cactus({.vertices = 9000}), {}, {}, {}};
    const Vec3 elbow = [&] {
        Vec3 sum = Vec3::Zero();
        const auto& vertices = made.mesh.find_region(arm)->vertices();
        double low = made.mesh.position(vertices.front()).y();
        for (const Index v : vertices) {
            sum += made.mesh.position(v) / static_cast<double>(vertices.size());
            low = std::min(low, made.mesh.position(v).y());
        }
        return Vec3(sum.x(), low, sum.z());
    }();
    made.way = rotation(axis, degrees * kDegree, elbow);
    const std::string tip = std::string(arm).substr(0, std::string(arm).find('_')) + "_tip";
    made.moved = made.mesh.find_region(tip)->vertices();
    made.still = made.mesh.find_region("base")->vertices();
    return made;
}

// Two fingers of one sheet: one is bent against the other.
Collision fingers() {
    Collision made{"two fingers", make_sphere({1.0, 40, SphereKind::quads}), {}, {}, {}};
    for (Vec3& p : made.mesh.edit_positions()) {
        for (const double side : {-0.45, 0.45}) {
            const double r = std::hypot(p.x() - side, p.z()) / 0.32;
            if (r < 1.0 && p.y() > 0.0) p.y() += 2.2 * std::pow(1.0 - r * r, 0.35);
        }
    }
    made.still = where(made.mesh, [](const Vec3& p) { return p.y() < -0.6; });
    made.moved = where(made.mesh, [](const Vec3& p) { return p.y() > 1.9 && p.x() > 0.0; });
    made.way = rotation(Vec3::UnitZ(), 32.0 * kDegree, {0.45, 0.9, 0.0});
    return made;
}

// Parts of the armadillo are named by places in its box, as in scenes.h.
Collision armadillo_part(const Mesh& mesh, const std::string& name, const Vec3& part,
                         const Vec3& axis, double degrees, const Vec3& about) {
    const Box box = bounds(mesh);
    const double size = surface_radius(mesh);
    const auto point = [&](const Vec3& share) {
        return Vec3(box.min + share.cwiseProduct(box.max - box.min));
    };
    Collision made{
        "armadillo, " + name, mesh, {}, {}, rotation(axis, degrees * kDegree, point(about))};
    const Vec3 middle = SpatialTree(mesh).nearest(point(part)).position;
    const auto moves = [&](const Vec3& p) { return (p - middle).norm() < 0.2 * size; };
    made.moved = where(mesh, moves);
    made.still = where(mesh, [&](const Vec3& p) {
        return p.y() < point({0, 0.03, 0}).y() && !moves(p);
    });
    return made;
}

std::vector<Collision> collisions(const Mesh* armadillo) {
    std::vector<Collision> all;
    for (const double gap : {0.0, 0.1, 0.2}) all.push_back(folded_bar(gap));
    all.push_back(cactus_arm("right arm to the trunk", "right_arm", Vec3::UnitZ(), 45.0));
    all.push_back(cactus_arm("left arm to the trunk", "left_arm", Vec3::UnitZ(), -55.0));
    all.push_back(fingers());
    if (!armadillo) return all;
    const Mesh& mesh = *armadillo;
    const Vec3 hand(0.97, 0.83, 0.87), shoulder(0.7, 0.72, 0.5);
    const auto add = [&](const char* name, const Vec3& part, const Vec3& axis, double degrees,
                         const Vec3& about) {
        all.push_back(armadillo_part(mesh, name, part, axis, degrees, about));
    };
    add("arm to the chest", hand, Vec3::UnitY(), -110.0, shoulder);
    add("other arm to the chest", {0.05, 0.86, 0.87}, Vec3::UnitY(), 110.0, {0.3, 0.72, 0.5});
    add("tail to the leg", {0.5, 0.25, 0.0}, Vec3::UnitY(), -110.0, {0.5, 0.3, 0.3});
    return all;
}

/// A collision as it is solved.
class Solved {
  public:
    explicit Solved(Collision collision)
        : collision_(std::move(collision)), deformer_(triangulated(collision_.mesh)) {
        const auto topology = collision_.mesh.shared_topology();
        deformer_.pin({topology, collision_.still});
        deformer_.set_transform(deformer_.add_handle({topology, collision_.moved}), collision_.way);
    }

    const std::string& name() const { return collision_.name; }
    const Mesh& mesh() const { return collision_.mesh; }
    Deformer& deformer() { return deformer_; }
    std::size_t pairs() { return contacts_of(deformer_, collision_.mesh).size(); }
    double energy() const {
        std::vector<Index> held = collision_.still;
        held.insert(held.end(), collision_.moved.begin(), collision_.moved.end());
        std::sort(held.begin(), held.end());
        return QualityMeasure(collision_.mesh, held).of(deformer_.positions()).energy;
    }

  private:
    static const Mesh& triangulated(Mesh& mesh) {
        triangulate(mesh);
        return mesh;
    }

    Collision collision_;
    Deformer deformer_;
};

/// Fits of all boxes to a shape on one thread, as many in a row as take about as long as a search.
class BoxFits {
  public:
    explicit BoxFits(const Mesh& rest, std::vector<Vec3> shape)
        : shape_(std::move(shape)), tree_(rest.topology(), shape_, Context()) {}
    double seconds_of_one() {
        const double all = seconds([&] {
            for (int i = 0; i < kFits; ++i) {
                local_.set(shape_, context_);
                tree_.fit(local_, context_);
            }
        });
        return all / kFits;
    }

  private:
    Context context_;
    std::vector<Vec3> shape_;
    FaceTree tree_;
    LocalShape local_;
};

// On two threads, as people have them.
Quotient search_quotient(Solved& solved) {
    ContextOptions options;
    options.threads = 2;
    const Context context(options);
    BoxFits fits(solved.mesh(), solved.deformer().positions());
    const auto search = [&] { contacts_of(solved.deformer(), solved.mesh(), context); };
    search();
    return quotient_of(
        kSearches, [&] { return seconds(search); }, [&] { return fits.seconds_of_one(); });
}

struct Totals {
    double before = 0.0, left = 0.0, dearest = 0.0;
};

void add_rows(Report& report, Solved& solved, Totals& totals) {
    const std::string name = solved.name() + ": ";
    const double plain_seconds = seconds([&] { solved.deformer().solve(); });
    const double energy = solved.energy();
    const double before = static_cast<double>(solved.pairs());
    const Quotient search = search_quotient(solved);
    double left = before;
    const double seconds_avoiding = seconds([&] {
        left = static_cast<double>(
            solve_avoiding_contacts(solved.deformer(), solved.mesh()).contacts.size());
    });
    const double ratio = solved.energy() / energy;
    report.add({name + "pairs without avoid", before, ""});
    report.add({name + "pairs with avoid", left, "", 0.1 * before});
    report.add({name + "energy with avoid / without", ratio, "x", 1.5});
    report.add({name + "first solve with avoid / without", seconds_avoiding / plain_seconds, "x"});
    report.add_ratio(name + "contacts, 2 threads / fit on 1 thread", "fit of the boxes", search);
    totals.before += before;
    totals.left += left;
    totals.dearest = std::max(totals.dearest, ratio);
}

}  // namespace

void add_contact_rows(Report& report, const Mesh* armadillo) {
    Totals totals;
    for (Collision& collision : collisions(armadillo)) {
        Solved solved(std::move(collision));
        report.title("contacts, " + solved.name() + ": " +
                     std::to_string(solved.mesh().vertex_count()) + " vertices");
        add_rows(report, solved, totals);
    }
    report.title("contacts, all");
    report.add({"contacts: pairs that avoid takes away", 1.0 - totals.left / totals.before, "of 1",
                0.9, Better::more});
    report.add({"contacts: greatest energy with avoid / without", totals.dearest, "x", 1.5});
}

}  // namespace lissom::bench
