#include "viewer/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "viewer/render/scene_drawer.h"

namespace lissom {
namespace {

constexpr int kMaximumSupersample = 4;
bool is_power_of_two(int n) {
    return n > 0 && (n & (n - 1)) == 0;
}

// Pixels of the picture, and those of a tile as they are drawn: a driver without a graphics card
// takes them from the same memory.
std::size_t picture_bytes(const RenderOptions& options) {
    constexpr std::size_t kColor = 8, kDepth = 4, kOutput = 4, kTilePixels = 2048;
    const auto tile_side = [&](int side) {
        return std::min(at(side) * at(options.supersample), kTilePixels);
    };
    const std::size_t tile = tile_side(options.width) * tile_side(options.height);
    const std::size_t several = options.samples > 1 ? at(options.samples) : 0;
    return kOutput * at(options.width) * at(options.height) +
           tile * (several * (kColor + kDepth) + kColor + kDepth + kOutput);
}

double min_opacity(const Snapshot& snapshot) {
    double least = 1.0;
    for (const DrawnMesh& drawn : snapshot.meshes) {
        const double opacity = drawn.style.opacity;
        require(opacity >= 0.0 && opacity <= 1.0, "the opacity of a mesh must be 0 to 1",
                ErrorCode::out_of_range);
        least = std::min(least, opacity);
    }
    return least;
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
        tools = std::make_unique<SceneTools>();
    }

    ~State() {
        try {
            const PlatformScope scope(*platform);
            tools.reset();
        } catch (const Error&) {
            // The context is in use elsewhere; its objects end with it.
        }
    }

    std::unique_ptr<Platform> platform;
    std::unique_ptr<SceneTools> tools;
    std::string driver;
    int maximum_size = 0, maximum_samples = 0;
};

Renderer::Renderer(std::unique_ptr<Platform> platform)
    : state_(std::make_unique<State>(std::move(platform))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const Snapshot& snapshot, const Camera& camera, const RenderOptions& options,
                       const Context& context) {
    require_valid(options);
    const double opacity = min_opacity(snapshot);
    if (opacity == 1.0) return render_solid(snapshot, camera, options, context);
    Snapshot solid = snapshot, open = snapshot;
    solid.revision = open.revision = 0;
    for (DrawnMesh& drawn : solid.meshes) drawn.style.opacity = 1.0;
    std::erase_if(open.meshes, [](const DrawnMesh& drawn) { return drawn.style.opacity < 1.0; });
    const Image behind = render_solid(open, camera, options, context);
    return mixed(behind, render_solid(solid, camera, options, context), opacity);
}

Image Renderer::render_solid(const Snapshot& snapshot, const Camera& camera,
                             const RenderOptions& options, const Context& context) {
    Progress progress(context, "render");
    const MemoryCharge charge = context.charge(picture_bytes(options), "the picture");
    const PlatformScope scope(*state_->platform);
    GpuScene scene;
    progress.step(0.3);
    scene.update(snapshot, context);
    progress.step(0.7);
    return draw_scene(*state_->tools, scene, camera, options, context);
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
    require(options.mark_scale > 0.0 && std::isfinite(options.mark_scale),
            "mark_scale must be above 0", ErrorCode::out_of_range);
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
