/// FileError: an error about a file that was to be read or written.
#pragma once

#include <string>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {

/// An error that knows its file. The line, if any, is the first of its elements
/// (ElementKind::line).
class FileError : public Error {
  public:
    /// `message` names the file as well: it is shown alone.
    FileError(ErrorCode code, std::string file, std::string message, Elements elements = {})
        : Error(code, std::move(message), std::move(elements)), file_(std::move(file)) {}

    /// The path as in messages, in UTF-8.
    const std::string& file() const { return file_; }
    /// Returns the file of an error that knows it, else `file`.
    static std::string of(const Error& error, const std::string& file) {
        const auto* known = dynamic_cast<const FileError*>(&error);
        return known ? known->file() : file;
    }

  private:
    std::string file_;
};

}  // namespace lissom
