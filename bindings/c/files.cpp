#include "bindings/c/files.h"

#include "kernel/core/error.h"

namespace lissom::c {

std::string read_by_host(const lissom_context& context, const std::string& path) {
    std::string content;
    const auto sink = [](void* argument, const void* bytes, size_t size) {
        static_cast<std::string*>(argument)->append(static_cast<const char*>(bytes), size);
    };
    if (!context.options.read_file(context.options.user, path.c_str(), sink, &content)) {
        throw Error(ErrorCode::file_not_found, path + ": the host has no such file");
    }
    return content;
}

void write_by_host(const lissom_context& context, const std::string& path,
                   const std::string& bytes) {
    if (!context.options.write_file(context.options.user, path.c_str(), bytes.data(),
                                    bytes.size())) {
        throw Error(ErrorCode::file_write_failed, path + ": the host cannot write the file");
    }
}

std::filesystem::path path_of(const std::string& text) {
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

std::string extension_of(const std::string& path) {
    std::string extension = path_of(path).extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    return extension;
}

}  // namespace lissom::c
