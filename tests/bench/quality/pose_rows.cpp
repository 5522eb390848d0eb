#include "tests/bench/quality/pose_rows.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/deform/poses/pose_space.h"
#include "kernel/io/poses/pose_targets.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom::bench {
namespace {

constexpr int kBlends = 9;

std::vector<Vec3> mean_of(std::span<const Vec3> a, std::span<const Vec3> b) {
    std::vector<Vec3> mean(a.begin(), a.end());
    for (std::size_t v = 0; v < mean.size(); ++v) mean[v] = 0.5 * (a[v] + b[v]);
    return mean;
}

Mesh with_positions(const Mesh& mesh, std::vector<Vec3> positions) {
    Mesh moved = mesh;
    moved.set_positions(std::move(positions));
    return moved;
}

class Posed {
  public:
    explicit Posed(const QualityScene& scene) : scene_(scene), deformer_(scene.mesh) {
        const auto topology = scene.mesh.shared_topology();
        deformer_.pin({topology, scene.still});
        moved_ = deformer_.add_handle({topology, scene.moved});
    }

    const std::vector<Vec3>& at(const Move& move, double share) {
        deformer_.set_transform(moved_, move.at(share));
        return deformer_.solve();
    }
    Mesh mesh_at(const Move& move, double share) {
        return with_positions(scene_.mesh, at(move, share));
    }

  private:
    const QualityScene& scene_;
    Deformer deformer_;
    HandleId moved_{};
};

double correctives_error(const PoseSpace& space, const std::vector<double>& at) {
    PoseTargetOptions options;
    for (const double weight : at) options.correctives.push_back({{"pose", weight}});
    PoseTargetReport report;
    pose_targets(space, options, &report);
    return at.empty() ? report.linear_error : report.error;
}

void add_rows(Report& report, const QualityScene& scene, Posed& posed, const Move& move) {
    const std::string name = scene.name + " " + move.name + ": ";
    const Mesh pose = posed.mesh_at(move, 1.0);
    const PoseSpace space(scene.mesh, {{"pose", {pose}}});
    const double rest = volume(scene.mesh), size = surface_radius(scene.mesh);
    const Mesh half = space.blend({{"pose", 0.5}});
    const Mesh linear =
        with_positions(scene.mesh, mean_of(scene.mesh.positions(), pose.positions()));
    report.add({name + "volume of the pose", volume(pose) / rest, "of rest"});
    report.add({name + "volume at half, linear blend", volume(linear) / rest, "of rest"});
    report.add({name + "volume at half, pose space", volume(half) / rest, "of rest"});
    report.add(
        {name + "volume at half, deformer", volume(posed.mesh_at(move, 0.5)) / rest, "of rest"});
    const double plain = correctives_error(space, {});
    report.add({name + "morph target: greatest error / size", plain / size, ""});
    const double one = correctives_error(space, {0.5});
    report.add({name + "and a corrective at .5: error / without", one / plain, "x", 0.4});
    const double three = correctives_error(space, {0.25, 0.5, 0.75});
    report.add({name + "and three correctives: error / without", three / plain, "x", 0.15});
    PoseFrames frames(space);
    double weight = 0.4;
    const Quotient frame = seconds_quotient(
        kBlends, [&] { frames.positions(std::vector<double>{weight += 0.01}); },
        [&] { posed.at(move, weight); });
    report.add_ratio(name + "blend / frame of the deformer", "full frame", frame);
}

}  // namespace

void add_pose_rows(Report& report, const std::vector<QualityScene>& scenes) {
    for (const QualityScene& scene : scenes) {
        report.title("poses, " + scene.name + ": " + std::to_string(scene.mesh.vertex_count()) +
                     " vertices");
        Posed posed(scene);
        for (const Move& move : scene.moves) {
            if (move.angle <= 180.0) add_rows(report, scene, posed, move);
        }
    }
}

}  // namespace lissom::bench
