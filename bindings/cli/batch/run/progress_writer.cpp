#include "bindings/cli/batch/run/progress_writer.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bindings/cli/batch/plan/axis.h"

namespace lissom::cli {
namespace {

std::string duration_text(double seconds) {
    if (seconds < 0.0) return "?";
    const auto whole = static_cast<long long>(std::min(seconds, 1e9) + 0.5);
    if (whole < 120) return std::to_string(whole) + " s";
    if (whole < 7200) return std::to_string(whole / 60) + " min";
    return std::to_string(whole / 3600) + " h";
}

std::string rate_text(double rate) {
    const double shown = rate >= 1.0 ? rate : 60.0 * rate;
    return number_text(std::round(10.0 * shown) / 10.0) + (rate >= 1.0 ? " a second" : " a minute");
}

std::string progress_text(const BatchProgress& progress) {
    std::string text =
        std::to_string(progress.ended()) + " of " + std::to_string(progress.all) + " jobs";
    if (progress.failed > 0) text += ", " + std::to_string(progress.failed) + " failed";
    if (progress.rate() > 0.0) {
        text += ", " + rate_text(progress.rate()) + ", " + duration_text(progress.seconds_left()) +
                " left";
    }
    return text;
}

}  // namespace

Json progress_json(const BatchProgress& progress) {
    return {
        {"all", progress.all},
        {"kept", progress.kept},
        {"done", progress.done},
        {"failed", progress.failed},
        {"rate", progress.rate()},
        {"seconds", progress.seconds},
        {"seconds_left", progress.seconds_left() < 0.0 ? Json() : Json(progress.seconds_left())}};
}

void ProgressWriter::show(const BatchProgress& progress) {
    if (form_ == "auto") {
        const double fraction =
            progress.all > 0 ? static_cast<double>(progress.ended()) / progress.all : 1.0;
        program_.show_progress(progress_text(progress), fraction);
    } else if (form_ != "none" && (progress.seconds >= next_ || progress.ended() == progress.all)) {
        next_ = progress.seconds + 1.0;
        std::cerr << (form_ == "json" ? json_text(progress_json(progress), -1)
                                      : progress_text(progress))
                  << std::endl;
    }
}

}  // namespace lissom::cli
