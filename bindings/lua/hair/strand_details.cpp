// lissom.Strands: local details of examples.
#include "bindings/lua/hair/strand_effect.h"
#include "kernel/hair/operators/strand_detail.h"
#include "kernel/io/strand_file.h"

namespace lissom::lua {
namespace {

// The examples, of a script or of a file. Inside Call::attempt only.
Strands examples_of(const Call& call) {
    if (call.is_object<StrandsObject>("from")) return call.object<StrandsObject>("from")->strands;
    return load_strands(call.file(call.string("from"), FileUse::read), {}, call.context());
}

int give_strand_details(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        DetailOptions options;
        read_effect(call, asked, options);
        options.span = call.number("span");
        options.scale = call.number("scale");
        options.turn = call.number("turn");
        options.resample = call.boolean("resample");
        add_detail(strands, examples_of(call), options, call.context());
    });
}

int take_strand_details(Call& call) {
    return new_strands(
        call, [&] { return details(strands_of(call), call.number("span"), call.context()); });
}

Parameter span_field() {
    return meters("span",
                  "Bends shorter than this are details, longer ones the course of a strand.")
        .defaults(DetailOptions().span)
        .above(0);
}

const std::string kKinkedStrand =
    "local points = {}\n"
    "for k = 0, 60 do points[k + 1] = { 0.002 * math.sin(k), -0.002 * k, 0 } end\n"
    "local example = lissom.strands{ points = points, counts = { 61 } }\n";

std::vector<ErrorCode> errors_of_files() {
    std::vector<ErrorCode> errors = kOperatorErrors;
    for (const ErrorCode code :
         {ErrorCode::file_not_found, ErrorCode::file_is_directory, ErrorCode::file_empty,
          ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::file_truncated,
          ErrorCode::file_too_large, ErrorCode::unknown_format, ErrorCode::unsupported}) {
        errors.push_back(code);
    }
    return errors;
}

}  // namespace

std::vector<Function> strand_detail_methods() {
    const DetailOptions d;
    return {
        {.name = "detail",
         .body = give_strand_details,
         .summary =
             "Gives strands the curls and kinks of examples in place of their own, by differential "
             "coordinates along each strand, while its course stays; strands of a guide take those "
             "of one example.",
         .options = with_fields(
             {either("from",
                     {object("from", "lissom.Strands", "Hair with the details."),
                      string("from", "A file of such hair.")},
                     "The examples."),
              span_field(),
              number("scale", "Size of the details, as a multiple of that of the examples.")
                  .defaults(d.scale)
                  .above(0),
              number("turn",
                     "Details of each guide are turned about the strand by up to this part of a "
                     "turn, at random.")
                  .defaults(d.turn)
                  .between(0, 1),
              boolean("resample",
                      "Strands with longer segments than their example get more points.")
                  .defaults(d.resample)},
             effect_fields(d)),
         .results = kSelfStrands,
         .errors = errors_of_files(),
         .example = kTwoStrands + kKinkedStrand +
                    "hair:detail{ from = example, scale = 0.5 }\n"
                    "assert(hair:stats().points > 5)"},
        {.name = "details",
         .body = take_strand_details,
         .summary = "Takes the details alone: the same strands with straight courses, which hang "
                    "down from their roots. Saved, they are examples for strands:detail.",
         .options = {span_field()},
         .results = {{"lissom.Strands", "strands", "The new strands."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kKinkedStrand + "assert(#example:details{ span = 0.03 } == 1)"}};
}

}  // namespace lissom::lua
