// Texts, tables and objects that scenes, styles and other objects keep for a script.
#include "tests/unit/bindings/sandbox/hostile_scripts.h"

namespace lissom::test {
namespace {

using enum HostileEnd;

const std::string kLibrary = "local l = require('lissom') kept = {} ";
const std::string kScene =
    kLibrary + "local m = l.shapes.box() local s = l.scene{ history = 1e12 } s:add('m', m) ";
const std::string kTwoLocks =
    kLibrary + "local h = l.strands{ points = { { 0, 0, 0 }, { 0, 1, 0 } }, counts = { 1, 1 } } ";
// A head of few vertices, and a style with one curve.
const std::string kCoarseStyle =
    kLibrary +
    "local head = l.shapes.head{ vertices = 3000 } local style = l.hairstyle(head, { resolution = "
    "5000 }) local p = { style:at{ azimuth = 20, elevation = 50, lift = 0.01 }, "
    "style:at{ azimuth = 70, elevation = 10, lift = 0.02 } } "
    "local c = style:add_stream{ points = p } ";
const std::string kText = "(('n'):rep(4000000) .. i)";

std::string again(const std::string& step) {
    return "for i = 1, 1e9 do " + step + " end";
}

}  // namespace

std::vector<HostileScript> hostile_keeping() {
    const char* const limit = "memory";
    return {
        {"regions of styles", kScene + again("s:set('m', { style = { region = " + kText + " } })"),
         error, limit},
        {"regions of new objects",
         kScene + again("s:add('o' .. i, m, { style = { region = " + kText + " } })"), error,
         limit},
        {"parameters of a scene",
         kScene + again("s:set_parameters('o' .. i, { a = " + kText + " })"), error, limit},
        {"names of parameters of a scene",
         kScene + again("s:set_parameters('o' .. i, { [" + kText + "] = 1 })"), error, limit},
        {"owners of parameters of a scene",
         kScene + again("s:set_parameters(" + kText + ", { a = 1 })"), error, limit},
        {"many owners of parameters", kScene + again("s:set_parameters('o' .. i, { a = i })"),
         error, limit},
        {"names of open steps", kScene + again("s:begin(" + kText + ")"), error, limit},
        {"open steps", kScene + again("s:begin('a')"), error, limit},
        {"small steps", kScene + again("s:set('m', { visible = i % 2 == 0 })"), any},
        {"names of attributes in a history",
         kScene + "m:add_attribute{ name = ('n'):rep(4000000), domain = 'vertex', width = 1 } " +
             again("m:transform{ translate = { 1, 0, 0 } } s:hash()"),
         error, limit},
        {"names of the attributes of buffers",
         kScene +
             "local n = ('n'):rep(4000000) m:add_attribute{ name = n, domain = 'vertex', "
             "width = 1 } " +
             again("kept[i] = m:attribute(n)"),
         error, limit},
        {"comments of strands",
         kTwoLocks + "h:set_comment(('c'):rep(6000000)) " + again("kept[i] = h:copy()"), error,
         limit},
        {"a comment in a history",
         kTwoLocks + "local s = l.scene{ history = 1e12 } s:add('h', h) " +
             again("h:set_comment(" + kText + ") s:hash()"),
         error, limit},
        {"profiles of strands",
         kTwoLocks +
             "local p = {} for i = 1, 100000 do p[i] = 1 end "
             "h:set_widths{ width = 1e-4, profile = p } " +
             again("kept[i] = h:copy()"),
         error, limit},
        {"names of curves",
         kCoarseStyle + again("style:add_stream{ points = p, name = " + kText + " }"), error,
         limit},
        {"names of a curve",
         kCoarseStyle + again("kept[i] = l.scene{} kept[i]:add('s', style) "
                              "c:set{ name = " +
                              kText + " }"),
         error, limit},
        {"masks",
         kCoarseStyle + "local q = {} for i = 1, 20000 do q[i] = p[1] end " +
             again("style:add_mask{ points = q, kind = 'length', value = 0.5, radius = 0.01 }"),
         any},
    };
}

}  // namespace lissom::test
