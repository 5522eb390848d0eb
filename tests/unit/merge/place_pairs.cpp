#include "tests/unit/merge/place_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "kernel/core/error.h"
#include "kernel/io/mesh_file.h"
#include "kernel/merge/loop/loop_fit.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/merge_stages.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/merge/real_pairs.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

constexpr double kDepths[] = {0.12, 0.22, 0.35};

Index farthest_vertex(const Mesh& mesh, const Vec3& direction) {
    Index best = 0;
    for (Index v = 1; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).dot(direction) > mesh.position(best).dot(direction)) best = v;
    }
    return best;
}

std::vector<Vec3> directions() {
    std::vector<Vec3> all;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x != 0 || y != 0 || z != 0) all.push_back(Vec3(x, y, z).normalized());
            }
        }
    }
    return all;
}

struct CutPart {
    Mesh mesh;
    Path boundary;
};

std::optional<CutPart> kept_part(const Mesh& mesh, const Vec3& point, const Vec3& normal,
                                 const Vec3& seed) try {
    CutPlane plane;
    plane.point = point;
    plane.normal = normal;
    plane.seed = seed;
    Cut parts = cut(mesh, plane);
    if (parts.lines.size() != 1 || !parts.lines.front().kept.closed()) return std::nullopt;
    return CutPart{std::move(parts.kept.mesh), parts.lines.front().kept};
} catch (const Error&) {
    return std::nullopt;
}

Vec3 middle_of(const CutPart& part) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : part.boundary.vertices()) sum += part.mesh.position(v);
    return sum / part.boundary.vertices().size();
}

// A part that stands out farther than it is thick, and is less than half of the model.
bool stands_out(const Mesh& model, const CutPart& part, const Vec3& direction) {
    const double radius = part.boundary.length(part.mesh) / (2.0 * kPi);
    const Vec3 tip = part.mesh.position(farthest_vertex(part.mesh, direction));
    return part.mesh.vertex_count() > 60 && 2 * part.mesh.vertex_count() < model.vertex_count() &&
           part.boundary.vertices().size() >= 12 &&
           (tip - middle_of(part)).dot(direction) > 1.2 * radius;
}

void move_away(PlacePair& pair, Random& random) {
    const Mat3 turn =
        rotation(random.direction(), random.uniform(0.0, 2.0 * kPi), Vec3::Zero()).linear;
    const double scale = std::exp(random.uniform(-3.0, 3.0));
    const Vec3 away = 10.0 * random.direction();
    for (Vec3& p : pair.source.edit_positions()) p = scale * (turn * p) + away;
    pair.right = turn.transpose();
}

void roughen_and_move(PlacePair& pair, Random& random) {
    const double size = surface_radius(pair.source);
    for (Vec3& p : pair.source.edit_positions()) p += 0.004 * size * random.direction();
    move_away(pair, random);
}

// Models that stand upright and look along z, and the height of their necks, 0 to 1.
constexpr std::pair<const char*, double> kUpright[] = {
    {"heads/LeePerrySmith.glb", 0.34},     {"heads/african_head.obj", 0.22},
    {"heads/digitalsalon_head.obj", 0.24}, {"heads/hairstep_usc_head.obj", 0.15},
    {"heads/human_neutral.obj", 0.83},     {"heads/ict_head.obj", 0.28},
    {"heads/sintel_head.obj", 0.5},        {"models/homer.obj", 0.65},
    {"models/teddy_gpy.obj", 0.53},        {"heads/WaltHead.obj", 0.14}};

struct Upright {
    std::string name;
    CutPart head, body;
};

// A model cut through its neck: at the middle of what lies there.
std::optional<Upright> upright(const char* file, double height) {
    const auto path = data_file(file);
    if (!path) return std::nullopt;
    Mesh model = load_mesh(*path);
    triangulate(model);
    const Vec3 up = Vec3::UnitY();
    const Vec3 top = model.position(farthest_vertex(model, up));
    const Vec3 foot = model.position(farthest_vertex(model, -up));
    const double level = foot.y() + height * (top.y() - foot.y());
    Vec3 middle = Vec3::Zero();
    int count = 0;
    for (const Vec3& p : model.positions()) {
        if (std::abs(p.y() - level) > 0.04 * (top.y() - foot.y())) continue;
        middle += p;
        ++count;
    }
    middle /= count;
    middle.y() = level;
    auto head = kept_part(model, middle, up, top), body = kept_part(model, middle, -up, foot);
    if (!head || !body) return std::nullopt;
    return Upright{file, std::move(*head), std::move(*body)};
}

std::optional<PlacePair> pair_at(const Mesh& model, const Vec3& direction, double depth,
                                 Random& random) {
    const Vec3 tip = model.position(farthest_vertex(model, direction));
    const Vec3 far = model.position(farthest_vertex(model, -direction));
    const double extent = (tip - far).dot(direction);
    const auto part = kept_part(model, tip - depth * extent * direction, direction, tip);
    if (!part || !stands_out(model, *part, direction)) return std::nullopt;
    const double radius = part->boundary.length(part->mesh) / (2.0 * kPi);
    const Vec3 across = direction.cross(random.direction()).normalized();
    const Vec3 tilted = (direction + std::tan(0.1) * across).normalized();
    auto rest = kept_part(model, middle_of(*part) - 0.25 * radius * direction, -tilted, far);
    if (!rest || rest->mesh.vertex_count() < model.vertex_count() / 3) return std::nullopt;
    PlacePair pair{"", part->mesh, std::move(rest->mesh), part->boundary, rest->boundary};
    roughen_and_move(pair, random);
    return pair;
}

}  // namespace

std::vector<PlacePair> cut_pairs(const std::string& file, std::size_t limit) {
    const auto path = data_file(file);
    if (!path) return {};
    Mesh model = load_mesh(*path);
    triangulate(model);
    Random random(static_cast<std::uint32_t>(7 + model.vertex_count()));
    std::vector<PlacePair> pairs;
    std::vector<Vec3> tips;
    for (const Vec3& direction : directions()) {
        const Vec3 tip = model.position(farthest_vertex(model, direction));
        const bool known = std::any_of(tips.begin(), tips.end(), [&](const Vec3& other) {
            return (tip - other).norm() < 0.5 * surface_radius(model);
        });
        for (const double depth : kDepths) {
            if (known || pairs.size() >= limit) break;
            std::optional<PlacePair> pair = pair_at(model, direction, depth, random);
            if (!pair) continue;
            pair->name = file + " " + std::to_string(pairs.size());
            pairs.push_back(std::move(*pair));
            tips.push_back(tip);
            break;
        }
    }
    return pairs;
}

std::vector<PlacePair> head_pairs() {
    std::vector<Upright> models;
    for (const auto& [file, height] : kUpright) {
        if (std::optional<Upright> model = upright(file, height)) models.push_back(*model);
    }
    Random random(12);
    std::vector<PlacePair> pairs;
    for (std::size_t i = 0; i < models.size(); ++i) {
        for (const std::size_t step : {1, 4}) {
            const Upright &head = models[i], &body = models[(i + step) % models.size()];
            PlacePair pair{head.name + " on " + body.name, head.head.mesh, body.body.mesh,
                           head.head.boundary, body.body.boundary};
            move_away(pair, random);
            pairs.push_back(std::move(pair));
        }
    }
    return pairs;
}

std::vector<PlacePair> keyed_pairs() {
    std::vector<PlacePair> pairs;
    for (const RealPair& real : real_pairs()) {
        const auto source = load_part(real.source), target = load_part(real.target);
        if (!source || !target) return {};
        const Mesh* targets[] = {&target->mesh};
        const std::vector<Join> joins{join_of(real, *source, *target)};
        const MergePreparation made = prepare_merge(source->mesh, targets, joins, {}, {});
        const std::vector<std::vector<KeyPair>> keys{joins.front().keys};
        const Matching matching =
            match_boundaries(made.given, made.boundaries, made.options, made.report.sides.joins,
                             keys, [] { return FoundPlaces{}; });
        const Vec3 turn = matching.joins.front().turn;
        PlacePair pair{real.name, source->mesh, target->mesh, source->boundary, target->boundary};
        pair.right = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

bool is_right(const PlacePair& pair, const Mat3& rotation) {
    return Eigen::AngleAxisd(rotation * pair.right.transpose()).angle() < kPi / 6.0;
}

}  // namespace lissom::test
