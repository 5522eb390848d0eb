#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

struct Recorder {
    std::vector<double> fractions;
    std::vector<std::string> labels;

    Context context() {
        ContextOptions options;
        options.progress = [this](std::string_view label, double fraction) {
            labels.emplace_back(label);
            fractions.push_back(fraction);
        };
        return Context(options);
    }
    bool monotonic() const {
        for (std::size_t i = 1; i < fractions.size(); ++i) {
            if (fractions[i] < fractions[i - 1]) return false;
        }
        return true;
    }
};

void inner_work(const Context& context) {
    Progress progress(context, "inner");
    progress.step(0.5);
    progress.update(1.0);
    progress.step(0.5);
    progress.update(0.5);
    progress.update(1.0);
}

}  // namespace

TEST_CASE("progress without steps covers the whole operation") {
    Recorder recorder;
    const Context context = recorder.context();
    Progress progress(context, "work");
    progress.update(0.25);
    progress.update(1.0);
    CHECK(recorder.fractions == std::vector<double>{0.0, 0.25, 1.0});
    CHECK(recorder.labels.back() == "work");
}

TEST_CASE("an operation inside another fills the step announced for it") {
    Recorder recorder;
    const Context context = recorder.context();
    Progress progress(context, "outer");
    progress.step(0.2);
    inner_work(context);
    CHECK(recorder.fractions.back() == doctest::Approx(0.2));
    progress.step(0.8);
    inner_work(context);
    CHECK(recorder.fractions.back() == doctest::Approx(1.0));
    CHECK(recorder.monotonic());
}

TEST_CASE("progress never decreases and never leaves 0 to 1") {
    Recorder recorder;
    const Context context = recorder.context();
    Progress progress(context, "work");
    for (const double fraction : {0.5, 0.2, -3.0, 0.7, 9.0, 0.1}) progress.update(fraction);
    CHECK(recorder.monotonic());
    CHECK(recorder.fractions.front() == 0.0);
    CHECK(recorder.fractions.back() == 1.0);
}

TEST_CASE("each operation of the outermost level starts from 0") {
    Recorder recorder;
    const Context context = recorder.context();
    inner_work(context);
    recorder.fractions.clear();
    inner_work(context);
    CHECK(recorder.fractions.front() == 0.0);
    CHECK(recorder.fractions.back() == doctest::Approx(1.0));
}

TEST_CASE("every report is a checkpoint") {
    const Context context;
    Progress progress(context, "work");
    context.cancel();
    CHECK(test::error_of([&] { progress.step(0.5); }).code() == ErrorCode::cancelled);
    CHECK(test::error_of([&] { progress.update(0.5); }).code() == ErrorCode::cancelled);
}

TEST_CASE("an operation that was cancelled leaves progress ready for the next") {
    Recorder recorder;
    const Context context = recorder.context();
    try {
        Progress progress(context, "cancelled");
        progress.step(0.9);
        context.cancel();
        inner_work(context);
    } catch (const Error&) {
        context.clear_cancel();
    }
    recorder.fractions.clear();
    inner_work(context);
    CHECK(recorder.fractions.front() == 0.0);
    CHECK(recorder.fractions.back() == doctest::Approx(1.0));
}
