// Skins fitted to deformations: read from their files and posed by the rules of glTF, they are the
// deformations up to the error told.
#include "kernel/io/skin_baker.h"

#include <Eigen/Geometry>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// The parts of a binary glTF file that pose a skin.
struct SkinFile {
    explicit SkinFile(const std::string& glb) : bytes(glb), json(json_of_glb(glb)) {}

    template <typename T>
    std::vector<T> numbers(std::size_t accessor) const {
        const Json& a = json["accessors"][accessor];
        const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
        std::uint32_t json_bytes = 0;
        std::memcpy(&json_bytes, bytes.data() + 12, 4);
        std::vector<T> values(view["byteLength"].get<std::size_t>() / sizeof(T));
        std::memcpy(values.data(),
                    bytes.data() + 28 + json_bytes + view.value("byteOffset", std::size_t{0}),
                    values.size() * sizeof(T));
        return values;
    }

    // The map of each joint at a key: that of its node after the inverse bind matrix.
    std::vector<Eigen::Affine3d> maps(std::size_t key) const {
        const Json& skin = json["skins"][0];
        const auto inverse = numbers<float>(skin["inverseBindMatrices"].get<std::size_t>());
        std::vector<Eigen::Affine3d> result(skin["joints"].size());
        for (std::size_t j = 0; j < result.size(); ++j) {
            const Eigen::Matrix4f bind = Eigen::Map<const Eigen::Matrix4f>(inverse.data() + 16 * j);
            const auto t = track(skin["joints"][j], "translation");
            const auto r = track(skin["joints"][j], "rotation");
            Eigen::Affine3d node = Eigen::Affine3d::Identity();
            node.translate(Vec3(t[3 * key], t[3 * key + 1], t[3 * key + 2]));
            node.rotate(
                Eigen::Quaterniond(r[4 * key + 3], r[4 * key], r[4 * key + 1], r[4 * key + 2]));
            result[j] = node * Eigen::Affine3d(bind.cast<double>());
        }
        return result;
    }

    std::vector<float> track(const Json& node, const std::string& path) const {
        const Json& animation = json["animations"][0];
        for (const Json& channel : animation["channels"]) {
            if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
            const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
            return numbers<float>(sampler["output"].get<std::size_t>());
        }
        FAIL("a joint has no track");
        return {};
    }

    std::string bytes;
    Json json;
};

// Positions of a mesh read from a file, posed by its attributes.
std::vector<Vec3> posed(const Mesh& mesh, const std::vector<Eigen::Affine3d>& maps) {
    const Attribute& joints = *mesh.attributes().find("joints");
    const Attribute& weights = *mesh.attributes().find("weights");
    std::vector<Vec3> result;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        Vec3 sum = Vec3::Zero();
        double total = 0.0;
        for (std::size_t k = 0; k < joints.at(v).size(); ++k) {
            const double weight = weights.at(v)[k];
            CHECK(weight >= 0.0);
            total += weight;
            sum += weight * (maps[static_cast<std::size_t>(joints.at(v)[k])] * mesh.position(v));
        }
        CHECK(total == doctest::Approx(1.0).epsilon(1e-5));
        result.push_back(sum);
    }
    return result;
}

struct Bend {
    Mesh bar;
    std::vector<Mesh> shapes;
};

Bend bend_of(double degrees, Index frames) {
    Bend bend{make_bar({}), {}};
    Deformer deformer(bend.bar, Region::all(bend.bar.shared_topology()));
    deformer.add_handle(bend.bar.region("bottom"));
    const HandleId top = deformer.add_handle(bend.bar.region("top"));
    for (Index f = 0; f <= frames; ++f) {
        deformer.set_transform(top, rotation(Vec3::UnitZ(), degrees * kPi / 180.0 * f / frames,
                                             deformer.handle(top).center));
        deformer.solve();
        Mesh shape = bend.bar;
        deformer.apply_to(shape);
        bend.shapes.push_back(std::move(shape));
    }
    return bend;
}

SkinnedMesh skin_of(const Bend& bend, const SkinOptions& options) {
    SkinBaker baker(bend.bar, Region::all(bend.bar.shared_topology()), options);
    for (std::size_t f = 0; f < bend.shapes.size(); ++f) {
        baker.add(static_cast<double>(f) / 10.0, bend.shapes[f]);
    }
    return baker.finish();
}

}  // namespace

TEST_CASE("a skin fitted to a bend is read back from its file and poses within the error told") {
    const Bend bend = bend_of(90.0, 6);
    double before = 1.0;
    for (const Index joints : {2, 4, 8}) {
        CAPTURE(joints);
        const SkinnedMesh skinned = skin_of(bend, {.joints = joints});
        const double size = surface_radius(bend.bar);
        MESSAGE("joints ", joints, ": greatest ", skinned.max_error / size, " rms ",
                skinned.rms_error / size);
        CHECK(skinned.joint_count == joints);
        CHECK(skinned.max_error < 0.1 * size);
        CHECK(skinned.rms_error < 0.5 * before * size);
        before = skinned.rms_error / size;
        const std::string bytes = encode_mesh(skinned.mesh, "glb");
        const SkinFile file(bytes);
        const Mesh back = decode_mesh(bytes, "glb", {.weld = Weld::none});
        REQUIRE(back.vertex_count() == bend.bar.vertex_count());
        double greatest = 0.0;
        for (std::size_t f = 0; f < bend.shapes.size(); ++f) {
            const std::vector<Vec3> points = posed(back, file.maps(f));
            for (Index v = 0; v < back.vertex_count(); ++v) {
                greatest = std::max(greatest, (points[at(v)] - bend.shapes[f].position(v)).norm());
            }
        }
        CHECK(greatest == doctest::Approx(skinned.max_error).epsilon(1e-3));
    }
    CHECK(before < 0.004);
}

TEST_CASE("vertices follow at most as many joints as asked, and those around the region none") {
    const Bend bend = bend_of(60.0, 3);
    for (const Index influences : {1, 2, 5}) {
        const SkinnedMesh skinned = skin_of(bend, {.joints = 6, .influences = influences});
        const Attribute& weights = *skinned.mesh.attributes().find("weights");
        CHECK(weights.width == (influences > 4 ? 8 : 4));
        for (Index v = 0; v < bend.bar.vertex_count(); ++v) {
            const auto row = weights.at(v);
            CHECK(std::count_if(row.begin(), row.end(), [](double w) { return w > 0.0; }) <=
                  influences);
        }
    }
    // The lower half stays.
    std::vector<Index> upper;
    for (Index v = 0; v < bend.bar.vertex_count(); ++v) {
        if (bend.bar.position(v).y() > bounds(bend.bar).center().y()) upper.push_back(v);
    }
    const Region moving(bend.bar.shared_topology(), upper);
    SkinBaker baker(bend.bar, moving, {.joints = 5});
    baker.add(0.0, bend.shapes.back());
    const SkinnedMesh part = baker.finish();
    for (Index v = 0; v < bend.bar.vertex_count(); ++v) {
        if (moving.contains(v)) continue;
        CHECK(part.mesh.attributes().find("joints")->at(v)[0] == 0.0);
        CHECK(part.mesh.attributes().find("weights")->at(v)[0] == 1.0);
    }
}

TEST_CASE("skins refuse options out of range, times that go back and other meshes") {
    const Bend bend = bend_of(30.0, 1);
    const Region all = Region::all(bend.bar.shared_topology());
    CHECK(error_of([&] { skin_of(bend, {.joints = 0}); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { skin_of(bend, {.joints = 251}); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { skin_of(bend, {.influences = 9}); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(error_of([&] { SkinBaker(bend.bar, all).finish(); }).code() ==
          ErrorCode::invalid_argument);
    SkinBaker baker(bend.bar, all);
    baker.add(1.0, bend.bar);
    CHECK(error_of([&] { baker.add(1.0, bend.bar); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { baker.add(2.0, make_box()); }).code() == ErrorCode::topology_mismatch);
}

TEST_CASE("skins do not depend on the number of threads") {
    const Bend bend = bend_of(90.0, 3);
    std::vector<double> before;
    for (const int threads : {1, 3}) {
        ContextOptions options;
        options.threads = threads;
        SkinBaker baker(bend.bar, Region::all(bend.bar.shared_topology()), {}, Context(options));
        for (std::size_t f = 0; f < bend.shapes.size(); ++f) {
            baker.add(static_cast<double>(f), bend.shapes[f]);
        }
        const std::vector<double> weights =
            baker.finish().mesh.attributes().find("weights")->values;
        if (!before.empty()) CHECK(weights == before);
        before = weights;
    }
}
