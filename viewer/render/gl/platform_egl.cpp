#include <dlfcn.h>
#define EGL_NO_X11
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <optional>
#include <string_view>

#include "kernel/core/error.h"
#include "viewer/render/gl/platform.h"

namespace lissom {
namespace {

constexpr int kGlVersion = 33;

[[noreturn]] void throw_no_display(const std::string& message) {
    throw Error(ErrorCode::no_display, message);
}

bool can_load(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (void* library = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
            dlclose(library);
            return true;
        }
    }
    return false;
}

void require_library(const std::vector<std::string>& names, std::string_view package) {
    if (can_load(names)) return;
    throw_no_display("pictures need " + names.front() + ", which is not on this machine; install " +
                     std::string(package) +
                     " (on Debian: apt-get install libegl1 libgl1 libgl1-mesa-dri). Everything "
                     "else works without it");
}

// A display to try, and its name.
struct Candidate {
    EGLDisplay display;
    std::string name;
};

bool has_client_extension(const char* name) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

void add_devices(std::vector<Candidate>& candidates) {
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (!eglQueryDevicesEXT(16, devices, &count)) return;
    for (EGLint i = 0; i < count; ++i) {
        candidates.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr),
             "device " + std::to_string(i)});
    }
}

// In the order in which they are tried.
std::vector<Candidate> list_displays() {
    std::vector<Candidate> candidates;
    if (has_client_extension("EGL_EXT_platform_base")) {
        if (has_client_extension("EGL_MESA_platform_surfaceless")) {
            candidates.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                           EGL_DEFAULT_DISPLAY, nullptr),
                                  "surfaceless"});
        }
        const bool lists_devices = has_client_extension("EGL_EXT_device_base") ||
                                   has_client_extension("EGL_EXT_device_enumeration");
        if (lists_devices && has_client_extension("EGL_EXT_platform_device")) {
            add_devices(candidates);
        }
    }
    candidates.push_back({eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display"});
    return candidates;
}

// Current context of a thread.
struct Current {
    EGLenum api = eglQueryAPI();
    EGLDisplay display = eglGetCurrentDisplay();
    EGLSurface draw = eglGetCurrentSurface(EGL_DRAW);
    EGLSurface read = eglGetCurrentSurface(EGL_READ);
    EGLContext context = eglGetCurrentContext();
};

class EglPlatform : public Platform {
  public:
    // Takes the first display on which a context can be made current.
    EglPlatform() {
        std::string reasons;
        for (const Candidate& candidate : list_displays()) {
            const std::optional<std::string> reason = open(candidate.display);
            if (!reason) return;
            close();
            reasons += (reasons.empty() ? "" : "; ") + candidate.name + ": " + *reason;
        }
        throw_no_display("no OpenGL 3.3 context can be made on this machine (" + reasons +
                         "); install a driver (on Debian: apt-get install libgl1-mesa-dri, which "
                         "draws without a graphics card)");
    }
    ~EglPlatform() override { close(); }

    void enter() override {
        before_.emplace();
        eglBindAPI(EGL_OPENGL_API);
        if (!eglMakeCurrent(display_, surface_, surface_, context_)) {
            leave();
            throw_no_display("the OpenGL context is in use on another thread");
        }
    }

    void leave() noexcept override {
        if (!before_) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglBindAPI(before_->api);
        if (before_->context != EGL_NO_CONTEXT) {
            eglMakeCurrent(before_->display, before_->draw, before_->read, before_->context);
        }
        before_.reset();
    }

  private:
    // Why no context could be made on `display`, or nothing.
    std::optional<std::string> open(EGLDisplay display) {
        EGLint major = 0, minor = 0;
        display_ = display;
        if (display == EGL_NO_DISPLAY) return "not offered";
        if (!eglInitialize(display, &major, &minor)) return "does not start";
        const Current before;
        if (!eglBindAPI(EGL_OPENGL_API)) return "has no OpenGL";
        std::optional<std::string> reason = make_context();
        eglBindAPI(before.api);
        if (reason) return reason;
        return check_context();
    }

    std::optional<std::string> make_context() {
        const EGLint wanted[] = {EGL_SURFACE_TYPE,
                                 EGL_PBUFFER_BIT,
                                 EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_BIT,
                                 EGL_RED_SIZE,
                                 8,
                                 EGL_GREEN_SIZE,
                                 8,
                                 EGL_BLUE_SIZE,
                                 8,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        const bool found = eglChooseConfig(display_, wanted, &config, 1, &count) && count > 0;
        const bool surfaceless = epoxy_has_egl_extension(display_, "EGL_KHR_surfaceless_context");
        if (!found && !surfaceless) return "has no pixel format to draw in";
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION_KHR,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                  EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
        if (context_ == EGL_NO_CONTEXT) return "refuses an OpenGL 3.3 core context";
        if (surfaceless) return std::nullopt;
        const EGLint one_pixel[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface_ = eglCreatePbufferSurface(display_, config, one_pixel);
        if (surface_ == EGL_NO_SURFACE) return "refuses a surface";
        return std::nullopt;
    }

    std::optional<std::string> check_context() {
        try {
            const PlatformScope scope(*this);
            if (epoxy_gl_version() < kGlVersion) return "offers an older OpenGL than 3.3";
        } catch (const Error&) {
            return "does not let its context be used";
        }
        return std::nullopt;
    }

    void close() {
        if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        surface_ = EGL_NO_SURFACE;
        context_ = EGL_NO_CONTEXT;
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
    std::optional<Current> before_;
};

}  // namespace

std::unique_ptr<Platform> make_egl_platform(const EglLibraries& libraries) {
    require_library(libraries.egl, "EGL");
    require_library(libraries.gl, "OpenGL");
    return std::make_unique<EglPlatform>();
}

}  // namespace lissom
