#include "tests/unit/merge/real_pairs.h"

#include <algorithm>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/subdivide.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();

// The two directions and their opposites.
std::vector<std::pair<Vec3, Vec3>> both_ways(const Vec3& a, const Vec3& b) {
    return {{a, b}, {-a, -b}};
}

}  // namespace

const std::vector<RealPair>& real_pairs() {
    static const std::vector<RealPair> pairs = [] {
        const ModelPart venus_waist{"venus_torso_711.off", 2, Vec3(0, -.95, 0), kY, kY};
        const ModelPart venus_neck{"venus_torso_711.off", 2, Vec3(0, 2.36, -.1), -kY,
                                   Vec3(0, 0, 0)};
        const ModelPart fish{"fish_oded.obj", 2, Vec3(0, .1, -.17), Vec3(0, .72, -.7),
                             Vec3(0, 0, -1.8)};
        const ModelPart mannequin{"mannequin_nyugp.off", 0, Vec3(40, .5, -14.4), Vec3(0, .05, 1),
                                  Vec3(40, .7, -12)};
        const ModelPart camel{"camel_isoblend.obj", 0, Vec3(0, .52, -.6), Vec3(0, -.76, .65),
                              Vec3(0, .2, .5)};
        const ModelPart camel_head{"camelhead.off", 0, Vec3(0, -.28, .2), kY, Vec3(0, 0, -.3)};
        const ModelPart cow{"cow_3k.off", 1, Vec3(.27, .1, 0), Vec3(-1, -.55, 0), Vec3(-.2, 0, 0)};
        const ModelPart dinosaur{"dinosaur.obj", 0, Vec3(2, 3, 0), Vec3(-.5, 1, 0),
                                 Vec3(-30, 40, 0)};
        const ModelPart dinosaur_back{"dinosaur.obj", 0, Vec3(2, 3, 0), Vec3(.5, -1, 0),
                                      Vec3(50, -40, 0)};
        const ModelPart feline{"feline_small.obj", 1, Vec3(-.2, 1.42, -.1), -kX,
                               Vec3(-.6, 1.4, -.1)};
        const ModelPart feline_front{"feline_small.obj", 1, Vec3(-.2, 1.42, -.1), kX,
                                     Vec3(.2, 1.4, -.1)};
        const ModelPart spot{"spot.obj", 1, Vec3(0, .17, -.21), Vec3(0, -.62, .79), Vec3(0, 0, .8)};
        const ModelPart cow_head{"cowhead.obj"}, lion{"lion.off"};
        const auto waist = both_ways(kY, -kZ);
        std::vector<std::pair<Vec3, Vec3>> neck = both_ways(kY, kZ);
        neck.insert(neck.end(), {{kX, -kX}, {-kX, kX}});
        const Vec3 cow_up(-.5, 1, 0), lion_up(0, -.3, 1), back(1, .5, 0);
        return std::vector<RealPair>{
            {"mermaid", fish, venus_waist, waist, 10.8},
            {"mannequin on Venus", mannequin, venus_neck, neck, 19.7},
            {"cow head on camel", cow_head, camel, both_ways(kY, Vec3(0, .65, .76)), 13.2},
            {"camel head on cow", camel_head, cow, both_ways(-kZ, cow_up), 14.6},
            {"lion on cow", lion, cow, both_ways(lion_up, cow_up), 24.5},
            {"dinosaur on feline", dinosaur, feline, both_ways(back, kY), 19.6},
            {"feline on dinosaur", feline_front, dinosaur_back, both_ways(kY, back), 29.0},
            {"lion on spot", lion, spot, both_ways(lion_up, kY), 23.0}};
    }();
    return pairs;
}

std::optional<LoadedPart> load_part(const ModelPart& part) {
    const std::optional<std::filesystem::path> path = data_file("models/" + part.file);
    if (!path) return std::nullopt;
    Mesh mesh = load_mesh(*path);
    if (part.subdivisions > 0) {
        mesh = subdivide(mesh, {part.subdivisions, SubdivisionScheme::loop});
    }
    if (!part.point) {
        std::vector<Path> open = boundaries(mesh);
        const auto longest = std::max_element(
            open.begin(), open.end(),
            [&](const Path& a, const Path& b) { return a.length(mesh) < b.length(mesh); });
        Path boundary = *longest;
        return LoadedPart{std::move(mesh), std::move(boundary)};
    }
    CutPlane plane;
    plane.point = *part.point;
    plane.normal = part.normal;
    plane.seed = part.seed;
    Cut parts = cut(mesh, plane);
    return LoadedPart{std::move(parts.kept.mesh), parts.lines.front().kept};
}

Index farthest(const Mesh& mesh, const Path& path, const Vec3& direction) {
    const std::vector<Index>& ids = path.vertices();
    return *std::max_element(ids.begin(), ids.end(), [&](Index a, Index b) {
        return mesh.position(a).dot(direction) < mesh.position(b).dot(direction);
    });
}

Join join_of(const RealPair& pair, const LoadedPart& source, const LoadedPart& target) {
    Join join{source.boundary, target.boundary};
    for (const auto& [from, to] : pair.keys) {
        join.keys.push_back({farthest(source.mesh, source.boundary, from),
                             farthest(target.mesh, target.boundary, to)});
    }
    return join;
}

}  // namespace lissom::test
