-- Plays the game of examples/love for some frames, looks at its picture, and says what is wrong with it.
require "game"

local frames = 0
local update, draw = love.update, love.draw

-- At one place of the sway, however fast the machine is.
function love.update() update(frames == 1 and 0.9 or 0) end

-- How much of a part of the picture is not background, and how many shades it has.
local function seen(image, left, right)
    local count, shades, different = 0, {}, 0
    local r0, g0, b0 = image:getPixel(1, 1)
    for x = left, right - 1, 2 do
        for y = 0, image:getHeight() - 1, 2 do
            local r, g, b = image:getPixel(x, y)
            if math.abs(r - r0) + math.abs(g - g0) + math.abs(b - b0) > 0.1 then count = count + 1 end
            local key = string.format("%d %d %d", 31 * r, 31 * g, 31 * b)
            if not shades[key] then shades[key], different = true, different + 1 end
        end
    end
    return count / ((right - left) * image:getHeight() / 4), different
end

local function check(image)
    image:encode("png", "picture.png")
    local width = image:getWidth()
    for name, part in pairs{ bar = { 0, width / 2 }, head = { width / 2, width } } do
        local share, shades = seen(image, part[1], part[2])
        print(string.format("%s: %.1f %% of its half, %d shades", name, 100 * share, shades))
        if share < 0.08 or share > 0.8 or shades < 8 then
            print("the picture of the " .. name .. " is not what it should be")
            love.event.quit(1)
            return
        end
    end
    print("drawn in " .. love.filesystem.getSaveDirectory())
    love.event.quit(0)
end

function love.draw()
    draw()
    frames = frames + 1
    if frames == 5 then love.graphics.captureScreenshot(check) end
end
