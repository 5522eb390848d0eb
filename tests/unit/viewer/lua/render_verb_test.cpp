#include "viewer/lua/render_verb.h"

#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

#include "kernel/io/mesh_file.h"
#include "kernel/io/strand_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/scene_file.h"
#include "tests/unit/viewer/picture_folder.h"

namespace lissom::cli {
namespace {

using test::PictureFolder;

ProgramParts parts_with_render() {
    ProgramParts parts = kernel_parts();
    parts.verbs.push_back({"render", "", "", render});
    return parts;
}

struct Ended {
    int status;
    std::string out, err;
};

// Runs the program in this process with its streams caught.
Ended run(std::vector<std::string> words) {
    words.insert(words.begin(), {"lissom", "render"});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    std::ostringstream out, err;
    std::streambuf* const old_out = std::cout.rdbuf(out.rdbuf());
    std::streambuf* const old_err = std::cerr.rdbuf(err.rdbuf());
    const int status = run_program(static_cast<int>(argv.size()), argv.data(), parts_with_render());
    std::cout.rdbuf(old_out);
    std::cerr.rdbuf(old_err);
    return {status, out.str(), err.str()};
}

std::string box_in(const PictureFolder& folder) {
    BoxOptions options;
    options.size = {1.0, 2.0, 3.0};
    save_mesh(make_box(options), folder.path("box.obj"));
    return folder.path("box.obj");
}

TEST_CASE("render draws a mesh file into a picture of the size") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    const std::string box = box_in(folder), out = folder.path("p.png");
    const Ended ended = run({box, "-o", out, "--size", "64x48", "--view", "front", "--json"});
    CHECK(ended.status == kSuccess);
    CHECK(ended.out.find("\"width\": 64") != std::string::npos);
    CHECK(folder.read("p.png").starts_with("\x89PNG"));
    CHECK(folder.read("p.png").substr(18, 2) == std::string("\0\x40", 2));
}

TEST_CASE("options of render change the picture") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    const std::string box = box_in(folder), out = folder.path("p.png");
    const auto picture = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {box, "-o", out, "--size", "64x48"});
        CHECK(run(words).status == kSuccess);
        return folder.read("p.png");
    };
    const std::string plain = picture({});
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--view", "top"},
                                               {"--up", "z"},
                                               {"--parallel"},
                                               {"--fov", "60"},
                                               {"--camera", "-3,4,5,0,0,0"},
                                               {"--camera", "3,4,5,0,0,0", "--ortho", "2"},
                                               {"--crease", "180"},
                                               {"--wire"},
                                               {"--color", "red"},
                                               {"--background", "transparent"},
                                               {"--samples", "1"},
                                               {"--supersample", "2"}}) {
        CAPTURE(words.front());
        CHECK(picture(words) != plain);
    }
    CHECK(picture({"--shading", "flat"}) == plain);  // a box has sharp edges anyway
}

TEST_CASE("several files fill cells") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    const std::string box = box_in(folder), out = folder.path("p.png");
    CHECK(run({box, box, "-o", out, "--size", "64x32", "--columns", "2", "--fit", "each"}).status ==
          kSuccess);
}

TEST_CASE("render draws scenes and hair files, and says which file a message is about") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    const std::string box = box_in(folder), out = folder.path("p.png");
    Scene scene;
    scene.add("box", std::make_shared<MeshItem>(std::make_shared<Mesh>(load_mesh(box))));
    scene.add("hidden", std::make_shared<MeshItem>(std::make_shared<Mesh>(make_sphere({}))),
              {.visible = false});
    save_scene(scene, folder.path("a.lissom"));
    const std::vector<std::string> options{"-o", out, "--size", "64x48", "--view", "front"};
    const auto picture = [&](const std::string& file) {
        std::vector<std::string> words = options;
        words.push_back(file);
        const Ended ended = run(words);
        CHECK_MESSAGE(ended.status == kSuccess, ended.err);
        return folder.read("p.png");
    };
    CHECK(picture(folder.path("a.lissom")) == picture(box));
    save_strands(Strands({0, 0, 0, 0, 1, 0}, {0, 2}), folder.path("a.hair"));
    CHECK(picture(folder.path("a.hair")) != picture(box));
    std::ofstream(folder.path("bad.obj"))
        << "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::vector<std::string> words = options;
    words.insert(words.end(), {box, folder.path("bad.obj")});
    const Ended two = run(words);
    CHECK(two.err.find("bad.obj: 1 file not found") != std::string::npos);
    CHECK(two.err.find("box.obj: ") == std::string::npos);
}

TEST_CASE("wrong calls of render end with status 2, faults with status 1") {
    const PictureFolder folder;
    const std::string box = box_in(folder), out = folder.path("p.png");
    const auto status = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {box, "-o", out});
        return run(words).status;
    };
    CHECK(run({box}).status == kUsage);
    CHECK(run({"-o", out}).status == kUsage);
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--size", "12"},
                                               {"--size", "0x10"},
                                               {"--size", "10x10x"},
                                               {"--view", "side"},
                                               {"--color", "blau"},
                                               {"--camera", "1,2,3"},
                                               {"--camera", "1,2,3,0,0,0", "--view", "top"},
                                               {"--ortho", "2"},
                                               {"--range", "0,1"},
                                               {"--no-legend"},
                                               {"--fit", "each"},
                                               {"--supersample", "9"}}) {
        CAPTURE(words.front());
        CHECK(status(words) == kUsage);
    }
    CHECK(run({box, "-o", folder.path("p.jpg")}).status == kFailure);
    CHECK(run({folder.path("none.obj"), "-o", out}).status == kFailure);
    const Ended absent = run({box, "-o", out, "--region", "top_half"});
    CHECK(absent.status == kFailure);
    CHECK(absent.err.find("no region 'top_half'") != std::string::npos);
    CHECK(folder.names() == std::vector<std::string>{"box.obj"});
}

TEST_CASE("render draws a picture of each of many files, and a page") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    const std::string box = box_in(folder), out = folder.path("pictures");
    std::filesystem::copy_file(box, folder.path("other box.obj"));
    std::ofstream(folder.path("bad.obj")) << "v 0 0 0\nf 1 2 3\n";
    const std::vector<std::string> words{
        "--in",  folder.path("*.obj"), "-o",           out,     "--size", "64x48", "--view",
        "front", "--camera",           "-3,4,5,0,0,0", "--json"};
    std::vector<std::string> without = words;
    without.erase(without.begin() + 6, without.begin() + 8);
    const Ended ended = run(without);
    CHECK(ended.status == kFailure);
    CHECK(ended.out.find("\"drawn\": 2") != std::string::npos);
    CHECK(ended.out.find("\"failed\": 1") != std::string::npos);
    CHECK(folder.read("pictures/box.obj.png").starts_with("\x89PNG"));
    CHECK(folder.read("pictures/box.obj.png") == folder.read("pictures/other box.obj.png"));
    CHECK(folder.read("pictures/index.html").find("other box.obj.png") != std::string::npos);
    const std::string single = folder.path("single.png");
    CHECK(run({box, "-o", single, "--size", "64x48", "--camera", "-3,4,5,0,0,0"}).status ==
          kSuccess);
    CHECK(folder.read("single.png") == folder.read("pictures/box.obj.png"));
    CHECK(run(without).out.find("\"kept\": 2") != std::string::npos);
    // An option that the jobs do not understand is told before they start.
    CHECK(run(words).status == kUsage);
    CHECK(run({box, "-o", single, "--jobs", "2"}).status == kUsage);
}

}  // namespace
}  // namespace lissom::cli

namespace lissom::test {

int run_tested_program(int argc, char** argv) {
    return cli::run_program(argc, argv, cli::parts_with_render());
}

}  // namespace lissom::test
