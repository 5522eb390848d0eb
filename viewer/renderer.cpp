#include "viewer/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "viewer/picture_drawer.h"
#include "viewer/strands/strand_layer.h"

namespace lissom {
namespace {

constexpr int kMaximumSupersample = 4;
// Radius of occlusion: a share of the drawing's RMS distance to its centre, and at most a share of
// the height that is seen.
constexpr double kOcclusionOfSize = 0.60;
constexpr double kOcclusionOfView = 0.20;

bool is_power_of_two(int n) {
    return n > 0 && (n & (n - 1)) == 0;
}

// Calls `visit` with every point of the drawing in the camera's world.
template <typename Visit>
void for_each_point(const Drawing& drawing, const std::vector<Vec3>& strand_corners,
                    const Visit& visit) {
    for (const DrawnMesh& drawn : drawing.meshes) {
        for (const Vec3& p : drawn.mesh->positions()) visit(drawn.transform(p));
    }
    for (const DrawnLine& line : drawing.lines) {
        for (const Vec3& p : line.points) visit(p);
    }
    for (const DrawnPoint& point : drawing.points) visit(point.position);
    for (const Vec3& p : strand_corners) visit(p);
}

// The corners of boxes around the strands: they hold all of their points that are finite.
std::vector<Vec3> corners_of(const std::vector<DrawnStrands>& strands) {
    std::vector<Vec3> corners;
    for (const DrawnStrands& drawn : strands) {
        const Box box = bounds(*drawn.strands);
        for (int i = 0; !box.empty() && i < 8; ++i) {
            const Vec3 corner(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                              i & 4 ? box.max.z() : box.min.z());
            corners.push_back(drawn.transform(corner / drawn.style.unit));
        }
    }
    return corners;
}

// Where a drawing is and how large.
struct Placement {
    Vec3 center = Vec3::Zero();
    /// RMS distance to the center.
    double size = 0.0;
};

Placement place(const Drawing& drawing, const std::vector<Vec3>& strand_corners) {
    Placement placement;
    double count = 0.0, square = 0.0;
    for_each_point(drawing, strand_corners, [&](const Vec3& p) {
        require(p.allFinite(), "a transform, line or point of the drawing is NaN or infinite",
                ErrorCode::not_finite);
        placement.center += p;
        ++count;
    });
    if (count == 0.0) return placement;
    placement.center /= count;
    for_each_point(drawing, strand_corners,
                   [&](const Vec3& p) { square += (p - placement.center).squaredNorm(); });
    placement.size = std::sqrt(square / count);
    return placement;
}

// Nearest and farthest depth.
std::pair<double, double> depths(const Drawing& drawing, const std::vector<Vec3>& strand_corners,
                                 const Camera& camera) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for_each_point(drawing, strand_corners, [&](const Vec3& p) {
        const double depth = camera.forward().dot(p - camera.eye());
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    });
    return {nearest, farthest};
}

// A camera without perspective sees the same from farther away: moves it to before everything.
Camera before_everything(const Camera& camera, double nearest, double farthest) {
    if (!camera.is_ortho() || nearest > farthest) return camera;
    CameraOptions options = camera.options();
    const double distance = farthest - nearest + *options.ortho;
    options.target = options.eye + nearest * camera.forward();
    options.eye = options.target - distance * camera.forward();
    return Camera(options);
}

ViewParameters view_parameters(const Drawing& drawing, const std::vector<Vec3>& strand_corners,
                               const Camera& given, double aspect, const Vec3& origin) {
    const auto [given_nearest, given_farthest] = depths(drawing, strand_corners, given);
    const Camera camera = before_everything(given, given_nearest, given_farthest);
    const auto [nearest, farthest] = depths(drawing, strand_corners, camera);
    const DepthRange range = fit_depth_range(nearest, farthest);
    const double half_height = camera.half_height(1.0);
    return {view_matrix(camera, origin), projection_matrix(camera, aspect, range),
            Vec2(aspect * half_height, half_height), !camera.is_ortho(), range.near};
}

std::size_t picture_bytes(const RenderOptions& options) {
    return 4 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
}

std::string text_of(GLenum name) {
    const GLubyte* const text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

int limit_of(GLenum name) {
    std::array<GLint, 2> values{};
    glGetIntegerv(name, values.data());
    return name == GL_MAX_VIEWPORT_DIMS ? std::min(values[0], values[1]) : values[0];
}

}  // namespace

// Everything that belongs to the context, and ends while it is current.
struct Renderer::State {
    explicit State(std::unique_ptr<Platform> given) : platform(std::move(given)) {
        const PlatformScope scope(*platform);
        driver = text_of(GL_RENDERER);
        maximum_size = std::min(limit_of(GL_MAX_VIEWPORT_DIMS), limit_of(GL_MAX_TEXTURE_SIZE));
        maximum_samples = limit_of(GL_MAX_SAMPLES);
        tools = std::make_unique<PictureTools>();
    }

    // The picture without strands, which `shadow` stands for.
    Image draw_meshes(const Drawing& drawing, const Vec3& origin, const ViewParameters& view,
                      const RenderOptions& options, double occlusion_radius,
                      const StrandShadow* shadow, const Context& context) const {
        Progress progress(context, "render");
        const PlatformScope scope(*platform);
        progress.step(0.3);
        GpuDrawing uploaded = upload(drawing, origin, context);
        uploaded.hair = upload_shade(shadow);
        progress.step(0.2);
        const PictureDrawer drawer(*tools, uploaded, view, options, occlusion_radius);
        progress.step(0.5);
        return drawer.draw(progress);
    }

    ~State() {
        try {
            const PlatformScope scope(*platform);
            tools.reset();
        } catch (const Error&) {
            // The context is in use elsewhere; what is in it ends with it.
        }
    }

    std::unique_ptr<Platform> platform;
    std::unique_ptr<PictureTools> tools;
    std::string driver;
    int maximum_size = 0, maximum_samples = 0;
};

Renderer::Renderer(std::unique_ptr<Platform> platform)
    : state_(std::make_unique<State>(std::move(platform))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const Drawing& drawing, const Camera& camera, const RenderOptions& options,
                       const Context& context) {
    require_valid(options);
    Progress progress(context, "render");
    const std::vector<Vec3> strand_corners = corners_of(drawing.strands);
    const Placement placement = place(drawing, strand_corners);
    const double aspect = static_cast<double>(options.width) / options.height;
    const ViewParameters view =
        view_parameters(drawing, strand_corners, camera, aspect, placement.center);
    const double depth = camera.forward().dot(placement.center - camera.eye());
    const double seen = 2.0 * camera.half_height(std::max(depth, view.near));
    const double radius = std::min(kOcclusionOfSize * placement.size, kOcclusionOfView * seen);

    const MemoryCharge charge = context.charge(picture_bytes(options), "the picture");
    if (drawing.strands.empty()) {
        progress.step(1.0);
        return state_->draw_meshes(drawing, placement.center, view, options, radius, nullptr,
                                   context);
    }
    progress.step(0.3);
    const StrandScene scene{view_strands(drawing, view.view, placement.center),
                            view_triangles(drawing, view.view, placement.center), view};
    const StrandShadow shadow(scene.strands, scene.triangles, context);
    progress.step(0.3);
    RenderOptions on_nothing = options;
    on_nothing.background = std::nullopt;
    const Image meshes =
        state_->draw_meshes(drawing, placement.center, view, on_nothing, radius, &shadow, context);
    progress.step(0.4);
    return lay_over(meshes, draw_strands(scene, shadow, options, context), options.background);
}

void Renderer::require_valid(const RenderOptions& options) const {
    require(options.width > 0 && options.height > 0,
            "the picture's size must be at least 1 x 1 pixels");
    require(options.width <= maximum_size() && options.height <= maximum_size(),
            "the picture is too large: this driver draws at most " +
                std::to_string(maximum_size()) + " pixels a side",
            ErrorCode::out_of_range);
    require(is_power_of_two(options.samples) && options.samples <= std::max(maximum_samples(), 1),
            "samples must be 1, 2, 4 ... and this driver has at most " +
                std::to_string(maximum_samples()),
            ErrorCode::out_of_range);
    require(options.supersample >= 1 && options.supersample <= kMaximumSupersample,
            "supersample must be 1 to " + std::to_string(kMaximumSupersample),
            ErrorCode::out_of_range);
    require(options.occlusion >= 0.0 && options.occlusion <= 1.0, "occlusion must be 0 to 1",
            ErrorCode::out_of_range);
}

int Renderer::maximum_size() const {
    return state_->maximum_size;
}
int Renderer::maximum_samples() const {
    return state_->maximum_samples;
}
const std::string& Renderer::driver() const {
    return state_->driver;
}

}  // namespace lissom
