#include "kernel/scene/scene_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/io/stream/file.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/file/part_archive.h"
#include "kernel/scene/hairstyle_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/strands_item.h"
#include "tests/unit/support.h"

using namespace lissom;
using lissom::test::error_of;

namespace {

// A bent bar in a scene, with two handles, one of them soft and of points.
struct BentScene {
    std::shared_ptr<Mesh> bar = std::make_shared<Mesh>(make_bar());
    std::shared_ptr<Deformer> edit;
    Scene scene;

    explicit BentScene(const DeformOptions& options = {}) {
        edit = std::make_shared<Deformer>(*bar, Region::all(bar->shared_topology()), options);
        edit->add_handle(*bar->find_region("bottom"));
        edit->remove_handle(edit->add_handle(*bar->find_region("top")));
        const HandleId top = edit->add_handle(*bar->find_region("top"), {.falloff = 0.1});
        const auto point = face_point(bar->topology(), 30, std::vector{0.4, 0.3, 0.2, 0.1});
        edit->add_handle(std::vector{point}, {.gradient = false, .weight = 3.0});
        edit->constrain(
            PointConstraint{face_point(bar->topology(), 60, std::vector{0.1, 0.2, 0.3, 0.4}),
                            Vec3(0.5, 0.0, 0.0), std::nullopt, 10.0});
        set_stiffness(*edit, *bar->find_region("top"), 4.0);
        edit->set_transform(top, rotation(Vec3::UnitZ(), 1.0, edit->handle(top).center));
        edit->solve();
        edit->apply_to(*bar);
        scene.add("bend", std::make_shared<DeformItem>(edit, std::make_shared<MeshItem>(bar)));
    }
};

std::shared_ptr<Mesh> labelled_grid() {
    auto mesh = std::make_shared<Mesh>(make_grid());
    mesh->attributes().add({"heat", Domain::vertex, 1, ScalarType::uint16,
                            std::vector<double>(at(mesh->vertex_count()), 0.5)});
    FaceLabels groups;
    groups.of_face.assign(at(mesh->face_count()), groups.add("half"));
    groups.of_face[0] = kNoIndex;
    mesh->attributes().labels()["group"] = groups;
    mesh->set_region("corner", Region(mesh->shared_topology(), {0, 1}));
    mesh->material_libraries() = {"a.mtl"};
    Report report;
    report.add({FindingKind::edges_nonmanifold, ElementKind::edge, true, 2, {1, 2, 3, 4}, "two"});
    mesh->set_report(report);
    return mesh;
}

Strands colored_strands() {
    Strands strands({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0}, {0, 2, 5});
    strands.set_groups({0, kNoIndex}, {"tail"});
    strands.set_ids({7, 9});
    strands.set_roots({{3, 4},
                       {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0)},
                       {Eigen::Vector2f(0.5f, 0.25f), Eigen::Vector2f(0, 1)},
                       {{4, 5, 6}, {5, 6, 7}}});
    strands.set_colors({Eigen::Vector3f::Zero(),
                        StrandDomain::strand,
                        {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, 1)}});
    strands.set_comment("two");
    return strands;
}

// A folder for one test.
struct SceneFolder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / "lissom_scene_folder";

    SceneFolder() { std::filesystem::remove_all(path); }
    ~SceneFolder() { std::filesystem::remove_all(path); }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
            if (entry.is_regular_file()) {
                names.push_back(entry.path().lexically_relative(path).generic_string());
            }
        }
        std::sort(names.begin(), names.end());
        return names;
    }
    std::string text(const std::string& name) const { return read_file(path / name).bytes; }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path / name, std::ios::binary) << bytes;
    }
};

// The scene again, through the bytes of a file and through a folder.
void reload(Scene& from, Scene& to) {
    ItemMaker maker;
    Scene other;
    SceneFolder folder;
    CHECK(save_scene(from, folder.path).empty());
    load_scene(folder.path, other, maker);
    CHECK(other.hash() == from.hash());
    const EncodedScene encoded = encode_scene(from);
    CHECK(encoded.left_out.empty());
    decode_scene(encoded.bytes, to, maker);
}

// Hashes of all states of a history, from its beginning to its end; the scene stays where it is.
std::vector<std::uint64_t> hashes_of(Scene& scene) {
    std::size_t undone = 0, redone = 0;
    while (scene.undo()) ++undone;
    std::vector<std::uint64_t> hashes{scene.hash()};
    while (scene.redo()) {
        hashes.push_back(scene.hash());
        ++redone;
    }
    for (; redone > undone; --redone) scene.undo();
    return hashes;
}

}  // namespace

TEST_CASE("scene file: meshes, strands and curves come back to the bit, with their looks") {
    Scene scene;
    const auto grid = labelled_grid();
    const ObjectId id = scene.add("grid", std::make_shared<MeshItem>(grid));
    scene.add("again", scene.object(id).item, {.transform = translation(Vec3(0.1, 0.2, 0.3))});
    scene.add("hair", std::make_shared<StrandsItem>(std::make_shared<Strands>(colored_strands())));
    scene.add("line",
              std::make_shared<PolylineItem>(std::make_shared<Polyline>(
                  Polyline{{Vec3(0.1, 1e-300, -0.0), Vec3(1.0 / 3.0, 2, 3)}, true})),
              {.visible = false, .style = {.color = Vec3(0.1, 0.2, 0.3), .line_width = 2.5}});
    Scene loaded;
    reload(scene, loaded);
    CHECK(loaded.hash() == scene.hash());
    CHECK(loaded.history().steps.empty());
    CHECK(loaded.find("grid")->item == loaded.find("again")->item);
    const auto& mesh = dynamic_cast<const MeshItem&>(*loaded.find("grid")->item).mesh();
    CHECK(mesh.report() == grid->report());
    CHECK(mesh.material_libraries() == grid->material_libraries());
}

TEST_CASE("scene file: a deformation goes on where it was") {
    BentScene b;
    Scene loaded;
    reload(b.scene, loaded);
    CHECK(loaded.hash() == b.scene.hash());
    auto& item = dynamic_cast<DeformItem&>(*loaded.find("bend")->item);
    auto& edit = const_cast<Deformer&>(item.deformer());
    CHECK(edit.positions() == b.edit->positions());
    CHECK(edit.handles() == b.edit->handles());
    edit.solve();
    b.edit->solve();
    CHECK(edit.positions() == b.edit->positions());
    edit.reset();
    CHECK(edit.positions() == rest_positions_of(*b.edit));
}

TEST_CASE("scene file: a new rest shape and a mesh with normals come back") {
    auto mesh = std::make_shared<Mesh>(make_cactus());
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (const Vec3& n : vertex_normals(*mesh)) {
        normals.values.insert(normals.values.end(), n.begin(), n.end());
    }
    mesh->attributes().add(normals);
    auto edit = std::make_shared<Deformer>(*mesh, Region::all(mesh->shared_topology()));
    edit->add_handle(*mesh->find_region("base"));
    const HandleId tip = edit->add_handle(*mesh->find_region("tip"));
    for (int turn = 0; turn < 2; ++turn) {
        edit->set_transform(tip, rotation(Vec3::UnitZ(), 0.5, edit->handle(tip).center));
        edit->solve();
        edit->apply_to(*mesh);
        if (turn == 0) edit->rebase();
    }
    Scene scene, loaded;
    scene.add("bend", std::make_shared<DeformItem>(edit, std::make_shared<MeshItem>(mesh)));
    reload(scene, loaded);
    CHECK(loaded.hash() == scene.hash());
    const auto& item = dynamic_cast<const DeformItem&>(*loaded.find("bend")->item);
    auto& again = const_cast<Deformer&>(item.deformer());
    const auto part = item.parts().front();
    Mesh one = *mesh, other = dynamic_cast<const MeshItem&>(*part).mesh();
    edit->reset();
    edit->apply_to(one);
    again.reset();
    again.apply_to(other);
    CHECK(hash(one) == hash(other));
}

TEST_CASE("scene file: a hairstyle grows the same hair again") {
    const auto head = std::make_shared<Mesh>(make_head());
    const auto head_item = std::make_shared<MeshItem>(head);
    HairstyleOptions options;
    options.resolution = 4000;
    const auto style =
        std::make_shared<Hairstyle>(*head, std::make_shared<const Scalp>(*head), options);
    DividingCurve parting{{{0.0, 0.14, 0.05}, {0.0, 0.15, 0.0}}};
    parting.options.left = {0.1, 0.7};
    style->remove(style->add({.shape = StreamCurve{.points = {{0.1, 0.1, 0}, {0.12, 0, 0}}}}));
    style->add({.shape = parting});
    style->add(
        {.shape = StreamCurve{.points = {{0.05, 0.12, 0.05}, {0.1, 0.05, 0.0}}}, .name = "side"});
    const HairOptions hair{.roots = {.count = 40}};
    const auto grown = [&](Scene& scene) {
        const auto& item = dynamic_cast<const HairstyleItem&>(*scene.find("style")->item);
        return hash(const_cast<Hairstyle&>(item.style()).grow(hair));
    };
    Scene scene, loaded;
    scene.add("style", std::make_shared<HairstyleItem>(style, head_item));
    SUBCASE("whose head is an object") {
        scene.add("head", head_item);
    }
    SUBCASE("whose head is none") {}
    reload(scene, loaded);
    CHECK(loaded.hash() == scene.hash());
    CHECK(grown(loaded) == grown(scene));
}

TEST_CASE("scene file: what has no place in a file is told") {
    BentScene b;
    b.bar->replace_by(subdivide(*b.bar, {}));
    const EncodedScene encoded = encode_scene(b.scene);
    CHECK(encoded.left_out.size() == 1);
    Scene loaded;
    ItemMaker maker;
    decode_scene(encoded.bytes, loaded, maker);
    CHECK(loaded.objects().empty());
}

TEST_CASE("scene file: a file that is cut short or damaged is refused, and the scene stays empty") {
    BentScene b;
    Scene small;
    small.add("line", std::make_shared<PolylineItem>(
                          std::make_shared<Polyline>(Polyline{{Vec3::Zero(), Vec3::Ones()}})));
    b.scene.add("hair",
                std::make_shared<StrandsItem>(std::make_shared<Strands>(colored_strands())));
    const std::string whole = encode_scene(small).bytes;
    ItemMaker maker;
    const auto code_of = [&](const std::string& bytes) {
        Scene scene;
        const Error error = error_of([&] { decode_scene(bytes, scene, maker); });
        CHECK(scene.objects().empty());
        CHECK(scene.depth() == 0);
        return error.code();
    };
    // The two empty records at the end say that nothing is missing: one is enough.
    for (std::size_t size = 0; size + 1024 < whole.size(); size += 37) {
        CHECK(code_of(whole.substr(0, size)) == ErrorCode::file_truncated);
    }
    CHECK(code_of(std::string(4096, 'x')) == ErrorCode::file_syntax);
    CHECK(code_of(std::string(4096, '\0')) == ErrorCode::file_truncated);

    // Random bytes never do worse than an error.
    const std::string rich = encode_scene(b.scene).bytes;
    std::mt19937 random(7);
    for (int trial = 0; trial < 300; ++trial) {
        std::string bytes = rich;
        const std::size_t manifest = bytes.rfind("\"format\"");
        for (int change = 0; change < 3; ++change) {
            const std::size_t begin = trial % 2 ? manifest : 0;
            bytes[begin + random() % (bytes.size() - begin)] = char(random());
        }
        Scene scene;
        try {
            decode_scene(bytes, scene, maker);
        } catch (const Error&) {
            CHECK(scene.objects().empty());
        }
    }
}

TEST_CASE("scene file: values that do not fit each other are refused") {
    Scene scene;
    scene.add("grid", std::make_shared<MeshItem>(labelled_grid()));
    const std::string bytes = encode_scene(scene).bytes;
    // The archive with one part replaced.
    const auto with_part = [&](const std::string& name, const std::string& content) {
        const PartReader parts(bytes);
        PartWriter next;
        for (const std::string part :
             {"items/0/positions", "items/0/offsets", "items/0/corners",
              "items/0/attributes/0/values", "items/0/labels/0/of_face",
              "items/0/regions/0/vertices", "items/0/report/0/ids", "scene.json"}) {
            next.add(part, part == name ? content : std::string(parts.find(part)));
        }
        return std::move(next).finish();
    };
    const auto refused = [&](const std::string& name, const std::string& content) {
        Scene loaded;
        ItemMaker maker;
        (void)error_of([&] { decode_scene(with_part(name, content), loaded, maker); });
        CHECK(loaded.objects().empty());
    };
    const std::string manifest(PartReader(bytes).find("scene.json"));
    const auto with_text = [&](const std::string& before, const std::string& after) {
        std::string text = manifest;
        REQUIRE(text.find(before) != std::string::npos);
        return text.replace(text.find(before), before.size(), after);
    };
    refused("items/0/positions", "");
    refused("items/0/positions", std::string(25, '\0'));
    refused("items/0/offsets", std::string(404, '\x7f'));
    refused("items/0/corners", std::string(1600, '\x7f'));
    refused("items/0/attributes/0/values", std::string(8, '\0'));
    refused("items/0/labels/0/of_face", std::string(400, '\x01'));
    refused("items/0/regions/0/vertices", std::string(4, '\x7f'));
    refused("scene.json", with_text("\"width\": 1", "\"width\": 2000000000"));
    refused("scene.json", with_text("\"width\": 1", "\"width\": -1"));
    refused("scene.json", with_text("\"item\": 0", "\"item\": 1"));
    refused("scene.json", with_text("\"item\": 0", "\"item\": -1"));
    refused("scene.json", with_text("\"item\": 0", "\"item\": \"../../etc/passwd\""));
    refused("scene.json", with_text("\"name\": \"grid\"", "\"name\": \"\""));
    refused("scene.json", std::string(100000, '['));
    Scene loaded;
    ItemMaker maker;
    const std::string newer =
        with_part("scene.json", with_text("\"version\": 1", "\"version\": 2"));
    CHECK(error_of([&] { decode_scene(newer, loaded, maker); }).code() == ErrorCode::unsupported);
}

TEST_CASE("scene file: saving replaces a file whole or not at all") {
    const auto folder = std::filesystem::temp_directory_path() / "lissom_scene_file_test";
    std::filesystem::create_directories(folder);
    const auto path = folder / "a.lissom";
    BentScene b;
    save_scene(b.scene, path);
    const std::uint64_t saved = b.scene.hash();
    b.scene.remove(b.scene.objects().front()->id);
    const Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { save_scene(b.scene, path, {}, cancelled); }).code() ==
          ErrorCode::cancelled);
    Scene loaded;
    ItemMaker maker;
    load_scene(path, loaded, maker);
    CHECK(loaded.hash() == saved);
    CHECK(error_of([&] { load_scene(path, loaded, maker); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { save_scene(b.scene, folder / "no" / "a.lissom"); }).code() ==
          ErrorCode::file_write_failed);
    Scene other;
    CHECK(error_of([&] { load_scene(folder / "b.lissom", other, maker); }).code() ==
          ErrorCode::file_not_found);
    std::filesystem::remove_all(folder);
}

TEST_CASE("scene file: NaN in texture coordinates changes neither hash nor history") {
    Scene scene;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto grid = std::make_shared<Mesh>(make_grid());
    for (const Domain domain : {Domain::vertex, Domain::corner}) {
        Attribute uv{domain == Domain::vertex ? "uv" : "uv2", domain, 2, ScalarType::float32, {}};
        uv.values.assign(at(2 * element_count(grid->topology(), domain)), 0.25);
        uv.values[3] = nan;
        uv.values[4] = -nan;
        grid->attributes().add(uv);
    }
    auto hair = std::make_shared<Strands>(colored_strands());
    StrandRoots roots = hair->roots();
    roots.uvs[0].x() = float(nan);
    hair->set_roots(roots);
    scene.add("grid", std::make_shared<MeshItem>(grid));
    scene.add("hair", std::make_shared<StrandsItem>(hair));
    const std::uint64_t before = scene.hash();
    Scene loaded;
    reload(scene, loaded);
    CHECK(scene.hash() == before);
    CHECK(loaded.hash() == before);
    CHECK(scene.history().steps.size() == 2);
    CHECK(loaded.history().steps.empty());
}

TEST_CASE("scene file: a folder has files to look at, named after the objects") {
    SceneFolder folder;
    Scene scene;
    scene.add("my grid/1", std::make_shared<MeshItem>(labelled_grid()));
    scene.add("My Grid_1", std::make_shared<MeshItem>(labelled_grid()));
    scene.add("hair", std::make_shared<StrandsItem>(std::make_shared<Strands>(colored_strands())));
    scene.set_parameters("deform", {{"falloff", 0.25}, {"mirror", true}, {"axis", "x"}});
    save_scene(scene, folder.path);
    const std::vector<std::string> files = folder.files();
    for (const char* name : {"scene.json", "my_grid/1.obj", "My_Grid_1.obj", "hair.obj"}) {
        CAPTURE(name);
        CHECK(std::find(files.begin(), files.end(), name) != files.end());
    }
    CHECK(folder.text("hair.obj").find("l 3 4 5\n") != std::string::npos);
    Scene loaded;
    ItemMaker maker;
    load_scene(folder.path, loaded, maker);
    CHECK(loaded.hash() == scene.hash());
    CHECK(loaded.parameters() == scene.parameters());
    Scene from_file;
    decode_scene(encode_scene(scene).bytes, from_file, maker);
    CHECK(from_file.parameters() == scene.parameters());
}

TEST_CASE("scene file: saving into a folder again leaves what is not its own") {
    SceneFolder folder;
    BentScene b;
    save_scene(b.scene, folder.path);
    folder.write("notes.txt", "mine");
    const std::uint64_t saved = b.scene.hash();
    const auto before = folder.files();
    // What stands in the way of a new file: nothing is written.
    folder.write("line.points.txt", "");
    folder.write("line", "a file of an artist");
    std::vector<Vec3> points(20, Vec3::Ones());
    b.scene.add("line", std::make_shared<PolylineItem>(
                            std::make_shared<Polyline>(Polyline{points, false})));
    const Error error = error_of([&] { save_scene(b.scene, folder.path); });
    CHECK(error.code() == ErrorCode::file_write_failed);
    CHECK(error.message().find("line") != std::string::npos);
    Scene old;
    ItemMaker maker;
    load_scene(folder.path, old, maker);
    CHECK(old.hash() == saved);
    std::filesystem::remove(folder.path / "line");
    std::filesystem::remove(folder.path / "line.points.txt");
    CHECK(folder.files() == before);
    save_scene(b.scene, folder.path);
    Scene loaded;
    load_scene(folder.path, loaded, maker);
    CHECK(loaded.hash() == b.scene.hash());
    b.scene.remove(b.scene.find("bend")->id);
    save_scene(b.scene, folder.path);
    CHECK(folder.files().size() == 3);
    CHECK(folder.text("notes.txt") == "mine");
}

TEST_CASE("scene file: a folder that is a file, and files that are no scene, are refused") {
    SceneFolder folder;
    BentScene b;
    std::ofstream(folder.path) << "a file";
    CHECK(error_of([&] { save_scene(b.scene, folder.path, {.form = SceneForm::folder}); }).code() ==
          ErrorCode::file_write_failed);
    CHECK(error_of([&] { save_scene(b.scene, folder.path / ""); }).code() ==
          ErrorCode::file_write_failed);
    CHECK(read_file(folder.path).bytes == "a file");
    std::filesystem::remove(folder.path);
    std::filesystem::create_directory(folder.path);
    Scene loaded;
    ItemMaker maker;
    CHECK(error_of([&] { load_scene(folder.path, loaded, maker); }).code() ==
          ErrorCode::file_is_directory);
    folder.write("scene.json", "{ \"mine\": 1 }");
    CHECK(error_of([&] { save_scene(b.scene, folder.path); }).code() ==
          ErrorCode::file_write_failed);
    CHECK(error_of([&] { load_scene(folder.path, loaded, maker); }).code() ==
          ErrorCode::file_syntax);
    CHECK(folder.files().size() == 1);
}

namespace {

// Calls visit(parent, key, path) for every value of `json` that has a key.
template <typename Visit>
void for_each_key(nlohmann::json& json, const Visit& visit) {
    if (json.is_array()) {
        for (nlohmann::json& one : json) for_each_key(one, visit);
    }
    if (!json.is_object()) return;
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    for (const std::string& key : keys) {
        for_each_key(json[key], visit);
        visit(json, key);
    }
}

}  // namespace

TEST_CASE("scene file: a value that is wrong is named by its key, and text by its line") {
    SceneFolder folder;
    BentScene b;
    b.scene.add("grid", std::make_shared<MeshItem>(labelled_grid()));
    b.scene.add("hair",
                std::make_shared<StrandsItem>(std::make_shared<Strands>(colored_strands())));
    save_scene(b.scene, folder.path);
    const std::string whole = folder.text("scene.json");
    const auto refusal = [&](const std::string& text) {
        folder.write("scene.json", text);
        Scene scene;
        ItemMaker maker;
        std::string message;
        try {
            load_scene(folder.path, scene, maker);
        } catch (const Error& error) {
            message = error.message();
        }
        return message;
    };
    nlohmann::json manifest = nlohmann::json::parse(whole);
    int refused = 0;
    for_each_key(manifest, [&](nlohmann::json& parent, const std::string& key) {
        const nlohmann::json kept = parent[key];
        for (const nlohmann::json& wrong : {nlohmann::json(nullptr), nlohmann::json(-7),
                                            nlohmann::json{{"odd", nlohmann::json::array({1})}}}) {
            parent[key] = wrong;
            const std::string message = refusal(manifest.dump(1));
            CAPTURE(message);
            // A format of another name is no scene, whose keys are unknown.
            CHECK((message.empty() || key == "format" || message.find(key) != std::string::npos ||
                   message.find("the scene's 'items/") != std::string::npos ||
                   message.find("the scene's 'objects/") != std::string::npos));
            refused += !message.empty();
        }
        parent[key] = kept;
    });
    CHECK(refused > 100);
    const std::size_t end = whole.find("\"items\"");
    CHECK(refusal(std::string(whole).insert(end, "}")).find("line ") != std::string::npos);
    CHECK(refusal(whole) == "");
}

TEST_CASE("scene file: parts of a folder that are missing or cut short are named") {
    SceneFolder folder;
    BentScene b;
    b.scene.add("grid", std::make_shared<MeshItem>(labelled_grid()));
    b.scene.add("hair",
                std::make_shared<StrandsItem>(std::make_shared<Strands>(colored_strands())));
    b.scene.step("turn", [&] { transform(*b.bar, translation(Vec3(1, 2, 3))); });
    save_scene(b.scene, folder.path, {.history = true});
    ItemMaker maker;
    const auto refused = [&](const std::string& name) {
        Scene scene;
        const Error error = error_of([&] { load_scene(folder.path, scene, maker); });
        CAPTURE(name);
        CAPTURE(error.message());
        CHECK(error.message().find(name) != std::string::npos);
        CHECK(scene.objects().empty());
        CHECK(scene.parameters().empty());
        return error.code();
    };
    for (const std::string& name : folder.files()) {
        const std::string whole = folder.text(name);
        std::filesystem::remove(folder.path / name);
        if (name == "history.tar") {
            Scene scene;
            load_scene(folder.path, scene, maker);
            CHECK(scene.hash() == b.scene.hash());
            CHECK(scene.history().steps.empty());
        } else {
            refused(name == "scene.json" ? "scene.json" : name);
        }
        for (const double part : {0.0, 0.3, 0.7, 1.0}) {
            const std::size_t size =
                part < 1.0 ? std::size_t(part * double(whole.size())) : whole.size() - 2;
            folder.write(name, whole.substr(0, size));
            const ErrorCode code =
                name == "history.tar" && part == 1.0 ? ErrorCode::file_truncated : refused(name);
            CHECK((code == ErrorCode::file_truncated || code == ErrorCode::file_empty ||
                   code == ErrorCode::file_syntax));
        }
        folder.write(name, whole);
    }
    std::string manifest = folder.text("scene.json");
    const std::string version = "\"version\": 1";
    REQUIRE(manifest.find(version) != std::string::npos);
    folder.write("scene.json", std::string(manifest).replace(manifest.find(version), version.size(),
                                                             "\"version\": 2"));
    CHECK(refused("scene.json") == ErrorCode::unsupported);
    const std::string model = "\"grid.obj\"";
    folder.write("scene.json", std::string(manifest).replace(manifest.rfind(model), model.size(),
                                                             "\"../../etc/passwd\""));
    CHECK(refused("scene.json") == ErrorCode::unsafe_path);
    folder.write("scene.json", manifest);
    std::string grid = folder.text("grid.obj");
    folder.write("grid.obj", grid.replace(grid.rfind("f "), 3, "f 9999"));
    CHECK(refused("grid.obj") == ErrorCode::face_index);
}

TEST_CASE("scene file: a folder edited by hand is loaded as it is, without its history") {
    SceneFolder folder;
    Scene scene;
    auto grid = std::make_shared<Mesh>(make_grid());
    scene.add("grid", std::make_shared<MeshItem>(grid));
    save_scene(scene, folder.path, {.history = true});
    std::string text = folder.text("grid.obj");
    const std::size_t line = text.find("\nv ") + 1;
    text.replace(line, text.find('\n', line) - line, "v 7 8 9");
    folder.write("grid.obj", text);
    Scene loaded;
    ItemMaker maker;
    load_scene(folder.path, loaded, maker);
    const auto& item = dynamic_cast<const MeshItem&>(*loaded.find("grid")->item);
    CHECK(item.mesh().position(0) == Vec3(7, 8, 9));
    CHECK(loaded.history().steps.empty());
}

TEST_CASE("scene file: a history is undone and done again to the same hashes") {
    BentScene b;
    auto& scene = b.scene;
    const auto head = std::make_shared<Mesh>(make_head());
    const auto head_item = std::make_shared<MeshItem>(head);
    HairstyleOptions options;
    options.resolution = 4000;
    const auto style =
        std::make_shared<Hairstyle>(*head, std::make_shared<const Scalp>(*head), options);
    scene.add("head", head_item);
    scene.add("style", std::make_shared<HairstyleItem>(style, head_item));
    scene.step("curve", [&] {
        style->add({.shape = StreamCurve{.points = {{0.1, 0.1, 0}, {0.12, 0, 0}}}});
    });
    auto hair = std::make_shared<Strands>(colored_strands());
    scene.add("hair", std::make_shared<StrandsItem>(hair));
    scene.step("pull", [&] { hair->edit_points()[3] = 0.125f; });
    const auto top = HandleId{2};
    for (int i = 0; i < 4; ++i) {
        scene.step("turn", [&] {
            b.edit->set_transform(top,
                                  rotation(Vec3::UnitZ(), 0.2 * i, b.edit->handle(top).center));
            b.edit->solve();
            b.edit->apply_to(*b.bar);
        });
        if (i == 1) scene.step("rest", [&] { b.edit->rebase(); });
    }
    scene.rename(scene.find("hair")->id, "wig");
    scene.step("face", [&] {
        head->replace_by(subdivide(*head, {}));
        scene.set_look(scene.find("head")->id, {.visible = false});
    });
    scene.remove(scene.find("wig")->id);
    scene.reorder(scene.find("style")->id, 0);
    for (int i = 0; i < 3; ++i) scene.undo();
    const std::uint64_t present = scene.hash();
    const auto hashes = hashes_of(scene);
    const HistoryReport history = scene.history();
    REQUIRE(hashes.size() == history.steps.size() + 1);

    ItemMaker maker;
    SceneFolder folder;
    const auto same = [&](Scene& loaded) {
        CHECK(loaded.hash() == present);
        CHECK(loaded.history().place == history.place);
        CHECK(loaded.find("wig")->id.value == scene.find("wig")->id.value);
        CHECK(hashes_of(loaded) == hashes);
        CHECK(loaded.hash() == present);
        for (std::size_t i = 0; i < history.steps.size(); ++i) {
            CHECK(loaded.history().steps[i].name == history.steps[i].name);
        }
        // The live objects go on.
        const auto& item = dynamic_cast<const DeformItem&>(*loaded.find("bend")->item);
        auto& edit = const_cast<Deformer&>(item.deformer());
        edit.solve();
        b.edit->solve();
        CHECK(edit.positions() == b.edit->positions());
        loaded.undo();
    };
    const EncodedScene encoded = encode_scene(scene, {.history = true});
    const std::size_t plain = encode_scene(scene).bytes.size();
    CHECK(encoded.left_out.empty());
    save_scene(scene, folder.path, {.history = true});
    Scene from_file, from_folder, again, without({.history_bytes = 0});
    decode_scene(encoded.bytes, from_file, maker);
    load_scene(folder.path, from_folder, maker);
    decode_scene(encode_scene(from_file, {.history = true}).bytes, again, maker);
    for (Scene* loaded : {&from_file, &from_folder, &again}) same(*loaded);
    decode_scene(encoded.bytes, without, maker);
    CHECK(without.hash() == present);
    CHECK(without.history().steps.empty());

    // What steps have in common is written once.
    for (int i = 0; i < 20; ++i) {
        scene.step("nudge", [&] { hair->edit_points()[0] += 1.0f; });
    }
    CHECK(encode_scene(scene, {.history = true}).bytes.size() < 6 * plain);
    scene.begin("open");
    CHECK(error_of([&] { (void)encode_scene(scene, {.history = true}); }).code() ==
          ErrorCode::invalid_argument);
    scene.rollback();
}

TEST_CASE("scene file: a damaged history is refused, and the scene stays empty") {
    BentScene b;
    for (int i = 0; i < 3; ++i) {
        b.scene.step("turn", [&] {
            b.edit->set_transform(HandleId{2}, translation(Vec3(0.0, 0.1 * i, 0.0)));
            b.edit->solve();
            b.edit->apply_to(*b.bar);
        });
    }
    const std::string whole = encode_scene(b.scene, {.history = true}).bytes;
    const std::size_t part = whole.find("\"lissom history\"");
    ItemMaker maker;
    std::mt19937 random(11);
    for (int trial = 0; trial < 60; ++trial) {
        std::string bytes = whole;
        bytes[part + random() % 4000] = char(random());
        Scene loaded;
        try {
            decode_scene(bytes, loaded, maker);
        } catch (const Error&) {
            CHECK(loaded.objects().empty());
            CHECK(loaded.history().steps.empty());
        }
    }
}

TEST_CASE("scene file: steps of a history that have no place in it are left out and told") {
    BentScene b;
    b.scene.clear_history();
    b.scene.step("refine", [&] { b.bar->replace_by(subdivide(*b.bar, {})); });
    b.scene.remove(b.scene.find("bend")->id);
    auto line = std::make_shared<Polyline>(Polyline{{Vec3::Zero(), Vec3::Ones()}, false});
    b.scene.add("line", std::make_shared<PolylineItem>(line));
    Scene loaded;
    ItemMaker maker;
    // The steps themselves have a place: the deformation is as it was in the step before.
    const EncodedScene whole = encode_scene(b.scene, {.history = true});
    CHECK(whole.left_out.empty());
    b.scene.undo();
    b.scene.undo();
    b.edit->set_transform(HandleId{0}, translation(Vec3(0, 0.1, 0)));
    b.scene.remove(b.scene.find("bend")->id);
    b.scene.add("line", std::make_shared<PolylineItem>(line));
    const EncodedScene encoded = encode_scene(b.scene, {.history = true});
    REQUIRE(encoded.left_out.size() == 1);
    CHECK(encoded.left_out[0].find("steps of the history") != std::string::npos);
    decode_scene(encoded.bytes, loaded, maker);
    CHECK(loaded.hash() == b.scene.hash());
    CHECK(loaded.history().steps.size() == 1);
}
