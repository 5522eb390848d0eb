#include "bindings/lua/mesh/buffer.h"

#include <cmath>
#include <cstring>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"

namespace lissom::lua {

std::span<double> BufferObject::numbers() {
    if (source == Source::own) return values;
    const bool unchanged = changes_ == mesh->changes;
    if (!unchanged || mesh->mesh.shared_topology() != topology) {
        require_current(*mesh, topology, "the buffer");
        found_ = find_attribute();
        changes_ = mesh->changes;
    }
    if (source == Source::attribute) return found_;
    const std::span<const Vec3> positions = mesh->mesh.positions();
    return {reinterpret_cast<double*>(const_cast<Vec3*>(positions.data())), 3 * positions.size()};
}

std::span<double> BufferObject::edit() {
    const std::span<double> all = numbers();
    if (source == Source::positions) mesh->mesh.edit_positions();
    return all;
}

std::span<double> BufferObject::find_attribute() {
    if (source != Source::attribute) return {};
    Attribute* attribute = mesh->mesh.attributes().find(name);
    if (!attribute || attribute->width != width) {
        throw Error(ErrorCode::topology_mismatch,
                    "the attribute '" + name +
                        "' of this buffer has gone or was replaced; ask the "
                        "mesh for it again");
    }
    return attribute->values;
}

std::vector<Vec3> BufferObject::as_points() {
    if (width != 3) {
        throw Error(ErrorCode::invalid_argument,
                    "positions need a buffer of three numbers a vertex, "
                    "this one has " +
                        std::to_string(width));
    }
    const std::span<const double> all = numbers();
    std::vector<Vec3> points(all.size() / 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {all[3 * i], all[3 * i + 1], all[3 * i + 2]};
    }
    return points;
}

namespace {

constexpr int kMost = 16;
constexpr double kMaxBytes = 9007199254740992.0;
constexpr int kMaxStride = 65536;

// The numbers, or an empty span after which the call has failed.
bool find_numbers(Call& call, std::span<double>& numbers, bool edit) {
    const auto buffer = call.self<BufferObject>();
    return call.attempt_quick([&] {
        if (edit && !buffer->writable()) {
            throw Error(ErrorCode::invalid_argument, "this buffer can only be read");
        }
        numbers = edit ? buffer->edit() : buffer->numbers();
    });
}

// ---- buffer[i] and #buffer

int get_number(Call& call) {
    if (lua_type(call.lua(), 2) != LUA_TNUMBER) return 0;
    std::span<double> numbers;
    if (!find_numbers(call, numbers, false)) return call.fail();
    const double place = lua_tonumber(call.lua(), 2);
    const bool exists = place >= 1 && place <= numbers.size() && place == std::floor(place);
    if (!exists) {
        lua_pushnil(call.lua());
        return 1;
    }
    return call.push(numbers[static_cast<std::size_t>(place) - 1]);
}

double checked_number(Call& call, int index, bool finite) {
    if (lua_type(call.lua(), index) != LUA_TNUMBER) {
        call.raise(lua_pushfstring(call.lua(), "a buffer holds numbers, got %s",
                                   luaL_typename(call.lua(), index)));
    }
    const double value = lua_tonumber(call.lua(), index);
    if (finite && !std::isfinite(value)) call.raise("a position must be finite");
    return value;
}

bool needs_finite(Call& call) {
    return call.self<BufferObject>()->source == BufferObject::Source::positions;
}

int set_number(Call& call) {
    if (lua_type(call.lua(), 2) != LUA_TNUMBER) call.raise("a buffer has no fields, only numbers");
    const double place = lua_tonumber(call.lua(), 2);
    const double value = checked_number(call, 3, needs_finite(call));
    std::span<double> numbers;
    if (!find_numbers(call, numbers, true)) return call.fail();
    if (!(place >= 1 && place <= numbers.size()) || place != std::floor(place)) {
        call.raise(
            lua_pushfstring(call.lua(), "the buffer has the places 1 to %d", count_of(numbers)));
    }
    numbers[static_cast<std::size_t>(place) - 1] = value;
    return 0;
}

int number_count(Call& call) {
    std::span<double> numbers;
    if (!find_numbers(call, numbers, false)) return call.fail();
    return call.push_count(numbers.size());
}

int buffer_text(Call& call) {
    const auto buffer = call.self<BufferObject>();
    std::size_t count = 0;
    const bool usable = call.attempt_quick([&] { count = buffer->numbers().size(); });
    lua_pushfstring(call.lua(),
                    usable ? "lissom.Buffer: %d numbers, %d a row" : "lissom.Buffer (out of date)",
                    index_of(count), buffer->width);
    return 1;
}

// ---- Methods

int row_width(Call& call) {
    return call.push(call.self<BufferObject>()->width);
}

int row_count(Call& call) {
    std::span<double> numbers;
    if (!find_numbers(call, numbers, false)) return call.fail();
    return call.push_count(numbers.size() / call.self<BufferObject>()->width);
}

// Checks a row number; fails with out_of_range.
bool find_row(Call& call, bool edit, std::span<double>& row) {
    const auto width = static_cast<std::size_t>(call.self<BufferObject>()->width);
    std::span<double> numbers;
    if (!find_numbers(call, numbers, edit)) return false;
    const auto i = static_cast<std::size_t>(call.id("row"));
    if (i < numbers.size() / width) {
        row = numbers.subspan(i * width, width);
        return true;
    }
    return call.attempt_quick([&] {
        throw Error(ErrorCode::out_of_range,
                    "row " + std::to_string(i + 1) + " is not one of the " +
                        std::to_string(numbers.size() / width) + " of the buffer");
    });
}

int get_row(Call& call) {
    std::span<double> row;
    if (!find_row(call, false, row)) return call.fail();
    luaL_checkstack(call.lua(), count_of(row), "the row is too wide");
    for (const double value : row) lua_pushnumber(call.lua(), value);
    return count_of(row);
}

int set_row(Call& call) {
    const std::span<const double> values = call.numbers("values");
    std::span<double> row;
    if (!find_row(call, true, row)) return call.fail();
    if (values.size() != row.size()) {
        call.raise(lua_pushfstring(call.lua(), "a row of this buffer has %d numbers, got %d",
                                   count_of(row), count_of(values)));
    }
    std::copy(values.begin(), values.end(), row.begin());
    return call.push_argument();
}

int pointer(Call& call) {
    std::span<double> numbers;
    const bool edit = call.self<BufferObject>()->writable();
    if (!call.attempt_quick([&] { call.require_addresses(); })) return call.fail();
    if (!find_numbers(call, numbers, edit)) return call.fail();
    lua_pushlightuserdata(call.lua(), numbers.data());
    return 1;
}

// Layout of rows of floats in memory of the host, in bytes.
struct FloatRows {
    std::size_t count, width, offset, step;

    std::size_t row() const { return width * sizeof(float); }
    std::size_t end() const { return count == 0 ? 0 : offset + (count - 1) * step + row(); }
};

// Throws invalid_argument if rows overlap, or do not fit into so many bytes.
void require_room(const FloatRows& rows, std::size_t size) {
    if (rows.step < rows.row()) {
        throw Error(ErrorCode::invalid_argument, "stride is " + std::to_string(rows.step) +
                                                     " bytes; a row needs " +
                                                     std::to_string(rows.row()));
    }
    if (rows.end() <= size) return;
    throw Error(ErrorCode::invalid_argument, "there are " + std::to_string(size) + " bytes; " +
                                                 std::to_string(rows.count) + " rows need " +
                                                 std::to_string(rows.end()));
}

void write_rows(std::span<const double> numbers, const FloatRows& rows, std::byte* memory) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto value = static_cast<float>(numbers[i]);
        const std::size_t place =
            rows.offset + i / rows.width * rows.step + i % rows.width * sizeof(float);
        std::memcpy(memory + place, &value, sizeof value);
    }
}

int write_floats(Call& call) {
    auto* memory = static_cast<std::byte*>(call.address("address"));
    const auto size = static_cast<std::size_t>(call.number("size"));
    FloatRows rows{0, static_cast<std::size_t>(call.self<BufferObject>()->width),
                   static_cast<std::size_t>(call.integer("offset")), 0};
    rows.step = call.has("stride") ? static_cast<std::size_t>(call.integer("stride")) : rows.row();
    std::span<double> numbers;
    if (!find_numbers(call, numbers, false)) return call.fail();
    const bool done = call.attempt_quick([&] {
        call.require_addresses();
        rows.count = numbers.size() / rows.width;
        require_room(rows, size);
        if (!memory) throw Error(ErrorCode::invalid_argument, "the address is null");
        write_rows(numbers, rows, memory);
    });
    return done ? call.push_argument() : call.fail();
}

int changed(Call& call) {
    const auto buffer = call.self<BufferObject>();
    const bool done = call.attempt([&] {
        const std::span<double> numbers = buffer->edit();
        if (buffer->source != BufferObject::Source::positions) return;
        Elements bad{ElementKind::vertex, 0, {}};
        for (std::size_t i = 0; i < numbers.size(); i += 3) {
            const bool finite = std::isfinite(numbers[i] + numbers[i + 1] + numbers[i + 2]);
            if (!finite) bad.add(index_of(i / 3));
        }
        if (bad.count == 0) return;
        const std::string names = describe(bad);
        throw Error(ErrorCode::not_finite, "positions of " + names + " are NaN or infinite",
                    std::move(bad));
    });
    return done ? call.push_argument() : call.fail();
}

int to_table(Call& call) {
    std::span<double> numbers;
    if (!find_numbers(call, numbers, false)) return call.fail();
    return call.push_numbers(numbers);
}

// ---- Methods of a mesh

constexpr const char* kDomainNames[] = {"vertex", "corner", "face"};
constexpr const char* kTypeNames[] = {"float32", "float64", "int8",  "uint8",
                                      "int16",   "uint16",  "int32", "uint32"};

template <typename Enum>
std::string_view name_of(std::span<const char* const> names, Enum value) {
    return names[static_cast<std::size_t>(value)];
}

std::vector<std::string> names_of(std::span<const char* const> names) {
    return {names.begin(), names.end()};
}

int mesh_positions(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        auto buffer = std::make_shared<BufferObject>();
        buffer->source = BufferObject::Source::positions;
        buffer->mesh = mesh.share();
        buffer->topology = mesh->mesh.shared_topology();
        buffer->width = 3;
        result.set(std::move(buffer));
    });
    return done ? 1 : call.fail();
}

std::shared_ptr<BufferObject> attribute_buffer(std::shared_ptr<MeshObject> mesh,
                                               const Attribute& attribute) {
    auto buffer = std::make_shared<BufferObject>();
    buffer->source = BufferObject::Source::attribute;
    buffer->topology = mesh->mesh.shared_topology();
    buffer->mesh = std::move(mesh);
    buffer->name = attribute.name;
    buffer->width = attribute.width;
    return buffer;
}

std::vector<std::string_view> attribute_names(const Mesh& mesh) {
    std::vector<std::string_view> names;
    for (const Attribute& attribute : mesh.attributes().all()) names.push_back(attribute.name);
    return names;
}

int mesh_attribute(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const char* name = call.string("name");
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        const Attribute* attribute = mesh->mesh.attributes().find(name);
        if (!attribute) refuse_absent("attribute", name, attribute_names(mesh->mesh));
        result.set(attribute_buffer(mesh.share(), *attribute));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int mesh_attributes(Call& call) {
    const auto& all = call.self<MeshObject>()->mesh.attributes().all();
    return push_list(call, all, [&](const Attribute& attribute) {
        lua_createtable(call.lua(), 0, 5);
        call.set_field("name", call.push(std::string_view(attribute.name)));
        call.set_field("domain", call.push(name_of(kDomainNames, attribute.domain)));
        call.set_field("width", call.push(attribute.width));
        call.set_field("type", call.push(name_of(kTypeNames, attribute.type)));
        call.set_field("count", call.push(attribute.size()));
    });
}

// The attribute's numbers: one value for all, one row for all, or all of them.
std::vector<double> attribute_values(const Call& call, std::size_t width, std::size_t count) {
    const std::size_t total = width * count;
    if (call.kind("values") == Kind::number)
        return std::vector<double>(total, call.number("values"));
    const std::span<const double> given = call.numbers("values");
    if (given.size() == total) return {given.begin(), given.end()};
    if (given.size() != width) {
        throw Error(ErrorCode::invalid_argument, "values has " + std::to_string(given.size()) +
                                                     " numbers; " + std::to_string(total) +
                                                     " are needed, or one row of " +
                                                     std::to_string(width) + " for all");
    }
    std::vector<double> values(total);
    for (std::size_t i = 0; i < total; ++i) values[i] = given[i % width];
    return values;
}

int add_attribute(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const auto result = call.create<BufferObject>();
    const bool done = call.attempt([&] {
        Attribute attribute{call.string("name"),
                            call.choice<Domain>("domain"),
                            call.integer("width"),
                            call.choice<ScalarType>("type"),
                            {}};
        const Index count = element_count(mesh->mesh.topology(), attribute.domain);
        attribute.values = attribute_values(call, attribute.width, count);
        const Attribute& added = mesh->mesh.attributes().add(std::move(attribute));
        mesh->changed();
        result.set(attribute_buffer(mesh.share(), added));
    });
    if (!done) return call.fail();
    call.charge(mesh);
    call.charge(result);
    return 1;
}

int remove_attribute(Call& call) {
    const auto mesh = call.self<MeshObject>();
    const char* name = call.string("name");
    bool removed = false;
    const bool done = call.attempt([&] {
        removed = mesh->mesh.attributes().remove(name);
        mesh->changed();
    });
    return done ? call.push(removed) : call.fail();
}

}  // namespace

Type buffer_type() {
    const auto row = id("row", "Number of the row: the id of its vertex, corner or face.");
    Type type{.name = "lissom.Buffer",
              .summary =
                  "Numbers of the kernel, read and written in place. It keeps its mesh alive and "
                  "refuses to work once the mesh has another topology."};
    type.operators = {{"__index", get_number, "buffer[i]",
                       "number i, counting all rows through; nil beyond the end"},
                      {"__newindex", set_number, "buffer[i] = x", "writes number i"},
                      {"__len", number_count, "#buffer", "how many numbers there are"},
                      {"__tostring", buffer_text, "tostring(buffer)", "its size"}};
    type.methods = {
        {.name = "width",
         .body = row_width,
         .summary = "Numbers a row: 3 for positions.",
         .results = {{"integer", "width", "Numbers a row."}},
         .example = "assert(lissom.shapes.box():positions():width() == 3)"},
        {.name = "count",
         .body = row_count,
         .summary = "Number of rows: of vertices, corners or faces.",
         .results = {{"integer", "rows", "Number of rows."}},
         .errors = {ErrorCode::topology_mismatch},
         .example = "assert(lissom.shapes.box():positions():count() == 8)"},
        {.name = "get",
         .body = get_row,
         .summary = "The numbers of a row, as several results.",
         .arguments = {row},
         .results = {{"number", "...", "Numbers of the row, as many as the buffer is wide."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::topology_mismatch},
         .example = "local x, y, z = lissom.shapes.box():positions():get(1)"},
        {.name = "set",
         .body = set_row,
         .summary = "Writes a row and returns the buffer.",
         .arguments = {row, numbers("values", "Numbers, as many as the buffer is wide.")},
         .results = {{"lissom.Buffer", "buffer", "The buffer."}},
         .errors = {ErrorCode::out_of_range, ErrorCode::topology_mismatch},
         .example = "lissom.shapes.box():positions():set(1, { 0, 0, 0 })"},
        {.name = "pointer",
         .body = pointer,
         .summary =
             "The address of the numbers, doubles in rows, for LuaJIT's ffi. It is valid until "
             "the mesh's topology or attributes change. Call `changed` after writing.",
         .results = {{"lightuserdata", "address", "Address of the first number."}},
         .errors = {ErrorCode::topology_mismatch, ErrorCode::unsupported},
         .example = "local address = lissom.shapes.box():positions():pointer()"},
        {.name = "write_floats",
         .body = write_floats,
         .summary = "Writes all numbers into memory of the host as floats of 32 bits, row after "
                    "row, as graphics cards take them: of a mapped buffer, or LÖVE's "
                    "`data:getPointer()` and `data:getSize()`. Nothing is written after an error.",
         .arguments =
             {address("address", "Address of the first row."),
              number("size", "Bytes that may be written from there on.").between(0, kMaxBytes)},
         .options =
             {integer("offset", "Bytes from the address to the first row.").defaults(0).at_least(0),
              integer("stride",
                      "Bytes from one row to the next, if other data stands between them; "
                      "without it they follow each other.")
                  .optional()
                  .between(1, kMaxStride)},
         .results = {{"lissom.Buffer", "buffer", "The buffer."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::topology_mismatch,
                    ErrorCode::unsupported},
         .example =
             R"(local from, to = lissom.shapes.box():positions(), lissom.shapes.box():positions()
from:write_floats(to:pointer(), 8 * #to))"},
        {.name = "changed",
         .body = changed,
         .summary = "Tells the mesh that numbers were written through `pointer`, and checks them.",
         .results = {{"lissom.Buffer", "buffer", "The buffer."}},
         .errors = {ErrorCode::not_finite, ErrorCode::topology_mismatch},
         .example = "lissom.shapes.box():positions():changed()"},
        {.name = "table",
         .body = to_table,
         .summary = "All numbers as one list.",
         .results = {{"number[]", "numbers", "A copy of the numbers."}},
         .errors = {ErrorCode::topology_mismatch},
         .example = "assert(#lissom.shapes.box():positions():table() == 24)"}};
    return type;
}

std::vector<Function> buffer_methods_of_mesh() {
    return {
        {.name = "positions",
         .body = mesh_positions,
         .summary =
             "The positions as a typed buffer without a copy: x, y, z of vertex 1, of vertex 2, "
             "and so on.",
         .results = {{"lissom.Buffer", "positions", "Three numbers a vertex."}},
         .example = R"(local mesh = lissom.shapes.box()
local positions = mesh:positions()
for i = 1, #positions, 3 do positions[i] = 2 * positions[i] end
assert(mesh:bounds().max[1] == 1))"},
        {.name = "attributes",
         .body = mesh_attributes,
         .summary = "The attributes of the mesh.",
         .results = {{"lissom.AttributeInfo[]", "attributes", "In the order they were added."}},
         .example = "assert(#lissom.shapes.box():attributes() == 0)"},
        {.name = "attribute",
         .body = mesh_attribute,
         .summary =
             "The numbers of an attribute as a typed buffer without a copy. A NaN means that an "
             "element has no value.",
         .arguments = {string("name", "Name of the attribute: \"uv\", \"normal\", \"color\", ...")},
         .results = {{"lissom.Buffer?", "buffer", "Its numbers."}},
         .example = R"(local mesh = lissom.shapes.box()
assert(lissom.try(mesh.attribute, mesh, "color") == nil))"},
        {.name = "add_attribute",
         .body = add_attribute,
         .summary = "Adds an attribute, in place of one of the same name.",
         .options =
             {string("name", "Its name. \"uv\", \"normal\" and \"color\" have a meaning in files."),
              choice("domain", names_of(kDomainNames), "The elements that it is on.")
                  .defaults("vertex"),
              integer("width", "Numbers an element.").defaults(1).between(1, kMost),
              choice("type", names_of(kTypeNames), "Number type in files.").defaults("float32"),
              either("values",
                     {number("value", "One number for all."),
                      numbers("list", "One row for all, or all rows one after the other.")},
                     "The numbers.")
                  .defaults(0.0)},
         .results = {{"lissom.Buffer", "buffer", "Its numbers."}},
         .effect = Effect::changes,
         .errors = {ErrorCode::invalid_argument},
         .example = R"(local mesh = lissom.shapes.box()
local heat = mesh:add_attribute{ name = "heat", values = 20 }
heat[1] = 100
assert(mesh:attribute("heat")[1] == 100))"},
        {.name = "remove_attribute",
         .body = remove_attribute,
         .summary = "Removes an attribute.",
         .arguments = {string("name", "Name of the attribute.")},
         .results = {{"boolean", "removed", "False if there was none."}},
         .effect = Effect::changes,
         .example = "assert(not lissom.shapes.box():remove_attribute('heat'))"}};
}

}  // namespace lissom::lua
