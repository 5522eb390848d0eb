--- Selects vertices: the region "selected" of each mesh, with which the other tools work.
--
-- Click or drag over the surface. With shift the hit is added, with ctrl removed; a click beside everything
-- selects nothing. Keys: + and - grow and shrink the selection by a ring, i inverts it, a selects all, d or
-- Escape nothing.
local lissom = require "lissom"
local brush = require "tools.support.brush"
local disk = require "tools.support.disk"
local meshes = require "tools.support.meshes"

-- Effects of the keys on the selected vertices.
local changes = {
    ["+"] = function(region) return region:grow(1) end,
    ["-"] = function(region) return region:shrink(1) end,
    i = function(region) return region:invert() end,
    a = function(region) return region:mesh():region{ all = true } end,
    d = function(region) return region:mesh():region{ vertices = {} } end,
}
changes["="] = changes["+"]

local function change_all(scene, change)
    for _, one in ipairs(meshes.visible(scene)) do
        meshes.select(one.mesh, change(meshes.selection(one.mesh)))
    end
end

-- Selects the hits, a region for each mesh, together with the selection at the press.
local function choose(stroke, ev, hit)
    for _, one in ipairs(meshes.visible(ev.scene)) do
        local mesh = one.mesh
        local before, found = stroke.before[mesh], hit[mesh] or mesh:region{ vertices = {} }
        if before and stroke.takes then found = before:minus(found) end
        if before and stroke.adds then found = before:union(found) end
        meshes.select(mesh, found)
    end
end

-- Adds the result of ev:select to a table of regions, one for each mesh.
local function joined(regions, found)
    for _, one in ipairs(found) do
        local old = regions[one.mesh]
        regions[one.mesh] = old and old:union(one.region) or one.region
    end
    return regions
end

-- Actions of each way to select: at the press, at each motion of the cursor, and at the end. Each may return
-- the hits.
local ways = {}
ways.click = {
    press = function(stroke, ev, params)
        local hit = ev:pick{ kinds = { "vertex", "face" }, through = params.through }
        return hit and { [hit.mesh] = hit.mesh:region{ vertices = { hit.vertex } } } or {}
    end,
}

ways.component = {
    press = function(stroke, ev)
        local hit = ev:hit()
        return hit and { [hit.mesh] = hit.mesh:region{ all = true }:connected{ at = hit.vertex } } or {}
    end,
}

local function paint(stroke, ev, params)
    return stroke.brush:cover(ev, params.radius, { through = params.through })
end
ways.brush = { press = paint, drag = paint }

local function enclosed(stroke, ev, params)
    if not stroke.outline or #stroke.outline < 3 then return {} end
    return joined({}, ev:select{ lasso = stroke.outline, through = params.through })
end

ways.lasso = {
    press = function(stroke, ev) stroke.outline = { { ev.x, ev.y } } end,
    drag = function(stroke, ev) table.insert(stroke.outline, { ev.x, ev.y }) end,
    release = enclosed,
}

ways.rectangle = {
    drag = function(stroke, ev)
        local x, y = ev.start[1], ev.start[2]
        stroke.outline = { { x, y }, { ev.x, y }, { ev.x, ev.y }, { x, ev.y } }
    end,
    release = enclosed,
}

-- A disk over the surface: pressed in its middle, dragged to its rim.
ways.disk = {
    press = function(stroke, ev)
        local hit = ev:hit()
        if not hit then return {} end
        stroke.disk = disk.around(hit.mesh, hit.vertex)
        return { [hit.mesh] = hit.mesh:region{ vertices = { hit.vertex } } }
    end,
    drag = function(stroke, ev)
        local hit = stroke.disk and ev:hit()
        if not hit or not rawequal(hit.mesh, stroke.disk.mesh) then return nil end
        return { [hit.mesh] = stroke.disk:up_to(hit.vertex) }
    end,
}

-- Lets the way that is set do its part of a drag.
local function on(stage)
    return function(self, ev)
        local act = self.stroke and self.stroke.way[stage]
        local hit = act and act(self.stroke, ev, self.params)
        if hit then choose(self.stroke, ev, hit) end
        if stage == "release" then self.stroke = nil end
    end
end

return lissom.tool{
    name = "select",
    help = "Click or drag over the surface; shift adds, ctrl removes. Keys: + - i(nvert) a(ll) d(rop).",
    params = {
        by = { type = "choice", default = "brush", choices = { "click", "brush", "lasso", "rectangle", "disk",
            "component" }, help = "click: a vertex; disk: over the surface, from its middle to its rim" },
        radius = { type = "number", default = 30, min = 1, max = 300, unit = "pixels", help = "brush" },
        through = { type = "boolean", default = false, help = "Includes parts hidden by the surface." },
    },
    brush = brush.new(),
    press = function(self, ev)
        self.brush:lift()
        self.stroke = { way = ways[self.params.by], brush = self.brush, adds = ev.shift, takes = ev.ctrl }
        self.stroke.before = {}
        for _, one in ipairs(meshes.visible(ev.scene)) do
            self.stroke.before[one.mesh] = meshes.selection(one.mesh)
        end
        on("press")(self, ev)
    end,
    drag = on("drag"),
    release = on("release"),
    move = function(self, ev) self.brush:move(ev) end,
    key = function(self, ev)
        if changes[ev.key] and not self.stroke then change_all(ev.scene, changes[ev.key]) end
    end,
    draw = function(self, view)
        local outline = self.stroke and self.stroke.outline
        if outline then view:outline{ pixels = outline, closed = true } end
        if self.params.by == "brush" then self.brush:draw(view, self.params.radius) end
    end,
    cancel = function(self, ev)
        local after_error = ev.scene:depth() == 0       -- else it is a step
        if not (self.stroke or after_error) then change_all(ev.scene, changes.d) end
        self.stroke = nil
    end,
    deactivate = function(self) self.stroke = nil; self.brush:lift() end,
}
