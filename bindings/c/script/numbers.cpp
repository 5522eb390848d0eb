// Typed lists that functions of scripts take and return.
#include <memory>

#include "bindings/c/data.h"
#include "bindings/c/script/host.h"
#include "bindings/lua/mesh/buffer.h"

namespace lissom::c {
namespace {

std::shared_ptr<lua::BufferObject> numbers_of(lissom_context& context, lissom_object numbers) {
    auto found = scripts_of(context).object_of_type(numbers.id, lua::BufferObject::kTypeName);
    require(found != nullptr, "the object is no list of numbers");
    return std::static_pointer_cast<lua::BufferObject>(found);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_status lissom_numbers_create(lissom_context* context, const lissom_input* values,
                                    int32_t width, lissom_object* numbers) {
    return run(context, [&] {
        require_given(numbers, "numbers");
        ScriptHost& host = scripts_of(*context);
        auto made = std::make_shared<lua::BufferObject>();
        made->values = read_numbers(values, width, "values");
        made->width = width;
        made->held = MemoryHold(context->kernel.memory(), "a list of numbers");
        made->held.resize(made->memory_bytes());
        numbers->id = host.add_object(lua::BufferObject::kTypeName, made);
    });
}

int32_t lissom_numbers_size(lissom_context* context, lissom_object numbers) {
    if (!context) return -1;
    return context->count([&] {
        const auto own = numbers_of(*context, numbers);
        return index_of(own->numbers().size()) / own->width;
    });
}

int32_t lissom_numbers_width(lissom_context* context, lissom_object numbers) {
    return context ? context->count([&] { return numbers_of(*context, numbers)->width; }) : -1;
}

lissom_status lissom_numbers_read(lissom_context* context, lissom_object numbers,
                                  const lissom_output* values) {
    return run(context, [&] {
        const auto own = numbers_of(*context, numbers);
        const std::span<const double> all = own->numbers();
        const auto width = at(own->width);
        require_room(values, all.size() / width, width, "values");
        write_elements(
            *values, all.size() / width, width,
            [&](std::size_t i, std::size_t k) { return all[i * width + k]; },
            [](std::size_t) { return false; });
    });
}

}  // extern "C"
