/// Compares two files of `./dev bench --json`: which ratios got worse, and which changes are noise.
///
///     compare_benches BEFORE.json AFTER.json
///
/// A ratio was taken in turns in one run, with quartiles. It has changed where the quartiles of
/// both files do not meet and the medians differ by more than 5 %. Times of different runs are
/// shown and not judged. The exit status is 1 where a ratio got worse, 2 where a file cannot be
/// read.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace {

constexpr double kSmallest = 0.05;

using Rows = std::map<std::string, nlohmann::json>;

Rows read_rows(const char* path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(std::string("cannot open ") + path);
    Rows rows;
    for (const nlohmann::json& row : nlohmann::json::parse(file)) rows[row.at("name")] = row;
    return rows;
}

enum class Verdict { shown, same, better, worse };

Verdict verdict_of(const nlohmann::json& before, const nlohmann::json& after) {
    if (before.at("ratio").is_null() || after.at("ratio").is_null()) return Verdict::shown;
    const double was = before.at("ratio"), is = after.at("ratio");
    const bool apart = before.at("high") < after.at("low") || after.at("high") < before.at("low");
    if (!apart || std::abs(is - was) <= kSmallest * std::abs(was)) return Verdict::same;
    return (is < was) == (after.at("better") == "less") ? Verdict::better : Verdict::worse;
}

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::shown:
            return "";
        case Verdict::same:
            return "noise";
        case Verdict::better:
            return "better";
        case Verdict::worse:
            return "WORSE";
    }
    return "";
}

// Prints a line a row; how many got worse.
int compare(const Rows& before, const Rows& after) {
    int worse = 0;
    std::printf("%-66s %10s %10s %8s\n", "", "before", "after", "change");
    for (const auto& [name, now] : after) {
        const auto was = before.find(name);
        if (was == before.end()) {
            std::printf("%-66s %10s %10.4g      new\n", name.c_str(), "",
                        now.at("value").get<double>());
            continue;
        }
        const double old_value = was->second.at("value"), value = now.at("value");
        const Verdict verdict = verdict_of(was->second, now);
        worse += verdict == Verdict::worse;
        std::printf("%-66s %10.4g %10.4g %+7.1f%% %s\n", name.c_str(), old_value, value,
                    100.0 * (value / old_value - 1.0), name_of(verdict));
    }
    for (const auto& [name, was] : before) {
        if (!after.count(name)) std::printf("%-66s gone\n", name.c_str());
    }
    return worse;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: compare_benches BEFORE.json AFTER.json\n");
        return 2;
    }
    try {
        const int worse = compare(read_rows(argv[1]), read_rows(argv[2]));
        std::printf("\n%d worse\n", worse);
        return worse > 0 ? 1 : 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "compare_benches: %s\n", error.what());
        return 2;
    }
}
