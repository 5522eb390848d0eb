#include "bindings/cli/test/report.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace lissom::cli {
namespace {

// Returns a duration in seconds, to a hundredth.
std::string duration_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f s", seconds);
    return text;
}

std::string counted(int count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string place_text(const TestLine& place) {
    return place.file + ":" + std::to_string(place.line);
}

// An event of a file has no name of a test.
std::string shown_name(const TestResult& test) {
    return test.name.empty() ? "the file" : test.name;
}

std::string source_line(const TestLine& place) {
    std::ifstream stream(place.file);
    std::string line;
    for (int i = 0; i < place.line && std::getline(stream, line); ++i) {
    }
    return stream ? line : "";
}

// Each line behind `indent`; the last one ends, too.
std::string indented(const std::string& text, const std::string& indent) {
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);) result += indent + line + "\n";
    return result;
}

// The message, whose first line stands behind the place.
std::string message_text(const TestResult& test, const std::string& indent) {
    std::string text = indented(test.message, indent + "    ");
    text.replace(0, indent.size() + 4, indent + place_text(test.place) + ": ");
    return text;
}

std::string output_text(const TestResult& test, const std::string& indent) {
    if (test.output.empty()) return "";
    return indent + "it printed:\n" + indented(test.output, indent + "  | ");
}

std::string failure_text(const TestResult& test, bool verbose) {
    const std::string indent = "    ";
    std::string text = message_text(test, indent);
    const std::string source = source_line(test.place);
    if (!source.empty())
        text += indent + "  " + std::to_string(test.place.line) + " | " + source + "\n";
    for (const TestLine& caller : test.callers) {
        text += indent + "  called from " + place_text(caller) + "\n";
    }
    if (!verbose) text += output_text(test, indent + "  ");
    if (!test.folder.empty()) text += indent + "  its files are in " + test.folder + "\n";
    return text;
}

const char* status_word(TestStatus status) {
    return status == TestStatus::passed   ? "passed"
           : status == TestStatus::failed ? "failed"
                                          : "skipped";
}

std::string test_text(const FileResult& file, const TestResult& test, bool verbose) {
    std::string text;
    const std::string full = file.file + ": " + shown_name(test);
    if (verbose || test.status == TestStatus::failed) {
        text += "  " + std::string(status_word(test.status)) + "  " + shown_name(test) + "  (" +
                duration_text(test.seconds) + ")\n";
    }
    if (test.status == TestStatus::failed) text += failure_text(test, verbose);
    if (verbose) text += output_text(test, "    ");
    if (test.status == TestStatus::skipped)
        text += "  skipped: " + full + ": " + test.message + "\n";
    for (const std::string& reason : test.left_out) {
        text += "  skipped: " + full + ": a picture: " + reason + "\n";
    }
    for (const std::string& path : test.updated) text += "  wrote " + path + "\n";
    return text;
}

TestCounts counts_of(const std::vector<FileResult>& results) {
    TestCounts counts;
    for (const FileResult& result : results) counts.add(result);
    return counts;
}

// ---- TAP

std::string tap_name(const std::string& name) {
    std::string text;
    for (const char c : name) {
        if (c == '#' || c == '\\') text += '\\';
        text += c == '\n' || c == '\r' ? ' ' : c;
    }
    return text;
}

// A text of JSON is one of YAML.
std::string yaml_line(const std::string& key, const std::string& value) {
    return "  " + key + ": " + json_text(value, -1) + "\n";
}

std::string tap_details(const TestResult& test) {
    std::string text =
        "  ---\n" + yaml_line("message", test.message) + yaml_line("at", place_text(test.place));
    if (!test.output.empty()) text += yaml_line("output", test.output);
    if (!test.folder.empty()) text += yaml_line("files", test.folder);
    return text + "  ...\n";
}

// ---- JUnit

// Characters that XML 1.0 does not have, and bytes that are no UTF-8, become "?".
std::string xml_text(const std::string& text) {
    // Returns a JSON text; its writer replaces broken UTF-8 by U+FFFD.
    const std::string valid = Json::parse(json_text(text, -1)).get<std::string>();
    std::string result;
    for (const char c : valid) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\n':
                result += "&#10;";
                break;
            case '\t':
                result += "&#9;";
                break;
            default:
                result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
        }
    }
    return result;
}

std::string attribute(const std::string& name, const std::string& value) {
    return " " + name + "=\"" + xml_text(value) + "\"";
}

std::string number_attribute(const std::string& name, double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return attribute(name, text);
}

std::string junit_failure(const TestResult& test) {
    const std::string element = test.is_expectation ? "failure" : "error";
    std::string details = message_text(test, "");
    for (const TestLine& caller : test.callers)
        details += "called from " + place_text(caller) + "\n";
    return "      <" + element + attribute("message", test.message) +
           attribute("type", test.is_expectation ? "expectation" : "error") + ">" +
           xml_text(details) + "</" + element + ">\n";
}

std::string junit_case(const FileResult& file, const TestResult& test) {
    std::string text = "    <testcase" + attribute("name", shown_name(test)) +
                       attribute("classname", file.file) + attribute("file", file.file) +
                       number_attribute("line", test.line) +
                       number_attribute("time", test.seconds) + ">\n";
    if (test.status == TestStatus::failed) text += junit_failure(test);
    if (test.status == TestStatus::skipped) {
        text += "      <skipped" + attribute("message", test.message) + "/>\n";
    }
    if (!test.output.empty())
        text += "      <system-out>" + xml_text(test.output) + "</system-out>\n";
    return text + "    </testcase>\n";
}

// Errors among these failures: the attributes that both suites and all of them have.
std::string junit_counts(const std::vector<FileResult>& results, double seconds) {
    int errors = 0;
    for (const FileResult& file : results) {
        for (const TestResult& test : file.tests) {
            errors += test.status == TestStatus::failed && !test.is_expectation ? 1 : 0;
        }
    }
    const TestCounts counts = counts_of(results);
    return number_attribute("tests", counts.tests()) +
           number_attribute("failures", counts.failed - errors) +
           number_attribute("errors", errors) + number_attribute("skipped", counts.skipped) +
           number_attribute("time", seconds);
}

// ---- JSON

Json test_json(const FileResult& file, const TestResult& test) {
    Json json = {{"file", file.file}, {"name", test.name}, {"line", test.line}};
    json["status"] = status_word(test.status);
    json["seconds"] = test.seconds;
    if (test.status != TestStatus::passed) json["message"] = test.message;
    if (test.status == TestStatus::failed) {
        json["kind"] = test.is_expectation ? "expectation" : "error";
        json["at"] = {{"file", test.place.file}, {"line", test.place.line}};
        json["callers"] = Json::array();
        for (const TestLine& caller : test.callers) {
            json["callers"].push_back({{"file", caller.file}, {"line", caller.line}});
        }
    }
    if (!test.output.empty()) json["output"] = test.output;
    if (!test.folder.empty()) json["folder"] = test.folder;
    if (!test.left_out.empty()) json["left_out"] = test.left_out;
    if (!test.updated.empty()) json["updated"] = test.updated;
    return json;
}

}  // namespace

std::string file_text(const FileResult& result, bool verbose) {
    if (result.tests.empty()) return "";
    TestCounts counts;
    counts.add(result);
    const bool has_failed = counts.failed > 0;
    std::string text = (has_failed ? "FAILED  " : "ok      ") + result.file + "  (" +
                       (has_failed ? std::to_string(counts.failed) + " of " : std::string()) +
                       counted(counts.tests(), "test") + ", " + duration_text(result.seconds) +
                       ")\n";
    for (const TestResult& test : result.tests) text += test_text(result, test, verbose);
    return text;
}

std::string counts_text(const TestCounts& counts, double seconds) {
    std::string text =
        std::to_string(counts.passed) + " passed, " + std::to_string(counts.failed) + " failed";
    if (counts.skipped > 0) text += ", " + std::to_string(counts.skipped) + " skipped";
    if (counts.left_out > 0) text += ", " + counted(counts.left_out, "picture") + " not compared";
    if (counts.updated > 0) text += ", " + counted(counts.updated, "picture") + " written";
    return text + " (" + counted(counts.files, "file") + ", " + duration_text(seconds) + ")";
}

std::string tap_text(const std::vector<FileResult>& results) {
    std::string text = "TAP version 13\n";
    int number = 0;
    for (const FileResult& file : results) {
        for (const TestResult& test : file.tests) {
            text += std::string(test.status == TestStatus::failed ? "not ok " : "ok ") +
                    std::to_string(++number) + " - " +
                    tap_name(file.file + ": " + shown_name(test));
            if (test.status == TestStatus::skipped) text += " # SKIP " + tap_name(test.message);
            text += "\n";
            if (test.status == TestStatus::failed) text += tap_details(test);
        }
    }
    return text + "1.." + std::to_string(number) + "\n";
}

std::string junit_text(const std::vector<FileResult>& results, double seconds) {
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"lissom test\"" +
        junit_counts(results, seconds) + ">\n";
    for (const FileResult& file : results) {
        if (file.tests.empty()) continue;
        text += "  <testsuite" + attribute("name", file.file) + junit_counts({file}, file.seconds) +
                ">\n";
        for (const TestResult& test : file.tests) text += junit_case(file, test);
        text += "  </testsuite>\n";
    }
    return text + "</testsuites>\n";
}

Json results_json(const std::vector<FileResult>& results, double seconds) {
    const TestCounts counts = counts_of(results);
    Json json = {{"passed", counts.passed},
                 {"failed", counts.failed},
                 {"skipped", counts.skipped},
                 {"seconds", seconds},
                 {"tests", Json::array()}};
    for (const FileResult& file : results) {
        for (const TestResult& test : file.tests) json["tests"].push_back(test_json(file, test));
    }
    return json;
}

std::string list_text(const std::vector<FileResult>& results) {
    std::string text;
    for (const FileResult& file : results) {
        for (const TestResult& test : file.tests) {
            text += place_text({file.file, test.line}) + ": " + shown_name(test) + "\n";
        }
    }
    return text;
}

Json list_json(const std::vector<FileResult>& results) {
    Json tests = Json::array();
    for (const FileResult& file : results) {
        for (const TestResult& test : file.tests) {
            tests.push_back({{"file", file.file}, {"name", test.name}, {"line", test.line}});
        }
    }
    return {{"tests", tests}};
}

}  // namespace lissom::cli
