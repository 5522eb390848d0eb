--- Merges two meshes along an open boundary of each: what answers the clicks is a coroutine.
--
-- Click the loop of the part that is moved, then the loop that it is joined to: the merged surface appears
-- there, instead of the second mesh. Where it is turned wrongly, click pairs of points that shall meet, the
-- first on the loop of the part, the second on the seam. Enter takes the result, and the part is hidden too.
-- `transition` may be changed until the next merge: the result follows.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

local pick = lissom.pick

-- Merges. A join is { source =, target =, keys = }: hits of two loops, pairs of points on them.
local function merged(self, scene, join)
    for _, hit in ipairs{ join.source, join.target } do
        local there = rawequal(meshes.get(scene, hit.object), hit.mesh)
        if not there then error(hit.object .. " is no longer there", 0) end
    end
    local source, target, radii = join.source.boundary, join.target.boundary, self.params.transition
    local function width(loop) return radii * loop:length() / (2 * math.pi) end
    return assert(lissom.merge{
        joins = { { source = source, target = target, keys = #join.keys > 0 and join.keys or nil } },
        transition = radii > 0 and { source = width(source), target = width(target) } or nil,
    })
end

-- Shows the result of a join, in place of the one before or of the target.
local function show(self, scene, join)
    local mesh, report = merged(self, scene, join)
    local before = self.result and scene:info(self.result)
    if before then
        scene:remove(self.result)
    else
        self.result = meshes.unused_name(scene, "merged")
        scene:set(join.target.object, { visible = false })
    end
    scene:add(self.result, mesh, { transform = scene:info(join.target.object).transform })
    -- For the colours of the window; by ids, which a journal can tell.
    for _, name in ipairs{ "seam", "transition" } do
        local region = report[name].region
        if region then mesh:set_region(name, mesh:region{ vertices = region:vertices() }) end
    end
    self.joins[mesh:hash()] = join
end

-- The same; where it cannot be merged, that is told in the picture, and the clicks go on.
local function try(self, scene, join)
    local done, message = pcall(show, self, scene, join)
    message = not done and message:gsub("^%S+:%d+: ", ""):gsub(" %[[%l_]+%]$", "")
    self.trouble = message and { at = join.target.position, text = message } or nil
end

-- The join that is shown, which undo changes too; nil where there is none.
local function shown(self, scene)
    local mesh = self.result and scene:get(self.result)
    return mesh and self.joins[mesh:hash()]
end

-- The same, as long as the result is not taken: the part is still to be seen.
local function in_progress(self, scene)
    local join = shown(self, scene)
    local source = join and scene:info(join.source.object)
    return source and source.visible and join
end

-- The point of a loop that was clicked, in the space of its mesh.
local function on_loop(scene, loop, hit)
    local place = scene:info(loop.object).transform
    return loop.boundary:nearest(matrices.point(matrices.inverse(place), hit.position)).position
end

-- Draws a loop and the keys on it, the first or second of each pair.
local function draw_loop(view, loop, keys, which, color)
    local info = loop and view.scene:info(loop.object)
    if not info then return end
    local points = {}
    for i, point in ipairs(loop.boundary:points()) do points[i] = matrices.point(info.transform, point) end
    view:line{ points = points, closed = true, color = color, width = 4 }
    for number, pair in ipairs(keys) do
        local at = pair[which] and matrices.point(info.transform, pair[which])
        if at then view:handle{ at = at, color = color } end
        if at then view:label{ at = at, text = tostring(number) } end
    end
end

return lissom.tool{
    name = "merge",
    help = "Click two loops, then pairs of points that meet; Enter takes the result.",
    params = {
        transition = { type = "number", default = 0, min = 0, max = 2, unit = "radii of the loop",
            help = "Width on either side of the seam in which the details of both fade into each other." },
    },
    joins = {},             -- by the hash of what they make
    run = function(self, ev)
        local scene = ev.scene
        self.open = nil
        while not in_progress(self, scene) do           -- after undo it may be: then keys are asked for
            self.source = nil
            self.source = pick.boundary{
                prompt = "Click the loop of the part that is moved (the box 'boundaries' shows all)" }
            self.result = nil
            local target = pick.boundary{ prompt = "Click the loop that it is joined to" }
            try(self, scene, { source = self.source, target = target, keys = {} })
        end
        local join = shown(self, scene)
        while join do
            local from = pick.boundary{ prompt = "Enter takes it; or click a point of the part's loop",
                object = join.source.object, optional = true }
            if not from then return scene:set(join.source.object, { visible = false }) end
            self.open = { on_loop(scene, join.source, from) }
            local to = pick.point{ prompt = "Click where it belongs on the seam", object = self.result }
            local keys = table.move(join.keys, 1, #join.keys, 1, {})
            table.insert(keys, { self.open[1], on_loop(scene, join.target, to) })
            self.open = nil
            try(self, scene, { source = join.source, target = join.target, keys = keys })
            join = shown(self, scene)
        end
    end,
    changed = function(self, ev)
        local join = shown(self, ev.scene)
        if join then try(self, ev.scene, join) end
    end,
    draw = function(self, view)
        if self.trouble then view:label(self.trouble) end
        local join = in_progress(self, view.scene) or { source = self.source, keys = {} }
        local keys = table.move(join.keys, 1, #join.keys, 1, {})
        table.insert(keys, self.open)
        draw_loop(view, join.source, keys, 1, "#d06020")
        draw_loop(view, join.target, keys, 2, "#2070c0")
    end,
    cancel = function(self, ev)
        local in_a_step = ev.scene:depth() > 0          -- after an error there is none
        local join = in_a_step and in_progress(self, ev.scene)
        if join then
            ev.scene:remove(self.result)
            ev.scene:set(join.target.object, { visible = true })
        end
        self.source, self.trouble = nil, nil
    end,
    deactivate = function(self) self.source, self.trouble = nil, nil end,
}
