// Hair bound to the joints of its head (UsdSkel): posed by the rules of USD, roots go where the
// rules of glTF put the skin below them.
#include <Eigen/Geometry>
#include <sstream>

#include "kernel/hair/follow/strand_roots.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/skinned_asset.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

using Matrix4 = Eigen::Matrix4d;

Matrix4 place_of(const Vec3& translation, double turn) {
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    map.translate(translation);
    map.rotate(Eigen::AngleAxisd(turn, Vec3(1, 2, 2).normalized()));
    return map.matrix();
}

std::vector<float> columns_of(const std::vector<Matrix4>& matrices) {
    std::vector<float> result;
    for (const Matrix4& m : matrices) {
        for (int i = 0; i < 16; ++i) result.push_back(static_cast<float>(m.data()[i]));
    }
    return result;
}

// "head" hangs on "a neck", but comes before it in the skin; bound elsewhere than they stand.
struct SkinnedSquare {
    Matrix4 neck = place_of(Vec3(0.5, -1, 0), 0.3), head = place_of(Vec3(0, 1.5, 0.25), -0.7);
    Matrix4 bind_neck = place_of(Vec3(0.25, -1, 0), 0.1), bind_head = place_of(Vec3(0, 1, 0), 0.9);
    GltfFile file;

    SkinnedSquare() {
        Json primitive = file.square_primitive();
        Json& attributes = primitive["attributes"];
        attributes["JOINTS_0"] = file.accessor<std::uint8_t>(
            {0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, kUnsignedByte, "VEC4");
        attributes["WEIGHTS_0"] =
            file.floats({.25, .75, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
        const int node = file.add_mesh(primitive);
        file.json["nodes"][node].update({{"name", "body"}, {"skin", 0}});
        file.json["nodes"].push_back({{"name", "a neck"}, {"children", {3}}});
        file.json["nodes"][1]["matrix"] = columns_of({neck});
        file.json["nodes"].push_back({{"name", "head"}, {"matrix", columns_of({head})}});
        // Between both a node that is no joint.
        file.json["nodes"].push_back({{"translation", {0, 0, 0.5}}, {"children", {2}}});
        file.json["skins"] = {
            {{"joints", {2, 1}},
             {"inverseBindMatrices",
              file.floats(columns_of({bind_head.inverse(), bind_neck.inverse()}), "MAT4")}}};
    }
};

// Strands with roots all over the square, whose unit is 2 cm.
constexpr double kUnit = 0.02;

Strands hair_on(const Mesh& mesh) {
    const std::vector<Eigen::Vector3f> weights = {
        {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.25f, 0.5f, 0.25f}, {0.5f, 0.125f, 0.375f}};
    StrandRoots roots;
    std::vector<std::vector<Vec3>> points;
    for (std::size_t i = 0; i < 2 * weights.size(); ++i) {
        roots.faces.push_back(static_cast<Index>(i % 2));
        roots.barycentrics.push_back(weights[i / 2]);
    }
    for (Index s = 0; s < count_of(roots.faces); ++s) {
        const Vec3 root = kUnit * *root_place(roots, s, mesh);
        points.push_back({root, root + Vec3(0, 0, 0.01), root + Vec3(0, 0.01, 0.02)});
    }
    Strands strands = strands_of(points);
    strands.set_roots(std::move(roots));
    return strands;
}

// The numbers of an attribute of a layer.
std::vector<double> numbers_of(const std::string& layer, const std::string& name) {
    const std::size_t begin = layer.find(name + " = [");
    REQUIRE(begin != std::string::npos);
    std::string list = layer.substr(begin + name.size() + 3);
    list.resize(list.find(']'));
    for (char& c : list) {
        if (c == '(' || c == ')' || c == ',' || c == '[') c = ' ';
    }
    std::istringstream in(list);
    return {std::istream_iterator<double>(in), {}};
}

// USD multiplies rows by matrices.
std::vector<Matrix4> matrices_of(const std::string& layer, const std::string& name) {
    std::vector<double> values = numbers_of(layer, name);
    std::vector<Matrix4> result;
    for (std::size_t i = 0; i + 16 <= values.size(); i += 16) {
        result.push_back(Eigen::Map<const Matrix4>(values.data() + i));
    }
    return result;
}

// Metres to the file.
Matrix4 frame_of(const StrandSaveOptions& options) {
    Matrix4 frame = Matrix4::Identity();
    if (options.up == UpAxis::z) frame.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    frame.topLeftCorner<3, 3>() /= options.unit;
    return frame;
}

Vec3 moved(const Matrix4& map, const Vec3& p) {
    return (map * p.homogeneous()).head<3>();
}

}  // namespace

TEST_CASE("a skeleton has the joints of the file, as they were bound and as they stand") {
    const SkinnedSquare square;
    const Mesh mesh = square.file.load();
    const auto* asset = dynamic_cast<const SkinnedAsset*>(mesh.asset().get());
    REQUIRE(asset);
    const Skeleton skeleton = asset->skeleton_of("body");
    CHECK(skeleton.names == std::vector<std::string>{"head", "a neck"});
    CHECK(skeleton.parents == std::vector<Index>{1, kNoIndex});
    CHECK((skeleton.bind[0].translation - Vec3(0, 1, 0)).norm() < 1e-6);
    CHECK((skeleton.bind[0].linear - square.bind_head.topLeftCorner<3, 3>()).norm() < 1e-6);
    CHECK((skeleton.rest[0].translation - Vec3(0, 1.5, 0.75)).norm() < 1e-6);
    CHECK((skeleton.rest[1].translation - Vec3(0.5, -1, 0)).norm() < 1e-6);
    CHECK(asset->skeleton_of("nobody").names.empty());
}

TEST_CASE("roots of hair bound to a head go with its skin, in every unit and up axis") {
    const SkinnedSquare square;
    const Mesh mesh = square.file.load();
    const Strands hair = hair_on(mesh);
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        for (const double unit : {1.0, 0.01}) {
            const StrandSaveOptions options{.up = up, .unit = unit, .head = &mesh};
            const std::string layer = encode_strands(hair, "usda", options).bytes;
            CAPTURE(layer);
            const auto bind = matrices_of(layer, "bindTransforms");
            const auto rest = matrices_of(layer, "restTransforms");
            REQUIRE(bind.size() == 2);
            REQUIRE(rest.size() == 2);
            // Both pictures pose the head, by a turn of its own after that of rest.
            const Matrix4 turn = place_of(Vec3::Zero(), 1.1);
            Matrix4 lift = Matrix4::Identity();
            lift(2, 3) = 0.5;
            const Matrix4 neck_now = square.neck,
                          head_now = square.neck * lift * square.head * turn;
            const Matrix4 frame = frame_of(options);
            const Matrix4 turn_in_file =
                frame * turn * frame.inverse();  // a rotation: without a scale
            const std::vector<Matrix4> now = {rest[0], rest[0] * rest[1] * turn_in_file};
            const auto joints = numbers_of(layer, "skel:jointIndices");
            const auto weights = numbers_of(layer, "skel:jointWeights");
            REQUIRE(joints.size() == 4 * static_cast<std::size_t>(hair.point_count()));
            REQUIRE(weights.size() == joints.size());
            for (Index s = 0; s < hair.size(); ++s) {
                const Vec3 root = moved(frame, hair.root(s).cast<double>());
                Vec3 by_usd = Vec3::Zero();
                double total = 0.0;
                for (std::size_t i = 0; i < 4; ++i) {
                    const std::size_t k = 4 * at(hair.first_point(s)) + i;
                    const auto joint = static_cast<std::size_t>(joints[k]);
                    by_usd += weights[k] * moved(now[joint] * bind[joint].inverse(), root);
                    total += weights[k];
                }
                CHECK(total == doctest::Approx(1.0));
                const auto triangle = *root_triangle(hair.roots(), s, mesh);
                Vec3 by_gltf = Vec3::Zero();
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto j = mesh.attributes().find("joints")->at(triangle[c]);
                    const auto w = mesh.attributes().find("weights")->at(triangle[c]);
                    const double share = hair.roots().barycentrics[at(s)][static_cast<Index>(c)];
                    for (std::size_t i = 0; i < w.size(); ++i) {
                        const Matrix4 map = j[i] == 0.0 ? head_now * square.bind_head.inverse()
                                                        : neck_now * square.bind_neck.inverse();
                        by_gltf += share * w[i] * moved(map, *root_place(hair.roots(), s, mesh));
                    }
                }
                CHECK((by_usd - moved(frame, kUnit * by_gltf)).norm() < 1e-6 / unit);
            }
        }
    }
}

TEST_CASE("hair bound to a head reads back as it was") {
    const SkinnedSquare square;
    const Mesh mesh = square.file.load();
    const Strands hair = hair_on(mesh);
    const std::string layer = encode_strands(hair, "usda", {.head = &mesh}).bytes;
    CHECK(layer.find("\"a_neck\", \"a_neck/head\"") != std::string::npos);
    CHECK(hash(decode_strands(layer, "usda")) == hash(hair));
}

TEST_CASE("hair is not bound to a head that it has no joints of") {
    const SkinnedSquare square;
    const Mesh mesh = square.file.load();
    const Strands hair = hair_on(mesh);
    const auto code = [](const Strands& strands, const Mesh& head, const char* format) {
        return error_of([&] { encode_strands(strands, format, {.head = &head}); }).code();
    };
    CHECK(code(hair, mesh, "hair") == ErrorCode::invalid_argument);
    Mesh bare = mesh;
    bare.attributes().remove("weights");
    CHECK(code(hair, bare, "usda") == ErrorCode::invalid_argument);
    Strands rootless = hair;
    rootless.set_roots({});
    CHECK(code(rootless, mesh, "usda") == ErrorCode::invalid_argument);
    Mesh weightless = mesh;
    for (double& w : weightless.attributes().find("weights")->at(2)) w = 0.0;
    const Error error = error_of([&] { encode_strands(hair, "usda", {.head = &weightless}); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(error.elements().count == 2);
    CHECK(error.message().starts_with("strands "));
}
