/// Services of the engine for the library: its jobs, its log, its table of files.
#pragma once

#include <lissom/lissom.hpp>

#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "jobs.h"

namespace engine {

/// Everything that the engine and the library may open, by name. No name is a path of the disk.
class Files {
  public:
    void add(const std::string& name, std::string bytes) { files_[name] = std::move(bytes); }
    const std::string* find(const std::string& name) const {
        const auto found = files_.find(name);
        return found == files_.end() ? nullptr : &found->second;
    }

  private:
    std::map<std::string, std::string> files_;
};

struct Host {
    Jobs jobs{3};
    Files files;
    std::vector<std::string> log;
    /// Tasks that the library began and that it will wait for.
    std::vector<std::shared_ptr<Jobs::Task>> begun;
};

namespace callbacks {

inline Host& host(void* user) {
    return *static_cast<Host*>(user);
}

inline void log(void* user, lissom_log_level level, const char* message) {
    static constexpr const char* kNames[] = {"debug", "info", "warning"};
    host(user).log.push_back(std::string(kNames[level]) + ": " + message);
}

inline void parallel_for(void* user, std::size_t count, void (*chunk)(void*, std::size_t),
                         void* argument) {
    host(user).jobs.parallel_for(count, [&](std::size_t i) { chunk(argument, i); });
}

inline void* enqueue(void* user, void (*task)(void*), void* argument) {
    host(user).begun.push_back(host(user).jobs.begin([=] { task(argument); }));
    return host(user).begun.back().get();
}

inline void wait(void* user, void* task) {
    host(user).jobs.wait(*static_cast<Jobs::Task*>(task));
}

inline bool read_file(void* user, const char* path, lissom_sink* sink, void* argument) {
    const std::string* bytes = host(user).files.find(path);
    if (bytes) sink(argument, bytes->data(), bytes->size());
    return bytes != nullptr;
}

inline bool write_file(void* user, const char* path, const void* bytes, std::size_t size) {
    host(user).files.add(path, std::string(static_cast<const char*>(bytes), size));
    return true;
}

}  // namespace callbacks

inline lissom_context_options options_for(Host& host) {
    lissom_context_options options = lissom_default_context_options();
    options.user = &host;
    options.log = callbacks::log;
    options.parallel_for = callbacks::parallel_for;
    options.enqueue = callbacks::enqueue;
    options.wait = callbacks::wait;
    options.read_file = callbacks::read_file;
    options.write_file = callbacks::write_file;
    return options;
}

}  // namespace engine
