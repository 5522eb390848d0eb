#include "kernel/scene/file/list_store.h"

#include "kernel/core/error.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_model() {
    throw Error(ErrorCode::file_syntax, "the scene names a model that it cannot have");
}

}  // namespace

std::size_t bytes_of(NumberType type) {
    return type == NumberType::float64 || type == NumberType::int64 ? 8 : 4;
}

ListSink::~ListSink() = default;
ListSource::~ListSource() = default;

SceneJson ListSink::put_model(const std::string&, const ModelView&) {
    return nullptr;
}

void ListSource::get_surface(const std::string&, const SceneJson&, std::vector<Vec3>&,
                             std::vector<Index>&, std::vector<Index>&) {
    refuse_model();
}

void ListSource::get_lines(const std::string&, const SceneJson&, std::vector<float>&,
                           std::vector<Index>&) {
    refuse_model();
}

}  // namespace lissom
