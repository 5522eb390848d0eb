/// Compares two files of `./dev bench --json`: which ratios got worse, and which changes are noise.
///
///     compare_benches BEFORE.json AFTER.json
///     compare_benches --in-turns BEFORE.json AFTER.json BEFORE.json AFTER.json ...
///
/// A ratio was taken in turns in one run, with quartiles. It has changed where the quartiles of
/// both files do not meet and the medians differ by more than 5 %. Times of different runs are
/// shown and not judged. Of two programs that ran in turns every row is judged, by the best of its
/// times or the median of its ratios: it is worse where it differs by more than 10 %. The exit
/// status is 1 where one got worse, 2 where a file cannot be read.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr double kSmallest = 0.05;
constexpr double kSmallestInTurns = 0.10;

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

// Each row of the files, with the best of its times: what else a machine does makes them longer. It
// makes ratios longer or shorter, so that the median is taken of those.
Rows typical_of(const std::vector<Rows>& runs) {
    std::map<std::string, std::vector<double>> values;
    for (const Rows& run : runs) {
        for (const auto& [name, row] : run) values[name].push_back(row.at("value"));
    }
    Rows typical = runs.front();
    for (auto& [name, row] : typical) {
        std::vector<double>& of_row = values[name];
        std::sort(of_row.begin(), of_row.end());
        const bool less = row.at("better") == "less";
        if (!row.at("ratio").is_null()) {
            row["value"] = of_row[of_row.size() / 2];
        } else {
            row["value"] = less ? of_row.front() : of_row.back();
        }
    }
    return typical;
}

// Prints a line a row; how many are worse in `after`.
int compare_in_turns(const Rows& before, const Rows& after) {
    int worse = 0;
    std::printf("%-66s %10s %10s %8s\n", "best time, median of ratios", "before", "after",
                "change");
    for (const auto& [name, now] : after) {
        const auto was = before.find(name);
        if (was == before.end()) continue;
        const double old_value = was->second.at("value"), value = now.at("value");
        const bool less = now.at("better") == "less";
        const bool is_worse = less ? value > (1.0 + kSmallestInTurns) * old_value
                                   : old_value > (1.0 + kSmallestInTurns) * value;
        worse += is_worse;
        std::printf("%-66s %10.4g %10.4g %+7.1f%%%s\n", name.c_str(), old_value, value,
                    100.0 * (value / old_value - 1.0), is_worse ? " WORSE" : "");
    }
    return worse;
}

int compare_files(int argc, char** argv) {
    if (argc == 3) return compare(read_rows(argv[1]), read_rows(argv[2]));
    std::vector<Rows> runs[2];
    for (int i = 2; i < argc; ++i) runs[i % 2].push_back(read_rows(argv[i]));
    return compare_in_turns(typical_of(runs[0]), typical_of(runs[1]));
}

}  // namespace

int main(int argc, char** argv) {
    const bool in_turns = argc >= 4 && argc % 2 == 0 && argv[1] == std::string_view("--in-turns");
    if (argc != 3 && !in_turns) {
        std::fprintf(stderr, "usage: compare_benches [--in-turns] BEFORE.json AFTER.json ...\n");
        return 2;
    }
    try {
        const int worse = compare_files(argc, argv);
        std::printf("\n%d worse\n", worse);
        return worse > 0 ? 1 : 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "compare_benches: %s\n", error.what());
        return 2;
    }
}
