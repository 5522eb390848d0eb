/// Rows of a benchmark, printed as a table or as JSON.
///
/// Machines differ by three times, so that a time alone says little: what is to be reached is a
/// ratio of two things timed in turns in one run, ours and a peer's, or ours and a limit of the
/// machine. Times are shown without a target.
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

/// Quotients of two measurements taken in turns: their median and quartiles, and the median of
/// either.
struct Quotient {
    double value = 0.0, low = 0.0, high = 0.0;
    double above = 0.0, below = 0.0;
};

struct Row {
    std::string name;
    double value = 0.0;
    std::string unit;
    /// The value to reach; negative where the row is shown only.
    double target = -1.0;
    Better better = Better::less;
    /// What a ratio is taken against, with quartiles of the ratio; empty for other values.
    std::string peer = {};
    double low = 0.0, high = 0.0;
    /// By what a row is bound that misses its target, in shares of a profile.
    std::string bound_by = {};

    bool reached() const { return better == Better::less ? value <= target : value >= target; }
};

class Report {
  public:
    /// Understands --json, and --part=NAME where a benchmark asks for its parts.
    Report(int argc, char** argv) {
        for (int i = 1; i < argc; ++i) {
            const std::string_view option = argv[i];
            json_ = json_ || option == "--json";
            if (option.starts_with("--part=")) part_ = option.substr(7);
        }
    }
    ~Report() {
        if (json_) print_json();
        if (part_.empty() || found_part_) return;
        std::fprintf(stderr, "no part '%s'; there are:%s\n", part_.c_str(), parts_.c_str());
    }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;

    /// Whether this part is to be run: it is the one asked for, or none was.
    bool wants(const std::string& part) {
        parts_ += " " + part;
        found_part_ = found_part_ || part == part_;
        return part_.empty() || part == part_;
    }
    void add(Row row) {
        if (!json_) print(row);
        rows_.push_back(std::move(row));
    }
    /// A ratio of ours and `peer`, or of `peer` and ours.
    void add_ratio(const std::string& name, const std::string& peer, const Quotient& quotient,
                   double target = -1.0, Better better = Better::less,
                   const std::string& bound_by = {}) {
        add({name, quotient.value, "x", target, better, peer, quotient.low, quotient.high,
             bound_by});
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
        if (!row.peer.empty()) std::printf(" (%.3g .. %.3g)", row.low, row.high);
        if (row.target >= 0.0) {
            std::printf(" target %s %g: %s", row.better == Better::less ? "<=" : ">=", row.target,
                        row.reached() ? "reached" : "MISSED");
        }
        std::printf("\n");
        if (is_explained(row)) std::printf("      bound by %s\n", row.bound_by.c_str());
        std::fflush(stdout);
    }
    static bool is_explained(const Row& row) {
        return row.target >= 0.0 && !row.reached() && !row.bound_by.empty();
    }
    // "key": value, or null where there is none.
    static void print_number(const char* key, double value, bool present) {
        std::printf(", \"%s\": ", key);
        if (present) {
            std::printf("%.6g", value);
        } else {
            std::printf("null");
        }
    }
    static void print_object(const Row& row) {
        const bool ratio = !row.peer.empty();
        std::printf("{\"name\": \"%s\", \"unit\": \"%s\", \"peer\": ", row.name.c_str(),
                    row.unit.c_str());
        std::printf(ratio ? "\"%s\"" : "null%s", row.peer.c_str());
        print_number("value", row.value, true);
        print_number("ratio", row.value, ratio);
        print_number("low", row.low, ratio);
        print_number("high", row.high, ratio);
        print_number("target", row.target, row.target >= 0.0);
        std::printf(", \"better\": \"%s\"", row.better == Better::less ? "less" : "more");
        if (is_explained(row)) std::printf(", \"bound_by\": \"%s\"", row.bound_by.c_str());
        std::printf("}");
    }
    void print_json() const {
        std::printf("[\n");
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            std::printf("  ");
            print_object(rows_[i]);
            std::printf(i + 1 < rows_.size() ? ",\n" : "\n");
        }
        std::printf("]\n");
    }

    bool json_ = false, found_part_ = false;
    std::string part_, parts_;
    std::vector<Row> rows_;
};

/// The value below which `part` of the values lie.
inline double quantile(std::vector<double> values, double part) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

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
    return quantile(times, 0.5);
}

/// Quotients of what `above` and `below` return, called in turns `repeats` times: what else the
/// machine does then meets both alike.
template <typename Above, typename Below>
Quotient quotient_of(int repeats, const Above& above, const Below& below) {
    std::vector<double> quotients, aboves, belows;
    for (int i = 0; i < repeats; ++i) {
        aboves.push_back(above());
        belows.push_back(below());
        quotients.push_back(aboves.back() / belows.back());
    }
    return {quantile(quotients, 0.5), quantile(quotients, 0.25), quantile(quotients, 0.75),
            quantile(aboves, 0.5), quantile(belows, 0.5)};
}

/// The same of the seconds of two actions.
template <typename Above, typename Below>
Quotient seconds_quotient(int repeats, const Above& above, const Below& below) {
    return quotient_of(
        repeats, [&] { return seconds(above); }, [&] { return seconds(below); });
}

}  // namespace lissom::bench
