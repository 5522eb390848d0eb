/// Rows of a benchmark, printed as a table or as JSON.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lissom::bench {

/// Whether smaller or greater values are better.
enum class Better { less, more };

struct Row {
    std::string name;
    double value = 0.0;
    std::string unit;
    /// The value to reach; negative where the row is for comparison only.
    double target = -1.0;
    Better better = Better::less;

    bool reached() const { return better == Better::less ? value <= target : value >= target; }
};

class Report {
  public:
    /// Understands --json.
    Report(int argc, char** argv) {
        for (int i = 1; i < argc; ++i) json_ = json_ || std::string_view(argv[i]) == "--json";
    }
    ~Report() {
        if (json_) print_json();
    }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;

    void add(Row row) {
        if (!json_) print(row);
        rows_.push_back(std::move(row));
    }
    /// A row of the JSON alone; the table shows its value in another way.
    void add_to_json(Row row) { rows_.push_back(std::move(row)); }
    /// A line between rows of the table; not part of the JSON.
    void title(const std::string& text) const {
        if (!json_) std::printf("\n%s\n", text.c_str());
    }
    /// A line of the table; not part of the JSON.
    void line(const std::string& text) const {
        if (!json_) std::printf("%s\n", text.c_str());
        std::fflush(stdout);
    }

  private:
    static void print(const Row& row) {
        std::printf("  %-58s %10.4g %-8s", row.name.c_str(), row.value, row.unit.c_str());
        if (row.target >= 0.0) {
            std::printf(" target %s %g: %s", row.better == Better::less ? "<=" : ">=", row.target,
                        row.reached() ? "reached" : "MISSED");
        }
        std::printf("\n");
        std::fflush(stdout);
    }
    void print_json() const {
        std::printf("[\n");
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const Row& row = rows_[i];
            std::printf("  {\"name\": \"%s\", \"value\": %.6g, \"unit\": \"%s\", \"target\": ",
                        row.name.c_str(), row.value, row.unit.c_str());
            if (row.target >= 0.0) std::printf("%g", row.target);
            if (row.target < 0.0) std::printf("null");
            std::printf(", \"better\": \"%s\"}%s\n", row.better == Better::less ? "less" : "more",
                        i + 1 < rows_.size() ? "," : "");
        }
        std::printf("]\n");
    }

    bool json_ = false;
    std::vector<Row> rows_;
};

/// Seconds that `action` takes once.
template <typename Action>
double seconds(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Median of the seconds of `repeats` runs.
template <typename Action>
double median_seconds(int repeats, const Action& action) {
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) times.push_back(seconds(action));
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[static_cast<std::size_t>(repeats / 2)];
}

}  // namespace lissom::bench
