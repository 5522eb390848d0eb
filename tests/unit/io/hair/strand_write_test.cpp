// Formats that are written only.
#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kernel/io/strand_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/strands/strand_support.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands two_strands() {
    return strands_of({{{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}}, {{1, 0, 0}, {1, 0.25, 0}}});
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// A RIB file as a list of requests, each a name and what follows it up to the next.
class RibFile {
  public:
    explicit RibFile(const std::string& text) {
        std::istringstream stream(text);
        std::string word;
        for (std::string row; std::getline(stream, row);) {
            if (row.starts_with("##")) continue;
            std::istringstream words(row);
            while (words >> word) {
                const char first = word.front();
                if (first >= 'A' && first <= 'Z') {
                    requests_.push_back({word, {}});
                } else if (!requests_.empty()) {
                    requests_.back().second.push_back(word);
                }
            }
        }
    }

    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& [name, words] : requests_) result.push_back(name);
        return result;
    }

    // The numbers behind a word of the first request of this name.
    std::vector<double> numbers(const std::string& name, const std::string& behind = "") const {
        for (const auto& [request, words] : requests_) {
            if (request != name) continue;
            auto at =
                behind.empty() ? words.begin() : std::find(words.begin(), words.end(), behind);
            std::vector<double> result;
            for (; at != words.end(); ++at) {
                if (*at == "]") break;
                if (*at != "[" && at->front() != '"') result.push_back(std::stod(*at));
            }
            return result;
        }
        return {};
    }

    std::vector<Vec3> points(const std::string& name) const {
        const std::vector<double> all = numbers(name, "\"P\"");
        std::vector<Vec3> result;
        for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
            result.emplace_back(all[i], all[i + 1], all[i + 2]);
        }
        return result;
    }

    // Where a renderer draws a point (RenderMan Interface 3.2, section 4).
    Vec2 pixel(const Vec3& p) const {
        const std::vector<double> m = numbers("ConcatTransform"), window = numbers("ScreenWindow"),
                                  format = numbers("Format"),
                                  fov = numbers("Projection", "\"fov\"");
        Vec3 c;
        for (std::size_t k = 0; k < 3; ++k) {
            c[static_cast<Index>(k)] =
                p.x() * m[k] + p.y() * m[4 + k] + p.z() * m[8 + k] + m[12 + k];
        }
        const double scale = 1.0 / (c.z() * std::tan(0.5 * fov[0] * kPi / 180.0));
        return {(c.x() * scale - window[0]) / (window[1] - window[0]) * format[0],
                (window[3] - c.y() * scale) / (window[3] - window[2]) * format[1]};
    }

  private:
    std::vector<std::pair<std::string, std::vector<std::string>>> requests_;
};

template <typename T>
T number_at(const std::string& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
}

}  // namespace

TEST_CASE("OBJ has a vertex a point and a line a strand") {
    Strands strands = two_strands();
    CHECK(
        encode_strands(strands, "obj").bytes ==
        "# 2 strands of hair\nv 0 0 0\nv 0 0.5 0\nv 0 1 0\nv 1 0 0\nv 1 0.25 0\nl 1 2 3\nl 4 5\n");
    strands.set_groups({kNoIndex, 0}, {"fringe"});
    CHECK(holds(encode_strands(strands, "obj").bytes, "l 1 2 3\ng fringe\nl 4 5\n"));
}

TEST_CASE("progress grows from 0 to 1 while strands are saved, and they can be cancelled") {
    const TemporaryFolder folder;
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (Index s = 0; s < 4000; ++s) {
        for (int k = 0; k < 25; ++k) {
            points.insert(points.end(), {0.001f * static_cast<float>(s), 0.01f * k, 0.0f});
        }
        offsets.push_back(offsets.back() + 25);
    }
    const Strands strands(std::move(points), std::move(offsets));
    for (const char* name :
         {"a.usda", "a.hair", "a.data", "a.tfx", "a.ply", "a.rib", "a.glb", "a.obj"}) {
        CAPTURE(name);
        std::vector<double> fractions;
        ContextOptions options;
        options.progress = [&](std::string_view, double fraction) {
            fractions.push_back(fraction);
        };
        save_strands(strands, folder / name, {}, Context(options));
        CHECK(fractions.size() > 4);
        CHECK(std::is_sorted(fractions.begin(), fractions.end()));
        CHECK(fractions.front() == 0.0);
        CHECK(fractions.back() == doctest::Approx(1.0));
        Context* running = nullptr;
        ContextOptions stopping;
        stopping.progress = [&](std::string_view, double fraction) {
            if (running && fraction > 0.5) running->cancel();
        };
        Context context(stopping);
        running = &context;
        CHECK(error_of([&] { save_strands(strands, folder / "b.usda", {}, context); }).code() ==
              ErrorCode::cancelled);
        CHECK_FALSE(std::filesystem::exists(folder / "b.usda"));
    }
}

TEST_CASE("RIB has linear curves with diameters") {
    Strands strands = two_strands();
    const std::string plain = encode_strands(strands, "rib").bytes;
    CHECK(holds(plain,
                "Curves \"linear\" [ 3 2 ]\n\"nonperiodic\" \"P\" [ 0 0 0 0 0.5 0 0 1 0 1 0 0 1 "
                "0.25 0 ]\n"));
    CHECK(holds(plain, "\"constantwidth\" [ 7.5e-05 ]"));
    StrandWidths widths;
    widths.common = 2.0f;
    widths.profile = {1.0f, 0.5f};
    strands.set_widths(widths);
    strands.set_groups({0, 1}, {"a \"b\"", "c"});
    const std::string grouped = encode_strands(strands, "rib").bytes;
    CHECK(holds(grouped, "\"string name\" [\"a \\\"b\\\"\"]"));
    CHECK(holds(grouped, "\"width\" [ 2 1.5 1 ]"));
    CHECK(holds(grouped, "\"width\" [ 2 1 ]"));
}

TEST_CASE("RIB is a scene that a renderer makes the picture of alone") {
    const Strands strands = two_strands();
    const Mesh head = make_sphere({.radius = 40.0, .segments = 8});
    StrandSaveOptions options;
    RibScene scene;
    scene.head = &head;
    scene.unit = 0.01;
    scene.camera = CameraOptions{Vec3(0, 0, 300), Vec3(0, 20, 0), Vec3::UnitY(), 0.5};
    scene.width = 640;
    scene.height = 480;
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        options.up = up;
        options.unit = up == UpAxis::z ? 0.1 : 1.0;
        const RibFile file(encode_rib(strands, scene, options).bytes);
        // The parts, in the order in which a renderer needs them.
        const std::vector<std::string> names = file.names();
        std::size_t at = 0;
        for (const char* name :
             {"Display", "Format", "ScreenWindow", "Projection", "ConcatTransform", "WorldBegin",
              "LightSource", "AttributeBegin", "Surface", "PointsPolygons", "AttributeEnd",
              "Surface", "AttributeBegin", "Curves", "AttributeEnd", "WorldEnd"}) {
            CAPTURE(name);
            const auto found =
                std::find(names.begin() + static_cast<std::ptrdiff_t>(at), names.end(), name);
            REQUIRE(found != names.end());
            at = static_cast<std::size_t>(found - names.begin()) + 1;
        }
        // Head and hair stand in the picture where our own camera has them.
        const Camera camera(*scene.camera);
        const PictureSize size{640, 480};
        const auto heads = file.points("PointsPolygons");
        REQUIRE(heads.size() == static_cast<std::size_t>(head.vertex_count()));
        for (Index v = 0; v < head.vertex_count(); ++v) {
            const Vec3 pixel = camera.project(head.position(v), size);
            CHECK((file.pixel(heads[static_cast<std::size_t>(v)]) - pixel.head<2>()).norm() < 0.01);
        }
        const auto hairs = file.points("Curves");
        REQUIRE(hairs.size() == 5);
        for (std::size_t i = 0; i < 5; ++i) {
            const Vec3 place(strands.points()[3 * i], strands.points()[3 * i + 1],
                             strands.points()[3 * i + 2]);
            const Vec3 pixel = camera.project(100.0 * place, size);
            CHECK((file.pixel(hairs[i]) - pixel.head<2>()).norm() < 0.01);
        }
    }
}

TEST_CASE("the usual camera of a RIB scene sees all of hair and head") {
    const Mesh head = make_sphere({.radius = 2.0, .segments = 8});
    RibScene scene;
    scene.head = &head;
    const RibFile file(encode_rib(two_strands(), scene).bytes);
    for (const char* name : {"PointsPolygons", "Curves"}) {
        for (const Vec3& p : file.points(name)) {
            const Vec2 pixel = file.pixel(p);
            CHECK((pixel.array() > 0.0).all());
            CHECK((pixel.array() < 800.0).all());
        }
    }
    CHECK(holds(encode_strands({}, "rib").bytes, "WorldEnd"));
}

TEST_CASE("a RIB archive is curves alone; other formats refuse a scene") {
    const Mesh head = make_sphere({.radius = 2.0, .segments = 8});
    RibScene scene;
    scene.archive = true;
    const std::string bytes = encode_rib(two_strands(), scene).bytes;
    CHECK_FALSE(holds(bytes, "WorldBegin"));
    CHECK_FALSE(holds(bytes, "Surface"));
    CHECK(holds(bytes, "Curves"));
    const auto refused = [&] {
        return error_of([&] { encode_rib(two_strands(), scene); }).code() ==
               ErrorCode::invalid_argument;
    };
    scene.head = &head;
    CHECK(refused());
    scene.archive = false;
    CHECK_FALSE(holds(encode_rib(two_strands(), scene).bytes, "nan"));
    CHECK(error_of([&] { save_rib(two_strands(), "nowhere.usda", scene); }).code() ==
          ErrorCode::invalid_argument);
    scene.width = 0;
    CHECK(refused());
    CHECK(holds(encode_strands(two_strands(), "rib").bytes, "WorldBegin"));
}

TEST_CASE("RIB has colours of strands or points") {
    Strands strands = two_strands();
    strands.set_colors({Eigen::Vector3f(1, 0, 0)});
    CHECK(holds(encode_strands(strands, "rib").bytes, "Color [ 1 0 0 ]"));
    strands.set_colors({Eigen::Vector3f::Zero(), StrandDomain::strand, {{1, 0, 0}, {0, 1, 0}}});
    CHECK(holds(encode_strands(strands, "rib").bytes, "\"uniform color Cs\" [ 1 0 0 0 1 0 ]"));
}

TEST_CASE("glTF has one LINES primitive with 32-bit indices") {
    const auto json = nlohmann::json::parse(encode_strands(two_strands(), "gltf").bytes);
    REQUIRE(json["meshes"].size() == 1);
    REQUIRE(json["meshes"][0]["primitives"].size() == 1);
    const auto& primitive = json["meshes"][0]["primitives"][0];
    CHECK(primitive["mode"] == 1);
    const auto& positions = json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    CHECK(positions["count"] == 5);
    CHECK(positions["min"] == nlohmann::json({0.0, 0.0, 0.0}));
    CHECK(positions["max"] == nlohmann::json({1.0, 1.0, 0.0}));
    const auto& indices = json["accessors"][primitive["indices"].get<int>()];
    CHECK(indices["componentType"] == 5125);
    CHECK(indices["count"] == 6);
}

TEST_CASE("GLB holds the points and the ends of all segments") {
    Strands strands = two_strands();
    strands.set_colors({Eigen::Vector3f(2.0f, 0.5f, 0.0f)});
    const std::string bytes = encode_strands(strands, "glb").bytes;
    const auto json_size = number_at<std::uint32_t>(bytes, 12);
    const auto json = nlohmann::json::parse(bytes.substr(20, json_size));
    const std::string binary = bytes.substr(20 + json_size + 8);
    const auto data_of = [&](int accessor) {
        const auto& view =
            json["bufferViews"][json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"]
                                    .get<std::size_t>()];
        return binary.substr(view["byteOffset"].get<std::size_t>(),
                             view["byteLength"].get<std::size_t>());
    };
    const auto& primitive = json["meshes"][0]["primitives"][0];
    const std::string points = data_of(primitive["attributes"]["POSITION"].get<int>());
    REQUIRE(points.size() == strands.points().size_bytes());
    CHECK(std::memcmp(points.data(), strands.points().data(), points.size()) == 0);
    const std::string lines = data_of(primitive["indices"].get<int>());
    std::vector<std::uint32_t> ends;
    for (std::size_t i = 0; i < lines.size(); i += 4)
        ends.push_back(number_at<std::uint32_t>(lines, i));
    CHECK(ends == std::vector<std::uint32_t>{0, 1, 1, 2, 3, 4});
    const std::string colors = data_of(primitive["attributes"]["COLOR_0"].get<int>());
    CHECK(number_at<float>(colors, 0) == 1.0f);
    CHECK(number_at<float>(colors, 4) == 0.5f);
}
