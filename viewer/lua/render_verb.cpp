#include "viewer/lua/render_verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>

#include "bindings/cli/batch/files/files_verb.h"
#include "bindings/cli/json.h"
#include "bindings/cli/scene_input.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/strand_file.h"
#include "kernel/io/stream/file.h"
#include "viewer/lua/paint.h"
#include "viewer/lua/png_file.h"
#include "viewer/render/draw/scene_drawing.h"

namespace lissom::cli {
namespace {

struct Request {
    FilesVerb many{"render"};
    std::vector<std::string> files;
    std::string out, size = "1280x960", view = "three-quarter", up = "y", shading = "smooth",
                     fit = "all";
    std::string region, scalars, color = "clay", background = "white";
    std::vector<std::string> handles;
    std::vector<double> camera, range;
    double fov = 30.0, ortho = 0.0, crease = 50.0;
    MeshStyle style;
    Picture picture;
    bool no_legend = false, is_style_given = false;
};

bool read_size(const std::string& text, int& width, int& height) {
    int used = 0;
    const bool read = std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) == 2;
    return read && used == count_of(text) && width > 0 && height > 0;
}

// Checks for the command line: returns the defect of a word, or nothing.
std::string check_size(const std::string& text) {
    int width = 0, height = 0;
    return read_size(text, width, height) ? "" : "a size is written as 1280x960";
}

std::string check_color(const std::string& text) {
    try {
        parse_color(text);
    } catch (const Error& error) {
        return error.message();
    }
    return "";
}

std::string check_mesh_color(const std::string& text) {
    try {
        MeshStyle style;
        paint_mesh(style, text);
    } catch (const Error& error) {
        return error.message();
    }
    return "";
}

std::string check_background(const std::string& text) {
    return text == "transparent" ? "" : check_color(text);
}

void declare_view(CLI::App& app, Request& request) {
    app.add_option("--size", request.size, "Width and height in pixels (default: 1280x960)")
        ->check(check_size);
    app.add_option("--view", request.view, "The side to look from (default: three-quarter)")
        ->check(
            CLI::IsMember({"front", "back", "left", "right", "top", "bottom", "three-quarter"}));
    app.add_option("--up", request.up, "The axis that points up (default: y)")
        ->check(CLI::IsMember({"y", "z"}));
    auto* parallel =
        app.add_flag("--parallel", request.picture.framing.ortho, "A view without perspective");
    auto* camera =
        app.add_option("--camera", request.camera,
                       "X,Y,Z,X,Y,Z: position and target of the camera, instead of --view")
            ->delimiter(',')
            ->expected(6)
            ->excludes("--view")
            ->excludes(parallel);
    auto* fov =
        app.add_option("--fov", request.fov, "Vertical opening angle in degrees (default: 30)")
            ->check(CLI::Range(1.0, 170.0))
            ->excludes(parallel);
    app.add_option("--ortho", request.ortho,
                   "Height that a camera without perspective sees, in mesh units")
        ->check(CLI::PositiveNumber)
        ->needs(camera)
        ->excludes(fov);
}

void declare_content(CLI::App& app, Request& request) {
    MeshStyle& style = request.style;
    app.add_option("--shading", request.shading, "smooth or flat (default: smooth)")
        ->check(CLI::IsMember({"smooth", "flat"}));
    app.add_option("--crease", request.crease,
                   "Angle in degrees above which smooth shading keeps an edge (default: 50)")
        ->check(CLI::Range(0.0, 180.0));
    app.add_flag("--wire", style.wire, "Draw the edges of the faces");
    app.add_option("--color", request.color,
                   "Colour of the meshes; #rrggbbaa: seen through (default: clay)")
        ->check(check_mesh_color);
    app.add_option("--region", request.region, "Name of a region to draw in blue");
    app.add_option("--handles", request.handles, "Names of regions to draw in purple");
    app.add_flag("--boundaries", style.boundaries, "Draw the open boundaries in colours");
    auto* scalars =
        app.add_option("--scalars", request.scalars,
                       "Name of an attribute of the vertices to draw in the colours of a scale");
    app.add_option("--range", request.range, "LOW,HIGH: the ends of the scale")
        ->delimiter(',')
        ->expected(2)
        ->needs(scalars);
    app.add_flag("--no-legend", request.no_legend, "Leave out the scale's legend")->needs(scalars);
    auto* columns = app.add_option("--columns", request.picture.columns,
                                   "Draw each mesh in a cell of its own, so many a row")
                        ->check(CLI::PositiveNumber);
    app.add_option("--fit", request.fit,
                   "In cells, frame all meshes at one scale or each by itself (default: all)")
        ->check(CLI::IsMember({"all", "each"}))
        ->needs(columns);
}

void declare_quality(CLI::App& app, Request& request) {
    RenderOptions& options = request.picture.options;
    app.add_option("--background", request.background, "A colour, or transparent (default: white)")
        ->check(check_background);
    app.add_option("--samples", options.samples, "Samples a pixel along edges (default: 4)");
    app.add_option("--supersample", options.supersample,
                   "Draw larger by this factor and average (default: 1)")
        ->check(CLI::Range(1, 4));
    app.add_option("--occlusion", options.occlusion, "Darkness of folds, 0 to 1 (default: 1)")
        ->check(CLI::Range(0.0, 1.0));
}

Camera placed_camera(const Request& request) {
    CameraOptions options;
    const std::vector<double>& c = request.camera;
    options.eye = Vec3(c[0], c[1], c[2]);
    options.target = Vec3(c[3], c[4], c[5]);
    options.up = request.up == "y" ? Vec3::UnitY() : Vec3::UnitZ();
    options.fov = request.fov * kDegree;
    if (request.ortho > 0.0) options.ortho = request.ortho;
    return Camera(options);
}

// Sets the options that do not depend on the meshes.
void options_of(Request& request) {
    Picture& picture = request.picture;
    read_size(request.size, picture.options.width, picture.options.height);
    picture.view = *find_view(request.view);
    picture.framing.up = request.up == "y" ? ViewUp::y : ViewUp::z;
    picture.framing.fov = request.fov * kDegree;
    if (!request.camera.empty()) picture.camera = placed_camera(request);
    if (!request.range.empty()) picture.range = ValueRange{request.range[0], request.range[1]};
    picture.legend = !request.no_legend;
    picture.fit_each = request.fit == "each";
    picture.options.background = request.background == "transparent"
                                     ? std::nullopt
                                     : std::optional<Color>(parse_color(request.background));
    paint_mesh(request.style, request.color);
    request.style.shading = request.shading == "flat" ? Shading::flat : Shading::smooth;
    request.style.crease = request.crease * kDegree;
}

// Messages about a file begin with its name.
class FileNamedLog {
  public:
    explicit FileNamedLog(Program& program) : program_(program), before_(program.log_filter) {
        program.log_filter = [this](LogLevel level, std::string_view message) {
            if (before_ && !before_(level, message)) return false;
            if (file.empty() || level != LogLevel::warning) return true;
            program_.clear_progress();
            std::cerr << "warning: " << file << ": " << message << std::endl;
            return false;
        };
    }
    ~FileNamedLog() { program_.log_filter = before_; }
    FileNamedLog(const FileNamedLog&) = delete;
    FileNamedLog& operator=(const FileNamedLog&) = delete;

    std::string file;

  private:
    Program& program_;
    std::function<bool(LogLevel, std::string_view)> before_;
};

void add_scene(Request& request, const std::string& path, const Context& context) {
    SceneDrawing drawing = drawing_of(read_scene_list(path, context));
    Picture& picture = request.picture;
    for (DrawnMesh& mesh : drawing.meshes) {
        if (request.is_style_given) mesh.style = request.style;
        picture.meshes.push_back(std::move(mesh));
    }
    for (DrawnStrands& strands : drawing.strands) {
        picture.strands.push_back({std::move(strands), std::nullopt});
    }
    auto& marks = picture.marks;
    std::move(drawing.lines.begin(), drawing.lines.end(), std::back_inserter(marks.lines));
    marks.points.insert(marks.points.end(), drawing.points.begin(), drawing.points.end());
}

void add_file(Request& request, const std::string& path, const Context& context) {
    if (is_scene_path(path)) return add_scene(request, path, context);
    if (is_hair_path(path)) {
        auto strands = std::make_shared<const Strands>(load_strands(path, {}, context));
        request.picture.strands.push_back({{std::move(strands), {}, {}}, std::nullopt});
        return;
    }
    request.picture.meshes.push_back(
        {std::make_shared<const Mesh>(load_mesh(path, {}, context)), request.style});
}

void add_files(Program& program, Request& request) {
    FileNamedLog log(program);
    for (const std::string& path : request.files) {
        log.file = path;
        add_file(request, path, program.context());
    }
    log.file.clear();
    if (!request.region.empty()) paint_region(request.picture, request.region);
    for (const std::string& name : request.handles) paint_handle(request.picture, name);
    if (!request.scalars.empty()) paint_values(request.picture, request.scalars);
}

void declare(CLI::App& app, Request& request) {
    app.add_option(
        "FILE", request.files,
        "Mesh files, hair files (.hair, .data, .usda, .tfx) and scenes (.lissom) to draw");
    app.add_option("-o,--out", request.out,
                   "The picture to write, a .png file; with --in a folder, which gets a picture "
                   "NAME.png of each file, and a page of all")
        ->required();
    declare_view(app, request);
    declare_content(app, request);
    declare_quality(app, request);
    request.many.declare(app);
}

// Returns the defect of the choice of files; empty if there is none.
std::string misuse(const CLI::App& app, const Request& request) {
    const std::string wrong = request.many.misuse(app, request.files);
    if (!wrong.empty()) return wrong;
    if (request.many.is_for_many()) return request.files.empty() ? "" : "FILE goes without --in";
    if (request.files.empty()) return "FILE is required";
    if (std::filesystem::path(request.out).has_extension()) return "";
    return "the picture " + request.out +
           " needs the extension .png; --in draws each file into a " +
           "folder, as --in 'models/*.obj' -o " + request.out;
}

int render_many(Program& program, const CLI::App& app, Request& request) {
    request.many.files.out_folder = request.out;
    request.many.files.extension = "png";
    request.many.files.adds_extension = true;
    return request.many.run(program, app, {"--out"}, "out",
                            {{"drawn"}, {number_column("width", 6), number_column("height", 6)}});
}

int render_one(Program& program, const CLI::App& app, Request& request) {
    require_picture_path(request.out);
    make_folder(std::filesystem::path(request.out).parent_path());
    options_of(request);
    request.is_style_given = app.count("--shading") + app.count("--color") + app.count("--wire") +
                                 app.count("--crease") + app.count("--boundaries") >
                             0;
    add_files(program, request);
    Renderer renderer;
    const Image image = draw_picture(renderer, request.picture, program.context());
    save_picture(image, request.out, program.context());
    program.clear_progress();
    if (program.json()) {
        program.answer(json_text({{"file", request.out},
                                  {"width", image.width},
                                  {"height", image.height},
                                  {"driver", renderer.driver()}}));
    }
    return kSuccess;
}

}  // namespace

int render(Program& program, const std::vector<std::string>& words) {
    CLI::App app(
        "Draws meshes, hair and scenes.\n\n"
        "  lissom render FILE... -o PICTURE                 all in one picture\n"
        "  lissom render --in 'a/**/*.obj' -o FOLDER        a picture of each, and a page of all",
        "lissom render");
    Request request;
    declare(app, request);
    int status = kSuccess;
    if (!request.many.parse(program, app, words, status)) return status;
    const std::string wrong = misuse(app, request);
    if (!wrong.empty()) {
        return program.fail("lissom render: " + wrong + " (see lissom render --help)", kUsage);
    }
    return request.many.is_for_many() ? render_many(program, app, request)
                                      : render_one(program, app, request);
}

}  // namespace lissom::cli
