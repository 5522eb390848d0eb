#include "kernel/core/memory_hold.h"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "tests/unit/support.h"

using namespace lissom;

namespace {

std::shared_ptr<MemoryAccount> account_of(std::size_t limit) {
    return std::make_shared<MemoryAccount>(limit);
}

// An object as the kernel has them.
struct Numbers {
    explicit Numbers(std::shared_ptr<MemoryAccount> account)
        : hold(std::move(account), "numbers") {}
    void add(double x) {
        hold.resize((list.size() + 1) * sizeof(double));
        list.push_back(x);
    }

    MemoryHold hold;
    std::vector<double> list;
};

}  // namespace

TEST_CASE("a hold grows, shrinks, and goes with its object") {
    const auto account = account_of(0);
    {
        Numbers numbers(account);
        for (int i = 0; i < 10; ++i) numbers.add(i);
        CHECK(account->used() == 80);
        numbers.hold.resize(8);
        CHECK(account->used() == 8);
    }
    CHECK(account->used() == 0);
    CHECK(account->peak() == 80);
}

TEST_CASE("a copy of an object charges again, a move does not") {
    const auto account = account_of(0);
    Numbers first(account);
    first.add(1.0);
    Numbers copy = first;
    CHECK(account->used() == 16);
    const Numbers moved = std::move(copy);
    CHECK(account->used() == 16);
    first = moved;
    CHECK(account->used() == 16);
    Numbers elsewhere(account_of(0));
    elsewhere.add(1.0);
    elsewhere = moved;
    CHECK(account->used() == 24);
    first = Numbers(nullptr);
    CHECK(account->used() == 16);
}

TEST_CASE("a copy that has no room is not made, and nothing has changed") {
    const auto account = account_of(12);
    Numbers first(account);
    first.add(1.0);
    const Error error = test::error_of([&] { const Numbers copy = first; });
    CHECK(error.code() == ErrorCode::memory_limit);
    CHECK(error.message().find("numbers") != std::string::npos);
    CHECK(account->used() == 8);
    CHECK(test::error_of([&] { first.add(2.0); }).code() == ErrorCode::memory_limit);
    CHECK(first.list.size() == 1);
    CHECK(account->used() == 8);
}

TEST_CASE("a charge that no number of bytes can hold is refused") {
    const auto account = account_of(100);
    account->charge(10, "a little");
    const std::size_t most = std::numeric_limits<std::size_t>::max();
    CHECK(test::error_of([&] { account->charge(most - 5, "too much"); }).code() ==
          ErrorCode::memory_limit);
    CHECK(account->used() == 10);
    account->release(10);
}

TEST_CASE("an account within another is charged to both, or to none") {
    const auto outer = account_of(100);
    const auto inner = std::make_shared<MemoryAccount>(50, outer);
    inner->charge(40, "both");
    CHECK(outer->used() == 40);
    CHECK(test::error_of([&] { inner->charge(20, "the inner"); }).code() ==
          ErrorCode::memory_limit);
    CHECK(outer->used() == 40);
    outer->charge(60, "the outer");
    CHECK(test::error_of([&] { inner->charge(5, "the outer"); }).code() == ErrorCode::memory_limit);
    CHECK(inner->used() == 40);
    inner->release(40);
    CHECK(outer->used() == 60);
}

TEST_CASE("an overdraft lifts the limit of an account and of those around it while it lives") {
    const auto outer = account_of(10);
    const auto inner = std::make_shared<MemoryAccount>(10, outer);
    {
        const MemoryOverdraft overdraft(inner);
        CHECK_NOTHROW(inner->charge(20, "putting back"));
        CHECK_NOTHROW(outer->charge(20, "putting back"));
    }
    CHECK(test::error_of([&] { inner->charge(1, "more"); }).code() == ErrorCode::memory_limit);
    CHECK_NOTHROW(MemoryOverdraft(nullptr));
}

TEST_CASE("contexts share an account, and one context charges another") {
    ContextOptions options;
    options.memory_limit = 100;
    const Context first(options);
    options.memory = first.memory();
    const Context second(options);
    const MemoryCharge charge = second.charge(60, "the second");
    CHECK(first.memory()->used() == 60);
    CHECK(test::error_of([&] { (void)first.charge(60, "the first"); }).code() ==
          ErrorCode::memory_limit);
    const Context part = first.charging(account_of(1000));
    CHECK_NOTHROW((void)part.charge(500, "a part"));
    part.cancel();
    CHECK(first.cancelled());
}
