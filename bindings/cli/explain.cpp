// lissom explain CODE
#include <CLI/CLI.hpp>
#include <iostream>

#include "bindings/cli/json.h"
#include "bindings/cli/verbs.h"
#include "kernel/core/error.h"
#include "kernel/core/nearest.h"

namespace lissom::cli {
namespace {

Json code_json(ErrorCode code) {
    return {{"code", std::string(code_name(code))},
            {"explanation", std::string(code_explanation(code))}};
}

void print_code(const Json& code) {
    std::cout << code["code"].get<std::string>() << ": " << code["explanation"].get<std::string>()
              << "\n";
}

}  // namespace

int explain(Program& program, const std::vector<std::string>& words) {
    CLI::App app("Explains an error code and its remedy.", "lissom explain");
    std::string name;
    app.add_option("CODE", name, "The code; if left out, all are listed");
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    Json found = Json::array();
    std::vector<std::string_view> names;
    for (const ErrorCode code : all_codes()) {
        names.push_back(code_name(code));
        if (name.empty() || name == code_name(code)) found.push_back(code_json(code));
    }
    if (found.empty()) {
        return program.fail("lissom explain: no code '" + name + "'" + name_hint(name, names),
                            kUsage);
    }
    if (program.json()) {
        std::cout << json_text(name.empty() ? Json{{"codes", found}} : found[0]) << std::endl;
        return kSuccess;
    }
    for (const Json& code : found) print_code(code);
    return kSuccess;
}

}  // namespace lissom::cli
