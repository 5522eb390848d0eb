// Real glTF files: all are read or refused with a code, and what is read is saved and read again.
#include "kernel/io/stream/file.h"
#include "tests/unit/io/gltf/support.h"

using namespace lissom;
using namespace lissom::test;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> gltf_files(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::optional<Mesh> loaded(const fs::path& path) {
    try {
        return load_mesh(path);
    } catch (const Error& error) {
        CHECK(error.code() != ErrorCode::internal);
        CHECK(error.message().starts_with(display_name(path)));
        return std::nullopt;
    }
}

// The same surface; vertices that repair split may stand elsewhere.
void check_same_surface(const Mesh& a, const Mesh& b) {
    CHECK(a.vertex_count() == b.vertex_count());
    CHECK(a.face_count() == b.face_count());
    for (const auto& entry : a.attributes().labels()) {
        CHECK(label_of_each_face(a, entry.first) == label_of_each_face(b, entry.first));
    }
    const bool is_cut = a.report().find(FindingKind::vertices_nonmanifold) != nullptr;
    if (is_cut || a.vertex_count() != b.vertex_count()) return;
    CHECK(a.topology().faces().vertices == b.topology().faces().vertices);
    double error = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        const double scale = std::max(1.0, a.position(v).norm());
        error = std::max(error, (a.position(v) - b.position(v)).norm() / scale);
    }
    CHECK(error < 1e-6);
}

int load_and_save_all(const fs::path& folder) {
    int count = 0;
    for (const fs::path& path : gltf_files(folder)) {
        CAPTURE(path.string());
        const std::optional<Mesh> mesh = loaded(path);
        if (!mesh) continue;
        ++count;
        check_same_surface(*mesh, round_trip(*mesh, "glb"));
    }
    return count;
}

}  // namespace

TEST_CASE("every real glTF file is read and saved again, or says why not") {
    const auto folder = data_file("gltf");
    if (!folder) return;
    CHECK(load_and_save_all(*folder) > 85);
}

TEST_CASE("every file of the validator's own tests is read or says why not") {
    const auto folder = data_file("gltf_validator");
    if (!folder) return;
    int count = 0;
    for (const fs::path& path : gltf_files(*folder)) {
        CAPTURE(path.string());
        if (const std::optional<Mesh> mesh = loaded(path)) {
            ++count;
            CHECK(!encode_mesh(*mesh, "glb").empty());
        }
    }
    CHECK(count > 80);
}

TEST_CASE("a skinned model keeps its textures, joints and animations") {
    const auto path = data_file("gltf/gthree_RobotExpressive.glb");
    if (!path) return;
    const Mesh mesh = load_mesh(*path);
    const std::string bytes = encode_mesh(mesh, "glb");
    const Mesh again = decode_mesh(bytes, "glb");
    CHECK(mesh.attributes().find("joints"));
    CHECK(again.attributes().find("morph.1.position"));
    const Json saved = json_of_glb(bytes), source = json_of_glb(read_bytes(*path));
    CHECK(saved["skins"].size() == source["skins"].size());
    CHECK(saved["animations"].size() == source["animations"].size());
    CHECK(saved["materials"] == source["materials"]);
    CHECK(saved["nodes"].size() == source["nodes"].size());
    CHECK(json_of_glb(encode_mesh(again, "glb"))["nodes"] == saved["nodes"]);
}
