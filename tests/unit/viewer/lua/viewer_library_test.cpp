#include "viewer/lua/viewer_library.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "bindings/lua/reference/reference.h"
#include "tests/unit/bindings/annotation_check.h"
#include "tests/unit/bindings/lua_state.h"
#include "tests/unit/viewer/picture_folder.h"

namespace lissom::lua {
namespace {

using test::PictureFolder;

HostOptions with_viewer() {
    auto registry = std::make_shared<Registry>(kernel_registry());
    registry->add(viewer_library());
    HostOptions options;
    options.registry = std::move(registry);
    return options;
}

std::string content(const std::string& name) {
    std::ifstream file(std::string(LISSOM_VIEWER_FOLDER) + "/" + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// What lissom.render returns for a small picture of a box with these options.
std::string render(test::LuaState& lua, const PictureFolder& folder, const std::string& options) {
    return lua.eval("lissom.render{ mesh = lissom.shapes.box(), size = { 32, 24 }, file = '" +
                    folder.path("picture.png") + "', " + options + " }");
}

TEST_CASE("every example of the viewer's table runs") {
    const Library library = viewer_library();
    std::vector<Function> functions = library.functions;
    for (const Type& type : library.types) {
        functions.insert(functions.end(), type.methods.begin(), type.methods.end());
    }
    for (const Function& function : functions) {
        CAPTURE(function.name);
        test::LuaState lua(with_viewer());
        CHECK(lua.run(function.example) == "");
    }
}

TEST_CASE("the viewer's annotations are those of its table") {
    const bool current = content("meta/lissom_viewer.lua") == annotations(viewer_library());
    CHECK_MESSAGE(current, "run the build target `reference` and look at what changed");
}

TEST_CASE("lua-language-server understands the viewer's annotations beside the kernel's") {
    const std::string kernel = annotations(kernel_library()), text = annotations(viewer_library());
    CHECK(text.starts_with("---@meta _\n"));
    std::set<std::string> types = test::declared_types(kernel);
    types.merge(test::declared_types(text));
    for (const std::string& mistake : test::annotation_mistakes(text, types)) {
        CHECK_MESSAGE(false, mistake);
    }
}

TEST_CASE("one reference has all that scripts can call, a page a type, with contents") {
    const std::vector<Page> pages = reference_pages(*with_viewer().registry);
    std::string index;
    std::set<std::string> files;
    for (const Page& page : pages) {
        CAPTURE(page.file);
        CHECK_MESSAGE(content("../docs/lua/" + page.file) == page.text,
                      "run the build target `reference` and look at what changed");
        CHECK(files.insert(page.file).second);
        if (page.file == "README.md") index = page.text;
    }
    for (const char* place : {"lissom.md#load", "lissom.md#render", "shapes.md#cactus", "mesh.md",
                              "camera.md", "tables.md", "codes.md"}) {
        CHECK_MESSAGE(index.find("](" + std::string(place) + ")") != std::string::npos, place);
    }
    const std::string folder = std::string(LISSOM_VIEWER_FOLDER) + "/../docs/lua";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        CHECK_MESSAGE(files.count(entry.path().filename().string()) == 1, entry.path());
    }
}

TEST_CASE("links within the reference lead to a place") {
    const std::vector<Page> pages = reference_pages(*with_viewer().registry);
    std::set<std::string> places;
    for (const Page& page : pages) {
        places.insert(page.file);
        for (std::size_t at = 0; (at = page.text.find("<a id=\"", at)) != std::string::npos; ++at) {
            const std::size_t begin = at + 7;
            const std::string id = page.text.substr(begin, page.text.find('"', begin) - begin);
            CHECK_MESSAGE(places.insert(page.file + "#" + id).second, page.file << "#" << id);
        }
    }
    for (const Page& page : pages) {
        for (std::size_t at = 0; (at = page.text.find("](", at)) != std::string::npos; ++at) {
            // Code is no link.
            Index fences = 0;
            for (std::size_t f = 0; (f = page.text.find("```", f)) < at; f += 3) ++fences;
            if (fences % 2 == 1) continue;
            std::string place = page.text.substr(at + 2, page.text.find(')', at) - at - 2);
            if (place.starts_with("#")) place = page.file + place;
            CHECK_MESSAGE(places.count(place) == 1, page.file << ": " << place);
        }
    }
}

TEST_CASE("scripts draw pictures, one after the other") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    test::LuaState lua(with_viewer());
    CHECK(render(lua, folder, "") == folder.path("picture.png"));
    const std::string first = folder.read("picture.png");
    CHECK(first.starts_with("\x89PNG"));
    CHECK(render(lua, folder, "view = 'front'") == folder.path("picture.png"));
    CHECK(folder.read("picture.png") != first);
    CHECK(render(lua, folder, "") == folder.path("picture.png"));
    CHECK(folder.read("picture.png") == first);
    CHECK(folder.names() == std::vector<std::string>{"picture.png"});
}

TEST_CASE("scripts draw hair, and every option of it changes the picture") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    test::LuaState lua(with_viewer());
    CHECK(lua.run(R"(
        local points, counts = {}, {}
        for i = 1, 400 do
            local x, z = (i * 0.618) % 1 - 0.5, (i * 0.755) % 1 - 0.5
            for k = 0, 8 do
                points[#points + 1] = { 0.1 * x + 0.002 * k * k * x, 0.05 + 0.01 * k, 0.1 * z }
            end
            counts[i] = 9
        end
        hair = lissom.strands{ points = points, counts = counts }:set_widths{ width = 0.001 }
        block = lissom.shapes.box{ size = 0.1 })") == "");
    const auto picture = [&](const std::string& options) {
        CHECK(lua.run("assert(lissom.render{ strands = hair, size = { 96, 72 }, file = '" +
                      folder.path("hair.png") + "', " + options + " })") == "");
        return folder.read("hair.png");
    };
    const std::string plain = picture("mesh = block");
    CHECK(picture("mesh = block") == plain);
    CHECK(picture("view = 'front'") != plain);
    CHECK(picture("mesh = block, hair = {}") == plain);
    for (const char* option :
         {"color = '#202020'", "level = 0.5", "count = 100", "unit = 1.1", "primary = 0",
          "primary_exponent = 10", "primary_shift = 30", "secondary = 0", "secondary_exponent = 3",
          "secondary_shift = 30", "shift_jitter = 40", "strand_tone = 0.5", "clump_tone = 0.5",
          "clump_size = 0.05", "root_tone = 0.2", "tip_tone = 2", "shadow = 0", "scalp_tint = 0"}) {
        CAPTURE(option);
        CHECK(picture("mesh = block, hair = { " + std::string(option) + " }") != plain);
    }
    const std::string gray = picture("mesh = block, color = '#cccccc'");
    CHECK(picture("mesh = block, color = '#ccccccff'") == gray);
    CHECK(picture("mesh = block, color = '#cccf'") == gray);
    const std::string open = picture("mesh = block, color = '#cccccc40'");
    CHECK(open != gray);
    CHECK(picture("mesh = block, color = '#cccccc80'") != open);
    CHECK(picture("meshes = { block, block }, offsets = { { -1, 0, 0 }, { 1, 0, 0 } }, "
                  "strands = { hair, hair }, columns = 2") != plain);
    const auto fails = [&](const std::string& options) {
        return lua.run("lissom.render{ file = 'x.png', " + options + " }");
    };
    CHECK(fails("mesh = block, strands = hair, hair = { colour = 'red' }").find("color") !=
          std::string::npos);
    CHECK(fails("mesh = block, hair = {}").find("'strands'") != std::string::npos);
    CHECK(fails("strands = hair, hair = { level = 0.5, count = 3 }").find("either") !=
          std::string::npos);
    CHECK(fails("").find("'strands'") != std::string::npos);
    CHECK(fails("meshes = { block, block }, strands = { hair, hair, hair }").find("3 strands") !=
          std::string::npos);
}

TEST_CASE("every option of a picture changes it") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    test::LuaState lua(with_viewer());
    CHECK(lua.run("mesh = lissom.shapes.cylinder{ caps = false, segments = 9, rings = 3 }\n"
                  "heights = {}\n"
                  "for i = 1, #mesh do heights[i] = select(2, mesh:position(i)) end") == "");
    const auto picture = [&](const std::string& options) {
        CHECK(lua.run("assert(lissom.render{ mesh = mesh, size = { 192, 144 }, file = '" +
                      folder.path("p.png") + "', " + options + " })") == "");
        return folder.read("p.png");
    };
    const std::string plain = picture("");
    for (const char* options :
         {"view = 'top'",
          "up = 'z'",
          "parallel = true",
          "margin = 0.2",
          "background = '#123456'",
          "background = 'transparent'",
          "samples = 1",
          "supersample = 2",
          "occlusion = 0",
          "offsets = { { 0.1, 0, 0 } }, camera = lissom.frame(mesh)",
          "color = 'red'",
          "color = { '#0f0' }",
          "shading = 'flat'",
          "crease = 10",
          "wire = true",
          "region = mesh:region('top'):grow(1)",
          "region = mesh:region{ all = true }",
          "regions = true",
          "regions = { 'top' }",
          "handles = { 'top' }",
          "handles = { mesh:region{ where = function(_, _, _, z) return z > 0.4 end } }",
          "boundaries = true",
          "paths = mesh:boundaries()",
          "points = { { 0, 0, 0.5 } }",
          "scalars = heights",
          "camera = lissom.camera{ eye = { 3, 0, 0 }, ortho = 3 }"}) {
        CAPTURE(std::string(options));
        const bool changed = picture(options) != plain;
        CHECK(changed);
    }
    const std::string wire = picture("wire = true");
    CHECK(picture("wire = true, wire_width = 3") != wire);
    const std::string scaled = picture("scalars = heights");
    CHECK(picture("scalars = heights, range = { 0, 9 }") != scaled);
    CHECK(picture("scalars = heights, legend = false") != scaled);
    CHECK(picture("scalars = heights, label = 'y'") != scaled);
    CHECK(picture("regions = true") != picture("regions = { 'top' }"));
    CHECK(picture("regions = false") == plain);
    CHECK(lua.run("lissom.render{ mesh = mesh, regions = { 'tip' }, file = 'no.png' }") != "");
    CHECK(picture("boundaries = true, line_width = 9") != picture("boundaries = true"));
}

TEST_CASE("attributes are drawn by name, and copies side by side share a region") {
    const PictureFolder folder;
    if (!test::can_draw()) return;
    test::LuaState lua(with_viewer());
    const std::string result = lua.eval(
        "(function()\n"
        "  local before = lissom.shapes.cactus{ vertices = 2000 }\n"
        "  before:add_attribute{ name = 'height', domain = 'vertex' }\n"
        "  local after = before:copy():transform{ scale = 0.9 }\n"
        "  return lissom.render{ meshes = { before, after }, columns = 2, scalars = 'height',\n"
        "      captions = { 'before', 'after' },\n"
        "      region = before:region('tip'), handles = { 'left_tip', 'right_tip' },\n"
        "      size = { 200, 60 }, file = '" +
        folder.path("pair.png") +
        "' }\n"
        "end)()");
    CHECK(result == folder.path("pair.png"));
}

TEST_CASE("one number is the size of a square picture") {
    const PictureFolder folder;
    test::LuaState lua(with_viewer());
    CHECK(lua.run("assert(lissom.render{ mesh = lissom.shapes.box(), size = 20, file = '" +
                  folder.path("square.png") + "' })") == "");
    CHECK(lua.eval("(function()\n"
                   "  local file = assert(io.open('" +
                   folder.path("square.png") +
                   "', 'rb'))\n"
                   "  local width, height = string.unpack('>I4I4', file:read(24), 17)\n"
                   "  file:close()\n"
                   "  return width .. ' ' .. height\n"
                   "end)()") == "20 20");
    CHECK(lua.run(
              "local mesh = lissom.shapes.box()\n"
              "local a = lissom.frame(mesh, { size = 20 })\n"
              "local b = lissom.frame(mesh, { size = { 20, 20 } })\n"
              "assert(a:project({ 0, 0.1, 0.2 }, 50) == b:project({ 0, 0.1, 0.2 }, { 50, 50 }))") ==
          "");
}

TEST_CASE("misuse is an error that names the option") {
    const PictureFolder folder;
    test::LuaState lua(with_viewer());
    const auto refuses = [&](const std::string& options, const std::string& text) {
        CAPTURE(options);
        CHECK(render(lua, folder, options).find(text) != std::string::npos);
        CHECK(folder.names().empty());
    };
    refuses("wier = true", "did you mean 'wire'?");
    refuses("view = 'frnt'", "did you mean \"front\"?");
    refuses("size = { 0, 10 }", "bad option 'size'");
    refuses("size = { 10 }", "bad option 'size'");
    refuses("size = 0", "bad option 'size'");
    refuses("size = 10.5", "bad option 'size'");
    refuses("meshes = { lissom.shapes.box() }", "bad option 'mesh'");
    refuses("camera = lissom.camera{ eye = { 1, 1, 1 } }, view = 'top'", "bad option 'view'");
    refuses("camera = lissom.camera{ eye = { 1, 1, 1 } }, margin = 0.1", "bad option 'margin'");
    refuses("range = { 0, 1 }", "bad option 'range'");
    refuses("legend = false", "bad option 'legend'");
    refuses("label = 'a'", "bad option 'label'");
    refuses("fit = 'each'", "bad option 'fit'");
    refuses("wire_width = 2", "bad option 'wire_width'");
    refuses("shading = 'flat', crease = 30", "bad option 'crease'");
    refuses("line_width = 2", "bad option 'line_width'");
    refuses("color = 'blau'", "is not a colour");
    refuses("color = '#12345g78'", "'#12345g78' is not a colour");
    refuses("color = '#123456g8'", "'#123456g8' is not a colour");
    refuses("region = 'lift'", "no region 'lift', did you mean 'left'?");
    refuses("region = lissom.shapes.box():region{ all = true }", "belongs to none of the meshes");
    refuses("scalars = 'height'", "no attribute 'height'");
    refuses("scalars = { 1, 2, 3 }", "3 values");
    refuses("offsets = {}", "0 offsets were given for 1 meshes");
    refuses("scalars = { 1, 2, 3, 4, 5, 6, 7, 8 }, range = { 1 }", "{low, high}");
}

TEST_CASE("a picture that cannot be drawn or written is an error with a code") {
    const PictureFolder folder;
    test::LuaState lua(with_viewer());
    const auto code = [&](const std::string& file, const std::string& mesh) {
        return lua.eval("select(2, lissom.try(lissom.render, { mesh = " + mesh + ", file = '" +
                        file + "', size = { 8, 8 } })).code");
    };
    CHECK(code(folder.path("p.jpg"), "lissom.shapes.box()") == "unknown_format");
    if (!test::can_draw()) return;
    CHECK(code(folder.path("none/p.png"), "lissom.shapes.box()") == "file_write_failed");
    CHECK(code(folder.path("p.png"), "lissom.mesh{ positions = { { 0, 0, 0 } }, faces = {} }") ==
          "mesh_empty");
    CHECK(folder.names().empty());
}

TEST_CASE("cameras are checked, and print themselves") {
    test::LuaState lua(with_viewer());
    const auto error = [&](const std::string& options) {
        return lua.run("lissom.camera{ " + options + " }");
    };
    CHECK(error("").find("'eye'") != std::string::npos);
    CHECK(error("eye = { 0, 0, 0 }").find("same point") != std::string::npos);
    CHECK(error("eye = { 0, 5, 0 }").find("up runs along its view") != std::string::npos);
    CHECK(error("eye = { 0, 5, 0 }, up = 'z'") == "");
    CHECK(error("eye = { 0, 0, 5 }, fov = 0").find("'fov'") != std::string::npos);
    CHECK(error("eye = { 0, 0, 5 }, fov = 40, ortho = 1").find("'ortho'") != std::string::npos);
    CHECK(lua.eval("tostring(lissom.camera{ eye = { 0, 0, 5 } })") ==
          "lissom.Camera (from 0, 0, 5 to 0, 0, 0; fov 30)");
    CHECK(lua.eval("lissom.camera{ eye = { 0, 0, 5 }, ortho = 2 }:ortho()") == "2.0");
}

}  // namespace
}  // namespace lissom::lua
