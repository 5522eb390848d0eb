-- ---- Marks over the picture. A view is lissom.ToolView.

local hover_color = "#ffd24a"

-- The points of the boundary that was hit, in the place of its object.
local function points_of(scene, hit)
    local place = hit.object and scene:info(hit.object).transform
    local points = {}
    for i, v in ipairs(hit.boundary:vertices()) do
        local x, y, z = hit.mesh:position(v)
        points[i] = { x, y, z }
        for row = 1, place and 3 or 0 do
            local m = place[row]
            points[i][row] = m[1] * x + m[2] * y + m[3] * z + m[4]
        end
    end
    return points
end

-- Shows the answer of a click.
local function draw_hover(view, host)
    local hit, request = host.hover, host.request
    if not hit or not request then return end
    if hit.object and not try(host.scene.info, host.scene, hit.object) then return end
    if request.kind == "boundary" then
        view:line{ points = points_of(host.scene, hit), closed = true, color = hover_color, width = 5 }
    else
        view:points{ points = { hit.position }, color = hover_color, radius = 6 }
    end
end

-- The view that the tool has drawn on.
function Host:drawn_view()
    self:ready()
    local view = new_view{ camera = self.camera, scene = self.scene, size = self.size, up = self:up_axis(),
        cursor = self.x and { self.x, self.y } or nil }
    draw_hover(view, self)
    local draw = self.tool and self.tool.draw
    -- One that was stopped from outside never came to its end: only another tool draws again.
    if not draw or rawequal(self.draws, self.tool) then return view end
    self.working, self.draws = true, self.tool
    local before = self.scene:depth()
    self.scene:begin("draw")
    local outer = guard(self.scene, before + 1)
    local done, message = pcall(draw, self.tool, view)
    self.working, self.draws = false, nil
    guard(self.scene, outer)
    local whole = self.scene:depth() == before + 1
    local changed = whole and self.scene:commit()
    while self.scene:depth() > before do self.scene:rollback() end
    if done and whole and not changed then return view end
    if changed and before == 0 then self.scene:undo() end
    if done then
        message = new_error("the tool '" .. self.tool.name .. "' changed the scene while it was drawn")
    end
    self:fail(message)
end

function Host:draw() return marks_of(self:drawn_view()) end

function Host:prompt()
    local request = self.request
    if not request then return self.tool and self.tool.help or nil end
    if request.kind ~= "number" then return request.prompt end
    return request.prompt .. " " .. (self.typed ~= "" and self.typed or tostring(request.default or ""))
end

