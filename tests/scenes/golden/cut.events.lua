-- What was done with tools; lissom run does it again.
return (require("lissom").replay{
    version = 1,
    open = { "cactus.lua" },
    before = "65d4f1bf8be61cfe",
    events = {
        { "look", { eye = { 0, 0, 5 }, fov = 29.999999999999996, size = { 1280, 960 }, target = { 0, 0, 0 }, up = { 0, 1, 0 } }, t = 0 },
        { "tool", "cut", t = 0.001 },
        { "look", { eye = { 2.2885382203499978, 2.4565857608955204, 3.1064418632227175 }, fov = 29.999999999999996, size = { 990, 682 }, target = { 0.060570319819824976, 1.0428003483489667, -0.07542605300486266 }, up = { -0.19617469496901105, 0.9396926207859083, -0.2801664995932355 } }, t = 0.034 },
        { "press", 330, 520, t = 0.869 },
        { "move", 382, 512, t = 0.883 },
        { "move", 434, 504, t = 0.915 },
        { "move", 486, 496, t = 0.96 },
        { "move", 538, 488, t = 1.004 },
        { "move", 590, 480, t = 1.048 },
        { "release", 590, 480, hash = "28f8eed968baac4c", objects = { { "cactus 2", "467561e6a486c249" }, { "cactus 3", "b7327cc5db5b6603" } }, t = 1.294 },
    },
    after = "28f8eed968baac4c",
})
