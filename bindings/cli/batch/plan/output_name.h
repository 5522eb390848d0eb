/// Names of the outputs of a batch: a template with placeholders in braces.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lissom::cli {

/// A template as "out/{name}/{height}.glb"; "{{" and "}}" stand for braces.
class OutputName {
  public:
    /// Errors: invalid_argument for a brace without its other.
    explicit OutputName(const std::string& text);

    /// Returns the names of its placeholders, in their order.
    std::vector<std::string> placeholders() const;
    /// Returns the folder above the first placeholder, or that of the file if there is none.
    std::filesystem::path base() const;
    /// Returns the path with a value for each placeholder. In a value, "/" and characters that no
    /// file's name has become "_", but for the placeholder "dir", which may name folders. Returns
    /// the path in its normal form.
    std::filesystem::path fill(const std::function<std::string(const std::string&)>& value) const;

  private:
    struct Piece {
        std::string text;
        bool is_placeholder = false;
    };
    std::vector<Piece> pieces_;
};

}  // namespace lissom::cli
