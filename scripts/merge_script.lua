--- Common parts of the scripts of merging: their parameters, the models they are run on, and their files.
--
--     local params = merge_script.params(add_tail.schema)
--     local source, target, options = merge_script.models(params, { "keys" }, generate)
--     merge_script.finish(params, "mermaid", mesh, report, parts)
local lissom = require "lissom"
local merge_pairs = require "merge_pairs"
local merge_pictures = require "merge_pictures"

local merge_script = {}

-- Parameters that every script of merging has.
local script_schema = {
    source = { type = "file", default = "", help = "model that is deformed, instead of a generated one" },
    target = { type = "file", default = "", help = "model that stays, instead of a generated one" },
    models = { type = "string", default = "", help = "folder of well known models, for `pair`" },
    pair = { type = "string", default = "", help = "name of a pair of scripts/merge_pairs.lua" },
    levels = { type = "integer", default = 0, min = 0, max = 3, help = "Loop subdivisions of models first" },
    seam = { type = "choice", default = "conform", choices = { "conform", "fair", "band" },
        help = "how the seam is sewn" },
    fade = { type = "boolean", default = false,
        help = "a transition region of widths that suit the seam, in place of the two below" },
    fade_source = { type = "number", default = 0, min = 0,
        help = "width of the transition region on the source" },
    fade_target = { type = "number", default = 0, min = 0, help = "and on the target" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
    size = { type = "integer", default = 640, min = 64, max = 4096, unit = "pixels", help = "of a picture" },
}

--- The parameters of a script: those of `schema`, models, and the folder of its files.
function merge_script.params(schema)
    local all = {}
    for _, list in ipairs{ script_schema, schema or {} } do
        for name, one in pairs(list) do all[name] = one end
    end
    return lissom.params(all)
end

-- Options of lissom.merge that come from the parameters of a script.
local function script_options(params)
    local options = { seam = params.seam }
    if params.fade then
        options.transition = true
    elseif params.fade_source > 0 or params.fade_target > 0 then
        options.transition = { source = params.fade_source, target = params.fade_target }
    end
    return options
end

--- Source, target and options of a script: a known pair, given models, or the result of generate(); and the
-- values that the command line gave to parameters of `schema`.
function merge_script.models(params, schema, generate)
    local source, target, options
    if params.pair ~= "" then
        source, target, options = merge_pairs.load(params.pair, params.models)
    elseif params.source ~= "" or params.target ~= "" then
        source, target = lissom.load(params.source), lissom.load(params.target)
        source = source:subdivide(params.levels, { scheme = "loop" })
        target = target:subdivide(params.levels, { scheme = "loop" })
        options = {}
    else
        source, target, options = generate()
    end
    for name, one in pairs(schema) do
        if params[name] ~= one.default then options[name] = params[name] end
    end
    for name, value in pairs(script_options(params)) do
        if options[name] == nil then options[name] = value end
    end
    return source, target, options
end

--- Prints the report of a merge, saves OUT/NAME.obj and draws its pictures; more are options of
-- merge_pictures.write.
function merge_script.finish(params, name, mesh, report, parts, more)
    merge_pictures.print(name, mesh, report, parts)
    print(mesh:save(params.out .. "/" .. name .. ".obj"))
    local all = { name = name, out = params.out, size = params.size, mesh = mesh, report = report,
        parts = parts }
    for key, value in pairs(more or {}) do all[key] = value end
    merge_pictures.write(all)
end

return merge_script
