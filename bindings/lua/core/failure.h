/// Failure: an error of the kernel as plain data. It outlives the exception, so that Lua is called
/// only when no C++ object is alive any more.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "kernel/core/error.h"

namespace lissom::lua {

struct Failure {
    ErrorCode code = ErrorCode::internal;
    char message[2048] = {};
    /// Elements concerned, 0-based, as in Elements.
    ElementKind kind = ElementKind::none;
    std::size_t count = 0;
    std::size_t id_count = 0;
    Index ids[Elements::kMaximumIds] = {};
    /// The file that was to be read or written, in UTF-8; empty without one. Its line counts from
    /// 1; 0 without one.
    char file[1024] = {};
    std::size_t line = 0;

    /// Takes over an error, with ids in the message numbered from 1.
    void set(const Error& error) noexcept;
    void set(ErrorCode code_given, const char* text) noexcept;

    /// Runs `work`; if it throws, sets this failure and returns false.
    template <typename Work>
    bool guard(const Work& work) noexcept {
        try {
            work();
            return true;
        } catch (const Error& error) {
            set(error);
        } catch (const std::bad_alloc&) {
            set(ErrorCode::memory_limit, "there is not enough memory");
        } catch (const std::exception& error) {
            set(ErrorCode::internal, error.what());
        } catch (...) {
            set(ErrorCode::internal, "an unknown exception was thrown");
        }
        return false;
    }

  private:
    void set_input(const Error& error) noexcept;
};

/// The message of an error as scripts read it: vertices, faces and other elements count from 1.
std::string lua_message(const Error& error);

}  // namespace lissom::lua
