/// MockGl: stands in for OpenGL without a driver, a screen or a context, and counts what it is
/// asked.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace lissom::test {

/// While it lives every call of OpenGL that the viewer makes comes here: libepoxy calls through
/// pointers. One at a time in a process.
class MockGl {
  public:
    MockGl();
    ~MockGl() {
        for (const auto& restore : restore_) restore();
        now() = nullptr;
    }
    MockGl(const MockGl&) = delete;
    MockGl& operator=(const MockGl&) = delete;

    /// Calls by name since the last `reset`.
    int calls(const std::string& name) const {
        const auto found = calls_.find(name);
        return found == calls_.end() ? 0 : found->second;
    }
    int calls() const {
        int all = 0;
        for (const auto& [name, count] : calls_) all += count;
        return all;
    }
    /// Calls that draw.
    int draws() const {
        return calls("glDrawArrays") + calls("glDrawArraysInstanced") + calls("glDrawElements");
    }
    const std::map<std::string, int>& calls_by_name() const { return calls_; }
    /// Sent to buffers and textures since then.
    std::size_t bytes() const { return bytes_; }
    /// Objects that were made and not freed, ever since it lives.
    int alive() const { return made_ - freed_; }
    void reset() {
        calls_.clear();
        bytes_ = 0;
    }

  private:
    template <auto& slot>
    friend struct Mocked;

    static MockGl*& now() {
        static MockGl* mock = nullptr;
        return mock;
    }
    template <auto& slot>
    void stand_in(const char* name);

    // ---- What calls mean beside being counted

    template <typename... Arguments>
    void take(const std::string& name, Arguments... arguments);
    static GLuint answer(const std::string& name) {
        if (name == "glCheckFramebufferStatus") return GL_FRAMEBUFFER_COMPLETE;
        if (name == "glCreateShader" || name == "glCreateProgram") return now()->made();
        return 0;
    }
    GLuint made() { return static_cast<GLuint>(++made_); }

    std::vector<std::function<void()>> restore_;
    std::map<std::string, int> calls_;
    std::size_t bytes_ = 0;
    int made_ = 0, freed_ = 0;
};

/// The function that stands in for the one that `slot` points to.
template <auto& slot>
struct Mocked;

template <typename Result, typename... Arguments, Result (*&slot)(Arguments...)>
struct Mocked<slot> {
    static inline const char* name = nullptr;

    static Result call(Arguments... arguments) {
        MockGl::now()->take(name, arguments...);
        if constexpr (std::is_same_v<Result, const GLubyte*>) {
            return reinterpret_cast<const GLubyte*>("mock");
        } else if constexpr (!std::is_void_v<Result>) {
            return static_cast<Result>(MockGl::answer(name));
        }
    }
};

template <auto& slot>
void MockGl::stand_in(const char* name) {
    Mocked<slot>::name = name;
    restore_.push_back([before = slot] { slot = before; });
    slot = &Mocked<slot>::call;
}

template <typename... Arguments>
void MockGl::take(const std::string& name, Arguments... arguments) {
    ++calls_[name];
    const auto is = [&](const char* beginning) { return name.starts_with(beginning); };
    const std::tuple<Arguments...> values(arguments...);
    using Values = std::tuple<Arguments...>;
    if constexpr (std::is_same_v<Values, std::tuple<GLsizei, GLuint*>>) {
        // glGen...
        for (GLsizei i = 0; i < std::get<0>(values); ++i) std::get<1>(values)[i] = made();
    } else if constexpr (std::is_same_v<Values, std::tuple<GLsizei, const GLuint*>>) {
        if (is("glDelete")) freed_ += std::get<0>(values);
    } else if constexpr (std::is_same_v<Values, std::tuple<GLuint>>) {
        if (is("glDeleteShader") || is("glDeleteProgram")) ++freed_;
    } else if constexpr (std::is_same_v<Values, std::tuple<GLenum, GLint*>>) {
        // glGetIntegerv
        *std::get<1>(values) = 1 << 14;
    } else if constexpr (std::is_same_v<Values, std::tuple<GLuint, GLenum, GLint*>>) {
        // glGetShaderiv, glGetProgramiv: compiled, linked
        *std::get<2>(values) = GL_TRUE;
    } else if constexpr (std::is_same_v<Values,
                                        std::tuple<GLenum, GLsizeiptr, const void*, GLenum>>) {
        bytes_ += static_cast<std::size_t>(std::get<1>(values));
    } else if constexpr (std::is_same_v<Values,
                                        std::tuple<GLenum, GLintptr, GLsizeiptr, const void*>>) {
        bytes_ += static_cast<std::size_t>(std::get<2>(values));
    } else if constexpr (std::is_same_v<Values, std::tuple<GLenum, GLint, GLint, GLint, GLsizei,
                                                           GLsizei, GLenum, GLenum, const void*>>) {
        // glTexSubImage2D
        bytes_ += 4u * static_cast<std::size_t>(std::get<4>(values) * std::get<5>(values));
    } else if constexpr (std::is_same_v<Values,
                                        std::tuple<GLenum, GLint, GLint, GLsizei, GLsizei, GLsizei,
                                                   GLint, GLenum, GLenum, const void*>>) {
        // glTexImage3D
        bytes_ += 4u * static_cast<std::size_t>(std::get<3>(values) * std::get<4>(values) *
                                                std::get<5>(values));
    }
}

inline MockGl::MockGl() {
    now() = this;
#define STAND_IN(name) stand_in<epoxy_##name>(#name)
    STAND_IN(glActiveTexture);
    STAND_IN(glAttachShader);
    STAND_IN(glBindBuffer);
    STAND_IN(glBindFramebuffer);
    STAND_IN(glBindRenderbuffer);
    STAND_IN(glBindTexture);
    STAND_IN(glBindVertexArray);
    STAND_IN(glBlendFunc);
    STAND_IN(glBlitFramebuffer);
    STAND_IN(glBufferData);
    STAND_IN(glBufferSubData);
    STAND_IN(glCheckFramebufferStatus);
    STAND_IN(glClear);
    STAND_IN(glClearColor);
    STAND_IN(glCompileShader);
    STAND_IN(glCreateProgram);
    STAND_IN(glCreateShader);
    STAND_IN(glDeleteBuffers);
    STAND_IN(glDeleteFramebuffers);
    STAND_IN(glDeleteProgram);
    STAND_IN(glDeleteRenderbuffers);
    STAND_IN(glDeleteShader);
    STAND_IN(glDeleteTextures);
    STAND_IN(glDeleteVertexArrays);
    STAND_IN(glDepthFunc);
    STAND_IN(glDepthMask);
    STAND_IN(glDisable);
    STAND_IN(glDrawArrays);
    STAND_IN(glDrawArraysInstanced);
    STAND_IN(glDrawElements);
    STAND_IN(glEnable);
    STAND_IN(glEnableVertexAttribArray);
    STAND_IN(glFinish);
    STAND_IN(glFramebufferRenderbuffer);
    STAND_IN(glFramebufferTexture2D);
    STAND_IN(glGenBuffers);
    STAND_IN(glGenFramebuffers);
    STAND_IN(glGenRenderbuffers);
    STAND_IN(glGenTextures);
    STAND_IN(glGenVertexArrays);
    STAND_IN(glGetError);
    STAND_IN(glGetIntegerv);
    STAND_IN(glGetProgramiv);
    STAND_IN(glGetShaderiv);
    STAND_IN(glGetString);
    STAND_IN(glGetUniformLocation);
    STAND_IN(glLinkProgram);
    STAND_IN(glPixelStorei);
    STAND_IN(glPolygonOffset);
    STAND_IN(glReadPixels);
    STAND_IN(glRenderbufferStorageMultisample);
    STAND_IN(glShaderSource);
    STAND_IN(glTexBuffer);
    STAND_IN(glTexImage2D);
    STAND_IN(glTexImage3D);
    STAND_IN(glTexParameteri);
    STAND_IN(glTexSubImage2D);
    STAND_IN(glUniform1f);
    STAND_IN(glUniform1i);
    STAND_IN(glUniform2fv);
    STAND_IN(glUniform3fv);
    STAND_IN(glUniform4fv);
    STAND_IN(glUniformMatrix4fv);
    STAND_IN(glUseProgram);
    STAND_IN(glVertexAttribDivisor);
    STAND_IN(glVertexAttribIPointer);
    STAND_IN(glVertexAttribPointer);
    STAND_IN(glViewport);
#undef STAND_IN
}

}  // namespace lissom::test
