#include "bindings/c/script/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/numbers/number_text.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/utf8.h"

namespace lissom::c {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse_arguments(const std::string& why) {
    throw Error(ErrorCode::invalid_argument, "arguments: " + why);
}

// Takes what nlohmann's parser tells of; errors are thrown through it.
class Reader final : public Json::json_sax_t {
  public:
    explicit Reader(const Context& context) : context_(context) {}

    List take() {
        auto* list = std::get_if<List>(&root_.content);
        if (!list) refuse_arguments("they are not a JSON list");
        return std::move(*list);
    }

    bool null() override { return add({}); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(std::int64_t value) override { return add(value); }
    bool number_unsigned(std::uint64_t value) override {
        if (value > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
            refuse_number(std::to_string(value));
        }
        return add(static_cast<std::int64_t>(value));
    }
    // An integer beyond 64 bits comes as a double.
    bool number_float(double value, const std::string& text) override {
        if (text.find_first_of(".eE") == std::string::npos) refuse_number(text);
        return add(value);
    }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(Json::binary_t&) override { return false; }

    bool start_array(std::size_t) override { return open(List()); }
    bool start_object(std::size_t) override { return open(Fields()); }
    bool end_array() override { return close(); }
    bool end_object() override {
        const auto& fields = std::get<Fields>(open_.back()->content);
        std::vector<std::string_view> names(fields.names.begin(), fields.names.end());
        std::sort(names.begin(), names.end());
        const auto twice = std::adjacent_find(names.begin(), names.end());
        if (twice != names.end()) {
            refuse_arguments("a table has the name '" + std::string(*twice) + "' twice");
        }
        return close();
    }
    bool key(std::string& name) override {
        std::get<Fields>(open_.back()->content).add(std::move(name), {});
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token,
                     const Json::exception& error) override {
        constexpr int kNumberTooLarge = 406;
        if (error.id == kNumberTooLarge) refuse_number(token);
        refuse_arguments("no JSON at byte " + std::to_string(position) +
                         (token.empty() ? "" : ", near '" + token + "'"));
    }

  private:
    [[noreturn]] static void refuse_number(const std::string& text) {
        refuse_arguments("the number " + text + " is out of range");
    }

    // The place of a value that comes now.
    Value& place(Value value) {
        if (++placed_ % kValuesPerCheckpoint == 0) context_.checkpoint();
        if (open_.empty()) return root_ = std::move(value);
        if (auto* list = std::get_if<List>(&open_.back()->content)) {
            return list->emplace_back(std::move(value));
        }
        return std::get<Fields>(open_.back()->content).values.back() = std::move(value);
    }
    bool add(Value value) {
        place(std::move(value));
        return true;
    }
    bool open(Value value) {
        if (static_cast<int>(open_.size()) > kDepth) refuse_arguments("they are nested too deeply");
        open_.push_back(&place(std::move(value)));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    static constexpr std::size_t kValuesPerCheckpoint = 1024;

    const Context& context_;
    std::size_t placed_ = 0;
    Value root_;
    // The lists and tables that are open. What they stand in does not grow before they are closed.
    std::vector<Value*> open_;
};

void write_text(std::string& json, const std::string& text) {
    const bool plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return c >= 0x20 && c < 0x7f && c != '"' && c != '\\';
    });
    if (plain) {
        json += '"' + text + '"';
    } else {
        if (!is_utf8(text)) {
            throw Error(ErrorCode::invalid_argument,
                        "a text is not UTF-8, which JSON cannot hold: " + in_quotes(text));
        }
        json += Json(text).dump();
    }
}

template <typename Number>
void write_number(std::string& json, Number number) {
    char text[64];
    const char* end = lissom::write_number(text, text + sizeof text, number).ptr;
    json.append(static_cast<const char*>(text), end);
    const bool whole = std::all_of(static_cast<const char*>(text), end,
                                   [](char c) { return c == '-' || (c >= '0' && c <= '9'); });
    // A double stays one.
    if (std::is_floating_point_v<Number> && whole) json += ".0";
}

void write_value(std::string& json, const Value& value);

void write_list(std::string& json, const List& list) {
    json += '[';
    for (const Value& item : list) {
        if (&item != list.data()) json += ',';
        write_value(json, item);
    }
    json += ']';
}

void write_fields(std::string& json, const Fields& fields) {
    json += '{';
    for (std::size_t i = 0; i < fields.values.size(); ++i) {
        if (i > 0) json += ',';
        write_text(json, fields.names[i]);
        json += ':';
        write_value(json, fields.values[i]);
    }
    json += '}';
}

struct Writer {
    std::string& json;

    void operator()(std::monostate) const { json += "null"; }
    void operator()(bool value) const { json += value ? "true" : "false"; }
    void operator()(std::int64_t value) const { write_number(json, value); }
    void operator()(double value) const { write_number(json, value); }
    void operator()(const std::string& value) const { write_text(json, value); }
    void operator()(const List& value) const { write_list(json, value); }
    void operator()(const Fields& value) const { write_fields(json, value); }
};

void write_value(std::string& json, const Value& value) {
    std::visit(Writer{json}, value.content);
}

}  // namespace

void Fields::add(std::string name, Value value) {
    values.push_back(std::move(value));
    names.push_back(std::move(name));
}

List list_of_json(std::string_view text, const Context& context) {
    Reader reader(context);
    Json::sax_parse(text.begin(), text.end(), &reader);
    return reader.take();
}

std::string json_of(const List& list) {
    std::string json;
    write_list(json, list);
    return json;
}

}  // namespace lissom::c
