#include "kernel/core/context.h"

#include <string>
#include <utility>
#include <vector>

#include "tests/unit/support.h"

using namespace lissom;

TEST_CASE("the default context is silent, serial and unlimited") {
    const Context context;
    context.log(LogLevel::warning, "nobody hears this");
    CHECK(context.threads() == 1);
    CHECK(context.memory()->limit() == 0);
    CHECK_NOTHROW(context.checkpoint());
}

TEST_CASE("cancel is sticky until it is cleared, and shared by copies") {
    const Context context;
    const Context copy = context;
    context.cancel();
    CHECK(copy.cancelled());
    CHECK(test::error_of([&] { copy.checkpoint(); }).code() == ErrorCode::cancelled);
    CHECK(test::error_of([&] { copy.checkpoint(); }).code() == ErrorCode::cancelled);
    copy.clear_cancel();
    CHECK_NOTHROW(context.checkpoint());
}

TEST_CASE("a cancelled context starts nothing") {
    const Context context;
    context.cancel();
    CHECK(test::error_of([&] { Progress(context, "work"); }).code() == ErrorCode::cancelled);
    bool ran = false;
    const auto loop = [&] { context.parallel_for(0, 10, 1, [&](Index, Index) { ran = true; }); };
    CHECK(test::error_of(loop).code() == ErrorCode::cancelled);
    CHECK(!ran);
}

TEST_CASE("messages reach the host's log") {
    std::vector<std::pair<LogLevel, std::string>> heard;
    ContextOptions options;
    options.log = [&](LogLevel level, std::string_view message) {
        heard.emplace_back(level, std::string(message));
    };
    Context(options).log(LogLevel::info, "hello");
    REQUIRE(heard.size() == 1);
    CHECK(heard[0].first == LogLevel::info);
    CHECK(heard[0].second == "hello");
}

TEST_CASE("memory is charged while the charge lives") {
    const Context context;
    {
        const MemoryCharge charge = context.charge(1000, "a test");
        CHECK(context.memory()->used() == 1000);
    }
    CHECK(context.memory()->used() == 0);
    CHECK(context.memory()->peak() == 1000);
}

TEST_CASE("a charge over the limit is refused by name and adds nothing") {
    ContextOptions options;
    options.memory_limit = 1500;
    const Context context(options);
    const MemoryCharge held = context.charge(1000, "the first");
    const Error error = test::error_of([&] { (void)context.charge(501, "the second"); });
    CHECK(error.code() == ErrorCode::memory_limit);
    CHECK(error.message().find("the second") != std::string::npos);
    CHECK(context.memory()->used() == 1000);
    CHECK_NOTHROW((void)context.charge(500, "what still fits"));
}

TEST_CASE("a charge moves and is released once") {
    const Context context;
    MemoryCharge first = context.charge(100, "one");
    MemoryCharge second = std::move(first);
    CHECK(first.bytes() == 0);
    CHECK(context.memory()->used() == 100);
    second = context.charge(30, "two");
    CHECK(context.memory()->used() == 30);
    second = MemoryCharge();
    CHECK(context.memory()->used() == 0);
}

TEST_CASE("a charge may outlive its context") {
    MemoryCharge charge;
    {
        const Context context;
        charge = context.charge(10, "longer than the context");
    }
    CHECK(charge.bytes() == 10);
}
