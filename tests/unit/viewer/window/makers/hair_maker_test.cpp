#include "viewer/window/makers/hair_maker.h"

#include <condition_variable>
#include <mutex>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/render/strands/strand_support.h"

using namespace lissom;
using namespace lissom::window;

namespace {

// Counts what the maker has told, and waits for it.
class Told {
  public:
    std::function<void()> teller() {
        return [this] {
            const std::lock_guard lock(mutex_);
            ++count_;
            changed_.notify_all();
        };
    }
    void wait_for(int count) {
        std::unique_lock lock(mutex_);
        REQUIRE(changed_.wait_for(lock, std::chrono::seconds(60), [&] { return count_ >= count; }));
    }
    int count() {
        const std::lock_guard lock(mutex_);
        return count_;
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int count_ = 0;
};

void wait_idle(const HairMaker& maker) {
    for (int i = 0; i < 6000 && maker.busy(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    REQUIRE_FALSE(maker.busy());
}

Snapshot curtain_snapshot(Index count, double z = 0.0) {
    return test::drawing_of(test::curtain(count, z, 0.01));
}

}  // namespace

TEST_CASE("hair maker: few strands come first, then all, and nothing for the same hair again") {
    Told told;
    HairMaker maker(2, told.teller());
    const Snapshot snapshot = curtain_snapshot(500);
    maker.make(snapshot);
    told.wait_for(1);
    const auto first = maker.take();
    told.wait_for(2);
    wait_idle(maker);
    // The second may have come before the first was taken.
    const auto second = maker.take();
    REQUIRE(first);
    const Hair all = second ? second->hair : first->hair;
    REQUIRE(all.parts.size() == 1);
    CHECK(all.parts[0].packed->all.size() == 500);
    CHECK(all.light);
    if (second) {
        CHECK(first->hair.parts[0].packed->all.size() == 0);
        CHECK(first->hair.parts[0].packed->few.size() == 500);
        CHECK(first->hair.light->grid().size() <= all.light->grid().size());
    }
    maker.make(snapshot);
    CHECK_FALSE(maker.busy());
    CHECK(told.count() == 2);
}

TEST_CASE("hair maker: strands that stay are not packed again, others are, none are gone") {
    Told told;
    HairMaker maker(2, told.teller());
    Snapshot snapshot = curtain_snapshot(50);
    snapshot.strands.push_back(curtain_snapshot(60, 1.0).strands[0]);
    maker.make(snapshot);
    wait_idle(maker);
    const Hair before = maker.take()->hair;
    // A mesh that moves changes the light alone.
    snapshot.meshes = {{test::shared(make_box())}};
    maker.make(snapshot);
    wait_idle(maker);
    const Hair lit = maker.take()->hair;
    CHECK(lit.parts[0].packed == before.parts[0].packed);
    CHECK(lit.light != before.light);
    snapshot.strands[0].style.color = kWhite;
    maker.make(snapshot);
    wait_idle(maker);
    const Hair colored = maker.take()->hair;
    CHECK(colored.parts[0].packed != before.parts[0].packed);
    CHECK(colored.parts[1].packed == before.parts[1].packed);
    snapshot.strands.erase(snapshot.strands.begin());
    maker.make(snapshot);
    wait_idle(maker);
    const Hair one = maker.take()->hair;
    REQUIRE(one.parts.size() == 1);
    CHECK(one.parts[0].packed == before.parts[1].packed);
    snapshot.strands.clear();
    maker.make(snapshot);
    wait_idle(maker);
    const auto none = maker.take();
    REQUIRE(none);
    CHECK(none->hair.parts.empty());
    CHECK_FALSE(none->hair.light);
}

TEST_CASE("hair maker: a style that cannot be drawn is told, and the next hair is made") {
    Told told;
    HairMaker maker(1, told.teller());
    Snapshot snapshot = curtain_snapshot(5);
    snapshot.strands[0].style.unit = -1.0;
    maker.make(snapshot);
    wait_idle(maker);
    const auto wrong = maker.take();
    REQUIRE(wrong);
    CHECK_FALSE(wrong->error.empty());
    snapshot.strands[0].style.unit = 1.0;
    maker.make(snapshot);
    wait_idle(maker);
    CHECK(maker.take()->hair.parts.size() == 1);
}

TEST_CASE("hair maker: light for one camera comes with its number, and not once it is given up") {
    Told told;
    HairMaker maker(1, told.teller());
    maker.make(curtain_snapshot(50));
    wait_idle(maker);
    const auto light = maker.take()->hair.light;
    maker.direct(light, Mat3::Identity(), 7);
    wait_idle(maker);
    const auto directed = maker.take_directed();
    REQUIRE(directed);
    CHECK(directed->number == 7);
    CHECK(directed->light == light);
    CHECK(directed->bytes == light->directed(Mat3::Identity()));
    CHECK_FALSE(maker.take_directed());
}
