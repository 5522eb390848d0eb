#include "viewer/lua/png_file.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom {

void require_picture_path(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".png") return;
    throw Error(ErrorCode::unknown_format,
                display_name(path) + ": pictures are written as .png; name the file so");
}

Image load_picture(const std::filesystem::path& path, const Context& context) {
    const FileContent file = read_file(path, context);
    try {
        return decode_png(file.bytes);
    } catch (const Error& error) {
        throw Error(error.code(), display_name(path) + ": " + error.message());
    }
}

void save_picture(const Image& image, const std::filesystem::path& path, const Context& context) {
    require_picture_path(path);
    write_file_atomically(path, encode_png(image), context);
}

}  // namespace lissom
