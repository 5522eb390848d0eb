/// Platform: provider of the renderer's OpenGL context. The renderer draws into framebuffers of its
/// own, so a platform needs no window.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace lissom {

/// An OpenGL context, 3.3 core or later, that belongs to this object and ends with it.
class Platform {
  public:
    Platform() = default;
    virtual ~Platform() = default;
    Platform(const Platform&) = delete;
    Platform& operator=(const Platform&) = delete;

    /// Makes the context current on this thread, after noting the current one. Errors:
    /// no_display.
    virtual void enter() = 0;
    /// Restores the context from before `enter`.
    virtual void leave() noexcept = 0;
};

/// Keeps a platform's context current for its own lifetime.
class PlatformScope {
  public:
    explicit PlatformScope(Platform& platform) : platform_(platform) { platform_.enter(); }
    ~PlatformScope() { platform_.leave(); }
    PlatformScope(const PlatformScope&) = delete;
    PlatformScope& operator=(const PlatformScope&) = delete;

  private:
    Platform& platform_;
};

/// Shared libraries that the EGL platform loads when it is first made; for each, the file names
/// it may have. They are looked for before use, because libepoxy ends the process if one is
/// missing.
struct EglLibraries {
    std::vector<std::string> egl{"libEGL.so.1"};
    std::vector<std::string> gl{"libOpenGL.so.0", "libGL.so.1"};
};

/// A context from EGL that needs no display server: on the surfaceless platform, else on the first
/// device that works, else on the default display. The connection to the driver stays open until
/// the process ends, because closing it would end contexts that others hold on it. Errors:
/// no_display, which names the missing parts and their packages.
std::unique_ptr<Platform> make_egl_platform(const EglLibraries& libraries = {});

}  // namespace lissom
