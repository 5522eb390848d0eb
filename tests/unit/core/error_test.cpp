#include "kernel/core/error.h"

#include <algorithm>
#include <set>
#include <string>

#include "kernel/core/context.h"
#include "kernel/core/memory_error.h"
#include "tests/unit/support.h"

using namespace lissom;

TEST_CASE("every code has a name and an explanation of its own") {
    std::set<std::string_view> names, explanations;
    for (const ErrorCode code : all_codes()) {
        CHECK(code_name(code).size() > 2);
        CHECK(code_explanation(code).size() > 20);
        names.insert(code_name(code));
        explanations.insert(code_explanation(code));
    }
    CHECK(names.size() == all_codes().size());
    CHECK(explanations.size() == all_codes().size());
}

TEST_CASE("the table of codes follows the order of the enumeration") {
    const auto& codes = all_codes();
    for (std::size_t i = 0; i < codes.size(); ++i) CHECK(static_cast<std::size_t>(codes[i]) == i);
    CHECK(codes.front() == ErrorCode::cancelled);
    CHECK(codes.back() == ErrorCode::internal);
}

TEST_CASE("names are lower case words joined by underscores") {
    for (const ErrorCode code : all_codes()) {
        const std::string_view name = code_name(code);
        CHECK(std::all_of(name.begin(), name.end(),
                          [](char c) { return c == '_' || (c >= 'a' && c <= 'z'); }));
    }
    CHECK(code_name(ErrorCode::nonmanifold_edge) == "nonmanifold_edge");
    CHECK(code_name(ErrorCode::file_not_found) == "file_not_found");
}

TEST_CASE("an error keeps its code, message and elements") {
    Elements elements{ElementKind::vertex, 0, {}};
    elements.add(7);
    const Error error(ErrorCode::out_of_range, "no such vertex", elements);
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(std::string(error.what()) == "no such vertex");
    CHECK(error.elements().ids == std::vector<Index>{7});
}

TEST_CASE("elements beyond the limit are counted but not kept") {
    Elements vertices{ElementKind::vertex, 0, {}};
    for (Index i = 0; i < 250; ++i) vertices.add(i);
    CHECK(vertices.count == 250);
    CHECK(vertices.ids.size() == Elements::kMaximumIds);

    Elements edges{ElementKind::edge, 0, {}};
    for (Index i = 0; i < 250; ++i) edges.add_edge(i, i + 1);
    CHECK(edges.count == 250);
    CHECK(edges.ids.size() == Elements::kMaximumIds);
}

TEST_CASE("elements are described in words, from the base asked for") {
    Elements elements{ElementKind::vertex, 0, {}};
    elements.add(2);
    CHECK(describe(elements) == "vertex 2");
    CHECK(describe(elements, 1) == "vertex 3");
    elements.add(8);
    elements.add(11);
    CHECK(describe(elements, 1) == "vertices 3, 9 and 12");
    for (Index i = 0; i < 247; ++i) elements.add(i);
    CHECK(describe(elements, 1, 3) == "vertices 3, 9, 12 (of 250)");

    Elements edges{ElementKind::edge, 0, {}};
    edges.add_edge(0, 4);
    edges.add_edge(4, 5);
    CHECK(describe(edges, 1) == "edges 1-5 and 5-6");
}

TEST_CASE("every kind of element has a name") {
    CHECK(kind_name(ElementKind::none) == "element");
    CHECK(kind_name(ElementKind::component) == "component");
    CHECK(kind_name(ElementKind::line) == "line");
}

TEST_CASE("memory that runs out is an error with a code") {
    const auto code_of = [](const auto& work) {
        try {
            with_memory_errors(work);
            return ErrorCode::internal;
        } catch (const Error& error) {
            return error.code();
        }
    };
    CHECK(code_of([] { throw std::bad_alloc(); }) == ErrorCode::memory_limit);
    CHECK(code_of([] { throw std::bad_array_new_length(); }) == ErrorCode::memory_limit);
    CHECK(code_of([] { throw std::length_error("vector"); }) == ErrorCode::memory_limit);
    CHECK(code_of([] { throw Error(ErrorCode::cancelled, "stop"); }) == ErrorCode::cancelled);
    CHECK(with_memory_errors([] { return 7; }) == 7);
    const Context context;
    CHECK(code_of([&] {
              context.parallel_for(0, 10, 1, [](Index, Index) { throw std::bad_alloc(); });
          }) == ErrorCode::memory_limit);
}

TEST_CASE("a long message keeps its beginning and its end, and its characters whole") {
    for (const std::string before : {"", "a", "ab"}) {
        std::string name;
        for (int i = 0; i < 1'000'000; ++i) name += "\xe2\x82\xac";
        const Error error(ErrorCode::out_of_range,
                          before + "there is no '" + name + "'; look at the list");
        CHECK(error.message().size() < 4200);
        CHECK(error.message().find(before + "there is no '\xe2\x82\xac") == 0);
        CHECK(error.message().ends_with("\xe2\x82\xac'; look at the list"));
        CHECK(error.message().find("\xe2\x82\xac [...] \xe2\x82\xac") != std::string::npos);
    }
    const Error short_error(ErrorCode::out_of_range, std::string(4096, 'x'));
    CHECK(short_error.message() == std::string(4096, 'x'));
}
